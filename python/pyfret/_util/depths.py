"""Depths of layers, and an axis on which thin ones can be seen."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

__all__ = ["interfaces", "stretched", "thin"]

#: Part of the axis that a layer gets at least where the axis is stretched.
LEAST = 0.16
#: Part of the depth shown below which a layer cannot be seen.
INVISIBLE = 0.06


def interfaces(z: xr.DataArray, layer: xr.DataArray) -> list[float]:
    """Return the depths at which the layer changes [m]."""
    changes = np.flatnonzero(np.diff(layer.values))
    # Depths that are given on both sides of an interface change there more than once.
    return list(dict.fromkeys(float(z[n] + z[n + 1]) / 2 for n in changes))


def stretched(borders: NDArray[np.float64]) -> NDArray[np.float64]:
    """Place the borders of layers on an axis from 0 to 1 so that every layer has enough room."""
    shares = np.diff(borders) / (borders[-1] - borders[0])
    least = min(LEAST, 0.8 / shares.size)
    thin = shares < least
    remainder = 1.0 - least * np.count_nonzero(thin)
    shares = np.where(thin, least, remainder * shares / max(shares[~thin].sum(), 1e-300))
    return np.concatenate(([0.0], np.cumsum(shares)))


def thin(borders: NDArray[np.float64]) -> bool:
    """Whether a layer is too thin to be seen on an even axis."""
    steps = np.diff(borders)
    return steps.size > 1 and bool(steps.min() < INVISIBLE * (borders[-1] - borders[0]))
