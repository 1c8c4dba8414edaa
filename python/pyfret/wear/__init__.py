"""Wear: what many cycles do to the surfaces.

A run of wear is solved, opened and gone on with::

    worn = fret.wear.solve(scene, cycles=18e3, body2=fret.wear.Archard(k=1e-13))
    worn.depth2[-1]
"""

from pyfret._util.names import listing
from pyfret.wear.result import WearResult
from pyfret.wear.runs import resume, solve
from pyfret.wear.settings import Archard, DissipatedEnergy, Wear
from pyfret.wear.third_body import Air, DebrisBed

__all__ = [
    "Air",
    "Archard",
    "DebrisBed",
    "DissipatedEnergy",
    "Wear",
    "WearResult",
    "resume",
    "solve",
]
__dir__ = listing(__all__)
