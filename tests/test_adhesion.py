"""Loads of which adhesion is no small part are doubted, with the pull-off force."""

from __future__ import annotations

import re
import warnings
from math import pi

import pytest

import pyfret as fret
from pyfret.errors import SceneWarning

GLASS = fret.Elastic(E=70e9, nu=0.2)
RADIUS = 10e-6
#: Work of adhesion of van der Waals forces that the doubt takes [J/m^2].
WORK = 0.05


def doubts_of_load(W: float) -> list[str]:
    """Return the doubts of a glass colloid on glass."""
    a = fret.reference.hertz(R=RADIUS, bodies=(GLASS, GLASS), W=W).a
    scene = fret.Scene(
        body1=fret.Body(GLASS, shape=fret.Sphere(R=RADIUS)),
        body2=fret.Body(GLASS),
        friction=0.0,
        grid=fret.Grid.centred(width=2.6 * a, n=24),
        path=fret.LoadPath.start().normal(W, increments=1),
    )
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", SceneWarning)
        fret.solve(scene, progress=False)
    return [str(item.message) for item in caught]


def test_the_pull_off_force_of_a_colloid_is_that_of_johnson_kendall_roberts() -> None:
    force = 1.5 * pi * WORK * RADIUS
    (doubt,) = [text for text in doubts_of_load(5.0 * force) if "pull-off" in text]
    printed = re.search(r"pull-off force is ([\d.e+-]+) N, ([\d.]+) of W", doubt)
    assert printed is not None, doubt
    assert float(printed[1]) == pytest.approx(force, rel=5e-3)
    assert float(printed[2]) == pytest.approx(0.2, abs=5e-3)


def test_a_load_above_ten_times_the_pull_off_force_is_not_doubted() -> None:
    force = 1.5 * pi * WORK * RADIUS
    assert not [text for text in doubts_of_load(12.0 * force) if "pull-off" in text]
