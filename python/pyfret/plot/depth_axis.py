"""An axis of depth on which thin layers can be seen."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np
from matplotlib.ticker import FixedFormatter, FixedLocator, MaxNLocator, NullLocator

from pyfret._util.depths import stretched, thin
from pyfret._util.numbers import in_words

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from pyfret.plot.scales import Scale

#: One scale of depth, a scale for each layer, or the one that shows all layers.
DepthScale: TypeAlias = Literal["auto", "true", "layers"]
#: Words behind the label of an axis whose scale changes from layer to layer.
SCALES = "each layer has its own scale"


def draw_depth_axis(
    ax: Axes,
    borders: NDArray[np.float64],
    which: Literal["x", "y"],
    by: Scale,
    *,
    depth: DepthScale = "auto",
    substrate: bool = True,
) -> bool:
    """Label an axis of depth; return whether each layer has a scale of its own.

    Parameters
    ----------
    ax : matplotlib Axes
        The axes.
    borders : array
        Depths of the surface, of the interfaces and of the deepest point, in the unit of the axis.
    which : "x" or "y"
        The axis.
    by : Scale
        Unit of the depths.
    depth : "auto", "true" or "layers"
        One scale, or a scale for each layer (default: if one is too thin to be seen).
    substrate : bool
        Whether the deepest point lies in the substrate.
    """
    label = by.label("z")
    if depth not in ("auto", "true", "layers"):
        raise ValueError(f'depth = {depth!r}: must be "auto", "true" or "layers"')
    stretch = (thin(borders) if depth == "auto" else depth == "layers") and borders.size > 2
    if stretch:
        stretch_axis(ax, borders, which)
        name_layers(ax, borders, which, by, substrate=substrate)
        label += f"; {SCALES}" if which == "x" else f"\n{SCALES}"
    (ax.set_ylabel if which == "y" else ax.set_xlabel)(label)
    return stretch


def stretch_axis(ax: Axes, borders: NDArray[np.float64], which: Literal["x", "y"]) -> None:
    """Give every layer enough room on an axis: linear within a layer, another scale in each."""
    places = stretched(borders)
    span = borders[-1] - borders[0]

    def onward(z: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the places of depths on the axis."""
        beyond = np.minimum(z - borders[0], 0) + np.maximum(z - borders[-1], 0)
        return np.asarray(np.interp(z, borders, places) + beyond / span)

    def back(place: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the depths of places on the axis."""
        beyond = np.minimum(place, 0) + np.maximum(place - 1, 0)
        return np.asarray(np.interp(place, places, borders) + span * beyond)

    set_scale = ax.set_yscale if which == "y" else ax.set_xscale
    set_scale("function", functions=(onward, back))
    axis = ax.yaxis if which == "y" else ax.xaxis
    # The borders, and below the last one a few places of the substrate.
    below = MaxNLocator(3).tick_values(borders[-2], borders[-1])
    far = places[-2] + 0.08
    ticks = [*borders[:-1], *(z for z in below if z <= borders[-1] and onward(np.array(z)) > far)]
    axis.set_major_locator(FixedLocator(ticks))
    numbers = [in_words(tick, 2 if tick < 1 else 3) for tick in ticks]
    axis.set_major_formatter(FixedFormatter(numbers))
    if which == "x":
        # Neighbouring borders would write over one another.
        ax.tick_params(axis="x", labelrotation=45)
    axis.set_minor_locator(NullLocator())


def name_layers(
    ax: Axes, borders: NDArray[np.float64], which: Literal["x", "y"], by: Scale, *, substrate: bool
) -> None:
    """Write name and thickness into each layer, and mark each change of the scale."""
    places, unit = stretched(borders), by.name if by.is_unit else f"${by.name}$"
    middles = np.interp((places[:-1] + places[1:]) / 2, places, borders)
    for n, (middle, thickness) in enumerate(zip(middles, np.diff(borders), strict=True)):
        deepest = n == middles.size - 1
        options: dict[str, Any]
        name = "substrate" if deepest and substrate else f"coating {n + 1}"
        size = "" if deepest else f"{in_words(thickness)} {unit}"
        if which == "y":
            text = f"{name}, {size}".rstrip(", ")
            box = {"boxstyle": "round,pad=0.1", "fc": "white", "ec": "none", "alpha": 0.7}
            options = {"transform": ax.get_yaxis_transform(), "va": "center", "bbox": box}
            ax.text(0.015, middle, text, fontsize=7, zorder=6, clip_on=True, **options)
        else:
            text = f"{name}\n{size}".rstrip()
            options = {"transform": ax.get_xaxis_transform(), "ha": "center", "va": "bottom"}
            ax.text(middle, 1.01, text, fontsize=7, **options)
            if n % 2 == 0 and not deepest:
                ax.axvspan(borders[n], borders[n + 1], color="0.5", alpha=0.12, linewidth=0)
    # A break mark across the axis at each change of the scale.
    transform = ax.get_yaxis_transform() if which == "y" else ax.get_xaxis_transform()
    zero = np.zeros(borders.size - 2)
    marks = (zero, borders[1:-1]) if which == "y" else (borders[1:-1], zero)
    slanted = [(-1.0, -0.6), (1.0, 0.6)]
    ax.plot(
        *marks,
        linestyle="none",
        marker=slanted,
        markersize=9,
        color="0.2",
        clip_on=False,
        transform=transform,
        zorder=6,
    )
