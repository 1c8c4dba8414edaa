"""Rough contacts: accepted, counted, and right against another program and a theorem."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

import pyfret as fret
from rough_balls import MODULUS, ROWS, R, band_limited, scene, surface

pytestmark = pytest.mark.solves


def pressed(seed: int) -> fret.Result:
    """The ball of a row under its force."""
    z, pitch, W = surface(seed)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        path = fret.LoadPath.start().normal(W, increments=1)
        return fret.solve(scene(z, pitch), path, progress=False)


def count_faces(inside: np.ndarray) -> int:
    """Faces between cells inside and outside."""
    return sum(int(np.count_nonzero(np.diff(inside.astype(int), axis=k))) for k in (0, 1))


@pytest.mark.parametrize("row", ROWS, ids=lambda row: str(row["seed"]))
def test_self_affine_balls_are_those_of_another_program(row: dict[str, float]) -> None:
    """Cells in contact and the largest pressure, of contacts of 15 to 2100 cells."""
    result = pressed(int(row["seed"]))
    last = result.at(-1)
    cells = int((np.asarray(last.p) > 0).sum())
    assert cells == pytest.approx(row["cells"], rel=1e-3)
    assert float(last.p_max) == pytest.approx(row["p_max"], rel=1e-3)


def test_spots_are_counted_in_the_dataset() -> None:
    """Numbers of spots, areas, gap and pressure follow from the fields."""
    result = pressed(109)
    d, last = result.dataset.isel(increment=-1), result.at(-1)
    p, grid = np.asarray(last.p), result.scene.grid
    cell = grid.dx * grid.dy
    contact = p > 0
    faces = count_faces(contact)
    beta = (np.pi - 1 + np.log(2)) / 24
    assert float(d.real_area) == pytest.approx(cell * (contact.sum() - beta * faces), rel=1e-9)
    assert float(d.mean_pressure) == pytest.approx(float(d.W) / (cell * contact.sum()), rel=1e-9)
    a = (3 * float(d.W) * R / (4 * MODULUS)) ** (1 / 3)
    assert float(d.nominal_area) == pytest.approx(np.pi * a**2, rel=1e-9)
    inside = np.hypot(grid.x[:, None], grid.y[None, :]) <= a
    assert float(d.mean_gap) == pytest.approx(float(np.asarray(last.gap)[inside].mean()), rel=1e-6)
    from pyfret.plot.rough import label_spots

    labels, areas = label_spots(contact, cell)
    assert int(d.spots) == labels.max() == len(areas) > 10
    largest = count_faces(labels == 1 + int(np.argmax(areas)))
    assert float(d.largest_spot) == pytest.approx(areas.max() - beta * largest * cell, rel=1e-9)
    assert float(d.largest_spot) < float(d.real_area)
    around = np.pad(contact, 1)
    near = sum(
        around[1 + i : around.shape[0] - 1 + i, 1 + j : around.shape[1] - 1 + j]
        for i in (-1, 0, 1)
        for j in (-1, 0, 1)
    )
    lone = np.count_nonzero(contact & (near == 1)) / contact.sum()
    assert float(d.lone_share) == pytest.approx(lone)


def test_the_area_of_the_contact_is_the_real_one() -> None:
    """The contact area is corrected for the faces of its cells, as the real area is."""
    d = pressed(109).dataset.isel(increment=-1)
    error = 0.5 * float(d.real_area_error)
    assert float(d.contact_area) == pytest.approx(float(d.real_area), abs=error)
    assert float(d.contact_radius) == pytest.approx(np.sqrt(float(d.contact_area) / np.pi))


def test_slopes_are_those_of_the_heights() -> None:
    """Differences of neighbouring heights within the nominal contact, without the ball."""
    z, pitch, W = surface(109)
    d = pressed(109).dataset.isel(increment=-1)
    x = pitch * (np.arange(len(z)) - (len(z) - 1) / 2)
    a = (3 * W * R / (4 * MODULUS)) ** (1 / 3)
    inside = (np.hypot(x[:, None], x[None, :]) <= a)[:-1, :-1]
    squares = (np.diff(z, axis=0)[:, :-1] ** 2 + np.diff(z, axis=1)[:-1] ** 2) / pitch**2
    assert float(d.rms_slope) == pytest.approx(np.sqrt(squares[inside].mean()), rel=1e-3)
    assert float(d.slope_length) == pytest.approx(pitch)


def test_like_bodies_are_pressed_in_one_increment() -> None:
    """Without shear the path does not matter; unlike bodies and later shear need increments."""
    z, pitch, W = band_limited(1, 48)
    steel, made = fret.Elastic(E=210e9, nu=0.3), scene(z, pitch, friction=0.4)
    unlike = made.replace(body2=fret.Body(fret.Elastic(E=100e9, nu=0.3)))
    assert made.body1.substrate == steel
    pressing = fret.LoadPath.start().normal(W)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        counts = [
            np.bincount(fret.solve(pair, path, progress=False).dataset.branch_of_increment.values)
            for pair, path in (
                (made, pressing),
                (made, pressing.tangential(0.2 * W)),
                (unlike, pressing),
            )
        ]
    assert counts[0].tolist() == [1]
    assert counts[1][0] == 1 < counts[1][1]
    assert counts[2][0] > 10


def test_what_is_said_of_asperities_names_them() -> None:
    """A contact of asperities of one cell is solved; the warning names what depends on them."""
    z, pitch, W = surface(108)
    with pytest.warns(fret.errors.SceneWarning, match=r"asperities have .* across their radius"):
        result = fret.solve(
            scene(z, pitch), fret.LoadPath.start().normal(W, increments=1), progress=False
        )
    assert result.dataset.sizes["increment"] == 1


@pytest.mark.parametrize(("seed", "part"), [(1, 0.3), (2, 0.6), (3, 0.9)])
def test_rough_partial_slip_follows_from_pressing_alone(seed: int, part: float) -> None:
    """Ciavarella and Jaeger: q = mu (p(W) - p(W - T/mu)), delta_x likewise, for nu = 0.

    M. Ciavarella, Int. J. Solids Struct. 35 (1998) 2349; J. Jaeger, Arch. Appl. Mech. 65 (1995)
    478.
    """
    z, pitch, W = band_limited(seed, 64)
    mu = 0.4
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        exact = fret.Settings(tolerance=1e-8)
        sheared = scene(z, pitch, friction=mu, nu=0.0, settings=exact)
        T = part * mu * W
        path = fret.LoadPath.start().normal(W, increments=1).tangential(T, increments=1)
        result = fret.solve(sheared, path, progress=False)
        unloaded = [
            fret.solve(
                scene(z, pitch, nu=0.0, settings=exact),
                fret.LoadPath.start().normal(load, increments=1),
                progress=False,
            ).at(-1)
            for load in (W, W - T / mu)
        ]
    full, reduced = (np.asarray(at.p) for at in unloaded)
    q = np.asarray(result.at(-1).q_x)
    assert np.abs(q - mu * (full - reduced)).max() < 1e-3 * mu * full.max()
    shift = mu * (float(unloaded[0].delta_z) - float(unloaded[1].delta_z))
    assert float(result.dataset.delta_x[-1]) == pytest.approx(shift, rel=1e-4)
    # The cells that stick are those in contact under W - T/mu. The rim of the first surface is
    # smooth: there the zones lie within cells, while the real area counts whole ones.
    areas = [float(at.dataset.real_area) for at in unloaded]
    within = 3e-3 if seed == 1 else 1e-9
    assert float(result.dataset.stick_ratio[-1]) == pytest.approx(areas[1] / areas[0], abs=within)


@pytest.mark.filterwarnings("ignore:the surfaces are uneven")
def test_the_slope_does_not_depend_on_the_direction_of_the_shear() -> None:
    """Shear along x mirrors the scene and halves its cells, shear along y does not."""
    cells = (np.arange(24) - 11.5) * 4e-6
    x, y = np.meshgrid(cells, cells, indexing="ij")
    bowl = fret.SurfaceMap(-(x**2 + y**2) / (2 * 5e-3), spacing=(4e-6, 4e-6))
    steel = fret.Elastic(E=210e9, nu=0.3)
    slopes = []
    for axis in ("T_x", "T_y"):
        scene = fret.Scene(
            body1=fret.Body(steel, shape=bowl),
            body2=fret.Body(steel),
            friction=0.5,
            grid=fret.Grid.centred(width=24 * 4e-6, n=24),
            path=fret.LoadPath.start().normal(0.5, increments=1).force(**{axis: 0.1}, increments=1),
        )
        slopes.append(float(fret.solve(scene, progress=False).rms_slope[-1]))
    assert slopes[0] == pytest.approx(slopes[1], rel=1e-9)


def test_a_smooth_ball_given_as_a_map_has_the_warning_of_a_ball() -> None:
    """A map of a ball has no asperities; a spot on top of a rough one is an asperity."""
    steel = fret.Elastic(E=2.1e11, nu=0.3)
    grid = fret.Grid.centred(width=4e-4, n=32)
    x, y = grid.x[:, None], grid.y[None, :]
    ball = -(x**2 + y**2) / (2 * R)
    hills = 1e-6 * np.cos(2 * np.pi * x / 2e-4) * np.cos(2 * np.pi * y / 2e-4)
    shapes: dict[str, fret.Sphere | fret.SurfaceMap] = {
        "ball": fret.Sphere(R=R),
        "map": fret.SurfaceMap(ball, spacing=grid.dx),
        "rough": fret.SurfaceMap(ball + hills, spacing=grid.dx),
    }
    for name, shape in shapes.items():
        bodies = {"body1": fret.Body(steel, shape=shape), "body2": fret.Body(steel)}
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            path = fret.LoadPath.start().normal(1.0 if name == "rough" else 10.0)
            fret.solve(fret.Scene(friction=0.3, grid=grid, **bodies), path, progress=False)
        texts = [str(w.message) for w in caught]
        is_rough = name == "rough"
        smooth = [text for text in texts if "the contact has 6." in text]
        assert bool(smooth) != is_rough, texts
        assert any("uneven: the contact is one spot" in text for text in texts) == is_rough, texts


@pytest.mark.parametrize("seed", [101, 104, 109])
def test_the_largest_stress_is_not_below_samples_under_all_asperities(seed: int) -> None:
    """The search starts below the asperities; planes of the whole contact hold nothing larger."""
    z, pitch, W = band_limited(seed, 128)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        path = fret.LoadPath.start().normal(W).tangential([0.6 * 0.3 * W])
        last = fret.solve(scene(z, pitch, friction=0.3), path, progress=False).at(-1)
        largest = last.stress().maximum("von_mises")
        planes = last.stress(z=pitch * np.geomspace(0.2, 8.0, 12)).von_mises
    assert largest.value >= float(planes.max()) * (1 - 1e-6)
