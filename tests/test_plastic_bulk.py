"""Bodies that yield under a bulk stress: constant, reversed, in coatings, bent, refused."""

from __future__ import annotations

import numpy as np
import pytest

import pyfret as fret

pytestmark = [pytest.mark.solves, pytest.mark.filterwarnings("ignore")]

LAW = fret.Plastic(s_y=400e6, hardening=5e9)
BASE = fret.Elastic(E=116e9, nu=0.32)
SOFT = fret.Elastic(E=60e9, nu=0.3, plastic=LAW)
PLASTIC = fret.Elastic(E=116e9, nu=0.32, plastic=LAW)
NU = 0.32


def line(body2: fret.Body, path: fret.LoadPath, mu: float = 0.0) -> fret.Result:
    """A cylinder on a flat."""
    scene = fret.Scene(
        body1=fret.Body(BASE, shape=fret.Cylinder(R=20e-3)),
        body2=body2,
        friction=mu,
        grid=fret.Grid.strip(extent=3e-3, n=48),
        path=path,
    )
    return fret.solve(scene, progress=False, save="all")


def ball(body2: fret.Body, path: fret.LoadPath) -> fret.Result:
    """A ball on a flat."""
    scene = fret.Scene(
        body1=fret.Body(BASE, shape=fret.Sphere(R=10e-3)),
        body2=body2,
        friction=0.0,
        grid=fret.Grid.centred(width=7e-4, n=24),
        path=path,
    )
    return fret.solve(scene, progress=False, save="all")


def pressed(low: float, high: float, **bulk: float) -> fret.LoadPath:
    """Pressed lightly, stretched, pressed."""
    path = fret.LoadPath.start().normal(low, increments=1)
    if bulk:
        path = path.force(**bulk, increments=1)
    return path.normal(high, increments=3)


def same_strain(one: fret.Result, two: fret.Result) -> None:
    """Compare plastic strain, volume and approach of two runs."""
    strains = [float(run.largest_plastic_strain[-1]) for run in (one, two)]
    assert strains[0] > 1e-4
    # The passes of three increments end where the stress changes by 1e-4 of the yield stress.
    assert abs(strains[0] - strains[1]) < 2.0 * 3.0 * 1e-4 * LAW.s_y / (2.0 * 44e9)
    # Cells at the border of what yields count whole.
    for name, tolerance in (("plastic_volume", 2e-2), ("delta_z", 1e-4), ("p_max", 1e-4)):
        numbers = [float(run.dataset[name][-1]) for run in (one, two)]
        assert numbers[0] == pytest.approx(numbers[1], rel=tolerance), name


@pytest.mark.parametrize("sigma", [-150e6, 200e6])
def test_a_constant_bulk_stress_is_a_residual_stress(sigma: float) -> None:
    """Without friction it has no other part in a line contact, nor below a ball."""
    bulk = line(fret.Body(PLASTIC), pressed(1e4, 8e5, sigma_B=sigma))
    residual = [[0.0, sigma, NU * sigma]]
    same_strain(bulk, line(fret.Body(PLASTIC, residual=residual), pressed(1e4, 8e5)))
    turned = fret.Body(PLASTIC, bulk_azimuth=np.pi / 2)
    round_bulk = ball(turned, pressed(0.5, 60.0, sigma_B=sigma))
    residual = [[0.0, 0.0, sigma]]
    same_strain(round_bulk, ball(fret.Body(PLASTIC, residual=residual), pressed(0.5, 60.0)))


def test_a_coating_has_its_part_of_the_bulk_stress() -> None:
    """It is stretched like the substrate, s_xx = E'/(1 - nu'^2) (1 - nu^2) sigma_B/E."""
    sigma = 250e6
    stretched = 60e9 / (1 - 0.3**2) * (1 - NU**2) * sigma / 116e9
    film = fret.Coating(SOFT, thickness=100e-6)
    bulk = line(fret.Body(BASE, coatings=film), pressed(1e4, 6e5, sigma_B=sigma))
    strained = fret.Coating(SOFT, thickness=100e-6, residual=[[0.0, stretched, 0.3 * stretched]])
    same_strain(bulk, line(fret.Body(BASE, coatings=strained), pressed(1e4, 6e5)))


