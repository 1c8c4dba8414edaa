"""What dataclasses need whose fields are arrays: comparison and a short text."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import fields
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._util.attributes import missing_attribute

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

    Base = DataclassInstance
else:
    Base = object

__all__ = ["HoldsArrays"]

#: Numbers of an array, or entries of a list, that are shown.
SHOWN = 6


class HoldsArrays(Base):
    """A dataclass with arrays, equal where all of its fields are, NaN to NaN; no key of a dict.

    Its decorator is ``@dataclass(frozen=True, eq=False, repr=False)``.
    """

    __hash__ = None  # type: ignore[assignment]

    def __eq__(self, other: object) -> bool:
        """Whether the other one is of the same class with the same fields."""
        if type(other) is not type(self):
            return NotImplemented
        names = [attribute.name for attribute in fields(self) if attribute.compare]
        return all(alike(getattr(self, name), getattr(other, name)) for name in names)

    def __repr__(self) -> str:
        """Give the fields, long ones by their size."""
        shown = (
            f"{attribute.name}={short(getattr(self, attribute.name))}"
            for attribute in fields(self)
            if attribute.repr
        )
        return f"{type(self).__name__}({', '.join(shown)})"


#: Words for what a scene has to be fitted for.
FITTED = {
    name: 'it follows from a fit, fret.fit(scene, data, unknown={"mu": (0.1, 1.2)})'
    for name in ("mu", "friction", "friction_coefficient", "cof", "stiffness", "k")
}


def refuse_attribute(self: Any, name: str) -> Any:
    """Refuse a name that an object does not have, with the nearest one.

    An object that was fitted leads to the unknowns that it determined.
    """
    if name.startswith("_"):
        missing_attribute(self, name)
    unknowns = vars(self).get("known")
    if unknowns is None:
        missing_attribute(self, name, FITTED)
    values = {
        key.rpartition(".")[2]: f"its value is known[{key!r}].value" for key in reversed(unknowns)
    }
    missing_attribute(self, name, values)


if not TYPE_CHECKING:
    # A method within the class would let type checkers take any name.
    HoldsArrays.__getattr__ = refuse_attribute


def alike(one: Any, other: Any) -> bool:
    """Return whether two fields are equal; arrays, and lists of them, entry by entry."""
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        numbers = np.asarray(one).dtype.kind == "f" and np.asarray(other).dtype.kind == "f"
        return np.array_equal(one, other, equal_nan=numbers)
    if isinstance(one, Mapping) and isinstance(other, Mapping):
        return one.keys() == other.keys() and all(alike(one[key], other[key]) for key in one)
    if isinstance(one, (list, tuple)) and isinstance(other, (list, tuple)):
        return len(one) == len(other) and all(map(alike, one, other))
    return bool(one == other)


def short(value: Any) -> str:
    """Return a field as a short text."""
    if isinstance(value, np.ndarray) and value.size > SHOWN:
        return f"<array of {' x '.join(map(str, value.shape))}>"
    if isinstance(value, Sequence) and not isinstance(value, str) and len(value) > SHOWN:
        return f"<{type(value).__name__} of {len(value)}>"
    return repr(value)
