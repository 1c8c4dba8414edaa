"""Measured data: friction loops, indentation curves, scars, lives."""

from __future__ import annotations

import sys
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar, TypeAlias

import numpy as np

from pyfret import _core
from pyfret._util.arrays import together
from pyfret._util.csv_table import Tabular
from pyfret._util.holds_arrays import HoldsArrays
from pyfret._util.lazy import xr
from pyfret._util.numbers import length
from pyfret._util.window import wrap
from pyfret.fit.recorders import read_columns
from pyfret.fit.turns import find_turns, remove_drift, turns_between
from pyfret.quantities import (
    Force,
    Forces,
    InSI,
    Length,
    Lengths,
    MeasuredForces,
    MeasuredShifts,
    ScarPositions,
    as_number,
    by_default,
    part,
    quantities,
)

if TYPE_CHECKING:
    import os
    from collections.abc import Mapping, Sequence

    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from pyfret._util.csv_table import Tables
    from pyfret.fit.columns import RecordColumns

__all__ = [
    "Data",
    "Indentation",
    "Lives",
    "Loops",
    "Measured",
    "Scar",
    "read_indentation",
    "read_lives",
    "read_loops",
    "read_scar",
]

Data: TypeAlias = "Loops | Indentation | Scar | Lives"

#: Part of a branch at its end with the slope of sliding, and the largest slope there, over
#: the slope of the flank, for a loop that slides: at 0.9 mu W a ball in partial slip has 0.46.
END, SLIDING = 0.25, 0.3
#: Slope of a flank of a single point [N/m], and more.
STEEPEST = 1e100
#: Part of the shift of a cycle that both of its branches have, if it is a whole one.
WHOLE = 0.9


