"""The largest value of a field on sections, between the samples."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from pyfret import _core

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["Peak", "largest"]


class Peak(NamedTuple):
    """The largest value of a layer and where it is."""

    #: Value, in its unit.
    value: float
    #: Place [m].
    x: float
    y: float
    #: Depth [m].
    z: float
    #: Layer from the surface down; their number for the substrate.
    layer: int
    #: What the samples leave of an error of the value, estimated.
    error: float


def largest(field: xr.DataArray, layer: int) -> Peak:
    """Give the largest value in a layer of a field over (depth, x) or (depth, y).

    Of several sections, over (depth, x, y) or (depth, y, x), it is that of the section that has it;
    nothing is interpolated between sections.
    """
    here = field.isel(depth=field.layer.values == layer)
    if here.sizes["depth"] == 0 or not np.isfinite(here).any():
        raise ValueError(f"layer {layer} is not judged: it has no material or no depth")
    sections = (
        [here] if here.ndim == 2 else [here.isel({here.dims[2]: n}) for n in range(len(here[0, 0]))]
    )
    return max((_on_section(one, layer) for one in sections), key=lambda peak: peak.value)


def _on_section(field: xr.DataArray, layer: int) -> Peak:
    along = str(field.dims[1])
    depths = field.z.values.tolist()
    found = _core.largest_of_samples(
        field.values, depths, [layer] * len(depths), field[along].values.tolist()
    )
    if found is None:
        raise ValueError("the section holds no number")
    value, place, z, layer, error = found
    across = "y" if along == "x" else "x"
    at = {along: place, across: float(field[across])}
    return Peak(value, at["x"], at["y"], z, layer, error)
