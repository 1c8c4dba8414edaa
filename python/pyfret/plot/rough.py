"""Figures of rough contacts and of maps: spots, gap, pressure, real area, heights."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._util.numbers import length
from pyfret._util.theme import colour_map
from pyfret.plot.along import field_along
from pyfret.plot.maps import frame, label_scale, look_at_contact
from pyfret.plot.scales import MICRO, Scale, Units, last_of, run_of, scales_of_snapshot
from pyfret.plot.sizes import Width
from pyfret.plot.style import axes, note, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from pyfret._core import SurfaceMap
    from pyfret.run import Run, State

#: Part of the gaps beside the contact that a scale of colours covers.
INNER = 0.98
#: Heights of a map.
NANO = Scale(1e-9, "nm", is_unit=True)
#: Bins of a histogram.
BINS = 40
#: Increments below which each has a mark.
FEW = 30


@styled
def spots(
    shown: State | Run, *, units: Units = "auto", width: Width | None = None, ax: Axes | None = None
) -> Axes:
    """Draw the spots of the contact, each by its own area.

    A spot is a patch of cells in contact that touch, corners included. The title has their number.

    Parameters
    ----------
    shown : Snapshot or Result
        The contact; of a result the last increment that it has kept.
    units : "auto", "dimensionless" or "SI"
        Lengths over a_H (default where there is a Hertz contact) or in um.
    width : "column" or "page", optional
        Width of a new figure: a column of 85 mm or a page of 170 mm.
    ax : matplotlib Axes, optional
        Where to draw.
    """
    snapshot = last_of(shown)
    by = scales_of_snapshot(snapshot, units)
    contact = snapshot.dataset.contact.values.astype(bool)
    labels, areas = label_spots(contact, snapshot.scene.grid.dx * snapshot.scene.grid.dy)
    area = np.where(contact, np.append(areas, 0.0)[labels - 1], np.nan) / MICRO.value**2
    if snapshot.scene.grid.plane_strain:
        return field_along(ax, snapshot, area, "area of the spot [µm$^2$]", by.length)
    ax = axes(ax, square=True)
    extent = frame(ax, snapshot, by.length)
    drawn = ax.imshow(
        area.T,
        origin="lower",
        extent=extent,
        cmap=colour_map("sequential"),
        norm="log",
        aspect=ax.get_aspect(),
    )
    look_at_contact(ax, snapshot, by.length)
    if len(areas):
        label_scale(drawn, ax, f"area of each of {len(areas)} spots [µm$^2$]")
    return ax


def label_spots(contact: Any, cell: float) -> tuple[Any, Any]:
    """Return the number of the spot of each cell, 0 without contact, and the areas [m^2]."""
    shape = contact.shape
    # Each cell takes the smallest label of its neighbours until nothing changes.
    labels = np.where(contact, np.arange(1, contact.size + 1).reshape(shape), 0)
    beyond = contact.size + 1
    while True:
        padded = np.pad(np.where(contact, labels, beyond), 1, constant_values=beyond)
        least = labels
        for i in range(3):
            for j in range(3):
                least = np.minimum(least, padded[i : i + shape[0], j : j + shape[1]])
        # A label is the place of a cell, whose own label may be smaller by now.
        flat = np.append(0, least.ravel())
        least = np.where(contact, flat[least], 0)
        if np.array_equal(least, labels):
            break
        labels = least
    _, inverse, count = np.unique(labels[contact], return_inverse=True, return_counts=True)
    numbers = np.zeros(shape, dtype=int)
    numbers[contact] = inverse + 1
    return numbers, cell * count


@styled
def gap_map(
    shown: State | Run, *, units: Units = "auto", width: Width | None = None, ax: Axes | None = None
) -> Axes:
    """Draw the gap between the surfaces, white in the contact; parameters as in :func:`spots`."""
    snapshot = last_of(shown)
    by = scales_of_snapshot(snapshot, units)
    contact = snapshot.dataset.contact.values.astype(bool)
    gap = np.where(contact, np.nan, snapshot.dataset.gap.values) / MICRO.value
    if snapshot.scene.grid.plane_strain:
        return field_along(ax, snapshot, gap, MICRO.label("h"), by.length)
    ax = axes(ax, square=True)
    extent = frame(ax, snapshot, by.length)
    upper = float(np.quantile(gap[~contact], INNER)) if not contact.all() else 1.0
    drawn = ax.imshow(
        gap.T,
        origin="lower",
        extent=extent,
        cmap=colour_map("sequential"),
        vmin=0.0,
        vmax=upper or 1.0,
        aspect=ax.get_aspect(),
    )
    look_at_contact(ax, snapshot, by.length)
    label_scale(drawn, ax, MICRO.label("h"))
    return ax


@styled
def pressure_histogram(
    shown: State | Run, *, units: Units = "auto", width: Width | None = None, ax: Axes | None = None
) -> Axes:
    """Draw the distribution of the pressure over the cells in contact.

    Parameters
    ----------
    shown : Snapshot or Result
        The contact; of a result the last increment that it has kept.
    units : "auto", "dimensionless" or "SI"
        Pressures over p_H (default where there is a Hertz contact) or in MPa.
    width : "column" or "page", optional
        Width of a new figure: a column of 85 mm or a page of 170 mm.
    ax : matplotlib Axes, optional
        Where to draw.
    """
    snapshot = last_of(shown)
    by = scales_of_snapshot(snapshot, units).stress
    p = snapshot.dataset.p.values
    ax = axes(ax)
    pressed = p[p > 0] / by.value
    if pressed.size:
        ax.hist(pressed, bins=min(BINS, 2 + int(np.sqrt(pressed.size))), density=True)
        ax.axvline(pressed.mean(), color="0.2", ls="--", lw=1.0, label="mean")
        ax.legend()
    else:
        note(ax, "the bodies do not touch")
    ax.set_xlabel(by.label("p"))
    ax.set_ylabel("probability density")
    ax.set_xlim(0.0, None)
    return ax


@styled
def area_over_load(
    result: Run, *, width: Width | None = None, ax: Axes | None = None, **line: Any
) -> Axes:
    """Draw the real area over the normal force, with the error of the cells as a band."""
    d = run_of(result).dataset
    ax = axes(ax)
    W, area, error = (
        np.append(0.0, d[name].values) for name in ("W", "real_area", "real_area_error")
    )
    area, error = area / MICRO.value**2, error / MICRO.value**2
    (drawn,) = ax.plot(W, area, **{"marker": "." if len(W) < FEW else "", **line})
    ax.fill_between(W, area - error, area + error, alpha=0.25, color=drawn.get_color(), lw=0)
    ax.set_xlabel(f"$W$ [{d.W.attrs['units']}]")
    per = "/m" if str(d.real_area.attrs["units"]).endswith("/m") else ""
    ax.set_ylabel(f"real area [µm$^2${per}]")
    ax.set_xlim(0.0, None)
    ax.set_ylim(0.0, None)
    return ax


@styled
def surface_heights(
    surface: SurfaceMap, *, width: Width | None = None, ax: Axes | None = None
) -> Axes:
    """Draw the heights of a map about their mean."""
    z = np.asarray(surface.values, dtype=float)
    z = z - z.mean()
    scale = MICRO if np.ptp(z) > MICRO.value else NANO
    half = [0.5 * n * d / MICRO.value for n, d in zip(z.shape, surface.spacing, strict=True)]
    ax = axes(ax, square=True)
    drawn = ax.imshow(
        z.T / scale.value,
        origin="lower",
        extent=(-half[0], half[0], -half[1], half[1]),
        cmap=colour_map("diverging"),
        vmin=-np.abs(z).max() / scale.value,
        vmax=np.abs(z).max() / scale.value,
        aspect=ax.get_aspect(),
    )
    ax.set_xlabel(MICRO.label("x"))
    ax.set_ylabel(MICRO.label("y"))
    label_scale(drawn, ax, f"{scale.label('z')}, $S_q$ = {length(surface.rms)}")
    return ax
