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
    with pytest.raises(fret.errors.InvalidSceneError, match=r"wear\.body2\.k = -1"):
        worn(fret.wear.Archard(-1.0))
    with pytest.raises(TypeError, match="wear law"):
        worn("archard")
    with pytest.raises(fret.errors.InvalidSceneError, match=r"wear\.law"):
        worn(lambda *_: np.zeros(3))
    with pytest.raises(fret.errors.InvalidSceneError, match="nothing grows"):
        worn(lambda pressed_way, *_: -pressed_way)
    with pytest.raises(fret.errors.InvalidSceneError, match=r"wear\.tolerance = 3"):
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
    assert axes.get_ylabel() == "worn depth [um]"
    assert len(axes.lines) > 2
    assert fret.plot.wear_history(result).get_xlabel() == "cycles"
    assert len(fret.plot.wear_loops(result).lines) == 2
