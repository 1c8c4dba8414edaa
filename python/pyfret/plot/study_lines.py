"""Lines of a study: a measure over one parameter, a line for each value of the others."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from pyfret._util.bounds import bounds, is_estimate
from pyfret._util.numbers import in_words
from pyfret._util.parameters import one_of
from pyfret.plot.sizes import Width
from pyfret.plot.studies import Tabulated, in_unit_of, on_axis, scale_axis, select_measure
from pyfret.plot.style import axes, styled

if TYPE_CHECKING:
    from collections.abc import Mapping

    import xarray as xr
    from matplotlib.axes import Axes

    from pyfret.plot.studies import Words

__all__ = ["study_line"]

#: Most lines of a figure.
MOST_LINES = 8
#: Lines from which on the legend stands above the axes.
MANY_LINES = 3


@styled
def study_line(
    study: Tabulated,
    of: str | None = None,
    *,
    along: str | None = None,
    at: Mapping[str, float | str] | None = None,
    labels: Mapping[str, str] | None = None,
    width: Width | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Draw a measure of a study over one parameter, with the others as lines.

    A band is the range that the error of a number leaves. A point without a number is a gap.

    Parameters
    ----------
    study : Study
        The study.
    of : str, optional
        The measure (default: the first).
    along : str, optional
        The parameter of the axis (default: the one with the most values).
    at : mapping of str to float, optional
        Values of parameters that are kept, numbers in SI or texts with a unit. The nearest ones
        are taken. ``"mu"`` is short for ``"friction.mu"``.
    labels : mapping of str to str, optional
        What parameters and measures are called in the figure, by their names (default: their
        meaning and unit where they are keys of a scene file).
    width : "column" or "page", optional
        Width of a new figure: a column of 85 mm or a page of 170 mm.
    ax : matplotlib Axes, optional
        Where to draw.

    Raises
    ------
    ValueError
        The parameters change together, or there are more than eight lines.
    """
    d, values, label, words = select_measure(study, of, at, labels)
    if "point" in values.dims or not values.dims:
        raise ValueError("study_line needs a grid of parameters: samples have no lines")
    names = [str(name) for name in values.dims]
    chosen = max(names, key=lambda name: values.sizes[name])
    if along is not None:
        chosen = one_of(names, along, "along")
    others = [name for name in names if name != chosen]
    count = int(np.prod([values.sizes[name] for name in others], dtype=int))
    if count > MOST_LINES:
        raise ValueError(
            f"{count} lines: must be at most {MOST_LINES}; give the values of some of "
            f"{', '.join(others)} as at={{name: value}}"
        )
    ax = axes(ax)
    places = scale_axis(ax, "x", values[chosen], words)
    ax.set_ylabel(label + ("\n(estimate)" if is_estimate(d[str(values.name)]) else ""))
    ends = bounds(d, str(values.name))
    for indices in product(*(range(values.sizes[name]) for name in others)):
        position = dict(zip(others, indices, strict=True))
        text = describe(values.isel(position), others, words)
        (line,) = ax.plot(places, values.isel(position).values, "o-", markersize=4, label=text)
        if ends is not None:
            low, high = (in_unit_of(end, d[str(values.name)]).isel(position) for end in ends)
            ax.fill_between(
                places, low.values, high.values, alpha=0.2, linewidth=0.0, color=line.get_color()
            )
    if others:
        title = split_label(others[0], words)[0] if len(others) == 1 else None
        above = {"loc": "lower left", "bbox_to_anchor": (0.0, 1.0), "ncols": 3}
        ax.legend(title=title, **(above if count > MANY_LINES else {"loc": "best"}))
    return ax


def split_label(name: str, words: Words) -> tuple[str, str]:
    """Return the words and the unit of the label of a parameter."""
    head, _, unit = words[name][0].replace(",\n", ", ").partition(" [")
    return head, unit.removesuffix("]")


def describe(values: xr.DataArray, names: list[str], words: Words) -> str:
    """Return the values of the parameters of a line, with their units; of one without its name."""
    texts = []
    for name in names:
        value = on_axis(values[name], words)[0].item()
        text = in_words(float(value)) if isinstance(value, int | float) else str(value)
        head, unit = split_label(name, words)
        texts.append(f"{head} = {text} {unit}".rstrip())
    return ", ".join(texts) if len(texts) > 1 else "".join(texts).partition(" = ")[2]
