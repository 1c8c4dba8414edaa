"""Texts of files that people name."""

from __future__ import annotations

import codecs
import stat
from typing import TYPE_CHECKING

from pyfret._core import StoreError

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["read_text"]

#: Bytes of the largest text that is read.
LARGEST = 1 << 28


def read_text(path: Path) -> str:
    """The text of a file, UTF-8 or UTF-16.

    Raises
    ------
    StoreError
        There is no file but a folder, a pipe or a device, it is too large, or no text.
    """
    try:
        # A pipe would be waited for when it is opened, and a device has no end.
        about = path.stat()
        if not stat.S_ISREG(about.st_mode):
            raise StoreError(f"{path}: is not a file")
        if about.st_size > LARGEST:
            raise StoreError(f"{path}: has {about.st_size} bytes: must have {LARGEST} at most")
        content = path.read_bytes()
    except StoreError:
        raise
    except OSError as error:
        raise StoreError(f"{path}: {error.strerror}") from error
    wide = content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    try:
        return content.decode("utf-16" if wide else "utf-8-sig")
    except UnicodeDecodeError as error:
        where = f"at byte {error.start + 1}"
        raise StoreError(f"{path}: is not UTF-8 text {where}: save it as UTF-8") from error
