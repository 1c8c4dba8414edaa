"""Messages of errors that repeat a value of the user: megabytes of it are cut."""

from __future__ import annotations

__all__ = ["abridge_error"]

#: Longest text of an error, and the characters that are kept of a longer one at both ends.
LONGEST, KEPT_FIRST, KEPT_LAST = 20_000, 200, 800


def abridge_error(error: BaseException) -> None:
    """Cut the texts of an error that are longer than :data:`LONGEST`, in place."""
    error.args = tuple(abridge(value) for value in error.args)
    if isinstance(error, OSError) and isinstance(error.filename, str):
        error.filename = abridge(error.filename)


def abridge(value: object) -> object:
    """Return the ends of a long text, with the number of the characters left out between them."""
    if not isinstance(value, str) or len(value) <= LONGEST:
        return value
    left_out = len(value) - KEPT_FIRST - KEPT_LAST
    return f"{value[:KEPT_FIRST]}... ({left_out} more characters) ...{value[-KEPT_LAST:]}"
