"""Meshes in input files of Abaqus and CalculiX: what is understood, what is refused by name.

Nodes and elements of a file without parts, or of parts that instances place: each instance moves
the coordinates of its part, then turns them (Abaqus, Input Syntax Rules, ``*INSTANCE``). Keywords
that move, copy, generate or turn nodes in other ways are refused; all others do not affect a mesh.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from pyfret._core import read_text
from pyfret.export.numbers import number

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from numpy.typing import NDArray

__all__ = ["Part", "read_parts"]

#: Keywords that change where nodes lie, which there are, or along which axes forces act.
REFUSED = {
    "SYSTEM": "the nodes that follow are in other axes",
    "INCLUDE": "part of the model is in another file",
    "NGEN": "nodes are generated",
    "NFILL": "nodes are generated",
    "NCOPY": "nodes are copied",
    "NMAP": "nodes are moved",
    "ELGEN": "elements are generated",
    "ELCOPY": "elements are copied",
    "TRANSFORM": "forces on its nodes act along other axes",
    "IMPERFECTION": "nodes are moved",
    "ADJUST": "nodes are moved",
    "IMPORT": "the model belongs to another job",
    "PARAMETER": "numbers are names",
    "SYMMETRIC MODEL GENERATION": "nodes are generated",
    "CYCLIC SYMMETRY MODEL": "the model is one sector",
    "SUBSTRUCTURE PATH": "the model is in another file",
    "CSYS": "the nodes that follow may be in other axes",
}
#: Options that a block may have, and their meanings.
OPTIONS = {"NODE": {"NSET", "SYSTEM"}, "ELEMENT": {"TYPE", "ELSET"}}
#: Beginnings of the types of elements with a volume, of those that are faces, and of the others,
#: which carry no pressure on a face: plane, axisymmetric, bars, springs, masses, connectors.
VOLUMES = ("C3D", "DC3D", "DCC3D", "AC3D", "F3D", "Q3D", "SC")
SHELLS = ("S", "STRI", "M3D", "R3D", "SFM3D", "DS", "SAX")
OTHERS = (
    *("CP", "CA", "CG", "DC1", "DC2", "DCA", "B2", "B3", "T2", "T3", "PIPE", "FRAME", "ELBOW"),
    *("SPRING", "MASS", "ROTARYI", "CONN", "GAP", "DASHPOT", "DCOUP", "RB", "R2D", "RAX", "COH"),
    *("GK", "D1", "D2", "U", "W", "HEATCAP", "ITT", "PSI", "LS3", "JOINT", "IRS", "MCL", "PC3D"),
)


@dataclass
class Part:
    """Nodes and elements with their numbers."""

    numbers: list[int] = field(default_factory=list)
    points: list[list[float]] = field(default_factory=list)
    #: Elements as rows of numbers of nodes.
    volumes: list[list[int]] = field(default_factory=list)
    faces: list[list[int]] = field(default_factory=list)
    #: What stands before the numbers of an instance, such as ``Block-1.``.
    prefix: str = ""


@dataclass
class Line:
    """A keyword with its options, or a line of data."""

    n: int
    text: str
    keyword: str = ""
    options: dict[str, str] = field(default_factory=dict)


def lines_of(path: Path) -> Iterator[Line]:
    """Yield the lines of a file without comments; continued keywords are joined."""
    rows = enumerate(read_text(path).splitlines(), 1)
    for n, row in rows:
        text = row.strip()
        if not text or text.startswith("**"):
            continue
        if not text.startswith("*"):
            yield Line(n, text)
            continue
        while text.endswith(","):
            text += next((continued for _, continued in rows), "").strip()
        head, *options = (cell.strip() for cell in text[1:].split(","))
        pairs = (option.partition("=") for option in options if option)
        options_of_line = {key.strip().upper(): value.strip().strip('"') for key, _, value in pairs}
        yield Line(n, text, " ".join(head.upper().split()), options_of_line)


def read_parts(path: Path) -> list[Part]:
    """Read the parts of a file at their places; a ValueError has the line at fault."""
    reader = _Reader(path)
    for line in lines_of(path):
        try:
            reader.take(line)
        except ValueError as error:
            raise ValueError(f"{path}, line {line.n}: {error}") from error
    return reader.placed()


class _Reader:
    """Goes through a file line by line."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.flat = Part()
        self.parts: dict[str, Part] = {}
        self.instances: list[tuple[str, str, int, list[list[float]]]] = []
        self.own: dict[int, Part] = {}
        self.now = self.flat
        self.keyword = self.kind = ""
        self.open_line = False

    def take(self, line: Line) -> None:
        """Read a line of data for the present keyword, or a keyword."""
        if line.keyword:
            self.begin(line)
        elif self.keyword == "NODE":
            row = [cell.strip() for cell in line.text.rstrip(",").split(",")]
            self.now.numbers.append(int(row[0]))
            point = [number(coordinate) if coordinate else 0.0 for coordinate in row[1:4]]
            self.now.points.append(point + [0.0] * (3 - len(point)))
        elif self.keyword == "ELEMENT" and self.kind:
            row_of = [int(cell) for cell in line.text.rstrip(",").split(",")]
            rows = self.now.volumes if self.kind == "volume" else self.now.faces
            # An element goes on in the next line after a comma.
            rows[-1].extend(row_of) if self.open_line else rows.append(row_of)
            self.open_line = line.text.endswith(",")
        elif self.keyword == "INSTANCE":
            row_of_move = [number(cell) for cell in line.text.rstrip(",").split(",")]
            self.instances[-1][3].append(row_of_move)

    def begin(self, line: Line) -> None:
        """Begin a keyword."""
        self.keyword, self.open_line = line.keyword, False
        for name, why in REFUSED.items():
            if line.keyword == name:
                raise ValueError(f"*{name}: {why}, which is not read; write the mesh without it")
        unread = set(line.options) - OPTIONS.get(line.keyword, set(line.options))
        if unread:
            raise ValueError(f"*{line.keyword}, {', '.join(sorted(unread))}: is not read")
        if line.keyword == "NODE" and line.options.get("SYSTEM", "R").upper() != "R":
            raise ValueError("*NODE, SYSTEM: only R, rectangular coordinates, is read")
        if line.keyword == "ELEMENT":
            self.kind = kind_of(line.options.get("TYPE", ""))
        elif line.keyword == "PART":
            self.now = self.parts.setdefault(line.options.get("NAME", "").upper(), Part())
        elif line.keyword in ("END PART", "END INSTANCE", "END ASSEMBLY"):
            self.now = self.flat
        elif line.keyword == "INSTANCE":
            if "PART" not in line.options:
                raise ValueError("*INSTANCE without PART: is not read")
            name, part = line.options.get("NAME", ""), line.options["PART"].upper()
            self.instances.append((name, part, line.n, []))
            # Nodes of its own, which Abaqus writes for meshes of an instance.
            self.now = self.own.setdefault(len(self.instances) - 1, Part())

    def placed(self) -> list[Part]:
        """Return all parts in the axes of the assembly."""
        parts = [self.flat] if self.flat.numbers else []
        if self.parts and not self.instances:
            raise ValueError(f"{self.path}: its *PART stands in no *INSTANCE: nothing places it")
        for n, (name, part, line, moves) in enumerate(self.instances):
            own_nodes = self.own[n]
            nodes = own_nodes if own_nodes.numbers else self.parts.get(part)
            if nodes is None:
                raise ValueError(f"{self.path}, line {line}: *INSTANCE: there is no *PART {part}")
            try:
                points = moved(np.array(nodes.points).reshape(-1, 3), moves)
            except ValueError as error:
                raise ValueError(f"{self.path}, line {line}: *INSTANCE: {error}") from error
            parts.append(
                Part(nodes.numbers, points.tolist(), nodes.volumes, nodes.faces, prefix=f"{name}.")
            )
        if not any(part.numbers for part in parts):
            raise ValueError(f"{self.path}: has no *NODE block with nodes")
        return parts