def test_a_bent_body_has_less_below() -> None:
    """The bulk stress falls to zero at the neutral plane."""
    sigma, depth = 200e6, 4e-3
    body = fret.Body(PLASTIC, bulk_neutral_depth=depth)
    bulk = line(body, pressed(1e4, 8e5, sigma_B=sigma))
    table = [[0.0, sigma, NU * sigma], [2 * depth, -sigma, -NU * sigma]]
    same_strain(bulk, line(fret.Body(PLASTIC, residual=table), pressed(1e4, 8e5)))


@pytest.mark.parametrize("lag", [1.0, -1.0, 0.0])
def test_energy_balances_under_a_bulk_stress_that_swings(lag: float) -> None:
    """Shear and bulk stress to and fro, in phase, against it, and one after the other."""
    W, mu, sigma = 8e5, 0.4, 150e6
    path = fret.LoadPath.start().normal(W, increments=3)
    for sign in (1.0, -1.0, 1.0):
        if lag:
            path = path.force(T_x=sign * 0.3 * mu * W, sigma_B=sign * lag * sigma, increments=3)
        else:
            path = path.force(T_x=sign * 0.3 * mu * W, increments=2)
            path = path.force(sigma_B=sign * sigma, increments=2)
    run = line(fret.Body(PLASTIC), path, mu)
    assert float(run.plastic_work.sum()) > 0.0
    assert float(np.abs(run.residual_energy).max()) < 1e-5
    # The bulk stress changes what yields.
    alone = line(fret.Body(PLASTIC), fret.LoadPath.start().normal(W, increments=3), mu)
    assert float(run.largest_plastic_strain[-1]) != pytest.approx(
        float(alone.largest_plastic_strain[-1]), rel=1e-3
    )


def test_the_stress_below_has_the_bulk_stress() -> None:
    """Sections and the plastic state have it; the yield surface is kept with it."""
    sigma = 200e6
    run = line(fret.Body(PLASTIC), pressed(1e4, 8e5, sigma_B=sigma))
    state = run.at(-1)
    on, off = (state.stress(z=[2e-4], y=0.0, bulk=bulk).s_xx.values for bulk in (True, False))
    assert np.allclose(on - off, sigma, rtol=1e-6)
    plastic = state.plastic().dataset
    s = plastic.stress.sel(component=["xx", "yy", "zz", "xz"]).to_numpy()
    xx, yy, zz, xz = np.moveaxis(s, 1, 0)
    mises = np.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3 * xz**2)
    limit = LAW.s_y + 5e9 * plastic.equivalent.to_numpy()
    assert (mises < 1.002 * limit).all()
    # The lowest plane, beside the contact.
    assert xx[-1, 0, 0] == pytest.approx(sigma, rel=0.35)


def test_a_layer_that_yields_as_a_whole_is_refused() -> None:
    """The bulk stress does it alone, or together with the residual stress."""
    W = fret.LoadPath.start().normal(8e5, increments=1)
    with pytest.raises(fret.errors.InvalidSceneError, match=r"body2 a stress .* as a whole"):
        line(fret.Body(PLASTIC), W.force(sigma_B=500e6, increments=1))
    strained = fret.Body(PLASTIC, residual=[[0.0, 300e6, 0.0]])
    with pytest.raises(fret.errors.InvalidSceneError, match="as a whole"):
        line(strained, W.force(sigma_B=200e6, increments=1))
    film = fret.Coating(SOFT, thickness=100e-6)
    with pytest.raises(fret.errors.InvalidSceneError, match=r"body2\.coatings\[0\] a stress"):
        line(fret.Body(BASE, coatings=film), W.force(sigma_B=900e6, increments=1))


def test_a_yielding_coating_on_a_dovetail_runs() -> None:
    """Copper-nickel-indium of 150 um under a pad, with the tension of the blade."""
    law = fret.Plastic(s_y=250e6, hardening=3e9)
    film = fret.Coating(fret.Elastic(E=60e9, nu=0.3, plastic=law), thickness=150e-6)
    scene = fret.Scene(
        body1=fret.Body(BASE, shape=fret.shapes.FlatPunch(radius=1.5e-3, edge=3e-3)),
        body2=fret.Body(BASE, coatings=film),
        friction=0.4,
        grid=fret.Grid.strip(extent=3.8e-3, n=64),
    )
    path = fret.LoadPath.start().force(W=5e5, increments=3)
    run = fret.solve(scene, path.force(T_x=1e5, sigma_B=300e6, increments=4), progress=False)
    assert float(run.largest_plastic_strain[-1]) > 0.0
    assert float(np.abs(run.residual_energy).max()) < 1e-4
