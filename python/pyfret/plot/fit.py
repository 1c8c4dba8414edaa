"""Texts of a figure that fit into it: wrapped labels, fewer numbers on axes, legends below."""

from __future__ import annotations

import math
import re
import warnings
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from matplotlib.axes import Axes
from matplotlib.projections.polar import PolarAxes
from matplotlib.ticker import FixedLocator, LogLocator, MaxNLocator, NullLocator
from matplotlib.transforms import Bbox, ScaledTranslation, blended_transform_factory

if TYPE_CHECKING:
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure
    from matplotlib.legend import Legend
    from matplotlib.text import Text

__all__ = ["fit"]

#: Layouts until all texts have room, at most.
ROUNDS = 5
#: Further layouts of axes of equal lengths.
LAYOUTS = 3
#: Room between a legend below and the labels above it, and beside the border [inch].
GAP, EDGE = 0.04, 0.03
#: Distance of neighbouring numbers of an axis, over the size of their text.
BESIDE = 0.35
#: Part of its row or its column of a figure that a label takes, at most.
PART = 0.85
#: Fewest numbers on an axis.
FEWEST = 2


def fit(figure: Figure, *, legends_below: bool = False) -> None:
    """Lay out a new figure until no text is cut or lies on another one.

    Parameters
    ----------
    figure : matplotlib Figure
        The figure.
    legends_below : bool
        Whether legends stand below their axes, as in a narrow column.
    """
    for n in range(ROUNDS):
        with warnings.catch_warnings():
            # Labels that are not wrapped yet may leave no room.
            warnings.simplefilter("ignore", UserWarning)
            figure.draw_without_rendering()
        changed = False
        for ax in axes_of(figure):
            changed |= wrap_texts(figure, ax)
            changed |= thin_numbers(ax)
            changed |= place_legend(figure, ax, below=legends_below, first=n == 0)
        for legend in figure.legends:
            changed |= narrow_legend(figure, legend, None, {})
        if figure._suptitle is not None:  # type: ignore[attr-defined]
            changed |= wrap(figure._suptitle, figure.bbox.width)  # type: ignore[attr-defined]
        if not changed:
            break
    engine = figure.get_layout_engine()
    # Axes of equal lengths are narrower than their position. The layout decides by how much.
    if engine is not None and any(ax.get_aspect() != "auto" for ax in figure.axes):
        for _ in range(LAYOUTS):
            engine.execute(figure)


def axes_of(figure: Figure) -> list[Axes]:
    """Return the axes of a figure that are seen, scales of colours included."""
    inner = [child for ax in figure.axes for child in ax.child_axes if isinstance(child, Axes)]
    return [ax for ax in [*figure.axes, *inner] if ax.get_visible()]


def wrap_texts(figure: Figure, ax: Axes) -> bool:
    """Wrap titles and labels of axes that are longer than the room that they have."""
    if not ax.axison:
        return wrap(ax._left_title, figure.bbox.x1 - ax.bbox.x0)  # type: ignore[attr-defined]
    changed = False
    position = parent_of(figure, ax).get_subplotspec()
    rows, columns = (1, 1) if position is None else position.get_gridspec().get_geometry()
    whole, box = figure.bbox, ax.bbox
    middle = {"x": (box.x0 + box.x1) / 2, "y": (box.y0 + box.y1) / 2}
    room = {
        "x": min(PART * whole.width / columns, 2 * min(middle["x"], whole.x1 - middle["x"])),
        "y": min(PART * whole.height / rows, 2 * min(middle["y"], whole.y1 - middle["y"])),
    }
    for which, axis in (("x", ax.xaxis), ("y", ax.yaxis)):
        if axis.label.get_visible():
            changed |= wrap(axis.label, room[which])
    for title in (ax.title, ax._left_title, ax._right_title):  # type: ignore[attr-defined]
        changed |= wrap(title, figure.bbox.x1 - ax.bbox.x0)
    return changed


def parent_of(figure: Figure, ax: Axes) -> Axes:
    """Return the axes that a scale of colours stands beside; other axes as they are."""
    return next((owner for owner in figure.axes if ax in owner.child_axes), ax)


