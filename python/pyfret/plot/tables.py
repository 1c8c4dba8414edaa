"""Tables that figures are drawn of: what they have to hold, and what makes them."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    import xarray as xr

__all__ = ["must_hold"]


def must_hold(table: xr.Dataset, parameter: str, names: Iterable[str], made: str) -> None:
    """Refuse a table without variables that a figure draws, and name the function that makes one.

    Raises
    ------
    ValueError
        One of the names is no variable of the table.
    """
    absent = [name for name in names if name not in table.variables]
    if absent:
        raise ValueError(f"{parameter} has no {', '.join(absent)}: must be {made}")
