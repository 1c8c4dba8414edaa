"""`--json` of every command that has it: JSON in which every null has a reason."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyfret as fret
from conftest import ROOT
from pyfret._cli import commands

FRET = ROOT / "target" / "release" / "fret"
STEEL = fret.Elastic(E=210e9, nu=0.3)

WEAR = """
[wear]
cycles = 200
first_branch = 2
jumps = 2
[wear.body2]
k = 1e-14
"""
STUDY = """
scene = "scene.toml"
measure = ["p_max", "energy_ratio"]
[parameters]
mu = [0.3, 0.4]
"""
COMPARE = """
scene = "scene.toml"
questions = ["tension", "energy", "yield"]
[candidates.bare]
material = "titanium_6Al4V"
[candidates.other]
mu = 0.4
"""
RUN = ["run", "scene.toml", "-o", "new.zarr", "--overwrite"]
STORE = "out.zarr"
LENGTHS = "1e-5,2e-5,3e-5,4e-5"
SEARCHED = ["--criterion", "crossland", "--parameter", "path.1.T_x,-path.2.T_x,path.3.T_x"]
#: Ways of every command that has ``--json``. Those of commands that do not solve come last.
WAYS: dict[str, list[list[str]]] = {
    "run": [RUN, [*RUN, "--error"], ["run", "punch.toml", "-o", "punch.zarr"]],
    "resume": [["resume", "half.zarr"]],
    "check": [["check", "scene.toml"], ["check", "punch.toml"], ["check", "wrong.toml"]],
    "wear": [["wear", "wear.toml", "-o", "worn.zarr"]],
    "life": [
        ["life", STORE, "--material", "7075", "--criterion", item, *extra]
        for item in ("smith_watson_topper", "crossland")
        for extra in ((), ("--distance", "2e-5"))
    ],
    "stress": [
        ["stress", STORE],
        ["stress", STORE, "--along-x", "0", "--of", "von_mises,u_z"],
        ["stress", STORE, "--volume", "--depths", "4"],
    ],
    "crack": [
        ["crack", STORE, "--lengths", LENGTHS],
        ["crack", STORE, "--lengths", LENGTHS, "--material", "titanium_6Al4V"],
        *(
            ["crack", STORE, "--lengths", LENGTHS, "--dK-th", item, "--paris", "1e-11,3"]
            for item in ("2e4", "1e6", "3e7")
        ),
    ],
    "study": [["study", "study.toml", "--workers", "1"]],
    "compare": [["compare", "compare.toml", "--workers", "1"]],
    "fit": [["fit", "loop.csv", "scene.toml", "--unknown", "mu=0.2:1.2"]],
    "threshold": [
        ["threshold", "scene.toml", "--material", "7075", "--between", "2e4:5.9e4", *SEARCHED]
    ],
    "export": [["export", STORE, "-o", "p.csv"]],
    "info": [["info", "loop.csv"], ["info", STORE]],
    "report": [["report", STORE, "-o", "page.html"]],
    "cite": [["cite"], ["cite", STORE]],
    "table": [
        ["table", STORE, *extra]
        for extra in ((), ("--of", "branches"), ("--of", "loops"), ("-o", "table.csv"))
    ],
    "damage": [
        ["damage", "pressed.toml", "rig.csv", "--material", "7075", *extra]
        for extra in ((), ("--criterion", "crossland", "--exponent", "5"))
    ],
}
#: Checks all of the package for minutes; its answer has no number that may be missing.
LONG = {"verify"}


#: Parsers of the commands that ``fret`` hands to Python, which `test_report.py` looks at.
IN_PYTHON: dict[str, Any] = commands.parser()._subparsers._group_actions[0].choices  # type: ignore[union-attr, assignment]


def fret_of(*words: str, folder: Path) -> subprocess.CompletedProcess[str]:
    extra = {"FRET_PYTHON": sys.executable, "MPLBACKEND": "Agg"}
    return subprocess.run(
        [FRET, *words], capture_output=True, text=True, cwd=folder, check=False,
        env={**os.environ, **extra},
    )  # fmt: skip


@pytest.fixture
def ran(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Callable[..., subprocess.CompletedProcess[str]]:
    """Return a function that runs a command; one of Python runs in this process."""

    def run(*words: str) -> subprocess.CompletedProcess[str]:
        if words[0] not in IN_PYTHON:
            return fret_of(*words, folder=folder)
        monkeypatch.chdir(folder)
        code = commands.main(words)
        printed = capsys.readouterr()
        return subprocess.CompletedProcess(words, code, printed.out, printed.err)

    return run


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A line contact with a cycle of partial slip, what it is asked of, and a punch."""
    position = tmp_path_factory.mktemp("json")
    path = fret.LoadPath.start().normal(1e5, increments=2).cycles(1, T_x=2e4, increments=4)
    scene = fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Cylinder(R=0.05)),
        body2=fret.Body(STEEL),
        friction=0.6,
        grid=fret.Grid.strip(extent=8e-4, n=32),
        path=path,
    ).replace(save="all")
    text = scene.to_toml()
    (position / "scene.toml").write_text(text)
    (position / "wear.toml").write_text(text + WEAR)
    (position / "wrong.toml").write_text(text.replace("mu = 0.6", "mu = -1"))
    punch = scene.replace(
        body1=fret.Body(STEEL, shape=fret.shapes.FlatPunch(radius=2e-4, edge=1e-4))
    )
    (position / "punch.toml").write_text(
        punch.replace(
            grid=fret.Grid.centred(width=8e-4, n=16),
            friction=0.0,
            path=fret.LoadPath.start().normal(100.0, increments=2),
        ).to_toml()
    )
    # One that only presses, and the recording of a force that follows.
    pressed = scene.replace(path=fret.LoadPath.start().normal(1e5, increments=2))
    (position / "pressed.toml").write_text(pressed.to_toml())
    samples = 2e4 * np.sin(np.arange(200))
    recorded = "\n".join(f"{n / 100:.2f};{force:.9g}" for n, force in enumerate(samples))
    (position / "rig.csv").write_text(f"t [s];T_x [N/m]\n{recorded}\n")
    (position / "study.toml").write_text(STUDY)
    (position / "compare.toml").write_text(COMPARE)
    result = fret.solve(scene, out=position / STORE, progress=False)
    shift, force = (result.dataset[name].values for name in ("delta_x", "T_x"))
    rows = zip(1e6 * shift[2:], force[2:], strict=True)
    table = "\n".join(f"{x:.9g};{y:.9g}" for x, y in rows)
    (position / "loop.csv").write_text(f"delta [um];T [N/m]\n{table}\n")
    begun = fret_of("run", "scene.toml", "-o", "half.zarr", folder=position)
    assert begun.returncode == 0, begun.stderr
    return position


