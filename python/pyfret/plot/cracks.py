"""Figures of cracks below a contact."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter

from pyfret._util.numbers import in_letters, in_words
from pyfret._util.theme import MARK
from pyfret.fracture.growth import Cracks, Threshold
from pyfret.plot.sizes import Width
from pyfret.plot.style import axes, styled
from pyfret.quantities import Length, quantities

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray


__all__ = ["crack_arrest", "intensity", "intensity_history", "kitagawa"]

MICRO, MEGA = 1e6, 1e-6


@styled
def intensity(cracks: Cracks, *, width: Width | None = None, ax: Axes | None = None) -> Axes:
    """Largest and smallest K_I of the cycle over the length of the crack, with their error."""
    ax = axes(ax)
    for name, error, label, colour in (
        ("K_max", cracks.error, r"largest $K_\mathrm{I}$", "C0"),
        ("K_min", cracks.K_min_error, r"smallest $K_\mathrm{I}$", "C1"),
    ):
        ax.errorbar(
            cracks.lengths * MICRO,
            getattr(cracks, name) * MEGA,
            yerr=MEGA * error if "error" in cracks.dataset else None,
            color=colour,
            marker=".",
            label=label,
            elinewidth=0.6,
        )
    ax.axhline(0.0, color="0.7", linewidth=0.5, zorder=0)
    ax.set_xlabel("length of the crack [µm]")
    ax.set_ylabel(r"$K$ [MPa m$^{1/2}$]")
    ax.legend()
    return ax


@styled
@quantities
def intensity_history(
    cracks: Cracks, length: Length, *, width: Width | None = None, ax: Axes | None = None
) -> Axes:
    """K_I and K_II over the kept increments of the cycle, with their error bars.

    Thin lines: faces may pass through each other.

    Parameters
    ----------
    cracks : Cracks
        From :meth:`Result.crack`.
    length : float
        Length of the crack [m]; the nearest of those computed is drawn.
    width : "column" or "page", optional
        Width of a new figure: a column of 85 mm or a page of 170 mm.
    ax : matplotlib Axes, optional
        Where to draw.
    """
    ax = axes(ax)
    at_length = cracks.at_length(length)
    for name, label, colour in (
        ("K_I", r"$K_\mathrm{I}$", "C0"),
        ("K_II", r"$K_\mathrm{II}$", "C1"),
    ):
        ax.errorbar(
            at_length.increment,
            at_length[name] * MEGA,
            yerr=at_length[f"{name}_error"] * MEGA,
            color=colour,
            label=label,
            elinewidth=0.6,
        )
        ax.plot(
            at_length.increment, at_length[f"{name}_linear"] * MEGA, color=colour, linewidth=0.5
        )
    ax.plot([], [], color="0.3", linewidth=0.5, label="faces that pass through each other")
    ax.axhline(0.0, color="0.7", linewidth=0.5, zorder=0)
    ax.xaxis.set_major_locator(MaxNLocator(6, integer=True))
    ax.set_xlabel("increment")
    ax.set_ylabel(r"$K$ [MPa m$^{1/2}$]")
    # Room for the legend above the curves.
    low, high = ax.get_ylim()
    ax.set_ylim(low, high + 0.45 * (high - low))
    title = f"$l$ = {in_words(float(at_length.length) * MICRO, 3)} µm"
    ax.legend(loc="upper center", ncols=2, title=title)
    return ax


@styled
@quantities
def crack_arrest(
    cracks: Cracks,
    threshold: Threshold,
    *,
    start: Length | None = None,
    width: Width | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Range of K over the length of the crack, its threshold, and what becomes of the crack.

    Parameters
    ----------
    cracks : Cracks
        From :meth:`Result.crack`.
    threshold : Threshold
        Of the material.
    start : float, optional
        Length that the crack begins with [m] (default: the shortest).
    width : "column" or "page", optional
        Width of a new figure: a column of 85 mm or a page of 170 mm.
    ax : matplotlib Axes, optional
        Where to draw.
    """
    ax = axes(ax)
    lengths = cracks.lengths * MICRO
    range_of_K = cracks.dK(threshold)
    ax.plot(lengths, range_of_K * MEGA, color="C0", label=r"$\Delta K$")
    draw_band(ax, lengths, range_of_K * MEGA, cracks.dK_error(threshold) * MEGA)
    limit = rf"$\Delta K_\mathrm{{th}}${threshold.mark}"
    ax.plot(lengths, threshold.range_at(cracks.lengths) * MEGA, "k--", label=limit)
    arrest = cracks.arrest(threshold, start=start)
    tip = np.atleast_1d(threshold.range_at(arrest.tip))[0] * MEGA
    if arrest.verdict != "grows":
        ax.plot(arrest.tip * MICRO, tip, "o", color=MARK, zorder=3)
    ax.plot([], [], "o", color=MARK, label=in_letters(f"the crack {arrest.briefly()}"))
    if arrest.lengths is not None:
        shown = (lengths[0], lengths[-1])
        ends = [float(np.clip(end * MICRO, *shown)) for end in arrest.lengths]
        ax.plot(ends, [tip, tip], color=MARK, linewidth=3.0, alpha=0.5, zorder=2.5)
    ax.set_xscale("log")
    ax.set_ylim(bottom=0.0)
    ax.set_xlabel(r"crack length $l$ [µm]")
    ax.set_ylabel(r"$\Delta K_\mathrm{I}$ [MPa m$^{1/2}$]")
    ax.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2, borderpad=0.1)
    return ax


