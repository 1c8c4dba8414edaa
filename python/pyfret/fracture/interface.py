"""Stress on the interfaces over a cycle, and energy release rates of coatings."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from pyfret._core import with_error
from pyfret._util.attributes import missing_attribute
from pyfret._util.bounds import ESTIMATE
from pyfret._util.lazy import xr
from pyfret.fatigue.cycle_section import sections_of_cycle
from pyfret.fatigue.cycles import history
from pyfret.fatigue.section import Section, SectionOptions
from pyfret.fracture.film import own_stress
from pyfret.quantities import Length, ResidualStress, Strength, as_number, quantities
from pyfret.subsurface.fields import interfaces

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from pyfret._core import Coating
    from pyfret.run import Run

__all__ = ["Buckling", "buckling_release", "edge_release", "over_cycle"]


@quantities
def over_cycle(
    result: Run,
    *,
    peel_strength: Strength | None = None,
    shear_strength: Strength | None = None,
    **section: Unpack[SectionOptions],
) -> xr.Dataset:
    """Follow peel and shear on the interfaces below the contact over a closed cycle.

    A residual stress of the layers, uniform and biaxial, has no part in the stress on an interface
    away from its edges.

    Parameters
    ----------
    result : Result
        Solved with ``save="all"``, or with the increments of the cycle.
    peel_strength, shear_strength : float, optional
        Strengths of the interface in tension and in shear [Pa]; both or neither.
    **section
        ``x`` or ``y``, ``body_number``, ``cycle``, as in :func:`pyfret.fatigue.life`.

    Returns
    -------
    xarray.Dataset
        Over (interface, x) or (interface, y), in Pa. ``peel``: the largest s_zz of the cycle, 0
        without tension. ``shear``: the largest size of (s_xz, s_yz). ``shear_amplitude``: half the
        longest chord of its path. With strengths also ``criterion``, the largest (s_zz/Z)^2 +
        (s_xz^2 + s_yz^2)/S^2 of the cycle, with s_zz where it is tension. It reaches 1 where the
        interface fails: J. C. Brewer, P. A. Lagace, J. Compos. Mater. 22 (1988) 1141-1155, with one
        shear strength for both directions.

    Raises
    ------
    ValueError
        The body has no coating, one of the strengths is missing or not positive, or as
        :func:`pyfret.fatigue.life`.
    """
    where = sections_of_cycle(result, Section(**section))[0]
    scene = result.scene
    depths = interfaces(scene.body1 if where.body_number == 1 else scene.body2)
    if not depths:
        raise ValueError(f"body {where.body_number} has no coating and no interface")
    peel_strength, shear_strength = as_number(peel_strength), as_number(shear_strength)
    strengths = {"peel_strength": peel_strength, "shear_strength": shear_strength}
    given_strengths = [name for name, value in strengths.items() if value is not None]
    if len(given_strengths) == 1:
        raise ValueError(f"{given_strengths[0]} is given alone: the criterion needs both strengths")
    for name, value in strengths.items():
        if value is not None and not (value > 0.0 and np.isfinite(value)):
            raise ValueError(f"{name} = {value}: must be a positive stress in Pa")
    along = where.axis
    stress = history(
        result,
        depths,
        **where.line.named(),
        body_number=where.body_number,
        cycle=where.cycle,
    )
    # Both sides carry the same traction; the traction of the upper layer is used.
    of_upper = stress.values[:, ::2]
    peel = np.maximum(of_upper[..., 2], 0.0)
    shear = of_upper[..., 4:6]
    dims = ("interface", along)
    # The error of the stress over a cycle is not known.
    pascal = {"units": "Pa", **ESTIMATE}
    result_fields = xr.Dataset(
        {
            "peel": (dims, peel.max(axis=0), {**pascal, "long_name": "largest peel of the cycle"}),
            "shear": (
                dims,
                np.linalg.norm(shear, axis=-1).max(axis=0),
                {**pascal, "long_name": "largest shear of the cycle"},
            ),
            "shear_amplitude": (
                dims,
                _half_chord(shear),
                {**pascal, "long_name": "half the longest chord of the shear path"},
            ),
        },
        coords={"z": ("interface", depths, {"units": "m"}), along: stress[along]},
    )
    if peel_strength is not None and shear_strength is not None:
        square = (peel / peel_strength) ** 2 + (shear**2).sum(axis=-1) / shear_strength**2
        attrs = {
            **ESTIMATE,
            "units": "1",
            "long_name": "quadratic criterion of the interface, 1 at failure",
        }
        result_fields["criterion"] = (dims, square.max(axis=0), attrs)
    return result_fields


def _half_chord(path: np.ndarray) -> np.ndarray:
    """Return half the longest chord of paths of shape (time, ..., 2)."""
    longest = np.zeros(path.shape[1:-1])
    for n in range(1, len(path)):
        chords = np.linalg.norm(path[n:] - path[:-n], axis=-1)
        longest = np.maximum(longest, chords.max(axis=0))
    return longest / 2


@quantities
def edge_release(coating: Coating, stress: ResidualStress | None = None) -> float:
    """Give what a coating releases that parts from its substrate along a straight front [J/m^2].

    G = (1 - nu^2) h stress^2/(2 E), the steady state far from the edge from which the crack runs;
    the strain along the front does not change. Tension and compression release the same; a
    compressed coating has to be free to move away, or slide, along the crack.

    J. W. Hutchinson, Z. Suo, Adv. Appl. Mech. 29 (1992) 63-191.

    Parameters
    ----------
    coating : Coating
        Its modulus, Poisson's ratio and thickness.
    stress : float, optional
        Stress across the front, residual and of the load [Pa] (default: the residual stress of the
        coating).
    """
    stress = own_stress(coating, as_number(stress))
    E, nu = coating.material.E, coating.material.nu
    return (1.0 - nu * nu) * coating.thickness * stress * stress / (2.0 * E)


class Buckling(NamedTuple):
    """A compressed coating above a debonded strip."""

    #: Compressive stress at which it buckles [Pa], positive.
    critical_stress: float
    #: Deflection in the middle [m].
    deflection: float
    #: Energy release rate along the sides of the strip [J/m^2].
    release: float

    def __repr__(self) -> str:
        """The three with their units: estimates, since the substrate is taken for rigid."""
        return (
            f"Buckling(critical_stress = {with_error(1e-6 * self.critical_stress)} MPa, "
            f"deflection = {with_error(1e6 * self.deflection)} um, "
            f"release = {with_error(self.release)} J/m^2)"
        )


@quantities
def buckling_release(
    coating: Coating, stress: ResidualStress | None = None, *, half_width: Length
) -> Buckling:
    """Give how a compressed coating buckles above a long debonded strip, and what that releases.

    With b half of the width of the strip, h the thickness and s the compression::

        s_c = pi^2/12 E/(1 - nu^2) (h/b)^2
        deflection = h sqrt(4/3 (s/s_c - 1))
        G = (1 - nu^2) h/(2 E) (s - s_c) (s + 3 s_c)

    and nothing below s_c. The substrate is taken for rigid against the coating.

    J. W. Hutchinson, Z. Suo, Adv. Appl. Mech. 29 (1992) 63-191, straight-sided blister.

    Parameters
    ----------
    coating : Coating
        Its modulus, Poisson's ratio and thickness.
    stress : float, optional
        Stress of the coating across the strip [Pa], compression negative (default: the residual
        stress of the coating).
    half_width : float
        Half of the width of the strip, b [m], much longer than the thickness.

    Raises
    ------
    ValueError
        The half width is not positive, or the buckling stress is 0.
    """
    half_width = as_number(half_width)
    if not (half_width > 0.0 and np.isfinite(half_width)):
        raise ValueError(
            f"half_width = {half_width}: must be a positive length in m, half of the strip"
        )
    E, nu, h = coating.material.E, coating.material.nu, coating.thickness
    plane = E / (1.0 - nu * nu)
    critical = np.pi**2 / 12.0 * plane * (h / half_width) ** 2
    if not critical > 0:
        raise ValueError(
            f"coating: E = {E:g} Pa, {h:g} m thick on a strip of {2 * half_width:g} m, has a "
            "buckling stress of 0: must be stiffer, or the strip narrower"
        )
    s = -own_stress(coating, as_number(stress))
    if s <= critical:
        return Buckling(float(critical), 0.0, 0.0)
    deflection = h * np.sqrt(4.0 / 3.0 * (s / critical - 1.0))
    release = h / (2.0 * plane) * (s - critical) * (s + 3.0 * critical)
    return Buckling(float(critical), float(deflection), float(release))


if not TYPE_CHECKING:
    # A method within the class would let type checkers take any name.
    Buckling.__getattr__ = missing_attribute
