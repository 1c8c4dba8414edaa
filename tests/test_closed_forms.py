"""The solution against closed forms, from Python."""

from __future__ import annotations

import numpy as np
import pytest

import pyfret as fret
from conftest import MU, T_MAX, R, W, pair, paper_path, sphere_on_flat

N = 64
# A contact edge is known to about half a cell, 1.2 a / 64; a radius from an area much better.
HALF_CELL = 1.2 / N


@pytest.fixture(scope="module", params=[0.0, 0.3], ids=["nu=0", "nu=0.3"])
def similar(request: pytest.FixtureRequest) -> tuple[float, fret.Result]:
    """A fretting loop of similar bodies: no coupling, one closed form for everything."""
    nu = float(request.param)
    scene = sphere_on_flat(nu=nu, n=N)
    return nu, fret.solve(scene, paper_path(2, 90), save="all", progress=False)


def mindlin(nu: float) -> fret.reference.CattaneoMindlin:
    hertz = fret.reference.hertz(R=R, bodies=pair(nu), W=W)
    return fret.reference.CattaneoMindlin(hertz, bodies=pair(nu), mu=MU)


def test_hertz(similar: tuple[float, fret.Result]) -> None:
    nu, result = similar
    hertz = fret.reference.hertz(R=R, bodies=pair(nu), W=W)
    end = result.at(-1)
    r = np.hypot(*np.meshgrid(end.x, end.y, indexing="ij"))
    error = end.p.values - hertz.p(r)
    assert np.linalg.norm(error) < 0.02 * np.linalg.norm(hertz.p(r))
    assert float(end.delta_z) == pytest.approx(hertz.delta_z, rel=2e-3)
    assert float(end.contact_radius) == pytest.approx(hertz.a, rel=HALF_CELL / 2)
    assert result.a_H == pytest.approx(hertz.a, rel=1e-14)
    assert result.p_H == pytest.approx(hertz.p0, rel=1e-14)
