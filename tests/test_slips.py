"""Slips of the user are caught where they are made, and said in the user's words."""

from __future__ import annotations

import builtins
import io
import math
import sys
import warnings
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

import pyfret as fret
from conftest import R, W, pair, sphere_on_flat
from pyfret._util.progress import Progress

pytestmark = pytest.mark.solves

STEEL, _ = pair(0.3)
BALL = fret.Body(STEEL, shape=fret.Sphere(R))
FLAT = fret.Body(STEEL)
GRID = fret.Grid.centred(width=1e-3, n=8)
PRESSED = fret.LoadPath.start().normal(W, increments=1)


@pytest.mark.parametrize(
    ("make", "expected"),
    [
        (lambda: fret.Elastic(E=210e9, nu=0.6), r"nu = 0.6: must be -1 < nu <= 0.5"),
        (
            lambda: fret.Coating(STEEL, thickness=-3e-6),
            r"thickness = -0.000003: must be a positive",
        ),
        (lambda: fret.Coating(fret.RIGID, thickness=1e-6), r"E = inf"),
        (lambda: fret.Friction(-0.6), r"friction.mu = -0.6"),
        (
            lambda: fret.Scene(body1=BALL, body2=FLAT, friction=-0.6, grid=GRID),
            r"friction.mu = -0.6",
        ),
        (lambda: fret.Sphere(0.0), r"sphere.R = 0: must be a finite radius"),
        (lambda: fret.shapes.Rough(rms=1e-7, hurst=2.0, longest=1e-4, shortest=1e-5), r"hurst = 2"),
        (lambda: fret.SurfaceMap([[0.0, math.inf]], spacing=1e-6), r"inf: must be a finite number"),
    ],
)
def test_a_constructor_refuses_at_once(make: Callable[[], object], expected: str) -> None:
    with pytest.raises(fret.errors.InvalidSceneError, match=expected):
        make()


@pytest.mark.parametrize(
    ("make", "expected"),
    [
        (
            lambda: fret.Body(210e9),
            r"^substrate = 210000000000.0: must be a material, such as Elastic",
        ),
        (
            lambda: fret.Body(STEEL, shape="flat"),
            r"^shape = 'flat': must be a shape, such as Sphere",
        ),
        (lambda: fret.Body(STEEL, coatings=3e-6), r"^coatings = 3e-06: must be a list of coatings"),
        (
            lambda: fret.Body(STEEL, coatings=[STEEL]),
            r"^coatings: Elastic.*must be a coating, such as",
        ),
        (
            lambda: fret.Coating(210e9, thickness=1e-6),
            r"^material = 210000000000.0: .*such as Elastic\(E=210e9",
        ),
        (
            lambda: fret.Scene(body1=STEEL, body2=FLAT, friction=0.3, grid=GRID),
            r"^body1: Elastic.*such as Body",
        ),
        (
            lambda: fret.Scene(body1=BALL, body2=FLAT, friction="a", grid=GRID),
            r"^friction = 'a': must be a coeffic",
        ),
        (
            lambda: fret.Scene(body1=BALL, body2=FLAT, friction=0.3, grid=128),
            r"^grid = 128: must be a grid",
        ),
        (
            lambda: fret.reference.hertz(R=R, bodies=(R, STEEL), W=W),
            r"^bodies = 0.018: must be a material",
        ),
        (lambda: PRESSED.tangential("a"), r"^T_x = 'a': must be a number, or several"),
        (
            lambda: fret.SurfaceMap([[0.0]], spacing="a"),
            r"^spacing = 'a': must be a length in m",
        ),
    ],
)
def test_an_argument_of_another_type_is_named_with_an_example(
    make: Callable[[], object], expected: str
) -> None:
    with pytest.raises(TypeError, match=expected):
        make()


def test_what_is_plain_is_taken() -> None:
    assert fret.Sphere(R) == fret.Sphere(R=R)
    heights = np.zeros((3, 4), dtype=np.float32)
    assert fret.SurfaceMap(heights, spacing=2e-6).spacing == (2e-6, 2e-6)
    assert fret.Grid.from_spacing(8, 1e-6) == fret.Grid.from_spacing((8, 8), (1e-6, 1e-6))
    item = fret.Coating(STEEL, thickness=1e-6)
    assert fret.Body(STEEL, coatings=item) == fret.Body(STEEL, coatings=[item])
    by_body = fret.reference.hertz(R=R, bodies=(BALL, FLAT), W=W)
    assert by_body.a == fret.reference.hertz(R=R, bodies=(STEEL, STEEL), W=W).a


def flat_of(coatings: list[fret.Coating], shape: object = None) -> fret.Scene:
    scene = sphere_on_flat()
    body = fret.Body(STEEL, coatings=coatings, shape=shape or fret.shapes.Flat())  # type: ignore[arg-type]
    return fret.Scene(body1=scene.body1, body2=body, friction=0.3, grid=scene.grid, path=PRESSED)


