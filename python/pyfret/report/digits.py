"""Numbers of a page in few digits."""

from __future__ import annotations

from typing import Any

import numpy as np

__all__ = ["short"]


def short(values: Any, digits: int = 4) -> Any:
    """Round numbers to a few digits, as lists; missing numbers become None."""
    array = np.asarray(values, dtype=float)
    with np.errstate(divide="ignore", invalid="ignore"):
        power = digits - 1 - np.floor(np.log10(np.abs(array)))
        power = np.where(np.isfinite(power), power, 0.0)
        rounded = np.round(array * 10.0**power) / 10.0**power
    listed = np.where(np.isfinite(rounded), rounded, np.nan).astype(object)
    listed[~np.isfinite(rounded)] = None
    return listed.tolist()
