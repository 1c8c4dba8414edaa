"""Largest stresses of every layer of random stacks, against Hankel transforms.

``make layers`` goes through twenty stacks on five grids each.
"""

from __future__ import annotations

import os
import warnings

import numpy as np
import pytest

import pyfret as fret
from hankel import Ball, Layer

STACKS = int(os.environ.get("FRET_LAYERS", "1"))
#: Length of the grid over the contact radius with its cells across.
GRIDS = ((2.4, 40), (3.0, 56), (4.0, 64), (5.0, 96), (6.0, 128))
MEASURES = ("s_1", "von_mises", "interface_shear")
R, W = 8e-3, 40.0


def stack(random: np.random.Generator, a: float) -> list[Layer]:
    """Two to five layers of a thirtieth to a half of the contact radius, on a substrate."""
    count = int(random.integers(2, 6))
    layers = [
        Layer(
            E=float(205e9 * 2 ** random.uniform(-1.5, 1.8)),
            nu=float(random.uniform(0.15, 0.4)),
            thickness=float(a * 15 ** random.uniform(-1.0, 0.0) / 2.0),
        )
        for _ in range(count)
    ]
    return [*layers, Layer(205e9, 0.28, np.inf)]


@pytest.mark.slow
@pytest.mark.solves
@pytest.mark.timeout(1800)
@pytest.mark.parametrize("seed", range(STACKS))
def test_largest_stresses_of_layers_are_those_of_hankel_transforms(seed: int) -> None:
    steel = fret.Elastic(E=205e9, nu=0.28)
    layers = stack(
        np.random.default_rng(seed), fret.reference.hertz(R=R, bodies=(steel, steel), W=W).a
    )
    right = Ball(R, (steel.E, steel.nu), layers, W)
    coatings = [
        fret.Coating(fret.Elastic(E=layer.E, nu=layer.nu), thickness=layer.thickness)
        for layer in layers[:-1]
    ]
    off = []
    for extent, n in GRIDS:
        scene = fret.Scene(
            body1=fret.Body(steel, shape=fret.Sphere(R=R)),
            body2=fret.Body(steel, coatings=coatings),
            friction=0.0,
            grid=fret.Grid.centred(width=extent * right.a, n=n),
        )
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            at = fret.solve(scene, fret.LoadPath.start().normal(W), progress=False).at(-1)
            below = at.stress()
            for k in range(len(layers)):
                for item in MEASURES:
                    extremum, truth = below.maximum(item, layer=k), right.largest(k, item)
                    if abs(extremum.value - truth) > max(0.02 * truth, extremum.error):
                        off.append((extent, n, k, item, truth, extremum))
    assert not off, "\n".join(map(str, [right.a, layers, *off]))


@pytest.mark.solves
@pytest.mark.parametrize("stiffness", [0.5, 2.0, 4.0])
def test_a_layer_of_a_twentieth_of_the_radius_is_covered(stiffness: float) -> None:
    """The error covers what the cells along the rim add to the largest stress."""
    steel = fret.Elastic(E=205e9, nu=0.28)
    thickness = 0.05 * fret.reference.hertz(R=R, bodies=(steel, steel), W=W).a
    film = fret.Elastic(E=stiffness * steel.E, nu=steel.nu)
    layers = [Layer(film.E, film.nu, thickness), Layer(steel.E, steel.nu, np.inf)]
    right = Ball(R, (steel.E, steel.nu), layers, W)
    for extent, n in ((2.5, 40), (2.5, 60)):
        scene = fret.Scene(
            body1=fret.Body(steel, shape=fret.Sphere(R=R)),
            body2=fret.Body(steel, coatings=[fret.Coating(film, thickness=thickness)]),
            friction=0.0,
            grid=fret.Grid.centred(width=extent * right.a, n=n),
        )
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            at = fret.solve(scene, fret.LoadPath.start().normal(W), progress=False).at(-1)
            largest = at.stress().maximum("von_mises", layer=0)
        truth = right.largest(0, "von_mises")
        assert abs(largest.value - truth) < largest.error, (n, largest, truth)
        assert largest.value == pytest.approx(truth, rel=0.05 if stiffness > 1.0 else 2e-3), n
