"""First yield and shakedown below contacts, against closed forms."""

from __future__ import annotations

import warnings

import matplotlib.pyplot as plt
import numpy as np
import pytest

import pyfret as fret
from conftest import T_MAX, R, W, pair, sphere_on_flat
from pyfret import fatigue

pytestmark = pytest.mark.solves

S_Y = 1e9
FACTORS = ("von_mises", "tresca", "shakedown")


@pytest.fixture(scope="module")
def pressed() -> fret.Result:
    """A sphere on a half-space, pressed only."""
    path = fret.LoadPath.start().normal(W, increments=2)
    return fret.solve(sphere_on_flat(n=32), path, save="all", progress=False)


@pytest.fixture(scope="module")
def coated_cycle() -> fret.Result:
    """A coated contact over a cycle."""
    path = fret.LoadPath.start().normal(W, increments=2)
    path = path.tangential([T_MAX, -T_MAX, T_MAX], increments=10)
    return fret.solve(sphere_on_flat(ratio=2.0, n=24), path, save="all", progress=False)


def test_a_sphere_yields_where_hertz_says(pressed: fret.Result) -> None:
    hertz = fret.reference.hertz(R=R, bodies=pair(0.3), W=W)
    factors = pressed.load_factors(S_Y, cycle=None)
    for of in ("von_mises", "tresca"):
        least = factors.least(of)
        # K. L. Johnson (1985) for nu = 0.3, to more digits: p_0 = 1.613 Y, 0.481 a deep.
        assert least.value * hertz.p0 / S_Y == pytest.approx(1.613, rel=5e-3)
        assert least.z / hertz.a == pytest.approx(0.481, abs=0.01)
        assert abs(least.x) < 0.02 * hertz.a
        assert least.y == 0.0
    assert "von_mises" in repr(factors)


def test_residual_stress_counts_for_yield_and_not_for_shakedown(pressed: fret.Result) -> None:
    z = [0.0, 1e-4, 2e-4]
    free = pressed.load_factors(S_Y, z, cycle=None).dataset
    held = pressed.load_factors(S_Y, z, cycle=None, residual=[-3e8]).dataset
    np.testing.assert_allclose(held.shakedown, free.shakedown, rtol=1e-9)
    # On the axis (s_xx - s_zz) = -d and the residual stress adds to it: (s_y + r)/d.
    middle = {"x": 16, "depth": 2}
    stress = pressed.at(-1).stress(z, y=0.0)
    d = float((stress.s_xx - stress.s_zz)[middle])
    assert d > 0.0
    assert float(held.tresca[middle]) == pytest.approx((S_Y + 3e8) / d, rel=5e-3)
    with pytest.raises(ValueError, match="constant stress"):
        pressed.load_factors(S_Y, z, cycle=None, residual=[-2e9])


def test_layers_have_their_own_limits(coated_cycle: fret.Result) -> None:
    steel = fatigue.Materials()["steel_4340"]
    both = coated_cycle.load_factors([3e9, steel])
    single = coated_cycle.load_factors([None, 1103e6])
    for of in ("von_mises", "tresca", "shakedown"):
        assert both.least_of(1, of) == single.least_of(1, of) == single.least(of)
        assert both.least(of).value == min(both.least_of(n, of).value for n in (0, 1))
    assert single.layers == [1]
    assert np.isnan(single.dataset.tresca.values[single.dataset.layer.values == 0]).all()
    # Tresca's condition is the stricter one.
    assert (both.dataset.tresca <= both.dataset.von_mises * (1 + 1e-12)).all()
    volume = coated_cycle.load_factors(S_Y, [0.0, 1e-4], y=[0.0, 1e-4])
    assert volume.dataset.tresca.dims == ("depth", "x", "y")
    with pytest.raises(ValueError, match="layer 0 is not judged"):
        single.least_of(0)
    with pytest.raises(ValueError, match="3 yield stresses"):
        coated_cycle.load_factors([1e9, 1e9, 1e9])
    with pytest.raises(ValueError, match="must be one of von_mises"):
        both.least("mises")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="one section"):
        fret.plot.load_factor_map(volume)
    for of in ("von_mises", "shakedown"):
        ax = fret.plot.load_factor_map(both, of=of)  # type: ignore[arg-type]
        assert ax.get_ylim()[0] > ax.get_ylim()[1]
        legend = ax.get_legend()
        assert legend is not None
        assert any("of the limit" in text.get_text() for text in legend.get_texts())
    plt.close("all")