def kind_of(kind: str) -> str:
    """Return whether elements of a type are volumes, faces or neither; refuse others."""
    name = kind.upper()
    if not name:
        raise ValueError("*ELEMENT without TYPE: is not read")
    if name.startswith(VOLUMES):
        return "volume"
    if name.startswith(OTHERS):
        return ""
    shell = name.startswith(SHELLS) and not name.startswith(("SAX", "SPRING"))
    if shell:
        return "face"
    raise ValueError(f"*ELEMENT, TYPE={kind}: is not known")


def moved(points: NDArray[np.float64], moves: list[list[float]]) -> NDArray[np.float64]:
    """Move the points of an instance: shifted by its first line of data, turned by the second."""
    if len(moves) > 2 or any(
        len(row) not in n for row, n in zip(moves, ((1, 2, 3), (7,)), strict=False)
    ):
        raise ValueError("must have a move of three numbers, then a turn of seven")
    if moves:
        points = points + np.array(moves[0] + [0.0] * (3 - len(moves[0])))
    if len(moves) == 2:
        a, b, angle = np.array(moves[1][:3]), np.array(moves[1][3:6]), math.radians(moves[1][6])
        length = float(np.linalg.norm(b - a))
        if length == 0.0:
            raise ValueError("its axis of rotation has two equal points")
        u = (b - a) / length
        x = points - a
        # Rodrigues' formula.
        points = (
            a
            + x * math.cos(angle)
            + np.cross(u, x) * math.sin(angle)
            + np.outer(x @ u, u) * (1.0 - math.cos(angle))
        )
    return points
