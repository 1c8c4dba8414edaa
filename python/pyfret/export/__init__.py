"""Exchange with finite elements: tractions, stresses, forces on nodes, loops.

A :class:`Frame` places the component in the other model. It holds the middle of the grid, the
directions of its axes, and the model's unit of length. ::

    frame = export.Frame(origin=(0.0, 0.0, 20.0), z=(0.0, 0.0, -1.0), unit="mm")
    export.tractions(result.at(-1), "tractions.csv", frame=frame)
    export.loads(result.at(-1), "block.inp", "loads.inp", frame=frame)
    sigma_B = export.bulk_stress("component.frd", frame=frame)
"""

from pyfret._util.names import listing
from pyfret.export.frame import Frame
from pyfret.export.hysteresis import hysteresis
from pyfret.export.images import image
from pyfret.export.nodes import loads, nodal_forces
from pyfret.export.read import bulk_stress, compliance
from pyfret.export.tables import stress, tractions
from pyfret.export.write import write

__all__ = [
    "Frame",
    "bulk_stress",
    "compliance",
    "hysteresis",
    "image",
    "loads",
    "nodal_forces",
    "stress",
    "tractions",
    "write",
]
__dir__ = listing(__all__)
