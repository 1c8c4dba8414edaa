"""Every printed number of a crack has the error of that number."""

from __future__ import annotations

import json
import math
import sys
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import pyfret as fret
from pyfret import fracture
from pyfret._cli import commands
from pyfret.study import questions

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

LENGTHS = np.geomspace(1e-5, 4e-4, 6)
THRESHOLD = fracture.Threshold(dK_th=3.4e6, dS_0=500e6, walker=0.5)


def pad(cells: int) -> fret.Result:
    """A cylinder of titanium on a flat, its force in phase with a bulk stress."""
    titanium = fret.Elastic(E=115e9, nu=0.32)
    scene = fret.Scene(
        body1=fret.Body(titanium, shape=fret.Cylinder(R=0.04)),
        body2=fret.Body(titanium),
        friction=0.5,
        grid=fret.Grid.strip(extent=1.7e-3, n=cells),
    )
    path = fret.LoadPath.start().normal(4e5, increments=2)
    for sign in (1.0, -1.0, 1.0):
        path = path.force(T_x=sign * 1.2e5, sigma_B=sign * 130e6, increments=6)
    return fret.solve(scene, path, save="all", progress=False)


@pytest.fixture(scope="module")
def coarse() -> fret.Result:
    return pad(48)


@pytest.fixture(scope="module")
def cracks(coarse: fret.Result) -> fracture.Cracks:
    return coarse.crack(lengths=LENGTHS)


def numbers(of: fracture.Cracks) -> dict[str, NDArray[np.float64]]:
    return {"K_max": of.K_max, "K_min": of.K_min, "dK": of.dK(THRESHOLD), "K_I": of.dataset.K_I}


@pytest.mark.solves
def test_each_error_is_that_of_its_number(cracks: fracture.Cracks) -> None:
    """No number moves by more than its error on three times as many cells."""
    fine = pad(144).crack(cracks.dataset.attrs["x"], lengths=LENGTHS)
    errors = {
        "K_max": cracks.error,
        "K_min": cracks.K_min_error,
        "dK": cracks.dK_error(THRESHOLD),
        "K_I": cracks.K_I_error,
    }
    truth = numbers(fine)
    for name, value in numbers(cracks).items():
        off = np.abs(np.asarray(value) - np.asarray(truth[name]))
        assert np.all(off <= errors[name] + 1e-9 * cracks.K_max), name
    # A state of large pressure has an error of K of faces that pass through each other. K_I of the
    # closed crack is 0 and does not have it.
    dataset = cracks.dataset
    shut = (dataset.open.values == 0.0) & (
        dataset.K_I_linear.values + dataset["error"].values < 0.0
    )
    assert shut.any(axis=0).all()
    assert np.all(dataset["error"].values[shut] > 0.0)
    assert np.all(cracks.K_I_error[shut] == 0.0)


@pytest.mark.solves
@pytest.mark.parametrize("start", LENGTHS[:3].tolist())
def test_the_rows_and_the_verdict_have_one_error(cracks: fracture.Cracks, start: float) -> None:
    arrest = cracks.arrest(THRESHOLD, start=start)
    n = int(np.searchsorted(LENGTHS, start))
    limit = THRESHOLD.range_at(LENGTHS)[n]
    assert arrest.at_start == pytest.approx(cracks.dK(THRESHOLD)[n] / limit, rel=1e-9)
    assert arrest.at_start_error == pytest.approx(cracks.dK_error(THRESHOLD)[n] / limit, rel=1e-6)


