"""Warnings about what is allowed but hardly meant."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pyfret._core import CELLS_PER_FILM
from pyfret._util.scene_warnings import warn

if TYPE_CHECKING:
    from pyfret._core import Grid, Scene

__all__ = ["doubt_layers", "doubt_run", "doubt_scene"]


def doubt_scene(scene: Scene) -> None:
    """Warn of every number of a scene that looks like one of another unit."""
    for doubt in scene.doubts():
        warn(doubt)


def doubt_run(doubts: list[str], scene: Scene) -> None:
    """Warn of the doubts of a run that its scene alone does not raise."""
    before = scene.doubts()
    for doubt in doubts:
        if doubt not in before:
            warn(doubt)


def doubt_layers(interfaces: list[float], grid: Grid) -> None:
    """Warn of an interface nearer to the surface than a cell is long."""
    cell = grid.dx if grid.plane_strain else min(grid.dx, grid.dy)
    if interfaces and interfaces[0] < cell:
        warn(
            f"the first interface is {interfaces[0]:.3g} m below the surface, "
            f"{interfaces[0] / cell:.2f} cells. The stress in the layer may be wrong near the edge "
            f"of the contact. For it, use cells of "
            f"{interfaces[0] / CELLS_PER_FILM:.2e} m, {CELLS_PER_FILM:g} in its thickness",
        )
