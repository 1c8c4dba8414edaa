"""Conditions that hold in every cell and increment, for all bodies."""

from __future__ import annotations

import numpy as np
import pytest

import pyfret as fret
from conftest import MU, TOLERANCE, W, paper_path, sphere_on_flat


def test_forces_balance(coated: fret.Result) -> None:
    d = coated.dataset
    for i, area in enumerate([coated.scene.grid.cell_area] * d.sizes["saved"]):
        fields = d.isel(saved=i)
        loads = d.sel(increment=int(fields.saved_increment))
        assert float(fields.p.sum()) * area == pytest.approx(float(loads.W), rel=1e-9)
        assert float(fields.q_x.sum()) * area == pytest.approx(float(loads.T_x), abs=1e-9 * MU * W)
        assert float(fields.q_y.sum()) * area == pytest.approx(0.0, abs=1e-9 * MU * W)


def test_complementarity_and_coulomb(coated: fret.Result) -> None:
    d = coated.dataset
    contact = d.contact.values.astype(bool)
    stick = d.stick.values.astype(bool)
    p, gap = d.p.values, d.gap.values
    q = np.hypot(d.q_x.values, d.q_y.values)
    slip = contact & ~stick
    assert (p >= 0).all()
    assert (p[contact] > 0).all()
    assert (p[~contact] == 0).all()
    # Overlap is bounded in every cell, up to the rounding of u_z; the gap in the root mean square
    # over the contact, and one cell may hold all of it.
    assert (gap[~contact] >= -1.001 * TOLERANCE * coated.delta_H).all()
    largest = np.sqrt(contact.sum(axis=(1, 2)).max())
    assert np.abs(gap[contact]).max() < largest * TOLERANCE * coated.delta_H
    assert (q <= MU * p * (1 + 1e-9)).all()
    np.testing.assert_allclose(q[slip], MU * p[slip], rtol=1e-9)


def test_every_reversal_starts_in_full_stick(coated: fret.Result) -> None:
    d = coated.dataset
    turns = np.flatnonzero(np.diff(d.branch_of_increment.values))[1:] + 1
    assert (d.stick_ratio.values[turns] > 0.9).all()


def test_friction_only_takes_energy(coated: fret.Result) -> None:
    taken = coated.dissipated_energy.values
    # Slip along the shear is within the solver's tolerance.
    assert np.diff(taken, prepend=0.0).min() >= -TOLERANCE * taken[-1]


def test_energy_balances(coated: fret.Result) -> None:
    d = coated.dataset
    imbalance = (d.work - d.elastic - d.dissipated - d.opening + d.quadrature).values
    total = np.cumsum(np.abs(d.work.values))
    # The identity is algebra: what the gaps and slips within the tolerance take is left.
    assert np.abs(imbalance[1:] / total[1:]).max() < TOLERANCE


def test_both_loops_are_the_same_within_a_hundredth(coated: fret.Result) -> None:
    """The paper, figure 12: the loops of t/tau in (0.2, 0.6] and (0.6, 1] superpose."""
    d = coated.dataset
    first, second = (np.isin(d.branch_of_increment, pair) for pair in ((2, 3), (4, 5)))
    np.testing.assert_array_equal(d.T_x[first], d.T_x[second])
    shift = d.delta_x.values
    assert np.abs(shift[first] - shift[second]).max() < 0.01 * np.ptp(shift)


@pytest.mark.parametrize(("ratio", "sign"), [(0.5, -1), (2.0, 1), (4.0, 1)])
def test_the_stick_zone_moves_against_x_below_a_soft_coating(ratio: float, sign: int) -> None:
    """The paper, section 4: opposite to x for E1/E2 < 1, along x for E1/E2 > 1."""
    path = paper_path(20, 45)
    end = fret.solve(sphere_on_flat(ratio=ratio, n=48), path, progress=False).at(0.2)
    stick = end.stick.values.astype(bool)
    middle = end.x.values[stick.any(axis=1)].mean() / end.a_H
    assert sign * middle > 0.02


def test_answers_do_not_depend_on_the_mirror(coated: fret.Result) -> None:
    settings = fret.Settings(tolerance=TOLERANCE, skip=fret.settings.Skip(mirror=False))
    scene = coated.scene.replace(settings=settings)
    whole = fret.solve(scene, progress=False)
    # Waves of a few cells make of a misfit a hundred times as much traction.
    known_values = 100 * TOLERANCE * MU * coated.p_H
    np.testing.assert_allclose(whole.at(-1).q_x, coated.at(-1).q_x, atol=known_values)


def test_two_runs_are_the_same_bit_for_bit(coated: fret.Result) -> None:
    again = fret.solve(coated.scene, progress=False)
    assert again.dataset.identical(coated.dataset)


@pytest.mark.parametrize("mu", [0.05, 0.13, 0.2])
@pytest.mark.parametrize(("E", "thickness"), [(2e9, 20e-6), (20e9, 20e-6), (400e9, 5e-6)])
def test_the_state_agrees_with_the_stick_ratio(E: float, thickness: float, mu: float) -> None:
    """Pressed and sheared, layers softer and harder than the bodies: full stick is a ratio of 1."""
    R, load = 5e-3, 20.0
    steel = fret.Elastic(E=210e9, nu=0.3)
    a = fret.reference.hertz(R=R, bodies=(steel, steel), W=load).a
    film = fret.Coating(fret.Elastic(E=E, nu=0.4), thickness=thickness)
    scene = fret.Scene(
        body1=fret.Body(steel, shape=fret.Sphere(R=R)),
        body2=fret.Body(steel, coatings=[film]),
        friction=mu,
        grid=fret.Grid.centred(width=5.0 * a, n=32),
    )
    path = fret.LoadPath.start().normal(load, increments=16)
    path = path.tangential([0.6 * mu * load, -0.6 * mu * load], increments=8)
    d = fret.solve(scene, path, progress=False).dataset
    full = d.status.values == 1
    np.testing.assert_array_equal(full, d.stick_ratio.values == 1.0)
    assert full.any() or mu < 0.1
    assert (d.status.values == 2).any()
