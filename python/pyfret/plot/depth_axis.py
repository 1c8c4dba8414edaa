"""An axis of depth on which thin layers can be seen."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np
from matplotlib.ticker import FixedFormatter, FixedLocator, MaxNLocator, NullLocator

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

#: Part of the axis that a layer gets at least where the axis is stretched.
LEAST = 0.16
#: Part of the depth shown below which a layer cannot be seen.
INVISIBLE = 0.06


def interfaces(z: xr.DataArray, layer: xr.DataArray) -> list[float]:
    """Depths at which the layer changes."""
    changes = np.flatnonzero(np.diff(layer.values))
    return [float(z[n] + z[n + 1]) / 2 for n in changes]


def stretched(borders: NDArray[np.float64]) -> NDArray[np.float64]:
    """Places of the borders of layers on an axis from 0 to 1 that gives each layer room."""
    shares = np.diff(borders) / (borders[-1] - borders[0])
    least = min(LEAST, 0.8 / shares.size)
    thin = shares < least
    rest = 1.0 - least * np.count_nonzero(thin)
    shares = np.where(thin, least, rest * shares / max(shares[~thin].sum(), 1e-300))
    return np.concatenate(([0.0], np.cumsum(shares)))


def thin(borders: NDArray[np.float64]) -> bool:
    """Whether a layer is too thin to be seen on an even axis."""
    steps = np.diff(borders)
    return steps.size > 1 and bool(steps.min() < INVISIBLE * (borders[-1] - borders[0]))


def stretch(ax: Axes, borders: NDArray[np.float64], which: Literal["x", "y"]) -> None:
    """Give every layer room on an axis: even within a layer, another scale in each."""
    places = stretched(borders)
    span = borders[-1] - borders[0]

    def onward(z: NDArray[np.float64]) -> NDArray[np.float64]:
        beyond = np.minimum(z - borders[0], 0) + np.maximum(z - borders[-1], 0)
        return np.asarray(np.interp(z, borders, places) + beyond / span)

    def back(place: NDArray[np.float64]) -> NDArray[np.float64]:
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
    axis.set_major_formatter(FixedFormatter([f"{tick:.{2 if tick < 1 else 3}g}" for tick in ticks]))
    if which == "x":
        # Neighbouring borders would write over one another.
        ax.tick_params(axis="x", labelrotation=45)
    axis.set_minor_locator(NullLocator())
