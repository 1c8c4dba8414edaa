"""Oxygen and debris in runs of wear: input, stores, figures."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyfret as fret

AIR = fret.wear.Air(distance=1.753e-3, power_density=24e3, power_exponent=0.94)
BED = fret.wear.DebrisBed(kappa=4.444e-3, starved_yield=0.75)
LAW = fret.wear.DissipatedEnergy(alpha=2.25e-13, starved=4e-14)


def cylinder(n: int = 64) -> fret.Scene:
    """A titanium cylinder on a flat."""
    titanium = fret.Elastic(E=119e9, nu=0.29)
    path = fret.LoadPath.start().normal(1.066e6)
    return fret.Scene(
        body1=fret.Body(titanium, shape=fret.Cylinder(R=80e-3)),
        body2=fret.Body(titanium),
        friction=0.6,
        grid=fret.Grid.strip(extent=5.5e-3, n=n),
        path=path.displace(delta_x=75e-6).displace(delta_x=-75e-6).displace(delta_x=75e-6),
    )


def settings(**changes: Any) -> dict[str, Any]:
    """Settings of a short run with air and bed."""
    wear: dict[str, Any] = {"cycles": 500, "body1": LAW, "body2": LAW, "frequency": 5.0, "jumps": 4}
    return {**wear, "air": AIR, "bed": BED, **changes}


@pytest.mark.parametrize(
    ("changes", "match"),
    [
        (lambda: {"frequency": None}, r"wear\.frequency"),
        (lambda: {"debris_kept": 0.5}, r"wear\.debris_kept"),
        (lambda: {"air": AIR.replace(threshold=3e4)}, r"wear\.air\.threshold"),
        (lambda: {"air": AIR.replace(threshold=float("nan"))}, r"threshold"),
        (lambda: {"air": AIR.replace(distance=-1e-3)}, r"distance"),
        (lambda: {"air": AIR.replace(power_exponent=-0.5)}, r"wear\.air\.power_exponent"),
        (lambda: {"air": AIR.replace(reaction=1.0)}, r"wear\.air\.distance"),
        (lambda: {"air": AIR.replace(pressure=1e8)}, r"wear\.air\.power_density"),
        (lambda: {"bed": BED.replace(kappa=-1.0)}, r"wear\.bed\.kappa"),
        (lambda: {"bed": BED.replace(kappa=float("nan"))}, r"kappa"),
        (lambda: {"bed": BED.replace(starved_yield=1.5)}, r"wear\.bed\.starved_yield"),
        (lambda: {"bed": BED.replace(volume_ratio=0.0)}, r"wear\.bed\.volume_ratio"),
        (lambda: {"closed_below": -1e-6}, r"closed_below"),
        (lambda: {"body1": LAW.replace(starved=-1e-14)}, r"starved"),
        (lambda: {"bed": AIR}, r"DebrisBed"),
    ],
)
def test_constants_without_a_meaning_are_refused_by_name(
    changes: Callable[[], dict[str, Any]], match: str
) -> None:
    with pytest.raises((ValueError, TypeError), match=match):
        fret.wear.solve(cylinder(), progress=False, **settings(**changes()))


@pytest.mark.solves
def test_a_run_keeps_its_mass_and_goes_on_with_the_same_bits(tmp_path: Path) -> None:
    worn = fret.wear.solve(cylinder(), progress=False, **settings())
    volume = worn.volume1 + worn.volume2
    np.testing.assert_allclose(worn.debris + worn.ejected, volume, rtol=1e-9)
    area = worn.scene.grid.dx
    np.testing.assert_allclose(worn.bed[-1].sum() * area, worn.debris[-1], rtol=1e-9)
    assert 0 < float(worn.aerated_share[-1]) < 1
    assert "bed" in worn.summary()
    assert "aerated" in worn.summary()
    gap = worn.worn1 + worn.worn2 - worn.bed
    np.testing.assert_allclose(worn.gap, gap, atol=1e-15)
    # The scene file of the run has both tables.
    out = tmp_path / "run.zarr"
    stored = fret.wear.solve(cylinder(), progress=False, out=out, **settings())
    assert stored.table["air"]["distance"] == AIR.distance
    assert stored.table["bed"]["kappa"] == BED.kappa
    np.testing.assert_array_equal(stored.bed, worn.bed)
    # A second run starts on surfaces and bed of the first one.
    second = fret.wear.solve(cylinder(), progress=False, start=worn, **settings())
    volume = second.volume1 + second.volume2
    np.testing.assert_allclose(second.debris + second.ejected, volume, rtol=1e-8)


@pytest.mark.solves
def test_more_without_oxygen_than_in_air_is_doubted() -> None:
    law = LAW.replace(starved=1e-12)
    short = settings(body1=law, cycles=10, jumps=1)
    worn = fret.wear.solve(cylinder(48), progress=False, **short)
    assert "wear.body1.starved" in " ".join(worn.doubts)
