"""Materials by their names."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from pyfret import _core

if TYPE_CHECKING:
    from collections.abc import Mapping

    from pyfret._core import Material

#: Characters of an unknown name that are repeated.
LONGEST = 60

__all__ = ["as_material", "find_material", "list_materials", "read_material"]


def as_material(read: Material | str) -> Material:
    """Return a material that the decorator of its function has found: for type checkers."""
    return cast("Material", read)


def find_material(name: str, materials: Mapping[str, Material]) -> Material | None:
    """Find the material with a name or a synonym: ``"Ti6Al4V"``."""
    if name in materials:
        return materials[name]
    match = _core.find_material(name, list(materials.values()))
    return None if match is None else materials[match.name]


def list_materials(name: str, materials: Mapping[str, Material]) -> str:
    """Describe the names of materials where one is unknown, the nearest first."""
    names = {n: m for m in materials.values() for n in (m.name, *m.also)}
    other_case = {n: m for n, m in names.items() if n.lower() == name.lower()}
    if other_case:
        titles = ", ".join(f"{n!r} is {m.title!r}" for n, m in other_case.items())
        return f"no material {name!r}: in a formula the case counts, {titles}"
    near = _core.nearest_materials(name[:LONGEST], list(materials.values()))
    hint = f"; the nearest {'are' if len(near) > 1 else 'is'} {', '.join(near)}" if near else ""
    return (
        f"no material {name[:LONGEST]!r}{hint}; there are {', '.join(materials)}; "
        "another one is fret.Elastic(E=..., nu=...)"
    )


def read_material(name: str, parameter: str) -> Material:
    """Find a material of the table that comes with the package.

    Raises
    ------
    ValueError
        There is no material with this name.
    """
    materials = {material.name: material for material in _core.materials()}
    material = find_material(name, materials)
    if material is None:
        raise ValueError(f"{parameter}: {list_materials(name, materials)}")
    return material
