"""Results in files: Zarr stores and NetCDF.

A file of :func:`write` has checksums of its attributes and its numbers, which :func:`read`
compares. Files that xarray wrote have none and are read as they are.
"""

from __future__ import annotations

import errno
import glob
import json
import os
import platform
import shutil
import zlib
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._core import StoreError, read_bytes, shown
from pyfret._util.extras import needed
from pyfret._util.lazy import xr
from pyfret._util.stores import check_heads, check_store

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["checked", "deflate", "is_copy", "opened", "read", "replacement", "write"]

#: Bytes of a NetCDF file beside its numbers, more than.
MARGIN = 1 << 20

#: How many times as large as the file the numbers of a NetCDF file may be: zlib packs no better.
RATIO = 1100
#: Attribute with the checksums, and bytes of numbers up to which they are compared when a file is
#: opened; the numbers of larger files are read when they are asked for.
SUMS, COMPARED = "copy_crc32", 1 << 28
#: What marks an attribute as JSON, where a file has no room for what it is.
JSON = "json:"


def flat(value: object) -> object:
    """An attribute that NetCDF has room for: numbers and text as they are, the rest as JSON."""
    return value if isinstance(value, (str, int, float)) else JSON + json.dumps(value)


def unfolded(value: Any) -> Any:
    """The attribute that :func:`flat` was given."""
    text = isinstance(value, str) and value.startswith(JSON)
    return json.loads(value[len(JSON) :]) if text else value


def plain(value: Any) -> Any:
    """Return an attribute in the form in which every format gives it back."""
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, list | tuple):
        return plain(value[0]) if len(value) == 1 else [plain(item) for item in value]
    if isinstance(value, dict):
        return {str(key): plain(item) for key, item in value.items()}
    return float(value) if isinstance(value, int | float) else value


def content(values: Any) -> bytes:
    """Return numbers and texts as bytes, the same after every format."""
    array = np.asarray(values)
    if array.dtype.kind in "biuf":
        return np.ascontiguousarray(array, "<f8" if array.dtype.kind == "f" else "<i8").tobytes()
    return json.dumps([str(label) for label in array.ravel().tolist()]).encode()


def sums_of(dataset: xr.Dataset, *, numbers: bool) -> dict[str, int]:
    """Return checksums of the attributes (key "") and of each variable with its labels.

    Without `numbers` the units of the variables stand in their labels alone.
    """
    attributes = {k: v for k, v in dataset.attrs.items() if k != SUMS}
    sums = {"": zlib.crc32(json.dumps(plain(attributes), sort_keys=True).encode())}
    for name, variable in dataset.variables.items():
        head = [list(map(str, variable.dims)), list(variable.shape), plain(variable.attrs)]
        sum_of = zlib.crc32(json.dumps(head, sort_keys=True).encode())
        sums[f"{name} labels"] = sum_of
        if numbers:
            sums[str(name)] = zlib.crc32(content(variable.values), sum_of)
    return sums


def compare(dataset: xr.Dataset) -> xr.Dataset:
    """Return the dataset without its checksums, after comparing them.

    Raises
    ------
    ValueError
        Something is not what was written; the message names it.
    """
    stored = dataset.attrs.pop(SUMS, None)
    if stored is None:
        return dataset
    numbers = dataset.nbytes <= COMPARED
    sums = sums_of(dataset.load() if numbers else dataset, numbers=numbers)
    there = {k: v for k, v in dict(stored).items() if numbers or not k or k.endswith(" labels")}
    wrong = [name for name in {**there, **sums} if there.get(name) != sums.get(name)]
    if wrong:
        subject = wrong[0].removesuffix(" labels") or "an attribute"
        raise ValueError(f"{subject} is damaged: it is not what was written")
    return dataset


def write(
    dataset: xr.Dataset,
    path: str | os.PathLike[str],
    *,
    overwrite: bool = False,
    otherwise: str = ", or replace it with overwrite=True",
) -> None:
    """Write a dataset to a Zarr folder (``.zarr``) or a NetCDF file (``.nc``).

    It is written beside its place and put there at once. With `overwrite` it replaces what
    pyfret or xarray wrote there, and nothing else. The refusal of a place that is not free ends
    with `otherwise`.
    """
    target = Path(path)
    restore(target)
    if target.exists() and not (overwrite and replaceable(target)):
        raise FileExistsError(
            f"{target}: is there already"
            + (
                ", and is no store or file of results: choose another place"
                if overwrite
                else f": choose another place{otherwise}"
            )
        )
    if target.suffix not in (".zarr", ".nc"):
        raise ValueError(f"{target}: must end in .zarr or .nc")
    dataset = dataset.assign_attrs({SUMS: sums_of(dataset, numbers=True)})
    with replacement(target) as unfinished:
        if target.suffix == ".zarr":
            encoding = {name: deflate() for name in dataset.variables}
            dataset = without_booleans(dataset)
            dataset.to_zarr(unfinished, zarr_format=2, consolidated=True, encoding=encoding)
        else:
            need_netcdf()
            attrs = {k: flat(v) for k, v in dataset.attrs.items()}
            reserve(unfinished, dataset.nbytes)
            encoding = {
                name: shuffled(variable)
                for name, variable in dataset.variables.items()
                if variable.ndim and variable.size and variable.dtype.kind in "biuf"
            }
            dataset.assign_attrs(attrs).to_netcdf(unfinished, encoding=encoding)


