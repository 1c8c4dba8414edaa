"""Will the coating come off? Stress on the interfaces over a cycle, and energy release rates.

The interfaces of a coated body carry a normal stress s_zz, which peels where it is tension, and a
shear stress (s_xz, s_yz). :func:`over_cycle` follows both along a contact's cycle;
:func:`edge_release` and :func:`buckling_release` give what a stressed coating releases where it
parts from its substrate. ::

    found = fracture.over_cycle(result, peel_strength=200e6, shear_strength=300e6)
    found.criterion.max()  # 1 where the interface fails
"""

from pyfret._util.names import listing
from pyfret.fracture.interface import Buckling, buckling_release, edge_release, over_cycle

__all__ = ["Buckling", "buckling_release", "edge_release", "over_cycle"]
__dir__ = listing(__all__)
