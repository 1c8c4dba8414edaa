"""The form of the first tab: fields with units and sliders, materials, layers, shapes, loads."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from pyfret._util.extras import needed
from pyfret.workbench.edits import CYCLES, SHAPES, material_names, name_of_shape
from pyfret.workbench.fields import BODIES, Field, fields_of
from pyfret.workbench.names import OWN, source_of
from pyfret.workbench.presets import PRESETS

if TYPE_CHECKING:
    from collections.abc import Iterable

    from pyfret._core import Scene

__all__ = ["button", "doubt_id", "render_form", "select"]

#: Steps of a slider.
STEPS = 240


def html() -> Any:
    """Import the elements of HTML."""
    return needed("dash.html", "explore")


def doubt_id(key: str) -> dict[str, str]:
    """Return the name of the place for the doubts of a field."""
    return {"t": "doubt", "key": key}


def input_id(kind: str, key: str) -> str:
    """Return the name of an input, which its label refers to."""
    return f"{kind}-{key.split(',', 1)[0].replace('.', '-').replace('*', 'all')}"


def select(
    name: str, label: str, options: Iterable[tuple[str, str]], value: str, **data: str
) -> Any:
    """Make a list to choose from; its event has the data and the value."""
    h = html()
    choices = [h.Option(text, value=key, selected=key == value) for key, text in options]
    attributes = {f"data-{key}": item for key, item in data.items()}
    return h.Div(
        [h.Label(label, htmlFor=name), h.Select(choices, id=name, **attributes)], className="field"
    )


def button(text: str, *, label: str | None = None, kind: str = "", **data: str) -> Any:
    """Make a button; its event has the data."""
    attributes: dict[str, Any] = {f"data-{key}": item for key, item in data.items()}
    if label:
        attributes["aria-label"] = label
    return html().Button(text, type="button", className=kind, **attributes)


def position(field: Field) -> int:
    """Return the step of the slider at the value."""
    assert field.slider is not None
    low, high = field.slider
    return round(STEPS * (math.log10(field.value / field.scale) - low) / (high - low))


def render_field(field: Field) -> Any:
    """Make a number field with its unit, a slider below it, and the place of its doubts."""
    h, dcc = html(), needed("dash.dcc", "explore")
    name = input_id("number", field.key)
    label = f"{field.label} [{field.unit}]" if field.unit else field.label
    parts = [
        h.Label(label, htmlFor=name),
        dcc.Input(
            id=name, type="number", value=field.shown, step=1 if field.whole else "any", size="9"
        ),
    ]
    ends = field.slider
    if ends is not None:
        slider = input_id("slider", field.key)
        parts += [
            h.Label(f"{field.label}, slider", htmlFor=slider, className="unseen"),
            dcc.Input(id=slider, type="range", min=0, max=STEPS, step=1, value=position(field)),
        ]
    data = {"data-field": field.key, "data-value": repr(field.shown)}
    if ends is not None:
        data |= {"data-low": repr(ends[0]), "data-high": repr(ends[1])}
    doubt = h.Div(id=doubt_id(field.key), className="doubt", role="status")
    return h.Div([h.Div(parts, className="field number", **data), doubt])


def material_select(part: str, name: str) -> Any:
    """Make the list of materials of a part, with the source of the one that is chosen."""
    h = html()
    options = [(item, item) for item in [*material_names(), OWN]]
    name_of_list = f"material-{part.replace('.', '-')}"
    chosen = select(name_of_list, "material", options, name, event="material", part=part)
    return h.Div([chosen, h.P(source_of(name), className="source")])


def render_layer(body: str, n: int, count: int, fields: list[Field], name: str) -> Any:
    """Make the fields of a layer, with buttons that move and remove it."""
    h, part = html(), f"{body}.coatings.{n}"
    at = f"layer {n + 1} of the {BODIES[body]}"
    buttons = [button("Remove", label=f"Remove {at}", event="remove", part=body, n=str(n))]
    if n + 1 < count:
        buttons.insert(
            0, button("Move down", label=f"Move {at} down", event="move", part=body, n=str(n))
        )
    head = h.Div([h.H3(f"Layer {n + 1}"), h.Div(buttons)], className="head")
    return h.Div([head, material_select(part, name), *map(render_field, fields)], className="layer")


def render_body(
    scene: Scene, body: str, groups: dict[str, list[Field]], names: dict[str, str]
) -> Any:
    """Make the fields of a body: its shape, its layers, its substrate."""
    h = html()
    whole = scene.body1 if body == "body1" else scene.body2
    shape = name_of_shape(whole.shape)
    shapes = [(name, name) for name in ([] if shape in SHAPES else [shape]) + list(SHAPES)]
    count = len(whole.coatings)
    layers = [
        render_layer(body, n, count, groups[f"{body}.coatings.{n}"], names[f"{body}.coatings.{n}"])
        for n in range(count)
    ]
    add = button(
        "Add a layer on top", label=f"Add a layer on the {BODIES[body]}", event="add", part=body
    )
    return h.Fieldset(
        [
            h.Legend(BODIES[body].capitalize()),
            select(f"shape-{body}", "shape", shapes, shape, event="shape", part=body),
            *map(render_field, groups[f"{body}.shape"]),
            *layers,
            add,
            h.H3("Substrate"),
            material_select(body, names[body]),
            *map(render_field, groups[body]),
        ]
    )


def render_form(scene: Scene, names: dict[str, str]) -> list[Any]:
    """Make the form of a scene."""
    h, groups = html(), fields_of(scene)
    presets = [("", scene.title or "this scene"), *((n, n) for n in PRESETS if n != scene.title)]
    cycles = [("", "as it is"), *CYCLES.items()]
    return [
        select("preset", "begin with", presets, "", event="preset"),
        h.Div(id=doubt_id(""), className="doubt", role="status"),
        h.Fieldset(
            [
                h.Legend("Loads and friction"),
                select("cycle", "load cycle", cycles, "", event="cycle"),
                *map(render_field, groups["loads"]),
                *map(render_field, groups["contact"]),
            ]
        ),
        render_body(scene, "body1", groups, names),
        render_body(scene, "body2", groups, names),
    ]
