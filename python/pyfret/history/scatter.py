"""Scatter of a record: how much a sum over the loops of one record differs from its mean.

The loops of a narrow band of a Gaussian load follow its envelope, which changes slowly. So a record
of many cycles holds few envelopes that are independent of one another. With u = A^2/(2 m_0) the
amplitudes at two instants have the joint density ::

    exp(-u - v) sum_n rho^(2 n) L_n(u) L_n(v)

L_n are Laguerre's polynomials, and rho(t) is the magnitude of the Fourier transform of the density
over m_0 (S. O. Rice, Bell Syst. Tech. J. 24 (1945) 46-156, sec. 3.7). A sum of g(A) over a record
of the duration T thus has the relative variance ::

    sum_{n > 0} (c_n/c_0)^2 int rho^(2 n) (1 - |t|/T) dt / T,     c_n = mean of g(A) L_n(u)

It is exact for a narrow band. In a wide band loops follow one another less closely.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from pyfret.history.spectrum import Spectrum

__all__ = ["record_scatter"]

#: Terms of the sum, samples of the density, and their number with zeros beyond its ends.
TERMS, SAMPLES, PADDED = 40, 4096, 16384


def record_scatter(
    spectrum: Spectrum,
    amplitude: NDArray[np.float64],
    count: NDArray[np.float64],
    contribution: NDArray[np.float64],
    duration: float,
) -> float:
    """Return the standard deviation of a sum over the loops of a record, over its mean.

    Parameters
    ----------
    spectrum : Spectrum
        The density.
    amplitude, count : array
        Amplitudes (half of the range), and how often they occur.
    contribution : array
        What one loop of each amplitude adds to the sum.
    duration : float
        Duration of the record [s].
    """
    u = amplitude**2 / (2.0 * spectrum.moments[0])
    weights = count * contribution / count.sum()
    coefficients = np.array([float(weights @ column) for column in laguerre(u)])
    if not coefficients[0] > 0.0:
        return 0.0
    relative = (coefficients[1:] / coefficients[0]) ** 2
    return float(np.sqrt(relative @ overlaps(spectrum, duration)))


def laguerre(u: NDArray[np.float64]) -> list[NDArray[np.float64]]:
    """Return Laguerre's polynomials of the orders 0 to TERMS."""
    values = [np.ones_like(u), 1.0 - u]
    for n in range(1, TERMS):
        values.append(((2 * n + 1 - u) * values[n] - n * values[n - 1]) / (n + 1))
    return values


def overlaps(spectrum: Spectrum, duration: float) -> NDArray[np.float64]:
    """Return the integrals of rho^(2 n) (1 - |t|/T) over the record, over T, for n from 1."""
    f = np.linspace(spectrum.frequencies[0], spectrum.frequencies[-1], SAMPLES)
    density = np.interp(f, spectrum.frequencies, spectrum.density)
    step = f[1] - f[0]
    rho = np.abs(np.fft.rfft(density, PADDED)) / density.sum()
    t = np.arange(rho.size) / (PADDED * step)
    # Both signs of the time; the transform repeats itself beyond its last half.
    weights = 2.0 * t[1] * np.maximum(1.0 - t / duration, 0.0)
    weights[0] *= 0.5
    squares = rho**2
    return np.array([float(weights @ squares**n) for n in range(1, TERMS + 1)]) / duration
