"""Result stores whose values are checked when they are read.

A store has a checksum of every chunk. Opening a large store checks its metadata and its
coordinates. The chunks of a field are checked when an increment of it is read for the first time.
"""

from __future__ import annotations

import json
import math
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from xarray.backends import BackendArray
from xarray.core import indexing

from pyfret._core import CheckedStore, StoreError, read_bytes
from pyfret._util.lazy import xr

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["open_checked", "stored_attributes"]

#: Bytes of values up to which a store is checked as a whole when it is opened.
CHECKED_AT_ONCE = 64 << 20
#: How often a store is opened again that is being written meanwhile.
ATTEMPTS = 5


class Checks:
    """The checksums of a store, and the entries of its arrays that have been checked.

    A copy in another process opens the store for itself.
    """

    def __init__(self, path: str) -> None:
        self.path = path
        self.store = CheckedStore(path)
        self.checked: dict[str, NDArray[np.bool_]] = {}

    def __reduce__(self) -> tuple[Any, ...]:
        """Make the checks of the same store."""
        return Checks, (self.path,)

    def check(self, name: str, entries: NDArray[np.int64], length: int) -> None:
        """Check the chunks with some entries along the first axis of an array.

        Raises
        ------
        StoreError
            A file is missing or damaged; the message names it.
        """
        checked = self.checked.setdefault(name, np.zeros(length, bool))
        unchecked = entries[~checked[entries]]
        if unchecked.size == 0:
            return
        edges = np.flatnonzero(np.diff(unchecked) != 1) + 1
        for part in np.split(unchecked, edges):
            self.store.check_part(name, int(part[0]), int(part[-1]) + 1)
        checked[unchecked] = True


class CheckedArray(BackendArray):
    """A variable of a store that is checked before it is read."""

    def __init__(self, name: str, variable: xr.Variable, checks: Checks) -> None:
        self.name, self.variable, self.checks = name, variable, checks
        self.shape, self.dtype = variable.shape, variable.dtype

    def __getitem__(self, key: indexing.ExplicitIndexer) -> Any:
        """Return the values at an indexer of xarray."""
        return indexing.explicit_indexing_adapter(
            key, self.shape, indexing.IndexingSupport.OUTER, self._read
        )

    def _read(self, key: tuple[Any, ...]) -> NDArray[Any]:
        """Read a part of the array after checking its chunks."""
        entries = np.unique(np.atleast_1d(np.arange(self.shape[0])[key[0]]))
        self.checks.check(self.name, entries, self.shape[0])
        return np.asarray(self.variable[key].values)


def stored_attributes(checks: Checks) -> dict[str, Any]:
    """Return the attributes of a store that its checksums cover."""
    attributes: dict[str, Any] = json.loads(checks.store.attributes())
    return attributes


def open_checked(path: str | os.PathLike[str]) -> xr.Dataset:
    """Open a store of a run.

    Its values are checked at once up to 64 MB; values of a larger store are checked when they are
    read.

    Raises
    ------
    StoreError
        There is no store, or a file of it is missing or damaged; the message names both.
    """
    root = os.fspath(path)
    for attempt in range(ATTEMPTS):
        checks = Checks(root)
        try:
            return _open(root, checks)
        except Exception as error:
            # A store that is being written has other metadata and chunks by now.
            last = attempt + 1 == ATTEMPTS
            if last or Checks(root).store.attributes() == checks.store.attributes():
                if isinstance(error, StoreError | ModuleNotFoundError):
                    raise
                message = " ".join(str(error).split())
                raise StoreError(f"{root}: {type(error).__name__}: {message}") from error
    raise AssertionError("unreachable")


def _open(root: str, checks: Checks) -> xr.Dataset:
    """Open a store with some checks."""
    arrays = array_shapes(root)
    if 8 * sum(math.prod(shape) for shape, _ in arrays.values()) <= CHECKED_AT_ONCE:
        checks.store.check()
        dataset = xr.open_zarr(root, chunks=None)
    else:
        for name, (shape, dims) in arrays.items():
            if dims == [name]:
                checks.check(name, np.arange(shape[0]), shape[0])
        dataset = xr.open_dataset(root, engine="zarr", cache=False)
        variables = {name: checked(name, dataset, checks) for name in dataset.variables}
        dataset = xr.Dataset(
            {name: variables[name] for name in dataset.data_vars},
            coords={name: variables[name] for name in dataset.coords},
            attrs=dataset.attrs,
        )
    for variable in dataset.variables.values():
        # The encoding of this store is of no use to the next one.
        variable.encoding.clear()
    attributes = stored_attributes(checks)
    opened: xr.Dataset = dataset.assign_attrs(
        {name: value for name, value in attributes.items() if name in dataset.attrs}
    )
    return opened


def array_shapes(root: str) -> dict[str, tuple[list[int], list[str]]]:
    """Return the shape and the names of the dimensions of the arrays of a store."""
    documents = json.loads(read_bytes(Path(root) / ".zmetadata"))["metadata"]
    shapes = {}
    for key, document in documents.items():
        name, _, file = key.rpartition("/")
        if file == ".zarray":
            attributes = documents.get(f"{name}/.zattrs", {})
            shapes[name] = document["shape"], attributes.get("_ARRAY_DIMENSIONS", [])
    return shapes


def checked(name: Any, dataset: xr.Dataset, checks: Checks) -> xr.Variable:
    """Return a variable that is checked when it is read; coordinates have been checked."""
    variable = dataset.variables[name]
    if name in dataset.sizes or variable.ndim == 0:
        return variable
    # Classes of xarray without types.
    cache: Any = indexing.MemoryCachedArray
    copy_on_write: Any = indexing.CopyOnWriteArray
    array = indexing.LazilyIndexedArray(CheckedArray(name, variable, checks))
    return xr.Variable(variable.dims, cache(copy_on_write(array)), variable.attrs)
