"""Turns of a measured shift: where its branches begin and end, and its drift."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["find_turns", "remove_drift", "turns_between"]

#: Part of the range of the shift that a turn has to go back to count as one.
TURN = 0.3
#: Points on each side of a turn whose parabolas meet there: least, most, over the points of a
#: branch.
BESIDE, MOST_BESIDE, OF_BRANCH = 4, 12, 0.1
#: Part of the direction from the outermost point to a turn that is its error.
OF_WAY = 0.25
#: Points whose least and largest shift are compared at once.
BLOCK = 1024
#: Part of half of the range beyond which the first or the last point counts as a turn.
OUTER = 0.8


def find_turns(delta: NDArray[np.float64]) -> list[int]:
    """Return the points where a shift turns by more than a part of its range, :data:`TURN`.

    The first point is a turn if the shift began at one of its ends, and the last one likewise.
    Blocks of points without a turn are passed over by their least and largest shift.
    """
    low, high = (float(delta.min()), float(delta.max())) if delta.size else (0.0, 0.0)
    least = TURN * (high - low)
    turns: list[int] = []
    if least == 0.0:
        return turns

    def is_outer(point: int) -> bool:
        return abs(float(delta[point]) - 0.5 * (high + low)) > 0.5 * OUTER * (high - low)

    extreme, direction = 0, 0
    for first in range(0, delta.size, BLOCK):
        block = delta[first : first + BLOCK]
        if direction != 0:
            ahead = direction * block
            top = float(ahead.max())
            if max(top, direction * float(delta[extreme])) - float(ahead.min()) <= least:
                if top >= direction * float(delta[extreme]):
                    # The last of equal ones.
                    extreme = first + block.size - 1 - int(ahead[::-1].argmax())
                continue
        for n, value in enumerate(block.tolist(), first):
            ahead_by = value - delta[extreme]
            if direction == 0:
                if abs(ahead_by) > least:
                    if is_outer(extreme):
                        turns.append(extreme)
                    direction, extreme = int(np.sign(ahead_by)), n
            elif direction * ahead_by >= 0:
                extreme = n
            elif -direction * ahead_by > least:
                turns.append(extreme)
                direction, extreme = -direction, n
    if is_outer(extreme):
        turns.append(extreme)
    return turns


def remove_drift(
    values: NDArray[np.float64], turns: list[int]
) -> tuple[NDArray[np.float64], float]:
    """Subtract the drift of a gauge, and return it from the first to the last middle.

    The middle of a cycle is the mean of its largest and least value. A straight line through the
    middles, at the middles of the cycles, is the drift. At least two cycles are needed.
    """
    cycles = [(turns[n], turns[n + 2]) for n in range(0, len(turns) - 2, 2)]
    if len(cycles) < 2:
        raise ValueError("removing a drift needs two whole cycles at least")
    places = np.array([0.5 * (first + last) for first, last in cycles])
    middles = np.array(
        [
            0.5 * (values[first : last + 1].max() + values[first : last + 1].min())
            for first, last in cycles
        ]
    )
    slope = float(np.polyfit(places, middles, 1)[0])
    moved = slope * float(places[-1] - places[0])
    return values - slope * (np.arange(values.size) - turns[0]), moved


def turns_between(delta: NDArray[np.float64], turns: list[int]) -> NDArray[np.float64]:
    """The turns within a record: number of the point, shift there and its error, (n, 3).

    One parabola goes through the points before a turn and one through those after it. On an upper
    turn the shift is the lower of both, and the turn lies where that is largest. Points rarely lie
    on the turn.
    """
    refined = []
    for n, at in enumerate(turns):
        before = at - turns[n - 1] if n > 0 else at
        after = turns[n + 1] - at if n + 1 < len(turns) else delta.size - 1 - at
        many = min(max(BESIDE, int(OF_BRANCH * min(before, after))), MOST_BESIDE)
        if min(before, after) < many:
            continue
        sign = 1.0 if delta[at] > delta[at - many] else -1.0
        s = np.linspace(-1.0, 1.0, 401)
        sides = []
        for side in (np.arange(-many, 0), np.arange(1, many + 1)):
            parabola = np.polyfit(side, sign * delta[at + side], 2)
            residual = sign * delta[at + side] - np.polyval(parabola, side)
            sides.append(
                (np.polyval(parabola, s), float(np.sqrt(residual @ residual / (many - 3))))
            )
        lower = np.minimum(sides[0][0], sides[1][0])
        top = int(lower.argmax())
        # Not below the outermost point, unless that stands out by its noise.
        noise = max(sides[0][1], sides[1][1])
        turn = max(float(lower[top]), sign * float(delta[at]) - 2.0 * noise)
        error = OF_WAY * abs(turn - sign * float(delta[at])) + noise
        refined.append((at + float(s[top]), sign * turn, error))
    return np.array(refined).reshape(-1, 3)
