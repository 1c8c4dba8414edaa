"""The compiled module refuses wrong arguments as the functions of Python do.

The module itself calls :func:`guard` when it is loaded, so that nothing stands outside.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from types import BuiltinFunctionType, MethodDescriptorType
from typing import TYPE_CHECKING, Any

from pyfret._util.keywords import check_places, unknown_keyword
from pyfret._util.refusals import refuse_clearly

if TYPE_CHECKING:
    from types import ModuleType

__all__ = ["guard"]

#: The class that a constructor gets.
CLASS = inspect.Parameter("cls", inspect.Parameter.POSITIONAL_ONLY)
#: Parameters that are given by name.
NAMED = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)


def guard(module: ModuleType, constructors: dict[type, Callable[..., Any]]) -> None:
    """Put the functions, methods and constructors of a module behind :func:`refusing`.

    Parameters
    ----------
    module : module
        It changes in place.
    constructors : dict of type to callable
        What makes an object of a class, from the class and the arguments.
    """
    for name, member in list(vars(module).items()):
        if isinstance(member, BuiltinFunctionType):
            setattr(module, name, refusing(member, name))
        elif isinstance(member, type) and not issubclass(member, BaseException):
            guard_methods(member)
            members = [key for key in vars(member) if isinstance(getattr(member, key), member)]
            if member in constructors and member.__text_signature__ is not None:
                guard_constructor(member, constructors[member])
            elif members:
                refuse_construction(member, members)


def guard_methods(kind: type) -> None:
    """Put the methods of a class behind :func:`refusing`."""
    for key, member in list(vars(kind).items()):
        if key.startswith("_"):
            continue
        name = f"{kind.__name__}.{key}"
        if isinstance(member, MethodDescriptorType):
            setattr(kind, key, refusing(member, name))
        elif isinstance(member, staticmethod):
            setattr(kind, key, staticmethod(refusing(member.__func__, name)))


def guard_constructor(kind: type, make: Callable[..., Any]) -> None:
    """Put the constructor of a class behind :func:`refusing`."""
    signature = inspect.signature(kind)

    def __new__(cls: type, /, *values: Any, **keywords: Any) -> Any:  # noqa: N807
        return make(cls, *values, **keywords)

    __new__.__signature__ = signature.replace(parameters=[CLASS, *signature.parameters.values()])  # type: ignore[attr-defined]
    __new__.__qualname__ = f"{kind.__qualname__}.__new__"
    __new__.__module__ = kind.__module__
    kind.__new__ = staticmethod(refusing(__new__, kind.__name__))  # type: ignore[method-assign]


def refuse_construction(kind: type, members: list[str]) -> None:
    """Let the constructor of a class that has members alone name these."""

    def __new__(cls: type, /, *_: Any, **__: Any) -> Any:  # noqa: N807
        every = ", ".join(f"{cls.__name__}.{name}" for name in members)
        raise TypeError(f"{cls.__name__} is not made: it is one of {every}")

    __new__.__signature__ = inspect.Signature([CLASS])  # type: ignore[attr-defined]
    __new__.__module__, __new__.__qualname__ = kind.__module__, f"{kind.__qualname__}.__new__"
    kind.__new__ = staticmethod(__new__)  # type: ignore[method-assign]


def refusing(call: Callable[..., Any], name: str) -> Callable[..., Any]:
    """Return a function whose refusal of an unknown keyword names the nearest known one."""

    def parameters() -> list[inspect.Parameter]:
        return list(inspect.signature(call).parameters.values())

    return refuse_clearly(
        call,
        name,
        lambda: [parameter.name for parameter in parameters()],
        lambda values, keywords: refuse_call(name, parameters(), values, keywords),
    )


def refuse_call(
    name: str, parameters: list[inspect.Parameter], values: Sequence[Any], keywords: dict[str, Any]
) -> TypeError | None:
    """Return the refusal of arguments whose names or whose number are wrong."""
    if not any(parameter.kind is parameter.VAR_KEYWORD for parameter in parameters):
        named = (parameter.name for parameter in parameters if parameter.kind in NAMED)
        refusal = unknown_keyword(name, keywords, [key for key in named if key != "self"])
        if refusal is not None:
            return refusal
    return check_places(name, parameters, values)
