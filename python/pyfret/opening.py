"""One door for what was saved: a run, a run of wear, a study."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pyfret import result, study, wear
from pyfret._core import read_bytes
from pyfret._util import files

if TYPE_CHECKING:
    import os

__all__ = ["open"]


def open(path: str | os.PathLike[str]) -> Any:
    """Open the store of a run, of wear or of a study, or a copy of it (``.zarr``, ``.nc``).

    Fields are read when they are asked for. Every file of a store is checked before: what is read
    is what was written. What ``save`` wrote has no checksums and is not checked. What the metadata
    ask for beside being read, such as a codec of another program, is refused by name.

    Returns
    -------
    Result, WearResult or Study
        By what is there.

    Raises
    ------
    StoreError
        There is no store, or a file of it is missing or damaged; the message names both.
    """
    files.checked(path)
    attributes = _attributes(Path(path))
    if attributes.get("kind") == "study":
        return study.open(path)
    if "wear" in attributes:
        return wear.open(path)
    return result.open(path)


def _attributes(path: Path) -> dict[str, Any]:
    """The attributes of a store or a copy, as far as they can be read; who opens it says more."""
    if path.suffix == ".nc":
        with files.opened(path) as dataset:
            return dict(dataset.attrs)
    for name in ("zarr.json", ".zattrs"):
        try:
            found = json.loads(read_bytes(path / name))
        except (OSError, ValueError):
            continue
        if isinstance(found, dict):
            inner = found.get("attributes", found)
            return inner if isinstance(inner, dict) else {}
    return {}
