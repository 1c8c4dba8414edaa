"""Valid scenes, and the messages for scenes without a meaning."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import pyfret as fret
from conftest import R, W, sphere_on_flat

STEEL = fret.Elastic(E=210e9, nu=0.3)


@pytest.mark.parametrize(
    ("E", "nu", "message"),
    [
        (-1.0, 0.3, r"E = -1: must be a positive modulus in Pa"),
        (0.0, 0.3, r"E = 0"),
        (math.nan, 0.3, r"E = NaN"),
        (210e9, 0.51, r"nu = 0.51: must be -1 < nu <= 0.5"),
        (210e9, -1.0, r"nu = -1"),
    ],
)
def test_a_material_out_of_range_is_refused(E: float, nu: float, message: str) -> None:
    with pytest.raises(fret.errors.InvalidSceneError, match=message):
        fret.Elastic(E=E, nu=nu)


def with_thickness(thickness: float) -> fret.Scene:
    scene = sphere_on_flat()
    layer = fret.Coating(STEEL, thickness=thickness)
    return fret.Scene(
        body1=scene.body1, body2=fret.Body(STEEL, coatings=[layer]), friction=0.3, grid=scene.grid
    )


INDENTED = fret.LoadPath.start().normal(W, increments=1)


@pytest.mark.parametrize(
    ("broken", "message"),
    [
        (lambda: with_thickness(0.0), r"coating\.thickness = 0: must be a positive"),
        (lambda: sphere_on_flat().replace(friction=-0.1), r"friction\.mu = -0\.1: must be"),
        (lambda: sphere_on_flat().replace(friction=math.nan), r"friction\.mu = NaN"),
        (lambda: sphere_on_flat(n=0), r"grid\.nx = 0: must be at least one cell"),
    ],
)
def test_a_scene_without_meaning_is_refused(broken: Callable[[], fret.Scene], message: str) -> None:
    with pytest.raises(fret.errors.InvalidSceneError, match=message):
        broken().replace(path=INDENTED).check()


@pytest.mark.parametrize(
    ("path", "message"),
    [
        (fret.LoadPath.start(), r"path = empty: must be at least one branch"),
        (
            INDENTED.tangential(1.01 * 0.3 * W, increments=1),
            r"path\[1\]\.T_x = 303: must be \|T\| <= mu W",
        ),
    ],
)
def test_a_path_beyond_reach_is_refused(path: fret.LoadPath, message: str) -> None:
    with pytest.raises(fret.errors.InvalidSceneError, match=message):
        fret.solve(sphere_on_flat(), path, progress=False)


def test_a_grid_too_small_for_the_contact_says_how_large_it_should_be() -> None:
    scene = sphere_on_flat()
    tight = fret.Grid.centred(width=0.5 * scene.grid.nx * scene.grid.dx, n=16)
    cramped = fret.Scene(body1=scene.body1, body2=scene.body2, friction=0.3, grid=tight)
    with pytest.raises(fret.errors.OffGridError, match=r"should be about .* m wide"):
        fret.solve(cramped, INDENTED, progress=False)


def test_tangential_shares_increments_in_proportion_to_the_change_of_force() -> None:
    path = INDENTED.tangential([270.0, -270.0, 270.0], increments=50)
    assert [branch.increments for branch in path.branches] == [1, 10, 20, 20]
    np.testing.assert_allclose(np.abs(np.diff(path.T_x)), 27.0, rtol=1e-12)


def test_equal_radius_increments_grow_with_the_cube() -> None:
    path = fret.LoadPath.start().force(W=W, increments=4, spacing=fret.Spacing.EQUAL_RADIUS)
    np.testing.assert_allclose(path.W, W * (np.arange(1, 5) / 4) ** 3, rtol=1e-15)


def test_forces_not_named_keep_their_value() -> None:
    path = INDENTED.force(T_y=10.0, increments=1).force(T_x=20.0, increments=2, t=5.0)
    end = path.branches[-1]
    assert (end.W, end.T_x, end.T_y, end.t) == (W, 20.0, 10.0, 5.0)


def test_the_grid_is_centred_on_the_initial_point_of_contact() -> None:
    grid = fret.Grid.from_spacing((4, 3), (0.5, 2.0))
    np.testing.assert_array_equal(grid.x, [-0.75, -0.25, 0.25, 0.75])
    np.testing.assert_array_equal(grid.y, [-2.0, 0.0, 2.0])


def test_parts_are_read_back_as_they_were_given() -> None:
    scene = sphere_on_flat(ratio=2.0)
    assert scene.body1.shape == fret.Sphere(R=R)
    assert scene.body2.shape == fret.shapes.Flat()
    assert scene.body2.coatings[0].material == fret.Elastic(E=420e9, nu=0.3)
    assert scene.replace(friction=0.5).mu == 0.5
    assert scene.replace(friction=0.5) != scene
    skip = fret.settings.Skip(mirror=False)
    settings = fret.Settings(kernel=fret.settings.InverseFft(enlargement=4), skip=skip)
    assert scene.replace(settings=settings).settings == settings
    assert settings.kernel == fret.settings.InverseFft(enlargement=4, aliases=0)
    assert not settings.skip.mirror


def test_no_slip_is_said_as_in_scene_files() -> None:
    held = sphere_on_flat().replace(friction="stick")
    assert held.mu == math.inf
    assert 'mu = "stick"' in held.to_toml()
    with pytest.raises(TypeError, match='"stick" for no slip'):
        sphere_on_flat().replace(friction="glued")


def test_a_scene_survives_its_file() -> None:
    settings = fret.Settings(
        tolerance=1e-6, skip=fret.settings.Skip(mirror=False), preset=fret.settings.Preset.SPINU2020
    )
    path = INDENTED.tangential([100.0, -100.0], increments=3)
    scene = sphere_on_flat(ratio=2.0).replace(path=path, settings=settings)
    assert fret.Scene.from_toml(scene.to_toml()) == scene


def test_an_unknown_key_names_the_nearest_valid_one_and_the_line() -> None:
    text = sphere_on_flat().replace(path=INDENTED).to_toml().replace("mu =", "mue =")
    with pytest.raises(fret.errors.InvalidSceneError, match=r":\d+: .*mue.*mu"):
        fret.Scene.from_toml(text)


def test_a_graded_coating_is_a_stack_with_the_properties_of_each_middle() -> None:
    profile = fret.Profile.linear(top=400e9, bottom=200e9)
    stack = fret.graded(E=profile, nu=fret.Profile.constant(0.3), thickness=1e-3, layers=4)
    assert [c.material.E for c in stack] == pytest.approx([375e9, 325e9, 275e9, 225e9])
    assert sum(c.thickness for c in stack) == pytest.approx(1e-3)
    with pytest.raises(fret.errors.InvalidSceneError, match="layers"):
        fret.graded(E=profile, nu=fret.Profile.constant(0.3), thickness=1e-3, layers=0)


def test_a_scene_reads_no_file_outside_its_folder(tmp_path: Path) -> None:
    np.save(
        tmp_path / "outside.npy",
        -np.add.outer(np.arange(-2.0, 3) ** 2, np.arange(-2.0, 3) ** 2) * 1e-6,
    )
    scene = tmp_path / "scene" / "scene.toml"
    scene.parent.mkdir()
    scene.write_text(
        """
        schema = 1
        body1.shape.height_map = { spacing = 1e-3, file = "../outside.npy" }
        body1.E = 2e11
        body1.nu = 0.3
        body2 = { shape = "flat", E = 2e11, nu = 0.3 }
        friction.mu = 0.3
        grid = { n = 8, extent = 3e-3 }
        path = [{ W = 1.0, increments = 1 }]
        """
    )
    with pytest.raises(fret.errors.InvalidSceneError, match="outside the folder"):
        fret.Scene.from_file(scene)
    assert fret.Scene.from_file(scene, allow_outside=True).grid.nx == 8


def test_the_settings_of_python_have_the_defaults_of_a_scene_file() -> None:
    scene = sphere_on_flat().replace(path=INDENTED)
    text = scene.to_toml().split("[kernel]")[0]
    assert fret.Scene.from_toml(text).settings == fret.Settings()
    exotic = fret.Settings(
        kernel=fret.settings.FrequencyDomain(enlargement=3),
        save=[1],
        path_grid="same",
        tolerance=1e-7,
    )
    again = fret.Scene.from_toml(scene.replace(settings=exotic).to_toml())
    assert again.settings == exotic
    with pytest.raises(TypeError, match="the nearest is 'path_tolerance'"):
        fret.Settings(pathtolerance=1.0)  # type: ignore[call-arg]
