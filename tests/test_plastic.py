"""Bodies that yield, as a user meets them."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

import pyfret as fret

STEEL = fret.Elastic(E=210e9, nu=0.3, plastic=fret.Plastic(s_y=1e9, hardening=1e10))


def indentation(material: fret.Elastic = STEEL, **changes: object) -> fret.Scene:
    """A rigid ball on a flat, pressed to 2.5 times the approach of first yield."""
    return fret.Scene(
        body1=fret.Body(fret.RIGID, shape=fret.Sphere(R=10e-3)),
        body2=fret.Body(material),
        mu=0.0,
        grid=fret.Grid.centred(extent=5.6e-4, n=24),
        path=fret.LoadPath.start().normal(120.0, increments=3).normal(1.0, increments=1),
        **changes,
    )


def test_what_yields_is_told_with_its_residual_stress_and_imprint() -> None:
    """Volume, depth, imprint and residual stress of a march, and the numbers of every increment."""
    states = []
    for increment in fret.march(indentation()):
        states.append((increment.plastic(), float(increment.plastic_volume)))
    loaded, unloaded = states[2][0], states[3][0]
    assert loaded.volume() > 0
    assert loaded.volume() == pytest.approx(states[2][1])
    assert 0 < loaded.depth() < 3e-4
    assert 1e-4 < loaded.largest() < 0.02
    # Nothing yields anew while the load comes off.
    assert unloaded.volume() == loaded.volume()
    imprint = unloaded.dataset.imprint
    assert 0 < float(imprint.max()) < 2e-6
    yield_stress = 1e9 + 1e10 * loaded.largest()
    s = loaded.dataset.stress.sel(component=["xx", "yy", "zz", "xy", "xz", "yz"]).to_numpy()
    xx, yy, zz, xy, xz, yz = np.moveaxis(s, 1, 0)
    mises = np.sqrt(
        0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3 * (xy**2 + xz**2 + yz**2)
    )
    assert mises.max() < 1.002 * yield_stress


def test_the_energy_of_every_increment_balances() -> None:
    """Displacements without tractions do work, too."""
    result = fret.solve(indentation(), progress=False)
    assert float(result.plastic_work.sum()) > 0
    assert float(np.abs(result.residual_energy).max()) < 1e-6


def test_bodies_that_do_not_yield_have_the_bits_of_elastic_ones() -> None:
    """A yield stress that is not reached changes nothing."""
    hard = fret.Elastic(E=210e9, nu=0.3, plastic=fret.Plastic(s_y=1e12))
    elastic = fret.solve(indentation(fret.Elastic(E=210e9, nu=0.3)), progress=False)
    found = fret.solve(indentation(hard), progress=False)
    for name in ("W", "delta_z", "p_max", "p"):
        np.testing.assert_array_equal(found.dataset[name], elastic.dataset[name])


def test_a_scene_file_keeps_the_law() -> None:
    """Written and read again it is the same scene."""
    scene = indentation()
    assert fret.Scene.from_toml(scene.to_toml()) == scene
    assert "plastic = " in scene.to_toml()
    assert scene.body2.substrate.plastic == fret.Plastic(s_y=1e9, hardening=1e10)


@pytest.mark.parametrize(
    ("numbers", "key"),
    [({"s_y": 0.0}, "s_y"), ({"s_y": float("nan")}, "s_y")]
    + [
        ({"s_y": 1e9, name: bad}, name)
        for name, bad in itertools.product(("hardening", "kinematic"), (-1.0, float("inf")))
    ],
)
def test_numbers_without_meaning_are_refused_by_name(numbers: dict[str, float], key: str) -> None:
    """The message names the key."""
    with pytest.raises(fret.errors.InvalidSceneError, match=f"plastic.{key}"):
        fret.Plastic(**numbers)


def test_stress_of_elastic_bodies_is_refused() -> None:
    """A section would lack the residual stress."""
    result = fret.solve(indentation(), progress=False)
    with pytest.raises(fret.errors.ArgumentError, match="plastic"):
        result.at(-1).stress()


def test_a_material_of_the_table_yields_only_when_asked() -> None:
    """Its yield stress is that of the table; a material without one is refused."""
    assert fret.material("titanium_6Al4V").plastic is None
    alloy = fret.material("titanium_6Al4V", plastic=True)
    assert alloy.plastic == fret.Plastic(s_y=1185e6)
    with (
        pytest.warns(fret.errors.SceneWarning),
        pytest.raises(ValueError, match=r"no yield stress.*plastic=Plastic\(s_y"),
    ):
        fret.material("CrN", plastic=True)
