"""Doubts of numbers that are allowed and hardly meant: nearly always their unit is another one.

The crate ``plausible`` holds a table of quantities with a row for each known key. A key is the last
name of a key of a scene file, or a parameter with the function or class that takes it.
"""

from __future__ import annotations

import math
import sys
import warnings
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from pyfret import _core

__all__ = ["SceneWarning", "doubt_numbers", "doubts_of", "warn"]


class SceneWarning(UserWarning):
    """A number of a scene is allowed but hardly meant; the message has it as it was read."""


def warn(text: str) -> None:
    """Warn of a doubt at the line of the user's program that has called pyfret."""
    level, frame = 2, sys._getframe(1)
    while frame.f_back and str(frame.f_globals.get("__name__")).partition(".")[0] == "pyfret":
        level, frame = level + 1, frame.f_back
    warnings.warn(text, SceneWarning, stacklevel=level)


def doubts_of(of: str, /, **numbers: Any) -> list[str]:
    """Return warnings on numbers by their names, parameters of `of` or keys of a scene file.

    In lists each number counts, in arrays the largest, in tables the largest of the last column.
    Other values are left out.
    """
    warnings = []
    for name, given in numbers.items():
        for value in sizes(given):
            doubt = _core.doubt(f"{of}.{name}" if of else name, name, value)
            if doubt is not None and doubt not in warnings:
                warnings.append(doubt)
    return warnings


def doubt_numbers(of: str, /, **numbers: Any) -> None:
    """Warn of the doubts of numbers, :func:`doubts_of`."""
    for doubt in doubts_of(of, **numbers):
        warn(doubt)


def is_row(given: Any) -> bool:
    """Return whether it is a row of two numbers or more."""
    return (
        isinstance(given, (list, tuple))
        and len(given) > 1
        and all(isinstance(value, (int, float, str)) for value in given)
    )


def sizes(given: Any) -> Iterator[float]:
    """Yield the numbers of a value that are judged: see :func:`doubts_of`."""
    if isinstance(given, (bool, str, bytes)) or given is None:
        return
    if isinstance(given, (list, tuple)):
        if given and all(is_row(row) for row in given):
            # A table: its last column is the quantity, the others are places.
            yield max((abs(size) for row in given for size in sizes(row[-1])), default=0.0)
            return
        for value in given:
            yield from sizes(value)
        return
    if isinstance(given, (int, float, np.number)):
        if math.isfinite(given):
            yield float(given)
        return
    if isinstance(given, Sequence) or not hasattr(given, "__array__"):
        return
    array = np.asarray(given)
    if array.dtype.kind in "iuf" and array.size:
        largest = max(-float(array.min()), float(array.max()))
        if math.isfinite(largest):
            # Without a copy of a long record.
            yield largest
            return
        finite = np.abs(array[np.isfinite(array)])
        yield from (float(finite.max()),) if finite.size else ()
