"""A dataset that is written as a table, too."""

from __future__ import annotations

from typing import TYPE_CHECKING

import xarray as xr

from pyfret._util.csv_table import check_path, choose_columns, data_frame, write_excel

if TYPE_CHECKING:
    import os
    from collections.abc import Hashable, Sequence

    import pandas as pd

__all__ = ["Table"]


class Table(xr.Dataset):  # type: ignore[no-untyped-call]
    """A dataset of rows, with ``to_csv`` and ``to_excel`` as pandas has them."""

    __slots__ = ()

    def to_dataframe(self, dim_order: Sequence[Hashable] | None = None) -> pd.DataFrame:
        """Return a table of pandas: a row for every point, units in the names of the columns.

        Parameters
        ----------
        dim_order : sequence, optional
            The axes of the rows, as xarray has it (default: those of the first variable).
        """
        return data_frame(self, None if dim_order is None else [str(dim) for dim in dim_order])

    def to_csv(self, path: str | os.PathLike[str], *, columns: Sequence[str] | None = None) -> None:
        """Write :meth:`to_dataframe` as a table of text (``.csv``).

        A file that is there is replaced.

        Parameters
        ----------
        path : path
            The file.
        columns : sequence of str, optional
            Columns in this order, with or without their units (default: all).
        """
        check_path(path)
        frame = choose_columns(self.to_dataframe(), columns)
        frame.to_csv(path, index=False, lineterminator="\n", encoding="utf-8")

    def to_excel(
        self, path: str | os.PathLike[str], *, columns: Sequence[str] | None = None
    ) -> None:
        """Write :meth:`to_dataframe` as a sheet of Excel (``.xlsx``).

        A file that is there is replaced. It needs openpyxl: ``pip install "fretting[rigs]"``.

        Parameters
        ----------
        path : path
            The file.
        columns : sequence of str, optional
            Columns in this order, with or without their units (default: all).
        """
        check_path(path)
        write_excel({"values": choose_columns(self.to_dataframe(), columns)}, path)
