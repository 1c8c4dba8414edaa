"""Folders that are said to be stores: looked at before a library reads them.

A store from somebody else is data. Its metadata name programs (codecs, filters) and types that a
library would run or build. Those that pyfret does not write are refused by name before a chunk is
read. So are sizes that the files do not bear out, and what is no file.
"""

from __future__ import annotations

import json
import math
import os
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pyfret._core import StoreError, read_bytes, shown
from pyfret._util.unpacking import unpacks_within

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

__all__ = ["check_heads", "check_store"]

#: Codecs that pyfret writes, or xarray for it.
CODECS = frozenset(("gzip", "zlib", "zstd", "blosc", "bytes", "crc32c"))
#: Codecs that pack.
PACKED = frozenset(("gzip", "zlib", "zstd", "blosc"))
#: Types of numbers and text of a fixed length, in Zarr 2 and 3.
TYPES = re.compile(r"[<>|]?(b1|[iu][1248]|f[248]|[US]\d{1,6})")
NAMES = frozenset(
    (
        *("bool", "float16", "float32", "float64", "fixed_length_utf32"),
        *(f"{kind}{bits}" for kind in ("int", "uint") for bits in (8, 16, 32, 64)),
    )
)
#: Attributes of an array or a group: they describe no array, whatever their names are.
ATTRIBUTES = ".zattrs"
#: Documents that hold metadata.
DOCUMENTS = (".zarray", ".zattrs", ".zgroup", ".zmetadata", "zarr.json")
#: Bytes that an array may have without a file of its own, and values of a chunk, a field of
#: the largest grid.
FREE, LARGEST = 1 << 26, 1 << 28
#: Levels of folders of a store.
DEEPEST = 6


def check_store(path: str | os.PathLike[str], *, chunks: bool = True) -> None:
    """Refuse a store that asks for more than to be read.

    Without `chunks` the sizes to which its chunks unpack are not compared with the metadata. The
    reader of runs compares them chunk by chunk.

    Raises
    ------
    StoreError
        The store holds a codec, a filter or a type that pyfret does not write. Or its files do not
        bear out a size, or it is neither a file nor a folder. The message names the cause.
    """
    root = Path(path)
    try:
        for file in [file for file in entries(root, DEEPEST) if file.name in DOCUMENTS]:
            check_document(root, Path(file.path), chunks=chunks)
    except Refused as refused:
        raise StoreError(shown(f"{os.fspath(path)}: {refused}")) from None
    except (OSError, RecursionError) as error:
        raise StoreError(shown(f"{os.fspath(path)}: {error}")) from error


def check_heads(path: str | os.PathLike[str]) -> None:
    """Refuse a store whose arrays have other heads than its collected metadata.

    Readers take one or the other, so that a changed head gives other numbers to some of them.

    Raises
    ------
    StoreError
        A head is missing, or differs. The message names the file.
    """
    root = Path(path)
    collected = root / ".zmetadata"
    if not collected.is_file():
        return
    try:
        heads = json.loads(read_bytes(collected))["metadata"]
        for name, head in heads.items():
            if json.loads(read_bytes(root / name)) != head:
                raise Refused(
                    f"the file {name} is not what was written: .zmetadata has other values"
                )
    except Refused as refused:
        raise StoreError(shown(f"{os.fspath(path)}: {refused}")) from None
    except (OSError, ValueError, LookupError, TypeError, AttributeError, RecursionError) as error:
        raise StoreError(shown(f"{os.fspath(path)}: {error}")) from error


class Refused(Exception):
    """Why a store is not read."""


def entries(folder: str | os.PathLike[str], levels: int) -> Iterator[os.DirEntry[str]]:
    """Yield the files of a folder and of the folders in it, so many `levels` deep."""
    if levels == 0:
        raise Refused(f"{Path(folder).name}: folders lie {DEEPEST} deep in it")
    with os.scandir(folder) as listed:
        for entry in listed:
            if entry.is_dir():
                yield from entries(entry.path, levels - 1)
            elif entry.is_file():
                yield entry
            else:
                raise Refused(f"{entry.name} is not a file")


def check_document(root: Path, file: Path, *, chunks: bool) -> None:
    """Refuse a document of metadata that asks for too much memory; the message names it."""
    name = file.relative_to(root)
    try:
        document = json.loads(read_bytes(file))
    except ValueError as error:
        raise Refused(f"the file {name} is damaged: {error}") from None
    if not isinstance(document, dict):
        raise Refused(f"the file {name} is damaged: it is no object")
    if file.name == ATTRIBUTES:
        return
    try:
        check_arrays(document, file.parent, root, chunks=chunks)
    except Refused as refused:
        raise Refused(f"the file {name}: {refused}") from None


