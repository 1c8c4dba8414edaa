"""Criteria, materials, yield and shakedown on plain arrays, and along the cycle of a contact."""

from __future__ import annotations

import copy
import pickle
from typing import TYPE_CHECKING

import numpy as np
import pytest

import pyfret as fret
from conftest import ROOT, sphere_on_flat
from pyfret import _core, fatigue
from pyfret.fatigue import Criterion

if TYPE_CHECKING:
    from pathlib import Path

MPA = 1e6


def axial(most: float, least: float) -> np.ndarray:
    """A uniaxial history."""
    stress = np.zeros((2, 6))
    stress[:, 0] = np.array([most, least]) * MPA
    return stress


def test_numbers_of_the_literature() -> None:
    stress = np.stack([axial(100, -100), axial(200, 0)], axis=1).reshape(2, 2, 1, 6)
    fields = fatigue.evaluate_criterion(stress, Criterion.findley(k=0.3))
    np.testing.assert_allclose(
        fields.value.values.ravel(), [67.2015 * MPA, 88.3095 * MPA], rtol=1e-6
    )
    assert fields.value.dims == ("dim_0", "dim_1")
    assert fields.normal.shape == (2, 1, 3)
    np.testing.assert_allclose(np.linalg.norm(fields.normal, axis=-1), 1.0)
    assert (fields.missed <= 5.01e-3 * fields.value).all()
    bent = np.zeros((2, 6))
    bent[:, 0], bent[:, 3] = [411 * MPA, -411 * MPA], [205 * MPA, -205 * MPA]
    alpha = (352 - 540.97 / np.sqrt(3)) / (540.97 / 3)
    value = float(fatigue.evaluate_criterion(bent, Criterion.crossland(alpha=alpha)).value)
    assert value / MPA - 352 == pytest.approx(-8.281, abs=5e-4)
    E, nu = 210e9, 0.3
    swt = fatigue.evaluate_criterion(axial(300, -300), Criterion.smith_watson_topper(E=E, nu=nu))
    assert float(swt.value) == pytest.approx((300 * MPA) ** 2 / E)


def test_materials_and_lives(tmp_path: Path) -> None:
    table = fatigue.Materials()
    assert all(source for m in table.values() for _, _, source in m.numbers())
    steel = table["steel_42CrMo4"]
    fields = fatigue.evaluate_margin(axial(398, -398), steel, "dang_van")
    assert float(fields.safety_factor) == pytest.approx(1.0)
    titanium = table["titanium_6Al4V"]
    lives = [
        float(fatigue.evaluate_margin(axial(s, -s), titanium, "smith_watson_topper").life)
        for s in (500, 600, 700)
    ]
    assert lives[0] > lives[1] > lives[2] > 1e3
    # Beyond the tests of a curve, as in the life of a result; the curve itself goes on.
    beyond = fatigue.evaluate_margin(axial(200, -200), titanium, "smith_watson_topper")
    assert np.isinf(beyond.life)
    assert 1e7 < titanium.assessment("smith_watson_topper").life(float(beyond.value)) < np.inf
    with pytest.raises(ValueError, match=r"alumina`\.s_D: is missing \(fatigue limit"):
        fatigue.evaluate_margin(axial(1, -1), table["alumina"], "crossland")
    with pytest.raises(KeyError, match="steel_42CrMo4"):
        table["unobtainium"]
    mine = tmp_path / "mine.toml"
    mine.write_text(
        'schema = 1\n[materials.mine]\ns_D = { value = 4e8, source = "test" }\n'
        't_D = { value = 2.5e8, source = "test" }\n',
        encoding="utf-8",
    )
    assert fatigue.Materials(mine)["mine"].number("t_D") == 2.5e8
    mine.write_text("schema = 1\n[materials.mine]\ns_D = 4e8\n", encoding="utf-8")
    with pytest.raises(ValueError, match=r"mine\.toml:3: .*source"):
        fatigue.Materials(mine)


def test_the_criteria_are_those_of_the_core() -> None:
    assert list(fatigue.CRITERIA) == [name for name, _ in _core.criteria()]
    documented = (ROOT / "docs" / "fatigue.md").read_text(encoding="utf-8")
    steel = {"alpha": 0.3, "k": 0.5, "E": 2e11, "nu": 0.3, "s_y": 5e8, "S": 0.85}
    for name in fatigue.CRITERIA:
        assert f"`{name}`" in documented
        make = getattr(Criterion, name)
        with pytest.raises(ValueError, match=f"{name}.*nothing"):
            make()
        for keys in (("alpha",), ("k",), ("E", "nu"), ("E", "nu", "k", "s_y"), ("E", "nu", "S")):
            try:
                made = make(**{key: steel[key] for key in keys})
            except ValueError:
                continue
            assert pickle.loads(pickle.dumps(made)) == made == copy.deepcopy(made)
            assert repr(made).startswith(f"Criterion.{name}(")
            break
        else:
            raise AssertionError(name)


