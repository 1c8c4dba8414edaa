"""Commands in Python have the help, errors and exit codes of the compiled commands."""

from __future__ import annotations

import argparse
import errno
import json
import re
import subprocess
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

import pyfret as fret
from conftest import ROOT, sphere_on_flat
from pyfret._cli import NEEDS_PYTHON, commands, export, fit
from pyfret._cli.values import Value, Values, number, setting
from pyfret._core import unit_of, units

pytestmark = pytest.mark.solves

COMMANDS = (
    "study",
    "compare",
    "explore",
    "export",
    "crack",
    "damage",
    "fit",
    "threshold",
    "info",
    "table",
    "report",
    "verify",
    "cite",
    "workbench",
)


def test_commands_of_python_do_not_go_back_to_the_compiled_one() -> None:
    choices = commands.parser()._subparsers._group_actions[0].choices  # type: ignore[union-attr]
    assert set(choices or ()) == NEEDS_PYTHON


def help_of(*words: str, capsys: pytest.CaptureFixture[str]) -> str:
    assert commands.main([*words, "--help"]) == 0
    return capsys.readouterr().out


@pytest.mark.parametrize("command", COMMANDS)
def test_help_says_what_a_command_does_how_and_with_what(
    command: str, capsys: pytest.CaptureFixture[str]
) -> None:
    output = help_of(command, capsys=capsys)
    first, empty, usage, *_ = output.splitlines()
    assert first[0].isupper()
    assert empty == ""
    assert usage.startswith(f"Usage: fret {command} [OPTIONS]")
    options = output[output.index("Options:") :].splitlines()
    assert options[-1].split(maxsplit=2)[:2] == ["-h,", "--help"]
    assert "  -q, --quiet" in output
    assert "%%" not in output
    assert max(len(line) for line in output.splitlines() if not line.startswith("Usage")) <= 100
    # No option without a meaning.
    names = [line for line in options[1:] if line.lstrip().startswith("-")]
    for n, line in enumerate(options[1:]):
        if line in names and len(line.split(maxsplit=3)) < 3:
            following = options[n + 2]
            assert following.startswith(" " * 20), line


#: A unit in the help of an option.
UNIT = re.compile(r"\[(?:m|N|Pa|Pa m\^0\.5|rad|degrees)\b[^]]*\]|metres|newtons|pascals")


def quantities() -> Iterator[tuple[str, argparse.Action]]:
    """All options of the commands in Python that are numbers with a unit."""
    chosen = next(action for action in commands.parser()._actions if action.dest == "command")
    assert chosen.choices is not None
    for name, parser in dict(chosen.choices).items():  # type: ignore[call-overload]
        for action in parser._actions:
            if isinstance(action.type, Value | Values):
                yield name, action
            elif action.option_strings and UNIT.search(action.help or ""):
                raise AssertionError(f"fret {name} {action.option_strings}: takes no unit")


def test_every_option_that_is_a_quantity_may_have_a_unit() -> None:
    """The commands in Python take lengths, stresses and angles, one or several."""
    checked = set()
    for name, action in quantities():
        checked.add((name, action.dest))
        assert f"[{action.type.unit}, or with a unit]" in (action.help or "")  # type: ignore[union-attr]
        parts = action.type.kinds if isinstance(action.type, Values) else (action.type,)
        for item in parts:
            assert isinstance(item, Value)
            assert item("0.25") == 0.25
            computed = unit_of(item.unit)
            if computed is None:
                continue
            # Every other unit of the same kind.
            for unit in units(computed[0]).split(", "):
                alternative = unit_of(unit)
                assert alternative is not None
                assert item(f"2 {unit}") == pytest.approx(
                    2.0 * alternative[1] / computed[1], rel=1e-12
                )
            with pytest.raises(argparse.ArgumentTypeError, match="must be"):
                item("2 parsec")
    expected = {"lengths", "x", "angle", "kink", "azimuth", "residual", "dK_th", "dS_0"}
    assert {("crack", item) for item in expected} | {("threshold", "distance")} <= checked


#: Options of several numbers that are no quantities.
DIRECTIONS = {("export", "axis_x"), ("export", "axis_z")}


