"""The Hertz contact that every program solves, its closed form, and how wrong a pressure is.

A steel sphere on a steel half-space under a given force, without friction and without images: the
scene of ``scenes/hertz.toml`` in one increment. Only NumPy is needed, so that each program can be
judged where it runs, all by the same measure.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Field = NDArray[np.float64]

#: Radius of the sphere [m], normal force [N], Young's modulus [Pa] and Poisson's ratio of both.
R, W, E, NU = 0.018, 1e3, 210e9, 0.3
#: Width of the square grid over the contact radius.
EXTENT = 2.4

#: Contact modulus [Pa], contact radius [m], peak pressure [Pa], approach [m]: K. L. Johnson,
#: Contact Mechanics (1985), section 4.2.
E_STAR = E / (1 - NU**2) / 2
A = (3 * W * R / (4 * E_STAR)) ** (1 / 3)
P0 = 3 * W / (2 * np.pi * A**2)
APPROACH = A**2 / R


def width() -> float:
    """Width of the grid [m]."""
    return EXTENT * A


def squared_radius(n: int) -> Field:
    """Squared distance of the cells' middles from the axis [m^2], shape (n, n)."""
    x = (np.arange(n) - (n - 1) / 2) * (width() / n)
    square: Field = x[:, None] ** 2 + x[None, :] ** 2
    return square


def gap(n: int) -> Field:
    """Gap between the undeformed surfaces [m]."""
    return squared_radius(n) / (2 * R)


def pressure(n: int) -> Field:
    """Hertz's pressure in the middles of the cells [Pa]."""
    inside: Field = P0 * np.sqrt(np.maximum(0.0, 1 - squared_radius(n) / A**2))
    return inside


def displacement(p: Field) -> Field:
    """Normal displacement under a pressure that is constant on each cell [m].

    A. E. H. Love, Phil. Trans. R. Soc. A 228 (1929) 377: the integral of 1/r over a rectangle from
    the function x arsinh(y/abs(x)) + y arsinh(x/abs(y)) of its corners.
    """
    n = len(p)
    d = width() / n
    offset = np.fft.fftfreq(2 * n, 1 / (2 * n))
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


def judge(p: Field) -> dict[str, float]:
    """How wrong a pressure [Pa] is: against the equations, and against the closed form."""
    n = len(p)
    cell = (width() / n) ** 2
    exact = pressure(n)
    contact = p > 0
    h = displacement(p) + gap(n)
    h -= h[contact].mean()
    overlap = max(0.0, -float(h[~contact].min()))
    return {
        "balance": abs(float(p.sum()) * cell / W - 1),
        "residual": max(float(np.sqrt(np.mean(h[contact] ** 2))), overlap) / APPROACH,
        "error_p": float(np.linalg.norm(p - exact) / np.linalg.norm(exact)),
        "error_p0": float(p.max()) / P0 - 1,
        "error_a": float(np.sqrt(contact.sum() * cell / np.pi)) / A - 1,
    }
