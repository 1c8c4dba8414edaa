"""What a model of the component says to the contact: bulk stress and compliance."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from pyfret._core import read_text
from pyfret._util.door import numbers_only
from pyfret.export.foreign import read_by_meshio
from pyfret.export.frame import Frame
from pyfret.export.numbers import numbers

if TYPE_CHECKING:
    import os
    from collections.abc import Iterator

    from numpy.typing import NDArray

__all__ = ["bulk_stress", "compliance", "nodal"]

#: Digits of the numbers of nodes, by the format of a block.
WIDTHS = {"0": 5, "1": 10}
#: Letters of the head of a block before its format; some programs leave the format out.
SHORT = 58
#: Numbers in a row of a block of results.
COMPONENTS = {"STRESS": 6, "DISP": 3}
#: Nearest nodes that a value at the contact is taken from.
NEAREST = 8
#: Order of the components xx, yy, zz, xy, yz, zx of a stress of CalculiX as a matrix.
FRD = (0, 3, 5, 3, 1, 4, 5, 4, 2)
#: The same of xx, yy, zz, xy, xz, yz.
VOIGT = (0, 3, 4, 3, 1, 5, 4, 5, 2)


@numbers_only
def bulk_stress(
    path: str | os.PathLike[str], *, frame: Frame | None = None, field: str = "stress"
) -> float:
    """Bulk stress along the contact's x at the contact, from the results of another program [Pa].

    The component is computed without the contact. The stress at the middle of the grid is a mean
    over the nearest nodes. Its weights are the inverse squares of their distances.

    Parameters
    ----------
    path : path
        ``.frd`` of CalculiX: ``*NODE FILE`` S, the last step. ``.dat`` of CalculiX: ``*EL PRINT``
        S, the mean over the points printed last. Or a mesh that meshio reads with a stress at its
        nodes. It has six components xx, yy, zz, xy, xz, yz, or nine.
    frame : Frame, optional
        Where the contact lies in the model, and its units.
    field : str
        Name of the stress in the files of meshio; of a ``.dat`` with several sets, the set.

    Returns
    -------
    float
        ``sigma_B`` of :meth:`pyfret.LoadPath.bulk`, tension positive.
    """
    frame = Frame() if frame is None else frame
    place = Path(path)
    if place.suffix.lower() == ".dat":
        stress = _printed(place, field)[:, VOIGT].mean(axis=0).reshape(3, 3)
    else:
        points, values = nodal(place, "STRESS", field)
        order = FRD if place.suffix.lower() == ".frd" else VOIGT
        matrices = values if values.shape[1] == 9 else values[:, order]
        stress = _at_contact(points, matrices, frame).reshape(3, 3)
    return float(frame.contact_stress(stress)[0, 0])


@numbers_only
def compliance(
    path: str | os.PathLike[str],
    force: float,
    *,
    frame: Frame | None = None,
    field: str = "displacement",
) -> float:
    """Compliance of the component along the contact's x at the contact [m/N].

    Its inverse is the ``rig_stiffness`` of a rig that drives through it.

    Parameters
    ----------
    path : path
        As in :func:`bulk_stress`, with displacements (``*NODE FILE`` U).
    force : float
        Force along x that the model was loaded with at the contact [N].
    frame, field
        As in :func:`bulk_stress`.
    """
    frame = Frame() if frame is None else frame
    if not np.isfinite(force) or force == 0.0:
        raise ValueError(f"force = {force}: must be a finite force other than zero, in N")
    points, values = nodal(Path(path), "DISP", field)
    shift = _at_contact(points, values[:, :3], frame) @ frame.axes[0]
    return float(shift / frame.per_metre / force)


def _at_contact(
    points: NDArray[np.float64], values: NDArray[np.float64], frame: Frame
) -> NDArray[np.float64]:
    """A field at the middle of the grid, from the nodes around."""
    distance = np.linalg.norm(points - np.asarray(frame.origin), axis=1)
    near = np.argsort(distance, kind="stable")[:NEAREST]
    extent = np.ptp(points, axis=0).max()
    if distance[near[0]] > extent:
        raise ValueError(
            f"the nearest node is {distance[near[0]]:.3g} {frame.unit} from the contact, farther "
            "than the model is long: frame.origin must be in the model's unit of length"
        )
    weight = 1.0 / np.maximum(distance[near], 1e-9 * extent) ** 2
    return np.asarray(weight @ values[near] / weight.sum())


def nodal(
    path: Path, block: str, field: str = ""
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Nodes and a field on them: `block` of a ``.frd``, `field` of what meshio reads."""
    if path.suffix.lower() == ".frd":
        return _read_frd(path, block)
    mesh = read_by_meshio(path)
    if field not in mesh.point_data:
        known = ", ".join(mesh.point_data) or "none"
        raise ValueError(f"{path}: has no field {field!r} at its nodes; it has {known}")
    points = np.zeros((len(mesh.points), 3))
    points[:, : mesh.points.shape[1]] = mesh.points
    return points, np.asarray(mesh.point_data[field], float).reshape(len(points), -1)


