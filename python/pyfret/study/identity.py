"""What tells a function from another one of its name: its code, and what it refers to.

A name is not enough: a formula that was corrected, a constant beside it, an argument of
``functools.partial`` are other measures under the same name. ::

    def peak(result): ...

    peak.version = "2"  # optional: counts in place of all of this
"""

from __future__ import annotations

import functools
import hashlib
import types
from collections.abc import Mapping, Sequence, Set
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np

__all__ = ["identity"]

#: Levels of functions and values in one another that are followed.
DEEPEST = 40


class Unknown(Exception):
    """A value of which nothing tells whether it has changed."""


def identity(of: Any) -> str:
    """A checksum of what a function does, equal in every process of one version of Python.

    It covers the code without comments and the docstring, defaults, closures, arguments of
    ``functools.partial`` and the fields of an object that is called. It also covers the globals
    that the code names: values, and functions of the same module. An attribute ``version`` replaces
    all of it.

    Raises
    ------
    ValueError
        The function refers to something that cannot be told from another one.
    """
    try:
        text = repr(parts(of, getattr(of, "__module__", None), ()))
    except Unknown as unknown:
        name = getattr(of, "__qualname__", type(of).__qualname__)
        raise ValueError(
            f"{name}: refers to {unknown}, and no store can tell whether that has changed; give "
            f'it a version that you change yourself, {name}.version = "1"'
        ) from None
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def parts(of: Any, home: str | None, within: tuple[int, ...]) -> Any:
    """A value as nested tuples of text, of which equal ones mean the same."""
    if id(of) in within:
        return "again"
    if len(within) > DEEPEST:
        raise Unknown(f"a {type(of).__name__}, {DEEPEST} levels down")
    deeper = (*within, id(of))

    def all_of(values: Any) -> tuple[Any, ...]:
        return tuple(parts(value, home, deeper) for value in values)

    if (version := getattr(of, "version", None)) is not None and callable(of):
        return ("version", str(version))
    if of is None or isinstance(of, (bool, int, float, complex, str, bytes)):
        return (type(of).__name__, repr(of))
    if isinstance(of, np.generic | np.ndarray):
        array = np.ascontiguousarray(of)
        if array.dtype.hasobject:
            return ("array", array.shape, all_of(array.ravel().tolist()))
        digest = hashlib.sha256(array.tobytes()).hexdigest()
        return ("array", array.dtype.str, array.shape, digest)
    if isinstance(of, functools.partial):
        return ("partial", *all_of((of.func, of.args, dict(of.keywords))))
    if isinstance(of, types.MethodType):
        return ("method", *all_of((of.__func__, of.__self__)))
    if isinstance(of, types.FunctionType):
        return ("function", *of_function(of, home, deeper))
    if isinstance(of, types.ModuleType):
        return ("module", of.__name__)
    if isinstance(of, (type, types.BuiltinFunctionType, np.ufunc)):
        return ("named", getattr(of, "__module__", ""), getattr(of, "__qualname__", str(of)))
    if isinstance(of, Mapping):
        return ("mapping", tuple(sorted((repr(k), parts(v, home, deeper)) for k, v in of.items())))
    if isinstance(of, Set):
        return ("set", tuple(sorted(map(repr, all_of(of)))))
    if isinstance(of, Sequence):
        return (type(of).__name__, *all_of(of))
    return of_object(of, home, deeper)


def of_function(of: types.FunctionType, home: str | None, within: tuple[int, ...]) -> list[Any]:
    """The code of a function, its defaults and closure, and the globals that it names."""
    cells = [cell.cell_contents for cell in of.__closure__ or () if filled(cell)]
    found = [of_code(of.__code__), *(parts(v, home, within) for v in (of.__defaults__, cells))]
    found.append(parts(of.__kwdefaults__ or {}, home, within))
    if of.__module__ != home:
        # Of another module, such as a library: its own code, not what that refers to.
        return [of.__module__, of.__qualname__, *found]
    for name in sorted(names_of(of.__code__)):
        if name in of.__globals__:
            found.append((name, parts(of.__globals__[name], home, within)))
    return found


def filled(cell: types.CellType) -> bool:
    """Whether a cell of a closure holds something."""
    try:
        return cell.cell_contents is not cell
    except ValueError:
        return False


def of_code(code: types.CodeType) -> tuple[Any, ...]:
    """Instructions and constants; a docstring, names of files and lines are left out."""
    consts = [of_code(c) if isinstance(c, types.CodeType) else repr(c) for c in code.co_consts]
    if code.co_consts and isinstance(code.co_consts[0], str):
        # Where a docstring stands, or None without one.
        consts[0] = "" if code.co_flags & DOCUMENTED or code.co_name != "<lambda>" else consts[0]
    return (code.co_code.hex(), tuple(consts), code.co_names, code.co_varnames, code.co_freevars)


#: Flag of code with a docstring, from Python 3.13 on.
DOCUMENTED = 0x4000000


def names_of(code: types.CodeType) -> set[str]:
    """Names that code and the code within it ask for."""
    inner = (c for c in code.co_consts if isinstance(c, types.CodeType))
    return set(code.co_names).union(*map(names_of, inner))


def of_object(of: Any, home: str | None, within: tuple[int, ...]) -> tuple[Any, ...]:
    """An object by its class, by the code that calls it where that is of Python, and its state."""
    kind = type(of)
    found: list[Any] = ["object", kind.__module__, kind.__qualname__]
    call = getattr(kind, "__call__", None)  # noqa: B004
    if isinstance(call, types.FunctionType) and kind.__module__.split(".")[0] != "pyfret":
        found.append(parts(call, home, within))
    if is_dataclass(of):
        values: Any = {f.name: getattr(of, f.name) for f in fields(of)}
    else:
        try:
            values = of.__reduce_ex__(4)[1:3]
        except Exception:
            raise Unknown(f"a {kind.__qualname__}") from None
    return (*found, parts(values, home, within))
