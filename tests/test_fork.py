"""Processes that are copies of this one, after it has solved something."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable

import numpy as np
import pytest

import pyfret as fret
from conftest import W, sphere_on_flat

pytestmark = [
    pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork here"),
    pytest.mark.filterwarnings("ignore:.*use of fork:DeprecationWarning"),
]
PATH = fret.LoadPath.start().normal(W, increments=2).tangential(50.0, increments=2)


def in_a_copy(work: Callable[[], bool]) -> int:
    """The exit code of a copy of this process: 0 if `work` returns true, 9 if it hangs."""
    child = os.fork()
    if child == 0:
        try:
            os._exit(0 if work() else 1)
        except BaseException:
            os._exit(2)
    end = time.monotonic() + 40
    while time.monotonic() < end:
        ended, status = os.waitpid(child, os.WNOHANG)
        if ended:
            return os.waitstatus_to_exitcode(status)
        time.sleep(0.02)
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return 9


def test_a_copy_solves_as_well() -> None:
    """A copy and a copy of the copy give the same numbers."""
    scene = sphere_on_flat(ratio=2.0, n=16)
    in_process = fret.solve(scene, PATH, progress=False).dataset

    def same() -> bool:
        there = fret.solve(scene, PATH, progress=False).dataset
        return bool(np.array_equal(there.q_x, in_process.q_x))

    assert in_a_copy(lambda: same() and in_a_copy(same) == 0) == 0


def test_a_copy_of_a_process_at_work_is_refused_at_once() -> None:
    """Locks that another thread held are never given back there."""
    scene = sphere_on_flat(ratio=2.0, n=128)
    begun = threading.Event()

    def work() -> None:
        for _ in fret.march(scene, PATH):
            begun.set()

    at_work = threading.Thread(target=work)
    at_work.start()
    assert begun.wait(60)

    def refused() -> bool:
        try:
            fret.kernels.stress_at(scene.body2, (1e-5, 1e-5), (0.0, 0.0, 1e-5))
        except RuntimeError as error:
            return 'get_context("spawn")' in str(error)
        return not at_work.is_alive()

    code = in_a_copy(refused)
    at_work.join()
    assert code == 0


def test_multiprocessing_by_fork() -> None:
    """Run the code of users in a separate process."""
    script = """
import multiprocessing, warnings
import pyfret as fret
warnings.simplefilter("ignore")
steel = fret.Elastic(E=210e9, nu=0.3)
body = fret.Body(steel, coatings=[fret.Coating(fret.Elastic(E=400e9, nu=0.2), thickness=1e-5)])
def work(n):
    grid = fret.Grid.centred(width=1e-4, n=n)
    return float(fret.kernels.influence_coefficients(body, grid)[2, 2].max())
before = [work(n) for n in (8, 12)]
with multiprocessing.get_context("fork").Pool(2) as pool:
    assert pool.map(work, (8, 12)) == before
"""
    subprocess.run([sys.executable, "-c", script], check=True, timeout=80)
