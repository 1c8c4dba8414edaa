"""An axis of depth on which thin layers can be seen."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np
from matplotlib.ticker import FixedFormatter, FixedLocator, MaxNLocator, NullLocator

from pyfret._util.depths import stretched
from pyfret._util.numbers import in_words

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray


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
    numbers = [in_words(tick, 2 if tick < 1 else 3) for tick in ticks]
    axis.set_major_formatter(FixedFormatter(numbers))
    if which == "x":
        # Neighbouring borders would write over one another.
        ax.tick_params(axis="x", labelrotation=45)
    axis.set_minor_locator(NullLocator())
