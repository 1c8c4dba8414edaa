"""TOML, by the standard library or, under Python 3.10, by tomli; imported at the first use."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

from pyfret._util.text import read_text

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["parse_toml", "read_toml"]


def parse_toml(text: str) -> dict[str, Any]:
    """Parse a text in TOML; a ValueError has the fault and its line."""
    if sys.version_info >= (3, 11):
        import tomllib
    else:
        import tomli as tomllib

    return tomllib.loads(text)


def read_toml(file: Path) -> dict[str, Any]:
    """Parse a file in TOML; a ValueError has its name, the fault and its line."""
    text = read_text(file)
    try:
        return parse_toml(text)
    except ValueError as error:
        raise ValueError(f"{file}: {error}") from error
