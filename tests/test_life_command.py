"""`fret life` prints the numbers that Python returns."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import pyfret as fret
from conftest import ROOT, T_MAX, sphere_on_flat
from conftest import W as LOAD
from pyfret import fatigue

pytestmark = pytest.mark.solves

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
    environment = {k: v for k, v in os.environ.items() if k != "FRET_PYTHON"}
    command = [FRET, "life", *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False, env=environment)


def test_several_criteria_are_those_one_by_one(store: Path, tmp_path: Path) -> None:
    steel = ("--material", "steel_42CrMo4", "--json")
    together = life(store, *steel, "--criterion", "findley,crossland")
    assert together.returncode == 0, together.stderr
    parts = [life(store, *steel, "--criterion", name).stdout for name in ("findley", "crossland")]
    assert together.stdout == "".join(parts)


def test_lengths_and_stresses_may_have_their_unit(store: Path) -> None:
    common = (store, "--material", "steel_42CrMo4", "--criterion", "findley", "--json")
    plain = life(*common, "--distance", "2e-5", "--along-x=1e-6", "--residual=-1e8,5e7")
    units = life(*common, "--distance", "20 um", "--along-x=1 um", "--residual=-100 MPa,50 MPa")
    assert plain.returncode == 0, plain.stderr
    answer, expected = (
        {key: entry for key, entry in json.loads(item.stdout).items() if isinstance(entry, float)}
        for item in (units, plain)
    )
    assert len(expected) > 5
    assert answer == pytest.approx(expected, rel=1e-9)
    refused = life(*common, "--distance", "20 N")
    assert refused.returncode == 2
    assert "must be a number in m" in refused.stderr


def test_several_criteria_stand_below_each_other_in_a_table(store: Path, tmp_path: Path) -> None:
    steel = ("--material", "steel_42CrMo4", "--criterion")
    tables = {}
    names = ("findley", "smith_watson_topper", "crossland")
    for entry_name in (*names, ",".join(names)):
        written = life(store, *steel, entry_name, "-o", tmp_path / "a.csv")
        assert written.returncode == 0, written.stderr
        tables[entry_name] = pd.read_csv(tmp_path / "a.csv")
    together = tables[",".join(names)]
    assert list(dict.fromkeys(together.criterion)) == list(names)
    for name in names:
        entry_name, alone = (
            together[together.criterion == name].reset_index(drop=True),
            tables[name],
        )
        assert len(entry_name) == len(alone) > 100
        for column in alone:
            title, _, unit = column.partition(" [")
            whole = title if title in ("value", "missed") else column
            assert entry_name[whole].equals(alone[column]), column
            if title == "value":
                assert set(entry_name.unit) == {unit.rstrip("]")}
        empty = "life [cycles]" if "safety_factor" in alone else "safety_factor"
        assert entry_name[empty].isna().all()


def test_rows_are_what_python_finds(store: Path, tmp_path: Path) -> None:
    fields = tmp_path / "life.csv"
    common = ("--criterion", "findley", "--along-y=1e-4", "--residual=-1e8,5e7")
    steel = ("--material", "steel_42CrMo4,steel_42CrMo4")
    run = life(store, *common, *steel, "--json", "-o", fields)
    assert run.returncode == 0, run.stderr
    computed = fret.open(store).life([STEEL, STEEL], "findley", x=1e-4, residual=[-1e8, 5e7])
    rows = [json.loads(line) for line in run.stdout.splitlines()]
    assert [row["layer"] for row in rows] == [0, 1]
    for row in rows:
        mask = computed.dataset.isel(depth=computed.dataset.layer.values == row["layer"])
        # No point of the section is worse, and the value is the margin's.
        assert row["value"] >= float(mask.value.max()) * (1 - 1e-9)
        assert row["safety_factor"] == pytest.approx(
            STEEL.assessment("findley").safety_factor(row["value"]), rel=1e-9
        )
        assert np.linalg.norm(row["normal"]) == pytest.approx(1.0)
        assert abs(row["inclination"]) <= 90.0
        assert row["error"] >= row["error_z"] >= 0.0
        assert row["x"] == 1e-4
        arguments = computed.range_of(row["layer"])
        assert [row[key] for key in ("low", "best", "high", "L")] == pytest.approx(
            [arguments.low, arguments.best, arguments.high, arguments.L], rel=1e-9
        )
        assert row["notes"][: len(arguments.notes)] == list(arguments.notes)
        # The range at the point has the scatter of the material, as the range of the mean has.
        worst = computed.worst_of(row["layer"])
        assert row["at_point"] == pytest.approx(list(worst.whole), rel=1e-9)
        assert worst.whole[1] / worst.whole[0] > arguments.material
    assert [row["decides"] for row in rows].count(True) == 1
    table = np.genfromtxt(fields, delimiter=",", skip_header=1)
    np.testing.assert_allclose(table[:, 4], computed.dataset.value.values.ravel(), rtol=1e-12)


def test_the_table_of_a_distance_has_the_means(store: Path, tmp_path: Path) -> None:
    out, L = tmp_path / "means.csv", 1e-5
    steel = ("--material", "steel_42CrMo4", "--along-x=0")
    criteria = ("--criterion", "findley,crossland")
    run = life(store, *steel, *criteria, "--distance", f"{L}", "-o", out)
    assert run.returncode == 0, run.stderr
    table = pd.read_csv(out)
    for name in ("findley", "crossland"):
        means = fatigue.average(fret.open(store), STEEL, name, L=L, y=0.0)
        held = means.value.notnull()
        rows = table[table.criterion == name]
        np.testing.assert_allclose(rows["x [m]"], means.x[held], rtol=1e-12)
        np.testing.assert_allclose(rows["value"], means.value[held], rtol=1e-9)
        np.testing.assert_allclose(rows["safety_factor"], means.safety_factor[held], rtol=1e-9)
        # From the top of the layer that has the material.
        thickness = fret.open(store).scene.body2.coatings[0].thickness
        np.testing.assert_allclose(rows["z [m]"], thickness, rtol=1e-12)
        assert set(rows["layer"]) == {1}


def test_lines_and_distance(store: Path, tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text(TABLE, encoding="utf-8")
    own_values = ("--materials", tmp_path / "mine.toml", "--criterion", "dang_van")
    run = life(store, *own_values)
    assert run.returncode == 0, run.stderr
    # One material is the substrate's.
    assert run.stdout.startswith("the substrate: safety factor")
    assert ", the least of this body at a point, limited by dang_van = " in run.stdout
    pair = ("--material", "mine,mine")
    run = life(store, *own_values, *pair, "--distance", "3e-5", "--json")
    assert run.returncode == 0, run.stderr
    stress = fatigue.history(fret.open(store), (np.arange(40) + 0.5) / 40 * 6e-5, y=0.0)
    mean = stress.mean("depth").transpose("increment", "x", "component")
    mine = fatigue.Materials(tmp_path / "mine.toml")["mine"]
    expected = float(fatigue.evaluate_margin(mean, mine, "dang_van").value.max())
    assert json.loads(run.stdout)["value"] == pytest.approx(expected, rel=2e-3)
    run = life(store, *own_values, "--distance", "3e-5", "--json")
    assert json.loads(run.stdout)["layer"] == 1


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        ((), "--material = nothing: must be one of CrN"),
        (("--material", "stell"), "stell: must be one of CrN"),
        (("--material", "steel_42CrMo4,none,none"), "materials = 3: must be one, the substrate's"),
        (("--material", "alumina"), "s_D"),
        (("--material", "steel_42CrMo4", "-o", "life.png"), "pyfret.plot.criterion_map"),
        (
            ("--material", "none,steel_42CrMo4", "--distance", "1e-5", "--layer", "0"),
            "a layer that has a material",
        ),
    ],
)
def test_bad_input_is_one_sentence(arguments: tuple[str, ...], expected: str, store: Path) -> None:
    run = life(store, "--criterion", "crossland", *arguments)
    assert run.returncode == 2, run.stdout
    assert expected in run.stderr
    assert len(run.stderr.strip().splitlines()) == 1
