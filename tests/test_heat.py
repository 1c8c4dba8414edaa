"""Contact temperature of a run: closed forms, sharing, time, refusals, figures."""

from __future__ import annotations

from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pytest
import xarray as xr

import pyfret as fret
from conftest import MU, T_MAX, sphere_on_flat
from conftest import W as LOAD
from pyfret import fatigue
from pyfret.heat import Conductor

pytestmark = pytest.mark.solves

STEEL = Conductor(conductivity=45.0, heat_capacity=3.6e6)
SHIFT = 40e-6
STEEL_E = fret.Elastic(E=210e9, nu=0.3)
POOR = Conductor(conductivity=3.0, heat_capacity=2.0e6)


@pytest.fixture(scope="module")
def sliding() -> fret.Result:
    """Like spheres that slide by far more than they give, over one closed cycle."""
    path = fret.LoadPath.start().normal(LOAD, increments=1)
    path = path.displace(delta_x=[SHIFT, -SHIFT, SHIFT], increments=60)
    return fret.solve(sphere_on_flat(n=32), path, save="all", progress=False)


@pytest.fixture(scope="module")
def coated() -> fret.Result:
    path = fret.LoadPath.start().normal(LOAD, increments=2)
    path = path.tangential([T_MAX, -T_MAX, T_MAX], increments=15)
    return fret.solve(sphere_on_flat(ratio=2.0, n=16), path, save="all", progress=False)


def test_gross_slip_heats_as_the_source_of_hertz_shape(sliding: fret.Result) -> None:
    """q_0 = mu p_H times the mean speed; pi q_0 a/(8 K) in each of two bodies alike."""
    frequency = 1e-6
    computed = sliding.temperature(STEEL, STEEL, frequency=frequency)
    loop = sliding.loops().isel(cycle=-1)
    heat = float(loop.dissipated) * frequency
    np.testing.assert_allclose(computed.attrs["heat_into_body1"], heat / 2, rtol=1e-6)
    np.testing.assert_allclose(computed.attrs["heat_into_body2"], heat / 2, rtol=1e-6)
    q_0 = 1.5 * heat / (np.pi * sliding.a_H**2)
    expected = np.pi * q_0 * sliding.a_H / (8 * STEEL.conductivity)
    # Of the middle four cells half a diagonal off: T falls like 1 - r^2/(2 a^2).
    off = (sliding.scene.grid.dx**2 / 2) / (2 * sliding.a_H**2)
    # What the spheres give, u = u_0 (1 - r^2/(2 a^2)) of each half stroke, does not slip; it is
    # largest in the middle. The mean of u over the heat is 0.8 u_0; what is missing in the
    # middle, 1 - r^2/(2 a^2) - 0.8, is 0.075 of it where sources count by 1/r.
    elastic = sliding.scene.body1.substrate
    give = 3 * MU * LOAD * (2 - elastic.nu) / (8 * elastic.G * sliding.a_H)
    unslipped = 0.075 * give / (SHIFT - 0.8 * give)
    assert float(computed.steady.max()) == pytest.approx(
        expected * (1 - off) * (1 - unslipped), rel=2e-3
    )
    # So slow a cycle is quasi-steady. Heat goes as |sin| but while the spheres give, so that its
    # largest value over the mean is pi/2 times all of the stroke over what of it slips; the
    # harmonics of the kept increments round the edges off.
    slips = (1 - 0.8 * give / SHIFT) * (1 - unslipped)
    ratio = float(computed.largest.max() / computed.steady.max())
    assert ratio == pytest.approx(np.pi / 2 / slips, rel=1e-2)


def test_a_fast_cycle_hardly_swings(sliding: fret.Result) -> None:
    heat = sliding.temperature(STEEL, STEEL, frequency=1e7)
    swing = float(heat.flash.max()) / float(heat.steady.max())
    assert 0.0 < swing < 0.01
    steady = sliding.temperature(STEEL, STEEL, frequency=1e7, harmonics=0)
    np.testing.assert_allclose(steady.steady, heat.steady, rtol=1e-12)
    assert float(abs(steady.flash).max()) == 0.0


@pytest.fixture(scope="module")
def in_many_harmonics(sliding: fret.Result) -> dict[float, Any]:
    """Compute the heat of gross slip at rates above the slowest, in 128 harmonics."""
    slowest = 1e-4 * STEEL.conductivity / STEEL.heat_capacity / sliding.a_H**2
    return {
        times: sliding.temperature(
            STEEL, STEEL, frequency=times * slowest, wave="linear", harmonics=128
        ).attrs
        for times in (1e2, 1e4, 1e6)
    }


@pytest.mark.parametrize("harmonics", [8, 16, 32, 64])
def test_heat_that_stops_at_once_does_not_overshoot(
    sliding: fret.Result, in_many_harmonics: dict[float, Any], harmonics: int
) -> None:
    """Heat of gross slip at a constant rate is even, and ends at the reversal."""
    a, K = sliding.a_H, STEEL.conductivity
    slowest = 1e-4 * K / STEEL.heat_capacity / a**2
    heat = sliding.temperature(
        STEEL, STEEL, frequency=slowest, wave="linear", harmonics=harmonics
    ).attrs
    # Quasi-steady: pi q_0 a/(8 K) for q_0 = mu p_H times the speed, four ways in a period.
    q_0 = 1.5 * MU * LOAD / (np.pi * a**2) * 4.0 * SHIFT * slowest
    right = np.pi * q_0 * a / (8.0 * K)
    assert heat["maximum"] == pytest.approx(right, rel=0.01)
    assert 0.0 < heat["maximum_error"] < 0.03 * right
    for times, many in in_many_harmonics.items():
        few = sliding.temperature(
            STEEL, STEEL, frequency=times * slowest, wave="linear", harmonics=harmonics
        ).attrs
        assert few["maximum"] == pytest.approx(many["maximum"], rel=0.01)
        assert abs(few["maximum"] - many["maximum"]) <= few["maximum_error"]


