"""Which public functions take a keyword, or have a name: those of the object at hand, or others."""

from __future__ import annotations

import ast
import functools
import inspect
import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

__all__ = ["functions", "keywords", "takers"]

#: Options whose names a class has, ``**options: Unpack[Options]``.
UNPACKED = re.compile(r"Unpack\[([\w.]+)\]")
#: What pages call an object of a class, where it is not the name of the class.
CALLED = {"LoadPath": "path", "WearResult": "worn"}
#: Names of classes in an annotation.
CLASS = re.compile(r"\b[A-Z]\w+")
#: Most functions that are named.
MOST = 3


@functools.cache
def keywords(annotation: str) -> tuple[str, ...] | None:
    """The names that ``**options`` of an annotation take; None where these are any."""
    found = UNPACKED.fullmatch(annotation)
    if found is None:
        return None
    name = found[1].rpartition(".")[2]
    own = [m for module, m in list(sys.modules.items()) if module.split(".")[0] == "pyfret"]
    of = next((vars(module)[name] for module in own if name in vars(module)), None)
    return None if of is None else tuple(of.__annotations__)


def takers(what: str, call: Callable[..., Any], keyword: str, *, anywhere: bool) -> list[str]:
    """Public functions that take a keyword, as they are called, three at most.

    The methods of what a function gives come first, then those of its own class, then those of its
    arguments. Only where `anywhere` says so, and where there are few, all public functions follow.

    Parameters
    ----------
    what : str
        The function that was called, with its class: ``"Result.life"``.
    call : callable
        The function itself.
    keyword : str
        The keyword that it does not take.
    """
    types = {k: CLASS.findall(str(v)) for k, v in getattr(call, "__annotations__", {}).items()}
    owner, _, own = what.rpartition(".")
    given, arguments = types.pop("return", []), [of for each in types.values() for of in each]
    for name in (*given[:1], owner or what, *dict.fromkeys(arguments)):
        found = [
            told
            for of in classes_named(name)
            for told, method in members(of)
            if told.rpartition(".")[2] != own and keyword in names(method)
        ]
        if found:
            return list(dict.fromkeys(found))[:MOST]
    found = [told for told, of in public() if keyword in names(of)] if anywhere else []
    found = list(dict.fromkeys(found))
    of_package = [told for told in found if "." not in told]
    return next((few for few in (found, of_package) if 0 < len(few) <= MOST), [])


@functools.cache
def figures() -> tuple[str, ...]:
    """Names of the figures, read without importing matplotlib."""
    text = (Path(__file__).parents[1] / "plot" / "__init__.py").read_text(encoding="utf-8")
    lists = [of for of in ast.parse(text).body if isinstance(of, ast.Assign)]
    named = next(of for of in lists if ast.unparse(of.targets[0]) == "__all__")
    return tuple(ast.literal_eval(named.value))


def functions(name: str) -> list[str]:
    """The functions of the package of a name, as they are called with what they need."""
    found = [f"fret.plot.{name}(...)"] if name in figures() else []
    for told, of in exported():
        module, _, last = told.rpartition(".")
        if last == name and module != "plot" and not isinstance(of, type):
            needed = [
                one.name
                for one in inspect.signature(of).parameters.values()
                if one.default is one.empty and one.kind not in (one.VAR_KEYWORD, one.KEYWORD_ONLY)
            ]
            found.append(f"fret.{told}({', '.join(needed)})")
    return found


def names(call: Callable[..., Any]) -> list[str]:
    """The keywords that a function takes, those of its options included."""
    try:
        parameters = inspect.signature(call).parameters.values()
    except (TypeError, ValueError):
        return []
    found = [
        one.name for one in parameters if one.kind in (one.POSITIONAL_OR_KEYWORD, one.KEYWORD_ONLY)
    ]
    for one in parameters:
        if one.kind is one.VAR_KEYWORD:
            found += keywords(str(one.annotation)) or ()
    return found


def classes_named(name: str) -> list[type]:
    """The public classes of a name, or those that a class of this name is behind."""
    return [
        of for of in classes() if name in {one.__name__ for one in of.__mro__ if one is not object}
    ]


def members(of: type) -> Iterator[tuple[str, Callable[..., Any]]]:
    """The public methods of a class, and its constructor by the name that it is reached by."""
    yield from methods(of)
    yield from ((name, one) for name, one in exported() if one is of)


def methods(of: type) -> Iterator[tuple[str, Callable[..., Any]]]:
    """The public methods of a class, as they are called."""
    for name in (one for one in dir(of) if not one.startswith("_")):
        member = getattr(of, name)
        if callable(member) and not isinstance(member, type):
            made = isinstance(inspect.getattr_static(of, name), (staticmethod, classmethod))
            yield f"{of.__name__ if made else called(of)}.{name}", member


def called(of: type) -> str:
    """What pages call an object of a class."""
    return CALLED.get(of.__name__, re.sub(r"(?<=[a-z])(?=[A-Z])", "_", of.__name__).lower())


@functools.cache
def classes() -> tuple[type, ...]:
    """All public classes."""
    return tuple(dict.fromkeys(of for _, of in exported() if isinstance(of, type)))


@functools.cache
def public() -> tuple[tuple[str, Callable[..., Any]], ...]:
    """All public functions, constructors and methods, as they are called."""
    found: list[tuple[str, Callable[..., Any]]] = []
    for name, of in exported():
        found.append((name, of))
        if isinstance(of, type):
            found += methods(of)
    return tuple(found)


@functools.cache
def exported() -> tuple[tuple[str, Any], ...]:
    """The callables that the modules of the package list, with the names to reach them by."""
    found: list[tuple[str, Any]] = []
    seen: set[int] = set()

    def walk(module: Any, prefix: str) -> None:
        seen.add(id(module))
        for name in module.__all__:
            of = vars(module).get(name)
            if inspect.ismodule(of):
                if id(of) not in seen:
                    walk(of, f"{prefix}{name}.")
            elif callable(of) and not (isinstance(of, type) and issubclass(of, BaseException)):
                found.append((f"{prefix}{name}", of))

    walk(sys.modules["pyfret"], "")
    return tuple(found)
