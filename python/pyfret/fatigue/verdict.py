"""What bodies that yield come to over the cycles of a run."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, NamedTuple, TypeAlias

import numpy as np

from pyfret._core import RATCHETS, SHAKEN
from pyfret._util.numbers import in_words, um
from pyfret.quantities import quantities
from pyfret.subsurface.plastic import plastic_points

if TYPE_CHECKING:
    from pyfret.run import Run, State

__all__ = ["Verdict", "Where", "verdict"]

Kind: TypeAlias = Literal["elastic", "shakes down", "settles", "alternates", "ratchets"]
#: Plastic work of a cycle over that of the one before, below which a run has not settled.
SETTLES = 0.8


class Where(NamedTuple):
    """The point whose equivalent plastic strain grows most in the last cycle."""

    #: The body, 1 or 2.
    body_number: int
    #: Place [m].
    x: float
    y: float
    #: Depth [m].
    z: float
    #: Index of the layer from the surface down, from 0.
    layer: int


class Verdict(NamedTuple):
    """What a run with cycles comes to."""

    #: "elastic", "shakes down", "settles" (more cycles are needed), "alternates", "ratchets".
    kind: Kind
    #: Cycles after which nothing yields any more; None where something does in the last one.
    after: int | None
    #: Plastic work of every cycle [J], in plane strain [J/m].
    work: tuple[float, ...]
    #: Friction work of every cycle, in the same unit.
    friction_work: tuple[float, ...]
    #: Largest growth of the equivalent plastic strain in the last cycle; NaN where the increments
    #: at its ends did not keep their fields.
    strain: float
    #: Largest change of the plastic strain over the last cycle, as an equivalent strain, or NaN.
    net_strain: float
    #: Where the strain grows most; None where it does not, or is not known.
    where: Where | None
    #: Largest stress of von Mises of the path over the yield stress, 1 where a body yields.
    yield_ratio: float

    def __str__(self) -> str:
        """Say it in a sentence."""
        share = self.work[-1] / self.friction_work[-1] if self._rubs else None
        of = "" if share is None else f", {in_words(100 * share, 2)} % of the friction work"
        if self.kind == "elastic":
            return (
                f"elastic: the stress reaches {in_words(self.yield_ratio, 3)} of the yield stress"
            )
        if self.kind == "shakes down":
            return f"shakes down after {self.after} of {len(self.work)} cycles"
        work = f"{in_words(self.work[-1], 3)} J of plastic work in the last cycle{of}"
        if self.kind == "settles":
            fall = self.work[-1] / self.work[-2]
            return (
                f"settles: {work}, {in_words(fall, 2)} of the cycle before; go on for more cycles"
            )
        if np.isnan(self.strain):
            return f"{self.kind}: {work}"
        at = ""
        if self.where is not None:
            x, y, z = (um(of) for of in (self.where.x, self.where.y, self.where.z))
            at = f" at x = {x}, y = {y}, z = {z} of body {self.where.body_number}"
        return (
            f"{self.kind}: {work}, strain {in_words(100 * self.strain, 3)} % per cycle, "
            f"net {in_words(100 * self.net_strain, 3)} %{at}"
        )

    @property
    def _rubs(self) -> bool:
        return bool(self.friction_work and self.friction_work[-1] > 0.0)


@quantities
def verdict(result: Run) -> Verdict:
    """Say what bodies that yield come to over the closed cycles of a run.

    A run has shaken down where the plastic work of a cycle falls below 1e-3 of the friction work.
    Without friction the plastic work of the path takes the place of the friction work. It settles
    where the work of the last cycle is below 0.8 of that before. Otherwise it ratchets where a
    point keeps half of the strain that the last cycle adds up there, and alternates where it does
    not.

    The works of few increments err in first order; `strain` at the border of slip grows with every
    refinement.

    Parameters
    ----------
    result : Result
        With a closed cycle in its load path.

    Raises
    ------
    ValueError
        Something has yielded and the load path has no closed cycle.
    """
    d = result.dataset
    reached = float(d.yield_ratio.max())
    branch = d.branch_of_increment.values
    loops = result.loops()
    cycles = [
        (int(first), int(last))
        for first, last in zip(loops.first_branch.values, loops.last_branch.values, strict=True)
    ]
    per_cycle = [(branch >= first) & (branch <= last) for first, last in cycles]
    work = tuple(float(d.plastic_work.values[own].sum()) for own in per_cycle)
    friction = tuple(float(d.dissipated.values[own].sum()) for own in per_cycle)
    total = float(d.plastic_work.values.sum())
    if total == 0.0 and float(d.largest_plastic_strain.max()) == 0.0:
        return Verdict("elastic", 0, work, friction, 0.0, 0.0, None, reached)
    if not cycles:
        raise ValueError(
            "the load path has no closed cycle, and one is needed: end where a cycle began"
        )
    small = [SHAKEN * (rubbed if rubbed > 0.0 else total) for rubbed in friction]
    busy = [n for n, (done, limit) in enumerate(zip(work, small, strict=True)) if done > limit]
    after = busy[-1] + 1 if busy else 0
    strain, net, where = grown(result, cycles[-1])
    if after < len(cycles):
        return Verdict("shakes down", after, work, friction, strain, net, where, reached)
    kind: Kind = "ratchets" if net >= RATCHETS * strain > 0.0 else "alternates"
    if len(work) > 1 and work[-1] < SETTLES * work[-2]:
        kind = "settles"
    return Verdict(kind, None, work, friction, strain, net, where, reached)


def grown(result: Run, cycle: tuple[int, int]) -> tuple[float, float, Where | None]:
    """Largest growth of the equivalent strain in a cycle, largest net strain, and where it grows.

    NaN where the increments at the ends of the cycle did not keep their fields.
    """
    branch = result.dataset.branch_of_increment.values
    inside = np.flatnonzero((branch >= cycle[0]) & (branch <= cycle[1]))
    numbers = result.dataset.increment.values
    saved = result.dataset.saved_increment.values
    before = int(numbers[inside[0] - 1]) if inside[0] > 0 else 0
    end = int(numbers[inside[-1]])
    if before not in saved or end not in saved:
        return np.nan, np.nan, None
    strain, net, where = 0.0, 0.0, None
    state, first = result.at(end), result.at(before)
    for body_number in (n for n in (1, 2) if state.body(n).yields):
        largest, left, place = of_body(first, state, body_number)
        net = max(net, left)
        if largest > strain:
            strain, where = largest, place
    return strain, net, where


def of_body(first: State, last: State, body_number: int) -> tuple[float, float, Where | None]:
    """Largest growth, largest net strain and the place of the growth in a body."""
    ends = plastic_points(last, body_number)
    if ends.sizes["point"] == 0:
        return 0.0, 0.0, None
    starts = plastic_points(first, body_number)
    known = {
        key: n for n, key in enumerate(zip(starts.plane.values, starts.cell.values, strict=True))
    }
    rows = [known.get(key, -1) for key in zip(ends.plane.values, ends.cell.values, strict=True)]
    was = np.array(rows)
    zero = np.zeros((1, 6))
    strain = ends.strain.values - np.vstack((starts.strain.values, zero))[was]
    growth = ends.equivalent.values - np.append(starts.equivalent.values, 0.0)[was]
    # e : e with the shear components twice.
    square = (strain[:, :3] ** 2).sum(axis=1) + 2.0 * (strain[:, 3:] ** 2).sum(axis=1)
    left = float(np.sqrt(2.0 / 3.0 * square).max())
    top = int(growth.argmax())
    here = ends.isel(point=top)
    place = Where(body_number, float(here.x), float(here.y), float(here.z), int(here.layer))
    return float(growth[top]), left, place
