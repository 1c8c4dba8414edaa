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
    total : int
        Number of increments.
    title : str
        What is being run.
    shown : bool
        Whether to draw at all; without a terminal or a notebook nothing is drawn in any case.
    """

    def __init__(self, total: int, *, title: str, shown: bool) -> None:
        self.total = total
        self.title = title
        self.shown = shown and (sys.stderr.isatty() or "ipykernel" in sys.modules)
        self.started = self.drawn = time.monotonic()
        self.done = 0

    def __enter__(self) -> Progress:
        """Start counting time."""
        return self

    def update(self, done: int) -> None:
        """Say that `done` increments are solved."""
        self.done = done
        now = time.monotonic()
        if self.shown and (now - self.drawn > INTERVAL or done == self.total):
            self.drawn = now
            self.draw(now - self.started)

    def draw(self, elapsed: float) -> None:
        """Draw the bar over the last one."""
        share = self.done / max(self.total, 1)
        bar = ("=" * round(WIDTH * share)).ljust(WIDTH)
        left = elapsed * (1 - share) / share if share > 0 else 0.0
        text = (
            f"\r{self.title} [{bar}] {self.done}/{self.total} {elapsed:.0f} s, {left:.0f} s left "
        )
        sys.stderr.write(text)
        sys.stderr.flush()

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Leave the last state of the bar on the screen."""
        if self.shown and self.done:
            self.draw(time.monotonic() - self.started)
            sys.stderr.write("\n")
