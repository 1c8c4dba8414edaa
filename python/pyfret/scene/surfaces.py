"""Measured surfaces in the formats of the instruments."""

from __future__ import annotations

import gzip
import io
import warnings
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from pyfret._core import StoreError, SurfaceMap, read_bytes, unit_of
from pyfret._util.scene_warnings import warn
from pyfret.quantities import Length, quantities

if TYPE_CHECKING:
    from numpy.typing import NDArray


__all__ = ["read_surface"]

#: Endings of files of numbers alone. What they hold decides: a binary one is an instrument's.
PLAIN = frozenset((".npy", ".csv", ".txt", ".dat", ".tsv", ".asc", ".xyz", ".prn", ".grd", ""))
#: Bytes at the beginning of a file that tell text from other content.
BEGINNING = 4096


@quantities
def read_surface(
    path: str | PathLike[str],
    *,
    spacing: Length | tuple[Length, Length] | None = None,
    unit: str | None = None,
    channel: str | int | None = None,
    missing: Literal["refuse", "crop", "fill"] = "refuse",
    detrend: str = "center",
) -> SurfaceMap:
    """Read a measured surface: X3P, SDF, OPD and all other formats of SurfaceTopography, and text.

    ``.npy`` arrays and text (tables, points x y z in any order, Gwyddion's export, ESRI grids) are
    read as :meth:`SurfaceMap.from_file` reads them; `detrend` takes nothing off these.

    Parameters
    ----------
    path : path
        File of the instrument; its units are converted to metres.
    spacing : float or (float, float), optional
        Distance of the points along x and y [m], where the file does not say it.
    unit : str, optional
        Unit of plain numbers, such as "um" (default: that of the file). It holds for a list of
        points, x and y too, and for an instrument's heights and lengths without a unit.
    channel : str or int, optional
        Which of several channels of heights. In the file of an instrument: its name, or its index
        from 0. For points with several columns beside x and y: the title, or the number of the
        column from 1.
    missing : "refuse", "crop" or "fill"
        What becomes of points that were not measured. "refuse": an error with their place. "crop":
        lines are taken off the edges. "fill": the mean of the neighbours, where at most a tenth of
        the points is missing and no hole is wider than ten.
    detrend : str
        What SurfaceTopography takes off: ``center`` the mean, ``height`` the mean plane,
        ``curvature`` a paraboloid.

    Raises
    ------
    ImportError
        If the package SurfaceTopography is missing: ``pip install "fretting[surfaces]"``.
    StoreError
        If the file cannot be read, holds a profile instead of a map, or has points that were not
        measured. If it has several channels, or leaves something open. The message names the
        argument to give.
    """
    place = Path(path)
    if place.suffix.lower() in PLAIN and (not place.is_file() or is_plain(place)):
        column = None if channel is None else str(channel)
        return SurfaceMap.from_file(
            path, spacing=spacing, unit=unit, channel=column, missing=missing
        )
    try:
        from SurfaceTopography.IO import open_topography
    except ImportError as absent:
        message = (
            'reading instrument files needs SurfaceTopography: pip install "fretting[surfaces]"'
        )
        raise ImportError(message) from absent
    if not read_bytes(place):
        raise StoreError(f"{fspath(path)}: is empty")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            reader = open_topography(opened(place))
            must_be_whole(place, reader)
            chosen = chosen_channel(reader, channel)
            surface = measured(reader, chosen, spacing, unit)
            if surface.dim == 2:
                surface = surface.to_unit("m").detrend(detrend)
    except StoreError as error:
        raise StoreError(f"{fspath(path)}: {error}") from error.__cause__
    except Exception as error:
        raise StoreError(f"{fspath(path)}: {why_not(place, error)}") from error
    if surface.dim != 2:
        raise StoreError(
            f"{fspath(path)}: holds a profile of {surface.nb_grid_pts[0]} points, not a map of "
            "heights over the plane. In plane strain give its heights as an array of shape (n, 1), "
            "SurfaceMap(heights.reshape(-1, 1), spacing=(2e-6, 1.0))"
        )
    heights: NDArray[np.float64] = np.ma.filled(
        np.ma.asarray(surface.heights(), dtype=float), np.nan
    )
    x, y = surface.pixel_size
    pitch = (float(x), float(y))
    try:
        return SurfaceMap(np.ascontiguousarray(heights), spacing=pitch, missing=missing)
    except ValueError as error:
        raise StoreError(f"{fspath(path)}: {error}") from error


