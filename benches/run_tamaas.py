"""The Hertz contact by Tamaas: Polonsky-Keer-Rey with its operator without images."""

from __future__ import annotations

import os
import re
import tempfile

import hertz
import tamaas
from measuring import Solution, Task, measure


def prepare(task: Task) -> tamaas.PolonskyKeerRey:
    """A half-space, its coefficients, and the solver."""
    tamaas.initialize(task.threads)
    width = hertz.width()
    model = tamaas.ModelFactory.createModel(
        tamaas.model_type.basic_2d, [width, width], [task.cells, task.cells]
    )
    model.E, model.nu = hertz.E_STAR, 0.0
    tamaas.ModelFactory.registerNonPeriodic(model, "dcfft")
    solver = tamaas.PolonskyKeerRey(model, -hertz.gap(task.cells), task.tolerance)
    solver.setIntegralOperator("dcfft")
    solver.max_iter = 100_000
    # The first and the last iteration are told, for their number.
    solver.dump_freq = solver.max_iter
    return solver


def solve(solver: tamaas.PolonskyKeerRey) -> Solution:
    """The pressure under the mean pressure asked for; the iterations from what it writes."""
    with tempfile.TemporaryFile() as said:
        kept = os.dup(1)
        os.dup2(said.fileno(), 1)
        solver.solve(hertz.W / hertz.width() ** 2)
        os.dup2(kept, 1)
        os.close(kept)
        said.seek(0)
        numbers = re.findall(r"^\s*(\d+)\s+\S+e\S+\s+\S+e\S+", said.read().decode(), re.MULTILINE)
    return Solution(solver.model.traction.copy(), int(numbers[-1]) if numbers else -1)


if __name__ == "__main__":
    measure(tamaas.__version__, prepare, solve)
