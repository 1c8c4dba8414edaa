"""How compiled classes look in a notebook."""

from __future__ import annotations

from pyfret._core import LoadPath, Scene
from pyfret.reporting.tables import path_html, scene_html

__all__ = ["show_in_notebooks"]


def show_in_notebooks() -> None:
    """Let scenes and load paths be shown as tables."""
    for kind, html in ((Scene, scene_html), (LoadPath, path_html)):
        setattr(kind, "_repr_html_", html)  # noqa: B010
