"""Dataclasses as JSON: their arrays go into the variables of a dataset."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._core import Scene

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["packed", "unpacked"]


def packed(value: Any, arrays: dict[str, np.ndarray]) -> Any:
    """Convert a part to JSON; its arrays are put into `arrays`."""
    if isinstance(value, np.ndarray):
        name = f"array_{len(arrays)}"
        arrays[name] = value
        return {"array": name}
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, Scene):
        return {"scene": value.to_toml()}
    if is_dataclass(value):
        attributes = {
            attribute.name: packed(getattr(value, attribute.name), arrays)
            for attribute in fields(value)
        }
        return {"part": type(value).__name__, "fields": attributes}
    if isinstance(value, tuple):
        return {"tuple": [packed(item, arrays) for item in value]}
    if isinstance(value, list):
        return [packed(item, arrays) for item in value]
    if isinstance(value, dict):
        return {"dict": {key: packed(item, arrays) for key, item in value.items()}}
    if value is None or isinstance(value, bool | int | float | str):
        return value
    raise TypeError(f"{value!r:.60}: a file holds numbers, text, and lists and tables of them")


def unpacked(value: Any, dataset: xr.Dataset, parts: Mapping[str, type]) -> Any:
    """Rebuild a part from its JSON; only classes of `parts` are made."""
    if isinstance(value, list):
        return [unpacked(item, dataset, parts) for item in value]
    if not isinstance(value, dict):
        return value
    if "array" in value:
        return dataset[value["array"]].values
    if "scene" in value:
        return Scene.from_toml(value["scene"])
    if "tuple" in value:
        return tuple(unpacked(item, dataset, parts) for item in value["tuple"])
    if "dict" in value:
        return {key: unpacked(item, dataset, parts) for key, item in value["dict"].items()}
    arguments = {key: unpacked(item, dataset, parts) for key, item in value["fields"].items()}
    return parts[value["part"]](**arguments)
