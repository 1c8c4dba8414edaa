"""Physical quantities as types: a parameter ``z: Length`` takes a number in m, or ``"3 um"``.

Each type is a row of the table of quantities (crate ``plausible``): a unit, and a range in which
numbers are plausible. The decorator :func:`quantities` reads the types of a function once. At each
call it converts texts with units, and quantities of pint, to SI (``_core.quantity_in_si``, in the
core ``scene::case::measure``). It refuses what is no number, and warns of a number outside its
range: its unit is nearly always another one.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import (
    TYPE_CHECKING,
    Annotated,
    Any,
    Generic,
    Protocol,
    TypeAlias,
    TypeVar,
    overload,
)

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pyfret._util.keywords import check_places, refuse_unknown
from pyfret._util.names import listing
from pyfret._util.parameter import Signature, Unit, unit_of
from pyfret._util.refusals import refuse_clearly

if TYPE_CHECKING:
    from typing_extensions import dataclass_transform
else:

    def dataclass_transform(**_: Any) -> Any:
        """Return a decorator without effect: it is for type checkers."""
        return lambda cls: cls


T = TypeVar("T")
C = TypeVar("C", bound=Callable[..., Any])


class HasUnit(Protocol):
    """A quantity of pint, or of another library with its attributes."""

    @property
    def magnitude(self) -> Any:
        """Return the number."""

    @property
    def units(self) -> Any:
        """Return the unit of the number."""


#: A number in SI units, or one with its unit: a text such as ``"3 um"``, a quantity of pint.
Quantity: TypeAlias = float | str | HasUnit
#: One of these, or several.
Quantities: TypeAlias = Quantity | Sequence[Quantity] | NDArray[np.float64]


Modulus: TypeAlias = Annotated[Quantity, Unit("modulus", "Pa")]
ContactModulus: TypeAlias = Annotated[Quantity, Unit("contact modulus", "Pa")]
Radius: TypeAlias = Annotated[Quantity, Unit("radius", "m")]
Length: TypeAlias = Annotated[Quantity, Unit("length", "m")]
RelativeDepth: TypeAlias = Annotated[float, Unit("depth over a_H")]
Thickness: TypeAlias = Annotated[Quantity, Unit("thickness", "m")]
CrackLength: TypeAlias = Annotated[Quantity, Unit("length of a crack", "m")]
Angle: TypeAlias = Annotated[Quantity, Unit("angle", "rad")]
Force: TypeAlias = Annotated[Quantity, Unit("force", "N")]
PointForce: TypeAlias = Annotated[Quantity, Unit("load of a closed form", "N")]
LineForce: TypeAlias = Annotated[Quantity, Unit("load of a line contact", "N/m")]
Moment: TypeAlias = Annotated[Quantity, Unit("moment", "N m")]
Stiffness: TypeAlias = Annotated[Quantity, Unit("stiffness", "N/m")]
Frequency: TypeAlias = Annotated[Quantity, Unit("frequency", "Hz")]
Time: TypeAlias = Annotated[Quantity, Unit("time", "s")]
FrictionCoefficient: TypeAlias = Annotated[float, Unit("friction")]
NormalCompliance: TypeAlias = Annotated[Quantity, Unit("compliance of a bond", "m/Pa")]
ShearCompliance: TypeAlias = Annotated[Quantity, Unit("compliance of a bond in shear", "m/Pa")]
PeakPressure: TypeAlias = Annotated[Quantity, Unit("peak pressure", "Pa")]
BulkStress: TypeAlias = Annotated[Quantity, Unit("bulk stress", "Pa")]
ResidualDepth: TypeAlias = Annotated[Quantity, Unit("depth of a residual stress", "m")]
DeepestResidualStress: TypeAlias = Annotated[Quantity, Unit("deepest residual stress", "m")]
ResidualStress: TypeAlias = Annotated[Quantity, Unit("residual stress", "Pa")]
YieldStress: TypeAlias = Annotated[Quantity, Unit("material stress", "Pa")]
Strength: TypeAlias = Annotated[Quantity, Unit("strength", "Pa")]
StressIntensity: TypeAlias = Annotated[Quantity, Unit("threshold", "Pa m^0.5")]
Toughness: TypeAlias = Annotated[Quantity, Unit("toughness", "J/m^2")]
CrackGrowth: TypeAlias = Annotated[Quantity, Unit("crack growth", "m/cycle at 1 MPa m^0.5")]
WearCoefficient: TypeAlias = Annotated[Quantity, Unit("wear coefficient", "m^2/N")]
EnergyWearCoefficient: TypeAlias = Annotated[Quantity, Unit("energy wear coefficient", "m^3/J")]
ThermalExpansion: TypeAlias = Annotated[Quantity, Unit("thermal expansion", "1/K")]
Conductivity: TypeAlias = Annotated[Quantity, Unit("conductivity", "W/(m K)")]
HeatCapacity: TypeAlias = Annotated[Quantity, Unit("heat capacity", "J/(m^3 K)")]
Density: TypeAlias = Annotated[Quantity, Unit("density", "kg/m^3")]
SpecificHeat: TypeAlias = Annotated[Quantity, Unit("specific heat", "J/(kg K)")]

#: A number that the function itself checks.
Unchecked: TypeAlias = Annotated[float, Unit("", checked=False)]

#: Arrays, without a unit and of quantities.
Numbers: TypeAlias = Annotated[ArrayLike, Unit("")]
Lengths: TypeAlias = Annotated[ArrayLike, Unit("length", "m")]
CrackLengths: TypeAlias = Annotated[ArrayLike, Unit("length of a crack", "m")]
MeasuredShifts: TypeAlias = Annotated[NDArray[np.float64], Unit("measured shift", "m")]
MeasuredForces: TypeAlias = Annotated[NDArray[np.float64], Unit("force", "N")]
ScarPositions: TypeAlias = Annotated[NDArray[np.float64], Unit("place on a scar", "m")]
Forces: TypeAlias = Annotated[ArrayLike, Unit("force", "N")]
BulkStresses: TypeAlias = Annotated[ArrayLike, Unit("bulk stress", "Pa")]
ResidualStresses: TypeAlias = Annotated[ArrayLike, Unit("residual stress", "Pa")]
if TYPE_CHECKING:
    #: A stress of every layer: of a body without coatings one number may stand alone.
    LayerStresses: TypeAlias = Quantity | Sequence[ArrayLike]
else:
    LayerStresses = Sequence[ResidualStresses]
StressHistory: TypeAlias = Annotated[ArrayLike, Unit("stress history", "Pa", checked=False)]


class InSI(Generic[T]):
    """Type of a field of a :func:`part`: it is given as a quantity, and is a number in SI."""

    if TYPE_CHECKING:

        @overload
        def __get__(self: InSI[Quantity], of: object, owner: Any = None) -> float: ...
        @overload
        def __get__(self: InSI[Quantity | None], of: object, owner: Any = None) -> float | None: ...
        def __get__(self, of: object, owner: Any = None) -> Any: ...
        def __set__(self, of: object, value: T) -> None: ...

    else:

        def __class_getitem__(cls, quantity: Any) -> Any:
            """Return the quantity."""
            return quantity


@overload
def as_number(read: Quantity) -> float: ...
@overload
def as_number(read: Quantity | None) -> float | None: ...
def as_number(read: Any) -> Any:
    """Return a quantity that the decorator has converted: for type checkers."""
    return read


def as_layers(read: LayerStresses | None) -> Sequence[ArrayLike] | None:
    """Return stresses of layers that the decorator has converted: for type checkers."""
    return read  # type: ignore[return-value]


def by_default(number: float | None) -> Any:
    """Return the default of a field of the type :class:`InSI`: for type checkers."""
    return number


def quantities(call: C) -> C:
    """Convert the quantities among the arguments of a function to SI, and check its arguments.

    The types of the parameters are read at the first call. Of a class it is its constructor.
    """
    if isinstance(call, type):
        call.__init__ = checked(call.__init__, call)  # type: ignore[misc]
        return call
    return checked(call)


def checked(call: C, dataclass: type | None = None) -> C:
    """Return a function that checks its arguments, or the constructor of a dataclass."""
    read = functools.cache(functools.partial(Signature, call, dataclass))
    name = call.__qualname__.removesuffix(".__init__")

    @functools.wraps(call)
    def call_converted(*values: Any, **keywords: Any) -> Any:
        """Call the function with its arguments checked and converted."""
        signature = read()
        rules, names = signature.rules, signature.names
        if signature.keywords is not None:
            refuse_unknown(name, keywords, signature.keywords)
        refusal = check_places(name, signature.parameters.values(), values)
        if refusal is not None:
            raise refusal
        places = [
            rules[key].read(value) if key in rules else value
            for key, value in zip(names, values, strict=False)
        ]
        keywords = {
            key: rules[key].read(value) if key in rules else value
            for key, value in keywords.items()
        }
        answer = call(*places, *values[len(places) :], **keywords)
        # Only values that are accepted are doubted.
        for key, value in (*zip(names, places, strict=False), *keywords.items()):
            if key in rules:
                rules[key].warn(value)
        return answer

    refused = refuse_clearly(call_converted, name, lambda: read().names, lambda *_: None)
    return refused  # type: ignore[return-value]


@dataclass_transform(frozen_default=True, field_specifiers=(field,))
def part(
    *, kw_only: bool = False, eq: bool = True, repr: bool = True
) -> Callable[[type[T]], type[T]]:
    """Make a frozen dataclass whose fields are quantities, of the types :class:`InSI`."""

    def make(cls: type[T]) -> type[T]:
        """Make the class."""
        made: Any = dataclass(frozen=True, kw_only=kw_only, eq=eq, repr=repr)(cls)
        return quantities(made)  # type: ignore[no-any-return]

    return make


__all__ = ["Quantities", "Quantity", "Unit", "part", "quantities"]
__all__ += [name for name, hint in globals().items() if unit_of(hint) is not None]
__dir__ = listing(__all__)
