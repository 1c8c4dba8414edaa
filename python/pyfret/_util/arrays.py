"""Arrays that people give."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["plain"]


def plain(values: ArrayLike, name: str) -> NDArray[np.float64]:
    """The numbers of an array; a ValueError if some are masked, whose values nobody means.

    `name` is that of the argument.
    """
    if np.ma.is_masked(values):
        masked: Any = np.ma.getmaskarray(np.ma.asarray(values))
        raise ValueError(
            f"{name} has {np.count_nonzero(masked)} masked values of {masked.size}: must have a "
            "number everywhere; leave them out, or fill them"
        )
    try:
        return np.asarray(values, dtype=float)
    except (TypeError, ValueError, OverflowError) as error:
        raise TypeError(f"{name}: must be an array of numbers: {error}") from error
