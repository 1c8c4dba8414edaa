"""The worst point of a section."""

from __future__ import annotations

import math
from typing import NamedTuple, NoReturn

from pyfret._core import degrees, with_error, with_range
from pyfret._util.attributes import missing_attribute
from pyfret._util.numbers import place
from pyfret.subsurface.tensor import Errors

__all__ = ["Worst", "in_megapascals"]

#: Names of numbers that a worst point does not have, and where they are.
ELSEWHERE = {
    "L": "it is a value at a point; life.L is the distance that the range is averaged over",
    "life": "it is the margin",
    "safety_factor": "it is the margin",
}


class Worst(NamedTuple):
    """The worst point of a section, between the samples, rims of the contact included."""

    #: Value of the criterion, in its unit: that of the stress at the point.
    value: float
    #: Safety factor, or life in cycles for criteria with a strain-life curve.
    margin: float
    #: Place [m].
    x: float
    y: float
    #: Depth [m].
    z: float
    #: Index of the layer from the surface down, from 0: coating 1 is 0, and the substrate has the
    #: number of coatings.
    layer: int
    #: What may be wrong with the value, by its sources.
    errors: Errors
    #: The border that it lies on: "rim" of the contact or "stick border"; None inside.
    at: str | None
    #: Normal of the critical plane, where the criterion has one.
    normal: tuple[float, float, float] | None
    #: Angle of the critical plane to the surface normal in the section [degrees], positive where it
    #: leans towards larger x or y with depth.
    inclination: float | None
    #: The margins of value + error and of value - error: the least and the largest. The scatter of
    #: the material is no part of it: :attr:`whole`.
    range: tuple[float, float]
    #: Unit of the value: "Pa", or "1" for strains.
    units: str = "1"
    #: Unit of the margin: "cycles" of a life, "1" of a safety factor.
    margin_units: str = "1"
    #: The least and the largest margin, 10 to 90 %: of the error and of the material's scatter.
    whole: tuple[float, float] = (math.nan, math.nan)

    @property
    def error(self) -> float:
        """What may be wrong with the value, all together."""
        return self.errors.sum

    def __getattr__(self, name: str) -> NoReturn:
        """Refuse a name that it does not have."""
        missing_attribute(self, name, ELSEWHERE)

    def __repr__(self) -> str:
        """Give margin with its range of 10 to 90 %, value, error and place in a few digits."""
        margin = with_range(self.margin, *self.whole)
        value = in_megapascals(self.value, self.error, self.units)
        at = f", at={self.at!r}" if self.at else ""
        angle = "" if self.inclination is None else f", inclination={degrees(self.inclination)}"
        told = (
            f"life {margin} cycles" if self.margin_units == "cycles" else f"safety factor {margin}"
        )
        return f"Worst({told} at a point, value={value}, {place(self)}{at}{angle})"


def in_megapascals(value: float, error: float, units: str) -> str:
    """A value with its error and unit: stresses in MPa, pure numbers alone."""
    if units == "Pa":
        return f"{with_error(1e-6 * value, 1e-6 * error)} MPa"
    return with_error(value, error) + ("" if units == "1" else f" {units}")
