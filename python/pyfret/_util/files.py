"""Results in files: Zarr stores and NetCDF."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pyfret._util.lazy import xr

if TYPE_CHECKING:
    import os

__all__ = ["read", "write"]

#: What marks an attribute as JSON, where a file has no room for what it is.
JSON = "json:"


def flat(value: object) -> object:
    """An attribute that NetCDF has room for: numbers and text as they are, the rest as JSON."""
    return value if isinstance(value, (str, int, float)) else JSON + json.dumps(value)


def unfolded(value: Any) -> Any:
    """The attribute that :func:`flat` was given."""
    text = isinstance(value, str) and value.startswith(JSON)
    return json.loads(value[len(JSON) :]) if text else value


def write(dataset: xr.Dataset, path: str | os.PathLike[str]) -> None:
    """Write a dataset to a Zarr folder (``.zarr``) or a NetCDF file (``.nc``)."""
    place = Path(path)
    if place.exists():
        raise FileExistsError(f"{place}: is there already")
    if place.suffix == ".zarr":
        dataset.to_zarr(place, zarr_format=2, consolidated=True)
    elif place.suffix == ".nc":
        attrs = {k: flat(v) for k, v in dataset.attrs.items()}
        dataset.assign_attrs(attrs).to_netcdf(place)
    else:
        raise ValueError(f"{place}: must end in .zarr or .nc")


def read(path: str | os.PathLike[str]) -> xr.Dataset:
    """The dataset of a Zarr store or of a NetCDF file (``.nc``) that :func:`write` wrote."""
    if Path(path).suffix == ".nc":
        dataset = xr.open_dataset(path)
        dataset = dataset.assign_attrs({k: unfolded(v) for k, v in dataset.attrs.items()})
    else:
        dataset = xr.open_zarr(path, chunks=None)
    for variable in dataset.variables.values():
        # How it lies in this file is of no use to the next one, and its codecs would not do there.
        variable.encoding.clear()
    return dataset


def is_copy(path: str | os.PathLike[str]) -> bool:
    """Whether a Zarr folder is one that :meth:`pyfret.Result.save` wrote, which has no checksums.

    Those of schema 1 are stores: they had none either, and are refused as such.
    """
    try:
        consolidated = json.loads((Path(path) / ".zmetadata").read_bytes())
        schema = consolidated["metadata"][".zattrs"]["schema"]
    except (OSError, ValueError, LookupError, TypeError):
        return False
    sums = {"checksums", "crc32"} & set(consolidated)
    return not sums and isinstance(schema, int) and schema > 1
