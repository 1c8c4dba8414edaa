"""The progress bar of a run."""

from __future__ import annotations

import sys
import time
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from types import TracebackType

#: Characters of the bar.
WIDTH = 28
#: Seconds between two drawings, so that drawing never costs.
INTERVAL = 0.1


class Progress:
    """A bar with the time left, on standard error if people are watching.

    Parameters
    ----------
    title : str
        What is being run.
    shown : bool
        Whether to draw at all; without a terminal or a notebook nothing is drawn in any case.
    """

    def __init__(self, *, title: str, shown: bool) -> None:
        self.title = title
        self.shown = shown and (sys.stderr.isatty() or "ipykernel" in sys.modules)
        self.started = self.drawn = time.monotonic()
        self.done = self.total = 0

    def __enter__(self) -> Progress:
        """Start counting time."""
        return self

    def update(self, done: int, total: int) -> None:
        """Say that `done` of `total` increments are solved."""
        self.done, self.total = done, total
        now = time.monotonic()
        if self.shown and (now - self.drawn > INTERVAL or done == total):
            self.drawn = now
            sys.stderr.write("\r" + self.line(now - self.started))
            sys.stderr.flush()

    def line(self, elapsed: float) -> str:
        """The bar, counts and times after `elapsed` seconds."""
        share = min(self.done / max(self.total, 1), 1.0)
        bar = ("=" * round(WIDTH * share)).ljust(WIDTH)
        left = elapsed * (1 - share) / share if share > 0 else 0.0
        counts = f"{self.done}/{max(self.total, self.done)}"
        return f"{self.title} [{bar}] {counts} {elapsed:.0f} s, {left:.0f} s left "

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Leave the last state of the bar on the screen."""
        if self.shown and self.done:
            sys.stderr.write("\r" + self.line(time.monotonic() - self.started) + "\n")
