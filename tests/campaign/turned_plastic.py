"""Balls on flats that yield, turned by 90 degrees: the same scene, whatever the axis of the force.

    python tests/campaign/turned_plastic.py [COUNT]

2 to 8 increments a quarter. Each line is a scene: the largest differences of p, q and of the
largest plastic strain, over the largest value.
"""

from __future__ import annotations

import math
import sys
import warnings

import numpy as np

import pyfret as fret


def solve(seed: int, axis: str, n: int = 24) -> fret.Result:
    """A ball that yields its flat, sheared along an axis."""
    rng = np.random.default_rng([seed, 402])
    s_y = float(rng.uniform(4e8, 8e8))
    law = fret.Plastic(
        s_y=s_y, kinematic=float(rng.uniform(2e9, 1e10)), hardening=float(rng.uniform(1e9, 4e9))
    )
    flat = fret.Elastic(E=115e9, nu=0.32, plastic=law)
    ball = fret.Elastic(E=210e9, nu=0.3)
    modulus = 1.0 / ((1 - 0.3**2) / 210e9 + (1 - 0.32**2) / 115e9)
    p0 = 1.6 * s_y * float(rng.uniform(2.0, 4.0)) ** (1 / 3)
    R, mu = 0.01, float(rng.uniform(0.2, 0.5))
    a = math.pi * p0 * R / (2 * modulus)
    W = 2 * math.pi * a * a * p0 / 3
    force = float(rng.uniform(0.5, 0.85)) * mu * W
    quarter = int(rng.integers(2, 9))
    path = fret.LoadPath.start().normal(W, increments=4)
    path = path.cycles(1, **{f"T_{axis}": force}, increments=5 * quarter)
    scene = fret.Scene(
        body1=fret.Body(ball, shape=fret.Sphere(R=R)),
        body2=fret.Body(flat),
        friction=mu,
        grid=fret.Grid.centred(width=3.6 * a, n=n),
    )
    return fret.solve(scene, path, save="all", progress=False)


def differences(seed: int) -> dict[str, float]:
    """Largest differences between the scene and the turned one."""
    x, y = (solve(seed, axis).dataset for axis in "xy")
    q = abs(x.q_x.values).max()
    return {
        "p": float(
            max(abs(b.T - a).max() / a.max() for a, b in zip(x.p.values, y.p.values, strict=True))
        ),
        "q": float(
            max(abs(b.T - a).max() / q for a, b in zip(x.q_x.values, y.q_y.values, strict=True))
        ),
        "strain": float(abs(y.largest_plastic_strain / x.largest_plastic_strain - 1.0).max()),
    }


def main(count: int) -> None:
    """Print the differences of scenes."""
    warnings.simplefilter("ignore")
    right = 0
    for seed in range(count):
        off = differences(seed)
        right += max(off.values()) < 1e-3
        print(seed, ", ".join(f"{name} {value:.1e}" for name, value in off.items()), flush=True)
    print(f"{right} of {count} within 1e-3")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 20)
