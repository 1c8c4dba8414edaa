"""Parts of a scene that are given again with some fields exchanged."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

from pyfret._util.attributes import missing_attribute

__all__ = ["Replaceable"]

T = TypeVar("T")


class Replaceable:
    """A part of a scene that can be given again with some of its fields exchanged."""

    def replace(self: T, **changes: Any) -> T:
        """Return the same part with some fields exchanged, named as in the constructor."""
        return replace(self, **changes)  # type: ignore[type-var]

    def __replace__(self: T, **changes: Any) -> T:
        """Return it for :func:`copy.replace`."""
        return replace(self, **changes)  # type: ignore[type-var]

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> NoReturn:
            """Refuse a name that it does not have, with the nearest one."""
            missing_attribute(self, name)
