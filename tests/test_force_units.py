"""A force or a force per length keeps its dimension until the scene knows which it needs."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any

import pytest

import pyfret as fret

# 100 N/m on a cylinder of 10 mm are less than what clean surfaces would stick with.
pytestmark = pytest.mark.filterwarnings("ignore:the pull-off force")

STEEL = fret.Elastic(E=210e9, nu=0.3)
FORCES = ("W", "T_x", "T_y")
PRESSED = fret.LoadPath.start().normal(100.0)
#: A path by every method that takes a force, with one force as a text.
PATHS: dict[tuple[str, str], Callable[[str], fret.LoadPath]] = {
    ("normal", "W"): lambda text: fret.LoadPath.start().normal(text),
    ("radial", "W"): lambda text: PRESSED.radial([text, 50.0]),
    ("tangential", "T_x"): lambda text: PRESSED.tangential([1.0, text]),
    ("force", "W"): lambda text: PRESSED.force(W=text),
    ("force", "T_x"): lambda text: PRESSED.force(T_x=text),
    ("force", "T_y"): lambda text: PRESSED.force(T_y=text),
    ("ellipse", "T_x"): lambda text: PRESSED.ellipse(T_x=text, T_y=1.0),
    ("ellipse", "T_y"): lambda text: PRESSED.ellipse(T_x=1.0, T_y=text),
    ("cycles", "T_x"): lambda text: PRESSED.cycles(1, T_x=text),
    ("cycles", "T_y"): lambda text: PRESSED.cycles(1, T_y=text),
    ("sine", "W"): lambda text: PRESSED.sine(1, W=text),
    ("sine", "T_x"): lambda text: PRESSED.sine(1, T_x=text),
    ("sine", "T_y"): lambda text: PRESSED.sine(1, T_y=text),
    ("Branch", "W"): lambda text: fret.LoadPath([fret.Branch(W=text, t=1.0)]),
    ("Branch", "T_x"): lambda text: fret.LoadPath([fret.Branch(W=100.0, T_x=text, t=1.0)]),
    ("Branch", "T_y"): lambda text: fret.LoadPath([fret.Branch(W=100.0, T_y=text, t=1.0)]),
}


def scene(*, line: bool) -> fret.Scene:
    shape: Any = fret.Cylinder(R=0.01) if line else fret.Sphere(R=0.01)
    grid = fret.Grid.strip(extent=1e-5, n=64) if line else fret.Grid.centred(width=6e-4, n=24)
    return fret.Scene(
        body1=fret.Body(STEEL, shape=shape), body2=fret.Body(STEEL), friction=0.5, grid=grid
    )


def test_every_method_that_takes_a_force_is_tried() -> None:
    methods = {
        (name, parameter)
        for name, method in inspect.getmembers(fret.LoadPath, callable)
        if not name.startswith("_")
        for parameter in inspect.signature(method).parameters
        if parameter in FORCES
    }
    branch = {("Branch", name) for name in inspect.signature(fret.Branch).parameters}
    assert methods | {call for call in branch if call[1] in FORCES} == set(PATHS)


@pytest.mark.parametrize("call", PATHS, ids="-".join)
@pytest.mark.parametrize("line", [False, True])
def test_a_force_of_the_other_dimension_is_refused(call: tuple[str, str], *, line: bool) -> None:
    right, wrong = ("2 N/m", "2 N") if line else ("2 N", "0.002 N/mm")
    path = PATHS[call](right)
    assert path == PATHS[call](right)
    if path.branches[0].W and path.branches[0].W > 0.0:
        scene(line=line).replace(path=path).check()
    with pytest.raises(ValueError, match=r"the contact is (a|no) line") as refused:
        scene(line=line).replace(path=PATHS[call](wrong)).check()
    assert wrong in str(refused.value)


def test_titles_of_a_measured_history_have_a_dimension(tmp_path: Any) -> None:
    file = tmp_path / "loads.csv"
    file.write_text("t [s], W [N/mm], T_x [N/mm]\n1,0.1,0\n2,0.1,0.02\n")
    path = fret.LoadPath.from_csv(file)
    assert pytest.approx(100.0) == path.branches[0].W
    scene(line=True).replace(path=path).check()
    with pytest.raises(ValueError, match=r"W \[N/mm\].*the contact is no line"):
        scene(line=False).replace(path=path).check()