def wrap(text: Text, room: float) -> bool:
    """Break a text into as many lines as its room takes [pixels]."""
    words = text.get_text()
    if not words.strip():
        return False
    box = text.get_window_extent()
    upright = text.get_rotation() % 180.0 == 90.0
    length = box.height if upright else box.width
    if length <= room:
        return False
    lines = words.split("\n")
    longest = max(visible_length(line) for line in lines)
    limit = longest * room / length
    text.set_text(
        "\n".join(in_lines(line, math.ceil(visible_length(line) / limit)) for line in lines)
    )
    return text.get_text() != words


def visible_length(words: str) -> int:
    """Return about how many letters of a text are seen, without the marks of formulas."""
    return len(re.sub(r"\\mathrm|\\times|[${}_^]", "", re.sub(r"\\[a-z]+", "m", words)))


def in_lines(words: str, lines: int) -> str:
    """Break words into lines of about the same length; formulas stay whole."""
    pieces = re.findall(r"(?:\$[^$]*\$|[^\s$])+", words)
    visible = [visible_length(piece) + 1 for piece in pieces]
    out, used, target = [[]], 0, sum(visible) / lines  # type: ignore[var-annotated]
    for piece, size in zip(pieces, visible, strict=True):
        if out[-1] and used + size / 2 > target * len(out) and len(out) < lines:
            out.append([])
        out[-1].append(piece)
        used += size
    return "\n".join(" ".join(line) for line in out)


def thin_numbers(ax: Axes) -> bool:
    """Take numbers off an axis where they would touch each other."""
    if isinstance(ax, PolarAxes):
        return False
    changed = False
    for axis in (ax.xaxis, ax.yaxis):
        boxes = number_boxes(axis)
        which = 0 if axis.axis_name == "x" else 1
        if which == 0 and any(label.get_rotation() % 180 for label in axis.get_ticklabels()):
            continue
        room = BESIDE * (1.0 if which == 0 else 0.0)
        lows = sorted((box.min[which], box.max[which], box.height) for box in boxes)
        if any(after[0] < before[1] + room * before[2] for before, after in pairwise(lows)):
            changed |= fewer_numbers(axis, len(boxes))
    return changed


def number_boxes(axis: Axis) -> list[Bbox]:
    """Return the boxes of the numbers of an axis that are seen."""
    low, high = sorted(axis.get_view_interval())
    span = high - low
    ticks = [
        tick
        for tick in axis.get_major_ticks()
        if low - 1e-9 * span <= tick.get_loc() <= high + 1e-9 * span
    ]
    labels = [label for tick in ticks for label in (tick.label1, tick.label2)]
    return [
        label.get_window_extent() for label in labels if label.get_visible() and label.get_text()
    ]


def fewer_numbers(axis: Axis, shown: int) -> bool:
    """Give an axis fewer numbers; return whether there are fewer."""
    locator = axis.get_major_locator()
    if shown <= FEWEST:
        return False
    if isinstance(locator, FixedLocator):
        ticks = list(axis.get_majorticklocs())
        texts = [label.get_text() for label in axis.get_ticklabels()]
        if len(texts) != len(ticks) or any(text and not is_number(text) for text in texts):
            return False
        axis.set_ticks(ticks[::2], labels=texts[::2])
    elif isinstance(locator, LogLocator):
        subs = locator._subs  # type: ignore[attr-defined]
        if subs is None or len(subs) <= 1:
            return False
        axis.set_major_locator(LogLocator(subs=(1.0, 3.0) if len(subs) > 2 else (1.0,)))
    else:
        integer = bool(getattr(locator, "_integer", False))
        axis.set_major_locator(MaxNLocator(max(shown - 2, 1), integer=integer, min_n_ticks=FEWEST))
    axis.set_minor_locator(NullLocator())
    return True


def is_number(text: str) -> bool:
    """Check that a label is a number, and no name."""
    return bool(re.fullmatch(r"[-\u2212+.\d\s\u00d7eE]+", text))


def place_legend(figure: Figure, ax: Axes, *, below: bool, first: bool) -> bool:
    """Place the legend of axes below them, or make one beside them as narrow as the figure."""
    legend = ax.get_legend()
    if legend is None:
        return False
    if below and first:
        position = below_axes(figure, ax)
        set_columns(legend, ax, len(legend.get_texts()), position)
        return True
    is_below = hasattr(legend, "is_below")
    if not (below or is_below) and has_no_room(legend, ax):
        set_columns(legend, ax, legend._ncols, below_axes(figure, ax))  # type: ignore[attr-defined]
        return True
    moved = below or is_below
    return narrow_legend(figure, legend, ax, below_axes(figure, ax) if moved else {})


