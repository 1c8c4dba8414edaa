"""Measured surfaces in the formats of the instruments."""

from __future__ import annotations

from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np

from pyfret._core import SurfaceMap

if TYPE_CHECKING:
    from numpy.typing import NDArray

#: Files of numbers alone, whose spacing has to be said.
PLAIN = frozenset((".npy", ".csv", ".txt", ".dat", ".tsv", ".asc"))


def read_surface(
    path: str | PathLike[str],
    *,
    spacing: float | tuple[float, float] | None = None,
    missing: Literal["refuse", "crop", "fill"] = "refuse",
    detrend: str = "center",
) -> SurfaceMap:
    """Read a measured surface: X3P, SDF, OPD and all other formats of SurfaceTopography.

    With `spacing` also plain numbers: ``.npy`` arrays and tables of text, as
    :meth:`SurfaceMap.from_file` reads them, of which `detrend` takes nothing off.

    Parameters
    ----------
    path : path
        File of the instrument; its units are converted to metres.
    spacing : float or (float, float), optional
        Distance of the points of plain numbers, along x and y [m].
    missing : "refuse", "crop" or "fill"
        What becomes of points that were not measured: an error that says where they are; lines
        taken off the edges; the mean of the neighbours.
    detrend : str
        What SurfaceTopography takes off: ``center`` the mean, ``height`` the mean plane,
        ``curvature`` a paraboloid.

    Raises
    ------
    ImportError
        If the package SurfaceTopography is missing: ``pip install "fretting[surfaces]"``.
    StoreError
        If the file has points that were not measured, or cannot be read.
    ValueError
        If plain numbers have no spacing, or a file that says its own is given another.
    """
    if Path(path).suffix.lower() in PLAIN:
        if spacing is None:
            raise ValueError(f"{path}: plain numbers need the distance of the points, spacing=2e-6")
        return SurfaceMap.from_file(path, spacing=spacing, missing=missing)
    if spacing is not None:
        raise ValueError(f"{path}: the file of an instrument says its spacing itself")
    try:
        from SurfaceTopography import read_topography
    except ImportError as absent:
        message = (
            'reading instrument files needs SurfaceTopography: pip install "fretting[surfaces]"'
        )
        raise ImportError(message) from absent
    surface = read_topography(fspath(path)).to_unit("m").detrend(detrend)
    heights: NDArray[np.float64] = np.ma.filled(
        np.ma.asarray(surface.heights(), dtype=float), np.nan
    )
    x, y = surface.pixel_size
    pitch = (float(x), float(y))
    return SurfaceMap(np.ascontiguousarray(heights), spacing=pitch, missing=missing)
