"""Ends of the contact and of its stick zone along a line of the surface."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from pyfret import _core
from pyfret._core import with_error
from pyfret.quantities import quantities

if TYPE_CHECKING:
    from pyfret.run import State

__all__ = ["Zone", "zone"]


class Zone(NamedTuple):
    """A zone along x: its borders, known within the cells [m]; NaN where there is none."""

    left: float
    right: float
    #: How many borders lie between these two: 0 for one zone without holes.
    inside: int
    #: Error of a border, of the middle and of the half width [m], an estimate: a quarter of a cell.
    #: Of line contacts on 48 to 100 cells the borders are 0.05 of a cell off at most.
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
    """The outermost borders of the contact or of its stick zone along the line of constant y."""
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
    border_places = sorted(x for x, _, kind, _ in below.borders(y=y) if kind == name)
    cells = d.x.values[row]
    half = grid.dx / 2
    if len(border_places) < 2:
        # A zone that ends at the rim has no border of its own there.
        low, high = cells[0] - grid.dx, cells[-1] + grid.dx
        rims = {x for x, _, kind, _ in below.borders(y=y) if kind == "rim" and low <= x <= high}
        border_places = sorted({*border_places, *rims})
    x_left = border_places[0] if border_places else float(cells[0] - half)
    right = border_places[-1] if len(border_places) > 1 else float(cells[-1] + half)
    return Zone(float(x_left), float(right), max(len(border_places) - 2, 0), grid.dx / 4)
