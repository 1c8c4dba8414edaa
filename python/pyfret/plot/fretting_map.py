"""The fretting map: running conditions, crack risk and frictional energy over the loads."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from pyfret.plot.stresses import COLOURS
from pyfret.plot.studies import in_figures
from pyfret.plot.style import axes, styled

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

#: Running conditions by the codes of ``status``, each with its colour.
CONDITIONS = {0: ("no contact", "#ffffff"), 1: ("full stick", "#9ecae1")}
CONDITIONS |= {2: ("partial slip", "#deebf7"), 3: ("gross slip", "#fdd0a2")}
#: Axes of the map: factor and label.
AXES = {"T": (1.0, r"$T$"), "delta": (1e6, r"$\delta$ [µm]")}
#: Lives whose contours are drawn [cycles], and the levels of safety factors.
LIVES = 10.0 ** np.arange(3, 10)
FACTORS = np.array([0.3, 0.5, 1.0, 2.0, 4.0])
CRACK, ENERGY, ARREST = "#a50f15", "0.35", "#08519c"
#: Lengths of stopped cracks whose contours are drawn [µm].
LENGTHS = np.array([10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0])


@styled
def fretting_map(table: xr.Dataset, *, ax: Axes | None = None) -> Axes:
    """Running conditions as areas, over them contours of crack risk and of the energy of a cycle.

    The crack risk is the criterion that the map was made with, as safety factor or as life in
    cycles: full lines, thick where the factor is 1. Dashed lines are the energy that friction
    dissipates in a cycle, to which wear is proportional. Dotted lines are lengths at which cracks
    stop; where none stops any more a thick dotted line begins.

    Parameters
    ----------
    table : xarray.Dataset
        Of :func:`pyfret.study.running_conditions` with `cracking` and `arrest`; what was not asked
        for is left out.
    ax : matplotlib Axes, optional
        Where to draw.
    """
    ax = axes(ax)
    driven = "T" if "T" in table.dims else "delta"
    scale, label = AXES[driven]
    table = table.transpose(driven, "W", ...)
    W, amplitude = table.W.values, table[driven].values * scale
    status = table.status.values
    colours = ListedColormap([colour for _, colour in CONDITIONS.values()])
    norm = BoundaryNorm(np.arange(-0.5, 4.0), colours.N)
    ax.pcolormesh(W, amplitude, status, cmap=colours, norm=norm, shading="nearest", zorder=0)
    entries: list[Patch | Line2D] = [
        Patch(color=c, label=name) for n, (name, c) in CONDITIONS.items() if n in status
    ]
    energy, meaning = in_figures(table.dissipated)
    entries += lines(ax, W, amplitude, energy.values, None, ENERGY, "dashed", meaning)
    for name, levels in (("safety_factor", FACTORS), ("life", LIVES)):
        if name in table:
            meaning = {"safety_factor": "safety factor", "life": "life [cycles]"}[name]
            entries += lines(ax, W, amplitude, table[name].values, levels, CRACK, "solid", meaning)
    entries += arrest_lines(ax, W, amplitude, table)
    ax.set_xlabel(f"$W$ [{force_unit(table)}]")
    ax.set_ylabel(label if driven == "delta" else f"{label} [{force_unit(table)}]")
    ax.grid(visible=False)
    ax.legend(handles=entries, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2)
    return ax


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
    """Contours with their numbers, and their entry in the legend; none where nothing is known."""
    shown = np.ma.masked_invalid(field)
    if min(shown.shape) < 2 or shown.count() < 4:
        return []
    given: dict[str, Any] = {} if levels is None else {"levels": levels}
    found = levels if levels is not None else np.array([])
    widths = np.where(found == 1.0, 2.0, 1.0) if found.size else 0.8
    drawn = ax.contour(
        W, amplitude, shown, colors=colour, linestyles=style, linewidths=widths, **given
    )
    ax.clabel(drawn, fontsize=7, fmt="%g")
    return [Line2D([], [], color=colour, linestyle=style, linewidth=1.0, label=meaning)]


def arrest_lines(
    ax: Axes, x: NDArray[Any], y: NDArray[Any], table: xr.Dataset, colour: str = ARREST
) -> list[Line2D]:
    """Contours of the length at which cracks stop, and the line beyond which none does."""
    if "arrest_margin" not in table:
        return []
    length = table.arrest_length.values * 1e6
    meaning = "crack stops at [µm]"
    entries = lines(ax, x, y, length, LENGTHS, colour, "dotted", meaning)
    margin = np.ma.masked_invalid(table.arrest_margin.values)
    if min(margin.shape) > 1 and margin.min() < 1.0 < margin.max():
        ax.contour(x, y, margin, levels=[1.0], colors=colour, linestyles="dotted", linewidths=2.2)
        line = Line2D([], [], color=colour, linestyle="dotted", linewidth=2.2)
        line.set_label("no crack stops beyond")
        entries.append(line)
    return entries


@styled
def arrest_map(table: xr.Dataset, *, ax: Axes | None = None) -> Axes:
    """Where cracks stop over shear and bulk stress, and at which length.

    Three areas: no crack grows from its first length, cracks stop, cracks grow; dotted lines are
    the lengths at which they stop, full lines the criterion of initiation, if the map has one.

    Parameters
    ----------
    table : xarray.Dataset
        Of :func:`pyfret.study.arrest_map`.
    ax : matplotlib Axes, optional
        Where to draw.
    """
    ax = axes(ax)
    table = table.transpose("T", "sigma_B")
    bulk, T = table.sigma_B.values / 1e6, table["T"].values / 1e3
    margin, length = table.arrest_margin.values, table.arrest_length.values
    shortest = np.nanmin(length) if np.isfinite(length).any() else np.nan
    fate = np.where(margin >= 1.0, 2.0, np.where(length <= shortest, 0.0, 1.0))
    fate[np.isnan(margin)] = np.nan
    names = ("no growth", "stops", "grows")
    colours = ListedColormap(["#ffffff", "#9ecae1", "#fdd0a2"])
    norm = BoundaryNorm(np.arange(-0.5, 3.0), colours.N)
    ax.pcolormesh(bulk, T, np.ma.masked_invalid(fate), cmap=colours, norm=norm, shading="nearest")
    entries: list[Patch | Line2D] = [
        Patch(facecolor=colours(n), edgecolor="0.6", label=name)
        for n, name in enumerate(names)
        if n in fate
    ]
    for name, levels, meaning in (
        ("safety_factor", FACTORS, "safety factor of initiation"),
        ("life", LIVES, "cycles to initiation"),
    ):
        if name in table:
            entries += lines(ax, bulk, T, table[name].values, levels, CRACK, "solid", meaning)
    entries += arrest_lines(ax, bulk, T, table)
    ax.set_xlabel(r"bulk stress $\sigma_\mathrm{B}$ [MPa]")
    unit = str(table["T"].attrs.get("units", "N"))
    ax.set_ylabel(f"$T$ [k{unit}]")
    ax.grid(visible=False)
    ax.legend(handles=entries, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2)
    return ax


@styled
def running_map(table: xr.Dataset, *, ax: Axes | None = None) -> Axes:
    r"""Running conditions over W and the amplitude of T or of the shift, from the sweep.

    Coloured by the energy ratio, which tells gross slip (0.2 and more) from partial slip. Over
    shifts a line parts them by the status; over forces it is grey where there is no static
    solution, above the dashed line :math:`T = \mu W`. With `arrest` in the sweep dotted lines are
    the lengths at which cracks stop, and a thick one begins where none does.
    """
    ax = axes(ax)
    driven = "T" if "T" in table.dims else "delta"
    scale, label = AXES[driven]
    W, amplitude = table.W.values, table[driven].values * scale
    ratio = table.energy_ratio.transpose(driven, "W").values
    slides = table.status.transpose(driven, "W").values == 3
    image = ax.pcolormesh(
        W, amplitude, np.ma.masked_invalid(ratio), cmap=COLOURS, shading="nearest"
    )
    unsolved = np.ma.masked_where(np.isfinite(ratio), np.ones_like(ratio))
    ax.pcolormesh(W, amplitude, unsolved, cmap="Greys", vmin=0, vmax=3, shading="nearest")
    bar = ax.get_figure().colorbar(image, ax=ax)  # type: ignore[union-attr]
    bar.set_label("energy ratio")
    limits = ax.get_xlim(), ax.get_ylim()
    if driven == "delta" and slides.any() and not slides.all():
        ax.contour(W, amplitude, slides, levels=[0.5], colors="0.2", linewidths=1.0)
    if driven == "T":
        ends = np.array([0.0, W.max() * 1.1])
        ax.plot(ends, table.attrs["mu"] * ends, color="0.2", linestyle="--", linewidth=0.9)
    entries = arrest_lines(ax, W, amplitude, table.transpose(driven, "W"))
    if entries:
        ax.legend(handles=entries, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2)
    ax.set_xlim(*limits[0])
    ax.set_ylim(*limits[1])
    ax.set_xlabel(f"$W$ [{force_unit(table)}]")
    ax.set_ylabel(label if driven == "delta" else f"{label} [{force_unit(table)}]")
    ax.grid(visible=False)
    return ax
