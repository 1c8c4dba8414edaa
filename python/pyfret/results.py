"""The result of a run: scalars of every increment, fields of some, the scene inside."""

from __future__ import annotations

import json
import numbers
from os import fspath
from typing import TYPE_CHECKING, Literal

import numpy as np
import xarray as xr

from pyfret import _core, subsurface
from pyfret._core import Scene, StoreError
from pyfret.snapshot import Snapshot

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Sequence

    from numpy.typing import ArrayLike

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

#: Columns of the summary: title, variable, decimals, measure.
COLUMNS: list[tuple[str, str, int, Callable[[Result], float]]] = [
    ("t", "t", 3, lambda _: 1.0),
    ("W [N]", "W", 1, lambda _: 1.0),
    ("T_x [N]", "T_x", 1, lambda _: 1.0),
    ("a/a_H", "contact_radius", 4, lambda r: 1.0 / r.a_H),
    ("stick ratio", "stick_ratio", 4, lambda _: 1.0),
    ("p_max/p_H", "p_max", 4, lambda r: 1.0 / r.p_H),
    ("delta_z [um]", "delta_z", 4, lambda _: 1e6),
    ("delta_x [um]", "delta_x", 4, lambda _: 1e6),
    ("dissipated [uJ]", "dissipated", 3, lambda _: 1e6),
    ("convolutions", "convolutions", 0, lambda _: 1.0),
]


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
        return float(self.dataset.attrs["a_H"])

    @property
    def p_H(self) -> float:
        """Hertz peak pressure of the uncoated pair at the largest load [Pa]."""
        return float(self.dataset.attrs["p_H"])

    @property
    def mu(self) -> float:
        """Friction coefficient."""
        return float(self.dataset.attrs["mu"])

    @property
    def delta_H(self) -> float:
        """Hertz approach of the uncoated pair at the largest load [m], a_H^2/R."""
        return self.a_H**2 / float(self.dataset.attrs["R"])

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
        z: ArrayLike,
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

    def summary(self) -> str:
        """Tabulate what the run ended with, one line per branch."""
        ends = self.branches()
        columns = [
            [title, *(f"{value:.{digits}f}" for value in np.asarray(scale(self) * ends[name]))]
            for title, name, digits, scale in COLUMNS
            if name in ends
        ]
        widths = [max(len(cell) for cell in column) for column in columns]
        rows = [
            "  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True))
            for row in zip(*columns, strict=True)
        ]
        return "\n".join([f"{self.dataset.attrs['title']}: {self.status}", *rows])

    def __repr__(self) -> str:
        """Give the title and the size of the result."""
        d = self.dataset
        return (
            f"Result({d.attrs['title']!r}, {d.sizes['increment']} increments, "
            f"{d.sizes['saved']} with fields of {d.sizes['x']} x {d.sizes['y']}, {self.status})"
        )


def open(path: str | os.PathLike[str]) -> Result:
    """Open a result store; its fields are read when they are asked for.

    Every file of it is checked before: what is read is what was written.

    Raises
    ------
    StoreError
        There is no store, or a file of it is missing or damaged; the message names both.
    """
    # Zarr reads the attributes of the group from a file that no checksum covers.
    attributes = json.loads(_core.verify(path))
    try:
        dataset = xr.open_zarr(path, chunks=None)
    except Exception as error:
        message = " ".join(str(error).split())
        raise StoreError(f"{fspath(path)}: {type(error).__name__}: {message}") from error
    kept = {name: value for name, value in attributes.items() if name in dataset.attrs}
    return Result(dataset.assign_attrs(kept))
