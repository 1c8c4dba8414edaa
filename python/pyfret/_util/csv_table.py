"""A dataset as a table for other programs: one row for every point, units in the head."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret import _core
from pyfret._util.keywords import nearest_names
from pyfret._util.refusals import refuse_keywords
from pyfret._util.spelling import factor_between

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import TypeAlias

    import pandas as pd
    import xarray as xr

    #: What makes the datasets of the tables and the axes of their rows, by the names of the tables.
    Tables: TypeAlias = dict[str, Callable[[], tuple[xr.Dataset, Sequence[str] | None]]]

__all__ = [
    "Tabular",
    "check_path",
    "choose_columns",
    "convert_units",
    "data_frame",
    "head",
    "unit_of",
    "write_csv",
    "write_excel",
]

#: Attribute of a table with the heads of the columns that distinguish its rows.
PLACES = "places"
#: The dimension whose entries become columns.
AXIS = "axis"
#: Rows of a sheet of Excel, its head included, and characters of its name.
ROWS_OF_SHEET, NAME_OF_SHEET = 1_048_576, 31


def unit_of(name: str, of: xr.DataArray) -> str:
    """The unit of a variable, or of the key that it is named after; "" of numbers."""
    measured = _core.measured_by(name)
    unit = str(of.attrs.get("units", "1" if measured is None else measured[1]))
    return "" if unit == "1" else unit


def head(name: str, of: xr.DataArray) -> str:
    """Name and unit of a column: ``T_x [N]``; a pure number has no unit."""
    unit = unit_of(name, of)
    return f"{name} [{unit}]" if unit else name


def row_axes(dataset: xr.Dataset, rows: Sequence[str] | None) -> list[str]:
    """Return the axes of a table, for None the axes of the first variable that has some."""
    if rows is None:
        rows = next((v.dims for v in dataset.data_vars.values() if v.dims), ())  # type: ignore[assignment]
    return [str(dim) for dim in rows or () if dim != AXIS]


def columns_of(dataset: xr.Dataset, rows: Sequence[str] | None = None) -> dict[str, Any]:
    """Return the columns of a table by their heads.

    Parameters
    ----------
    dataset : xarray.Dataset
        Variables with units.
    rows : sequence of str, optional
        The axes of the table (default: the axes of the first variable that has some).
    """
    over = row_axes(dataset, rows)
    shape = [dataset.sizes[d] for d in over]
    columns = {}
    for name, variable in [*dataset.coords.items(), *dataset.data_vars.items()]:
        # A number of the whole is no column, but the place of a section is.
        if name in dataset.data_vars and not variable.dims:
            continue
        if not set(variable.dims) <= {*over, AXIS} or variable.dims == (AXIS,):
            continue
        parts = {f"{name}": variable}
        if AXIS in variable.dims:
            parts = {
                f"{name}_{at}": variable.sel({AXIS: at}, drop=True) for at in variable[AXIS].values
            }
        for part, values in parts.items():
            absent = [d for d in over if d not in values.dims]
            whole = values.expand_dims(absent).transpose(*over).values
            sizes = [dataset.sizes[d] if d in values.dims else 1 for d in over]
            columns[head(part, values)] = np.broadcast_to(whole.reshape(sizes), shape).ravel()
    return columns


def data_frame(dataset: xr.Dataset, rows: Sequence[str] | None = None) -> pd.DataFrame:
    """Return the variables over some axes as a table of pandas, units in the names of columns."""
    from pyfret._util.frame import Frame

    frame = Frame(columns_of(dataset, rows))
    axes = row_axes(dataset, rows)
    if len(axes) > 1:
        coordinates = [(str(k), v) for k, v in dataset.coords.items() if {*v.dims} & {*axes}]
        heads = [head(name, values) for name, values in coordinates]
        frame.attrs[PLACES] = [column for column in heads if column in frame.columns]
    return frame


def write_csv(
    dataset: xr.Dataset, path: str | os.PathLike[str], rows: Sequence[str] | None = None
) -> None:
    """Write the variables over some axes, each with its unit, and the coordinates of the points.

    A file that is there is replaced.
    """
    data_frame(dataset, rows).to_csv(path, index=False, lineterminator="\n", encoding="utf-8")


def write_excel(frames: Mapping[str, pd.DataFrame], path: str | os.PathLike[str]) -> None:
    """Write tables into a workbook of Excel, a sheet for each.

    Raises
    ------
    ImportError
        The package openpyxl is missing.
    ValueError
        The file does not end in ``.xlsx``, or a table has more rows than a sheet.
    """
    if Path(os.fspath(path)).suffix.lower() != ".xlsx":
        raise ValueError(f"{os.fspath(path)}: must end in .xlsx")
    for name, frame in frames.items():
        if len(frame) >= ROWS_OF_SHEET:
            raise ValueError(
                f"the table {name} has {len(frame)} rows, and a sheet of Excel at most "
                f"{ROWS_OF_SHEET - 1}: write it with to_csv"
            )
    try:
        import openpyxl  # type: ignore[import-untyped]  # noqa: F401
    except ModuleNotFoundError as absent:
        message = 'Excel needs openpyxl: pip install "fretting[rigs]"'
        raise ModuleNotFoundError(message, name="openpyxl") from absent
    import pandas as pd

    with pd.ExcelWriter(path, engine="openpyxl") as book:
        for name, frame in frames.items():
            frame.to_excel(book, sheet_name=name[:NAME_OF_SHEET], index=False)


def check_path(path: Any) -> None:
    """Refuse what is no path.

    Raises
    ------
    TypeError
        It is neither a text nor a path.
    """
    if not isinstance(path, str | os.PathLike):
        shown = f"{path!r:.60}" if isinstance(path, int | float) else f"<{type(path).__name__}>"
        raise TypeError(f"path = {shown}: must be a path, such as 'table.csv'")


def choose_columns(frame: pd.DataFrame, columns: Sequence[str] | None) -> pd.DataFrame:
    """Return some columns of a table, by their names with or without units.

    Where a coordinate is among them, the others that distinguish its rows stay. A table over x and
    y with ``["x", "p"]`` has y as well.

    Raises
    ------
    TypeError
        The columns are no names.
    ValueError
        The table has no such column; the message has the nearest ones.
    """
    if columns is None:
        return frame
    names = [columns] if isinstance(columns, str) else columns
    if not isinstance(names, Sequence) or not all(isinstance(name, str) for name in names):
        raise TypeError(f"columns = <{type(columns).__name__}>: must be a list of names")
    heads = {head.split(" [")[0]: head for head in frame.columns}
    for name in names:
        if name not in heads and name not in frame.columns:
            near = nearest_names(name, heads, 3) or list(heads)
            raise ValueError(f"columns: no column {name!r:.60}; there is {', '.join(near)}")
    chosen = [heads.get(name, name) for name in names]
    coordinates = [column for column in frame.attrs.get(PLACES, ()) if frame[column].nunique() > 1]
    kept = [column for column in coordinates if column in chosen]
    if 0 < len(kept) < len(chosen) and frame[kept].duplicated().any():
        last = 1 + max(chosen.index(column) for column in kept)
        chosen[last:last] = [column for column in coordinates if column not in chosen]
    return frame[chosen]


def convert_units(frame: pd.DataFrame, units: Mapping[str, str] | None) -> pd.DataFrame:
    """Return a table with some columns in other units, in their heads as well.

    Parameters
    ----------
    frame : DataFrame
        Units in the names of the columns.
    units : mapping of str to str, optional
        Units by the names of columns, or by the units that are replaced: ``{"m": "um"}``. Errors
        and bounds of a column (``_error``, ``_low``, ``_high``) are in its unit.

    Raises
    ------
    TypeError
        It is no mapping of texts.
    ValueError
        There is no such column, or the unit measures something else; the message has both.
    """
    if units is None:
        return frame
    if not isinstance(units, Mapping) or not all(
        isinstance(text, str) for pair in units.items() for text in pair
    ):
        raise TypeError('units: must be names of columns with their units, such as {"T_x": "kN"}')
    parts = {column: column.removesuffix("]").split(" [") for column in map(str, frame.columns)}
    names = {name for column, part in parts.items() for name in (column, *part) if len(part) == 2}
    for name in units:
        if name not in names:
            near = nearest_names(name, names, 3)
            hint = f"; the nearest are {', '.join(near)}" if near else ""
            raise ValueError(f"units: no column with a unit is called {name!r:.60}{hint}")
    converted = {}
    for column, part in parts.items():
        measured = part[0].removesuffix("_low").removesuffix("_high").removesuffix("_error")
        keys = (column, *part, measured) if measured in names else (column, *part)
        unit = next((units[key] for key in keys if key in units), None)
        if unit is None or len(part) < 2:
            converted[column] = frame[column]
            continue
        factor = factor_between(part[1], unit)
        if factor is None:
            raise ValueError(f"units: {part[0]} is in {part[1]}: cannot be in {unit!r:.60}")
        converted[f"{part[0]} [{unit}]"] = frame[column] * factor
    return type(frame)(converted)


def convert_tables(
    frames: Mapping[str, pd.DataFrame], units: Mapping[str, str] | None
) -> dict[str, pd.DataFrame]:
    """Return tables in other units; a column may be in a single one of them."""
    if not isinstance(units, Mapping) or len(frames) == 1:
        return {name: convert_units(frame, units) for name, frame in frames.items()}
    heads = {
        name: {text for column in frame for text in str(column).removesuffix("]").split(" [")}
        for name, frame in frames.items()
    }
    absent = {key: unit for key, unit in units.items() if not any(key in k for k in heads.values())}
    if absent:
        convert_units(next(iter(frames.values())), absent)
    return {
        name: convert_units(frame, {k: unit for k, unit in units.items() if k in heads[name]})
        for name, frame in frames.items()
    }


class Tabular:
    """Something with tables: data frames, CSV and Excel, units in the names of columns."""

    def _tables(self) -> Tables:
        """Return what makes the tables, the main one first."""
        axes = getattr(type(self), "table_axes", None)
        return {"values": lambda: (self.dataset, axes)}  # type: ignore[attr-defined]

    def _frame(self, of: str | None) -> pd.DataFrame:
        """Return the table of a name, the main one for None."""
        make = self._maker(of)
        return data_frame(*make())

    def _maker(self, of: str | None) -> Callable[[], tuple[xr.Dataset, Sequence[str] | None]]:
        """Return the function that makes the table of a name, the main one for None."""
        tables = self._tables()
        if of is None:
            return next(iter(tables.values()))
        if not isinstance(of, str):
            raise TypeError(f"of = <{type(of).__name__}>: must be a text, {', '.join(tables)}")
        if of not in tables:
            raise ValueError(f"of = {of!r:.60}: must be one of {', '.join(tables)}")
        return tables[of]

    @refuse_keywords
    def to_dataframe(
        self,
        of: str | None = None,
        *,
        columns: Sequence[str] | None = None,
        units: Mapping[str, str] | None = None,
    ) -> pd.DataFrame:
        """Return a table of pandas: a row for every point, units in the names of the columns.

        A column is found by its name without the unit as well: ``frame["T_x"]``.

        Parameters
        ----------
        of : str, optional
            The table (default: the main one). A run has ``"increments"``, ``"branches"``,
            ``"loops"`` and ``"error_bars"``, wear has ``"jumps"`` and ``"loops"``, an increment
            has its ``"profile"``.
        columns : sequence of str, optional
            Columns in this order, with or without their units (default: all). Beside a
            coordinate, the others that distinguish its rows stay.
        units : dict, optional
            Units of some columns in place of SI units, such as ``{"delta_x": "um"}``, or of all
            columns of a unit, such as ``{"m": "um"}``.
        """
        return convert_units(choose_columns(self._frame(of), columns), units)

    @refuse_keywords
    def to_csv(
        self,
        path: str | os.PathLike[str],
        *,
        of: str | None = None,
        columns: Sequence[str] | None = None,
        units: Mapping[str, str] | None = None,
    ) -> None:
        """Write :meth:`to_dataframe` as a table of text (``.csv``).

        A file that is there is replaced.

        Parameters
        ----------
        path : path
            The file.
        of : str, optional
            The table, as in :meth:`to_dataframe`.
        columns : sequence of str, optional
            Columns in this order, such as ``["delta_x", "T_x"]``, with or without their units
            (default: all).
        units : dict, optional
            Units of columns, as in :meth:`to_dataframe`.
        """
        self._maker(of)
        check_path(path)
        frame = convert_units(choose_columns(self._frame(of), columns), units)
        frame.to_csv(path, index=False, lineterminator="\n", encoding="utf-8")

    @refuse_keywords
    def to_excel(
        self,
        path: str | os.PathLike[str],
        *,
        of: str | None = None,
        columns: Sequence[str] | None = None,
        units: Mapping[str, str] | None = None,
    ) -> None:
        """Write the tables into a workbook of Excel (``.xlsx``): a sheet for each, or `of` alone.

        A file that is there is replaced. It needs openpyxl: ``pip install "fretting[rigs]"``.

        Parameters
        ----------
        path : path
            The file.
        of : str, optional
            The table, as in :meth:`to_dataframe` (default: all, of `columns` the main one).
        columns : sequence of str, optional
            Columns as in :meth:`to_csv` (default: all).
        units : dict, optional
            Units of columns, as in :meth:`to_dataframe`. Each table has those that it has.
        """
        self._maker(of)
        check_path(path)
        names = list(self._tables())
        if of is not None:
            names = [of]
        elif columns is not None:
            names = names[:1]
        frames = {name: choose_columns(self._frame(name), columns) for name in names}
        write_excel(convert_tables(frames, units), path)
