"""Variants side by side: a table with the differences beyond the errors, and overlaid figures."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._util.extras import needed
from pyfret.run.summary import directions
from pyfret.subsurface.line import fields_on, line_of, main_line
from pyfret.workbench.figures import DASHES, LOOPS
from pyfret.workbench.form import button, html
from pyfret.workbench.runs import curve, draw
from pyfret.workbench.theme import CURVES

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pyfret.workbench.answers import PageAnswer

__all__ = ["MOST", "curves_of", "draw_curves", "render_comparison", "verdict"]

#: Most variants, points of a curve.
MOST, POINTS = 4, 160


def thin_out(x: Any, y: Any) -> list[list[float]]:
    """Return a curve in at most as many points as are seen, in five digits."""
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    keep = np.unique(np.linspace(0, x.size - 1, min(x.size, POINTS)).round().astype(int))
    return [[float(f"{v:.5g}") for v in values[keep]] for values in (x, y)]


def curves_of(answer: PageAnswer) -> dict[str, Any]:
    """Return loop, pressure along the shear, and stress below the middle, for a pin."""
    d, last = answer.result.dataset, answer.result.at(-1)
    force, motion = LOOPS[next(iter(directions(answer.result)), "x")]
    line = main_line(last)
    cut = fields_on(last, line)
    curves = {
        "loop": thin_out(1e6 * d[motion].values, d[force].values),
        "p": thin_out(1e6 * cut[line.axis].values, 1e-6 * cut.p.values),
        "labels": {"loop": [f"{motion} [µm]", f"{force} [{d[force].attrs['units']}]"]},
    }
    if answer.below is not None:
        data = answer.below.dataset
        axis = line_of(data).axis
        middle = int(np.argmin(np.abs(data[axis].values - float(data[axis].values.mean()))))
        stress = answer.below.measure("von_mises").transpose("depth", axis).values[:, middle]
        curves["stress"] = thin_out(1e6 * data.z.values, 1e-6 * stress)
    return curves


def verdict(number: dict[str, Any], first: dict[str, Any] | None) -> str:
    """Return how a number differs from the first variant beyond both errors.

    "" where either has no error, or where their ranges overlap.
    """
    if first is None or number is first:
        return ""
    low, high = number.get("low"), number.get("high")
    first_low, first_high = first.get("low"), first.get("high")
    if low is None or high is None or first_low is None or first_high is None:
        return ""
    return "▲ larger" if low > first_high else "▼ smaller" if high < first_low else "no difference"


def render_comparison(pins: Sequence[dict[str, Any]]) -> list[Any]:
    """Make the table of the variants: a row for each number, a column for each variant."""
    h = html()
    if not pins:
        return [h.P("Nothing is pinned yet.")]
    names = list(dict.fromkeys(row["name"] for pin in pins for row in pin["numbers"]))
    heads = [
        h.Th(
            [
                h.Div(pin["name"]),
                button("Open", label=f"Open {pin['name']}", event="open-pin", n=str(n)),
                button("Remove", label=f"Remove {pin['name']}", event="unpin", n=str(n)),
            ],
            scope="col",
        )
        for n, pin in enumerate(pins)
    ]
    by_name = [{row["name"]: row for row in pin["numbers"]} for pin in pins]
    lines = []
    for name in names:
        rows = [table.get(name) for table in by_name]
        unit = next((row["unit"] for row in rows if row), "")
        cells = []
        for n, row in enumerate(rows):
            mark = verdict(row, rows[0]) if row and n else ""
            text = "" if row is None else row["text"]
            differs = mark[:1] in ("▲", "▼")
            cells.append(h.Td([text, h.Div(mark)], className="differs" if differs else ""))
        label = f"{name} [{unit}]" if unit else name
        lines.append(h.Tr([h.Th(label, scope="row"), *cells]))
    head = h.Thead(h.Tr([h.Th("number", scope="col"), *heads]))
    note = h.P(
        "Larger and smaller: than the first variant, beyond both errors. Without a mark one of the "
        "two has no error."
    )
    return [h.Table([head, h.Tbody(lines)]), note]


def draw_curves(pins: Sequence[dict[str, Any]], which: str) -> Any:
    """Overlay a curve of all variants."""
    go = needed("plotly.graph_objects", "explore")
    labels = {"p": ["x [µm]", "p [MPa]"], "stress": ["depth [µm]", "von Mises stress [MPa]"]}
    curves = []
    for n, pin in enumerate(pins):
        if which not in pin["curves"]:
            continue
        labels.setdefault(which, pin["curves"]["labels"]["loop"])
        x, y = pin["curves"][which]
        drawn = curve(x, y, f"{n + 1}. {pin['name']}")
        drawn["line"] = {"color": CURVES[n], "dash": DASHES[n], "width": 2}
        curves.append(drawn)
    return go.Figure(draw(curves, *labels.get(which, ["", ""])))
