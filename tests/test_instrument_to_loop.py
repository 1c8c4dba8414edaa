"""Maps of instruments with holes, tilt and form: from the file to the loop in six lines."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import pyfret as fret

pytestmark = pytest.mark.solves

Heights = NDArray[np.float64]

N, PITCH, R, W, MU = 72, 3e-6, 8e-3, 0.8, 0.4
SIDE = N * PITCH


def heights() -> Heights:
    """A ground ball without tilt: form and waves of 12 points or more [m], shape (x, y)."""
    x = PITCH * (np.arange(N) - (N - 1) / 2)
    waves = fret.SurfaceMap(np.random.default_rng(4).standard_normal((N, N)), spacing=PITCH)
    rough: Heights = waves.filter(short=12 * PITCH).values
    ball: Heights = 2e-9 / rough.std() * rough - (x[:, None] ** 2 + x[None, :] ** 2) / (2 * R)
    return ball


def measured() -> Heights:
    """The ball on a tilted stage, three of its points lost."""
    x = PITCH * np.arange(N)
    z = heights() + 2e-3 * x[:, None] - 1e-3 * x[None, :] + 1e-5
    z[5, 9] = z[40, 60] = z[41, 60] = np.nan
    return z


def atomic_force(path: Path) -> None:
    """A .gwy of an atomic force microscope: lost points under a mask."""
    topography = pytest.importorskip("SurfaceTopography").Topography
    masked = topography(np.ma.masked_invalid(measured()), (SIDE, SIDE), unit="m")
    masked.to_gwy(str(path.with_suffix(".gwy")))


def optical(path: Path) -> None:
    """An .x3p of an optical profiler, of edition 2017."""
    x3pio = pytest.importorskip("x3pio")
    x3pio.write(path.with_suffix(".x3p"), measured().T, x_scale=PITCH, y_scale=PITCH)


def focus_variation(path: Path) -> None:
    """An .al3d of a focus variation microscope."""
    surfalize = pytest.importorskip("surfalize")
    step = 1e6 * PITCH
    surfalize.Surface(1e6 * measured().T, step, step).save(path.with_suffix(".al3d"))


def stylus(path: Path) -> None:
    """An .sdf of an areal stylus instrument."""
    sdfio = pytest.importorskip("sdfio")
    sdfio.write(path.with_suffix(".sdf"), measured().T, x_scale=PITCH, y_scale=PITCH)


def loop_of(surface: fret.SurfaceMap, path: fret.LoadPath) -> fret.Result:
    """The contact of a ball that was measured with its form."""
    steel = fret.Elastic(E=210e9, nu=0.3)
    ball = fret.Sphere(R=surface.fit_form("sphere").radii[0]) + surface.level("sphere")
    bodies = {"body1": fret.Body(steel, shape=ball), "body2": fret.Body(steel)}
    grid = fret.Grid.from_spacing(surface.values.shape, surface.spacing)
    return fret.solve(fret.Scene(friction=MU, grid=grid, **bodies), path, progress=False)


#: What a warning of this contact may be about: lost points, a mask, small asperities.
APPLIES = ("were not measured", "under a mask", "the surfaces are uneven")


@pytest.mark.parametrize("write", [atomic_force, optical, focus_variation, stylus])
def test_six_lines_from_file_to_loop(write: Callable[[Path], None], tmp_path: Path) -> None:
    """The loop is the one of the heights without tilt and holes; each warning applies."""
    write(tmp_path / "map")
    (file,) = tmp_path.iterdir()
    T = 0.6 * MU * W
    path = fret.LoadPath.start().normal(W, increments=1).tangential([T, -T, T], increments=1)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        # Five lines of loop_of and this one.
        result = loop_of(fret.read_surface(file, missing="fill"), path)
    for warning in caught:
        assert any(part in str(warning.message) for part in APPLIES), warning.message
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        truth = loop_of(fret.SurfaceMap(heights(), spacing=PITCH), path)
    for name, rel in (("dissipated", 0.01), ("delta_x", 0.003), ("real_area", 0.02)):
        value, right = (float(run.dataset[name][-1]) for run in (result, truth))
        assert value == pytest.approx(right, rel=rel), name
    assert int(result.dataset.spots[-1]) == int(truth.dataset.spots[-1])
