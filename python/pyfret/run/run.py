"""A run: scalars of every increment, fields of some, the scene inside."""

from __future__ import annotations

import numbers
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from pyfret import _core
from pyfret._util.attributes import attribute_error
from pyfret._util.lazy import xr
from pyfret._util.names import meant
from pyfret._util.tables import as_table
from pyfret._util.text import shown
from pyfret.quantities import quantities
from pyfret.run.attributes import OfRun
from pyfret.run.loops import loops_of_cycles, state_in_words
from pyfret.run.state import State

if TYPE_CHECKING:
    from collections.abc import Iterator

    from pyfret._core import LoadPath, Scene
    from pyfret._util.csv_table import Tables
    from pyfret._util.labelled_table import Table

__all__ = ["Run", "one_of"]

#: Measures of stress, and words for the largest one: they belong to an increment.
LABELS = frozenset(name for name, label in _core.probe_labels().items() if label[0] == "Pa")
STRESS_WORDS = frozenset(("stress", "stresses", "max_stress", "peak_stress", "mises"))
#: Where the energies of a run are.
ENERGIES = (
    "the energy of each cycle is result.loops().dissipated, the sum since the start "
    "result.dissipated_energy, the energy of each branch result.branches().dissipated, "
    "the energy of each increment result.dissipated"
)
#: Calls that answer a question about a run, by the words that others have for them.
CALLS = {
    **dict.fromkeys(
        ("energy", "loop_energy", "energy_per_cycle", "cycle_energy", "dissipation"), ENERGIES
    ),
    **dict.fromkeys(
        ("first_yield", "yielding", "yields", "shakedown", "yield_factor", "load_factor"),
        'result.load_factors("Ti-6Al-4V") has the factors of first yield and of shakedown',
    ),
    **dict.fromkeys(
        ("profile", "profiles", "section", "slice", "line"),
        "result.at(-1).along(y=0.0) has the fields of an increment on a line, "
        'result.at(-1).to_csv(path, of="profile") writes those through the middle',
    ),
    "wear": "fret.wear.solve(scene, body2=fret.wear.Archard(k=...), cycles=...) wears the bodies",
    "fatigue": 'it is called life, result.life("Ti-6Al-4V")',
    **dict.fromkeys(
        ("last", "final", "end", "snapshot", "snapshots", "increments", "steps", "frames"),
        "result.at(-1) is the last increment that kept its fields, list(result) has all of them",
    ),
    **dict.fromkeys(
        ("columns", "variables", "units", "to_numpy", "to_dict", "keys", "items", "values"),
        "result.dataset has all numbers with their units, result.to_dataframe() is their table",
    ),
}
#: Scalars of an increment that add up over a branch.
SUMMED = frozenset(
    (
        "work",
        "elastic",
        "dissipated",
        "opening",
        "quadrature",
        "plastic_work",
        "convolutions",
        "alternations",
        "normal_iterations",
        "tangential_iterations",
        "parts",
    )
)


def one_of(which: float | None, t: float | None) -> float:
    """Return an increment, or the path time of one as a float.

    Raises
    ------
    TypeError
        Both are given, or neither.
    """
    if (which is None) == (t is None):
        raise TypeError(
            "at() takes an increment, as at(-1), or a path time, as at(t=2.0): give one of them"
        )
    if t is None:
        assert which is not None
        return which
    if isinstance(t, bool) or not isinstance(t, numbers.Real):
        raise TypeError(f"t = {t!r:.60}: must be a path time, such as 2.0")
    return float(t)


