"""`--json`: what every command prints is JSON, numbers that are not finite included."""

from __future__ import annotations

import ast
import json
import math
import subprocess
from pathlib import Path
from typing import Any

import pytest

import pyfret as fret
from conftest import ROOT, sphere_on_flat
from pyfret._cli import commands, parser
from pyfret._cli.printing import as_printed

CLI = Path(parser.__file__).parent
FRET = ROOT / "target" / "release" / "fret"


def refused(name: str) -> None:
    raise AssertionError(f"{name} is no JSON")


def read(text: str) -> Any:
    return json.loads(text, parse_constant=refused)


def test_one_writer_serves_all_commands() -> None:
    """Nobody else in the command line writes JSON."""
    writers = {
        file.name
        for file in CLI.glob("*.py")
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8")))
        if isinstance(node, ast.Attribute) and node.attr in ("dumps", "dump")
    }
    assert writers == {"printing.py"}
    takes = [file for file in CLI.glob("*.py") if '"--json"' in file.read_text(encoding="utf-8")]
    for file in takes:
        text = file.read_text(encoding="utf-8")
        assert "print_json(" in text, file.name


def test_a_number_that_is_not_finite_is_null_with_its_reason() -> None:
    surface = read(
        json.dumps(
            as_printed(
                {
                    "life": math.inf,
                    "error": math.nan,
                    "ends": [1.0, math.inf],
                    "of": {"best": math.nan},
                    "rows": [{"x": math.inf}],
                    "n": 3,
                    "missing": None,
                    "deep": [[1.0, math.nan], [2.0, 3.0]],
                    "told": "inf",
                    "cycles": math.inf,
                    "cycles_why": "stops",
                }
            ),
            allow_nan=False,
        )
    )
    assert surface["life"] is surface["error"] is None
    assert (surface["life_why"], surface["error_why"]) == ("infinite", "not known")
    assert (surface["ends"], surface["ends_why"]) == ([1.0, None], [None, "infinite"])
    assert surface["of"] == {"best": None, "best_why": "not known"}
    assert surface["rows"] == [{"x": None, "x_why": "infinite"}]
    assert (surface["missing"], surface["missing_why"]) == (None, "not known")
    assert surface["deep_why"] == [[None, "not known"], None]
    assert (surface["n"], surface["told"], surface["cycles_why"]) == (3, "inf", "stops")


@pytest.mark.solves
def test_commands_print_json_where_numbers_end(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A contact that sticks (mu infinite), and cracks that stop."""
    store = tmp_path / "out.zarr"
    path = fret.LoadPath.start().normal(1e3, increments=2).cycles(1, T_x=100.0, increments=4)
    scene = sphere_on_flat(n=24).replace(friction="stick", path=path, save="all")
    (tmp_path / "scene.toml").write_text(scene.to_toml())
    run = subprocess.run(
        [FRET, "run", tmp_path / "scene.toml", "-o", store, "--json"],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    text = read(run.stdout)
    assert (text["mu"], text["mu_why"]) == (None, "infinite")
    life = subprocess.run(
        [FRET, "life", store, "--material", "7075", "--criterion", "smith_watson_topper", "--json"],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert life.returncode == 0, life.stderr
    for row in map(read, life.stdout.splitlines()):
        for name in ("low", "best", "high"):
            assert (row[name] is None) == (f"{name}_why" in row)
    crack = [
        "crack",
        str(store),
        "--lengths",
        "1e-5,2e-5,3e-5,4e-5",
        "--dK-th",
        "1e9",
        "--paris",
        "1e-11,3",
    ]
    assert commands.main([*crack, "--json"]) == 0
    rows = [read(line) for line in capsys.readouterr().out.splitlines()]
    assert rows[-1]["cycles"] is None
    assert rows[-1]["cycles_why"].startswith("the crack does not grow from a length of")


@pytest.mark.solves
def test_a_contact_without_friction_has_no_stick_ratio(tmp_path: Path) -> None:
    path = fret.LoadPath.start().normal(1e3, increments=2)
    scene = sphere_on_flat(n=24).replace(friction=0.0, path=path)
    result = fret.solve(scene, progress=False)
    for text in (result.summary(), result._repr_html_(), result.at(-1)._repr_html_()):
        assert "no friction" in text
        assert "stick" not in text
    (tmp_path / "scene.toml").write_text(scene.to_toml())
    for extra in ((), ("--json",)):
        command = [FRET, "run", tmp_path / "scene.toml", "-o", tmp_path / "a.zarr", "--overwrite"]
        run = subprocess.run([*command, *extra], capture_output=True, text=True, check=False)
        assert run.returncode == 0, run.stderr
        assert "full" not in run.stdout
    (branch,) = read(run.stdout)["branches"]
    assert (branch["stick_ratio"], branch["status"]) == (None, "no_friction")
