"""Second and third tab: preview, full answer, life and crack, background runs, variants."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pyfret._util.extras import needed
from pyfret.workbench.answers import REFUSALS, PageAnswer, answer_in_full, preview, solve_in_full
from pyfret.workbench.doubts import doubt_of_sentence
from pyfret.workbench.figures import draw_loop, draw_stress, draw_tractions, draw_zones
from pyfret.workbench.form import button
from pyfret.workbench.judgements import crack_verdict, first_yield, life_of
from pyfret.workbench.names import layer_labels, names_of
from pyfret.workbench.render import render_doubt, render_headline, render_jobs, render_numbers
from pyfret.workbench.variants import draw_curves, render_comparison

if TYPE_CHECKING:
    from pyfret.workbench.jobs import Jobs
    from pyfret.workbench.sessions import Sessions

__all__ = ["connect_answers"]

#: Scene and criterion to judge while the second tab is shown, each pair once.
JUDGE = """function(scene, tab, event, before) {
  const chosen = event && event.event === "criterion" ? event.value : null;
  const criterion = chosen || (before ? before.criterion : "smith_watson_topper");
  const next = {scene, criterion};
  const same = JSON.stringify(next) === JSON.stringify(before);
  return tab !== "answers" || same ? window.dash_clientside.no_update : next;
}"""


def connect_answers(app: Any, sessions: Sessions, jobs: Jobs) -> None:
    """Connect answers, judgements, background runs and variants."""
    dash = needed("dash", "explore")

    def outputs(*, again: bool) -> list[Any]:
        """List the outputs of an answer."""
        slots = [
            ("state", "children"),
            ("headline", "children"),
            ("run-doubts", "children"),
            ("numbers", "children"),
            ("figure-loop", "figure"),
            ("figure-zones", "figure"),
            ("figure-tractions", "figure"),
            ("figure-stress", "figure"),
        ]
        return [dash.Output(*slot, allow_duplicate=again) for slot in slots]

    def shown(answer: PageAnswer, scene: Any, names: dict[str, str], state: str) -> list[Any]:
        """Return the contents of the outputs for an answer."""
        rows = [number.as_row() for number in answer.numbers]
        at_fields = scene.doubts()
        doubts = [doubt_of_sentence(scene, text) for text in answer.doubts if text not in at_fields]
        result = answer.result
        figures = [draw_loop(result), draw_zones(result), draw_tractions(result)]
        labels = layer_labels(scene, names)
        figures.append(
            {} if answer.below is None else draw_stress(answer.below, labels, answer.marks)
        )
        headline, doubted = render_headline(rows), render_doubt(doubts)
        if at_fields:
            text = (
                f"{len(at_fields)} doubts at the fields" if at_fields[1:] else "1 doubt at a field"
            )
            doubted.append(button(text, event="show", name="contact"))
        return [state, headline, doubted, render_numbers(rows), *figures]

    def refused(scene: Any, error: Exception) -> list[Any]:
        """Return the contents of the outputs for a refusal."""
        doubt = doubt_of_sentence(scene, str(error))
        return ["no answer", dash.no_update, render_doubt([doubt]), *[dash.no_update] * 5]

    app.clientside_callback(
        "function(scene, before) { return JSON.stringify(scene) === JSON.stringify(before) ? "
        "window.dash_clientside.no_update : 'solving ...'; }",
        dash.Output("state", "children", allow_duplicate=True),
        dash.Input("scene", "data"),
        dash.State("previewed", "data"),
        prevent_initial_call=True,
    )

    @app.callback(  # type: ignore[untyped-decorator]
        *outputs(again=False),
        dash.Output("previewed", "data"),
        dash.Input("scene", "data"),
        dash.Input("session", "data"),
        dash.State("counts", "data"),
        dash.State("previewed", "data"),
        prevent_initial_call=True,
    )
    def show_preview(packed: Any, session: Any, counts: Any, before: Any) -> list[Any]:
        """Answer in few increments."""
        if not session or packed == before:
            raise dash.exceptions.PreventUpdate
        scene, names = sessions.unpack(session, packed)
        names = names_of(scene, names)
        sessions.want(session, scene.to_toml())
        try:
            answer = preview(scene, counts)
        except REFUSALS as error:
            return [*refused(scene, error), packed]
        increments = answer.result.dataset.sizes["increment"]
        state = f"preview: {increments} increments, estimates; the full answer follows"
        return [*shown(answer, scene, names, state), packed]

    @app.callback(  # type: ignore[untyped-decorator]
        *outputs(again=True),
        dash.Output("counts", "data"),
        dash.Output("solved", "data"),
        dash.Input("previewed", "data"),
        dash.State("session", "data"),
        prevent_initial_call=True,
    )
    def show_full(packed: Any, session: Any) -> list[Any]:
        """Answer in full, with errors."""
        scene, names = sessions.unpack(session, packed)
        names = names_of(scene, names)
        if not sessions.wants(session, scene.to_toml()):
            raise dash.exceptions.PreventUpdate
        try:
            answer = answer_in_full(scene, names)
        except REFUSALS as error:
            return [*refused(scene, error), dash.no_update, None]
        grid = scene.grid
        cells = f"{grid.nx}" if grid.plane_strain else f"{grid.nx} x {grid.ny}"
        state = f"full answer: {cells} cells, {sum(answer.counts)} increments, errors estimated"
        return [*shown(answer, scene, names, state), answer.counts, packed]

    # A server call that begins anew loses its answer: the browser decides when to judge.
    app.clientside_callback(
        JUDGE,
        dash.Output("judging", "data"),
        dash.Input("solved", "data"),
        dash.Input("tab", "data"),
        dash.Input("event", "data"),
        dash.State("judging", "data"),
        prevent_initial_call=True,
    )

    @app.callback(  # type: ignore[untyped-decorator]
        dash.Output("life", "children"),
        dash.Output("judged", "data"),
        dash.Input("judging", "data"),
        dash.State("session", "data"),
        prevent_initial_call=True,
    )
    def judge(judging: Any, session: Any) -> list[Any]:
        """Judge first yield and life, which take seconds, while the second tab is shown."""
        packed, criterion = judging["scene"], judging["criterion"]
        if not packed:
            return ["no answer yet", {"criterion": criterion}]
        scene, names = sessions.unpack(session, packed)
        names = names_of(scene, names)
        if not sessions.wants(session, scene.to_toml()):
            raise dash.exceptions.PreventUpdate
        result = solve_in_full(scene)
        rows = [first_yield(result, names).as_row(), life_of(result, names, criterion).as_row()]
        return [render_numbers(rows), {"criterion": criterion, "scene": packed}]

    @app.callback(  # type: ignore[untyped-decorator]
        dash.Output("crack", "children"),
        dash.Input("judged", "data"),
        dash.State("session", "data"),
        prevent_initial_call=True,
    )
    def judge_crack(judged: Any, session: Any) -> Any:
        """Judge a crack, after the life."""
        packed = (judged or {}).get("scene")
        if not packed:
            return ""
        scene, names = sessions.unpack(session, packed)
        names = names_of(scene, names)
        if not sessions.wants(session, scene.to_toml()):
            raise dash.exceptions.PreventUpdate
        return render_numbers([crack_verdict(solve_in_full(scene), names).as_row()])

    @app.callback(  # type: ignore[untyped-decorator]
        dash.Output("jobs", "children"),
        dash.Output("tick", "disabled"),
        dash.Input("tick", "n_intervals"),
        dash.Input("session", "data"),
        dash.Input("note", "data"),
        prevent_initial_call=True,
    )
    def show_jobs(_: Any, session: Any, note: Any) -> list[Any]:
        """Show the background runs of the browser, and why one could not start."""
        if not session:
            raise dash.exceptions.PreventUpdate
        listed = jobs.jobs_of(session)
        children = render_jobs(listed)
        if note and note["key"] == "run":
            html = needed("dash.html", "explore")
            children.insert(0, html.Div(html.Div(note["sentence"]), className="doubt"))
        return [children, not any(job.running() for job in listed)]

    @app.callback(  # type: ignore[untyped-decorator]
        dash.Output("comparison", "children"),
        dash.Output("comparison-figures", "hidden"),
        dash.Output("figure-compare-loop", "figure"),
        dash.Output("figure-compare-p", "figure"),
        dash.Output("figure-compare-stress", "figure"),
        dash.Input("pins", "data"),
    )
    def compare(pins: Any) -> list[Any]:
        """Show the variants side by side."""
        pins = pins or []
        figures = [draw_curves(pins, which) for which in ("loop", "p", "stress")]
        return [render_comparison(pins), not pins, *figures]
