"""The solution against closed forms, from Python."""

from __future__ import annotations

from typing import Any

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


def test_stick_radius_on_the_first_loading(similar: tuple[float, fret.Result]) -> None:
    nu, result = similar
    exact = mindlin(nu).stick_radius(T_MAX)
    radius = np.sqrt(float(result.at(0.2).stick_area) / np.pi)
    # Of nu = 0.3 the stick zone is a slightly elongated ellipse of nearly the same area.
    assert radius == pytest.approx(exact, abs=HALF_CELL * result.a_H)


@pytest.mark.parametrize(
    ("t", "part", "T"),
    [
        (0.2, "q_loading", T_MAX),
        (0.3, "q_unloading", 0.0),
        (0.4, "q_unloading", -T_MAX),
        (0.5, "q_reloading", 0.0),
        (0.6, "q_reloading", T_MAX),
        (1.0, "q_reloading", T_MAX),
    ],
)
def test_shear_on_the_centre_line(
    similar: tuple[float, fret.Result], t: float, part: str, T: float
) -> None:
    nu, result = similar
    cut = result.at(t).along_x()
    turn = {} if part == "q_loading" else {"T_m": T_MAX}
    exact = getattr(mindlin(nu), part)(np.abs(cut.x.values), T=T, **turn)
    scale = np.linalg.norm(mindlin(nu).q_loading(np.abs(cut.x.values), T=T_MAX))
    # Two cells of the 64 straddle a kink of the closed form; they make up the whole error.
    assert np.linalg.norm(cut.q_x.values - exact) < 0.04 * scale


def test_the_loop_dissipates_what_the_closed_form_says(
    similar: tuple[float, fret.Result],
) -> None:
    nu, result = similar
    per_branch = result.branches().dissipated.values
    exact = mindlin(nu).loop_energy(T_MAX)
    assert per_branch[2] + per_branch[3] == pytest.approx(exact, rel=0.02)
    assert per_branch[4] + per_branch[5] == pytest.approx(exact, rel=0.02)


def test_shift_along_the_loop(similar: tuple[float, fret.Result]) -> None:
    nu, result = similar
    d = result.dataset
    way_down = d.branch_of_increment.values == 2
    shift = mindlin(nu).shift_unloading(d.T_x.values[way_down], T_m=T_MAX)
    limit = mindlin(nu).shift_limit
    np.testing.assert_allclose(d.delta_x.values[way_down] / limit, shift / limit, atol=0.01)


def test_similar_bodies_pressed_together_have_no_shear(
    similar: tuple[float, fret.Result],
) -> None:
    _, result = similar
    assert float(result.at(0.1).q_max) == 0.0


def test_stresses_of_closed_forms_take_places_that_fit_together() -> None:
    """Every closed form of a stress, over arrays of any shapes that numpy puts together."""
    steel = fret.Elastic(E=210e9, nu=0.3)
    line = fret.reference.line_contact(R=0.02, bodies=(steel, steel), W=3e5)
    ball = fret.reference.HertzStress(a=1e-4, nu=0.3)
    T, middle = 0.5 * 0.4 * 3e5, 0.1 * line.a

    def of_line(x: Any, z: Any) -> list[Any]:
        return line.stress(x, z, T=T, mu=0.4, middle=middle)

    x, y, z = line.a * np.linspace(-2, 2, 5)[:, None], 2e-5, line.a * np.linspace(0, 1, 4)
    for call, places in ((of_line, (x, z)), (ball.pressure, (x, y, z)), (ball.shear, (x, y, z))):
        computed = call(*places)
        whole = [np.broadcast_to(item, (5, 4)) for item in places]
        for at in np.ndindex(5, 4):
            alone = call(*(float(item[at]) for item in whole))
            assert [float(item[at]) for item in computed] == [float(item) for item in alone]
        with pytest.raises(ValueError, match=r"must fit .* of the other places"):
            call(*places[:-1], np.zeros((3, 4)))
    # At the surface the stress equals the tractions, and the stick zone is the one passed in.
    _, s_zz, s_xz = of_line(x[:, 0], 0.0)
    assert s_zz == pytest.approx(-line.p(x[:, 0]), abs=1e-9 * line.p0)
    q = line.q(x[:, 0], T=T, mu=0.4, middle=middle)
    assert s_xz == pytest.approx(-q, abs=1e-9 * line.p0)
