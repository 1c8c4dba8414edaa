"""Distribution of points to processes, threads or a cluster."""

from __future__ import annotations

import contextlib
import os
import sys
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    CancelledError,
    Executor,
    Future,
    wait,
)
from pathlib import Path
from typing import Any

from pyfret._util.processors import count_processors
from pyfret.study.point import FAILED, Outcome, failure

__all__ = ["Workers"]

#: Points that are submitted for each worker: one at work, one waiting.
POINTS_PER_WORKER = 2
#: Deaths of workers at a point after which the point is taken for the cause.
DEATHS = 3

#: Seconds between two checks of a worker that its parent process is alive.
WATCH = 0.5

#: Hands the n-th point to an executor.
Submit = Callable[[Executor, int], "Future[Outcome]"]


@contextlib.contextmanager
def standard_streams() -> Iterator[None]:
    """Replace missing standard streams, as under pythonw and in services.

    Libraries that start processes flush them.
    """
    missing = [name for name in ("stdout", "stderr") if getattr(sys, name) is None]
    with Path(os.devnull).open("w", encoding="utf-8") as nowhere:
        for name in missing:
            setattr(sys, name, nowhere)
        try:
            yield
        finally:
            for name in missing:
                if getattr(sys, name) is nowhere:
                    setattr(sys, name, None)


class Workers:
    """An executor, and the number of points that it takes at a time.

    Parameters
    ----------
    executor : None, int, Executor or distributed.Client
        None: one local process for each processor; a number: that many; an executor of
        ``concurrent.futures``; or a client of a Dask cluster.
    points : int
        Number of points, the upper limit of the processes.
    """

    def __init__(self, executor: Any, points: int) -> None:
        self.own: Callable[[], Executor] | None = None
        if executor is None or isinstance(executor, int):
            count = max(min(executor or count_processors(), points), 1)
            self.threads: int | None = max(count_processors() // count, 1)
            self.ahead = POINTS_PER_WORKER * count
            self.own = lambda: local_executor(count, self.threads or 1)
            self.executor = self.own()
        elif hasattr(executor, "get_executor"):
            # A client of Dask: it hands the points of a dead worker to others by itself.
            self.executor = executor.get_executor(pure=False)
            threads_per_worker = list(executor.nthreads().values())
            self.threads = max(threads_per_worker, default=1)
            self.ahead = POINTS_PER_WORKER * max(sum(threads_per_worker), 1)
        elif isinstance(executor, Executor):
            count = int(getattr(executor, "_max_workers", None) or count_processors())
            self.executor, self.threads = executor, max(count_processors() // count, 1)
            self.ahead = POINTS_PER_WORKER * count
        else:
            raise TypeError(
                f"executor = {executor!r}: must be a number of processes, an executor of "
                "concurrent.futures or a dask.distributed.Client"
            )

    def run(self, points: list[int], submit: Submit) -> Iterator[tuple[int, Outcome]]:
        """Yield the outcomes of all points as they come."""
        waiting = points[::-1]
        at_work: dict[Future[Outcome], int] = {}
        deaths: dict[int, int] = {}
        streams = contextlib.ExitStack()
        try:
            streams.enter_context(standard_streams())
            while waiting or at_work:
                broken = self.hand_out(waiting, at_work, deaths, submit)
                done, _ = wait(at_work, return_when=FIRST_COMPLETED)
                for future in done:
                    point = at_work.pop(future)
                    try:
                        yield point, future.result()
                    except (BrokenExecutor, CancelledError):
                        broken = True
                        at_work[future] = point
                    except Exception as error:
                        yield point, failure(error)
                if broken:
                    yield from self.mend(waiting, at_work, deaths)
        finally:
            for future in at_work:
                future.cancel()
            if self.own is not None:
                shut_down(self.executor)
            streams.close()

    def hand_out(
        self,
        waiting: list[int],
        at_work: dict[Future[Outcome], int],
        deaths: dict[int, int],
        submit: Submit,
    ) -> bool:
        """Submit as many points as the workers take; return True if the executor is broken.

        Points that were at work when a process died are handed out alone, so that no other one is
        taken for the cause.
        """
        while waiting and len(at_work) < self.ahead:
            if at_work and (waiting[-1] in deaths or any(n in deaths for n in at_work.values())):
                return False
            try:
                future = submit(self.executor, waiting[-1])
            except BrokenExecutor:
                return True
            at_work[future] = waiting.pop()
        return False

    def mend(
        self, waiting: list[int], at_work: dict[Future[Outcome], int], deaths: dict[int, int]
    ) -> Iterator[tuple[int, Outcome]]:
        """Start new processes in place of those that died, and hand out their points again."""
        if self.own is None:
            raise RuntimeError(
                "the executor is broken: a worker was killed. Points that are done are in the "
                "store; the same call with another executor goes on with the others"
            )
        lost = sorted(at_work.values(), key=lambda n: (deaths.get(n, 0), -n))
        whole = [f for f in at_work if f.done() and not f.cancelled() and f.exception() is None]
        finished = {at_work[future]: future for future in whole}
        at_work.clear()
        for point in lost:
            deaths[point] = deaths.get(point, 0) + 1
            if point in finished:
                yield point, finished[point].result()
            elif deaths[point] < DEATHS:
                waiting.append(point)
            else:
                reason = f"its process was killed {DEATHS} times; is there enough memory?"
                yield point, Outcome(FAILED, reason)
        shut_down(self.executor)
        self.executor = self.own()


def local_executor(count: int, threads: int) -> Executor:
    """Make an executor of local processes that share the processors."""
    from loky import ProcessPoolExecutor

    # What lies in the current folder is no part of Python.
    env = {"RAYON_NUM_THREADS": str(threads), "PYTHONSAFEPATH": "1"}
    pool: Executor = ProcessPoolExecutor(
        count, env=env, initializer=end_with_parent, initargs=(os.getpid(),)
    )
    return pool


def end_with_parent(parent: int) -> None:
    """End this process once its parent has ended."""

    def watch() -> None:
        """End the process once its parent has ended."""
        while os.getppid() == parent:
            time.sleep(WATCH)
        os._exit(1)

    if os.name == "posix":
        threading.Thread(target=watch, daemon=True, name="watch the parent").start()


def shut_down(executor: Executor) -> None:
    """End the processes of our own executor at once."""
    executor.shutdown(wait=True, kill_workers=True)  # type: ignore[call-arg]
