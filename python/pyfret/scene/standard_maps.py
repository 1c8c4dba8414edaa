"""Maps of heights in the two standard formats: X3P (ISO 25178-72) and SDF (ISO 25178-71).

Both are read by the libraries x3pio and sdfio: MIT licence, release 2.0.0 of October 2026, all
revisions of the standards, checksums verified. SurfaceTopography 1.27 reads the first revisions
only. surfalize 0.19 is under the GPL. Both libraries need Python 3.11; under Python 3.10
SurfaceTopography reads the first revisions, and the others are refused by name.
"""

from __future__ import annotations

import re
import struct
import sys
import zipfile
from io import BytesIO
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._core import StoreError
from pyfret._util.extras import needed
from pyfret.scene.reading import Reading

if TYPE_CHECKING:
    from pathlib import Path

__all__ = [
    "HAS_LIBRARIES",
    "is_sdf",
    "is_x3p",
    "must_be_first_revision",
    "profile",
    "read_sdf",
    "read_x3p",
]

#: First characters of an SDF file: text or binary, the standard or its predecessor, its edition.
SDF = re.compile(rb"(?:\xef\xbb\xbf)?[aAbB](?:ISO|BCR)-\d\.\d")
#: A binary head: mark, manufacturer and dates, then the numbers of points and lines (by edition),
#: scales and types [bytes].
BEFORE_COUNTS, AFTER_COUNTS = 42, 35
COUNTS = {b"ISO-1.0": "<HH", b"BCR-1.0": "<HH", b"ISO-2.0": "<II"}
#: Points of a piece of a large binary file, which stays in the cache of a processor.
PIECE = 1 << 17
#: Whether this Python has x3pio and sdfio.
HAS_LIBRARIES = sys.version_info[:2] >= (3, 11)
#: Revisions that SurfaceTopography reads as well.
FIRST_REVISIONS = (b"ISO5436 - 2000", b"ISO-1.0")
#: The revision in the description of an X3P file.
REVISION = re.compile(rb"<Revision>\s*(.*?)\s*</Revision>")


def release(library: str) -> str:
    """Name an installed library with its version."""
    # With `email` and `socket`, a tenth of the time of `import pyfret`.
    from importlib.metadata import version

    return f"{library} {version(library)}"


def is_sdf(start: bytes) -> bool:
    """Check the first bytes of a file for SDF."""
    return SDF.match(start) is not None


def is_x3p(path: Path, start: bytes) -> bool:
    """Check a file for an archive with a description of X3P."""
    if not start.startswith(b"PK"):
        return False
    try:
        with zipfile.ZipFile(path) as archive:
            return any(name.lower().rpartition("/")[2] == "main.xml" for name in archive.namelist())
    except (zipfile.BadZipFile, OSError, ValueError):
        # The end of the archive is missing: an ending decides.
        return path.suffix.lower() == ".x3p"


def must_be_first_revision(path: Path, start: bytes) -> None:
    """Refuse a revision that SurfaceTopography does not read, for a Python before 3.11."""
    revision = start.lstrip(b"\xef\xbb\xbf")[1:8]
    if not is_sdf(start):
        with zipfile.ZipFile(path) as archive:
            match = REVISION.search(archive.read("main.xml"))
        revision = match[1] if match else b"unknown"
    if revision not in FIRST_REVISIONS:
        text = revision.decode("latin-1")
        raise StoreError(f"is of the revision {text}, which needs Python 3.11 or later")


def read_sdf(path: Path, unit: str | None, spacing: object, channel: object) -> Reading:
    """Read a surface data file of any edition."""
    must_say_all(unit, spacing)
    sdfio = needed("sdfio", "surfaces")
    try:
        header, lines = _read_in_pieces(path, sdfio)
    except sdfio.SdfError as error:
        raise StoreError(f"is no whole SDF file: {' '.join(str(error).split())}") from error
    kind = f"SDF {header.revision}, {header.format.name.lower()}"
    only_channel("Default", channel)
    if min(lines.shape) == 0:
        raise StoreError("has no points")
    notes = []
    heights = lines.T
    if str(header.revision) == "BCR-1.0":
        # sdfio turns the lines over, as MountainsMap draws them.
        heights = heights[:, ::-1]
        notes.append(
            "BCR-1.0 fixes no direction of y: its first line lies at y = 0, as in ISO 25178"
        )
    if not 0.0 < abs(header.z_scale) < np.inf:
        raise StoreError(f"Zscale = {header.z_scale}: must be a positive number")
    return Reading(
        kind,
        release("sdfio"),
        heights,
        (float(header.x_scale), float(header.y_scale)),
        ("Default",),
        "Default",
        notes,
    )


