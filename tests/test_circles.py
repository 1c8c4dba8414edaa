"""The tool that looks for circles sees imports that are made late."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from types import ModuleType


@pytest.fixture(scope="module")
def tool() -> ModuleType:
    """Give the tool as a module."""
    path = Path(__file__).parent.parent / "tools/acyclic.py"
    spec = importlib.util.spec_from_file_location("acyclic", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def package(folder: Path, **files: str) -> Path:
    """Write a package `pyfret` of these files."""
    for name, text in {"__init__": "", **files}.items():
        path = folder / "pyfret" / f"{name.replace('__of__', '/__init__').replace('.', '/')}.py"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return folder / "pyfret"


LATE = "from importlib import import_module\n\ndef f():\n    return import_module({})\n"


def test_a_late_import_upwards_is_a_circle(tool: ModuleType, tmp_path: Path) -> None:
    root = package(
        tmp_path, low=LATE.format('"pyfret.high"'), high="from pyfret import low\n\nlow.f()\n"
    )
    assert tool.circles(tool.package(root)) == [
        [root / "high.py", root / "low.py", root / "high.py"]
    ]
    assert tool.unseen(root) == []


@pytest.mark.parametrize(
    ("argument", "words"),
    [('f"pyfret.{1}"', "put together"), ('"pyfret." + "high"', "put together"), ('".high"', "put")],
)
def test_a_name_that_is_put_together_is_refused(
    tool: ModuleType, tmp_path: Path, argument: str, words: str
) -> None:
    (text,) = tool.unseen(package(tmp_path, low=LATE.format(argument)))
    assert words in text


def test_a_package_hands_on_late_what_it_holds_alone(tool: ModuleType, tmp_path: Path) -> None:
    late = {"__init__": LATE.format('"pyfret.plot"'), "low__of__": LATE.format('"pyfret.high"')}
    (text,) = tool.unseen(package(tmp_path, **late))
    assert "low/__init__.py" in text
    assert "not within" in text
