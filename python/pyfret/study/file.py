"""The study file: TOML that says what is varied, what is measured and where it goes."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._util.parameters import in_si
from pyfret.study.keys import known, place_of, read
from pyfret.study.loop import DEFAULT, run

if TYPE_CHECKING:
    from pyfret.study.outcome import Study

__all__ = ["run_file"]

#: Keys of a study file.
KEYS = ("scene", "parameters", "combine", "measure", "out", "grow")
#: Values of a range, at most.
MOST = 1_000_000
#: Parameters of a map, at most.
MAPPED = 2
#: Keys of a range of values.
RANGE = ("from", "to", "n", "scale")


def run_file(
    path: str | PathLike[str],
    *,
    out: str | PathLike[str] | None = None,
    executor: Any = None,
    again: bool = False,
    mapped: bool = False,
) -> tuple[Study, Path]:
    """Run the study of a file, or go on with it; the study, and its store.

    Parameters
    ----------
    path : path
        The study file; names in it are relative to its folder.
    out : path, optional
        Store (default: that of the file, or the file's own name with the ending ``.zarr``).
    executor, again
        As in :func:`pyfret.study.run`.
    mapped : bool
        Whether a map is to be drawn of it, which has one parameter or two.

    Raises
    ------
    ValueError
        The file is no study; the message names the key and what is allowed. A map is to be drawn of
        more than two parameters.
    """
    file = Path(path)
    says = read(file, KEYS, ("scene", "parameters"))
    if not isinstance(says["parameters"], dict):
        raise ValueError(f"{file}: `parameters`: must be a table of keys and values")
    place = place_of(file, says, out)
    parameters = {k: values(v, k, str(file)) for k, v in says["parameters"].items()}
    if mapped and says.get("combine", "grid") == "grid" and len(parameters) > MAPPED:
        *_, last = parameters
        raise ValueError(
            f"--map: {file} has {len(parameters)} parameters, {', '.join(parameters)}, and a map "
            f"has {MAPPED}. Leave --map out, and draw a part of the study in Python: "
            f'fret.open("{place}").map(at={{"{last}": {parameters[last][0]!r}}})'
        )
    found = run(
        file.parent / says["scene"],
        parameters,
        combine=says.get("combine", "grid"),
        measure=says.get("measure", DEFAULT),
        grow=says.get("grow", True),
        out=place,
        executor=executor,
        again=again,
    )
    return found, place


def values(given: Any, name: str, file: str) -> list[Any]:
    """Values of a parameter: a list, or a range ``{ from, to, n, scale }``."""
    where = f"{file}: parameters.{name}"
    if isinstance(given, list):
        return given
    if not isinstance(given, dict):
        raise ValueError(f"{where} = {given!r}: must be a list or {{ from = .., to = .., n = .. }}")
    for key in given:
        known(key, RANGE, where)
    scale = given.get("scale", "linear")
    if scale not in ("linear", "log"):
        raise ValueError(f'{where}.scale = {scale!r}: must be "linear" or "log"')
    given, unit = dict(given), ""
    for key in ("from", "to"):
        if isinstance(given.get(key), str):
            unit = unit or given[key].lstrip("+-.0123456789eE ").strip()
        if key in given:
            try:
                given[key] = in_si(name, given[key])
            except ValueError as refused:
                raise ValueError(f"{where}.{key}: {refused}") from None
        if not isinstance(given.get(key, 0), int | float):
            raise ValueError(f"{where}.{key} = {given[key]!r}: must be a number")
    n = given.get("n", 1)
    if not isinstance(n, int) or not 1 <= n <= MOST:
        raise ValueError(f"{where}.n = {n!r}: must be a whole number from 1 to {MOST}")
    if scale == "log" and not given.get("from", 1) * given.get("to", 1) > 0:
        raise ValueError(f"{where}: a logarithmic scale begins and ends above zero")
    try:
        space = np.linspace if scale == "linear" else np.geomspace
        spaced: list[Any] = space(given["from"], given["to"], int(given["n"])).tolist()
    except KeyError as missing:
        raise ValueError(f"{where}: {missing} is missing") from None
    if not unit:
        return spaced
    # The scene refuses the unit where the contact has another one, as of a single value.
    size = in_si(name, f"1 {unit}")
    return [f"{value / size!r} {unit}" for value in spaced]
