"""Types that users' tools read: a quantity is a number or a text, wherever its unit is known."""

from __future__ import annotations

import ast
import importlib
import inspect
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import pyfret as fret
import pyfret.plot
from conftest import ROOT
from pyfret import _core, quantities
from test_documents import DOCUMENTS, text

#: Annotations that take a text with a unit.
TAKES = {*quantities.__all__, "YieldStresses", "ArrayLike"} - {"FrictionCoefficient"}
#: A program of a user, with units wherever they are taken.
PROGRAM = """
import numpy as np
import pyfret as fret
import pyfret.plot

steel = fret.Elastic(E="210 GPa", nu=0.3, plastic=fret.Plastic(s_y="600 MPa", hardening="2 GPa"))
film = fret.Coating(fret.material("TiN"), thickness="3 um", residual=-1e9)
upper = fret.Body(steel, shape=fret.Sphere(R="5 mm"))
lower = fret.Body(steel, coatings=[film])
path = fret.LoadPath.start().normal("10 N").tangential(["3 N", "-3 N", 3.0])
path = path.force(W="10 N", T_x="1 N", sigma_B="100 MPa").cycles(1, delta_x="2 um")
path = path.displace(delta_x=["1 um", "-1 um"]).rig("20 N/um").tangential(np.array([1.0, -1.0]))
grid = fret.Grid.centred(width=("0.3 mm", 4e-4), n=32)
width: float = fret.reference.line_contact(R="10 mm", bodies=(steel, steel), W=1e5).a
law = fret.wear.Archard(k="1e-5 mm^3/(N m)", threshold=0.0)
twice: float = 2.0 * law.k
wear = fret.wear.Wear(cycles=1e4, body2=law, rig_stiffness="9 N/um", frequency="10 Hz")
threshold = fret.fracture.Threshold(dK_th="2 MPa m^0.5", dS_0="300 MPa")
root: float = threshold.dK_th**2
heat = fret.heat.Conductor(conductivity="40 W/(m K)", heat_capacity="3.6 MJ/(m^3 K)")
scene = fret.Scene(body1=upper, body2=lower, friction=0.3, grid=grid, path=path)


def answers(result: fret.Result) -> float:
    below = result.at(-1).stress(z=["1 um", "2 um"], azimuth="30 deg")
    growth = result.grow_crack(0.0, angle="10 deg")
    life = result.life(fret.fatigue.Materials()["7075"], "smith_watson_topper", azimuth="0 deg")
    peened = result.life("steel_4340", "smith_watson_topper", residual=-600e6)
    in_layers = result.at(-1).stress(residual=["-2 GPa", [[0.0, -6e8], [1e-4, 0.0]]])
    print(peened.margin, in_layers.von_mises, result.crack(0.0, residual="-600 MPa"))
    worn = fret.wear.solve(scene, wear)
    print(below.von_mises, growth.path_error, growth.end, worn.loops().T, life.over_distance().best)
    return worn.cycles_to(depth="1 um")
"""


def annotation_in_stub(name: str, key: str) -> str:
    """The annotation of a parameter of a compiled callable in the stub."""
    tree = ast.parse((ROOT / "python/pyfret/_core.pyi").read_text(encoding="utf-8"))
    owner, _, call = name.rpartition(".")
    body: list[Any] = tree.body
    for part in filter(None, owner.split(".")):
        body = next(of.body for of in body if isinstance(of, ast.ClassDef) and of.name == part)
    for of in body:
        if isinstance(of, ast.FunctionDef) and of.name == call:
            every = [*of.args.posonlyargs, *of.args.args, *of.args.kwonlyargs]
            return next(
                ast.unparse(one.annotation) for one in every if one.arg == key and one.annotation
            )
    raise AssertionError(name)


