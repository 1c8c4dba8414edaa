"""The Hertz contact by pyfret, with its own solvers or those of the preset ``spinu2020``."""

from __future__ import annotations

import hertz
from measuring import Solution, Task, measure

import pyfret as fret

STEEL = fret.Elastic(E=hertz.E, nu=hertz.NU)
PRESETS = {"fast": fret.Preset.FAST, "spinu2020": fret.Preset.SPINU2020}


def prepare(task: Task) -> fret._core.March:
    """Everything up to the first increment: coefficients, transforms, buffers."""
    scene = fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Sphere(R=hertz.R)),
        body2=fret.Body(STEEL),
        mu=0.0,
        grid=fret.Grid.centred(extent=hertz.width(), n=task.cells),
        path=fret.LoadPath.start().normal(hertz.W, increments=1),
        settings=fret.Settings(preset=PRESETS[task.preset], tolerance=task.tolerance),
    )
    return fret._core.March(scene)


def solve(march: fret._core.March) -> Solution:
    """The increment and its fields."""
    scalars = next(march)
    return Solution(
        march.fields()["p"], int(scalars["normal_iterations"]), scalars["convolutions"]
    )


if __name__ == "__main__":
    measure(fret.__version__, prepare, solve)
