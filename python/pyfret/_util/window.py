"""Width of the window that texts are printed in, and texts that fit into it."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING

from pyfret._core import table_text, wrap_text

if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import TextIO

__all__ = ["format_table", "is_coloured", "named_width", "terminal_width", "window_width", "wrap"]

#: Columns of a file or a pipe, and the least number that is used.
USUAL, LEAST = 80, 40


def window_width() -> int:
    """Return the columns of a line: ``COLUMNS``, else the terminal's, else 80."""
    return max(named_width() or terminal_width(sys.stdout) or USUAL, LEAST)


def named_width() -> int | None:
    """Return the columns that the variable ``COLUMNS`` names."""
    text = os.environ.get("COLUMNS", "")
    return int(text) if text.isascii() and text.isdigit() and int(text) > 0 else None


def terminal_width(stream: TextIO | None) -> int | None:
    """Return the columns of the terminal of a stream; None of a file or a pipe."""
    try:
        if stream is None or not stream.isatty():
            return None
        return os.get_terminal_size(stream.fileno()).columns or None
    except (AttributeError, OSError, ValueError):
        return None


def is_coloured(stream: TextIO | None) -> bool:
    """Return whether a stream is a terminal with colours, which the user has not declined."""
    declined = bool(os.environ.get("NO_COLOR")) or os.environ.get("TERM", "dumb") == "dumb"
    return terminal_width(stream) is not None and not declined


def wrap(text: str, width: int | None = None) -> str:
    """Wrap the lines of a text that are wider than the window."""
    return wrap_text(text, width or window_width())


def format_table(titles: Sequence[str], rows: Sequence[Sequence[str]], *, keys: int = 1) -> str:
    """Align a table; columns that do not fit stand below, beside the first `keys` columns.

    Titles may have several lines.
    """
    return table_text([*titles], [[*row] for row in rows], keys, window_width())
