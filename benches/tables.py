"""Tables of what was measured, and documents that hold them between marks."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    Row = dict[str, Any]


def table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A Markdown table; numbers stand at the right."""
    rules = ["---", *["---:"] * (len(heads) - 1)]
    filled = [[*row, *[""] * (len(heads) - len(row))] for row in rows]
    lines = [heads, rules, *filled]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def seconds(value: float) -> str:
    """A time in the unit that suits it, to three figures."""
    unit, factor = next(
        (u, f) for u, f in (("s", 1.0), ("ms", 1e3), ("us", 1e6)) if value * f >= 1 or u == "us"
    )
    return f"{value * factor:.3g} {unit}"


def times(ratio: float) -> str:
    """How many times as long."""
    return f"{ratio:.2f}" if ratio < 10 else f"{ratio:.0f}"


def side_by_side(rows: Sequence[Row]) -> str:
    """Every program on every grid; the last columns compare with the first program."""
    lines = []
    first: Row = {}
    hertz = any("error_p" in row for row in rows)
    for row in rows:
        name = f"{row['program']} {row.get('version', '')}".strip()
        if "missing" in row:
            lines.append([str(row.get("cells", "")), name, row["missing"]])
            continue
        if row["program"] == "pyfret":
            first = row
        whole = row["set_up_s"] + row["solve_s"]
        same = first.get("cells") == row["cells"]
        ratio = times(row["solve_s"] / first["solve_s"]) if same else "-"
        of_whole = times(whole / (first["set_up_s"] + first["solve_s"])) if same else "-"
        lines.append(
            [
                str(row["cells"]),
                name,
                str(row["threads"]),
                str(row["iterations"]),
                f"{row['residual']:.1e}",
                *([f"{100 * row['error_p']:.3f} %"] if hertz else []),
                *([f"{100 * row['error_p0']:+.4f} %"] if hertz else []),
                *([f"{100 * row['error_a']:+.3f} %"] if hertz else []),
                seconds(row["set_up_s"]),
                seconds(row["solve_s"]),
                seconds(row["processor_s"]),
                ratio,
                of_whole,
                f"{(row['memory'] - row['memory_empty']) / row['cells'] ** 2:.0f} B",
                seconds(row["start_up_s"]),
            ]
        )
    errors = ["p (L2)", "p0", "a"] if hertz else []
    heads = [
        *("cells", "program", "threads", "iterations", "residual", *errors),
        *(
            "set-up",
            "solve",
            "its CPU time",
            "solve, ratio",
            "both, ratio",
            "memory per cell",
            "start-up",
        ),
    ]
    return table(heads, lines)


def convolution(rows: Sequence[Row]) -> str:
    """Ours against six transforms by FFTW, and two threads against one."""
    heads = ["cells", "FFTW, 1 thread", "ours, 1 thread", "ours/FFTW", "ours, 2 threads", "gain"]
    lines = []
    for row in rows:
        one, two, fftw = row["threads_1"], row["threads_2"], row.get("fftw")
        lines.append(
            [
                str(row["cells"]),
                seconds(fftw) if fftw else row.get("missing", "-"),
                seconds(one),
                times(one / fftw) if fftw else "-",
                seconds(two),
                times(one / two),
            ]
        )
    return table(heads, lines)


def fretting(rows: Sequence[Row]) -> str:
    """The paper's scene; the last column compares with ours at the same tolerance."""
    heads = [
        *("E1/E2", "cells", "increments", "solvers", "tolerance", "time"),
        *("convolutions per increment", "error of q", "after indentation", "time, ratio"),
    ]

    def key(row: Row) -> tuple[float, ...]:
        return (row["ratio"], row["cells"], row["increments"], row["tolerance"])

    ours = {key(row): row for row in rows if row["program"] == "pyfret"}
    lines = []
    for row in rows:
        same = ours.get(key(row))
        plain = row["program"] != "pyfret"
        lines.append(
            [
                f"{row['ratio']:g}",
                str(row["cells"]),
                f"{row['increments']:.0f}",
                row["program"],
                f"{row['tolerance']:.0e}",
                seconds(row["seconds"]),
                f"{row['per_increment']:.1f}",
                f"{100 * row['error_q']:.2g} %",
                f"{100 * row['error_q_first']:.2g} %",
                times(row["seconds"] / same["seconds"]) if plain and same else "-",
            ]
        )
    return table(heads, lines)


def runs(rows: Sequence[Row]) -> str:
    """Whole runs of the command."""
    lines = [[row["run"], seconds(row["seconds"])] for row in rows]
    return table(["`fret run`, start-up and files included unless said", "time"], lines)


def large(rows: Sequence[Row]) -> str:
    """Grids of many cells, over the cells."""
    heads = ["cells", "set-up", "indentation", "increment of shear", "each per cell", "peak memory"]
    heads.append("per cell")
    lines = []
    for row in rows:
        area = row["cells"] ** 2
        stages = [row[f"{stage}_s"] for stage in ("set_up", "normal", "frictional")]
        memory = row["frictional_memory"] - row["memory_empty"]
        lines.append(
            [
                str(row["cells"]),
                *map(seconds, stages),
                ", ".join(f"{1e6 * s / area:.2f}" for s in stages) + " us",
                f"{memory / 2**30:.2f} GiB",
                f"{memory / area:.0f} B",
            ]
        )
    return table(heads, lines)


def write_between_marks(document: Path, name: str, text: str) -> None:
    """Replace what stands between the marks `name` of a document."""
    begin, end = f"<!-- begin {name} -->", f"<!-- end {name} -->"
    pattern = re.compile(f"{re.escape(begin)}.*?{re.escape(end)}", re.DOTALL)
    content = document.read_text()
    if not pattern.search(content):
        raise ValueError(f"{document} has no marks {begin} ... {end}")
    document.write_text(pattern.sub(lambda _: f"{begin}\n\n{text}\n\n{end}", content))
