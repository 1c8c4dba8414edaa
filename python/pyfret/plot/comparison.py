"""Candidates side by side: a panel for every number."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

from pyfret._util.text import literal
from pyfret._util.theme import MARK, REFERENCE, STICK
from pyfret.plot.sizes import Width, new_panels
from pyfret.plot.style import styled

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

__all__ = ["Panel", "comparison"]

#: Width of a panel, and the height of a candidate in it [inch].
WIDTH, HEIGHT = 2.9, 0.34
#: Highest over lowest value from which an axis is logarithmic.
DECADE = 10.0
#: End of a range without one, and colours of :attr:`Panel.order`.
MOST = 1e300
COLOURS = (REFERENCE, STICK, MARK)


class Panel(NamedTuple):
    """A number of all candidates, in the unit of its axis."""

    title: str
    unit: str
    #: "smaller" or "larger"; empty where the candidates cannot be compared by it.
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
def comparison(of: SideBySide, *, width: Width | None = None) -> Figure:
    """Draw the numbers of a comparison, a panel each, with the range that their error leaves.

    Blue: no other candidate is better beyond the errors. Orange: another one is better. Grey: no
    difference among all. An arrow begins at the least value of a number without an upper end, such
    as a life of 1e7 cycles or more. Stresses in different materials have no better one: compare
    stress over strength.

    Parameters
    ----------
    of : Comparison
        As :func:`pyfret.compare` gives it.
    width : "column" or "page", optional
        Width of a new figure: a column of 85 mm or a page of 170 mm.
    """
    panels, candidates = of.panels(), of.candidates
    high = HEIGHT * len(candidates) + 0.95
    figure, axes = new_panels(len(panels), size=(WIDTH, high), across=(3, 2, 1), sharey=True)
    for ax, panel in zip(axes.flat, panels, strict=False):
        draw(ax, panel)
    axes[0, 0].set_yticks(range(len(candidates)), [literal(candidate) for candidate in candidates])
    return figure


def draw(ax: Axes, panel: Panel) -> None:
    """Draw one number of all candidates."""
    values, low, high = panel.values, panel.low, panel.high
    finite = values[np.isfinite(values)]
    bounds: list[float] = []
    for n, value in enumerate(values):
        if np.isfinite(value):
            ends = [[value - low[n]], [min(high[n], MOST) - value]]
            colour = COLOURS[panel.order[n]]
            ax.errorbar(value, n, xerr=ends, fmt="o", color=colour, capsize=3, ms=5)
        elif np.isfinite(low[n]) and value > 0.0:
            # An arrow from the least value that the range has.
            start = max(low[n], 0.0)
            ax.plot(start, n, ">", color=COLOURS[panel.order[n]], ms=6)
            ax.annotate(
                "",
                (1.0, n),
                (start, n),
                xycoords=ax.get_yaxis_transform(),
                textcoords=ax.transData,
                arrowprops={"arrowstyle": "->", "color": COLOURS[panel.order[n]], "lw": 1.4},
            )
            bounds.append(start)
        else:
            ax.text(
                0.5,
                n,
                "no answer" if np.isnan(value) else panel.texts[n],
                transform=ax.get_yaxis_transform(),
                ha="center",
                va="center",
                color="0.35",
            )
    shown = np.array([*finite, *bounds])
    if bounds and shown.min() > 0.0:
        ax.set_xscale("log")
        ax.set_xlim(10.0 ** (np.floor(np.log10(shown.min())) - 0.3), 10.0 * shown.max())
    elif panel.logarithmic and finite.size and finite.max() > DECADE * finite.min():
        ax.set_xscale("log")
    elif finite.size and finite.min() > 0.0 and not panel.logarithmic:
        ax.set_xlim(left=0.0)
    if not shown.size:
        ax.set_xticks([])
    ax.set_ylim(values.size - 0.5, -0.5)
    ax.grid(visible=False, axis="y")
    ax.set_title(panel.title)
    better = f"{panel.better} is better" if panel.better else "different materials"
    unit = panel.unit.replace("u", "µ") if panel.unit.startswith("u") else panel.unit
    ax.set_xlabel(better if unit == "1" else f"[{unit}], {better}")