def refused(name: str) -> None:
    raise AssertionError(f"{name} is no JSON")


def answers(text: str) -> list[Any]:
    """The JSON objects of an output: one over several lines, or one a line."""
    decoder, computed, at = json.JSONDecoder(parse_constant=refused), [], 0
    while text[at:].strip():
        at += len(text[at:]) - len(text[at:].lstrip())
        value, at = decoder.raw_decode(text, at)
        computed.append(value)
    return computed


def without_reason(value: Any, at: str = "") -> list[str]:
    """List the nulls without a reason."""
    if isinstance(value, list):
        return [w for n, item in enumerate(value) for w in without_reason(item, f"{at}[{n}]")]
    if not isinstance(value, dict):
        return []
    collected = []
    for name, entry in value.items():
        if name.endswith("_why"):
            continue
        why, local = value.get(f"{name}_why"), f"{at}.{name}"
        if not reasons_fit([entry], [why]):
            collected.append(local)
        collected += without_reason(entry, local)
    return collected


def reasons_fit(values: list[Any], reasons: Any) -> bool:
    """Whether every null of a list, at any depth, has its reason at the same place."""
    for n, item in enumerate(values):
        why = reasons[n] if isinstance(reasons, list) and n < len(reasons) else None
        if item is None and not isinstance(why, str):
            return False
        if isinstance(item, list) and not reasons_fit(item, why):
            return False
    return True


def test_the_search_for_nulls_finds_them() -> None:
    assert without_reason({"a": None}) == [".a"]
    assert without_reason({"a": [1.0, None]}) == [".a"]
    assert without_reason({"a": [[None]], "a_why": [["infinite"]]}) == []
    assert without_reason({"a": {"b": None, "b_why": "not known"}, "c": 1}) == []


@pytest.mark.solves
def test_every_command_with_json_is_walked_over(folder: Path) -> None:
    listed = re.findall(r"^  (\w+)  ", fret_of("--help", folder=folder).stdout, re.MULTILINE)
    assert len(listed) > 10
    texts = {
        item: IN_PYTHON[item].format_help()
        if item in IN_PYTHON
        else fret_of(item, "--help", folder=folder).stdout
        for item in listed
    }
    with_json = {item for item, text in texts.items() if "--json" in text}
    assert with_json - LONG - {"help"} == set(WAYS)


@pytest.mark.solves
@pytest.mark.filterwarnings("ignore")
@pytest.mark.usefixtures("without_overview")
@pytest.mark.parametrize("command", WAYS)
def test_every_null_has_its_reason(
    ran: Callable[..., subprocess.CompletedProcess[str]], command: str
) -> None:
    for direction in WAYS[command]:
        run = ran(*direction, "--json")
        assert run.returncode == (2 if "wrong.toml" in direction else 0), (direction, run.stderr)
        computed = answers(run.stdout)
        if command != "resume":
            assert computed, direction
        for answer in computed:
            assert without_reason(answer) == [], direction


@pytest.mark.solves
@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("material", ["steel_42CrMo4", "titanium_6Al4V"])
def test_a_threshold_that_rests_on_an_estimate_says_so(
    ran: Callable[..., subprocess.CompletedProcess[str]], material: str
) -> None:
    marked = material == "titanium_6Al4V"
    direction = [item if item != "7075" else material for item in WAYS["threshold"][0]]
    direction += ["--distance", "2e-5", "--value", "3"]
    run = ran(*direction)
    assert run.returncode == 0, run.stderr
    assert ("estimate" in run.stdout) == marked
    (row,) = answers(ran(*direction, "--json").stdout)
    assert ("estimate" in row) == marked
    # The scene is a line contact.
    assert row["unit"] == "N/m"
    assert run.stdout.count("[N/m]") == 4, run.stdout


def test_one_function_writes_what_the_compiled_commands_print() -> None:
    """Nobody else turns JSON into text; Python's commands have a test of their own."""
    as_text = r"\{:#\}|serde_json::to_string|json!\([^;]*\)\s*\.to_string\(\)"
    printed = re.compile(as_text, re.DOTALL)
    writers = {
        file.name
        for file in (ROOT / "crates" / "fret-cli" / "src").rglob("*.rs")
        if printed.search(file.read_text(encoding="utf-8"))
    }
    assert writers == {"json.rs"}
