"""The fields of a scene: keys of the scene file with label, unit and range of a slider."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pyfret import _core
from pyfret._util.toml import parse_toml

if TYPE_CHECKING:
    from pyfret._core import Scene

__all__ = ["BODIES", "Field", "amplitude_key", "fields_of", "find_field", "parse"]

#: A slider goes from the value over this to the value times this.
SPAN = 8.0
#: Names of the bodies in labels.
BODIES = {"body1": "upper body", "body2": "lower body"}
#: Units of the page by the unit in SI, with their size.
UNITS = {
    "m": ("mm", 1e-3),
    "Pa": ("MPa", 1e6),
    "N": ("N", 1.0),
    "N m": ("N mm", 1e-3),
    "rad": ("deg", math.pi / 180),
    "N/m": ("N/µm", 1e6),
}
#: Lengths that people give in micrometres, moduli in gigapascals.
FINE, STIFF = ("µm", 1e-6), ("GPa", 1e9)
#: Keys that people give in micrometres.
MICROMETRES = (
    "thickness",
    "rms",
    "longest",
    "shortest",
    "delta_x",
    "delta_y",
    "amplitude",
    "wavelength",
    "crown",
)
#: Labels by the last part of a key.
LABELS = {
    "R": "radius",
    "R_x": "radius along x",
    "R_y": "radius along y",
    "E": "Young's modulus E",
    "nu": "Poisson's ratio",
    "thickness": "thickness",
    "residual": "residual stress",
    "mu": "friction coefficient",
    "W": "normal force W",
    "T_x": "tangential force T_x",
    "T_y": "tangential force T_y",
    "M_z": "torsional moment M_z",
    "delta_x": "shift delta_x",
    "delta_y": "shift delta_y",
    "sigma_B": "bulk stress of the lower body",
    "sigma_B1": "bulk stress of the upper body",
    "rms": "roughness (rms)",
    "hurst": "Hurst exponent",
    "longest": "longest wave",
    "shortest": "shortest wave",
    "n": "cells along x",
    "angle": "angle to the x axis",
    "edge": "radius of the edge",
    "radius": "radius of the flat part",
}
#: Numbers of shapes without a field.
HIDDEN = ("phase", "spacing")
#: Loads and motions of a branch that have a field, in their order.
LOADS = ("W", "T_x", "T_y", "M_z", "delta_x", "delta_y", "sigma_B", "sigma_B1")


@dataclass(frozen=True)
class Field:
    """A number of a scene that can be changed."""

    #: Key of the scene file; several with commas get one value, after a minus the opposite.
    key: str
    label: str
    #: Unit of the page, and its size in SI.
    unit: str
    scale: float
    #: Value in SI.
    value: float
    #: Whether it is a whole number.
    whole: bool = False

    @property
    def shown(self) -> float:
        """The value in the unit of the page, in six digits."""
        return float(f"{self.value / self.scale:.6g}")

    @property
    def slider(self) -> tuple[float, float] | None:
        """The ends of the slider: decades of the value; None where it has none."""
        if self.value <= 0.0 or not math.isfinite(self.value) or self.whole:
            return None
        low, high = self.value / SPAN, self.value * SPAN
        if self.key.endswith(("nu", "hurst")):
            return None
        if self.key.endswith("mu"):
            high = min(high, 2.0)
        return math.log10(low / self.scale), math.log10(high / self.scale)


def parse(scene: Scene) -> dict[str, Any]:
    """Return the tables of the scene file."""
    return parse_toml(scene.to_toml())


def make_field(key: str, value: float, scene: Scene) -> Field:
    """Make the field of a key, with the unit that people use."""
    name = key.split(",", 1)[0].rpartition(".")[2]
    measured = _core.measured_by(key.split(",", 1)[0].replace(".*.", ".0."))
    unit, scale = UNITS.get(measured[1] if measured else "", ("", 1.0))
    if unit == "mm" and name in MICROMETRES:
        unit, scale = FINE
    if unit == "MPa" and name == "E":
        unit, scale = STIFF
    if name in ("W", "T_x", "T_y", "M_z"):
        unit = scene.grid.unit_of("N") if name != "M_z" else unit
    return Field(key, LABELS.get(name, name), unit, scale, value, whole=name in ("n", "seed"))


def shape_keys(shape: Any, prefix: str) -> Iterator[tuple[str, float]]:
    """Yield the keys of the numbers of a shape."""
    parts = shape.items() if isinstance(shape, dict) else ()
    for name, value in parts:
        if isinstance(value, list):
            for n, part in enumerate(value):
                yield from shape_keys(part, f"{prefix}.{name}.{n}")
        elif isinstance(value, dict):
            yield from shape_keys(value, f"{prefix}.{name}")
        elif isinstance(value, int | float) and math.isfinite(value) and name not in HIDDEN:
            yield f"{prefix}.{name}", float(value)


def amplitude_key(scene: Scene, load: str) -> tuple[str, float] | None:
    """Return the key that sets a load in all branches at once, and its largest value.

    None where the branches have several sizes of it, or none.
    """
    values = [float(getattr(branch, load) or 0.0) for branch in scene.path.branches]
    sizes = {abs(value) for value in values if value}
    if len(sizes) != 1:
        return None
    first = next(value for value in values if value)
    keys = [
        f"{'' if value * first > 0 else '-'}path.{n}.{load}"
        for n, value in enumerate(values)
        if value
    ]
    return ",".join(keys), first


def load_fields(scene: Scene) -> list[Field]:
    """Return the fields of the load path: an amplitude of each load, or a value of each branch."""
    fields = []
    for load in LOADS:
        together = amplitude_key(scene, load)
        if together is not None:
            fields.append(make_field(*together, scene))
            continue
        for n, branch in enumerate(scene.path.branches):
            value = getattr(branch, load)
            if value:
                field = make_field(f"path.{n}.{load}", float(value), scene)
                label = f"{field.label}, branch {n + 1}"
                fields.append(Field(field.key, label, field.unit, field.scale, field.value))
    return fields


def fields_of(scene: Scene) -> dict[str, list[Field]]:
    """Return the fields by the part of the scene: a body, a layer of it, contact, loads."""
    tables = parse(scene)
    groups: dict[str, list[Field]] = {}
    for body in BODIES:
        table = tables[body]
        keys = list(shape_keys(table.get("shape"), f"{body}.shape"))
        groups[f"{body}.shape"] = [make_field(key, value, scene) for key, value in keys]
        for n, layer in enumerate(table.get("coatings", [])):
            names = [name for name in ("thickness", "E", "nu") if name in layer]
            at = f"{body}.coatings.{n}"
            layer_fields = [make_field(f"{at}.{k}", float(layer[k]), scene) for k in names]
            residual = layer.get("residual", 0.0)
            if isinstance(residual, int | float):
                layer_fields.append(make_field(f"{at}.residual", float(residual), scene))
            groups[at] = layer_fields
        names = [k for k in ("E", "nu") if isinstance(table.get(k), int | float)]
        groups[body] = [make_field(f"{body}.{k}", float(table[k]), scene) for k in names]
    contact = []
    if isinstance(tables["friction"].get("mu"), int | float):
        contact.append(make_field("friction.mu", float(scene.mu), scene))
    contact.append(make_field("grid.n", float(scene.grid.nx), scene))
    groups["contact"] = contact
    groups["loads"] = load_fields(scene)
    return groups


def find_field(scene: Scene, key: str) -> Field | None:
    """Return the field with a key, None where the scene has none."""
    return next((f for group in fields_of(scene).values() for f in group if f.key == key), None)
