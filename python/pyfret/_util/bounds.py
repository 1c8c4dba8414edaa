"""Numbers of a table with the range that the estimate of their error leaves.

A number ``name`` has its range as ``name_low`` and ``name_high``. A number without an error is an
estimate: its attribute ``accuracy`` has this word.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._core import with_error, with_range
from pyfret._util.numbers import in_words

if TYPE_CHECKING:
    from collections.abc import Collection

    import xarray as xr

__all__ = ["ESTIMATE", "SIDES", "bounds", "is_bound", "known_to", "span", "split"]

#: Suffixes of a number and of its range, with what they add to its meaning.
SIDES = {"": "", "_low": ", lowest", "_high": ", highest"}
#: Attributes of a number without an error, and the word before it.
ESTIMATE = {"accuracy": "estimate"}
ABOUT = "about "
#: Factor from which on the range of a number is a factor and no part.
FACTOR = 1.5


def split(name: str, names: Collection[str]) -> tuple[str, str]:
    """Split a name into the number and the side of its range (low, high, or neither)."""
    for side in SIDES:
        base = name.removesuffix(side)
        if side and base != name and base in names:
            return base, side
    return name, ""


def is_bound(name: str, names: Collection[str]) -> bool:
    """Whether a name of a table is an end of the range of another one."""
    return split(name, names)[1] != ""


def bounds(table: xr.Dataset, name: str) -> tuple[xr.DataArray, xr.DataArray] | None:
    """The lowest and the highest values of a number; None if it has no range."""
    low, high = (f"{name}{side}" for side in SIDES if side)
    return (table[low], table[high]) if low in table and high in table else None


def shown(table: xr.Dataset, name: str, at: Any) -> str:
    """Format a number at one place of a table with the digits that its range leaves.

    An estimate has two digits. The measure of a user has four: its accuracy is not known.
    """
    value = float(table[name].values[at])
    ends = bounds(table, name)
    if ends is not None:
        return with_range(value, *(float(end.values[at]) for end in ends))
    if is_estimate(table[name]):
        return with_error(value)
    return in_words(value)


def is_estimate(values: xr.DataArray) -> bool:
    """Whether a number is one without an error."""
    return bool(values.attrs.get("accuracy") == ESTIMATE["accuracy"])


def span(table: xr.Dataset, name: str) -> str:
    """Format the least and the largest value of a number."""
    values = table[name].values
    is_float = values.dtype.kind == "f"
    infinite = np.isinf(values) if is_float else np.zeros(values.shape, dtype=bool)
    if bounds(table, name) is not None:
        # A life without an end is printed by the largest that is known.
        infinite[...] = False
    unknown = np.isnan(values) if is_float else infinite
    counted = ~(infinite | unknown)
    if not counted.any():
        return "infinite" if infinite.any() else "no number"
    ends = [
        np.unravel_index(int(find(np.where(counted, values, fill))), values.shape)
        for find, fill in ((np.argmin, np.inf), (np.argmax, -np.inf))
    ]
    low, high = (shown(table, name, at) for at in ends)
    counts = {"infinite": infinite.sum(), "no number": unknown.sum()}
    beyond = "".join(f", {count} {word}" for word, count in counts.items() if count)
    if low == high:
        return low + beyond
    if low.startswith(ABOUT) and high.startswith(ABOUT):
        high = high.removeprefix(ABOUT)
    return f"{low} to {high}{beyond}"


def known_to(table: xr.Dataset, name: str) -> str:
    """Format the accuracy of a number over a whole table, for a figure; "" for a user's measure.

    It is a part of the largest value, or a factor if that is more than ``FACTOR``.
    """
    values, ends = table[name].values.astype(float), bounds(table, name)
    if ends is None:
        return "estimate" if is_estimate(table[name]) else ""
    low, high = (end.values.astype(float) for end in ends)
    finite = np.isfinite(values) & np.isfinite(low) & np.isfinite(high)
    if not finite.any():
        return "estimate"
    values, low, high = values[finite], low[finite], high[finite]
    if (low > 0.0).all():
        factor = float(np.maximum(high / values, values / low).max())
        if factor > FACTOR:
            return f"within a factor of {factor:.2g}"
    largest = float(np.abs(values).max())
    error = float(np.maximum(values - low, high - values).max())
    return f"± {in_words(100.0 * error / largest, 2)} %" if largest > 0.0 else ""