class Measurement(HoldsArrays, Tabular):
    """Measured points: a table of columns, and a picture of the last one over the first."""

    #: Unit and meaning of each column, by the name of its field.
    columns: ClassVar[Mapping[str, tuple[str, str]]]

    def _tables(self) -> Tables:
        """Return what makes the table: a row for every point."""
        variables = {
            name: ("point", np.asarray(getattr(self, name)), {"units": unit, "long_name": meaning})
            for name, (unit, meaning) in self.columns.items()
        }
        return {"points": lambda: (xr.Dataset(variables), ("point",))}

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the measured points."""
        from pyfret.fit.measured_figure import measured_points

        return measured_points(self.to_dataframe(), self.columns, ax)


@part(eq=False, repr=False)
class Loops(Measurement):
    """Friction loops: force over shift, branch by branch.

    Attributes
    ----------
    delta, T : array
        Shift [m] and force [N] (in a line contact N/m) of all points, in the order of time.
    down : array of bool
        Whether the shift falls there.
    cycle : array of int
        Number of the cycle of a point, from 0.
    W : float, optional
        Normal force [N]; None: from the scene.
    noise : float, optional
        Standard deviation of the force [N]; None: from the residuals of the fit.
    drift : (float, float)
        How much shift [m] and force [N] of the middle of a cycle move from the first to the last.
    tilt : bool, optional
        Whether a spring parallel to the contact is fitted; None: if the loops slide.
    drifts : bool, optional
        Whether drifts of both gauges, linear in the number of the point, are fitted. None: if the
        record has several cycles or two turns.
    """

    columns: ClassVar = {
        "delta": ("m", "shift"),
        "cycle": ("1", "cycle, from 0"),
        "T": ("N", "force"),
    }

    delta: MeasuredShifts
    T: MeasuredForces
    down: NDArray[np.bool_]
    cycle: NDArray[np.int64]
    W: InSI[Force | None] = by_default(None)
    noise: InSI[Force | None] = by_default(None)
    drift: tuple[float, float] = (0.0, 0.0)
    tilt: bool | None = None
    drifts: bool | None = None
    #: Turns within the record, (n, 3): number of the point, between two points as a rule, shift
    #: there and its error [m]; :func:`turns_between`.
    turns: NDArray[np.float64] | None = None

    @property
    def energies(self) -> NDArray[np.float64]:
        """Return the energy of every whole cycle [J]: the area of its loop, closed by a line."""
        areas = []
        for n in range(int(self.cycle.max()) + 1):
            inside = self.cycle == n
            sides = [self.delta[inside & (self.down == down)] for down in (False, True)]
            reach = WHOLE * float(np.ptp(self.delta[inside]))
            if any(side.size == 0 or float(np.ptp(side)) < reach for side in sides):
                continue
            shift, force = self.delta[inside], self.T[inside]
            areas.append(
                0.5 * abs(float(np.sum(shift * np.roll(force, -1) - np.roll(shift, -1) * force)))
            )
        return np.array(areas)

    def summary(self) -> str:
        """Describe the loops: cycles, points, ranges, energy per cycle."""
        energies = self.energies
        lines = [
            f"{energies.size} whole cycle{'s' * (energies.size != 1)}, {self.delta.size} points",
            f"shift {length(float(self.delta.min()))} to {length(float(self.delta.max()))}, force "
            f"{self.T.min():.4g} to {self.T.max():.4g} N",
            "the loops slide" if self.sliding_slope is not None else "the loops do not slide",
        ]
        if energies.size:
            spread = (
                f", {energies.min():.4g} to {energies.max():.4g} J" if energies.size > 1 else ""
            )
            lines.insert(2, f"energy per cycle {energies.mean():.4g} J{spread}")
        return wrap("\n".join(lines).replace("µ", "u"))

    @property
    def sliding_slope(self) -> float | None:
        """Return the mean slope of the ends of branches [N/m]; None if the loops do not slide."""
        ends, flanks = self._slopes()
        if not ends or abs(np.mean(ends)) > SLIDING * float(np.mean(flanks)):
            return None
        return float(np.mean(ends))

    @property
    def flank_slope(self) -> float | None:
        """Return the mean slope of the branches after their turns [N/m].

        None where no branch has two points there.
        """
        flanks = [slope for slope in self._slopes()[1] if slope < STEEPEST]
        return float(np.mean(flanks)) if flanks else None

    def _slopes(self) -> tuple[list[float], list[float]]:
        """Return the slopes of the ends and of the flanks of branches with enough points [N/m]."""
        ends, flanks = [], []
        for n in range(int(self.cycle.max()) + 1):
            for down in (False, True):
                in_branch = (self.cycle == n) & (self.down == down)
                shift, force = self.delta[in_branch], self.T[in_branch]
                length = float(np.ptp(shift)) if shift.size else 0.0
                if length == 0.0:
                    continue
                to_end = shift - shift.min() if down else shift.max() - shift
                end = to_end < END * length
                if end.sum() < 3:
                    continue
                ends.append(float(np.polyfit(shift[end], force[end], 1)[0]))
                # The flank rises by half of the force in the part of the shift that it takes.
                rise = np.abs(force - (force.max() if down else force.min()))
                flank = shift[rise <= 0.5 * np.ptp(force)]
                flanks.append(0.5 * float(np.ptp(force)) / max(float(np.ptp(flank)), 1e-300))
        return ends, flanks

    @staticmethod
    @quantities
    def from_arrays(
        delta: Lengths,
        T: Forces,
        *,
        W: Force | None = None,
        noise: Force | None = None,
        tilt: bool | None = None,
        drift: bool | None = None,
        detrend: bool = False,
    ) -> Loops:
        """Loops of points in the order of time; what is before the first turn is left out.

        Points with a missing value, masked or NaN, are left out. ``tilt``, ``drift`` and
        ``detrend`` as in :func:`read_loops`.

        Raises
        ------
        ValueError
            There is no closed loop.
        """
        shift, force = together(delta=delta, T=T, holes=True)
        return _separate_loops(
            shift, force, detrend=detrend, drifts=drift, W=W, noise=noise, tilt=tilt
        )


def _separate_loops(
    shift: NDArray[np.float64],
    force: NDArray[np.float64],
    *,
    detrend: bool,
    drifts: bool | None,
    **options: Any,
) -> Loops:
    """Return the loops of points without holes, which are kept as they are."""
    turns = find_turns(shift)
    if detrend:
        shift, force, turns = _without_drift(shift, force, turns)
        drifts = False if drifts is None else drifts
    if len(turns) < 2:
        raise ValueError("the shift must turn twice at least: a loop is a way there and a way back")
    # One cycle may end where it began without a turn of its own.
    closed = len(turns) == 2
    order = slice(0, shift.size) if closed else slice(turns[0], turns[-1] + 1)
    # Branches fall and rise in turn; the point of a turn belongs to the branch after it.
    falls = bool(shift[turns[1]] < shift[turns[0]])
    branches = np.arange(len(turns) - 1)
    lengths = np.diff(turns)
    lengths[-1] += 1
    cycle = np.repeat(branches >> 1, lengths)
    down = np.repeat((branches & 1 == 1) != falls, lengths)
    if closed:
        before, after = turns[0], shift.size - turns[1] - 1
        down = np.pad(down, (before, after), constant_values=not falls)
        cycle = np.pad(cycle, (before, after))
    # The first and the last whole cycle: half of one has another middle.
    begin = order.start
    ends = [slice(0, None)] * 2
    if len(turns) > 3:
        ends = [slice(0, turns[2] - begin + 1), slice(turns[-3] - begin, None)]
    middles = [
        [0.5 * (v[order][part].max() + v[order][part].min()) for part in ends]
        for v in (shift, force)
    ]
    moved = (middles[0][1] - middles[0][0], middles[1][1] - middles[1][0])
    points = (shift[order], force[order], down, cycle)
    between = turns_between(shift, turns) - [order.start, 0.0, 0.0]
    return Loops(*points, drift=moved, drifts=drifts, turns=between, **options)


def _without_drift(
    shift: NDArray[np.float64], force: NDArray[np.float64], turns: list[int]
) -> tuple[NDArray[np.float64], NDArray[np.float64], list[int]]:
    """Return shift, force and turns without the drift of both gauges, and print the drift."""
    shift, moved = remove_drift(shift, turns)
    force, changed = remove_drift(force, turns)
    print(
        f"drift removed, a straight line through the middles of the cycles: shift {length(moved)}, "
        f"force {changed:.4g} N from the first to the last cycle",
        file=sys.stderr,
    )
    return shift, force, find_turns(shift)


@part(eq=False, repr=False)
class Indentation(Measurement):
    """An indentation curve: approach [m] over normal force [N].

    With ``frame`` the compliance of the frame is fitted, too.
    """

    columns: ClassVar = {"delta_z": ("m", "approach"), "W": ("N", "normal force")}

    W: MeasuredForces
    delta_z: MeasuredShifts
    noise: InSI[Length | None] = by_default(None)
    frame: bool = False

    @staticmethod
    @quantities
    def from_arrays(
        W: Forces, delta_z: Lengths, *, noise: Length | None = None, frame: bool = False
    ) -> Indentation:
        """A curve of points in any order; those without load or with a hole are left out.

        ``frame`` as of :func:`read_indentation`.
        """
        force, approach = together(W=W, delta_z=delta_z, holes=True)
        loaded = force > 0
        return Indentation(force[loaded], approach[loaded], as_number(noise), frame)

    def summary(self) -> str:
        """Describe the curve: points, largest force and approach."""
        return wrap(
            f"{self.W.size} points, up to {float(self.W.max()):.4g} N and an approach of "
            f"{length(float(np.max(self.delta_z)))}"
        )


@part(eq=False, repr=False)
class Scar(Measurement):
    """A worn profile along x at y = 0: depth [m] of a body, or of both with ``body_number=0``.

    ``wear`` holds the arguments of the run that made it, such as ``cycles`` and ``body2``.
    """

    columns: ClassVar = {"x": ("m", "place"), "depth": ("m", "worn depth, downwards")}

    x: ScarPositions
    depth: MeasuredShifts
    wear: Mapping[str, Any]
    body_number: int = 2
    noise: InSI[Length | None] = by_default(None)

    @staticmethod
    @quantities
    def from_arrays(
        x: Lengths,
        depth: Lengths,
        *,
        wear: Mapping[str, Any],
        body_number: int = 2,
        noise: Length | None = None,
    ) -> Scar:
        """Make a profile of points; points with a missing value are left out."""
        positions, worn = together(x=x, depth=depth, holes=True)
        low, high = float(worn.min()), float(worn.max())
        if -low > 2.0 * max(high, 0.0):
            raise ValueError(
                f"depth: reaches from {length(low)} to {length(high)}, and is positive into the "
                "body: give heights with the other sign"
            )
        return Scar(positions, worn, wear, body_number, noise)

    def summary(self) -> str:
        """Describe the profile: points, width, depth, and the run that made it."""
        x, depth = np.asarray(self.x), np.asarray(self.depth)
        wear = ", ".join(f"{key} = {value!r}" for key, value in self.wear.items())
        area = 0.5 * float(np.sum((depth[1:] + depth[:-1]) * np.diff(x)))
        return wrap(
            f"{depth.size} points over {length(float(np.ptp(x)))}, depth up to "
            f"{length(float(depth.max()))}, worn area {area:.4g} m^2\n"
            f"body {self.body_number or '1 and 2 together'}; {wear}"
        )


@part(eq=False, repr=False)
class Lives(Measurement):
    """Cycles to the end of a coating in several tests.

    Attributes
    ----------
    cycles : array
        Cycles of each test.
    settings : list of dict
        What was set in each, by the keys of a scene file.
    wear : mapping
        The arguments of the runs.
    part : float
        Part of the outermost coating's thickness at which a test has ended.
    noise : float, optional
        Standard deviation of ln(cycles).
    """

    columns: ClassVar = {"cycles": ("1", "cycles to the end of the coating")}

    cycles: NDArray[np.float64]
    settings: Sequence[Mapping[str, Any]]
    wear: Mapping[str, Any]
    part: float = 1.0
    body_number: int = 2
    noise: float | None = field(default=None)

    def summary(self) -> str:
        """Describe the tests: their number and the range of their lives."""
        lives = np.asarray(self.cycles, dtype=float)
        return wrap(f"{lives.size} tests, {lives.min():.4g} to {lives.max():.4g} cycles")


@dataclass(frozen=True, eq=False, repr=False)
class Measured(HoldsArrays):
    """The numbers of a set of data in a row, and how they are drawn."""

    data: Data
    measured: NDArray[np.float64]
    #: Coordinate that the numbers are drawn over, what it is, and what they are.
    along: NDArray[np.float64]
    labels: tuple[str, str]


def read_pair(
    columns: RecordColumns, first: int, second: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Read two columns [SI], and print how they were aligned."""
    x, y = columns.numbers(first, second)
    for note in columns.notes:
        print(f"{columns.place}: {note}", file=sys.stderr)
    return x, y


