"""Loads, friction laws and line contacts from Python."""

from __future__ import annotations

import zipfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import pyfret as fret
from conftest import MU, R, W, sphere_on_flat

pytestmark = pytest.mark.solves

STEEL = fret.Elastic(E=210e9, nu=0.3)
PRESSED = fret.LoadPath.start().normal(W, increments=1)


def test_a_friction_law_survives_the_scene_file() -> None:
    factors = np.linspace(0.5, 1.5, 64 * 64).reshape(64, 64)
    law = fret.Friction(
        0.3,
        mu_y=0.2,
        kinetic=0.25,
        map=fret.SurfaceMap(factors, spacing=(1e-3, 1e-3)),
        history=(fret.History.SLIP, [(0.0, 1.0), (1e-6, 1.4)]),
    )
    scene = sphere_on_flat().replace(friction=law, path=PRESSED)
    again = fret.Scene.from_toml(scene.to_toml())
    assert again == scene
    assert again.friction.history == law.history
    assert scene.replace(friction=0.4).friction == fret.Friction(0.4)


@pytest.mark.parametrize(
    ("law", "message"),
    [
        (
            lambda: fret.Friction(0.3, kinetic=-0.1),
            r"friction\.kinetic = -0\.1: must be a positive",
        ),
        (lambda: fret.Friction(0.3, mu_y=0.0), r"friction\.mu_y = 0"),
        (
            lambda: fret.Friction(0.3, map=fret.SurfaceMap(np.ones((4, 4)), spacing=(1e-6, 1e-6))),
            r"friction\.map = .*: must be at least as large as the grid",
        ),
        (
            lambda: fret.Friction(0.3, history=(fret.History.SLIP, [(1.0, 1.0), (0.5, 1.0)])),
            r"friction\.history\.table = 0\.5: must be a history that grows",
        ),
    ],
)
def test_a_law_without_meaning_is_refused(law: Callable[[], fret.Friction], message: str) -> None:
    with pytest.raises(fret.errors.InvalidSceneError, match=message):
        sphere_on_flat().replace(friction=law(), path=PRESSED).check()


def test_a_measured_history_is_a_path(tmp_path: Path) -> None:
    t = np.linspace(0.5, 3.0, 6)
    force = 0.5 * MU * W * np.sin(t)
    path = fret.LoadPath.start().waypoints(t=t, W=np.full(6, W), T_x=force, increments=2)
    assert len(path) == 12
    np.testing.assert_allclose(path.T_x[1::2], force, rtol=1e-15)
    file = tmp_path / "history.csv"
    table = np.column_stack([t, np.full(6, W), force])
    np.savetxt(file, table, delimiter=",", header="t, W, T_x", comments="", fmt="%.17g")
    assert fret.LoadPath.from_csv(file, increments=2) == path
    fine = fret.LoadPath.from_csv(file, increments=fret.PerRange(40))
    assert fine.branches[0].increments == 40
    with pytest.raises(fret.errors.InvalidSceneError, match="the nearest is T_x"):
        fret.LoadPath.start().waypoints(T_X=[1.0])


def test_elliptical_loading_dissipates_and_comes_back() -> None:
    T = 0.6 * MU * W
    path = PRESSED.ellipse(T_x=T, T_y=0.5 * T, turns=2, increments=16)
    result = fret.solve(sphere_on_flat(n=24), path, progress=False)
    scalars = result.dataset
    assert float(scalars.dissipated.min()) >= -1e-15
    # The second turn repeats: the rotating force has worn a path.
    assert float(scalars.delta_x[-1]) == pytest.approx(float(scalars.delta_x[-17]), rel=0.05)
    assert float(np.abs(scalars.delta_y).max()) > 0


def test_increments_of_any_path_may_be_left_to_be_chosen(tmp_path: Path) -> None:
    path = PRESSED.ellipse(T_x=20.0, T_y=10.0).waypoints(T_x=[0.0, 10.0], increments="auto")
    assert {branch.increments for branch in path.branches[1:]} == {None}
    file = tmp_path / "history.csv"
    file.write_text("W, T_x\n1.0, 0.0\n1.0, 0.1\n")
    history = fret.LoadPath.from_csv(file, increments="auto")
    assert [branch.increments for branch in history.branches] == [None, None]


def test_a_line_contact_is_that_of_hertz() -> None:
    line = fret.reference.line_contact(R=R, bodies=(STEEL, STEEL), W=1e5)
    scene = fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Cylinder(R=R)),
        body2=fret.Body(STEEL),
        friction=MU,
        grid=fret.Grid.strip(extent=2.4 * line.a, n=200),
    )
    path = (
        fret.LoadPath.start()
        .normal(1e5, increments=1)
        .force(T_x=0.5 * MU * 1e5, sigma_B=2e7, increments=4)
    )
    end = fret.solve(scene, path, progress=False).at(-1)
    assert scene.grid.plane_strain
    assert end.scene.hertz is not None
    assert end.scene.hertz.a == pytest.approx(line.a)
    x = end.p.x.to_numpy()
    p = end.p.to_numpy()[:, 0]
    assert np.linalg.norm(p - line.p(x)) < 0.005 * np.linalg.norm(p)
    with pytest.raises(fret.errors.InvalidSceneError, match=r"left out in plane strain"):
        scene.replace(path=PRESSED.torsion(1.0, increments=1)).check()


