"""Write the book: ``python -m validation --out docs/validation``."""

from __future__ import annotations

import argparse
import time
from pathlib import Path

import pyfret as fret
from validation import pages, paper
from validation.runner import run
from validation.truths import TRUTHS

#: Cells a side of the paper's runs, and of a quick look.
CELLS, QUICK_CELLS = 256, 32


def main() -> None:
    """Solve everything and write all pages and the front page."""
    parser = argparse.ArgumentParser(description="The validation book, from runs.")
    parser.add_argument("--out", type=Path, default=Path("docs/validation"), help="its folder")
    parser.add_argument("--quick", action="store_true", help="coarse grids only, for a look")
    names = [truth.name for truth in TRUTHS]
    parser.add_argument("--only", nargs="+", choices=[*names, "paper"], help="these pages alone")
    options = parser.parse_args()
    out: Path = options.out
    out.mkdir(parents=True, exist_ok=True)
    started = time.perf_counter()
    rows = []
    for truth in TRUTHS:
        if options.only is None or truth.name in options.only:
            outcome = run(truth, quick=options.quick)
            pages.write(outcome, out)
            rows.append(pages.front_row(outcome))
            print(rows[-1], flush=True)
    figures = []
    if options.only is None or "paper" in options.only:
        figures = paper.write(out, n=QUICK_CELLS if options.quick else CELLS)
        print(*figures, sep="\n", flush=True)
    if options.only is None:
        seconds = time.perf_counter() - started
        front(out, rows, figures, seconds)
        print(f"{seconds:.0f} s")


def front(folder: Path, rows: list[str], figures: list[str], seconds: float) -> None:
    """Write the front page."""
    parts = [
        "# Validation",
        f"Every page is written by `make validation` from runs of pyfret {fret.__version__}; all of "
        f"them took {seconds:.0f} s. Errors are ours less the truth, over the truth; those of fields "
        "are L2 norms over the cells. The order is that of the error in the number of cells a side.",
        "\n".join(
            [
                "| truth | cells a side | largest error: of | error | order | run time |",
                "|---|---|---|---|---|---|",
                *rows,
            ]
        ),
        "## The paper's figures",
        "\n".join(["| figure | the paper says | ours |", "|---|---|---|", *figures]),
    ]
    (folder / "README.md").write_text("\n\n".join(parts) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
