"""Figures of fatigue: where it cracks, and how near to the limit."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from matplotlib.patches import Patch
from matplotlib.ticker import FuncFormatter, MaxNLocator

from pyfret import _core, fatigue
from pyfret._core import with_error, with_range
from pyfret._util.depths import interfaces
from pyfret._util.numbers import in_letters, in_powers
from pyfret._util.theme import REFERENCE, STICK, colour_map
from pyfret.fatigue.factors import Factor
from pyfret.plot.depth_axis import DepthScale, draw_depth_axis
from pyfret.plot.scales import Units, scales
from pyfret.plot.sizes import Width, new_axes
from pyfret.plot.stresses import FLAT, section_size
from pyfret.plot.style import add_colour_bar, axes, inside_legend, mark, note, styled
from pyfret.subsurface.line import line_of

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.contour import ContourSet
    from numpy.typing import NDArray

    from pyfret.fatigue.factors import LoadFactors
    from pyfret.fatigue.judged import Life
    from pyfret.fatigue.ranges import LifeRange
    from pyfret.subsurface.extremum import Extremum

#: How criteria are written in figures.
NAMES = dict(_core.criteria())
#: Look of layers that nothing is known of.
NO_MATERIAL: dict[str, Any] = {"fc": "white", "ec": "0.75", "hatch": "///", "lw": 0.0}
#: Part of a limit below which a number is one of rounding.
NOTHING = 1e-9
#: Part of the largest value above which a place is shown, and the largest part of a section in
#: either direction that is enlarged.
HALF, SMALL = 0.5, 0.5
#: Colour of what is not judged.
UNJUDGED = "0.9"
#: Lives beyond this are drawn as endless [cycles].
ENDLESS = _core.LONGEST_LIFE


def used_part(worst: Extremum) -> str:
    """Return the largest value over the limit with its range, where a criterion has a limit."""
    assert worst.margin is not None
    assert worst.whole is not None
    low, high = (1.0 / margin if margin else np.inf for margin in worst.whole[::-1])
    return f"{with_range(1.0 / worst.margin, low, high)} of the limit"


def _shown(life: Life) -> tuple[NDArray[np.float64], str]:
    """Return the field of a map and its label."""
    name = NAMES[life.dataset.attrs["criterion"]]
    margin = life.extrapolated()
    if life.margin.name == "safety_factor":
        return 1.0 / margin, f"{name}: value over limit"
    # A decade beyond the last contour, so that its line runs between the points.
    return np.log10(np.minimum(margin, 10 * ENDLESS)), f"{name}: life [cycles]"


@styled
def criterion_map(
    life: Life,
    *,
    units: Units = "auto",
    levels: int = 12,
    depth: DepthScale = "auto",
    whole: bool = False,
    width: Width | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Contours of a criterion on a section, with the worst point and its margin.

    Criteria with a limit have the value over the limit; the bold contour is the limit itself. The
    others have the life in cycles, empty beyond 1e7 cycles. Layers without a
    material stay empty. Contours and worst point belong to the stress at each point. The margin of
    the life itself, of the stress averaged over the critical distance, is written below.

    Parameters
    ----------
    life : Life
        From :meth:`Result.life`.
    units : "auto", "dimensionless" or "SI"
        Of the lengths: over a_H (default where there is one), or in um.
    levels : int
        Number of contours, about.
    depth : "auto", "true" or "layers"
        Whether depths have one scale, or each layer a scale of its own (default: if one layer is
        too thin to be seen).
    whole : bool
        Whether the whole section is shown. By default the place where the criterion reaches half of
        its largest value is enlarged, if it takes less than half of the section.
    width : "column" or "page", optional
        Width of a new figure: a column of 85 mm or a page of 170 mm.
    ax : matplotlib Axes, optional
        Where to draw.
    """
    worst = life.worst
    safety = life.margin.name == "safety_factor"
    margin_text = worst.format_margin()
    margin = used_part(worst) if safety else f"{in_powers(margin_text)} cycles"
    field, label = _shown(life)
    shown = life.dataset.value.copy(data=field).assign_attrs(life.dataset.attrs)
    ax = _contours(shown, label, units, levels, ax, depth=depth, limit=1.0 if safety else None)
    if not whole:
        _enlarge(ax, shown, life.dataset.value.values, units)
    at = (line_of(shown).place(worst.x, worst.y), worst.z)
    text = f"worst point: {margin}"
    if life.L is not None:
        text += f"\nmean over {1e6 * life.L:.3g} µm: {_mean_margin(life.range, safety=safety)}"
    _mark(ax, at, text, shown, units, lives=not safety)
    return ax


def _mean_margin(mean: LifeRange, *, safety: bool) -> str:
    """Return the margin of the mean stress with its range, as the margin of a point is written."""
    if not safety:
        return f"{in_powers(repr(mean))} cycles"
    parts = (1.0 / margin if margin else np.inf for margin in (mean.best, mean.high, mean.low))
    return f"{with_range(*parts)} of the limit"


