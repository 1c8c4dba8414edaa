"""Scalars along the load path."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from matplotlib.ticker import EngFormatter, MaxNLocator

from pyfret._core import LoadPath
from pyfret.plot.scales import MICRO, Scale, Units, has_friction_scale, run_of, scales
from pyfret.plot.sizes import Width
from pyfret.plot.style import axes, note, styled
from pyfret.quantities import FrictionCoefficient, quantities

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from pyfret.run import Run, State

Direction = Literal["x", "y", "torsion"]

#: Load and motion of each direction, with their symbols.
NAMES = {
    "x": ("T_x", "delta_x", "T_x", r"\delta_x"),
    "y": ("T_y", "delta_y", "T_y", r"\delta_y"),
    "torsion": ("M_z", "phi_z", "M_z", r"\varphi_z"),
}


def driven(path: LoadPath) -> Direction:
    """Return the direction that a path drives first; x if it drives none."""
    directions: tuple[Direction, ...] = ("x", "y", "torsion")
    for branch in path.branches:
        for direction in directions:
            if any(getattr(branch, name) for name in NAMES[direction][:2]):
                return direction
    return "x"


#: Increments of a branch below which each one has a dot: a line alone would hide how few there are.
FEW = 20


def increment_marks(result: Run) -> dict[str, Any]:
    """Return the options of a line with a dot for each increment, where a branch has few."""
    branches = result.dataset.branch_of_increment.values
    _, counts = np.unique(branches, return_counts=True)
    few = counts.size > 0 and np.median(counts) < FEW
    return {"marker": "o", "markersize": 2.5} if few else {}


def reversals(result: Run, direction: Direction) -> NDArray[np.intp]:
    """Return the increments, from 0, after which force and shift turn round under constant W.

    All of the contact sticks at that moment.
    """
    d = result.dataset
    force, shift = (d[name].values for name in NAMES[direction][:2])
    W = d.W.values
    if W.size < 3:
        return np.zeros(0, dtype=np.intp)
    turned = (np.diff(force)[:-1] * np.diff(force)[1:] < 0.0) | (
        np.diff(shift)[:-1] * np.diff(shift)[1:] < 0.0
    )
    same = np.isclose(W[2:], W[1:-1]) & np.isclose(W[1:-1], W[:-2])
    return np.flatnonzero(turned & same) + 1


@styled
def fretting_loop(
    result: Run,
    *,
    direction: Direction | None = None,
    units: Units = "auto",
    width: Width | None = None,
    ax: Axes | None = None,
    **line: Any,
) -> Axes:
    r"""Tangential force over relative shift; in torsion the moment over the rotation.

    The shift is counted from the end of the first branch, the indentation. Dimensionless are
    :math:`T_x/(\mu W_{max})` and :math:`\delta_x/(\mu \delta_H)` with the Hertz approach
    :math:`\delta_H`, in torsion :math:`M_z/(\mu W_{max} a_H)` and
    :math:`\varphi_z a_H/(\mu \delta_H)`. The area of the loop is the work dissipated in a cycle.

    Parameters
    ----------
    result : Result
        The run.
    direction : "x", "y" or "torsion", optional
        The motion (default: the first that the path drives).
    units : "auto", "dimensionless" or "SI"
        Dimensionless (default where there is a Hertz contact) or in N and um; line contacts, whose
        approach is no yardstick, in N/m and um.
    width : "column" or "page", optional
        Width of a new figure: a column of 85 mm or a page of 170 mm.
    ax : matplotlib Axes, optional
        Where to draw.
    **line
        Passed on to ``plot``.
    """
    d = run_of(result).dataset
    ax = axes(ax)
    direction = direction or driven(result.scene.path)
    if direction not in NAMES:
        raise ValueError(f'direction = {direction!r}: must be "x", "y" or "torsion"')
    force, shift, force_symbol, shift_symbol = NAMES[direction]
    started = np.flatnonzero(d.branch_of_increment.values == 0)[-1]
    by_force, by_shift = loop_scales(result, units, torsion=force == "M_z")
    moved = (d[shift] - d[shift][started]) / by_shift.value
    line = {**increment_marks(result), **line}
    ax.plot(moved[started:], d[force][started:] / by_force.value, **line)
    if started + 1 == d.sizes["increment"]:
        note(ax, "the path ends with the indentation")
    # Few enough ticks for labels of five signs.
    ax.xaxis.set_major_locator(MaxNLocator(5))
    ax.set_xlabel(by_shift.label(shift_symbol))
    ax.set_ylabel(by_force.label(force_symbol))
    return ax


def loop_point(result: Run, at: State) -> tuple[list[float], list[float]]:
    """Return the point of an increment on the loop of :func:`fretting_loop`."""
    force, shift, *_ = NAMES[driven(result.scene.path)]
    d = result.dataset
    started = np.flatnonzero(d.branch_of_increment.values == 0)[-1]
    by_force, by_shift = loop_scales(result, "auto", torsion=force == "M_z")
    moved = (float(at.dataset[shift]) - float(d[shift][started])) / by_shift.value
    return [moved], [float(at.dataset[force]) / by_force.value]


def loop_scales(result: Run, units: Units, *, torsion: bool) -> tuple[Scale, Scale]:
    """Return the scales of the force, or moment, and of the shift, or rotation."""
    W, mu = result.W_max, result.mu
    force = str(result.dataset["M_z" if torsion else "T_x"].attrs["units"])
    # The approach of a line contact, the yardstick of shifts, depends on where it is read.
    flat = result.scene.grid.plane_strain
    if flat and units == "dimensionless":
        raise ValueError('units = "dimensionless": a line contact has no approach; give "SI"')
    dimensionless = scales(result.dataset.attrs, units).dimensionless and not flat
    if not (dimensionless and has_friction_scale(mu) and W > 0.0):
        shift = Scale(1e-6, "µrad", is_unit=True) if torsion else MICRO
        return Scale(1.0, force, is_unit=True), shift
    approach, a = mu * result.delta_H, result.a_H
    if torsion:
        return (
            Scale(mu * W * a, r"(\mu\, W_\mathrm{max}\, a_H)", is_unit=False),
            Scale(approach / a, r"(\mu\, \delta_H/a_H)", is_unit=False),
        )
    return (
        Scale(mu * W, r"(\mu\, W_\mathrm{max})", is_unit=False),
        Scale(approach, r"(\mu\, \delta_H)", is_unit=False),
    )


@styled
def stick_ratio(
    result: Run, *, width: Width | None = None, ax: Axes | None = None, **line: Any
) -> Axes:
    r"""Stick area over contact area along the load path, over :math:`t/\tau`.

    At a reversal under constant W the ratio steps up to 1. Branches of few increments have a dot
    for each of them.
    """
    t = run_of(result).dataset.t.values / float(result.dataset.t[-1])
    ratio = np.asarray(result.stick_ratio)
    ax = axes(ax)
    # At a reversal the whole contact sticks: a vertical step up to 1, between two increments.
    turned = reversals(result, driven(result.scene.path)) + 1
    marked = {**increment_marks(result), **line}
    if "marker" in marked:
        marked["markevery"] = [n + np.count_nonzero(turned <= n) for n in range(t.size)]
    ax.plot(np.insert(t, turned, t[turned - 1]), np.insert(ratio, turned, 1.0), **marked)
    ax.set_xlabel(r"$t/\tau$")
    ax.set_ylabel(r"$A_\mathrm{st}/A_\mathrm{c}$")
    ax.set_xlim(0, 1)
    ax.set_ylim(0, 1.03)
    return ax


#: What a path may drive: symbol, yardstick of its own kind, unit.
DRIVEN = {
    "W": ("W", "N"),
    "T_x": ("T_x", "N"),
    "T_y": ("T_y", "N"),
    "M_x": ("M_x", "N m"),
    "M_y": ("M_y", "N m"),
    "M_z": ("M_z", "N m"),
    "delta_z": (r"\delta_z", "m"),
    "delta_x": (r"\delta_x", "m"),
    "delta_y": (r"\delta_y", "m"),
    "phi_x": (r"\varphi_x", "rad"),
    "phi_y": (r"\varphi_y", "rad"),
    "phi_z": (r"\varphi_z", "rad"),
    "sigma_B": (r"\sigma_B", "Pa"),
    "sigma_B1": (r"\sigma_{B1}", "Pa"),
    "rolled": (r"x_\mathrm{rolled}", "m"),
}


@styled
@quantities
def load_path(
    path: LoadPath | Run,
    *,
    mu: FrictionCoefficient | None = None,
    width: Width | None = None,
    ax: Axes | None = None,
) -> Axes:
    r"""Loads and motions that a path drives over :math:`t/\tau`, the end of which is 1.

    Normal forces are over their largest value W, tangential ones over W, or over `mu` W where that
    is given. Everything else is over its own largest value, which the legend gives. Of a result
    every increment is drawn, of a path the ends of its branches.
    """
    ax = axes(ax)
    t, columns = histories(path)
    path_mu = getattr(path, "mu", mu)
    # Without friction the normal force itself is the yardstick.
    mu, times = (1.0, "") if path_mu is None else (path_mu, r"\mu\, ")
    W_max = np.nanmax(np.abs(columns["W"])) if "W" in columns else 0.0
    for name, values in columns.items():
        symbol, unit = DRIVEN[name]
        force = unit == "N"
        if not isinstance(path, LoadPath):
            unit = str(path.dataset[name].attrs["units"])
        largest = float(np.nanmax(np.abs(values)))
        if name == "W":
            label = r"$W/W_\mathrm{max}$"
        elif force and W_max > 0.0 and has_friction_scale(mu):
            largest, label = mu * W_max, rf"${symbol}/({times}W_\mathrm{{max}})$"
            label = label if times else rf"${symbol}/W_\mathrm{{max}}$"
        else:
            label = f"${symbol}$ / {EngFormatter(unit)(float(f'{largest:.3g}'))}"
        marks = {} if isinstance(path, LoadPath) else increment_marks(path)
        ax.plot(t / t[-1], values / largest, label=label, **marks)
    ax.set_xlabel(r"$t/\tau$")
    ax.set_xlim(0, 1)
    if columns:
        # The curves of a path leave no corner free.
        ax.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=3, borderpad=0.1)
    return ax


def histories(
    path: LoadPath | Run,
) -> tuple[NDArray[np.float64], dict[str, NDArray[np.float64]]]:
    """Return path time and the loads and motions that the path drives, from the unloaded state."""
    branches = path.branches if isinstance(path, LoadPath) else path.scene.path.branches
    names = [name for name in DRIVEN if any(getattr(b, name) for b in branches)]
    if isinstance(path, LoadPath):
        values = {name: [getattr(b, name) for b in branches] for name in names}
        columns = {
            name: np.array([np.nan if v is None else v for v in values], dtype=float)
            for name, values in values.items()
        }
        t = np.array([b.t for b in branches])
    else:
        columns = {name: path.dataset[name].values for name in names}
        t = path.dataset.t.values
    return np.r_[0.0, t], {name: np.r_[0.0, values] for name, values in columns.items()}


@styled
def loop_evolution(
    result: Run, *, width: Width | None = None, ax: Axes | None = None, **line: Any
) -> Axes:
    """Energy ratio, sliding ratio and dissipated energy of each cycle, the last over its mean.

    Of the first motion that the path drives: along x, along y or in torsion. Of a single cycle the
    ratios alone.
    """
    ax = axes(ax)
    loops = result.loops(direction=driven(result.scene.path))
    number = np.arange(1, loops.sizes["cycle"] + 1)
    line = {"marker": "o", "markersize": 4, **line}
    shown = [(loops.energy_ratio, "energy ratio"), (loops.sliding_ratio, "sliding ratio")]
    if number.size > 1:
        mean = float(loops.dissipated.mean())
        shown.append((loops.dissipated / (mean or 1.0), "dissipated energy over its mean"))
    for values, label in shown:
        # A ratio that no cycle has is no curve.
        if np.isfinite(values).any():
            ax.plot(number, values, label=label, **line)
    ax.set_xlabel("cycle")
    ax.set_xticks(number)
    # With room for a whole point at the largest value.
    ax.set_ylim(0.0, 1.08 * ax.dataLim.y1 if number.size and ax.dataLim.y1 > 0.0 else None)
    if number.size:
        ax.legend()
    else:
        note(ax, "the path closes no cycle")
    return ax
