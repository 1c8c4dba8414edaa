"""The table ``[history]`` of a scene file: a recording, a spectrum, or counted loops."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from pyfret._util.toml import read_toml
from pyfret.history.load_history import LoadHistory

if TYPE_CHECKING:
    from collections.abc import Mapping
    from os import PathLike

__all__ = ["read_history"]

#: Keys that belong to a recording.
RECORDING = ("columns", "units", "t", "frequency", "skip", "group", "residue")
#: Sources of a history, of which the table has one.
SOURCES = ("file", "spectrum", "matrix")
#: Arguments of the constructors, by the keys of their tables.
SPECTRUM = {"duration", "of", "channel", "mean", "distribution"}
MATRIX = {"range", "mean", "counts", "channel", "duration"}


def read_history(
    scene: str | PathLike[str], changes: Mapping[str, Any] | None = None
) -> LoadHistory | None:
    """Read the load history of a scene file; None where it has no table ``[history]``.

    Parameters
    ----------
    scene : path
        The scene file. The recording lies in its folder or below it.
    changes : mapping, optional
        Values in place of the values of the file, by keys such as ``history.residue``.
    """
    file = Path(scene)
    document = read_toml(file)
    for key, value in (changes or {}).items():
        names = key.split(".")
        if names[0] != "history":
            continue
        table = document
        for name in names[:-1]:
            table = table.setdefault(name, {})
        table[names[-1]] = value
    section = document.get("history")
    if section is None:
        return None
    where = f"{file}: history"
    if not isinstance(section, dict):
        raise ValueError(f"{where} = {section!r:.60}: must be a table")
    sources = [name for name in SOURCES if name in section]
    if len(sources) != 1:
        raise ValueError(
            f"{where}: has {', '.join(sources) or 'no source'}: must have one of "
            f"{', '.join(SOURCES)}"
        )
    source = sources[0]
    extra = [name for name in section if name in RECORDING]
    if source != "file" and extra:
        raise ValueError(f"{where}.{extra[0]}: must be left out beside {source}: it has no file")
    try:
        return READERS[source](section, file.parent)
    except (TypeError, ValueError) as error:
        raise type(error)(f"{where}.{source}: {error}") from error


def of_recording(section: dict[str, Any], folder: Path) -> LoadHistory:
    """Read the history of a recording that a section names."""
    name = section["file"]
    if not isinstance(name, str):
        raise ValueError(f"{name!r:.60}: must be the name of a file in quotes")
    path = folder / name
    if not path.resolve().is_relative_to(folder.resolve()):
        raise ValueError(
            f"{name!r}: must lie in the folder of the scene or below it; copy it there, or name it "
            "beside the scene: fret damage SCENE FILE"
        )
    return LoadHistory.from_csv(path, **{k: section[k] for k in RECORDING if k in section})


def of_spectrum(section: dict[str, Any], _: Path) -> LoadHistory:
    """Read the history of a spectrum in a section."""
    table = required(section["spectrum"], ("frequencies", "values", "duration"))
    options = {key: value for key, value in table.items() if key in SPECTRUM}
    return LoadHistory.from_spectrum((table["frequencies"], table["values"]), **options)


def of_matrix(section: dict[str, Any], _: Path) -> LoadHistory:
    """Read the history of counted loops in a section."""
    table = required(section["matrix"], ("range", "mean", "counts"))
    return LoadHistory.from_matrix(**{k: v for k, v in table.items() if k in MATRIX})


def required(table: Any, keys: tuple[str, ...]) -> dict[str, Any]:
    """Return a table; a ValueError if one of the keys is missing."""
    if not isinstance(table, dict):
        raise ValueError(f"{table!r:.60}: must be a table of {', '.join(keys)}")
    for key in keys:
        if key not in table:
            raise ValueError(f"{key} is missing")
    return table


#: Readers of the sources.
READERS = {"file": of_recording, "spectrum": of_spectrum, "matrix": of_matrix}