@styled
def load_factor_map(
    factors: LoadFactors,
    *,
    of: Factor = "von_mises",
    units: Units = "auto",
    levels: int = 12,
    depth: DepthScale = "auto",
    whole: bool = False,
    width: Width | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Contours of load over limit on a section, with the largest value and its place.

    The load factor of the section is one over this value. The bold contour is the limit. Layers
    without a yield stress stay empty.

    Parameters
    ----------
    factors : LoadFactors
        From :meth:`Result.load_factors`.
    of : "von_mises", "tresca" or "shakedown"
        First yield by one of the conditions, or shakedown.
    units, levels, depth, whole, width, ax
        As in :func:`criterion_map`.
    """
    least = factors.least(of)
    shown = factors.utilisation(of).assign_attrs(factors.dataset.attrs)
    name = {"von_mises": "First yield, von Mises", "tresca": "First yield, Tresca"}
    label = f"{name.get(of, 'Shakedown')}: load over limit"
    ax = _contours(shown, label, units, levels, ax, depth=depth, limit=1.0)
    if not whole:
        _enlarge(ax, shown, shown.values, units)
    at = (line_of(shown).place(least.x, least.y), least.z)
    largest = with_error(1.0 / least.value, least.error / least.value**2)
    _mark(ax, at, f"largest {in_letters(largest)} of the limit", shown, units)
    return ax


def _contours(
    shown: xr.DataArray,
    label: str,
    units: Units,
    levels: int,
    ax: Axes | None,
    *,
    depth: DepthScale,
    limit: float | None,
) -> Axes:
    """Draw contours of a field over (depth, x) or (depth, y) by layers; dark is near the limit.

    Without a limit, such as for lives, small values are dark.
    """
    if shown.ndim != 2:
        raise ValueError("the figure shows one section: section(place) gives one of several")
    if ax is None:
        ax = new_axes(section_size(shown, 5.4))
    length = scales(shown.attrs, units).length
    along = str(shown.dims[1])
    x, z = shown[along].values / length.value, shown.z.values / length.value
    inner = [z_i / length.value for z_i in interfaces(shown.z, shown.layer)]
    borders = np.array([z[0], *inner, z[-1]])
    stretch = draw_depth_axis(ax, borders, "y", length, depth=depth)
    ax.set_facecolor(UNJUDGED)
    for part, (top, bottom) in enumerate(pairwise(borders)):
        field_of_layer = shown.values[shown.layer.values == shown.layer.values[0] + part]
        if np.isnan(field_of_layer).all():
            ax.axhspan(top, bottom, **NO_MATERIAL)
    image = _filled(ax, x, z, shown, levels, limit)
    for border in inner:
        ax.axhline(border, color="0.2", linewidth=0.8, linestyle=(0, (6, 3)))
    ax.set_xlim(x[0], x[-1])
    ax.set_ylim(z[-1], z[0])
    if image is not None:
        bar = add_colour_bar(ax, image, label)
        if limit is None:
            bar.ax.yaxis.set_major_formatter(FuncFormatter(lambda v, _: in_powers(f"{10**v:.1e}")))
    ax.set_xlabel(length.label(along))
    flat = x[-1] - x[0] > FLAT * (z[-1] - z[0])
    ax.set_aspect("auto" if stretch or flat else "equal")
    ax.grid(visible=False)
    return ax


def _enlarge(ax: Axes, shown: xr.DataArray, value: NDArray[np.float64], units: Units) -> None:
    """Zoom to the surroundings of the values above half of the largest, if they are few."""
    if not np.nanmax(value, initial=0.0) > 0.0:
        return
    length = scales(shown.attrs, units).length
    near = np.nan_to_num(value) >= HALF * np.nanmax(value)
    places = [shown[str(shown.dims[1])].values / length.value, shown.z.values / length.value]
    spans = []
    for at, near_point in zip(places, (near.any(axis=0), near.any(axis=1)), strict=True):
        low, high = float(at[near_point].min()), float(at[near_point].max())
        # A margin of their own size, of three points at least.
        room = max(high - low, 3.0 * float(np.ptp(at)) / at.size)
        spans.append((max(low - room, float(at[0])), min(high + room, float(at[-1]))))
    part = [(high - low) / float(np.ptp(at)) for (low, high), at in zip(spans, places, strict=True)]
    if max(part) > SMALL:
        return
    ax.set_xlim(*spans[0])
    ax.set_ylim(spans[1][1], spans[1][0])
    ax.set_aspect("auto")


def _filled(
    ax: Axes,
    x: NDArray[np.float64],
    z: NDArray[np.float64],
    shown: xr.DataArray,
    levels: int,
    limit: float | None,
) -> ContourSet | None:
    """Draw the filled contours of every layer and, bold, the contour of the limit."""
    if levels < 1:
        raise ValueError(f"levels = {levels}: must be 1 or more")
    field, layers = shown.values, shown.layer.values
    if not np.isfinite(field).any():
        return None
    image = None
    colours = colour_map("sequential").reversed() if limit is None else colour_map("sequential")
    if limit is not None and np.nanmax(np.abs(field)) < NOTHING:
        note(ax, "nothing of the limit is used")
        return None
    highest = np.nanmax(field)
    if limit is None:
        highest = min(highest, np.log10(ENDLESS))
    if limit is None:
        steps = decades(float(np.nanmin(field)), float(highest), levels)
        if np.nanmin(field) >= highest:
            return None
    else:
        steps = np.asarray(MaxNLocator(levels).tick_values(np.nanmin(field), highest))
    bold = False
    for part in np.unique(layers):
        in_layer = layers == part
        if np.count_nonzero(in_layer) < 2 or not np.isfinite(field[in_layer]).any():
            continue
        image = ax.contourf(x, z[in_layer], field[in_layer], levels=steps, cmap=colours)
        lines = steps[steps > 0.0]
        ax.contour(x, z[in_layer], field[in_layer], levels=lines, colors="0.2", linewidths=0.4)
        if limit is not None and field[in_layer].min() < limit < field[in_layer].max():
            ax.contour(
                x, z[in_layer], field[in_layer], levels=[limit], colors="0.1", linewidths=1.8
            )
            bold = True
    if bold:
        # For the legend; the contour itself has no label.
        ax.plot([], [], color="0.1", linewidth=1.8, label="limit")
    return image


#: Numbers of a decade at which contours of lives lie, the closest ones first.
SUBDIVISIONS = ((1.0, 1.5, 2.0, 3.0, 5.0, 7.0), (1.0, 2.0, 5.0), (1.0, 3.0), (1.0,))


def decades(low: float, high: float, levels: int) -> NDArray[np.float64]:
    """Return the logarithms of about `levels` round numbers that enclose a range."""
    for subs in SUBDIVISIONS:
        powers = np.arange(np.floor(low) - 1, np.ceil(high) + 2)
        steps = np.sort(np.add.outer(powers, np.log10(subs)).ravel())
        first = max(int(np.searchsorted(steps, low + 1e-9, side="right")) - 1, 0)
        last = int(np.searchsorted(steps, high - 1e-9))
        if last - first <= levels:
            break
    return steps[first : last + 1]


def _mark(
    ax: Axes,
    place: tuple[float, float],
    text: str,
    shown: xr.DataArray,
    units: Units,
    *,
    lives: bool = False,
) -> None:
    """Draw a cross at the worst point; the legend explains it, and the grey area."""
    length = scales(shown.attrs, units).length.value
    mark(ax, (place[0] / length, place[1] / length), text)
    handles: list[Artist] = list(ax.get_legend_handles_labels()[0])
    field = shown.values
    if lives and (field > np.log10(ENDLESS)).any():
        handles.append(Patch(color=UNJUDGED, label=f"beyond {in_powers(f'{ENDLESS:.0e}')} cycles"))
    if np.isnan(field).any():
        handles.append(Patch(**NO_MATERIAL, label="no material given"))
    inside_legend(ax, handles=handles)


class OverDistances(Protocol):
    """Margins over distances, as :meth:`pyfret.fatigue.Life.over_distance` gives them."""

    @property
    def dataset(self) -> xr.Dataset:
        """``low`` and ``high`` over ``L``."""

    @property
    def margin(self) -> xr.DataArray:
        """The best estimate over ``L``."""


@styled
def life_over_distance(
    of: OverDistances | Life, *, width: Width | None = None, ax: Axes | None = None
) -> Axes:
    """Life or safety factor over the distance that the stress is averaged over, with its range.

    Parameters
    ----------
    of : OverDistance or Life
        As :meth:`pyfret.fatigue.Life.over_distance` gives it; of a life over its distances.
    width : "column" or "page", optional
        Width of a new figure: a column of 85 mm or a page of 170 mm.
    ax : matplotlib Axes, optional
        Where to draw.
    """
    if isinstance(of, fatigue.Life):
        of = of.over_distance()
    ax = axes(ax)
    d, margin = of.dataset, of.margin
    L = 1e6 * d["L"].values
    life = margin.name == "life"
    # A life without end reaches beyond the axis.
    top = 10.0 * ENDLESS if life else np.inf
    low, high = (np.minimum(d[name].values, top) for name in ("low", "high"))
    ax.fill_between(L, low, high, color=STICK, alpha=0.2, lw=0, label="10 to 90 %")
    ax.plot(L, margin.where(np.isfinite(margin)), "o-", color=STICK, ms=4, label="best estimate")
    if life and float(np.nanmax(high)) >= ENDLESS:
        ax.axhline(ENDLESS, color=REFERENCE, lw=1, label="longest life that is computed")
    if "L" in d.attrs:
        ax.axvline(
            1e6 * d.attrs["L"],
            color=REFERENCE,
            lw=1,
            ls="--",
            label="critical distance of the material",
        )
    if life:
        ax.set_yscale("log")
        ax.set_ylim(
            float(np.nanmin([*low, 0.5 * ENDLESS])) / 2.0, min(float(high.max()), 5e7) * 2.0
        )
    ax.set_xlabel("distance L [µm]")
    ax.set_ylabel("life [cycles]" if life else "safety factor")
    ax.legend()
    return ax
