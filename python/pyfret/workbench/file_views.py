"""Dropped files as the page shows them: what is read, a preview, doubts, and what can be done."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._core import Scene
from pyfret._util.scene_warnings import SceneWarning
from pyfret.file_info import describe_file
from pyfret.fit.columns import kind_of as kind_of_unit
from pyfret.opening import open as open_store
from pyfret.scene.surfaces import read_surface
from pyfret.workbench.answers import REFUSALS
from pyfret.workbench.figures import graph_objects
from pyfret.workbench.form import button, html, select
from pyfret.workbench.runs import curve, draw
from pyfret.workbench.theme import axis, layout, scale

if TYPE_CHECKING:
    from pyfret.file_info import FileInfo

__all__ = ["kind_of", "read_dropped_scene", "render_file", "surface_of"]

#: Most points along a side of a preview.
SIDE = 128
#: Beginnings of the names of a column of depths.
DEPTHS = ("depth", "z", "h", "worn", "tiefe")
#: Lines of a description.
LINES = 24


def read_dropped_scene(path: Path) -> Scene:
    """Read the scene of a dropped file, or of the result in a store."""
    if path.suffix.lower() == ".toml":
        return Scene.from_file(path)
    result = open_store(path)
    scene = getattr(result, "scene", None)
    if not isinstance(scene, Scene):
        raise ValueError(f"{path.name}: holds no scene")
    return scene


def describe(path: Path) -> tuple[str, dict[str, str], list[str]]:
    """Return the kind of a file, its description, and its doubts."""
    if path.suffix.lower() == ".toml":
        scene = Scene.from_file(path)
        lines = {"format": "scene file", "title": scene.title, "read by": "fret.Scene.from_file"}
        return "scene", lines, scene.doubts()
    if (columns := profile_columns(path)) is not None:
        return "scar", {"format": "table", "read by": "fret.fit.read_scar", **columns}, []
    info = describe_file(path)
    lines = {"format": info.format, "read by": info.reader, **info.content}
    return kind_of(info), lines, info.doubts


def profile_columns(path: Path) -> dict[str, str] | None:
    """Describe the columns of a profile: places and depths, and no forces; None of other files."""
    from pyfret.fit.recorders import read_columns

    try:
        columns = read_columns(path)
        places = columns.column("length", ("x", "pos"), None)
        depths = columns.column("length", DEPTHS, None)
        size = len(columns.numbers(places, depths)[0])
    except (*REFUSALS, ImportError, OSError):
        return None
    kinds = [kind_of_unit(unit) for unit in columns.units if unit]
    if places == depths or "force" in kinds or kinds.count("length") != 2:
        return None
    names = [f"{columns.names[n]} [{columns.units[n]}]" for n in (places, depths)]
    return {"place": names[0], "depth": names[1], "points": str(size)}


def kind_of(info: FileInfo) -> str:
    """Return what a file is for the page: store, loop, map or other."""
    if info.reader == "fret.open":
        return "store"
    if info.reader.startswith("fret.fit.read_loops,") or info.reader == "fret.fit.read_loops":
        return "loop"
    return "map" if "read_surface" in info.reader and "points" in info.content else "other"


def surface_of(path: Path) -> Any:
    """Read a map as a surface, holes filled."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SceneWarning)
        return read_surface(path, missing="fill")


def preview(path: Path, kind: str) -> Any:
    """Draw a file: a map, a loop, the profile of a scar."""
    from pyfret.fit.recorders import read_columns

    go = graph_objects()
    if kind == "map":
        surface = surface_of(path)
        steps = [max(n // SIDE, 1) for n in surface.values.shape]
        values = 1e6 * np.asarray(surface.values)[:: steps[0], :: steps[1]]
        x, y = (
            1e6 * pitch * step * np.arange(n)
            for pitch, step, n in zip(surface.spacing, steps, values.shape, strict=True)
        )
        bar = {"title": {"text": "µm", "side": "top"}, "thickness": 12}
        heat = go.Heatmap(x=x, y=y, z=values.T, colorscale=scale(), colorbar=bar)
        up = axis("y [µm]", scaleanchor="x", constrain="domain")
        across = axis("x [µm]", constrain="domain")
        return go.Figure([heat], layout(across, up, legend=False))
    columns = read_columns(path)
    first = columns.column("length", ("delta", "d_", "weg", "shift", "disp", "x", "pos"), None)
    if kind == "loop":
        second = columns.column("force", ("t", "q", "kraft", "f", "force"), None)
        x, y = columns.numbers(first, second)
        return go.Figure(draw([curve(1e6 * x, y, "")], "shift [µm]", "force [N]"))
    first = columns.column("length", ("x", "pos"), None)
    second = columns.column("length", DEPTHS, None)
    x, y = columns.numbers(first, second)
    return go.Figure(draw([curve(1e6 * x, 1e6 * y, "")], "x [µm]", "depth [µm]", downwards=True))


def actions(kind: str, drop: dict[str, str]) -> list[Any]:
    """Return the buttons of a file."""
    data = {"id": drop["id"], "name": drop["name"]}
    if kind in ("scene", "store"):
        return [button("Open its scene", event="open", **data)]
    if kind == "map":
        return [
            button("Use on the lower body", event="surface", part="body2", **data),
            button("Add to the upper body", event="surface", part="body1", **data),
        ]
    return []


def render_file(path: Path, drop: dict[str, str]) -> Any:
    """Make the card of a dropped file, with the reason where nothing reads it."""
    h = html()
    from pyfret._util.extras import needed

    dcc = needed("dash.dcc", "explore")
    head = h.Div(
        [
            h.H3(drop["name"]),
            button("Remove", label=f"Remove {drop['name']}", event="forget", id=drop["id"]),
        ],
        className="head",
    )
    try:
        kind, lines, doubts = describe(path)
    except (*REFUSALS, ImportError, OSError) as error:
        reason = str(error).replace(str(path.parent) + "/", "")
        return h.Div([head, h.Div(h.Div(reason), className="doubt")], className="card")
    rows = [
        h.Tr([h.Th(k.strip(), scope="row"), h.Td(str(v))]) for k, v in list(lines.items())[:LINES]
    ]
    parts = [head, h.Div(h.Table(h.Tbody(rows)), className="wide")]
    doubts = [doubt.replace(str(path.parent) + "/", "") for doubt in doubts]
    parts.append(h.Div([h.Div(doubt) for doubt in doubts], className="doubt"))
    if kind in ("map", "loop", "scar"):
        try:
            figure = preview(path, kind)
            config = {"displayModeBar": False, "responsive": True}
            drawing = dcc.Graph(figure=figure, config=config, className="plot", responsive=True)
            parts.append(h.Figure([drawing, h.Figcaption(f"Preview: read as a {kind}.")]))
        except (*REFUSALS, ImportError) as error:
            parts.append(h.Div(h.Div(f"no preview: {error}"), className="doubt"))
    roles = [("loop", "measured loop"), ("scar", "profile of a scar"), ("", "nothing of a fit")]
    if kind in ("loop", "scar"):
        name = f"role-{drop['id']}"
        parts.append(select(name, "what it is", roles, kind))
    parts.append(h.Div(actions(kind, drop), className="actions"))
    return h.Div(parts, className="card")
