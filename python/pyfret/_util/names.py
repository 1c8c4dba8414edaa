"""Names of modules: what ``dir`` lists, and what other programs call things."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

__all__ = ["OTHER_NAMES", "listing"]

#: What other programs call things of ``pyfret``.
OTHER_NAMES = {
    "load": "open",
    "Material": "Elastic",
    "Layer": "Coating",
    "Surface": "SurfaceMap",
    "Roughness": "shapes.Rough",
}


def listing(names: Sequence[str]) -> Callable[[], list[str]]:
    """Give the ``__dir__`` of a module: its public names and no others."""
    return lambda: list(names)
