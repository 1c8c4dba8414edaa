"""Layers of a body by the names of their materials."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pyfret import _core
from pyfret._util.material_names import find_material

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["layers_made_of"]


def layers_made_of(name: str, materials: Sequence[Any]) -> list[int]:
    """Return the indices of the layers whose material has a name in the table of materials."""
    row = find_material(name, {material.name: material for material in _core.materials()})
    numbers = {} if row is None else {key: number for key, number, _ in row.numbers()}
    known_as = name if row is None else row.name
    return [n for n, item in enumerate(materials) if is_made_of(item, {name, known_as}, numbers)]


def is_made_of(item: Any, names: set[str], numbers: dict[str, float]) -> bool:
    """Check whether a layer has a material of the table: one of `names`, or its Young's modulus."""
    if item is None:
        return False
    if isinstance(getattr(item, "name", None), str):
        return item.name in names
    return bool(numbers.get("E") == item.E)
