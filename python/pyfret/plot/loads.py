"""Figures of load histories, counted loops and their damage."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pyfret._util.numbers import in_letters, in_powers
from pyfret._util.theme import DANGER, STICK, colour_map
from pyfret.history.channels import channel_unit
from pyfret.plot.sizes import Width
from pyfret.plot.style import add_colour_bar, axes, mark, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from pyfret.fatigue.damage import Damage
    from pyfret.history.load_history import LoadHistory
    from pyfret.history.loops import CountedLoops

#: Most points of a line: beyond them the turning points alone are drawn.
MOST_POINTS = 20_000
#: Decades of damage that a map shows.
DECADES = 6.0
#: Factor and prefix of the unit of a channel in figures.
PREFIXES = {"m": (1e6, "µ"), "Pa": (1e-6, "M")}


def scaled(channel: str) -> tuple[float, str]:
    """Return the factor and the unit of a channel in a figure."""
    unit = channel_unit(channel)
    factor, prefix = PREFIXES.get(unit, (1.0, ""))
    return factor, prefix + unit


#: Names of channels that are Greek letters.
GREEK = ("delta", "sigma", "phi")


def symbol(channel: str) -> str:
    """Return the name of a channel as a formula."""
    name, _, index = channel.partition("_")
    letter = f"\\{name}" if name in GREEK else name
    return f"${letter}_{{{index}}}$" if index else f"${letter}$"


@styled
def load_history(
    history: LoadHistory, *, width: Width | None = None, ax: Axes | None = None
) -> Axes:
    """Channels over time, the density of a spectrum, or the range-mean histogram of loops.

    The counted channel has the left axis; other channels are drawn over their largest value.
    """
    if history.loops is not None:
        return loop_histogram(history.loops, ax=ax)
    ax = axes(ax)
    factor, unit = scaled(history.channel)
    if history.spectrum is not None:
        spectrum = history.spectrum
        ax.plot(spectrum.frequencies, factor**2 * spectrum.density)
        ax.set_xlabel("frequency [Hz]")
        ax.set_ylabel(f"density of {symbol(history.channel)} [({unit})²/Hz]")
        ax.set_ylim(bottom=0.0)
        return ax
    values = history.channels[history.channel]
    places = np.arange(values.size) if values.size <= MOST_POINTS else history.turns()
    time = places if history.t is None else history.t[places]
    ax.plot(time, factor * values[places], linewidth=0.8, label=symbol(history.channel))
    others = [name for name in history.channels if name != history.channel]
    for name in others:
        values_of_name = history.channels[name]
        top = max(float(np.abs(values_of_name).max()), 1e-300)
        factor_of_name, unit_of_name = scaled(name)
        size = factor * float(np.abs(values).max()) / top
        label = f"{symbol(name)}, largest {factor_of_name * top:.4g} {unit_of_name}"
        ax.plot(time, size * values_of_name[places], linewidth=0.8, linestyle="--", label=label)
    if others:
        ax.legend()
    ax.set_xlabel("sample" if history.t is None else "time [s]")
    ax.set_ylabel(f"{symbol(history.channel)} [{unit}]")
    return ax


@styled
def loop_histogram(
    loops: CountedLoops,
    *,
    ranges: int = 24,
    means: int = 24,
    width: Width | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Number of loops over range and mean, in a logarithmic scale."""
    from matplotlib.colors import LogNorm

    ax = axes(ax)
    channel = str(loops.dataset.attrs["channel"])
    factor, unit = scaled(channel)
    range_edges, mean_edges, counts = loops.histogram(ranges, means)
    shown = np.ma.masked_less_equal(counts, 0.0)
    low, high = float(shown.min()), float(shown.max())
    drawn = ax.pcolormesh(
        factor * mean_edges,
        factor * range_edges,
        shown,
        norm=LogNorm(low, high if high > low else 2.0 * low),
        cmap=colour_map("sequential"),
    )
    add_colour_bar(ax, drawn, "loops")
    ax.set_xlabel(f"mean of {symbol(channel)} [{unit}]")
    ax.set_ylabel(f"range of {symbol(channel)} [{unit}]")
    return ax


@styled
def damage_map(damage: Damage, *, width: Width | None = None, ax: Axes | None = None) -> Axes:
    """Damage of one pass of the history on a section, decimal logarithm, with the worst point."""
    d = damage.dataset
    if min(d.damage.shape) < 2:
        raise ValueError("damage: a map needs two depths and two places: give z=[...] to damage()")
    ax = axes(ax)
    along = str(d.damage.dims[1])
    places, depths = 1e6 * d[along].values, 1e6 * d.z.values
    with np.errstate(divide="ignore", invalid="ignore"):
        shown = np.ma.masked_invalid(np.log10(d.damage.values))
    if shown.count():
        top = float(shown.max())
        shown = np.ma.masked_less(shown, top - DECADES)
        drawn = ax.contourf(places, depths, shown, levels=12, cmap=colour_map("sequential"))
        add_colour_bar(ax, drawn, r"$\log_{10}$ damage of one pass")
        x, y, z = damage.place
        mark(
            ax,
            (1e6 * (x if along == "x" else y), 1e6 * z),
            f"worst point: {in_letters(in_powers(damage.worst_text))}",
        )
    rows = np.flatnonzero(~np.ma.getmaskarray(shown).all(axis=1))
    deepest = depths[min(rows[-1] + 2, depths.size - 1)] if rows.size else depths[-1]
    ax.set_ylim(deepest, 0.0)
    ax.set_xlabel(f"${along}$ [µm]")
    ax.set_ylabel("$z$ [µm]")
    return ax


@styled
def damage_contributions(
    damage: Damage, *, bins: int = 16, width: Width | None = None, ax: Axes | None = None
) -> Axes:
    """Part of each amplitude in the damage of the worst point, and the number of its loops."""
    ax = axes(ax)
    channel = str(damage.dataset.attrs["channel"])
    factor, unit = scaled(channel)
    edges, parts = damage.contributions(bins)
    d = damage.dataset
    counts, _ = np.histogram(0.5 * d["range"].values, edges, weights=d["count"].values)
    ax.bar(
        factor * edges[:-1],
        100.0 * parts,
        factor * np.diff(edges),
        align="edge",
        color=DANGER,
        edgecolor="white",
        label="damage",
    )
    ax.set_xlabel(f"amplitude of {symbol(channel)} [{unit}]")
    ax.set_ylabel("part of the damage [%]")
    loops = ax.twinx()
    loops.spines["right"].set_visible(True)
    loops.grid(visible=False)
    filled = counts > 0.0
    middles = factor * 0.5 * (edges[1:] + edges[:-1])
    loops.semilogy(middles[filled], counts[filled], "o", color=STICK)
    loops.set_ylabel("number of loops")
    ax.plot([], [], "o", color=STICK, label="loops (right)")
    ax.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2, borderpad=0.1)
    return ax
