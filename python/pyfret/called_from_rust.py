"""Functions and classes of Python that the compiled module uses: it imports no other module."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from pyfret._util.arrays import pitch, plain
from pyfret._util.attributes import missing_attribute
from pyfret._util.scene_warnings import warn
from pyfret.scene.tables import scene_html
from pyfret.settings import Settings

if TYPE_CHECKING:
    from collections.abc import Mapping

    from pyfret._core import Scene

__all__ = [
    "Settings",
    "missing_attribute",
    "pitch",
    "plain",
    "scene_html",
    "warn",
    "with_values",
]


def with_values(scene: Scene, values: Mapping[str, Any]) -> Scene:
    """Return a scene with other values, by the keys of a scene file."""
    changed: Scene = import_module("pyfret.study.design").with_values(scene, values)
    return changed
