"""Figures of critical planes: the shear on all planes, and a history against a limit."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.projections.polar import PolarAxes

from pyfret import fatigue
from pyfret._util.arrays import histories
from pyfret._util.material_names import as_material
from pyfret._util.numbers import layer_name
from pyfret._util.theme import MARK
from pyfret.plot.life import NAMES
from pyfret.plot.sizes import Width, new_axes
from pyfret.plot.style import axes, styled
from pyfret.quantities import Numbers

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import ArrayLike, NDArray

    from pyfret._core import Material
    from pyfret.fatigue.judged import Life


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
