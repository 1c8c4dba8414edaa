"""Parts of a scene: frozen dataclasses that are checked when they are made."""

from __future__ import annotations

import functools
from dataclasses import dataclass, fields, replace
from typing import Any, TypeVar

from pyfret._util.door import dataclass_transform
from pyfret._util.guesses import refuse_unknown

__all__ = ["part"]

T = TypeVar("T")


@dataclass_transform(kw_only_default=True, frozen_default=True)
def part(cls: type[T]) -> type[T]:
    """A frozen dataclass of keywords; one that is unknown is refused with the nearest."""
    made = dataclass(frozen=True, kw_only=True)(cls)
    known = [field.name for field in fields(made)]  # type: ignore[arg-type]
    init = made.__init__

    @functools.wraps(init)
    def made_of_known(self: T, *values: Any, **given: Any) -> None:
        refuse_unknown(cls.__name__, cls, given, known)
        init(self, *values, **given)

    made.__init__ = made_of_known  # type: ignore[assignment]
    return made


class Replaceable:
    """What can be given with some of its parts exchanged."""

    def replace(self: T, **changes: Any) -> T:
        """The same with some of its parts exchanged, named as in the constructor."""
        return replace(self, **changes)  # type: ignore[type-var]

    def __replace__(self: T, **changes: Any) -> T:
        """For :func:`copy.replace`."""
        return replace(self, **changes)  # type: ignore[type-var]
