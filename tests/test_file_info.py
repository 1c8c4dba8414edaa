"""`fret info`: every file of the corpus is described, and the page of the files is up to date."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import pyfret as fret
from conftest import ROOT, sphere_on_flat
from pyfret._cli import commands
from pyfret.file_info import describe_file
from test_real_files import CORPUS, ROWS

#: Functions by the readers of the table.
FUNCTIONS = {
    "read_surface": "fret.read_surface",
    "fit.read_loops": "fret.fit.read_loops",
    "export.bulk_stress": "fret.export",
    "mesh": "fret.export.loads",
}


@pytest.mark.parametrize("row", ROWS, ids=[row["file"] for row in ROWS])
@pytest.mark.filterwarnings("ignore")
def test_files_are_described_by_the_reader_that_takes_them(row: dict[str, Any]) -> None:
    try:
        info = describe_file(CORPUS / row["file"])
    except (ValueError, fret.errors.StoreError) as refusal:
        reason = str(refusal)
        assert "refused" in row
    else:
        reason = ""
    if reason:
        assert row["file"] in reason
        return
    assert FUNCTIONS[row["reader"]] in info.reader
    if row["options"].keys() & {"spacing", "unit"}:
        assert any("unit" in doubt or "spacing" in doubt for doubt in info.doubts) or info.content
    elif row["reader"] == "read_surface":
        assert info.content["points"] == "5 x 3 along x and y"
        assert info.content["pitch"] == "2 µm x 1 µm"
        assert info.content["not measured"] == (
            "1 points" if "filled" in row["right"] else "no points"
        )
    elif row["reader"] == "fit.read_loops":
        assert info.content["points"] == "81"
        assert "shift 'delta' over force 'T'" in info.content["read"]


def test_files_of_pyfret_are_described_by_their_commands(tmp_path: Path) -> None:
    scene, study = tmp_path / "scene.toml", tmp_path / "study.toml"
    pressed = sphere_on_flat(n=16).replace(path=fret.LoadPath.start().normal(10.0))
    scene.write_text(pressed.to_toml(), encoding="utf-8")
    study.write_text('scene = "scene.toml"\nmeasure = ["p_max"]\n[parameters]\nmu = [0.3, 0.4]\n')
    info = describe_file(scene)
    assert info.reader == "fret.Scene.from_file"
    assert info.content["grid"].startswith("16 x 16 cells of ")
    assert describe_file(study).reader == "fret study"
    scene.write_text("body1 = [")
    with pytest.raises(ValueError, match=r"scene\.toml.*at end of document"):
        describe_file(scene)


def test_doubts_are_listed() -> None:
    assert any("did not converge" in d for d in describe_file(CORPUS / "ccx_diverged.frd").doubts)
    assert any("order of its comp" in d for d in describe_file(CORPUS / "vtk_bare.vtu").doubts)
    assert any("interpolated" in d for d in describe_file(CORPUS / "asammdf.mf4").doubts)


def test_the_command_prints_lines_or_json(capsys: pytest.CaptureFixture[str]) -> None:
    file = str(CORPUS / "x3pio_layers.x3p")
    assert commands.run(["info", file]) == 0
    text = capsys.readouterr().out
    for words in ("X3P, ISO25178-72:2017/DAM1, by x3pio", "S_q", "doubt: has 2 layers"):
        assert words in text
    assert commands.run(["info", file, "--json"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert answer["content"]["channels"] == "'layer 0', 'layer 1'"
    assert commands.run(["info", str(CORPUS / "gdal.tif")]) == 2


def test_the_page_is_that_of_the_table() -> None:
    page = [sys.executable, str(ROOT / "tools" / "files_page.py"), "--check"]
    assert subprocess.run(page, check=False).returncode == 0
