"""Descriptions of a scene for people who do not know the package."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Any

from pyfret._core import Friction, Sum, SurfaceMap
from pyfret._util.numbers import in_words, length

if TYPE_CHECKING:
    from pyfret._core import Scene

__all__ = ["friction_in_words", "shape_in_words"]

#: What the numbers of shapes are called; all but these are lengths.
SYMBOLS = {"R_x": "R<sub>x</sub>", "R_y": "R<sub>y</sub>"}
#: Numbers without a unit.
PLAIN = frozenset(("hurst", "seed", "slope"))
#: Angles [rad].
ANGLES = frozenset(("angle", "phase"))


def shape_in_words(shape: Any) -> str:
    """Describe a surface: its kind and its numbers, as HTML."""
    if isinstance(shape, Sum):
        return " + ".join(shape_in_words(part) for part in shape.parts)
    if isinstance(shape, SurfaceMap):
        values = shape.__getnewargs_ex__()[1]
        nx, ny = values["values"].shape
        dx, dy = (length(side) for side in values["spacing"])
        steps = dx if dx == dy else f"{dx}, {dy}"
        return f"measured heights, {nx} &times; {ny} points {steps} apart"
    name = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", type(shape).__name__).lower()
    numbers = [
        f"{SYMBOLS.get(key, key)} = {number_in_words(key, value)}"
        for key, value in shape.__getnewargs_ex__()[1].items()
        # A cylinder without an end, an angle of zero, are what is expected.
        if not (key in ANGLES and value == 0.0) and value != math.inf
    ]
    return ", ".join([name, *numbers])


def number_in_words(key: str, value: float) -> str:
    """Format a number of a shape with its unit."""
    if key in PLAIN:
        return in_words(value)
    return f"{in_words(math.degrees(value))}&deg;" if key in ANGLES else length(value)


def friction_in_words(scene: Scene) -> str:
    """Describe the friction of a scene, as HTML."""
    friction = scene.friction
    if not isinstance(friction, Friction) or not math.isfinite(friction.mu):
        return "none slips"
    parts = [
        what if value is None else f"{what.replace('mu', '&mu;', 1)} = {in_words(value)}"
        for what, value in friction.words()
    ]
    return ", ".join(parts)
