"""A fit from a file."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from pyfret._core import StoreError
from pyfret._util.packed import unpacked
from pyfret.fit.data import Indentation, Lives, Loops, Measured, Scar
from pyfret.fit.outcome import FitResult, Known, Posterior

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["fit_from_dataset"]

#: What a file may hold; nothing else is made of it.
PARTS: dict[str, type] = {
    part.__name__: part
    for part in (FitResult, Known, Posterior, Measured, Loops, Indentation, Scar, Lives)
}


def fit_from_dataset(dataset: xr.Dataset) -> FitResult:
    """Rebuild a fit from its dataset.

    Raises
    ------
    StoreError
        The dataset holds no fit.
    """
    try:
        made = unpacked(json.loads(dataset.attrs["found"]), dataset.load(), PARTS)
    except (LookupError, TypeError, ValueError, AttributeError) as error:
        raise StoreError(f"is no fit: {' '.join(str(error).split())}") from error
    if not isinstance(made, FitResult):
        raise StoreError("is no fit")
    return made
