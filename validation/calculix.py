"""A coated fretting line contact as finite elements of CalculiX: mesh, input file, run, tractions.

Two blocks in plane strain: the upper one ends in a cylinder, the lower one has a coating. The
bottom is held, the top moves as a rigid body and carries the forces. Lengths are in mm, forces in N
per mm of depth, stresses in MPa.
"""

from __future__ import annotations

import os
import subprocess
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from pathlib import Path

    from validation.truth import Array

#: Radius, half-width of the uncoated contact and thickness of the coating [mm].
R, A, THICKNESS = 10.0, 0.1, 0.1
#: Young's modulus of both bodies [MPa], Poisson's ratio, friction.
E, NU, MU = 210e3, 0.3, 0.3
#: Forces at the ends of the branches over mu W.
BRANCHES = (0.9, -0.9, 0.9)
#: Normal force [N/mm]: A is the half-width of Hertz.
W = np.pi * A**2 * (E / (2.0 * (1.0 - NU**2))) / (4.0 * R)
#: Half the width and the height of a block, half the width and the depth of its even part [A].
FAR, FINE, DENSE = 60.0, 1.3, 0.2
#: Growth of the elements beyond the even part, and of those in the coating.
GROWTH, GROWTH_LAYER = 1.25, 1.1
#: Overlap at the start [mm]: a force needs a contact from the first iteration on.
OVERLAP = 5e-6


@dataclass(frozen=True)
class Model:
    """A run of CalculiX.

    Attributes
    ----------
    ratio : float
        Young's modulus of the coating over the modulus of the bodies.
    cells : int
        Elements across the half-width A.
    press, branch : int
        Increments of the pressing and of a branch.
    stick : float
        Stiffness of a stuck point [N/mm^3].
    normal : float
        Stiffness of a pressed point [N/mm^3].
    """

    ratio: float = 2.0
    cells: int = 20
    press: int = 8
    branch: int = 12
    stick: float = 5e7
    normal: float = 2e8


class Tractions(NamedTuple):
    """Place [mm], pressure and shear [MPa] of the nodes of the cylinder after a step."""

    x: Array
    p: Array
    q: Array


class Run(NamedTuple):
    """Tractions after each step, processor time [s] and largest memory [bytes] of a run."""

    steps: list[Tractions]
    seconds: float
    memory: int
    nodes: int


def grow(first: float, size: float, end: float, growth: float) -> list[float]:
    """Return coordinates after `first` to `end`; each element is `growth` times its predecessor."""
    count = 1
    while size * growth * (growth**count - 1.0) / (growth - 1.0) < end - first:
        count += 1
    steps = size * growth ** np.arange(1, count + 1)
    steps *= (end - first) / steps.sum()
    return list(first + np.cumsum(steps))


def coordinates(model: Model) -> tuple[Array, Array]:
    """Return the x of the columns and the depths of the rows of a block [mm]."""
    size = A / model.cells
    half = list(size * np.arange(round(FINE * model.cells) + 1))
    half += grow(half[-1], size, FAR * A, GROWTH)
    x = np.array([*(-v for v in half[:0:-1]), *half])
    z = list(size * np.arange(round(DENSE * model.cells) + 1))
    z += grow(z[-1], size, THICKNESS, GROWTH_LAYER)
    z += grow(z[-1], z[-1] - z[-2], FAR * A, GROWTH)
    return x, np.array(z)


def write_block(
    lines: list[str], name: str, first: int, points: Array, *, up: bool
) -> tuple[Array, Array]:
    """Write nodes and elements of a block; return their numbers, rows by columns."""
    rows, columns, _ = points.shape
    nodes = first + np.arange(rows * columns).reshape(rows, columns)
    lines.append("*NODE, NSET=ALL")
    for number, (x, y) in zip(nodes.ravel(), points.reshape(-1, 2), strict=True):
        lines.append(f"{number}, {x:.12g}, {y:.12g}, 0")
    elements = first + np.arange((rows - 1) * (columns - 1)).reshape(rows - 1, columns - 1)
    lines.append(f"*ELEMENT, TYPE=CPE4, ELSET={name}")
    near, deep = nodes[:-1], nodes[1:]
    corners = [near[:, :-1], near[:, 1:], deep[:, 1:], deep[:, :-1]]
    if not up:
        corners = [deep[:, :-1], deep[:, 1:], near[:, 1:], near[:, :-1]]
    for number, *row in zip(elements.ravel(), *(c.ravel() for c in corners), strict=True):
        lines.append(", ".join(str(v) for v in (number, *row)))
    return nodes, elements


