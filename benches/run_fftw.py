"""Time of the transforms of one three-component convolution by FFTW, through pyFFTW.

Six real fields on the doubled domain, three there and three back: each is n row transforms between
real and complex (the other n rows are zero, or not wanted) and n + 1 transforms of columns. Only
the transforms are counted, no product and no copy. FFTW measures its plans; of the ways to lay the
half spectrum out in memory, the fastest counts.
"""

from __future__ import annotations

import argparse
import json
import time
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
import pyfftw
from measuring import WARM_UP, spin

if TYPE_CHECKING:
    from collections.abc import Callable

    #: Forward and backward transform of one field: what to execute in turn.
    Layout = tuple[list[Callable[[], None]], list[Callable[[], None]], np.ndarray, np.ndarray]

THERE, BACK = "FFTW_FORWARD", "FFTW_BACKWARD"


def plan(source: np.ndarray, target: np.ndarray, axis: int, direction: str) -> Callable[[], None]:
    """One set of one-dimensional transforms along an axis, on one thread."""
    flags = ("FFTW_MEASURE",)
    execute: Callable[[], None] = pyfftw.FFTW(
        source, target, axes=(axis,), direction=direction, flags=flags, threads=1
    ).execute
    return execute


def fields(n: int) -> tuple[np.ndarray, np.ndarray]:
    """The loaded rows of a field, and those of its transform transformed back."""
    return pyfftw.zeros_aligned((n, 2 * n)), pyfftw.zeros_aligned((n, 2 * n))


def apart(n: int, *, by_columns: bool = False) -> Layout:
    """Columns transformed from one array to another, by rows of memory or by columns."""
    rows, result = fields(n)
    shape = (n + 1, 2 * n) if by_columns else (2 * n, n + 1)
    half, full, back = (pyfftw.zeros_aligned(shape, dtype=complex) for _ in range(3))
    axis = 1 if by_columns else 0
    half_rows, back_rows = (half.T, back.T) if by_columns else (half, back)
    there = [plan(rows, half_rows[:n], 1, THERE), plan(half, full, axis, THERE)]
    again = [plan(full, back, axis, BACK), plan(back_rows[:n], result, 1, BACK)]
    half[:] = 0
    return there, again, rows, result


def in_place(n: int) -> Layout:
    """Columns transformed where they are; their zeros have to be restored each time."""
    rows, result = fields(n)
    half = pyfftw.zeros_aligned((2 * n, n + 1), dtype=complex)

    def clear() -> None:
        half[n:] = 0

    there = [plan(rows, half[:n], 1, THERE), clear, plan(half, half, 0, THERE)]
    again = [plan(half, half, 0, BACK), plan(half[:n], result, 1, BACK)]
    return there, again, rows, result


def seconds(n: int, layout: Callable[[int], Layout], duration: float) -> float:
    """The best time of six transforms [s]."""
    there, again, rows, result = layout(n)
    field = np.random.default_rng(0).random((n, n))
    rows[:] = 0
    rows[:, :n] = field
    for step in there + again:
        step()
    if not np.allclose(result[:, :n], 4 * n * n * field, rtol=0, atol=1e-9 * n * n):
        raise RuntimeError("there and back is not the same")
    best = np.inf
    end = time.perf_counter() + duration
    while time.perf_counter() < end:
        begun = time.perf_counter()
        for _ in range(3):
            for step in there:
                step()
        for _ in range(3):
            for step in again:
                step()
        best = min(best, time.perf_counter() - begun)
    return best


def main() -> None:
    """Print one line of JSON for each number of cells."""
    parser = argparse.ArgumentParser()
    parser.add_argument("cells", type=int, nargs="+")
    parser.add_argument("--seconds", type=float, default=1.0, help="time for each layout")
    options = parser.parse_args()
    spin(WARM_UP)
    layouts: dict[str, Callable[[int], Layout]] = {
        "by rows": apart,
        "by columns": partial(apart, by_columns=True),
        "in place": in_place,
    }
    for n in options.cells:
        times = {name: seconds(n, of, options.seconds) for name, of in layouts.items()}
        layout = min(times, key=times.__getitem__)
        line = {"cells": n, "seconds": times[layout], "layout": layout}
        print(json.dumps(line | {"version": pyfftw.__version__}), flush=True)


if __name__ == "__main__":
    main()
