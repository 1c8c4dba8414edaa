"""Energy of a loop over its amplitude, from the loops of a table.

Loops of partial slip: the logarithm of energy/amplitude^3 is interpolated by cubic pieces. The
energy of small loops grows with amplitude^3 (R. D. Mindlin, H. Deresiewicz, J. Appl. Mech. 20
(1953) 327-344). Loops of gross slip: the contact slides over the part of the shift by which a loop
exceeds another one, so that with the range T of the force ::

    E(b) - E(a) = 2 T (b - a)

The energy is convex in the amplitude, by Masing's rule. With f the virgin curve, of decreasing
slope, ``E = 8 int_0^a f - 4 a f(a)`` has the second derivative ``-4 a f''(a) >= 0``. Where gross
slip begins between two loops, the energy thus lies below the chord, and above the line of gross
slip.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["EnergyCurve"]

#: Points on which the onset of gross slip is searched between two loops.
SEARCHED = 201


@dataclass(frozen=True)
class EnergyCurve:
    """Energy of loops over their amplitude.

    Attributes
    ----------
    amplitudes, energies : array
        Amplitudes, ascending, and energies of the loops of a table [J].
    slides : array of bool
        Loops of gross slip: they are the largest ones.
    force : float
        Range of the force of a loop of gross slip [N]; with a twist, of its moment [N m].
    """

    amplitudes: NDArray[np.float64]
    energies: NDArray[np.float64]
    slides: NDArray[np.bool_]
    force: float

    def every_second(self) -> EnergyCurve:
        """Return the curve by every second loop, the largest one among them."""
        kept = slice((self.amplitudes.size + 1) % 2, None, 2)
        return EnergyCurve(
            self.amplitudes[kept], self.energies[kept], self.slides[kept], self.force
        )

    def evaluate(
        self, amplitude: NDArray[np.float64], *, linear: bool = False
    ) -> NDArray[np.float64]:
        """Return the energy of loops of some amplitudes [J]; if `linear`, by straight pieces."""
        a = np.asarray(amplitude, dtype=float)
        energy = self._of_partial_slip(a, linear=linear)
        if self._first is None:
            return energy
        first = self._first
        sliding = self._line(a)
        energy = np.where(a >= self.amplitudes[first], sliding, energy)
        if first == 0:
            return energy
        low, high = self._bracket(a)
        inside = (a > self.amplitudes[first - 1]) & (a < self.amplitudes[first])
        return np.where(inside, 0.5 * (low + high), energy)

    def half_width(self, amplitude: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return half of the distance of the bounds at the onset of gross slip, elsewhere 0 [J]."""
        first = self._first
        if first is None or first == 0:
            return np.zeros_like(amplitude)
        low, high = self._bracket(amplitude)
        inside = (amplitude > self.amplitudes[first - 1]) & (amplitude < self.amplitudes[first])
        return np.where(inside, 0.5 * (high - low), 0.0)

    @cached_property
    def onset(self) -> float | None:
        """Return the amplitude at which gross slip begins; None if it is not between two loops."""
        first = self._first
        if first is None or first == 0:
            return None
        a = np.linspace(self.amplitudes[first - 1], self.amplitudes[first], SEARCHED)
        return float(a[int(np.argmax(self._line(a) >= self._extrapolate(a)))])

    @cached_property
    def _first(self) -> int | None:
        """Index of the first loop of gross slip."""
        return int(np.argmax(self.slides)) if self.slides.any() else None

    @cached_property
    def _partial(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Amplitudes of loops of partial slip, and log(energy/amplitude^3)."""
        chosen = ~self.slides & (self.energies > 0.0)
        a = self.amplitudes[chosen]
        return a, np.log(self.energies[chosen] / a**3)

    def _of_partial_slip(self, a: NDArray[np.float64], *, linear: bool) -> NDArray[np.float64]:
        """Return the energy below the onset of gross slip at amplitudes a.

        In small slip it grows like a^3: ln(E/a^3) is interpolated, by cubic or straight pieces.
        """
        nodes, log_ratio = self._partial
        if nodes.size == 0:
            return np.zeros_like(a)
        if linear or nodes.size < 3:
            value = np.interp(a, nodes, log_ratio)
        else:
            value = cubic(nodes, log_ratio, np.clip(a, nodes[0], nodes[-1]))
        return np.asarray(np.exp(value) * a**3)

    def _line(self, a: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the line of gross slip through its loops, continued to smaller amplitudes."""
        assert self._first is not None
        nodes, energies = self.amplitudes[self._first :], self.energies[self._first :]
        below = energies[0] - 2.0 * self.force * (nodes[0] - a)
        above = energies[-1] + 2.0 * self.force * (a - nodes[-1])
        inside = np.interp(a, nodes, energies)
        return np.where(a < nodes[0], below, np.where(a > nodes[-1], above, inside))

    def _extrapolate(self, a: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the energy beyond the largest loop of partial slip, by the slope before it."""
        nodes, ratio = self._partial
        if nodes.size == 0:
            return np.zeros_like(a)
        slope = (ratio[-1] - ratio[-2]) / (nodes[-1] - nodes[-2]) if nodes.size > 1 else 0.0
        return np.asarray(np.exp(ratio[-1] + slope * (a - nodes[-1])) * a**3)

    def _bracket(self, a: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the least and the largest energy where gross slip begins between two loops."""
        first = self._first
        assert first is not None
        ends = slice(first - 1, first + 1)
        chord = np.interp(a, self.amplitudes[ends], self.energies[ends])
        line = self._line(a)
        low = np.minimum(np.maximum(self._extrapolate(a), line), chord)
        with np.errstate(divide="ignore"):
            ratio = np.log(self.energies[ends] / self.amplitudes[ends] ** 3)
        power = np.exp(np.interp(a, self.amplitudes[ends], ratio)) * a**3
        return low, np.clip(power, low, chord)


def cubic(
    x: NDArray[np.float64], y: NDArray[np.float64], at: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Interpolate by cubic pieces, with the slopes of parabolas through three points."""
    slopes = np.gradient(y, x, edge_order=2)
    n = np.clip(np.searchsorted(x, at) - 1, 0, x.size - 2)
    width = x[n + 1] - x[n]
    t = (at - x[n]) / width
    return np.asarray(
        (1.0 - t) ** 2 * ((1.0 + 2.0 * t) * y[n] + t * width * slopes[n])
        + t**2 * ((3.0 - 2.0 * t) * y[n + 1] - (1.0 - t) * width * slopes[n + 1])
    )
