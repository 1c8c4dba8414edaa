"""Worn depth and volume in partial slip beside a finer grid, and the errors that are printed.

    python tests/campaign/worn.py [COUNT]

Line contacts and spheres, T 0.1 to 0.9 mu W, few and many cycles, 48 to 192 cells along a strip and
24 to 48 along a side of a ball's grid. Each line is a run. The last lines are the shares of runs
within 1.5 errors, of depth and volume each, or with a doubt about the cells across the slip zone.
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterator

import numpy as np

import pyfret as fret

STEEL = fret.Elastic(E=200e9, nu=0.3)
MU = 0.6
#: Cells of the truth: of lines and of balls.
FINE = {"line": 480, "ball": 96}
#: Largest ratio of a true error to its bar.
MOST = 1.5


def wear(kind: str, n: int, part: float, cycles: float) -> fret.wear.WearResult:
    """Wear a contact under the force `part` mu W."""
    R = 0.01
    if kind == "line":
        W = 2e5
        width = 3.4 * fret.reference.line_contact(R=R, bodies=(STEEL, STEEL), W=W).a
        shape: fret.shapes.Cylinder | fret.shapes.Sphere = fret.shapes.Cylinder(R=R)
        grid = fret.Grid.strip(extent=width, n=n)
    else:
        W = 50.0
        width = 2.9 * fret.reference.hertz(R=R, bodies=(STEEL, STEEL), W=W).a
        shape = fret.shapes.Sphere(R=R)
        grid = fret.Grid.centred(width=width, n=n)
    T = part * MU * W
    path = fret.LoadPath.start().normal(W, increments=2).tangential([T, -T, T])
    scene = fret.Scene(
        body1=fret.Body(STEEL, shape=shape),
        body2=fret.Body(STEEL),
        friction=MU,
        grid=grid,
        path=path,
    )
    law = fret.wear.Archard(5e-14)
    return fret.wear.solve(
        scene, cycles=cycles, body1=law, body2=law, tolerance=0.01, progress=False
    )


def numbers(run: fret.wear.WearResult) -> dict[str, float]:
    """Depth and volume of both bodies together."""
    d = run.dataset
    return {name: float(d[f"{name}1"][-1] + d[f"{name}2"][-1]) for name in ("depth", "volume")}


def drawn(count: int, seed: int = 403) -> Iterator[tuple[str, int, float, float]]:
    """Kind, cells, part of mu W and cycles of random runs."""
    rng = np.random.default_rng(seed)
    for k in range(count):
        kind = "ball" if k % 5 == 4 else "line"
        low, high = (48, 192) if kind == "line" else (24, 48)
        cycles = 10 ** float(rng.uniform(3.2, 4.5 if kind == "line" else 3.8))
        yield kind, int(rng.integers(low, high + 1)), float(rng.uniform(0.1, 0.9)), cycles


def ratios(kind: str, n: int, part: float, cycles: float) -> tuple[dict[str, float], bool, str]:
    """True errors over printed ones, whether the run doubts its cells, and both in words."""
    run = wear(kind, n, part, cycles)
    right = numbers(wear(kind, FINE[kind], part, cycles))
    doubted = any("slip zone" in doubt for doubt in run.doubts)
    off = {name: value / right[name] - 1.0 for name, value in numbers(run).items()}
    printed = {name: run.error_of(name) for name in off}  # type: ignore[arg-type]
    words = ", ".join(f"{name} {off[name]:+.1%} +- {printed[name]:.1%}" for name in off)
    about = f"{kind} of {n} cells, T {part:.2f} mu W, {cycles:.0f} cycles"
    true_over_printed = {name: abs(off[name]) / printed[name] for name in off}
    return true_over_printed, doubted, f"{about}: {words}{', doubted' if doubted else ''}"


def main(count: int) -> None:
    """Print the runs and the shares."""
    warnings.simplefilter("ignore")
    within: dict[str, list[bool]] = {"depth": [], "volume": []}
    every: dict[str, list[float]] = {"depth": [], "volume": []}
    for scene in drawn(count):
        of_scene, doubted, words = ratios(*scene)
        print(words, flush=True)
        for name, ratio in of_scene.items():
            within[name].append(ratio <= MOST or doubted)
            every[name].append(ratio)
    for name, ratios_of_name in every.items():
        print(
            f"{name}: {np.mean(within[name]):.0%} of {count} within {MOST} errors or doubted, "
            f"{np.mean(np.array(ratios_of_name) <= MOST):.0%} within, "
            f"median {np.median(ratios_of_name):.2f}"
        )


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 40)