def need_netcdf() -> None:
    """Fail with the name of the extra where no library for NetCDF-4 files is installed.

    h5netcdf installs without the library that reads and writes its files.
    """
    try:
        needed("netCDF4", "netcdf")
    except ModuleNotFoundError:
        for module in ("h5py", "h5netcdf"):
            needed(module, "netcdf")


def replaceable(place: Path) -> bool:
    """Return whether the place holds a file or folder of results, which may be replaced."""
    if place.is_dir():
        return any((place / name).is_file() for name in (".zgroup", ".zmetadata", "zarr.json"))
    return place.suffix == ".nc" and place.is_file()


def shuffled(variable: xr.Variable) -> dict[str, Any]:
    """Return the encoding of numbers in NetCDF: compressed, a chunk for each field."""
    first = 1 if variable.ndim > 2 else variable.shape[0]
    chunks = (first, *variable.shape[1:])
    return {"zlib": True, "complevel": 1, "shuffle": True, "chunksizes": chunks}


def without_booleans(dataset: xr.Dataset) -> xr.Dataset:
    """Return a dataset with booleans as 0 and 1, marked as xarray does: netCDF-C has none."""
    packed = {
        name: (variable.dims, variable.astype("u1").data, {**variable.attrs, "dtype": "bool"})
        for name, variable in dataset.variables.items()
        if variable.dtype == bool
    }
    return dataset.assign(packed)


def deflate() -> dict[str, Any]:
    """Return the encoding of copies and studies: zlib, which has no clock and netCDF-C reads."""
    return encoding_of(import_module("numcodecs").Zlib(level=1))


def encoding_of(codec: Any) -> dict[str, Any]:
    """Return the encoding with a codec, as the version of zarr takes it."""
    old = import_module("zarr").__version__.startswith("2.")
    return {"compressor": codec} if old else {"compressors": [codec]}


@contextmanager
def replacement(place: Path) -> Iterator[Path]:
    """Give a name beside `place`; what is there at the end takes its place, or goes on failure.

    A process that is ended between two moves leaves the new folder and the old one, both under
    other names. Then :func:`restore` puts the new one in place. The next writing clears leftovers.
    """
    restore(place)
    clear_leftovers(place)
    unfinished, old = (leftover(place, kind) for kind in (UNFINISHED, OLD))
    try:
        yield unfinished
        if place.is_dir():
            # A folder with files takes no other one in its place.
            place.replace(old)
            unfinished.replace(place)
            remove(old)
        else:
            unfinished.replace(place)
    finally:
        remove(unfinished)


#: Kinds of leftovers: a result that is being written, and one that a new result replaces.
UNFINISHED, OLD = "unfinished", "old"


def leftover(place: Path, kind: str, process: str | None = None) -> Path:
    """Return the name beside `place` that a process, by default this one, writes to."""
    process = process or f"{platform.node()}-{os.getpid()}"
    return place.with_name(f".{place.name}.{process}.{kind}{place.suffix}")


def leftovers(place: Path, kind: str) -> dict[str, Path]:
    """Return what processes of this machine that have ended left beside `place`, by process."""
    begin, end = f".{place.name}.", f".{kind}{place.suffix}"
    ended = {}
    for path in place.parent.glob(f"{glob.escape(begin)}*{glob.escape(end)}"):
        process = path.name[len(begin) : -len(end)]
        host, _, pid = process.rpartition("-")
        if host == platform.node() and pid.isdecimal() and not is_running(int(pid)):
            ended[process] = path
    return ended


def is_running(pid: int) -> bool:
    """Check whether a process runs on this machine; where that cannot be asked it may."""
    if os.name != "posix":
        return True
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except OSError:
        return True
    return True


def restore(place: Path) -> None:
    """Put a result in its place if a process was ended between moving the old and the new one."""
    if place.exists():
        return
    for process, old in leftovers(place, OLD).items():
        # The old one is moved when the new one is complete.
        new = leftover(place, UNFINISHED, process)
        (new if new.exists() else old).replace(place)
        return


