"""Turns of a measured shift: where its branches begin and end, and its drift."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pyfret import _core

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
#: Part of half of the range beyond which the first or the last point counts as a turn.
OUTER = 0.8


def find_turns(delta: NDArray[np.float64]) -> list[int]:
    """Return the points where a shift turns by more than a part of its range, :data:`TURN`.

    The first point is a turn if the shift began at one of its ends, and the last one likewise.
    """
    turns: list[int] = _core.find_turns(np.asarray(delta, dtype=float), TURN, OUTER).tolist()
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
    at = np.asarray(turns, dtype=np.int64)
    lengths = np.diff(np.r_[0, at, delta.size - 1])
    shorter = np.minimum(lengths[:-1], lengths[1:])
    many = np.clip((OF_BRANCH * shorter).astype(int), BESIDE, MOST_BESIDE)
    many[shorter < many] = 0
    refined = np.empty((at.size, 3))
    for count in range(BESIDE, MOST_BESIDE + 1):
        chosen = np.flatnonzero(many == count)
        if chosen.size:
            refined[chosen] = _refine(delta, at[chosen], count)
    chosen_turns: NDArray[np.float64] = refined[many > 0]
    return chosen_turns


def _refine(delta: NDArray[np.float64], at: NDArray[np.int64], many: int) -> NDArray[np.float64]:
    """Refine turns by parabolas through `many` points on each side: index, shift and its error."""
    shift = delta[at]
    sign = np.where(shift > delta[at - many], 1.0, -1.0)
    parabolas, noises = [], []
    for side in (np.arange(-many, 0), np.arange(1, many + 1)):
        values = sign * delta[at + side[:, None]]
        powers = np.vander(side, 3)
        # By `einsum`: the threads of a matrix product cost more time than its numbers.
        parabola = np.einsum("kj,ji->ki", np.linalg.pinv(powers), values)
        residuals = values - np.einsum("jk,ki->ji", powers, parabola)
        parabolas.append(parabola)
        noises.append(np.sqrt(np.einsum("ji,ji->i", residuals, residuals) / (many - 3)))
    position, lower = _highest(*parabolas)
    # Not below the outermost point, unless that stands out by its noise.
    noise = np.maximum(*noises)
    turn = np.maximum(lower, sign * shift - 2.0 * noise)
    error = OF_WAY * np.abs(turn - sign * shift) + noise
    refined: NDArray[np.float64] = np.stack([at + position, sign * turn, error], axis=1)
    return refined


def _highest(
    first: NDArray[np.float64], second: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return where in [-1, 1] the lower of two parabolas is largest, and its value there.

    That is at an end, at the vertex of one of them, or where they meet. A parabola has the rows
    a, b, c of a s^2 + b s + c.
    """
    with np.errstate(all="ignore"):
        a, b, c = first - second
        q = -0.5 * (b + np.copysign(np.sqrt(b * b - 4.0 * a * c), b))
        vertices = [-0.5 * parabola[1] / parabola[0] for parabola in (first, second)]
        points = np.stack([*vertices, q / a, c / q, np.full(a.shape, -1.0), np.ones(a.shape)])
    # NaN, where they do not meet, gives an end.
    s = np.fmax(np.fmin(points, 1.0), -1.0)
    lower = np.minimum(*((f[0] * s + f[1]) * s + f[2] for f in (first, second)))
    best = lower.argmax(axis=0)
    turns = np.arange(best.size)
    return s[best, turns], lower[best, turns]
