"""Changes of a scene: a value, a material, a layer, a shape, a load cycle; the grid follows."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

from pyfret import shapes
from pyfret._core import Coating, Cylinder, Grid, LoadPath, Sphere
from pyfret._util.scene_warnings import SceneWarning
from pyfret.fatigue import Materials
from pyfret.material_table import material

if TYPE_CHECKING:
    from collections.abc import Callable

    from pyfret._core import Body, Scene

__all__ = [
    "CYCLES",
    "SHAPES",
    "add_layer",
    "fit_grid",
    "material_names",
    "move_layer",
    "name_of_shape",
    "remove_layer",
    "replace_cycle",
    "replace_material",
    "replace_shape",
    "replace_value",
]

#: Keys that leave the contact where it is: the grid need not follow.
KEEP_GRID = ("friction.", "grid.n", ".residual")
#: Radius of a new shape, thickness of a new layer.
RADIUS, THICKNESS = 5e-3, 2e-6
#: Part of mu W that a new cycle has.
PART = 0.6
#: Shift of a new cycle [m].
SHIFT = 1e-6


def rough_sphere() -> Any:
    """Make a ball with a self-affine rough surface."""
    rough = shapes.Rough(rms=50e-9, hurst=0.8, longest=100e-6, shortest=25e-6)
    return Sphere(R=RADIUS) + rough


#: Shapes that a body can be given.
SHAPES: dict[str, Callable[[], Any]] = {
    "flat": shapes.Flat,
    "ball": lambda: Sphere(R=RADIUS),
    "cylinder along y": lambda: Cylinder(R=RADIUS),
    "cylinder along x": lambda: Cylinder(R=RADIUS, angle="90 deg"),
    "ellipsoid": lambda: shapes.Ellipsoid(R_x=RADIUS, R_y=2 * RADIUS),
    "flat punch, rounded edge": lambda: shapes.FlatPunch(radius=0.3e-3, edge=2e-3),
    "rough ball": rough_sphere,
}
#: Load cycles that a path can be given: the load or the motion that goes to and fro.
CYCLES = {
    "T_x": "tangential force along x",
    "T_y": "tangential force along y",
    "delta_x": "shift along x",
    "M_z": "torsion about z",
    "bulk": "tangential force with bulk stress",
    "none": "normal force alone",
}


def name_of_shape(shape: Any) -> str:
    """Return the name of a shape in the list, or its class where the list has none."""
    for name, make in SHAPES.items():
        listed = make()
        same_angle = getattr(listed, "angle", None) == getattr(shape, "angle", None)
        if type(listed) is type(shape) and (same_angle or not isinstance(shape, Cylinder)):
            return name
    return type(shape).__name__


def fit_grid(scene: Scene, n: int | None = None) -> Scene:
    """Return the scene on a grid that holds the contact, with as many cells along x.

    A scene without a size of its contact keeps its grid.
    """
    grid = scene.grid
    n = n or (grid.nx if grid.plane_strain else min(grid.nx, grid.ny))
    try:
        fitted = Grid.for_contact(
            scene.body1, scene.body2, scene.path, n=n, plane_strain=grid.plane_strain
        )
    except (ValueError, RuntimeError):
        return scene
    return scene.replace(grid=fitted)


def replace_value(scene: Scene, key: str, value: float) -> Scene:
    """Return the scene with another value of a field; the grid follows the contact."""
    if key == "grid.n":
        return fit_grid(scene, max(round(value), 1))
    whole = key.endswith("seed")
    changed = scene.replace({key: round(value) if whole else float(value)})
    if any(part in key for part in KEEP_GRID):
        return changed
    return fit_grid(changed)


def body_of(scene: Scene, body: str) -> Body:
    """Return a body by its key, body1 or body2."""
    return scene.body1 if body == "body1" else scene.body2


def with_body(scene: Scene, body: str, changed: Body) -> Scene:
    """Return the scene with another body, on a grid that follows."""
    replaced = scene.replace(body1=changed) if body == "body1" else scene.replace(body2=changed)
    return fit_grid(replaced)


def with_layers(scene: Scene, body: str, layers: list[Coating]) -> Scene:
    """Return the scene with other coatings of a body."""
    return with_body(scene, body, body_of(scene, body).replace(coatings=layers))


def add_layer(scene: Scene, body: str, name: str = "TiN") -> Scene:
    """Return the scene with one more outermost layer."""
    layers = body_of(scene, body).coatings
    thickness = layers[0].thickness if layers else THICKNESS
    return with_layers(scene, body, [Coating(elastic(name), thickness=thickness), *layers])


def remove_layer(scene: Scene, body: str, n: int) -> Scene:
    """Return the scene without a layer."""
    layers = body_of(scene, body).coatings
    return with_layers(scene, body, [layer for k, layer in enumerate(layers) if k != n])


def move_layer(scene: Scene, body: str, n: int) -> Scene:
    """Return the scene with a layer exchanged with the one below it."""
    layers = body_of(scene, body).coatings
    if n + 1 < len(layers):
        layers[n], layers[n + 1] = layers[n + 1], layers[n]
    return with_layers(scene, body, layers)


def elastic(name: str) -> Any:
    """Return a material of the table, without warnings: the page shows its source."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SceneWarning)
        return material(name)


def replace_material(scene: Scene, part: str, name: str) -> Scene:
    """Return the scene with a material of the table in a body or a layer."""
    body, _, layer = part.partition(".coatings.")
    whole = body_of(scene, body)
    if not layer:
        return with_body(scene, body, whole.replace(substrate=elastic(name)))
    layers = whole.coatings
    layers[int(layer)] = layers[int(layer)].replace(material=elastic(name))
    return with_layers(scene, body, layers)


def replace_shape(scene: Scene, body: str, name: str) -> Scene:
    """Return the scene with another shape of a body."""
    return with_body(scene, body, body_of(scene, body).replace(shape=SHAPES[name]()))


def replace_cycle(scene: Scene, kind: str) -> Scene:
    """Return the scene with another load cycle after its normal force."""
    W = max((abs(branch.W) for branch in scene.path.branches if branch.W), default=1.0)
    path = LoadPath.start().normal(W)
    T = float(f"{PART * (scene.mu or 1.0) * W:.3g}")
    if kind == "T_x":
        path = path.cycles(1, T_x=T)
    elif kind == "T_y":
        path = path.cycles(1, T_y=T)
    elif kind == "delta_x":
        path = path.cycles(1, delta_x=SHIFT)
    elif kind == "M_z":
        hertz = scene.hertz
        arm = hertz.a if hertz is not None else scene.grid.nx * scene.grid.dx / 4
        path = path.cycles(1, M_z=float(f"{0.3 * T * arm:.3g}"))
    elif kind == "bulk":
        for sign in (1.0, -1.0, 1.0):
            path = path.force(T_x=sign * T, sigma_B=sign * 50e6)
    return fit_grid(scene.replace(path=path.rig(scene.path.rig_stiffness)))


def material_names() -> dict[str, tuple[float, float | None]]:
    """Return the materials that have a modulus, with modulus and Poisson's ratio."""
    names = {}
    for name in (table := Materials()):
        numbers = {key: value for key, value, _ in table[name].numbers()}
        if "E" in numbers:
            names[name] = (numbers["E"], numbers.get("nu"))
    return names
