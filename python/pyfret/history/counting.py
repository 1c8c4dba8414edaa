"""Rainflow counting: the one place where a signal becomes loops.

The package ``rainflow`` 3.2 counts by ASTM E1049-85 (2017), 5.4.4, and keeps order and indices.
Its input is prepared here: floating point (a bare logger's int16 overflows in differences), turning
points alone, no missing values. Classes of amplitude lose the largest range, so there are none.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, TypeAlias, get_args

import numpy as np

from pyfret._util.arrays import plain
from pyfret.quantities import quantities

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["Residue", "count_signal", "rainflow", "rearranged", "turning_points"]

#: What becomes of the ranges that do not close: half cycles (E1049-85, 5.4.4), or the history is
#: a block that repeats, so that all of them close (5.4.5).
Residue: TypeAlias = Literal["half", "repeat"]


@quantities
def rainflow(signal: ArrayLike) -> NDArray[np.float64]:
    """Count the cycles of a signal: rows of range, mean, count (1 or 1/2).

    The amplitude is half of the range. The end points count as turning points, and a constant
    signal has no cycle. A missing value, masked or NaN, is refused with its place: the turning
    point beside it may be missing, too.

    Needs the package ``rainflow`` (``pip install fretting[fatigue]``), which follows ASTM E1049-85.
    """
    rows = count_signal(plain(signal, "signal"), "half")
    return rows[:, :3].copy()


def count_signal(values: NDArray[np.float64], residue: Residue) -> NDArray[np.float64]:
    """Count the loops of a signal without holes: rows of range, mean, count, first, last point.

    The points are indices of `values`. Rows have the order in which the loops close.
    """
    if values.ndim != 1:
        raise ValueError(f"signal has the shape {values.shape}: must have one dimension, time")
    if residue not in get_args(Residue):
        raise ValueError(f"residue = {residue!r}: must be 'half' or 'repeat'")
    try:
        import rainflow as counter
    except ImportError as error:
        raise ImportError("rainflow is missing: pip install fretting[fatigue]") from error
    places = rearranged(values) if residue == "repeat" else turning_points(values)
    turns = values[places]
    if turns.size < 2:
        return np.empty((0, 5))
    if turns.size == 2:
        # ASTM E1049-85, 5.4.4: the remainder is half a cycle.
        ends = [[np.ptp(turns), turns.mean(), 0.5, *places]]
        return np.array(ends, dtype=float)
    rows = np.array(list(counter.extract_cycles(turns.tolist())), dtype=float)
    rows[:, 3:] = places[rows[:, 3:].astype(int)]
    return merge_halves(rows) if residue == "repeat" else rows


def turning_points(values: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return the indices of the turning points, both ends included; the first of equal values."""
    if values.size < 2:
        return np.arange(values.size)
    changes = np.concatenate([[0], 1 + np.flatnonzero(np.diff(values) != 0.0)])
    if changes.size < 2:
        return changes[:1]
    rising = np.diff(values[changes]) > 0.0
    turns = changes[1:-1][rising[1:] != rising[:-1]]
    return np.concatenate([changes[:1], turns, changes[-1:]])


def rearranged(values: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return the turning points of a block that repeats, from its largest value to that again."""
    if values.size == 0:
        return np.empty(0, dtype=np.int64)
    first = int(values.argmax())
    block = np.concatenate([np.arange(first, values.size), np.arange(first + 1)])
    return block[turning_points(values[block])]


def merge_halves(rows: NDArray[np.float64]) -> NDArray[np.float64]:
    """Merge half cycles of the same range and mean into whole ones."""
    merged = rows.copy()
    kept = np.ones(len(rows), dtype=bool)
    waiting: dict[tuple[float, float], int] = {}
    for n in np.flatnonzero(rows[:, 2] == 0.5).tolist():
        key = (float(rows[n, 0]), float(rows[n, 1]))
        if key in waiting:
            merged[waiting.pop(key), 2] = 1.0
            kept[n] = False
        else:
            waiting[key] = n
    return merged[kept]
