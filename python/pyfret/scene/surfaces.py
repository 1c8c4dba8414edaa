"""Measured surfaces in the formats of the instruments."""

from __future__ import annotations

import re
import sys
import warnings
from os import PathLike, fspath
from pathlib import Path
from typing import Any, Literal, TypeAlias

import numpy as np

from pyfret._core import StoreError, SurfaceMap, check_sides, map_from_heights, read_bytes, shown
from pyfret._util.scene_warnings import warn
from pyfret.quantities import Length, quantities
from pyfret.scene.instruments import read_by_surface_topography
from pyfret.scene.reading import Reading, check_heights, check_range, summarize
from pyfret.scene.standard_maps import (
    HAS_LIBRARIES,
    is_sdf,
    is_x3p,
    must_be_first_revision,
    read_sdf,
    read_x3p,
)

__all__ = ["read_surface"]

#: Note on the direction of the lines of a matrix.
ALONG_X = (
    "rows are taken along x, columns along y: values[x, y]. If each row of the file is a line of "
    "constant y, use SurfaceMap(surface.values.T, spacing=(d_x, d_y))"
)
#: Forms that are subtracted, and their names in SurfaceTopography.
TRENDS = {"center": "center", "plane": "height", "paraboloid": "curvature"}
Trend: TypeAlias = Literal["center", "plane", "paraboloid"]
#: Endings of files of numbers alone. What they hold decides: a binary one is an instrument's.
PLAIN = frozenset((".npy", ".csv", ".txt", ".dat", ".tsv", ".asc", ".xyz", ".prn", ".grd", ""))
#: Bytes at the beginning of a file by which its format is recognized.
BEGINNING = 4096
#: Heads of the texts of instruments, whose lines run along x: SPIP and Nova, Wyko, WSxM, Attocube.
HEADS = re.compile(
    rb"^[#;\s]*(?:File Format\s*=\s*ASCII|Wyko ASCII Data File Format|WSxM file copyright"
    rb"|x-pixels\b|x-length\b|NX\s*=\s*\d|pixel size\s*=)",
    re.MULTILINE | re.IGNORECASE,
)
#: Lines of a head that state sizes, in words of other programs.
SIZES = re.compile(
    rb"^[#;%\s\"]*(?=[A-Za-z])[\w ./()-]*?"
    rb"(?:pixel|resolution|scan.?size|[xy].?size|calibration|pitch"
    rb"|spacing|increment|step)[\w ./()-]*\"?\s*[:=,;\t]+\s*\"?[-+\d.]+.*$",
    re.MULTILINE | re.IGNORECASE,
)


@quantities
def read_surface(
    path: str | PathLike[str],
    *,
    spacing: Length | tuple[Length, Length] | None = None,
    unit: str | None = None,
    channel: str | int | None = None,
    missing: Literal["refuse", "crop", "fill"] = "refuse",
    detrend: Trend | bool | None = None,
) -> SurfaceMap:
    """Read a measured surface: X3P, SDF, OPD and all other formats of SurfaceTopography, and text.

    ``.npy`` arrays and text (tables, points x y z in any order, Gwyddion's export, ESRI grids) are
    read as :meth:`SurfaceMap.from_file` reads them. The content of the file decides, not its
    ending. Points, pitch, size and S_q are printed on standard error.

    Parameters
    ----------
    path : path
        File of the instrument; its units are converted to metres.
    spacing : float or (float, float), optional
        Distance of the points along x and y [m], where the file does not state it, or states one
        that no instrument has.
    unit : str, optional
        Unit of plain numbers, such as "um" (default: the file's own). It holds for a list of
        points, x and y too, and for an instrument's heights and lengths without a unit.
    channel : str or int, optional
        Which of several channels of heights. In the file of an instrument: its name, or its index
        from 0. For points with several columns beside x and y: the title, or the number of the
        column from 1.
    missing : "refuse", "crop" or "fill"
        What becomes of points that were not measured. "refuse": an error with their place. "crop":
        lines are taken off the edges. "fill": the mean of the neighbours, where at most a tenth of
        the points is missing and no hole is wider than ten.
    detrend : "center", "plane", "paraboloid" or bool, optional
        Form that is subtracted: the mean, the mean plane, a paraboloid. True is the plane.
        Default: the mean of the file of an instrument, nothing of arrays and text.

    Warns
    -----
    SceneWarning
        If something was assumed or chosen: the first of several channels, a unit or a direction
        that the file does not state.

    Raises
    ------
    ImportError
        If the package SurfaceTopography is missing: ``pip install "fretting[surfaces]"``.
    StoreError
        If a side of the map is shorter than 0.1 um or longer than 0.5 m: its unit is another one.
        If the file cannot be read, holds a profile instead of a map, or has points that were not
        measured. If it has several channels, or leaves something open. The message names the
        argument to give.
    """
    if isinstance(detrend, bool):
        detrend = "plane" if detrend else None
    if detrend is not None and detrend not in list(TRENDS):
        raise ValueError(
            f"detrend = {detrend!r:.60}: must be one of {', '.join(map(repr, TRENDS))}"
        )
    start = beginning(path)
    source = Path(path)
    try:
        if is_text(source, start) and not is_sdf(start) and not HEADS.search(start):
            return read_plain(source, start, spacing, unit, channel, missing, detrend)
        if not start:
            raise StoreError("is empty")
        trend = "center" if detrend is None else TRENDS[detrend]
        reading = read_map(source, start, spacing, unit, channel, trend)
        check_sides(reading.heights.shape, reading.spacing)
    except StoreError as error:
        text = str(error)
        message = text if text.startswith(fspath(path)) else f"{fspath(path)}: {text}"
        raise StoreError(message) from error.__cause__
    for note in reading.notes:
        warn(f"{fspath(path)}: {note}")
    try:
        surface, rms = map_from_heights(reading.heights, spacing=reading.spacing, missing=missing)
        check_range(rms)
    except (StoreError, ValueError) as error:
        raise StoreError(f"{fspath(path)}: {error}") from error
    # The values of a surface are copied when they are asked for: 134 MB of 4096 x 4096 points.
    shape = surface.values.shape if missing == "crop" else reading.heights.shape
    summarize(path, shape, reading.spacing, rms, reading.kind)
    return surface


