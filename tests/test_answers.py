"""Many answers about one result: the stress below it is evaluated once."""

from __future__ import annotations

from collections import Counter
from typing import Any

import numpy as np
import pytest

import pyfret as fret
from pyfret.snapshot import Snapshot

STRESSES = ("von_mises", "s_1", "tresca")


@pytest.fixture(scope="module")
def run() -> fret.Result:
    steel = fret.Elastic(E=210e9, nu=0.3)
    film = fret.Coating(fret.Elastic(E=300e9, nu=0.25), thickness=20e-6)
    path = fret.LoadPath.start().normal(20.0, increments=2).cycles(1, T_x=6.0, increments=4)
    scene = fret.Scene(
        body1=fret.Body(steel, shape=fret.Sphere(R=5e-3)),
        body2=fret.Body(steel, coatings=[film]),
        friction=0.5,
        grid=fret.Grid.centred(width=0.25e-3, n=20),
        path=path,
    )
    return fret.solve(scene, progress=False)


@pytest.fixture
def sampled(monkeypatch: pytest.MonkeyPatch) -> Counter[int]:
    """Count the sections of each increment that are computed."""
    count: Counter[int] = Counter()
    stress = Snapshot.stress

    def counted(self: Snapshot, *args: Any, **options: Any) -> Any:
        count[int(self.increment)] += 1
        return stress(self, *args, **options)

    monkeypatch.setattr(Snapshot, "stress", counted)
    return count


@pytest.mark.solves
def test_stresses_of_all_measures_are_sampled_once(run: fret.Result, sampled: Counter[int]) -> None:
    fresh = fret.Result(run.dataset)
    together = fret.study.answers(fresh, [*STRESSES, "p_max"])
    assert set(sampled.values()) == {1}
    for name in STRESSES:
        alone = fret.study.answers(fret.Result(run.dataset), name)
        for side in ("", "_low", "_high"):
            np.testing.assert_array_equal(together[name + side], alone[name + side])
        assert together[name].attrs == alone[name].attrs


@pytest.mark.solves
def test_answers_are_those_of_a_study(run: fret.Result) -> None:
    measures = ["s_1", "stick_ratio", "p_max"]
    study = fret.study.run(run.scene, {"mu": [run.scene.friction.mu]}, measure=measures, executor=1)
    numbers = fret.study.answers(run, measures)
    for name in measures:
        np.testing.assert_allclose(numbers[name], study.dataset[name].squeeze(), rtol=1e-12)


@pytest.mark.solves
def test_a_missing_number_has_its_reason(run: fret.Result) -> None:
    numbers = fret.study.answers(run, ["p_max", "loop_energy", "stiffness"])
    assert np.isfinite(numbers.p_max)
    assert "p_max" in numbers.attrs["costs"]
    missing = [name for name in ("loop_energy", "stiffness") if np.isnan(numbers[name])]
    assert all(name in numbers.attrs["reasons"] for name in missing)


def test_an_unknown_measure_is_refused(run: fret.Result) -> None:
    with pytest.raises(ValueError, match="measure 'von_mieses': must be a function or one of"):
        fret.study.answers(run, "von_mieses")
