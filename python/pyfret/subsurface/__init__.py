"""Stress and displacement below the surface of a body.

Depth z is counted into the body, components use the axes of ``docs/conventions.md``, and
tension is positive. Every depth on an interface appears twice, with the layer above it first.
Most people start from :meth:`pyfret.Snapshot.stress`; the functions here take any tractions.
"""

from pyfret._util.names import listing
from pyfret.subsurface.extremum import Errors, Extremum, Place
from pyfret.subsurface.fields import displacement, envelope, stress, write_volume
from pyfret.subsurface.residual import thermal_stress
from pyfret.subsurface.tensor import Stress
from pyfret.subsurface.zones import Zone

__all__ = [
    "Errors",
    "Extremum",
    "Place",
    "Stress",
    "Zone",
    "displacement",
    "envelope",
    "stress",
    "thermal_stress",
    "write_volume",
]
__dir__ = listing(__all__)
