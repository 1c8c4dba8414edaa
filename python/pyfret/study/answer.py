"""A number of a result, and the range that the estimate of its error leaves."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from pyfret._util.bounds import ESTIMATE, SIDES
from pyfret._util.lazy import xr

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["NOTHING", "Answer", "estimate"]


class Answer(NamedTuple):
    """A number, and the range that its own estimate of the error leaves; NaN if it has none."""

    value: float
    low: float
    high: float

    @classmethod
    def within(cls, value: float, error: float = 0.0, *, least: float = -math.inf) -> Answer:
        """A number and its error; `least` is the smallest that the number can be."""
        return cls(value, max(value - error, least), value + error)

    def sides(self) -> Iterator[tuple[str, float]]:
        """The suffixes of a number in a study, and their values."""
        yield from zip(SIDES, self, strict=True)

    def arrays(
        self, name: str, unit: str, meaning: str, *, without: str = ""
    ) -> dict[str, xr.DataArray]:
        """The number and its range by their names; the range does not hold `without`."""
        left_out = {"without": without} if without else {}
        return {
            f"{name}{side}": xr.DataArray(
                value, attrs={"units": unit, "long_name": f"{meaning}{SIDES[side]}", **left_out}
            )
            for side, value in self.sides()
        }


def estimate(value: float, unit: str, meaning: str) -> xr.DataArray:
    """A number without an error."""
    return xr.DataArray(value, attrs={"units": unit, "long_name": meaning, **ESTIMATE})


#: A number that a contact does not have.
NOTHING = Answer(math.nan, math.nan, math.nan)
