"""Stress below the contact."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib import colormaps
from matplotlib.colors import ListedColormap
from matplotlib.ticker import MaxNLocator

from pyfret.plot.style import axes, styled

if TYPE_CHECKING:
    from collections.abc import Mapping

    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from pyfret.results import Result
    from pyfret.subsurface import Stress

#: Names of measures in figures.
SYMBOLS = {
    "von_mises": r"\sigma_\mathrm{VM}",
    "tresca": r"\sigma_\mathrm{T}",
    "hydrostatic": r"\sigma_\mathrm{h}",
    "s_1": r"\sigma_1",
    "s_2": r"\sigma_2",
    "s_3": r"\sigma_3",
    "s_xx": r"\sigma_{11}",
    "s_yy": r"\sigma_{22}",
    "s_zz": r"\sigma_{33}",
    "s_xy": r"\sigma_{12}",
    "s_xz": r"\sigma_{13}",
    "s_yz": r"\sigma_{23}",
    "interface_shear": r"\tau_\mathrm{if}",
    "interface_peel": r"\sigma_\mathrm{peel}",
}


def _interfaces(z: xr.DataArray, layer: xr.DataArray) -> list[float]:
    """Depths at which the layer changes."""
    changes = np.flatnonzero(np.diff(layer.values))
    return [float(z[n] + z[n + 1]) / 2 for n in changes]


def _mark(
    ax: Axes, place: tuple[float, float, float], *, a_H: float, p_H: float, marker: str = "x"
) -> None:
    """Mark a value [Pa] at a place along the section and a depth [m]."""
    value, along, depth = place
    at = (along / a_H, depth / a_H)
    ax.plot(*at, marker, color=MARK, mfc="none", ms=7, mew=1.6, clip_on=False, zorder=4)
    ax.annotate(
        f"{value / p_H:.3f}",
        at,
        xytext=(7, -11),
        textcoords="offset points",
        color=MARK,
        fontsize=8,
        bbox={"boxstyle": "round,pad=0.15", "fc": "white", "ec": "none", "alpha": 0.8},
    )


#: Colour of largest values.
MARK = "#D55E00"
#: Light enough for black labels.
COLOURS = ListedColormap(colormaps["YlGnBu"](np.linspace(0.0, 0.62, 256)))


@styled
def section_map(
    values: xr.DataArray,
    *,
    a_H: float,
    p_H: float,
    symbol: str | None = None,
    levels: int = 12,
    maximum: tuple[float, float, float] | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Contours of a field on a section over p_H, lengths over a_H, depth downwards.

    Parameters
    ----------
    values : DataArray of dims (depth, x) or (depth, y)
        The field [Pa].
    a_H, p_H : float
        Yardsticks of length and stress.
    symbol : str, optional
        What the field is called (default: by its name).
    levels : int
        Number of contours, about.
    maximum : (float, float, float), optional
        Value [Pa], place along the section and depth [m] of a cross with its value beside it.
    ax : matplotlib Axes, optional
        Where to draw.
    """
    if ax is None:
        ax = plt.figure(figsize=(4.6, 3.8)).add_subplot()
    along = str(values.dims[1])
    x, z = values[along].values / a_H, values.z.values / a_H
    field = values.values / p_H
    steps = MaxNLocator(levels).tick_values(np.nanmin(field), np.nanmax(field))
    layer = values.layer.values
    for part in np.unique(layer):
        here = layer == part
        if np.count_nonzero(here) < 2:
            continue
        ax.contourf(x, z[here], field[here], levels=steps, cmap=COLOURS)
        lines = ax.contour(x, z[here], field[here], levels=steps, colors="0.2", linewidths=0.4)
        ax.clabel(lines, steps[1::2], fontsize=6.5, inline_spacing=2)
    for depth in _interfaces(values.z, values.layer):
        ax.axhline(depth / a_H, color="0.2", linewidth=0.8, linestyle=(0, (6, 3)))
    if maximum is not None:
        _mark(ax, maximum, a_H=a_H, p_H=p_H)
    ax.set_xlabel(rf"${along}/a_H$" if along != "x" else r"$x_1/a_H$")
    ax.set_ylabel(r"$x_3/a_H$")
    ax.set_ylim(z[-1], z[0])
    ax.set_aspect("equal")
    ax.grid(visible=False)
    name = symbol if symbol is not None else SYMBOLS.get(str(values.name), str(values.name))
    ax.set_title(rf"${name}/p_H$")
    return ax


@styled
def stress_map(
    stress: Stress,
    *,
    a_H: float,
    p_H: float,
    of: str = "von_mises",
    levels: int = 12,
    ax: Axes | None = None,
) -> Axes:
    """Contours of a measure of stress on a section over p_H.

    A cross marks the largest value, a circle the largest one on the surface if that is another.
    """
    value, along, z, _ = stress.maximum(of)
    values = stress.measure(of)
    largest = (value, along, z)
    ax = section_map(values, a_H=a_H, p_H=p_H, levels=levels, maximum=largest, ax=ax)
    if float(values.z[0]) == 0.0 < z:
        surface = type(stress)(stress.dataset.isel(depth=slice(1)))
        _mark(ax, surface.maximum(of)[:3], a_H=a_H, p_H=p_H, marker="o")
    return ax


