"""The evidence book: published tests, predicted. One file for each publication."""

from __future__ import annotations

from typing import TYPE_CHECKING

from validation.experiments import (
    arnaud2021,
    arrest,
    baydoun2019,
    fouvry2007,
    fouvry2017,
    icf13,
    vanpeteghem2011,
)
from validation.experiments.page import NOT_READ

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from validation.experiments.page import Page

__all__ = ["PAGES", "write"]

#: The pages by their names.
PAGES: dict[str, Callable[[Path], Page]] = {
    "fouvry2007": fouvry2007.page,
    "fouvry2017": fouvry2017.page,
    "arnaud2021": arnaud2021.page,
    "baydoun2019": baydoun2019.page,
    "icf13": icf13.page,
    "arrest": arrest.page,
    "vanpeteghem2011": vanpeteghem2011.page,
}


def write(out: Path, only: list[str] | None = None) -> str:
    """Write the pages; returns their part of the front page."""
    rows = []
    for name, make in PAGES.items():
        if only is not None and name not in only:
            continue
        page = make(out)
        (out / f"{page.name}.md").write_text(page.text(), encoding="utf-8")
        rows.append(page.row())
        print(rows[-1], flush=True)
    head = "\n".join(["| test | predicted over measured | claims that hold |", "|---|---|---|"])
    text = "\n".join([head, *rows])
    found = (
        "How often `fret.fit` finds friction, a rig and a coating inside its confidence: "
        "[identification](identification.md)."
    )
    return f"## Published tests\n\n{NOT_READ}\n\n{text}\n\n{found}"