def test_rolling_needs_whole_cells() -> None:
    scene = sphere_on_flat()
    for cells, increments, good in ((8, 4, True), (6, 4, False)):
        path = PRESSED.force(rolled=cells * scene.grid.dx, increments=increments)
        if good:
            scene.replace(path=path).check()
        else:
            with pytest.raises(fret.errors.InvalidSceneError, match="must be whole cells"):
                scene.replace(path=path).check()


def write_x3p(file: Path, heights: np.ndarray, spacing: float) -> None:
    """A surface as instruments write it, ISO 25178-72: lengths in metres, x running fastest."""
    nx, ny = heights.shape
    axis = "<AxisType>I</AxisType><DataType>D</DataType><Increment>{}</Increment><Offset>0</Offset>"
    along = axis.format(spacing)
    main = (
        '<?xml version="1.0" encoding="UTF-8"?>'
        '<p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2"><Record1>'
        "<Revision>ISO5436 - 2000</Revision><FeatureType>SUR</FeatureType>"
        f"<Axes><CX>{along}</CX><CY>{along}</CY>"
        "<CZ><AxisType>A</AxisType><DataType>D</DataType></CZ></Axes></Record1><Record3>"
        f"<MatrixDimension><SizeX>{nx}</SizeX><SizeY>{ny}</SizeY><SizeZ>1</SizeZ></MatrixDimension>"
        "<DataLink><PointDataLink>bindata/data.bin</PointDataLink></DataLink></Record3>"
        "</p:ISO5436_2>"
    )
    with zipfile.ZipFile(file, "w") as x3p:
        x3p.writestr("main.xml", main)
        x3p.writestr("bindata/data.bin", heights.T.astype("<f8").tobytes())


def write_sdf(file: Path, heights: np.ndarray, spacing: float) -> None:
    """Write the map in the format of ISO 25178-71, as text."""
    nx, ny = heights.shape
    head = {
        "ManufacID": "fret",
        "CreateDate": "010120261200",
        "ModDate": "010120261200",
        "NumPoints": nx,
        "NumProfiles": ny,
        "Xscale": spacing,
        "Yscale": spacing,
        "Zscale": 1.0,
        "Zresolution": -1,
        "Compression": 0,
        "DataType": 7,
        "CheckType": 0,
    }
    lines = ["aISO-1.0", *(f"{name} = {value}" for name, value in head.items()), "*"]
    lines += [" ".join(f"{h:.17g}" for h in row) for row in heights.T]
    file.write_text("\n".join([*lines, "*", ""]))


@pytest.mark.parametrize("write", [write_x3p, write_sdf])
def test_measured_surfaces_come_in_metres(
    tmp_path: Path, write: Callable[[Path, np.ndarray, float], None]
) -> None:
    spacing = 5e-7
    heights = 1e-7 * np.sin(np.arange(12 * 8)).reshape(12, 8)
    file = tmp_path / f"surface.{write.__name__[-3:]}"
    write(file, heights, spacing)
    surface = fret.read_surface(file)
    assert surface.spacing == pytest.approx((spacing, spacing))
    np.testing.assert_allclose(surface.values, heights - heights.mean(), atol=1e-20)


def test_a_measured_surface_is_pressed(tmp_path: Path) -> None:
    grid = fret.Grid.centred(width=2e-5, n=144)
    x, y = np.meshgrid(grid.x, grid.y, indexing="ij")
    heights = 3e-8 * np.cos(8e5 * (x + 0.4 * y))
    write_x3p(tmp_path / "rough.x3p", heights, grid.dx)
    shape = fret.Sphere(R=5e-4) + fret.read_surface(tmp_path / "rough.x3p")
    scene = fret.Scene(
        body1=fret.Body(STEEL, shape=shape),
        body2=fret.Body(STEEL),
        friction=MU,
        grid=grid,
    )
    path = fret.LoadPath.start().normal(0.02, increments=2).tangential(2e-3, increments=2)
    end = fret.solve(scene, path, progress=False).at(-1)
    assert end.doubts == []
    # Heights point towards the other body: it touches where they are high.
    touched = end.contact.to_numpy()
    under = np.hypot(x, y) < np.hypot(x, y)[touched].max()
    assert 20e-12 < touched.sum() * grid.dx * grid.dy < 0.8 * under.sum() * grid.dx * grid.dy
    assert heights[touched].mean() > heights[under & ~touched].mean() + 1e-8


def test_several_normal_forces_are_branches_of_their_own() -> None:
    start = fret.LoadPath.start()
    one_by_one = start.normal(1.0, increments=2).normal("2 N", increments=2)
    assert start.normal([1.0, 2.0], increments=2) == one_by_one
    assert start.normal(np.array([1.0, 2.0]), increments=2) == one_by_one
    with pytest.raises(TypeError, match="a number, or several to visit in turn"):
        start.normal([])
    with pytest.raises(TypeError, match="W"):
        start.normal(None)  # type: ignore[arg-type]
