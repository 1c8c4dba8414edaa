"""Borders of the contact and of its stick zone lie where the closed form has them."""

from __future__ import annotations

import pytest

import pyfret as fret

pytestmark = pytest.mark.solves

STEEL = fret.Elastic(E=210e9, nu=0.3)
R, W, MU = 0.05, 3e5, 0.5


@pytest.mark.parametrize("n", [48, 64])
@pytest.mark.parametrize(("part", "sigma_B"), [(0.3, 0.0), (0.6, 30e6), (0.85, 30e6)])
def test_borders_are_known_to_their_error(n: int, part: float, sigma_B: float) -> None:
    line = fret.reference.line_contact(R=R, bodies=(STEEL, STEEL), W=W)
    scene = fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Cylinder(R=R)),
        body2=fret.Body(STEEL),
        friction=MU,
        grid=fret.Grid.strip(extent=2.5 * line.a, n=n),
    )
    path = fret.LoadPath.start().normal(W).force(T_x=part * MU * W, sigma_B=sigma_B)
    state = fret.solve(scene, path, progress=False).at(-1)
    stick, contact = state.stick_zone(), state.contact_zone()
    assert contact.error == pytest.approx(fret.subsurface.zones.WITHIN * scene.grid.dx)
    middle = line.stick_middle(eps_x=sigma_B * (1 - STEEL.nu**2) / STEEL.E, mu=MU)
    half_width = line.stick_half_width(T=part * MU * W, mu=MU)
    assert abs(stick.half_width - half_width) < stick.error
    assert abs(stick.middle - middle) < stick.error
    assert abs(contact.half_width - line.a) < contact.error
    assert abs(contact.middle) < contact.error
    assert repr(stick).count("+-") == 4
    assert "middle" in repr(stick)
