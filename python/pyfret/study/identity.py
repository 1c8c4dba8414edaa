"""Checksums of functions from their code and everything that it refers to.

A name is not enough: a formula that was corrected, a constant beside it, an argument of
``functools.partial`` are other measures under the same name. ::

    def peak(result): ...

    peak.version = "2"  # optional: replaces the checksum
"""

from __future__ import annotations

import functools
import hashlib
import types
from collections.abc import Mapping, Sequence, Set
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np

__all__ = ["code_checksum"]

#: Levels of functions and values in one another that are followed.
DEEPEST = 40


class Unknown(Exception):
    """A value whose changes cannot be detected."""


def code_checksum(of: Any) -> str:
    """Return a checksum of the code of a function, equal in every process of one Python version.

    It covers the code without comments and the docstring, defaults, closures, arguments of
    ``functools.partial`` and the fields of an object that is called. It also covers the globals
    that the code names: values, and functions of the same module. An attribute ``version`` replaces
    all of it.

    Raises
    ------
    ValueError
        The function refers to an object without a checksum.
    """
    try:
        text = repr(value_parts(of, getattr(of, "__module__", None), ()))
    except Unknown as unknown:
        name = getattr(of, "__qualname__", type(of).__qualname__)
        raise ValueError(
            f"{name}: refers to {unknown}, whose changes a store cannot detect; give "
            f'it a version that you change yourself, {name}.version = "1"'
        ) from None
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def value_parts(of: Any, home: str | None, within: tuple[int, ...]) -> Any:
    """Convert a value to nested tuples of text; equal tuples mean equal values.

    Functions of the module named ``home`` are converted with the globals that they use, others
    by their code. ``within`` has the ids of the values that hold this one.
    """
    if id(of) in within:
        return "again"
    if len(within) > DEEPEST:
        raise Unknown(f"a {type(of).__name__}, {DEEPEST} levels down")
    deeper = (*within, id(of))

    def all_of(values: Any) -> tuple[Any, ...]:
        """Convert several values."""
        return tuple(value_parts(value, home, deeper) for value in values)

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
        return ("function", *function_parts(of, home, deeper))
    if isinstance(of, types.ModuleType):
        return ("module", of.__name__)
    if isinstance(of, (type, types.BuiltinFunctionType, np.ufunc)):
        return ("named", getattr(of, "__module__", ""), getattr(of, "__qualname__", str(of)))
    if isinstance(of, Mapping):
        return (
            "mapping",
            tuple(sorted((repr(k), value_parts(v, home, deeper)) for k, v in of.items())),
        )
    if isinstance(of, Set):
        return ("set", tuple(sorted(map(repr, all_of(of)))))
    if isinstance(of, Sequence):
        return (type(of).__name__, *all_of(of))
    return object_parts(of, home, deeper)


def function_parts(of: types.FunctionType, home: str | None, within: tuple[int, ...]) -> list[Any]:
    """Return the code of a function, its defaults and closure, and the globals that it names."""
    cells = [cell.cell_contents for cell in of.__closure__ or () if is_filled(cell)]
    parts_of_function = [
        code_parts(of.__code__),
        *(value_parts(v, home, within) for v in (of.__defaults__, cells)),
    ]
    parts_of_function.append(value_parts(of.__kwdefaults__ or {}, home, within))
    if of.__module__ != home:
        # Of another module, such as a library: its own code, not what that refers to.
        return [of.__module__, of.__qualname__, *parts_of_function]
    for name in sorted(global_names(of.__code__)):
        if name in of.__globals__:
            parts_of_function.append((name, value_parts(of.__globals__[name], home, within)))
    return parts_of_function


def is_filled(cell: types.CellType) -> bool:
    """Check that a cell of a closure is not empty."""
    try:
        return cell.cell_contents is not cell
    except ValueError:
        return False


def code_parts(code: types.CodeType) -> tuple[Any, ...]:
    """Return instructions and constants; a docstring, names of files and lines are left out."""
    consts = [code_parts(c) if isinstance(c, types.CodeType) else repr(c) for c in code.co_consts]
    if code.co_consts and isinstance(code.co_consts[0], str):
        # Where a docstring stands, or None without one.
        consts[0] = "" if code.co_flags & DOCUMENTED or code.co_name != "<lambda>" else consts[0]
    return (code.co_code.hex(), tuple(consts), code.co_names, code.co_varnames, code.co_freevars)


#: Flag of code with a docstring, from Python 3.13 on.
DOCUMENTED = 0x4000000


def global_names(code: types.CodeType) -> set[str]:
    """Return the names that code and nested code refer to."""
    inner = (c for c in code.co_consts if isinstance(c, types.CodeType))
    return set(code.co_names).union(*map(global_names, inner))


def object_parts(of: Any, home: str | None, within: tuple[int, ...]) -> tuple[Any, ...]:
    """Return the class of an object, the Python code of its call, and its state."""
    kind = type(of)
    parts_of_object: list[Any] = ["object", kind.__module__, kind.__qualname__]
    call = getattr(kind, "__call__", None)  # noqa: B004
    if isinstance(call, types.FunctionType) and kind.__module__.split(".")[0] != "pyfret":
        parts_of_object.append(value_parts(call, home, within))
    if is_dataclass(of):
        values: Any = {f.name: getattr(of, f.name) for f in fields(of)}
    else:
        try:
            values = of.__reduce_ex__(4)[1:3]
        except Exception:
            raise Unknown(f"a {kind.__qualname__}") from None
    return (*parts_of_object, value_parts(values, home, within))
