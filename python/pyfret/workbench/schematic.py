"""The contact as a drawing: both bodies to scale, and its layers with their names."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._core import Cylinder
from pyfret._util.depths import stretched, thin
from pyfret._util.numbers import in_words
from pyfret.workbench.figures import graph_objects
from pyfret.workbench.names import layer_labels
from pyfret.workbench.theme import CURVES, MARK, axis, layout

if TYPE_CHECKING:
    from pyfret._core import Scene

__all__ = ["draw_bodies", "draw_layers", "loads_in_words"]

#: Fills of bodies and layers.
BODY_FILLS = ("rgba(0,114,178,.28)", "rgba(150,150,150,.35)")
LAYER_FILLS = ("rgba(230,159,0,.45)", "rgba(0,158,115,.40)", "rgba(204,121,167,.40)")
#: Half of the drawn width over the smallest radius, and over the grid of flat bodies.
WIDE, FLAT_WIDE = 0.9, 2.0
#: Points of an arc.
POINTS = 61


def radius_of(shape: Any) -> float | None:
    """Return the radius of a shape in the plane of the drawing (x and z); None of a flat one."""
    for part in getattr(shape, "parts", None) or [shape]:
        if isinstance(part, Cylinder) and abs(np.sin(part.angle)) > 0.5:
            continue
        for name in ("R", "R_x"):
            R = getattr(part, name, None)
            if R is not None and np.isfinite(R) and R != 0.0:
                return float(R)
    return None


def surface(shape: Any, x: Any) -> Any:
    """Return the height of a surface over x [m], a circle of its radius, 0 of a flat one."""
    R = radius_of(shape)
    if R is None:
        edge, flat = getattr(shape, "edge", None), getattr(shape, "radius", None)
        if edge is not None and flat is not None:
            return np.maximum(np.abs(x) - flat, 0.0) ** 2 / (2 * edge)
        return np.zeros_like(x)
    inside = np.clip(1.0 - (x / R) ** 2, 0.0, None)
    return R - np.sign(R) * abs(R) * np.sqrt(inside)


def loads_in_words(scene: Scene) -> dict[str, str]:
    """Return the largest loads and motions of the path, as text."""
    units = {"W": ("N", 1.0), "T_x": ("N", 1.0), "T_y": ("N", 1.0), "M_z": ("N m", 1.0)}
    units |= {name: ("µm", 1e6) for name in ("delta_x", "delta_y")}
    units |= {name: ("MPa", 1e-6) for name in ("sigma_B", "sigma_B1")}
    texts = {}
    for name, (unit, factor) in units.items():
        values = [getattr(branch, name) or 0.0 for branch in scene.path.branches]
        largest = max(map(abs, values), default=0.0)
        if largest:
            sign = "±" if min(values) < 0 < max(values) else ""
            unit = scene.grid.unit_of(unit) if unit in ("N", "N m") else unit
            texts[name] = f"{name} = {sign}{in_words(factor * largest, 3)} {unit}"
    return texts


def draw_bodies(scene: Scene) -> Any:
    """Draw both bodies to scale in the plane of x and z, with the loads."""
    go = graph_objects()
    radii = [r for b in (scene.body1, scene.body2) if (r := radius_of(b.shape)) is not None]
    grid = scene.grid.nx * scene.grid.dx
    half = WIDE * min(map(abs, radii)) if radii else FLAT_WIDE * grid
    x = np.linspace(-half, half, POINTS)
    high = 0.95 * half
    traces = []
    for body, sign, fill, name in (
        (scene.body1, 1.0, BODY_FILLS[0], "upper body"),
        (scene.body2, -1.0, BODY_FILLS[1], "lower body"),
    ):
        z = np.minimum(sign * surface(body.shape, x) * sign, high) * sign
        outline = np.concatenate([z, [sign * high, sign * high]])
        across = np.concatenate([x, [half, -half]])
        traces.append(
            go.Scatter(
                x=1e3 * across,
                y=1e3 * outline,
                mode="lines",
                fill="toself",
                fillcolor=fill,
                line={"color": "#777777", "width": 1.5},
                name=name,
                hoverinfo="name",
            )
        )
    up = axis("z up [mm]", scaleanchor="x", showgrid=False)
    figure = go.Figure(
        traces, layout(axis("x [mm], drawn to scale", showgrid=False), up, legend=True)
    )
    add_loads(figure, scene, 1e3 * half)
    return figure


def add_loads(figure: Any, scene: Scene, half: float) -> None:
    """Add arrows of the loads with their values; `half` is the half width of the drawing."""
    texts = loads_in_words(scene)
    tangential = next((texts[k] for k in ("T_x", "T_y", "delta_x", "M_z") if k in texts), "")

    def arrow(tail: tuple[float, float], head: tuple[float, float], colour: str) -> None:
        """Draw an arrow."""
        figure.add_annotation(
            x=head[0],
            y=head[1],
            ax=tail[0],
            ay=tail[1],
            xref="x",
            yref="y",
            axref="x",
            ayref="y",
            arrowhead=2,
            arrowwidth=2.5,
            arrowcolor=colour,
            text="",
        )

    def label(place: tuple[float, float], text: str, anchor: str = "center") -> None:
        """Write a label."""
        figure.add_annotation(x=place[0], y=place[1], text=text, showarrow=False, xanchor=anchor)

    if "W" in texts:
        arrow((0.0, 0.9 * half), (0.0, 0.5 * half), CURVES[0])
        label((0.06 * half, 0.78 * half), texts["W"], "left")
    if tangential:
        arrow((0.0, 0.25 * half), (0.42 * half, 0.25 * half), MARK)
        arrow((0.0, 0.25 * half), (-0.42 * half, 0.25 * half), MARK)
        label((0.0, 0.36 * half), tangential)
    if "sigma_B" in texts:
        arrow((0.4 * half, -0.5 * half), (0.85 * half, -0.5 * half), CURVES[2])
        arrow((-0.4 * half, -0.5 * half), (-0.85 * half, -0.5 * half), CURVES[2])
        label((0.0, -0.5 * half), texts["sigma_B"])


def draw_layers(scene: Scene, names: dict[str, str]) -> Any:
    """Draw the layers of both bodies, each with room for its name, and the contact in scale."""
    go = graph_objects()
    figure = go.Figure(
        layout=layout(axis("x [µm]", showgrid=False), axis("", showgrid=False), legend=False)
    )
    hertz = scene.hertz
    a = 1e6 * hertz.a if hertz is not None else 0.0
    half = max(1.5 * a, 0.5e6 * scene.grid.nx * scene.grid.dx)
    ticks: list[tuple[float, str]] = [(0.0, "0")]
    own_scales = False
    for sign, number, body in ((-1.0, 2, scene.body2), (1.0, 1, scene.body1)):
        thicknesses = [1e6 * layer.thickness for layer in body.coatings]
        depth = max(1.3 * sum(thicknesses), 0.6 * half)
        borders = np.array([0.0, *np.cumsum(thicknesses), depth])
        own_scales |= thin(borders)
        places = sign * (stretched(borders) if thin(borders) else borders / depth)
        for n, text in enumerate(layer_labels(scene, names, number)):
            last = n == len(thicknesses)
            fill = BODY_FILLS[number - 1] if last else LAYER_FILLS[n % len(LAYER_FILLS)]
            figure.add_shape(
                type="rect",
                x0=-half,
                x1=half,
                y0=places[n],
                y1=places[n + 1],
                fillcolor=fill,
                line={"width": 1, "color": "#777777"},
                layer="below",
            )
            size = "" if last else f", {in_words(thicknesses[n], 3)} µm"
            middle = (places[n] + places[n + 1]) / 2
            figure.add_annotation(x=0, y=middle, text=f"{text}{size}", showarrow=False)
            if not last:
                ticks.append((places[n + 1], in_words(borders[n + 1], 3)))
    if a:
        line = {"color": MARK, "width": 5}
        trace = go.Scatter(x=[-a, a], y=[0, 0], mode="lines", line=line, hoverinfo="skip")
        figure.add_trace(trace)
    ticks.sort()
    depths = "depth [µm]" + (", own scale in each layer" if own_scales else "")
    figure.update_yaxes(
        title_text=depths,
        range=[-1.02, 1.02],
        tickvals=[position for position, _ in ticks],
        ticktext=[text for _, text in ticks],
    )
    figure.update_xaxes(range=[-half, half])
    return figure
