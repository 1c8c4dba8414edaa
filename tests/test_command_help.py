"""Help, errors and exit codes of the commands in Python are those of the compiled ones."""

from __future__ import annotations

import errno
import json
from pathlib import Path

import pytest

import pyfret as fret
from conftest import sphere_on_flat
from pyfret._cli import commands

pytestmark = pytest.mark.solves

COMMANDS = (
    "study",
    "compare",
    "explore",
    "export",
    "crack",
    "fit",
    "threshold",
    "report",
    "verify",
    "cite",
)


def help_of(*words: str, capsys: pytest.CaptureFixture[str]) -> str:
    assert commands.main([*words, "--help"]) == 0
    return capsys.readouterr().out


@pytest.mark.parametrize("command", COMMANDS)
def test_help_says_what_a_command_does_how_and_with_what(
    command: str, capsys: pytest.CaptureFixture[str]
) -> None:
    said = help_of(command, capsys=capsys)
    first, empty, usage, *_ = said.splitlines()
    assert first[0].isupper()
    assert empty == ""
    assert usage.startswith(f"Usage: fret {command} [OPTIONS]")
    options = said[said.index("Options:") :].splitlines()
    assert options[-1].split(maxsplit=2)[:2] == ["-h,", "--help"]
    assert "  -q, --quiet" in said
    assert max(len(line) for line in said.splitlines() if not line.startswith("Usage")) <= 100
    # No option without a meaning.
    names = [line for line in options[1:] if line.lstrip().startswith("-")]
    for n, line in enumerate(options[1:]):
        if line in names and len(line.split(maxsplit=3)) < 3:
            following = options[n + 2]
            assert following.startswith(" " * 20), line


def test_the_help_of_all_names_the_commands_and_the_exit_codes(
    capsys: pytest.CaptureFixture[str],
) -> None:
    said = help_of(capsys=capsys)
    assert all(f"  {command} " in said for command in COMMANDS)
    assert "Exit codes: 0 done; 1" in said


def test_a_wrong_command_line_is_told_with_the_way_out(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert commands.main(["crack", "store.zarr", "--nothing"]) == 2
    said = capsys.readouterr().err
    assert said.startswith("error: ")
    assert "--nothing" in said
    assert "try '--help'" in said
    # Half a name is no name: it would be another one with the next option.
    assert commands.main(["crack", "store.zarr", "--leng", "1e-5"]) == 2


@pytest.fixture(scope="module")
def store(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("quiet") / "out.zarr"
    path = fret.LoadPath.start().normal(1e3, increments=2).cycles(1, T_x=100.0, increments=4)
    fret.solve(sphere_on_flat(n=24), path, save="all", out=place, progress=False)
    return place


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


def test_every_command_tells_programs_what_came_out(
    store: Path, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    def told(*words: str) -> dict[str, object]:
        assert commands.main([*words, "--json", "--quiet"]) == 0
        found = json.loads(capsys.readouterr().out)
        assert isinstance(found, dict)
        return found

    out = tmp_path / "tractions.csv"
    assert told("export", str(store), "-o", str(out)) == {
        "file": str(out),
        "body": 2,
        "unit": "m",
        "bytes": out.stat().st_size,
    }
    page = tmp_path / "page.html"
    crack = ["--crack", "--lengths", "1e-5,3e-5,6e-5,1e-4", "--dK-th", "3e6"]
    assert told("report", str(store), "-o", str(page), *crack) == {
        "page": str(page),
        "bytes": page.stat().st_size,
    }
    assert "kitagawa" in page.read_text(encoding="utf-8")
    sources = told("cite", str(store))["sources"]
    assert "10.24874/ti.2020.42.01.13" in json.dumps(sources)
    study = tmp_path / "study.toml"
    scene = tmp_path / "scene.toml"
    scene.write_text(fret.open(store).scene.to_toml(), encoding="utf-8")
    study.write_text(
        'scene = "scene.toml"\nmeasure = ["stick_ratio"]\n'
        '[parameters]\n"friction.mu" = [0.3, 0.4]\n',
        encoding="utf-8",
    )
    assert told("study", str(study), "-o", str(tmp_path / "s.zarr"), "--workers", "1") == {
        "store": str(tmp_path / "s.zarr"),
        "points": {"open": 0, "done": 2, "failed": 0},
        "measures": ["stick_ratio"],
        "failed": [],
        "map": None,
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
