"""Numbers, doubts and background runs as elements of the page."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pyfret._util.extras import needed
from pyfret.workbench.form import button, html

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from pyfret.workbench.doubts import Doubt
    from pyfret.workbench.jobs import Job

__all__ = ["render_doubt", "render_headline", "render_jobs", "render_numbers"]

#: Beginnings of the names of the numbers of the headline.
HEADLINE = ("largest", "stick ratio", "energy of", "state")


def with_unit(row: dict[str, Any]) -> str:
    """Return a number with its unit."""
    return f"{row['text']} {row['unit']}".strip() if row["value"] is not None else row["text"]


def value_attribute(row: dict[str, Any]) -> dict[str, str]:
    """Return the value of a number for programs; a number without a value has none."""
    return {} if row["value"] is None else {"data-value": repr(row["value"])}


def render_headline(rows: Sequence[dict[str, Any]]) -> list[Any]:
    """Make the cards of the largest numbers."""
    h = html()
    return [
        h.Div([h.Dt(row["name"]), h.Dd(with_unit(row), **value_attribute(row))])
        for row in rows
        if row["name"].startswith(HEADLINE)
    ]


def render_numbers(rows: Sequence[dict[str, Any]]) -> Any:
    """Make a table of numbers: name, value with its error and unit, and notes if there are any."""
    h = html()
    has_notes = any(row["note"] for row in rows)
    titles = ("number", "value with error", *(("note",) if has_notes else ()))
    lines = []
    for row in rows:
        data = {"data-number": row["name"], **value_attribute(row)}
        cells = [h.Th(row["name"], scope="row"), h.Td(with_unit(row), **data)]
        if has_notes:
            cells.append(h.Td(row["note"], className="note"))
        lines.append(h.Tr(cells))
    heads = h.Tr([h.Th(text, scope="col") for text in titles])
    return h.Table([h.Thead(heads), h.Tbody(lines)])


def render_doubt(doubts: Iterable[Doubt]) -> list[Any]:
    """Make doubts with the buttons that remove them."""
    import json

    h = html()
    boxes = []
    for doubt in doubts:
        parts: list[Any] = [doubt.sentence]
        if doubt.button:
            values = json.dumps(doubt.values)
            parts.append(h.Div(button(doubt.button, event="remedy", changes=values)))
        boxes.append(h.Div(parts))
    return boxes


def render_job(job: Job) -> Any:
    """Make the card of a run in the background: its progress, or what it came to."""
    h, dcc = html(), needed("dash.dcc", "explore")
    head: list[Any] = [h.H3(job.title)]
    if job.running():
        head.append(button("Cancel", label=f"Cancel {job.title}", event="cancel", id=job.id))
        done, total = job.progress()
        label = {"aria-label": f"Progress of {job.title}"}
        bar = h.Progress(value=str(done), max=str(total), **label) if total else h.Progress(**label)
        counts = h.P(f"{done} of {total}" if total else "running")
        return h.Div([h.Div(head, className="head"), bar, counts], className="card running")
    outcome = job.result()
    if "refused" in outcome:
        reason = h.Div(h.Div(outcome["refused"]), className="doubt")
        return h.Div([h.Div(head, className="head"), reason], className="card ended")
    if "scene" in outcome:
        head.append(button("Open its scene", event="open-job", id=job.id))
    config = {"displayModeBar": False, "responsive": True}
    graphs = [
        h.Figure(
            [
                dcc.Graph(figure=figure, config=config, className="plot", responsive=True),
                h.Figcaption(caption),
            ]
        )
        for caption, figure in outcome["figures"]
    ]
    doubts = h.Div([h.Div(doubt) for doubt in outcome["doubts"]], className="doubt")
    parts = [
        h.Div(head, className="head"),
        h.Div(render_numbers(outcome["numbers"]), className="wide"),
        doubts,
        h.Div(graphs, className="figures"),
    ]
    return h.Div(parts, className="card ended")


def render_jobs(jobs: Sequence[Job]) -> list[Any]:
    """Make the cards of all runs of a browser."""
    return [render_job(job) for job in jobs]