def test_every_option_of_several_numbers_is_a_quantity_or_a_direction() -> None:
    """All options whose default is a text of numbers, read by the command itself."""
    chosen = next(action for action in commands.parser()._actions if action.dest == "command")
    assert chosen.choices is not None
    names = set()
    for name, parser in dict(chosen.choices).items():  # type: ignore[call-overload]
        for action in parser._actions:
            if isinstance(action.default, str) and re.fullmatch(r"[-\d.,]+", action.default):
                names.add((name, action.dest))
                taken = "or with a unit]" in (action.help or "")
                assert taken != ((name, action.dest) in DIRECTIONS), action.option_strings
    assert {("export", "origin"), *DIRECTIONS} <= names


@pytest.mark.parametrize(("text", "unit", "x"), [("20 um,0,0", "mm", 0.02), ("2,0,0", "mm", 2.0)])
def test_the_origin_of_an_export_has_the_unit_of_the_model(text: str, unit: str, x: float) -> None:
    item = Value("length", unit)
    assert export.three(text, "--origin", item) == pytest.approx((x, 0.0, 0.0))
    with pytest.raises(ValueError, match=r"--origin: .*must be"):
        export.three("2 N,0,0", "--origin", item)


@pytest.mark.parametrize("command", ["stress", "life"])
def test_the_compiled_commands_say_so_too(command: str) -> None:
    fret_ = ROOT / "target" / "release" / "fret"
    ran = subprocess.run([fret_, command, "--help"], capture_output=True, text=True, check=True)
    # Lines are broken anywhere.
    words = " ".join(ran.stdout.split())
    matches = UNIT.findall(words)
    assert len(matches) >= 4
    assert {item.partition(",")[2] for item in matches} == {" or with a unit]"}


def test_the_help_of_all_names_the_commands_and_the_exit_codes(
    capsys: pytest.CaptureFixture[str],
) -> None:
    output = help_of(capsys=capsys)
    assert all(f"  {command} " in output for command in COMMANDS)
    assert "Exit codes: 0 done; 1" in output


