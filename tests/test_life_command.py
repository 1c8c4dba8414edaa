"""`fret life`: what it says is what Python finds."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import pyfret as fret
from conftest import ROOT, T_MAX, sphere_on_flat
from conftest import W as LOAD
from pyfret import fatigue
from pyfret._util import files

FRET = ROOT / "target" / "release" / "fret"
STEEL = fatigue.Materials()["steel_42CrMo4"]
TABLE = (
    'schema = 1\n[materials.mine]\ns_D = { value = 4e8, source = "test" }\n'
    't_D = { value = 2.5e8, source = "test" }\n'
)


@pytest.fixture(scope="module")
def store(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A coated contact over a cycle."""
    path = fret.LoadPath.start().normal(LOAD, increments=2)
    path = path.tangential([T_MAX, -T_MAX, T_MAX], increments=5)
    out = tmp_path_factory.mktemp("life") / "out.zarr"
    scene = sphere_on_flat(ratio=2.0, n=16)
    fret.solve(scene, path, save="all", out=out, progress=False)
    return out


def life(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "FRET_PYTHON": sys.executable, "MPLBACKEND": "Agg"}
    command = [FRET, "life", *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False, env=environment)


def test_rows_are_what_python_finds(store: Path, tmp_path: Path) -> None:
    fields = tmp_path / "life.zarr"
    common = ("--criterion", "findley", "--along-y=1e-4", "--residual=-1e8,5e7")
    run = life(store, *common, "--material", "steel_42CrMo4", "--json", "-o", fields)
    assert run.returncode == 0, run.stderr
    found = fret.open(store).life(STEEL, "findley", x=1e-4, residual=[-1e8, 5e7])
    rows = [json.loads(line) for line in run.stdout.splitlines()]
    assert [row["layer"] for row in rows] == [0, 1]
    for row in rows:
        worst = found.worst_of(row["layer"])
        assert row["safety_factor"] == worst.margin
        assert (row["x"], row["y"], row["z"]) == (worst.x, worst.y, worst.z)
        assert row["error"] == worst.error
        assert tuple(row["normal"]) == worst.normal
        assert row["decides"] == (row["layer"] == found.worst.layer)
    np.testing.assert_array_equal(files.read(fields).value, found.dataset.value)


def test_lines_figure_and_distance(store: Path, tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text(TABLE, encoding="utf-8")
    own = ("--materials", tmp_path / "mine.toml", "--criterion", "dang_van")
    run = life(store, *own, "--depths", "0,1e-4", "-o", tmp_path / "life.png")
    assert run.returncode == 0, run.stderr
    assert run.stdout.startswith("layer 0: safety factor")
    assert run.stdout.rstrip().endswith("decides")
    assert (tmp_path / "life.png").stat().st_size > 1e4
    run = life(store, *own, "--distance", "3e-5", "--json")
    assert run.returncode == 0, run.stderr
    mine = fatigue.Materials(tmp_path / "mine.toml")["mine"]
    mean = fatigue.average(fret.open(store), mine, "dang_van", L=3e-5)
    assert json.loads(run.stdout)["value"] == float(mean.value.max())


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ((), "--material is missing"),
        (("--material", "steel"), "steel: must be one of CrN"),
        (("--material", "steel_42CrMo4,none,none"), "3 materials: must be one for all layers"),
        (("--material", "aluminium_7075_T6"), "s_D"),
        (("--material", "steel_42CrMo4", "-o", "life.txt"), "must end in .png"),
        (("--material", "none,steel_42CrMo4", "--distance", "1e-5"), "no material"),
        (
            ("--material", "steel_42CrMo4", "--distance", "1e-5", "-o", "life.png"),
            "means over a distance have no figure",
        ),
    ],
)
def test_bad_input_is_one_sentence(arguments: tuple[str, ...], says: str, store: Path) -> None:
    run = life(store, "--criterion", "crossland", *arguments)
    assert run.returncode == 2, run.stdout
    assert says in run.stderr
    assert len(run.stderr.strip().splitlines()) == 1
