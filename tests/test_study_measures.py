"""Measures of a study: stresses at the states they are asked for, and increments for a measure."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import xarray as xr

import pyfret as fret
from conftest import SAME_PROCESS
from pyfret.study import point, stresses
from pyfret.study.loop import Costs
from pyfret.study.measures import MEASURES, evaluate_measures
from pyfret.subsurface.tensor import Stress

STEEL, TITANIUM = fret.Elastic(E=210e9, nu=0.3), fret.Elastic(E=117e9, nu=0.31)


def contact(path: fret.LoadPath, n: int = 24) -> fret.Scene:
    """A ball on a thin stiff film, whose interface is nearer to the surface than a cell."""
    a = fret.reference.hertz(R=8e-3, bodies=(STEEL, TITANIUM), W=60.0).a
    film = fret.Coating(fret.Elastic(E=450e9, nu=0.25), thickness=8e-6)
    return fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Sphere(R=8e-3)),
        body2=fret.Body(TITANIUM, coatings=[film]),
        friction=0.6,
        grid=fret.Grid.centred(width=2.4 * a, n=n),
        path=path,
    )


@pytest.fixture(scope="module")
def result() -> fret.Result:
    path = fret.LoadPath.start().normal(60.0, increments=4).cycles(1, T_x=25.0, increments=12)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return fret.solve(contact(path), progress=False)


def maximum(result: fret.Result, increment: int, name: str) -> Any:
    """The largest value of the whole section of an increment."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return result.at(increment).stress().maximum(name)


