"""What damage by a million reversals costs, beside a study of twelve amplitudes.

Like bodies under a constant normal force, 64 x 64 cells. The study solves a cycle of each amplitude
and judges its life on the same section. Times are processor times of one process. ::

    python benches/histories.py
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


def main() -> None:
    """Time both and print them."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--reversals", type=int, default=1_000_000)
    parser.add_argument("--cells", type=int, default=64)
    options = parser.parse_args()
    warnings.simplefilter("ignore")
    scene = contact(options.cells)
    force = random_force(options.reversals, 1)
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