def has_no_room(legend: Legend, ax: Axes) -> bool:
    """Check whether a legend is wider than its axes, or lies on their title."""
    if legend.get_window_extent().width > ax.bbox.width and not isinstance(ax, PolarAxes):
        return True
    titles = (ax.title, ax._left_title, ax._right_title)  # type: ignore[attr-defined]
    box = legend.get_window_extent()
    return any(
        box.overlaps(title.get_window_extent()) for title in titles if title.get_text().strip()
    )


def below_axes(figure: Figure, ax: Axes) -> dict[str, Any]:
    """Return the options of a legend below the labels of axes, in the middle of the figure."""
    boxes = [ax.xaxis.label.get_window_extent()] if ax.xaxis.label.get_text() else []
    boxes += number_boxes(ax.xaxis)
    lowest = min([ax.bbox.y0, *(box.y0 for box in boxes)])
    drop = (ax.bbox.y0 - lowest) / figure.dpi + GAP
    # In the middle of the figure, or of the panel where several are side by side.
    alone = panels_across(ax) == 1
    across = blended_transform_factory(figure.transFigure if alone else ax.transAxes, ax.transAxes)
    return {
        "loc": "upper center",
        "bbox_to_anchor": (0.5, 0.0),
        "bbox_transform": across + ScaledTranslation(0.0, -drop, figure.dpi_scale_trans),
        "frameon": False,
        "borderpad": 0.1,
    }


def panels_across(ax: Axes) -> int:
    """Return the number of panels side by side in the figure of axes."""
    position = ax.get_subplotspec()
    return 1 if position is None else int(position.get_gridspec().ncols)


def narrow_legend(
    figure: Figure, legend: Legend, ax: Axes | None, position: dict[str, Any]
) -> bool:
    """Give a legend fewer columns, or wrap its entries, until it is as wide as the figure."""
    box, edge = legend.get_window_extent(), EDGE * figure.dpi
    whole = figure.bbox.width / (1 if ax is None else panels_across(ax))
    wide = box.width > whole - 2 * edge
    if not wide and box.x0 >= 0.0 and box.x1 <= figure.bbox.width:
        return False
    columns: int = legend._ncols  # type: ignore[attr-defined]
    if columns > 1 and ax is not None:
        fitting = int(columns * (whole - 2 * edge) / box.width)
        set_columns(legend, ax, min(max(fitting, 1), columns - 1), position)
        return True
    if wide:
        room = whole - 2 * edge - 3.0 * legend._fontsize  # type: ignore[attr-defined]
        return any([wrap(text, room) for text in legend.get_texts()])
    if ax is not None and not position:
        # One that begins above the axes and ends beside the figure.
        set_columns(legend, ax, columns, below_axes(figure, ax))
        return True
    return False


def set_columns(legend: Legend, ax: Axes, columns: int, position: dict[str, Any]) -> None:
    """Draw a legend again with a number of columns, at another position if one is given."""
    options: dict[str, Any] = position or {
        "loc": legend._loc_real if hasattr(legend, "_loc_real") else legend._loc,  # type: ignore[attr-defined]
        "bbox_to_anchor": legend.get_bbox_to_anchor().transformed(ax.transAxes.inverted()),
        "frameon": legend.get_frame_on(),
        "borderpad": legend.borderpad,
        "handlelength": legend.handlelength,
    }
    title = legend.get_title().get_text()
    labels = [text.get_text() for text in legend.get_texts()]
    drawn, names = ax.get_legend_handles_labels()
    handles: list[Any] = drawn if names == labels else list(legend.legend_handles)
    fresh = ax.legend(
        handles=handles,
        labels=labels,
        ncols=columns,
        fontsize=legend._fontsize,  # type: ignore[attr-defined]
        title=title or None,
        columnspacing=1.2,
        **options,
    )
    fresh.set_zorder(legend.get_zorder())
    if position:
        # Room below is kept for it; it may be wider than the axes.
        fresh.is_below = True  # type: ignore[attr-defined]
        fresh.get_tightbbox = partial(box_below, fresh, ax)  # type: ignore[method-assign]


def box_below(legend: Legend, ax: Axes, renderer: Any = None) -> Bbox:
    """Return the box of a legend below axes that the layout keeps free: as wide as they are."""
    box = legend.get_window_extent(renderer)
    return Bbox([[ax.bbox.x0, box.y0], [ax.bbox.x1, box.y1]])
