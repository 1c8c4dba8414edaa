"""Maps of the contact plane."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.patches import Circle

from pyfret._core import Flat, Sphere
from pyfret._util.theme import MARK, SLIP, STICK, colour_map
from pyfret.plot.along import (
    field_along,
    legend_of_zones,
    shear_along,
    touched,
    zones_along,
)
from pyfret.plot.scales import MICRO, Scale, Units, last_of, run_of, scales_of_snapshot
from pyfret.plot.sizes import Width
from pyfret.plot.style import add_colour_bar, axes, styled
from pyfret.run.slid import slid_distance

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.image import AxesImage
    from numpy.typing import NDArray

    from pyfret.run import Run, State

#: Labels of the net slip and of the slid distance.
SLIPS = {"net": "net slip $|s|$ [µm]", "distance": r"slid distance $\int|\mathrm{d}s|$ [µm]"}
#: Part of the cells of a contact whose slip a scale of colours covers.
INNER = 0.97


def frame(ax: Axes, snapshot: State, length: Scale) -> tuple[float, float, float, float]:
    """Label the axes, draw the Hertz circle, and return the edges of the grid over the length."""
    grid = snapshot.scene.grid
    x, y = (snapshot.dataset[k].values / length.value for k in ("x", "y"))
    dx, dy = grid.dx / length.value, grid.dy / length.value
    if "a_H" in snapshot.dataset.attrs and is_round(snapshot):
        a_H = snapshot.a_H / length.value
        ax.add_patch(Circle((0, 0), a_H, fill=False, ls=(0, (4, 3)), lw=0.7, ec="0.35", zorder=3))
    ax.set_xlabel(length.label("x"))
    ax.set_ylabel(length.label("y"))
    return x[0] - dx / 2, x[-1] + dx / 2, y[0] - dy / 2, y[-1] + dy / 2


def look_at_contact(ax: Axes, snapshot: State, length: Scale) -> None:
    """Leave cells far from the contact out of the picture."""
    along_x, along_y = (touched(snapshot, axis, length) for axis in (0, 1))
    if along_x is None or along_y is None:
        return
    ax.set_xlim(max(along_x[0], ax.get_xlim()[0]), min(along_x[1], ax.get_xlim()[1]))
    ax.set_ylim(max(along_y[0], ax.get_ylim()[0]), min(along_y[1], ax.get_ylim()[1]))


def is_round(snapshot: State) -> bool:
    """Return whether the bodies are spheres or flats."""
    scene = snapshot.scene
    shapes = (scene.body1.shape, scene.body2.shape)
    return not scene.grid.plane_strain and all(isinstance(s, (Sphere, Flat)) for s in shapes)


@styled
def stick_slip(
    shown: State | Run, *, units: Units = "auto", width: Width | None = None, ax: Axes | None = None
) -> Axes:
    """Draw stick and slip zones; dashed, the Hertz circle of spheres.

    Of a line contact the pressure along x, coloured by the zones.

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
    contact, stick = (snapshot.dataset[k].values.astype(bool) for k in ("contact", "stick"))
    zone = np.where(contact, np.where(stick, 2, 1), 0)
    if snapshot.scene.grid.plane_strain:
        return zones_along(ax, snapshot, scales_of_snapshot(snapshot, units), zone)
    ax = axes(ax, square=True)
    extent = frame(ax, snapshot, scales_of_snapshot(snapshot, units).length)
    ax.imshow(
        zone.T,
        origin="lower",
        extent=extent,
        cmap=ListedColormap(["#FFFFFF00", SLIP, STICK]),
        vmin=0,
        vmax=2,
        interpolation="nearest",
        aspect=ax.get_aspect(),
    )
    look_at_contact(ax, snapshot, scales_of_snapshot(snapshot, units).length)
    legend_of_zones(ax, zone)
    return ax


def field_map(
    ax: Axes | None,
    snapshot: State,
    values: NDArray[np.float64],
    scale: Scale,
    length: Scale,
    **image: Any,
) -> tuple[Axes, AxesImage]:
    """Draw a field on the contact, blank beside it."""
    ax = axes(ax, square=True)
    extent = frame(ax, snapshot, length)
    contact = snapshot.dataset.contact.values.astype(bool)
    shown = np.where(contact, values / scale.value, np.nan)
    look = {"cmap": colour_map("sequential"), "aspect": ax.get_aspect(), **image}
    if not np.any(values[contact]):
        # A scale for a field that is zero everywhere.
        look["vmax"] = look.get("vmax") or 1.0
    drawn = ax.imshow(shown.T, origin="lower", extent=extent, **look)
    ax.set_xlim(extent[:2])
    ax.set_ylim(extent[2:])
    look_at_contact(ax, snapshot, length)
    return ax, drawn


@styled
def pressure_map(
    shown: State | Run,
    *,
    units: Units = "auto",
    width: Width | None = None,
    ax: Axes | None = None,
    colorbar: bool = True,
    **image: Any,
) -> Axes:
    """Pressure over the contact plane, over p_H or in MPa; of a line contact along x.

    Parameters
    ----------
    shown, units, width, ax
        As in :func:`stick_slip`.
    colorbar : bool
        Whether to draw the scale beside the map.
    **image
        Passed on to ``imshow``, such as ``cmap`` and ``vmax``.
    """
    snapshot = last_of(shown)
    by = scales_of_snapshot(snapshot, units)
    values = snapshot.dataset.p.values
    if snapshot.scene.grid.plane_strain:
        shown_p = values / by.stress.value
        return field_along(ax, snapshot, shown_p, by.stress.label("p"), by.length)
    ax, drawn = field_map(ax, snapshot, values, by.stress, by.length, **{"vmin": 0, **image})
    if colorbar:
        label_scale(drawn, ax, by.stress.label("p"))
    return ax


