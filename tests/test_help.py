"""Everything public has a docstring, in Python and in the stub."""

from __future__ import annotations

import ast
import inspect
import pkgutil
from collections.abc import Iterator
from importlib import import_module
from types import ModuleType
from typing import Any

import pyfret as fret
from conftest import ROOT
from pyfret import _core, plot
from pyfret.run import State

STUB = ast.parse((ROOT / "python" / "pyfret" / "_core.pyi").read_text(encoding="utf-8"))


def members(owner: Any) -> Iterator[tuple[str, Any]]:
    """Public members of a class that are its own."""
    for name, member in vars(owner).items():
        if not name.startswith("_") and not isinstance(member, owner):
            yield name, member


def public(module: ModuleType) -> Iterator[tuple[str, Any]]:
    for name in getattr(module, "__all__", dir(module)):
        thing = getattr(module, name)
        if not name.startswith("_") and (inspect.isclass(thing) or inspect.isroutine(thing)):
            yield f"{module.__name__}.{name}", thing


def test_every_public_name_has_its_docstring() -> None:
    modules = (
        fret,
        _core,
        plot,
        fret.kernels,
        fret.reference,
        fret.subsurface,
        fret.study,
        fret.fatigue,
        fret.wear,
        fret.heat,
        fret.fracture,
        fret.errors,
        fret.settings,
        fret.shapes,
    )
    empty = []
    for module in modules:
        for name, thing in public(module):
            if not (thing.__doc__ or "").strip():
                empty.append(name)
            for member, item in members(thing) if inspect.isclass(thing) else ():
                if (
                    isinstance(item, type(_core.Sphere.R))
                    or callable(item)
                    or isinstance(item, property)
                ):
                    doc = getattr(item, "__doc__", None)
                    if not (doc or "").strip():
                        empty.append(f"{name}.{member}")
    assert not empty


def test_a_name_of_a_class_has_one_meaning() -> None:
    # A class may be a kind of its namesake, as the measure of wear is settings of wear.
    owners: dict[str, list[type]] = {}
    for module in pkgutil.walk_packages(fret.__path__, "pyfret."):
        if "._" in module.name:
            continue
        for name in getattr(import_module(module.name), "__all__", ()):
            thing = getattr(import_module(module.name), name)
            if inspect.isclass(thing) and thing not in owners.setdefault(name, []):
                owners[name].append(thing)
    assert len(owners) > 100
    several = {n: entry for n, entry in owners.items() if len(entry) > 1}
    assert all(
        any(issubclass(a, b) for a in item for b in item if a is not b) for item in several.values()
    ), several


def test_the_stub_has_the_members_of_the_module() -> None:
    classes = {node.name: node for node in STUB.body if isinstance(node, ast.ClassDef)}
    for name, thing in public(_core):
        if not inspect.isclass(thing):
            continue
        mine = {n for n, _ in members(thing)}
        theirs = {
            node.name if isinstance(node, ast.FunctionDef) else node.target.id  # type: ignore[union-attr]
            for node in classes[name.removeprefix("pyfret._core.")].body
            if isinstance(node, (ast.FunctionDef, ast.AnnAssign))
        }
        assert mine <= theirs, f"{name}: {mine - theirs}"


def test_a_snapshot_declares_every_variable_of_the_store() -> None:
    declared = set(State.__annotations__)
    assert declared == {*_core.labels(), "x", "y", "half_width"}
