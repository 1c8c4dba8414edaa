"""Stress on interfaces over a cycle, and what coatings release, against closed forms."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import pyfret as fret
from conftest import T_MAX, sphere_on_flat
from conftest import W as LOAD
from pyfret import fatigue, fracture, subsurface

pytestmark = pytest.mark.solves

COATING = fret.Coating(fret.Elastic(E=300e9, nu=0.2), thickness=3e-6)


def cycled(*, ratio: float) -> fret.Result:
    """A sphere contact over one closed cycle, all increments kept."""
    path = fret.LoadPath.start().normal(LOAD, increments=2)
    path = path.tangential([T_MAX, -T_MAX, T_MAX], increments=10)
    return fret.solve(sphere_on_flat(ratio=ratio, n=24), path, save="all", progress=False)


def test_interface_over_a_cycle_is_the_largest_of_its_increments() -> None:
    result = cycled(ratio=2.0)
    Z, S = 150e6, 400e6
    interface = fracture.over_cycle(result, peel_strength=Z, shear_strength=S)
    kept = fatigue.cycle_increments(result)
    depths = result.scene.interfaces()
    below = [result.at(int(n)).stress(depths, y=0.0) for n in kept]
    peel = np.stack([s.interface_peel.values[0] for s in below])
    shear = np.stack([s.interface_shear.values[0] for s in below])
    np.testing.assert_allclose(interface.shear[0], shear.max(axis=0), rtol=1e-9)
    np.testing.assert_allclose(interface.peel[0], np.maximum(peel, 0.0).max(axis=0), rtol=1e-9)
    square = (np.maximum(peel, 0.0) / Z) ** 2 + (shear / S) ** 2
    np.testing.assert_allclose(interface.criterion[0], square.max(axis=0), rtol=1e-9)
    assert (interface.shear_amplitude <= interface.shear * (1 + 1e-12)).all()
    assert float(interface.shear.max()) > 0.0
    assert interface.z.values.tolist() == depths
    with pytest.raises(ValueError, match="peel_strength is given alone"):
        fracture.over_cycle(result, peel_strength=Z)
    with pytest.raises(ValueError, match="shear_strength = -1"):
        fracture.over_cycle(result, peel_strength=Z, shear_strength=-1.0)


def test_a_body_without_a_coating_has_no_interface() -> None:
    with pytest.raises(ValueError, match="body 2 has no coating"):
        fracture.over_cycle(cycled(ratio=1.0))


def hooke(E: float, nu: float) -> np.ndarray:
    """Normal strains of unit normal stresses, along x, y and z."""
    return (np.eye(3) * (1.0 + nu) - nu) / E


def test_edge_release_is_the_energy_that_hookes_law_gives_back() -> None:
    h, s = 3e-6, 1e9
    strains = hooke(300e9, 0.2)
    for along in (0.0, 4e8, -1e9):
        # The front runs along y: behind it no stress is left across, and the strain along it stays.
        ahead = np.array([s, along, 0.0])
        behind = np.array([0.0, (strains @ ahead)[1] / strains[1, 1], 0.0])
        released = (ahead @ strains @ ahead - behind @ strains @ behind) / 2
        assert fracture.edge_release(COATING, s) == pytest.approx(h * released, rel=1e-9)
    assert fracture.edge_release(COATING, -s) == fracture.edge_release(COATING, s)


def clamped(n: int = 400) -> tuple[float, np.ndarray, float]:
    """A plate strip of half width 1, clamped, by finite differences: load, shape, bending.

    The least eigenvalue of w'''' = -N w'', the shape with a mean of w'^2/2 of 1, and its mean of
    w''^2/2.
    """
    dx = 2.0 / n
    second = (np.eye(n - 1, k=1) - 2 * np.eye(n - 1) + np.eye(n - 1, k=-1)) / dx**2
    fourth = second @ second
    # The shape is mirrored in its clamped ends.
    fourth[[0, -1], [0, -1]] += 2 / dx**4
    values, shapes = np.linalg.eig(np.linalg.solve(-second, fourth))
    lowest = int(np.argmin(values.real))
    w = np.concatenate([[0.0], shapes[:, lowest].real, [0.0]])
    w /= np.sqrt(((np.diff(w) / dx) ** 2).mean() / 2)
    curvature = np.diff(np.concatenate([[w[1]], w, [w[-2]]]), 2) / dx**2
    weights = np.ones(n + 1)
    weights[[0, -1]] = 0.5
    return float(values[lowest].real), w, float((weights * curvature**2).sum() / n / 2)


def test_buckling_is_that_of_a_clamped_plate_by_finite_differences() -> None:
    h, s = 3e-6, 2e9
    strains = hooke(300e9, 0.2)
    # Stress along x over the strain along x, without strain along y.
    plane = 1.0 / (strains[0, 0] - strains[0, 1] ** 2 / strains[1, 1])
    D = plane * h**3 / 12
    load, w, bending = clamped()

    def stretch(b: float) -> float:
        """The mean of w'^2/2 at which membrane and bending energy of the strip are least."""
        return s / plane - D * bending / b**2 / (plane * h)

    def energy(b: float) -> float:
        """Return the energy of the buckled strip minus the flat one, per length [J/m]."""
        m = stretch(b)
        of_area = plane * h * ((s / plane - m) ** 2 - (s / plane) ** 2) / 2 + D * bending / b**2 * m
        return 2 * b * of_area

    for b in (40e-6, 60e-6, 200e-6):
        computed = fracture.buckling_release(COATING, -s, half_width=b)
        assert computed.critical_stress == pytest.approx(D * load / b**2 / h, rel=1e-4)
        deflection = np.abs(w).max() * b * np.sqrt(stretch(b))
        assert computed.deflection == pytest.approx(deflection, rel=1e-4)
        # Two fronts take up what the energy loses.
        d = 1e-4 * b
        loss = -(energy(b + d) - energy(b - d)) / (2 * d) / 2
        assert computed.release == pytest.approx(loss, rel=1e-4)
    wide = fracture.buckling_release(COATING, -s, half_width=5e-3)
    assert wide.release == pytest.approx(fracture.edge_release(COATING, s), rel=1e-4)
    narrow = fracture.buckling_release(COATING, -s, half_width=5e-6)
    assert (narrow.deflection, narrow.release) == (0.0, 0.0)
    assert fracture.buckling_release(COATING, s, half_width=5e-4).release == 0.0
    with pytest.raises(ValueError, match=r"half_width = 0.*half of the strip"):
        fracture.buckling_release(COATING, -s, half_width=0.0)
    with pytest.raises(TypeError, match="half_width"):
        fracture.buckling_release(COATING, -s, width=1e-5)  # type: ignore[call-arg]
    with pytest.raises(TypeError, match="half_width"):
        fracture.buckling_release(COATING, -s, 1e-5)  # type: ignore[misc]


def test_thermal_stress_keeps_the_coating_as_wide_as_its_substrate() -> None:
    E, nu, a_c, a_s = 300e9, 0.2, 5e-6, 12e-6
    for dT in (-400.0, 150.0):
        s = subsurface.thermal_stress(
            COATING.material, alpha_coating=a_c, alpha_substrate=a_s, temperature_change=dT
        )
        # Free expansion and Hooke's law in both directions: both strain as the substrate.
        assert a_c * dT + (s - nu * s) / E == pytest.approx(a_s * dT, rel=1e-12)
    cooled = subsurface.thermal_stress(
        COATING.material, alpha_coating=a_c, alpha_substrate=a_s, temperature_change=-400.0
    )
    assert cooled < 0.0
    with pytest.raises(ValueError, match="rigid"):
        subsurface.thermal_stress(
            fret.RIGID, alpha_coating=a_c, alpha_substrate=a_s, temperature_change=1.0
        )
    with pytest.raises(ValueError, match="alpha_coating = nan"):
        subsurface.thermal_stress(
            COATING.material, alpha_coating=np.nan, alpha_substrate=a_s, temperature_change=1.0
        )
    # By materials.
    table = fatigue.Materials()
    steel, alumina = table["steel_4340"], table["alumina"]
    by_name = subsurface.thermal_stress(alumina, alpha_substrate=steel, temperature_change=-100.0)
    assert by_name == pytest.approx(416e9 / (1 - 0.231) * (12.3e-6 - 7.4e-6) * -100.0, rel=1e-12)
    # Of TiN by its crystal's constants (Kim et al. 1992), averaged after Voigt, Reuss and Hill.
    c_11, c_12, c_44 = 625.0, 165.0, 163.0
    K = (c_11 + 2 * c_12) / 3
    G = (c_11 - c_12 + 3 * c_44) / 10
    G += 2.5 * (c_11 - c_12) * c_44 / (4 * c_44 + 3 * (c_11 - c_12))
    assert table["TiN"].number("nu") == pytest.approx((3 * K - 2 * G) / (6 * K + 2 * G), abs=5e-3)
    film = [("E", 400e9, "here"), ("alpha_T", 7e-6, "here")]
    with pytest.raises(ValueError, match=r"film`\.nu: is missing .Poisson"):
        subsurface.thermal_stress(
            fatigue.Material("film", film), alpha_substrate=steel, temperature_change=-100.0
        )
    with pytest.raises(ValueError, match="alpha_coating is missing"):
        subsurface.thermal_stress(COATING.material, alpha_substrate=steel, temperature_change=1.0)


def test_residual_stress_is_part_of_every_stress() -> None:
    now = cycled(ratio=2.0).at(-1)
    depths = [0.0, *now.scene.interfaces()]
    given_values = [-5e8, 1e8]
    for position in ({"y": 0.0}, {"x": 1e-5}, {"x": 1e-5, "y": 0.0}, {}):
        without, with_it = (
            now.stress(depths, **position),
            now.stress(depths, residual=given_values, **position),
        )
        of_depth = np.array(given_values)[without.dataset.layer.values]
        for name in ("s_xx", "s_yy"):
            change = (with_it.measure(name) - without.measure(name)).values
            expected = np.broadcast_to(of_depth.reshape(-1, *[1] * (change.ndim - 1)), change.shape)
            np.testing.assert_allclose(change, expected, atol=10.0)
        for name in ("s_zz", "s_xy", "s_xz", "s_yz"):
            np.testing.assert_array_equal(with_it.measure(name), without.measure(name))
    with pytest.raises(ValueError, match="one for each of the 2 layers"):
        now.stress(depths, y=0.0, residual=[1e8])
    with pytest.raises(ValueError, match=r"residual\[1\] = NaN"):
        now.stress(depths, y=0.0, residual=[1e8, np.nan])


def test_residual_stress_is_part_of_envelopes_and_volumes(tmp_path: Path) -> None:
    result = cycled(ratio=2.0)
    depths = [0.0, *result.scene.interfaces()]
    given_values = [-5e8, 1e8]
    item = ("s_xx", "s_zz", "von_mises")
    without, with_it = (
        result.envelope(depths, y=0.0, of=item, residual=r) for r in (None, given_values)
    )
    of_depth = np.array(given_values)[without.layer.values][:, None]
    for kind in ("max", "min", "mean"):
        change = (with_it[f"s_xx_{kind}"] - without[f"s_xx_{kind}"]).values
        np.testing.assert_allclose(change, np.broadcast_to(of_depth, change.shape), atol=10.0)
    xr.testing.assert_equal(with_it.s_zz_max, without.s_zz_max)
    histories = (
        result.at(int(n)).stress(depths, y=0.0, residual=given_values) for n in saved(result)
    )
    mises = np.max([item.von_mises.values for item in histories], axis=0)
    np.testing.assert_allclose(with_it.von_mises_max, mises, rtol=1e-9)
    now = result.at(-1)
    now.write_volume(tmp_path / "pressed.zarr", depths, of=item, residual=given_values)
    stored = xr.open_zarr(tmp_path / "pressed.zarr", chunks=None)
    planes = now.stress(depths, residual=given_values)
    # Of the two values on the interface the volume has the one of the coating.
    for name in item:
        np.testing.assert_allclose(stored[name], planes.measure(name)[:2], rtol=1e-9, atol=1.0)
    with pytest.raises(ValueError, match="one for each of the 2 layers"):
        now.write_volume(tmp_path / "other.zarr", depths, residual=[1e8])
    assert not (tmp_path / "other.zarr").exists()


def saved(result: fret.Result) -> list[int]:
    return [int(n) for n in result.dataset.saved_increment.values]