@pytest.mark.parametrize("mu", [0.0, 0.2, 0.34, 0.39, 0.6])
def test_a_sliding_cylinder_shakes_down_where_johnson_says(mu: float) -> None:
    """Line contact that slides: p_0/k = 4 without friction, 1/mu beyond mu = 0.367."""
    k = S_Y / np.sqrt(3)
    limits, where = {}, {}
    for nu in (0.3, 0.4999):
        steel = fret.Elastic(E=210e9, nu=nu)
        line = fret.reference.line_contact(R=0.05, bodies=(steel, steel), W=2e5)
        grid = fret.Grid.strip(extent=6.0 * line.a, n=300)
        p = line.p0 * np.sqrt(np.maximum(1 - (grid.x[:, None] / line.a) ** 2, 0.0))
        z = np.linspace(0.0, line.a, 41)
        stress = fret.subsurface.stress(fret.Body(steel), grid, z, p=p, q_x=mu * p, y=0.0, rim=True)
        # A place sees the stresses along x of its depth as the contact passes.
        passing = np.stack([stress.measure(c).values.T for c in fatigue.COMPONENTS], axis=-1)
        shakedown = fatigue.moving_load(passing, s_y=S_Y) * line.p0 / k
        limits[nu], where[nu] = float(shakedown.min()), z[shakedown.argmin()] / line.a
        # No residual stress helps against s_xz.
        assert (shakedown <= line.p0 / np.abs(passing[..., 4]).max(axis=0) * (1 + 1e-9)).all()
    # s_yy of an incompressible material lies midway: von Mises' condition is max shear = k.
    # The surface is sampled at cells of a/50, whose largest pressure is within 1e-4 of p_0.
    if mu > 0.367:
        assert limits[0.4999] == pytest.approx(1 / mu, rel=2e-3)
        assert where[0.4999] == 0.0
    else:
        assert 1 / 0.367 < limits[0.4999] < 1 / max(mu, 0.1)
        assert 0.25 < where[0.4999] < 0.55
    if mu == 0.0:
        # Here s_yy is the same at both places that decide.
        assert limits[0.4999] == pytest.approx(4.0, rel=1e-3)
        assert limits[0.3] == pytest.approx(4.0, rel=1e-3)
    # Otherwise the range of s_yy takes its part of von Mises' stress.
    assert limits[0.3] <= limits[0.4999] * (1 + 1e-9)


def test_a_stress_that_does_not_change_has_no_limit_of_shakedown() -> None:
    # Without friction a shift changes nothing: the layer is pressed once and stays so.
    steel = fret.Elastic(E=210e9, nu=0.3)
    path = fret.LoadPath.start().normal(W, increments=1)
    path = path.displace(delta_x=[1e-6, -1e-6, 1e-6], increments=2)
    a = fret.reference.hertz(R=R, bodies=(steel, steel), W=W).a
    scene = fret.Scene(
        body1=fret.Body(steel, shape=fret.Sphere(R=R)),
        body2=fret.Body(steel),
        friction=0.0,
        grid=fret.Grid.centred(width=3 * a, n=32),
        path=path,
    )
    factors = fret.solve(scene, save="all", progress=False).load_factors(S_Y)
    least = factors.least("shakedown")
    assert least.value == np.inf
    assert least.error == 0.0
    assert 0.0 < factors.least("von_mises").value < np.inf


#: Cells across 2.6 a.
GRIDS = (40, 48, 56, 64, 72, 80, 96, 128)


