"""A number within a range: low, best, high, and the sources of the range."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from pyfret._core import known_as, with_range
from pyfret._util.attributes import missing_attribute

__all__ = ["LifeRange", "Range", "known_as"]


class Range(NamedTuple):
    """A number and the range that it lies in."""

    low: float
    best: float
    high: float

    @property
    def factor(self) -> float:
        """The highest over the lowest value."""
        return self.high / self.low if self.low > 0.0 else math.inf

    def __repr__(self) -> str:
        """Give the best value and the range, with the digits that the range leaves."""
        return with_range(self.best, self.low, self.high)


class LifeRange(NamedTuple):
    """A life [cycles] or a safety factor: its range of 10 to 90 %, and the parts of the range.

    The logarithms of the parts are independent and add as squares.
    """

    low: float
    best: float
    high: float
    #: From the error of the stress.
    stress: Range
    #: Highest over lowest by the scatter of the material.
    material: float
    #: From the critical distance; None for a value at a point.
    distance: Range | None
    #: The critical distance [m].
    L: float | None
    #: Notes on the range.
    notes: tuple[str, ...]

    @property
    def factor(self) -> float:
        """The highest over the lowest value."""
        return self.high / self.low if self.low > 0.0 else math.inf

    def __repr__(self) -> str:
        """Give the best value and the range, with the digits that the range leaves."""
        return with_range(self.best, self.low, self.high)


if not TYPE_CHECKING:
    # A method within the class would let type checkers take any name.
    Range.__getattr__ = missing_attribute
    LifeRange.__getattr__ = missing_attribute
