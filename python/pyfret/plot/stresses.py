"""Stress below the contact."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from matplotlib.ticker import MaxNLocator

from pyfret._util.arrays import plain
from pyfret._util.depths import interfaces, thin
from pyfret._util.numbers import in_words
from pyfret._util.theme import colour_map
from pyfret.plot.depth_axis import DepthScale, draw_depth_axis
from pyfret.plot.scales import Scales, Units, scales
from pyfret.plot.sizes import Width, new_axes, new_panels
from pyfret.plot.style import add_colour_bar, axes, mark, styled
from pyfret.plot.tables import must_hold
from pyfret.quantities import Length, PeakPressure, Quantity, RelativeDepth
from pyfret.subsurface.contact import stress_below
from pyfret.subsurface.line import Line, line_of, main_line
from pyfret.subsurface.tensor import Stress

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.colors import Colormap
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from pyfret.run import Run
    from pyfret.subsurface.extremum import Extremum

#: What computes the extremes of a path.
ENVELOPE = "extremes of that measure over a path, result.envelope(of=[...])"
#: Names of measures in figures.
SYMBOLS = {
    "von_mises": r"\sigma_\mathrm{VM}",
    "tresca": r"\sigma_\mathrm{T}",
    "hydrostatic": r"\sigma_\mathrm{h}",
    "s_1": r"\sigma_1",
    "s_2": r"\sigma_2",
    "s_3": r"\sigma_3",
    "s_xx": r"\sigma_{xx}",
    "s_yy": r"\sigma_{yy}",
    "s_zz": r"\sigma_{zz}",
    "s_xy": r"\sigma_{xy}",
    "s_xz": r"\sigma_{xz}",
    "s_yz": r"\sigma_{yz}",
    "interface_shear": r"\tau_\mathrm{if}",
    "interface_peel": r"\sigma_\mathrm{peel}",
}


#: Part of a largest value from which on its error is said beside it.
TOLD = 0.02


def _scales(
    attrs: Mapping[Any, Any], units: Units, a_H: Quantity | None, p_H: Quantity | None
) -> Scales:
    """Scales of a dataset, or those given."""
    yardsticks = {k: v for k, v in (("a_H", a_H), ("p_H", p_H)) if v is not None}
    return scales({**attrs, **yardsticks}, units)


def _mark(ax: Axes, largest: Extremum, line: Line, by: Scales, *, marker: str = "x") -> None:
    """Mark a value at its place along the section and its depth, with an entry in the legend."""
    at = (line.place(largest.x, largest.y) / by.length.value, largest.z / by.length.value)
    where = "largest" if marker == "x" else "on the surface"
    text = in_words(largest.value / by.stress.value)
    if largest.error > TOLD * abs(largest.value):
        text += f" ± {in_words(largest.error / by.stress.value, digits=2)}"
    text += f" {by.stress.name}" if by.stress.is_unit else ""
    mark(ax, at, f"{where} {text}", marker=marker)


def section_size(values: xr.DataArray, width: float = 4.8) -> tuple[float, float]:
    """Return the size of a figure [inch] that a section to scale fills, with labels and colours."""
    along, z = values[str(values.dims[1])].values, values.z.values
    inner = interfaces(values.z, values.layer)
    ratio = np.ptp(along) / max(np.ptp(z), 1e-300)
    if ratio > FLAT or thin(np.array([z[0], *inner, z[-1]])):
        return width, 0.8 * width
    # Labels, ticks and the scale take an inch and a half beside the section, 0.7 below it.
    return width, float(np.clip((width - 1.5) / ratio + 0.7, 0.5 * width, 1.3 * width))


#: Length over depth of a section beyond which equal lengths leave it too low to be read.
FLAT = 3.0
#: Width of one of several sections side by side [inch]: three fill a page at the size of its text.
PANEL = 2.9
#: Part of the largest size from which both signs of a field are shown.
BOTH_SIGNS = 0.02


def is_signed(field: NDArray[np.float64]) -> bool:
    """Check that a field has negative and positive numbers that can be seen."""
    low, high = float(np.nanmin(field)), float(np.nanmax(field))
    return min(-low, high) > BOTH_SIGNS * max(-low, high)


def contour_levels(
    field: NDArray[np.float64], levels: int | Sequence[float]
) -> tuple[NDArray[np.float64], Colormap]:
    """Return the contours of a field, about `levels` of them, and its colours.

    Fields of both signs have contours symmetric about zero and colours with white at zero, and so
    have contours that are given symmetric about zero.
    """
    signed = is_signed(field)
    if isinstance(levels, int):
        if not levels >= 1:
            raise ValueError(f"levels = {levels}: must be 1 or more")
        low, high = np.nanmin(field), np.nanmax(field)
        if signed:
            high = max(-low, high)
            low = -high
        levels = MaxNLocator(levels).tick_values(low, high)
    steps = plain(levels, "levels")
    if steps.ndim != 1 or steps.size == 0:
        raise ValueError(f"levels = {levels!r:.60}: must be a number of contours, or their values")
    symmetric = steps.size > 1 and bool(np.isclose(steps[0], -steps[-1], rtol=1e-9))
    return steps, colour_map("diverging") if symmetric else colour_map("sequential")


@styled
def section_map(
    values: xr.DataArray,
    *,
    a_H: Length | None = None,
    p_H: PeakPressure | None = None,
    units: Units = "auto",
    symbol: str | None = None,
    levels: int | Sequence[float] = 12,
    maximum: Extremum | None = None,
    aspect: Literal["equal", "auto"] | None = None,
    depth: DepthScale = "auto",
    colorbar: bool = True,
    width: Width | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Contours of a field on a section, depth downwards.

    Parameters
    ----------
    values : DataArray of dims (depth, x) or (depth, y)
        The field [Pa].
    a_H, p_H : float, optional
        Yardsticks of length [m] and stress [Pa] (default: those among the attributes of the field).
    units : "auto", "dimensionless" or "SI"
        Over the yardsticks (default where there are any), or in um and MPa.
    symbol : str, optional
        What the field is called (default: by its name).
    levels : int or sequence of float
        Number of contours, about, or their values in the unit of the figure.
    maximum : Extremum, optional
        A largest value to mark by a cross with its value beside it.
    aspect : "equal" or "auto", optional
        Whether lengths are the same in both directions (default: unless the depth is stretched or
        the section is much longer than deep).
    depth : "auto", "true" or "layers"
        Whether depths have one scale, or each layer a scale of its own (default: if one layer is
        too thin to be seen).
    colorbar : bool
        Whether to draw the scale beside the map.
    width : "column" or "page", optional
        Width of a new figure: a column of 85 mm or a page of 170 mm.
    ax : matplotlib Axes, optional
        Where to draw.
    """
    by = _scales(values.attrs, units, a_H, p_H)
    along = str(values.dims[1])
    x, z = values[along].values / by.length.value, values.z.values / by.length.value
    if ax is None:
        ax = new_axes(section_size(values))
    field = values.values / by.stress.value
    layer = values.layer.values
    inner = [z_i / by.length.value for z_i in interfaces(values.z, values.layer)]
    borders = np.array([z[0], *inner, z[-1]])
    stretch = draw_depth_axis(ax, borders, "y", by.length, depth=depth)
    steps, colours = contour_levels(field, levels)
    image = None
    for part in np.unique(layer):
        in_layer = layer == part
        if np.count_nonzero(in_layer) < 2:
            continue
        image = ax.contourf(x, z[in_layer], field[in_layer], levels=steps, cmap=colours)
        ax.contour(x, z[in_layer], field[in_layer], levels=steps, colors="0.2", linewidths=0.4)
        if colours is colour_map("diverging"):
            ax.contour(x, z[in_layer], field[in_layer], levels=[0.0], colors="0.1", linewidths=1.3)
    for border in inner:
        ax.axhline(border, color="0.2", linewidth=0.8, linestyle=(0, (6, 3)))
    ax.set_xlim(x[0], x[-1])
    if maximum is not None:
        _mark(ax, maximum, line_of(values), by)
    name = symbol if symbol is not None else SYMBOLS.get(str(values.name), str(values.name))
    if colorbar and image is not None:
        add_colour_bar(ax, image, by.stress.label(name))
    ax.set_xlabel(by.length.label(along))
    ax.set_ylim(z[-1], z[0])
    flat = x[-1] - x[0] > FLAT * (z[-1] - z[0])
    ax.set_aspect(aspect or ("auto" if stretch or flat else "equal"))
    ax.grid(visible=False)
    return ax


