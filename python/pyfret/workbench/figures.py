"""Figures of the page, in the colours of ``plot``: loop, zones, tractions, stress over depth."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._util.depths import stretched, thin
from pyfret._util.extras import needed
from pyfret._util.numbers import in_words
from pyfret.run.summary import directions
from pyfret.subsurface.line import fields_on, line_of, main_line, main_shear
from pyfret.workbench.theme import CURVES, MARK, STICK, ZONES, axis, layout, scale

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pyfret.result import Result
    from pyfret.subsurface.tensor import Stress

__all__ = ["draw_load_cycle", "draw_loop", "draw_stress", "draw_tractions", "draw_zones"]

#: Force and motion of a loop by what drives it.
LOOPS = {"x": ("T_x", "delta_x"), "y": ("T_y", "delta_y"), "torsion": ("M_z", "phi_z")}
#: Dashes of curves that may lie on one another.
DASHES = ("solid", "dash", "dot", "dashdot")
#: Most points along a section.
ALONG = 160
#: Part of the contact that is shown beside it.
ROOM = 0.15


def graph_objects() -> Any:
    """Import plotly."""
    return needed("plotly.graph_objects", "workbench")


def draw_loop(result: Result, name: str = "", colour: str = CURVES[0]) -> Any:
    """Draw force over shift."""
    go, d = graph_objects(), result.dataset
    force, motion = LOOPS[next(iter(directions(result)), "x")]
    shift = np.concatenate([[0.0], 1e6 * d[motion].values])
    unit = "µrad" if d[motion].attrs["units"] == "rad" else "µm"
    trace = go.Scatter(
        x=shift,
        y=np.concatenate([[0.0], d[force].values]),
        mode="lines",
        name=name,
        line={"color": colour, "width": 2},
    )
    labels = f"{motion} [{unit}]", f"{force} [{d[force].attrs['units']}]"
    return go.Figure([trace], layout(axis(labels[0]), axis(labels[1]), legend=bool(name)))


def draw_zones(result: Result) -> Any:
    """Draw where the contact sticks and slips, of a line contact the slip of a cycle."""
    go, last = graph_objects(), result.at(-1)
    contact, stick = last.contact.values, last.stick.values
    zones = np.where(contact, np.where(stick, 1.0, 0.5), np.nan)
    x, y = 1e6 * last.p.x.values, 1e6 * last.p.y.values
    flat = result.scene.grid.plane_strain
    heat = go.Heatmap(
        x=x,
        y=[0.0] if flat else y,
        z=zones.T,
        colorscale=ZONES,
        zmin=0.0,
        zmax=1.0,
        showscale=False,
        hoverinfo="skip",
    )
    legend = [
        go.Scatter(
            x=[None],
            y=[None],
            mode="markers",
            name=name,
            marker={"color": colour, "size": 12, "symbol": "square"},
        )
        for name, colour in (("stick", STICK), ("slip", ZONES[1][1]))
    ]
    across = axis("x [µm]", constrain="domain")
    up = axis("" if flat else "y [µm]")
    if flat:
        up |= {"showticklabels": False, "range": [-1, 1]}
    else:
        up |= {"scaleanchor": "x", "constrain": "domain"}
    return go.Figure([heat, *legend], layout(across, up, legend=True))


def draw_tractions(result: Result) -> Any:
    """Draw pressure, shear and the bound of friction along the shear."""
    go, last = graph_objects(), result.at(-1)
    line = main_line(last)
    cut = fields_on(last, line)
    q = main_shear(cut)
    along = 1e6 * cut[line.axis].values
    inside = np.flatnonzero(cut.p.values > 0.0)
    if inside.size:
        room = max(round(ROOM * (inside[-1] - inside[0])), 2)
        part = slice(max(inside[0] - room, 0), inside[-1] + room + 1)
    else:
        part = slice(None)
    curves = [("p", 1e-6 * cut.p.values, CURVES[0], "solid")]
    curves.append((q, 1e-6 * cut[q].values, CURVES[1], "dash"))
    if np.isfinite(last.mu):
        curves.append(("mu p", 1e-6 * last.mu * cut.p.values, CURVES[2], "dot"))
    traces = [
        go.Scatter(
            x=along[part],
            y=values[part],
            mode="lines",
            name=name,
            line={"color": colour, "dash": dash, "width": 2},
        )
        for name, values, colour, dash in curves
    ]
    labels = axis(f"{line.axis} [µm]"), axis("traction [MPa]")
    return go.Figure(traces, layout(*labels, legend=True))


def draw_stress(
    below: Stress, labels: list[str], marks: Sequence[tuple[float, float, float]] = ()
) -> Any:
    """Draw the von Mises stress on the section, every layer with room of its own in depth."""
    go = graph_objects()
    line = line_of(below.dataset)
    x, z = 1e6 * below.dataset[line.axis].values, 1e6 * below.dataset.z.values
    layer = below.dataset.layer.values
    changes = np.flatnonzero(np.diff(layer))
    borders = np.array([z[0], *(z[changes] + z[changes + 1]) / 2, z[-1]])
    own_scales = thin(borders)

    def place(depth: Any) -> Any:
        return np.interp(depth, borders, stretched(borders)) if own_scales else np.asarray(depth)

    step = max(x.size // ALONG, 1)
    stress = 1e-6 * below.measure("von_mises").transpose("depth", line.axis).values
    # A depth on an interface stands twice; a hair's breadth keeps both rows.
    rows = place(z) + 1e-9 * np.arange(z.size) * max(float(np.ptp(place(z))), 1e-12)
    heat = go.Heatmap(
        x=x[::step],
        y=rows,
        z=stress[:, ::step],
        colorscale=scale(),
        zsmooth="best",
        colorbar={"title": {"text": "MPa", "side": "top"}, "thickness": 12, "outlinewidth": 0},
        hovertemplate="%{z:.3g} MPa<extra></extra>",
    )
    traces = [heat]
    if marks:
        spots = {
            "x": [1e6 * line.place(x, y) for x, y, _ in marks],
            "y": [float(place(1e6 * depth)) for _, _, depth in marks],
        }
        cross = {"symbol": "x", "color": MARK, "size": 9, "line": {"color": "#fff", "width": 1}}
        traces.append(go.Scatter(**spots, mode="markers", marker=cross, name="largest"))
    ticks = borders if own_scales else None
    up = axis("depth [µm]", autorange="reversed", showgrid=False)
    if ticks is not None:
        deep = [*ticks[:-1], (ticks[-2] + ticks[-1]) / 2, ticks[-1]]
        up |= {
            "tickvals": [float(place(t)) for t in deep],
            "ticktext": [in_words(t, 3) for t in deep],
        }
        up["title"]["text"] = "depth [µm], own scale in each layer"
    figure = go.Figure(traces, layout(axis(f"{line.axis} [µm]", showgrid=False), up, legend=False))
    for border in borders[1:-1]:
        figure.add_hline(
            y=float(place(border)), line={"color": "#333333", "width": 1.5, "dash": "dash"}
        )
    middles = place(borders)
    for n, label in enumerate(labels):
        if n + 1 < middles.size:
            figure.add_annotation(
                x=0.01,
                xref="paper",
                xanchor="left",
                y=float((middles[n] + middles[n + 1]) / 2),
                text=label,
                showarrow=False,
                bgcolor="rgba(255,255,255,.8)",
                font={"color": "#1b1b1b", "size": 11},
            )
    return figure


def draw_load_cycle(result_or_path: Any, unit: str) -> Any:
    """Draw the loads of a path over its time."""
    go = graph_objects()
    branches = result_or_path.branches
    t = [0.0, *(branch.t for branch in branches)]
    traces: list[Any] = []
    loads = ("W", "T_x", "T_y", "M_z", "delta_x", "delta_y", "sigma_B", "sigma_B1")
    for load in loads:
        values = [float(getattr(branch, load) or 0.0) for branch in branches]
        largest = max(map(abs, values), default=0.0)
        if not largest:
            continue
        factor, own_unit = (1e6, "µm") if load.startswith("delta") else (1.0, unit)
        if load.startswith("sigma"):
            factor, own_unit = 1e-6, "MPa"
        if load == "M_z":
            own_unit = "N m"
        traces.append(
            go.Scatter(
                x=t,
                y=[0.0, *(value / largest for value in values)],
                mode="lines+markers",
                name=f"{load} / {in_words(factor * largest, 3)} {own_unit}",
                line={
                    "color": CURVES[len(traces) % len(CURVES)],
                    "dash": DASHES[len(traces) % len(DASHES)],
                    "width": 2,
                },
            )
        )
    labels = axis("path time"), axis("part of the largest")
    return go.Figure(traces, layout(*labels, legend=True))
