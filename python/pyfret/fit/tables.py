"""Tables as rigs and profilers write them: any separator, decimal comma, units in the head."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from pyfret import _core
from pyfret.fit.columns import RecordColumns, kind_of, split_unit

if TYPE_CHECKING:
    import os
    from collections.abc import Sequence

    from numpy.typing import NDArray

__all__ = ["Row", "Table", "read_table", "table_from_rows"]

#: A line of a table: its number in the file and its cells; no cells for an empty line.
Row = tuple[int, list[str]]
#: Words of spreadsheets for a value that there is not, which begin like a comment.
NO_VALUE = re.compile(r"#(DIV/0|N/A|NV|WERT|VALUE|REF|BEZUG|NUM|ZAHL|NAME|NULL)\b")
#: Lines from which the separator of the columns is found.
SAMPLE = 200
NUMBER = re.compile(r"^[+-]?(\d+[.,]?\d*|[.,]\d+)([eE][+-]?\d+)?$", re.ASCII)
#: Part of the cells of a row of numbers that must be numbers; the others may be times or words.
NUMERIC = 0.5


class Table(RecordColumns):
    """Columns of a text or a sheet, in blocks that empty lines separate."""

    def __init__(
        self,
        place: str,
        names: tuple[str, ...],
        units: tuple[str, ...],
        blocks: Sequence[NDArray[np.float64]],
        faults: dict[int, str],
    ) -> None:
        super().__init__(place, names, units)
        self.blocks = blocks
        #: The first row of each column that has no number in it.
        self.faults = faults

    def raw(self, indices: tuple[int, ...]) -> list[NDArray[np.float64]]:
        """Return columns in their units."""
        for index in indices:
            if index in self.faults:
                raise ValueError(f"{self.place}:{self.faults[index]}")
        return [np.concatenate([block[:, n] for block in self.blocks]) for n in indices]


def read_table(
    path: str | os.PathLike[str], units: dict[str, str] | None = None, *, skip: int = 0
) -> Table:
    """Read a table of text.

    Parameters
    ----------
    path : path
        Text in UTF-8, UTF-16 or Latin-1 with a head of names, and perhaps a line of units below it.
        Lines above the head are left out. So are lines that begin with ``#`` or ``%``, unless the
        last of them above the numbers is the head.
    units : dict of str to str, optional
        Units of columns whose head names none.
    skip : int
        Lines at the top of the file that are left out, where the head is not found by itself.

    Raises
    ------
    ValueError
        There is no head; the message has the line.
    """
    file = Path(path)
    lines = list(enumerate(_core.read_text(file).splitlines(), 1))[skip:]
    kept = [(n, line.strip(" \r")) for n, line in lines if not is_comment(line)]
    filled = [line for _, line in kept if line.strip()]
    if len(filled) < 2:
        raise ValueError(f"{file}: must be a head and rows of numbers")
    separator = find_separator(filled)
    rows = [(n, cells(line, separator) if line.strip() else []) for n, line in kept]
    first = first_row([row for _, row in rows if row])
    if first == 0:
        begin = next(n for n, row in rows if row)
        comments = [
            (n, line.lstrip("#% \t")) for n, line in lines if n < begin and is_comment(line)
        ]
        heads = [(n, cells(line, separator)) for n, line in comments if line.strip()]
        rows = heads + rows
    return table_from_rows(str(file), rows, units)


def table_from_rows(place: str, rows: list[Row], units: dict[str, str] | None = None) -> Table:
    """Make a table of rows of cells: heads above, then numbers."""
    filled = [row for row in rows if row[1]]
    first = first_row([cells_of_row for _, cells_of_row in filled])
    if first == 0:
        raise ValueError(
            f"{place}:{filled[0][0]}: the first line must name the columns and their units, as in "
            "delta [um];T [N]"
        )
    if first is None:
        n, row = filled[1] if len(filled) > 1 else (0, ["nothing"])
        raise ValueError(f"{place}:{n}: must be numbers: {'; '.join(row)}")
    below = [cell.strip("[]()") for cell in filled[first - 1][1]]
    # Units may have a line of their own.
    is_row = first > 1 and all(kind_of(unit) or not unit for unit in below) and any(below)
    is_row = is_row and len(filled[first - 2][1]) == len(below)
    line_of_head, heads = filled[first - 2 if is_row else first - 1]
    begin, numbers = filled[first]
    if len(heads) != len(numbers):
        raise ValueError(
            f"{place}:{begin}: {len(numbers)} numbers, where the head, line "
            f"{line_of_head}, has {len(heads)}: skip=n leaves out n lines at the top"
        )
    in_file = dict(zip(heads, below, strict=True)) if is_row else {}
    check_units(place, heads, in_file, units or {})
    parted = [named(head, in_file | (units or {})) for head in heads]
    blocks: list[list[list[float]]] = [[]]
    faults: dict[int, str] = {}
    for n, row in rows:
        if n < begin:
            # What a logger writes above the head, the head, the units.
            continue
        if not row:
            if blocks[-1]:
                blocks.append([])
            continue
        if row == heads or (is_row and [cell.strip("[]()") for cell in row] == below):
            continue
        if len(row) != len(heads):
            raise ValueError(f"{place}:{n}: {len(row)} numbers, where the head has {len(heads)}")
        blocks[-1].append([number_or_fault(row, k, n, faults) for k in range(len(row))])
    arrays = [np.array(block) for block in blocks if block]
    if not arrays:
        raise ValueError(f"{place}: has no rows")
    names = tuple(name for name, _ in parted)
    return Table(place, names, tuple(unit for _, unit in parted), arrays, faults)


def number_or_fault(row: list[str], column: int, line: int, faults: dict[int, str]) -> float:
    """Return the number of a cell; NaN, and the line noted, where there is none."""
    try:
        return number(row[column])
    except ValueError:
        faults.setdefault(column, f"{line}: must be numbers: {'; '.join(row)}")
        return float("nan")


def check_units(place: str, heads: list[str], said: dict[str, str], units: dict[str, str]) -> None:
    """Refuse units of columns that are not there, or differ from the file."""
    for name, unit in units.items():
        matching = [head for head in heads if name in (head, split_unit(head)[0])]
        if not matching:
            raise ValueError(f"{place}: units: has no column {name!r}, but {', '.join(heads)}")
        there = said.get(matching[0]) or split_unit(matching[0])[1]
        if kind_of(there) and _core.unit_of(there) != _core.unit_of(unit):
            raise ValueError(
                f"{place}: units: {name!r} is given in {unit!r}, and the file says {there!r}: "
                "leave it out"
            )


def number(cell: str) -> float:
    """Read a cell with a decimal point or comma."""
    if not NUMBER.match(cell):
        raise ValueError(cell)
    return float(cell.replace(",", "."))


def find_separator(lines: list[str]) -> str | None:
    """Find the separator that makes numbers of most lines; None for blanks.

    A comma counts only if nothing else does as well.
    """

    def numeric(separator: str | None) -> tuple[int, int]:
        """Count the lines, and the cells, that are numbers with a separator."""
        rows = [cells(line, separator) for line in lines[:SAMPLE]]
        whole = sum(len(row) > 1 and all(map(NUMBER.match, row)) for row in rows)
        return whole, sum(map(is_numeric, rows))

    # The first of the best.
    return max((";", "\t", None, ","), key=numeric)


def is_comment(line: str) -> bool:
    """Whether a line is left out."""
    return line.startswith(("#", "%")) and not NO_VALUE.match(line)


def is_numeric(row: list[str]) -> bool:
    """Check that a row has numbers: two or more, in half of its cells or more."""
    count = sum(NUMBER.match(cell) is not None for cell in row)
    return count > 1 and count >= NUMERIC * len(row)


def first_row(rows: list[list[str]]) -> int | None:
    """Find the first row of numbers that the next row continues; None if there is none."""
    for n, row in enumerate(rows):
        after = rows[n + 1] if n + 1 < len(rows) else row
        if is_numeric(row) and is_numeric(after) and len(row) == len(after):
            return n
    return None


def cells(line: str, separator: str | None) -> list[str]:
    """Split a line into its cells, without quotes."""
    if separator is not None:
        parts = line.split(separator)
    elif line.startswith(("[", "(")):
        # A row of units.
        parts = line.split()
    else:
        parts = re.split(r"\s+(?![\[(/])", line)
    cells = [cell.strip().strip('"') for cell in parts]
    # Some programs end a line as they part its columns.
    return cells[:-1] if len(cells) > 1 and not cells[-1] else cells


def named(head: str, units: dict[str, str]) -> tuple[str, str]:
    """Return the name and the unit of a column; `units` takes precedence."""
    if head in units:
        return head, units[head]
    name, unit = split_unit(head)
    return name, units.get(name, unit)
