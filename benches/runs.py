"""Whole runs of ``fret``, start-up and files included, solutions alone, and grids of many cells."""

from __future__ import annotations

import os
import subprocess
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

import fretting
from environment import ROOT, product, run_python

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    Row = dict[str, Any]

FRET = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "release" / "fret"
PAPER = "scenes/coated_fretting.toml"


def ratio(value: float) -> tuple[str, ...]:
    """The setting E1/E2."""
    return ("--set", f"body2.coatings.0.E.E_substrate={value:g}")


def tolerance(value: float) -> tuple[str, ...]:
    """The solver's tolerance."""
    return ("--set", f"solver.tolerance={value:g}")


def short(value: float) -> str:
    """A power of ten as one writes it."""
    return f"{value:.0e}".replace("e-0", "e-")


SMALL = "scenes/coated_small.toml"
#: Similar bodies of nu = 0: the increments within a branch do not matter.
ALIKE = (
    *ratio(1.0),
    *(s for body in ("body1", "body2", "body2.coatings.0") for s in ("--set", f"{body}.nu=0.0")),
)
#: Similar bodies, an increment per reversal.
REVERSALS = (
    *ratio(1.0),
    *(s for branch in range(6) for s in ("--set", f"path.{branch}.increments=1")),
)
RUNS: tuple[tuple[str, tuple[str, ...]], ...] = (
    ("small, 64 x 64, 200 increments, tolerance 1e-6", (SMALL,)),
    *((f"the same, tolerance {short(t)}", (SMALL, *tolerance(t))) for t in (1e-5, fretting.OURS)),
    *(
        (
            f"paper, 256 x 256, 1000 increments, E1/E2 = {value:g}, tolerance {short(within)}",
            (PAPER, *ratio(value), *tolerance(within)),
        )
        for within in (fretting.OURS, 1e-5, 1e-6)
        for value in (0.5, 2.0, 4.0)
    ),
    (
        "paper, 256 x 256, 1000 increments, E1/E2 = 1, tolerance 1e-5",
        (PAPER, *ratio(1.0), *tolerance(1e-5)),
    ),
    (
        "paper, 256 x 256, E1/E2 = 1, nu = 0, `skip.path_independent_branches` (6 increments), "
        "tolerance 1e-5",
        (PAPER, *ALIKE, *tolerance(1e-5), "--set", "skip.path_independent_branches=true"),
    ),
    (
        "paper, 256 x 256, E1/E2 = 1, an increment per branch (6), tolerance 1e-6",
        (PAPER, *REVERSALS),
    ),
)
#: Of these also the solution alone.
ALONE = 2


def command_line(*, quick: bool) -> Iterator[Row]:
    """Wall time of runs, the better of two (short ones: the best of ten) [s]."""
    for name, arguments in RUNS[: 1 if quick else None]:
        times: list[float] = []
        # Emptied at the end: file systems are slow to make files where they have just removed some.
        with tempfile.TemporaryDirectory() as folder:
            while len(times) < 2 or (sum(times) < 3 and len(times) < 10):
                begun = time.perf_counter()
                subprocess.run(
                    [FRET, "run", *arguments, "-o", Path(folder) / f"{len(times)}.zarr"],
                    cwd=ROOT,
                    check=True,
                    capture_output=True,
                )
                times.append(time.perf_counter() - begun)
        yield {"run": name, "seconds": min(times), "repetitions": len(times)}
    for name, arguments in () if quick else RUNS[-ALONE:]:
        for row in run_python(product(), "run_loop.py", list(arguments)):
            yield row | {"run": f"{name}: the solution alone"}


def large(sizes: Sequence[int]) -> Iterator[Row]:
    """Time and memory over the cells; a grid that the machine's memory cannot hold is left out."""
    for cells in sizes:
        if 1000 * cells**2 < free_memory():
            yield from run_python(product(), "run_large.py", ["--cells", str(cells)])


def free_memory() -> float:
    """Memory that is free [bytes]."""
    file = Path("/proc/meminfo")
    if not file.exists():
        return float("inf")
    lines = dict(line.split(":", 1) for line in file.read_text().splitlines())
    return 1024.0 * int(lines["MemAvailable"].split()[0])
