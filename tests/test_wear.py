"""Wear from Python: laws, results, stores, figures."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import pyfret as fret

if TYPE_CHECKING:
    from pathlib import Path

STEEL = fret.Elastic(E=200e9, nu=0.3)


def line(n: int = 96) -> fret.Scene:
    """Give a cylinder that slides to and fro on a flat, both of steel."""
    path = fret.LoadPath.start().normal(18.5e3, increments=1)
    for to in (20e-6, -20e-6, 20e-6):
        path = path.displace(delta_x=to, increments=3)
    return fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Cylinder(R=6e-3)),
        body2=fret.Body(STEEL),
        mu=0.9,
        grid=fret.Grid.strip(extent=0.5e-3, n=n),
        path=path,
    )


def worn(law: object, **options: object) -> fret.wear.WearResult:
    """Wear the flat of :func:`line` by a law."""
    return fret.wear.solve(
        line(), cycles=2000, first_branch=2, cycling="sliding", body2=law, progress=False, **options
    )


def test_a_law_of_ones_own_that_says_the_same_wears_the_same() -> None:
    built_in = worn(fret.wear.Archard(2e-14))
    own = worn(lambda pressed_way, way, dissipated, worn, cycles: 2e-14 * pressed_way)
    assert np.allclose(built_in.worn2, own.worn2, rtol=1e-9, atol=0)
    energy = worn(lambda pressed_way, way, dissipated, worn, cycles: 2e-14 / 0.9 * dissipated)
    assert np.allclose(built_in.worn2, energy.worn2, rtol=1e-9, atol=0)


def test_volume_follows_from_energy_and_depth() -> None:
    result = worn(fret.wear.DissipatedEnergy(2e-14))
    d = result.dataset
    assert np.allclose(d.volume2, 2e-14 * d.dissipated, rtol=1e-9)
    assert np.isclose(float(d.worn2[-1].max()), float(d.depth2[-1]))
    assert float(d.cycles[-1]) == 2000
    assert d.worn1.max() == 0
    assert "2000 cycles" in repr(result)


def test_a_store_is_the_result(tmp_path: Path) -> None:
    in_memory = worn(fret.wear.Archard(2e-14))
    stored = worn(fret.wear.Archard(2e-14), out=tmp_path / "wear.zarr")
    assert in_memory.dataset.equals(stored.dataset.load())
    assert fret.wear.resume(tmp_path / "wear.zarr", progress=False).status == "done"
    with pytest.raises(fret.errors.StoreError, match="exists"):
        worn(fret.wear.Archard(2e-14), out=tmp_path / "wear.zarr")


def test_bad_input_is_refused_by_name() -> None:
    with pytest.raises(fret.errors.ArgumentError, match=r"wear\.body2\.k = -1"):
        worn(fret.wear.Archard(-1.0))
    with pytest.raises(TypeError, match="wear law"):
        worn("archard")
    with pytest.raises(fret.errors.ArgumentError, match=r"wear\.law"):
        worn(lambda *_: np.zeros(3))
    with pytest.raises(fret.errors.ArgumentError, match="nothing grows"):
        worn(lambda pressed_way, *_: -pressed_way)
    with pytest.raises(fret.errors.ArgumentError, match=r"wear\.tolerance = 3"):
        worn(fret.wear.Archard(1e-14), tolerance=3.0)


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ({"cycling": "slide"}, r"cycling = 'slide': must be \"march\" or \"sliding\""),
        ({"worn_through": "on"}, r"worn_through = 'on': must be \"stop\" or \"go_on\""),
        ({"jumps": -1}, r"jumps = -1: must be 1 or more"),
        ({"first_branch": 0}, r"first_branch = 0: must be 1 or more"),
        ({"tolerance": 0.01, "jumps": 3}, "one of them at most"),
        ({"share1": 0.5}, r"share1 = 0.5: must come with a law, body1"),
    ],
)
def test_options_are_refused_by_name(options: dict[str, Any], told: str) -> None:
    wears: dict[str, Any] = {"cycles": 10, "first_branch": 2, "body2": fret.wear.Archard(1e-14)}
    with pytest.raises(ValueError, match=told):
        fret.wear.solve(line(), progress=False, **{**wears, **options})


def test_figures_are_drawn() -> None:
    result = worn([fret.wear.Archard(2e-14)])
    axes = fret.plot.wear_profiles(result)
    assert axes.get_ylabel() == "worn depth [µm]"
    assert len(axes.lines) > 2
    assert fret.plot.wear_history(result).get_xlabel() == "cycles"
    assert len(fret.plot.wear_loops(result).lines) == 2


def test_debris_that_stays_makes_scars_narrow_and_deep() -> None:
    law = fret.wear.Archard(2e-13)
    free, kept = worn(law), worn(law, debris_kept=0.85)
    assert np.isclose(free.volume2[-1], kept.volume2[-1], rtol=1e-3)
    assert float(kept.depth2[-1]) > 1.2 * float(free.depth2[-1])
    assert np.isclose(kept.debris[-1], 0.85 * kept.volume2[-1])
    assert np.allclose(kept.gap, 0.15 * kept.worn)
    assert "debris: 0.85" in kept.summary()


def test_lives_are_told_at_their_cycle() -> None:
    d = worn(fret.wear.Archard(2e-13), jumps=40)
    depth, volume = 0.4 * float(d.depth2[-1]), 0.6 * float(d.volume2[-1])
    for told, name, value in (
        (d.cycles_to(depth=depth), "depth2", depth),
        (d.cycles_to(volume=volume), "volume2", volume),
    ):
        curve = np.interp(value, np.r_[0, d.dataset[name]], np.r_[0, d.dataset.cycles])
        assert np.isclose(told, curve, rtol=2e-3)
    few = worn(fret.wear.Archard(2e-13), jumps=10)
    assert np.isclose(few.cycles_to(depth=depth), d.cycles_to(depth=depth), rtol=0.03)
    assert d.cycles_to(depth=1.0) == np.inf
    with pytest.raises(ValueError, match="give one of them"):
        d.cycles_to()
    with pytest.raises(ValueError, match="has 0 coatings"):
        d.cycles_to(part_of_coating=0.5)


def test_a_run_goes_on_from_worn_surfaces(tmp_path: Path) -> None:
    law = fret.wear.Archard(8e-14)
    first = worn(law, jumps=8)
    second = worn(law, jumps=8, start=first)
    assert float(second.cycles[-1]) == 4000
    assert float(second.depth2[-1]) > float(first.depth2[-1])
    depth = float(second.depth2[0])
    for name in ("saved.zarr", "saved.nc"):
        second.save(tmp_path / name)
        again = fret.wear.open(tmp_path / name)
        assert again == second
        assert again.cycles_to(depth=depth) == second.cycles_to(depth=depth)
        with pytest.raises(FileExistsError, match=name):
            second.save(tmp_path / name)
    fret.solve(line(), progress=False).save(tmp_path / "run.zarr")
    for name in ("run.zarr", "none.zarr", "none.nc"):
        with pytest.raises(fret.errors.StoreError, match=name):
            fret.wear.open(tmp_path / name)


def test_coefficients_change_by_a_table() -> None:
    table = [(0.0, 1.0), (2000.0, 3.0)]
    law = fret.wear.Archard(2e-14, factor=("cycles", table))
    assert law.factor == ("cycles", table)
    assert law == law.replace(k=2e-14)
    twice = worn(law, jumps=10).volume2[-1] / worn(fret.wear.Archard(2e-14), jumps=10).volume2[-1]
    assert np.isclose(twice, 2.0, rtol=1e-3)
    power = fret.wear.DissipatedEnergy(2e-14, factor=("power_density", [(0.0, 0.5)]))
    with pytest.raises(fret.errors.ArgumentError, match=r"wear\.frequency.*must be given in Hz"):
        worn(power)
    half = worn(power, frequency=5.0).dataset
    assert np.isclose(half.volume2[-1], 1e-14 * half.dissipated[-1])
    with pytest.raises(ValueError, match="must be of"):
        fret.wear.Archard(1e-14, factor=("weekdays", table))


def test_what_is_left_open_is_chosen() -> None:
    scene = line()
    path = fret.LoadPath.start().normal(18.5e3).displace(delta_x=[20e-6, -20e-6, 20e-6])
    law = fret.wear.Archard(2e-14)
    result = fret.wear.solve(
        scene, path, cycles=100, cycling="sliding", body2=[law], jumps=1, progress=False
    )
    assert float(result.volume2[-1]) > 0
    with pytest.raises(fret.errors.ArgumentError, match="no closed cycle"):
        fret.wear.solve(
            scene, fret.LoadPath.start().normal(1e3), cycles=1, body2=law, progress=False
        )


def test_a_function_is_given_again_to_go_on(tmp_path: Path) -> None:
    def law(pressed_way: Any, *_: Any) -> Any:
        return 2e-14 * pressed_way

    def fails(pressed_way: Any, way: Any, dissipated: Any, worn: Any, cycles: float) -> Any:
        if cycles > 500:
            raise RuntimeError("the laboratory is closed")
        return law(pressed_way)

    store = tmp_path / "wear.zarr"
    with pytest.raises(fret.errors.ArgumentError, match="the laboratory is closed"):
        worn(fails, jumps=8, out=store)
    with pytest.raises(fret.errors.ArgumentError, match="given again"):
        fret.wear.resume(store, progress=False)
    resumed = fret.wear.resume(store, body2=law, progress=False)
    assert np.array_equal(resumed.worn2, worn(law, jumps=8).worn2)


def test_friction_falls_over_cycles() -> None:
    mu = fret.Friction(0.9, history=(fret.History.CYCLES, [(0.0, 1.0), (2000.0, 0.5)]))
    scene = line().replace(mu=mu)
    falls = fret.wear.solve(
        scene,
        cycles=2000,
        cycling="sliding",
        body2=fret.wear.Archard(1e-16),
        jumps=6,
        progress=False,
    )
    plain = worn(fret.wear.Archard(1e-16), jumps=6)
    assert np.isclose(falls.dissipated[-1] / plain.dissipated[-1], 0.75, rtol=1e-3)


def test_a_rig_acts_in_every_run() -> None:
    scene = line(160)
    shifted = scene.path.branches[-1].delta_x
    stiff = fret.solve(scene, progress=False)
    soft = fret.solve(scene, rig_stiffness=5e9, progress=False)
    assert float(soft.delta_x[-1]) == shifted
    assert float(soft.dataset.dissipated.sum()) < float(stiff.dataset.dissipated.sum())
    again = fret.Scene.from_toml(scene.replace(path=scene.path.rig(5e9)).to_toml())
    assert again.path.rig_stiffness == 5e9
