"""What a run leaves behind: scalars of every increment, fields of some, the scene inside."""

from __future__ import annotations

import json
import numbers
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import xarray as xr

from pyfret import _core, subsurface
from pyfret._core import Scene
from pyfret.doubts import doubt_layers

if TYPE_CHECKING:
    import os
    from collections.abc import Mapping, Sequence

    from numpy.typing import ArrayLike

    from pyfret._core import Body
    from pyfret.subsurface import Stress

__all__ = ["Result", "Snapshot", "open"]

#: Scalars of an increment that add up over a branch.
SUMMED = frozenset(
    (
        "work",
        "elastic",
        "dissipated",
        "opening",
        "quadrature",
        "convolutions",
        "alternations",
        "normal_iterations",
        "tangential_iterations",
        "parts",
    )
)

#: What the codes of ``status`` mean.
STATUS = ("no contact", "full stick", "partial slip", "gross slip")


def yardstick(attrs: Mapping[Any, Any], name: str) -> float:
    """A Hertz yardstick of a run; a ValueError where there is no Hertz contact."""
    if name not in attrs:
        raise ValueError(
            f"no {name}: these bodies have no Hertz contact (a flat, a punch, a rough surface, or "
            "nothing presses); lengths are measured by .length, stresses in Pa"
        )
    return float(attrs[name])


def friction(attrs: Mapping[Any, Any]) -> float:
    """The friction coefficient of a run; infinite for a contact that never slips."""
    mu = attrs["mu"]
    return np.inf if mu is None or mu == "stick" else float(mu)


#: What :meth:`Result.loops` gives: unit and meaning.
LOOP = {
    "first_branch": ("1", "first branch of the cycle, from 0"),
    "last_branch": ("1", "last branch of the cycle"),
    "dissipated": ("J", "energy dissipated in the cycle"),
    "T": ("N", "half the range of the force"),
    "delta": ("m", "half the range of the shift"),
    "stiffness": ("N/m", "stiffness right after the reversals"),
    "secant_stiffness": ("N/m", "stiffness of the whole loop"),
    "opening": ("m", "half the opening of the loop at the middle force"),
    "energy_ratio": ("1", "dissipated energy over that of the surrounding rectangle"),
    "sliding_ratio": ("1", "opening over the range of the shift"),
    "status": ("1", "0 no contact, 1 full stick, 2 partial slip, 3 gross slip"),
}


