"""Results of CalculiX in text: the ``.frd`` file of nodes and fields.

CalculiX GraphiX manual, "frd: Result Format". The head of a block of results (``100C``) has the
time, frequency or buckling factor, the kind of the step and the format. Format 0 has numbers of
nodes of five digits, format 1 of ten. The others are binary.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from pyfret._core import read_text
from pyfret._util.scene_warnings import warn
from pyfret.export.components import read_order, to_matrices, to_vectors
from pyfret.export.increments import StoredIncrement, choose_increment
from pyfret.export.numbers import number, numbers

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from numpy.typing import NDArray

__all__ = ["FIELDS", "list_increments", "read_frd"]

#: Digits of the numbers of nodes, by the format of a block.
WIDTHS = {"0": 5, "1": 10, "": 10}
#: Columns of the head of a block of results: value, text, kind of step, name of analysis, format.
VALUE, KIND, ANALYSIS, FORMAT = slice(12, 24), slice(56, 58), slice(63, 73), slice(72, 76)
#: Kinds of steps of the head: static, time, frequency, load; CalculiX writes 4 for buckling.
KINDS = {"": "load", "0": "load", "1": "load", "2": "mode", "3": "load", "4": "buckling mode"}
#: Fields that are read, and the components that their blocks have where they are not named.
FIELDS = {
    "STRESS": ("SXX", "SYY", "SZZ", "SXY", "SYZ", "SZX"),
    "DISP": ("D1", "D2", "D3"),
}
#: Component that a program of pictures computes from the others.
COMPUTED = "ALL"


class Block(NamedTuple):
    """A block of numbers: its first line, digits of the numbers of nodes, names of components."""

    first: int
    width: int
    names: tuple[str, ...]


def read_frd(
    path: Path, field: str, step: int | str | None = None
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Read nodes (n, 3) and a field on them: stresses (n, 3, 3) or displacements (n, 3)."""
    lines = read_text(path).splitlines()
    nodes, increments, ended = _index(lines, path)
    if nodes is None:
        raise ValueError(f"{path}: has no nodes; *NODE FILE writes them, as text")
    if not any(field in increment.blocks for increment in increments):
        raise ValueError(f"{path}: has no block {field}; *NODE FILE writes it, as text")
    chosen = choose_increment(increments, field, step, path)
    if not ended:
        warn(f"{path}: ends without the line 9999: the run was stopped, or has not ended; {chosen}")
    block = chosen.blocks[field]
    points = _rows(lines, path, nodes, 3)
    rows = _rows(lines, path, block, len(block.names))
    common = [n for n in points if n in rows]
    if not common:
        raise ValueError(f"{path}: {field} has no node of the block of nodes")
    values = np.array([rows[n] for n in common])
    try:
        if field == "STRESS":
            values = to_matrices(values, read_order(block.names))
        else:
            values = to_vectors(values, block.names)
    except ValueError as error:
        raise ValueError(f"{path}: {field}: {error}") from error
    return np.array([points[n] for n in common]), values


def list_increments(path: Path) -> list[StoredIncrement]:
    """List the increments of a file with the names of their blocks."""
    return _index(read_text(path).splitlines(), path)[1]


def _index(lines: Sequence[str], path: Path) -> tuple[Block | None, list[StoredIncrement], bool]:
    """Find the nodes, the increments with the places of their blocks, and the end of the run."""
    nodes: Block | None = None
    increments: list[StoredIncrement] = []
    above: dict[str, list[str]] = {}
    new, width = StoredIncrement("load", 0.0), 10
    for n, line in enumerate(lines):
        if line.startswith("    1P"):
            key, *words = line[6:].split() or [""]
            above[key] = words
        elif line.startswith("    2C"):
            width = _width(line, path)
            nodes = Block(n + 1, width, ("X", "Y", "Z"))
        elif line.startswith("  100C"):
            width, new = _width(line, path), _increment(line, above, path)
            above = {}
        elif line.startswith(" -4") and line[3:].split():
            if not increments or not increments[-1].is_same(new):
                increments.append(new)
            blocks, name = increments[-1].blocks, line[3:].split()[0]
            if name.endswith("I") and name[:-1] in blocks:
                # The imaginary part of a block above.
                increments[-1].kind = "vibration"
            blocks[name] = Block(n + 1, width, _names(lines, n + 1, name))
    return nodes, increments, any(line.startswith(" 9999") for line in lines[-3:])


def _increment(head: str, parameters: dict[str, list[str]], path: Path) -> StoredIncrement:
    """Read the increment of a block from its head and the parameters above it."""
    words = head[VALUE].split() or head[12:].split()
    try:
        value = number(words[0]) if words else 0.0
    except ValueError as error:
        raise ValueError(f"{path}: {head.strip()}: {error}") from error
    code, analysis = head[KIND].strip(), head[ANALYSIS].strip().upper()
    kind = KINDS.get(code, f"step of kind {code}")
    step = parameters.get("STEP", [])
    count, number_of_step = None, None
    if len(step) > 2 and all(word.lstrip("-").isdigit() for word in step[1:3]):
        count, number_of_step = (int(word) for word in step[1:3])
    mode = parameters.get("MODE", [""])[0]
    if analysis == "MODAL" or mode:
        kind = "mode"
    elif kind == "load" and count == 0:
        # Steady state dynamics have no increments.
        kind = "vibration"
    elif kind == "buckling mode" and value == 0.0:
        # The state under the load of the step, before its modes.
        kind = "load"
    return StoredIncrement(
        kind, value, number_of_step, count, int(mode) if mode.isdigit() else None
    )


def _names(lines: Sequence[str], first: int, field: str) -> tuple[str, ...]:
    """Read the names of the components of a block; the usual ones if it has fewer."""
    usual = FIELDS.get(field, ())
    names: list[str] = []
    for line in lines[first : first + 64]:
        if not line.startswith(" -5"):
            break
        words = line[3:].split()
        if words and words[0] != COMPUTED:
            names.append(words[0])
    return tuple(names) if len(names) >= len(usual) else usual


def _width(line: str, path: Path) -> int:
    """Return the digits of the numbers of nodes of a block."""
    form = line[FORMAT].strip() if len(line) > FORMAT.start else ""
    if form not in WIDTHS:
        raise ValueError(f"{path}: a block has the format {form}: must be 0 or 1, which are text")
    return WIDTHS[form]


def _rows(
    lines: Sequence[str], path: Path, block: Block, components: int
) -> dict[int, list[float]]:
    """Read the rows of a block up to its end, by the numbers of their nodes."""
    rows: dict[int, list[float]] = {}
    for n, line in enumerate(lines[block.first :], block.first + 1):
        if line.startswith(" -3"):
            return rows
        if not line.startswith(" -1"):
            continue
        try:
            values = numbers(line[3 + block.width :])
            if len(values) != components:
                raise ValueError(f"{len(values)} numbers: must have {components}")
            rows[int(line[3 : 3 + block.width])] = values
        except ValueError as error:
            raise ValueError(f"{path}, line {n}: {error}") from error
    raise ValueError(f"{path}: ends within a block")
