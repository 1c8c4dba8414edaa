"""How time and memory of answers grow on large grids, long paths and large files.

Each row is measured in a process of its own, on one thread: processor time, and the peak of the
memory beyond the memory after the imports. ::

    python benches/growth_large.py --document docs/performance.md
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
import warnings
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TYPE_CHECKING, Any

os.environ.setdefault("RAYON_NUM_THREADS", "1")

import numpy as np
from answers import CRITERIA, MATERIAL, contact
from growth import exponent, in_increments
from measuring import peak_memory
from tables import table, write_between_marks

import pyfret as fret

if TYPE_CHECKING:
    from collections.abc import Callable

CELLS = (128, 256, 512)
CYCLES = (50, 200, 1000)


def run_of(cells: int, save: Any = "all") -> fret.Result:
    """Solve the bare contact."""
    return fret.solve(contact("bare", cells), save=save, progress=False)


def asked_of(ask: Callable[[fret.Result], Any], save: Any = "all") -> Callable[[int], Any]:
    """Return what asks a question about the contact on so many cells."""
    return lambda cells: ask(run_of(cells, save))


#: Questions over the cells, each with its exponents allowed of time and memory.
OF_CELLS: dict[str, tuple[Callable[[int], Any], float, float]] = {
    "solution": (asked_of(lambda run: run), 2.6, 2.3),
    "largest von Mises stress": (
        asked_of(lambda run: run.at(-1).stress().maximum("von_mises"), "branches"),
        2.3,
        2.3,
    ),
    "life, one criterion": (asked_of(lambda run: run.life(MATERIAL, CRITERIA[0]).worst), 2.3, 2.3),
    "crack": (asked_of(lambda run: run.crack()), 2.3, 2.3),
    "overview": (asked_of(lambda run: run.plot(), "branches"), 2.3, 2.3),
}


def of_cells(name: str, cells: int) -> dict[str, float]:
    """Measure a question over the solution, and the peak of memory of both."""
    before = peak_memory()
    begun = time.process_time()
    save = "branches" if name in ("largest von Mises stress", "overview") else "all"
    run_of(cells, save)
    solved = time.process_time() - begun
    begun = time.process_time()
    OF_CELLS[name][0](cells)
    both = time.process_time() - begun
    return {
        "seconds": both if name == "solution" else both - solved,
        "bytes": peak_memory() - before,
    }


def of_cycles(_: str, cycles: int) -> dict[str, float]:
    """Measure an increment of many cycles."""
    before = peak_memory()
    scene = in_increments(8, cycles=cycles).replace(grid=contact("bare", 48).grid)
    begun = time.process_time()
    run = fret.solve(scene, save="branches", progress=False)
    seconds = time.process_time() - begun
    count = run.dataset.sizes["increment"]
    return {"seconds": seconds / count, "bytes": peak_memory() - before}


def of_branches(_: str, cycles: int) -> dict[str, float]:
    """Measure `branches()` over its dataset made at once."""
    run = fret.solve(in_increments(2, cycles=cycles), save="branches", progress=False)

    def least(work: Callable[[], Any]) -> float:
        times = []
        for _ in range(5):
            begun = time.process_time()
            work()
            times.append(time.process_time() - begun)
        return min(times)

    table_of_branches = run.branches()
    columns = {name: (v.dims, v.values, v.attrs) for name, v in table_of_branches.variables.items()}
    bare = least(lambda: type(run.dataset)(columns, attrs=run.dataset.attrs))
    return {"seconds": least(run.branches), "ratio": least(run.branches) / bare}


def of_files(form: str, increments: int) -> dict[str, float]:
    """Measure a store of many increments of 128 x 128 cells, and its NetCDF file."""
    scene = in_increments(increments // 4).replace(grid=contact("bare", 128).grid)
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder) / "run.zarr"
        fret.solve(scene, save="all", out=place, progress=False)
        begun = time.process_time()
        run = fret.open(place)
        opened = time.process_time() - begun
        begun = time.process_time()
        if form == "netcdf":
            run.save(Path(folder) / "run.nc")
        written = time.process_time() - begun
        files = [Path(folder) / "run.nc"] if form == "netcdf" else place.rglob("*")
        size = sum(f.stat().st_size for f in files if f.is_file())
    return {"seconds": written if form == "netcdf" else opened, "size": size}


def of_study(_: str, cells: int) -> dict[str, float]:
    """Measure a point of a study with largest stresses over its lone solution."""
    scene = contact("coated", cells)
    mu = np.linspace(0.5, 0.8, 8).tolist()
    fret.solve(scene, progress=False)
    begun = time.process_time()
    for value in mu:
        fret.solve(scene.replace({"friction.mu": value}), save="all", progress=False)
    alone = time.process_time() - begun
    begun = time.process_time()
    fret.study.run(
        scene.replace(save="all"),
        {"friction.mu": mu},
        measure="interface_shear",
        executor=ThreadPoolExecutor(1),
        progress=False,
    )
    seconds = time.process_time() - begun
    return {"seconds": seconds / len(mu), "ratio": seconds / alone}


#: Rows: title, over what, sizes, what measures, names of the questions.
ROWS: list[tuple[str, tuple[int, ...], Callable[[str, int], dict[str, float]], list[str]]] = [
    ("cells a side", CELLS, of_cells, list(OF_CELLS)),
    ("cycles", CYCLES, of_cycles, ["an increment of many cycles"]),
    ("cycles", CYCLES, of_branches, ["`branches()`"]),
    ("increments kept", (100, 400), of_files, ["store", "netcdf"]),
    ("cells a side", (32, 64), of_study, ["a point of a study with interface shear"]),
]


def measured(name: str, row: int, size: int) -> dict[str, float]:
    """Measure in a process of its own."""
    command = [sys.executable, __file__, "--row", str(row), "--name", name, "--size", str(size)]
    done = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True)
    numbers: dict[str, float] = json.loads(done.stdout.splitlines()[-1])
    print(json.dumps({"name": name, "size": size, **numbers}), flush=True)
    return numbers


def lines_of(row: int) -> list[list[str]]:
    """Return the lines of the table of a row."""
    over, sizes, _, names = ROWS[row]
    lines = []
    for name in names:
        found = [measured(name, row, size) for size in sizes]
        for key, unit, scale in (
            ("seconds", "ms", 1e3),
            ("bytes", "MB", 1e-6),
            ("size", "MB", 1e-6),
            ("ratio", "times", 1.0),
        ):
            if key not in found[0]:
                continue
            values = [numbers[key] for numbers in found]
            shown = ", ".join(f"{scale * value:.3g}" for value in values)
            label = {"bytes": "memory", "size": "file", "ratio": "ratio"}.get(key, "time")
            ends = ", ".join(map(str, sizes))
            slope = f"{exponent(sizes, values):.2f}" if min(values) > 0.0 else ""
            lines.append([f"{name}: {label}", over, f"{ends}: {shown} {unit}", slope])
    return lines


def main() -> None:
    """Measure, and write the table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--row", type=int)
    parser.add_argument("--name")
    parser.add_argument("--size", type=int)
    parser.add_argument("--document", type=Path, help="page whose table is replaced")
    options = parser.parse_args()
    warnings.simplefilter("ignore")
    if options.size is not None:
        print(json.dumps(ROWS[options.row][2](options.name, options.size)))
        return
    wanted = range(len(ROWS)) if options.row is None else [options.row]
    lines = [line for row in wanted for line in lines_of(row)]
    text = table(["answer", "over", "measured", "exponent"], lines)
    print(text)
    if options.document:
        write_between_marks(options.document, "growth of large runs", text)


if __name__ == "__main__":
    main()
