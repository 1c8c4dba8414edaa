"""A number of a result, with its range."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from pyfret._util.bounds import ESTIMATE, SIDES
from pyfret._util.lazy import xr

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["NO_ANSWER", "Answer", "estimate"]


class Answer(NamedTuple):
    """A number with the range of its own error estimate; NaN if it has none."""

    value: float
    low: float
    high: float

    @classmethod
    def from_error(cls, value: float, error: float = 0.0, *, least: float = -math.inf) -> Answer:
        """Make an answer from a number and its error; `least` is a lower limit of the number."""
        return cls(value, max(value - error, least), value + error)

    def sides(self) -> Iterator[tuple[str, float]]:
        """Yield the suffixes of a number in a study, with their values."""
        yield from zip(SIDES, self, strict=True)

    def arrays(
        self, name: str, unit: str, meaning: str, *, without: str = ""
    ) -> dict[str, xr.DataArray]:
        """Return the number and its range by their names; the range excludes `without`."""
        excluded = {"without": without} if without else {}
        return {
            f"{name}{side}": xr.DataArray(
                value, attrs={"units": unit, "long_name": f"{meaning}{SIDES[side]}", **excluded}
            )
            for side, value in self.sides()
        }


def estimate(value: float, unit: str, meaning: str) -> xr.DataArray:
    """Make a number without an error."""
    return xr.DataArray(value, attrs={"units": unit, "long_name": meaning, **ESTIMATE})


#: A number that a contact does not have.
NO_ANSWER = Answer(math.nan, math.nan, math.nan)
