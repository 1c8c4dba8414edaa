"""Events of the page that lead to another scene: a field, a material, a layer, a file."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pyfret._core import Scene
from pyfret.workbench import edits
from pyfret.workbench.doubts import Doubt, doubt_of_sentence
from pyfret.workbench.exports import read_link
from pyfret.workbench.fields import find_field
from pyfret.workbench.file_views import read_dropped_scene, surface_of
from pyfret.workbench.names import OWN
from pyfret.workbench.presets import make_preset
from pyfret.workbench.sessions import read_scene_text
from pyfret.workbench.uploads import dropped_path

if TYPE_CHECKING:
    from pyfret.workbench.jobs import Jobs
    from pyfret.workbench.sessions import Sessions

__all__ = ["SCENE_EVENTS", "Context", "change_scene"]

Event = dict[str, Any]
Named = tuple[Scene, dict[str, str]]


@dataclass(frozen=True)
class Context:
    """A browser: its session, its scene, and what the page has for it."""

    sessions: Sessions
    jobs: Jobs
    session: str
    scene: Scene
    names: dict[str, str]


def number_of(text: Any) -> float:
    """Return a number that somebody has typed.

    Raises
    ------
    ValueError
        It is none.
    """
    try:
        value = float(str(text).strip().replace(",", "."))
    except ValueError:
        raise ValueError(f"{str(text)[:40]!r}: must be a number") from None
    if not math.isfinite(value):
        raise ValueError(f"{value}: must be a finite number")
    return value


def change_value(context: Context, event: Event) -> Named:
    """Change a field."""
    field = find_field(context.scene, str(event["key"]))
    if field is None:
        raise ValueError("the scene has no such field: reload the page")
    value = number_of(event["value"]) * field.scale
    return edits.replace_value(context.scene, field.key, value), context.names


def apply_remedy(context: Context, event: Event) -> Named:
    """Change the fields that a button names, all at once."""
    changes = json.loads(event["changes"])
    scene = context.scene
    n = changes.pop("grid.n", None)
    if changes:
        scene = edits.fit_grid(scene.replace({str(k): float(v) for k, v in changes.items()}))
    if n is not None:
        scene = edits.replace_value(scene, "grid.n", float(n))
    return scene, context.names


def change_material(context: Context, event: Event) -> Named:
    """Give a part a material of the table."""
    part, name = str(event["part"]), str(event["value"])
    if name == OWN:
        return context.scene, context.names
    return edits.replace_material(context.scene, part, name), {**context.names, part: name}


def change_layers(context: Context, event: Event) -> Named:
    """Add, remove or move a layer; the names of materials follow by their constants."""
    body, n = str(event["part"]), int(event.get("n", 0))
    kept = [v for k, v in sorted(context.names.items()) if k.startswith(f"{body}.coatings.")]
    names = {k: v for k, v in context.names.items() if not k.startswith(f"{body}.coatings.")}
    kind = event["event"]
    if kind == "add":
        scene, kept = edits.add_layer(context.scene, body), ["TiN", *kept]
    elif kind == "remove":
        scene = edits.remove_layer(context.scene, body, n)
        del kept[n : n + 1]
    else:
        scene = edits.move_layer(context.scene, body, n)
        kept[n : n + 2] = kept[n : n + 2][::-1]
    return scene, names | {f"{body}.coatings.{k}": name for k, name in enumerate(kept)}


def put_surface(context: Context, event: Event) -> Named:
    """Put a dropped map on a body: on the lower one, or added to the shape of the upper one."""
    path = dropped_path(context.sessions, context.session, event["id"], event["name"])
    surface = surface_of(path)
    scene = context.scene
    if event["part"] == "body1":
        body = scene.body1.replace(shape=scene.body1.shape + surface)
        return edits.fit_grid(scene.replace(body1=body)), context.names
    body = scene.body2.replace(shape=surface)
    return edits.fit_grid(scene.replace(body2=body)), context.names


def open_dropped(context: Context, event: Event) -> Named:
    """Open the scene of a dropped file."""
    path = dropped_path(context.sessions, context.session, event["id"], event["name"])
    return read_dropped_scene(path), {}


def open_job(context: Context, event: Event) -> Named:
    """Open the scene that a fit came to."""
    job = context.jobs.find(context.session, str(event["id"]))
    if job is None:
        raise ValueError("the run is gone")
    return Scene.from_toml(job.result()["scene"]), context.names


#: Events that lead to another scene.
SCENE_EVENTS: dict[str, Callable[[Context, Event], Named]] = {
    "value": change_value,
    "remedy": apply_remedy,
    "material": change_material,
    "shape": lambda c, e: (edits.replace_shape(c.scene, str(e["part"]), str(e["value"])), c.names),
    "cycle": lambda c, e: (edits.replace_cycle(c.scene, str(e["value"])), c.names),
    "preset": lambda _, e: make_preset(str(e["value"])),
    "add": change_layers,
    "remove": change_layers,
    "move": change_layers,
    "surface": put_surface,
    "open": open_dropped,
    "open-job": open_job,
    "link": lambda _, e: (read_scene_text(read_link(str(e["value"]))), {}),
}


def change_scene(context: Context, event: Event) -> tuple[Named | None, Doubt | None]:
    """Return the scene that an event leads to, or the doubt that refuses it.

    The button of a refused value sets it together with the value that allows it.
    """
    try:
        scene, names = SCENE_EVENTS[event["event"]](context, event)
        scene.check()
    except (KeyError, ValueError, RuntimeError, OSError, ImportError) as error:
        text = str(error).replace(str(context.sessions.folder), "")
        doubt = doubt_of_sentence(context.scene, text)
        if (
            event["event"] == "value"
            and doubt.values
            and (field := find_field(context.scene, event["key"]))
        ):
            typed = {field.key: number_of(event["value"]) * field.scale}
            doubt = Doubt(doubt.sentence, field.key, doubt.button, {**typed, **doubt.values})
        elif event["event"] == "value":
            doubt = Doubt(doubt.sentence, str(event["key"]), doubt.button, doubt.values)
        return None, doubt
    return (scene, names), None
