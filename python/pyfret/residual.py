"""Residual stress of coatings: what a change of temperature leaves."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from pyfret._core import Elastic

__all__ = ["thermal"]


def thermal(
    coating: Elastic, *, alpha_coating: float, alpha_substrate: float, temperature_change: float
) -> float:
    """Thermal stress of a thin coating on a thick substrate [Pa], biaxial, tension positive.

    The coating has to follow the substrate, which strains by alpha_s dT where it would strain by
    alpha_c dT itself::

        s = E/(1 - nu) (alpha_s - alpha_c) dT

    A coating that expands less than its substrate is compressed as both cool from the temperature
    of its deposition. The stress of the substrate, less by the ratio of the thicknesses, is left
    out. L. B. Freund, S. Suresh, Thin Film Materials, Cambridge University Press (2003).

    Parameters
    ----------
    coating : Elastic
        Modulus and Poisson's ratio of the coating.
    alpha_coating, alpha_substrate : float
        Coefficients of linear thermal expansion [1/K]; ``alpha_T`` of a material.
    temperature_change : float
        Temperature less that at which the coating was free of stress [K], negative after cooling.

    Returns
    -------
    float
        One number of ``residual`` of :class:`pyfret.section.Section`.

    Examples
    --------
    >>> import pyfret as fret
    >>> nitride = fret.Elastic(E=590e9, nu=0.25)
    >>> s = fret.residual.thermal(
    ...     nitride, alpha_coating=9.4e-6, alpha_substrate=12e-6, temperature_change=-400.0
    ... )
    >>> round(s / 1e6)
    -818
    """
    if not np.isfinite(coating.E):
        raise ValueError("the coating is rigid: it has no finite thermal stress")
    given = {
        "alpha_coating": alpha_coating,
        "alpha_substrate": alpha_substrate,
        "temperature_change": temperature_change,
    }
    for name, value in given.items():
        if not np.isfinite(value):
            raise ValueError(f"{name} = {value}: must be a finite number")
    mismatch = (alpha_substrate - alpha_coating) * temperature_change
    return coating.E / (1.0 - coating.nu) * mismatch
