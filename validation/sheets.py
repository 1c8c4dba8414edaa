"""What a page about a published test is made of."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import matplotlib.pyplot as plt

import pyfret as fret
from validation.pages import DPI

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from pyfret import experiments

__all__ = ["Page", "drawn", "remarks", "table"]


@dataclass(frozen=True)
class Page:
    """A page: its title, its text, and a line of the verdict."""

    name: str
    title: str
    text: list[str]
    verdict: str


def table(head: list[str], rows: list[list[str]]) -> str:
    """A table in Markdown."""
    lines = ["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def remarks(test: experiments.Experiment) -> str:
    """Misprints and choices as a list."""
    return "\n".join(f"- {remark}" for remark in test.remarks)


def drawn(out: Path, name: str, draw: Callable[[Any], None]) -> str:
    """A figure of a page."""
    with fret.plot.style():
        figure, ax = plt.subplots(figsize=(5.4, 3.6), layout="constrained")
        draw(ax)
        figure.savefig(out / f"{name}.png", dpi=DPI)
        plt.close(figure)
    return f"![{name}]({name}.png)"
