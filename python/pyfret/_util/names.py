"""Names of modules: what ``dir`` lists, and what other programs call things."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Sequence

__all__ = ["MEANT", "OTHER_NAMES", "listing", "meant"]

#: What other programs call things of ``pyfret``.
OTHER_NAMES = {
    "load": "open",
    "Material": "Elastic",
    "Layer": "Coating",
    "Surface": "SurfaceMap",
    "Roughness": "shapes.Rough",
}
#: Names of arguments and attributes by the words and the symbols that others have for them.
MEANT = {
    "radius": ("R", "a", "contact_radius"),
    "young": ("E",),
    "modulus": ("E",),
    "poisson": ("nu",),
    "friction": ("mu",),
    "mu": ("friction",),
    "f": ("mu",),
    "F": ("W",),
    "P": ("W",),
    "N": ("W",),
    "Q": ("T_x",),
    "T": ("T_x",),
    "cof": ("friction", "mu"),
    "load": ("W",),
    "force": ("W",),
    "amplitude": ("T_x", "delta_x"),
    "stroke": ("delta_x",),
    "cells": ("n", "nx", "ny"),
    "size": ("extent", "width", "nx", "ny"),
    "centre": ("middle",),
    "center": ("middle",),
    "workers": ("executor",),
    "place": ("x", "y", "z"),
    "position": ("x", "y", "z"),
    "location": ("x", "y", "z"),
    "depth": ("z", "depth1", "depth2"),
    "plane": ("normal", "inclination"),
    "angle": ("inclination", "azimuth"),
    "direction": ("normal", "inclination"),
    "lives": ("life",),
    "half_width": ("a",),
    "peak_pressure": ("p_H", "p_max"),
    "p_max": ("p_H",),
    "energy": ("dissipated", "dissipated_energy"),
    "spacing": ("dx", "dy"),
    "cell_size": ("spacing", "dx", "dy"),
    "step": ("spacing", "dx", "dy"),
    "pitch": ("spacing", "dx", "dy"),
    "shape": ("nx", "ny"),
    "normal_load": ("W",),
    "normal_force": ("W",),
    "preload": ("W",),
    "shear_force": ("T_x", "T_y"),
    "tangential_force": ("T_x", "T_y"),
    "tangential_load": ("T_x", "T_y"),
    "torque": ("M_z",),
    "torsion": ("M_z", "phi_z"),
    "approach": ("delta_z",),
    "indentation": ("delta_z",),
    "displacement": ("delta_x", "delta_y", "delta_z"),
    "shift": ("delta_x", "delta_y"),
    "slip": ("slip_x", "slip_y"),
    "pressure": ("p", "p_max", "p_H"),
    "traction": ("q_x", "q_y", "p"),
    "area": ("contact_area",),
    "width": ("half_width", "a"),
    "friction_coefficient": ("friction", "mu"),
    "compliance": ("stiffness",),
    "secant_stiffness": ("stiffness",),
    "hysteresis": ("loops",),
    "loop": ("loops",),
    "rim": ("contact_zone", "a"),
    "rims": ("contact_zone", "a"),
    "edges": ("contact_zone", "a"),
    "borders": ("contact_zone", "stick_zone", "a"),
    "volume": ("volume1", "volume2"),
    "wear_depth": ("depth1", "depth2"),
    "worn_depth": ("depth1", "depth2"),
    "time": ("t",),
    "errors": ("error_bars", "error"),
    "safety": ("safety_factor", "margin"),
    "save": ("to_toml",),
    "to_file": ("to_toml",),
    "real_area": ("contact_area",),
    "life": ("cycles_to", "range_of_cycles"),
    "max": ("maximum",),
    "offset": ("middle",),
    "extent": ("width", "nx", "dx"),
}


def meant(name: str, known: Collection[str]) -> list[str]:
    """Those of the names known that a word or a symbol of others means."""
    word = name if len(name) == 1 else name.lower()
    return [synonym for synonym in MEANT.get(word, ()) if synonym in known]


def listing(names: Sequence[str]) -> Callable[[], list[str]]:
    """Give the ``__dir__`` of a module: its public names and no others."""
    return lambda: list(names)
