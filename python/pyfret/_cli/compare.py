"""``fret compare FILE``: which of these coatings."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pyfret._cli.parser import added
from pyfret._cli.printing import print_json, print_text
from pyfret._cli.values import FIGURES, ending
from pyfret.study.compare_file import run_compare_file

if TYPE_CHECKING:
    import argparse

__all__ = ["add_options", "run"]


def add_options(commands: argparse._SubParsersAction[Any]) -> None:
    """Add the command and its options."""
    compare = added(commands, "compare", "put bodies side by side, such as several coatings")
    compare.add_argument("file", help="file of the comparison (TOML)")
    compare.add_argument("-o", "--out", help="store (default: the one in the file, or NAME.zarr)")
    compare.add_argument("--workers", type=int, help="processes (default: one for each processor)")
    compare.add_argument("--again", action="store_true", help="also bodies that failed before")
    compare.add_argument(
        "--figure",
        type=ending(*FIGURES),
        metavar="FILE",
        help="figure of all numbers (.png, .svg, .pdf)",
    )
    compare.add_argument(
        "--report", type=ending(".html"), metavar="FILE", help="page for a browser (.html)"
    )
    compare.add_argument("--json", action="store_true", help="print one JSON object")


def run(options: argparse.Namespace) -> int:
    """Compare and print the table; 1 where a body could not be solved."""
    comparison, store = run_compare_file(
        options.file, out=options.out, executor=options.workers, again=options.again
    )
    if options.json:
        d = comparison.dataset
        numbers = {
            name: {
                "unit": d[name].attrs["units"],
                "better": verdict.best,
                "worse": verdict.worse,
                "values": {
                    candidate: [float(d[f"{name}{side}"][n]) for side in ("_low", "", "_high")]
                    for n, candidate in enumerate(comparison.candidates)
                },
                "told": dict(zip(comparison.candidates, comparison.formatted(name), strict=True)),
                # What a margin is a mean over [m]: 0 for the value at a point.
                **({"L": d[f"{name}_L"].values.tolist()} if f"{name}_L" in d else {}),
            }
            for name, verdict in (
                (name, comparison.preference(name)) for name in comparison.numbers
            )
        }
        answer = {
            "store": str(store),
            "numbers": numbers,
            "missing": comparison.missing,
            "unanswered": comparison.unanswered,
        }
        print_json({**answer, "failed": comparison.failed}, indent=2)
    else:
        print_text(comparison.summary())
    if options.figure:
        comparison.plot().savefig(options.figure)
    if options.report:
        comparison.report(options.report)
    return 1 if comparison.failed else 0
