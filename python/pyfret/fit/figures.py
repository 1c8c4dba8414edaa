"""Figures of a fit: measured over computed, and what is left."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pyfret._core import measured_by
from pyfret._util.theme import STICK
from pyfret.plot.style import axes, styled

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from pyfret.fit.data import Measured

__all__ = ["curves", "residuals"]

#: Factors and names of the units that the figures show.
SHOWN = {"[m]": (1e6, "[um]"), "[N]": (1.0, "[N]")}


def shown(label: str, values: NDArray[np.float64]) -> tuple[NDArray[np.float64], str]:
    """Return values in the unit of a figure, and their label."""
    for unit, (factor, name) in SHOWN.items():
        if label.endswith(unit):
            return factor * values, label.replace(unit, name)
    return values, label


def in_words(key: str, value: float, *, per_metre: bool) -> str:
    """Return an unknown with its value, and its unit in a three-dimensional contact."""
    measured = measured_by(key)
    unit = "" if measured is None or per_metre else measured[1]
    return f"{key} = {value:.4g} {unit}".rstrip()


@styled
def curves(
    of: Measured,
    computed: NDArray[np.float64],
    values: Mapping[str, float],
    ax: Axes | None = None,
) -> Axes:
    """Draw the measurement as points and the fitted computation as a line."""
    ax = axes(ax)
    along, label = shown(of.labels[0], of.along)
    ax.set_xlabel(label)
    measured, label = shown(of.labels[1], of.measured)
    line, _ = shown(of.labels[1], computed)
    ax.plot(along, measured, ".", color="0.55", markersize=3, label="measured")
    down = getattr(of.data, "down", None)
    parts = [np.ones(along.size, bool)] if down is None else [down, ~down]
    for n, part in enumerate(parts):
        order = np.argsort(along[part], kind="stable")
        name = "computed" if n == 0 else None
        ax.plot(along[part][order], line[part][order], color=STICK, label=name)
    ax.set_ylabel(label)
    # Loads of a line contact are per metre of its width.
    per_metre = "/m]" in of.labels[1]
    legend_title = "\n".join(
        in_words(key, value, per_metre=per_metre) for key, value in values.items()
    )
    ax.legend(title=legend_title, title_fontsize="small", fontsize="small")
    return ax


@styled
def residuals(of: Measured, left_over: NDArray[np.float64], ax: Axes | None = None) -> Axes:
    """Draw measured less computed values, which should scatter about zero without a pattern."""
    ax = axes(ax)
    along, label = shown(of.labels[0], of.along)
    ax.set_xlabel(label)
    residuals_scaled, label = shown(of.labels[1], left_over)
    down = getattr(of.data, "down", None)
    parts = {"": np.ones(along.size, bool)} if down is None else {"back": down, "forth": ~down}
    for name, part in parts.items():
        ax.plot(along[part], residuals_scaled[part], ".", markersize=3, label=name or None)
    ax.axhline(0.0, color="0.5", linewidth=0.8)
    ax.set_ylabel(f"measured less computed: {label}")
    if down is not None:
        ax.legend(fontsize="small")
    return ax
