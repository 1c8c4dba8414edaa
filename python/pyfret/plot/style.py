"""The look shared by all figures."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import wraps
from importlib import import_module
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar, overload

import matplotlib
import matplotlib.pyplot as plt
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import is_color_like, to_hex
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from pyfret._util.theme import MARK, settings
from pyfret.plot.fit import fit
from pyfret.plot.sizes import Width, new_axes, text_size, using_width
from pyfret.quantities import quantities

#: Whether a figure is being drawn: figures inside it take its look and its size.
DRAWING: ContextVar[bool] = ContextVar("drawing", default=False)


@contextmanager
def style() -> Iterator[None]:
    """Set the theme inside the ``with`` block, whatever the settings of the user."""
    with plt.style.context(settings(text_size()), after_reset=True):
        try:
            yield
        finally:
            # The first figure starts the backend, and a notebook's backend turns this on: it is no
            # matter of looks, and without it no later cell shows its figures.
            interactive = plt.isinteractive()
    (plt.ion if interactive else plt.ioff)()


class ThemedFigure(Figure):
    """A figure that keeps the theme when it is shown or saved.

    Matplotlib reads fonts, colours by number and the options of file formats while it writes a
    file. By then the ``with`` block of :func:`style` has ended.
    """

    def draw(self, renderer: Any) -> None:
        """Draw the figure in the theme."""
        with style():
            super().draw(renderer)

    def savefig(self, fname: Any, **options: Any) -> None:
        """Write the figure in the theme; parameters as in matplotlib."""
        with style():
            super().savefig(fname, **options)


if TYPE_CHECKING:
    from matplotlib.colorbar import Colorbar

    class Drawn(Axes):
        """Axes that know their figure: ``.figure.savefig("loop.png")`` writes it.

        Matplotlib leaves open that it may be a part of a figure, as where `ax` lies in one.
        """

        @property
        def figure(self) -> Figure:
            """Return the figure."""


P = ParamSpec("P")
T = TypeVar("T")


@overload
def styled(draw: Callable[P, Axes]) -> Callable[P, Drawn]: ...
@overload
def styled(draw: Callable[P, T]) -> Callable[P, T]: ...


def styled(draw: Callable[P, Any]) -> Callable[P, Any]:
    """Make `draw` work in the shared look, whatever the settings of the user."""

    @wraps(draw)
    def inside(*args: P.args, **kwargs: P.kwargs) -> Any:
        """Call `draw` in the shared look."""
        if DRAWING.get():
            return draw(*args, **kwargs)
        width: Any = kwargs.get("width")
        fresh = kwargs.get("ax") is None
        if width is not None and not fresh:
            raise ValueError("width: belongs to a new figure; give ax or width, not both")
        token = DRAWING.set(True)
        try:
            with using_width(width), style():
                drawn = draw(*args, **kwargs)
                fix_colours(drawn)
                if fresh:
                    keep_theme(drawn)
                    settle(drawn, width)
        finally:
            DRAWING.reset(token)
        if isinstance(drawn, Figure) and "inline" in matplotlib.get_backend():
            show_once(drawn)
        return drawn

    return quantities(inside)


def figure_of(drawn: object) -> Figure | None:
    """Return the figure of axes, or the figure itself; None for anything else."""
    figure = drawn.get_figure(root=True) if isinstance(drawn, Axes) else drawn
    return figure if isinstance(figure, Figure) else None


def keep_theme(drawn: object) -> None:
    """Let a new figure keep the theme when it is shown or saved."""
    figure = figure_of(drawn)
    if type(figure) is Figure:
        figure.__class__ = ThemedFigure


def fix_colours(drawn: object) -> None:
    """Replace colours by number ("C0") with colours of the theme, which hold on saving."""
    figure = figure_of(drawn)
    for line in figure.findobj(Line2D) if figure is not None else ():
        if is_color_like(colour := line.get_color()):
            line.set_color(to_hex(colour, keep_alpha=True))


def show_once(figure: Figure) -> None:
    """Let a notebook show a figure once where it is the value of a cell.

    It shows the value of a cell, and then every figure that is open.
    """

    def show() -> None:
        """Show the figure once."""
        notebook = import_module("IPython.display")
        file = io.BytesIO()
        figure.savefig(file, format="png", bbox_inches="tight")
        notebook.display(notebook.Image(file.getvalue()))
        plt.close(figure)

    figure._ipython_display_ = show  # type: ignore[attr-defined]


def settle(drawn: object, width: Width | None) -> None:
    """Lay out a new figure until no text is cut or lies on another one."""
    figure = figure_of(drawn)
    if figure is not None:
        fit(figure, legends_below=width == "column")


def axes(ax: Axes | None, *, square: bool = False) -> Axes:
    """Give `ax`, or the axes of a new figure; `square` ones for maps of the contact plane."""
    if ax is None:
        ax = new_axes((4.2, 3.9) if square else None)
    if square:
        ax.set_aspect("equal")
        ax.grid(visible=False)
    return ax


def add_colour_bar(ax: Axes, image: Any, label: str, *, extend: str = "neither") -> Colorbar:
    """Add the scale of colours of `image` beside the axes, as high as they are."""
    inset = ax.inset_axes((1.03, 0.0, 0.05, 1.0))
    bar: Colorbar = ax.get_figure().colorbar(image, cax=inset, extend=extend)  # type: ignore[union-attr]
    bar.outline.set_visible(False)
    bar.set_label(label)
    return bar


def mark(ax: Axes, at: tuple[float, float], text: str, *, marker: str = "x") -> None:
    """Mark a place of a section with a legend inside the axes."""
    ax.plot(
        *at,
        marker,
        color=MARK,
        mfc="none",
        ms=7,
        mew=1.6,
        clip_on=False,
        zorder=4,
        label=text,
        linestyle="none",
    )
    keep_inside(ax, *at)
    inside_legend(ax)


def keep_inside(ax: Axes, x: float, y: float, *, room: float = 0.03) -> None:
    """Widen the limits of axes to a marked point, which may lie beyond the drawn section."""
    for low_high, set_limits, coordinate in (
        (ax.get_xlim(), ax.set_xlim, x),
        (ax.get_ylim(), ax.set_ylim, y),
    ):
        first, last = low_high
        span = room * abs(last - first)
        if coordinate < min(first, last):
            set_limits(*(coordinate - span if end == min(first, last) else end for end in low_high))
        elif coordinate > max(first, last):
            set_limits(*(coordinate + span if end == max(first, last) else end for end in low_high))


def draw_cross(ax: Axes, x: float, y: float) -> None:
    """Draw a cross that is seen on light and on dark colours."""
    for colour, width in (("white", 4.0), ("black", 1.8)):
        ax.plot(x, y, "x", color=colour, ms=9, mew=width, clip_on=False, zorder=4)


def inside_legend(ax: Axes, *, handles: list[Artist] | None = None) -> None:
    """Add a legend on the section, deep below the contact, legible on its colours."""
    options = {} if handles is None else {"handles": handles}
    ax.legend(
        loc="lower right",
        frameon=True,
        framealpha=0.85,
        edgecolor="none",
        handlelength=1.0,
        borderpad=0.3,
        **options,
    ).set_zorder(5)


def apart(figure: Figure) -> None:
    """Leave room between the scale of a map and the axis of the next panel."""
    figure.set_layout_engine("constrained", w_pad=0.1, h_pad=0.06)


def note(ax: Axes, text: str) -> None:
    """Say in the middle of empty axes why they are."""
    ax.text(0.5, 0.5, text, transform=ax.transAxes, ha="center", va="center", color="0.4")