@quantities
def read_loops(
    path: str | os.PathLike[str],
    *,
    delta: str | None = None,
    T: str | None = None,
    units: dict[str, str] | None = None,
    skip: int = 0,
    group: str | None = None,
    W: Force | None = None,
    noise: Force | None = None,
    tilt: bool | None = None,
    drift: bool | None = None,
    detrend: bool = False,
) -> Loops:
    """Read friction loops of a file, one after the other, also parted by empty lines.

    Several cycles are separated where the shift turns by more than 0.3 of its range.

    Parameters
    ----------
    path : path
        A table with a head, such as ``Weg [µm];Kraft [N]``: any separator, decimal comma or point.
        Or a recording: TDMS of LabVIEW, MAT of MATLAB, HDF5, MDF, a workbook of Excel. The content
        decides. ``pip install "fretting[rigs]"`` brings the libraries, ``fretting[mdf]`` the one
        of MDF.
    delta, T : str, optional
        Names of the columns of shift and force (default: by their units). The other columns need
        neither units nor numbers.
    units : dict of str to str, optional
        Units of columns whose head has none.
    skip : int
        Lines at the top that are left out, where the head is not found by itself (default 0).
    group : str, optional
        Group of channels, structure or sheet, where several have such columns. Channels of
        different clocks are resampled to the slower one, and the rule is printed.
    W : float, optional
        Normal force [N] (default: from the scene).
    noise : float, optional
        Standard deviation of the force [N] (default: from the residuals of the fit).
    tilt : bool, optional
        Whether a spring parallel to the contact, such as a guide or a seal, is an unknown: its
        force is its stiffness times the shift (default: if the loops slide; in partial slip a rig
        of another stiffness looks alike).
    drift : bool, optional
        Whether drifts of shift and force are unknowns: both grow in proportion to the number of the
        point (default: if there are several cycles or two turns within the record).
    detrend : bool
        Whether the drift of both gauges, a straight line through the middles of the cycles, is
        subtracted and printed (default False).

    Raises
    ------
    ValueError
        The file is no such table; the message has the line and what is allowed.
    """
    table = read_columns(path, units, skip=skip, group=group)
    shift = table.column("length", ("delta", "d_", "weg", "x", "shift", "disp"), delta)
    force = table.column("force", ("t", "q", "kraft", "f", "force"), T)
    x, y = read_pair(table, shift, force)
    if table.has_holes:
        whole = ~(np.isnan(x) | np.isnan(y))
        x, y = x[whole], y[whole]
    try:
        return _separate_loops(x, y, detrend=detrend, drifts=drift, W=W, noise=noise, tilt=tilt)
    except ValueError as error:
        raise ValueError(f"{table.place}: {error}") from error


