"""Results that CalculiX prints: the ``.dat`` file of ``*EL PRINT``."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import numpy as np

from pyfret._core import read_text
from pyfret.export.components import read_order, to_matrices
from pyfret.export.increments import StoredIncrement, choose_increment
from pyfret.export.numbers import number, numbers

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from numpy.typing import NDArray

__all__ = ["list_prints", "read_printed"]

#: The head of stresses: names of the components, set and time.
STRESSES = re.compile(r"stresses \(elem, ?integ\.pnt\.,([^)]*)\) for set (.+?) and time +(\S+)")
#: The head of any other output, which ends the stresses.
OUTPUT = re.compile(r"(.+?)\(.*\) for .* and time +(\S+)")
#: The heads of a mode and of amplitudes at a frequency, in spaced letters.
MODE = re.compile(r"E I G E N V A L U E +N U M B E R +(\d+)")
AMPLITUDES = re.compile(r"F O R +F R E Q U E N C Y")
BUCKLING = "B U C K L I N G"


def read_printed(
    path: Path, element_set: str, step: int | str | None = None
) -> NDArray[np.float64]:
    """Read the stresses at the points of integration of a set as matrices, shape (n, 3, 3).

    The set must be named where there are several.
    """
    lines = read_text(path).splitlines()
    increments = _index(lines, path)
    names = dict.fromkeys(name for increment in increments for name in increment.blocks)
    if not names:
        raise ValueError(f"{path}: has no stresses of elements; *EL PRINT with S writes them")
    chosen_set = element_set if element_set in names or len(names) > 1 else next(iter(names))
    if chosen_set not in names:
        listed = [*names]
        raise ValueError(
            f"{path}: has stresses of {len(names)} sets, {', '.join(listed)}: choose with "
            f"field={listed[0]!r}"
        )
    increment = choose_increment(increments, chosen_set, step, path)
    first, components = increment.blocks[chosen_set]
    rows: list[list[float]] = []
    for n, line in enumerate(lines[first:], first + 1):
        words = line.split()
        if not words:
            continue
        if not words[0].isdigit():
            break
        try:
            rows.append(_point(line))
        except ValueError as error:
            raise ValueError(f"{path}, line {n}: {error}") from error
    if not rows:
        raise ValueError(f"{path}, line {first}: no stresses follow")
    try:
        return to_matrices(np.array(rows), read_order(components))
    except ValueError as error:
        raise ValueError(f"{path}, line {first}: {error}") from error


def list_prints(path: Path) -> list[StoredIncrement]:
    """List the increments of a file with the names of their sets."""
    return _index(read_text(path).splitlines(), path)


def _index(lines: Sequence[str], path: Path) -> list[StoredIncrement]:
    """Find the increments and the first lines of their stresses, by set.

    Modes and vibrations have heads of their own. An increment ends where the time changes or a set
    comes again.
    """
    increments: list[StoredIncrement] = []
    kind, mode, modes = "load", None, "mode"
    for n, line in enumerate(lines, 1):
        if BUCKLING in line:
            modes = "buckling mode"
        elif "E I G E N V A L U E   O U T P U T" in line:
            modes = "mode"
        elif head := MODE.search(line):
            kind, mode = modes, int(head[1])
            increments.append(StoredIncrement(kind, np.nan, mode=mode))
        elif AMPLITUDES.search(line):
            kind, mode = "vibration", None
            increments.append(StoredIncrement(kind, np.nan))
        elif head := STRESSES.search(line):
            try:
                time = number(head[3])
            except ValueError as error:
                raise ValueError(f"{path}, line {n}: {error}") from error
            last = increments[-1] if increments else None
            if last is not None and np.isnan(last.value):
                last.value = time
            twice = last is not None and head[2] in last.blocks and last.kind != "vibration"
            if last is None or last.value != time or twice:
                last = StoredIncrement("load", time)
                increments.append(last)
            last.blocks[head[2]] = (n, tuple(head[1].split(",")))
    return increments


def _point(line: str) -> list[float]:
    """Read the stress at a point of integration: element, point, six numbers."""
    match = re.fullmatch(r"\s*\d+\s+\d+\s(.*?)(\s+[A-Za-z_]\S*)?\s*", line)
    if match is None:
        raise ValueError(f"{line.strip()!r}: must be element, point and six stresses")
    if match[2]:
        raise ValueError(f"stresses along the axes {match[2].strip()}: print them with GLOBAL=YES")
    values = numbers(match[1])
    if len(values) != 6:
        raise ValueError(f"{len(values)} stresses: must be six")
    return values