def test_surfaces_agree_where_they_touch(coated: fret.Result) -> None:
    heat = coated.temperature(STEEL, [POOR, STEEL], frequency=50.0, bulk=(293.0, 298.0))
    contact = np.any(coated.dataset.contact.values[5:], axis=0)
    first, two = heat.steady.values
    warm = float(heat.steady.max()) - 293.0
    np.testing.assert_allclose(first[contact], two[contact], atol=1e-6 * warm)
    assert heat.attrs["maximum"] == float(heat.largest.max())
    hottest = heat.largest.sel(body=heat.attrs["maximum_body"])
    at = hottest.sel(x=heat.attrs["maximum_x"], y=heat.attrs["maximum_y"])
    assert float(at) == heat.attrs["maximum"]
    # The insulating coating sends heat to body 1, and what is warmer warms the other.
    alone = coated.temperature(STEEL, [POOR, STEEL], frequency=50.0)
    assert alone.attrs["heat_into_body1"] > alone.attrs["heat_into_body2"] > 0
    assert heat.attrs["heat_into_body1"] > alone.attrs["heat_into_body1"]


def test_time_within_a_branch(sliding: fret.Result) -> None:
    """A sine heats the middle of the stroke more than a constant rate."""
    slow = [
        sliding.temperature(STEEL, STEEL, frequency=1e-6, wave=wave).attrs["maximum"]
        for wave in ("sine", "linear")
    ]
    assert slow[0] > 1.2 * slow[1]


def test_materials_stand_for_conductors(coated: fret.Result) -> None:
    table = fatigue.Materials()
    titanium, alumina = table["titanium_6Al4V"], table["alumina"]
    by_name = coated.temperature(titanium, [alumina, STEEL], frequency=10.0)
    given_value = coated.temperature(
        Conductor(conductivity=6.7, heat_capacity=4430.0 * 610.0),
        [Conductor(conductivity=33.0, heat_capacity=3984.0 * 755.0), STEEL],
        frequency=10.0,
    )
    xr.testing.assert_identical(by_name, given_value)
    with pytest.raises(ValueError, match=r"steel_4340.*conductivity"):
        coated.temperature(table["steel_4340"], STEEL, frequency=10.0)


def test_refusals(coated: fret.Result) -> None:
    with pytest.raises(ValueError, match="frequency = 0"):
        coated.temperature(STEEL, STEEL, frequency=0.0)
    with pytest.raises(
        ValueError, match=r"conductor2 = 1 conductors: must be one for each of the 2"
    ):
        coated.temperature(STEEL, [STEEL], frequency=1.0)
    bad = Conductor(conductivity=-1.0, heat_capacity=3.6e6)
    with pytest.raises(ValueError, match=r"conductor1\[0\].conductivity = -1"):
        coated.temperature(bad, STEEL, frequency=1.0)
    with pytest.raises(ValueError, match="wave = 'square'"):
        coated.temperature(STEEL, STEEL, frequency=1.0, wave="square")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="harmonics = -1"):
        coated.temperature(STEEL, STEEL, frequency=1.0, harmonics=-1)
    some = fret.solve(coated.scene, coated.scene.path, save=[10, 14, 17], progress=False)
    with pytest.raises(ValueError, match="increment 5 were not kept"):
        some.temperature(STEEL, STEEL, frequency=1.0)
    strip = fret.Scene(
        body1=fret.Body(STEEL_E, shape=fret.Cylinder(R=0.01)),
        body2=fret.Body(STEEL_E),
        friction=0.3,
        grid=fret.Grid.strip(extent=4e-4, n=16),
    )
    path = fret.LoadPath.start().normal(1e5, increments=1)
    line = fret.solve(strip, path.tangential([1e4, -1e4, 1e4], increments=5), save="all")
    with pytest.raises(ValueError, match=r"grid\.plane_strain"):
        line.temperature(STEEL, STEEL, frequency=1.0)
    pressed = fret.solve(strip, path, save="all")
    with pytest.raises(ValueError, match="no closed cycle"):
        pressed.temperature(STEEL, STEEL, frequency=1.0)


def test_figures(coated: fret.Result) -> None:
    heat = coated.temperature(STEEL, POOR, frequency=50.0)
    ax = fret.plot.temperature(heat)
    # The mean temperatures of bodies that touch are one line.
    labels = [str(line.get_label()) for line in ax.lines]
    assert labels == ["largest, body 1", "largest, body 2", "mean, both bodies"]
    mapped = fret.plot.temperature_map(heat, of="flash", body_number=1, units="SI")
    shown = mapped.images[0].get_array()
    np.testing.assert_allclose(shown, heat.flash.sel(body=1).values.T)
    with pytest.raises(ValueError, match="of = 'hot'"):
        fret.plot.temperature_map(heat, of="hot")  # type: ignore[arg-type]
    plt.close("all")
