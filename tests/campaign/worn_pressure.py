"""The largest pressure of worn runs in gross slip, beside a run on four times the cells each way.

    python tests/campaign/worn_pressure.py [COUNT]

Cylinders and balls on flats, like and unlike bodies, both or one of them worn. Each line is a run.
The last line is the share of runs within 1.5 errors.
"""

from __future__ import annotations

import sys
import warnings

import numpy as np

import pyfret as fret

FINER = 4
#: Largest ratio of a true error to its bar.
MOST = 1.5


def wear(seed: int, finer: int) -> fret.wear.WearResult:
    """Wear the contact of a seed on a grid that is `finer` times as fine."""
    rng = np.random.default_rng([seed, 827])
    E, unlike = float(rng.uniform(7e10, 2.2e11)), rng.random() < 0.5
    flat = fret.Elastic(E=E, nu=0.3)
    counter = fret.Elastic(E=E * float(rng.uniform(0.5, 2.0)), nu=0.28) if unlike else flat
    R, p0 = float(rng.uniform(5e-3, 2e-2)), float(rng.uniform(3e8, 8e8))
    n, part = int(rng.integers(40, 65)), float(rng.uniform(0.05, 0.4))
    depth = float(rng.uniform(0.05, 0.6))
    one_body = rng.random() < 0.5
    modulus = 1.0 / ((1 - flat.nu**2) / flat.E + (1 - counter.nu**2) / counter.E)
    is_line = seed % 3 < 2
    a = (2.0 if is_line else 0.5 * np.pi) * p0 * R / modulus
    W = 0.5 * np.pi * a * p0 if is_line else 2.0 / 3.0 * np.pi * a * a * p0
    stroke = part * a
    width = 2.0 * (1.6 * a + stroke)
    shape: fret.shapes.Cylinder | fret.shapes.Sphere
    if is_line:
        shape, grid = fret.shapes.Cylinder(R=R), fret.Grid.strip(extent=width, n=finer * n)
    else:
        shape, grid = fret.shapes.Sphere(R=R), fret.Grid.centred(width=width, n=finer * n)
    scene = fret.Scene(
        body1=fret.Body(counter, shape=shape),
        body2=fret.Body(flat),
        friction=0.6,
        grid=grid,
        path=fret.LoadPath.start().normal(W).cycles(1, delta_x=stroke + 0.01 * a),
    )
    law = fret.wear.Archard(1e-15)
    # Mean pressure times slid distance a cycle makes this depth over a^2/(2 R).
    cycles = depth * a * a / (2.0 * R) / (1e-15 * 0.7 * p0 * 4.0 * stroke)
    bodies = {"body2": law} if one_body else {"body1": law, "body2": law}
    return fret.wear.solve(scene, cycles=cycles, tolerance=0.01, progress=False, **bodies)


def main(count: int) -> None:
    """Print the runs and the share."""
    warnings.simplefilter("ignore")
    within = []
    for seed in range(count):
        coarse, fine = wear(seed, 1).dataset, wear(seed, FINER).dataset
        value, right = float(coarse.p_max[-1]), float(fine.p_max[-1])
        error = float(coarse.p_max_error[-1])
        within.append(abs(value / right - 1.0) <= MOST * error)
        print(
            f"{seed}: {coarse.p.shape[1]} x {coarse.p.shape[2]} cells, {1e-6 * value:.1f} MPa "
            f"+- {error:.1%}, {value / right - 1.0:+.1%} off {FINER} times the cells",
            flush=True,
        )
    print(f"{np.mean(within):.0%} of {count} within {MOST} errors")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 10)
