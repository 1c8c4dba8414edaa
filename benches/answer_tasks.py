"""What tasks of many answers cost: error bars, a comparison, a study, the page.

Processor times and times of one process; medians of several runs of the short tasks.
:mod:`answers` writes the table. ::

    python benches/answer_tasks.py
"""

from __future__ import annotations

import argparse
import itertools
import json
import time
import warnings
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from statistics import median
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from answers import QUICK, STEEL, TITANIUM, R, W, contact

import pyfret as fret
from pyfret.workbench.answers import answer_in_full, preview
from pyfret.workbench.presets import ball_on_coated_flat

if TYPE_CHECKING:
    from collections.abc import Callable

#: Cells a side of studies, comparisons and the page.
FEW = 48
#: Points of the study: friction and radius of the ball [m].
POINTS = {
    "friction.mu": np.linspace(0.4, 0.8, 10).tolist(),
    "body1.shape.sphere.R": np.linspace(0.6 * R, R, 6).tolist(),
}
STRESSES = ("von_mises", "s_1", "tresca")
#: Young's modulus [Pa] of the coatings that are compared.
COATINGS = {"soft": 150e9, "carbon": 200e9, "nitride": 450e9, "diamond": 900e9}


class Cost(NamedTuple):
    """Processor time and time [s]."""

    processor: float
    wall: float


def measure(work: Callable[[], Any], repeat: int) -> Cost:
    """Return the medians of several repetitions of some work."""
    costs = []
    for _ in range(repeat):
        begun = time.process_time(), time.perf_counter()
        work()
        costs.append((time.process_time() - begun[0], time.perf_counter() - begun[1]))
    return Cost(*(median(column) for column in zip(*costs, strict=True)))


def solve(scene: fret.Scene, **options: Any) -> fret.Result:
    """Solve without a progress bar."""
    return fret.solve(scene, progress=False, **options)


def of_error_bars(repeat: int, divisor: int) -> list[tuple[str, Cost, float]]:
    """Measure runs with error bars of both kinds over the runs alone."""
    rows = []
    for kind in ("bare", "coated"):
        for cells in (64 // divisor, 128 // divisor):
            scene = contact(kind, cells)
            solve(scene)
            alone = measure(partial(solve, scene), repeat)
            for error in (True, "coarser"):
                bars = measure(partial(solve, scene, error=error), repeat)
                title = f"`error={error!r}`, {kind}, {cells} cells, over the solution"
                added = Cost(bars.processor - alone.processor, bars.wall - alone.wall)
                rows.append((title, added, added.processor / alone.processor))
    return rows


def of_comparison(_: int, divisor: int) -> list[tuple[str, Cost, float]]:
    """Measure the comparison of four coatings with all questions, over its solutions alone."""
    cells = FEW // divisor
    bare = contact("bare", cells)
    thickness = 0.1 * fret.reference.hertz(R=R, bodies=(STEEL, TITANIUM), W=W).a
    bodies = {
        name: fret.Body(
            TITANIUM, coatings=[fret.Coating(fret.Elastic(E=E, nu=0.25), thickness=thickness)]
        )
        for name, E in COATINGS.items()
    }
    scenes = [bare.replace(body2=body) for body in bodies.values()]
    alone = measure(lambda: [solve(scene, save="all") for scene in scenes], 1)

    def compare() -> None:
        executor = ThreadPoolExecutor(1)
        fret.study.compare(bodies, bare, bare.path, executor=executor, progress=False)

    cost = measure(compare, 1)
    title = f"`compare` of four coatings, {cells} cells, over their solutions"
    return [(title, cost, cost.processor / alone.processor)]


def of_study(_: int, divisor: int) -> list[tuple[str, Cost, float]]:
    """Measure a study of 60 points with largest stresses, over its solutions alone."""
    cells = FEW // divisor
    scene = contact("bare", cells)
    points = {name: values[::divisor] for name, values in POINTS.items()}
    scenes = [
        scene.replace(dict(zip(points, values, strict=True)))
        for values in itertools.product(*points.values())
    ]
    alone = measure(lambda: [solve(point, save="all") for point in scenes], 1)

    def study() -> None:
        fret.study.run(
            scene.replace(save="all"),
            points,
            measure=list(STRESSES),
            executor=ThreadPoolExecutor(1),
            progress=False,
        )

    cost = measure(study, 1)
    count, stresses = len(scenes), ", ".join(STRESSES)
    title = f"study of {count} points with {stresses}, {cells} cells, over its solutions"
    return [(title, cost, cost.processor / alone.processor)]


def of_page(repeat: int, _: int) -> list[tuple[str, Cost, float]]:
    """Measure the answers of the page to its first contact, on its 48 x 48 cells."""
    scene, names = ball_on_coated_flat()
    changes = iter(np.linspace(0.31, 0.6, 4 * repeat).tolist())

    def changed() -> fret.Scene:
        return scene.replace({"friction.mu": next(changes)})

    preview(changed(), None)
    first = measure(lambda: preview(changed(), None), repeat)
    full = measure(lambda: answer_in_full(changed(), names), repeat)
    return [
        (f"preview of the page, {FEW} cells", first, float("nan")),
        (f"full answer of the page, {FEW} cells", full, float("nan")),
    ]


TASKS = (of_error_bars, of_comparison, of_study, of_page)


def main() -> None:
    """Measure, and print a line of JSON for each task."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--quick", action="store_true", help="small grids, to check the program")
    options = parser.parse_args()
    warnings.simplefilter("ignore")
    for task in TASKS:
        for title, cost, ratio in task(options.repeat, QUICK if options.quick else 1):
            print(json.dumps({"title": title, **cost._asdict(), "ratio": ratio}), flush=True)


if __name__ == "__main__":
    main()
