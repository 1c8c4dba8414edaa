"""The progress bar of a run."""

from __future__ import annotations

import builtins
import os
import sys
import time
from importlib import import_module
from typing import TYPE_CHECKING, Any, ClassVar

from pyfret._core import shown
from pyfret._util.window import terminal_width

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import TracebackType

#: Characters of the bar.
WIDTH = 28
#: Columns of a window for the whole title and bar.
WIDE = 100
#: Seconds between two drawings, so that drawing never costs.
INTERVAL = 0.1


def watched(stream: Any) -> bool:
    """Return whether a stream is a terminal that moves its cursor, or a notebook."""
    try:
        terminal = bool(stream.isatty()) and os.environ.get("TERM") != "dumb"
    except (AttributeError, OSError, ValueError):
        # There is none, as under pythonw, or it is closed, or no file.
        return False
    return terminal or in_notebook()


def in_notebook() -> bool:
    """Whether a notebook runs this."""
    return hasattr(builtins, "__IPYTHON__")


def notebook_view() -> Any:
    """Return an output of the notebook's cell that can be changed later; None outside of a cell."""
    try:
        display = import_module("IPython.display").display
    except ImportError:
        return None
    return display({"text/plain": ""}, raw=True, display_id=True)


class Progress:
    """A bar with the time left, on standard error if people are watching.

    Parameters
    ----------
    title : str
        What is being run.
    shown : bool
        Whether to draw at all; without a terminal or a notebook nothing is drawn in any case.
    """

    #: Function that gets the counts of the outermost run, for a program that shows them.
    observer: ClassVar[Callable[[int, int], None] | None] = None
    _outermost: ClassVar[Progress | None] = None

    def __init__(self, *, title: str, shown: bool) -> None:
        self.title = title
        #: Text behind the times, such as the cost of a point.
        self.note = ""
        self.shown = shown and watched(sys.stderr)
        self.started = self.drawn = time.monotonic()
        self.done = self.total = self.drawn_letters = 0
        #: The output of a notebook that the bar is in.
        self.view: Any = None

    def __enter__(self) -> Progress:
        """Start counting time."""
        if Progress._outermost is None:
            Progress._outermost = self
        return self

    def update(self, done: int, total: int) -> None:
        """Show that `done` of `total` increments are solved."""
        self.done, self.total = done, total
        now = time.monotonic()
        if Progress.observer is not None and Progress._outermost is self:
            Progress.observer(done, total)
        if self.shown and (now - self.drawn > INTERVAL or done == total):
            self.drawn = now
            self.show(self.line(now - self.started))

    def show(self, line: str) -> None:
        """Draw a line in place of the last one, in a notebook as an output of its own."""
        if self.view is None and in_notebook():
            self.view = notebook_view()
        if self.view is not None:
            self.view.update({"text/plain": line}, raw=True)
            return
        width = terminal_width(sys.stderr)
        line = line if width is None else line[: width - 1]
        self.draw("\r" + line.ljust(self.drawn_letters))
        self.drawn_letters = len(line)

    def draw(self, text: str) -> None:
        """Write to standard error; characters that it cannot show are replaced.

        A bar that fails ends there.
        """
        stream = sys.stderr
        try:
            letters = getattr(stream, "encoding", None) or "ascii"
            stream.write(text.encode(letters, "replace").decode(letters))
            stream.flush()
        except (AttributeError, LookupError, OSError, ValueError):
            self.shown = False

    def line(self, elapsed: float) -> str:
        """Return the bar, the counts and the times after `elapsed` seconds."""
        share = min(self.done / max(self.total, 1), 1.0)
        # The counts stay in sight in a narrow window.
        wide = (terminal_width(sys.stderr) or WIDE) >= WIDE
        letters = WIDTH if wide else WIDTH // 3
        bar = ("=" * round(letters * share)).ljust(letters)
        title = shown(self.title) if wide else shown(self.title)[: WIDTH // 2]
        remaining = elapsed * (1 - share) / share if share > 0 else 0.0
        counts = f"{self.done}/{max(self.total, self.done)}"
        note = f"({shown(self.note)}) " if self.note and wide else ""
        return f"{title} [{bar}] {counts} {elapsed:.0f} s, {remaining:.0f} s left {note}"

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Take the bar off the screen when its work is over."""
        if Progress._outermost is self:
            Progress._outermost = None
        if self.view is not None:
            self.view.update({"text/plain": ""}, raw=True)
        elif self.shown and self.drawn_letters:
            self.draw("\r" + " " * self.drawn_letters + "\r")
