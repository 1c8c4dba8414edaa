"""Cracks through a film: what a channel crack releases, and K of a crack that ends in the film."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pyfret import _core
from pyfret.quantities import Length, ResidualStress, as_number, quantities

if TYPE_CHECKING:
    from pyfret._core import Coating, Elastic

__all__ = ["channel_release", "film_intensity"]


def own_stress(coating: Coating, stress: float | None) -> float:
    """Return the given stress, or the uniform residual stress of a coating [Pa].

    Raises
    ------
    ValueError
        Neither is there.
    """
    if stress is not None:
        return stress
    if isinstance(coating.residual, float):
        return coating.residual
    raise ValueError(
        "stress: give the stress of the coating in Pa, or a coating whose residual stress is one "
        "number, Coating(..., residual=-2e9)"
    )


@quantities
def channel_release(
    coating: Coating, below: Elastic, stress: ResidualStress | None = None
) -> float:
    """Give what a crack releases that channels through a film under tension [J/m^2].

    G = (pi/2) g stress^2 h/E', E' = E/(1 - nu^2), in the steady state, g(alpha, beta) of Dundurs'
    parameters by dislocations along the whole thickness (1e-4 of published values). A film in
    compression does not channel: 0.

    Parameters
    ----------
    coating : Coating
        The film.
    below : Elastic
        What it lies on, as a half-plane.
    stress : float, optional
        Stress of the film, residual and of the load [Pa] (default: the residual stress of the
        coating). Of a stress that varies through the thickness the largest value is on the safe
        side.

    Raises
    ------
    ValueError
        The film is too stiff for what it lies on, or the stress is not finite.

    References
    ----------
    J. L. Beuth, Int. J. Solids Struct. 29 (1992) 1657-1675; J. W. Hutchinson, Z. Suo, Adv. Appl.
    Mech. 29 (1992) 63-191, whose Z = (pi/2) g.
    """
    stress = own_stress(coating, as_number(stress))
    if not np.isfinite(stress):
        raise ValueError(f"stress = {stress}: must be finite")
    E, nu = coating.material.E, coating.material.nu
    try:
        Z = np.pi / 2.0 * _core.channel_crack(coating.material, below)
    except _core.InvalidSceneError as refused:
        raise ValueError(
            f"channel_release: no solution for a film of {E:.4g} Pa on {below.E:.4g} Pa. "
            "Films of up to 190 times the modulus of what they lie on have one"
        ) from refused
    return float(Z * max(stress, 0.0) ** 2 * coating.thickness * (1.0 - nu * nu) / E)


@quantities
def film_intensity(
    coating: Coating, below: Elastic, depth: Length, stress: ResidualStress | None = None
) -> float:
    """Give K_I of a crack normal to the surface that ends in the film [Pa m^0.5].

    The stress is uniform, and the constants belong to the film and the other material. The
    homogeneous body has 1.12 stress sqrt(pi depth). A film on a softer material has more, one on a
    stiffer material less.

    Parameters
    ----------
    coating, below
        As in :func:`channel_release`.
    depth : float
        Depth of the tip [m], above 0 and below the thickness.
    stress : float, optional
        Stress of the film [Pa] (default: the residual stress of the coating).
    """
    stress = own_stress(coating, as_number(stress))
    depth = as_number(depth)
    if not 0.0 < depth < coating.thickness:
        raise ValueError(f"depth = {depth}: must lie in the film, 0 to {coating.thickness} m")
    F = _core.partial_crack(coating.material, below, depth / coating.thickness)
    return float(F * stress * np.sqrt(np.pi * depth))