class Snapshot:
    """The contact at the end of one increment: its scalars and its fields.

    Every variable of :attr:`dataset` is an attribute as well, e.g. ``snapshot.p``.
    """

    # The variables of a result store, for editors and type checkers.
    x: xr.DataArray
    y: xr.DataArray
    increment: xr.DataArray
    t: xr.DataArray
    branch_of_increment: xr.DataArray
    W: xr.DataArray
    T_x: xr.DataArray
    T_y: xr.DataArray
    M_x: xr.DataArray
    M_y: xr.DataArray
    M_z: xr.DataArray
    sigma_B: xr.DataArray
    sigma_B1: xr.DataArray
    rolled: xr.DataArray
    delta_z: xr.DataArray
    delta_x: xr.DataArray
    delta_y: xr.DataArray
    phi_x: xr.DataArray
    phi_y: xr.DataArray
    phi_z: xr.DataArray
    status: xr.DataArray
    contact_area: xr.DataArray
    stick_area: xr.DataArray
    stick_ratio: xr.DataArray
    contact_radius: xr.DataArray
    p_max: xr.DataArray
    q_max: xr.DataArray
    work: xr.DataArray
    elastic: xr.DataArray
    dissipated: xr.DataArray
    opening: xr.DataArray
    quadrature: xr.DataArray
    residual_gap: xr.DataArray
    residual_penetration: xr.DataArray
    residual_coulomb: xr.DataArray
    residual_stick: xr.DataArray
    residual_direction: xr.DataArray
    residual_angle: xr.DataArray
    residual_balance: xr.DataArray
    residual_energy: xr.DataArray
    convolutions: xr.DataArray
    alternations: xr.DataArray
    normal_iterations: xr.DataArray
    tangential_iterations: xr.DataArray
    parts: xr.DataArray
    p: xr.DataArray
    q_x: xr.DataArray
    q_y: xr.DataArray
    u_x: xr.DataArray
    u_y: xr.DataArray
    u_z: xr.DataArray
    gap: xr.DataArray
    slip_x: xr.DataArray
    slip_y: xr.DataArray
    dissipated_density: xr.DataArray
    contact: xr.DataArray
    stick: xr.DataArray

    def __init__(self, dataset: xr.Dataset) -> None:
        self._dataset = dataset

    @property
    def dataset(self) -> xr.Dataset:
        """Fields of dims (x, y), the scalars of the increment, and the attrs of the run."""
        return self._dataset

    def __getattr__(self, name: str) -> xr.DataArray:
        """Give the variable `name` of the dataset."""
        if not name.startswith("_") and name in self.dataset.variables:
            return self.dataset[name]
        raise AttributeError(f"a snapshot has no {name!r}; it has {self.names()}")

    def names(self) -> list[str]:
        """Names of all variables, in order."""
        return sorted(str(name) for name in self.dataset.variables)

    @property
    def a_H(self) -> float:
        """Hertz radius of the uncoated pair at the largest load [m]."""
        return yardstick(self.dataset.attrs, "a_H")

    @property
    def p_H(self) -> float:
        """Hertz peak pressure of the uncoated pair at the largest load [Pa]."""
        return yardstick(self.dataset.attrs, "p_H")

    @property
    def mu(self) -> float:
        """Friction coefficient."""
        return friction(self.dataset.attrs)

    @property
    def scene(self) -> Scene:
        """The scene that was solved."""
        return Scene.from_toml(self.dataset.attrs["scene"])

    @property
    def length(self) -> float:
        """The length that results are measured in [m].

        a_H, or where there is no Hertz contact half the longer side of the box around the contact.
        """
        return self.scene.length(self.dataset["p"].values)

    def __dir__(self) -> list[str]:
        """The variables beside the methods."""
        return sorted({*super().__dir__(), *self.names()})

    def _body(self, body_number: int) -> Body:
        scene = self.scene
        return scene.body1 if body_number == 1 else scene.body2

    def _tractions(self) -> dict[str, np.ndarray]:
        return {k: self.dataset[k].values for k in ("p", "q_x", "q_y")}

    def bulk_stress(self, body_number: int = 2) -> float:
        """Bulk stress along x of the substrate of a body [Pa]."""
        return float(self.dataset["sigma_B1" if body_number == 1 else "sigma_B"])

    def stress(
        self,
        z: ArrayLike | None = None,
        *,
        x: float | None = None,
        y: float | None = None,
        body_number: int = 2,
        bulk: bool = True,
        rim: bool = True,
    ) -> Stress:
        """Stress below the contact, in the lower body unless `body_number` is 1.

        Parameters
        ----------
        z : float or array, optional
            Depths [m]; those on an interface appear twice, once in each layer (default: those that
            the layers ask for, down to twice :attr:`length`).
        x, y : float, optional
            With `y`, the section along x at that y; with `x`, that along y; with both, the line
            below a point; with neither, the whole plane at every depth given, or where none is, the
            section at y = 0.
        body_number : 1 or 2
            The body.
        bulk : bool
            Whether its bulk stress is part of the stress.
        rim : bool
            Whether tractions vary within the cells beside the rim and the stick zone, as in
            :func:`pyfret.subsurface.stress`.

        Warns
        -----
        SceneWarning
            The first interface is nearer to the surface than a cell is long.

        Examples
        --------
        >>> below = result.at(-1).stress()  # doctest: +SKIP
        >>> below.maximum("von_mises")  # doctest: +SKIP
        """
        body, grid = self._body(body_number), self.scene.grid
        doubt_layers(subsurface.interfaces(body), grid)
        sigma_B = self.bulk_stress(body_number) if bulk else 0.0
        below = subsurface.stress(
            body,
            grid,
            z,
            x=x,
            y=y,
            body_number=body_number,
            sigma_B=sigma_B,
            rim=rim,
            stick=self.dataset["stick"].values,
            length=self.length,
            **self._tractions(),
        )
        yardsticks = {k: v for k, v in self.dataset.attrs.items() if k in ("a_H", "p_H")}
        return subsurface.Stress(below.dataset.assign_attrs(yardsticks))

    def p_continued(self) -> xr.DataArray:
        """Pressure at the centres of the cells [Pa], that at the rim continued from inside.

        Cells at the rim carry what balances the others, up to a tenth more or less than the
        pressure at their centres; this is nearer to that. The sum of ``p`` is the load.
        """
        p = self.dataset["p"]
        return p.copy(data=_core.continued_pressure(p.values, self.scene.grid))

    def displacement(
        self,
        z: ArrayLike | None = None,
        *,
        x: float | None = None,
        y: float | None = None,
        body_number: int = 2,
    ) -> xr.Dataset:
        """Displacements u_x, u_y, u_z of a body below the contact [m], as in :meth:`stress`."""
        body, grid = self._body(body_number), self.scene.grid
        loads = self._tractions()
        return subsurface.displacement(
            body, grid, z, x=x, y=y, body_number=body_number, length=self.length, **loads
        )

    def write_volume(
        self,
        out: str | os.PathLike[str],
        z: ArrayLike | None = None,
        *,
        of: Sequence[str] = ("von_mises",),
        body_number: int = 2,
        bulk: bool = True,
        rim: bool = True,
    ) -> None:
        """Write stress, displacement in the volume: :func:`pyfret.subsurface.write_volume`."""
        body, grid = self._body(body_number), self.scene.grid
        subsurface.write_volume(
            body,
            grid,
            out,
            z,
            of=of,
            body_number=body_number,
            sigma_B=self.bulk_stress(body_number) if bulk else 0.0,
            rim=rim,
            stick=self.dataset["stick"].values,
            title=repr(self),
            **self._tractions(),
        )

    def along_x(self, *, y: float = 0.0) -> xr.Dataset:
        """Fields along the line of constant `y` [m], linear between the rows of cells."""
        rows = self.dataset.y.values
        if not rows[0] <= y <= rows[-1]:
            raise ValueError(f"y = {y}: must be {rows[0]} to {rows[-1]}, the rows of the grid")
        above = int(np.clip(np.searchsorted(rows, y), 1, rows.size - 1)) if rows.size > 1 else 0
        below = max(above - 1, 0)
        share = (y - rows[below]) / (rows[above] - rows[below]) if above else 0.0
        fields = self.dataset[[k for k, v in self.dataset.items() if v.dtype.kind == "f"]]
        row = fields.isel(y=below, drop=True) * (1 - share)
        return row + fields.isel(y=above, drop=True) * share

    def __repr__(self) -> str:
        """Say which increment this is and under which loads."""
        d = self.dataset
        return (
            f"Snapshot(increment {int(d.increment)}, t = {float(d.t):.4g}, "
            f"W = {float(d.W):.4g} N, T_x = {float(d.T_x):.4g} N)"
        )


