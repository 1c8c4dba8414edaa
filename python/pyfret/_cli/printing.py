"""Output of the commands, made safe for the terminal."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any

from pyfret._util.text import shown

if TYPE_CHECKING:
    from typing import TextIO

__all__ = ["as_printed", "print_json", "print_text"]


def print_text(text: object, *, file: TextIO | None = None) -> None:
    """Print a line, to the standard output unless another one is given."""
    print(shown(str(text)), file=file)


def print_json(answer: object, *, indent: int | None = None) -> None:
    """Print an answer for programs, as JSON that every reader takes."""
    print_text(json.dumps(as_printed(answer), indent=indent, allow_nan=False))


def as_printed(answer: Any) -> Any:
    """An answer whose numbers JSON has words for.

    A number that is missing or not finite is null, and ``NAME_why`` beside it is the reason. In a
    list the reasons of all stand in a list. A reason that is given stays.
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
    """Why a number, or one of a list, is none; None where all are numbers."""
    if value is None:
        return "not known"
    if isinstance(value, list | tuple):
        reasons_of_items = [reason(item) for item in value]
        return reasons_of_items if any(reasons_of_items) else None
    if not isinstance(value, float) or math.isfinite(value):
        return None
    return "not known" if math.isnan(value) else "infinite"