class Run(OfRun):
    """The result of a run.

    Its ``dataset`` has scalars over ``increment`` and fields over (``saved``, ``x``, ``y``) for the
    increments whose fields were kept. Its ``attrs`` hold the scene, the version, ``a_H``, ``p_H``
    and ``mu``. Every variable carries ``units`` and ``long_name``. Its scalars are attributes as
    well, e.g. ``result.T_x``; fields belong to an increment, e.g. ``result.at(-1).p``.
    """

    def __getattr__(self, name: str) -> xr.DataArray:
        """Give the scalar `name` of every increment, or an attribute of the dataset."""
        if name.startswith("_"):
            raise AttributeError(name)
        scalars = [str(k) for k, v in self.dataset.variables.items() if v.dims == ("increment",)]
        if name in scalars:
            return self.dataset[name]
        if name in self.dataset.attrs:
            return self.dataset.attrs[name]  # type: ignore[no-any-return]
        fields = {
            str(k): f"it is a field of every increment that kept it, result.at(-1).{k}"
            for k, v in self.dataset.variables.items()
            if "x" in v.dims
        }
        if name in LABELS or name in STRESS_WORDS:
            measure = name if name in LABELS else "maximum()"
            fields[name] = f"it is a stress below an increment, result.at(-1).stress().{measure}"
        if name in ("loop", "fretting_loop", "hysteresis"):
            fields[name] = (
                'its points are result.to_csv("loop.csv", columns=["delta_x", "T_x"]), its picture '
                "fret.plot.fretting_loop(result), the energies of all cycles result.loops()"
            )
        if name == "contact_radius":
            fields[name] = "of a line contact it is half_width"
        if (measured := name.removesuffix("_error")) != name and measured in scalars:
            fields[name] = (
                f"result = fret.solve(scene, error=True) has the errors at the end of each branch, "
                f"result.error_bars().{measured}.sel(part='total')"
            )
        public = (member for member in dir(type(self)) if not member.startswith("_"))
        names = [*scalars, *map(str, self.dataset.attrs), *public]
        for field in meant(name, [*fields]) if not meant(name, names) else ():
            fields.setdefault(name, fields[field])
        raise attribute_error("result", name, names, {**CALLS, **fields})

    def __iter__(self) -> Iterator[State]:  # type: ignore[override]
        """Go through the increments whose fields were kept, the first one first."""
        return (self.at(int(number)) for number in self.dataset.saved_increment.values)

    def __len__(self) -> int:
        """Count the increments whose fields were kept; ``len(result.path)`` counts all."""
        return int(self.dataset.saved_increment.size)

    def __bool__(self) -> bool:
        """Whether there is a result: always, whatever was kept."""
        return True

    def __dir__(self) -> list[str]:
        """The names of the class, and the scalars of every increment."""
        scalars = [str(k) for k, v in self.dataset.variables.items() if v.dims == ("increment",)]
        return sorted({*object.__dir__(self), *scalars, *map(str, self.dataset.attrs)})

    @property
    def status(self) -> str:
        """``"done"``, ``"running"``, or the reason why the run stopped."""
        return str(self.dataset.attrs["status"])

    @property
    def path(self) -> LoadPath:
        """The load path, as it was solved."""
        return self.scene.path

    @property
    def direction(self) -> Literal["x", "y", "torsion"]:
        """Return the fretting motion: the axis with more shear, torsion without shear."""
        d = self.dataset
        ranges = {axis: float(np.ptp(d[f"T_{axis}"].values)) for axis in ("x", "y")}
        if not any(ranges.values()) and np.ptp(d.M_z.values) > 0.0:
            return "torsion"
        return "y" if ranges["y"] > ranges["x"] else "x"

    @property
    def length(self) -> float:
        """The length that results are measured in [m].

        It is a_H. Where there is no Hertz contact, it is half the longer side of the box around the
        contact of the last increment with fields.
        """
        return self.at(-1).length

    @property
    def delta_H(self) -> float:
        """Hertz approach of the uncoated pair at the largest load [m], a_H^2/R.

        Line contacts have none: it depends on how far away it is read.
        """
        if self.scene.grid.plane_strain:
            raise ValueError("delta_H: a line contact has none, it depends on where it is read")
        return self.a_H**2 / self._yardstick("R")

    @property
    def W_max(self) -> float:
        """Largest normal force of the path [N]; of a line contact per metre [N/m]."""
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
        """Return the energy dissipated by friction since the start, for every increment.

        In J, of a line contact in J/m.
        """
        dissipated = self.dataset["dissipated"]
        total = dissipated.cumsum("increment").rename("dissipated_energy")
        return total.assign_attrs(
            units=dissipated.attrs["units"], long_name="energy dissipated since the start"
        )

    def at(self, which: float | None = None, *, t: float | None = None) -> State:
        """Give the contact at the end of one increment whose fields were kept.

        Parameters
        ----------
        which : int or float
            An integer counts increments from 1; negative ones count the kept increments from the
            last. A float is a path time t.
        t : float, optional
            The path time instead: ``at(t=2)`` is ``at(2.0)``.

        Raises
        ------
        KeyError
            The fields of that increment were not kept; the message lists those that were.
        """
        return State(*self._kept(one_of(which, t)))

    def _kept(self, which: float) -> tuple[xr.Dataset, Scene, dict[str, Any]]:
        """Return fields and scalars of an increment of :meth:`at`, the scene, shared numbers."""
        if isinstance(which, bool) or not isinstance(which, numbers.Real):
            raise TypeError(
                f"which = {which!r:.60}: must be an increment, such as 5, or -1 for the last that "
                "kept its fields, or a path time, such as 1.0"
            )
        saved = self.dataset.saved_increment.values
        times = self.dataset.saved_t.values
        if not isinstance(which, numbers.Integral):
            places = np.flatnonzero(np.isclose(times, which, rtol=1e-9, atol=1e-12))
        elif which > 0:
            places = np.flatnonzero(saved == which)
        else:
            places = np.flatnonzero(np.arange(saved.size) == saved.size + which)
        if places.size == 0 or which == 0:
            start = "increments count from 1, and " if which == 0 else ""
            ends = f": result.at({saved[0]}) is the first, result.at(-1) the last"
            raise KeyError(
                f"{start}no fields were kept at {which!r:.60}; kept are the increments "
                f"{saved.tolist()} at t = {times.tolist()}{ends if saved.size else ''}"
            )
        last_place = int(places[-1])
        increment = int(saved[last_place])
        n = int(np.flatnonzero(self.dataset.increment.values == increment)[0])
        row = self.dataset.drop_vars(("saved_increment", "saved_t")).isel(
            saved=last_place, increment=n
        )
        if "yielded_increment" in row:
            yielded_rows = np.flatnonzero(row.yielded_increment.values == increment)
            row = row.isel(
                yielded=slice(yielded_rows[0], yielded_rows[-1] + 1)
                if yielded_rows.size
                else slice(0)
            )
        return row, self.scene, self.shared

    def error_bars(self) -> xr.Dataset:
        """Estimated errors of the numbers at the end of every branch: dims (branch, part).

        Parts are ``total`` and its contributions. ``cells`` comes from runs on two coarser grids
        and, up to 256 x 256 cells, on a finer one. ``path`` comes from a run with fewer increments,
        ``solver`` from the tolerance. ``p`` and ``q`` are the tractions as fields: L2 norms over
        the largest of the path. ``stress`` is the error of the stress in the bodies, over the
        stress. ``residual_stress`` belongs to bodies that yield, at a point, over its largest below
        the middle of the grid. A largest strain at the border of slip or at the rim of a coating
        does not converge. The runs come from ``solve(..., error=True)`` and ``fret run --error``.
        """
        bars = self.dataset.attrs.get("error_bars")
        if not bars:
            raise ValueError(
                "the run has no error bars: solve(..., error=True) or fret run --error"
            )
        parts = list(bars[0]["q"])
        table = xr.Dataset(coords={"branch": [bar["branch"] for bar in bars], "part": parts})
        for name in (name for name in bars[0] if name != "branch"):
            of_field = name in ("p", "q", "stress", "residual_stress")
            values = np.array([[bar[name][part] for part in parts] for bar in bars], dtype=float)
            attrs = {"units": "1"} if of_field else self.dataset[name].attrs
            table[name] = (("branch", "part"), values, attrs)
        return table

    def branches(self) -> Table:
        """Scalars at the end of every branch; energies and work are sums over the branch.

        Where the increments were chosen, ``path_error`` is the estimated error that they leave in
        the shear there: L2 norm, over the largest of the path. On fine grids it holds what the run
        adds to the estimate. So it may be larger than the ``path_error`` of the branch of the
        scene.
        """
        branch = self.dataset.branch_of_increment.values
        starts = np.flatnonzero(np.diff(branch, prepend=branch[0] - 1))
        ends = np.append(starts[1:], branch.size) - 1
        columns: dict[Any, Any] = {}
        for name, variable in self.dataset.variables.items():
            if variable.dims == ("increment",) and name not in self.dataset.indexes:
                values = variable.values
                kept = np.add.reduceat(values, starts) if name in SUMMED else values[ends]
                attrs = dict(variable.attrs)
                if name in SUMMED:
                    meaning = str(attrs.get("long_name", ""))
                    attrs["long_name"] = meaning.replace("in the increment", "in the branch")
                columns[name] = ("branch", kept, attrs)
        if errors := self.dataset.attrs.get("path_error"):
            about = {"units": "1", "long_name": "estimated error of the shear from the increments"}
            columns["path_error"] = ("branch", np.asarray(errors, float)[branch[ends]], about)
        # All columns at once: a dataset to which they are added one by one is copied each time.
        coords = {"branch": branch[ends]}
        return as_table(xr.Dataset(columns, coords=coords, attrs=self.dataset.attrs))

    @quantities
    def loops(self, *, direction: Literal["x", "y", "torsion"] = "x") -> Table:
        """Energy and stiffness of every closed cycle of the load path.

        Parameters
        ----------
        direction : "x", "y" or "torsion"
            The fretting motion. In torsion ``T`` is the moment M_z [N m], ``delta`` the rotation
            phi_z [rad], and the units of stiffness and opening are theirs.

        Returns
        -------
        xarray.Dataset
            Over ``cycle``: ``dissipated`` [J], ``dissipated_sum`` of the cycles so far, half
            ranges ``T`` [N] and ``delta`` [m], ``energy_ratio``, ``sliding_ratio`` and ``status``.
            ``stiffness`` right after the
            reversals, ``secant_stiffness`` [N/m] and half the ``opening`` of the loop [m]. The
            branches that it spans. Of a line contact energies, forces and stiffness are per metre.
            ``dissipated_error`` and ``energy_ratio_error`` where the run has error bars. Its
            ``to_csv`` and ``to_excel`` write it as a table.
        """
        loops = loops_of_cycles(self.dataset, self.scene, direction)
        total = loops.dissipated.cumsum("cycle")
        about = {**loops.dissipated.attrs, "long_name": "energy dissipated in the cycles so far"}
        return as_table(loops.assign(dissipated_sum=total.assign_attrs(about)))

    @quantities
    def regimes(self, *, direction: Literal["x", "y", "torsion"] = "x") -> list[str]:
        """Return the regime of each closed cycle, from "no contact" to "gross slip".

        With mu = 0 a cycle is "no friction".

        Gross slip where all of the contact slipped at some time of the cycle. Cycles of different
        regimes are what is called the mixed regime.
        """
        codes = self.loops(direction=direction).status.values
        return [state_in_words(code, self.scene) for code in codes]

    def _tables(self) -> Tables:
        """Return what makes the tables; of error bars only where the run has them."""
        tables: Tables = {
            "increments": lambda: (
                self.dataset.assign(dissipated_energy=self.dissipated_energy),
                ("increment",),
            ),
            "branches": lambda: (self.branches(), ("branch",)),
            "loops": lambda: (self._counted_loops(), ("cycle",)),
        }
        if self.dataset.attrs.get("error_bars"):
            tables["error_bars"] = lambda: (self.error_bars(), ("branch", "part"))
        return tables

    def _counted_loops(self) -> xr.Dataset:
        """Return the loops along the motion, counted from 1."""
        loops = self.loops(direction=self.direction)
        return loops.assign_coords(cycle=np.arange(1, loops.sizes["cycle"] + 1))

    def __repr__(self) -> str:
        """Give the title and the size of the result."""
        d = self.dataset
        return shown(
            f"{type(self).__name__}({d.attrs['title']!r}, {d.sizes['increment']} increments, "
            f"{d.sizes['saved']} with fields of {d.sizes['x']} x {d.sizes['y']}, {self.status})"
        )
