"""Functions and classes of Python that the compiled module uses: it imports no other module."""

from __future__ import annotations

from pyfret._util.arrays import pitch, plain
from pyfret._util.attributes import missing_attribute
from pyfret._util.scene_warnings import warn
from pyfret.scene.tables import scene_html
from pyfret.settings import Settings

__all__ = ["Settings", "missing_attribute", "pitch", "plain", "scene_html", "warn"]
