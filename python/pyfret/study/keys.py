"""What a file of a study or of a comparison says: TOML whose keys are known."""

from __future__ import annotations

import difflib
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from pyfret._util.text import read_text

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

__all__ = ["known", "place_of", "read"]

#: Keys whose value names a file.
FILES = ("scene", "out", "materials")


def read(file: Path, keys: tuple[str, ...], needed: Iterable[str]) -> dict[str, Any]:
    """Read a file that may have these keys and must have some of them.

    Raises
    ------
    ValueError
        It is no TOML, a key is unknown or missing, or a file is not named in quotes.
    """
    try:
        says = tomllib.loads(read_text(file))
    except tomllib.TOMLDecodeError as error:
        raise ValueError(f"{file}: {error}") from error
    for key in says:
        known(key, keys, str(file))
    for key in needed:
        if key not in says:
            raise ValueError(f"{file}: the key `{key}` is missing")
    for key in FILES:
        if not isinstance(says.get(key, ""), str):
            raise ValueError(
                f"{file}: `{key}` = {says[key]!r}: must be the name of a file in quotes"
            )
    return says


def known(key: str, keys: tuple[str, ...], where: str) -> None:
    """Refuse an unknown key and name the nearest one."""
    if key not in keys:
        nearest = difflib.get_close_matches(key, keys, n=1, cutoff=0.0)[0]
        raise ValueError(f"{where}: unknown key `{key}`: the nearest valid key is `{nearest}`")


def place_of(file: Path, says: dict[str, Any], out: Any) -> Path:
    """Where the store goes: `out`, what the file says, or the file's own name with ``.zarr``."""
    return Path(out) if out is not None else file.parent / says.get("out", f"{file.stem}.zarr")
