"""Errors of wrong arguments: of functions in Python and of compiled ones by one rule.

A refusal names its argument. A value of a wrong class is a TypeError, whatever the function that
received it raised.
"""

from __future__ import annotations

import functools
import inspect
import re
from collections.abc import Callable, Iterable, Mapping
from types import BuiltinFunctionType
from typing import Any, TypeVar

from pyfret._util.echo import abridge_error
from pyfret._util.keywords import unknown_keyword
from pyfret._util.other_calls import PARTIAL_SLIP

__all__ = ["refuse_clearly", "refuse_keywords"]

C = TypeVar("C", bound=Callable[..., Any])

#: Errors that a value of a wrong class causes.
WRONG_CLASSES = (OverflowError, RecursionError, AttributeError)
#: The note of PyO3 on an argument.
NOTE = re.compile(r"while processing '(\w+)'")
#: Begin of a refusal that repeats the value.
VALUE = re.compile(r"[\"'\d(\[{<+-]|inf\b|nan\b|True\b|False\b|None\b")
#: Refusal of Python to call a function without a required argument.
MISSING = re.compile(
    r"(\w+)\(\) missing \d+ required (?:keyword|keyword-only|positional) arguments?: (.+)$"
)
#: Refusal of Python to call a value.
NOT_CALLABLE = re.compile(r"'(\w+)' object is not callable")
#: Refusal of Python to go through a value.
NOT_ITERABLE = re.compile(r"'(\w+)' object is not iterable")
#: Classes of values that a refusal repeats.
REPEATED = (str, float, int, list, tuple, set, dict, bytes, type, BuiltinFunctionType)
#: Characters of a value that a refusal begins with.
SHOWN = 50
#: Ends of refusals of calls without a required argument, by the functions.
EXAMPLES = {
    "CattaneoMindlin": f", such as {PARTIAL_SLIP}",
    "load_factors": ', such as result.load_factors("Ti-6Al-4V")',
    "first_yield": '; a result has it in result.load_factors("Ti-6Al-4V").least("von_mises")',
    "life": ', such as result.life("Ti-6Al-4V")',
    "arrest": ', such as cracks.arrest("Al 7075")',
}


def refuse_clearly(
    call: Callable[..., Any],
    name: str,
    names: Callable[[], list[str]],
    refuse_call: Callable[[tuple[Any, ...], dict[str, Any]], Exception | None],
) -> Callable[..., Any]:
    """Return a function that raises its errors of arguments with their names.

    Parameters
    ----------
    call : callable
        Function.
    name : str
        Its name in messages, with its class.
    names : callable
        Its parameters in their order.
    refuse_call : callable
        From a call that raised a TypeError: the refusal of its keywords or of their number.
    """

    @functools.wraps(call)
    def call_refusing(*values: Any, **keywords: Any) -> Any:
        """Call the function; its refusals name the argument."""
        try:
            return call(*values, **keywords)
        except (*WRONG_CLASSES, TypeError, ValueError, LookupError, OSError) as error:
            refusal = refuse_call(values, keywords) if isinstance(error, TypeError) else None
            if refusal is None:
                arguments = dict(zip(names(), values, strict=False)) | keywords
                refusal = name_missing(call, name, error) or explain(name, arguments, error)
            abridge_error(refusal or error)
            if refusal is None:
                raise
        raise refusal

    return call_refusing


def refuse_keywords(method: C) -> C:
    """Return a method whose refusal of an unknown keyword has the class and the right keywords.

    The attribute ``keyword_hint`` of the object, if there is one, is the end of the refusal.
    """
    names = [p.name for p in inspect.signature(method).parameters.values()][1:]

    @functools.wraps(method)
    def call_checked(self: Any, *values: Any, **keywords: Any) -> Any:
        """Call the method; the refusal of an unknown keyword names the right ones."""
        call = f"{type(self).__name__}.{method.__name__}"
        refusal = unknown_keyword(call, keywords, names)
        if refusal is not None:
            raise TypeError(f"{refusal}{getattr(type(self), 'keyword_hint', '')}")
        return method(self, *values, **keywords)

    return call_checked  # type: ignore[return-value]