def read_map(
    path: Path,
    start: bytes,
    spacing: Any,
    unit: str | None,
    channel: str | int | None,
    detrend: str,
) -> Reading:
    """Read the map of an instrument by the library of its format."""
    is_standard = is_x3p(path, start) or is_sdf(start)
    if is_standard and not HAS_LIBRARIES:
        must_be_first_revision(path, start)
    if not is_standard or not HAS_LIBRARIES:
        return read_by_surface_topography(path, spacing, unit, channel, detrend)
    read = read_sdf if is_sdf(start) else read_x3p
    reading = read(path, unit, spacing, channel)
    # The mean is subtracted as the map is built.
    if detrend != "center":
        subtract_trend(reading, detrend)
    return reading


def subtract_trend(reading: Reading, detrend: str) -> None:
    """Subtract a plane or a paraboloid, as SurfaceTopography names it."""
    from SurfaceTopography import Topography

    sizes = tuple(n * d for n, d in zip(reading.heights.shape, reading.spacing, strict=True))
    surface = Topography(np.ma.masked_invalid(reading.heights), sizes, unit="m")
    heights: Any = np.ma.asarray(surface.detrend(detrend).heights(), dtype=float)
    reading.heights = heights.filled(np.nan)


def read_plain(
    path: Path,
    start: bytes,
    spacing: Any,
    unit: str | None,
    channel: str | int | None,
    missing: Literal["refuse", "crop", "fill"],
    detrend: Trend | None,
) -> SurfaceMap:
    """Read an array or text without the head of an instrument."""
    column = None if channel is None else str(channel)
    surface = SurfaceMap.from_file(
        path, spacing=spacing, unit=unit, channel=column, missing=missing
    )
    shape = surface.values.shape
    if unit is None:
        try:
            check_heights(surface.peak_to_valley, shape, surface.spacing)
        except StoreError:
            if not states_unit(path, spacing, column):
                raise
    if detrend == "center":
        surface = surface.replace(values=surface.values - surface.values.mean())
    elif detrend is not None:
        surface = surface.level(detrend)
    line = SIZES.search(start)
    if line is not None and spacing is not None:
        text = " ".join(line[0].decode("latin-1").split())
        warn(f"{path}: a line of the head is not read: {text[:100]!r}. Check spacing= against it")
    kind = "numbers" if path.suffix.lower() == ".npy" else "text"
    # A matrix alone needs the pitch: a head and a list of points have it.
    is_matrix = spacing is not None
    kind = f"{kind}, heights taken in m" if unit is None and is_matrix else kind
    summarize(path, shape, surface.spacing, surface.rms, kind)
    if is_matrix:
        print(shown(f"{path}: {ALONG_X}"), file=sys.stderr)
    return surface


def states_unit(path: Path, spacing: Any, column: str | None) -> bool:
    """Check that a file states its unit: it refuses another one."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for unit in ("um", "nm"):
            try:
                SurfaceMap.from_file(
                    path, spacing=spacing, unit=unit, channel=column, missing="fill"
                )
            except StoreError:
                return True
    return False


def beginning(path: str | PathLike[str]) -> bytes:
    """Return the first bytes of a file; a StoreError for a folder or a device."""
    source = Path(path)
    if not source.is_file():
        # The reason by the reader that refuses pipes and devices.
        return read_bytes(source)[:BEGINNING]
    with source.open("rb") as file:
        return file.read(BEGINNING)


def is_text(path: Path, start: bytes) -> bool:
    """Check that a file of an ending of plain numbers holds text or a NumPy array."""
    if path.suffix.lower() not in PLAIN:
        return False
    if start.startswith((b"\x93NUMPY", b"\xff\xfe", b"\xfe\xff")):
        return True
    # UTF-16 without a mark has a zero in every second place.
    wide = len(start) > 3 and any(not any(start[n::2]) for n in (0, 1))
    text = not any(b < 9 or 13 < b < 32 for b in start.rstrip(b"\x1a"))
    return text or wide