def draw_band(
    ax: Axes, lengths: NDArray[np.float64], values: NDArray[np.float64], error: NDArray[np.float64]
) -> None:
    """Draw the error of a curve over the length of the crack as a band, where it has one."""
    if np.isfinite(error).any():
        low = np.maximum(values - error, 1e-3 * np.nanmin(values[values > 0.0], initial=np.inf))
        label = r"error of $\Delta K$"
        ax.fill_between(
            lengths, low, values + error, color="C0", alpha=0.25, linewidth=0.0, label=label
        )


def plain_ticks(ax: Axes) -> None:
    """Numbers without powers of ten at 1, 2 and 5 of each decade of the axis upwards."""
    ax.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    ax.yaxis.set_minor_formatter(NullFormatter())


@styled
def kitagawa(
    cracks: Cracks, threshold: Threshold, *, width: Width | None = None, ax: Axes | None = None
) -> Axes:
    """Kitagawa and Takahashi's diagram with the curve of the load in it.

    A crack grows where the curve is above the limit.

    Parameters
    ----------
    cracks : Cracks
        From :meth:`Result.crack`.
    threshold : Threshold
        Of the material.
    width : "column" or "page", optional
        Width of a new figure: a column of 85 mm or a page of 170 mm.
    ax : matplotlib Axes, optional
        Where to draw.
    """
    ax = axes(ax)
    diagram = cracks.kitagawa(threshold)
    lengths = diagram.length * MICRO
    load = diagram["load"].where(diagram["load"] > 0.0)
    ax.plot(lengths, load * MEGA, color="C0", label="load")
    error = cracks.dK_error(threshold) * load.values / cracks.dK(threshold)
    draw_band(ax, lengths, load.values * MEGA, error * MEGA)
    ax.plot(lengths, diagram["limit"] * MEGA, "k--", label=f"limit{threshold.mark}")
    if threshold.dS_0 is not None:
        ax.axhline(threshold.dS_0 * MEGA, color="0.6", linestyle=":", label=r"$\Delta\sigma_0$")
    ax.set_xscale("log")
    ax.set_yscale("log")
    plain_ticks(ax)
    ax.set_xlabel(r"crack length $l$ [µm]")
    ax.set_ylabel(r"$\Delta K/(Y\sqrt{\pi l})$ [MPa]")
    ax.legend()
    return ax
