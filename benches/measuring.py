"""How a program is measured: alone in its process, warmed up, the best of several solutions.

Each ``run_*.py`` hands :func:`measure` two functions and prints one line of JSON.
"""

from __future__ import annotations

import argparse
import json
import resource
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from hertz import judge

if TYPE_CHECKING:
    from collections.abc import Callable

    from hertz import Field

#: Processors raise their clock within about this time of steady work [s].
WARM_UP = 1.5


class Solution(NamedTuple):
    """What a program found."""

    p: Field
    iterations: int
    #: Convolutions, as far as the program tells.
    convolutions: float | None = None


class Task(NamedTuple):
    """What a program is asked for."""

    cells: int
    tolerance: float
    threads: int
    preset: str


def peak_memory() -> int:
    """Most memory that this process has held so far [bytes]."""
    status = Path("/proc/self/status")
    if status.exists():
        # Unlike the count of getrusage this one does not begin with that of the parent process.
        lines = dict(line.split(":", 1) for line in status.read_text().splitlines() if ":" in line)
        return 1024 * int(lines["VmHWM"].split()[0])
    unit = 1 if sys.platform == "darwin" else 1024
    return unit * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def spin(seconds: float) -> None:
    """Keep the processor busy."""
    end = time.perf_counter() + seconds
    while time.perf_counter() < end:
        pass


def measure(
    version: str, prepare: Callable[[Task], Any], solve: Callable[[Any], Solution]
) -> None:
    """Prepare and solve until the time is up, and print times, memory and errors.

    `prepare` makes everything that the solution needs (coefficients, plans) and is timed apart; the
    first one is counted, for what a program keeps makes the next ones cheaper.
    """
    parser = argparse.ArgumentParser()
    parser.add_argument("--cells", type=int, required=True)
    parser.add_argument("--tolerance", type=float, required=True)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--preset", default="fast")
    parser.add_argument("--seconds", type=float, default=4.0, help="time for the repetitions")
    parser.add_argument("--started", type=float, help="when the process was started")
    options = parser.parse_args()
    start_up = time.time() - options.started if options.started else 0.0
    task = Task(options.cells, options.tolerance, options.threads, options.preset)
    empty = peak_memory()
    spin(WARM_UP)
    preparations, solutions = [], []
    memory = 0
    end = time.perf_counter() + options.seconds
    while not solutions or time.perf_counter() + solutions[-1] < end:
        begun = time.perf_counter()
        state = prepare(task)
        prepared = time.perf_counter()
        solution = solve(state)
        solutions.append(time.perf_counter() - prepared)
        preparations.append(prepared - begun)
        memory = memory or peak_memory()
    line = {
        "version": version,
        "cells": task.cells,
        "tolerance": task.tolerance,
        "start_up_s": start_up,
        "set_up_s": preparations[0],
        "solve_s": min(solutions),
        "repetitions": len(solutions),
        "iterations": solution.iterations,
        "convolutions": solution.convolutions,
        "memory_empty": empty,
        "memory": memory,
        **judge(solution.p),
    }
    print(json.dumps(line))
