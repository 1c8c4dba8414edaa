"""Texts of files that people name, and of others on their way to the eye."""

from __future__ import annotations

import codecs
from html import escape
from typing import TYPE_CHECKING

from pyfret._core import StoreError, read_bytes, shown

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["html", "literal", "read_text", "shown"]


def html(text: object) -> str:
    """A text of others in a page: neither markup nor what turns the direction of reading."""
    return escape(shown(str(text)))


def literal(text: object) -> str:
    """A text of others in a figure: a ``$`` is one, and begins no formula."""
    return shown(str(text)).replace("$", r"\$")


def read_text(path: Path) -> str:
    """The text of a file, UTF-8 or UTF-16.

    Raises
    ------
    StoreError
        There is no file but a folder, a pipe or a device, it is too large, or no text.
    """
    content = read_bytes(path)
    wide = content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    try:
        return content.decode("utf-16" if wide else "utf-8-sig")
    except UnicodeDecodeError as error:
        where = f"at byte {error.start + 1}"
        raise StoreError(f"{path}: is not UTF-8 text {where}: save it as UTF-8") from error
