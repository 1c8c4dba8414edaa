"""``fret table``: a result as a table, printed or written."""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING, Any

from pyfret._cli.parser import added
from pyfret._cli.printing import print_data, print_json, print_text
from pyfret._cli.values import ending
from pyfret._util.csv_table import Tabular
from pyfret._util.numbers import format_number
from pyfret._util.window import format_table, terminal_width
from pyfret.opening import open as open_any

if TYPE_CHECKING:
    import argparse

    import pandas as pd

__all__ = ["add_options", "run"]

#: Endings of tables.
TABLES = (".csv", ".xlsx")


def add_options(commands: argparse._SubParsersAction[Any]) -> None:
    """Add the command and its options."""
    command = added(commands, "table", "print a result as a table, or write it (.csv, .xlsx)")
    command.add_argument("store", help="result of a run, of wear, of a study, or what save() wrote")
    command.add_argument(
        "--of",
        metavar="TABLE",
        help="increments, branches, loops or error_bars of a run, jumps or loops of wear "
        "(default: the first)",
    )
    command.add_argument(
        "-o",
        "--out",
        type=ending(*TABLES),
        metavar="FILE",
        help="file to write (.csv, .xlsx); it is replaced; a workbook has all tables",
    )
    command.add_argument("--json", action="store_true", help="print one JSON object")


def run(options: argparse.Namespace) -> int:
    """Print the table of a result, or write it."""
    result = open_any(options.store)
    if not isinstance(result, Tabular):
        raise ValueError(f"{options.store}: has no tables")
    if options.out and options.out.lower().endswith(".xlsx"):
        result.to_excel(options.out, of=options.of)
    elif options.out:
        result.to_csv(options.out, of=options.of)
    frame = result.to_dataframe(options.of)
    if options.json:
        rows = json.loads(frame.to_json(orient="records"))
        print_json({"store": options.store, "file": options.out, "rows": rows})
    elif options.out:
        print_text(f"{options.out}: {len(frame)} rows, {frame.shape[1]} columns")
    else:
        print_frame(frame)
    return 0


def print_frame(frame: pd.DataFrame) -> None:
    """Print a table: aligned on a terminal, with commas into a file or another program."""
    if terminal_width(sys.stdout) is None:
        print_data(frame.to_csv(index=False, lineterminator="\n").rstrip("\n"))
        return
    rows = [[format_number(value) for value in row] for row in frame.itertuples(index=False)]
    print_text(format_table([str(title).replace(" [", "\n[") for title in frame.columns], rows))
