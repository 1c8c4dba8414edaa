"""How the cost of answers grows: exponents in cells, increments, cycles, layers, saved increments.

Processor times of one thread, the least of two. The exponent is the slope of the straight line
through the logarithms, by least squares. ::

    python benches/growth.py --document docs/performance.md
"""

from __future__ import annotations

import argparse
import json
import os
import tempfile
import time
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any

os.environ.setdefault("RAYON_NUM_THREADS", "1")

import numpy as np
from answers import CARBON, MATERIAL, MU, SHARE, STEEL, TITANIUM, R, W, contact
from tables import table, write_between_marks

import pyfret as fret

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

#: Cells a side, increments of a branch, cycles, layers, increments that are kept.
CELLS = (32, 64, 128)
INCREMENTS = (16, 32, 64, 128)
CYCLES = (8, 16, 32, 64)
LAYERS = (6, 12, 24, 48)
KEPT = (50, 100, 200, 400)
#: Cycles of wear in partial slip.
WORN = (1e4, 1e5, 1e6)
#: Cells a side of the rows that do not vary them.
FEW = 32


def least(work: Callable[..., Any], *arguments: Any, repeat: int = 2) -> float:
    """Return the least processor time of some work with its arguments [s]."""
    times = []
    for _ in range(repeat):
        begun = time.process_time()
        work(*arguments)
        times.append(time.process_time() - begun)
    return min(times)


def exponent(sizes: Sequence[float], values: Sequence[float]) -> float:
    """Return the slope of the logarithms."""
    return float(np.polyfit(np.log(sizes), np.log(values), 1)[0])


def solve(scene: fret.Scene, save: Any = "all") -> fret.Result:
    """Solve without a progress bar."""
    return fret.solve(scene, save=save, progress=False)


def in_increments(count: int, *, cycles: int = 1) -> fret.Scene:
    """Return the bare contact with so many increments in half a cycle."""
    path = fret.LoadPath.start().normal(W, increments=8)
    path = path.cycles(cycles, T_x=SHARE * MU * W, increments=2 * count)
    return contact("bare", FEW).replace(path=path)


def in_layers(count: int) -> fret.Scene:
    """Return a contact on so many layers, together as thick as a tenth of the radius."""
    scene = contact("coated", FEW)
    whole = scene.body2.coatings[0].thickness
    materials = [CARBON if n % 2 else STEEL for n in range(count)]
    layers = [fret.Coating(material, thickness=whole / count) for material in materials]
    return scene.replace(body2=fret.Body(TITANIUM, coatings=layers))


def ask_life(run: fret.Result) -> Any:
    """Ask for the worst point by a criterion."""
    return run.life(MATERIAL, "findley").worst


#: Questions of which each is asked of a result without any answer yet.
QUESTIONS: dict[str, Callable[[fret.Result], Any]] = {
    "largest von Mises stress": lambda run: run.at(-1).stress().maximum("von_mises"),
    "life, one criterion": ask_life,
    "load factors": lambda run: run.load_factors(900e6).least("von_mises"),
    "crack": lambda run: run.crack(),
}


def of_cells() -> list[list[str]]:
    """Measure solution and answers over the cells."""
    scenes = [contact("bare", n) for n in CELLS]
    runs = [solve(scene) for scene in scenes]
    rows = [row("solution", "cells a side", CELLS, [least(solve, s) for s in scenes], 2.6)]
    for title, ask in QUESTIONS.items():
        times = [least(ask, fret.Result(run.dataset), repeat=1) for run in runs]
        rows.append(row(title, "cells a side", CELLS, times, 2.3))
    return rows


def of_increments() -> list[list[str]]:
    """Measure solution and life over the increments, solution over the cycles."""
    scenes = [in_increments(n) for n in INCREMENTS]
    counts = [4 * n + 8 for n in INCREMENTS]
    runs = [solve(scene) for scene in scenes]
    rows = [row("solution", "increments", counts, [least(solve, s) for s in scenes], 1.1)]
    lives = [least(ask_life, fret.Result(run.dataset), repeat=1) for run in runs]
    rows.append(row("life, one criterion", "increments", counts, lives, 1.1))
    of_cycles = [least(solve, in_increments(8, cycles=n), "branches") for n in CYCLES]
    rows.append(row("solution", "cycles", CYCLES, of_cycles, 1.1))
    return rows


