"""Residual stress of coatings after a change of temperature."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pyfret._core import Material
from pyfret.quantities import ThermalExpansion, as_number, quantities

if TYPE_CHECKING:
    from pyfret._core import Elastic

__all__ = ["thermal_stress"]


@quantities
def thermal_stress(
    coating: Elastic | Material,
    *,
    temperature_change: float,
    alpha_coating: ThermalExpansion | Material | None = None,
    alpha_substrate: ThermalExpansion | Material,
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
    coating : Elastic or Material
        Modulus and Poisson's ratio of the coating.
    alpha_coating, alpha_substrate : float or Material
        Coefficients of linear thermal expansion [1/K], or materials that have ``alpha_T``. For
        the coating the default is its own, where it is a material.
    temperature_change : float
        Temperature less that at which the coating was free of stress [K], negative after cooling.

    Returns
    -------
    float
        One number of ``residual`` of :class:`pyfret.fatigue.Section`.

    Examples
    --------
    >>> import pyfret as fret
    >>> nitride = fret.Elastic(E=590e9, nu=0.25)
    >>> s = fret.subsurface.thermal_stress(
    ...     nitride, alpha_coating=9.4e-6, alpha_substrate=12e-6, temperature_change=-400.0
    ... )
    >>> round(s / 1e6)
    -818
    """
    if isinstance(coating, Material):
        alpha_coating = coating if alpha_coating is None else alpha_coating
        E, nu = coating.number("E"), coating.number("nu")
    else:
        E, nu = coating.E, coating.nu
    if alpha_coating is None:
        raise ValueError("alpha_coating is missing: a coating that is no material has no alpha_T")
    if not np.isfinite(E):
        raise ValueError("the coating is rigid: it has no finite thermal stress")
    expansions = {
        "alpha_coating": _expansion(alpha_coating),
        "alpha_substrate": _expansion(alpha_substrate),
        "temperature_change": temperature_change,
    }
    for name, value in expansions.items():
        if not np.isfinite(value):
            raise ValueError(f"{name} = {value}: must be a finite number")
    mismatch = (expansions["alpha_substrate"] - expansions["alpha_coating"]) * temperature_change
    return E / (1.0 - nu) * mismatch


def _expansion(alpha: ThermalExpansion | Material) -> float:
    """Return a coefficient of thermal expansion, given or of a material [1/K]."""
    return alpha.number("alpha_T") if isinstance(alpha, Material) else as_number(alpha)
