"""The lines of the surface below which sections lie."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from pyfret import _core

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["Line", "along", "line_of"]


class Line(NamedTuple):
    """Which line a section lies below: along x at y, along y at x, or through x, y at an angle."""

    x: float | None
    y: float | None
    azimuth: float | None = None

    def named(self) -> dict[str, Any]:
        """Its numbers by their names, as keywords."""
        return {"x": self.x, "y": self.y, "azimuth": self.azimuth}

    @property
    def along(self) -> str:
        """Name of the place along the line."""
        return "s" if self.azimuth is not None else "y" if self.y is None else "x"

    @property
    def angle(self) -> float:
        """Angle of the line to the x axis [rad]."""
        return {"x": 0.0, "y": np.pi / 2}.get(self.along, self.azimuth or 0.0)

    def place(self, x: float, y: float) -> float:
        """The place along the line that is nearest to x, y [m]."""
        if self.azimuth is None:
            return x if self.along == "x" else y
        assert self.x is not None
        assert self.y is not None
        cos, sin = np.cos(self.azimuth), np.sin(self.azimuth)
        return float((x - self.x) * cos + (y - self.y) * sin)


def along(x: float, y: float, azimuth: float) -> Line:
    """The line through a point at an angle; along x or y where that is the angle."""
    return Line(*_core.line_through(x, y, azimuth))


def line_of(values: xr.Dataset | xr.DataArray) -> Line:
    """The line of a section by its coordinates."""
    if "s" not in values.dims:
        at = [None if name in values.dims else float(values[name]) for name in ("x", "y")]
        return Line(*at)
    azimuth = float(values["azimuth"])
    back = float(values["s"][0])
    x, y = float(values["x"][0]), float(values["y"][0])
    return Line(x - back * np.cos(azimuth), y - back * np.sin(azimuth), azimuth)
