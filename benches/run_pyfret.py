"""A frictionless contact by pyfret, with its own solvers or those of the preset ``spinu2020``."""

from __future__ import annotations

import math

import hertz
from measuring import Task, Work, measure, threads_allowed

import pyfret as fret

STEEL = fret.Elastic(E=hertz.E, nu=hertz.NU)
PRESETS = {"fast": fret.settings.Preset.FAST, "spinu2020": fret.settings.Preset.SPINU2020}


def prepare(task: Task) -> fret._core.March:
    """Everything up to the first increment: coefficients, transforms, buffers."""
    shape: fret.Sphere | fret.shapes.Sum = fret.Sphere(R=hertz.R)
    if task.shape.rms > 0:
        heights = hertz.roughness(task.shape, task.cells)
        shape += fret.SurfaceMap(heights, spacing=task.shape.width / task.cells)
    amplitude, wavelength, phase = task.shape.amplitude, task.shape.wavelength, task.shape.phase
    if amplitude > 0:
        for angle in (0.0, math.pi / 2):
            shape += fret.shapes.Waviness(
                amplitude=amplitude, wavelength=wavelength, angle=angle, phase=phase
            )
    scene = fret.Scene(
        body1=fret.Body(STEEL, shape=shape),
        body2=fret.Body(STEEL),
        friction=0.0,
        grid=fret.Grid.centred(width=task.shape.width, n=task.cells),
        path=fret.LoadPath.start().normal(hertz.W, increments=1),
        settings=fret.Settings(preset=PRESETS[task.preset], tolerance=task.tolerance),
    )
    return fret._core.March(scene)


def solve(march: fret._core.March) -> Work:
    """The increment."""
    scalars = next(march)
    return Work(int(scalars["normal_iterations"]), scalars["convolutions"])


def pressure(march: fret._core.March) -> hertz.Field:
    """Of the fields of the increment this one."""
    p: hertz.Field = march.variables()["p"][1].astype(float, copy=False)
    return p


if __name__ == "__main__":
    measure(fret.__version__, threads_allowed(), prepare, solve, pressure)
