"""Fourth tab: cards of dropped files, and the fit to those that were measured."""

from __future__ import annotations

import secrets
import shutil
from typing import TYPE_CHECKING, Any

from pyfret._util.extras import needed
from pyfret.workbench.file_views import render_file
from pyfret.workbench.form import button, html, select
from pyfret.workbench.layout import field
from pyfret.workbench.uploads import drop_folder, dropped_path

if TYPE_CHECKING:
    from pathlib import Path

    from pyfret.workbench.sessions import Sessions

__all__ = ["adopt_measured", "connect_files"]


def adopt_measured(sessions: Sessions, session: str, measured: Path) -> dict[str, str]:
    """Copy the measured file of the command line to a browser, as if it were dropped."""
    drop = secrets.token_hex(8)
    shutil.copyfile(measured, drop_folder(sessions, session, drop) / measured.name)
    return {"id": drop, "name": measured.name}


def fit_form() -> Any:
    """Make the form of a fit."""
    h = html()
    bodies = [("2", "lower body"), ("1", "upper body")]
    return h.Fieldset(
        [
            h.Legend("From a loop the friction, from a scar the wear, from both a depth"),
            select("fit-rig", "stiffness of the rig", [("no", "known"), ("yes", "unknown")], "no"),
            select("fit-body", "body with the scar", bodies, "2"),
            field("fit-cycles", "cycles of the scar", "1e5"),
            field("fit-predict", "predict the depth after so many cycles", "1e6"),
            h.Div(
                [
                    button("Fit", event="fit"),
                    button("Show the result", event="show", name="answers"),
                ],
                className="buttons",
            ),
        ]
    )


def connect_files(app: Any, sessions: Sessions) -> None:
    """Connect the cards to the list of dropped files."""
    dash = needed("dash", "explore")

    @app.callback(  # type: ignore[untyped-decorator]
        dash.Output("files", "children"),
        dash.Input("dropped", "data"),
        dash.Input("session", "data"),
        prevent_initial_call=True,
    )
    def show(dropped: Any, session: Any) -> list[Any]:
        """Show the files of the browser, the last first."""
        if not session:
            raise dash.exceptions.PreventUpdate
        cards = []
        for drop in (dropped or [])[::-1]:
            try:
                path = dropped_path(sessions, session, drop["id"], drop["name"])
            except ValueError as error:
                cards.append(html().P(str(error)))
                continue
            cards.append(render_file(path, drop))
        return [fit_form(), *cards] if cards else []
