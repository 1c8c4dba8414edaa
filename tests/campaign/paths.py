"""Energies of branches whose path is solved on a coarser grid, beside the path on the grid itself.

    python tests/campaign/paths.py FIRST COUNT

Balls on flats, bare, coated or of unlike bodies, sheared to and fro, at a normal force that varies
or not: 128 or 160 cells with a half or a quarter of them for the path. The truth has the
increments for a path error of 0.1 %. The last line has the ratios of the true errors to the
printed ones.
"""

from __future__ import annotations

import sys
import warnings

import numpy as np

import pyfret as fret

KINDS = ("bare", "coated", "unlike", "unlike coated", "varying", "turned")
R, W = 0.01, 100.0
#: Largest ratio of a true error to its bar; energies that count, over the largest of the path.
MOST, LEAST_ENERGY = 1.5, 1e-6


def drawn(seed: int) -> fret.Scene:
    """A ball on a flat with a coarser path."""
    rng, kind = np.random.default_rng(seed), KINDS[seed % len(KINDS)]
    ball = flat = fret.Elastic(E=210e9, nu=0.3)
    if "unlike" in kind:
        flat = fret.Elastic(E=210e9 * rng.uniform(0.3, 0.8), nu=rng.uniform(0.15, 0.4))
    mu = rng.uniform(0.2, 0.8)
    a = fret.reference.hertz(R=R, bodies=(ball, flat), W=W).a
    coatings = []
    if "coated" in kind or kind == "varying":
        film = fret.Elastic(E=flat.E * rng.choice([0.5, 2.0, 4.0]), nu=0.3)
        coatings = [fret.Coating(film, thickness=a * rng.uniform(0.1, 0.6))]
    T = rng.uniform(0.3, 0.92) * mu * W
    width = a * rng.uniform(2.5, 3.4)
    path = fret.LoadPath.start().normal(W)
    if kind == "varying":
        path = path.tangential([T]).normal(W * rng.uniform(1.1, 1.4)).tangential([-T, T])
    else:
        path = path.tangential([0.8 * T if kind == "turned" else T, -T, T])
    n = int(rng.choice([128, 128, 160]))
    return fret.Scene(
        body1=fret.Body(ball, shape=fret.Sphere(R=R)),
        body2=fret.Body(flat, coatings=coatings),
        friction=mu,
        grid=fret.Grid.centred(width=width, n=n),
        path=path,
        settings=fret.Settings(path_grid=n // (2 if seed % 3 else 4)),
    )


def ratios(seed: int) -> np.ndarray:
    """True error over printed error of the energy of each branch that dissipates."""
    scene = drawn(seed)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        result = fret.solve(scene, progress=False, error=True)
        finely = scene.replace(settings=fret.Settings(path_grid="same", path_tolerance=1e-3))
        truth = fret.solve(finely, progress=False).branches().dissipated.values
    bars = result.dataset.attrs["error_bars"]
    bar = np.array([branch["dissipated"]["total"] for branch in bars])
    off = np.abs(result.branches().dissipated.values - truth)
    counts = truth > LEAST_ENERGY * truth.max()
    counts[0] = False  # Branches after the pressing.
    return off[counts] / bar[counts]


def main(first: int, count: int) -> None:
    """Print the ratios of scenes, and how many are within the most."""
    every = []
    for seed in range(first, first + count):
        every.append(ratios(seed))
        print(seed, KINDS[seed % len(KINDS)], every[-1].round(2), flush=True)
    together = np.concatenate(every)
    print(
        f"{together.size}: {np.mean(together <= MOST):.1%} at most {MOST}, "
        f"median {np.median(together):.2f}, most {together.max():.2f}"
    )


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]))
