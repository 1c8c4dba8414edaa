"""Closed forms of partial slip worn until nothing changes.

W and the amplitude of T are constant, the bodies alike with nu = 0. The contact has shrunk to
Cattaneo's stick zone of the half-width c, which is unworn (V. L. Popov, Sci. Rep. 4 (2014) 3749):
its pressure is that of a Hertz contact of the half-width c and of a flat punch that carries the
rest of W. Lengths are over Hertz's a, pressures over p0, depths over a^2/R, worn volumes over
a^4/R (sphere) or a^3/R (cylinder, per length). `amplitude` is T/(mu W), between 0 and 1; x is the
distance from the middle.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from functools import cached_property
from typing import TYPE_CHECKING, ClassVar

import numpy as np

if TYPE_CHECKING:
    from validation.truth import Array

#: Points across the worn ring: its volume is off by 1e-8.
POINTS = 20001


class Worn(ABC):
    """What both contacts have in common."""

    #: Of the half-width, to which the force of a Hertz contact grows.
    power: ClassVar[int]

    def __init__(self, amplitude: float) -> None:
        self.amplitude = amplitude

    @property
    def c(self) -> float:
        """Half-width of the stick zone, Cattaneo's (1 - T/(mu W))^(1/power)."""
        return float((1 - self.amplitude) ** (1 / self.power))

    @property
    def punch(self) -> float:
        """Pressure of the flat punch that carries the rest of W, times (c^2 - x^2)^(1/2).

        Of a sphere 1 - c^3 of W = 2 pi a^2 p0/3 as P/(2 pi c) (c^2 - x^2)^(-1/2), of a cylinder
        1 - c^2 of W = pi a p0/2 as P/pi (c^2 - x^2)^(-1/2).
        """
        return (1 - self.c**self.power) / (self.power * self.c ** (self.power - 2))

    @abstractmethod
    def overlap(self, x: Array) -> Array:
        """By how much the unworn surfaces would overlap at x >= c; < 0 is a gap."""

    @abstractmethod
    def measure(self, x: Array) -> Array:
        """Area of the ring at x, over its width."""

    def p(self, x: Array) -> Array:
        """Pressure, 0 outside c."""
        inside = np.abs(x) < self.c
        root = np.sqrt(np.where(inside, self.c**2 - x**2, 1.0))
        return np.where(inside, root + self.punch / root, 0.0)

    def depth(self, x: Array) -> Array:
        """Depth worn off both bodies together."""
        x = np.abs(x)
        outside = np.maximum(self.overlap(np.maximum(x, self.c)), 0.0)
        return np.where(x > self.c, outside, 0.0)

    @cached_property
    def b(self) -> float:
        """Half-width of the worn region."""
        low, high = 1.0, 4.0
        for _ in range(60):
            middle = 0.5 * (low + high)
            worn = self.overlap(np.array([middle]))[0] > 0
            low, high = (middle, high) if worn else (low, middle)
        return low

    @cached_property
    def ring(self) -> tuple[Array, Array]:
        """Points from c to b, dense at both ends, and the depth there."""
        x = self.c + (self.b - self.c) * np.sin(np.linspace(0, np.pi / 2, POINTS)) ** 2
        return x, self.depth(x)

    @property
    def deepest(self) -> float:
        """Largest depth."""
        return float(self.ring[1].max())

    @property
    def volume(self) -> float:
        """Worn volume."""
        x, depth = self.ring
        return float(np.trapezoid(self.measure(x) * depth, x))


class WornSphere(Worn):
    """A sphere on a flat."""

    power = 3

    @property
    def approach(self) -> float:
        """Approach: c^2 of the sphere and 2 (1 - c^3)/(3 c) of the punch."""
        return 2 / (3 * self.c) + self.c**2 / 3

    def overlap(self, x: Array) -> Array:
        """Approach less the surface displacement (Abel transforms) and x^2/2."""
        t = self.c / x
        angle = np.arcsin(t)
        of_sphere = x**2 / 2 * (angle - t * np.sqrt(1 - t**2))
        return 2 / np.pi * (of_sphere + self.approach * (np.pi / 2 - angle)) - x**2 / 2

    def measure(self, x: Array) -> Array:
        """Circumference."""
        return 2 * np.pi * x


class WornCylinder(Worn):
    """A cylinder on a flat, plane strain."""

    power = 2

    def overlap(self, x: Array) -> Array:
        """Minus the gap, whose slope is [(x^2 - c^2)^(1/2) - (1 - c^2)/2 (x^2 - c^2)^(-1/2)]."""
        return 0.5 * (np.arccosh(x / self.c) - x * np.sqrt(x**2 - self.c**2))

    def measure(self, x: Array) -> Array:
        """Both sides."""
        return np.full_like(x, 2.0)
