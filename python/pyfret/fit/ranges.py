"""Ranges of the unknowns of a fit."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from pyfret._util.arrays import items, number
from pyfret._util.parameters import full
from pyfret._util.scene_warnings import doubt_numbers

__all__ = ["USUAL", "SearchRange", "ranges", "with_usual_ranges"]

#: Unknowns of a loop.
EXAMPLE = '{"mu": (0.1, 1.2), "rig.stiffness": (1e6, 1e8)}'
#: Ranges of the unknowns of a loop that are given by their names alone.
USUAL = {"mu": (0.05, 2.0), "rig.stiffness": (1e5, 1e10)}
#: Step of the differences, of ln of an unknown or of its range.
STEP = 0.02


@dataclass(frozen=True)
class SearchRange:
    """The range of an unknown: u from 0 to 1 between its ends, optionally by the logarithm."""

    key: str
    low: float
    start: float
    high: float

    @property
    def by_log(self) -> bool:
        """Whether the logarithm is searched."""
        return self.low > 0 and self.high / self.low > 1.5

    @property
    def width(self) -> float:
        """Length of the range, in what is searched."""
        return float(np.log(self.high / self.low)) if self.by_log else self.high - self.low

    @property
    def step(self) -> float:
        """Step of a difference, in u."""
        return STEP / self.width if self.by_log else STEP

    def value(self, u: float) -> float:
        """Return the unknown at u, the place in its range."""
        if self.by_log:
            return float(self.low * np.exp(u * self.width))
        return float(self.low + u * self.width)

    def to_u(self, value: float) -> float:
        """Return the place u of a value in its range."""
        offset = np.log(value / self.low) if self.by_log else value - self.low
        return float(offset / self.width)


def with_usual_ranges(
    unknown: Mapping[str, tuple[float, ...]] | Sequence[str] | str | None,
    starts: Mapping[str, float],
) -> Mapping[str, tuple[float, ...]]:
    """Return the ranges of unknowns that are given by their names alone, with their `starts`.

    Raises
    ------
    TypeError
        They are neither names nor ranges by names.
    ValueError
        A name has no usual range.
    """
    if unknown is None or isinstance(unknown, Mapping):
        return unknown or {}
    names = [unknown] if isinstance(unknown, str) else unknown
    if not isinstance(names, Sequence) or not all(isinstance(name, str) for name in names):
        raise TypeError(f"unknown = {unknown!r:.60}: must be ranges by names, such as {EXAMPLE}")
    for name in names:
        if full(name) not in map(full, USUAL):
            raise ValueError(f"unknown: {name:.60} needs its range, {{{name[:60]!r}: (low, high)}}")
    usual: dict[str, tuple[float, ...]] = {}
    for name, (low, high) in USUAL.items():
        start = starts.get(name)
        is_inside = start is not None and low < start < high
        usual[full(name)] = (low, start, high) if start is not None and is_inside else (low, high)
    return {name: usual[full(name)] for name in names}


def ranges(unknown: Mapping[str, tuple[float, ...]]) -> list[SearchRange]:
    """Check the ranges of the unknowns; implausible ends get a warning."""
    if not unknown:
        raise ValueError(f"unknown: none, give some with their ranges, such as {EXAMPLE}")
    search_ranges = []
    for key, bounds in unknown.items():
        ends = tuple(number(v, f"unknown: {key}") for v in items(bounds, f"unknown: {key}"))
        if len(ends) == 2:
            low, high = ends
            middle = np.sqrt(low * high) if low > 0 else 0.5 * (low + high)
            ends = (low, float(middle), high)
        if len(ends) != 3 or not ends[0] <= ends[1] <= ends[2] or not ends[0] < ends[2]:
            raise ValueError(
                f"unknown: {key} = {bounds}: must be (low, high) or (low, start, high)"
            )
        doubt_numbers("", **{key: (ends[0], ends[-1])})
        search_ranges.append(SearchRange(key, *ends))
    return search_ranges
