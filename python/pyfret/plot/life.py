"""Figures of fatigue: where it cracks, on which plane, how near to the limit."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.projections.polar import PolarAxes
from matplotlib.ticker import FuncFormatter, MaxNLocator

from pyfret import _core, fatigue
from pyfret._core import with_error, with_range
from pyfret._util.arrays import histories
from pyfret._util.depths import interfaces
from pyfret._util.material_names import as_material
from pyfret._util.numbers import in_letters, in_powers, layer_name
from pyfret._util.theme import MARK, REFERENCE, STICK, colour_map
from pyfret.plot.depth_axis import DepthScale, draw_depth_axis
from pyfret.plot.scales import scales
from pyfret.plot.sizes import Width, new_axes
from pyfret.plot.stresses import FLAT, section_size
from pyfret.plot.style import add_colour_bar, axes, inside_legend, mark, note, styled
from pyfret.quantities import Numbers
from pyfret.subsurface.line import line_of

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.contour import ContourSet
    from numpy.typing import ArrayLike, NDArray

    from pyfret._core import Material
    from pyfret.fatigue.factors import Factor, LoadFactors
    from pyfret.fatigue.judged import Life
    from pyfret.plot.scales import Units
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
    material stay empty.

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
    _mark(ax, at, f"worst point: {margin}", shown, units, lives=not safety)
    return ax


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


def history_of(stress: ArrayLike | Life) -> tuple[NDArray[np.float64], fatigue.Criterion | None]:
    """Return the stress history of a point, shape (time, 6) [Pa], and the criterion of a life."""
    if isinstance(stress, fatigue.Life):
        return stress.history(), stress.criterion
    history = histories(stress, "stress").whole()
    if history.size != 6 * len(history):
        raise ValueError(f"stress has the shape {history.shape}: must be (time, 6), of one point")
    return history.reshape(-1, 6), None


@styled
def critical_plane_rose(
    stress: ArrayLike | Life,
    criterion: fatigue.Criterion | None = None,
    *,
    plastic_strain: Numbers | None = None,
    width: Width | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Draw the stresses on the planes through one point whose normal lies in the x-z plane.

    The angle goes from x to the normal, towards z, downwards as in a section. Curves are the
    largest tension and half of the range of the shear within the x-z plane. A bar is the normal of
    the critical plane. For sections at y = 0 of contacts that are symmetric there, that is all
    shear there is on these planes.

    Parameters
    ----------
    stress : array of shape (time, 6), or Life
        Stress history of the point [Pa]; for a life of its worst point.
    criterion : Criterion, optional
        One that has a critical plane (default: the life's own).
    plastic_strain : array of the shape of the stress, optional
        Plastic strain at the same instants (default: the life's own).
    width : "column" or "page", optional
        Width of a new figure: a column of 85 mm or a page of 170 mm.
    """
    life_or_stress = stress
    stress, own_criterion = history_of(stress)
    criterion = own_criterion if criterion is None else criterion
    if criterion is None:
        raise TypeError("criterion: must be given with a history, such as Criterion.findley(k=0.3)")
    if not criterion.has_plane:
        raise ValueError(f"{criterion.name} has no critical plane")
    if isinstance(life_or_stress, fatigue.Life):
        plastic_strain, life_or_stress = life_or_stress.history("plastic_strain"), stress
    criterion_values = fatigue.evaluate_criterion(
        life_or_stress, criterion, plastic_strain=plastic_strain
    )
    normal = criterion_values.normal.values.reshape(3)
    angle = np.radians(np.arange(0.0, 360.5, 1.0))
    c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
    xx, zz, xz = stress[:, 0], stress[:, 2], stress[:, 4]
    s_n = np.maximum((c * c * xx + s * s * zz + 2 * s * c * xz).max(axis=1), 0.0) / 1e6
    shear = s * c * (zz - xx) + (c * c - s * s) * xz
    tau = (shear.max(axis=1) - shear.min(axis=1)) / 2e6
    if ax is None:
        ax = new_axes((4.4, 4.4), projection="polar")
    if not isinstance(ax, PolarAxes):
        raise TypeError('ax: must be polar axes, as figure.add_subplot(projection="polar") gives')
    ax.set_theta_direction(-1)
    ax.plot(angle, s_n, color="C0", label=r"$\sigma_\mathrm{n,max}$ [MPa]")
    ax.plot(angle, tau, color="C2", label=r"$\tau_\mathrm{a}$ [MPa]")
    reach = 1.05 * max(s_n.max(), tau.max())
    # Of a normal and its opposite, the one within a right angle of x.
    at = float(np.arctan2(normal[2], normal[0]))
    at = (at + np.pi / 2) % np.pi - np.pi / 2
    share = np.hypot(normal[0], normal[2])
    label = f"critical normal, {np.degrees(at):.1f}° from $x$"
    ax.plot(
        [at, at + np.pi],
        [share * reach] * 2,
        color=MARK,
        linewidth=1.6,
        label=label,
    )
    ax.set_rmax(reach)
    # The numbers of the radius where the curves are nearest to the middle.
    outer = np.maximum(s_n, tau) + np.where(np.abs(np.sin(angle - at)) < 0.2, reach, 0.0)
    free = float(np.degrees(angle[int(outer.argmin())]))
    ax.set_rlabel_position(free)
    ax.set_xticks(np.radians([0, 45, 90, 135, 180, 225, 270, 315]))
    ax.set_xticklabels(["x", "45°", "z", "135°", "-x", "225°", "-z", "315°"])
    ax.set_title(NAMES[criterion.name])
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.06), ncols=2)
    return ax


