"""Candidates side by side: a panel for every number."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Protocol

import matplotlib.pyplot as plt
import numpy as np

from pyfret._util.text import literal
from pyfret._util.theme import MARK, REFERENCE, STICK
from pyfret.plot.style import styled

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

__all__ = ["Panel", "comparison"]

#: Panels beside each other, and the size of one [inch].
ACROSS, WIDTH, HEIGHT = 3, 2.9, 0.34
#: Highest over lowest value from which an axis is logarithmic.
DECADE = 10.0
#: End of a range without one, and colours of :attr:`Panel.order`.
MOST = 1e300
COLOURS = (REFERENCE, STICK, MARK)


class Panel(NamedTuple):
    """A number of all candidates, in the unit of its axis."""

    title: str
    unit: str
    #: "smaller" or "larger".
    better: str
    #: Values with their ranges, as the table has them: for those that no point can show.
    texts: Sequence[str]
    #: Whether its error is a factor.
    logarithmic: bool
    values: NDArray[np.float64]
    low: NDArray[np.float64]
    high: NDArray[np.float64]
    #: Of each candidate 0 where there is no difference among all, 1 where no other is better, 2
    #: where another one is.
    order: Sequence[int]


class SideBySide(Protocol):
    """An object with candidates and the numbers of each."""

    @property
    def candidates(self) -> list[str]:
        """Names of the candidates."""

    def panels(self) -> list[Panel]:
        """The numbers."""


@styled
def comparison(of: SideBySide) -> Figure:
    """Draw the numbers of a comparison, a panel each, with the range that their error leaves.

    Blue: no other candidate is better beyond the errors. Orange: another one is better. Grey: no
    difference among all.

    Parameters
    ----------
    of : Comparison
        As :func:`pyfret.compare` gives it.
    """
    panels, candidates = of.panels(), of.candidates
    across = min(ACROSS, len(panels))
    down = -(-len(panels) // across)
    figure, axes = plt.subplots(
        down,
        across,
        figsize=(WIDTH * across, (HEIGHT * len(candidates) + 0.95) * down),
        layout="constrained",
        squeeze=False,
        sharey=True,
    )
    for ax, panel in zip(axes.flat, panels, strict=False):
        draw(ax, panel)
    for ax in axes.flat[len(panels) :]:
        ax.set_axis_off()
    axes[0, 0].set_yticks(range(len(candidates)), [literal(candidate) for candidate in candidates])
    return figure


def draw(ax: Axes, panel: Panel) -> None:
    """One number of all candidates."""
    values, low, high = panel.values, panel.low, panel.high
    finite = values[np.isfinite(values)]
    for n, value in enumerate(values):
        if np.isfinite(value):
            ends = [[value - low[n]], [min(high[n], MOST) - value]]
            colour = COLOURS[panel.order[n]]
            ax.errorbar(value, n, xerr=ends, fmt="o", color=colour, capsize=3, ms=5)
        else:
            ax.text(
                0.5,
                n,
                "no answer" if np.isnan(value) else panel.texts[n],
                transform=ax.get_yaxis_transform(),
                ha="center",
                va="center",
                color="0.4",
                fontsize=7,
            )
    if panel.logarithmic and finite.size and finite.max() > DECADE * finite.min():
        ax.set_xscale("log")
    elif finite.size and finite.min() > 0.0 and not panel.logarithmic:
        ax.set_xlim(left=0.0)
    if not finite.size:
        ax.set_xticks([])
    ax.set_ylim(values.size - 0.5, -0.5)
    ax.grid(visible=False, axis="y")
    ax.set_title(panel.title, fontsize=8)
    better = f"{panel.better} is better"
    unit = panel.unit.replace("u", "µ") if panel.unit.startswith("u") else panel.unit
    ax.set_xlabel(better if unit == "1" else f"[{unit}], {better}", fontsize=7)
