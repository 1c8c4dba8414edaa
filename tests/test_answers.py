"""Many answers about one result: the stress below it is evaluated once."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import pyfret as fret
from conftest import SAME_PROCESS
from pyfret._core import measure
from pyfret.study import stresses
from pyfret.subsurface.contact import sample_borders, sample_sections
from pyfret.subsurface.tensor import COMPONENTS

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
def sampled(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Count the states of each evaluation of sections."""
    counts: list[int] = []

    def counted(states: list[fret.Snapshot], **options: Any) -> Any:
        counts.append(len(states))
        return sample_sections(states, **options)

    monkeypatch.setattr(stresses, "sample_sections", counted)
    return counts


@pytest.mark.solves
def test_stresses_of_all_measures_are_sampled_once(run: fret.Result, sampled: list[int]) -> None:
    fresh = fret.Result(run.dataset)
    together = fret.study.answers(fresh, [*STRESSES, "p_max"])
    assert len(sampled) == 1
    for name in STRESSES:
        alone = fret.study.answers(fret.Result(run.dataset), name)
        for side in ("", "_low", "_high"):
            np.testing.assert_array_equal(together[name + side], alone[name + side])
        assert together[name].attrs == alone[name].attrs


@pytest.mark.solves
@pytest.mark.parametrize("body_number", [1, 2])
def test_sections_together_are_the_sections_of_each(run: fret.Result, body_number: int) -> None:
    residual = (-50e6, 0.0) if body_number == 2 else None
    states = [run.at(int(n)) for n in run.dataset.saved_increment.values]
    # The last one is sheared in another direction: its section lies below another line.
    turned = run.scene.path.force(T_x=3.0, T_y=4.0, increments=2)
    states.append(fret.solve(run.scene.replace(path=turned), progress=False).at(-1))
    sections = sample_sections(states, body_number=body_number, residual=residual)
    for state, (samples, layers) in zip(states, sections, strict=True):
        alone = state.stress(body_number=body_number, residual=residual)
        components = np.stack([alone.dataset[name].values for name in COMPONENTS])
        np.testing.assert_allclose(samples, components, rtol=1e-9, atol=1.0)
        assert layers == alone.dataset.layer.values.tolist()
        borders = sample_borders(state, body_number=body_number, residual=residual)
        rims = [alone.rims().measure("s_1"), alone.stick_borders().measure("s_1")]
        expected = sorted(value for field in rims for value in field.values.tolist())
        np.testing.assert_allclose(np.sort(measure("s_1", borders)), expected, rtol=1e-9)


@pytest.mark.solves
def test_answers_are_those_of_a_study(run: fret.Result) -> None:
    measures = ["s_1", "stick_ratio", "p_max"]
    study = fret.study.run(
        run.scene, {"mu": [run.scene.friction.mu]}, measure=measures, executor=SAME_PROCESS
    )
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