def _read_in_pieces(path: Path, sdfio: Any) -> tuple[Any, Any]:
    """Return the header and the lines of an SDF file, pieces of a large binary one in turn.

    A piece is a file of its own: the head with another number of lines, and these lines.
    """
    with path.open("rb") as file:
        start = file.read(BEFORE_COUNTS)
        counts = struct.Struct(COUNTS.get(start[1:8], "<HH"))
        sizes, end = file.read(counts.size), file.read(AFTER_COUNTS)
        is_binary = start[:1] in (b"b", b"B") and start[1:8] in COUNTS
        if not is_binary or len(end) < AFTER_COUNTS:
            return _read_whole(path, sdfio)
        points, lines = counts.unpack(sizes)

        def read_lines(count: int, content: bytes) -> Any:
            head = start + counts.pack(points, count) + end
            return sdfio.read(BytesIO(head + content))

        header = read_lines(0, b"").header
        line = points * int(re.sub(r"\D", "", header.data_type.name)) // 8
        is_whole = path.stat().st_size >= len(start + sizes + end) + lines * line
        if points * lines <= PIECE or not is_whole:
            return _read_whole(path, sdfio)
        heights = np.empty((lines, points))
        step = max(1, PIECE // points)
        for first in range(0, lines, step):
            count = min(step, lines - first)
            piece = read_lines(count, file.read(count * line)).data
            # sdfio turns the lines of BCR-1.0 over, piece by piece.
            rows = slice(first, first + count)
            if str(header.revision) == "BCR-1.0":
                rows = slice(lines - first - count, lines - first)
            heights[rows] = piece
    return header, heights


def _read_whole(path: Path, sdfio: Any) -> tuple[Any, Any]:
    """Return the header and the lines of an SDF file that is read at once."""
    file = sdfio.read(path)
    return file.header, file.data


def read_x3p(path: Path, unit: str | None, spacing: object, channel: object) -> Reading:
    """Read an X3P file of any revision; its layers are channels."""
    must_say_all(unit, spacing)
    x3pio = needed("x3pio", "surfaces")
    notes = []
    try:
        try:
            file: Any = x3pio.read(path)
        except x3pio.X3pChecksumError as error:
            if "main.xml" not in str(error):
                raise
            # Of the description alone: some programs write another checksum there. Damage to the
            # archive is found by its own checksums.
            file = x3pio.read(path, verify=False)
            notes.append(
                "the checksum of its description is wrong: check the size, or the program that "
                "wrote it"
            )
    except x3pio.X3pChecksumError as error:
        raise StoreError(f"is damaged: {' '.join(str(error).split())}") from error
    except x3pio.X3pError as error:
        raise StoreError(f"is no whole X3P file: {' '.join(str(error).split())}") from error
    if isinstance(file, x3pio.PointCloud):
        raise StoreError("holds a cloud of points, not a map of heights over an even grid")
    names = tuple(f"layer {n}" for n in range(len(file.layers)))
    layer = file.layers[chosen_layer(names, channel)]
    if isinstance(file, x3pio.Profile):
        raise StoreError(profile(layer.z.shape[-1]))
    if not layer.is_regular_grid:
        raise StoreError("has a place of its own for each point: only even grids are read")
    reading = Reading(
        f"X3P, {file.revision.value}",
        release("x3pio"),
        layer.z.T,
        tuple(float(step) for step in layer.spacing),  # type: ignore[arg-type]
        names,
        names[chosen_layer(names, channel)],
        notes,
    )
    if len(names) > 1 and channel is None:
        reading.notes.append(f"has {len(names)} layers, {', '.join(names)}: the first is read")
    if layer.placement.has_rotation:
        reading.notes.append("lies turned in space: heights are read along its own z")
    return reading


def profile(points: int) -> str:
    """Return the reason why a profile is refused."""
    return (
        f"holds a profile of {points} points, not a map of heights over the plane. In plane strain "
        "give its heights as an array of shape (n, 1), "
        "SurfaceMap(heights.reshape(-1, 1), spacing=(2e-6, 1.0))"
    )


def must_say_all(unit: str | None, spacing: object) -> None:
    """Refuse a unit or a spacing beside the file's."""
    if unit is not None:
        raise StoreError("has its unit, m: leave unit out")
    if spacing is not None:
        raise StoreError("has its spacing: leave spacing out")


def only_channel(name: str, channel: object) -> None:
    """Refuse a channel that a file with one map does not have."""
    if channel not in (None, 0, name):
        raise StoreError(f"has no channel {channel!r}: there is 0 ({name!r})")


def chosen_layer(names: tuple[str, ...], channel: object) -> int:
    """Return the index of a layer that is chosen by name or index."""
    if channel is None:
        return 0
    if channel in names:
        return names.index(str(channel))
    if isinstance(channel, int) and 0 <= channel < len(names):
        return channel
    raise StoreError(f"has no channel {channel!r}: there are {', '.join(names)}")
