"""Tables as rigs and profilers write them: any separator, decimal comma, units in the head."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from pyfret import _core

if TYPE_CHECKING:
    import os

    from numpy.typing import NDArray

__all__ = ["Table", "read"]

#: A unit of each kind that a column is asked for, as an example.
USUAL = {"length": "um", "force": "N", "stress": "MPa", "stiffness": "N/um", "angle": "rad"}
#: What the columns of a table measure.
KINDS = "length, force, stress, stiffness, time, number"
#: Words of spreadsheets for a value that there is not, which begin like a comment.
NO_VALUE = re.compile(r"#(DIV/0|N/A|NV|WERT|VALUE|REF|BEZUG|NUM|ZAHL|NAME|NULL)\b")
#: A unit at the end of a head: ``[um]``, ``(um)``, ``/ um`` or ``_um``.
UNIT = re.compile(r"^(.*?)\s*(?:\[([^\]]*)\]|\(([^)]*)\)|/\s*(\S+)|_([^_\s]+))\s*$")
#: Lines from which what parts the columns is found.
SAMPLE = 200
NUMBER = re.compile(r"^[+-]?(\d+[.,]?\d*|[.,]\d+)([eE][+-]?\d+)?$", re.ASCII)


@dataclass(frozen=True)
class Table:
    """Columns in SI units, in blocks that empty lines part."""

    place: str
    names: tuple[str, ...]
    units: tuple[str, ...]
    blocks: tuple[NDArray[np.float64], ...]

    def column(self, kind: str, names: tuple[str, ...], given: str | None) -> int:
        """Which column measures that: the one of a name that is given, or the only one so named."""
        if given is not None:
            if given not in self.names:
                raise ValueError(
                    f"{self.place}: has no column {given!r}, but {', '.join(self.names)}"
                )
            at = self.names.index(given)
            self.must_measure(at, kind)
            return at
        of_kind = [n for n, unit in enumerate(self.units) if _core.measures(unit, kind)]
        if len(of_kind) > 1:
            named = [n for n in of_kind if self.names[n].lower().startswith(names)]
            of_kind = named or of_kind
        if len(of_kind) == 1:
            return of_kind[0]
        heads = ", ".join(f"{n} [{u}]" for n, u in zip(self.names, self.units, strict=True))
        what = "no column" if not of_kind else "more than one column"
        raise ValueError(
            f"{self.place}: {what} with a unit of {kind} ({heads}): name the column, or write its "
            "unit into the head, as in delta [um];T [N]"
        )

    def must_measure(self, at: int, kind: str) -> None:
        """Refuse a column without a unit of that kind."""
        unit, name = self.units[at], self.names[at]
        if _core.measures(unit, kind):
            return
        told = f"[{unit}]" if unit else "without a unit"
        usual = USUAL.get(kind, "SI")
        raise ValueError(
            f"{self.place}: column {name!r} {told}: must have a unit of {kind}; write it "
            f'into the head, as in {name} [{usual}], or give units={{"{name}": "{usual}"}}'
        )


def kind_of(unit: str) -> str:
    """What a unit measures, nothing for none."""
    found = _core.unit_of(unit) if unit else None
    return found[0] if found else ""


def size_of(unit: str) -> float:
    """A known unit in SI; 1 for none."""
    found = _core.unit_of(unit) if unit else None
    return found[1] if found else 1.0


def read(
    path: str | os.PathLike[str], units: dict[str, str] | None = None, *, skip: int = 0
) -> Table:
    """Read a table.

    Parameters
    ----------
    path : path
        Text in UTF-8, UTF-16 or Latin-1 with a head of names, and perhaps a line of units below it.
        Lines above the head are left out. So are lines that begin with ``#`` or ``%``.
    units : dict of str to str, optional
        Units of columns whose head names none.
    skip : int
        Lines at the top of the file that are left out, where the head is not found by itself.

    Raises
    ------
    ValueError
        There is no head, a number cannot be read, or a unit is unknown; the message has the line.
    """
    place = Path(path)
    lines = list(enumerate(_core.read_text(place).splitlines(), 1))[skip:]
    kept = [(n, line.strip(" \r")) for n, line in lines if not is_comment(line)]
    filled = [(n, line) for n, line in kept if line.strip()]
    if len(filled) < 2:
        raise ValueError(f"{place}: must be a head and rows of numbers")
    separator = parting([line for _, line in filled])
    rows = [cells(line, separator) for _, line in filled]
    first = first_row(rows)
    if first == 0:
        raise ValueError(
            f"{place}:{filled[0][0]}: the first line must name the columns and their units, as in "
            "delta [um];T [N]"
        )
    if first is None:
        n, line = filled[1]
        raise ValueError(f"{place}:{n}: must be numbers: {line}")
    below = [cell.strip("[]()") for cell in rows[first - 1]]
    # Units may have a line of their own.
    is_row = first > 1 and all(kind_of(unit) or not unit for unit in below) and any(below)
    head = first - 2 if is_row else first - 1
    heads, line_of_head = rows[head], filled[head][0]
    if len(heads) != len(rows[first]):
        raise ValueError(
            f"{place}:{filled[first][0]}: {len(rows[first])} numbers, where the head, line "
            f"{line_of_head}, has {len(heads)}: skip=n leaves out n lines at the top"
        )
    said = dict(zip(heads, below, strict=True)) if is_row else {}
    check_units(place, heads, said, units or {})
    units = said | (units or {})
    parted = [named(head, units) for head in heads]
    for name, unit in parted:
        if unit and not kind_of(unit):
            known = _core.units(KINDS)
            raise ValueError(
                f"{place}:{line_of_head}: {name}: unit {unit!r}: must be one of {known}"
            )
    factors = np.array([size_of(unit) for _, unit in parted])
    blocks: list[list[list[float]]] = [[]]
    for n, line in kept:
        if n < filled[first][0]:
            # What a logger writes above the head, the head, the units.
            continue
        if not line.strip():
            if blocks[-1]:
                blocks.append([])
            continue
        row = cells(line, separator)
        if row == heads or (is_row and [cell.strip("[]()") for cell in row] == below):
            continue
        if len(row) != len(heads):
            raise ValueError(f"{place}:{n}: {len(row)} numbers, where the head has {len(heads)}")
        try:
            blocks[-1].append([number(cell) for cell in row])
        except ValueError:
            raise ValueError(f"{place}:{n}: must be numbers: {line}") from None
    arrays = tuple(np.array(block) * factors for block in blocks if block)
    if not arrays:
        raise ValueError(f"{place}: has no rows")
    if not all(np.isfinite(block).all() for block in arrays):
        raise ValueError(f"{place}: has numbers that are not finite")
    names = tuple(name for name, _ in parted)
    return Table(str(place), names, tuple(unit for _, unit in parted), arrays)


def check_units(place: Path, heads: list[str], said: dict[str, str], units: dict[str, str]) -> None:
    """Refuse units of columns that are not there, or of which the file says another one."""
    for name, unit in units.items():
        of = [head for head in heads if name in (head, own(head)[0])]
        if not of:
            raise ValueError(f"{place}: units: has no column {name!r}, but {', '.join(heads)}")
        there = said.get(of[0]) or own(of[0])[1]
        if kind_of(there) and _core.unit_of(there) != _core.unit_of(unit):
            raise ValueError(
                f"{place}: units: {name!r} is given in {unit!r}, and the file says {there!r}: "
                "leave it out"
            )


def number(cell: str) -> float:
    """The number of a cell, with a decimal point or comma."""
    if not NUMBER.match(cell):
        raise ValueError(cell)
    return float(cell.replace(",", "."))


def parting(lines: list[str]) -> str | None:
    """What parts the columns, None for blanks: that which makes numbers of most lines.

    A comma parts only where nothing else does as well.
    """

    def numeric(separator: str | None) -> int:
        return sum(is_numeric(cells(line, separator)) for line in lines[:SAMPLE])

    # The first of the best.
    return max((";", "\t", None, ","), key=numeric)


def is_comment(line: str) -> bool:
    """Whether a line is left out."""
    return line.startswith(("#", "%")) and not NO_VALUE.match(line)


def is_numeric(row: list[str]) -> bool:
    """Whether a line is a row of numbers."""
    return len(row) > 1 and all(NUMBER.match(cell) for cell in row)


def first_row(rows: list[list[str]]) -> int | None:
    """The first row of numbers that the next one goes on from."""
    for n, row in enumerate(rows):
        after = rows[n + 1] if n + 1 < len(rows) else row
        if is_numeric(row) and is_numeric(after) and len(row) == len(after):
            return n
    return None


def cells(line: str, separator: str | None) -> list[str]:
    """The cells of a line, without quotes."""
    parts = re.split(r"\s+(?![\[(/])", line) if separator is None else line.split(separator)
    found = [cell.strip().strip('"') for cell in parts]
    # Some programs end a line as they part its columns.
    return found[:-1] if len(found) > 1 and not found[-1] else found


def named(head: str, units: dict[str, str]) -> tuple[str, str]:
    """The name and the unit of a column, that of `units` where it is there."""
    if head in units:
        return head, units[head]
    name, unit = own(head)
    return name, units.get(name, unit)


def own(head: str) -> tuple[str, str]:
    """The name and the unit in the head of a column."""
    found = UNIT.match(head)
    if not found:
        return head, ""
    unit = next((u for u in found.groups()[1:] if u is not None), "").strip()
    if found.group(5) is not None and not kind_of(unit):
        return head, ""
    return found.group(1).strip(), unit
