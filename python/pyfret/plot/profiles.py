"""Tractions along the shear, through the centre of the contact."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable

from pyfret._util.theme import REFERENCE, colour_map
from pyfret.plot.along import look_along
from pyfret.plot.histories import NAMES, driven
from pyfret.plot.scales import Units, last_of, run_of, scales_of_snapshot
from pyfret.plot.sizes import Width
from pyfret.plot.style import axes, styled
from pyfret.subsurface.line import fields_on, main_line, main_shear
from pyfret.subsurface.moments import lines_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from pyfret.run import Run, State
    from pyfret.subsurface.line import Line


@styled
def pressure_profile(
    shown: State | Run,
    *,
    units: Units = "auto",
    width: Width | None = None,
    ax: Axes | None = None,
    **line: Any,
) -> Axes:
    """Pressure along the shear, over p_H and a_H or in MPa and um.

    On the line through the centre of the contact, as :meth:`Snapshot.along` gives it.

    Parameters
    ----------
    shown : Snapshot or Result
        The contact; of a result the last increment that it has kept.
    units : "auto", "dimensionless" or "SI"
        Dimensionless (default where there is a Hertz contact) or SI.
    width : "column" or "page", optional
        Width of a new figure: a column of 85 mm or a page of 170 mm.
    ax : matplotlib Axes, optional
        Where to draw.
    **line
        Passed on to ``plot``.
    """
    snapshot = last_of(shown)
    ax, by = axes(ax), scales_of_snapshot(snapshot, units)
    along, fresh = main_line(snapshot), not ax.lines
    cut = fields_on(snapshot, along)
    ax.plot(cut[along.axis] / by.length.value, cut.p / by.stress.value, **line)
    look_along(ax, snapshot, by.length, along, fresh=fresh)
    ax.set_xlabel(by.length.label(along.axis))
    ax.set_ylabel(by.stress.label("p"))
    return ax


@styled
def shear_profile(
    shown: State | Run,
    *,
    of: Literal["q_x", "q_y", "q_s", "q_t"] | None = None,
    bound: bool = False,
    units: Units = "auto",
    width: Width | None = None,
    ax: Axes | None = None,
    **line: Any,
) -> Axes:
    r"""Shear along its direction, :math:`q_x/(\mu p_H)` over :math:`x/a_H`, or in MPa over um.

    On the line through the centre of the contact, as :meth:`Snapshot.along` gives it.

    Parameters
    ----------
    shown, units, width, ax, **line
        As in :func:`pressure_profile`.
    of : "q_x", "q_y", "q_s" or "q_t", optional
        Which component (default: the larger one on the line, as q_y in torsion); q_s and q_t on an
        oblique line alone.
    bound : bool
        Whether to draw the bounds of friction, plus and minus mu p, in grey.
    """
    snapshot = last_of(shown)
    return _shear_on(main_line(snapshot), snapshot, of, units, ax, bound=bound, **line)


def _shear_on(
    along: Line,
    snapshot: State,
    of: str | None,
    units: Units,
    ax: Axes | None,
    *,
    bound: bool = False,
    **line: Any,
) -> Axes:
    """Draw the shear of an increment on a line."""
    ax, by = axes(ax), scales_of_snapshot(snapshot, units)
    cut, fresh = fields_on(snapshot, along), not ax.lines
    name = of or main_shear(cut)
    if name not in cut:
        components = ", ".join(str(k) for k in cut if str(k).startswith("q_"))
        raise ValueError(f"of = {name!r}: must be one of {components} on this line")
    s = cut[along.axis] / by.length.value
    ax.plot(s, cut[name] / by.shear.value, **line)
    if bound and np.isfinite(snapshot.mu):
        for sign in (1, -1):
            bound_line = sign * snapshot.mu * cut.p / by.shear.value
            ax.plot(s, bound_line, color=REFERENCE, linestyle=":", linewidth=1.0)
    look_along(ax, snapshot, by.length, along, fresh=fresh)
    ax.set_xlabel(by.length.label(along.axis))
    ax.set_ylabel(by.shear.label(name))
    return ax


@styled
def shear_profiles(
    result: Run, *, units: Units = "auto", width: Width | None = None, ax: Axes | None = None
) -> Axes:
    """Shear traction along its direction for every increment whose fields were kept.

    On the line through the centre of the largest contact, along the shear of all increments.
    More than twelve load states have a scale of colours for the time, no legend.

    A load state that was visited before is drawn as markers in the colour of its first visit.
    Markers on a line show that the cycle has settled.
    """
    run = run_of(result)
    kept = run.dataset.saved_increment.values
    along = lines_of(run, kept, 2)[0]
    ax = axes(ax)
    name = main_shear(fields_on(run.at(-1), along))
    tau = float(result.dataset.t[-1])
    visits = load_states(result)
    states = 1 + max(state for state, _ in visits)
    colours = colour_map("order")(np.linspace(0.0, 1.0, states))
    few = len(visits) <= NAMED
    times = result.dataset.saved_t.values
    for number, t, (state, visit) in zip(kept, times, visits, strict=True):
        line: dict[str, Any] = {"color": colours[state], "label": f"{round(float(t / tau), 3)}"}
        if not few:
            line |= {"color": colour_map("order")(t / tau), "linewidth": 0.7}
        elif visit > 0:
            n = result.dataset.sizes["x"]
            every = max(1, n // 28)
            line |= {
                "linewidth": 0.5,
                "marker": MARKERS[(visit - 1) % len(MARKERS)],
                "markerfacecolor": "none",
                "markeredgewidth": 0.8,
                "markevery": (((visit - 1) * every // 2) % every, every),
            }
        _shear_on(along, result.at(int(number)), name, units, ax, **line)
    if few:
        anchor = (1.0, 0.5)
        ax.legend(title=r"$t/\tau$", loc="center left", bbox_to_anchor=anchor, alignment="left")
    else:
        bar = plt.colorbar(ScalarMappable(cmap=colour_map("order")), ax=ax, pad=0.02)
        bar.set_label(r"$t/\tau$")
        bar.outline.set_visible(False)
    return ax


#: Most lines that a legend names.
NAMED = 12
#: Markers of the second, third, ... visit of a load state.
MARKERS = ("o", "x", "s", "^")


def load_states(result: Run) -> list[tuple[int, int]]:
    """Number the load states of the kept increments and count the visits of each.

    Two increments share a state if their loads or motions agree to 1e-6 of the largest one and were
    reached in the same direction.
    """
    d = result.dataset
    branches = result.scene.path.branches
    load, motion, _, _ = NAMES[driven(result.scene.path)]
    normal = "delta_z" if any(branch.delta_z for branch in branches) else "W"
    force = motion if any(getattr(branch, motion) for branch in branches) else load
    scales = {name: 1e-6 * float(abs(d[name]).max()) or 1.0 for name in (normal, force)}
    seen: list[tuple[float, ...]] = []
    counts: list[int] = []
    visits = []
    for increment in d.saved_increment.values:
        i = int(increment) - 1
        before = max(i - 1, 0)
        row = d.isel(increment=i)
        rise = float(row[force] - d[force][before])
        loads = (round(float(row[name]) / scale) for name, scale in scales.items())
        state = (*loads, np.sign(rise))
        if state not in seen:
            seen.append(state)
            counts.append(-1)
        number = seen.index(state)
        counts[number] += 1
        visits.append((number, counts[number]))
    return visits
