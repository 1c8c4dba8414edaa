"""Ctrl-C in long calls that solve nothing: they end soon and leave no files."""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

import pyfret as fret
from conftest import pair

STEEL, _ = pair(0.3)
#: When to press Ctrl-C, counted from the start of the call [s]: the first that is not too late on
#: this machine.
AFTER = [0.2, 0.1, 0.05, 0.025, 0.0125]
#: A second; the machine may be busy with other things [s].
SOON = 3.0

BODY = fret.Body(STEEL, coatings=[fret.Coating(fret.Elastic(E=4 * STEEL.E, nu=0.3), thickness=0.5)])


@pytest.fixture(autouse=True)
def _ctrl_c() -> Iterator[None]:
    """Let SIGINT raise KeyboardInterrupt, also where the tests run in the background."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def load(n: int) -> tuple[fret.Grid, np.ndarray]:
    grid = fret.Grid.centred(width=2.4, n=n)
    x, y = np.meshgrid(grid.x, grid.y, indexing="ij")
    return grid, np.sqrt(np.maximum(1 - x**2 - y**2, 0))


def section(_: Path) -> object:
    grid, p = load(1024)
    return fret.subsurface.stress(BODY, grid, np.linspace(0, 2, 2000), p=p, q_x=p, y=0.0)


def planes(_: Path) -> object:
    grid, p = load(1024)
    return fret.subsurface.stress(BODY, grid, [0.1, 0.2], p=p, q_x=p)


def points(_: Path) -> object:
    grid, p = load(512)
    places = [(0.1, 0.1, z, 0) for z in np.linspace(0.001, 0.4, 2000)]
    return fret._core.Subsurface(BODY, grid, p=p).points(places)


def volume(out: Path) -> None:
    grid, p = load(1024)
    z = np.linspace(0, 1, 50)
    fret.subsurface.write_volume(BODY, grid, out, z, p=p)


def coefficients(_: Path) -> object:
    grid, _p = load(2048)
    return fret._core.stress_coefficients(BODY, grid, 0.7)


@pytest.mark.parametrize("call", [section, planes, points, volume, coefficients])
def test_ctrl_c_ends_the_call(call: Callable[[Path], object], tmp_path: Path) -> None:
    for after in AFTER:
        folder = tmp_path / str(after)
        folder.mkdir()
        raised: list[float] = []

        def interrupt(raised: list[float] = raised) -> None:
            raised.append(time.perf_counter())
            os.kill(os.getpid(), signal.SIGINT)

        timer = threading.Timer(after, interrupt)
        timer.start()
        ended = False
        try:
            call(folder / "out.zarr")
            ended = True
            timer.cancel()
            timer.join()
        except KeyboardInterrupt:
            if ended:
                continue
            assert time.perf_counter() - raised[0] < SOON
            assert list(folder.iterdir()) == []
            return
    pytest.fail(f"the call ends within {AFTER[-1]} s")
