"""What a compiled object holds, as a sheet for people: its numbers with their units.

A unit stands in the docstring of the attribute, in brackets, and in no second place.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from typing import Any

from pyfret._util.numbers import in_words, length

__all__ = ["sheet"]

#: The meaning of an attribute, and its unit.
DOCUMENTED = re.compile(r"(?P<meaning>[^\[.,]+?)\s*(?:\[(?P<unit>[^\]]+)\]|[.,]|$)")
#: Larger units, the largest first.
LARGER = {"Pa": ((1e9, "GPa"), (1e6, "MPa")), "N/m": ((1e3, "kN/m"),)}


def sheet(of: Any) -> str:
    """Return the class of an object and a line for each number and part: name, value, meaning."""
    rows = sorted(lines(of), key=lambda row: "(" in row[1])
    names = max(len(name) for name, _, _ in rows)
    # A part is longer than any number, and no column of its own.
    values = max((len(value) for _, value, _ in rows if "(" not in value), default=0)
    texts = (f"  {name:<{names}}  {value:<{values}}  {meaning}" for name, value, meaning in rows)
    return "\n".join([f"{type(of).__name__}:", *texts])


def lines(of: Any, before: str = "") -> Iterator[tuple[str, str, str]]:
    """Yield name, value and meaning of every attribute; parts with a sheet come by name."""
    for name, attribute in inspect.getmembers_static(type(of), inspect.isgetsetdescriptor):
        match = DOCUMENTED.match(inspect.getdoc(attribute) or "")
        if name.startswith("_") or match is None:
            continue
        value = getattr(of, name)
        if getattr(type(value), "__str__", None) is sheet:
            yield from lines(value, f"{before}{name}.")
        else:
            yield f"{before}{name}", shown(value, match["unit"] or ""), match["meaning"]


def shown(value: Any, unit: str) -> str:
    """Format a number with its unit, any other value by its repr."""
    if not isinstance(value, float | int):
        return repr(value)
    if unit == "m":
        return length(value).replace("µ", "u")
    for size, larger in LARGER.get(unit, ()):
        if abs(value) >= size:
            return f"{in_words(value / size)} {larger}"
    return f"{in_words(value)} {unit}".rstrip()
