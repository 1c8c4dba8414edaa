"""A ball pressed on a stack of layers without friction, by Hankel transforms: a truth of its own.

Pressure p(r) = sum_m c_m (1 - r^2/a^2)^(m + 1/2), whose transforms are Bessel functions (Gradshteyn
and Ryzhik 6.683.6), so that it ends like a root at the radius a. Displacements of a layer for the
wave number k, u_r = int U J_1(kr) k dk and u_z = int W J_0(kr) k dk:

    U = (A + B k s) e^(-ks) + (C + D k t) e^(-kt)
    W = (A + B (3 - 4 nu + k s)) e^(-ks) - (C + D (3 - 4 nu + k t)) e^(-kt)

with the depths s below the top and t above the bottom of the layer, from Navier's equations.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from scipy.optimize import brentq
from scipy.special import gamma, j0, j1, jv

#: Terms of the pressure, panels of wave numbers and nodes in each, largest wave number times a.
TERMS, PANELS, NODES, HIGHEST = 9, 60, 10, 300.0
#: Radii of samples over the contact radius, depths in a layer, and the least depth below a loaded
#: surface over the contact radius: nearer the waves that are left out count.
RADII, DEPTHS, LEAST = np.linspace(0.0, 6.0, 601), 33, 0.03


@dataclass(frozen=True)
class Layer:
    """Elastic constants [Pa, -] and thickness [m]; the last layer is infinite."""

    E: float
    nu: float
    thickness: float

    def rows(self, k: np.ndarray, z: float) -> np.ndarray:
        """U, W, s_zz, s_rz and k U + dW/dz of A, B, C and D at a depth below the top, (k, 5, 4)."""
        mu = self.E / (2.0 * (1.0 + self.nu))
        lame = self.E * self.nu / ((1.0 + self.nu) * (1.0 - 2.0 * self.nu))
        kappa = 3.0 - 4.0 * self.nu
        out = np.zeros((k.size, 5, 4))
        for first, sign, depth in ((0, 1.0, z), (2, -1.0, self.thickness - z)):
            if not np.isfinite(depth):
                continue
            decay, far = np.exp(-k * depth), k * depth
            U, dU = (1.0, far), (-sign * k, sign * k * (1.0 - far))
            W, dW = (sign, sign * (kappa + far)), (-k, k * (1.0 - kappa - far))
            for n in (0, 1):
                volume = k * U[n] + dW[n]
                rows = (U[n], W[n], lame * volume + 2 * mu * dW[n], mu * (dU[n] - k * W[n]), volume)
                for row, value in enumerate(rows):
                    out[:, row, first + n] = value * decay
        return out


class Ball:
    """A ball of radius R [m] and material (E, nu) pressed by W [N] on layers."""

    def __init__(self, R: float, ball: tuple[float, float], layers: list[Layer], W: float) -> None:
        self.layers = layers
        E_star = 1.0 / sum((1.0 - nu**2) / E for E, nu in (ball, (layers[-1].E, layers[-1].nu)))
        hertz = (0.75 * W * R / E_star) ** (1.0 / 3.0)
        self._ball = 2.0 * (1.0 - ball[1] ** 2) / ball[0]
        self.a = float(brentq(lambda a: self._pressed(a, R) - W, 0.2 * hertz, 4.0 * hertz))
        self._pressed(self.a, R)
        r = self.a * RADII
        kr = self.k[:, None] * r
        J1 = j1(kr)
        over = np.divide(J1, r, out=np.repeat(0.5 * self.k[:, None], r.size, 1), where=r > 0.0)
        self._bessel = j0(kr), J1, over

    def _waves(self) -> tuple[np.ndarray, np.ndarray]:
        """Wave numbers times a and their weights: short panels at small ones."""
        edges = HIGHEST * np.linspace(0.0, 1.0, PANELS + 1) ** 2
        x, w = np.polynomial.legendre.leggauss(NODES)
        middle, half = 0.5 * (edges[1:] + edges[:-1]), 0.5 * np.diff(edges)
        return (middle[:, None] + half[:, None] * x).ravel(), (half[:, None] * w).ravel()

    def _pressed(self, a: float, R: float) -> float:
        """Solve for the pressure on the radius a; its force."""
        waves, weights = self._waves()
        self.k, self.dk = waves / a, weights / a
        nu = np.arange(TERMS) + 0.5
        self.transforms = (
            a**2 * 2.0**nu * gamma(nu + 1) * jv(nu + 1, waves[:, None]) / waves[:, None] ** (nu + 1)
        )
        self.coefficients = self._response(self.layers)
        top = self.layers[0].rows(self.k, 0.0)
        give = np.einsum("kn,kn->k", top[:, 1], self.coefficients[:, :4]) + self._ball / self.k
        r = a * np.sin(0.5 * np.pi * (np.arange(3 * TERMS) + 0.5) / (3 * TERMS))
        kernel = j0(r[:, None] * self.k) * (give * self.k * self.dk)
        system = np.column_stack([kernel @ self.transforms, -np.ones(r.size)])
        scale = np.abs(system).max(axis=0)
        solution, *_ = np.linalg.lstsq(system / scale, -(r**2) / (2.0 * R), rcond=None)
        self.c = (solution / scale)[:TERMS]
        return float(2.0 * np.pi * a**2 * (self.c / (2.0 * nu + 2.0)).sum())

    def _response(self, layers: list[Layer]) -> np.ndarray:
        """A, B, C and D of every layer under a unit pressure of each wave number, flat."""
        size = 4 * len(layers) - 2
        system, right = np.zeros((self.k.size, size, size)), np.zeros((self.k.size, size))
        top = layers[0].rows(self.k, 0.0)
        width = min(4, size)
        system[:, 0, :width], system[:, 1, :width] = top[:, 2, :width], top[:, 3, :width]
        right[:, 0] = -1.0
        for n, (upper, lower) in enumerate(pairwise(layers)):
            rows = slice(2 + 4 * n, 6 + 4 * n)
            system[:, rows, 4 * n : 4 * n + 4] = upper.rows(self.k, upper.thickness)[:, :4]
            end = min(4 * n + 8, size)
            system[:, rows, 4 * n + 4 : end] = -lower.rows(self.k, 0.0)[:, :4, : end - 4 * n - 4]
        # Displacements and stresses are of the order 1/(E k) and 1.
        scale = np.ones((self.k.size, size))
        E = max(layer.E for layer in layers)
        for n in range(len(layers) - 1):
            scale[:, 2 + 4 * n : 4 + 4 * n] = (E * self.k)[:, None]
        unknown = 1.0 / (E * self.k)[:, None, None]
        solution = np.linalg.solve(
            system * scale[:, :, None] * unknown, (right * scale)[:, :, None]
        )
        flat = np.zeros((self.k.size, 4 * len(layers)))
        flat[:, :size] = solution[:, :, 0] * unknown[:, :, 0]
        return flat

    def stress(self, n: int, z: float) -> np.ndarray:
        """s_rr, s_tt, s_zz and s_rz [Pa] in layer n at a depth below its top, (4, RADII)."""
        layer = self.layers[n]
        own_values = self.coefficients[:, 4 * n : 4 * n + 4]
        if n > 0 or z > 0.0:
            return self._tensor(layer, own_values, z)
        # At the surface: a half-space (Johnson (3.42)) and the rest, which decays by exp(-2 k h).
        alone = self._response([replace(layer, thickness=np.inf)])
        below = RADII**2 < 1.0
        root = np.where(below, np.sqrt(np.maximum(1.0 - RADII**2, 0.0)), 0.0)
        m = np.arange(TERMS)
        p = (self.c * root[:, None] ** (2 * m + 1)).sum(axis=1)
        within = (self.c / (2 * m + 3) * (1.0 - root[:, None] ** (2 * m + 3))).sum(axis=1)
        mean = np.divide(within, RADII**2, out=np.full(p.size, 0.5 * self.c.sum()), where=RADII > 0)
        part = (1.0 - 2.0 * layer.nu) * mean
        half_space = np.array([part - p, -part - 2.0 * layer.nu * p, -p, 0.0 * p])
        remainder = self._tensor(layer, own_values - alone, 0.0)
        remainder[2:] = 0.0
        return half_space + remainder

    def _tensor(self, layer: Layer, own: np.ndarray, z: float) -> np.ndarray:
        mu = layer.E / (2.0 * (1.0 + layer.nu))
        lame = layer.E * layer.nu / ((1.0 + layer.nu) * (1.0 - 2.0 * layer.nu))
        U, _, s_zz, s_rz, volume = np.einsum("kin,kn->ik", layer.rows(self.k, z), own)
        load = (self.transforms @ self.c) * self.k * self.dk
        J0, J1, J1_over_r = self._bessel
        normal = lame * (load * volume) @ J0
        tangential = 2.0 * mu * (load * U) @ J1_over_r
        radial = 2.0 * mu * ((load * U * self.k) @ J0) - tangential
        s = [normal + radial, normal + tangential, (load * s_zz) @ J0, (load * s_rz) @ J1]
        return np.array(s)

    def largest(self, n: int, of: str) -> float:
        """The largest s_1, von Mises' stress or shear of interfaces of a layer [Pa]."""
        deep = min(self.layers[n].thickness, 2.0 * self.a)
        last = n + 1 == len(self.layers)
        depths = deep * np.linspace(0.0, 1.0, DEPTHS)
        if of == "interface_shear":
            depths = np.array([0.0] if last else [deep] if n == 0 else [0.0, deep])
        depths = depths[(depths >= LEAST * self.a) | (depths == 0.0) | (n > 0)]
        return float(max(measured(self.stress(n, z), of).max() for z in depths))


def measured(stress: np.ndarray, of: str) -> np.ndarray:
    """A measure of s_rr, s_tt, s_zz and s_rz [Pa]."""
    rr, tt, zz, rz = stress
    if of == "interface_shear":
        return np.abs(rz)
    if of == "s_1":
        in_plane = 0.5 * (rr + zz) + np.hypot(0.5 * (rr - zz), rz)
        return np.maximum(in_plane, tt)
    return np.sqrt(0.5 * ((rr - tt) ** 2 + (tt - zz) ** 2 + (zz - rr) ** 2) + 3.0 * rz**2)
