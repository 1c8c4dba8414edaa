"""What is measured: friction loops, indentation curves, scars, lives."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from pyfret import _core
from pyfret._util.arrays import together
from pyfret._util.holds_arrays import HoldsArrays
from pyfret.fit import tables
from pyfret.quantities import (
    Force,
    Forces,
    InSI,
    Lengths,
    MeasuredShifts,
    Numbers,
    ScarPositions,
    by_default,
    part,
    quantities,
)

if TYPE_CHECKING:
    import os
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray


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

#: Part of the range of the shift that a turn has to go back to count as one.
TURN = 0.3
#: Points on each side of a turn whose parabolas meet there: least, most, over those of a branch.
BESIDE, MOST_BESIDE, OF_BRANCH = 4, 12, 0.1
#: Part of the way from the outermost point to a turn that is its error.
OF_WAY = 0.25
#: Part of a branch at its end whose slope is that of sliding, and the largest slope there, over
#: that of the flank, of a loop that slides: at 0.9 mu W a ball in partial slip has 0.46.
END, SLIDING = 0.25, 0.3


@part(eq=False, repr=False)
class Loops(HoldsArrays):
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
        Normal force [N]; None: that of the scene.
    noise : float, optional
        Standard deviation of the force [N]; None: that of the residuals of the fit.
    drift : (float, float)
        How much shift [m] and force [N] of the middle of a cycle move from the first to the last.
    tilt : bool, optional
        Whether a spring parallel to the contact is fitted; None: if the loops slide.
    drifts : bool, optional
        Whether drifts of both gauges, linear in the number of the point, are fitted. None: if the
        record has several cycles or two turns.
    """

    delta: MeasuredShifts
    T: NDArray[np.float64]
    down: NDArray[np.bool_]
    cycle: NDArray[np.int64]
    W: InSI[Force | None] = by_default(None)
    noise: float | None = None
    drift: tuple[float, float] = (0.0, 0.0)
    tilt: bool | None = None
    drifts: bool | None = None
    #: Turns within the record, (n, 3): number of the point, between two points as a rule, shift
    #: there and its error [m]; :func:`turns_between`.
    turns: NDArray[np.float64] | None = None

    @property
    def sliding_slope(self) -> float | None:
        """Slope of the ends of the branches [N/m], mean; None if the loops do not slide."""
        ends, flanks = [], []
        for n in range(int(self.cycle.max()) + 1):
            for down in (False, True):
                here = (self.cycle == n) & (self.down == down)
                shift, force = self.delta[here], self.T[here]
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
        if not ends or abs(np.mean(ends)) > SLIDING * float(np.mean(flanks)):
            return None
        return float(np.mean(ends))

    @staticmethod
    @quantities
    def of(
        delta: Numbers,
        T: Numbers,
        *,
        W: Force | None = None,
        noise: float | None = None,
        tilt: bool | None = None,
        drift: bool | None = None,
    ) -> Loops:
        """Loops of points in the order of time; what is before the first turn is left out.

        Points with a missing value, masked or NaN, are left out. ``tilt`` and ``drift`` as of
        :func:`loops`.

        Raises
        ------
        ValueError
            There is no closed loop.
        """
        shift, force = together(delta=delta, T=T, holes=True)
        turns = turning(shift)
        if len(turns) < 2:
            raise ValueError(
                "the shift must turn twice at least: a loop is a way there and a way back"
            )
        # One cycle may end where it began without a turn of its own.
        closed = len(turns) == 2
        order = np.arange(shift.size) if closed else np.arange(turns[0], turns[-1] + 1)
        down, cycle = np.zeros(shift.size, bool), np.zeros(shift.size, np.int64)
        for n, (first, last) in enumerate(pairwise(turns)):
            down[first : last + 1] = shift[last] < shift[first]
            cycle[first : last + 1] = n // 2
        if closed:
            rest = np.r_[0 : turns[0], turns[1] + 1 : shift.size]
            down[rest] = shift[turns[1]] > shift[turns[0]]
        middles = [
            [
                0.5 * (v[order][cycle[order] == n].max() + v[order][cycle[order] == n].min())
                for n in (0, cycle[order].max())
            ]
            for v in (shift, force)
        ]
        moved = (middles[0][1] - middles[0][0], middles[1][1] - middles[1][0])
        points = (shift[order], force[order], down[order], cycle[order])
        between = turns_between(shift, turns) - [order[0], 0.0, 0.0]
        return Loops(*points, W, noise, moved, tilt, drift, between)


