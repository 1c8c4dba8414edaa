"""The JSON Schema of the scene file has the keys, units and defaults of the reader."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import jsonschema
import pytest

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

import pyfret as fret
from conftest import ROOT
from pyfret import _core
from pyfret._core import run_command, unit_of

SCHEMA: dict[str, Any] = json.loads(
    (ROOT / "crates/fret-cli/src/scene.schema.json").read_text(encoding="utf-8")
)
SCENES = sorted((ROOT / "scenes").glob("*.toml"))
TEMPLATES = sorted((ROOT / "crates/fret-cli/templates").glob("*.toml"))
BASE = (ROOT / "crates/fret-cli/templates/wear.toml").read_text(encoding="utf-8")
#: A place in a scene of each table of the schema; a quoted key is none that a reader knows.
PLACES = {
    "": "",
    "body1": "body1.",
    "body2": "body2.",
    "friction": "friction.",
    "friction/history": "friction.history.",
    "friction/bed": "friction.bed.",
    "friction/map": "friction.map.",
    "grid": "grid.",
    "kernel": "kernel.",
    "kernel/method/inverse_fft": "kernel.method.inverse_fft.",
    "kernel/method/frequency_domain": "kernel.method.frequency_domain.",
    "solver": "solver.",
    "skip": "skip.",
    "output": "output.",
    "rig": "rig.",
    "cycle": "cycle.",
    "history": "history.",
    "history/spectrum": "history.spectrum.",
    "history/matrix": "history.matrix.",
    "wear": "wear.",
    "wear/air": "wear.air.",
    "wear/bed": "wear.bed.",
    "wear/body1": "wear.body1.",
    "wear/body2": "wear.body2.",
    "wear/body1/factor": "wear.body1.factor.",
    "wear/body2/factor": "wear.body2.factor.",
    "#wear_law/factor": "wear.body1.laws.0.factor.",
    "#coating": "body2.coatings.0.",
    "#plastic": "body2.plastic.",
    "#branch": "path.0.",
    "#wear_law": "wear.body1.laws.0.",
    **{
        f"#shape/{name}": f"body2.shape.{name}."
        for name in SCHEMA["definitions"]["shape"]["anyOf"][1]["properties"]
        if name != "sum"
    },
}


def properties(place: str) -> dict[str, Any]:
    """Return the properties of the table at a place of the schema."""
    node = SCHEMA
    for step in filter(None, place.split("/")):
        if step.startswith("#"):
            node = SCHEMA["definitions"][step[1:]]
            continue
        tables = [node, *node.get("anyOf", [])]
        node = next(t["properties"][step] for t in tables if step in t.get("properties", {}))
    tables = [node, *node.get("anyOf", [])]
    return next(t["properties"] for t in tables if "properties" in t)


def tables(node: Any) -> int:
    """Count the tables of a schema that list their keys."""
    if isinstance(node, list):
        return sum(tables(item) for item in node)
    if not isinstance(node, dict):
        return 0
    return ("properties" in node) + sum(tables(item) for item in node.values())


@pytest.fixture
def scene_file(tmp_path: Path) -> Path:
    path = tmp_path / "scene.toml"
    path.write_text(BASE.replace("[[path]]", "[[path]]\nt = 1", 1), encoding="utf-8")
    return path


@pytest.mark.parametrize("place", PLACES)
def test_keys_are_those_of_the_reader(
    place: str, scene_file: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    text = re.sub(r"\n\[wear\.body\d\].*?(?=\n\[|\Z)", "", BASE, flags=re.DOTALL)
    laws = "[[wear.body1.laws]]\nk = 1e-14" if "wear_law" in place else "[wear.body1]\nk = 1e-14"
    scene_file.write_text(f"{text}\n{laws}\n[wear.body2]\nk = 1e-14\n", encoding="utf-8")
    unknown = PLACES[place] + "zzzz=1"
    assert run_command(["fret", "check", str(scene_file), "--set", unknown]) == 2
    printed = capfd.readouterr().err
    keys = re.search(r"unknown key `[^`]*zzzz`: .*?\(of ([^)]*)\)", printed)
    assert keys, printed
    assert set(keys[1].split(", ")) == set(properties(place))


#: Where tables of the schema that stand for several places are in a scene.
DEFINED = {"wear_law": "wear.body1.laws", "coating": "body1.coatings", "branch": "path"}


def quantities_of(node: Any, place: str = "") -> Iterator[tuple[str, str]]:
    """Return the key and the unit of every quantity of a schema."""
    if isinstance(node, list):
        for item in node:
            yield from quantities_of(item, place)
    if not isinstance(node, dict):
        return
    if "x-unit" in node:
        yield place, node["x-unit"]
    for key, value in node.items():
        if key in ("properties", "definitions"):
            for name, item in value.items():
                step = DEFINED.get(name, name) if key == "definitions" else name
                yield from quantities_of(item, f"{place}.{step}" if place else step)
        else:
            yield from quantities_of(value, place)


def test_every_quantity_is_read_with_its_unit() -> None:
    quantities = list(quantities_of(SCHEMA))
    assert len(quantities) > 60
    for key, unit in quantities:
        measured = _core.measured_by(key)
        assert measured is not None, f"{key}: a text with a unit is refused"
        assert measured[1] == unit.split(",")[0], key


def test_every_table_of_the_schema_has_a_place() -> None:
    # Beyond PLACES: the shapes themselves, a measured path, increments per range, the wrappers of
    # two kernel methods, and a number in one of four measures.
    assert tables(SCHEMA) == len(PLACES) + 1 + 2 + 2 + 4


@pytest.mark.parametrize("file", [*SCENES, *TEMPLATES], ids=lambda file: file.stem)
def test_scenes_follow_the_schema(file: Path) -> None:
    with file.open("rb") as stream:
        jsonschema.Draft7Validator(SCHEMA).validate(tomllib.load(stream))


@pytest.mark.parametrize(
    "change",
    ['friction.mu = "slip"', "grid.cells = 3", 'solver.preset = "slow"', "skip.mirror = 1"],
)
def test_mistakes_do_not_follow_the_schema(change: str) -> None:
    scene = tomllib.loads(BASE)
    (section, values), *_ = tomllib.loads(change).items()
    scene.setdefault(section, {}).update(values)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.Draft7Validator(SCHEMA).validate(scene)


def test_defaults_are_those_of_the_program(scene_file: Path) -> None:
    written = tomllib.loads(fret.Scene.from_file(scene_file).to_toml())
    for section in ("kernel", "solver", "skip", "output"):
        described = {
            key: node["default"] for key, node in properties(section).items() if "default" in node
        }
        assert described == written[section]


def quantities(node: Any) -> Iterator[tuple[str, str]]:
    """Yield the key and unit of each quantity of a schema."""
    if isinstance(node, list):
        for item in node:
            yield from quantities(item)
    elif isinstance(node, dict):
        for key, value in node.get("properties", {}).items():
            if "x-unit" in value:
                yield key, value["x-unit"]
        for value in node.values():
            yield from quantities(value)


@pytest.mark.parametrize(("key", "unit"), sorted(set(quantities(SCHEMA))))
def test_units_are_known(key: str, unit: str) -> None:
    assert unit_of(unit.partition(",")[0]), key


def test_schema_is_written(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "scene.schema.json"
    assert run_command(["fret", "schema", "-o", str(out)]) == 0
    assert json.loads(out.read_text(encoding="utf-8")) == SCHEMA
    assert run_command(["fret", "schema"]) == 0
    assert json.loads(capfd.readouterr().out) == SCHEMA


@pytest.mark.solves
def test_editors_find_the_schema_of_a_new_scene(tmp_path: Path) -> None:
    taplo = Path(sys.executable).with_name("taplo")
    scene = tmp_path / "scene.toml"
    assert run_command(["fret", "new", "coated_ball", "-o", str(scene)]) == 0
    assert run_command(["fret", "schema", "-o", str(tmp_path / "scene.schema.json")]) == 0

    def check() -> subprocess.CompletedProcess[str]:
        command = [str(taplo), "check", "--no-auto-config", str(scene)]
        return subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, check=False)

    good = check()
    assert good.returncode == 0, good.stderr
    scene.write_text(scene.read_text().replace("mu = 0.15", "nu = 0.15"), encoding="utf-8")
    bad = check()
    assert bad.returncode != 0
    assert "nu" in bad.stderr