@styled
def dang_van_diagram(
    stress: ArrayLike | Life,
    *,
    material: Material | str | None = None,
    width: Width | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Path of one point in Dang Van's plane: mesoscopic shear over hydrostatic stress.

    A material that has ``s_D`` and ``t_D`` adds the limit tau = t_D - alpha p_h. A cross marks the
    instant nearest to it or farthest beyond. By default it is the material of a life at
    its worst point. `stress` has the shape (time, 6) [Pa]; of a life it is the history at its
    worst point.
    """
    if material is None and isinstance(stress, fatigue.Life):
        layer_material = stress._material_of(stress.worst.layer)
        material = layer_material if has_numbers(layer_material, "t_D", "s_D") else None
    stress, _ = history_of(stress)
    ax = axes(ax)
    tau, p_h = (v / 1e6 for v in fatigue.dang_van_path(stress))
    ax.plot(np.r_[p_h, p_h[0]], np.r_[tau, tau[0]], color="C0", marker=".", markersize=3)
    if material is not None:
        t_D, s_D = (as_material(material).number(name) / 1e6 for name in ("t_D", "s_D"))
        alpha = 3.0 * t_D / s_D - 1.5
        low = min(p_h.min(), 0.0)
        ends = np.array([low, t_D / alpha]) if alpha > 0.0 else np.array([low, p_h.max()])
        ax.plot(ends, t_D - alpha * ends, color="0.2", linestyle="--", label="limit")
        worst = int(np.argmax(tau + alpha * p_h))
        factor = t_D / (tau[worst] + alpha * p_h[worst])
        label = f"nearest to the limit: safety factor {factor:.3g}" if factor > 0.0 else "no limit"
        ax.plot(p_h[worst], tau[worst], "x", color=MARK, ms=7, mew=1.6, label=label)
        ax.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), borderpad=0.1)
    ax.set_xlabel(r"hydrostatic stress $p_\mathrm{h}$ [MPa]")
    ax.set_ylabel(r"mesoscopic shear $\tau$ [MPa]")
    ax.set_ylim(bottom=0.0)
    return ax


@styled
def haigh_diagram(
    life: Life,
    *,
    material: Material | str | None = None,
    width: Width | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Amplitude over mean of the normal stress on the critical planes of all points of a section.

    A cross marks the worst point of every layer. The dashed line is the limit of uniaxial stress of
    the material, by default the one of the worst layer. Where there is ``s_u``, it goes from
    ``s_D`` fully reversed to ``s_u`` without amplitude (Goodman 1899). Else it follows from Dang
    Van's criterion, s_D - (1 - s_D/(2 t_D)) times the mean.

    The limit is meant for planes of the largest normal stress, as found by
    ``"smith_watson_topper"``. Planes of shear have less normal stress at the same danger.

    Parameters
    ----------
    life : Life
        From :meth:`Result.life`, of a criterion that has critical planes.
    material : Material, optional
        With ``s_D``, and ``s_u`` or ``t_D`` (default: the material of the worst layer, if it has
        these numbers).
    width : "column" or "page", optional
        Width of a new figure: a column of 85 mm or a page of 170 mm.
    ax : matplotlib Axes, optional
        Where to draw.
    """
    d = life.dataset
    criterion = d.attrs["criterion"]
    if not np.isfinite(d.normal).any():
        raise ValueError(f"{criterion} has no critical plane")
    ax = axes(ax)
    for layer in life.layers:
        in_layer = d.layer.values == layer
        mean, amplitude = (d[f"normal_{k}"].values[in_layer] / 1e6 for k in ("mean", "amplitude"))
        colour = f"C{layer}"
        ax.plot(mean.ravel(), amplitude.ravel(), ".", ms=2.5, color=colour, alpha=0.35)
        n = int(np.nanargmax(d.value.values[in_layer]))
        name = layer_name(layer, len(d.attrs["interfaces"]))
        at = (mean.ravel()[n], amplitude.ravel()[n])
        ax.plot(*at, "x", color=colour, ms=8, mew=1.8, label=f"worst point, {name}")
    if material is None:
        layer_material = life._material_of(life.worst.layer)
        pairs = (("s_D", "t_D"), ("s_D", "s_u"))
        if any(has_numbers(layer_material, *pair) for pair in pairs):
            material = layer_material
    if material is not None:
        _limit_of_uniaxial_stress(ax, as_material(material))
    ax.set_ylim(bottom=0.0)
    ax.set_xlabel(r"mean normal stress $\sigma_\mathrm{n,m}$ [MPa]")
    ax.set_ylabel(r"amplitude $\sigma_\mathrm{n,a}$ [MPa]")
    points = Line2D([], [], linestyle="none", marker=".", color="0.4")
    points.set_label(f"points, planes of {NAMES[criterion]}")
    handles = [points, *ax.get_legend_handles_labels()[0]]
    # Outside: inside it would look like points.
    ax.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.0, 1.0), borderpad=0.1)
    return ax


def has_numbers(material: Material | None, *names: str) -> bool:
    """Check that a material has numbers of these names."""
    return material is not None and set(names) <= {name for name, _, _ in material.numbers()}


def _limit_of_uniaxial_stress(ax: Axes, material: Material) -> None:
    """Draw the amplitude that a mean stress leaves, where there are points."""
    slope, name = fatigue.mean_stress_slope(material)
    s_D = material.number("s_D") / 1e6
    x_min, right = ax.get_xlim()
    top = ax.get_ylim()[1]
    ends = np.array([min(x_min, 0.0), s_D / slope if slope > 0.0 else max(right, s_D)])
    ax.plot(ends, s_D - slope * ends, color="0.2", linestyle="--", label=f"limit, {name}")
    ax.set_xlim(x_min, max(right, 0.2 * s_D))
    ax.set_ylim(top=max(top, 1.1 * s_D))


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
