"""Bodies that yield: the zone that has, and the stress that it leaves."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.ticker import MaxNLocator

from pyfret._util.lazy import xr
from pyfret._util.theme import colour_map
from pyfret.plot.depth_axis import DepthScale, draw_depth_axis
from pyfret.plot.scales import Units, last_of, scales_of_snapshot
from pyfret.plot.sizes import Width, new_axes
from pyfret.plot.stresses import SYMBOLS
from pyfret.plot.style import axes, styled
from pyfret.quantities import Length, as_number
from pyfret.subsurface.fields import interfaces
from pyfret.subsurface.line import cut, main_line
from pyfret.subsurface.plastic import PlasticState
from pyfret.subsurface.unloaded import Unloaded

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from pyfret.run import Run, State
    from pyfret.subsurface.line import Line

#: Room around the zone that has yielded, over its width and depth.
ROOM = 0.25
#: Plastic strain that is coloured at all, over the first step of the colours.
LEAST = 0.02


@styled
def plastic_zone(
    shown: State | Run,
    *,
    body_number: int | None = None,
    units: Units = "auto",
    depth: DepthScale = "auto",
    width: Width | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Equivalent plastic strain of a body that yields on the section along the shear.

    The section goes through the centre of the contact, as in :meth:`Snapshot.stress`; depth
    is downwards.

    Parameters
    ----------
    shown : Snapshot or Result
        The contact; of a result the last increment that it has kept.
    body_number : 1 or 2, optional
        The body (default: as in :attr:`Snapshot.plastic`).
    units : "auto", "dimensionless" or "SI"
        Lengths over a_H (default where there is a Hertz contact), or in um.
    depth : "auto", "true" or "layers"
        Whether depths have one scale, or each layer a scale of its own (default: if one layer is
        too thin to be seen).
    width : "column" or "page", optional
        Width of a new figure: a column of 85 mm or a page of 170 mm.
    ax : matplotlib Axes, optional
        Where to draw.
    """
    state = last_of(shown)
    plastic = PlasticState(state, body_number)
    by = scales_of_snapshot(state, units)
    line = main_line(state)
    middle = _on_line(plastic, state, line)
    percent = 100.0 * middle.values
    x, z = middle[line.axis].values / by.length.value, plastic.dataset.z.values / by.length.value
    layers = plastic.dataset.layer.values
    yielded = percent > 0.0
    deepest, outline = z[-1], state.outline
    middle_x = 0.0 if outline is None else line.place(*outline.centre) / by.length.value
    widest = np.abs(x - middle_x).max()
    if yielded.any():
        deepest = z[yielded.any(axis=1)].max()
        widest = min(np.abs(x[yielded.any(axis=0)] - middle_x).max() * (1.0 + ROOM), widest)
    deepest *= 1.0 + ROOM
    if ax is None:
        high = np.clip(3.3 * deepest / (2.0 * widest) + 0.7, 1.8, 6.0)
        ax = new_axes((4.8, float(high)))
    inner = [d / by.length.value for d in interfaces(state.body(plastic.body_number))]
    borders = np.array([0.0, *(d for d in inner if d < deepest), deepest])
    whole = len(borders) == len(inner) + 2
    stretch = draw_depth_axis(ax, borders, "y", by.length, depth=depth, substrate=whole)
    image = None
    if yielded.any():
        steps = MaxNLocator(9).tick_values(0.0, percent.max())
        # What has not yielded stays white.
        levels = [LEAST * steps[1], *steps[1:]]
        for layer in np.unique(layers):
            in_layer = layers == layer
            if np.count_nonzero(in_layer) < 2 or not yielded[in_layer].any():
                continue
            image = ax.contourf(
                x, z[in_layer], percent[in_layer], levels=levels, cmap=colour_map("sequential")
            )
            ax.contour(
                x, z[in_layer], percent[in_layer], levels=steps[1:], colors="0.2", linewidths=0.4
            )
    else:
        ax.text(0.5, 0.5, "nothing has yielded", transform=ax.transAxes, ha="center")
    for border in inner:
        if border < deepest:
            ax.axhline(border, color="0.2", linewidth=0.8, linestyle=(0, (6, 3)))
    if outline is not None:
        ends = middle_x + np.array(outline.border(line.angle)) / by.length.value
        ax.plot(ends, [0.0, 0.0], color="k", linewidth=3.0, clip_on=False, zorder=5)
    label = "equivalent plastic strain [%]"
    if image is not None:
        beside = ax.inset_axes((1.03, 0.0, 0.05, 1.0))
        bar = ax.get_figure().colorbar(image, cax=beside)  # type: ignore[union-attr]
        bar.outline.set_visible(False)
        bar.set_label(label)
        bar.set_ticks(steps[1:])
    else:
        ax.set_title(label)
    ax.set_xlim(middle_x - widest, middle_x + widest)
    ax.set_ylim(deepest, 0.0)
    ax.set_xlabel(by.length.label(line.axis))
    if not stretch:
        ax.set_aspect("equal")
    ax.grid(visible=False)
    return ax


