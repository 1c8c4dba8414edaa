"""Every name in every document exists: code is run, names, keywords and options are looked up."""

from __future__ import annotations

import dataclasses
import functools
import inspect
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import pytest

import pyfret as fret
from conftest import ROOT, sphere_on_flat
from pyfret import plot
from pyfret.fatigue import Section

DOCS = ROOT / "docs"
DOCUMENTS = [
    *(ROOT / name for name in ("README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "SECURITY.md")),
    *sorted(DOCS.glob("*.md")),
    *(
        page
        for part in ("howto", "theory", "reference")
        for page in sorted((DOCS / part).glob("*.md"))
    ),
]
FRET = ROOT / "target" / "release" / "fret"
#: What a short name may belong to.
OWNERS: list[Any] = [
    fret,
    plot,
    fret.study,
    fret.export,
    fret.fatigue,
    fret.fracture,
    fret.wear,
    fret.study.Study,
    fret.subsurface,
    fret.kernels,
    fret.reference,
    fret.Scene,
    fret.LoadPath,
    fret.Grid,
    fret.Snapshot,
    fret.Result,
    fret.Settings,
    fret.subsurface.Stress,
]


def text(document: Path) -> str:
    return document.read_text(encoding="utf-8")


def ids(document: Path) -> str:
    return str(document.relative_to(ROOT))


def code_spans(document: Path) -> list[str]:
    """Return the texts between backticks, without blocks of code."""
    prose = re.sub(r"```.*?```", "", text(document), flags=re.DOTALL)
    return re.findall(r"`([^`\n]+)`", prose)


def found(dotted: str) -> list[Any]:
    """The things that a dotted name may mean."""
    first, *remainder = dotted.split(".")
    if first in ("fret", "pyfret"):
        return [resolved(fret, remainder)]
    return [resolved(owner, [first, *remainder]) for owner in OWNERS if first in dir(owner)]


def resolved(owner: Any, names: list[str]) -> Any:
    for name in names:
        owner = getattr(owner, name)
    return owner


@pytest.mark.parametrize("document", DOCUMENTS, ids=ids)
def test_its_names_exist(document: Path) -> None:
    for span in code_spans(document):
        for name in re.findall(r"(?<![\w./])(?:py)?fret(?:\.[A-Za-z_]\w*)+", span):
            if not re.search(r"\.(toml|zarr|md|rs|py|html)$", name):
                assert found(name), name


def calls(document: Path) -> Iterator[tuple[str, str]]:
    """Calls with keywords, in prose."""
    for span in code_spans(document):
        for name, arguments in re.findall(r"([A-Za-z_][\w.]*)\(([^()]*)\)", span):
            if "=" in arguments:
                yield name, arguments


@pytest.mark.parametrize("document", DOCUMENTS, ids=ids)
def test_its_keywords_exist(document: Path) -> None:
    for name, arguments in calls(document):
        keywords = set(re.findall(r"(\w+)\s*=(?!=)", re.sub(r'"[^"]*"', '""', arguments)))
        things = [thing for thing in found(name.lstrip(".")) if callable(thing)]
        if not things:
            continue
        parameters = [set(inspect.signature(thing).parameters) for thing in things]
        # What judges a section takes its fields as keywords.
        fields = set(inspect.signature(Section).parameters)
        parameters = [
            parameter_names | fields if "section" in parameter_names else parameter_names
            for parameter_names in parameters
        ]
        # The settings of wear may stand in the call.
        of_wear = {field.name for field in dataclasses.fields(fret.wear.Wear)}
        parameters = [
            parameter_names | of_wear if "settings" in parameter_names else parameter_names
            for parameter_names in parameters
        ]
        assert any(keywords <= parameter_names for parameter_names in parameters), (
            name,
            keywords,
            parameters,
        )


COMMANDS = (
    *("new", "run", "resume", "check", "schema", "stress", "wear", "completions", "man"),
    *(
        "study",
        "compare",
        "explore",
        "workbench",
        "life",
        "crack",
        "damage",
        "export",
        "fit",
        "threshold",
        "report",
        "info",
        "table",
        "verify",
        "cite",
    ),
)


@functools.cache
def help_of(command: str) -> str:
    """Return the help of a command."""
    environment = {**os.environ, "FRET_PYTHON": sys.executable}
    return subprocess.run(
        [FRET, command, "--help"], capture_output=True, text=True, check=True, env=environment
    ).stdout


@pytest.mark.parametrize("document", DOCUMENTS, ids=ids)
def test_its_options_exist(document: Path) -> None:
    lines = re.findall(r"```sh\n(.*?)```", text(document), flags=re.DOTALL)
    spoken = code_spans(document) + [
        line for block in lines for line in block.replace("\\\n", " ").splitlines()
    ]
    for span in spoken:
        command = re.match(r"fret (\w+)", span)
        if command is None:
            continue
        assert command[1] in COMMANDS, span
        for option in re.findall(r"(?<!\S)(--[a-z][a-z-]+)", span):
            assert option in help_of(command[1]), span


@pytest.fixture(scope="module")
def store(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A small run of a coated contact, as the documents have it."""
    folder = tmp_path_factory.mktemp("documents")
    scene = sphere_on_flat(ratio=2.0, n=16)
    path = fret.LoadPath.start().normal(1e3, increments=2).cycles(1, T_x=100.0, increments=4)
    fret.solve(scene, path, out=folder / "out.zarr", progress=False)
    return folder


@pytest.mark.slow
@pytest.mark.parametrize("document", DOCUMENTS, ids=ids)
def test_its_python_runs(document: Path, store: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    blocks = re.findall(r"```python\n(.*?)```", text(document), flags=re.DOTALL)
    monkeypatch.chdir(store)
    names: dict[str, Any] = {"__name__": "__main__"}
    for n, block in enumerate(blocks):
        exec(compile(block, f"{document.name}, block {n + 1}", "exec"), names)
    plt.close("all")


def test_the_scene_of_its_document_is_a_scene() -> None:
    document = ROOT / "docs" / "scene_file.md"
    block, *_ = re.findall(r"```toml\n(.*?)```", text(document), flags=re.DOTALL)
    assert fret.Scene.from_toml(block).title == "Coated fretting"


@pytest.mark.solves
def test_the_example_of_a_real_coating_is_short_and_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    script = (ROOT / "examples" / "dlc_on_titanium.py").read_text(encoding="utf-8")
    assert len(script.splitlines()) <= 25
    monkeypatch.chdir(tmp_path)
    exec(compile(script.replace("n=128", "n=64"), "dlc_on_titanium.py", "exec"), {})
    plt.close("all")
    assert (tmp_path / "dlc_on_titanium.png").is_file()
    text = capsys.readouterr().out
    assert "energy ratio" in text
    assert "partial slip" in text