@pytest.mark.solves
@pytest.mark.parametrize("name", ["interface_shear", "interface_peel"])
def test_a_stress_of_interfaces_is_that_of_whole_sections_at_less_work(
    name: str, result: fret.Result, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One search, from samples on both sides of the interface alone."""
    whole = [maximum(result, int(n), name) for n in result.dataset.saved_increment.values]
    largest = max(whole, key=lambda extremum: float(extremum.value))
    searched: list[int] = []
    search = Stress.maximum

    def counted(self: Stress, of: str = "von_mises", *, layer: int | None = None) -> Any:
        searched.append(self.dataset.sizes["depth"])
        return search(self, of, layer=layer)

    monkeypatch.setattr(Stress, "maximum", counted)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        numbers, reasons = evaluate_measures(result, [name])
    assert not reasons
    assert float(numbers[name].values) == pytest.approx(largest.value, abs=largest.error)
    assert searched == [2]


@pytest.mark.solves
def test_a_stress_is_taken_at_the_increments_it_is_asked_for(result: fret.Result) -> None:
    measures = [fret.study.LargestStress("s_1", increments=[n]) for n in (-1, 4)]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        numbers, _ = evaluate_measures(result, measures)
    for suffix, increment in (("", -1), ("_2", 4)):
        extremum = maximum(result, increment, "s_1")
        limits = [
            float(numbers[f"largest_s_1{suffix}{side}"].values) for side in ("_low", "", "_high")
        ]
        errors = (-extremum.error, 0.0, extremum.error)
        np.testing.assert_allclose(limits, [max(extremum.value + e, 0.0) for e in errors])
    for bad in (
        {"stress": "x"},
        {"stress": "s_1", "increments": []},
        {"stress": "s_1", "body_number": 3},
    ):
        with pytest.raises(ValueError, match=next(reversed(bad))):
            fret.study.LargestStress(**bad)  # type: ignore[arg-type]


@pytest.mark.solves
@pytest.mark.parametrize("increments", [None, 4])
def test_increments_are_chosen_for_the_measures(increments: int | None) -> None:
    """A stiffness without enough increments has more of them, or the reason where they are set."""
    path = fret.LoadPath.start().normal(60.0)
    options: Any = {} if increments is None else {"increments": increments}
    scene = contact(path.cycles(2, delta_x=3e-6, **options), n=32)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        alone = fret.solve(scene, progress=False).loops()
        study = fret.study.run(
            scene, {"mu": [0.6]}, measure="stiffness", executor=SAME_PROCESS, progress=False
        ).dataset
    assert np.isnan(alone.stiffness.values).all()
    if increments is None:
        assert np.isfinite(study.stiffness.values).all()
    else:
        assert np.isnan(study.stiffness.values).all()
        assert "fewer than three increments" in str(study.reason.values[0])


@pytest.mark.solves
@pytest.mark.filterwarnings("ignore")
def test_a_study_of_a_stress_of_interfaces_solves_and_searches_once_a_point(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The work beside the solutions is one search a point, on both sides of the interface alone."""
    work: dict[str, list[int]] = {name: [] for name in ("solve", "states", "depths", "sections")}

    def count(module: Any, name: str, of: str, size: Callable[..., int]) -> None:
        call = getattr(module, name)

        def counted(*values: Any, **options: Any) -> Any:
            computed = call(*values, **options)
            work[of].append(size(computed, *values))
            return computed

        monkeypatch.setattr(module, name, counted)

    count(point, "solve", "solve", lambda result, *_: result.dataset.sizes["increment"])
    count(stresses, "sample_interfaces", "states", lambda samples, *_: len(samples))
    count(stresses, "sample_sections", "sections", lambda samples, *_: len(samples))
    count(Stress, "maximum", "depths", lambda _, stress, *__: stress.dataset.sizes["depth"])
    path = fret.LoadPath.start().normal(6e4, increments=2).cycles(1, T_x=1.5e4, increments=3)
    a = fret.reference.line_contact(R=8e-3, bodies=(STEEL, TITANIUM), W=6e4).a
    scene = contact(path).replace(
        body1=fret.Body(STEEL, shape=fret.Cylinder(R=8e-3)),
        grid=fret.Grid.strip(extent=2.4 * a, n=64),
    )
    values = {
        "mu": [0.4, 0.5, 0.6],
        "body1.shape.R": [7e-3, 8e-3, 9e-3],
        "body2.coatings.0.thickness": [6e-6, 8e-6],
    }
    study = fret.study.run(
        scene, values, measure="interface_shear", executor=SAME_PROCESS, progress=False
    )
    assert study.count()["done"] == 18
    sizes = fret.solve(scene, progress=False).dataset.sizes
    assert work["solve"] == [sizes["increment"]] * 18
    assert work["states"] == [sizes["saved"]] * 18
    assert work["depths"] == [2] * 18
    assert not work["sections"]


def test_mean_costs_stand_in_the_progress_with_the_dearest_first() -> None:
    costs = Costs()
    assert str(costs) == ""
    costs.add({"solution": 1.0, "p_max": 1e-4, "von_mises": 2.0})
    costs.add({})
    costs.add({"solution": 1.0, "p_max": 1e-4, "von_mises": 4.0})
    assert str(costs) == "von_mises 3 s, solution 1 s a point"


@pytest.mark.solves
def test_every_measure_has_its_processor_time(result: fret.Result) -> None:
    costs: dict[str, float] = {}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        evaluate_measures(result, ["p_max", "interface_shear"], costs)
    assert set(costs) == {"p_max", "interface_shear"}
    assert costs["interface_shear"] > costs["p_max"] >= 0.0
    assert "interface_shear" in MEASURES


def table(*, spread: bool) -> fret.study.Study:
    """A study of 3 x 2 x 2 points of a function that is known."""
    axes = {"mu": [0.2, 0.4, 0.6], "body1.shape.sphere.R": [5e-3, 1e-2], "speed": [1.0, 2.0]}
    mu, R, speed = np.meshgrid(*axes.values(), indexing="ij")
    values = xr.DataArray(1e9 * mu * speed + 1e10 * R, axes, name="p_max")
    values.attrs = {"units": "Pa", "long_name": "largest pressure"}
    data = {"p_max": values, "status": xr.full_like(values, 1, dtype=np.int8)}
    if spread:
        data |= {"p_max_low": 0.9 * values, "p_max_high": 1.1 * values}
    else:
        values.attrs["accuracy"] = "estimate"
    return fret.study.Study(xr.Dataset(data))


def test_a_parameter_is_drawn_with_the_others_as_lines_and_errors_as_bands() -> None:
    study = table(spread=True)
    axes = fret.plot.study_line(study, "p_max", along="mu")
    lines = axes.get_lines()
    assert len(lines) == 4
    assert len(axes.collections) == 4
    np.testing.assert_allclose(lines[0].get_xdata(), [0.2, 0.4, 0.6])
    np.testing.assert_allclose(lines[3].get_ydata(), np.array([0.2, 0.4, 0.6]) * 2.0 + 0.1)
    low = min(path.vertices[:, 1].min() for path in axes.collections[3].get_paths())
    assert low == pytest.approx(0.9 * 0.5)
    texts = [text.get_text() for text in axes.get_legend().get_texts()]
    assert texts[3] == "radius, body 1 = 10 mm, speed = 2"
    kept = study.line("p_max", along="mu", at={"speed": 2.0})
    assert len(kept.get_lines()) == 2
    estimate = fret.plot.study_line(table(spread=False), along="mu", at={"speed": 1.0})
    assert not estimate.collections
    assert "estimate" in estimate.get_ylabel()
    with pytest.raises(ValueError, match="no parameter 'nu'"):
        fret.plot.study_line(study, "p_max", along="nu")
