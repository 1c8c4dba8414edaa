"""Refusals of keywords that a function does not take, with the nearest one that it takes."""

from __future__ import annotations

import inspect
from difflib import get_close_matches
from typing import TYPE_CHECKING, Any

from pyfret._util.names import meant
from pyfret._util.other_calls import WRITTEN_ELSEWHERE

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

__all__ = [
    "accepted_keywords",
    "check_places",
    "nearest_names",
    "refuse_unknown",
    "unknown_keyword",
]

#: Parameters that are given by position.
POSITIONAL = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)


#: Characters of a name that are compared with others: the time grows with their square.
COMPARED = 64


def nearest_names(name: str, known: Iterable[str], most: int) -> list[str]:
    """Return the known names that are synonyms of a name, or else the most similar ones."""
    name = name[:COMPARED]
    cases: dict[str, list[str]] = {}
    for candidate in known:
        cases.setdefault(candidate.lower(), []).append(candidate)
    # Of names that differ in their case alone, such as a class and a function, the one that begins
    # as the name comes first.
    similar = [
        candidate
        for match in get_close_matches(name.lower(), cases, n=most)
        for candidate in sorted(cases[match], key=lambda case: case[:1] != name[:1])
    ]
    return (meant(name, [c for group in cases.values() for c in group]) or similar)[:most]


def unknown_keyword(call: str, keywords: Iterable[str], known: Sequence[str]) -> TypeError | None:
    """Return the refusal of the first keyword that is not known, if there is one.

    Parameters
    ----------
    call : str
        Function, with its class: ``"Result.life"``.
    keywords, known : names
        Keywords of the call, and those that the function takes.
    """
    for name in keywords:
        if name not in known:
            if elsewhere := WRITTEN_ELSEWHERE.get(call, {}).get(name):
                return TypeError(f"{call} has no argument {name!r}: {elsewhere}")
            near = nearest_names(name, known, 1)
            names = ", ".join(known) or "none"
            hint = f"the nearest is {near[0]!r} (of {names})" if near else f"it takes {names}"
            return TypeError(f"{call} has no argument {name!r:.200}: {hint}")
    return None


def refuse_unknown(call: str, keywords: Iterable[str], known: Sequence[str]) -> None:
    """Refuse a keyword that is not known.

    Raises
    ------
    TypeError
        The message has the nearest keyword and all others.
    """
    refusal = unknown_keyword(call, keywords, known)
    if refusal is not None:
        raise refusal


def accepted_keywords(function: Callable[..., Any], names: Sequence[str]) -> list[str]:
    """Return the names that a user's function takes by keyword, beside its five first arguments."""
    try:
        parameters = list(inspect.signature(function).parameters.values())
    except (TypeError, ValueError):  # a function of C without a signature
        return []
    if any(p.kind is p.VAR_KEYWORD for p in parameters):
        return list(names)
    positional = [p for p in parameters if p.kind in POSITIONAL]
    taken = {p.name for p in positional[5:] if p.kind is not p.POSITIONAL_ONLY}
    taken |= {p.name for p in parameters if p.kind is p.KEYWORD_ONLY}
    return [name for name in names if name in taken]


def check_places(
    call: str, parameters: Iterable[inspect.Parameter], values: Sequence[Any]
) -> TypeError | None:
    """Return the refusal of positional values for keyword parameters, if there are any."""
    parameters = list(parameters)
    positional = [p.name for p in parameters if p.kind in POSITIONAL]
    keywords = [p.name for p in parameters if p.kind is p.KEYWORD_ONLY]
    variadic = any(p.kind is p.VAR_POSITIONAL for p in parameters)
    if variadic or not keywords or len(values) <= len(positional):
        return None
    first = "".join(f"{name}, " for name in positional if name not in ("self", "cls"))
    example = ", ".join(f"{name}=..." for name in keywords)
    return TypeError(f"{call} takes arguments by name, {call}({first}{example})")
