"""Identification of friction, rig, coating and wear from measurements.

``data`` holds measured loops, indentation curves, scars and lives. ``models`` solves what they
should have been. ``search`` finds the unknowns, and ``outcome`` holds them with their confidence.
::

    loops = fret.fit.read_loops("loop.csv")
    found = fret.fit(scene, loops, unknown={"mu": (0.1, 1.5), "rig.stiffness": (1e6, 1e8)})
    print(found.summary())
"""

from __future__ import annotations

from pyfret._util.modules import enter_public_module
from pyfret._util.names import listing
from pyfret.fit.data import (
    Indentation,
    Lives,
    Loops,
    Scar,
    read_indentation,
    read_lives,
    read_loops,
    read_scar,
)
from pyfret.fit.outcome import FitResult, Posterior
from pyfret.fit.search import fit

__all__ = [
    "FitResult",
    "Indentation",
    "Lives",
    "Loops",
    "Posterior",
    "Scar",
    "fit",
    "read_indentation",
    "read_lives",
    "read_loops",
    "read_scar",
]
__dir__ = listing(__all__)

enter_public_module(__name__)
