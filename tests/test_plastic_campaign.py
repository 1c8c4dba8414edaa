"""Random contacts of bodies that yield, audited; `make plastic` draws 300 of them."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import pyfret as fret
from pyfret import _core
from pyfret.errors import NoConvergenceError
from pyfret.subsurface.plastic import YIELDED

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

DRAWN = int(os.environ.get("FRET_PLASTIC", "10"))
#: Seeds whose path has an increment without a solution: the surface flows in shear.
FLOWS = [20]
#: A seed whose volume grid grows under shear, with points at the border of the smaller one.
GROWS = 96


def drawn(seed: int) -> fret.Scene:
    """Draw bodies with up to two layers, a law, a path of loads or of motions."""
    rng = np.random.default_rng(seed)
    line = rng.random() < 0.3
    E = 10 ** rng.uniform(10.5, 11.5)
    s_y = E * rng.uniform(2e-3, 8e-3)
    law = fret.Plastic(
        s_y=s_y,
        hardening=E * rng.choice([0.0, 0.01, 0.05]) + 1e-3 * E,
        kinematic=E * rng.choice([0.0, 0.0, 0.05]),
    )
    nu = rng.uniform(0.1, 0.4)
    R = 10 ** rng.uniform(-3, -1)
    upper = fret.Elastic(E=E * rng.choice([1.0, 3.0]), nu=nu)
    # Largest pressure over the pressure at first yield, of the uncoated bodies.
    p_0 = 1.65 * s_y * rng.uniform(0.8, 1.8)
    modulus = 1 / ((1 - nu**2) / upper.E + (1 - nu**2) / E)
    a = (2 if line else np.pi / 2) * p_0 * R / modulus
    W = np.pi / 2 * a * p_0 if line else 2 / 3 * np.pi * a**2 * p_0
    layers = []
    for _ in range(rng.integers(0, 3)):
        own_values = fret.Plastic(s_y=s_y * rng.uniform(0.7, 2.0), hardening=0.02 * E)
        material = fret.Elastic(
            E=E * rng.uniform(0.5, 2.0), nu=0.3, plastic=own_values if rng.random() < 0.4 else None
        )
        layers.append(fret.Coating(material, thickness=a * rng.uniform(0.1, 0.5)))
    mu = rng.choice([0.0, rng.uniform(0.05, 0.7)])
    path = fret.LoadPath.start().normal(W, increments=4)
    if mu > 0:
        T = mu * W * rng.uniform(0.3, 0.9)
        path = path.tangential([T, -T], increments=4)
    else:
        path = path.normal(0.1 * W, increments=2)
    shape = fret.Cylinder(R=R) if line else fret.Sphere(R=R)
    grid = fret.Grid.strip(extent=3.2 * a, n=48) if line else fret.Grid.centred(width=3.2 * a, n=20)
    return fret.Scene(
        body1=fret.Body(upper, shape=shape),
        body2=fret.Body(fret.Elastic(E=E, nu=nu, plastic=law), coatings=layers),
        friction=mu,
        grid=grid,
        path=path,
    )


def over_the_yield_surface(scene: fret.Scene, found: object) -> float:
    """Give the largest stress over the yield stress, the back stress taken off, less one."""
    body = scene.body2
    materials = [*(c.material for c in body.coatings), body.substrate]
    dataset = found.dataset
    upper = -1.0
    for plane, layer in enumerate(dataset.layer.to_numpy()):
        law = materials[int(layer)].plastic
        if law is None:
            continue
        stress, strain = (dataset[n].isel(z=plane).to_numpy() for n in ("stress", "strain"))
        s = stress - law.kinematic / 1.5 * strain
        s[:3] -= s[:3].mean(axis=0)
        mises = np.sqrt(1.5 * ((s[:3] ** 2).sum(axis=0) + 2 * (s[3:] ** 2).sum(axis=0)))
        yield_stress = law.s_y + law.hardening * dataset.equivalent.isel(z=plane).to_numpy()
        upper = max(upper, float((mises / yield_stress).max()) - 1)
    return upper


def of_strain(found: fret.Result) -> dict[str, object]:
    """Give what has yielded and the scalars of the path."""
    names = (*YIELDED, "W", "T_x", "delta_z", "plastic_work", "elastic", "dissipated")
    return {name: found.dataset[name].to_numpy() for name in names}


@pytest.mark.solves
@pytest.mark.filterwarnings("ignore::pyfret.errors.SceneWarning")
@pytest.mark.parametrize("seed", sorted({*range(max(1, DRAWN // 10))} - {*FLOWS}))
def test_a_random_contact_that_was_stopped_goes_on_to_the_same_bits(
    seed: int, tmp_path: Path
) -> None:
    """Stopped after a random increment, and resumed."""
    scene = drawn(seed).replace(save="all")
    last = int(np.random.default_rng(seed).integers(1, 6))

    def stop(index: int, _: int) -> None:
        if index == last:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        _core.solve(scene, store=tmp_path / "run", checkpoint=0.0, on_increment=stop)
    resumed = of_strain(fret.resume(tmp_path / "run", progress=False))
    for name, whole in of_strain(fret.solve(scene, progress=False)).items():
        np.testing.assert_array_equal(resumed[name], whole)


def until_it_flows(scene: fret.Scene) -> Iterator[Any]:
    """Go along a path, to an increment without a solution: the surface flows in shear."""
    contact, failure = 0.0, None
    try:
        for increment in fret.march(scene):
            contact = float((increment.dataset.p > 0).sum()) * scene.grid.cell_area
            yield increment
    except NoConvergenceError as error:
        failure = str(error)
    if failure is None:
        return
    assert "shear yield stress" in failure
    # That is right: the shear of the path, over the last contact, comes to s_y/sqrt(3).
    T = max(abs(branch.T_x) for branch in scene.path.branches)
    assert T / contact > 0.75 * scene.body2.substrate.plastic.s_y / np.sqrt(3)


@pytest.mark.solves
@pytest.mark.filterwarnings("ignore::pyfret.errors.SceneWarning")
@pytest.mark.parametrize("seed", FLOWS)
def test_a_surface_that_flows_in_shear_is_refused_by_that_cause(seed: int) -> None:
    """Under 1.0 s_y/sqrt(3) of mean shear, with next to no hardening."""
    with pytest.raises(NoConvergenceError, match="shear yield stress"):
        list(fret.march(drawn(seed)))


@pytest.mark.solves
@pytest.mark.filterwarnings("ignore::pyfret.errors.SceneWarning")
@pytest.mark.parametrize(
    "seed",
    [
        pytest.param(seed, marks=[pytest.mark.slow] if DRAWN == 10 and seed in range(4, 10) else [])
        for seed in sorted({*range(DRAWN), GROWS})
    ],
)
def test_a_random_contact_holds_what_holds_for_all(seed: int) -> None:
    """Balance, Coulomb's law, the yield condition, energy; plastic work is never given back."""
    scene = drawn(seed)
    work = kept = moved = 0.0
    for increment in until_it_flows(scene):
        p = increment.dataset.p.to_numpy()
        area = scene.grid.cell_area
        assert p.sum() * area == pytest.approx(float(increment.W), rel=1e-6)
        if scene.friction.mu > 0:
            q = np.hypot(increment.dataset.q_x.to_numpy(), increment.dataset.q_y.to_numpy())
            assert (q <= scene.friction.mu * p * (1 + 1e-6)).all()
        assert abs(float(increment.residual_energy)) < 1e-4
        assert float(increment.plastic_work) >= 0.0
        # The kept energy, with the residual stress included, is part of the work done.
        # The work takes the mean force over each of a few increments: half a percent off.
        work, kept = work + float(increment.work), kept + float(increment.elastic)
        moved += abs(float(increment.work))
        assert 0.0 < kept <= work + 5e-3 * moved
        assert float(increment.dissipated) >= -1e-4 * abs(float(increment.work))
        # Stress changes by 1e-4 of the yield stress in the last pass.
        assert over_the_yield_surface(scene, increment.plastic()) < 2e-3
