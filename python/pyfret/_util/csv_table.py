"""A dataset as a table for other programs: one row for every point, units in the head."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from pyfret import _core

if TYPE_CHECKING:
    import os
    from collections.abc import Sequence

    import xarray as xr

__all__ = ["head", "unit_of", "write_csv"]

#: The dimension whose entries become columns.
AXIS = "axis"


def unit_of(name: str, of: xr.DataArray) -> str:
    """The unit of a variable: its own, or that of the key that it is named after; "" of numbers."""
    measured = _core.measured_by(name)
    unit = str(of.attrs.get("units", "1" if measured is None else measured[1]))
    return "" if unit == "1" else unit


def head(name: str, of: xr.DataArray) -> str:
    """Name and unit of a column: ``T_x [N]``; a pure number has no unit."""
    unit = unit_of(name, of)
    return f"{name} [{unit}]" if unit else name


def write_csv(
    dataset: xr.Dataset, path: str | os.PathLike[str], rows: Sequence[str] | None = None
) -> None:
    """Write the variables over some axes, each with its unit, and the coordinates of the points.

    Parameters
    ----------
    dataset : xarray.Dataset
        Variables with units.
    path : path
        Where to write; a file that is there is replaced.
    rows : sequence of str, optional
        The axes of the table (default: those of the first variable).
    """
    first = next(iter(dataset.data_vars.values()))
    over = [str(d) for d in (first.dims if rows is None else rows) if d != AXIS]
    shape = [dataset.sizes[d] for d in over]
    columns = {}
    for name, of in [*dataset.coords.items(), *dataset.data_vars.items()]:
        # A number of the whole is no column, but the place of a section is.
        if name in dataset.data_vars and not of.dims:
            continue
        if not set(of.dims) <= {*over, AXIS} or of.dims == (AXIS,):
            continue
        parts = {f"{name}": of}
        if AXIS in of.dims:
            parts = {f"{name}_{at}": of.sel({AXIS: at}, drop=True) for at in of[AXIS].values}
        for part, values in parts.items():
            absent = [d for d in over if d not in values.dims]
            whole = values.expand_dims(absent).transpose(*over).values
            sizes = [dataset.sizes[d] if d in values.dims else 1 for d in over]
            columns[head(part, values)] = np.broadcast_to(whole.reshape(sizes), shape).ravel()
    with Path(path).open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(zip(*columns.values(), strict=True))
