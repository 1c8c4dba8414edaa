"""Surfaces of bodies: every shape, the usual ones among them."""

from pyfret._core import (
    Cone,
    CrownedRoller,
    Cylinder,
    Ellipsoid,
    Flat,
    FlatPunch,
    Ridges,
    Ring,
    Rough,
    Sphere,
    Sum,
    SurfaceMap,
    Waviness,
    Wedge,
)
from pyfret._util.names import listing

__all__ = [
    "Cone",
    "CrownedRoller",
    "Cylinder",
    "Ellipsoid",
    "Flat",
    "FlatPunch",
    "Ridges",
    "Ring",
    "Rough",
    "Sphere",
    "Sum",
    "SurfaceMap",
    "Waviness",
    "Wedge",
]
__dir__ = listing(__all__)
