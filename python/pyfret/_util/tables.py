"""Datasets that are written as tables, too; their class is imported at the first use."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray as xr

    from pyfret._util.labelled_table import Table

__all__ = ["as_table"]


def as_table(dataset: xr.Dataset) -> Table:
    """Return a dataset with ``to_csv`` and ``to_excel``."""
    from pyfret._util.labelled_table import Table

    # Variables have no coordinates of their own, which a dataset would align one by one.
    variables = {name: dataset.variables[name] for name in dataset.data_vars}
    return Table(variables, dataset.coords, dataset.attrs)