class Result:
    """The result of a run.

    Attributes
    ----------
    dataset : xarray.Dataset
        Scalars over ``increment``; fields over (``saved``, ``x``, ``y``) for the increments whose
        fields were kept; ``attrs`` holds the scene, the version, ``a_H``, ``p_H`` and ``mu``.
        Every variable carries ``units`` and ``long_name``.
    """

    def __init__(self, dataset: xr.Dataset) -> None:
        self.dataset = dataset

    @property
    def scene(self) -> Scene:
        """The scene that was solved."""
        return Scene.from_toml(self.dataset.attrs["scene"])

    @property
    def status(self) -> str:
        """``"done"``, ``"running"``, or the sentence that says why the run stopped."""
        return str(self.dataset.attrs["status"])

    @property
    def a_H(self) -> float:
        """Hertz radius of the uncoated pair at the largest load [m]."""
        return yardstick(self.dataset.attrs, "a_H")

    @property
    def p_H(self) -> float:
        """Hertz peak pressure of the uncoated pair at the largest load [Pa]."""
        return yardstick(self.dataset.attrs, "p_H")

    @property
    def mu(self) -> float:
        """Friction coefficient."""
        return friction(self.dataset.attrs)

    @property
    def length(self) -> float:
        """The length that results are measured in [m].

        a_H, or where there is no Hertz contact half the longer side of the box around the contact
        of the last increment whose fields were kept.
        """
        return self.at(-1).length

    @property
    def delta_H(self) -> float:
        """Hertz approach of the uncoated pair at the largest load [m], a_H^2/R."""
        return self.a_H**2 / yardstick(self.dataset.attrs, "R")

    @property
    def W_max(self) -> float:
        """Largest normal force of the path [N]."""
        return float(self.dataset.W.max())

    @property
    def stick_ratio(self) -> xr.DataArray:
        """Stick area over contact area, every increment."""
        return self.dataset["stick_ratio"]

    @property
    def delta_x(self) -> xr.DataArray:
        """Relative tangential shift of the bodies along x [m], every increment."""
        return self.dataset["delta_x"]

    @property
    def dissipated_energy(self) -> xr.DataArray:
        """Energy dissipated by friction since the start of the path [J], every increment."""
        total = self.dataset["dissipated"].cumsum("increment")
        return total.assign_attrs(units="J", long_name="energy dissipated since the start")

    def at(self, which: float) -> Snapshot:
        """Give the contact at the end of one increment whose fields were kept.

        Parameters
        ----------
        which : int or float
            An integer counts increments from 1; negative ones count the kept increments from the
            last. A float is a path time t.

        Raises
        ------
        KeyError
            The fields of that increment were not kept; the message lists those that were.
        """
        saved = self.dataset.saved_increment.values
        times = self.dataset.saved_t.values
        if not isinstance(which, numbers.Integral):
            places = np.flatnonzero(np.isclose(times, which, rtol=1e-9, atol=1e-12))
        elif which > 0:
            places = np.flatnonzero(saved == which)
        else:
            places = np.flatnonzero(np.arange(saved.size) == saved.size + which)
        if places.size == 0 or which == 0:
            raise KeyError(
                f"no fields were kept at {which!r}; kept are the increments {saved.tolist()} "
                f"at t = {times.tolist()}"
            )
        place = int(places[-1])
        fields = self.dataset.isel(saved=place)
        increment = int(saved[place])
        here = fields.sel(increment=increment).drop_vars(("saved_increment", "saved_t"))
        return Snapshot(here)

    def error_bars(self) -> xr.Dataset:
        """Estimated errors of the numbers at the end of every branch: dims (branch, part).

        Parts are ``total``, and what makes it: ``cells``, told by runs on two coarser grids and, of
        numbers on up to 256 x 256 cells, by one on a finer grid, ``path``, told by a run with fewer
        increments, and ``solver``, its tolerance. ``p`` and ``q`` are the tractions as fields: L2
        norms over the largest of the path. The runs are those of ``solve(..., error=True)`` and
        ``fret run --error``.
        """
        bars = self.dataset.attrs.get("error_bars")
        if not bars:
            raise ValueError(
                "the run has no error bars: solve(..., error=True) or fret run --error"
            )
        parts = list(bars[0]["q"])
        table = xr.Dataset(coords={"branch": [bar["branch"] for bar in bars], "part": parts})
        for name in (name for name in bars[0] if name != "branch"):
            of_field = name in ("p", "q")
            attrs = {"units": "1"} if of_field else self.dataset[name].attrs
            values = [[bar[name][part] for part in parts] for bar in bars]
            table[name] = (("branch", "part"), values, attrs)
        return table

    def branches(self) -> xr.Dataset:
        """Scalars at the end of every branch; energies and work are sums over the branch."""
        of = self.dataset.branch_of_increment.values
        starts = np.flatnonzero(np.diff(of, prepend=of[0] - 1))
        ends = np.append(starts[1:], of.size) - 1
        table = xr.Dataset(coords={"branch": of[ends]}, attrs=self.dataset.attrs)
        for name, variable in self.dataset.variables.items():
            if variable.dims == ("increment",) and name not in self.dataset.indexes:
                values = variable.values
                kept = np.add.reduceat(values, starts) if name in SUMMED else values[ends]
                table[name] = ("branch", kept, variable.attrs)
        return table

    def loops(self, *, direction: Literal["x", "y", "torsion"] = "x") -> xr.Dataset:
        """Energy and stiffness of every closed cycle of the load path.

        Parameters
        ----------
        direction : "x", "y" or "torsion"
            The fretting motion. In torsion ``T`` is the moment M_z [N m], ``delta`` the rotation
            phi_z [rad], and the units of stiffness and opening are theirs.

        Returns
        -------
        xarray.Dataset
            Over ``cycle``: ``dissipated`` [J], half ranges ``T`` [N] and ``delta`` [m],
            ``stiffness`` right after the reversals and ``secant_stiffness`` [N/m], half the
            ``opening`` of the loop [m], ``energy_ratio``, ``sliding_ratio``, ``status``, and the
            branches it spans.
        """
        d = self.dataset
        torsion = direction == "torsion"
        force, shift = ("M_z", "phi_z") if torsion else (f"T_{direction}", f"delta_{direction}")
        found = _core.loops(
            self.scene.path,
            branch=d.branch_of_increment.values.tolist(),
            T=d[force].values.tolist(),
            delta=d[shift].values.tolist(),
            dissipated=d.dissipated.values.tolist(),
            status=d.status.values.tolist(),
        )
        units = {"N": "N m", "m": "rad", "N/m": "N m/rad"} if torsion else {}
        return xr.Dataset(
            {
                name: (
                    "cycle",
                    [cycle[name] for cycle in found],
                    {"units": units.get(unit, unit), "long_name": of},
                )
                for name, (unit, of) in LOOP.items()
            },
            attrs=d.attrs,
        )

    def envelope(
        self,
        z: ArrayLike | None = None,
        *,
        x: float | None = None,
        y: float | None = None,
        of: Sequence[str] = ("von_mises",),
        body_number: int = 2,
        bulk: bool = True,
    ) -> xr.Dataset:
        """Extremes of stress over the increments whose fields were kept, on a section or on planes.

        Use :func:`pyfret.subsurface.envelope` with :func:`pyfret.march` for all increments of a
        path without keeping their fields; parameters and result are those of that function.
        """
        kept = (self.at(int(n)) for n in self.dataset.saved_increment.values)
        return subsurface.envelope(
            self.scene, kept, z, x=x, y=y, of=of, body_number=body_number, bulk=bulk
        )

    def _columns(self, ends: xr.Dataset) -> list[list[str]]:
        """Columns of the summary: a title, then a cell per branch."""
        hertz = "a_H" in self.dataset.attrs
        radius = ("a/a_H", 1 / self.a_H) if hertz else ("a [um]", 1e6)
        grid = self.scene.grid
        if grid.plane_strain:
            # Half the width of the strips that touch.
            ends["contact_radius"] = ends.contact_area / (2 * grid.dy)
        pressure = ("p_max/p_H", 1 / self.p_H) if hertz else ("p_max [MPa]", 1e-6)
        numbers = [
            ("t", "t", 1.0),
            ("W [N]", "W", 1.0),
            ("T_x [N]", "T_x", 1.0),
            (radius[0], "contact_radius", radius[1]),
            ("stick ratio", "stick_ratio", 1.0),
            (pressure[0], "p_max", pressure[1]),
            ("delta_z [um]", "delta_z", 1e6),
            ("delta_x [um]", "delta_x", 1e6),
            ("dissipated [uJ]", "dissipated", 1e6),
        ]
        others = [("T_y [N]", "T_y", 1.0), ("delta_y [um]", "delta_y", 1e6)]
        torsion = [("M_z [N m]", "M_z", 1.0), ("phi_z [urad]", "phi_z", 1e6)]
        for pair in (others, torsion):
            if any(self._drives(name) for _, name, _ in pair):
                numbers[3:3] = pair
        columns = [
            [title, *(f"{value:.5g}" for value in scale * ends[name].values)]
            for title, name, scale in numbers
        ]
        return [*columns, ["state", *(STATUS[int(code)] for code in ends.status)]]

    def _drives(self, name: str) -> bool:
        """Whether the path gives that load or motion a value other than zero."""
        return any(getattr(branch, name) for branch in self.scene.path.branches)

    def summary(self) -> str:
        """Tabulate what the run ended with: a line per branch, then one per cycle.

        Lengths are over a_H and pressures over p_H where there is a Hertz contact, else in um and
        MPa; in plane strain a is half the width of the contact.
        """
        columns = self._columns(self.branches())
        widths = [max(len(cell) for cell in column) for column in columns]
        rows = [
            "  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True))
            for row in zip(*columns, strict=True)
        ]
        return "\n".join(
            [f"{self.dataset.attrs['title']}: {self.status}", *rows, *self._cycle_lines()]
        )

    def _cycle_lines(self) -> list[str]:
        """A line for every cycle along every direction that is driven."""
        lines = []
        for direction in self._directions():
            loops = self.loops(direction=direction)
            for n in range(loops.sizes["cycle"]):
                of = loops.isel(cycle=n)
                lines.append(
                    f"cycle {n + 1} ({direction}): {STATUS[int(of.status)]}, "
                    f"{1e6 * float(of.dissipated):.4g} uJ dissipated, "
                    f"energy ratio {float(of.energy_ratio):.3g}, "
                    f"stiffness {float(of.stiffness):.4g} {of.stiffness.attrs['units']}"
                )
        return lines

    def _directions(self) -> list[Literal["x", "y", "torsion"]]:
        """The fretting motions that the path drives."""
        motions: list[tuple[Literal["x", "y", "torsion"], tuple[str, str]]] = [
            ("x", ("T_x", "delta_x")),
            ("y", ("T_y", "delta_y")),
            ("torsion", ("M_z", "phi_z")),
        ]
        return [of for of, names in motions if any(self._drives(name) for name in names)]

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the result to a Zarr folder (``.zarr``) or a NetCDF file (``.nc``).

        :func:`pyfret.open` opens both. The place must be free. NetCDF needs the package h5netcdf or
        netCDF4: ``pip install "pyfret[netcdf]"``.

        Parameters
        ----------
        path : path
            Where to write; its ending says in which format.

        Raises
        ------
        FileExistsError
            There is something at the place.
        ValueError
            The ending is another.
        """
        place = Path(path)
        if place.exists():
            raise FileExistsError(f"{place}: is there already")
        if place.suffix == ".zarr":
            self.dataset.to_zarr(place, zarr_format=2, consolidated=True)
        elif place.suffix == ".nc":
            attrs = {k: flat(v) for k, v in self.dataset.attrs.items()}
            self.dataset.assign_attrs(attrs).to_netcdf(place)
        else:
            raise ValueError(f"{place}: must end in .zarr or .nc")

    def __repr__(self) -> str:
        """Give the title and the size of the result."""
        d = self.dataset
        return (
            f"Result({d.attrs['title']!r}, {d.sizes['increment']} increments, "
            f"{d.sizes['saved']} with fields of {d.sizes['x']} x {d.sizes['y']}, {self.status})"
        )


#: What marks an attribute as JSON, where a file has no room for what it is.
JSON = "json:"


def flat(value: object) -> object:
    """An attribute that NetCDF has room for: numbers and text as they are, the rest as JSON."""
    return value if isinstance(value, (str, int, float)) else JSON + json.dumps(value)


def unfolded(value: Any) -> Any:
    """The attribute that :func:`flat` was given."""
    text = isinstance(value, str) and value.startswith(JSON)
    return json.loads(value[len(JSON) :]) if text else value


def open(path: str | os.PathLike[str]) -> Result:
    """Open a result: a Zarr store, or a NetCDF file (``.nc``) that :meth:`Result.save` wrote.

    Fields are read when they are asked for.
    """
    if Path(path).suffix == ".nc":
        dataset = xr.open_dataset(path)
        dataset = dataset.assign_attrs({k: unfolded(v) for k, v in dataset.attrs.items()})
    else:
        dataset = xr.open_zarr(path, chunks=None)
    for variable in dataset.variables.values():
        # How it lies in this file is of no use to the next one, and its codecs would not do there.
        variable.encoding.clear()
    return Result(dataset)