def public_calls(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Return the module that lists all public callables with good arguments."""
    monkeypatch.syspath_prepend(str(Path(__file__).with_name("hostile")))
    return importlib.import_module("public")


@pytest.mark.solves
@pytest.mark.filterwarnings("ignore")
def test_parameters_whose_quantity_is_known_are_typed_so(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every parameter with a name of the table of quantities has a unit in its type."""
    asked, wrong = 0, []
    for name, call in public_calls(monkeypatch).public():
        function = call.__init__ if inspect.isclass(call) else getattr(call, "__func__", call)
        checked = inspect.unwrap(function)
        if checked is function or not inspect.isfunction(checked):
            continue
        for rule in quantities.Signature(checked).rules.values():
            measured = _core.measured_by(f"{call.__qualname__}.{rule.name}")
            if rule.number in (None, "count", "text", "array") or not measured or not measured[1]:
                continue
            asked += 1
            if rule.unit is None or rule.unit.si != measured[1]:
                wrong.append(f"{name}({rule.name}: {rule.unit})")
    assert asked > 60
    assert wrong == []


@pytest.mark.solves
@pytest.mark.filterwarnings("ignore")
def test_compiled_parameters_that_take_a_unit_are_typed_so(monkeypatch: pytest.MonkeyPatch) -> None:
    """Compare their treatment of a text with the stub; a number refuses a text."""
    public = public_calls(monkeypatch)
    asked, wrong = 0, []
    for name, call in public.public():
        found = public.good(name, call) if name not in public.LEFT_OUT else None
        qualified = (
            call.__qualname__ if not inspect.isclass(call) else f"{call.__qualname__}.__new__"
        )
        if found is None or not is_compiled(call) or qualified.startswith("Criterion."):
            continue
        try:
            public.invoked(call, found[0])
        except Exception:
            continue
        for key, value in found[0].items():
            if type(value) is not float:
                continue
            measured = _core.measured_by(key)
            unit = measured[1] if measured and measured[1] else "um"
            try:
                public.invoked(call, found[0] | {key: f"{value!r} {unit}"})
                taken = True
            except Exception as error:
                if "must be a number in SI units" not in str(error):
                    # Read, and refused for its size.
                    continue
                taken = False
            asked += 1
            names = set(re.findall(r"\w+", annotation_in_stub(qualified, key)))
            if taken != bool(names & TAKES):
                wrong.append(
                    f"{qualified}({key}: {annotation_in_stub(qualified, key)}): taken: {taken}"
                )
    assert asked > 60
    assert wrong == []


def is_compiled(call: Any) -> bool:
    """Whether a callable is one of the compiled module."""
    if inspect.isclass(call):
        return getattr(_core, call.__name__, None) is call
    owner = getattr(_core, call.__qualname__.partition(".")[0], None)
    return owner is not None and getattr(call, "__module__", None) in (None, "pyfret._core")


#: Errors of mypy that a page may have, each with its reason.
OF_PAGES = {
    "no-untyped-def": "functions of pages have no annotations, for the sake of readers",
    "no-untyped-call": "the same, where they are called",
    "no-redef": "a block may begin anew with a name of the block above",
    "assignment": "the same, where the new thing is of another type",
    "operator": "`fret.fit` is a module that is called",
}


@pytest.mark.solves
def test_a_program_and_the_pages_are_typed_strictly(tmp_path: Path) -> None:
    """Check a program with units, and the blocks of each page one after the other."""
    (tmp_path / "program.py").write_text(PROGRAM, encoding="utf-8")
    settings = ["[mypy]", "strict = true"]
    for page in DOCUMENTS:
        blocks = re.findall(r"```python\n(.*?)```", text(page), flags=re.DOTALL)
        if blocks:
            name = re.sub(r"\W", "_", str(page.relative_to(ROOT)))
            (tmp_path / f"{name}.py").write_text("".join(blocks), encoding="utf-8")
            settings += [f"[mypy-{name}]", f"disable_error_code = {', '.join(OF_PAGES)}"]
    configuration = tmp_path / "mypy.ini"
    configuration.write_text("\n".join(settings), encoding="utf-8")
    command = [sys.executable, "-m", "mypy", "--config-file", str(configuration)]
    command += ["--cache-dir", str(ROOT / ".mypy_cache"), *map(str, sorted(tmp_path.glob("*.py")))]
    checked = subprocess.run(
        command,
        capture_output=True,
        text=True,
        check=False,
        env=os.environ | {"MYPYPATH": str(Path(fret.__file__).parents[1])},
    )
    assert checked.returncode == 0, checked.stdout + checked.stderr
