"""The answer to a change: numbers and figures of a contact, as a preview or in full."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._core import NoConvergenceError, OffGridError, with_error
from pyfret._util.extras import needed
from pyfret._util.scene_warnings import SceneWarning
from pyfret.run.loops import NO_FRICTION, frictionless
from pyfret.run.summary import directions
from pyfret.solution import solve
from pyfret.study.comparison import layer_names
from pyfret.subsurface.line import fields_on, line_of, main_line, main_shear
from pyfret.what_if.controls import in_increments

if TYPE_CHECKING:
    from pyfret._core import Scene
    from pyfret.result import Result

__all__ = ["FEWER", "PageAnswer", "answer"]

#: A preview has the increments of the neighbouring scene over this, a least number in a branch.
FEWER, LEAST = 3, 4
#: Force and motion of a loop by what drives it.
LOOPS = {"x": ("T_x", "delta_x"), "y": ("T_y", "delta_y"), "torsion": ("M_z", "phi_z")}
#: Colours of the zones: none, slip, stick.
ZONES = [[0.0, "#ffffff"], [0.5, "#F2C9A9"], [1.0, "#0072B2"]]


@dataclass(frozen=True)
class PageAnswer:
    """The answer of a contact."""

    #: Numbers as the page shows them, by their names.
    numbers: dict[str, str]
    #: The largest von Mises stress [Pa], as the page shows it.
    largest: float
    #: The first doubt that applies, or nothing.
    doubt: str
    #: Increments of every branch.
    counts: list[int]
    #: The figure, for plotly.
    figure: Any


def answer(
    scene: Scene, counts: list[int] | None = None, *, like: Scene | None = None
) -> PageAnswer:
    """Solve a scene and draw it.

    Parameters
    ----------
    scene : Scene
        The contact with its path.
    counts : list of int, optional
        Increments of the branches of a neighbouring scene, for a preview (default: those that the
        tolerance of the path asks for).
    like : Scene, optional
        A neighbouring scene whose increments are the first guess of those that are chosen.

    Raises
    ------
    ValueError
        The scene has no meaning or no solution.
    """
    if counts is not None:
        fewer = [max(LEAST, count // FEWER) for count in counts]
        scene = scene.replace(path=in_increments(scene.path, fewer))
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", SceneWarning)
            result = solve(scene.replace(save="branches"), like=like, progress=False)
            last = result.at(-1)
            # A preview looks at the plane of the shear, an answer in the whole body.
            plane = {} if counts is None else main_line(last).named()
            below = last.stress(**plane)
            largest = below.maximum("von_mises")
    except (NoConvergenceError, OffGridError) as error:
        raise ValueError(str(error)) from error
    doubts = result.doubts
    names = layer_names(len(scene.body2.coatings))
    unit = scene.grid.unit_of("J")
    mises = with_error(1e-6 * largest.value, 1e-6 * largest.error)
    numbers = {
        "largest von Mises stress": f"{mises} MPa in the {names[largest.layer]}",
        "largest pressure": f"{1e-6 * float(result.p_max[-1]):.4g} MPa",
        "stick ratio": NO_FRICTION
        if frictionless(scene)
        else f"{float(result.stick_ratio[-1]):.3f}",
        "energy of the last cycle": energy_of_last_cycle(result, unit),
    }
    increments_of_branches = np.bincount(result.dataset.branch_of_increment.values)
    taken = [int(n) for n in increments_of_branches if n]
    return PageAnswer(
        numbers,
        largest.value,
        doubts[0] if doubts else "",
        counts if counts is not None else taken,
        figure(result, below, largest),
    )


def energy_of_last_cycle(result: Result, unit: str) -> str:
    """The energy that the last cycle dissipates, or why there is none."""
    try:
        loops = result.loops(direction=next(iter(directions(result)), "x"))
    except ValueError as error:
        return f"no answer: {error}"
    if not loops.sizes["cycle"]:
        return "no closed cycle"
    return f"{1e6 * float(loops.dissipated[-1]):.4g} µ{unit}"


def figure(result: Result, below: Any, most: Any) -> Any:
    """Loop, zones, tractions and stress on the section along the shear, in one figure."""
    plotly = needed("plotly.graph_objects", "explore")
    panels = needed("plotly.subplots", "explore")
    d, last = result.dataset, result.at(-1)
    section = line_of(below.dataset)
    cut = fields_on(last, section)
    q = main_shear(cut)
    drawn = panels.make_subplots(
        rows=2,
        cols=2,
        subplot_titles=(
            "loop",
            "stick (blue) and slip",
            f"pressure p (green), shear {q} (purple) along {section.axis}",
            "von Mises stress",
        ),
        horizontal_spacing=0.12,
        vertical_spacing=0.16,
    )
    force, motion = LOOPS[next(iter(directions(result)), "x")]
    shift = np.concatenate([[0.0], 1e6 * d[motion].values])
    loop = np.concatenate([[0.0], d[force].values])
    drawn.add_trace(plotly.Scatter(x=shift, y=loop, mode="lines"), 1, 1)
    unit = "µrad" if d[motion].attrs["units"] == "rad" else "µm"
    axes = [(f"{motion} [{unit}]", f"{force} [{d[force].attrs['units']}]"), ("x [µm]", "y [µm]")]
    x, contact, stick = 1e6 * last.p.x.values, last.contact.values, last.stick.values
    zones = np.where(contact, np.where(stick, 1.0, 0.5), 0.0)
    y = 1e6 * last.p.y.values
    heat = {"colorscale": ZONES, "zmin": 0.0, "zmax": 1.0, "showscale": False}
    drawn.add_trace(plotly.Heatmap(x=x, y=y, z=zones.T, **heat), 1, 2)
    along = 1e6 * cut[section.axis].values
    for name, colour in (("p", "#009E73"), (q, "#AB63FA")):
        values, line = 1e-6 * cut[name].values, {"color": colour}
        drawn.add_trace(plotly.Scatter(x=along, y=values, mode="lines", name=name, line=line), 2, 1)
    axis_label = f"{section.axis} [µm]"
    axes += [(axis_label, f"p, {q} [MPa]"), (axis_label, "depth [µm]")]
    stress = 1e-6 * below.measure("von_mises")
    # A depth on an interface stands twice; a hair's breadth keeps both rows.
    depth = 1e6 * below.dataset.z.values + 1e-6 * np.arange(below.dataset.z.size)
    drawn.add_trace(
        plotly.Heatmap(
            x=1e6 * below.dataset[section.axis].values,
            y=depth,
            z=stress.transpose("depth", section.axis).values,
            colorscale="Viridis",
            colorbar={"title": "MPa", "len": 0.42, "y": 0.21, "thickness": 12},
        ),
        2,
        2,
    )
    cross = {"symbol": "x", "color": "#D55E00", "size": 9}
    drawn.add_trace(
        plotly.Scatter(
            x=[1e6 * section.place(most.x, most.y)],
            y=[1e6 * most.z],
            mode="markers",
            marker=cross,
        ),
        2,
        2,
    )
    for n, (across, up) in enumerate(axes):
        drawn.update_xaxes(title_text=across, row=n // 2 + 1, col=n % 2 + 1)
        drawn.update_yaxes(title_text=up, row=n // 2 + 1, col=n % 2 + 1)
    drawn.update_yaxes(autorange="reversed", row=2, col=2)
    # A round contact is drawn round.
    drawn.update_yaxes(scaleanchor="x2", constrain="domain", row=1, col=2)
    drawn.update_xaxes(constrain="domain", row=1, col=2)
    drawn.update_layout(
        height=640, showlegend=False, margin={"l": 60, "r": 20, "t": 40, "b": 50}, uirevision="x"
    )
    return drawn
