"""A threshold and a law of growth are given as such, as a material, or by the name of one."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import pyfret as fret
from pyfret import fatigue, fracture, plot

ALLOY = fatigue.Materials()["7075"]
#: K that falls, so that cracks stop, and K that rises.
LENGTHS = np.geomspace(1e-5, 1e-3, 12)
CRACKS = fracture.Cracks.from_arrays(LENGTHS, 1e7 * (LENGTHS / 1e-5) ** 0.3, np.zeros(12))
FILM = fret.Coating(fret.Elastic(E=400e9, nu=0.25), thickness=2e-6, residual=-2e9)
STEEL = fret.material("steel")


@pytest.mark.parametrize("given", ["7075-T6", ALLOY, fracture.Threshold.from_material("7075")])
def test_a_threshold_is_that_of_a_material(given: Any) -> None:
    right = fracture.Threshold.from_material(ALLOY)
    assert CRACKS.arrest(given) == CRACKS.arrest(right)
    np.testing.assert_array_equal(CRACKS.dK(given), CRACKS.dK(right))
    assert CRACKS.kitagawa(given).equals(CRACKS.kitagawa(right))
    assert fret.study.Arrest(given).threshold == right
    assert fret.study.FirstToFail(threshold=given).threshold == right
    assert plot.crack_arrest(CRACKS, given).lines
    # The law of growth belongs to the same material, or is the given one.
    law = fracture.Paris.from_material(ALLOY)
    assert CRACKS.life(given) == CRACKS.life(right, law) == CRACKS.life(given, "7075")
    assert CRACKS.life(given, fracture.Paris(1e-12, 3.0)).cycles != CRACKS.life(given).cycles


def test_what_has_no_law_is_refused_with_the_way() -> None:
    own_threshold = fracture.Threshold(2e6, 200e6)
    with pytest.raises(ValueError, match=r"paris: the threshold has no law of growth, give Paris"):
        CRACKS.life(own_threshold)
    with pytest.raises(ValueError, match=r"threshold: no material 'unobtainium'"):
        CRACKS.arrest("unobtainium")
    with pytest.raises(ValueError, match=r"paris"):
        CRACKS.life(own_threshold, "titanium_6Al4V")
    assert fracture.Threshold.from_material("titanium_6Al4V").growth is None


def test_a_film_has_its_own_residual_stress() -> None:
    given_value = FILM.residual
    assert isinstance(given_value, float)
    bare = FILM.replace(residual=None)
    item: list[Any] = [
        lambda *stress: fracture.edge_release(*stress),
        lambda film, *stress: fracture.channel_release(film, STEEL, *stress),
        lambda film, *stress: fracture.buckling_release(film, *stress, half_width=5e-5),
        lambda film, *stress: fracture.film_intensity(film, STEEL, 1e-6, *stress),
    ]
    for element in item:
        assert element(FILM) == element(bare, given_value)
        with pytest.raises(ValueError, match=r"stress: give the stress of the coating"):
            element(bare)
    assert fracture.edge_release(FILM) > 0.0


SCENE = fret.Scene(
    body1=fret.Body(STEEL, shape=fret.Cylinder(R=1e-2)),
    body2=fret.Body(STEEL),
    friction=0.3,
    grid=fret.Grid.strip(extent=4e-4, n=16),
    path=fret.LoadPath.start().normal(1e5).cycles(1, T_x=1e4, increments=4),
)


def test_several_criteria_are_those_of_lives() -> None:
    several: Any = ["crossland", "dang_van"]
    result = fret.solve(SCENE, save="all", progress=False)
    with pytest.raises(TypeError, match=r"fatigue.lives\(result, materials, \[...\]\) evaluates"):
        result.life(ALLOY, several)
    assert list(fatigue.lives(result, ALLOY, several)) == several


def test_a_word_of_others_names_what_it_means() -> None:
    at = fret.solve(SCENE, save="all", progress=False).at(-1)
    for element, name, expected_name in (
        (SCENE, "save", "to_toml"),
        (SCENE, "to_file", "to_toml"),
        (SCENE.grid, "extent", "nx and dx"),
        (at.stress(), "max", "maximum"),
    ):
        with pytest.raises(AttributeError, match=f"it is called {expected_name}"):
            getattr(element, name)
