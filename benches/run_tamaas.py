"""A frictionless contact by Tamaas: Polonsky-Keer-Rey with its operator without images."""

from __future__ import annotations

import os
import re
import tempfile

import hertz
import tamaas
from measuring import Task, Work, measure, threads_allowed

STDERR = 2


def prepare(task: Task) -> tuple[tamaas.PolonskyKeerRey, Task]:
    """A half-space, its coefficients, and the solver."""
    width = task.shape.width
    model = tamaas.ModelFactory.createModel(
        tamaas.model_type.basic_2d, [width, width], [task.cells, task.cells]
    )
    model.E, model.nu = hertz.E_STAR, 0.0
    tamaas.ModelFactory.registerNonPeriodic(model, "dcfft")
    solver = tamaas.PolonskyKeerRey(model, -hertz.gap(task.shape, task.cells), task.tolerance)
    solver.setIntegralOperator("dcfft")
    solver.max_iter = 100_000
    # The first and the last iteration are told, for their number.
    solver.dump_freq = solver.max_iter
    return solver, task


def solve(prepared: tuple[tamaas.PolonskyKeerRey, Task]) -> Work:
    """The contact under a mean pressure; the iterations from what it writes."""
    solver, task = prepared
    with tempfile.TemporaryFile() as said:
        kept = os.dup(STDERR)
        os.dup2(said.fileno(), STDERR)
        solver.solve(hertz.W / task.shape.width**2)
        os.dup2(kept, STDERR)
        os.close(kept)
        said.seek(0)
        numbers = re.findall(r"^\s*(\d+)\s+\S+e\S+\s+\S+e\S+", said.read().decode(), re.MULTILINE)
    return Work(int(numbers[-1]))


def pressure(prepared: tuple[tamaas.PolonskyKeerRey, Task]) -> hertz.Field:
    """Of the model."""
    p: hertz.Field = prepared[0].model.traction
    return p


if __name__ == "__main__":
    # The wheel may be built without threads.
    parallel = tamaas.TamaasInfo.backend != "cpp"
    threads = threads_allowed() if parallel else 1
    tamaas.initialize(threads)
    measure(tamaas.__version__, threads, prepare, solve, pressure)
