"""Surfaces that bear a limited pressure: saturation, permanent indentation, friction."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

import pyfret as fret
from rough_balls import MODULUS, NU, E, R, surface

pytestmark = pytest.mark.solves

STEEL = fret.Elastic(E=E, nu=NU)
PITCH, N = 4e-6, 64
LOAD = 4 * MODULUS * (0.25 * N * PITCH) ** 3 / (3 * R)


#: Approach and deepest indentation of Tamaas [m] by hardness [Pa].
TAMAAS = {
    3.0e8: (5.768609393698811e-07, 1.9625692456152651e-07),
    4.5e8: (5.200605286821246e-07, 5.558307101613724e-08),
    2e9: (-1.400020897794317e-07, 1.3053644728857296e-07),
    4e9: (-1.5734140091848627e-07, 2.696684374754254e-08),
}


def scene(hardness: float | None, seed: int | None = None, friction: float = 0.0) -> fret.Scene:
    """A ball, smooth or of a row of the rough ones, on a flat of a hardness."""
    pitch, shape = PITCH, fret.Sphere(R=R)
    if seed is not None:
        z, pitch, _ = surface(seed, N)
        shape = shape + fret.SurfaceMap(z, spacing=pitch)
    return fret.Scene(
        body1=fret.Body(STEEL, shape=shape),
        body2=fret.Body(STEEL, hardness=hardness),
        friction=friction,
        grid=fret.Grid.from_spacing((N, N), (pitch, pitch)),
    )


def solved(made: fret.Scene, path: fret.LoadPath) -> fret.Result:
    """The result without the warnings of rough contacts."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return fret.solve(made, path, progress=False)


# ContactMechanics 1.8.3, PlasticNonSmoothContactSystem on the same cells without images.
# Tamaas 2.9.0 (KatoSaturated without images, pressures over E*, lengths over the width) has the
# same cells. Its approach differs by 8e-7 at most, its deepest indentation by 5e-6 (`TAMAAS`).
@pytest.mark.parametrize(
    ("hardness", "seed", "cells", "limited", "approach", "depth"),
    [
        (3.0e8, None, 1092, 1020, 5.768604862563369e-07, 1.962566572233858e-07),
        (4.5e8, None, 840, 500, 5.200602302364439e-07, 5.558290797750348e-08),
        (2e9, 109, 128, 61, -1.4000194906700032e-07, 1.30536533949686e-07),
        (4e9, 109, 98, 12, -1.5734140337554033e-07, 2.696683681462472e-08),
    ],
)
def test_saturated_contacts_are_those_of_another_program(
    hardness: float, seed: int | None, cells: int, limited: int, approach: float, depth: float
) -> None:
    """Cells in contact and at the limit, approach and deepest indentation."""
    W = LOAD if seed is None else surface(seed, N)[2]
    at = solved(scene(hardness, seed), fret.LoadPath.start().normal(W, increments=1)).at(-1)
    p = np.asarray(at.p)
    assert np.count_nonzero(p > 0) == cells
    assert np.count_nonzero(p >= hardness * (1 - 1e-9)) == limited
    assert p.max() <= hardness * (1 + 1e-12)
    assert float(at.delta_z) == pytest.approx(approach, rel=1e-5)
    deepest = float(np.asarray(at.indentation).max())
    assert deepest == pytest.approx(depth, rel=1e-5)
    assert (float(at.delta_z), deepest) == pytest.approx(TAMAAS[hardness], rel=2e-5)


@pytest.mark.parametrize("seed", [None, 109])
def test_unloading_is_elastic_and_reloading_meets_the_indentation(seed: int | None) -> None:
    """Unloaded and loaded again to the same force, nothing new is indented; beyond it, more is."""
    H = 4.5e8 if seed is None else 2e9
    W = LOAD if seed is None else surface(seed, N)[2]
    path = fret.LoadPath.start()
    for load in (W, 0.3 * W, W, 1.2 * W):
        path = path.normal(load, increments=2)
    result = solved(scene(H, seed), path)
    ends = [result.at(n) for n in (2, 4, 6, 8)]
    depths = [np.asarray(at.indentation) for at in ends]
    assert depths[1] == pytest.approx(depths[0], abs=1e-13)
    assert depths[2] == pytest.approx(depths[0], abs=1e-12)
    assert depths[3].max() > 1.02 * depths[0].max()
    assert np.asarray(ends[2].p) == pytest.approx(np.asarray(ends[0].p), abs=1e-4 * H)
    plastic = result.dataset.plastic_work.values
    assert plastic[:2].sum() > 0
    assert abs(plastic[2:6]).sum() < 1e-5 * plastic[:2].sum()
    assert (plastic >= 0).all()
    assert np.abs(result.dataset.residual_energy.values).max() < 1e-6


def test_friction_is_bounded_by_the_limited_pressure() -> None:
    """Partial slip under a saturated pressure: |q| <= mu p, and the shear carries the force."""
    mu, H = 0.4, 4.5e8
    T = 0.6 * mu * LOAD
    path = fret.LoadPath.start().normal(LOAD, increments=1).tangential(T, increments=4)
    result = solved(scene(H, friction=mu), path)
    at = result.at(-1)
    p, q = np.asarray(at.p), np.hypot(at.q_x, at.q_y)
    assert np.asarray(q - mu * p).max() < 1e-9 * mu * H
    assert np.asarray(at.q_x).sum() * PITCH**2 == pytest.approx(T, rel=1e-9)
    assert 0.0 < float(at.stick_ratio) < 1.0


def test_a_hardness_beyond_the_elastic_pressure_changes_nothing() -> None:
    """The limit of a hard surface."""
    path = fret.LoadPath.start().normal(LOAD, increments=2)
    hard, elastic = (solved(scene(H), path).at(-1) for H in (1e10, None))
    assert np.array_equal(hard.p, elastic.p)
    assert not np.asarray(hard.indentation).any()


def test_a_hardness_may_be_that_of_a_material() -> None:
    """2.8 times the yield stress of the table; what is no hardness is refused."""
    body = fret.Body(STEEL, hardness="steel_42CrMo4")
    s_y = fret.fatigue.Materials()["steel_42CrMo4"].number("s_y")
    assert body.hardness == pytest.approx(2.8 * s_y)
    assert fret.Body(STEEL).hardness is None
    with pytest.raises(ValueError, match="above 0 Pa"):
        fret.Body(STEEL, hardness=-1e9)
    with pytest.raises(ValueError, match="plastic"):
        fret.Body(fret.Elastic(E=E, nu=NU, plastic=fret.Plastic(s_y=1e9)), hardness=1e9)
    with pytest.raises(ValueError, match="larger grid"):
        solved(scene(1e7), fret.LoadPath.start().normal(LOAD, increments=1))


def test_a_scene_file_keeps_the_hardness() -> None:
    """Written and read, the scene is the same."""
    made = scene(1e9).replace(path=fret.LoadPath.start().normal(LOAD, increments=1))
    assert "hardness = 1000000000.0" in made.to_toml()
    assert fret.Scene.from_toml(made.to_toml()) == made