def clear_leftovers(place: Path) -> None:
    """Remove what processes that have ended left beside `place`."""
    for kind in (UNFINISHED, OLD):
        for path in leftovers(place, kind).values():
            remove(path)


def remove(path: Path) -> None:
    """Remove a file or a folder, if it is there."""
    if path.is_dir():
        shutil.rmtree(path, ignore_errors=True)
    else:
        path.unlink(missing_ok=True)


def reserve(path: Path, size: int) -> None:
    """Fail if the disk has no room: the library of NetCDF ends the process where it is full."""
    if not hasattr(os, "posix_fallocate"):
        return
    with path.open("wb") as file:
        try:
            os.posix_fallocate(file.fileno(), 0, max(size, 1) + MARGIN)
        except OSError as error:
            if error.errno in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG):
                raise OSError(error.errno, os.strerror(error.errno), str(path)) from error
    path.unlink()


def read(path: str | os.PathLike[str]) -> xr.Dataset:
    """Read the dataset of a Zarr store or of a NetCDF file (``.nc``) that :func:`write` wrote."""
    if Path(path).suffix == ".nc":
        need_netcdf()
        size = len(read_bytes(path))
        dataset = xr.open_dataset(path)
        kinds = {
            str(variable.dtype)
            for variable in dataset.variables.values()
            if variable.dtype.kind not in "biufUS"
        }
        if kinds - {"object"} or dataset.nbytes > RATIO * size + MARGIN:
            dataset.close()
            raise ValueError("holds other types or more numbers than its size allows")
        dataset = dataset.assign_attrs({k: unfolded(v) for k, v in dataset.attrs.items()})
    else:
        dataset = xr.open_zarr(path, chunks=None)
    for variable in dataset.variables.values():
        # How it lies in this file is of no use to the next one, and its codecs would not do there.
        variable.encoding.clear()
    return compare(dataset)


def opened(path: str | os.PathLike[str]) -> xr.Dataset:
    """Open the dataset of a file as :func:`read`; a StoreError has the reason if there is none.

    Of a folder :func:`pyfret._util.stores.check_store` comes first.
    """
    checked(path)
    if Path(path).is_dir():
        check_heads(path)
    try:
        return read(path)
    except ModuleNotFoundError:
        raise
    except Exception as error:
        message = " ".join(str(error).split())
        raise StoreError(f"{os.fspath(path)}: {type(error).__name__}: {message}") from error


#: Files of the metadata of a store, of any format.
METADATA = ("zarr.json", ".zgroup", ".zattrs", ".zmetadata")
#: What opens files that are no results, by their ending.
READERS = {
    ".toml": "a scene is opened by fret.Scene.from_file(path)",
    **dict.fromkeys(
        (".csv", ".txt", ".dat", ".xlsx"),
        "fret.fit.read_loops(path), fret.LoadHistory.from_csv(path) and fret.read_surface(path) "
        "read tables",
    ),
}


def checked(path: str | os.PathLike[str], *, chunks: bool = True) -> None:
    """Refuse a file or folder that pyfret has not written, before anything is read of it.

    `chunks` as in :func:`pyfret._util.stores.check_store`.
    """
    target = Path(path)
    restore(target)
    if not target.exists():
        raise StoreError(shown(f"{os.fspath(path)}: no such file or folder"))
    is_store = target.suffix == ".zarr" or any((target / name).exists() for name in METADATA)
    if target.is_dir() and is_store:
        check_store(target, chunks=chunks)
    elif target.is_dir() or target.suffix != ".nc":
        if target.is_file():
            read_bytes(path)
        reader = READERS.get(target.suffix.lower(), "a folder .zarr, or a file .nc")
        raise StoreError(shown(f"{os.fspath(path)}: is no result: {reader}"))


def is_copy(path: str | os.PathLike[str]) -> bool:
    """Return whether a file is a copy without checksums, by :func:`write` or xarray.

    Zarr folders of schema 1 are stores: they had none either, and are refused as such.
    """
    if Path(path).suffix == ".nc":
        return True
    try:
        if (Path(path) / "zarr.json").is_file():
            # Format 3, which xarray writes by default.
            group = json.loads((Path(path) / "zarr.json").read_bytes())
            return isinstance(group["attributes"]["schema"], int)
        consolidated = json.loads((Path(path) / ".zmetadata").read_bytes())
        schema = consolidated["metadata"][".zattrs"]["schema"]
    except (OSError, ValueError, LookupError, TypeError):
        return False
    sums = {"checksums", "crc32"} & set(consolidated)
    return not sums and isinstance(schema, int) and schema > 1
