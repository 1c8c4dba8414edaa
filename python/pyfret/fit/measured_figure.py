"""The figure of what was measured: loops, a scar, an indentation curve, lives."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pyfret._util.theme import STICK
from pyfret.plot.style import axes, styled

if TYPE_CHECKING:
    from collections.abc import Mapping

    import pandas as pd
    from matplotlib.axes import Axes

__all__ = ["measured_points"]


@styled
def measured_points(
    table: pd.DataFrame, columns: Mapping[str, tuple[str, str]], ax: Axes | None = None
) -> Axes:
    """Draw the last column over the first one, lengths in um; depths grow downwards."""
    ax = axes(ax)
    numbers, labels = [], []
    for n, (unit, meaning) in enumerate(columns.values()):
        is_length = unit == "m"
        numbers.append((1e6 if is_length else 1.0) * table.iloc[:, n].to_numpy())
        labels.append(meaning if unit == "1" else f"{meaning} [{'um' if is_length else unit}]")
    if len(numbers) == 1:
        numbers.insert(0, np.arange(1, len(table) + 1))
        labels.insert(0, "test")
    ax.set_xlabel(labels[0])
    ax.set_ylabel(labels[-1])
    ax.plot(numbers[0], numbers[-1], ".-", color=STICK, markersize=3, linewidth=0.6)
    if "downwards" in labels[-1]:
        ax.invert_yaxis()
    return ax
