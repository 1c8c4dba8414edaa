"""A dataset that is written as a table, too."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import xarray as xr
from xarray.plot.accessor import DatasetPlotAccessor

from pyfret._util.attributes import attribute_error
from pyfret._util.csv_table import (
    check_path,
    choose_columns,
    convert_units,
    data_frame,
    write_excel,
)
from pyfret._util.keywords import nearest_names
from pyfret._util.window import format_table, wrap

if TYPE_CHECKING:
    import os
    from collections.abc import Hashable, Mapping, Sequence

    import pandas as pd

__all__ = ["Table"]


#: Most rows of a summary; of more the first and the last ones are printed.
ROWS = 12
#: Most columns of a summary.
COLUMNS = 16


class TableFigures(DatasetPlotAccessor):
    """The figures of a table, as xarray has them; called itself, a column over the rows."""

    def __call__(self, column: str | None = None, **options: Any) -> Any:
        """Draw a column over the rows (default: the dissipated energy, else the first column).

        `options` are the options of :meth:`xarray.DataArray.plot.line`.
        """
        table = self._ds
        names = [str(name) for name, v in table.data_vars.items() if v.ndim == 1]
        name = column or next((n for n in names if n == "dissipated"), names[0])
        if name not in names:
            near = ", ".join(nearest_names(name, names, 3) or names)
            raise ValueError(f"column = {name!r:.60}: there is {near}")
        lines = table[name].plot.line(**{"marker": "o", **options})
        return lines[0].axes


class Table(xr.Dataset):  # type: ignore[no-untyped-call]
    """A dataset of rows, with ``to_csv`` and ``to_excel`` as pandas has them."""

    __slots__ = ()

    @property
    def plot(self) -> TableFigures:  # type: ignore[override]
        """Its figures: ``plot("T")`` draws a column over the rows."""
        return TableFigures(self)

    def summary(self) -> str:
        """Give the rows as a text, units in the heads.

        Of more than 12 rows it has the first and the last ones. Columns of zeros are left out.
        """
        frame = self.to_dataframe()
        full = frame.loc[:, (frame.fillna(0.0) != 0.0).any()]
        frame = full.iloc[:, :COLUMNS]
        rows = [[f"{value:.6g}" for value in row] for row in frame.to_numpy(dtype=float)]
        if len(rows) > ROWS:
            rows = [*rows[: ROWS // 2], ["..."] * frame.shape[1], *rows[-ROWS // 2 :]]
        text = format_table([str(name).replace(" [", "\n[") for name in frame.columns], rows)
        omitted = full.shape[1] - frame.shape[1]
        return wrap(f"{text}\n{omitted} more columns: to_dataframe()" if omitted else text)

    def __getitem__(self, key: Any) -> Any:
        """Return a column by its name, the row of a number, or what xarray selects by a key.

        Raises
        ------
        KeyError
            There is no such column; the message has the nearest ones.
        """
        if isinstance(key, int) and not isinstance(key, bool) and len(self.sizes) == 1:
            return self.isel({next(iter(self.sizes)): key})
        if isinstance(key, str) and key not in self.variables:
            names = [str(variable) for variable in self.variables]
            raise KeyError(str(attribute_error("table", key, names, {})))
        return super().__getitem__(key)

    def __getattr__(self, name: str) -> Any:
        """Refuse a name that is no variable, with the nearest one."""
        try:
            return super().__getattr__(name)
        except AttributeError:
            if name.startswith("_"):
                raise
        names = [str(variable) for variable in self.variables]
        members = ("summary", "plot", "to_csv", "to_excel", "to_dataframe")
        raise attribute_error("table", name, [*names, *members], {})

    def to_dataframe(
        self,
        dim_order: Sequence[Hashable] | None = None,
        *,
        columns: Sequence[str] | None = None,
        units: Mapping[str, str] | None = None,
    ) -> pd.DataFrame:
        """Return a table of pandas: a row for every point, units in the names of the columns.

        A column is found by its name without the unit as well: ``frame["T"]``.

        Parameters
        ----------
        dim_order : sequence, optional
            The axes of the rows, as xarray has it (default: those of the first variable).
        columns : sequence of str, optional
            Columns in this order, with or without their units (default: all).
        units : dict, optional
            Units of some columns in place of SI units, such as ``{"dissipated": "uJ"}``.
        """
        axes = None if dim_order is None else [str(dim) for dim in dim_order]
        return convert_units(choose_columns(data_frame(self, axes), columns), units)

    def to_csv(
        self,
        path: str | os.PathLike[str],
        *,
        columns: Sequence[str] | None = None,
        units: Mapping[str, str] | None = None,
    ) -> None:
        """Write :meth:`to_dataframe` as a table of text (``.csv``).

        A file that is there is replaced.

        Parameters
        ----------
        path : path
            The file.
        columns : sequence of str, optional
            Columns in this order, with or without their units (default: all).
        units : dict, optional
            Units of columns, as in :meth:`to_dataframe`.
        """
        check_path(path)
        frame = convert_units(choose_columns(self.to_dataframe(), columns), units)
        frame.to_csv(path, index=False, lineterminator="\n", encoding="utf-8")

    def to_excel(
        self,
        path: str | os.PathLike[str],
        *,
        columns: Sequence[str] | None = None,
        units: Mapping[str, str] | None = None,
    ) -> None:
        """Write :meth:`to_dataframe` as a sheet of Excel (``.xlsx``).

        A file that is there is replaced. It needs openpyxl: ``pip install "fretting[rigs]"``.

        Parameters
        ----------
        path : path
            The file.
        columns : sequence of str, optional
            Columns in this order, with or without their units (default: all).
        units : dict, optional
            Units of columns, as in :meth:`to_dataframe`.
        """
        check_path(path)
        frame = convert_units(choose_columns(self.to_dataframe(), columns), units)
        write_excel({"values": frame}, path)
