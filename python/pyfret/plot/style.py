"""The look shared by all figures."""

from __future__ import annotations

from contextlib import AbstractContextManager
from pathlib import Path

import matplotlib.pyplot as plt
from matplotlib.axes import Axes

#: Colours with a meaning, of the Okabe-Ito palette.
STICK = "#0072B2"
SLIP = "#F2C9A9"
REFERENCE = "#9A9A9A"


def style() -> AbstractContextManager[None]:
    """Set the look of figures made inside the ``with`` block."""
    return plt.style.context(Path(__file__).with_name("pyfret.mplstyle"))


def axes(ax: Axes | None, *, square: bool = False) -> Axes:
    """Give `ax`, or the axes of a new figure; `square` ones for maps of the contact plane."""
    if ax is None:
        with style():
            ax = plt.figure(figsize=(4.2, 3.9) if square else None).add_subplot()
    if square:
        ax.set_aspect("equal")
        ax.grid(visible=False)
    return ax
