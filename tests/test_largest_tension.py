"""The largest tension of a ball in partial slip: its place on the rim, its error over the grids."""

from __future__ import annotations

import numpy as np
import pytest

import pyfret as fret

R, W, MU = 5e-3, 100.0, 0.5
STEEL = fret.material("steel")
A = fret.reference.hertz(R=R, bodies=(STEEL, STEEL), W=W).a


def largest(n: int, thickness: float) -> fret.subsurface.Extremum:
    """Below a film that is nearly as stiff as its substrate."""
    film = fret.Coating(fret.Elastic(E=200e9, nu=0.3), thickness=thickness)
    scene = fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Sphere(R=R)),
        body2=fret.Body(STEEL, coatings=[film]),
        friction=MU,
        grid=fret.Grid.centred(width=2.6 * A, n=n),
        path=fret.LoadPath.start().normal(W, increments=1).force(T_x=8.0, increments=4),
    )
    return fret.solve(scene, progress=False).at(-1).stress().maximum("s_1")


@pytest.mark.solves
def test_the_error_of_a_tension_on_the_rim_does_not_jump_with_the_grid() -> None:
    """The point lies on the rim, whether or not it is in the middle of a row of cells."""
    computed = [largest(n, 20e-6) for n in (40, 44, 48, 52, 56, 96)]
    assert all(item.border == "rim" for item in computed)
    # Twice as many cells in each direction: all values are within their errors of it.
    finest = computed.pop()
    off = np.array([abs(item.value - finest.value) for item in computed])
    errors = np.array([item.error for item in computed])
    assert (off < errors).all()
    assert errors.max() < 2.0 * errors.min()
    assert errors.max() < 0.2 * finest.value
