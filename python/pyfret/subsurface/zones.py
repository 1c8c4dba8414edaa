"""Ends of the contact and of its stick zone along a line of the surface."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from pyfret import _core
from pyfret._core import with_error
from pyfret._util.attributes import missing_attribute
from pyfret.quantities import quantities

if TYPE_CHECKING:
    from pyfret.run import State

__all__ = ["Zone", "zone"]

#: Error of a border from the tractions beside it, and of a border between a cell of the zone and
#: the next cell [cells]. The scan has 60 random line contacts on 64 against 256 cells, bare and
#: coated, of like and unlike bodies: 119 of 120 ends are at most 1.5 errors off.
WITHIN, BETWEEN = 0.25, 0.75
#: Farthest that a border lies from the edge between a cell of the zone and the next cell [cells].
#: Extrapolated tractions that end farther in or out contradict the states of the cells.
FARTHEST = 0.75


class Zone(NamedTuple):
    """A zone along x: its borders, known within the cells [m]; NaN where there is none."""

    left: float
    right: float
    #: How many borders lie between these two: 0 for one zone without holes.
    inside: int
    #: Error of a border, of the middle and of the half width [m], an estimate that counts the cells
    #: alone: the larger error of both borders (:data:`WITHIN`, :data:`BETWEEN`).
    error: float | None = None

    def __repr__(self) -> str:
        """Give borders, middle and half width with their error."""
        names = ("left", "right", "middle", "half_width")
        error = None if self.error is None else 1e6 * self.error
        parts = (f"{n} {with_error(1e6 * getattr(self, n), error)} um" for n in names)
        return f"Zone({', '.join(parts)})"

    @property
    def middle(self) -> float:
        """The middle of the zone [m], the offset that a bulk stress gives it."""
        return (self.left + self.right) / 2

    @property
    def half_width(self) -> float:
        """Half the way from border to border [m]."""
        return (self.right - self.left) / 2


@quantities
def zone(state: State, of: Literal["contact", "stick"], y: float = 0.0) -> Zone:
    """Return the outermost borders of contact or stick zone along a line of constant y."""
    d, grid = state.dataset, state.scene.grid
    in_zone = d[of].values.astype(bool)
    y = float(d.y[0]) if grid.plane_strain else y
    row = in_zone[:, int(np.abs(d.y.values - y).argmin())]
    touching = np.flatnonzero(d.contact.values.astype(bool).any(axis=1))
    if not row.any() or touching.size == 0:
        return Zone(np.nan, np.nan, 0)
    if of == "stick" and bool((d.stick.values == d.contact.values).all()):
        # Sticks everywhere: the zone ends where the contact does.
        return zone(state, "contact", y)
    p, q_x, q_y = state.tractions().values()
    stick = d["stick"].values.astype(bool)
    below = _core.Subsurface(state.body(2), grid, p=p, q_x=q_x, q_y=q_y, rim=True, stick=stick)
    name = "stick border" if of == "stick" else "rim"
    borders = below.borders(y=y)
    places = sorted((x, within) for x, _, kind, within in borders if kind == name)
    cells = d.x.values[row]
    half = grid.dx / 2
    if len(places) < 2:
        # A zone that ends at the rim has no border of its own there.
        low, high = cells[0] - grid.dx, cells[-1] + grid.dx
        rims = {(x, k) for x, _, kind, k in borders if kind == "rim" and low <= x <= high}
        places = sorted({*places, *rims})
    ends = [
        _border(places[:1], cells[0] - half, grid.dx),
        _border(places[-1:] if len(places) > 1 else [], cells[-1] + half, grid.dx),
    ]
    (x_left, _), (x_right, _) = ends
    return Zone(x_left, x_right, max(len(places) - 2, 0), max(error for _, error in ends))


def _border(places: list[tuple[float, bool]], edge: float, cell: float) -> tuple[float, float]:
    """Return the place of a border and its error [m]; the last cell of the zone ends at `edge`."""
    if not places:
        return float(edge), BETWEEN * cell
    ((x, within),) = places
    nearest = float(np.clip(x, edge - FARTHEST * cell, edge + FARTHEST * cell))
    return nearest, (WITHIN if within and nearest == x else BETWEEN) * cell


if not TYPE_CHECKING:
    # A method within the class would let type checkers take any name.
    Zone.__getattr__ = missing_attribute
