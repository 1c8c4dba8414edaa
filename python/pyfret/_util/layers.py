"""Layers of a body by the names of their materials."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["layers_made_of"]


def layers_made_of(name: str, materials: Sequence[Any]) -> list[int]:
    """Return the indices of the layers whose material has a name in the table of materials."""
    modulus = modulus_of(name)
    return [n for n, item in enumerate(materials) if is_of(item, name, modulus)]


def is_of(item: Any, name: str, modulus: float | None) -> bool:
    """Check whether a layer is of the material with a name, by the name or by Young's modulus."""
    if item is None:
        return False
    if isinstance(getattr(item, "name", None), str):
        return bool(item.name == name) or (modulus is not None and item.name == table_name(name))
    return modulus is not None and bool(modulus == item.E)


def table_name(name: str) -> str | None:
    """Return the name of a material in the table; None where there is none."""
    from pyfret.fatigue import Materials

    try:
        return str(Materials()[name].name)
    except KeyError:
        return None


def modulus_of(name: str) -> float | None:
    """Return Young's modulus of a material of the table; None where there is none [Pa]."""
    from pyfret.material_table import material

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return material(name).E
        except (KeyError, ValueError):
            return None
