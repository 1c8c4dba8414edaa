"""The sliders: what can be dragged in a scene, and the scene that follows."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from pyfret._core import Branch, Coating, Cylinder, Elastic, LoadPath, Scene, Sphere

__all__ = ["CONTROLS", "Control", "changed", "controls", "in_increments"]

#: A slider goes from the value over this to the value times this.
SPAN = 8.0
#: Loads and moments of a branch, which grow together.
LOADS = ("W", "T_x", "T_y", "M_x", "M_y", "M_z")


@dataclass(frozen=True)
class Control:
    """A slider over the logarithm of a parameter."""

    name: str
    label: str
    #: Unit of the label, and how much it is in SI.
    unit: str
    scale: float
    #: Largest value; of a friction coefficient 2.
    most: float
    #: The value of a scene, or nothing where it has no such parameter.
    read: Callable[[Scene], float | None]
    #: The scene with another value.
    write: Callable[[Scene, float], Scene]

    def ends(self, scene: Scene) -> tuple[float, float]:
        """The ends of the slider."""
        value = self.read(scene)
        assert value is not None
        return value / SPAN, min(value * SPAN, self.most)

    def text(self, value: float) -> str:
        """A value as text."""
        return f"{value / self.scale:.3g} {self.unit}".strip()


def coated(scene: Scene) -> int | None:
    """The body whose outermost coating is dragged: the lower one, if it has one."""
    return 2 if scene.body2.coatings else 1 if scene.body1.coatings else None


def outermost(scene: Scene) -> Coating | None:
    """The coating that is dragged."""
    number = coated(scene)
    if number is None:
        return None
    return (scene.body2 if number == 2 else scene.body1).coatings[0]


def with_coating(scene: Scene, coating: Coating) -> Scene:
    """The scene with another outermost coating."""
    number = coated(scene)
    body = scene.body2 if number == 2 else scene.body1
    made = body.replace(coatings=[coating, *body.coatings[1:]])
    return scene.replace(body2=made) if number == 2 else scene.replace(body1=made)


def thickness(scene: Scene, value: float) -> Scene:
    """The scene with another thickness."""
    coating = outermost(scene)
    assert coating is not None
    return with_coating(scene, coating.replace(thickness=value))


def modulus(scene: Scene, value: float) -> Scene:
    """The scene with another modulus of the coating."""
    coating = outermost(scene)
    assert coating is not None
    return with_coating(scene, coating.replace(material=Elastic(E=value, nu=coating.material.nu)))


def radius(scene: Scene) -> float | None:
    """The radius of the upper body."""
    shape = scene.body1.shape
    return shape.R if isinstance(shape, Sphere | Cylinder) and shape.R > 0.0 else None


def with_radius(scene: Scene, value: float) -> Scene:
    """The scene with another radius."""
    shape: Any = scene.body1.shape
    return scene.replace(body1=scene.body1.replace(shape=shape.replace(R=value)))


def load(scene: Scene) -> float | None:
    """The largest normal force of the path."""
    return max((abs(branch.W) for branch in scene.path.branches if branch.W), default=None)


def with_load(scene: Scene, value: float) -> Scene:
    """The scene under loads that keep their ratios."""
    before = load(scene)
    assert before is not None
    factor = value / before

    def grown(branch: Branch) -> Branch:
        loads = {name: getattr(branch, name) for name in LOADS}
        return branch.replace(**{k: factor * v for k, v in loads.items() if v is not None})

    return scene.replace(path=scene.path.replace(branches=[grown(b) for b in scene.path.branches]))


#: All sliders.
CONTROLS = (
    Control("load", "normal force, others in proportion", "N", 1.0, math.inf, load, with_load),
    Control(
        "mu",
        "friction coefficient",
        "",
        1.0,
        2.0,
        lambda scene: scene.mu or None,
        lambda scene, value: scene.replace(friction=scene.friction.replace(mu=value)),
    ),
    Control(
        "thickness",
        "thickness of the coating",
        "µm",
        1e-6,
        math.inf,
        lambda scene: coating.thickness if (coating := outermost(scene)) else None,
        thickness,
    ),
    Control(
        "modulus",
        "modulus of the coating",
        "GPa",
        1e9,
        1.2e12,
        lambda scene: coating.material.E if (coating := outermost(scene)) else None,
        modulus,
    ),
    Control("radius", "radius of the upper body", "mm", 1e-3, math.inf, radius, with_radius),
)


def controls(scene: Scene) -> list[Control]:
    """The sliders that a scene has."""
    return [control for control in CONTROLS if control.read(scene) is not None]


def changed(scene: Scene, values: Mapping[str, float], *, n: int) -> Scene:
    """The scene with the values of the sliders, on n cells along x of a grid that fits.

    The grid keeps its ratio to the Hertz contact of the uncoated pair.
    """
    made = scene
    for control in controls(scene):
        if control.name in values:
            made = control.write(made, values[control.name])
    before, after = scene.hertz, made.hertz
    ratio = after.a / before.a if before is not None and after is not None else 1.0
    grid = scene.grid
    dx = grid.nx * grid.dx * ratio / n
    if grid.plane_strain:
        return made.replace(grid=grid.replace(nx=n, dx=dx))
    ny = max(round(n * grid.ny * grid.dy / (grid.nx * grid.dx)), 2)
    return made.replace(grid=grid.replace(nx=n, ny=ny, dx=dx, dy=grid.ny * grid.dy * ratio / ny))


def in_increments(path: LoadPath, counts: list[int]) -> LoadPath:
    """The path in so many increments for each branch."""
    branches = [
        branch.replace(increments=count)
        for branch, count in zip(path.branches, counts, strict=True)
    ]
    return path.replace(branches=branches)
