"""The contacts that every program solves, Hertz's closed form, and how wrong a pressure is.

A steel sphere, smooth or with waves, on a steel half-space under a given force, in one increment,
without friction and without images. Only NumPy is needed, so that each program can be judged where
it runs, all by the same measure.
"""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Field = NDArray[np.float64]

#: Radius of the sphere [m], normal force [N], Young's modulus [Pa] and Poisson's ratio of both.
R, W, E, NU = 0.018, 1e3, 210e9, 0.3

#: Contact modulus [Pa], contact radius [m], peak pressure [Pa], approach [m]: K. L. Johnson,
#: Contact Mechanics (1985), section 4.2.
E_STAR = E / (1 - NU**2) / 2
A = (3 * W * R / (4 * E_STAR)) ** (1 / 3)
P0 = 3 * W / (2 * np.pi * A**2)
APPROACH = A**2 / R


class Shape(NamedTuple):
    """The sphere and the waves on it, one along x and one along y."""

    #: Width of the square grid [m].
    width: float
    #: Height of a crest above the mean, length and phase at the origin of a wave [m], [m], [rad].
    amplitude: float = 0.0
    wavelength: float = 1.0
    phase: float = 0.0
    #: Root mean square of a self-affine roughness [m], its shortest wave as a part of the width.
    rms: float = 0.0
    shortest: float = 1 / 64

    @property
    def is_smooth(self) -> bool:
        """Whether the answer is Hertz's."""
        return self.amplitude == 0 and self.rms == 0


#: Without waves the answer is Hertz's, which a program may well start from. The waves part the rim
#: of the contact into spots; nothing is symmetric, and no program knows the answer. The roughness
#: parts all of it; its waves are the same on every grid.
SHAPES = {
    "hertz": Shape(2.4 * A),
    "wavy": Shape(3.0 * A, amplitude=0.03 * APPROACH, wavelength=0.25 * A, phase=1.0),
    #: Hundreds of spots: the contact of a machined ball.
    "rough": Shape(4.0 * A, rms=0.05 * APPROACH),
}


def positions(shape: Shape, n: int) -> Field:
    """Middles of the cells along one side [m]."""
    x: Field = (np.arange(n, dtype=np.float64) - (n - 1) / 2) * (shape.width / n)
    return x


def squared_radius(shape: Shape, n: int) -> Field:
    """Squared distance of the cells' middles from the axis [m^2], shape (n, n)."""
    x = positions(shape, n)
    square: Field = x[:, None] ** 2 + x[None, :] ** 2
    return square


@functools.cache
def roughness(shape: Shape, n: int) -> Field:
    """Heights of the roughness in the middles of the cells [m]: Hurst exponent 0.8, no image."""
    most = round(1 / shape.shortest)
    rng = np.random.default_rng(1)
    k = np.arange(-most, most + 1)
    size = np.hypot(k[:, None], k[None, :])
    amplitude = np.where((size > 0) & (size <= most), np.maximum(size, 4.0) ** -1.8, 0.0)
    phases = rng.uniform(0, 2 * np.pi, amplitude.shape)
    factors = amplitude * np.exp(1j * phases)
    waves = np.exp(2j * np.pi * np.outer(positions(shape, n) / shape.width, k))
    z: Field = (waves @ factors @ waves.T).real
    scaled: Field = shape.rms * z / np.sqrt(0.5 * np.sum(amplitude**2))
    return scaled


def gap(shape: Shape, n: int) -> Field:
    """Gap between the undeformed surfaces [m], up to a constant."""
    h: Field = squared_radius(shape, n) / (2 * R)
    if shape.rms > 0:
        h -= roughness(shape, n)
    if shape.amplitude > 0:
        wave = np.cos(2 * np.pi * positions(shape, n) / shape.wavelength + shape.phase)
        h -= shape.amplitude * (wave[:, None] + wave[None, :])
    return h


def pressure(shape: Shape, n: int) -> Field:
    """Hertz's pressure in the middles of the cells [Pa]."""
    inside: Field = P0 * np.sqrt(np.maximum(0.0, 1 - squared_radius(shape, n) / A**2))
    return inside


def displacement(p: Field, width: float) -> Field:
    """Normal displacement under a pressure that is constant on each cell [m].

    A. E. H. Love, Phil. Trans. R. Soc. A 228 (1929) 377: the integral of 1/r over a rectangle from
    the function x arsinh(y/abs(x)) + y arsinh(x/abs(y)) of its corners.
    """
    n = len(p)
    d = width / n
    # 0, 1, ... n - 1, -n, ... -1: the order of the transforms.
    offset = np.roll(np.arange(-n, n, dtype=np.float64), n)
    lower, upper = (offset - 0.5) * d, (offset + 0.5) * d

    def corner(x: Field, y: Field) -> Field:
        x, y = np.meshgrid(x, y, indexing="ij")
        value: Field = x * np.arcsinh(y / abs(x)) + y * np.arcsinh(x / abs(y))
        return value

    coefficients = (
        corner(upper, upper) - corner(lower, upper) - corner(upper, lower) + corner(lower, lower)
    ) / (np.pi * E_STAR)
    spectrum = np.fft.rfft2(coefficients) * np.fft.rfft2(p, s=(2 * n, 2 * n))
    u: Field = np.fft.irfft2(spectrum, s=(2 * n, 2 * n))[:n, :n]
    return u


def judge(p: Field, shape: Shape) -> dict[str, float]:
    """How wrong a pressure [Pa] is: against the equations, and against the closed form."""
    n = len(p)
    cell = (shape.width / n) ** 2
    contact = p > 0
    h = displacement(p, shape.width) + gap(shape, n)
    h -= h[contact].mean()
    overlap = max(0.0, -float(h[~contact].min()))
    found = {
        "balance": abs(float(p.sum()) * cell / W - 1),
        "residual": max(float(np.sqrt(np.mean(h[contact] ** 2))), overlap) / APPROACH,
    }
    if not shape.is_smooth:
        return found
    exact = pressure(shape, n)
    return found | {
        "error_p": float(np.linalg.norm(p - exact) / np.linalg.norm(exact)),
        "error_p0": float(p.max()) / P0 - 1,
        "error_a": float(np.sqrt(contact.sum() * cell / np.pi)) / A - 1,
    }