@styled
def stress_along_depth(
    stress: Stress,
    *,
    a_H: float,
    p_H: float,
    of: tuple[str, ...] = ("s_xx", "s_yy", "s_zz", "von_mises"),
    ax: Axes | None = None,
) -> Axes:
    """Measures of the stress below one point over p_H, over the depth over a_H.

    Broken at interfaces, where s_xx and s_yy jump.
    """
    ax = axes(ax)
    z, layer = stress.dataset.z.values / a_H, stress.dataset.layer.values
    if stress.dataset.s_xx.ndim != 1:
        raise ValueError("the line below one point is drawn: give stress(z, x=..., y=...)")
    for n, name in enumerate(of):
        values = stress.measure(name).values / p_H
        for part in np.unique(layer):
            here = layer == part
            label = f"${SYMBOLS.get(name, name)}$" if part == layer[0] else None
            ax.plot(z[here], values[here], color=f"C{n}", label=label)
    for depth in _interfaces(stress.dataset.z, stress.dataset.layer):
        ax.axvline(depth / a_H, color="0.6", linewidth=0.8, linestyle=(0, (6, 3)), zorder=0)
    ax.set_xlabel(r"$x_3/a_H$")
    ax.set_ylabel(r"$\sigma/p_H$")
    ax.legend()
    return ax


@styled
def envelope_maps(
    envelope: xr.Dataset, *, a_H: float, p_H: float, of: str = "von_mises", cycle: int = -1
) -> Figure:
    """Largest value over the path, and amplitude and mean over a cycle, of a measure of stress."""
    name = SYMBOLS.get(of, of)
    shown = [(envelope[f"{of}_max"], rf"\max {name}")]
    if envelope.sizes.get("cycle", 0) > 0:
        shown.append((envelope[f"{of}_amplitude"].isel(cycle=cycle), rf"\Delta {name}/2"))
        shown.append((envelope[f"{of}_mean"].isel(cycle=cycle), rf"\overline{{{name}}}"))
    figure, row = plt.subplots(
        1, len(shown), figsize=(0.4 + 3.7 * len(shown), 3.7), squeeze=False, layout="constrained"
    )
    for ax, (values, symbol) in zip(row[0], shown, strict=True):
        section_map(values, a_H=a_H, p_H=p_H, symbol=symbol, ax=ax)
        ax.label_outer()
    return figure


@styled
def stress_history(
    envelope: xr.Dataset,
    *,
    a_H: float,
    p_H: float,
    of: str = "von_mises",
    ax: Axes | None = None,
    **line: Any,
) -> Axes:
    """Largest value of a measure of stress on a section, over p_H, at every increment.

    The points are coloured by its depth over a_H.
    """
    ax = axes(ax)
    value, z = envelope[f"{of}_largest"] / p_H, envelope[f"{of}_largest_z"] / a_H
    ax.plot(value.increment, value, color="0.7", zorder=1, **line)
    points = ax.scatter(value.increment, value, c=z, s=9, cmap="viridis", zorder=2)
    bar = ax.get_figure().colorbar(points, ax=ax)  # type: ignore[union-attr]
    bar.set_label(r"$x_3/a_H$")
    ax.set_ylim(bottom=0.0)
    ax.set_xlabel("increment")
    ax.set_ylabel(rf"$\max {SYMBOLS.get(of, of)}/p_H$")
    return ax


@styled
def stress_maps(
    results: Mapping[float, Result],
    *,
    depth: float = 2.0,
    layers: int = 256,
    of: str = "von_mises",
) -> Figure:
    """Figure 13 of the paper: stress below the contact at the end of the path, for every ratio.

    Parameters
    ----------
    results : mapping of float to Result
        The run of each ratio E1/E2 of the moduli of coating and substrate.
    depth : float
        Largest depth over a_H.
    layers : int
        Number of depths.
    of : str
        Measure of stress.
    """
    n = len(results)
    figure, row = plt.subplots(
        1, n, figsize=(0.4 + 3.7 * n, 3.7), squeeze=False, layout="constrained"
    )
    for ax, letter, (ratio, result) in zip(row[0], "abcdef", sorted(results.items()), strict=False):
        interfaces = np.cumsum([c.thickness for c in result.scene.body2.coatings])
        z = np.union1d(np.linspace(0.0, depth * result.a_H, layers), interfaces)
        stress = result.at(-1).stress(z, y=0.0)
        stress_map(stress, a_H=result.a_H, p_H=result.p_H, of=of, ax=ax)
        ax.set_title(rf"({letter})  $E_1/E_2 = {ratio:g}$")
        ax.label_outer()
    return figure


@styled
def loop_evolution(result: Result, *, ax: Axes | None = None, **line: Any) -> Axes:
    """Energy ratio, sliding ratio and dissipated energy of each cycle, the last over its mean."""
    ax = axes(ax)
    loops = result.loops()
    number = np.arange(1, loops.sizes["cycle"] + 1)
    line = {"marker": "o", "markersize": 4, **line}
    dissipated = loops.dissipated / loops.dissipated.mean()
    for values, label in (
        (loops.energy_ratio, "energy ratio"),
        (loops.sliding_ratio, "sliding ratio"),
        (dissipated, "dissipated energy over its mean"),
    ):
        ax.plot(number, values, label=label, **line)
    ax.set_xlabel("cycle")
    ax.set_xticks(number)
    ax.set_ylim(bottom=0.0)
    ax.legend()
    return ax


@styled
def running_map(table: xr.Dataset, *, ax: Axes | None = None) -> Axes:
    r"""Running conditions over W and the amplitude of T or of the shift, from the sweep.

    Coloured by the energy ratio, which tells gross slip (0.2 and more) from partial slip. Over
    shifts a line parts them by the status; over forces it is grey where there is no static
    solution, above the dashed line :math:`T = \mu W`.
    """
    ax = axes(ax)
    driven = "T" if "T" in table.dims else "delta"
    scale, label = {"T": (1.0, r"$T$ [N]"), "delta": (1e6, r"$\delta$ [µm]")}[driven]
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
    ax.set_xlim(*limits[0])
    ax.set_ylim(*limits[1])
    ax.set_xlabel(r"$W$ [N]")
    ax.set_ylabel(label)
    ax.grid(visible=False)
    return ax