def name_missing(call: Callable[..., Any], name: str, error: Exception) -> TypeError | None:
    """Return the refusal of a call without a required argument, with what the argument is."""
    missing = MISSING.search(str(error)) if isinstance(error, TypeError) else None
    if missing is None or missing[1] != getattr(call, "__name__", ""):
        return None
    names = re.findall(r"'(\w+)'", missing[2])
    documentation = getattr(call, "__doc__", None) or ""
    described = []
    for parameter in names:
        entry = re.search(
            rf"^ *(?:\w+, )*{parameter}\b[\w, ]*(?: : .*)?\n( +)(\S.*(?:\n\1\S.*)*)",
            documentation,
            re.M,
        )
        described.append(f"{parameter} ({first_clause(entry[2])})" if entry else parameter)
    example = EXAMPLES.get(name.rpartition(".")[2], "")
    return TypeError(f"{name} needs {' and '.join(described)}{example}")


def first_clause(text: str) -> str:
    """Return the first sentence of a text, without what follows a colon and without an example."""
    plain = re.sub(r":\w+:(`\w+`)", r"\1", " ".join(text.split()))
    sentence = re.split(r"[.:;](?:\s|$)", plain, maxsplit=1)[0]
    return re.split(r",? such as\b", sentence, maxsplit=1)[0]


def explain(name: str, arguments: Mapping[str, Any], error: Exception) -> Exception | None:
    """Return the refusal that names the argument an error is about; nothing where it is unknown."""
    refusal = name_argument(error) or name_class(name, arguments, error)
    refusal = refusal or name_value(arguments, error)
    return refusal and refusal.with_traceback(error.__traceback__)


def name_argument(error: Exception) -> Exception | None:
    """Return a refusal of PyO3 with the name of its argument in the text, from the note.

    An overflow is raised as a ValueError, a missing attribute and too deep a list as a TypeError.
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
    return kind(text)


def name_class(name: str, arguments: Mapping[str, Any], error: Exception) -> TypeError | None:
    """Return the refusal of arguments of a wrong class."""
    uncalled = NOT_CALLABLE.fullmatch(str(error))
    if uncalled is not None and not any(map(callable, arguments.values())):
        for key, value in arguments.items():
            if type(value).__name__ == uncalled[1]:
                return TypeError(f"{key}: must be a function, not of the class {uncalled[1]}")
    unlisted = NOT_ITERABLE.fullmatch(str(error))
    if unlisted is not None:
        for key, value in arguments.items():
            if type(value).__name__ == unlisted[1] and not isinstance(value, Iterable):
                return TypeError(f"{key}: must be a sequence, not of the class {unlisted[1]}")
    wrong = [key for key, value in arguments.items() if is_of_wrong_class(value, error)]
    if not wrong:
        return None
    classes = ", ".join(f"{key} is a {type(arguments[key]).__name__}" for key in wrong)
    return TypeError(f"{name}: {classes}, which it does not take")


def is_of_wrong_class(value: object, error: Exception) -> bool:
    """Check that an error is about the class of a value, or about its endless nesting.

    An AttributeError is where a function took the value for another class: ``(3).dims``. The error
    then holds the value in `obj`.
    """
    if isinstance(error, RecursionError):
        return isinstance(value, (list, tuple, dict))
    if not isinstance(error, AttributeError) or error.obj is not value:
        return False
    # An error that a function raises itself has no object.
    return value is not None or "NoneType" in str(error)


def name_value(arguments: Mapping[str, Any], error: Exception) -> Exception | None:
    """Return a refusal that repeats a value with the name of its argument before it."""
    text = str(error)
    if ": must be" not in text or not isinstance(error, (TypeError, ValueError)):
        return None
    for key, value in arguments.items():
        if isinstance(value, REPEATED) and text.startswith(begin(value)):
            return type(error)(f"{key} = {text}")
    return None


def begin(value: object) -> str:
    """Return the first characters of a value as it is written, or ``?`` where it has no end."""
    try:
        return repr(value)[:SHOWN]
    except RecursionError:
        return "?"
