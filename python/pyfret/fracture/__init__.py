"""Will a crack stop, will the coating come off? Stress intensity, arrest, energy release.

:func:`crack` (or :meth:`pyfret.Result.crack`) takes the stress of a contact's cycle to the tips of
cracks. With :func:`grow` (:meth:`pyfret.Result.grow_crack`) the crack chooses its way.
:class:`Cracks` gives the length of arrest by a :class:`Threshold` and the cycles by :class:`Paris`.
:class:`Crack` does so for any stress history, without a contact. ::

    cracks = result.crack()
    cracks.arrest(fracture.Threshold(dK_th=2.1e6, dS_0=124e6))

The interfaces of a coated body carry a normal stress s_zz, which peels where it is tension, and a
shear stress (s_xz, s_yz). :func:`over_cycle` follows both along a contact's cycle;
:func:`edge_release`, :func:`buckling_release` and :func:`channel_release` give what a stressed
coating releases where it parts from its substrate or cracks. ::

    found = fracture.over_cycle(result, peel_strength=200e6, shear_strength=300e6)
    found.criterion.max()  # 1 where the interface fails
"""

from pyfret._core import Crack, ellipse_factor
from pyfret._util.names import listing
from pyfret.fracture.arrest import CrackArrest, CrackLife
from pyfret.fracture.below import crack, grow
from pyfret.fracture.blocks import BlockGrowth, grow_by_history
from pyfret.fracture.film import channel_release, film_intensity
from pyfret.fracture.first import PARTS, FailureOrder, first_to_fail
from pyfret.fracture.growth import Cracks, Paris, Threshold
from pyfret.fracture.interface import Buckling, buckling_release, edge_release, over_cycle

__all__ = [
    "PARTS",
    "BlockGrowth",
    "Buckling",
    "Crack",
    "CrackArrest",
    "CrackLife",
    "Cracks",
    "FailureOrder",
    "Paris",
    "Threshold",
    "buckling_release",
    "channel_release",
    "crack",
    "edge_release",
    "ellipse_factor",
    "film_intensity",
    "first_to_fail",
    "grow",
    "grow_by_history",
    "over_cycle",
]
__dir__ = listing(__all__)
