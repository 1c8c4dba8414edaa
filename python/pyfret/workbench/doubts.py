"""Doubts of a scene at the field that causes them, with the change that removes them."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from pyfret._core import InvalidSceneError
from pyfret.workbench.fields import fields_of

if TYPE_CHECKING:
    from pyfret._core import Scene

__all__ = ["Doubt", "doubt_of_sentence", "doubts_of", "locate_key"]

#: Most cells along a side that a button offers: more take minutes.
MOST_CELLS = 512
#: Part of the largest tangential force that a button sets.
PART = 0.9
#: Patterns of remedies in sentences.
CELLS = re.compile(r"grid\.n = \[?(\d+)")
CELL_LENGTH = re.compile(r"use cells of ([\d.e+-]+) m")
FRICTION_LIMIT = re.compile(r"path\[(\d+)\]\.(T_[xy]) = .*<= mu W = ([\d.e+-]+)")


@dataclass(frozen=True)
class Doubt:
    """A doubt in words."""

    sentence: str
    #: Key of the field that causes it; "" of the whole scene.
    key: str = ""
    #: Text of the button; "" without a remedy.
    button: str = ""
    #: Values that remove it, by keys of fields; "grid.n" alone lets the grid follow.
    values: dict[str, float] = field(default_factory=dict)


def locate_key(scene: Scene, sentence: str) -> str:
    """Return the key of the field that a sentence names, "" where it names none."""
    match = re.search(r"((?:body[12]|path|friction|grid)[\w.\[\]]*)", sentence)
    if match is None:
        return "grid.n" if "grid" in sentence or "cells" in sentence else ""
    key = re.sub(r"\[(\d+)\]", r".\1", match[1]).rstrip(".")
    keys = [field.key for group in fields_of(scene).values() for field in group]
    for candidate in keys:
        if key in [part.removeprefix("-") for part in candidate.split(",")]:
            return candidate
    # A sentence may leave out the kind of a shape, body1.shape.R.
    head, _, tail = key.rpartition(".")
    near = [k for k in keys if head and k.startswith(head) and k.endswith(f".{tail}")]
    return near[0] if near else "grid.n" if key.startswith("grid") else ""


def doubt_of_sentence(scene: Scene, sentence: str) -> Doubt:
    """Place a sentence at its field, with the button that its remedy needs."""
    text = re.sub(r"^scene:\d+: |^setting [^:]*: ", "", sentence)
    key = locate_key(scene, text)
    n = 0
    if match := CELLS.search(text):
        n = int(match[1])
    elif match := CELL_LENGTH.search(text):
        n = math.ceil(scene.grid.nx * scene.grid.dx / float(match[1]))
    if n > MOST_CELLS:
        return Doubt(f"{text}. That takes {n} cells along x, minutes: solve it as a file", key)
    if n:
        return Doubt(text, key, f"use {n} cells", {"grid.n": float(n)})
    if match := FRICTION_LIMIT.search(text):
        value = float(f"{PART * float(match[3]):.3g}")
        load = locate_key(scene, f"path[{match[1]}].{match[2]}")
        unit = scene.grid.unit_of("N")
        return Doubt(text, load, f"use {match[2]} = {value:g} {unit}", {load: value})
    if "touches the border of the grid" in text or "does not fit on the grid" in text:
        return Doubt(text, "grid.n", "fit the grid", {"grid.n": float(scene.grid.nx)})
    return Doubt(text, key)


def doubts_of(scene: Scene) -> list[Doubt]:
    """Return the doubts of a scene, each once."""
    try:
        sentences = scene.doubts()
    except InvalidSceneError as error:
        return [doubt_of_sentence(scene, str(error))]
    return [doubt_of_sentence(scene, sentence) for sentence in dict.fromkeys(sentences)]
