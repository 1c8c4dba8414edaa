"""One spelling of the micrometre: µm in figures and pages, um in plain text."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).parents[1]
#: What is drawn: labels, titles, entries of a legend.
DRAWN = re.compile(r"\b(set_\w*label|set_title|[xyz]?label|title|suptitle)(\(|=|\s*=\s*)f?\"[^\"]*")


def test_figures_have_one_spelling_of_the_micrometre() -> None:
    count, wrong = 0, []
    for folder in (
        "python/pyfret/plot",
        "python/pyfret/what_if",
        "examples",
        "validation",
        "benches",
    ):
        for file in sorted((ROOT / folder).rglob("*.py")):
            for drawn in DRAWN.finditer(file.read_text(encoding="utf-8")):
                count += 1
                if re.search(r"\bum\b|\\mu ?\\?,?\s*\\?m(athrm)?\b|\u03bcm", drawn[0]):
                    wrong.append(f"{file.relative_to(ROOT)}: {drawn[0]}")
    assert count > 100
    assert wrong == []
