"""The ledger of a study: a line for every point that has been written, with checksums.

The file ``status/.points`` lies in the store, where no Zarr library looks for arrays. Its first
line describes the layout. Each other line describes a point: its status, and checksums of its
values in the arrays. These are checksums of values and not of files, which points share. A line
ends in its own checksum. A point counts once its line is whole. A killed process may leave the last
line unfinished; it is then left out.
"""

from __future__ import annotations

import json
import os
import zlib
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._core import StoreError

if TYPE_CHECKING:
    from collections.abc import Iterable

    import xarray as xr

__all__ = ["FILE", "Ledger", "attributes", "checksum"]

#: Codes of the status of points that were solved.
SOLVED = (1, 3)
#: Name of the file in the store.
FILE = "status/.points"


def checksum(variable: xr.Variable, attrs: str = "") -> int:
    """Compute the CRC-32 of a variable: its values, their type and shape, its attributes."""
    values = np.ascontiguousarray(variable.values)
    text = values.dtype.kind in "OTSU"
    if text:
        content = json.dumps(values.tolist()).encode()
    else:
        content = values.astype(values.dtype.newbyteorder("<")).tobytes()
    kind = "text" if text else values.dtype.kind
    return zlib.crc32(content, zlib.crc32(f"{kind} {values.shape} {attrs}".encode()))


def attributes(dataset: xr.Dataset) -> dict[str, str]:
    """Return the attributes of every variable, as text."""
    return {
        str(name): json.dumps(dict(variable.attrs), sort_keys=True, default=str)
        for name, variable in dataset.variables.items()
    }


def write_line(entry: Any) -> bytes:
    """Write an entry as a line."""
    text = json.dumps(entry, separators=(",", ":"))
    return f"{text}\t{zlib.crc32(text.encode()):08x}\n".encode()


def read_line(line: bytes) -> Any:
    """Read the entry of a line; a ValueError if the line is damaged."""
    text, _, crc = line.rstrip(b"\n").partition(b"\t")
    if not line.endswith(b"\n") or f"{zlib.crc32(text):08x}".encode() != crc:
        raise ValueError("is damaged")
    return json.loads(text)


class Ledger:
    """The record of the written points of a study.

    Attributes
    ----------
    layout : int
        Checksum of the coordinates and attributes.
    points : dict of int to (int, dict of str to int)
        Status of each point, and checksums of its values in the arrays.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        try:
            lines = (folder / FILE).read_bytes().splitlines(keepends=True)
        except OSError as error:
            raise StoreError(f"{folder}: the file {FILE}: {error.strerror}") from error
        #: Bytes of the lines that are whole.
        self.length = 0
        entries: list[Any] = []
        for n, line in enumerate(lines):
            try:
                entries.append(read_line(line))
            except ValueError as error:
                if n + 1 == len(lines) and not line.endswith(b"\n") and entries:
                    break
                raise StoreError(f"{folder}: the file {FILE}, line {n + 1}: {error}") from error
            self.length += len(line)
        if not entries:
            raise StoreError(f"{folder}: the file {FILE} is empty")
        self.layout = int(entries[0])
        self.points: dict[int, tuple[int, dict[str, int]]] = {
            int(n): (int(status), sums) for n, status, sums in entries[1:]
        }
        #: The point of the last line, whose status may not have been written yet.
        self.last = int(entries[-1][0]) if len(entries) > 1 else None

    @staticmethod
    def begin(folder: Path, layout: int) -> None:
        """Write the ledger of a study without points."""
        (folder / FILE).write_bytes(write_line(layout))

    def add(
        self, n: int, status: int, values: dict[str, xr.Variable], attrs: dict[str, str]
    ) -> None:
        """Record that the n-th point has been written, to variables of these attributes."""
        sums = {name: checksum(variable, attrs.get(name, "")) for name, variable in values.items()}
        with (self.folder / FILE).open("r+b") as file:
            file.truncate(self.length)
            file.seek(self.length)
            line = write_line([n, status, sums])
            file.write(line)
            file.flush()
            os.fsync(file.fileno())
        self.length += len(line)
        self.points[n] = status, sums
        self.last = n

    def check(self, layout: int, dataset: xr.Dataset, point_dims: Iterable[str]) -> None:
        """Reject arrays that differ from the ledger; the message names array and point.

        `point_dims` are the dimensions of the points.
        """
        if layout != self.layout:
            raise StoreError(
                f"{self.folder}: its coordinates or attributes are not those that were written"
            )
        sizes = {dim: dataset.sizes[dim] for dim in point_dims}
        status, attrs = dataset["status"].values.ravel(), attributes(dataset)
        for n, (code, sums) in self.points.items():
            indices = dict(zip(sizes, np.unravel_index(n, tuple(sizes.values())), strict=True))
            where = ", ".join(f"{dim} {int(i)}" for dim, i in indices.items())
            if status[n] != code and n != self.last:
                raise StoreError(f"{self.folder}: status of point {where}: is not what was written")
            if code in SOLVED and not dataset["seconds"].values.ravel()[n] > 0.0:
                # Times differ from run to run and have no checksum. A solved point has one.
                raise StoreError(
                    f"{self.folder}: seconds of point {where}: a file of seconds is missing"
                )
            for name, crc in sums.items():
                if name not in dataset:
                    raise StoreError(f"{self.folder}: {name}: is missing")
                value = dataset[name].variable.isel({dim: int(i) for dim, i in indices.items()})
                if checksum(value, attrs[name]) != crc:
                    raise StoreError(
                        f"{self.folder}: {name} of point {where}: is not what was written; a file "
                        f"of {name} is missing or damaged"
                    )
        unlisted = [n for n in np.flatnonzero(status) if int(n) not in self.points]
        if unlisted:
            raise StoreError(
                f"{self.folder}: point {unlisted[0]} has a status and no line in the file {FILE}"
            )
