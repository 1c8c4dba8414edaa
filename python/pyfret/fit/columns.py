"""Columns of a measured record: names, units and numbers, whatever the file that has them.

Only the columns that are used must have a known unit, and numbers in every row.
"""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from typing import TYPE_CHECKING

import numpy as np

from pyfret import _core

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["RecordColumns", "kind_of", "size_of", "split_unit"]

#: A unit of each kind that a column is asked for, as an example.
USUAL = {"length": "um", "force": "N", "stress": "MPa", "stiffness": "N/um", "angle": "rad"}
#: What the columns of a table measure.
KINDS = "length, force, stress, stiffness, time, number"
#: A unit at the end of a head: ``[um]``, ``(um)``, ``/ um`` or ``_um``.
UNIT = re.compile(r"^(.*?)\s*(?:\[([^\]]*)\]|\(([^)]*)\)|/\s*(\S+)|_([^_\s]+))\s*$")


def kind_of(unit: str) -> str:
    """Return what a unit measures, nothing for none."""
    measure = _core.unit_of(unit) if unit else None
    return measure[0] if measure else ""


def size_of(unit: str) -> float:
    """Return a known unit in SI; 1 for none."""
    measure = _core.unit_of(unit) if unit else None
    return measure[1] if measure else 1.0


def split_unit(head: str) -> tuple[str, str]:
    """Return the name and the unit in the head of a column."""
    match = UNIT.match(head)
    if not match:
        return head, ""
    unit = next((u for u in match.groups()[1:] if u is not None), "").strip()
    if match.group(5) is not None and not kind_of(unit):
        return head, ""
    return match.group(1).strip(), unit


class RecordColumns(ABC):
    """Columns by their names, with the units that the file gives them.

    Attributes
    ----------
    place : str
        The file.
    names, units : tuple of str
        Of each column; an unknown unit matters for the columns that are used.
    notes : list of str
        What was assumed or computed while the columns were read.
    has_holes : bool
        Whether the columns that were read last have missing values.
    """

    def __init__(self, place: str, names: tuple[str, ...], units: tuple[str, ...]) -> None:
        self.place, self.names, self.units = place, names, units
        self.notes: list[str] = []
        self.has_holes = False

    @abstractmethod
    def raw(self, indices: tuple[int, ...]) -> list[NDArray[np.float64]]:
        """Read columns in their units, as arrays that nobody else has."""

    def numbers(self, *indices: int) -> list[NDArray[np.float64]]:
        """Read columns in SI units."""
        for index in indices:
            unit = self.units[index]
            if unit and not kind_of(unit):
                kind_units = _core.units(KINDS)
                raise ValueError(
                    f"{self.place}: {self.names[index]}: unit {unit!r}: must be one of {kind_units}"
                )
        columns = self.scaled(indices, [size_of(self.units[index]) for index in indices])
        self.has_holes = False
        for values in columns:
            # A sum is finite where all numbers are.
            if np.isfinite(values.sum()):
                continue
            if np.isinf(values).any():
                raise ValueError(f"{self.place}: has numbers that are not finite")
            self.has_holes = True
        return columns

    def scaled(self, indices: tuple[int, ...], factors: list[float]) -> list[NDArray[np.float64]]:
        """Read columns times a factor each."""
        columns = self.raw(indices)
        for values, factor in zip(columns, factors, strict=True):
            if factor != 1.0:
                values *= factor
        return columns

    def column(self, kind: str, names: tuple[str, ...], given: str | None) -> int:
        """Return the index of the column of a given name, or of the only one of a kind."""
        if given is not None:
            index = self.index(given)
            self.must_measure(index, kind)
            return index
        of_kind = [n for n, unit in enumerate(self.units) if _core.measures(unit, kind)]
        if len(of_kind) > 1:
            of_name = [n for n in of_kind if self.short(n).lower().startswith(names)]
            of_kind = of_name or of_kind
        if len(of_kind) == 1:
            return of_kind[0]
        heads = ", ".join(f"{n} [{u}]" for n, u in zip(self.names, self.units, strict=True))
        count = "no column" if not of_kind else "more than one column"
        raise ValueError(
            f"{self.place}: {count} with a unit of {kind} ({heads}): name the column, or write its "
            "unit into the head, as in delta [um];T [N]"
        )

    def short(self, index: int) -> str:
        """Return the name of a column without its group."""
        return self.names[index].rpartition("/")[2]

    def index(self, name: str) -> int:
        """Return the index of a column by its name, with or without its group or its unit."""
        if name in self.names:
            return self.names.index(name)
        matching = [
            n
            for n, unit in enumerate(self.units)
            if name in (self.short(n), f"{self.names[n]} [{unit}]")
        ]
        if len(matching) == 1:
            return matching[0]
        listed = ", ".join(self.names[n] for n in matching) or ", ".join(self.names)
        problem = f"{len(matching)} columns" if matching else "no column"
        raise ValueError(f"{self.place}: has {problem} {name!r}, but {listed}")

    def must_measure(self, index: int, kind: str) -> None:
        """Refuse a column without a unit of a kind."""
        unit, name = self.units[index], self.names[index]
        if _core.measures(unit, kind):
            return
        stated = f"[{unit}]" if unit else "without a unit"
        usual = USUAL.get(kind, "SI")
        raise ValueError(
            f"{self.place}: column {name!r} {stated}: must have a unit of {kind}; write it "
            f'into the head, as in {name} [{usual}], or give units={{"{name}": "{usual}"}}'
        )
