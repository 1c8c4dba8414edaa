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
#: Points of a block, whose least and largest shift are compared at once.
BLOCK = 32
#: Numbers on a point of each side where its parabola is looked at, and turns at a time.
STEPS, AT_ONCE = 401, 256
#: Part of half of the range beyond which the first or the last point counts as a turn.
OUTER = 0.8


def find_turns(delta: NDArray[np.float64]) -> list[int]:
    """Return the points where a shift turns by more than a part of its range, :data:`TURN`.

    The first point is a turn if the shift began at one of its ends, and the last one likewise.
    Blocks of points without a turn are passed over by their least and largest shift.
    """
    turns: list[int] = []
    if not delta.size:
        return turns
    begins = np.arange(0, delta.size, BLOCK)
    lows, highs = np.minimum.reduceat(delta, begins), np.maximum.reduceat(delta, begins)
    low, high = float(lows.min()), float(highs.max())
    least = TURN * (high - low)
    if least == 0.0:
        return turns

    def is_outer(point: int) -> bool:
        """Return whether a point is near one of the ends of the shift."""
        return abs(float(delta[point]) - 0.5 * (high + low)) > 0.5 * OUTER * (high - low)

    # The outermost shift since the last turn, its point or its block, and the sign of the way.
    outermost, point, block, direction = float(delta[0]), 0, -1, 0
    for n, (bottom, top) in enumerate(zip(lows.tolist(), highs.tolist(), strict=True)):
        if direction > 0:
            if (top if top > outermost else outermost) - bottom <= least:
                if top >= outermost:
                    outermost, block = top, n
                continue
        elif direction < 0 and top - (bottom if bottom < outermost else outermost) <= least:
            if bottom <= outermost:
                outermost, block = bottom, n
            continue
        if block >= 0:
            point, block = last_equal(delta, block, outermost), -1
        for index, value in enumerate(delta[n * BLOCK : (n + 1) * BLOCK].tolist(), n * BLOCK):
            ahead = value - outermost
            if direction == 0:
                if abs(ahead) > least:
                    if is_outer(point):
                        turns.append(point)
                    direction, outermost, point = (1 if ahead > 0.0 else -1), value, index
            elif direction * ahead >= 0:
                outermost, point = value, index
            elif -direction * ahead > least:
                turns.append(point)
                direction, outermost, point = -direction, value, index
    if block >= 0:
        point = last_equal(delta, block, outermost)
    if is_outer(point):
        turns.append(point)
    return turns


def last_equal(delta: NDArray[np.float64], block: int, value: float) -> int:
    """Return the last point of a block with a value."""
    values: list[float] = delta[block * BLOCK : (block + 1) * BLOCK].tolist()
    return block * BLOCK + len(values) - 1 - values[::-1].index(value)


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
    at = np.asarray(turns, dtype=np.int64)
    lengths = np.diff(np.r_[0, at, delta.size - 1])
    shorter = np.minimum(lengths[:-1], lengths[1:])
    many = np.clip((OF_BRANCH * shorter).astype(int), BESIDE, MOST_BESIDE)
    many[shorter < many] = 0
    refined = np.empty((at.size, 3))
    for count in range(BESIDE, MOST_BESIDE + 1):
        chosen = np.flatnonzero(many == count)
        for first in range(0, chosen.size, AT_ONCE):
            rows = chosen[first : first + AT_ONCE]
            refined[rows] = _refine(delta, at[rows], count)
    chosen_turns: NDArray[np.float64] = refined[many > 0]
    return chosen_turns


def _refine(delta: NDArray[np.float64], at: NDArray[np.int64], many: int) -> NDArray[np.float64]:
    """Refine turns by parabolas through `many` points on each side: index, shift and its error."""
    shift = delta[at]
    sign = np.where(shift > delta[at - many], 1.0, -1.0)
    s = np.linspace(-1.0, 1.0, STEPS)
    heights, noises = [], []
    for side in (np.arange(-many, 0), np.arange(1, many + 1)):
        values = sign[:, None] * delta[at[:, None] + side]
        powers = np.vander(side, 3)
        parabolas = values @ np.linalg.pinv(powers).T
        residuals = values - parabolas @ powers.T
        heights.append(parabolas @ np.vander(s, 3).T)
        noises.append(np.sqrt((residuals**2).sum(axis=1) / (many - 3)))
    lower = np.minimum(*heights)
    top = lower.argmax(axis=1)
    # Not below the outermost point, unless that stands out by its noise.
    noise = np.maximum(*noises)
    turn = np.maximum(lower[np.arange(at.size), top], sign * shift - 2.0 * noise)
    error = OF_WAY * np.abs(turn - sign * shift) + noise
    refined: NDArray[np.float64] = np.stack([at + s[top], sign * turn, error], axis=1)
    return refined