@quantities
@dataclass(frozen=True, eq=False, repr=False)
class Indentation(HoldsArrays):
    """An indentation curve: approach [m] over normal force [N].

    With ``frame`` the compliance of the frame is fitted, too.
    """

    W: NDArray[np.float64]
    delta_z: MeasuredShifts
    noise: float | None = None
    frame: bool = False

    @staticmethod
    @quantities
    def of(
        W: Forces, delta_z: Lengths, *, noise: float | None = None, frame: bool = False
    ) -> Indentation:
        """A curve of points in any order; those without load or with a hole are left out.

        ``frame`` as of :func:`indentation`.
        """
        force, approach = together(W=W, delta_z=delta_z, holes=True)
        loaded = force > 0
        return Indentation(force[loaded], approach[loaded], noise, frame)


@quantities
@dataclass(frozen=True, eq=False, repr=False)
class Scar(HoldsArrays):
    """A worn profile along x at y = 0: depth [m] of a body, or of both with ``body_number=0``.

    ``wear`` holds the arguments of the run that made it, such as ``cycles`` and ``body2``.
    """

    x: ScarPositions
    depth: MeasuredShifts
    wear: Mapping[str, Any]
    body_number: int = 2
    noise: float | None = None

    @staticmethod
    @quantities
    def of(
        x: Numbers,
        depth: Lengths,
        *,
        wear: Mapping[str, Any],
        body_number: int = 2,
        noise: float | None = None,
    ) -> Scar:
        """A profile of points; those with a missing value are left out."""
        place, worn = together(x=x, depth=depth, holes=True)
        return Scar(place, worn, wear, body_number, noise)


@quantities
@dataclass(frozen=True, eq=False, repr=False)
class Lives(HoldsArrays):
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

    cycles: NDArray[np.float64]
    settings: Sequence[Mapping[str, Any]]
    wear: Mapping[str, Any]
    part: float = 1.0
    body_number: int = 2
    noise: float | None = field(default=None)


@dataclass(frozen=True, eq=False, repr=False)
class Measured(HoldsArrays):
    """The numbers of a set of data in a row, and how they are drawn."""

    data: Data
    measured: NDArray[np.float64]
    #: Coordinate that the numbers are drawn over, what it is, and what they are.
    along: NDArray[np.float64]
    labels: tuple[str, str]


@quantities
def read_loops(
    path: str | os.PathLike[str],
    *,
    delta: str | None = None,
    T: str | None = None,
    units: dict[str, str] | None = None,
    skip: int = 0,
    W: Force | None = None,
    noise: float | None = None,
    tilt: bool | None = None,
    drift: bool | None = None,
) -> Loops:
    """Read friction loops of a file, one after the other, also parted by empty lines.

    Parameters
    ----------
    path : path
        A table with a head, such as ``Weg [µm];Kraft [N]``: any separator, decimal comma or point.
    delta, T : str, optional
        Names of the columns of shift and force (default: by their units).
    units : dict of str to str, optional
        Units of columns whose head has none.
    skip : int
        Lines at the top that are left out, where the head is not found by itself (default 0).
    W : float, optional
        Normal force [N] (default: that of the scene).
    noise : float, optional
        Standard deviation of the force [N] (default: that of the residuals of the fit).
    tilt : bool, optional
        Whether a spring parallel to the contact, such as a guide or a seal, is an unknown: its
        force is its stiffness times the shift (default: if the loops slide; in partial slip a rig
        of another stiffness looks alike).
    drift : bool, optional
        Whether drifts of shift and force are unknowns: both grow in proportion to the number of the
        point (default: if there are several cycles or two turns within the record).

    Raises
    ------
    ValueError
        The file is no such table; the message has the line and what is allowed.
    """
    table = tables.read(path, units, skip=skip)
    shift = table.column("length", ("delta", "d_", "weg", "x", "shift", "disp"), delta)
    force = table.column("force", ("t", "q", "kraft", "f", "force"), T)
    rows = np.concatenate(table.blocks)
    return Loops.of(rows[:, shift], rows[:, force], W=W, noise=noise, tilt=tilt, drift=drift)


