"""Scenes to begin with, each made by the public classes of materials by their names."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from pyfret import shapes
from pyfret._core import Body, Coating, Cylinder, Grid, LoadPath, Scene, Sphere
from pyfret.workbench.edits import elastic

__all__ = ["FIRST", "PRESETS", "Preset", "make_preset"]

#: Cells along x of a contact of a ball, and of a line contact.
CELLS, CELLS_OF_LINES = 48, 192
#: A scene, and the names of the materials of its parts.
Preset = tuple[Scene, dict[str, str]]
#: Material of a body, its shape, and its layers from the surface down with their thickness [m].
Parts = tuple[str, Any, Sequence[tuple[str, float]]]


def ball_on_coated_flat() -> Preset:
    """Build an alumina ball on titanium with 3 um of titanium nitride."""
    path = LoadPath.start().normal(10.0).cycles(1, T_x=3.0)
    ball = ("alumina", Sphere(R=5e-3), ())
    flat = ("titanium_6Al4V", shapes.Flat(), [("TiN", 3e-6)])
    return assemble(ball, flat, path, mu=0.4)


def pad_with_bulk_stress() -> Preset:
    """Build a cylindrical pad on a fatigue specimen: forces per metre, bulk stress in phase."""
    path = LoadPath.start().normal(200e3)
    for sign in (1.0, -1.0, 1.0):
        path = path.force(T_x=sign * 60e3, sigma_B=sign * 60e6)
    pad = ("aluminium_7075_T6", Cylinder(R=50e-3), ())
    specimen = ("aluminium_7075_T6", shapes.Flat(), ())
    return assemble(pad, specimen, path, mu=0.6, plane_strain=True)


def crossed_cylinders() -> Preset:
    """Two crossed cylinders of bearing steel, as in many fretting rigs."""
    upper = ("steel_100Cr6", Cylinder(R=5e-3), ())
    lower = ("steel_100Cr6", Cylinder(R=5e-3, angle="90 deg"), ())
    path = LoadPath.start().normal(20.0).cycles(1, delta_x=1.5e-6)
    return assemble(upper, lower, path, mu=0.6)


def connector() -> Preset:
    """A contact point of a connector: a small dome on a coated flat, under a shift."""
    dome = ("nickel_718", Sphere(R=1.5e-3), ())
    flat = ("nickel_718", shapes.Flat(), [("TiN", 1e-6)])
    path = LoadPath.start().normal(1.0).cycles(1, delta_x=0.2e-6)
    return assemble(dome, flat, path, mu=0.3)


def rough_ball() -> Preset:
    """Build a steel ball with a rough surface on a steel flat."""
    rough = shapes.Rough(rms=50e-9, hurst=0.8, longest=100e-6, shortest=25e-6)
    ball = ("steel_100Cr6", Sphere(R=5e-3) + rough, ())
    path = LoadPath.start().normal(10.0).cycles(1, T_x=3.0)
    return assemble(ball, ("steel_100Cr6", shapes.Flat(), ()), path, mu=0.5)


def make_body(parts: Parts) -> Body:
    """Make a body of materials of the table."""
    name, shape, layers = parts
    coatings = [Coating(elastic(layer), thickness=thickness) for layer, thickness in layers]
    return Body(elastic(name), shape=shape, coatings=coatings)


def assemble(
    upper: Parts, lower: Parts, path: LoadPath, *, mu: float, plane_strain: bool = False
) -> Preset:
    """Put bodies and loads on a grid that holds the contact, and name the materials."""
    n = CELLS_OF_LINES if plane_strain else CELLS
    body1, body2 = make_body(upper), make_body(lower)
    grid = Grid.for_contact(body1, body2, path, n=n, plane_strain=plane_strain)
    names = {"body1": upper[0], "body2": lower[0]}
    for body, (_, _, layers) in (("body1", upper), ("body2", lower)):
        names |= {f"{body}.coatings.{n}": layer for n, (layer, _) in enumerate(layers)}
    return Scene(body1=body1, body2=body2, friction=mu, grid=grid, path=path), names


#: All presets by their names.
PRESETS: dict[str, Callable[[], Preset]] = {
    "Ball on a coated flat": ball_on_coated_flat,
    "Pad with bulk stress": pad_with_bulk_stress,
    "Crossed cylinders": crossed_cylinders,
    "Connector": connector,
    "Rough surface under a ball": rough_ball,
}
#: The preset of a page without a scene.
FIRST = "Ball on a coated flat"


def make_preset(name: str) -> Preset:
    """Make a scene by the name of a preset, with that name as its title."""
    scene, names = PRESETS[name]()
    return scene.replace(title=name), names