def opened(path: Path) -> str | io.BytesIO:
    """What SurfaceTopography opens: the file, or its text under the name that the standard has now.

    ISO 25178-71 took over the format of EUNA 15178, whose text begins with aBCR-1.0; the scales are
    in m in both.
    """
    content = read_bytes(path)
    if not content.startswith(b"aBCR-1.0"):
        return fspath(path)
    return io.BytesIO(content.replace(b"aBCR-1.0", b"aISO-1.0", 1))


def must_be_whole(path: Path, reader: Any) -> None:
    """Refuse a text that begins as ISO 25178-71 has it and that only another reader takes."""
    with path.open("rb") as file:
        start = file.read(8)
    if start[1:5] in (b"ISO-", b"BCR-") and reader.format() != "sdf":
        raise StoreError(
            f"begins as {start.decode('latin-1')}, and its head or its points are not those of "
            "ISO 25178-71 without compression"
        )


def is_plain(path: Path) -> bool:
    """Whether a file holds text or a NumPy array."""
    with path.open("rb") as file:
        start = file.read(BEGINNING)
    if start.startswith((b"\x93NUMPY", b"\xff\xfe", b"\xfe\xff")):
        return True
    # UTF-16 without a mark has a zero in every second place.
    wide = len(start) > 3 and any(not any(start[n::2]) for n in (0, 1))
    text = not any(b < 9 or 13 < b < 32 for b in start.rstrip(b"\x1a"))
    return text or wide


def chosen_channel(reader: Any, channel: str | int | None) -> int:
    """The index of a channel of heights; a warning names them all where it is not said which."""
    channels = list(reader.channels)
    names = [str(of.name) for of in channels]
    heights = [n for n, of in enumerate(channels) if is_height(of)] or list(range(len(channels)))
    listed = ", ".join(f"{n} ({names[n]!r})" for n in heights)
    if not channels:
        raise StoreError("holds no channel of heights")
    if channel is None:
        if len(heights) == 1:
            return heights[0]
        warn(
            f"the file has {len(heights)} channels: {listed}; the first is read, another by "
            f"channel={names[heights[-1]]!r}",
        )
        return heights[0]
    if isinstance(channel, str):
        found = [n for n, name in enumerate(names) if name == channel]
        if len(found) == 1:
            return found[0]
        how = "none" if not found else f"{len(found)} channels"
        raise StoreError(
            f"{how} of that name, {channel!r}: there are {listed}; an index tells them"
        )
    if not 0 <= channel < len(channels):
        raise StoreError(f"has no channel {channel}: there are {listed}")
    return channel


def is_height(channel: Any) -> bool:
    """Whether a channel holds heights; one without a kind in its file counts as such."""
    return bool(getattr(channel, "is_height_channel", True))


def measured(
    reader: Any,
    channel: int,
    spacing: Length | tuple[Length, Length] | None,
    unit: str | None,
) -> Any:
    """The surface of a channel in a unit of length."""
    of = reader.channels[channel]
    options: dict[str, Any] = {}
    if of.unit is not None and unit is not None and unit != of.unit:
        raise StoreError(f"says that its unit is {of.unit}: leave unit out")
    if of.unit is None and unit is None:
        raise StoreError('does not say its unit: give unit="um", or another')
    if of.unit is None:
        options["unit"] = unit
    if of.physical_sizes is not None and spacing is not None:
        raise StoreError("says its spacing itself: leave spacing out")
    if of.physical_sizes is None:
        if spacing is None:
            raise StoreError("does not say the distance of its points: give spacing=2e-6, in m")
        kind, size = unit_of(str(of.unit or unit)) or ("", 1.0)
        if kind != "length":
            raise StoreError(f"unit {of.unit or unit!r}: must be a unit of length, such as um")
        pitch = np.broadcast_to(np.asarray(spacing, dtype=float) / size, len(of.nb_grid_pts))
        sizes = zip(of.nb_grid_pts, pitch, strict=True)
        options["physical_sizes"] = tuple(float(n * d) for n, d in sizes)
    return reader.topography(channel_index=channel, **options)


def why_not(path: Path, error: Exception) -> str:
    """Why a file could not be read, in one sentence."""
    if path.suffix.lower() == ".gz":
        try:
            with gzip.open(path) as file:
                file.read(1)
        except (OSError, EOFError):
            return "is no file of an instrument that SurfaceTopography reads"
    said = " ".join(str(error).split())
    if type(error).__name__ == "CannotDetectFileFormat" or not said:
        size = path.stat().st_size
        return (
            "is empty"
            if size == 0
            else "is no file of an instrument that SurfaceTopography reads, or is damaged"
        )
    return f"cannot be read: {type(error).__name__}: {said[:300]}"
