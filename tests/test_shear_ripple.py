"""The shear that few increments of an indentation leave, and its printed error."""

from __future__ import annotations

import numpy as np
import pytest

import pyfret as fret

pytestmark = pytest.mark.solves

A, R, E = 0.1e-3, 10e-3, 210e9


def pressed(increments: int, *, error: bool = False) -> fret.Result:
    """Press a cylinder on a flat whose coating is twice as stiff (0.1 mm, plane strain)."""
    steel, stiff = fret.Elastic(E=E, nu=0.3), fret.Elastic(E=2.0 * E, nu=0.3)
    force = np.pi * A**2 * E / (2.0 * (1.0 - 0.3**2)) / (4.0 * R)
    scene = fret.Scene(
        body1=fret.Body(steel, shape=fret.Cylinder(R=R)),
        body2=fret.Body(steel, coatings=[fret.Coating(stiff, thickness=0.1e-3)]),
        friction=0.3,
        grid=fret.Grid.strip(extent=3.0 * A, n=64),
        path=fret.LoadPath.start().normal(force, increments=increments),
    )
    return fret.solve(scene, error=error, progress=False)


@pytest.mark.parametrize("increments", [8, 16])
def test_few_increments_print_an_error_that_covers_the_shear(increments: int) -> None:
    """The largest |q| after pressing alone: 35 MPa with 8 increments, 21 MPa with 128.

    It jumps from ripple to ripple. So its change from n/2 to n increments is no error of it.
    """
    many = float(pressed(128).q_max[-1])
    few = pressed(increments, error=True)
    off = float(few.q_max[-1]) - many
    error = float(few.error_bars().q_max.sel(part="total")[-1])
    assert off < error < many
    if increments == 8:
        assert off > 0.5 * many
