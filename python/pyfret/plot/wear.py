"""Figures of wear."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

from pyfret._util.theme import CATEGORIES, SAFE, colour_map
from pyfret.plot.sizes import Width
from pyfret.plot.style import add_colour_bar, axes, inside_legend, styled

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

    from pyfret.wear.result import WearResult

#: What is drawn of a worn pair.
Which = Literal["body1", "body2", "both"]
#: Debris in a scar, and where oxygen arrives.
DEBRIS, AIR = CATEGORIES[1], SAFE
#: Most profiles in a figure.
MOST_LINES = 50
#: Deepest depth over the deepest of the profiles from which on the legend has it.
OFF_LINE = 1.02


def _depth(d: xr.Dataset, of: Which) -> np.ndarray:
    """Return the worn depth of a body, or of both."""
    fields = {"body1": d.worn1, "body2": d.worn2, "both": d.worn1 + d.worn2}
    return np.asarray(fields[of])


@styled
def wear_profiles(
    result: WearResult,
    *,
    of: Which = "body2",
    lines: int = 8,
    width: Width | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Worn depth on the line along the shear after several blocks of cycles, in um, downwards.

    The line goes through the centre of the last contact (:meth:`WearResult.along`). At most `lines`
    profiles are drawn, 1 to 50, at equal steps of the largest depth.
    """
    if not 1 <= lines <= MOST_LINES:
        raise ValueError(f"lines = {lines}: must be 1 to {MOST_LINES}")
    ax = axes(ax)
    d = result.along()
    middle = _depth(d, of)
    along = str(d.worn2.dims[-1])
    position = 1e3 * d[along].values
    last = len(middle) - 1
    wanted_depths = np.linspace(middle.max() / lines, middle.max(), lines)
    chosen = sorted(
        {min(int(np.searchsorted(middle.max(axis=1), w)), last) for w in wanted_depths} | {last}
    )
    colours = colour_map("order")(np.linspace(1.0, 0.0, len(chosen)))
    for block, colour in zip(chosen, colours, strict=True):
        cycles = f"{float(result.dataset.block_cycles[block]):,.0f}".replace(",", " ")
        ax.plot(position, 1e6 * middle[block], color=colour, label=cycles)
    ax.invert_yaxis()
    worn = np.flatnonzero(middle[-1] > 1e-3 * middle.max())
    if len(worn):
        low, high = position[worn[[0, -1]]]
        room = 0.125 * (high - low)
        ax.set_xlim(low - room, high + room)
    ax.set_xlabel(f"${along}$ [mm]")
    ax.set_ylabel("worn depth [µm]")
    deepest = float(np.max(_depth(result.dataset, of)[-1]))
    if deepest > OFF_LINE * middle[-1].max():
        ax.plot([], [], " ", label=f"deepest, off this line: {1e6 * deepest:.3g} µm")
    ax.legend(title="cycles", fontsize="small")
    return ax


@styled
def third_body(
    result: WearResult, *, block: int = -1, width: Width | None = None, ax: Axes | None = None
) -> Axes:
    """Scar, bed of debris and aerated zone on the line along the shear after a block, in um.

    The depths of both bodies together point downwards. The bed fills the scar up to the growth of
    the gap. The background is light blue where oxygen arrives in the contact.
    """
    ax = axes(ax)
    d = result.along().isel(block=block)
    along = str(d.worn2.dims[-1])
    position = 1e3 * d[along].values
    depth = 1e6 * np.asarray(d.worn1 + d.worn2)
    bed = 1e6 * np.asarray(d.bed)
    if "bed" not in result.table:
        bed = result.debris_kept * depth
    open_depth = depth - bed
    aerated = np.where(np.asarray(d.p) > 0.0, np.asarray(d.aerated), 0.0)
    step = position[1] - position[0]
    for x, share in zip(position, aerated, strict=True):
        if share > 0.0:
            ax.axvspan(x - 0.5 * step, x + 0.5 * step, color=AIR, alpha=0.5 * share, lw=0)
    ax.plot(position, depth, label="worn off both bodies")
    if bed.any():
        ax.fill_between(position, open_depth, depth, color=DEBRIS, alpha=0.4, label="debris")
        ax.plot(position, open_depth, color=DEBRIS, linestyle="--", label="growth of the gap")
    if aerated.any():
        ax.fill_between([], [], color=AIR, alpha=0.5, label="oxygen arrives")
    ax.invert_yaxis()
    worn = np.flatnonzero(depth > 1e-3 * max(float(depth.max()), 1e-30))
    if len(worn):
        low, high = position[worn[[0, -1]]]
        room = 0.125 * (high - low) + step
        ax.set_xlim(low - room, high + room)
    ax.set_xlabel(f"${along}$ [mm]")
    ax.set_ylabel("depth [µm]")
    cycles = f"{float(result.dataset.block_cycles[block]):,.0f} cycles".replace(",", " ")
    ax.legend(title=cycles, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2, borderpad=0.1)
    return ax


