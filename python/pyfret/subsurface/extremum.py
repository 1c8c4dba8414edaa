"""The largest or smallest value of a field below a contact, its error and its place."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple, NoReturn

from pyfret._core import degrees, with_error, with_range
from pyfret._util.attributes import missing_attribute
from pyfret._util.numbers import layer_name
from pyfret._util.numbers import place as describe_place

__all__ = ["Errors", "Extremum", "Place", "format_value"]

#: Names of attributes by other words; messages on unknown attributes read it.
ELSEWHERE = {
    "L": "it is a value at a point; life.L is the distance that the range is averaged over",
    "life": "it is the margin",
    "safety_factor": "it is the margin",
    "factor": "it is the value",
    "at": "the border has the name `border`, the point `place`",
}


class Errors(NamedTuple):
    """Errors of an extreme value by their sources, in its unit."""

    #: Error of the search along x.
    x: float
    #: Error of the search along y.
    y: float
    #: Error of the search over the depths.
    z: float
    #: Difference to the value under the tractions of cells twice as large; NaN where it was not
    #: computed.
    tractions: float
    #: Error of the stress caused by the errors of the tractions; None without error bars
    #: (``solve(..., error=True)``). For a criterion or a load factor it covers the increments,
    #: where they were chosen.
    solution: float | None = None

    @property
    def sum(self) -> float:
        """Sum of the errors, for a number that is no linear function of the stress."""
        return sum(error for error in self if error is not None and not math.isnan(error))


class Place(NamedTuple):
    """A point of a body."""

    #: Place on the surface [m].
    x: float
    y: float
    #: Depth [m].
    z: float


#: Borders as they are printed.
PRINTED_BORDERS = {
    "rim": "at the rim of the contact",
    "stick border": "at the border of the stick zone",
}


class Extremum(NamedTuple):
    """An extreme value and its place, between the samples, rims of the contact included.

    It is the largest stress of :meth:`pyfret.subsurface.Stress.maximum`, the worst point of a
    :class:`pyfret.fatigue.Life`, the least load factor of :class:`pyfret.fatigue.LoadFactors`, or
    the largest growth of the plastic strain. The fields after ``errors`` belong to some of these.
    """

    #: The value, in `units`.
    value: float
    #: Error of the value; NaN where it is not estimated.
    error: float
    #: The point [m]; `x`, `y` and `z` are its coordinates.
    place: Place
    #: Index of the layer from the surface down, from 0; the number of coatings for the substrate.
    layer: int
    #: Unit of the value: "Pa", or "1" for strains and factors.
    units: str = "1"
    #: The border that the point lies on, "rim" of the contact or "stick border"; None inside. At
    #: the rim a value depends on how well the tractions are known there.
    border: str | None = None
    #: Errors of the value by their sources, in its unit.
    errors: Errors | None = None
    #: Safety factor at the point, or life in cycles for criteria with a strain-life curve.
    margin: float | None = None
    #: Unit of the margin: "cycles" of a life, "1" of a safety factor.
    margin_units: str = "1"
    #: The margins of value + error and of value - error: the least and the largest. The scatter of
    #: the material is part of :attr:`whole` alone.
    range: tuple[float, float] | None = None
    #: The least and the largest margin, 10 to 90 %, of the error and the scatter of the material.
    whole: tuple[float, float] | None = None
    #: Normal of the critical plane, where the criterion has one.
    normal: tuple[float, float, float] | None = None
    #: Angle of the critical plane to the surface normal in the section [degrees], positive where it
    #: leans towards larger x or y with depth.
    inclination: float | None = None
    #: The body, 1 or 2, where the search went over both.
    body_number: int | None = None
    #: Number of coatings of the body, for the name of the layer.
    coatings: int | None = None

    @property
    def layer_name(self) -> str:
        """Return the name of the layer, such as "coating 1" or "the substrate"."""
        if self.coatings is None:
            return f"layer {self.layer}"
        return layer_name(self.layer, self.coatings)

    @property
    def x(self) -> float:
        """Return the place along x [m]."""
        return self.place.x

    @property
    def y(self) -> float:
        """Return the place along y [m]."""
        return self.place.y

    @property
    def z(self) -> float:
        """Return the depth [m]."""
        return self.place.z

    def format_margin(self) -> str:
        """Format the margin with its range of 10 to 90 %; an empty text without a margin."""
        if self.margin is None or self.whole is None:
            return ""
        return with_range(self.margin, *self.whole)

    def __repr__(self) -> str:
        """Give value, error and place in a few digits, and the margin with its range."""
        value = format_value(self.value, self.error, self.units)
        parts = [value, describe_place(self, self.coatings)]
        if margin := self.format_margin():
            life = self.margin_units == "cycles"
            kind = f"life {margin} cycles" if life else f"safety factor {margin}"
            parts = [f"{kind} at a point", f"value={value}", describe_place(self, self.coatings)]
        if self.border:
            parts.append(PRINTED_BORDERS.get(self.border, self.border))
        if self.inclination is not None:
            parts.append(f"inclination={degrees(self.inclination)}")
        return f"Extremum({', '.join(parts)})"


def format_value(value: float, error: float, units: str) -> str:
    """Format a value with its error and unit: stresses in MPa, pure numbers alone."""
    if units == "Pa":
        return f"{with_error(1e-6 * value, 1e-6 * error)} MPa"
    return with_error(value, error) + ("" if units == "1" else f" {units}")


def refuse_attribute(self: Extremum, name: str) -> NoReturn:
    """Refuse a name that an extremum does not have, with where its number is."""
    missing_attribute(self, name, ELSEWHERE)


if not TYPE_CHECKING:
    # A method within the class would let type checkers take any name.
    Extremum.__getattr__ = refuse_attribute
    Errors.__getattr__ = Place.__getattr__ = missing_attribute
