"""The distance that the surfaces slide over a path."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from pyfret.run.run import Run

__all__ = ["slid_distance"]


def slid_distance(result: Run, increment: int | None = None) -> NDArray[np.float64]:
    r"""Return the slid distance of every cell from the start of the path [m].

    The distance is :math:`\int |\mathrm{d}s|`, the sum of the slip of all increments. The slip of
    an increment has one direction, since it is solved as one step.

    Parameters
    ----------
    result : Result
        The run, with the fields of all increments.
    increment : int, optional
        The last increment, from 1 (default: the last one of the run).

    Raises
    ------
    ValueError
        Fields of increments are missing, or the contact has rolled.
    """
    d = result.dataset
    last = int(d.increment[-1]) if increment is None else increment
    saved = d.saved_increment.values
    if saved.size < last or not np.array_equal(saved[:last], np.arange(1, last + 1)):
        raise ValueError(
            f"slid distance: {np.count_nonzero(saved <= last)} of {last} increments kept their "
            'fields; it needs all of them: solve(..., save="all")'
        )
    if np.any(d.rolled.values):
        raise ValueError("slid distance: the contact rolls; the surfaces of a cell change")
    steps = (np.diff(d[name].values[:last], axis=0, prepend=0.0) for name in ("slip_x", "slip_y"))
    return np.asarray(np.hypot(*steps).sum(axis=0))