@quantities
def read_indentation(
    path: str | os.PathLike[str],
    *,
    W: str | None = None,
    delta_z: str | None = None,
    units: dict[str, str] | None = None,
    skip: int = 0,
    group: str | None = None,
    noise: Length | None = None,
    frame: bool = False,
) -> Indentation:
    """Read an indentation curve of a file, as :func:`read_loops`.

    With ``frame=True`` the compliance of the frame [m/N] is an unknown: the approach that is
    measured holds it times the force.
    """
    table = read_columns(path, units, skip=skip, group=group)
    force = table.column("force", ("w", "f", "p", "load"), W)
    approach = table.column("length", ("delta", "h", "z", "depth", "weg"), delta_z)
    forces, approaches = read_pair(table, force, approach)
    return Indentation.from_arrays(forces, approaches, noise=noise, frame=frame)


@quantities
def read_scar(
    path: str | os.PathLike[str],
    *,
    wear: Mapping[str, Any],
    body_number: int = 2,
    x: str | None = None,
    depth: str | None = None,
    units: dict[str, str] | None = None,
    skip: int = 0,
    group: str | None = None,
    noise: Length | None = None,
) -> Scar:
    """Read the profile of a scar of a file, depth downwards positive, as :func:`read_loops`."""
    table = read_columns(path, units, skip=skip, group=group)
    x_column = table.column("length", ("x", "pos"), x)
    worn = table.column("length", ("depth", "z", "h", "worn", "tiefe"), depth)
    if x_column == worn:
        raise ValueError(
            f"{table.place}: has one column of lengths, {table.names[x_column]}: "
            "a profile has two, "
            "place and depth"
        )
    places, depths = read_pair(table, x_column, worn)
    return Scar.from_arrays(places, depths, wear=wear, body_number=body_number, noise=noise)


@quantities
def read_lives(
    path: str | os.PathLike[str],
    *,
    wear: Mapping[str, Any],
    cycles: str = "cycles",
    part: float = 1.0,
    body_number: int = 2,
    units: dict[str, str] | None = None,
    skip: int = 0,
    group: str | None = None,
    noise: float | None = None,
) -> Lives:
    """Read lives of a file: a column of cycles, the others named by the keys of a scene file.

    A column of a key that has a unit names it, as in ``W [N]``.
    """
    table = read_columns(path, units, skip=skip, group=group)
    if cycles not in table.names:
        raise ValueError(f"{table.place}: has no column {cycles!r}, but {', '.join(table.names)}")
    cycles_column = table.names.index(cycles)
    for at, name in enumerate(table.names):
        kind, unit = _core.measured_by(name) or ("", "")
        if at != cycles_column and unit:
            table.must_measure(at, kind)
    rows = np.column_stack(table.numbers(*range(len(table.names))))
    settings = [
        {
            name: float(v)
            for n, (name, v) in enumerate(zip(table.names, row, strict=True))
            if n != cycles_column
        }
        for row in rows
    ]
    return Lives(rows[:, cycles_column], settings, wear, part, body_number, noise)
