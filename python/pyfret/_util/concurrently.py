"""Several runs at a time in threads, with one bar, one end and one first error.

The compiled solver frees the interpreter's lock. Every run has threads of its own: in common ones
each run waits for pieces of the others.
"""

from __future__ import annotations

import threading
from concurrent.futures import FIRST_EXCEPTION, Future, ThreadPoolExecutor, wait
from typing import TYPE_CHECKING, TypeVar

from pyfret import _core
from pyfret._util.processors import count_threads

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from pyfret._util.progress import Progress

__all__ = ["run_concurrently"]

#: Seconds between two looks at signals.
LOOK = 0.1

Result = TypeVar("Result")


class StoppedError(Exception):
    """Another run failed, or the user ended the call."""


class SharedCounts:
    """Increments of several runs, drawn as one bar.

    The total of a run is known once it has begun. Until then it is the mean of the others.
    """

    def __init__(self, runs: int, bar: Progress) -> None:
        self.runs, self.bar = runs, bar
        self.stopped = threading.Event()
        self.lock = threading.Lock()
        self.counts: dict[str, tuple[int, int]] = {}

    def counter(self, name: str) -> Callable[[int, int], None]:
        """Return the function that counts the increments of a run, and ends it."""

        def count(done: int, total: int) -> None:
            if self.stopped.is_set():
                raise StoppedError(name)
            with self.lock:
                self.counts[name] = done, total
                together = sum(row[0] for row in self.counts.values())
                totals = sum(row[1] for row in self.counts.values())
                self.bar.update(together, -(-totals * self.runs // len(self.counts)))

        return count


def run_concurrently(
    works: Mapping[str, Callable[[Callable[[int, int], None]], Result]],
    bar: Progress,
) -> dict[str, Result]:
    """Do works by their names, as many at a time as a run has threads.

    A work gets the function to call with the increments done and their total. Once a work fails,
    or a signal interrupts the caller, this function raises in all others.
    """
    if len(works) == 1:
        return {name: work(bar.update) for name, work in works.items()}
    shared = SharedCounts(len(works), bar)
    at_once = min(len(works), count_threads())
    threads = max(count_threads() // at_once, 1)
    with ThreadPoolExecutor(at_once, initializer=_core.limit_threads, initargs=(threads,)) as pool:
        futures: dict[str, Future[Result]] = {
            name: pool.submit(work, shared.counter(name)) for name, work in works.items()
        }
        try:
            waiting = set(futures.values())
            while waiting:
                # A wait without an end hears no signal on Windows.
                done, waiting = wait(waiting, LOOK, FIRST_EXCEPTION)
                failed = [future for future in done if future.exception() is not None]
                for future in failed:
                    future.result()
        finally:
            shared.stopped.set()
            for future in futures.values():
                future.cancel()
    return {name: future.result() for name, future in futures.items()}