@pytest.mark.solves
def test_the_command_prints_each_error_beside_its_number(
    coarse: fret.Result,
    cracks: fracture.Cracks,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    coarse.save(tmp_path / "pad.nc")
    message = [
        "crack",
        str(tmp_path / "pad.nc"),
        "--lengths",
        ",".join(map(repr, LENGTHS.tolist())),
    ]
    message += ["--material", "titanium_6Al4V", "--paris", "1e-11,3"]
    assert commands.main([*message, "--json"]) == 0
    rows = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [row["K_max_error"] for row in rows[:-1]] == pytest.approx(cracks.error)
    assert [row["K_min_error"] for row in rows[:-1]] == pytest.approx(cracks.K_min_error)
    for row in rows[:-1]:
        assert row["dK_error"] <= row["K_max_error"] * (1.0 + 1e-12)
    assert "; ".join(rows[-1]["notes"]) == rows[-1]["told"]
    assert "; ".join(rows[-1]["cycles_notes"]) == rows[-1]["cycles_told"]
    assert commands.main(message) == 0
    lines = capsys.readouterr().out.splitlines()
    # The verdict stands first.
    assert lines[0].startswith("crack from x")
    for row, line in zip(rows[:-1], lines[-len(rows) + 1 :], strict=True):
        for name in ("K_min", "K_max", "dK"):
            assert fret._core.with_error(row[name] / 1e6, row[f"{name}_error"] / 1e6) in line


def test_a_crack_without_errors_has_none() -> None:
    item = fracture.Cracks.from_arrays(LENGTHS, np.full(6, 2e6), np.zeros(6))
    for error in (
        item.error,
        item.K_min_error,
        item.dK_error(),
        item.dK_error(THRESHOLD),
        item.K_I_error,
    ):
        assert np.all(np.isnan(error))


@pytest.mark.solves
def test_the_first_to_fail_has_the_margin_of_the_same_cracks(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """One question has one number, and the line names the lengths of which it is the least."""
    # The lengths of cracks by default are many.
    monkeypatch.setattr(sys.modules["pyfret.fracture.below"], "LENGTHS", 4)
    steel = fret.Elastic(E=210e9, nu=0.3)
    film = fret.Coating(fret.Elastic(E=400e9, nu=0.25), thickness=1e-5)
    scene = fret.Scene(
        body1=fret.Body(steel, shape=fret.Cylinder(R=0.05)),
        body2=fret.Body(steel, coatings=[film]),
        friction=0.6,
        grid=fret.Grid.strip(extent=1e-3, n=16),
    )
    path = fret.LoadPath.start().normal(2e5).tangential([6e4, -6e4, 6e4], increments=3)
    result = fret.solve(scene, path, save="all", progress=False)
    threshold = fracture.Threshold.from_material("steel_42CrMo4")
    # By default both begin where a crack has come through the coatings.
    for lengths, start in (([2e-5, 5e-5, 1e-4, 3e-4], 20), (None, 15)):
        computed = fracture.first_to_fail(result, threshold=threshold, lengths=lengths)
        same = result.crack(lengths=lengths).arrest(threshold)
        assert (computed.substrate, computed.substrate_error) == (same.margin, same.margin_error)
        assert computed.arrest == same
        assert f"a crack {same.describe()}" in computed.summary()
        assert f"least dK/dK_th from a length of {start} um on" in repr(computed)
    assert "the ranges leave out the scatter of estimates" in computed.summary()


def test_a_comparison_keeps_the_error_of_a_crack(monkeypatch: pytest.MonkeyPatch) -> None:
    computed = fracture.FailureOrder(math.nan, 0.3, 0.5, 0.2)
    monkeypatch.setattr(fracture, "first_to_fail", lambda *_, **__: computed)
    steel = fret.Elastic(E=210e9, nu=0.3)
    candidate = fret.study.Candidate(fret.Body(steel))
    nothing: Any = SimpleNamespace(body_number=2)
    numbers, _ = questions.adhesion(nothing, candidate, nothing)
    assert numbers["crack"] == pytest.approx((0.5, 0.3, 0.7))
    assert numbers["interface"] == (0.3, 0.3, 0.3)
    assert math.isnan(numbers["film"].value)


def test_a_range_says_that_it_leaves_out_the_scatter_of_estimates() -> None:
    """The words stand where an estimate meets a range, and nowhere else."""
    words = "the ranges leave out the scatter of estimates"
    plain = fracture.Cracks.from_arrays(LENGTHS, np.geomspace(1e7, 1e6, 6), np.zeros(6))
    barred = fracture.Cracks(plain.dataset.assign(error=0.1 * plain.dataset.K_I))
    of_rule = fracture.Threshold.from_material("titanium_6Al4V")
    own_threshold = fracture.Threshold(of_rule.dK_th, of_rule.dS_0)
    paris = fracture.Paris(1e-11, 3.0)
    guessed = fracture.Paris(1e-11, 3.0, estimate="paris_C is an estimate")
    for cracks, threshold, law, in_arrest, in_life in (
        (barred, of_rule, paris, True, True),
        (barred, own_threshold, guessed, False, True),
        (barred, own_threshold, paris, False, False),
        (plain, of_rule, guessed, False, False),
    ):
        assert (words in cracks.arrest(threshold).describe()) == in_arrest
        assert (words in cracks.life(threshold, law).describe()) == in_life
