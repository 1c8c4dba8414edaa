"""Everything public says what it is, in Python and in the stub."""

from __future__ import annotations

import ast
import inspect
from collections.abc import Iterator
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
            for member, of in members(thing) if inspect.isclass(thing) else ():
                if isinstance(of, type(_core.Sphere.R)) or callable(of) or isinstance(of, property):
                    doc = getattr(of, "__doc__", None)
                    if not (doc or "").strip():
                        empty.append(f"{name}.{member}")
    assert not empty


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
