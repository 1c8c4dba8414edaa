"""Results as tables: data frames, CSV, Excel, the command; units in the names of the columns."""

from __future__ import annotations

import json
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

import pyfret as fret
from conftest import SAME_PROCESS
from pyfret._cli import commands

STEEL = fret.Elastic(E=210e9, nu=0.3)
PATH = fret.LoadPath.start().normal(50.0, increments=3).cycles(2, T_x=10.0, increments=8)


@pytest.fixture(scope="module")
def result() -> fret.Result:
    ball = fret.Body(STEEL, shape=fret.Sphere(R=5e-3))
    grid = fret.Grid.centred(width=4e-4, n=24)
    scene = fret.Scene(body1=ball, body2=fret.Body(STEEL), friction=0.4, grid=grid)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return fret.solve(scene, PATH, save="all", progress=False)


def results(result: fret.Result) -> dict[str, Any]:
    """Return an object of each class that has a dataset."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        scene = result.scene
        law = fret.wear.Archard(k=1e-15)
        return {
            "run": result,
            "snapshot": result.at(-1),
            "stress": result.at(-1).stress(),
            "life": result.life("7075", "findley"),
            "factors": result.load_factors(1e9),
            "cracks": result.crack(),
            "wear": fret.wear.solve(scene, cycles=100, body2=law, progress=False),
            "study": fret.study.run(
                scene, {"mu": [0.3, 0.4]}, measure=["p_max"], executor=SAME_PROCESS, progress=False
            ),
        }


@pytest.mark.solves
def test_every_result_is_a_table_with_units(result: fret.Result, tmp_path: Path) -> None:
    for name, kind in results(result).items():
        frame = kind.to_dataframe()
        assert len(frame) > 0, name
        assert any(head.endswith("]") for head in frame.columns), name
        kind.to_csv(tmp_path / f"{name}.csv")
        read = pd.read_csv(tmp_path / f"{name}.csv")
        assert list(read.columns) == list(frame.columns), name
        numbers = frame.select_dtypes("number")
        np.testing.assert_allclose(read[numbers.columns], numbers, rtol=1e-12, err_msg=name)
        kind.to_excel(tmp_path / f"{name}.xlsx")
        sheets = pd.read_excel(tmp_path / f"{name}.xlsx", sheet_name=None)
        first = next(iter(sheets.values()))
        assert first.shape == frame.shape, name
        with pytest.raises(ValueError, match="of = 'nothing': must be"):
            kind.to_dataframe("nothing")
        with pytest.raises(TypeError, match="path = 5"):
            kind.to_csv(5)
        with pytest.raises(ValueError, match=r"must end in \.xlsx"):
            kind.to_excel(tmp_path / "table.xls")


def test_the_energies_of_the_cycles_add_up(result: fret.Result) -> None:
    loops = result.to_dataframe("loops")
    assert loops.cycle.tolist() == [1, 2]
    summed = loops["dissipated [J]"].cumsum()
    np.testing.assert_allclose(loops["dissipated_sum [J]"], summed)
    increments = result.to_dataframe("increments")
    np.testing.assert_allclose(
        increments["dissipated_energy [J]"], increments["dissipated [J]"].cumsum()
    )
    branches = result.to_dataframe("branches")
    assert branches["dissipated [J]"].sum() == pytest.approx(increments["dissipated [J]"].sum())
    assert branches["W [N]"].iloc[-1] == pytest.approx(50.0)


def test_a_run_has_its_path_and_an_increment_its_time(result: fret.Result) -> None:
    assert result.path == result.scene.path
    assert result.at(t=2).dataset.identical(result.at(2.0).dataset)
    for call in (lambda: result.at(), lambda: result.at(1, t=2.0), lambda: result.at(t=True)):
        with pytest.raises(TypeError, match=r"at\(|t = True"):
            call()


def test_one_residual_stress_belongs_to_a_body_without_coatings(result: fret.Result) -> None:
    lives = [
        result.life("steel_42CrMo4", "dang_van", y=0.0, residual=residual).best  # type: ignore[arg-type]
        for residual in (-600e6, [-600e6], "-600 MPa", 0.0)
    ]
    assert lives[0] == lives[1] == lives[2] > lives[3]
    stress = result.at(-1).stress(y=0.0, residual=-600e6).s_xx  # type: ignore[arg-type]
    assert stress.identical(result.at(-1).stress(y=0.0, residual=[-600e6]).s_xx)


@pytest.mark.solves
def test_the_command_prints_and_writes_tables(
    result: fret.Result, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    store = str(tmp_path / "run.zarr")
    result.save(store)
    assert commands.main(["table", store, "--of", "loops"]) == 0
    printed = capsys.readouterr().out
    assert printed.splitlines()[0].startswith("cycle,first_branch,last_branch,dissipated [J]")
    assert len(printed.splitlines()) == 3
    out = tmp_path / "run.xlsx"
    assert commands.main(["table", store, "-o", str(out), "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert len(document["rows"]) == result.dataset.sizes["increment"]
    assert set(pd.read_excel(out, sheet_name=None)) == {"increments", "branches", "loops"}
    assert commands.main(["table", store, "--of", "loop"]) == 2
    assert "must be one of increments, branches, loops" in capsys.readouterr().err
