"""Tractions along the line y = 0."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib import colormaps

from pyfret.plot.style import axes, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from pyfret.results import Result, Snapshot


@styled
def pressure_profile(snapshot: Snapshot, *, ax: Axes | None = None, **line: Any) -> Axes:
    """Pressure over the Hertz peak pressure along y = 0."""
    ax = axes(ax)
    cut = snapshot.along_x()
    ax.plot(cut.x / snapshot.a_H, cut.p / snapshot.p_H, **line)
    ax.set_xlabel(r"$x_1/a_H$")
    ax.set_ylabel(r"$p/p_H$")
    return ax


@styled
def shear_profile(snapshot: Snapshot, *, ax: Axes | None = None, **line: Any) -> Axes:
    r"""Shear traction :math:`q_1/(\mu p_H)` along y = 0."""
    ax = axes(ax)
    cut = snapshot.along_x()
    ax.plot(cut.x / snapshot.a_H, cut.q_x / (snapshot.mu * snapshot.p_H), **line)
    ax.set_xlabel(r"$x_1/a_H$")
    ax.set_ylabel(r"$q_1/(\mu\, p_H)$")
    return ax


@styled
def shear_profiles(result: Result, *, ax: Axes | None = None) -> Axes:
    """Shear traction along y = 0 for every increment whose fields were kept.

    A load state that was visited before is drawn as markers in the colour of its first visit:
    markers on a line show that the cycle has settled.
    """
    ax = axes(ax)
    tau = float(result.dataset.t[-1])
    visits = load_states(result)
    colours = colormaps["viridis"](np.linspace(0.0, 0.88, 1 + max(state for state, _ in visits)))
    for t, (state, visit) in zip(result.dataset.saved_t.values, visits, strict=True):
        line: dict[str, Any] = {"color": colours[state], "label": f"{round(float(t / tau), 3)}"}
        if visit > 0:
            n = result.dataset.sizes["x"]
            every = max(1, n // 28)
            line |= {
                "linewidth": 0.5,
                "marker": MARKERS[(visit - 1) % len(MARKERS)],
                "markerfacecolor": "none",
                "markeredgewidth": 0.8,
                "markevery": (((visit - 1) * every // 2) % every, every),
            }
        shear_profile(result.at(float(t)), ax=ax, **line)
    ax.legend(title=r"$t/\tau$", loc="center left", bbox_to_anchor=(1.0, 0.5), alignment="left")
    return ax


#: Markers of the second, third, ... visit of a load state.
MARKERS = ("o", "x", "s", "^")


def load_states(result: Result) -> list[tuple[int, int]]:
    """Number the load states of the kept increments and count the visits of each.

    Two increments share a state if they have the same forces, reached in the same direction, to
    1e-6 of the largest force.
    """
    d = result.dataset
    scale = 1e-6 * result.W_max
    seen: list[tuple[float, ...]] = []
    counts: list[int] = []
    visits = []
    for increment in d.saved_increment.values:
        i = int(increment) - 1
        before = max(i - 1, 0)
        here = d.isel(increment=i)
        rise = float(here.T_x - d.T_x[before])
        state = (round(float(here.W) / scale), round(float(here.T_x) / scale), np.sign(rise))
        if state not in seen:
            seen.append(state)
            counts.append(-1)
        number = seen.index(state)
        counts[number] += 1
        visits.append((number, counts[number]))
    return visits