def test_moduli_in_another_unit_are_refused_with_what_was_understood() -> None:
    soft = fret.Elastic(E=114.0, nu=0.3)
    scene = sphere_on_flat()
    scene = fret.Scene(
        body1=fret.Body(soft, shape=fret.Sphere(R)),
        body2=fret.Body(soft),
        friction=0.3,
        grid=scene.grid,
    )
    with pytest.raises(fret.errors.InvalidSceneError, match=r"E\* = 6.*114 GPa is 114e9"):
        scene.replace(path=PRESSED).check()


def test_heights_in_another_unit_are_refused() -> None:
    heights = np.random.default_rng(1).normal(size=(32, 32))
    scene = sphere_on_flat()
    spacing = scene.grid.dx
    with pytest.raises(
        fret.errors.InvalidSceneError, match=r"heights over a range of .* m: must be below"
    ):
        flat_of([], fret.SurfaceMap(heights, spacing=spacing)).check()
    steep = fret.SurfaceMap(heights * spacing, spacing=spacing)
    assert "slopes of" in " ".join(flat_of([], steep).doubts())


@pytest.mark.parametrize(
    ("scene", "expected"),
    [
        (flat_of([fret.Coating(STEEL, thickness=3.0)]), r"thickness = 3.000e0 m is \d+ times"),
        (
            sphere_on_flat().replace(path=PRESSED.displace(delta_x=0.03, increments=1)),
            r"path\[1\].delta_x = 3.000e-2 m is beyond the grid",
        ),
        (
            sphere_on_flat().replace(path=PRESSED.force(sigma_B=5e10, increments=1)),
            r"path\[1\].sigma_B = 5.000e10 Pa strains the body by 0.24, which is not small",
        ),
    ],
)
def test_what_is_hardly_meant_is_warned_of(scene: fret.Scene, expected: str) -> None:
    with pytest.warns(fret.errors.SceneWarning, match=expected):
        scene.check()
    with pytest.warns(fret.errors.SceneWarning, match=expected):
        next(iter(fret.march(scene)))


def test_a_scene_is_checked_along_a_path_that_comes_later() -> None:
    scene = sphere_on_flat()
    with pytest.raises(fret.errors.InvalidSceneError, match="path = empty"):
        scene.check()
    scene.check(PRESSED)
    far = PRESSED.displace(delta_x=0.03, increments=1)
    assert "is beyond the grid" in " ".join(scene.doubts(far))
    with pytest.warns(fret.errors.SceneWarning, match="is beyond the grid"):
        scene.check(path=far)


def few_cells(cells: float) -> fret.Scene:
    """Make a scene with `n` cells across the Hertz radius."""
    scene = sphere_on_flat()
    a = fret.reference.hertz(R=R, bodies=(STEEL, STEEL), W=W).a
    return scene.replace(grid=fret.Grid.centred(width=32 * a / cells, n=32))


def test_a_contact_of_a_cell_is_refused_with_the_cells_that_it_takes() -> None:
    for cells, n in ((0.3, 214), (0.9, 72)):
        expected = rf"grid.n = .* must be \[{n}, {n}\] or more, .* cells across its radius"
        with pytest.raises(fret.errors.InvalidSceneError, match=expected):
            few_cells(cells).check(PRESSED)
        with pytest.raises(fret.errors.InvalidSceneError, match=expected):
            fret.solve(few_cells(cells), PRESSED, progress=False)


def test_a_contact_of_few_cells_is_doubted_before_and_after() -> None:
    with pytest.warns(fret.errors.SceneWarning, match="cells across its radius") as text:
        result = fret.solve(few_cells(4.0), PRESSED, progress=False)
    assert len(text) == 2
    assert "cells across its radius" in result.doubts[0]
    assert "warning: the contact has" in result.summary()
    assert 3.0 < float(result.dataset.cells_per_radius[-1]) < 5.0


def test_a_scene_as_it_should_be_is_not_doubted() -> None:
    for ratio in (0.5, 1.0, 4.0):
        assert sphere_on_flat(ratio=ratio).replace(path=PRESSED).doubts() == []


def test_a_contact_that_cannot_fit_is_refused_before_it_is_solved() -> None:
    scene = sphere_on_flat()
    tight = fret.Grid.centred(width=0.5 * scene.grid.nx * scene.grid.dx, n=16)
    scene = fret.Scene(body1=scene.body1, body2=scene.body2, friction=0.3, grid=tight, path=PRESSED)
    with pytest.raises(fret.errors.OffGridError, match="does not fit on the grid"):
        scene.check()


