"""First and fifth tab: drawings, doubts at their fields, and the contact for other programs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pyfret._util.extras import needed
from pyfret.workbench.doubts import Doubt, doubts_of
from pyfret.workbench.exports import COMMANDS, write_link, write_script
from pyfret.workbench.fields import fields_of
from pyfret.workbench.figures import draw_load_cycle
from pyfret.workbench.form import html, select
from pyfret.workbench.names import names_of
from pyfret.workbench.render import render_doubt
from pyfret.workbench.schematic import draw_bodies, draw_layers

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pyfret.workbench.sessions import Sessions

__all__ = ["connect_contact"]

#: Letters of a scene file that are shown.
SHOWN = 20_000


def connect_contact(app: Any, sessions: Sessions) -> None:
    """Connect drawings, doubts and texts to the scene."""
    dash = needed("dash", "explore")
    dcc = needed("dash.dcc", "explore")

    @app.callback(  # type: ignore[untyped-decorator]
        dash.Output("figure-bodies", "figure"),
        dash.Output("figure-layers", "figure"),
        dash.Output("figure-cycle", "figure"),
        dash.Output("study-keys", "children"),
        dash.Input("scene", "data"),
        dash.Input("session", "data"),
        prevent_initial_call=True,
    )
    def draw(packed: Any, session: Any) -> list[Any]:
        """Draw bodies, layers and load path."""
        if not session:
            raise dash.exceptions.PreventUpdate
        scene, names = sessions.unpack(session, packed)
        names = names_of(scene, names)
        keys = [
            (field.key, f"{field.label} ({group.replace('.', ' ')})")
            for group, fields in fields_of(scene).items()
            for field in fields
            if field.key != "grid.n"
        ]
        study = select("study-key", "field", keys, "friction.mu")
        unit = scene.grid.unit_of("N")
        cycle = draw_load_cycle(scene.path, unit)
        return [draw_bodies(scene), draw_layers(scene, names), cycle, study]

    @app.callback(  # type: ignore[untyped-decorator]
        dash.Output({"t": "doubt", "key": dash.ALL}, "children"),
        dash.Input("scene", "data"),
        dash.Input("note", "data"),
        dash.Input({"t": "doubt", "key": dash.ALL}, "id"),
        dash.Input("session", "data"),
    )
    def place_doubts(packed: Any, note: Any, slots: Sequence[Any], session: Any) -> list[Any]:
        """Put every doubt at its field; doubts without a field at the top."""
        if not session or not slots:
            raise dash.exceptions.PreventUpdate
        scene, _ = sessions.unpack(session, packed)
        doubts = doubts_of(scene)
        if note and note["key"] != "run":
            values = note.get("values") or {}
            refusal = Doubt(note["sentence"], note["key"], note.get("button", ""), values)
            doubts.insert(0, refusal)
        keys = [slot["key"] for slot in slots]
        return [
            render_doubt(d for d in doubts if d.key == key or (key == "" and d.key not in keys))
            for key in keys
        ]

    @app.callback(  # type: ignore[untyped-decorator]
        dash.Output("python", "children"),
        dash.Output("commands", "children"),
        dash.Output("toml", "children"),
        dash.Output("link-place", "children"),
        dash.Input("scene", "data"),
        dash.Input("judged", "data"),
        dash.Input("session", "data"),
    )
    def write(packed: Any, judged: Any, session: Any) -> list[Any]:
        """Write the contact as Python, as commands, as a file and as a link."""
        if not session:
            raise dash.exceptions.PreventUpdate
        scene, names = sessions.unpack(session, packed)
        criterion = (judged or {}).get("criterion", "smith_watson_topper")
        script = write_script(scene, names_of(scene, names), criterion)
        text = scene.to_toml()
        cut = "\n... (the file has it all)"
        link = write_link(scene)
        slot = dcc.Textarea(id="link", value=link, readOnly=True, rows=3)
        if not link:
            slot = html().P("The scene holds a measured surface: take the scene file.", id="link")
        return [
            script if len(script) <= SHOWN else script[:SHOWN] + cut,
            COMMANDS,
            text if len(text) <= SHOWN else text[:SHOWN] + cut,
            slot,
        ]
