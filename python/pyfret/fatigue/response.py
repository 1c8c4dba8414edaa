"""The response of bodies that yield to the cycles of a run: shakedown, ratcheting, alternation."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, NamedTuple, TypeAlias

import numpy as np

from pyfret._core import RATCHETS, SHAKEN
from pyfret._util.attributes import missing_attribute
from pyfret._util.numbers import in_words, um
from pyfret.quantities import quantities
from pyfret.subsurface.extremum import Extremum, Place
from pyfret.subsurface.plastic import plastic_points

if TYPE_CHECKING:
    from pyfret.run import Run, State

__all__ = ["CyclicResponse", "cyclic_response"]

Kind: TypeAlias = Literal["elastic", "shakes down", "settles", "alternates", "ratchets"]
#: Plastic work of a cycle over the work of the previous cycle, below which a run has not settled.
SETTLES = 0.8


class CyclicResponse(NamedTuple):
    """The response of the bodies to the cycles of a run."""

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
    #: The point whose equivalent plastic strain grows most in the last cycle, and the growth,
    #: without an error. None where nothing grows, or the increments did not keep their fields.
    where: Extremum | None
    #: Largest stress of von Mises of the path over the yield stress, 1 where a body yields.
    yield_ratio: float

    def __str__(self) -> str:
        """Describe the response in a sentence."""
        share = self.work[-1] / self.friction_work[-1] if self._rubs else None
        percentage = "" if share is None else f", {in_words(100 * share, 2)} % of the friction work"
        if self.kind == "elastic":
            return (
                f"elastic: the stress reaches {in_words(self.yield_ratio, 3)} of the yield stress"
            )
        if self.kind == "shakes down":
            return f"shakes down after {self.after} of {len(self.work)} cycles"
        work = f"{in_words(self.work[-1], 3)} J of plastic work in the last cycle{percentage}"
        if self.kind == "settles":
            fall = self.work[-1] / self.work[-2]
            return (
                f"settles: {work}, {in_words(fall, 2)} of the cycle before; go on for more cycles"
            )
        if np.isnan(self.strain):
            return f"{self.kind}: {work}"
        at = ""
        if self.where is not None:
            x, y, z = (um(coordinate) for coordinate in (self.where.x, self.where.y, self.where.z))
            at = f" at x = {x}, y = {y}, z = {z} of body {self.where.body_number}"
        return (
            f"{self.kind}: {work}, strain {in_words(100 * self.strain, 3)} % per cycle, "
            f"net {in_words(100 * self.net_strain, 3)} %{at}"
        )

    @property
    def _rubs(self) -> bool:
        """Return whether friction dissipates energy, so that plastic work is compared with it."""
        return bool(self.friction_work and self.friction_work[-1] > 0.0)


@quantities
def cyclic_response(result: Run) -> CyclicResponse:
    """Classify the response of bodies that yield to the closed cycles of a run.

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
    work = tuple(float(d.plastic_work.values[in_cycle].sum()) for in_cycle in per_cycle)
    friction = tuple(float(d.dissipated.values[in_cycle].sum()) for in_cycle in per_cycle)
    total = float(d.plastic_work.values.sum())
    if total == 0.0 and float(d.largest_plastic_strain.max()) == 0.0:
        return CyclicResponse("elastic", 0, work, friction, 0.0, 0.0, None, reached)
    if not cycles:
        raise ValueError(
            "the load path has no closed cycle, and one is needed: end where a cycle began"
        )
    small = [SHAKEN * (rubbed if rubbed > 0.0 else total) for rubbed in friction]
    busy = [
        n
        for n, (cycle_work, limit) in enumerate(zip(work, small, strict=True))
        if cycle_work > limit
    ]
    after = busy[-1] + 1 if busy else 0
    strain, net, where = strain_growth(result, cycles[-1])
    if after < len(cycles):
        return CyclicResponse("shakes down", after, work, friction, strain, net, where, reached)
    kind: Kind = "ratchets" if net >= RATCHETS * strain > 0.0 else "alternates"
    if len(work) > 1 and work[-1] < SETTLES * work[-2]:
        kind = "settles"
    return CyclicResponse(kind, None, work, friction, strain, net, where, reached)


def strain_growth(result: Run, cycle: tuple[int, int]) -> tuple[float, float, Extremum | None]:
    """Return largest strain growth and largest net strain in a cycle, with the place of the growth.

    NaN where the increments at the ends of the cycle did not keep their fields.
    """
    branch = result.dataset.branch_of_increment.values
    inside = np.flatnonzero((branch >= cycle[0]) & (branch <= cycle[1]))
    numbers = result.dataset.increment.values
    saved = result.dataset.saved_increment.values
    start = int(numbers[inside[0] - 1]) if inside[0] > 0 else 0
    end = int(numbers[inside[-1]])
    if start not in saved or end not in saved:
        return np.nan, np.nan, None
    strain, net, where = 0.0, 0.0, None
    state, start_state = result.at(end), result.at(start)
    for body_number in (n for n in (1, 2) if state.body(n).yields):
        growth, net_growth, growth_point = strain_growth_of_body(start_state, state, body_number)
        net = max(net, net_growth)
        if growth > strain:
            strain, where = growth, growth_point
    return strain, net, where


def strain_growth_of_body(
    first: State, last: State, body_number: int
) -> tuple[float, float, Extremum | None]:
    """Return the largest growth, the largest net strain and the place of the growth in a body."""
    ends = plastic_points(last, body_number)
    if ends.sizes["point"] == 0:
        return 0.0, 0.0, None
    starts = plastic_points(first, body_number)
    row_of_point = {
        key: n for n, key in enumerate(zip(starts.plane.values, starts.cell.values, strict=True))
    }
    rows = [
        row_of_point.get(key, -1) for key in zip(ends.plane.values, ends.cell.values, strict=True)
    ]
    start_rows = np.array(rows)
    zero = np.zeros((1, 6))
    strain = ends.strain.values - np.vstack((starts.strain.values, zero))[start_rows]
    growth = ends.equivalent.values - np.append(starts.equivalent.values, 0.0)[start_rows]
    # e : e with the shear components twice.
    square = (strain[:, :3] ** 2).sum(axis=1) + 2.0 * (strain[:, 3:] ** 2).sum(axis=1)
    net_strain = float(np.sqrt(2.0 / 3.0 * square).max())
    top = int(growth.argmax())
    point = ends.isel(point=top)
    peak = Place(float(point.x), float(point.y), float(point.z))
    largest = Extremum(
        float(growth[top]),
        np.nan,
        peak,
        int(point.layer),
        body_number=body_number,
        coatings=len(last.body(body_number).coatings),
    )
    return largest.value, net_strain, largest


if not TYPE_CHECKING:
    # A method within the class would let type checkers take any name.
    CyclicResponse.__getattr__ = missing_attribute
