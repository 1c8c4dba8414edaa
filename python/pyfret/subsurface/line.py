"""The lines of the surface below which sections lie, and the fields of a contact along them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from pyfret import _core
from pyfret._util.lazy import xr

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from pyfret.run import State

__all__ = ["Line", "cut", "fields_on", "line_of", "line_through_point", "main_line", "main_shear"]


class Line(NamedTuple):
    """The line above a section: along x at y, along y at x, or through x, y at an angle."""

    x: float | None
    y: float | None
    azimuth: float | None = None

    def named(self) -> dict[str, Any]:
        """Its numbers by their names, as keywords."""
        return {"x": self.x, "y": self.y, "azimuth": self.azimuth}

    @property
    def axis(self) -> str:
        """Name of the coordinate along the line: "x", "y" or "s"."""
        return "s" if self.azimuth is not None else "y" if self.y is None else "x"

    @property
    def angle(self) -> float:
        """Angle of the line to the x axis [rad]."""
        return {"x": 0.0, "y": np.pi / 2}.get(self.axis, self.azimuth or 0.0)

    def place(self, x: Any, y: Any) -> Any:
        """Return the place along the line that is nearest to x, y [m], numbers or arrays."""
        if self.azimuth is None:
            return x if self.axis == "x" else y
        assert self.x is not None
        assert self.y is not None
        cos, sin = np.cos(self.azimuth), np.sin(self.azimuth)
        return (x - self.x) * cos + (y - self.y) * sin


def line_through_point(x: float, y: float, azimuth: float) -> Line:
    """The line through a point at an angle; along x or y where that is the angle."""
    return Line(*_core.line_through(x, y, azimuth))


def line_of(values: xr.Dataset | xr.DataArray) -> Line:
    """Return the line of a section by its coordinates."""
    if "s" not in values.dims:
        at = [None if name in values.dims else float(values[name]) for name in ("x", "y")]
        return Line(*at)
    azimuth = float(values["azimuth"])
    back = float(values["s"][0])
    x, y = float(values["x"][0]), float(values["y"][0])
    return Line(x - back * np.cos(azimuth), y - back * np.sin(azimuth), azimuth)


def main_line(state: State) -> Line:
    """The line along the shear of an increment, through the centre of its contact.

    Along x through the centre where the shear has no direction, along the middle without a contact.
    """
    outline = state.outline
    return Line(None, 0.0) if outline is None else Line(*_core.main_sections(outline)[0])


def fields_on(state: State, line: Line) -> xr.Dataset:
    """The fields of an increment on a line, linear between the centres of the cells.

    Over x, y or s, the place from the point that the line goes through. Oblique lines have `q_s`
    and `q_t` as well, the shear along s and the shear to the left of it [Pa].
    """
    return cut(state.dataset, state.scene.grid, line)


def cut(d: xr.Dataset, grid: _core.Grid, line: Line) -> xr.Dataset:
    """Interpolate the fields of a grid on a line of it, as :func:`fields_on`.

    Fields may have other dimensions before x and y, which stay.
    """
    metres = {"units": "m"}
    if line.azimuth is None:
        along = line.axis
        coords = {along: (along, d[along].values, metres)}
        points = {"x": d.x.values, "y": d.y.values}
        at = {
            k: points[k] if k == along else np.full(d[along].size, getattr(line, k)) for k in "xy"
        }
        x, y = at["x"], at["y"]
    else:
        along = "s"
        s, places = _core.line_places(grid, **line.named())
        x, y = np.transpose(places)
        coords = {k: ("s", v, metres) for k, v in {"s": np.asarray(s), "x": x, "y": y}.items()}
    weights = [_interpolation_weights(d[k].values, at) for k, at in (("x", x), ("y", y))]
    (i_left, right, u), (near, far, v) = weights

    def on_line(field: NDArray[np.float64]) -> NDArray[np.float64]:
        """Interpolate one field."""
        low = field[..., i_left, near] * (1 - v) + field[..., i_left, far] * v
        high = field[..., right, near] * (1 - v) + field[..., right, far] * v
        return low * (1 - u) + high * u

    fields = xr.Dataset(coords=coords)
    for name, field in d.data_vars.items():
        if field.dtype.kind == "f" and field.dims[-2:] == ("x", "y"):
            fields[name] = ((*field.dims[:-2], along), on_line(field.values), dict(field.attrs))
    if line.azimuth is not None and "q_x" in fields:
        cos, sin = np.cos(line.azimuth), np.sin(line.azimuth)
        fields["q_s"] = (fields.q_x * cos + fields.q_y * sin).assign_attrs(units="Pa")
        fields["q_t"] = (fields.q_y * cos - fields.q_x * sin).assign_attrs(units="Pa")
    return fields


def main_shear(cut: xr.Dataset) -> str:
    """The component of the shear that is largest on a line."""
    components = ("q_s", "q_t") if "q_s" in cut else ("q_x", "q_y")
    return max(components, key=lambda of: float(abs(cut[of]).max()))


def _interpolation_weights(
    cells: NDArray[np.float64], at: NDArray[np.float64]
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float64]]:
    """Return the cells on both sides of places and the share of the second.

    At the border it is the last cell.
    """
    if cells.size == 1:
        none = np.zeros(at.size, dtype=np.int64)
        return none, none, np.zeros(at.size)
    above = np.clip(np.searchsorted(cells, at), 1, cells.size - 1)
    share = (at - cells[above - 1]) / (cells[above] - cells[above - 1])
    return above - 1, above, np.clip(share, 0.0, 1.0)