@styled
def depth_map(
    result: WearResult,
    *,
    of: Which = "body2",
    block: int = -1,
    width: Width | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Worn depth over the contact plane after a block of cycles, um."""
    ax = axes(ax, square=True)
    d = result.dataset
    depth = 1e6 * _depth(d, of)[block].T
    drawn = ax.pcolormesh(
        1e3 * d.x,
        1e3 * d.y,
        depth,
        cmap=colour_map("sequential"),
        shading="nearest",
        rasterized=True,
    )
    add_colour_bar(ax, drawn, "worn depth [µm]")
    ax.set_xlabel("$x$ [mm]")
    ax.set_ylabel("$y$ [mm]")
    return ax


@styled
def wear_history(result: WearResult, *, width: Width | None = None, ax: Axes | None = None) -> Axes:
    """Deepest worn depth of each body that wears over cycles, with the coatings' thickness, um.

    Coatings that are worn through, or reported as thin, are marked at their cycle.
    """
    ax = axes(ax)
    d = result.dataset
    scene = result.scene
    first = float(d.cycles[0] - d.length[0])
    for body, coated in ((1, scene.body1), (2, scene.body2)):
        depth = 1e6 * np.r_[d.attrs["depth_before"][body - 1], d[f"depth{body}"]]
        if depth[-1] == 0:
            continue
        (line,) = ax.plot(np.r_[first, d.cycles], depth, label=f"body {body}")
        bottom = 0.0
        for n, layer in enumerate(coated.coatings):
            bottom += 1e6 * layer.thickness
            if bottom < 3 * depth[-1]:
                bottom_label = f"bottom of coating {n + 1} of body {body}"
                ax.axhline(
                    bottom, color=line.get_color(), linestyle=":", linewidth=1, label=bottom_label
                )
    for event in result.events:
        if event["kind"] == "worn through":
            label = f"coating {event['coating'] + 1} of body {event['body']} is worn through"
            ax.axvline(event["cycles"], color="0.5", linestyle="--", linewidth=1, label=label)
    ax.set_xlabel("cycles")
    ax.set_ylabel("deepest worn depth [µm]")
    ax.set_ylim(bottom=0)
    inside_legend(ax)
    return ax


@styled
def wear_loops(result: WearResult, *, width: Width | None = None, ax: Axes | None = None) -> Axes:
    """Friction loops at the first and at the last block of cycles, along x or y.

    It is the axis along which the force is largest.
    """
    ax = axes(ax)
    d, direction = result.dataset, result.direction
    # The last one dashed, so that the first is seen where they are alike.
    for block, look in ((0, "-"), (-1, "--")):
        shift, force = (
            np.asarray(d[f"loop_{quantity}_{direction}"][block]) for quantity in ("delta", "T")
        )
        cycles = f"after {float(d.block_cycles[block]):,.0f} cycles".replace(",", " ")
        ax.plot(1e6 * np.r_[shift[-1], shift], np.r_[force[-1], force], look, label=cycles)
    ax.set_xlabel(rf"$\delta_{direction}$ [µm]")
    ax.set_ylabel(f"$T_{direction}$ [{d.loop_T_x.attrs['units']}]")
    ax.legend()
    return ax
