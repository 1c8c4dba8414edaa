"""Responses of a body, from Python."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import pyfret as fret

STEEL = fret.Elastic(E=210e9, nu=0.3)
HARD = fret.Elastic(E=840e9, nu=0.25)
COATED = fret.Body(STEEL, coatings=[fret.Coating(HARD, thickness=3e-5)])
GRID = fret.Grid.from_spacing((6, 9), (1e-5, 2e-5))


def test_the_response_of_a_half_space_is_its_closed_form() -> None:
    k_x, k_y = np.array([[3e4], [-1e5]]), np.array([2e4, 0.0, -7e4])
    frf = fret.kernels.surface_frf(fret.Body(STEEL), k_x, k_y)
    assert frf.shape == (2, 3, 3, 3)
    k = np.hypot(k_x, k_y)
    np.testing.assert_allclose(frf[..., 2, 2], (1 - STEEL.nu) / (STEEL.G * k), rtol=1e-13)
    coupling = 1j * k_x * (1 - 2 * STEEL.nu) / (2 * STEEL.G * k**2)
    np.testing.assert_allclose(frf[..., 0, 2], coupling, rtol=1e-12)


def test_a_layer_thick_or_thin_against_the_wave_is_a_half_space() -> None:
    short, long = (fret.kernels.surface_frf(COATED, k, 0.0)[2, 2].real * k for k in (1e7, 1e-2))
    assert short == pytest.approx((1 - HARD.nu) / HARD.G, rel=1e-12)
    assert long == pytest.approx((1 - STEEL.nu) / STEEL.G, rel=1e-5)


def test_coefficients_are_reciprocal_and_have_their_parity() -> None:
    C = fret.kernels.influence_coefficients(COATED, GRID)
    assert C.shape == (3, 3, 11, 17)
    assert np.unravel_index(C[2, 2].argmax(), C.shape[2:]) == (5, 8)
    np.testing.assert_allclose(C, C.transpose(1, 0, 2, 3)[:, :, ::-1, ::-1], atol=1e-12 * C.max())
    np.testing.assert_allclose(C[0, 1], -C[0, 1, ::-1], atol=1e-12 * C.max())
    np.testing.assert_allclose(C[0, 1], -C[0, 1, :, ::-1], atol=1e-12 * C.max())
    assert C[0, 2, 8, 8] != 0.0


def test_coefficients_are_what_the_operator_convolves_with() -> None:
    C = fret.kernels.influence_coefficients(COATED, GRID)
    rigid = fret.Body(fret.RIGID)
    operator = fret.SurfaceOperator(rigid, COATED, GRID)
    loaded = (2, 5)
    for column, name in enumerate(("q_x", "q_y", "p")):
        field = np.zeros((GRID.nx, GRID.ny))
        field[loaded] = 1.0
        u = operator.displacement(**{name: field})
        x, y = (n - 1 - i for n, i in zip((GRID.nx, GRID.ny), loaded, strict=True))
        expected = C[:, column, x : x + GRID.nx, y : y + GRID.ny]
        np.testing.assert_allclose(u, expected, atol=1e-12 * C.max())


def test_stress_at_a_point_is_an_entry_of_the_coefficients() -> None:
    z = 4e-5
    S = fret.kernels.stress_coefficients(COATED, GRID, z)
    assert S.shape == (6, 3, 11, 17)
    for a, b in ((5, 8), (8, 3), (0, 16)):
        offset = ((a - 5) * GRID.dx, (b - 8) * GRID.dy, z)
        stress = fret.kernels.stress_at(COATED, (GRID.dx, GRID.dy), offset)
        np.testing.assert_allclose(S[:, :, a, b], stress, atol=1e-8)


def test_the_surface_carries_what_acts_on_it() -> None:
    stress = fret.kernels.stress_at(COATED, (2e-5, 2e-5), (0.0, 0.0, 0.0))
    rows = dict(zip(("xx", "yy", "zz", "xy", "xz", "yz"), stress, strict=True))
    np.testing.assert_allclose(rows["zz"], [0, 0, -1], atol=1e-9)
    np.testing.assert_allclose(rows["xz"], [-1, 0, 0], atol=1e-9)
    np.testing.assert_allclose(rows["yz"], [0, -1, 0], atol=1e-9)


def test_interfaces_carry_traction_and_strain_alike() -> None:
    h = COATED.coatings[0].thickness
    coat, base = (
        fret.kernels.stress_at(COATED, (2e-5, 2e-5), (1e-5, 2e-5, h), layer=layer)
        for layer in (0, 1)
    )
    np.testing.assert_allclose(coat[[2, 4, 5]], base[[2, 4, 5]], atol=1e-8)

    def strain(s: np.ndarray, material: fret.Elastic) -> np.ndarray:
        along_x = s[0] - material.nu * (s[1] + s[2])
        along_y = s[1] - material.nu * (s[0] + s[2])
        return np.array([along_x, along_y, (1 + material.nu) * s[3]]) / material.E

    scale = np.abs(base).max() / STEEL.E
    np.testing.assert_allclose(strain(coat, HARD), strain(base, STEEL), atol=1e-7 * scale)
    assert np.abs(coat[0] - base[0]).max() > 0.05


def test_a_response_of_ones_own_is_converted_as_the_paper_does() -> None:
    """First order in the enlargement: each doubling halves the error at least."""
    exact = fret.kernels.influence_coefficients(COATED, GRID)[2, 2]

    def error(enlargement: int) -> float:
        own_values = fret.kernels.convert(
            lambda k_x, k_y: fret.kernels.surface_frf(COATED, k_x, k_y),
            GRID,
            enlargement=enlargement,
            aliases=2,
        )
        return float(np.abs(own_values[2, 2] - exact).max() / exact.max())

    coarse, fine = error(4), error(8)
    assert fine < 0.55 * coarse
    assert fine < 0.02


def test_a_response_of_another_shape_is_refused() -> None:
    with pytest.raises(ValueError, match="one matrix per wave vector"):
        fret.kernels.convert(lambda k_x, k_y: np.ones((5, 3, 3), dtype=complex), GRID)


@pytest.mark.parametrize(
    "grid",
    [fret.Grid.strip(extent=2e-4, n=24), fret.Grid.from_spacing((12, 9), (1e-5, 2e-5))],
    ids=["line", "plane"],
)
def test_eigenstrains_and_tractions_answer_each_other_alike(grid: fret.Grid) -> None:
    """Reciprocity of a coated body: t . u[e] over the surface is sigma[t] : e over the volume."""
    layer = fret.Coating(fret.Elastic(E=400e9, nu=0.2), thickness=20e-6)
    body = fret.Body(fret.Elastic(E=210e9, nu=0.3), coatings=[layer])
    operator = fret.kernels.EigenstrainOperator(body, grid, depth=6e-5, height=1e-5)
    assert set(operator.layer) == {0, 1}
    assert (np.diff(operator.z) > 0.0).all()
    rng = np.random.default_rng(3)
    e = rng.normal(size=(operator.z.size, 6, grid.nx, grid.ny))
    t = rng.normal(size=(3, grid.nx, grid.ny))
    _, u = operator.apply(e)
    stress, _ = operator.apply(q_x=t[0], q_y=t[1], p=t[2])
    twice = np.array([1.0, 1.0, 1.0, 2.0, 2.0, 2.0])[:, None, None]
    parts = stress * e * twice * operator.weights[:, None, None, None]
    assert abs((u * t).sum() - parts.sum()) < 1e-10 * np.abs(parts).sum()


def test_a_uniform_thermal_strain_of_a_layer_presses_it() -> None:
    """A heated layer, 128 times as wide as thick, is under -E alpha dT/(1 - nu) along x and y."""
    E, nu, strain = 210e9, 0.3, 1e-3
    grid = fret.Grid.centred(width=64e-6, n=32)
    operator = fret.kernels.EigenstrainOperator(
        fret.Body(fret.Elastic(E=E, nu=nu)), grid, depth=5e-7, height=2.5e-7
    )
    e = np.zeros((operator.z.size, 6, 32, 32))
    e[operator.z < 5e-7, :3] = strain
    stress, _ = operator.apply(e)
    middle = stress[0, :, 15, 15]
    biaxial = -E * strain / (1.0 - nu)
    np.testing.assert_allclose(middle[:2], biaxial, rtol=0.03)
    assert abs(middle[2]) < 0.03 * abs(biaxial)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"depth": 0.0}, "depth"),
        ({"height": float("nan")}, "height"),
        ({"height": 1e-12}, "height"),
        ({"body": fret.Body(fret.RIGID)}, "E"),
    ],
)
def test_an_eigenstrain_operator_without_meaning_is_refused(
    change: dict[str, Any], message: str
) -> None:
    """Lengths that are none, and a rigid body."""
    arguments = {
        "body": fret.Body(fret.Elastic(E=210e9, nu=0.3)),
        "grid": fret.Grid.centred(width=1e-4, n=8),
        "depth": 2e-5,
        "height": 1e-5,
    }
    with pytest.raises(ValueError, match=message):
        fret.kernels.EigenstrainOperator(**{**arguments, **change})
    operator = fret.kernels.EigenstrainOperator(**arguments)
    with pytest.raises(ValueError, match="eigenstrain has the shape"):
        operator.apply(np.zeros((1, 6, 8, 8)))
    with pytest.raises(ValueError, match="must be a finite number"):
        operator.apply(p=np.full((8, 8), np.inf))
