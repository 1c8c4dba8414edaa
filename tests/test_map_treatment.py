"""Measured maps: form, filters, resampling, parameters, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

import pyfret as fret

SPACING = 2e-6


def points(n: int = 48) -> tuple[np.ndarray, np.ndarray]:
    """Coordinates of the points of a square map [m]."""
    x = SPACING * (np.arange(n) - 0.5 * (n - 1))
    return x[:, None], x[None, :]


@pytest.mark.parametrize("form", ["plane", "sphere", "paraboloid", "cubic"])
def test_a_form_that_is_there_is_found_and_removed(form: str) -> None:
    """The heights of a tilted ball: nothing is left of them but by a plane."""
    x, y = points()
    R = 8e-3
    z = 3e-7 + 1e-3 * x - 2e-3 * y - (x**2 + y**2) / (2 * R)
    surface = fret.SurfaceMap(z, spacing=SPACING)
    fitted = surface.fit_form(form)
    assert fitted.slopes == pytest.approx((1e-3, -2e-3), rel=1e-6)
    if form == "plane":
        assert fitted.radii == (np.inf, np.inf)
        assert fitted.explained == pytest.approx(0.0, abs=1e-9)
    else:
        assert fitted.radii == pytest.approx((R, R), rel=1e-6)
        assert fitted.explained == pytest.approx(1.0, abs=1e-9)
        assert np.abs(surface.level(form).values).max() < 1e-9 * np.ptp(z)


def test_summary_names_a_ball_and_its_radius() -> None:
    """Heights with the curvature of the ball differ from a flat sample."""
    x, y = points()
    rough = 1e-8 * np.random.default_rng(0).standard_normal((48, 48))
    ball = fret.SurfaceMap(rough - (x**2 + y**2) / (2 * 5e-3), spacing=SPACING)
    assert "sphere of R = 5" in ball.summary()
    assert "Sphere(R=" in ball.summary()
    flat = fret.SurfaceMap(rough + 1e-3 * x, spacing=SPACING)
    assert "sphere" not in flat.summary()
    assert "S_q 10" in flat.summary()


@pytest.mark.parametrize("along", [0, 1])
def test_a_filter_passes_half_of_a_wave_at_its_cut_off(along: int) -> None:
    """ISO 16610-21: the transmission of a wave is exp(-pi (alpha cut_off/wavelength)^2)."""
    n, wavelength = 256, 32 * SPACING
    x = points(n)[along] + np.zeros((n, n))
    wave = fret.SurfaceMap(1e-7 * np.cos(2 * np.pi * x / wavelength), spacing=SPACING)
    middle = (slice(96, 160), slice(96, 160))
    for ratio in (0.5, 1.0, 2.0):
        passed = wave.filter(short=ratio * wavelength)
        expected = np.exp(-np.log(2) * ratio**2)
        transmission = passed.values[middle] / wave.values[middle]
        assert np.median(transmission) == pytest.approx(expected, rel=2e-3)
        removed = wave.filter(long=ratio * wavelength)
        assert removed.values == pytest.approx(wave.values - passed.values, abs=1e-20)


def test_filters_refuse_a_cut_off_without_effect() -> None:
    """A cut-off below two points, or beyond the map, or the wrong way round."""
    surface = fret.SurfaceMap(np.eye(32), spacing=SPACING)
    with pytest.raises(ValueError, match="two points"):
        surface.filter(short=1e-6)
    with pytest.raises(ValueError, match="must be below"):
        surface.filter(short=2e-5, long=1e-5)
    with pytest.raises(ValueError, match="needs short"):
        surface.filter()


@pytest.mark.parametrize("factor", [2, 3, 0.5])
def test_resampled_heights_are_those_of_the_waves(factor: float) -> None:
    """Waves of a cosine series are exact between the points; the size of the map stays."""
    n = 32
    side = n * SPACING
    waves = [(1, 2, 3e-8), (5, 0, 2e-8), (3, 4, 1e-8)]

    def heights(count: int) -> np.ndarray:
        u = (np.arange(count) + 0.5) / count
        return sum(
            a * np.cos(np.pi * i * u)[:, None] * np.cos(np.pi * j * u)[None, :] for i, j, a in waves
        )

    resampled = fret.SurfaceMap(heights(n), spacing=SPACING).resample(n=int(factor * n))
    assert resampled.spacing == pytest.approx((side / (factor * n),) * 2)
    assert resampled.values == pytest.approx(heights(int(factor * n)), abs=1e-20)
    again = resampled.resample(spacing=SPACING)
    assert again.values == pytest.approx(heights(n), abs=1e-20)


def test_statistics_are_those_of_the_standard() -> None:
    """A sine along x: S_q = a/sqrt 2, S_a = 2 a/pi, S_ku = 3/2, slope a k/sqrt 2."""
    n, a = 512, 1e-7
    k = 2 * np.pi / (64 * SPACING)
    x = SPACING * np.arange(n)
    z = np.tile(a * np.sin(k * x)[:, None], (1, 16))
    fitted = fret.SurfaceMap(z, spacing=SPACING).statistics()
    assert fitted.S_q == pytest.approx(a / np.sqrt(2), rel=1e-6)
    assert fitted.S_a == pytest.approx(2 * a / np.pi, rel=1e-3)
    assert fitted.S_z == pytest.approx(2 * a, rel=1e-3)
    assert fitted.S_sk == pytest.approx(0.0, abs=1e-9)
    assert fitted.S_ku == pytest.approx(1.5, rel=1e-6)
    assert fitted.S_dq == pytest.approx(a * k / np.sqrt(2), rel=3e-3)


def test_a_spectrum_has_the_height_of_the_map() -> None:
    """The integral of the density over all wave vectors is S_q^2 (C_iso: 2 pi q dq/(2 pi)^2)."""
    rng = np.random.default_rng(3)
    surface = fret.SurfaceMap(1e-8 * rng.standard_normal((128, 128)), spacing=SPACING)
    psd = surface.filter(short=2e-5).spectrum()
    variance = np.trapezoid(psd.values * psd.q.values, psd.q.values) / (2 * np.pi)
    assert psd.attrs["units"] == "m^4"
    assert variance == pytest.approx(surface.filter(short=2e-5).rms ** 2, rel=0.2)


def test_heights_are_drawn() -> None:
    """The axes of a map are in um, and its S_q stands beside the scale of colours."""
    surface = fret.SurfaceMap(np.random.default_rng(1).normal(size=(24, 16)), spacing=SPACING)
    ax = surface.plot()
    assert "x" in ax.get_xlabel()
    labels = [inset.get_ylabel() for inset in ax.child_axes]
    assert any("S_q" in label for label in labels)
    assert ax.get_title("left") == ""
    assert ax.get_xlim()[1] == pytest.approx(24.0)