def _read_frd(path: Path, block: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Nodes and the last field of a name of a text ``.frd`` file.

    CalculiX GraphiX manual, "frd: Result Format": the head of a block ends with its format. Format
    0 has numbers of nodes of five digits, format 1 of ten. The others are binary.
    """
    points: dict[int, list[float]] = {}
    found: dict[int, list[float]] = {}
    width = 10
    lines = iter(enumerate(read_text(path).splitlines(), 1))
    for _, line in lines:
        if line.startswith(("    2C", "  100C", "    3C")):
            width = _width(line, path)
        if line.startswith("    2C"):
            points = _rows(lines, path, width, 3)
        elif line.startswith(" -4") and line[3:].split()[:1] == [block]:
            found = _rows(lines, path, width, COMPONENTS[block])
    if not points or not found:
        what = "nodes" if not points else f"block {block}"
        raise ValueError(f"{path}: has no {what}; *NODE FILE writes it, as text")
    numbers = [number for number in points if number in found]
    return np.array([points[n] for n in numbers]), np.array([found[n] for n in numbers])


def _width(line: str, path: Path) -> int:
    """Digits of the numbers of nodes of a block."""
    last = (line[SHORT:].split() or ["1"])[-1]
    if last not in WIDTHS:
        raise ValueError(f"{path}: a block has the format {last}: must be 0 or 1, which are text")
    return WIDTHS[last]


def _rows(
    lines: Iterator[tuple[int, str]], path: Path, width: int, components: int
) -> dict[int, list[float]]:
    """The rows of a block up to its end, by the number of their nodes."""
    rows: dict[int, list[float]] = {}
    for n, line in lines:
        if line.startswith(" -3"):
            return rows
        if not line.startswith(" -1"):
            continue
        try:
            values = numbers(line[3 + width :])
            if len(values) != components:
                raise ValueError(f"{len(values)} numbers: must have {components}")
            rows[int(line[3 : 3 + width])] = values
        except ValueError as error:
            raise ValueError(f"{path}, line {n}: {error}") from error
    raise ValueError(f"{path}: ends within a block")


def _printed(path: Path, of: str) -> NDArray[np.float64]:
    """The stresses that ``*EL PRINT`` wrote last for a set, shape (points, 6).

    `of` is the set, needed where there are several.
    """
    blocks: dict[str, list[list[float]]] = {}
    rows: list[list[float]] | None = None
    for n, line in enumerate(read_text(path).splitlines(), 1):
        words = line.split()
        if line.strip().startswith("stresses (elem"):
            head = re.search(r"for set (.+?) and time", line)
            name = head[1].strip() if head else ""
            # Later times take the place of earlier ones.
            rows = blocks[name] = []
        elif rows is not None and words and words[0].isdigit():
            try:
                rows.append(_point(line))
            except ValueError as error:
                raise ValueError(f"{path}, line {n}: {error}") from error
        elif words:
            rows = None
    if not any(blocks.values()):
        raise ValueError(f"{path}: has no stresses of elements; *EL PRINT with S writes them")
    if len(blocks) == 1:
        return np.array(next(iter(blocks.values())))
    if of not in blocks or not blocks[of]:
        raise ValueError(
            f"{path}: has stresses of {len(blocks)} sets, {', '.join(blocks)}: say which with "
            f"field={next(iter(blocks))!r}"
        )
    return np.array(blocks[of])


def _point(line: str) -> list[float]:
    """The stress at a point of integration: element, point, six numbers."""
    found = re.fullmatch(r"\s*\d+\s+\d+\s(.*?)(\s+[A-Za-z_]\S*)?\s*", line)
    if found is None:
        raise ValueError(f"{line.strip()!r}: must be element, point and six stresses")
    if found[2]:
        raise ValueError(f"stresses along the axes {found[2].strip()}: print them with GLOBAL=YES")
    values = numbers(found[1])
    if len(values) != 6:
        raise ValueError(f"{len(values)} stresses: must be six")
    return values
