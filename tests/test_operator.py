"""Displacements under given tractions."""

from __future__ import annotations

import numpy as np
import pytest

import pyfret as fret
from conftest import R, W, pair


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.45])
def test_hertz_pressure_lifts_nothing_but_a_paraboloid(nu: float) -> None:
    """Under Hertz's pressure u_z is delta - r^2/(2 R) inside the contact."""
    hertz = fret.reference.hertz(R=R, bodies=pair(nu), W=W)
    grid = fret.Grid.from_spacing((65, 72), (2.2 * hertz.a / 65, 2.2 * hertz.a / 72))
    upper, lower = (fret.Body(material) for material in pair(nu))
    r = np.hypot(*np.meshgrid(grid.x, grid.y, indexing="ij"))
    u_x, u_y, u_z = fret.SurfaceOperator(upper, lower, grid).displacement(hertz.p(r))
    inside = r < 0.9 * hertz.a
    exact = hertz.delta_z - r**2 / (2 * R)
    # Half a per cent: the pressure is piecewise constant and steep at the edge.
    np.testing.assert_allclose(u_z[inside], exact[inside], atol=0.005 * hertz.delta_z)
    assert np.abs(u_x).max() < 1e-12 * hertz.delta_z
    assert np.abs(u_y).max() < 1e-12 * hertz.delta_z


def test_shear_and_pressure_answer_each_other_alike() -> None:
    """Reciprocity: the work of one load on the displacement of another is the same both ways."""
    bodies = fret.Body(fret.Elastic(E=210e9, nu=0.3)), fret.Body(fret.Elastic(E=70e9, nu=0.1))
    operator = fret.SurfaceOperator(*bodies, fret.Grid.from_spacing((12, 9), (1e-5, 2e-5)))
    rng = np.random.default_rng(1)
    first, second = rng.normal(size=(2, 3, 12, 9))
    u_first = operator.displacement(first[2], first[0], first[1])
    u_second = operator.displacement(second[2], second[0], second[1])
    work = (u_first * second).sum()
    assert work == pytest.approx((u_second * first).sum(), rel=1e-10)
    assert (u_first * first).sum() > 0


def test_a_field_of_another_shape_is_refused() -> None:
    upper, lower = (fret.Body(material) for material in pair(0.3))
    operator = fret.SurfaceOperator(upper, lower, fret.Grid.from_spacing((4, 6), (1e-5, 1e-5)))
    with pytest.raises(ValueError, match=r"p has the shape \(6, 4\): must be .* \(4, 6\)"):
        operator.displacement(np.ones((6, 4)))
