"""The figure of measured loops."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pyfret._util.theme import STICK
from pyfret.plot.style import axes, styled

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

__all__ = ["measured_loops"]


@styled
def measured_loops(
    delta: NDArray[np.float64], T: NDArray[np.float64], ax: Axes | None = None
) -> Axes:
    """Draw the force [N] of measured loops over their shift [m]."""
    ax = axes(ax)
    ax.set_xlabel("shift [um]")
    ax.plot(1e6 * delta, T, ".-", color=STICK, markersize=3, linewidth=0.6)
    ax.set_ylabel("force [N]")
    return ax