def of_layers() -> list[list[str]]:
    """Measure the stress below the middle over the layers."""
    ends = [solve(in_layers(n), "branches").at(-1) for n in LAYERS]
    return [row("`stress()`", "layers", LAYERS, [least(s.stress, repeat=1) for s in ends], 1.1)]


def read_last(place: Path) -> Any:
    """Open a store and read a field of its last increment."""
    return fret.open(place).at(-1).p.values


def of_stores() -> list[list[str]]:
    """Measure opening, reading of one increment, and size of stores over the kept increments."""
    opened, read, sizes = [], [], []
    with tempfile.TemporaryDirectory() as folder:
        for n in KEPT:
            place = Path(folder) / f"{n}.zarr"
            fret.solve(in_increments(n // 4), save="all", out=place, progress=False)
            opened.append(least(fret.open, place))
            read.append(least(read_last, place))
            sizes.append(sum(f.stat().st_size for f in place.rglob("*") if f.is_file()))
    return [
        row("opening of a store", "increments kept", KEPT, opened, 1.1),
        row("opening, one increment read", "increments kept", KEPT, read, 1.1),
        row("size of a store", "increments kept", KEPT, sizes, 1.1, unit="MB"),
    ]


def of_wear() -> list[list[str]]:
    """Count the jumps of wear in partial slip over the cycles."""
    steel = fret.Elastic(E=200e9, nu=0.0)
    path = fret.LoadPath.start().normal(50.0, increments=1)
    path = path.tangential([15.0, -15.0, 15.0], increments=30)
    a = fret.reference.hertz(R=10e-3, bodies=(steel, steel), W=50.0).a
    scene = fret.Scene(
        body1=fret.Body(steel, shape=fret.Sphere(R=10e-3)),
        body2=fret.Body(steel),
        friction=0.6,
        grid=fret.Grid.centred(width=2.8 * a, n=FEW),
        path=path,
    )
    law = fret.wear.Archard(5e-14)
    counts, times = [], []
    for cycles in WORN:
        wear = fret.wear.Wear(cycles=cycles, body1=law, body2=law, first_branch=2)
        begun = time.process_time()
        counts.append(fret.wear.solve(scene, wear, progress=False).dataset.sizes["jump"])
        times.append(time.process_time() - begun)
    return [
        row("wear in partial slip", "cycles", WORN, counts, 0.3, unit="jumps"),
        row("wear in partial slip", "cycles", WORN, times, 0.3),
    ]


def of_pairs() -> list[list[str]]:
    """Measure a crack below unlike bodies over one below like bodies."""
    unlike = contact("bare", 64)
    like = unlike.replace(body1=fret.Body(TITANIUM, shape=fret.Sphere(R=R)))
    times = [least(solve(scene).crack, repeat=1) for scene in (like, unlike)]
    ratio = times[1] / times[0]
    return [["crack", "unlike over like bodies", "", f"{ratio:.2g}", "1.3"]]


def row(
    title: str,
    over: str,
    sizes: Sequence[float],
    values: Sequence[float],
    allowed: float,
    unit: str = "s",
) -> list[str]:
    """Return a row: what, over what, the values, the exponent, the exponent allowed."""
    scale = 1e-6 if unit == "MB" else 1.0
    shown = ", ".join(f"{scale * value:.2g}" for value in values)
    ends = ", ".join(f"{size:g}" for size in sizes)
    line = [title, over, f"{ends}: {shown} {unit}", f"{exponent(sizes, values):.2f}", f"{allowed}"]
    print(json.dumps(line), flush=True)
    return line


PARTS = {
    "cells": of_cells,
    "increments": of_increments,
    "layers": of_layers,
    "stores": of_stores,
    "wear": of_wear,
    "pairs": of_pairs,
}


def main() -> None:
    """Measure, and write the table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--only", nargs="+", choices=PARTS, default=list(PARTS))
    parser.add_argument("--document", type=Path, help="page whose table is replaced")
    options = parser.parse_args()
    rows: list[list[str]] = []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        solve(contact("bare", 16)).life(MATERIAL, "findley")
        for part in options.only:
            rows += PARTS[part]()
    text = table(["answer", "over", "measured", "exponent", "allowed"], rows)
    print(text)
    if options.document:
        write_between_marks(options.document, "growth", text)


if __name__ == "__main__":
    main()
