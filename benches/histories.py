"""What damage by a million reversals costs, beside a study of twelve amplitudes.

Like bodies under a constant normal force, 64 x 64 cells. The study solves a cycle of each amplitude
and judges its life on the same section. Times are processor times of one process.

``--parts``: the amplitudes of a table in one path, and in parts that are marched at the same time.
These are times of the clock, the least of a few in turns, since the parts share the processors. ::

    python benches/histories.py
    python benches/histories.py --parts --cells 128
"""

from __future__ import annotations

import argparse
import resource
import time
import warnings
from typing import Literal

import numpy as np

import pyfret as fret
from pyfret import fatigue
from pyfret._util import concurrently
from pyfret._util.processors import count_threads
from pyfret.history import parts
from pyfret.history.table import HistoryTable

R, W, MU = 0.018, 1e3, 0.3
STEEL = fret.Elastic(E=210e9, nu=0.3)
MATERIAL = "steel_42CrMo4"
CRITERION: Literal["smith_watson_topper"] = "smith_watson_topper"


def contact(cells: int) -> fret.Scene:
    """Return a ball on a flat, pressed."""
    a = fret.reference.hertz(R=R, bodies=(STEEL, STEEL), W=W).a
    return fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Sphere(R=R)),
        body2=fret.Body(STEEL),
        friction=MU,
        grid=fret.Grid.centred(width=2.4 * a, n=cells),
        path=fret.LoadPath.start().normal(W),
    )


def random_force(reversals: int, seed: int) -> np.ndarray:
    """Return reversals of a wide band, up to 0.85 of sliding."""
    random = np.random.default_rng(seed)
    mean, amplitude = 0.06 * random.standard_normal(reversals), random.rayleigh(0.12, reversals)
    sign = np.where(np.arange(reversals) % 2 == 0, 1.0, -1.0)
    return np.clip(mean + sign * (0.02 + amplitude), -0.85, 0.85) * MU * W


def cost_of_study(scene: fret.Scene, top: float) -> float:
    """Return the processor time of twelve amplitudes, each a cycle and its life [s]."""
    start = time.process_time()
    for amplitude in top * np.arange(1, 13) / 12.0:
        result = fret.solve(scene, scene.path.cycles(1, T_x=float(amplitude)), progress=False)
        result.life(MATERIAL, CRITERION, y=0.0)
    return time.process_time() - start


def time_parts(scene: fret.Scene, history: fret.LoadHistory, repeats: int) -> None:
    """Print the times of a table whose amplitudes have one path, or parts one or two at a time."""
    manners = {
        "one path": (1_000, 1),
        "parts one after the other": (parts.AMPLITUDES, 1),
        "parts at the same time": (parts.AMPLITUDES, count_threads()),
    }
    times: dict[str, list[tuple[float, float]]] = {manner: [] for manner in manners}
    energies: dict[str, float] = {}
    for _ in range(repeats):
        for manner, (amplitudes, threads) in manners.items():
            parts.AMPLITUDES = amplitudes
            setattr(concurrently, "count_threads", lambda threads=threads: threads)  # noqa: B010
            start, used = time.perf_counter(), time.process_time()
            table = HistoryTable.build(scene, history, progress=False)
            times[manner].append((time.perf_counter() - start, time.process_time() - used))
            energies[manner] = table.total_energy
    for manner, rows in times.items():
        clock, used = min(rows)
        print(
            f"{manner:25s} {clock:6.1f} s, processor {used:6.1f} s, energy {energies[manner]:.6e} J"
        )


def main() -> None:
    """Time both and print them."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--reversals", type=int, default=1_000_000)
    parser.add_argument("--cells", type=int, default=64)
    parser.add_argument("--parts", action="store_true")
    parser.add_argument("--repeats", type=int, default=3)
    options = parser.parse_args()
    warnings.simplefilter("ignore")
    scene = contact(options.cells)
    force = random_force(options.reversals, 1)
    if options.parts:
        history = fret.LoadHistory.from_array(T_x=force[:2000])
        time_parts(scene, history, options.repeats)
        return
    study = cost_of_study(scene, float(np.abs(force).max()))
    start = time.process_time()
    history = fret.LoadHistory.from_array(T_x=force, frequency=1000.0)
    damage = fatigue.damage(scene, history, MATERIAL, CRITERION, y=0.0, progress=False)
    cost = time.process_time() - start
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6
    print(damage)
    print(f"study {study:.1f} s, history {cost:.1f} s: {cost / study:.2f} times, {memory:.2f} GB")


if __name__ == "__main__":
    main()
