"""Fields along a line of the surface: the sight of a profile, line contacts in place of maps."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.patches import Patch

from pyfret._util.theme import REFERENCE, SLIP, STICK
from pyfret.plot.style import axes
from pyfret.subsurface.line import Line

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from pyfret.plot.scales import Scale, Scales
    from pyfret.run import State

__all__ = [
    "field_along",
    "legend_of_zones",
    "look_along",
    "shear_along",
    "zones_along",
]

#: The line of a line contact.
MIDDLE = Line(None, 0.0)

#: Room around a contact, over half its length.
MARGIN = 0.3


def touched(snapshot: State, axis: int, length: Scale) -> tuple[float, float] | None:
    """Return the ends of the contact along x (0) or y (1) with some room; None without contact."""
    contact = snapshot.dataset.contact.values.astype(bool)
    if not contact.any():
        return None
    grid = snapshot.scene.grid
    name, cell = (("x", grid.dx), ("y", grid.dy))[axis]
    places = snapshot.dataset[name].values[contact.any(axis=1 - axis)]
    low, high = places.min() - cell / 2, places.max() + cell / 2
    margin = MARGIN * (high - low) / 2
    return (low - margin) / length.value, (high + margin) / length.value


def look_along(
    ax: Axes, snapshot: State, length: Scale, line: Line = MIDDLE, *, fresh: bool
) -> None:
    """Leave the surface far from the contact out of a profile on a line.

    On axes with curves already, the range that they show stays in sight.
    """
    contact = snapshot.dataset.contact.values.astype(bool)
    if not contact.any():
        return
    d, grid = snapshot.dataset, snapshot.scene.grid
    s = line.place(*np.meshgrid(d.x.values, d.y.values, indexing="ij")) / length.value
    cell = np.hypot(np.cos(line.angle) * grid.dx, np.sin(line.angle) * grid.dy) / length.value
    low, high = s[contact].min() - cell / 2, s[contact].max() + cell / 2
    margin = MARGIN * (high - low) / 2
    low, high = max(low - margin, s.min() - cell / 2), min(high + margin, s.max() + cell / 2)
    if not fresh:
        low, high = min(low, ax.get_xlim()[0]), max(high, ax.get_xlim()[1])
    ax.set_xlim(low, high)


def legend_of_zones(ax: Axes, zone: NDArray[np.int_], *further: Any) -> None:
    """Draw a legend above the axes of the zones that occur."""
    zones = ((2, STICK, "stick"), (1, SLIP, "slip"))
    handles = [Patch(color=color, label=label) for n, color, label in zones if (zone == n).any()]
    handles += further
    if handles:
        ax.legend(
            handles=handles,
            loc="lower right",
            bbox_to_anchor=(1.0, 1.0),
            ncols=len(handles),
            handlelength=1.0,
            borderpad=0.1,
        )


def zones_along(ax: Axes | None, snapshot: State, by: Scales, zone: NDArray[np.int_]) -> Axes:
    """Draw the pressure of a line contact, cells below it coloured by stick and slip."""
    ax = axes(ax)
    x, p = snapshot.dataset.x.values / by.length.value, snapshot.dataset.p.values[:, 0]
    cell = snapshot.scene.grid.dx / by.length.value
    for n, colour in ((1, SLIP), (2, STICK)):
        in_zone = zone[:, 0] == n
        # A hair wider than a cell, so that no white shows between neighbours.
        height = p[in_zone] / by.stress.value
        ax.bar(x[in_zone], height, width=1.02 * cell, color=colour, linewidth=0)
    look_along(ax, snapshot, by.length, fresh=True)
    ax.set_xlabel(by.length.label("x"))
    ax.set_ylabel(by.stress.label("p"))
    ax.set_ylim(bottom=0.0)
    ax.grid(visible=False)
    legend_of_zones(ax, zone)
    return ax


def field_along(
    ax: Axes | None,
    snapshot: State,
    values: NDArray[np.float64],
    label: str,
    length: Scale,
    *,
    largest: float | None = None,
) -> Axes:
    """Draw a field of a line contact along x, without cells that do not touch."""
    ax = axes(ax)
    x = snapshot.dataset.x.values / length.value
    contact = snapshot.dataset.contact.values.astype(bool)[:, 0]
    ax.plot(x, np.where(contact, values[:, 0], np.nan))
    look_along(ax, snapshot, length, fresh=True)
    ax.set_xlabel(length.label("x"))
    ax.set_ylabel(label)
    if not np.any(values < 0.0):
        ax.set_ylim(0.0, largest)
    return ax


def shear_along(ax: Axes | None, snapshot: State, by: Scales) -> Axes:
    """Draw the shear of a line contact within the bounds of friction, in grey."""
    ax = axes(ax)
    d = snapshot.dataset
    x, contact = d.x.values / by.length.value, d.contact.values.astype(bool)[:, 0]
    q = {name: d[name].values[:, 0] / by.shear.value for name in ("q_x", "q_y")}
    largest = max(float(np.abs(tractions).max()) for tractions in q.values())
    shown = [name for name, tractions in q.items() if np.abs(tractions).max() > 1e-6 * largest] or [
        "q_x"
    ]
    for name in shown:
        ax.plot(x, np.where(contact, q[name], np.nan), label=f"${name}$")
    label = f"${shown[0]}$" if len(shown) == 1 else None
    if np.isfinite(snapshot.mu) and snapshot.mu > 0.0:
        bound = snapshot.mu * d.p.values[:, 0] / by.shear.value
        bounds: dict[str, Any] = {"color": REFERENCE, "linestyle": ":", "linewidth": 1.0}
        ax.plot(x, bound, label=r"$\pm\mu p$", **bounds)
        ax.plot(x, -bound, **bounds)
    look_along(ax, snapshot, by.length, fresh=True)
    ax.set_xlabel(by.length.label("x"))
    ax.set_ylabel(by.shear.label("q" if label is None else shown[0]))
    ax.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=3, borderpad=0.1)
    return ax