@styled
def stress_map(
    stress: Stress,
    *,
    a_H: Length | None = None,
    p_H: PeakPressure | None = None,
    units: Units = "auto",
    of: str = "von_mises",
    levels: int | Sequence[float] = 12,
    aspect: Literal["equal", "auto"] | None = None,
    depth: DepthScale = "auto",
    colorbar: bool = True,
    width: Width | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Contours of a measure of stress on a section; parameters as in :func:`section_map`.

    A cross marks the largest value, a circle the largest one on the surface if that is another.
    ``interface_shear`` and ``interface_peel`` are stresses on the interfaces: a curve for each.
    """
    if not isinstance(stress, Stress):
        raise TypeError(
            f"{type(stress).__name__}: must be the stress on a section, as result.at(-1).stress() "
            "gives it"
        )
    values = stress.measure(of).assign_attrs(stress.dataset.attrs)
    if of.startswith("interface"):
        return interface_curves(values, _scales(stress.dataset.attrs, units, a_H, p_H), ax)
    largest = stress.maximum(of)
    ax = section_map(
        values,
        a_H=a_H,
        p_H=p_H,
        units=units,
        levels=levels,
        maximum=largest,
        aspect=aspect,
        depth=depth,
        colorbar=colorbar,
        ax=ax,
    )
    if float(values.z[0]) == 0.0 < largest.z:
        by = _scales(stress.dataset.attrs, units, a_H, p_H)
        _mark(ax, stress.on_surface().maximum(of), line_of(values), by, marker="o")
    return ax


def interface_curves(values: xr.DataArray, by: Scales, ax: Axes | None) -> Axes:
    """Draw a stress on the interfaces along the section, a curve for each."""
    depths = interfaces(values.z, values.layer)
    if not depths:
        raise ValueError(f"{values.name}: this body has no coatings, and so no interface")
    ax = axes(ax)
    along = str(values.dims[1])
    for n, depth in enumerate(depths):
        above = np.flatnonzero(values.layer.values == values.layer.values[0] + n)[-1]
        below = "the substrate" if n + 1 == len(depths) else f"coating {n + 2}"
        label = f"coating {n + 1} on {below}, $z$ = {in_words(depth / by.length.value, 3)}"
        label += f" {by.length.name}" if by.length.is_unit else f" ${by.length.name}$"
        s = values[along].values / by.length.value
        ax.plot(s, values.values[above] / by.stress.value, label=label)
    ax.axhline(0.0, color="0.6", linewidth=0.8, zorder=0)
    ax.margins(x=0.0)
    ax.set_xlabel(by.length.label(along))
    ax.set_ylabel(by.stress.label(SYMBOLS[str(values.name)]))
    ax.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), borderpad=0.1)
    return ax


@styled
def stress_along_depth(
    stress: Stress,
    *,
    a_H: Length | None = None,
    p_H: PeakPressure | None = None,
    units: Units = "auto",
    of: tuple[str, ...] = ("s_xx", "s_yy", "s_zz", "von_mises"),
    depth: DepthScale = "auto",
    width: Width | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Measures of the stress below one point over the depth; parameters as in :func:`section_map`.

    Broken at interfaces, where s_xx and s_yy jump.
    """
    ax = axes(ax)
    by = _scales(stress.dataset.attrs, units, a_H, p_H)
    z, layer = stress.dataset.z.values / by.length.value, stress.dataset.layer.values
    if stress.dataset.s_xx.ndim != 1:
        raise ValueError("the line below one point is drawn: give stress(x=..., y=...)")
    inner = [d / by.length.value for d in interfaces(stress.dataset.z, stress.dataset.layer)]
    borders = np.array([z[0], *inner, z[-1]])
    draw_depth_axis(ax, borders, "x", by.length, depth=depth)
    for n, name in enumerate(of):
        values = stress.measure(name).values / by.stress.value
        for part in np.unique(layer):
            in_layer = layer == part
            label = f"${SYMBOLS.get(name, name)}$" if part == layer[0] else None
            # On an axis of symmetry two of the stresses are one line.
            dashes = (0, (3, 3)) if name == "s_yy" else "-"
            ax.plot(z[in_layer], values[in_layer], color=f"C{n}", linestyle=dashes, label=label)
    for border in inner:
        ax.axvline(border, color="0.6", linewidth=0.8, linestyle=(0, (6, 3)), zorder=0)
    ax.set_xlim(z[0], z[-1])
    ax.set_ylabel(by.stress.label(r"\sigma"))
    ax.legend()
    return ax


@styled
def envelope_maps(
    envelope: xr.Dataset,
    *,
    a_H: Length | None = None,
    p_H: PeakPressure | None = None,
    units: Units = "auto",
    of: str = "von_mises",
    cycle: int = -1,
    width: Width | None = None,
) -> Figure:
    """Largest value over the path, and amplitude and mean over a cycle, of a measure of stress."""
    must_hold(envelope, "envelope", [f"{of}_max"], ENVELOPE)
    name = SYMBOLS.get(of, of)
    shown = [(envelope[f"{of}_max"], rf"\max {name}")]
    cycles = envelope.sizes.get("cycle", 0)
    if cycles > 0:
        if not -cycles <= cycle < cycles:
            raise ValueError(f"cycle = {cycle}: must be {-cycles} to {cycles - 1}")
        shown.append((envelope[f"{of}_amplitude"].isel(cycle=cycle), rf"\Delta {name}/2"))
        shown.append((envelope[f"{of}_mean"].isel(cycle=cycle), rf"\overline{{{name}}}"))
    by = _scales(envelope.attrs, units, a_H, p_H)
    # One scale of colours for all.
    fields = np.concatenate([values.values.ravel() for values, _ in shown]) / by.stress.value
    levels = contour_levels(fields, 12)[0].tolist()
    _, high = section_size(shown[0][0], PANEL)
    figure, grid = new_panels(
        len(shown),
        size=(PANEL, max(high, 0.75 * PANEL)),
        across=(3, 3, 1),
        sharex=True,
        sharey=True,
    )
    panels = list(grid.flat[: len(shown)])
    for ax, letter, (values, symbol) in zip(panels, "abc", shown, strict=False):
        field = values.assign_attrs(envelope.attrs)
        scale = ax is panels[-1] or grid.shape[1] == 1
        section_map(
            field, a_H=a_H, p_H=p_H, units=units, symbol=name, levels=levels, colorbar=scale, ax=ax
        )
        ax.set_title(f"({letter})  ${symbol}$")
        ax.label_outer()
        ax.xaxis.set_major_locator(MaxNLocator(4))
    return figure


@styled
def stress_history(
    envelope: xr.Dataset,
    *,
    a_H: Length | None = None,
    p_H: PeakPressure | None = None,
    units: Units = "auto",
    of: str = "von_mises",
    width: Width | None = None,
    ax: Axes | None = None,
    **line: Any,
) -> Axes:
    """Largest value of a measure of stress on a section at every increment.

    The points are coloured by its depth.
    """
    must_hold(envelope, "envelope", [f"{of}_largest", f"{of}_largest_z"], ENVELOPE)
    ax = axes(ax)
    by = _scales(envelope.attrs, units, a_H, p_H)
    value = envelope[f"{of}_largest"] / by.stress.value
    z = envelope[f"{of}_largest_z"] / by.length.value
    ax.plot(value.increment, value, color="0.7", zorder=1, **line)
    # A depth that stays is one colour, its last digits are none.
    middle, half = (float(z.max()) + float(z.min())) / 2, (float(z.max()) - float(z.min())) / 2
    half = max(half, 0.05 * middle)
    points = ax.scatter(value.increment, value, c=z, s=9, cmap=colour_map("order"), zorder=2)
    points.set_clim(middle - half, middle + half)
    if half == 0.0:
        # All on the surface: no depth is below zero.
        points.set_clim(0.0, float(envelope.z.max()) / by.length.value)
    ax.xaxis.set_major_locator(MaxNLocator(integer=True, min_n_ticks=1))
    ax.set_xlim(float(value.increment[0]) - 0.5, float(value.increment[-1]) + 0.5)
    add_colour_bar(ax, points, by.length.label("z"))
    # Room above the largest value, and none below where it can't be negative.
    ax.margins(y=0.08)
    if float(value.min()) >= 0.0:
        ax.set_ylim(0.0, 1.08 * float(value.max()) or 1.0)
    ax.set_xlabel("increment")
    ax.set_ylabel(by.stress.label(rf"\max {SYMBOLS.get(of, of)}"))
    return ax


@styled
def stress_maps(
    results: Mapping[float, Run],
    *,
    depth: RelativeDepth = 2.0,
    layers: int = 256,
    of: str = "von_mises",
    width: Width | None = None,
) -> Figure:
    """Figure 13 of the paper: stress below the contact at the end of the path, for every ratio.

    On the section along the shear, through the centre of the contact.

    All panels share one scale of colours.

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
    width : "column" or "page", optional
        Width of a new figure: a column of 85 mm or a page of 170 mm.
    """
    below: dict[float, Stress] = {}
    for ratio, result in sorted(results.items()):
        z = np.union1d(np.linspace(0.0, depth * result.a_H, layers), result.scene.interfaces())
        last = result.at(-1)
        below[ratio] = stress_below(last, z, **main_line(last).named())
    fields = [stress.measure(of).values / results[ratio].p_H for ratio, stress in below.items()]
    # One scale of colours for all.
    levels = MaxNLocator(12).tick_values(
        min(float(np.nanmin(field)) for field in fields),
        max(float(np.nanmax(field)) for field in fields),
    )
    figure, grid = new_panels(
        len(below), size=(2.7, 3.0), across=(len(below), 3, 1), sharex=True, sharey=True
    )
    panels = list(grid.flat[: len(below)])
    for ax, letter, (ratio, stress) in zip(panels, "abcdef", below.items(), strict=False):
        scale = ax is panels[-1] or grid.shape[1] == 1
        stress_map(stress, of=of, levels=levels, colorbar=scale, ax=ax)
        ax.set_title(rf"({letter})  $E_1/E_2 = {ratio:g}$")
        ax.xaxis.set_major_locator(MaxNLocator(4))
        ax.label_outer()
        # Below the section, of which it would cover a third.
        ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.22), borderpad=0.1)
    return figure
