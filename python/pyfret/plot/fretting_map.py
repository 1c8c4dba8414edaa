"""The fretting map: running conditions, crack risk and frictional energy over the loads."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from pyfret._util.bounds import known_to
from pyfret._util.theme import CRACK, DANGER, MIDDLE, NEUTRAL, SAFE, STICK, colour_map
from pyfret.fracture.arrest import WORDS
from pyfret.plot.areas import Raster
from pyfret.plot.sizes import Width
from pyfret.plot.studies import in_figures, whole_labels
from pyfret.plot.style import add_colour_bar, axes, styled
from pyfret.plot.tables import must_hold

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.patches import Patch
    from numpy.typing import NDArray

#: Running conditions by the codes of ``status``, each with its colour.
CONDITIONS = {0: ("no contact", NEUTRAL), 1: ("full stick", SAFE)}
CONDITIONS |= {2: ("partial slip", MIDDLE), 3: ("gross slip", DANGER)}
#: What becomes of a crack.
FATES = {0: (WORDS["dormant"], NEUTRAL), 1: (WORDS["stops"], SAFE)}
FATES |= {2: (WORDS["grows"], DANGER)}
#: Axes of the map: factor and label.
AXES = {"T": (1.0, r"$T$"), "delta": (1e6, r"$\delta$ [µm]")}
#: Lives whose contours are drawn [cycles], and the levels of safety factors.
SLIDES, PARTIAL = 3, 2
LIVES = 10.0 ** np.arange(3, 10)
FACTORS = np.array([0.3, 0.5, 1.0, 2.0, 4.0])
ENERGY, ARREST = "0.35", STICK
#: Variables of a map of running conditions, and what makes one.
RUNNING = ("W", "status", "dissipated")
RUNNING_MADE = "a map of running conditions, fret.study.running_conditions(scene, W=..., T=...)"
ARRESTED = ("T", "sigma_B", "start_margin", "arrest_margin")
#: Where no static solution exists.
UNSOLVED = "0.85"
#: Lengths of stopped cracks whose contours are drawn [µm].
LENGTHS = np.array([10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0])


@styled
def fretting_map(table: xr.Dataset, *, width: Width | None = None, ax: Axes | None = None) -> Axes:
    """Running conditions as areas, over them contours of crack risk and of the energy of a cycle.

    The crack risk is the criterion of the map, as safety factor or as life in cycles. It has full
    lines, thick where the factor is 1. Dashed lines are the energy that friction dissipates in a
    cycle, to which wear is proportional. Dotted lines are lengths at which cracks stop; where none
    stops any more a thick dotted line begins.

    Parameters
    ----------
    table : xarray.Dataset
        Of :func:`pyfret.study.running_conditions` with `cracking` and `arrest`; what was not asked
        for is left out.
    width : "column" or "page", optional
        Width of a new figure: a column of 85 mm or a page of 170 mm.
    ax : matplotlib Axes, optional
        Where to draw.
    """
    driven = "T" if "T" in table.dims else "delta"
    must_hold(table, "table", (driven, *RUNNING), RUNNING_MADE)
    ax = axes(ax)
    scale, label = AXES[driven]
    table = table.transpose(driven, "W", ...)
    W, amplitude = table.W.values, table[driven].values * scale
    raster = Raster(W, amplitude)
    entries: list[Patch | Line2D] = [*raster.draw(ax, conditions(table, raster, scale), CONDITIONS)]
    energy, meaning = in_figures(table.dissipated)
    meaning = label_with_error(meaning, table, "dissipated")
    entries += lines(ax, W, amplitude, energy.values, None, ENERGY, "dashed", meaning)
    for name, levels in (("safety_factor", FACTORS), ("life", LIVES)):
        if name in table:
            meaning = {"safety_factor": "safety factor", "life": "life [cycles]"}[name]
            meaning = label_with_error(meaning, table, name)
            entries += lines(ax, W, amplitude, table[name].values, levels, CRACK, "solid", meaning)
    entries += arrest_lines(ax, raster, table)
    ax.set_xlabel(f"$W$ [{force_unit(table)}]")
    ax.set_ylabel(label if driven == "delta" else f"{label} [{force_unit(table)}]")
    ax.legend(handles=entries, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2)
    return ax


def onset(table: xr.Dataset, raster: Raster, scale: float) -> NDArray[np.float64] | None:
    """Return the amplitude of gross slip along the raster: a power of W between the forces."""
    if "slides_from" not in table or not (table.slides_from > 0.0).all():
        return None
    W, limit = table.W.values, table.slides_from.values * scale
    order = np.argsort(W)
    return np.asarray(np.exp(np.interp(np.log(raster.x), np.log(W[order]), np.log(limit[order]))))


def conditions(table: xr.Dataset, raster: Raster, scale: float) -> NDArray[np.float64]:
    """Return the running conditions on the raster: gross slip above its onset, samples below it."""
    status = table.status.values
    codes = raster.nearest(status).astype(float)
    limit = onset(table, raster, scale)
    if limit is None:
        return codes
    below = [column[column < SLIDES] for column in status.T]
    # A force that slides under the least amplitude is in partial slip below that.
    least = np.array([column[-1] if column.size else PARTIAL for column in below])
    under = raster.nearest(np.where(status == SLIDES, least, status)).astype(float)
    return np.where(raster.y[:, None] >= limit, float(SLIDES), under)


def carried(field: NDArray[Any], order: NDArray[np.int_]) -> NDArray[np.float64]:
    """Extend the last value of every column of a field over (amplitude, W) to larger amplitudes."""
    out = np.array(field[order], dtype=float)
    for below, row in pairwise(out):
        row[np.isnan(row)] = below[np.isnan(row)]
    back = np.empty_like(out)
    back[order] = out
    return back


def label_with_error(meaning: str, table: xr.Dataset, name: str) -> str:
    """Return the label of contours, with the error of their numbers."""
    return ", ".join(filter(None, (meaning, known_to(table, name))))


def force_unit(table: xr.Dataset) -> str:
    """The unit of the forces of a map."""
    return str(table.W.attrs.get("units", "N"))


def lines(
    ax: Axes,
    W: NDArray[Any],
    amplitude: NDArray[Any],
    field: NDArray[Any],
    levels: NDArray[Any] | None,
    colour: str,
    style: Literal["solid", "dashed", "dotted"],
    meaning: str,
) -> list[Line2D]:
    """Draw contours with their numbers; return their entry in the legend, none without values."""
    shown = np.ma.masked_invalid(field)
    if min(shown.shape) < 2 or shown.count() < 4:
        return []
    options: dict[str, Any] = {} if levels is None else {"levels": levels}
    given_levels = levels if levels is not None else np.array([])
    widths = np.where(given_levels == 1.0, 2.0, 1.0) if given_levels.size else 0.8
    drawn = ax.contour(
        W, amplitude, shown, colors=colour, linestyles=style, linewidths=widths, **options
    )
    whole_labels(ax, ax.clabel(drawn, fontsize=7, fmt="%g"))
    return [Line2D([], [], color=colour, linestyle=style, linewidth=1.0, label=meaning)]


def arrest_lines(ax: Axes, raster: Raster, table: xr.Dataset, colour: str = ARREST) -> list[Line2D]:
    """Draw contours of the length at which cracks stop, and the line beyond which none stops."""
    if "arrest_margin" not in table:
        return []
    x, y = raster.x, raster.y
    length = raster.resample(table.arrest_length.values * 1e6)
    if "start_margin" in table:
        # A crack that does not grow stops nowhere.
        length = np.where(raster.resample(table.start_margin.values) < 1.0, np.nan, length)
    meaning = label_with_error("crack stops at [µm]", table, "arrest_length")
    entries = lines(ax, x, y, length, LENGTHS, colour, "dotted", meaning)
    margin = np.ma.masked_invalid(raster.resample(table.arrest_margin.values))
    if min(margin.shape) > 1 and margin.min() < 1.0 < margin.max():
        ax.contour(x, y, margin, levels=[1.0], colors=colour, linestyles="dotted", linewidths=2.2)
        line = Line2D([], [], color=colour, linestyle="dotted", linewidth=2.2)
        line.set_label("no crack stops beyond")
        entries.append(line)
    return entries


@styled
def arrest_map(table: xr.Dataset, *, width: Width | None = None, ax: Axes | None = None) -> Axes:
    """Map where cracks stop over shear and bulk stress, and at which length.

    Three areas: no crack grows from its first length, cracks stop, cracks grow. Dotted lines are
    the lengths at which they stop. Full lines are the criterion of initiation, if the map has one.

    Parameters
    ----------
    table : xarray.Dataset
        Of :func:`pyfret.study.arrest_map`.
    width : "column" or "page", optional
        Width of a new figure: a column of 85 mm or a page of 170 mm.
    ax : matplotlib Axes, optional
        Where to draw.
    """
    made = "a map of arrest, fret.study.arrest_map(scene, W=..., T=..., sigma_B=..., arrest=...)"
    must_hold(table, "table", ARRESTED, made)
    ax = axes(ax)
    table = table.transpose("T", "sigma_B")
    bulk, T = table.sigma_B.values / 1e6, table["T"].values / 1e3
    raster = Raster(bulk, T)
    start, arrest = (
        raster.resample(table[name].values) for name in ("start_margin", "arrest_margin")
    )
    fate = np.where(start < 1.0, 0.0, np.where(arrest < 1.0, 1.0, 2.0))
    fate[np.isnan(arrest)] = np.nan
    entries: list[Patch | Line2D] = [*raster.draw(ax, fate, FATES)]
    for name, levels, meaning in (
        ("safety_factor", FACTORS, "safety factor of initiation"),
        ("life", LIVES, "cycles to initiation"),
    ):
        if name in table:
            about = label_with_error(meaning, table, name)
            entries += lines(ax, bulk, T, table[name].values, levels, CRACK, "solid", about)
    entries += arrest_lines(ax, raster, table)
    ax.set_xlabel(r"bulk stress $\sigma_\mathrm{B}$ [MPa]")
    unit = str(table["T"].attrs.get("units", "N"))
    ax.set_ylabel(f"$T$ [k{unit}]")
    ax.legend(handles=entries, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2)
    return ax


@styled
def running_map(table: xr.Dataset, *, width: Width | None = None, ax: Axes | None = None) -> Axes:
    r"""Running conditions over W and the amplitude of T or of the shift, from the sweep.

    Coloured by the energy ratio, which separates gross slip (0.2 and more) from partial slip. Over
    shifts a line parts them; over forces it is grey where there is no static solution, above the
    dashed line :math:`T = \mu W`. With `arrest` in the sweep dotted lines are
    the lengths at which cracks stop, and a thick one begins where none does.
    """
    driven = "T" if "T" in table.dims else "delta"
    must_hold(table, "table", (driven, *RUNNING), RUNNING_MADE)
    ax = axes(ax)
    scale, label = AXES[driven]
    table = table.transpose(driven, "W", ...)
    W, amplitude = table.W.values, table[driven].values * scale
    raster = Raster(W, amplitude)
    limit = onset(table, raster, scale)
    # Nothing is solved where a force slides: the ratio of the last one that does not.
    ratio = carried(table.energy_ratio.values, np.argsort(amplitude))
    fine = np.ma.masked_invalid(raster.resample(ratio))
    gross = conditions(table, raster, scale) == SLIDES
    if driven == "T":
        raster.draw(ax, np.where(gross, 1.0, np.nan), {1: ("", UNSOLVED)})
        fine = np.ma.masked_where(gross, fine)
    steps = MaxNLocator(10).tick_values(float(fine.min()), float(fine.max()))
    image = ax.contourf(raster.x, raster.y, fine, levels=steps, cmap=colour_map("sequential"))
    add_colour_bar(ax, image, "energy ratio")
    if limit is not None:
        ax.plot(raster.x, limit, color="0.2", linestyle="-" if driven == "delta" else "--")
    elif gross.any() and not gross.all():
        ax.contour(raster.x, raster.y, gross, levels=[0.5], colors="0.2", linewidths=1.0)
    entries = arrest_lines(ax, raster, table)
    if entries:
        ax.legend(handles=entries, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2)
    ax.set_xlim(raster.x[0], raster.x[-1])
    ax.set_ylim(raster.y[0], raster.y[-1])
    ax.set_xlabel(f"$W$ [{force_unit(table)}]")
    ax.set_ylabel(label if driven == "delta" else f"{label} [{force_unit(table)}]")
    ax.grid(visible=False)
    return ax
