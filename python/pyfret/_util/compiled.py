"""The compiled module refuses unknown arguments as the functions of Python do: with those it takes.

The module itself calls :func:`guard` when it is loaded, so that nothing stands outside.
"""

from __future__ import annotations

import functools
import inspect
import re
from collections.abc import Callable, Sequence
from types import BuiltinFunctionType, MethodDescriptorType
from typing import TYPE_CHECKING, Any

from pyfret._util.echo import abridge_error
from pyfret._util.keywords import check_places, unknown_keyword

if TYPE_CHECKING:
    from types import ModuleType

__all__ = ["guard"]

#: The class that a constructor gets.
CLASS = inspect.Parameter("cls", inspect.Parameter.POSITIONAL_ONLY)
#: Parameters that are given by name.
NAMED = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)


def guard(module: ModuleType, constructors: dict[type, Callable[..., Any]]) -> None:
    """Put the functions, methods and constructors of a module behind :func:`telling`.

    Parameters
    ----------
    module : module
        It changes in place.
    constructors : dict of type to callable
        What makes an object of a class, from the class and the arguments.
    """
    for name, of in list(vars(module).items()):
        if isinstance(of, BuiltinFunctionType):
            setattr(module, name, telling(of, name))
        elif isinstance(of, type) and not issubclass(of, BaseException):
            methods(of)
            members = [one for one in vars(of) if isinstance(getattr(of, one), of)]
            if of in constructors and of.__text_signature__ is not None:
                made_by(of, constructors[of])
            elif members:
                chosen_of(of, members)


def methods(of: type) -> None:
    """Put the methods of a class behind :func:`telling`."""
    for name, member in list(vars(of).items()):
        if name.startswith("_"):
            continue
        what = f"{of.__name__}.{name}"
        if isinstance(member, MethodDescriptorType):
            setattr(of, name, telling(member, what))
        elif isinstance(member, staticmethod):
            setattr(of, name, staticmethod(telling(member.__func__, what)))


def made_by(of: type, make: Callable[..., Any]) -> None:
    """Put the constructor of a class behind :func:`telling`."""
    own = inspect.signature(of)

    def __new__(cls: type, /, *values: Any, **given: Any) -> Any:  # noqa: N807
        return make(cls, *values, **given)

    __new__.__signature__ = own.replace(parameters=[CLASS, *own.parameters.values()])  # type: ignore[attr-defined]
    __new__.__qualname__ = f"{of.__qualname__}.__new__"
    __new__.__module__ = of.__module__
    of.__new__ = staticmethod(telling(__new__, of.__name__))  # type: ignore[method-assign]


def chosen_of(of: type, members: list[str]) -> None:
    """Let a class that has members alone, and no constructor, say so."""

    def __new__(cls: type, /, *_: Any, **__: Any) -> Any:  # noqa: N807
        every = ", ".join(f"{cls.__name__}.{name}" for name in members)
        raise TypeError(f"{cls.__name__} is not made: it is one of {every}")

    __new__.__signature__ = inspect.Signature([CLASS])  # type: ignore[attr-defined]
    __new__.__module__, __new__.__qualname__ = of.__module__, f"{of.__qualname__}.__new__"
    of.__new__ = staticmethod(__new__)  # type: ignore[method-assign]


def telling(call: Callable[..., Any], what: str) -> Callable[..., Any]:
    """A function whose refusal of an unknown keyword names those that are known."""

    @functools.wraps(call)
    def told(*values: Any, **given: Any) -> Any:
        try:
            return call(*values, **given)
        except (*WRONG_CLASSES, TypeError, ValueError) as error:
            refusal: Exception | None = None
            if isinstance(error, TypeError):
                refusal = refused(what, call, values, given)
            refusal = refusal or with_argument(error) or with_value(call, values, given, error)
            abridge_error(refusal or error)
            if refusal is None:
                raise
        raise refusal

    return told


#: Errors of values of a wrong class, and what they are raised as.
WRONG_CLASSES = (OverflowError, RecursionError, AttributeError)
#: The note of PyO3 on an argument.
NOTE = re.compile(r"while processing '(\w+)'")
#: Begin of a refusal that repeats the value.
VALUE = re.compile(r"[\"'\d(\[{<+-]|inf\b|nan\b|True\b|False\b|None\b")


def with_argument(error: Exception) -> Exception | None:
    """Return a refusal of PyO3 with the name of its argument in the text, from the note.

    Nothing where the error is none of an argument. An overflow is raised as a ValueError, a missing
    attribute and too deep a list as a TypeError.
    """
    notes = [NOTE.fullmatch(note) for note in getattr(error, "__notes__", ())]
    names = [note[1] for note in notes if note]
    if not names:
        return None
    text = str(error)
    for name in names:
        if not re.match(rf"{name}\b", text):
            text = f"{name} = {text}" if VALUE.match(text) else f"{name}: {text}"
    kind = type(error)
    if issubclass(kind, WRONG_CLASSES):
        kind = ValueError if issubclass(kind, OverflowError) else TypeError
    return kind(text).with_traceback(error.__traceback__)


def with_value(
    call: Callable[..., Any], values: Sequence[Any], keywords: dict[str, Any], error: Exception
) -> Exception | None:
    """Return a refusal that repeats a value with the name of its argument before it.

    Nothing where the text has the name already, or begins with no value of the call.
    """
    text = str(error)
    uncalled = NOT_CALLABLE.fullmatch(text)
    if ": must be" not in text and uncalled is None:
        return None
    try:
        arguments = inspect.signature(call).bind_partial(*values, **keywords).arguments
    except TypeError:
        return None
    if uncalled is not None and not any(map(callable, arguments.values())):
        for name, value in arguments.items():
            if type(value).__name__ == uncalled[1]:
                return TypeError(f"{name}: must be a function, not of the class {uncalled[1]}")
    for name, value in arguments.items():
        if not isinstance(value, REPEATED):
            continue
        shown = repr(value)[:SHOWN]
        if shown and text.startswith(shown):
            return type(error)(f"{name} = {text}").with_traceback(error.__traceback__)
    return None


#: Refusal of Python to call a value.
NOT_CALLABLE = re.compile(r"'(\w+)' object is not callable")
#: Classes of values that a refusal repeats.
REPEATED = (str, float, int, list, tuple, set, dict, bytes, type, BuiltinFunctionType)
#: Characters of a value that a refusal begins with.
SHOWN = 50


def refused(
    what: str, call: Callable[..., Any], values: Sequence[Any], given: dict[str, Any]
) -> TypeError | None:
    """Why a function does not take its arguments, if their names or their number are the cause."""
    parameters = list(inspect.signature(call).parameters.values())
    if not any(one.kind is one.VAR_KEYWORD for one in parameters):
        known = [one.name for one in parameters if one.kind in NAMED and one.name != "self"]
        refusal = unknown_keyword(what, given, known)
        if refusal is not None:
            return refusal
    return check_places(what, parameters, values)
