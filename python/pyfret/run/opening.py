"""The dataset of a run in a store, checked before it is read."""

from __future__ import annotations

from importlib import import_module
from os import fspath
from typing import TYPE_CHECKING

from pyfret._core import StoreError
from pyfret._util import files
from pyfret._util.stores import check_heads

if TYPE_CHECKING:
    import os

    import xarray as xr

__all__ = ["open_dataset"]


def open_dataset(path: str | os.PathLike[str]) -> xr.Dataset:
    """Open the dataset of a run: a Zarr store, or a copy that was saved.

    Raises
    ------
    StoreError
        There is no store, or a file of it is missing or damaged; the message names both.
    """
    if files.is_copy(path):
        dataset = files.opened(path)
    else:
        files.checked(path, chunks=False)
        dataset = import_module("pyfret.run.checked_store").open_checked(path)
        if dataset.attrs.get("status") == "done":
            # While a run goes on, arrays grow before the collected metadata.
            check_heads(path)
    if "scene" not in dataset.attrs or "increment" not in dataset.sizes:
        raise StoreError(f"{fspath(path)}: is no result of pyfret: it has no scene or no increment")
    opened: xr.Dataset = dataset
    return opened