def fretted(kind: str, n: int) -> fret.Result:
    """A titanium line or ball, bare or coated, over a cycle of shear and bulk stress in phase."""
    body, mu = fret.Elastic(E=115e9, nu=0.32), 0.55
    shape: fret.Cylinder | fret.Sphere
    if kind.startswith("line"):
        load, shape = 3e5, fret.Cylinder(R=0.04)
        hertz = fret.reference.line_contact(R=0.04, bodies=(body, body), W=load)
        grid = fret.Grid.strip(extent=2.6 * hertz.a, n=n)
    else:
        load, shape = 15.0, fret.Sphere(R=8e-3)
        hertz = fret.reference.hertz(R=8e-3, bodies=(body, body), W=load)
        grid = fret.Grid.centred(width=2.6 * hertz.a, n=n)
    layers = []
    if kind.endswith("coated"):
        coating = fret.Elastic(E=2.2 * body.E, nu=0.25)
        layers = [fret.Coating(coating, thickness=0.12 * hertz.a)]
    path = fret.LoadPath.start().normal(load)
    for sign in (1, -1, 1):
        path = path.force(T_x=sign * 0.5 * mu * load, sigma_B=sign * 0.3 * hertz.p0)
    scene = fret.Scene(
        body1=fret.Body(body, shape=shape),
        body2=fret.Body(body, coatings=layers),
        friction=mu,
        grid=grid,
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", fret.errors.SceneWarning)
        return fret.solve(scene, path, save="all", progress=False)


def agree(kind: str, finest: int, grids: tuple[int, ...]) -> None:
    """Factors and lives of all layers on some grids lie within their errors of the finest grid."""
    titanium = fatigue.Materials()["titanium_6Al4V"]
    layers = [0, 1] if kind.endswith("coated") else [0]
    criteria = ("smith_watson_topper", "fatemi_socie")
    fine = fretted(kind, finest)
    limits, materials = [9e8] * len(layers), [titanium] * len(layers)
    right = fine.load_factors(limits)
    lives = {of: fine.life(materials, of) for of in criteria}
    for n in grids:
        result = fretted(kind, n)
        factors = result.load_factors(limits)
        assert "+-" in repr(factors)
        for layer in layers:
            for of in FACTORS:
                least, truth = factors.least_of(layer, of), right.least_of(layer, of).value
                off, label = abs(least.value - truth), f"{kind}, {n} cells, {of}: {least}, {truth}"
                assert off < max(0.04 * truth, least.error), label
                assert 1 / 1.5 < least.value / truth < 1.5, label
        for of in criteria:
            life = result.life(materials, of)
            for layer in layers:
                worst, truth = life.worst_of(layer), lives[of].worst_of(layer).margin
                low, high = worst.range
                assert low <= worst.margin <= high
                assert low <= truth <= high, f"{kind}, {n} cells, {of}: {worst}, {truth}"


def test_a_worst_point_beyond_the_grid_does_not_depend_on_it() -> None:
    """Bulk stress out of phase is worst at 1.7 a below a coating, where the grid ends at 1.3 a."""
    steel, mu, R, W = fret.Elastic(E=210e9, nu=0.3), 0.8, 0.02, 45e3
    hard = fret.Elastic(E=420e9, nu=0.3)
    a = fret.reference.line_contact(R=R, bodies=(hard, steel), W=W)
    film = fret.Coating(fret.Elastic(E=115e9, nu=0.25), thickness=0.3 * a.a)
    path, T, bulk = fret.LoadPath.start().normal(W, increments=12), 0.37 * mu * W, 0.46 * a.p0
    for to, sigma_B in ((T, 0.0), (0.0, bulk), (-T, 0.0), (0.0, -bulk), (T, 0.0)):
        path = path.force(T_x=to, sigma_B=sigma_B, increments=5)
    material, found = fatigue.Materials()["steel_42CrMo4"], []
    for n in (32, 64):
        scene = fret.Scene(
            body1=fret.Body(hard, shape=fret.Cylinder(R=R)),
            body2=fret.Body(steel, coatings=[film]),
            friction=mu,
            grid=fret.Grid.strip(extent=2.6 * a.a, n=n),
        )
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", fret.errors.SceneWarning)
            result = fret.solve(scene, path, save="all", progress=False)
        found.append(result.life([material, material], "crossland").worst_of(1))
    coarse, fine = found
    assert abs(fine.x) > 1.4 * a.a
    assert abs(coarse.x) == pytest.approx(abs(fine.x), rel=0.02)
    assert coarse.margin == pytest.approx(fine.margin, rel=2e-3)


@pytest.mark.slow
@pytest.mark.timeout(1800)
@pytest.mark.parametrize("kind", ["line bare", "line coated"])
def test_least_factors_and_lives_of_lines_do_not_depend_on_the_grid(kind: str) -> None:
    # Just after a reversal the ring of reverse slip is narrower than a cell of all but the finest.
    agree(kind, 512, GRIDS)


@pytest.mark.slow
@pytest.mark.timeout(1800)
@pytest.mark.parametrize("kind", ["ball bare", "ball coated"])
def test_least_factors_and_lives_of_balls_do_not_depend_on_the_grid(kind: str) -> None:
    agree(kind, 160, GRIDS)
