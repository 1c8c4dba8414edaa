"""Every call of the README's table "From a question to a call" runs."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pytest

import pyfret as fret
from conftest import ROOT, SAME_PROCESS

README = (ROOT / "README.md").read_text(encoding="utf-8")
TABLE = README.partition("## From a question to a call")[2].partition("\n## ")[0]
ROWS = dict(re.findall(r"^\| ([^|`]+?) \| (.+) \|$", TABLE, flags=re.MULTILINE))
ROWS.pop("question", None)
#: Rows whose calls take seconds.
LONG = ("a measured loop", "a scar", "depth after", "which of two", "a study", "its picture")


def spans(row: str) -> list[str]:
    """Return the code of a row: whole calls and names of results, without fragments."""
    whole = re.findall(r"`([^`]+)`", row)
    return [
        span for span in whole if re.match(r"(\w+ = )?(fret|result|table|surface|loops)\b", span)
    ]


def small_scene(coated: fret.Body) -> fret.Scene:
    """A ball on a coated body, few cells, one cycle."""
    path = fret.LoadPath.start().normal(20.0, increments=2).cycles(1, T_x=5.0, increments=3)
    ball = fret.Body("100Cr6", shape=fret.Sphere(R=5e-3))
    grid = fret.Grid.centred(width=2.6e-4, n=16)
    return fret.Scene(body1=ball, body2=coated, friction=0.5, grid=grid, path=path)


def names_for(question: str, folder: Path) -> dict[str, Any]:
    """Return what the calls of a row begin with."""
    coated = fret.Body("Ti-6Al-4V", coatings=[fret.Coating("TiN", thickness="2 um")])
    scene = small_scene(coated)
    names: dict[str, Any] = {"fret": fret, "coated": coated, "scene": scene, "path": scene.path}
    if question.startswith(("its picture", "a study")):
        points = {"body2.coatings.0.thickness": ["1 um", "2 um"], "mu": [0.3, 0.5]}
        if question.startswith("its picture"):
            measure = ["loop_energy", "interface_shear"]
            names["table"] = fret.study(
                scene, points, measure=measure, executor=SAME_PROCESS, progress=False
            )
    elif question.startswith(("a measured loop", "a scar", "depth after", "which of two")):
        slides = (
            fret.LoadPath.start().normal(20.0).displace(delta_x=[8e-6, -8e-6, 8e-6], increments=4)
        )
        bare = fret.Body("Ti-6Al-4V")
        wide = fret.Grid.centred(width=7e-4, n=24)
        grid = wide if question.startswith("depth after") else scene.grid
        names["scene"] = scene.replace(body2=bare, path=slides, grid=grid)
        if question.startswith("a measured loop"):
            run = fret.solve(names["scene"].replace({"rig.stiffness": 1e7}), progress=False)
            columns = run.dataset.isel(increment=slice(-8, None))
            write_columns(folder / "loop.csv", "x [um],force [N]", columns.delta_x, columns.T_x)
            names["scene"] = names["scene"].replace(path=fret.LoadPath.start().normal(20.0))
        if question.startswith("a scar"):
            law = fret.wear.Archard(2e-16)
            worn = fret.wear.solve(names["scene"], body2=law, cycles=1e5, progress=False).dataset
            depth = worn.worn2.values[-1][:, 8]
            write_columns(folder / "scar.csv", "x [um],depth [um]", worn.x, 1e6 * depth)
        if question.startswith("which of two"):
            names |= {"body": coated, "law": fret.wear.Archard(1e-17), "path": slides}
            names["law_below"] = fret.wear.Archard(2e-17)
    elif not question.startswith(("which materials", "a film", "bulk", "residual")):
        names["result"] = fret.solve(scene, save="all", progress=False)
    if question.startswith("a measured surface"):
        heights = np.random.default_rng(1).normal(0.0, 0.1, (140, 130))
        heights[3, 4] = np.nan
        np.savetxt(folder / "map.csv", heights, delimiter=",")
    return names


def write_columns(path: Path, head: str, first: Any, second: Any) -> None:
    columns = np.column_stack([1e6 * np.asarray(first), np.asarray(second)])
    np.savetxt(path, columns, delimiter=",", header=head, comments="")


def test_the_table_has_its_rows() -> None:
    assert len(ROWS) >= 18
    assert sum(len(spans(row)) for row in ROWS.values()) >= 30


@pytest.mark.solves
@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize(
    "question",
    [pytest.param(q, marks=[pytest.mark.slow] if q.startswith(LONG) else []) for q in ROWS],
)
def test_the_calls_of_a_row_run(
    question: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    names = names_for(question, tmp_path)
    for span in spans(ROWS[question]):
        exec(compile(span.replace("path.zarr", str(tmp_path)), question, "exec"), names)
    plt.close("all")
