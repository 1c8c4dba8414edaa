"""Measured surfaces in the formats of the instruments."""

from __future__ import annotations

from os import PathLike, fspath

import numpy as np

from pyfret._core import SurfaceMap


def read_surface(path: str | PathLike[str], *, detrend: str = "center") -> SurfaceMap:
    """Read a measured surface: X3P, SDF, OPD and all other formats of SurfaceTopography.

    Parameters
    ----------
    path : path
        File of the instrument; its units are converted to metres.
    detrend : str
        What SurfaceTopography takes off: ``center`` the mean, ``height`` the mean plane,
        ``curvature`` a paraboloid.

    Raises
    ------
    ImportError
        If the package SurfaceTopography is missing: ``pip install "pyfret[surfaces]"``.
    ValueError
        If the file has points that were not measured.
    """
    try:
        from SurfaceTopography import read_topography
    except ImportError as missing:
        message = 'reading instrument files needs SurfaceTopography: pip install "pyfret[surfaces]"'
        raise ImportError(message) from missing
    surface = read_topography(fspath(path)).to_unit("m").detrend(detrend)
    heights = surface.heights()
    if np.ma.is_masked(heights):
        holes = int(np.ma.getmaskarray(heights).sum())
        message = f"{path}: {holes} points were not measured; fill them first"
        raise ValueError(message)
    x, y = surface.pixel_size
    return SurfaceMap(np.ascontiguousarray(heights, dtype=float), spacing=(float(x), float(y)))
