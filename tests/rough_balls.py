"""Self-affine balls on a flat of the same steel, the same numbers on every machine."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import pyfret as fret

R, E, NU = 8e-3, 210e9, 0.3
MODULUS = E / (2 * (1 - NU**2))
FILE = Path(__file__).parent / "data" / "rough_balls.json"
ROWS: list[dict[str, Any]] = json.loads(FILE.read_text(encoding="utf-8"))["rows"]


def surface(seed: int, n: int = 128) -> tuple[NDArray[np.float64], float, float]:
    """Heights [m], pitch [m], force of a smooth ball of a contact radius of n pitch/4 [N]."""
    rng = np.random.default_rng(seed)
    s_q, hurst = 10 ** rng.uniform(np.log10(0.05e-6), -6), rng.uniform(0.5, 0.9)
    pitch = 10 ** rng.uniform(np.log10(0.5e-6), np.log10(4e-6))
    k = np.hypot(np.fft.fftfreq(n)[:, None], np.fft.fftfreq(n)[None, :])
    k[0, 0] = 1
    roll_off = rng.uniform(0.01, 0.05)
    white = np.fft.fft2(rng.standard_normal((n, n)))
    z = np.fft.ifft2(white * np.maximum(k, roll_off) ** -(1 + hurst)).real
    z = (z - z.mean()) * s_q / z.std()
    radius = 0.25 * n * pitch
    return z, pitch, 4 * MODULUS * radius**3 / (3 * R)


def band_limited(
    seed: int, n: int, shortest: float = 1 / 8
) -> tuple[NDArray[np.float64], float, float]:
    """Heights with waves of 1/`shortest` points or more; slopes of a ground surface."""
    rng = np.random.default_rng(seed)
    pitch = 10 ** rng.uniform(np.log10(0.5e-6), np.log10(4e-6)) * 128 / n
    hurst, s_q = rng.uniform(0.5, 0.9), 10 ** rng.uniform(-8, -7) * pitch * n / 1e-4
    waves_each_way = round(128 * shortest)
    k = np.arange(-waves_each_way, waves_each_way + 1)
    size = np.hypot(k[:, None], k[None, :])
    amplitude = np.where(
        (size > 0) & (size <= waves_each_way), np.maximum(size, 3.0) ** -(1 + hurst), 0.0
    )
    factors = amplitude * np.exp(2j * np.pi * rng.random(amplitude.shape))
    u = (np.arange(n) + 0.5) / n
    waves = np.exp(2j * np.pi * np.outer(u, k))
    z = (waves @ factors @ waves.T).real
    z *= s_q / np.sqrt(0.5 * np.sum(amplitude**2))
    radius = 0.25 * n * pitch
    return z, pitch, 4 * MODULUS * radius**3 / (3 * R)


def scene(
    z: NDArray[np.float64], pitch: float, *, friction: float = 0.0, nu: float = NU, **parts: Any
) -> fret.Scene:
    """The ball with these heights on the flat."""
    steel = fret.Elastic(E=E, nu=nu)
    rough = fret.SurfaceMap(z, spacing=pitch)
    return fret.Scene(
        body1=fret.Body(steel, shape=fret.Sphere(R=R) + rough),
        body2=fret.Body(steel),
        friction=friction,
        grid=fret.Grid.from_spacing(z.shape, (pitch, pitch)),
        **parts,
    )
