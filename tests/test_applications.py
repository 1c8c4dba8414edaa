"""Applications are in a distribution of their own, and are imported by the same names."""

from __future__ import annotations

import ast
import importlib.abc
import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

import pyfret as fret
from pyfret._util.extras import application

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

ROOT = Path(__file__).parent.parent
#: Modules of the distribution ``fretting-apps``.
APPLICATIONS = (
    "pyfret.workbench",
    "pyfret.report",
    "pyfret.experiments",
    "pyfret.verification",
    "pyfret.plot.paper",
    "pyfret.fit.posterior",
)


def is_application(name: str) -> bool:
    """Check that a module is one of the applications, or within one."""
    return any(f"{name}.".startswith(f"{module}.") for module in APPLICATIONS)


class Absent(importlib.abc.MetaPathFinder):
    """Applications are not installed."""

    def find_spec(self, name: str, *_: Any) -> None:
        """Raise the error of Python for a missing module."""
        if is_application(name):
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)


@pytest.fixture
def absent(monkeypatch: pytest.MonkeyPatch) -> None:
    """Take the applications away."""
    for name in [*sys.modules]:
        if is_application(name):
            monkeypatch.delitem(sys.modules, name)
    for name in ("experiments", "explore", "verify"):
        monkeypatch.delitem(vars(fret), name, raising=False)
    monkeypatch.setattr(sys, "meta_path", [Absent(), *sys.meta_path])


@pytest.mark.usefixtures("absent")
@pytest.mark.parametrize(
    "use",
    [
        lambda: fret.experiments,
        lambda: fret.explore,
        lambda: fret.verify,
        lambda: fret.plot.paper_figures,
        lambda: application("pyfret.report.page"),
        lambda: application("pyfret.fit.posterior"),
    ],
)
def test_an_absent_application_names_its_distribution(use: Callable[[], Any]) -> None:
    with pytest.raises(ModuleNotFoundError, match="is an application: pip install fretting-apps"):
        use()


def imports_at_load(body: list[ast.stmt]) -> Iterator[str]:
    """Yield the modules that statements import when the file is loaded, as `a.b` or `a.b.name`."""
    for node in body:
        if isinstance(node, ast.ImportFrom):
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.If) and ast.unparse(node.test) != "TYPE_CHECKING":
            yield from imports_at_load([*node.body, *node.orelse])


def test_no_other_module_loads_an_application() -> None:
    wrong, count = [], 0
    for path in sorted((ROOT / "python/pyfret").rglob("*.py")):
        name = ".".join(path.relative_to(ROOT / "python").with_suffix("").parts)
        if is_application(name):
            continue
        count += 1
        modules = imports_at_load(ast.parse(path.read_text(encoding="utf-8")).body)
        wrong += [f"{name} imports {module}" for module in modules if is_application(module)]
    assert count > 150
    assert wrong == []


def test_both_distributions_have_the_same_list_of_applications() -> None:
    main = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    apps = (ROOT / "apps/pyproject.toml").read_text(encoding="utf-8")
    left_out = re.findall(r'path = "python/(pyfret/[^"]*?)(?:/\*\*/\*)?"', main)
    packed = re.findall(r'"\.\./python/([^"]+)" = "([^"]+)"', apps)
    assert packed == [(path, path) for path in left_out]
    modules = {path.removesuffix(".py").replace("/", ".") for path in left_out}
    assert modules == set(APPLICATIONS)
    assert all((ROOT / "python" / path).exists() for path in left_out)


def test_the_applications_take_this_version() -> None:
    version = re.search(
        r'^version = "(\d+)\.(\d+)', (ROOT / "Cargo.toml").read_text(encoding="utf-8"), re.MULTILINE
    )
    assert version is not None
    major, minor = int(version[1]), int(version[2])
    apps = (ROOT / "apps/pyproject.toml").read_text(encoding="utf-8")
    assert f'"fretting>={major}.{minor}.0,<{major}.{minor + 1}"' in apps