def check_arrays(document: Mapping[str, Any], where: Path, root: Path, *, chunks: bool) -> None:
    """Refuse an array of a document, or of its collected metadata, that is too large."""
    check_array(document, where, root, chunks=chunks)
    for key in ("metadata", "consolidated_metadata"):
        inner = document.get(key)
        inner = inner.get("metadata", inner) if isinstance(inner, dict) else inner
        if isinstance(inner, dict):
            for name, of in inner.items():
                if isinstance(of, dict) and not name.endswith(f"/{ATTRIBUTES}"):
                    part = name.removesuffix("/.zarray")
                    check_array(of, where / part.removeprefix("/"), root, chunks=chunks)


def check_array(of: Mapping[str, Any], where: Path, root: Path, *, chunks: bool) -> None:
    """Refuse metadata of an array that ask for too much memory; others describe no array."""
    if "shape" not in of and "dtype" not in of and "data_type" not in of:
        return
    name = where.name
    for codec in codecs(of):
        word = codec.get("id", codec.get("name")) if isinstance(codec, dict) else codec
        if word not in CODECS:
            allowed = ", ".join(sorted(CODECS))
            raise Refused(f"{name}: asks for the codec {word!r}: pyfret reads {allowed}")
    if of.get("filters") or of.get("storage_transformers"):
        raise Refused(f"{name}: asks for filters, {of.get('filters')!r}: pyfret reads none")
    kind = of.get("dtype", of.get("data_type"))
    word = kind.get("name") if isinstance(kind, dict) else kind
    if not isinstance(word, str) or not (TYPES.fullmatch(word) or word in NAMES):
        raise Refused(f"{name}: holds {kind!r}: pyfret reads numbers and text of a fixed length")
    check_size(of, where, root, word, unpacked=chunks)


def codecs(of: Mapping[str, Any]) -> list[Any]:
    """Return the codecs that an array names."""
    listed = of.get("codecs") or []
    codecs = [of["compressor"]] if of.get("compressor") is not None else []
    return [*codecs, *(listed if isinstance(listed, list) else [listed])]


def check_chunks(of: Mapping[str, Any], where: Path, root: Path, limit: int) -> None:
    """Refuse chunks that unpack to more bytes than the metadata of the array have room for."""
    if not (where.resolve().is_relative_to(root.resolve()) and where.is_dir()):
        return
    words = (c.get("id", c.get("name")) if isinstance(c, dict) else c for c in codecs(of))
    names = sorted({str(word) for word in words} & PACKED)
    for file in entries(where, DEEPEST):
        if not file.name.startswith((".", "zarr")):
            for name in names:
                if not unpacks_within(Path(file.path), name, limit):
                    shown_name = Path(file.path).relative_to(root)
                    raise Refused(f"{shown_name}: unpacks to more than its {limit} bytes")


def check_size(
    of: Mapping[str, Any], where: Path, root: Path, word: str, *, unpacked: bool
) -> None:
    """Refuse an array whose shape is larger than its files can make it."""
    grid = of.get("chunk_grid") or {}
    inner = grid.get("configuration", {}) if isinstance(grid, dict) else {}
    # A single number has no axis: its chunks are an empty list.
    chunks = of.get("chunks")
    if chunks is None and isinstance(inner, dict):
        chunks = inner.get("chunk_shape")
    for sizes, subject, least in ((of.get("shape"), "shape", 0), (chunks, "chunks", 1)):
        whole = isinstance(sizes, list) and all(type(n) is int and n >= least for n in sizes)
        if not whole:
            raise Refused(f"{where.name}: has no {subject} but {sizes!r}")
    digits = re.search(r"\d+", word)
    width = max(int(digits[0]) if digits else 1, 1)
    values, chunk = math.prod(of["shape"]), math.prod(chunks or [1])
    if chunk > LARGEST:
        raise Refused(f"{where.name}: has chunks of {chunk} values: must be {LARGEST} at most")
    if unpacked:
        check_chunks(of, where, root, chunk * width * (4 if "U" in word else 1))
    if values * width <= FREE:
        return
    inside = where.resolve().is_relative_to(root.resolve()) and where.is_dir()
    files = (
        sum(not n.name.startswith((".", "zarr")) for n in entries(where, DEEPEST)) if inside else 0
    )
    if values > files * chunk:
        raise Refused(
            f"{where.name}: has {values} values by its shape, but {files} files of {chunk} each"
        )
