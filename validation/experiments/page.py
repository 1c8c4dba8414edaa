"""A page of a published test: conditions, data, prediction, verdict."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import matplotlib.pyplot as plt
import numpy as np

import pyfret as fret
from validation.pages import DPI

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence
    from pathlib import Path

    from pyfret.experiments import Experiment

__all__ = ["Claim", "Page", "drawn", "factor", "spread", "table"]

NOT_READ = (
    "The numbers are facts of the papers cited, typed from tables or read off figures by others "
    "and converted to SI units; none of the papers was read in full."
)


@dataclass(frozen=True)
class Claim:
    """What was asked before the comparison, what came out, and whether it holds."""

    of: str
    asked: str
    found: str
    holds: bool

    def row(self) -> list[str]:
        """As a row of a table."""
        return [self.of, self.asked, self.found, "yes" if self.holds else "**no**"]


@dataclass(frozen=True)
class Page:
    """A page of the book."""

    name: str
    title: str
    test: Experiment
    conditions: str
    fitted: str
    predicted: str
    comparison: Sequence[str]
    claims: Sequence[Claim]
    verdict: str

    def text(self) -> str:
        """The page in Markdown."""
        parts = [
            f"# {self.title}",
            f"{self.test.citation}. {NOT_READ}",
            "## Conditions",
            self.conditions,
            "Misprints of the paper, and choices:",
            "\n".join(f"- {remark}" for remark in self.test.remarks),
            "## What is fitted, what is predicted",
            f"**Fitted or taken from the test:** {self.fitted}",
            f"**Predicted:** {self.predicted}",
            "## Prediction and measurement",
            *self.comparison,
            "## Verdict",
            table(["of", "asked before", "found", "holds"], [claim.row() for claim in self.claims]),
            self.verdict,
        ]
        return "\n\n".join(parts) + "\n"

    def row(self) -> str:
        """The row of the front page."""
        held = sum(claim.holds for claim in self.claims)
        found = "; ".join(f"{claim.of}: {claim.found}" for claim in self.claims)
        count = f"{held} of {len(self.claims)}"
        return f"| [{self.title}]({self.name}.md) | {found} | {count} |"


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table in Markdown."""
    lines = ["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
    return "\n".join([*lines, *("| " + " | ".join(row) + " |" for row in rows)])


def spread(ratios: Sequence[float], within: float) -> str:
    """Mean, scatter and count of ratios."""
    r = np.array(ratios)
    inside = int(np.sum(np.abs(r - 1) <= within))
    return (
        f"mean {r.mean():.2f}, sd {r.std(ddof=1):.2f}, {inside} of {r.size} within "
        f"{100 * within:.0f} %"
    )


def factor(ratios: Sequence[float], by: float) -> str:
    """How many ratios lie within a factor."""
    logs = np.abs(np.log(ratios))
    return f"{int(np.sum(logs <= np.log(by)))} of {len(ratios)} within a factor {by:g}"


def drawn(out: Path, name: str, draw: Callable[[Any], None]) -> str:
    """A figure of a page, as Markdown."""
    with fret.plot.style():
        figure, ax = plt.subplots(figsize=(5.4, 3.6), layout="constrained")
        draw(ax)
        figure.savefig(out / f"{name}.png", dpi=DPI)
        plt.close(figure)
    return f"![{name}]({name}.png)"
