"""What a model of the component says to the contact: bulk stress and compliance."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from pyfret.export.frame import Frame

if TYPE_CHECKING:
    import os
    from collections.abc import Iterator

    from numpy.typing import NDArray

__all__ = ["bulk_stress", "compliance", "nodal"]

#: Nearest nodes that a value at the contact is taken from.
NEAREST = 8
#: Order of the components xx, yy, zz, xy, yz, zx of a stress of CalculiX as a matrix.
FRD = (0, 3, 5, 3, 1, 4, 5, 4, 2)
#: The same of xx, yy, zz, xy, xz, yz.
VOIGT = (0, 3, 4, 3, 1, 5, 4, 5, 2)


def bulk_stress(
    path: str | os.PathLike[str], *, frame: Frame | None = None, field: str = "stress"
) -> float:
    """Bulk stress along the contact's x at the contact, from the results of another program [Pa].

    The component is computed without the contact; the stress at the middle of the grid is that of
    the nearest nodes, weighted by the inverse squares of their distances.

    Parameters
    ----------
    path : path
        ``.frd`` of CalculiX (``*NODE FILE`` S, the last step), ``.dat`` of CalculiX (``*EL PRINT``
        S: the mean over the points printed), or any mesh that meshio reads with a stress at its
        nodes: six components xx, yy, zz, xy, xz, yz, or nine.
    frame : Frame, optional
        Where the contact lies in the model, and its units.
    field : str
        Name of the stress in the files of meshio.

    Returns
    -------
    float
        ``sigma_B`` of :meth:`pyfret.LoadPath.bulk`, tension positive.
    """
    frame = Frame() if frame is None else frame
    place = Path(path)
    if place.suffix.lower() == ".dat":
        stress = _printed(place)[:, VOIGT].mean(axis=0).reshape(3, 3)
    else:
        points, values = nodal(place, "STRESS", field)
        order = FRD if place.suffix.lower() == ".frd" else VOIGT
        matrices = values if values.shape[1] == 9 else values[:, order]
        stress = _at_contact(points, matrices, frame).reshape(3, 3)
    return float(frame.contact_stress(stress)[0, 0])


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
    try:
        import meshio
    except ModuleNotFoundError as absent:
        message = 'results other than .frd and .dat need meshio: pip install "fretting[mesh]"'
        raise ModuleNotFoundError(message, name="meshio") from absent
    mesh = meshio.read(path)
    if field not in mesh.point_data:
        known = ", ".join(mesh.point_data) or "none"
        raise ValueError(f"{path}: has no field {field!r} at its nodes; it has {known}")
    points = np.zeros((len(mesh.points), 3))
    points[:, : mesh.points.shape[1]] = mesh.points
    return points, np.asarray(mesh.point_data[field], float).reshape(len(points), -1)


def _read_frd(path: Path, block: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Nodes and the last field of a name of a text ``.frd`` file."""
    points: dict[int, list[float]] = {}
    found: dict[int, list[float]] = {}
    lines = iter(path.read_text(encoding="latin-1").splitlines())
    for line in lines:
        if line.startswith("    2C"):
            points = dict(_rows(lines, path))
        elif line.startswith(" -4") and line[3:].split()[0] == block:
            found = dict(_rows(lines, path))
    if not points or not found:
        what = "nodes" if not points else f"block {block}"
        raise ValueError(f"{path}: has no {what}; *NODE FILE writes it, as text")
    numbers = [number for number in points if number in found]
    return np.array([points[n] for n in numbers]), np.array([found[n] for n in numbers])


def _rows(lines: Iterator[str], path: Path) -> Iterator[tuple[int, list[float]]]:
    """The rows of a block up to its end: number of the node and columns of twelve characters."""
    for line in lines:
        if line.startswith(" -3"):
            return
        if not line.startswith(" -1"):
            continue
        try:
            values = [float(line[k : k + 12]) for k in range(13, len(line.rstrip()), 12)]
            yield int(line[3:13]), values
        except ValueError as error:
            raise ValueError(f"{path}: {line!r}: {error}") from error


def _printed(path: Path) -> NDArray[np.float64]:
    """The stresses of the last block that ``*EL PRINT`` wrote, shape (points, 6)."""
    blocks: list[list[list[float]]] = []
    reading = False
    for line in path.read_text(encoding="latin-1").splitlines():
        fields = line.split()
        if line.strip().startswith("stresses (elem"):
            blocks.append([])
            reading = True
        elif reading and len(fields) >= 8:
            blocks[-1].append([float(value) for value in fields[2:8]])
        elif fields:
            reading = False
    if not blocks or not blocks[-1]:
        raise ValueError(f"{path}: has no stresses of elements; *EL PRINT with S writes them")
    return np.array(blocks[-1])
