"""Cycles, errors, stress, life and wear of rough contacts: like, unlike and coated bodies."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

import pyfret as fret
from rough_balls import NU, E, R, surface

pytestmark = pytest.mark.solves

MU = 0.4
STEEL = fret.Elastic(E=E, nu=NU)
FILM = fret.Elastic(E=300e9, nu=0.25)
FLATS = {
    "like": fret.Body(STEEL),
    "unlike": fret.Body(fret.Elastic(E=114e9, nu=0.32)),
    "coated": fret.Body(STEEL, coatings=[fret.Coating(FILM, thickness=3e-6)]),
}
#: Points along a side: the second as an instrument has them.
SIZES = [48, pytest.param(256, marks=pytest.mark.slow)]


def contact(n: int, pair: str) -> tuple[fret.Scene, float]:
    """A self-affine ball on a flat, and its force."""
    z, pitch, W = surface(109, n)
    ball = fret.Sphere(R=R) + fret.SurfaceMap(z, spacing=pitch)
    made = fret.Scene(
        body1=fret.Body(STEEL, shape=ball),
        body2=FLATS[pair],
        friction=MU,
        grid=fret.Grid.from_spacing(z.shape, (pitch, pitch)),
    )
    return made, W


@pytest.mark.parametrize("n", SIZES)
@pytest.mark.parametrize("pair", FLATS)
def test_cycles_have_errors_stress_and_life(n: int, pair: str) -> None:
    """Two cycles of shear: the second repeats the first within the errors, and all have numbers."""
    made, W = contact(n, pair)
    path = fret.LoadPath.start().normal(W, increments=4 if pair != "like" else 1)
    path = path.cycles(2, T_x=0.5 * MU * W, increments=3)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        result = fret.solve(made, path, error=True, progress=False)
        stress = result.at(-1).stress()
    bars, loops = result.error_bars().sel(part="total"), result.loops()
    for name, bar in bars.data_vars.items():
        assert np.isfinite(bar.values).all(), name
    first, second = loops.dissipated.values
    error = float(np.hypot(*loops.dissipated_error.values))
    assert second == pytest.approx(first, abs=2 * error)
    # The shear acts along x: so does the section, along a row of cells.
    assert "x" in stress.dataset.dims
    assert np.isfinite(stress.von_mises.values).all()
    if pair == "like":
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            life = result.life("steel_42CrMo4", "crossland")
        assert np.isfinite(life.worst.value)


def test_a_map_takes_the_finer_grid_for_its_errors() -> None:
    """Every second point alone misses the approach of one rough ball in four."""
    made, W = contact(SIZES[0], "like")
    path = fret.LoadPath.start().normal(W, increments=1)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        by_default, coarser = (
            fret.solve(made, path, error=error, progress=False).error_bars()
            for error in (True, "coarser")
        )
    assert coarser.identical(by_default)


@pytest.mark.parametrize("n", SIZES)
def test_asperities_run_in(n: int) -> None:
    """Worn volume is alpha times the dissipated energy at each block, and asperities flatten."""
    made, W = contact(n, "like")
    path = fret.LoadPath.start().normal(W, increments=1)
    path = path.tangential(np.array([1.0, -1.0, 1.0]) * 0.5 * MU * W, increments=3)
    alphas = (1e-14, 2e-14)
    laws = {f"body{k + 1}": fret.wear.DissipatedEnergy(alpha=a) for k, a in enumerate(alphas)}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        worn = fret.wear.solve(made, path=path, cycles=2e5, progress=False, **laws)
    d, cell = worn.dataset, made.grid.dx * made.grid.dy
    assert d.sizes["jump"] >= 3
    for k, alpha in enumerate(alphas):
        volume = d[f"volume{k + 1}"].values
        assert volume == pytest.approx(alpha * d.dissipated.values, rel=1e-6)
        blocks = np.isin(d.cycles.values, d.block_cycles.values)
        fields = d[f"worn{k + 1}"].values.sum(axis=(1, 2)) * cell
        assert fields == pytest.approx(volume[blocks], rel=1e-6)
    assert float(d.contact_area[-1]) > 1.1 * float(d.contact_area[0])
