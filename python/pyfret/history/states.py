"""States of a contact at the ends of loops, as sums of states of a run."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from pyfret.history.ladder import follow_channels

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from pyfret.history.load_history import LoadHistory
    from pyfret.history.loops import CountedLoops
    from pyfret.run.run import Run

__all__ = [
    "LoopStates",
    "branch_ends",
    "group_loops",
    "loops_as_levels",
    "loops_as_rows",
    "marched_weights",
    "states_of_march",
]


@dataclass(frozen=True)
class LoopStates:
    """States at the moments of loops, as sums of states of a run.

    Attributes
    ----------
    rows : array
        Rows of range, mean, count.
    weights : array of shape (loops, moments, increments)
        Weights of the states of the increments.
    increments : array of int
        Kept increments of the run.
    """

    rows: NDArray[np.float64]
    weights: NDArray[np.float64]
    increments: NDArray[np.int64]


def loops_as_rows(loops: CountedLoops) -> NDArray[np.float64]:
    """Return rows of range, mean, count."""
    d = loops.dataset
    return np.column_stack([d["range"].values, d["mean"].values, d["count"].values])


def loops_as_levels(loops: CountedLoops) -> NDArray[np.float64]:
    """Return rows of amplitude, mean, count."""
    rows = loops_as_rows(loops)
    rows[:, 0] *= 0.5
    return rows


def group_loops(
    rows: NDArray[np.float64],
    moments: list[NDArray[np.float64]],
    sides: NDArray[np.float64],
    classes: tuple[int, int],
) -> tuple[NDArray[np.float64], list[NDArray[np.float64]], NDArray[np.float64]]:
    """Merge many loops into classes of range, mean and branch, which keep their mean states.

    `classes` are the numbers of classes of the range and of the mean. Returned are rows, moments
    and branches.
    """
    ranges, means = classes
    top = float(rows[:, 0].max())
    low, high = float(rows[:, 1].min()), float(rows[:, 1].max())
    by_range = np.minimum((rows[:, 0] / top * ranges).astype(int), ranges - 1)
    by_mean = np.minimum(
        ((rows[:, 1] - low) / max(high - low, 1e-300) * means).astype(int), means - 1
    )
    key = (by_range * means + by_mean) * 2 + (sides > 0.0)
    filled = np.flatnonzero(np.bincount(key, minlength=2 * ranges * means))
    position = np.searchsorted(filled, key)
    counts = np.bincount(position, rows[:, 2], filled.size)

    def mean_over_class(values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the mean of values over the loops of each class, weighted by their counts."""
        return np.stack(
            [
                np.bincount(position, rows[:, 2] * column, filled.size) / counts
                for column in values.T
            ],
            axis=1,
        )

    middle = mean_over_class(rows[:, :2])
    grouped = np.column_stack([middle, counts])
    return (
        grouped,
        [mean_over_class(moment) for moment in moments],
        np.where(filled % 2 == 1, 1.0, -1.0),
    )


def branch_ends(run: Run) -> dict[int, int]:
    """Return the last increment of every branch."""
    branch = run.dataset.branch_of_increment.values
    increments = run.dataset.increment.values
    return {int(b): int(n) for b, n in zip(branch, increments, strict=True)}


def marched_weights(
    run: Run,
    samples: tuple[NDArray[np.int64], NDArray[np.int64]],
    before: int,
    *,
    turns: bool,
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Return the weights of the increments of a march in the moments of its loops.

    `before` is the branch that ends at the first sample. With channels out of phase all states
    between the two ends of a loop are moments, up to the number of two.
    """
    ends = branch_ends(run)
    increments = np.array(sorted(set(ends.values())))
    places = [samples[0], samples[1]]
    if turns:
        middles = 0.5 * (samples[0] + samples[1])
        places += [np.floor(middles).astype(int), np.ceil(middles).astype(int)]
    moments = []
    for sample in places:
        weights = np.zeros((sample.size, increments.size))
        position = np.searchsorted(increments, [ends[before + int(n)] for n in sample])
        weights[np.arange(sample.size), position] = 1.0
        moments.append(weights)
    return np.stack(moments, axis=1), increments


def states_of_march(run: Run, history: LoadHistory, loops: CountedLoops) -> LoopStates:
    """Return the states at the ends of the loops of a march of the whole history.

    Raises
    ------
    ValueError
        The run is no march of the history.
    """
    if not history.is_series:
        return states_of_cycle(run, loops)
    places = history.turns()
    before = len(run.scene.path.branches) - places.size
    branches = run.scene.path.branches[max(before, 0) :]
    values = [getattr(branch, history.channel) for branch in branches]
    same = before >= 0 and all(
        value is not None and math.isclose(value, expected, rel_tol=1e-9, abs_tol=1e-12)
        for value, expected in zip(
            values, history.channels[history.channel][places].tolist(), strict=False
        )
    )
    if not same:
        raise ValueError(
            "the result is no march of this history: give fret.solve(scene, history), or the scene"
        )
    d = loops.dataset
    first, last = (
        np.searchsorted(places, d[name].values.astype(int)) for name in ("first", "last")
    )
    turns = follow_channels(history).turns
    weights, increments = marched_weights(run, (first, last), before, turns=turns)
    return LoopStates(loops_as_rows(loops), weights, increments)


def states_of_cycle(run: Run, loops: CountedLoops) -> LoopStates:
    """Return the states of loops of one amplitude by the last closed cycle of a run."""
    cycles = run.loops()
    rows = loops_as_rows(loops)
    channel = run.dataset.get(str(loops.dataset.attrs["channel"]))
    if cycles.sizes["cycle"] == 0 or channel is None or len(rows) != 1:
        raise ValueError(
            "the history has no order: give the scene, or for loops of one amplitude the result of "
            "one cycle of them"
        )
    last = cycles.isel(cycle=-1)
    branch = run.dataset.branch_of_increment.values
    saved = run.dataset.saved_increment.values
    inside = (branch >= int(last.first_branch)) & (branch <= int(last.last_branch))
    kept = np.array([n for n in run.dataset.increment.values[inside] if n in saved])
    values = channel.sel(increment=kept).values
    reach = 0.5 * float(np.ptp(values)), 0.5 * float(values.max() + values.min())
    expected = 0.5 * float(rows[0, 0]), float(rows[0, 1])
    if not np.allclose(reach, expected, rtol=1e-9, atol=1e-9 * expected[0]):
        raise ValueError(
            f"the cycle of the result has the amplitude {reach[0]:.6g} and the mean "
            f"{reach[1]:.6g}, and the loops have {expected[0]:.6g} and {expected[1]:.6g}: must be "
            "the same"
        )
    weights = np.eye(kept.size)[None]
    return LoopStates(rows, weights, kept)