def write_input(model: Model, path: Path) -> int:
    """Write the input file of a model; return the number of nodes."""
    x, z = coordinates(model)
    lines: list[str] = []
    column, depth = np.meshgrid(x, z)
    # The surface of the cylinder; rows above it are shifted less and less.
    fade = np.clip(1.0 - depth / (FAR * A), 0.0, 1.0)
    upper = np.stack([column, depth + fade * column**2 / (2.0 * R) - OVERLAP], -1)
    lower = np.stack([column, -depth], -1)
    top, of_top = write_block(lines, "UPPER", 1, upper, up=True)
    bottom, of_bottom = write_block(lines, "LOWER", top.size + 1, lower, up=False)
    coated = of_bottom[: int(np.searchsorted(z, THICKNESS * (1.0 - 1e-9)))]
    near = np.flatnonzero(np.abs(0.5 * (x[1:] + x[:-1])) < 1.25 * A)
    lines.append("*ELSET, ELSET=COATING")
    lines += [str(v) for v in coated.ravel()]
    lines.append("*ELSET, ELSET=SUBSTRATE, GENERATE")
    lines.append(f"{coated.max() + 1}, {of_bottom.max()}")
    for name, factor in (("STEEL", 1.0), ("FILM", model.ratio)):
        lines += [f"*MATERIAL, NAME={name}", "*ELASTIC", f"{factor * E:.12g}, {NU}"]
    for name, material in (("UPPER", "STEEL"), ("SUBSTRATE", "STEEL"), ("COATING", "FILM")):
        lines += [f"*SOLID SECTION, ELSET={name}, MATERIAL={material}", "1."]
    for name, row, face in (("SLAVE", of_top[0], "S1"), ("MASTER", of_bottom[0], "S3")):
        lines.append(f"*SURFACE, NAME={name}, TYPE=ELEMENT")
        lines += [f"{row[k]}, {face}" for k in near]
    lines += ["*SURFACE INTERACTION, NAME=TOUCH"]
    lines += ["*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{model.normal:g}, 0.01, 1e-8"]
    lines += ["*FRICTION", f"{MU}, {model.stick:g}"]
    lines += ["*CONTACT PAIR, INTERACTION=TOUCH, TYPE=SURFACE TO SURFACE", "SLAVE, MASTER"]
    # The top is rigid and does not turn.
    lines.append("*EQUATION")
    leader = int(top[-1, 0])
    for node in top[-1, 1:]:
        for axis in (1, 2):
            lines += ["2", f"{node}, {axis}, 1., {leader}, {axis}, -1."]
    lines.append("*NSET, NSET=HELD")
    lines += [str(v) for v in bottom[-1]]
    lines += ["*BOUNDARY", "HELD, 1, 2"]
    forces = [0.0, *(share * MU * W for share in BRANCHES)]
    for number, T in enumerate(forces):
        increments = model.press if number == 0 else model.branch
        lines += [f"*STEP, INC={1000 * increments}", "*STATIC"]
        lines += [f"{1.0 / increments:.9g}, 1., 1e-6, {1.0 / increments:.9g}"]
        if number == 0:
            # The top is kept from sliding while it is pressed.
            lines += ["*BOUNDARY", f"{leader}, 1, 1"]
        if number == 1:
            lines += ["*BOUNDARY, OP=NEW", "HELD, 1, 2"]
        lines += ["*CLOAD", f"{leader}, 2, {-W:.12g}"]
        if number:
            lines.append(f"{leader}, 1, {T:.12g}")
        lines += ["*NODE FILE, OUTPUT=2D, FREQUENCY=10000", "U"]
        lines += ["*CONTACT FILE, FREQUENCY=10000", "CDIS, CSTR", "*END STEP"]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")
    return int(top.size + bottom.size)


def read_tractions(path: Path) -> list[Tractions]:
    """Read pressure and shear of the pressed nodes of the cylinder, a step after the other."""
    places: dict[int, float] = {}
    blocks: list[dict[int, list[float]]] = []
    inside = ""
    for line in path.read_text().splitlines():
        if line.startswith("    2C"):
            inside = "nodes"
        elif line.startswith(" -4"):
            inside = line[3:].split()[0]
            if inside == "CONTACT":
                blocks.append({})
        elif line.startswith(" -3"):
            inside = ""
        elif line.startswith(" -1") and inside in ("nodes", "CONTACT"):
            node = int(line[3:13])
            row = [float(line[k : k + 12]) for k in range(13, len(line.rstrip()), 12)]
            if inside == "nodes":
                places[node] = row[0]
            else:
                blocks[-1][node] = row
    steps = []
    for block in blocks:
        rows = np.array([[places[node], *row] for node, row in block.items()])
        rows = rows[rows[:, 4] != 0.0]
        rows = rows[np.argsort(rows[:, 0])]
        # Columns: x, COPEN, CSLIP1, CSLIP2, CPRESS, CSHEAR1, CSHEAR2.
        steps.append(Tractions(rows[:, 0], rows[:, 4], rows[:, 5]))
    return steps


def run(model: Model, folder: Path) -> Run:
    """Run CalculiX in a folder on one thread."""
    nodes = write_input(model, folder / "job.inp")
    environment = os.environ | {"OMP_NUM_THREADS": "1"}
    with (folder / "job.log").open("w") as log:
        child = subprocess.Popen(["ccx", "job"], cwd=folder, stdout=log, env=environment)
        _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    text = (folder / "job.log").read_text()
    if "Job finished" not in text:
        raise RuntimeError(f"CalculiX ended without a solution: {text[-400:]}")
    steps = read_tractions(folder / "job.frd")
    return Run(steps, usage.ru_utime + usage.ru_stime, 1024 * usage.ru_maxrss, nodes)


def to_row(model: Model, result: Run) -> dict[str, Any]:
    """Return a run as plain numbers, the tractions near the contact alone."""
    steps = []
    for step in result.steps:
        near = np.abs(step.x) < FINE * A
        x, p, q = ([float(f"{v:.7g}") for v in values[near]] for values in step)
        steps.append({"x": x, "p": p, "q": q})
    numbers = {"seconds": result.seconds, "memory": result.memory, "nodes": result.nodes}
    return asdict(model) | numbers | {"steps": steps}
