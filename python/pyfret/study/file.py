"""The study file in TOML: scene, parameters, measures and store."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._util.parameters import in_si
from pyfret.study.keys import check_key, read_document, store_path
from pyfret.study.loop import DEFAULT, run

if TYPE_CHECKING:
    from pyfret.study.outcome import Study

__all__ = ["run_study_file"]

#: Keys of a study file.
KEYS = ("scene", "parameters", "combine", "measure", "out", "grow")
#: Values of a range, at most.
MAX_VALUES = 1_000_000
#: Parameters of a map, at most.
MAX_MAP_PARAMETERS = 2
#: Keys of a range of values.
RANGE = ("from", "to", "n", "scale")


def run_study_file(
    path: str | PathLike[str],
    *,
    out: str | PathLike[str] | None = None,
    executor: Any = None,
    again: bool = False,
    mapped: bool = False,
) -> tuple[Study, Path]:
    """Run the study of a file, or continue it; return the study and its store.

    Parameters
    ----------
    path : path
        The study file; names in it are relative to its folder.
    out : path, optional
        Store (default: `out` of the file, or the file's own name with the ending ``.zarr``).
    executor, again
        As in :func:`pyfret.study.run`.
    mapped : bool
        Whether a map will be drawn, which needs one parameter or two.

    Raises
    ------
    ValueError
        The file is no study; the message names the key and what is allowed. A map would have
        more than two parameters.
    """
    file = Path(path)
    document = read_document(file, KEYS, ("scene", "parameters"))
    if not isinstance(document["parameters"], dict):
        raise ValueError(f"{file}: `parameters`: must be a table of keys and values")
    store = store_path(file, document, out)
    parameters = {k: read_values(v, k, str(file)) for k, v in document["parameters"].items()}
    if (
        mapped
        and document.get("combine", "grid") == "grid"
        and len(parameters) > MAX_MAP_PARAMETERS
    ):
        *_, last = parameters
        raise ValueError(
            f"--map: {file} has {len(parameters)} parameters, {', '.join(parameters)}, and a map "
            f"has {MAX_MAP_PARAMETERS}. Leave --map out, and draw a part of the study in Python: "
            f'fret.open("{store}").map(at={{"{last}": {parameters[last][0]!r}}})'
        )
    study = run(
        file.parent / document["scene"],
        parameters,
        combine=document.get("combine", "grid"),
        measure=document.get("measure", DEFAULT),
        grow=document.get("grow", True),
        out=store,
        executor=executor,
        again=again,
    )
    return study, store


def read_values(values_or_range: Any, name: str, file: str) -> list[Any]:
    """Read the values of a parameter: a list, or a range ``{ from, to, n, scale }``."""
    where = f"{file}: parameters.{name}"
    if isinstance(values_or_range, list):
        return values_or_range
    if not isinstance(values_or_range, dict):
        raise ValueError(
            f"{where} = {values_or_range!r}: must be a list or {{ from = .., to = .., n = .. }}"
        )
    for key in values_or_range:
        check_key(key, RANGE, where)
    scale = values_or_range.get("scale", "linear")
    if scale not in ("linear", "log"):
        raise ValueError(f'{where}.scale = {scale!r}: must be "linear" or "log"')
    values_or_range, unit = dict(values_or_range), ""
    for key in ("from", "to"):
        if isinstance(values_or_range.get(key), str):
            unit = unit or values_or_range[key].lstrip("+-.0123456789eE ").strip()
        if key in values_or_range:
            try:
                values_or_range[key] = in_si(name, values_or_range[key])
            except ValueError as refused:
                raise ValueError(f"{where}.{key}: {refused}") from None
        if not isinstance(values_or_range.get(key, 0), int | float):
            raise ValueError(f"{where}.{key} = {values_or_range[key]!r}: must be a number")
    n = values_or_range.get("n", 1)
    if not isinstance(n, int) or not 1 <= n <= MAX_VALUES:
        raise ValueError(f"{where}.n = {n!r}: must be a whole number from 1 to {MAX_VALUES}")
    if scale == "log" and not values_or_range.get("from", 1) * values_or_range.get("to", 1) > 0:
        raise ValueError(f"{where}: a logarithmic scale begins and ends above zero")
    try:
        space = np.linspace if scale == "linear" else np.geomspace
        spaced: list[Any] = space(
            values_or_range["from"], values_or_range["to"], int(values_or_range["n"])
        ).tolist()
    except KeyError as missing:
        raise ValueError(f"{where}: {missing} is missing") from None
    if not unit:
        return spaced
    # The scene refuses the unit where the contact has another one, as of a single value.
    size = in_si(name, f"1 {unit}")
    return [f"{value / size!r} {unit}" for value in spaced]
