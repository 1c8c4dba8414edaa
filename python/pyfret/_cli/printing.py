"""Output of the commands, made safe for the terminal."""

from __future__ import annotations

import json
import math
import sys
from typing import Any

from pyfret._util.text import shown
from pyfret._util.window import LEAST, is_coloured, named_width, terminal_width, wrap

__all__ = ["as_printed", "print_data", "print_json", "print_message", "print_text"]


#: Beginnings of messages, with the codes of their colours on a terminal.
MARKS = {"fret: warning:": "\x1b[1;33m", "fret:": "\x1b[1;31m"}
#: Code that ends a colour.
PLAIN = "\x1b[0m"


def print_text(text: object) -> None:
    """Print lines for people to the standard output, wrapped to the window."""
    print(wrap(shown(str(text))))


def print_message(text: object) -> None:
    """Print a message to the standard error; in a file it is one line, which can be searched."""
    lines = shown(str(text))
    width = named_width() or terminal_width(sys.stderr)
    if width is not None:
        lines = wrap(lines, max(width, LEAST))
    if is_coloured(sys.stderr):
        mark = next((mark for mark in MARKS if lines.startswith(mark)), "")
        lines = f"{MARKS.get(mark, '')}{mark}{PLAIN if mark else ''}{lines[len(mark) :]}"
    print(lines, file=sys.stderr)


def print_data(text: object) -> None:
    """Print what programs read: a table with commas, the name of a file."""
    print(shown(str(text)))


def print_json(answer: object, *, indent: int | None = None) -> None:
    """Print an answer for programs, as JSON that every reader takes."""
    print_data(json.dumps(as_printed(answer), indent=indent, allow_nan=False))


def as_printed(answer: Any) -> Any:
    """Return an answer whose numbers JSON has words for.

    A number that is missing or not finite becomes null, and ``NAME_why`` beside it has the reason.
    In a list the reasons of all stand in a list. A reason that is there stays.
    """
    if isinstance(answer, dict):
        reasons = {f"{name}_why": reason(value) for name, value in answer.items()}
        reasons_given = {name: why for name, why in reasons.items() if why is not None}
        return reasons_given | {name: as_printed(value) for name, value in answer.items()}
    if isinstance(answer, list | tuple):
        return [as_printed(value) for value in answer]
    if hasattr(answer, "item"):
        answer = answer.item()
    return None if reason(answer) is not None else answer


def reason(value: Any) -> Any:
    """Return why a number, or a number of a list, is missing; None where all are numbers."""
    if value is None:
        return "not known"
    if isinstance(value, list | tuple):
        reasons_of_items = [reason(item) for item in value]
        return reasons_of_items if any(reasons_of_items) else None
    if not isinstance(value, float) or math.isfinite(value):
        return None
    return "not known" if math.isnan(value) else "infinite"
