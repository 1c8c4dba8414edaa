"""Reader of study and comparison files: TOML with checked keys."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from pyfret._util.toml import read_toml

__all__ = ["check_key", "read_document", "store_path"]

#: Keys whose value names a file.
FILES = ("scene", "out", "materials")


def read_document(file: Path, keys: tuple[str, ...], needed: Iterable[str]) -> dict[str, Any]:
    """Read a file that may have these keys and must have some of them.

    Raises
    ------
    ValueError
        It is no TOML, a key is unknown or missing, or a file is not named in quotes.
    """
    document = read_toml(file)
    for key in document:
        check_key(key, keys, str(file))
    for key in needed:
        if key not in document:
            raise ValueError(f"{file}: the key `{key}` is missing")
    for key in FILES:
        if not isinstance(document.get(key, ""), str):
            raise ValueError(
                f"{file}: `{key}` = {document[key]!r:.200}: must be the name of a file in quotes"
            )
    return document


def check_key(key: str, keys: tuple[str, ...], where: str) -> None:
    """Reject an unknown key and name the nearest one."""
    if key not in keys:
        nearest = difflib.get_close_matches(key[:64], keys, n=1, cutoff=0.0)[0]
        raise ValueError(f"{where}: unknown key `{key:.200}`: the nearest valid key is `{nearest}`")


def store_path(file: Path, document: dict[str, Any], out: Any) -> Path:
    """Return the path of the store: `out`, the one in the file, or a default by file name."""
    return Path(out) if out is not None else file.parent / document.get("out", f"{file.stem}.zarr")
