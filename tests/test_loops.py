"""Stiffness right after a reversal and sliding ratio: known to what is told, or not given."""

from __future__ import annotations

import numpy as np
import pytest

import pyfret as fret

SIC, STEEL = fret.Elastic(E=410e9, nu=0.14), fret.Elastic(E=193e9, nu=0.29)
R, W, MU = 3e-3, 8.0, 0.45


def mindlin(a: float) -> float:
    """R. D. Mindlin, J. Appl. Mech. 16 (1949) 259-268: 8 a/((2 - nu1)/G1 + (2 - nu2)/G2)."""
    compliance = sum((2 - m.nu) * 2 * (1 + m.nu) / m.E for m in (SIC, STEEL))
    return 8 * a / compliance


@pytest.mark.parametrize("reach", [15e-6, 1e-6, 2e-7])
@pytest.mark.parametrize("increments", [3, 12, 40])
def test_the_stiffness_is_mindlins_or_not_given(reach: float, increments: int) -> None:
    a = fret.reference.hertz(R=R, bodies=(SIC, STEEL), W=W).a
    scene = fret.Scene(
        body1=fret.Body(SIC, shape=fret.Sphere(R=R)),
        body2=fret.Body(STEEL),
        mu=MU,
        grid=fret.Grid.centred(extent=2.6 * a, n=32),
    )
    path = fret.LoadPath.start().normal(W)
    for to in (reach, -reach, reach):
        path = path.displace(delta_x=to, increments=increments)
    result = fret.solve(scene, path, progress=False)
    loop = result.loops().isel(cycle=-1)
    stiffness = float(loop.stiffness)
    # 40 increments of a way of 2 um have six in partial slip, 12 have two.
    if reach == 2e-7 or (reach < 1e-5 and increments >= 40):
        assert stiffness == pytest.approx(mindlin(a), rel=0.02)
        assert float(loop.stiffness_error) < 0.02 * stiffness
    elif reach > 1e-5:
        assert np.isnan(stiffness)
        assert "use more" in result.summary()
    else:
        assert np.isnan(stiffness) or stiffness == pytest.approx(mindlin(a), rel=0.02)
    sliding, error = float(loop.sliding_ratio), float(loop.sliding_ratio_error)
    # 0.9777 and 0.6716 on 60 increments a branch and 48 cells.
    right = {15e-6: 0.9777, 1e-6: 0.6716, 2e-7: 0.0735}[reach]
    assert np.isnan(sliding) or abs(sliding - right) < error + 0.005
    assert np.isnan(sliding) == (error > 0.05)