def test_a_wrong_command_line_is_told_with_the_way_out(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert commands.main(["crack", "store.zarr", "--nothing"]) == 2
    output = capsys.readouterr().err
    assert output.startswith("error: ")
    assert "--nothing" in output
    assert "try '--help'" in output
    # Half a name is no name: it would be another one with the next option.
    assert commands.main(["crack", "store.zarr", "--leng", "1e-5"]) == 2


@pytest.fixture(scope="module")
def store(tmp_path_factory: pytest.TempPathFactory) -> Path:
    position = tmp_path_factory.mktemp("quiet") / "out.zarr"
    path = fret.LoadPath.start().normal(1e3, increments=2).cycles(1, T_x=100.0, increments=4)
    fret.solve(sphere_on_flat(n=24), path, save="all", out=position, progress=False)
    return position


def test_quiet_prints_nothing_and_with_json_the_json(
    store: Path, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    lengths = ["--lengths", "1e-5,2e-5"]
    assert commands.main(["crack", str(store), *lengths, "-q"]) == 0
    assert capsys.readouterr().out == ""
    assert commands.main(["crack", str(store), *lengths, "-q", "--json"]) == 0
    rows = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [row["length"] for row in rows] == [1e-5, 2e-5]
    out = tmp_path / "tractions.csv"
    assert commands.main(["export", str(store), "-o", str(out), "--quiet"]) == 0
    assert out.is_file()
    assert capsys.readouterr().out == ""


def test_lengths_with_units_are_those_in_metres(
    store: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    progress = []
    for lengths, angle in (("1e-5,2e-5", "10"), ("10 um, 0.02 mm", "10 degrees")):
        crack = ["crack", str(store), "--lengths", lengths, "--angle", angle, "--json"]
        assert commands.main(crack) == 0
        rows = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
        progress.append([[row[name] for name in ("length", "K_max", "dK")] for row in rows])
    assert progress[0] == pytest.approx(np.array(progress[1]), rel=1e-9)
    assert commands.main(["crack", str(store), "--lengths", "5 N"]) == 2
    assert "must be" in capsys.readouterr().err


def test_values_of_keys_of_a_scene_may_have_a_unit() -> None:
    """The options --between, --over and --unknown take the unit of the key."""
    assert number("path.1.T_x", "20 kN") == 2e4
    assert number("rig.stiffness", " 5 N/um") == pytest.approx(5e6)
    assert number("body2.coatings.0.E", "3e11") == 3e11
    assert fit.range_of("body2.coatings.0.thickness=1 um:5 um") == (
        "body2.coatings.0.thickness",
        pytest.approx((1e-6, 5e-6)),
    )
    with pytest.raises(ValueError, match=r"must be KEY=LOW:HIGH.*must be a number in m"):
        fit.range_of("body2.coatings.0.thickness=1 N:5 N")
    with pytest.raises(ValueError, match="unit of my_key is not known"):
        number("my_key", "2 um")
    assert setting("grid.n=64") == ("grid.n", 64)
    assert setting("path.0.W=20 N") == ("path.0.W", "20 N")


def test_what_cannot_be_written_is_refused_before_anything_is_solved(
    store: Path, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    scene, study = tmp_path / "scene.toml", tmp_path / "study.toml"
    scene.write_text(fret.open(store).scene.to_toml(), encoding="utf-8")
    study.write_text(
        'scene = "scene.toml"\nmeasure = ["p_max"]\n[parameters]\n'
        '"friction.mu" = [0.3, 0.4]\n"body2.nu" = [0.3, 0.31]\n"body1.nu" = [0.3, 0.31]\n',
        encoding="utf-8",
    )
    out = tmp_path / "s.zarr"
    common = ["study", str(study), "-o", str(out), "--workers", "1"]
    assert commands.main([*common, "--map", str(tmp_path / "map.png")]) == 2
    output = capsys.readouterr().err
    assert "has 3 parameters" in output
    assert '.map(at={"body1.nu": 0.3})' in output
    assert commands.main([*common, "--map", str(tmp_path / "map.txt")]) == 2
    assert "must end in .png" in capsys.readouterr().err
    assert commands.main(["crack", str(store), "-o", "crack.txt"]) == 2
    assert "must end in .png" in capsys.readouterr().err
    assert not out.exists()


@pytest.mark.usefixtures("without_overview")
def test_every_command_tells_programs_what_came_out(
    store: Path, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    def answer_of(*words: str) -> dict[str, object]:
        assert commands.main([*words, "--json", "--quiet"]) == 0
        answer = json.loads(capsys.readouterr().out)
        assert isinstance(answer, dict)
        return answer

    out = tmp_path / "tractions.csv"
    assert answer_of("export", str(store), "-o", str(out)) == {
        "file": str(out),
        "body": 2,
        "unit": "m",
        "bytes": out.stat().st_size,
    }
    page = tmp_path / "page.html"
    crack = ["--crack", "--lengths", "1e-5,3e-5,6e-5,1e-4", "--dK-th", "3e6"]
    assert answer_of("report", str(store), "-o", str(page), *crack) == {
        "page": str(page),
        "bytes": page.stat().st_size,
    }
    assert "kitagawa" in page.read_text(encoding="utf-8")
    sources = answer_of("cite", str(store))["sources"]
    assert "10.24874/ti.2020.42.01.13" in json.dumps(sources)
    study = tmp_path / "study.toml"
    scene = tmp_path / "scene.toml"
    scene.write_text(fret.open(store).scene.to_toml(), encoding="utf-8")
    study.write_text(
        'scene = "scene.toml"\nmeasure = ["stick_ratio"]\n'
        '[parameters]\n"friction.mu" = [0.3, 0.4]\n',
        encoding="utf-8",
    )
    assert answer_of("study", str(study), "-o", str(tmp_path / "s.zarr"), "--workers", "1") == {
        "store": str(tmp_path / "s.zarr"),
        "points": {"open": 0, "done": 2, "failed": 0, "partly": 0},
        "measures": ["stick_ratio"],
        "failed": [],
        "unanswered": [],
        "map": None,
        "map_why": "not asked for",
    }


@pytest.mark.parametrize(
    ("number", "code"), [(errno.ENOSPC, 3), (errno.EROFS, 3), (errno.EACCES, 2)]
)
def test_a_full_disk_is_told_from_bad_input(
    number: int, code: int, store: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    def write(*_: object, **__: object) -> None:
        raise OSError(number, "said by the system", str(tmp_path / "page.html"))

    monkeypatch.setattr(fret.Result, "report", write)
    assert commands.main(["report", str(store), "-o", str(tmp_path / "page.html")]) == code
