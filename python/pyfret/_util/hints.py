"""Types of parameters, read from annotations with names that a module may not have imported."""

from __future__ import annotations

import builtins
import inspect
import types
import typing
from collections import abc
from collections.abc import Callable
from typing import Annotated, Any

from pyfret import _core

__all__ = ["Named", "Options", "members", "read_hints"]


class Named(type):
    """Class of the classes that a module imports for type checkers alone."""

    def __getattr__(cls, name: str) -> Any:
        """Return a class of a module that is not imported."""
        if name.startswith("_"):
            raise AttributeError(name)
        return Named(name, (), {})

    def __getitem__(cls, _: Any) -> Any:
        """Return a generic class for any argument."""
        return cls


class Options:
    """Keywords ``**options: Unpack[Options]``: a typed dictionary has their types."""

    def __class_getitem__(cls, options: Any) -> Any:
        """Return the dictionary, marked."""
        return Annotated[options, cls]


class Names(dict[str, Any]):
    """Names in the annotations of a module, whether it has imported them or not."""

    def __init__(self, module: dict[str, Any], common: dict[str, Any]) -> None:
        self._namespaces = (module, common, vars(_core), vars(abc), vars(builtins))

    def __missing__(self, name: str) -> Any:
        """Look the name up; a class that no module has imported is known by its name alone."""
        if name == "Unpack":
            return Options
        for names in self._namespaces:
            # An alias that is a text has names of other modules.
            if name in names and not isinstance(names[name], str):
                return names[name]
        return Named(name, (), {})


def read_hints(call: Callable[..., Any], common: dict[str, Any]) -> dict[str, Any]:
    """Return the types of the parameters of a function, or of the fields of a dataclass.

    `common` has names of types that every module may use.
    """
    if not isinstance(call, type):
        names = Names(getattr(inspect.unwrap(call), "__globals__", {}), common)
        return typing.get_type_hints(call, localns=names, include_extras=True)
    hints: dict[str, Any] = {}
    for base in reversed(call.__mro__):
        names = Names(vars(inspect.getmodule(base)), common)
        own_hints = typing.get_type_hints(base, localns=names, include_extras=True)
        hints |= {name: own_hints[name] for name in vars(base).get("__annotations__", ())}
    return hints


def members(hint: Any) -> list[Any]:
    """Return the members of a union, or the type itself."""
    if typing.get_origin(hint) in (typing.Union, types.UnionType):
        return [member for part in typing.get_args(hint) for member in members(part)]
    return [hint]
