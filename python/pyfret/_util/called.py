"""Materials by their names."""

from __future__ import annotations

import difflib
import re
from typing import TYPE_CHECKING, Any, TypeVar, cast

from pyfret import _core

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from pyfret._core import Material

__all__ = ["as_material", "by_name", "called", "law", "unknown"]

#: Annotations of parameters that take a material, or several.
MATERIAL = re.compile(r"\b(Materials?|Conductors)\b")

#: What a law of a material is made of it by, by the name of its class.
LAWS: dict[str, Callable[[Any], Any]] = {}
T = TypeVar("T", bound=type)


def law(of: T) -> T:
    """Let parameters of a class take a material or its name, too: what its method ``of`` gives."""
    LAWS[of.__name__] = of.of  # type: ignore[attr-defined]
    return of


def as_material(read: Material | str) -> Material:
    """A material within a function whose door has found it by its name: the same."""
    return cast("Material", read)


def called(name: str, among: Mapping[str, Material]) -> Material | None:
    """Give the material of a name, or of another one that it is known by: ``"Ti6Al4V"``."""
    if name in among:
        return among[name]
    return next((material for material in among.values() if material.is_called(name)), None)


def unknown(name: str, among: Mapping[str, Material]) -> str:
    """Say that there is no such material, with the nearest and all others."""
    all_names = {n: m for m in among.values() for n in (m.name, *m.also)}
    near = difflib.get_close_matches(name, all_names, n=1, cutoff=0.6)
    hint = f"; the nearest is {near[0]}" if near else ""
    return f"no material {name!r}{hint}; there are {', '.join(among)}"


def by_name(value: Any, name: str, annotation: str) -> Any:
    """The material of the table where a material is meant and a text is given, else the value.

    Where a law of a material is meant, it is that of the material.

    Raises
    ------
    ValueError
        There is no material of this name.
    """
    for one, of in LAWS.items():
        if isinstance(value, str | _core.Material) and re.search(rf"\b{one}\b", annotation):
            return of(by_name(value, name, "Material"))
    if not MATERIAL.search(annotation):
        return value
    if type(value) in (list, tuple):
        return type(value)(by_name(one, name, annotation) for one in value)
    # A number with a unit begins with a digit where a number is taken, too.
    if not isinstance(value, str) or ("Quantity" in annotation and value[:1].isdigit()):
        return value
    among = {material.name: material for material in _core.materials()}
    found = called(value, among)
    if found is None:
        raise ValueError(f"{name}: {unknown(value, among)}")
    return found
