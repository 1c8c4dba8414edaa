"""One three-component convolution against its six transforms by FFTW."""

from __future__ import annotations

import csv
from typing import TYPE_CHECKING, Any

from environment import Peers, Refused, run_example, run_python

if TYPE_CHECKING:
    from collections.abc import Sequence

    Row = dict[str, Any]

#: Both take turns so often, and the best counts: what slows the machine for a while slows both.
ROUNDS = 3


def measure(peers: Peers, sizes: Sequence[int], rounds: int = ROUNDS) -> list[Row]:
    """Times of both at every size [s]."""
    arguments = [str(n) for n in sizes]
    rows: dict[int, Row] = {n: {"cells": n} for n in sizes}

    def take(cells: int, column: str, seconds: float) -> None:
        row = rows[cells]
        row[column] = min(seconds, row.get(column, seconds))

    for _ in range(rounds):
        said = run_example("convolution_time", arguments)
        for line in csv.DictReader(said.splitlines()):
            take(int(line["cells"]), f"threads_{line['threads']}", float(line["seconds"]))
        try:
            if "pyFFTW" in peers.missing:
                raise Refused(f"not installed: {peers.missing['pyFFTW']}")
            for line in run_python(peers.python, "run_fftw.py", arguments, threads=1):
                take(line["cells"], "fftw", line["seconds"])
                rows[line["cells"]] |= {"version": line["version"]}
        except Refused as reason:
            for row in rows.values():
                row["missing"] = str(reason)
    return list(rows.values())
