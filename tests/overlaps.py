"""Texts of a figure that are cut, or that lie on each other."""

from __future__ import annotations

from itertools import combinations

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.text import Annotation, Text
from matplotlib.transforms import Bbox

#: Pixels by which boxes of neighbouring texts may touch: letters leave room in their boxes.
TOUCH = 1.5


def visible_texts(figure: Figure) -> list[tuple[str, Bbox, float]]:
    """Return the texts of a figure that are seen, with their boxes and angles."""
    hidden: set[int] = set()
    out: list[tuple[str, Bbox, float]] = []
    for ax in figure.findobj(Axes):
        assert isinstance(ax, Axes)
        if not (ax.get_visible() and ax.axison):
            hidden |= {id(text) for axis in (ax.xaxis, ax.yaxis) for text in axis.findobj(Text)}
            continue
        for axis in (ax.xaxis, ax.yaxis):
            if not axis.get_visible():
                hidden |= {id(text) for text in axis.findobj(Text)}
                continue
            low, high = sorted(axis.get_view_interval())
            span = high - low
            for tick in [*axis.get_major_ticks(), *axis.get_minor_ticks()]:
                inside = low - 1e-9 * span <= tick.get_loc() <= high + 1e-9 * span  # type: ignore[attr-defined]
                if not inside:
                    hidden |= {id(tick.label1), id(tick.label2)}
    for text in figure.findobj(Text):
        assert isinstance(text, Text)
        if id(text) in hidden or not text.get_visible() or not text.get_text().strip():
            continue
        box = (
            Text.get_window_extent(text)
            if isinstance(text, Annotation)
            else text.get_window_extent()
        )
        if text.get_clip_on() and text.axes is not None and not text.axes.bbox.overlaps(box):
            continue
        out.append((text.get_text(), box, text.get_rotation()))
    return out


def faults(figure: Figure) -> list[str]:
    """List texts that are cut by the border of the figure, and pairs that overlap."""
    figure.canvas.draw()
    texts, whole = visible_texts(figure), figure.bbox
    out = [
        f"cut: {text!r}"
        for text, box, _ in texts
        if box.x0 < whole.x0 - TOUCH
        or box.y0 < whole.y0 - TOUCH
        or box.x1 > whole.x1 + TOUCH
        or box.y1 > whole.y1 + TOUCH
    ]
    upright = [(text, box) for text, box, angle in texts if angle % 90.0 == 0.0]
    for (first, a), (second, b) in combinations(upright, 2):
        across = min(a.x1, b.x1) - max(a.x0, b.x0)
        up = min(a.y1, b.y1) - max(a.y0, b.y0)
        if across > TOUCH and up > TOUCH:
            out.append(f"overlap: {first!r} on {second!r}")
    return out
