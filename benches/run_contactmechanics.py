"""A frictionless contact by ContactMechanics: Polonsky-Keer on its half-space without images."""

from __future__ import annotations

from importlib.metadata import version

import hertz
from ContactMechanics import FreeFFTElasticHalfSpace
from ContactMechanics.Factory import make_system
from ContactMechanics.Systems import NonSmoothContactSystem
from measuring import Task, Work, measure
from SurfaceTopography import Topography


def prepare(task: Task) -> tuple[NonSmoothContactSystem, Task]:
    """The half-space with its coefficients, and the contact with the sphere."""
    n, width = task.cells, task.shape.width
    sizes = (width, width)
    substrate = FreeFFTElasticHalfSpace((n, n), young=hertz.E_STAR, physical_sizes=sizes)
    sphere = Topography(-hertz.gap(task.shape, n), physical_sizes=sizes)
    return make_system(substrate=substrate, surface=sphere), task


def solve(prepared: tuple[NonSmoothContactSystem, Task]) -> Work:
    """The contact under the force; its tolerances are lengths and forces."""
    system, task = prepared
    n = task.cells
    found = system.minimize_proxy(
        external_force=hertz.W,
        pentol=task.tolerance * hertz.APPROACH,
        forcetol=task.tolerance * hertz.W / n**2,
        thermotol=task.tolerance,
    )
    if not found.success:
        raise RuntimeError(found.message)
    return Work(found.nit, found.nfev)


def pressure(prepared: tuple[NonSmoothContactSystem, Task]) -> hertz.Field:
    """From the forces on the cells, without those of the enlarged domain."""
    system, task = prepared
    n = task.cells
    p: hertz.Field = system.force[:n, :n] * (n / task.shape.width) ** 2
    return p


if __name__ == "__main__":
    measure(version("ContactMechanics"), 1, prepare, solve, pressure)
