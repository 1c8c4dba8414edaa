"""Warnings about what is allowed but hardly meant."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING

from pyfret import _core

if TYPE_CHECKING:
    from pyfret._core import Grid, Scene

__all__ = ["SceneWarning", "doubt_layers", "doubt_numbers", "doubt_run", "doubt_scene", "doubts_of"]


class SceneWarning(UserWarning):
    """Something of a scene is allowed but hardly meant; the message says what was understood."""


def doubt_scene(scene: Scene) -> None:
    """Warn of every number of a scene that looks like one of another unit."""
    for doubt in scene.doubts():
        warnings.warn(doubt, SceneWarning, stacklevel=3)


def doubt_run(doubts: list[str], scene: Scene) -> None:
    """Warn of the doubts of a run that its scene alone does not raise."""
    before = scene.doubts()
    for doubt in doubts:
        if doubt not in before:
            warnings.warn(doubt, SceneWarning, stacklevel=3)


def doubts_of(quantity: str, /, **numbers: float | Sequence[float] | None) -> list[str]:
    """Give the doubts of numbers of a quantity, by their names: another unit.

    Sequences are looked at one by one, None and missing ones are left out.
    """
    found = []
    for name, given in numbers.items():
        for value in () if given is None else given if isinstance(given, Sequence) else (given,):
            doubt = _core.doubt(quantity, name, value)
            if doubt is not None:
                found.append(doubt)
    return found


def doubt_numbers(
    quantity: str, /, *, stacklevel: int = 3, **numbers: float | Sequence[float] | None
) -> list[str]:
    """Warn of the doubts of numbers, :func:`doubts_of`, and give them."""
    found = doubts_of(quantity, **numbers)
    for doubt in found:
        warnings.warn(doubt, SceneWarning, stacklevel=stacklevel)
    return found


def doubt_layers(interfaces: list[float], grid: Grid) -> None:
    """Warn of an interface nearer to the surface than a cell is long."""
    cell = grid.dx if grid.plane_strain else min(grid.dx, grid.dy)
    if interfaces and interfaces[0] < cell:
        warnings.warn(
            f"the first interface is {interfaces[0]:.3g} m below the surface, "
            f"{interfaces[0] / cell:.2f} cells: the tractions are known per cell, and the stress "
            "there is that of tractions which hardly vary over a layer; a finer grid tells",
            SceneWarning,
            stacklevel=3,
        )
