"""Types that the compiled module and Python share."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, Protocol, TypeAlias, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["FrictionFunction", "Quantities", "Quantity", "Variable", "as_number", "by_default"]


class HasUnit(Protocol):
    """A quantity of pint, or of another library that has its attributes."""

    @property
    def magnitude(self) -> Any:
        """Number."""

    @property
    def units(self) -> Any:
        """Unit of the number."""


#: A number in SI units, or one with its unit: a text such as ``"3 um"``, a quantity of pint.
Quantity: TypeAlias = float | str | HasUnit
#: One of these or several of them.
Quantities: TypeAlias = Quantity | Sequence[Quantity] | NDArray[np.float64]

if TYPE_CHECKING:

    class AsNumber:
        """A field of a class of values that is given as a quantity, and is a number."""

        def __get__(self, of: object, owner: type | None = None) -> float: ...
        def __set__(self, of: object, value: Quantity) -> None: ...

    class AsNumberOrNone:
        """The same of a field that may be left out."""

        def __get__(self, of: object, owner: type | None = None) -> float | None: ...
        def __set__(self, of: object, value: Quantity | None) -> None: ...


_Cells: TypeAlias = NDArray[np.float64]
#: A friction law of x, y, p, slip and dissipated energy: arrays with a number for each cell.
FrictionFunction: TypeAlias = Callable[[_Cells, _Cells, _Cells, _Cells, _Cells], ArrayLike]
#: A variable of a result: its dimensions, values and attributes.
Variable: TypeAlias = tuple[tuple[str, ...], NDArray[Any], dict[str, Any]]


@overload
def as_number(read: Quantity) -> float: ...
@overload
def as_number(read: Quantity | None) -> float | None: ...
def as_number(read: Any) -> Any:
    """A quantity within a function whose door has made it a number in SI: the same."""
    return read


def by_default(number: float | None) -> Any:
    """The default of a field of the type AsNumber."""
    return number
