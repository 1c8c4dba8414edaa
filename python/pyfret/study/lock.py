"""One writer for a store."""

from __future__ import annotations

import os
from contextlib import contextmanager
from typing import TYPE_CHECKING

from pyfret._core import StoreError

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

__all__ = ["only_writer"]


@contextmanager
def only_writer(place: Path) -> Iterator[None]:
    """Hold the folder `place` as its only writer; a StoreError if another process does.

    Where folders cannot be locked, as on Windows, nothing is held.
    """
    if os.name != "posix":
        yield
        return
    import fcntl

    folder = os.open(place, os.O_RDONLY)
    try:
        try:
            fcntl.flock(folder, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise StoreError(f"{place}: is being written by another process") from error
        except OSError:
            # A file system without locks.
            pass
        yield
    finally:
        os.close(folder)
