"""Functions and classes of Python that the compiled module uses: it imports no other module."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from pyfret._util.arrays import pitch, plain
from pyfret._util.attributes import missing_attribute
from pyfret._util.keywords import accepted_keywords
from pyfret._util.scene_warnings import warn
from pyfret.scene.maps import (
    filter_waves,
    fit_form,
    level,
    resample,
    spectrum,
    statistics,
    summarize_map,
    write_heights,
)
from pyfret.scene.tables import path_html, scene_html, summarize_scene
from pyfret.settings import Settings

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.axes import Axes

    from pyfret._core import Scene, SurfaceMap
    from pyfret.fatigue import Material

__all__ = [
    "Settings",
    "accepted_keywords",
    "filter_waves",
    "fit_form",
    "hardness_from",
    "level",
    "missing_attribute",
    "path_html",
    "pitch",
    "plain",
    "resample",
    "scene_html",
    "spectrum",
    "statistics",
    "summarize_map",
    "summarize_scene",
    "surface_heights",
    "warn",
    "with_values",
    "write_heights",
]


def with_values(scene: Scene, values: Mapping[str, Any]) -> Scene:
    """Return a scene with other values, by the keys of a scene file."""
    changed: Scene = import_module("pyfret.study.design").with_values(scene, values)
    return changed


def surface_heights(surface: SurfaceMap, ax: Axes | None) -> Axes:
    """Draw the heights of a map."""
    drawn: Axes = import_module("pyfret.plot").surface_heights(surface, ax=ax)
    return drawn


def hardness_from(hardness: float | Material | str) -> float:
    """Return a hardness [Pa] of a number or of a material of the table."""
    pressure: float = import_module("pyfret.material_table").hardness_from(hardness)
    return pressure
