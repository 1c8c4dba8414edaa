"""A number that is known within a range: low, best, high."""

from __future__ import annotations

import math
from typing import NamedTuple

__all__ = ["Range"]


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
        """Give the best value and the range in two digits, since it is not known better."""
        best, low, high = (f"{of:.2g}" for of in (self.best, self.low, self.high))
        return (
            f"{best} ({low} to {high})" if math.isfinite(self.high) else f"{best} ({low} or more)"
        )
