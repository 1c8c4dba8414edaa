"""What holds a dataset with units and meanings."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["Labelled"]


class Labelled:
    """Something that a dataset holds; equal where names, values and attributes are."""

    def __init__(self, dataset: xr.Dataset) -> None:
        self._dataset = dataset

    @property
    def dataset(self) -> xr.Dataset:
        """Variables with units and meaning."""
        return self._dataset

    def __eq__(self, other: object) -> bool:
        """Whether the other one is of the same class with an identical dataset."""
        if type(other) is not type(self):
            return NotImplemented
        return self.dataset.identical(other.dataset)
