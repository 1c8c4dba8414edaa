"""Maps of heights in the formats of instruments, by SurfaceTopography."""

from __future__ import annotations

import gzip
import warnings
from importlib import import_module
from os import fspath
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._core import StoreError, check_sides, unit_of
from pyfret._util.numbers import length
from pyfret.scene.reading import Reading
from pyfret.scene.standard_maps import profile

if TYPE_CHECKING:
    from pathlib import Path

    from pyfret.quantities import Length

__all__ = ["NEEDED", "read_by_surface_topography"]

#: Oldest release that masks undefined points of all its formats.
NEEDED = (1, 27, 1)
#: Mark of an HDF5 file of Octave, whose matrices are transposed.
OCTAVE = b"OCTAVE_NEW_FORMAT"
#: Readers of files without a mark of their format: they take a file by its size.
BY_SIZE = frozenset(("nms", "hgt"))
#: What SurfaceTopography assumes of a format that its files do not state.
ASSUMED = {
    "tmd": "lengths and heights of a .tmd are taken for mm, which the file does not state",
    "mat": "the rows of the matrix run along x, the columns along y, which a .mat does not state",
    "npz": "the rows of the array run along x, the columns along y, which a .npz does not state",
    "h5": "the rows of the array run along x, the columns along y, which the file does not state",
}


def read_by_surface_topography(
    path: Path,
    spacing: Length | tuple[Length, Length] | None,
    unit: str | None,
    channel: str | int | None,
    detrend: str,
) -> Reading:
    """Read a map by the first reader whose mark, or ending, the file has."""
    try:
        from SurfaceTopography.IO import open_topography
    except ImportError as absent:
        message = (
            'reading instrument files needs SurfaceTopography: pip install "fretting[surfaces]"'
        )
        raise ImportError(message) from absent
    release = import_module("importlib.metadata").version("SurfaceTopography")
    if tuple(int(part) for part in release.split(".")[:3] if part.isdigit()) < NEEDED:
        raise StoreError(
            f"needs SurfaceTopography 1.27.1 or later, and {release} is installed: older releases "
            "read points that were not measured as heights"
        )
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            reader = open_topography(fspath(path))
            must_be_its_format(path, reader)
            reading, index = described(path, reader, channel, release)
            surface = measured(reader, index, spacing, unit)
            if surface.dim != 2:
                raise StoreError(profile(surface.nb_grid_pts[0]))
            kind, scale = unit_of(str(surface.unit)) or ("", 1.0)
            if kind != "length":
                surface, scale = surface.to_unit("m"), 1.0
            trended = surface if detrend == "center" else surface.detrend(detrend)
            heights: Any = trended.heights()
            x, y = (scale * step for step in surface.pixel_size)
    except StoreError:
        raise
    except Exception as error:
        raise StoreError(why_not(path, error)) from error
    if reader.format() == "gwy" and np.ma.is_masked(heights):
        count = int(np.ma.getmaskarray(heights).sum())
        reading.notes.append(f"{count} points under a mask of Gwyddion count as not measured")
    reading.heights = with_holes(heights)
    if scale != 1.0:
        reading.heights *= scale
    reading.spacing = (float(x), float(y))
    if spacing is not None and reader.channels[index].physical_sizes is not None:
        replace_spacing(reading, spacing)
    return reading


def with_holes(heights: Any) -> Any:
    """Return heights as an array that may be changed, NaN where masked."""
    values = np.ma.getdata(heights)
    if values.dtype != float or not values.flags.writeable:
        values = np.array(values, dtype=float)
    if np.ma.is_masked(heights):
        values[np.ma.getmaskarray(heights)] = np.nan
    return values


def replace_spacing(reading: Reading, spacing: Length | tuple[Length, Length]) -> None:
    """Take the pitch of the user where no instrument has the file's; refuse it elsewhere."""
    try:
        check_sides(reading.heights.shape, reading.spacing)
    except StoreError:
        x, y = np.broadcast_to(np.asarray(spacing, dtype=float), 2).tolist()
        reading.notes.append(f"the file's pitch of {length(reading.spacing[0])} is not used")
        reading.spacing = (x, y)
        return
    raise StoreError("has its spacing: leave spacing out")


def must_be_its_format(path: Path, reader: Any) -> None:
    """Refuse a reader that takes a file by its size alone, unless the file has its ending."""
    name = reader.format()
    if name == "hgt" or (
        name in BY_SIZE and path.suffix.lower().lstrip(".") not in reader.file_extensions()
    ):
        raise StoreError("is no file of an instrument that SurfaceTopography reads, or is damaged")
    if name == "h5":
        with path.open("rb") as file:
            if OCTAVE in file.read(65536):
                raise StoreError("is HDF5 of Octave, which turns its matrices: save it with -v7")
    if name == "npz" and path.suffix.lower() != ".npz":
        raise StoreError("is an archive that no reader of an instrument takes, or is damaged")


