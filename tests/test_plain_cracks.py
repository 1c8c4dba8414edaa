"""Cracks under plain stress histories and in films; thresholds and growth constants."""

from __future__ import annotations

import copy
import pickle

import numpy as np
import pytest

import pyfret as fret
from pyfret import fracture

STEEL = fret.Elastic(E=210e9, nu=0.3)
F_0 = 1.121522255231


def test_uniform_tension_on_a_normal_crack() -> None:
    crack = fracture.Crack(legs=[(1e-4, 0.0)])
    stress = np.zeros((2, len(crack.points), 6))
    stress[0, :, 0] = 100e6
    K = crack.intensity(stress)
    assert K["K_I"][0] == pytest.approx(F_0 * 100e6 * np.sqrt(np.pi * 1e-4), rel=1e-7)
    assert K["error"][0] < 1e-6 * K["K_I"][0]
    stress[1, :, 0] = -50e6
    closed = crack.intensity(stress, friction=0.3)
    assert closed["K_I"][1] == 0.0
    assert closed["open"].tolist() == pytest.approx([1.0, 0.0])
    with pytest.raises(ValueError, match="must be"):
        crack.intensity(stress[:, :-1])


@pytest.mark.solves
def test_cracks_are_values() -> None:
    crack = fracture.Crack(legs=[(1e-4, 0.0), (2e-4, 0.3)], x=-1e-3)
    for again in (pickle.loads(pickle.dumps(crack)), copy.copy(crack)):
        assert np.array_equal(again.points, crack.points)
    assert repr(crack) == "Crack(legs=[(0.0001, 0.0), (0.0002, 0.3)], x=-0.001)"
    with pytest.raises(ValueError, match="length"):
        fracture.Crack(legs=[(-1e-4, 0.0)])


def test_thresholds() -> None:
    haddad = fracture.Threshold(dK_th=2.1e6, dS_0=124e6)
    assert haddad.a_0 == pytest.approx(91.29465388e-6)
    assert haddad.range_at(1e-5) == pytest.approx(0.659821e6, rel=1e-5)
    assert fracture.Threshold(2.1e6).range_at([1e-6, 1e-3]).tolist() == [2.1e6, 2.1e6]
    with pytest.raises(ValueError, match="dK_th"):
        fracture.Threshold(-1.0)
    unknown = fret.fatigue.Material("mine", [("s_D", 300e6, "a test")])
    with pytest.raises(ValueError, match="dK_th"):
        fracture.Threshold.from_material(unknown)
    own_material = fret.fatigue.Material(
        "mine", [("dK_th", 8e6, "a test"), ("s_D", 300e6, "another")]
    )
    assert fracture.Threshold.from_material(own_material) == fracture.Threshold(4e6, 300e6)


def test_growth_constants_of_the_table_of_materials() -> None:
    table = fret.fatigue.Materials()
    alloy = fracture.Threshold.from_material(table["aluminium_4Cu"])
    assert (alloy.dK_th, alloy.dS_0, alloy.walker) == (2.1e6, 124e6, None)
    assert alloy.a_0 == pytest.approx(91.29465388e-6)
    assert fracture.Paris.from_material(table["aluminium_7075_T6"]) == fracture.Paris(2.71e-11, 3.7)
    with pytest.raises(ValueError, match=r"aluminium_4Cu.*paris_C"):
        fracture.Paris.from_material(table["aluminium_4Cu"])
    own_material = fret.fatigue.Material(
        "mine", [("dK_th", 8e6, "a test"), ("s_D", 300e6, "one"), ("walker", 0.6, "another")]
    )
    assert fracture.Threshold.from_material(own_material).walker == 0.6
    assert fracture.Threshold.from_material(own_material, walker=0.9).walker == 0.9


@pytest.mark.solves
def test_growth_under_a_plain_history() -> None:
    """Under tension to and fro an inclined crack turns normal to it, and K_II vanishes."""
    crack = fracture.Crack(legs=[(1e-4, np.radians(40))])

    def tension(points: np.ndarray) -> np.ndarray:
        stress = np.zeros((2, len(points), 6))
        stress[0, :, 0] = 100e6
        return stress

    grown = crack.grow(tension, end=5e-4)
    assert abs(grown["angle"][-1]) < 0.05
    assert np.abs(grown["K_II"][0, 1:]).max() < 3e-3 * grown["K_I"][0, -1]
    depth = grown["z"][-1]
    assert grown["K_I"][0, -1] == pytest.approx(F_0 * 100e6 * np.sqrt(np.pi * depth), rel=2e-2)
    assert grown["path_error"] < 1e-2 * 4e-4

    def wrong(points: np.ndarray) -> np.ndarray:
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        crack.grow(wrong, end=5e-4)
    with pytest.raises(ValueError, match="direction"):
        crack.grow(tension, end=5e-4, direction="down")  # type: ignore[arg-type]


def test_kitagawa_of_uniform_tension() -> None:
    lengths = np.geomspace(1e-6, 1e-3, 20)
    K = 100e6 * np.sqrt(np.pi * lengths)
    cracks = fracture.Cracks.from_arrays(lengths, K, 0 * K)
    diagram = cracks.kitagawa(fracture.Threshold(2.1e6, 124e6))
    assert diagram["load"].values == pytest.approx(100e6)
    assert diagram.limit.values[0] == pytest.approx(124e6, rel=1e-2)
    assert cracks.scaled(0.5).K_max == pytest.approx(0.5 * K)
    assert fracture.ellipse_factor(1.0) == pytest.approx(0.590752, rel=1e-5)


def test_films() -> None:
    film = fret.Coating(STEEL, thickness=4e-6)
    G = fracture.channel_release(film, STEEL, 1e9)
    assert pytest.approx(1.975766 * 1e18 * 4e-6 * 0.91 / 210e9, rel=1e-5) == G
    assert fracture.channel_release(film, STEEL, -1e9) == 0.0
    stiff = fret.Coating(fret.Elastic(E=300.0 * STEEL.E, nu=0.3), thickness=1e-6)
    with pytest.raises(ValueError, match="channel_release: no solution"):
        fracture.channel_release(stiff, STEEL, 1e9)
    K = fracture.film_intensity(film, STEEL, 2e-6, 1e9)
    assert pytest.approx(F_0 * 1e9 * np.sqrt(np.pi * 2e-6), rel=1e-6) == K
    with pytest.raises(ValueError, match="depth"):
        fracture.film_intensity(film, STEEL, 5e-6, 1e9)
