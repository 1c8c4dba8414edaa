"""Sizes of figures: of a screen, of a column and of a page of a paper."""

from __future__ import annotations

from contextlib import contextmanager
from contextvars import ContextVar
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import matplotlib.pyplot as plt
import numpy as np

from pyfret._util.theme import TEXT, TEXT_OF_COLUMNS, WIDTHS

if TYPE_CHECKING:
    from collections.abc import Iterator

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

__all__ = ["Width", "new_axes", "new_figure", "new_panels", "sized", "text_size", "using_width"]

#: Width of a figure: a column of 85 mm or a page of 170 mm.
Width: TypeAlias = Literal["column", "page"]
#: Width of the figure that is drawn; None for a screen.
CURRENT: ContextVar[Width | None] = ContextVar("width", default=None)
#: Height over width of a single panel, the least and the most, in a column and on a page.
FORMS = {"column": (0.72, 1.3), "page": (0.5, 0.9)}
#: Height over width of a figure of several panels, as high as the text of a page at most.
TALL = {"column": 2.75, "page": 1.36}
#: Height over width of a panel in a column, over its form on a screen.
NARROWER = 0.82


@contextmanager
def using_width(width: Width | None) -> Iterator[None]:
    """Draw figures of a width inside the ``with`` block."""
    if width is not None and width not in WIDTHS:
        raise ValueError(f'width = {width!r}: must be "column" or "page"')
    token = CURRENT.set(width)
    try:
        yield
    finally:
        CURRENT.reset(token)


def text_size() -> float:
    """Return the size of the text [points]."""
    return TEXT_OF_COLUMNS if CURRENT.get() == "column" else TEXT


def sized(size: tuple[float, float]) -> tuple[float, float]:
    """Return the size of a figure of one panel [inch], from its size on a screen."""
    width = CURRENT.get()
    if width is None:
        return size
    form = float(np.clip(size[1] / size[0], *FORMS[width]))
    return WIDTHS[width], WIDTHS[width] * form


def new_figure(size: tuple[float, float] | None = None) -> Figure:
    """Return a new figure; `size` [inch] is its size on a screen."""
    return plt.figure(figsize=sized(size or tuple(plt.rcParams["figure.figsize"])))


def new_axes(size: tuple[float, float] | None = None, **options: Any) -> Axes:
    """Return the axes of a new figure; `size` [inch] is its size on a screen."""
    ax: Axes = new_figure(size).add_subplot(**options)
    return ax


def new_panels(
    count: int,
    *,
    size: tuple[float, float],
    across: tuple[int, int, int],
    **options: Any,
) -> tuple[Figure, NDArray[Any]]:
    """Return a new figure of several panels and an array of their axes, row by row.

    Parameters
    ----------
    count : int
        Number of panels.
    size : (float, float)
        Size of a panel on a screen [inch].
    across : (int, int, int)
        Panels beside each other on a screen, on a page, and in a column.
    **options
        Passed on to ``subplots``.
    """
    width = CURRENT.get()
    columns = min(count, across[(None, "page", "column").index(width)])
    rows = -(-count // columns)
    whole = (size[0] * columns, size[1] * rows)
    if width is not None:
        form = whole[1] / whole[0] * (NARROWER if width == "column" else 1.0)
        form = min(form, TALL[width])
        whole = (WIDTHS[width], WIDTHS[width] * form)
    figure, grid = plt.subplots(
        rows, columns, figsize=whole, squeeze=False, layout="constrained", **options
    )
    for ax in grid.flat[count:]:
        ax.set_axis_off()
    return figure, grid