def test_pulsating_compression_ends_at_once() -> None:
    stress = np.zeros((2, 1, 6))
    stress[1, 0, 0] = -400 * MPA
    swt = Criterion.smith_watson_topper(E=162e9, nu=0.3)
    assert float(fatigue.evaluate_criterion(stress, swt).value[0]) == 0.0
    stress[1, 0, :3] = -400 * MPA
    for criterion in (Criterion.findley(k=0.3), Criterion.matake(k=0.3), swt):
        assert float(fatigue.evaluate_criterion(stress, criterion).value[0]) == 0.0


def test_bad_input() -> None:
    findley = Criterion.findley(k=0.3)
    broken = np.ones((4, 3, 6))
    broken[2, 1, 4] = np.nan
    for stress, message in (
        (broken, "finite number"),
        (np.ones((1, 3, 6)), "at least 2"),
        (np.zeros((4, 3, 6)), "other than zero"),
        (np.ones((4, 3, 5)), "the last axis"),
        (np.ones(6), "time"),
    ):
        with pytest.raises(ValueError, match=message):
            fatigue.evaluate_criterion(stress, findley)
    with pytest.raises(ValueError, match="a weight, 0 or more"):
        Criterion.findley(k=-1.0)


def test_yield_and_shakedown() -> None:
    fields = fatigue.first_yield(axial(100, 0), s_y=250 * MPA)
    assert float(fields.von_mises) == pytest.approx(2.5)
    assert float(fields.tresca) == pytest.approx(2.5)
    assert float(fields.shakedown) == pytest.approx(5.0)
    held = fatigue.first_yield(axial(100, 0), s_y=250 * MPA, constant=(50 * MPA, 0, 0, 0, 0, 0))
    assert float(held.von_mises) == pytest.approx(2.0)


def test_path_of_dang_van() -> None:
    tau, p_h = fatigue.dang_van_path(axial(300, -300))
    np.testing.assert_allclose(tau, 150 * MPA)
    np.testing.assert_allclose(p_h, [100 * MPA, -100 * MPA])


def test_bridges() -> None:
    stress = np.arange(36.0).reshape(3, 2, 6)
    table = fatigue.to_pylife(stress)
    assert list(table.columns) == ["S11", "S22", "S33", "S12", "S13", "S23"]
    np.testing.assert_array_equal(table.loc[(1, 2)], stress[2, 1])
    counted = fatigue.rainflow([0.0, 3.0, -3.0, 3.0, 0.0])
    assert counted[:, 2].sum() == pytest.approx(2.0)


def test_along_the_cycle_of_a_contact() -> None:
    scene = sphere_on_flat(ratio=2.0, n=24)
    T = 0.6 * 0.3 * 1e3
    path = fret.LoadPath.start().normal(1e3, increments=3).tangential([T, -T, T], increments=25)
    result = fret.solve(scene, path, save="all", progress=False)
    z = np.array([0.0, 0.5, 1.0]) * result.a_H
    stress = fatigue.history(result, z, y=0.0)
    assert stress.dims == ("increment", "depth", "x", "component")
    # The interface has two sides.
    assert stress.layer.values.tolist() == [0, 0, 0, 1]
    fields = fatigue.evaluate_criterion(stress.values, Criterion.findley(k=0.3))
    worst = np.unravel_index(int(np.asarray(fields.value).argmax()), fields.value.shape)
    assert worst[0] == 0
    pressed = fatigue.history(result, z, y=0.0, residual=[-1e9, 0.0])
    change = (pressed - stress).isel(increment=0, x=0)
    np.testing.assert_allclose(change.isel(depth=0), [-1e9, -1e9, 0, 0, 0, 0], atol=1.0)
    np.testing.assert_allclose(change.isel(depth=3), 0.0, atol=1.0)
    relieved = fatigue.evaluate_criterion(pressed.values, Criterion.findley(k=0.3))
    assert float(relieved.value[worst]) < float(fields.value[worst])
    with pytest.raises(ValueError, match="one for each of the 2 layers"):
        fatigue.history(result, z, y=0.0, residual=[0.0])
    few = fret.solve(scene, path, save=[1], progress=False)
    with pytest.raises(ValueError, match="were kept"):
        fatigue.history(few, z, y=0.0)
