"""Write the book: ``python -m validation --out docs/validation``."""

from __future__ import annotations

import argparse
import os
from pathlib import Path

import numpy as np

import pyfret as fret
from validation import (
    coated_line,
    elements,
    experiments,
    finite_elements,
    kernels,
    pages,
    paper,
    path_order,
    rows,
    wear,
    work_precision,
)
from validation.runner import run
from validation.truths import TRUTHS

#: Pages that are no truths.
OTHERS = (
    "path_order",
    "rows",
    "wear",
    "kernels",
    "elements",
    "finite_elements",
    "coated_line",
    "experiments",
    "paper",
    "work_precision",
)
#: Cells a side of the paper's runs, and of a quick look.
CELLS, WORK_CELLS, QUICK_CELLS = 256, 64, 32


def main() -> None:
    """Solve everything and write all pages and the front page."""
    parser = argparse.ArgumentParser(description="The validation book, from runs.")
    parser.add_argument("--out", type=Path, default=Path("docs/validation"), help="its folder")
    parser.add_argument("--quick", action="store_true", help="coarse grids only, for a look")
    names = [truth.name for truth in TRUTHS]
    parser.add_argument("--only", nargs="+", choices=[*names, *OTHERS], help="these pages alone")
    options = parser.parse_args()
    out: Path = options.out
    out.mkdir(parents=True, exist_ok=True)
    started = processor_time()
    lines = []
    ratios: list[float] = []
    for truth in TRUTHS:
        if options.only is None or truth.name in options.only:
            outcome = run(truth, quick=options.quick)
            pages.write(outcome, out)
            lines.append(pages.front_row(outcome))
            ratios += outcome.grids.honesty()
            print(lines[-1], flush=True)
    if options.only is None or "path_order" in options.only:
        lines.append(path_order.write(out, quick=options.quick))
        print(lines[-1], flush=True)
    if options.only is None or "rows" in options.only:
        lines.append(rows.write(out, n=QUICK_CELLS * 2 if options.quick else rows.CELLS))
        print(lines[-1], flush=True)
    if options.only is None or "wear" in options.only:
        lines.append(wear.write(out, quick=options.quick))
        print(lines[-1], flush=True)
    if options.only is None or "kernels" in options.only:
        lines.append(kernels.write(out))
        print(lines[-1], flush=True)
    figures, others = [], []
    if options.only is None or "elements" in options.only:
        others.append(elements.write(out, quick=options.quick))
    if options.only is None or "finite_elements" in options.only:
        others.append(finite_elements.write(out, quick=options.quick))
        print(others[-1], flush=True)
    if options.only is None or "coated_line" in options.only:
        others.append(coated_line.write(out, quick=options.quick))
        print(others[-1], flush=True)
    if options.only is None or "experiments" in options.only:
        others.append(experiments.write(out))
    if options.only is None or "paper" in options.only:
        figures = paper.write(out, n=QUICK_CELLS if options.quick else CELLS)
        print(*figures, sep="\n", flush=True)
    if options.only is None or "work_precision" in options.only:
        others.append(work_precision.write(out, n=QUICK_CELLS if options.quick else WORK_CELLS))
    pages.shrink(out)
    if options.only is None:
        seconds = processor_time() - started
        front(out, lines, figures, [honesty(ratios), *others], seconds)
        print(f"{seconds:.0f} s")


def processor_time() -> float:
    """Return the time of a processor that this process and its children have used [s]."""
    used = os.times()
    return used.user + used.system + used.children_user + used.children_system


def honesty(ratios: list[float]) -> str:
    """What true over estimated errors of all numbers and grids come to."""
    low, middle, high = np.quantile(ratios, (0.05, 0.5, 0.95))
    within = 100 * np.mean([0.2 <= ratio <= 1.5 for ratio in ratios])
    over = 100 * np.mean([ratio > 1.5 for ratio in ratios])
    return (
        f"Error bars (`fret run --error`) of {len(ratios)} numbers: true over estimated error is "
        f"{middle:.2f} in the middle, {low:.2f} to {high:.2f} in nine tenths; between 0.2 and 1.5 "
        f"in {within:.0f} % and above in {over:.0f} %. Why not more of "
        "them: [Error bars against true errors](../error_bars.md)."
    )


def front(
    folder: Path, rows: list[str], figures: list[str], others: list[str], seconds: float
) -> None:
    """Write the front page."""
    parts = [
        "# Validation",
        f"Every page is written by `make validation` from runs of pyfret {fret.__version__}; all "
        f"of them took {seconds:.0f} s of a processor. Errors are ours less the truth, over the "
        "truth; errors of fields are L2 norms over the cells. The order is the power of the error "
        "in the number of cells a side, over several places of the rim within the cells where "
        "these matter; the processor time is for one run and one on half as many cells, for "
        "its error bars.",
        "\n".join(
            [
                "| truth | cells a side | largest error: of | error | order | processor time |",
                "|---|---|---|---|---|---|",
                *rows,
            ]
        ),
        *others,
        "## The paper's figures",
        "\n".join(["| figure | the paper | ours |", "|---|---|---|", *figures]),
    ]
    (folder / "README.md").write_text("\n\n".join(parts) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
