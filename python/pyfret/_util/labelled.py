"""What holds a dataset with units and meanings."""

from __future__ import annotations

from typing import Any, ClassVar

from pyfret._util.attributes import (
    dataset_attribute,
    dataset_item,
    dataset_names,
    missing_attribute,
)
from pyfret._util.csv_table import Tabular
from pyfret._util.lazy import xr
from pyfret._util.parameter import MADE

__all__ = ["Labelled"]


class Labelled(Tabular):
    """Something that a dataset holds; equal where names, values and attributes are.

    Variables of the dataset are attributes of it, and so are the attributes of the dataset.
    """

    #: Clause of the refusal of an item that is no name.
    _item_hint: ClassVar[str] = ""

    def __init__(self, dataset: xr.Dataset) -> None:
        if not isinstance(dataset, xr.Dataset):
            name = type(self).__name__
            made = MADE.get(name, "returned by a function")
            raise TypeError(f"dataset: a {name} is {made}; fret.open(path) opens a saved one")
        self._dataset = dataset

    @property
    def dataset(self) -> xr.Dataset:
        """Variables with units and meaning."""
        return self._dataset

    def __getattr__(self, name: str) -> Any:
        """Give a variable or an attribute of the dataset."""
        if not name.startswith("_") and name not in dataset_names(self.dataset):
            where = self._elsewhere(name)
            if name in where:
                missing_attribute(self, name, where)
        return dataset_attribute(self, name)

    def _elsewhere(self, name: str) -> dict[str, str]:
        """Return where a name is found that this object does not have."""
        return {}

    def __getitem__(self, name: str) -> Any:
        """Give a variable of the dataset, or another array of the object, by its name."""
        return dataset_item(self, name, self._item_hint)

    #: Its names are no sequence.
    __iter__ = None

    def __dir__(self) -> list[str]:
        """The names of the class, and of the dataset."""
        return sorted({*object.__dir__(self), *dataset_names(self.dataset)})

    def __eq__(self, other: object) -> bool:
        """Whether the other one is of the same class with an identical dataset."""
        if type(other) is not type(self):
            return NotImplemented
        return self.dataset.identical(other.dataset)