def _on_line(plastic: PlasticState, state: State, line: Line) -> xr.DataArray:
    """Return the equivalent strain below a line, over depth and place; 0 beside what may yield."""
    d = plastic.dataset[["equivalent"]].transpose("z", "x", "y")
    strain: xr.DataArray = cut(d, state.scene.grid, line).equivalent
    inside = np.ones(strain.sizes[line.axis], dtype=bool)
    for name in ("x", "y"):
        cells = d[name].values
        if cells.size > 1:
            at = strain[name].values if name in strain.coords else getattr(line, name)
            half = 0.5 * (cells[1] - cells[0])
            inside &= (at >= cells[0] - half) & (at <= cells[-1] + half)
    strain = strain.where(xr.DataArray(inside, dims=line.axis), 0.0).fillna(0.0)
    return strain


@styled
def residual_stress(
    shown: State | Run,
    *,
    body_number: int | None = None,
    of: tuple[str, ...] = ("s_xx", "s_yy", "s_zz"),
    x: Length | None = None,
    y: Length | None = None,
    units: Units = "auto",
    depth: DepthScale = "auto",
    width: Width | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Residual stress of plastic strain below a point over the depth, tension upwards.

    That with the contact taken apart.

    Parameters
    ----------
    shown : Snapshot or Result
        The contact; of a result the last increment that it has kept.
    body_number : 1 or 2, optional
        The body (default: as in :attr:`Snapshot.plastic`).
    of : sequence of str
        Measures, as in :class:`pyfret.subsurface.Stress`.
    x, y : float, optional
        The point [m] (default: the centre of the contact).
    units : "auto", "dimensionless" or "SI"
        Over p_H and a_H (default where there is a Hertz contact), or in MPa and um.
    depth : "auto", "true" or "layers"
        Whether depths have one scale, or each layer a scale of its own (default: if one layer is
        too thin to be seen).
    width : "column" or "page", optional
        Width of a new figure: a column of 85 mm or a page of 170 mm.
    ax : matplotlib Axes, optional
        Where to draw.
    """
    state = last_of(shown)
    number = PlasticState(state, body_number).body_number
    ax, by = axes(ax), scales_of_snapshot(state, units)
    centre = (0.0, 0.0) if state.outline is None else state.outline.centre
    x, y = (
        c if at is None else at for at, c in zip((as_number(x), as_number(y)), centre, strict=True)
    )
    below = Unloaded(state, warn=False).stress(x=x, y=y, body_number=number)
    z, layer = below.dataset.z.values / by.length.value, below.dataset.layer.values
    inner = [d / by.length.value for d in interfaces(state.body(number))]
    borders = np.array([z[0], *(d for d in inner if d < z[-1]), z[-1]])
    draw_depth_axis(
        ax, borders, "x", by.length, depth=depth, substrate=len(borders) == len(inner) + 2
    )
    for n, name in enumerate(of):
        values = below.measure(name).values / by.stress.value
        for part in np.unique(layer):
            in_layer = layer == part
            label = f"${SYMBOLS.get(name, name)}$" if part == layer[0] else None
            # On an axis of symmetry two of the stresses are one line.
            dashes = (0, (3, 3)) if name == "s_yy" else "-"
            ax.plot(z[in_layer], values[in_layer], color=f"C{n}", linestyle=dashes, label=label)
    ax.axhline(0.0, color="0.6", linewidth=0.8, zorder=0)
    for border in borders[1:-1]:
        ax.axvline(border, color="0.6", linewidth=0.8, linestyle=(0, (6, 3)), zorder=0)
    ax.set_xlim(z[0], z[-1])
    symbol = r"\sigma_\mathrm{residual}"
    ax.set_ylabel(by.stress.label(symbol))
    ax.legend()
    return ax
