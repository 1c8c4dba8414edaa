"""Figures of studies."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Literal, Protocol, TypeAlias

import numpy as np
from matplotlib.patches import Patch
from matplotlib.ticker import FuncFormatter, MaxNLocator

from pyfret._util.bounds import bounds, known_to
from pyfret._util.parameters import one_of, part
from pyfret._util.per_metre import of_line_contacts
from pyfret._util.text import literal
from pyfret._util.theme import MARK, REFERENCE, colour_map
from pyfret.plot.areas import geometric, logarithmic
from pyfret.plot.parameters import parameter_label
from pyfret.plot.sizes import Width
from pyfret.plot.style import axes, styled

if TYPE_CHECKING:
    from collections.abc import Iterable

    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.text import Text


#: Labels of parameters and the sizes of their units, by their names.
Words: TypeAlias = Mapping[str, tuple[str, float]]
#: Values along both parameters from which on contours are drawn.
CONTOURED = 4
#: Step of the contours over the scatter of the values, at least: closer ones are its islands.
ABOVE_SCATTER = 5.0
#: Letters in a line of a label, so that it fits beside a map.
WIDTH = 44
#: Status of a point that is done, and colour of points that are and have no value.
SOLVED, NO_VALUE = (1, 3), "0.9"


class Tabulated(Protocol):
    """Measures over parameters, as a :class:`pyfret.study.Study` has them."""

    @property
    def dataset(self) -> xr.Dataset:
        """Measures over the parameters."""

    @property
    def parameters(self) -> list[str]:
        """Names of the parameters."""

    @property
    def measures(self) -> list[str]:
        """Names of the measures."""


@styled
def study_map(
    study: Tabulated,
    of: str | None = None,
    *,
    at: Mapping[str, float | str] | None = None,
    kind: Literal["auto", "contour", "cells"] = "auto",
    levels: int = 10,
    labels: Mapping[str, str] | None = None,
    colorbar: bool = True,
    width: Width | None = None,
    ax: Axes | None = None,
) -> Axes:
    """A measure of a study over its parameters; crosses mark points that failed.

    Over one parameter a line, over two contours or cells; samples of several parameters are points
    over the first two. An axis is logarithmic if the values are in geometric steps.

    Parameters
    ----------
    study : Study
        The study.
    of : str, optional
        The measure (default: the first).
    at : mapping of str to float, optional
        Values of further parameters, numbers in SI or texts with a unit. The nearest ones are
        taken. ``"mu"`` is short for ``"friction.mu"``.
    kind : "auto", "contour" or "cells"
        Contours or a cell for each point. Default: contours from four values along both on, if
        their step is at least five times the scatter of the values.
    levels : int
        Number of contours, about.
    labels : mapping of str to str, optional
        What parameters and measures are called in the figure, by their names, such as
        ``{"body2.coatings.0.E": "modulus of the coating [Pa]"}`` (default: their meaning and unit
        where they are keys of a scene file).
    colorbar : bool
        Whether to draw the scale beside the map.
    width : "column" or "page", optional
        Width of a new figure: a column of 85 mm or a page of 170 mm.
    ax : matplotlib Axes, optional
        Where to draw.
    """
    d, values, label, words = select_measure(study, of, at, labels)
    chosen = str(values.name)
    ax = axes(ax)
    label = "\n".join(filter(None, (label, known_to(d, chosen))))
    if "point" in values.dims:
        scattered(ax, study.parameters, values, label, words)
    elif values.ndim == 1:
        line(ax, values, label, words)
        shade(ax, values, d, chosen, words)
    elif values.ndim == 2:
        plane(ax, values, kind, levels, label if colorbar else None, words)
    else:
        raise ValueError(
            f"{values.ndim} parameters: give the values of {values.ndim - 2} of "
            f"{', '.join(map(str, values.dims))} as at={{name: value}}"
        )
    if "point" not in values.dims:
        crosses(ax, d["status"], words)
    if values.ndim == 2 and bool((values.isnull() & d["status"].isin(SOLVED)).any()):
        # A life that is longer than the run, a crack that never starts.
        ax.set_facecolor(NO_VALUE)
        handles = [*ax.get_legend_handles_labels()[0], Patch(color=NO_VALUE, label="no value")]
        ax.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2)
    return ax


def select_measure(
    study: Tabulated,
    of: str | None,
    at: Mapping[str, float | str] | None,
    labels: Mapping[str, str] | None,
) -> tuple[xr.Dataset, xr.DataArray, str, Words]:
    """Return the part of a study that a figure draws, and its words.

    The tuple has the dataset at the values `at`, the measure in the unit of the figure, and its
    label on several lines. The last entry has the labels of the parameters.
    """
    d = study.dataset
    labels = {
        key if key in study.measures else one_of(study.parameters, key, "labels"): text
        for key, text in (labels or {}).items()
    }
    flat = of_line_contacts(d)
    words = {
        name: (labels[name], 1.0) if name in labels else parameter_label(name, per_metre=flat)
        for name in study.parameters
    }
    if at:
        d = part(d, at)
    names = study.measures
    chosen = names[0] if of is None and names else of
    if not names:
        raise ValueError("no point of the study has a measure: study.failed() has the reasons")
    if chosen not in names:
        raise ValueError(f"of = {of!r}: must be one of {', '.join(names)}")
    values = d[chosen]
    extra = [k for k in values.dims if k not in d["status"].dims]
    if extra:
        raise ValueError(f"{chosen} is a field over {', '.join(map(str, extra))}: draw one point")
    values, label = in_figures(values)
    label = labels.get(chosen, label)
    lines = [label] if "$" in label else textwrap.wrap(label, WIDTH)
    return d, values.rename(chosen), "\n".join(lines), words


#: Powers of ten of the prefixes of units.
PREFIXES = {-12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G"}


def in_figures(values: xr.DataArray) -> tuple[xr.DataArray, str]:
    """Return a measure in a unit with short numbers, and its meaning with that unit."""
    unit = literal(values.attrs.get("units", "1"))
    name = literal(values.attrs.get("long_name", values.name))
    power = power_of(values)
    if power is None:
        return values, name if unit == "1" else f"{name} [{unit}]"
    return values / 10.0**power, f"{name} [{PREFIXES[power]}{unit}]"


def power_of(values: xr.DataArray) -> int | None:
    """Return the power of ten of the unit in which the numbers of a measure are short."""
    if values.attrs.get("units", "1") not in ("J", "Pa", "m", "N", "N/m", "J/m", "N/m per m"):
        return None
    largest = float(np.abs(values).max())
    power = 3 * int(np.floor(np.log10(largest) / 3 + 1e-12)) if largest > 0 else 0
    return min(max(power, min(PREFIXES)), max(PREFIXES))


def in_unit_of(end: xr.DataArray, values: xr.DataArray) -> xr.DataArray:
    """An end of the range of a measure in the unit of its figure."""
    return end / 10.0 ** (power_of(values) or 0)


def on_axis(coordinate: xr.DataArray, words: Words) -> tuple[np.ndarray, str]:
    """The values of a parameter in the unit of its label, and the label."""
    values = np.asarray(coordinate.values)
    label, factor = words[str(coordinate.name)]
    return (values / factor if values.dtype.kind in "if" else values), label


#: Most values in geometric steps of which each has its tick.
MOST_TICKS = 6


def scale_axis(
    ax: Axes, which: Literal["x", "y"], coordinate: xr.DataArray, words: Words
) -> np.ndarray:
    """Label an axis, and return where the values of a parameter lie on it."""
    values, label = on_axis(coordinate, words)
    ax.set_xlabel(label) if which == "x" else ax.set_ylabel(label)
    if values.dtype.kind not in "ifb":
        places = np.arange(values.size, dtype=float)
        (ax.set_xticks if which == "x" else ax.set_yticks)(places, [str(v) for v in values])
        return places
    if geometric(values):
        logarithmic(ax, which)
        if values.size <= MOST_TICKS:
            (ax.set_xticks if which == "x" else ax.set_yticks)(values, [f"{v:.4g}" for v in values])
    elif values.dtype.kind in "if":
        # Small numbers as they are, none of them over a power at the end of the axis.
        axis = ax.xaxis if which == "x" else ax.yaxis
        axis.set_major_formatter(FuncFormatter(lambda v, _: f"{float(f'{v:.6g}'):g}"))
    return values.astype(float)


def edges(places: np.ndarray, *, logarithmic: bool) -> np.ndarray:
    """Return the borders of cells around the values of a parameter, half way on its axis."""
    values = np.log(places) if logarithmic else places
    if values.size == 1:
        step = 0.5 * abs(values[0]) or 0.5
        borders = np.array([values[0] - step, values[0] + step])
    else:
        middles = (values[:-1] + values[1:]) / 2
        borders = np.r_[
            1.5 * values[0] - 0.5 * values[1], middles, 1.5 * values[-1] - 0.5 * values[-2]
        ]
    return np.asarray(np.exp(borders) if logarithmic else borders)


def smooth(field: np.ma.MaskedArray[Any, Any], levels: int) -> bool:
    """Whether so many contours show the values and not their scatter."""
    return ABOVE_SCATTER * scatter_of(field) * levels <= float(np.ma.ptp(field))


def scatter_of(field: np.ma.MaskedArray[Any, Any]) -> float:
    """Standard deviation of the noise of values on a grid.

    Second differences along both parameters of white noise have 36 times its variance, of a
    smooth field they are small: J. Immerkaer, Comput. Vis. Image Underst. 64 (1996) 300-302.
    """
    along = field[2:] - 2.0 * field[1:-1] + field[:-2]
    twice = along[:, 2:] - 2.0 * along[:, 1:-1] + along[:, :-2]
    return float(np.sqrt(np.ma.mean(twice**2))) / 6.0 if twice.count() else 0.0


def line(ax: Axes, values: xr.DataArray, label: str, words: Words) -> None:
    """Draw a measure over one parameter."""
    places = scale_axis(ax, "x", values[str(values.dims[0])], words)
    ax.plot(places, values.values, "o-", markersize=4)
    ax.set_ylabel(label)


def shade(ax: Axes, values: xr.DataArray, d: xr.Dataset, name: str, words: Words) -> None:
    """Draw the range of a measure over one parameter, behind its line."""
    ends = bounds(d, name)
    if ends is None:
        return
    low, high = (in_unit_of(end, d[name]).values for end in ends)
    coordinate = values[str(values.dims[0])]
    places, _ = on_axis(coordinate, words)
    if places.dtype.kind not in "ifb":
        places = np.arange(places.size, dtype=float)
    ax.fill_between(places.astype(float), low, high, alpha=0.2, linewidth=0.0)


def plane(
    ax: Axes,
    values: xr.DataArray,
    kind: str,
    levels: int,
    label: str | None,
    words: Words,
) -> None:
    """Draw a measure over two parameters."""
    first, second = (str(name) for name in values.dims)
    x = scale_axis(ax, "x", values[first], words)
    y = scale_axis(ax, "y", values[second], words)
    field = np.ma.masked_invalid(values.values.T)
    fine = min(field.shape) >= CONTOURED and smooth(field, levels)
    drawn: Any
    if kind == "contour" or (kind == "auto" and fine and field.count() > 3):
        steps = MaxNLocator(levels).tick_values(float(field.min()), float(field.max()))
        drawn = ax.contourf(x, y, field, levels=steps, cmap=colour_map("sequential"))
        lines = ax.contour(x, y, field, levels=steps, colors="0.25", linewidths=0.5)
        whole_labels(ax, ax.clabel(lines, fontsize=7, fmt="%g"))
    else:
        borders = [
            edges(places, logarithmic=scale == "log")
            for places, scale in ((x, ax.get_xscale()), (y, ax.get_yscale()))
        ]
        drawn = ax.pcolormesh(*borders, field, cmap=colour_map("sequential"), shading="flat")
    ax.grid(visible=False)
    if label is not None:
        bar = ax.get_figure().colorbar(drawn, ax=ax)  # type: ignore[union-attr]
        bar.set_label(label)
        bar.outline.set_visible(False)


#: Part of the axes beside a border in which a label of a contour would be cut.
BORDER = 0.05


def whole_labels(ax: Axes, labels: Iterable[Text]) -> None:
    """Remove labels of contours that the border of the axes would cut; the others get a halo."""
    from matplotlib.patheffects import withStroke

    onto_axes = ax.transData + ax.transAxes.inverted()
    for label in list(labels):
        label.set_path_effects([withStroke(linewidth=2.0, foreground="white")])
        position = onto_axes.transform(label.get_position())
        if position.min() < BORDER or position.max() > 1.0 - BORDER:
            label.set_visible(False)


def scattered(
    ax: Axes,
    parameters: list[str],
    values: xr.DataArray,
    label: str,
    words: Words,
) -> None:
    """Draw a measure at samples: over the only parameter, or by colour over the first two."""
    x, text = on_axis(values[parameters[0]], words)
    ax.set_xlabel(text)
    if len(parameters) == 1:
        ax.plot(x, values.values, "o", markersize=4)
        ax.set_ylabel(label)
        return
    y, text = on_axis(values[parameters[1]], words)
    ax.set_ylabel(text)
    drawn = ax.scatter(
        x,
        y,
        c=values.values,
        cmap=colour_map("sequential"),
        s=26,
        edgecolors=REFERENCE,
        linewidths=0.4,
    )
    bar = ax.get_figure().colorbar(drawn, ax=ax)  # type: ignore[union-attr]
    bar.set_label(label)
    bar.outline.set_visible(False)


def crosses(ax: Axes, status: xr.DataArray, words: Words) -> None:
    """Mark the points that failed."""
    lost = np.argwhere(status.values == 2)
    if not lost.size:
        return
    coordinates = [on_axis(status[str(name)], words)[0] for name in status.dims]
    places = [
        (c if c.dtype.kind in "ifb" else np.arange(c.size))[lost[:, k]]
        for k, c in enumerate(coordinates)
    ]
    y = places[1] if len(places) > 1 else np.full(len(lost), ax.get_ylim()[0])
    ax.plot(places[0], y, "x", color=MARK, markersize=5, clip_on=False, label="failed")
    ax.legend(loc="upper right")
