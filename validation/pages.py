"""Pages as Markdown with figures."""

from __future__ import annotations

import math
from itertools import cycle
from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
from PIL import Image

import pyfret as fret
from validation.truth import LEFT_BY_CELLS

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from validation.runner import Ladder, Outcome

#: Resolution of the figures.
DPI = 110
#: Colours of the figures.
COLOURS = 128
#: Markers of curves, whose colours repeat after seven.
MARKERS = "os^Dv<>P"


def percent(error: float) -> str:
    """An error in per cent, two digits."""
    return f"{100 * error:+.2g} %"


def table(ladder: Ladder, counted: str, order: Callable[[str], float] | None) -> str:
    """Errors of every number at every size, its order, and the processor time."""
    names = ladder.names()
    rows = [
        "| " + " | ".join([counted, *names, "processor time"]) + " |",
        "|---" * (len(names) + 2) + "|",
    ]
    for n, (size, seconds) in enumerate(zip(ladder.sizes, ladder.seconds, strict=True)):
        errors = [percent(ladder.errors(name)[n]) for name in names]
        rows.append("| " + " | ".join([str(size), *errors, f"{seconds:.2f} s"]) + " |")
    if order is not None:
        found = [order(name) for name in names]
        shown = ["" if math.isnan(order) else f"{order:.1f}" for order in found]
        rows.append("| " + " | ".join(["observed order", *shown, ""]) + " |")
    return "\n".join(rows)


def whole_decades(limits: tuple[float, float]) -> tuple[float, float]:
    """Widen the limits of a logarithmic axis to powers of ten, so that two have labels."""
    low, high = (math.log10(limit) for limit in limits)
    return 10.0 ** math.floor(low), 10.0 ** math.ceil(high)


def convergence(outcome: Outcome, file: Path) -> None:
    """Draw the errors against the number of cells and of increments."""
    ladders = [(outcome.grids, "cells a side")]
    if outcome.increments is not None:
        ladders.append((outcome.increments, "increments"))
    if outcome.placed is not None:
        ladders.append((outcome.placed, f"cells a side, mean of {outcome.truth.places} places"))
    with fret.plot.style():
        figure, row = plt.subplots(
            1, len(ladders), figsize=(1.6 + 3.8 * len(ladders), 3.2), squeeze=False
        )
        for ax, (ladder, counted) in zip(row[0], ladders, strict=True):
            for name, marker in zip(ladder.names(), cycle(MARKERS)):
                errors = [abs(error) for error in ladder.errors(name)]
                if max(errors) > 0:
                    ax.loglog(ladder.sizes, errors, f"{marker}-", label=name)
            top = max(abs(e) for name in ladder.names() for e in ladder.errors(name))
            for power, dash in ((1, ":"), (2, "--")):
                slope = [top * (ladder.sizes[0] / n) ** power for n in ladder.sizes]
                ax.loglog(ladder.sizes, slope, dash, color="0.6", lw=0.9, label=f"order {power}")
            ax.set(xlabel=counted, ylabel="error")
            ax.set_xticks(ladder.sizes, [str(n) for n in ladder.sizes])
            ax.minorticks_off()
            ax.set_ylim(whole_decades(ax.get_ylim()))
        row[0][-1].legend(fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5))
        figure.savefig(file, dpi=DPI)
        plt.close(figure)


def write(outcome: Outcome, folder: Path) -> None:
    """Write the page of a truth and its two figures."""
    truth = outcome.truth
    with fret.plot.style():
        figure = plt.figure(figsize=(8.4, 3.5))
        truth.draw(figure, outcome.finest)
        figure.savefig(folder / f"{truth.name}.png", dpi=DPI)
        plt.close(figure)
    convergence(outcome, folder / f"{truth.name}_error.png")
    finest = outcome.grids.known[-1]
    numbers = ["| number | ours | truth | error | estimated error |", "|---|---|---|---|---|"]
    bars = outcome.grids.bars[-1]
    for name, known in finest.items():
        size = abs(known.truth if known.scale is None else known.scale)
        bar = f"{100 * bars[name] / size:.2g} %" if name in bars else ""
        numbers.append(
            f"| {name} | {known.ours:.6g} | {known.truth:.6g} | {percent(known.error)} | {bar} |"
        )
    parts = [
        f"# {truth.title}",
        truth.law,
        f"![ours and the truth]({truth.name}.png)",
        f"On {outcome.grids.sizes[-1]} cells a side:",
        "\n".join(numbers),
        "## Error against the grid",
        table(
            outcome.grids, "cells a side", outcome.grids.order if outcome.placed is None else None
        ),
    ]
    if outcome.increments is not None:
        steps = outcome.increments
        parts += [
            "## Error against the increments",
            table(steps, "increments", steps.order_along_path),
            ("" if truth.path_places == 1 else f"Root mean square over {truth.path_places} grids. ")
            + f"The order is taken over errors more than {LEFT_BY_CELLS} times what is left with "
            "the most increments, which the cells leave; none where fewer than two are.",
        ]
    if outcome.placed is not None:
        parts += [
            "## Error over the places of the rim within the cells",
            f"Root mean square over {truth.places} grids whose cells differ by up to a tenth: "
            "single runs go up and down by where the rim lies in its cells, so that only their "
            "mean has an order.",
            table(outcome.placed, "cells a side", outcome.placed.order),
        ]
    parts += [f"![errors]({truth.name}_error.png)"]
    if truth.remark:
        parts.append(truth.remark)
    parts += ["## Scene", f"```toml\n{outcome.finest.scene.to_toml().strip()}\n```"]
    parts.append("[All pages](README.md)")
    (folder / f"{truth.name}.md").write_text("\n\n".join(parts) + "\n", encoding="utf-8")


def shrink(folder: Path) -> None:
    """Save the new figures of a folder in few colours: a third of their size."""
    for file in folder.glob("*.png"):
        with Image.open(file) as image:
            if image.mode == "P":
                continue
            few = image.convert("RGB").quantize(COLOURS)
        few.save(file, optimize=True)


def front_row(outcome: Outcome) -> str:
    """The line of a truth on the front page."""
    name, error = outcome.worst
    grids = outcome.grids
    order = outcome.ordered.order(name)
    shown = "" if math.isnan(order) else f"{order:.1f}"
    truth = outcome.truth
    return (
        f"| [{truth.title}]({truth.name}.md) | {grids.sizes[-1]} | {name} | {percent(error)} "
        f"| {shown} | {grids.seconds[-1]:.2f} s |"
    )
