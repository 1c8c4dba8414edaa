"""A stationary Gaussian load from its spectral density."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeAlias, get_args

import numpy as np

from pyfret import _core
from pyfret._util.arrays import number, plain
from pyfret._util.holds_arrays import HoldsArrays
from pyfret.quantities import Numbers, Time, quantities

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["Distribution", "Spectrum", "SpectrumValues"]

#: Distribution of the amplitudes: of a narrow band, or of any band.
Distribution: TypeAlias = Literal["rayleigh", "dirlik"]
#: Numbers of a spectrum: one-sided density per Hz, or lines by their peak or their rms.
SpectrumValues: TypeAlias = Literal["density", "peak", "rms"]
#: Part of the distance of lines by which they may lie off an even grid.
UNEVEN = 1e-6


@dataclass(frozen=True, eq=False, repr=False)
class Spectrum(HoldsArrays):
    """One-sided spectral density per Hz of a stationary Gaussian load.

    The variance is the integral of the density over the frequencies from 0. A two-sided density
    has half of it at each sign of the frequency, so it must be doubled.

    Attributes
    ----------
    frequencies : array
        Frequencies [Hz], ascending; the density is linear between them and 0 outside.
    density : array
        Density, the squared unit of the load per Hz.
    """

    frequencies: NDArray[np.float64]
    density: NDArray[np.float64]

    @staticmethod
    @quantities
    def from_arrays(
        frequencies: Numbers, values: Numbers, *, of: SpectrumValues = "density"
    ) -> Spectrum:
        """Make a spectrum of a density per Hz, or of lines by their peak or their rms.

        Parameters
        ----------
        frequencies : array
            Frequencies [Hz], ascending; of lines at equal distances.
        values : array
            Density, amplitudes or root mean squares.
        of : "density", "peak" or "rms"
            What `values` are. A line of the peak a has the variance a^2/2, and of the rms s it has
            s^2.
        """
        if of not in get_args(SpectrumValues):
            raise ValueError(f"of = {of!r}: must be 'density', 'peak' or 'rms'")
        f, y = plain(frequencies, "frequencies"), plain(values, "values")
        if f.ndim != 1 or f.shape != y.shape:
            raise ValueError(
                f"values have the shape {y.shape} and the frequencies {f.shape}: must be as many "
                "numbers in one dimension"
            )
        if of != "density":
            f, y = density_of_lines(f, y * y * (0.5 if of == "peak" else 1.0))
        spectrum = Spectrum(f, y)
        spectrum._cycles("rayleigh")
        return spectrum

    def _cycles(
        self,
        distribution: Distribution,
        amplitudes: NDArray[np.float64] | None = None,
        powers: NDArray[np.float64] | None = None,
    ) -> dict[str, NDArray[np.float64]]:
        """Return what the core computes of the cycles under a distribution.

        ``moments`` has m_0, m_1, m_2 and m_4, ``rates`` the up-crossings, peaks and cycles [1/s].
        ``exceedance`` is the part of the cycles beyond each of `amplitudes`. ``mean_power`` is the
        mean of amplitude^k for each k of `powers`.
        """
        none = np.empty(0)
        return _core.spectral_cycles(
            self.frequencies,
            self.density,
            distribution,
            none if amplitudes is None else amplitudes,
            none if powers is None else powers,
        )

    @property
    def moments(self) -> tuple[float, float, float, float]:
        """Spectral moments m_0, m_1, m_2 and m_4; m_0 is the variance."""
        m_0, m_1, m_2, m_4 = self._cycles("rayleigh")["moments"].tolist()
        return m_0, m_1, m_2, m_4

    @property
    def rms(self) -> float:
        """Standard deviation of the load."""
        return float(np.sqrt(self.moments[0]))

    @property
    def up_crossings(self) -> float:
        """Up-crossings of the mean per second: the cycles of a narrow band."""
        return float(self._cycles("rayleigh")["rates"][0])

    @property
    def peaks(self) -> float:
        """Peaks per second: the cycles that rainflow counts in a wide band."""
        return float(self._cycles("rayleigh")["rates"][1])

    @property
    def irregularity(self) -> float:
        """Up-crossings over peaks: 1 for a narrow band."""
        return self.up_crossings / self.peaks

    def rate(self, distribution: Distribution) -> float:
        """Return the cycles per second: up-crossings for Rayleigh, peaks for Dirlik."""
        return float(self._cycles(distribution)["rates"][2])

    @quantities
    def exceedance(self, amplitude: Numbers, distribution: Distribution) -> NDArray[np.float64]:
        """Return the part of the cycles whose amplitude (half of the range) is larger."""
        flat = np.ravel(plain(amplitude, "amplitude"))
        return self._cycles(distribution, flat)["exceedance"].reshape(np.shape(amplitude))

    def mean_power(self, exponent: float, distribution: Distribution) -> float:
        """Return the mean of amplitude^exponent over the cycles.

        Miner's damage of a line N s^m = C is the number of cycles times this mean over C.
        """
        k = number(exponent, "exponent")
        if not 0.0 <= k <= 100.0:
            raise ValueError(f"exponent = {k}: must be 0 to 100")
        return float(self._cycles(distribution, powers=np.array([k]))["mean_power"][0])

    @quantities
    def sample(
        self, duration: Time, *, seed: int, points_per_cycle: int = 32
    ) -> tuple[float, NDArray[np.float64]]:
        """Return the time step [s] and the values of a Gaussian sample of zero mean.

        The lines of a Fourier series over the duration get normally distributed sines and cosines
        of the variance of the density. The same seed gives the same sample. The largest of n points
        of a cycle lies below its peak by pi^2/(6 n^2) on average, 0.2 % with 32 points.
        """
        length = float(duration)  # type: ignore[arg-type]
        step = 1.0 / (points_per_cycle * self.peaks)
        step = min(step, 0.5 / float(self.frequencies[-1]))
        points = round(length / step)
        if not 4 <= points <= 100_000_000:
            raise ValueError(
                f"duration = {length} s: must have 4 to 1e8 points of {step:.4g} s, "
                f"and has {points}"
            )
        f = np.fft.rfftfreq(points, step)
        G = np.interp(f, self.frequencies, self.density, left=0.0, right=0.0)
        random = np.random.default_rng(seed)
        scale = np.sqrt(G * f[1])
        waves = scale * (random.standard_normal(f.size) - 1j * random.standard_normal(f.size))
        waves[0] = 0.0
        return step, np.fft.irfft(waves, points) * (0.5 * points)


def density_of_lines(
    f: NDArray[np.float64], variance: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the density whose integral over the surroundings of each line is its variance."""
    steps = np.diff(f)
    if f.size < 2 or np.ptp(steps) > UNEVEN * abs(steps[0]) or steps[0] <= 0.0:
        raise ValueError("frequencies of lines: must ascend at equal distances, 2 at least")
    if f[0] < steps[0] * (1.0 - UNEVEN):
        raise ValueError(
            f"frequencies[0] = {f[0]} Hz: lines must begin at their distance, "
            f"{steps[0]:.6g} Hz, or above; a line at 0 Hz is a mean"
        )
    edges = np.concatenate([[max(f[0] - steps[0], 0.0)], f, [f[-1] + steps[0]]])
    return edges, np.concatenate([[0.0], variance / steps[0], [0.0]])
