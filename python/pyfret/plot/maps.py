"""Maps of the contact plane."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.patches import Circle, Patch

from pyfret.plot.style import SLIP, STICK, axes, styled

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.image import AxesImage

    from pyfret.results import Snapshot


def frame(ax: Axes, snapshot: Snapshot) -> tuple[float, float, float, float]:
    """Label the axes, draw the Hertz circle and give the edges of the grid over a_H."""
    x, y = (snapshot.dataset[k].values / snapshot.a_H for k in ("x", "y"))
    dx, dy = (v[1] - v[0] if v.size > 1 else 1.0 for v in (x, y))
    ax.add_patch(Circle((0, 0), 1.0, fill=False, ls=(0, (4, 3)), lw=0.7, ec="0.35", zorder=3))
    ax.set_xlabel(r"$x_1/a_H$")
    ax.set_ylabel(r"$x_2/a_H$")
    return x[0] - dx / 2, x[-1] + dx / 2, y[0] - dy / 2, y[-1] + dy / 2


@styled
def stick_slip(snapshot: Snapshot, *, ax: Axes | None = None) -> Axes:
    """Where the contact sticks and where it slips; dashed, the Hertz circle."""
    ax = axes(ax, square=True)
    extent = frame(ax, snapshot)
    contact, stick = (snapshot.dataset[k].values.astype(bool) for k in ("contact", "stick"))
    zone = np.where(contact, np.where(stick, 2, 1), 0)
    ax.imshow(
        zone.T,
        origin="lower",
        extent=extent,
        cmap=ListedColormap(["#FFFFFF00", SLIP, STICK]),
        vmin=0,
        vmax=2,
        interpolation="nearest",
    )
    handles = [Patch(color=STICK, label="stick"), Patch(color=SLIP, label="slip")]
    ax.legend(handles=handles, loc="upper right", handlelength=1.0, borderpad=0.1)
    return ax


@styled
def shear_streamlines(
    snapshot: Snapshot,
    *,
    ax: Axes | None = None,
    largest: float | None = None,
    colorbar: bool = True,
) -> Axes:
    r"""Streamlines of the shear vectors on body 2 over their size :math:`|q|/(\mu p_H)`.

    Blue line: edge of the stick zone; dashed: the Hertz circle.

    Parameters
    ----------
    snapshot : Snapshot
        The contact to show.
    ax : matplotlib Axes, optional
        Where to draw.
    largest : float, optional
        End of the colour scale, so that several maps can share it (default: the largest size).
    colorbar : bool
        Whether to draw the scale beside the map.
    """
    ax = axes(ax, square=True)
    extent = frame(ax, snapshot)
    d = snapshot.dataset
    contact = d.contact.values.astype(bool)
    x, y = (d[k].values / snapshot.a_H for k in ("x", "y"))
    q_x, q_y = (np.where(contact, d[k].values, np.nan) for k in ("q_x", "q_y"))
    image = ax.imshow(
        np.hypot(q_x, q_y).T / (snapshot.mu * snapshot.p_H),
        origin="lower",
        extent=extent,
        cmap="YlGnBu",
        alpha=0.75,
        vmin=0,
        vmax=largest,
    )
    if colorbar:
        label_scale(ax.get_figure(), image, ax)
    ax.streamplot(x, y, q_x.T, q_y.T, density=1.3, color="0.15", linewidth=0.6, arrowsize=0.6)
    stick = np.where(contact, d.stick.values, np.nan)
    if np.nanmin(stick) < np.nanmax(stick):
        ax.contour(x, y, stick.T, levels=[0.5], colors=[STICK], linewidths=1.2)
    ax.set_xlim(extent[:2])
    ax.set_ylim(extent[2:])
    return ax


def label_scale(figure: Any, image: AxesImage, ax: Axes | Sequence[Axes]) -> None:
    """Draw the colour scale of the size of the shear beside `ax`."""
    bar = figure.colorbar(image, ax=ax, shrink=0.85, pad=0.02)
    bar.set_label(r"$|q|/(\mu\, p_H)$")
    bar.outline.set_visible(False)
