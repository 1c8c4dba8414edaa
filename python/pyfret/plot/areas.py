"""Areas of a map, with borders between its samples."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.patches import Patch
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from pyfret._util.theme import DANGER, SAFE

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.axes import Axes
    from numpy.typing import NDArray

__all__ = ["Raster", "geometric", "logarithmic"]

#: What the codes of a map mean, each with its colour.
Kinds: TypeAlias = "Mapping[int, tuple[str, str]]"
#: Hatching of areas, by their colours.
HATCHES = {DANGER: "//", SAFE: ".."}
#: Points of the raster along either side.
FINE = 300


def geometric(values: NDArray[Any]) -> bool:
    """Return whether numbers rise in geometric rather than in equal steps."""
    if values.dtype.kind not in "if" or values.size < 3 or (values <= 0).any():
        return False
    steps, ratios = np.diff(values), np.diff(np.log(values))
    return bool(np.ptp(ratios) / abs(ratios.mean()) < np.ptp(steps) / abs(steps.mean()))


def logarithmic(ax: Axes, which: str) -> None:
    """Make the axis "x" or "y" logarithmic, with plain numbers at 1, 2 and 5 of each decade."""
    (ax.set_xscale if which == "x" else ax.set_yscale)("log")
    axis = ax.xaxis if which == "x" else ax.yaxis
    axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())


class Raster:
    """A fine raster between the samples of a map, along axes as they are drawn.

    Fields are interpolated linearly along each axis, over the logarithm of coordinates in geometric
    steps. So a border lies where a field reaches its limit, not half way between two samples.

    Parameters
    ----------
    x, y : array
        Coordinates of the samples.
    """

    def __init__(self, x: NDArray[Any], y: NDArray[Any]) -> None:
        self._samples = x, y
        self._log = geometric(x), geometric(y)
        self.x, self.y = (
            fine(values, log=log) for values, log in zip(self._samples, self._log, strict=True)
        )

    def resample(self, field: NDArray[Any]) -> NDArray[np.float64]:
        """Interpolate a field over (y, x) on the raster; NaN beside a sample without a value."""
        (x, y), (log_x, log_y) = self._samples, self._log
        rows = np.array(
            [interpolate_axis(self.x, x, row, log=log_x) for row in np.asarray(field, float)]
        )
        return np.array([interpolate_axis(self.y, y, column, log=log_y) for column in rows.T]).T

    def nearest(self, field: NDArray[Any]) -> NDArray[Any]:
        """Return the values of the nearest samples of a field over (y, x)."""
        places = [
            np.rint(
                interpolate_axis(fine, given_samples, np.arange(given_samples.size), log=log)
            ).astype(int)
            for fine, given_samples, log in zip(
                (self.x, self.y), self._samples, self._log, strict=True
            )
        ]
        near: NDArray[Any] = np.asarray(field)[np.ix_(places[1], places[0])]
        return near

    def draw(self, ax: Axes, codes: NDArray[Any], kinds: Kinds) -> list[Patch]:
        """Fill the areas of every code, NaN left blank, and give their entries of a legend."""
        for which, log in zip("xy", self._log, strict=True):
            if log:
                logarithmic(ax, which)
        colours = ListedColormap([colour for _, colour in kinds.values()])
        norm = BoundaryNorm(np.arange(len(kinds) + 1) + min(kinds) - 0.5, colours.N)
        shown = np.ma.masked_invalid(codes.astype(float))
        ax.pcolormesh(
            self.x,
            self.y,
            shown,
            cmap=colours,
            norm=norm,
            shading="nearest",
            zorder=0,
            rasterized=True,
        )
        ax.set_xlim(self.x[0], self.x[-1])
        ax.set_ylim(self.y[0], self.y[-1])
        ax.grid(visible=False)
        there = [code for code in kinds if (shown == code).any()]
        for code in there:
            if pattern := HATCHES.get(kinds[code][1]):
                self._hatch(ax, shown == code, pattern)
        return [
            Patch(
                facecolor=kinds[code][1],
                edgecolor="0.45",
                linewidth=0.4,
                hatch=HATCHES.get(kinds[code][1]),
                label=kinds[code][0],
            )
            for code in there
        ]

    def _hatch(self, ax: Axes, area: NDArray[Any], pattern: str) -> None:
        """Hatch an area, for grey print and for colour-blind readers."""
        drawn = ax.contourf(
            self.x,
            self.y,
            np.ma.filled(area.astype(float), 0.0),
            levels=[0.5, 1.5],
            colors="none",
            hatches=[pattern],
        )
        drawn.set(edgecolor="0.6", linewidth=0.0, zorder=0.5)


def fine(values: NDArray[Any], *, log: bool) -> NDArray[np.float64]:
    """Return coordinates of the raster; a single sample gets a width of its own."""
    low, high = float(values.min()), float(values.max())
    if low == high:
        half = 0.5 * abs(low) or 0.5
        low, high = low - half, high + half
    return np.asarray(np.geomspace(low, high, FINE) if log else np.linspace(low, high, FINE))


def interpolate_axis(
    places: NDArray[Any], samples: NDArray[Any], values: NDArray[Any], *, log: bool
) -> NDArray[np.float64]:
    """Interpolate linearly over ascending samples, or over their logarithm."""
    order = np.argsort(samples)
    scale = np.log if log else np.asarray
    return np.asarray(
        np.interp(scale(places), scale(samples[order]), np.asarray(values, float)[order])
    )