@quantities
def read_indentation(
    path: str | os.PathLike[str],
    *,
    W: str | None = None,
    delta_z: str | None = None,
    units: dict[str, str] | None = None,
    skip: int = 0,
    noise: float | None = None,
    frame: bool = False,
) -> Indentation:
    """Read an indentation curve of a file, as :func:`loops`.

    With ``frame=True`` the compliance of the frame [m/N] is an unknown: the approach that is
    measured holds it times the force.
    """
    table = tables.read(path, units, skip=skip)
    force = table.column("force", ("w", "f", "p", "load"), W)
    approach = table.column("length", ("delta", "h", "z", "depth", "weg"), delta_z)
    rows = np.concatenate(table.blocks)
    return Indentation.of(rows[:, force], rows[:, approach], noise=noise, frame=frame)


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
    noise: float | None = None,
) -> Scar:
    """Read the profile of a scar of a file, depth downwards positive, as :func:`loops`."""
    table = tables.read(path, units, skip=skip)
    place = table.column("length", ("x", "pos"), x)
    worn = table.column("length", ("depth", "z", "h", "worn", "tiefe"), depth)
    if place == worn:
        raise ValueError(
            f"{table.place}: has one column of lengths, {table.names[place]}: a profile has two, "
            "place and depth"
        )
    rows = np.concatenate(table.blocks)
    return Scar.of(rows[:, place], rows[:, worn], wear=wear, body_number=body_number, noise=noise)


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
    noise: float | None = None,
) -> Lives:
    """Read lives of a file: a column of cycles, the others named by the keys of a scene file.

    A column of a key that has a unit names it, as in ``W [N]``.
    """
    table = tables.read(path, units, skip=skip)
    if cycles not in table.names:
        raise ValueError(f"{table.place}: has no column {cycles!r}, but {', '.join(table.names)}")
    rows = np.concatenate(table.blocks)
    of = table.names.index(cycles)
    for at, name in enumerate(table.names):
        kind, unit = _core.measured_by(name) or ("", "")
        if at != of and unit:
            table.must_measure(at, kind)
    settings = [
        {
            name: float(v)
            for n, (name, v) in enumerate(zip(table.names, row, strict=True))
            if n != of
        }
        for row in rows
    ]
    return Lives(rows[:, of], settings, wear, part, body_number, noise)


def turns_between(delta: NDArray[np.float64], turns: list[int]) -> NDArray[np.float64]:
    """The turns within a record: number of the point, shift there and its error, (n, 3).

    One parabola goes through the points before a turn and one through those after it. On an upper
    turn the shift is the lower of both, and the turn lies where that is largest. Points rarely lie
    on the turn.
    """
    found = []
    for n, at in enumerate(turns):
        before = at - turns[n - 1] if n > 0 else at
        after = turns[n + 1] - at if n + 1 < len(turns) else delta.size - 1 - at
        many = min(max(BESIDE, int(OF_BRANCH * min(before, after))), MOST_BESIDE)
        if min(before, after) < many:
            continue
        sign = 1.0 if delta[at] > delta[at - many] else -1.0
        way = np.linspace(-1.0, 1.0, 401)
        sides = []
        for side in (np.arange(-many, 0), np.arange(1, many + 1)):
            parabola = np.polyfit(side, sign * delta[at + side], 2)
            rest = sign * delta[at + side] - np.polyval(parabola, side)
            sides.append((np.polyval(parabola, way), float(np.sqrt(rest @ rest / (many - 3)))))
        lower = np.minimum(sides[0][0], sides[1][0])
        top = int(lower.argmax())
        # Not below the outermost point, unless that stands out by its noise.
        noise = max(sides[0][1], sides[1][1])
        turn = max(float(lower[top]), sign * float(delta[at]) - 2.0 * noise)
        error = OF_WAY * abs(turn - sign * float(delta[at])) + noise
        found.append((at + float(way[top]), sign * turn, error))
    return np.array(found).reshape(-1, 3)


def turning(delta: NDArray[np.float64]) -> list[int]:
    """Where a shift turns, by more than a part of its range."""
    least = TURN * float(np.ptp(delta))
    turns: list[int] = []
    if least == 0.0:
        return turns
    extreme, way = 0, 0
    for n, value in enumerate(delta):
        ahead = value - delta[extreme]
        if way == 0:
            if abs(ahead) > least:
                # The first point is no turn, unless the shift began at one of its ends.
                if abs(delta[extreme] - 0.5 * (delta.max() + delta.min())) > 0.4 * np.ptp(delta):
                    turns.append(extreme)
                way, extreme = int(np.sign(ahead)), n
        elif way * ahead >= 0:
            extreme = n
        elif -way * ahead > least:
            turns.append(extreme)
            way, extreme = -way, n
    if abs(delta[extreme] - 0.5 * (delta.max() + delta.min())) > 0.4 * np.ptp(delta):
        turns.append(extreme)
    return turns
