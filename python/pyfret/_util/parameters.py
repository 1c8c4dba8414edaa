"""Names and values of the parameters of a study: keys of a scene file, and quantities in SI."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from pyfret import _core
from pyfret._util.keywords import nearest_names
from pyfret._util.lazy import xr

__all__ = ["SHORT", "full", "in_si", "one_of", "opposite", "part", "single"]

#: The place in a list, ``path[0].W``.
PLACE = re.compile(r"\[(\d+|\*)\]")
#: Parameters with a short name, and their keys in a scene file.
SHORT = {
    "mu": "friction.mu",
    "friction": "friction.mu",
    "W": "path.*.W",
    "grid.width": "grid.extent",
}


def single(name: str) -> str:
    """One key as a scene file has it: places in a list between points, no sign."""
    return PLACE.sub(r".\1", name.strip().removeprefix("-"))


def full(name: str) -> str:
    """Return the key of a short name: ``friction.mu`` for ``mu``."""
    parts = (part.strip() for part in name.split(","))
    return ",".join(
        "-" * part.startswith("-") + SHORT.get(single(part), single(part)) for part in parts
    )


def one_of(known: Iterable[str], name: str, what: str) -> str:
    """Return the parameter of a study that a name means, short or long.

    Raises
    ------
    ValueError
        The study has no such parameter; `what` is where the name was given.
    """
    known = list(known)
    if name in known:
        return name
    keys = {full(name): name for name in known}
    if full(name) in keys:
        return keys[full(name)]
    near = nearest_names(name, known, 1)
    hint = f"; the nearest is {near[0]!r}" if near else ""
    known_names = ", ".join(known)
    raise ValueError(f"{what}: the study has no parameter {name!r:.200}{hint} (of {known_names})")


def in_si(name: str, value: Any) -> Any:
    """Convert a text with a unit, or a quantity of pint, to SI; return other values unchanged.

    Texts of keys that measure nothing, such as names of materials, stay texts.

    Raises
    ------
    ValueError
        The unit measures something else than the key.
    """
    quantity = hasattr(value, "magnitude") and hasattr(value, "units")
    key = full(name)
    if not quantity and not (isinstance(value, str) and _core.measured_by(key)):
        return value
    try:
        return _core.si_of(key, value)
    except (TypeError, ValueError) as refused:
        raise type(refused)(f"{name} = {refused}") from None


def part(dataset: xr.Dataset, at: Mapping[str, Any]) -> xr.Dataset:
    """Select the part of a study at values of some parameters: nearest numbers, equal texts.

    Raises
    ------
    ValueError
        The study has no such parameter or no such text, a unit measures something else, or the
        parameters change together.
    """
    for name, value in at.items():
        key = one_of(map(str, dataset.coords), name, "at")
        if key not in dataset.dims:
            raise ValueError(f"at: {key} changes together with others: a sample has no part")
        values = dataset[key].values
        target = in_si(key, value)
        if values.dtype.kind in "ifb":
            try:
                index = int(np.argmin(np.abs(values - float(target))))
            except (TypeError, ValueError):
                raise ValueError(f"at: {key} = {value!r:.60}: must be a number") from None
        else:
            # A study keeps texts as a scene file has them.
            texts = [str(text) for text in values]
            same = [n for n, text in enumerate(texts) if text in (json.dumps(target), target)]
            if not same:
                raise ValueError(f"at: {key} = {value!r:.60}: must be one of {', '.join(texts)}")
            index = same[0]
        dataset = dataset.isel({key: index})
    return dataset


def opposite(value: Any) -> Any:
    """Return a value with the other sign; a text keeps its unit."""
    if not isinstance(value, str):
        return -value
    text = value.strip()
    return text[1:].strip() if text.startswith("-") else f"-{text.removeprefix('+')}"
