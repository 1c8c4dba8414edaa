"""Oxygen and debris between the surfaces: the tables ``[wear.air]`` and ``[wear.bed]``."""

from __future__ import annotations

from typing import Any

from pyfret.quantities import Frequency, InSI, Length, PeakPressure, Thickness, by_default, part
from pyfret.scene.parts import Replaceable

__all__ = ["Air", "DebrisBed"]


@part()
class Air(Replaceable):
    """Oxygen that diffuses into the contact and is consumed there by friction.

    In the closed region div(D grad P) = r P, and P is the ambient pressure on its border. The rate
    r follows the local power of friction, r = r_ref (phi/phi_ref)^m, or pressure and frequency,
    r = r_ref (p/p_ref)^a (f/f_ref)^b. Only D/r enters. Where P is below the threshold, wear laws
    take their coefficient `starved`.

    Parameters
    ----------
    distance : float, optional
        Width of the aerated border of a wide strip at the reference state [m].
    diffusivity, reaction : float, optional
        D [m^2/s] and r at the reference state [1/s], in place of `distance`.
    power_density, power_exponent : float, optional
        Reference power of friction [W/m^2] and exponent m.
    pressure, pressure_exponent, frequency, frequency_exponent : float, optional
        Reference pressure [Pa], a, reference frequency [Hz] and b, in place of the power.
    threshold : float
        Partial pressure of oxygen below which a surface is starved [Pa].
    ambient : float
        Partial pressure of oxygen outside [Pa].
    """

    distance: InSI[Length | None] = by_default(None)
    diffusivity: float | None = None
    reaction: float | None = None
    power_density: float | None = None
    power_exponent: float | None = None
    pressure: InSI[PeakPressure | None] = by_default(None)
    pressure_exponent: float | None = None
    frequency: InSI[Frequency | None] = by_default(None)
    frequency_exponent: float | None = None
    threshold: float = 0.1
    ambient: float = 21278.0


@part()
class DebrisBed(Replaceable):
    """A bed of debris, which fills the gap, spreads and leaves the contact.

    The volume h of debris per area follows dh/dN = e (w_1' + w_2') + div(K grad h), with h = 0 on
    the border of the closed region. K is kappa times the square of the slip amplitude of the cell.

    Parameters
    ----------
    kappa : float
        Transport number per cycle.
    volume_ratio : float
        Volume of debris over worn volume, e.
    starved_yield : float
        Part of the volume worn without oxygen that enters the bed, 0 to 1; the rest leaves.
    protecting_thickness : float, optional
        Thickness h_ref [m]: wear coefficients are divided by 1 + h/h_ref.
    """

    kappa: float
    volume_ratio: float = 1.0
    starved_yield: float = 1.0
    protecting_thickness: InSI[Thickness | None] = by_default(None)


def written(part_of_third_body: Air | DebrisBed) -> dict[str, Any]:
    """Return the table of a scene file."""
    return {name: value for name, value in vars(part_of_third_body).items() if value is not None}
