"""Numbers as programs of finite elements write them."""

from __future__ import annotations

import math
import re

__all__ = ["number", "numbers"]

#: A number: exponents of two digits, of three (Windows), or three without the letter (Fortran).
NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[EeDd][+-]?\d{3}|[EeDd][+-]?\d{1,2}|[+-]\d{3})?"
#: The same with a point and a letter, as in columns that touch one another.
TOUCHING = re.compile(
    r"\s*([+-]?\d+\.\d*(?:[EeDd][+-]\d{3}|[EeDd][+-]\d{2}|[+-]\d{3}))(?=[\s+-]|\d|$)"
)


def number(text: str) -> float:
    """Read a number, also with a D for the exponent or without a letter; else a ValueError."""
    word = text.strip()
    if not re.fullmatch(NUMBER, word):
        raise ValueError(f"{word!r} is no number")
    word = re.sub(r"[Dd]", "E", word)
    if short := re.fullmatch(r"(.*\d\.?)([+-]\d{3})", word):
        word = word if "E" in word.upper() else f"{short[1]}E{short[2]}"
    value = float(word)
    if not math.isfinite(value):
        raise ValueError(f"{word!r} is not finite")
    return value


def numbers(text: str) -> list[float]:
    """Read the numbers of columns that may touch each other.

    A ValueError if something else is there, such as the stars of a column that is too narrow.
    """
    numbers, at = [], 0
    text = text.rstrip()
    while at < len(text):
        match = TOUCHING.match(text, at)
        if match is None:
            raise ValueError(f"{text[at : at + 40].strip()!r} is no number")
        numbers.append(number(match[1]))
        at = match.end()
    return numbers