def test_paths_say_what_they_are() -> None:
    path = fret.LoadPath.start().normal(10.0)
    assert repr(path.cycles(2, delta_x=2e-6)) == "LoadPath(6 branches, increments to be chosen)"
    with pytest.raises(ValueError, match="increments of 1 of 1 branches are chosen"):
        len(path)
    assert bool(path)
    mixed = PRESSED.tangential([1.0, -1.0])
    assert "1 increments, more to be chosen in 2 branches" in repr(mixed)
    shifts = [2e-6, -2e-6, 2e-6]
    displaced = PRESSED.displace(delta_x=shifts, increments=50)
    assert [b.delta_x for b in displaced.branches[1:]] == shifts
    assert [b.increments for b in displaced.branches] == [1, 10, 20, 20]
    assert displaced == PRESSED.cycles(1, delta_x=2e-6, increments=50)
    assert PRESSED.tangential([9.0, -9.0, 9.0], increments=5) == PRESSED.cycles(
        1, T_x=9.0, increments=5
    )
    held = displaced.hold(increments=3).branches[-1]
    assert (held.W, held.delta_x, held.increments) == (W, 2e-6, 3)
    with pytest.raises(ValueError, match="one load or motion"):
        path.cycles(1)
    with pytest.raises(ValueError, match="one motion at a time"):
        path.displace(delta_x=[1e-6, 2e-6], delta_y=[1e-6, 2e-6])


def test_a_scene_file_is_solved_by_its_name(tmp_path: Path) -> None:
    file = tmp_path / "scene.toml"
    scene = sphere_on_flat(n=24).replace(path=PRESSED)
    file.write_text(scene.to_toml(), encoding="utf-8")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert fret.solve(file, progress=False).scene.body2 == scene.body2
        assert next(iter(fret.march(file))).W == W


def test_the_bar_of_a_run_never_runs_over() -> None:
    bar = Progress(title="run", shown=False)
    bar.update(78, 90)
    assert "78/90" in bar.line(10.0)
    assert "2 s left" in bar.line(10.0)
    # An increment more than there should be.
    bar.update(91, 90)
    assert len(bar.line(1.0)) < 60
    assert "91/91 1 s, 0 s left" in bar.line(1.0)


class Terminal(io.StringIO):
    """A stream on which people watch."""

    def isatty(self) -> bool:
        return True


def test_a_bar_takes_itself_off_the_screen(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    monkeypatch.setenv("TERM", "xterm")
    with Progress(title="run", shown=True) as bar:
        bar.update(2, 2)
        assert "2/2" in terminal.getvalue()
    *_, last = terminal.getvalue().rstrip("\r").rsplit("\r", 1)
    assert last.strip() == ""
    assert len(last) >= len(bar.line(0.0)) - 3
    assert terminal.getvalue().endswith("\r")
    assert "\n" not in terminal.getvalue()


def test_a_notebook_has_the_bar_in_an_output_of_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    shown: list[str] = []

    class Handle:
        def update(self, data: dict[str, str], *, raw: bool) -> None:
            assert raw
            shown.append(data["text/plain"])

    def display(data: dict[str, str], *, raw: bool, display_id: bool) -> Handle:
        assert raw
        assert display_id
        shown.append(data["text/plain"])
        return Handle()

    notebook = ModuleType("IPython.display")
    notebook.display = display  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "IPython", ModuleType("IPython"))
    monkeypatch.setitem(sys.modules, "IPython.display", notebook)
    monkeypatch.setattr(builtins, "__IPYTHON__", True, raising=False)
    red = io.StringIO()
    monkeypatch.setattr(sys, "stderr", red)
    with Progress(title="run", shown=True) as bar:
        bar.update(1, 2)
        bar.update(2, 2)
    assert "2/2" in shown[-2]
    assert shown[-1] == ""
    # Nothing in the box of errors.
    assert red.getvalue() == ""


def test_a_run_with_chosen_increments_knows_how_many_there_are(tmp_path: Path) -> None:
    progress: list[tuple[int, int]] = []
    scene = sphere_on_flat(n=16).replace(path=fret.LoadPath.start().normal(W))
    fret._core.solve(
        scene, store=tmp_path / "run.zarr", on_increment=lambda *at: progress.append(at)
    )
    count = fret.open(tmp_path / "run.zarr").dataset.sizes["increment"]
    assert progress == [(n, count) for n in range(1, count + 1)]


TEMPLATES = Path(__file__).parents[1] / "crates" / "fret-cli" / "templates"


@pytest.mark.parametrize("of", ["sphere", "cylinder"])
@pytest.mark.parametrize(
    ("slip", "expected"),
    [
        ("body1.E=210", "a contact with a/R = 1"),
        ("body1.shape.{of}.R=50", "R = 50 m is large"),
        ("path.0.W=3e8", "W = 3"),
        ("grid.extent=1e-5", "The grid is 1.0000e-5 m"),
    ],
)
def test_slips_of_units_are_told_of_a_line_as_of_a_ball(of: str, slip: str, expected: str) -> None:
    name = {"sphere": "uncoated_ball", "cylinder": "cylinder"}[of]
    text = (TEMPLATES / f"{name}.toml").read_text()
    with warnings.catch_warnings(record=True) as doubts:
        warnings.simplefilter("always")
        try:
            fret.Scene.from_toml(text, set=[slip.format(of=of)]).check()
            message = ""
        except fret.errors.InvalidSceneError as refused:
            message = str(refused)
    message += " ".join(str(doubt.message) for doubt in doubts)
    assert expected in message
    assert "approach" not in message
