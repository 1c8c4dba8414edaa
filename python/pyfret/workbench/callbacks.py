"""Connections of the page: events change the scene, and the scene is drawn, solved and judged."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pyfret._util.extras import needed
from pyfret.workbench.answers import REFUSALS
from pyfret.workbench.callbacks_answers import connect_answers
from pyfret.workbench.callbacks_contact import connect_contact
from pyfret.workbench.callbacks_files import adopt_measured, connect_files
from pyfret.workbench.compare_events import pin, unpin
from pyfret.workbench.events import SCENE_EVENTS, Context, change_scene
from pyfret.workbench.exports import write_file
from pyfret.workbench.form import render_form
from pyfret.workbench.names import names_of
from pyfret.workbench.orders import ORDERS, start_run

if TYPE_CHECKING:
    from pathlib import Path

    from pyfret.workbench.jobs import Jobs
    from pyfret.workbench.sessions import Sessions

__all__ = ["connect"]


def connect(app: Any, sessions: Sessions, jobs: Jobs, measured: Path | None) -> None:
    """Connect all parts of the page."""
    dash = needed("dash", "explore")
    outputs = {
        "scene": dash.Output("scene", "data"),
        "form": dash.Output("form", "children"),
        "pins": dash.Output("pins", "data"),
        "dropped": dash.Output("dropped", "data"),
        "note": dash.Output("note", "data"),
        "file": dash.Output("file", "data"),
        "out": dash.Output("out-state", "children"),
        "jobs": dash.Output("tick", "n_intervals"),
        "done": dash.Output("done", "data"),
    }

    @app.callback(  # type: ignore[untyped-decorator]
        output=outputs,
        inputs={"event": dash.Input("event", "data"), "session": dash.Input("session", "data")},
        state={
            "packed": dash.State("scene", "data"),
            "pins": dash.State("pins", "data"),
            "dropped": dash.State("dropped", "data"),
            "criterion": dash.State("judged", "data"),
        },
        prevent_initial_call=True,
    )
    def handle(
        event: Any, session: Any, packed: Any, pins: Any, dropped: Any, criterion: Any
    ) -> dict[str, Any]:
        """Do what an event asks for; without one, make the form of the scene of the browser."""
        changes = dict.fromkeys(outputs, dash.no_update)
        # A page that opens with a link sends both at once.
        triggers = {trigger["prop_id"].partition(".")[0] for trigger in dash.ctx.triggered}
        owner = event["session"] if "event" in triggers else session
        sessions.folder_of(owner)
        scene, names = sessions.unpack(owner, packed)
        names = names_of(scene, names)
        if "session" in triggers:
            adopted = (
                adopt_measured(sessions, owner, measured) if measured and not dropped else None
            )
            if adopted:
                changes["dropped"] = [adopted]
            changes["form"] = render_form(scene, names)
        if "event" not in triggers:
            return changes
        changes["done"] = event["number"]
        context = Context(sessions, jobs, owner, scene, names)
        try:
            kind = event["event"]
            if kind in SCENE_EVENTS:
                changes |= scene_event(context, event)
            elif kind in ORDERS:
                start_run(
                    context,
                    {
                        **event,
                        "values": {
                            **event.get("values", {}),
                            "drops": {d["id"]: d["name"] for d in dropped},
                        },
                    },
                )
                changes["note"] = None
                changes["jobs"] = 0
            elif kind == "cancel":
                if job := jobs.find(owner, str(event["id"])):
                    job.cancel()
                changes["jobs"] = 0
            elif kind == "pin":
                changes["pins"] = pin(pins, scene, names, sessions.pack(owner, scene, names))
            elif kind == "unpin":
                changes["pins"] = unpin(pins, event)
            elif kind == "open-pin":
                opened = pins[int(event["n"])]["scene"]
                shown = sessions.unpack(owner, opened)
                changes |= {"scene": opened, "form": render_form(shown[0], names_of(*shown))}
            elif kind == "dropped":
                entry = {"id": str(event["id"]), "name": str(event["name"])}
                changes["dropped"] = [*dropped, entry]
            elif kind == "forget":
                changes["dropped"] = [d for d in dropped if d["id"] != event["id"]]
            elif kind == "out":
                changes |= written(context, str(event["name"]), criterion)
        except (*REFUSALS, OSError, ImportError) as error:
            changes["note"] = {"sentence": str(error), "key": "run"}
        return changes

    def scene_event(context: Context, event: Any) -> dict[str, Any]:
        """Change the scene by an event."""
        named_scene, doubt = change_scene(context, event)
        if named_scene is None:
            assert doubt is not None
            return {
                "note": {
                    "sentence": doubt.sentence,
                    "key": doubt.key,
                    "button": doubt.button,
                    "values": doubt.values,
                }
            }
        scene, names = named_scene
        names = names_of(scene, names)
        changed: dict[str, Any] = {
            "scene": sessions.pack(context.session, scene, names),
            "note": None,
        }
        if event["event"] != "value" or event["key"] == "grid.n":
            changed["form"] = render_form(scene, names)
        return changed

    def written(context: Context, name: str, judged: Any) -> dict[str, Any]:
        """Write what the page shows as files."""
        criterion = (judged or {}).get("criterion", "smith_watson_topper")
        folder = sessions.folder_of(context.session)
        content = write_file(name, context.scene, context.names, criterion, folder)
        dcc = needed("dash.dcc", "explore")
        sent = dcc.send_bytes(content, name)
        return {"file": sent, "out": f"{name}: {len(content) / 1e3:.0f} kB"}

    app.clientside_callback(
        "function(number) { window.workbench.done(); return window.dash_clientside.no_update; }",
        dash.Output("done", "clear_data"),
        dash.Input("done", "data"),
        prevent_initial_call=True,
    )
    connect_contact(app, sessions)
    connect_answers(app, sessions, jobs)
    connect_files(app, sessions)
