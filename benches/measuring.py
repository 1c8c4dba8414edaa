"""How a program is measured: alone in its process, warmed up, the best of several solutions.

Each ``run_*.py`` hands :func:`measure` two functions and prints one line of JSON.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from hertz import SHAPES, Shape, judge, roughness

if TYPE_CHECKING:
    from collections.abc import Callable

    from hertz import Field

#: Processors raise their clock within about this time of steady work [s].
WARM_UP = 1.5


class Work(NamedTuple):
    """What a solution took, as far as the program tells."""

    iterations: int
    convolutions: float | None = None


class Task(NamedTuple):
    """What a program is asked for."""

    shape: Shape
    cells: int
    tolerance: float
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


def threads_allowed() -> int:
    """The number of threads that this run may use."""
    return int(os.environ.get("RAYON_NUM_THREADS", "1"))


def spin(seconds: float) -> None:
    """Keep the processor busy."""
    end = time.perf_counter() + seconds
    while time.perf_counter() < end:
        pass


def measure(
    version: str,
    threads: int,
    prepare: Callable[[Task], Any],
    solve: Callable[[Any], Work],
    pressure: Callable[[Any], Field],
) -> None:
    """Prepare and solve until the time is up, and print a line for every tolerance.

    `threads` is the number that the program runs on. `prepare` makes what the solution needs
    (coefficients, plans) and is timed apart; the first one counts, since what a program keeps makes
    the next ones cheaper. Reading the pressure out is not counted.
    """
    parser = argparse.ArgumentParser()
    parser.add_argument("--cells", type=int, required=True)
    parser.add_argument("--tolerance", type=float, nargs="+", required=True)
    parser.add_argument("--until", type=float, default=0.0, help="residual that is small enough")
    parser.add_argument("--scene", choices=SHAPES, default="hertz")
    parser.add_argument("--preset", default="fast")
    parser.add_argument("--seconds", type=float, default=4.0, help="time for repetitions")
    parser.add_argument("--started", type=float, help="when the process was started")
    options = parser.parse_args()
    start_up = time.time() - options.started if options.started else 0.0
    shape = SHAPES[options.scene]
    if shape.rms > 0:
        # The heights are given: neither the memory nor the time of a program.
        roughness(shape, options.cells)
    line: dict[str, Any] = {"version": version, "threads": threads, "start_up_s": start_up}
    line |= {"scene": options.scene, "cells": options.cells, "memory_empty": peak_memory()}
    spin(WARM_UP)
    set_up = memory = None
    for tolerance in options.tolerance:
        task = Task(shape, options.cells, tolerance, options.preset)
        solutions: list[float] = []
        of_processor: list[float] = []
        end = time.perf_counter() + options.seconds
        while not solutions or time.perf_counter() + solutions[-1] < end:
            begun = time.perf_counter()
            state = prepare(task)
            prepared, used = time.perf_counter(), time.process_time()
            work = solve(state)
            solutions.append(time.perf_counter() - prepared)
            of_processor.append(time.process_time() - used)
            set_up = set_up or prepared - begun
            memory = memory or peak_memory()
        line |= {"tolerance": tolerance, "set_up_s": set_up, "memory": memory}
        line |= {"solve_s": min(solutions), "repetitions": len(solutions)}
        # Of all threads together; unlike the time it does not grow when the machine is shared.
        line |= {"processor_s": min(of_processor)}
        line |= work._asdict() | judge(pressure(state), shape)
        print(json.dumps(line), flush=True)
        if line["residual"] < options.until:
            break