def described(
    path: Path, reader: Any, channel: str | int | None, release: str
) -> tuple[Reading, int]:
    """Return format, channels and notes of an open file, and the index of the channel to read."""
    channels = list(reader.channels)
    names = [str(item.name) for item in channels]
    heights = [n for n, item in enumerate(channels) if is_height(item)] or [*range(len(channels))]
    notes = [ASSUMED[reader.format()]] if reader.format() in ASSUMED else []
    if not channels:
        raise StoreError("holds no channel of heights")
    index = chosen_channel(names, heights, channel)
    if channel is None and len(heights) > 1:
        listed = ", ".join(f"{n} ({names[n]!r})" for n in heights)
        notes.append(
            f"the file has {len(heights)} channels: {listed}; {names[index]!r} is read, another by "
            f"channel={names[heights[-1]]!r}"
        )
    if reader.format() == "sur":
        notes += notes_of_sur(channels[index])
    reading = Reading(
        reader.name(),
        f"SurfaceTopography {release}",
        np.zeros((0, 0)),
        (1.0, 1.0),
        tuple(names[n] for n in heights),
        names[index],
        notes,
    )
    return reading, index


def notes_of_sur(channel: Any) -> list[str]:
    """Return notes on the offset and the units of the heights of a .sur."""
    raw = channel.info.get("raw_metadata")
    if raw is None:
        return []
    read = raw.get if hasattr(raw, "get") else lambda key, other=None: getattr(raw, key, other)
    notes = []
    offset, unit, second = (read(key) for key in ("data_offset", "data_unit", "delta_data_unit"))
    if offset:
        notes.append(f"the offset of the heights in the .sur, {offset:g} {unit}, is not added")
    if unit and second and unit != second:
        notes.append(f"the .sur has the units {unit} and {second} of heights: {second} is taken")
    return notes


def chosen_channel(names: list[str], heights: list[int], channel: str | int | None) -> int:
    """Return the index of a channel: chosen by name or index, else the first one of heights."""
    listed = ", ".join(f"{n} ({names[n]!r})" for n in heights)
    if channel is None:
        return heights[0]
    if isinstance(channel, str):
        matching = [n for n, name in enumerate(names) if name == channel]
        if len(matching) == 1:
            return matching[0]
        count = "none" if not matching else f"{len(matching)} channels"
        raise StoreError(
            f"{count} of that name, {channel!r}: there are {listed}; an index chooses one"
        )
    if not 0 <= channel < len(names):
        raise StoreError(f"has no channel {channel}: there are {listed}")
    return channel


def is_height(channel: Any) -> bool:
    """Check that a channel holds heights; one without a kind in its file counts as such."""
    return bool(getattr(channel, "is_height_channel", True))


def measured(
    reader: Any,
    index: int,
    spacing: Length | tuple[Length, Length] | None,
    unit: str | None,
) -> Any:
    """Return the surface of a channel in a unit of length."""
    channel = reader.channels[index]
    options: dict[str, Any] = {}
    if channel.unit is not None and unit is not None and unit != channel.unit:
        raise StoreError(f"has its unit, {channel.unit}: leave unit out")
    if channel.unit is None and unit is None:
        raise StoreError('does not state its unit: give unit="um", or another')
    if channel.unit is None:
        options["unit"] = unit
    if channel.physical_sizes is None:
        if spacing is None:
            raise StoreError("does not state the distance of its points: give spacing=2e-6, in m")
        kind, size = unit_of(str(channel.unit or unit)) or ("", 1.0)
        if kind != "length":
            raise StoreError(f"unit {channel.unit or unit!r}: must be a unit of length, such as um")
        pitch = np.broadcast_to(np.asarray(spacing, dtype=float) / size, len(channel.nb_grid_pts))
        sizes = zip(channel.nb_grid_pts, pitch, strict=True)
        options["physical_sizes"] = tuple(float(n * d) for n, d in sizes)
    return reader.topography(channel_index=index, **options)


def why_not(path: Path, error: Exception) -> str:
    """Return why a file could not be read, in one sentence."""
    if path.suffix.lower() == ".gz":
        try:
            with gzip.open(path) as file:
                file.read(1)
        except (OSError, EOFError):
            return "is no file of an instrument that SurfaceTopography reads"
    text = " ".join(str(error).split())
    if type(error).__name__ == "CannotDetectFileFormat" or not text:
        return "is no file of an instrument that SurfaceTopography reads, or is damaged"
    return f"cannot be read: {type(error).__name__}: {text[:300]}"