@styled
def slip_map(
    shown: State | Run,
    *,
    of: Literal["net", "distance"] = "net",
    units: Units = "auto",
    width: Width | None = None,
    ax: Axes | None = None,
    colorbar: bool = True,
    **image: Any,
) -> Axes:
    """Net slip since the start of the path, or the slid distance, in um.

    The net slip is the size of the vector from where a cell began to where it is. It returns to
    zero where the surfaces come back. The slid distance is the length of the way between, which
    wears. Of a line contact both are drawn along x.

    The scale of colours ends above all cells but a few: those that come and go with the rim slip
    farther than the others.

    Parameters
    ----------
    shown, units, width, ax, colorbar, **image
        As in :func:`pressure_map`.
    of : "net" or "distance"
        Net slip, or slid distance. The distance needs a result that kept the fields of all
        increments, ``solve(..., save="all")``.
    """
    snapshot = last_of(shown)
    by = scales_of_snapshot(snapshot, units)
    if of not in SLIPS:
        raise ValueError(f'of = {of!r}: must be "net" or "distance"')
    if of == "net":
        slip = np.hypot(snapshot.dataset.slip_x.values, snapshot.dataset.slip_y.values)
    else:
        slip = slid_distance(run_of(shown))
    contact = snapshot.dataset.contact.values.astype(bool)
    largest = np.quantile(slip[contact], INNER) / MICRO.value if contact.any() else None
    if snapshot.scene.grid.plane_strain:
        shown_s = slip / MICRO.value
        return field_along(ax, snapshot, shown_s, SLIPS[of], by.length)
    look = {"vmin": 0, "vmax": largest or None, **image}
    ax, drawn = field_map(ax, snapshot, slip, MICRO, by.length, **look)
    if colorbar:
        label_scale(drawn, ax, SLIPS[of])
    return ax


@styled
def shear_streamlines(
    shown: State | Run,
    *,
    units: Units = "auto",
    width: Width | None = None,
    ax: Axes | None = None,
    largest: float | None = None,
    colorbar: bool = True,
) -> Axes:
    r"""Streamlines of the shear vectors on body 2 over their size :math:`|q|/(\mu p_H)`.

    Orange line: edge of the stick zone; dashed: the Hertz circle of spheres. A line contact has no
    streamlines: its shear is drawn along x, with the bounds of friction.

    Parameters
    ----------
    shown : Snapshot or Result
        The contact to show; of a result the last increment that it has kept.
    units : "auto", "dimensionless" or "SI"
        Over a_H and mu p_H (default where there is a Hertz contact), or in um and MPa.
    width : "column" or "page", optional
        Width of a new figure: a column of 85 mm or a page of 170 mm.
    ax : matplotlib Axes, optional
        Where to draw.
    largest : float, optional
        End of the colour scale, so that several maps can share it (default: the largest size).
    colorbar : bool
        Whether to draw the scale beside the map.
    """
    snapshot = last_of(shown)
    by = scales_of_snapshot(snapshot, units)
    d = snapshot.dataset
    if snapshot.scene.grid.plane_strain:
        return shear_along(ax, snapshot, by)
    contact = d.contact.values.astype(bool)
    q_x, q_y = (np.where(contact, d[k].values, np.nan) for k in ("q_x", "q_y"))
    size = np.hypot(q_x, q_y)
    ax, image = field_map(ax, snapshot, size, by.shear, by.length, vmin=0, vmax=largest, alpha=0.75)
    if colorbar:
        label_scale(image, ax, by.shear.label("|q|"))
    limits = ax.get_xlim(), ax.get_ylim()
    x, y = (d[k].values / by.length.value for k in ("x", "y"))
    if min(size.shape) > 1 and np.nanmax(size, initial=0.0) > 0.0:
        ax.streamplot(x, y, q_x.T, q_y.T, density=1.3, color="0.15", linewidth=0.6, arrowsize=0.6)
    stick = np.where(contact, d.stick.values, np.nan)
    has_both_zones = contact.any() and np.nanmin(stick) < np.nanmax(stick)
    if min(size.shape) > 1 and has_both_zones:
        ax.contour(x, y, stick.T, levels=[0.5], colors=[MARK], linewidths=1.4)
        ax.plot([], [], color=MARK, linewidth=1.4, label="edge of the stick zone")
        ax.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), borderpad=0.1)
    ax.set_xlim(*limits[0])
    ax.set_ylim(*limits[1])
    return ax


def label_scale(image: AxesImage, ax: Axes, label: str) -> None:
    """Draw the colour scale of `image` beside `ax`."""
    values: Any = np.ma.masked_invalid(np.ma.asarray(image.get_array()))
    largest = image.get_clim()[1]
    extend = "max" if largest is not None and values.max() > largest else "neither"
    add_colour_bar(ax, image, label, extend=extend)
