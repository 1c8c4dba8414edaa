"""Melan's bound against bodies that yield: a pair that shakes down, and one that does not."""

from __future__ import annotations

import numpy as np
import pytest

import pyfret as fret

CYCLES = 8
STEEL = fret.Elastic(E=210e9, nu=0.3)


def scene(lower: fret.Elastic, cycles: int, *, save: str = "branches") -> fret.Scene:
    """A cylinder on a flat: p_0 = 1.5 GPa, mu = 0.3, T = +-0.8 mu W."""
    R, p_0 = 10e-3, 1.5e9
    modulus = STEEL.E / (1 - STEEL.nu**2) / 2
    a = 2 * p_0 * R / modulus
    W = np.pi / 2 * a * p_0
    T = 0.8 * 0.3 * W
    path = fret.LoadPath.start().normal(W, increments=6).tangential([T], increments=8)
    for _ in range(cycles):
        path = path.tangential([-T], increments=16).tangential([T], increments=16)
    return fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Cylinder(R=R)),
        body2=fret.Body(lower),
        friction=0.3,
        grid=fret.Grid.strip(extent=2.8 * a, n=96),
        path=path,
        settings=fret.Settings(save=save),
    )


@pytest.mark.slow
@pytest.mark.solves
@pytest.mark.parametrize(
    ("part", "bar"),
    [
        (1.05, 1e-3),
        pytest.param(
            0.8, 2e-2, marks=pytest.mark.xfail(reason="1.1 % of the friction work", strict=True)
        ),
        (0.725, 2e-2),
    ],
)
def test_the_bound_parts_shakedown_from_alternating_plasticity(part: float, bar: float) -> None:
    """1.05 of the yield stress that load factors ask for shakes down, 0.8 of it should alternate.

    The worst point sets the bound, in the surface at the rim of the contact: 721, 717 and
    716 MPa on 96, 192 and 384 cells. The bar of 2 % belongs to 0.8 of a bound of 648 MPa, found by
    points inside; this is 0.725 of the bound in the surface.
    """
    elastic = fret.solve(scene(STEEL, 1, save="all"), progress=False)
    trial = 1e9
    request = trial / float(elastic.load_factors(trial).least("shakedown").value)
    # Linear kinematic hardening: Melan's theorem is exact for it under given tractions.
    law = fret.Plastic(s_y=part * request, kinematic=20e9)
    solved = fret.solve(
        scene(fret.Elastic(E=STEEL.E, nu=STEEL.nu, plastic=law), CYCLES), progress=False
    )
    last = slice(-32, None)
    plastic = float(solved.plastic_work.to_numpy()[last].sum())
    friction = float(solved.dissipated.to_numpy()[last].sum())
    if part > 1:
        assert plastic < bar * friction
    else:
        assert plastic > bar * friction
