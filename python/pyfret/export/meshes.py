"""Meshes of finite elements: nodes with their numbers, and faces that lie in a plane."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from pyfret.export.foreign import FORMATS, is_keyword_file, read_by_meshio
from pyfret.export.inp import read_parts

if TYPE_CHECKING:
    import os

    from numpy.typing import NDArray

    from pyfret.export.frame import Frame
    from pyfret.export.inp import Part

__all__ = ["Mesh", "faces_in_plane", "read_mesh"]

#: Faces of a tetrahedron, a wedge and a hexahedron: corners in turn, then the nodes between them.
#: Linear elements have the first part of each, quadratic ones all of it.
TETRAHEDRON = ((0, 1, 2, 4, 5, 6), (0, 3, 1, 7, 8, 4), (1, 3, 2, 8, 9, 5), (2, 3, 0, 9, 7, 6))
WEDGE = (
    (0, 1, 2, 6, 7, 8),
    (3, 5, 4, 11, 10, 9),
    (0, 3, 4, 1, 12, 9, 13, 6),
    (1, 4, 5, 2, 13, 10, 14, 7),
    (2, 5, 3, 0, 14, 11, 12, 8),
)
HEXAHEDRON = (
    (0, 1, 2, 3, 8, 9, 10, 11),
    (4, 7, 6, 5, 15, 14, 13, 12),
    (0, 4, 5, 1, 16, 12, 17, 8),
    (1, 5, 6, 2, 17, 13, 18, 9),
    (2, 6, 7, 3, 18, 14, 19, 10),
    (3, 7, 4, 0, 19, 15, 16, 11),
)
#: By nodes of an element.
FACES = {4: TETRAHEDRON, 10: TETRAHEDRON, 6: WEDGE, 15: WEDGE, 8: HEXAHEDRON, 20: HEXAHEDRON}
#: Elements without volume, whose faces are themselves: triangles and quadrilaterals of meshio.
PLANE = ("triangle", "triangle6", "quad", "quad8")
#: Distance from the plane of a face in it, over the extent of the mesh.
IN_PLANE = 1e-6


class Mesh(NamedTuple):
    """Nodes and elements of a mesh."""

    #: Name of each node: its number, in an assembly behind its instance, ``Block-1.7``.
    names: list[str]
    #: Places of the nodes, shape (n, 3).
    points: NDArray[np.float64]
    #: Elements as rows of node indices, by their number of nodes; volumes.
    volumes: list[NDArray[np.int64]]
    #: Faces given as elements.
    faces: list[NDArray[np.int64]]


def read_mesh(path: str | os.PathLike[str]) -> Mesh:
    """Read the mesh of an ``.inp`` file of Abaqus or CalculiX, or of a format that meshio reads.

    Keywords of Abaqus are read under the other endings, too: CalculiX GraphiX writes ``.msh``.
    Nodes of an ``.inp`` keep their numbers, in an assembly behind the name of their instance; those
    of other formats count from 1.
    """
    file = Path(path)
    if file.suffix.lower() == ".inp" or (file.suffix.lower() in FORMATS and is_keyword_file(file)):
        return joined(read_parts(file), file)
    mesh = read_by_meshio(file)
    points = np.zeros((len(mesh.points), 3))
    points[:, : mesh.points.shape[1]] = mesh.points
    blocks = [(block.type, np.asarray(block.data, np.int64)) for block in mesh.cells]
    volumes = [data for name, data in blocks if name not in PLANE and data.shape[1] in FACES]
    faces = [data for name, data in blocks if name in PLANE]
    return Mesh([str(n + 1) for n in range(len(points))], points, volumes, faces)


def joined(parts: list[Part], path: Path) -> Mesh:
    """Join the parts of a file to one mesh."""
    names: list[str] = []
    points: list[NDArray[np.float64]] = []
    volumes: dict[int, list[NDArray[np.int64]]] = {}
    faces: dict[int, list[NDArray[np.int64]]] = {}
    for part in parts:
        numbers = np.array(part.numbers, dtype=np.int64)
        order = np.argsort(numbers, kind="stable")
        twice = np.flatnonzero(np.diff(numbers[order]) == 0)
        if twice.size:
            raise ValueError(f"{path}: the node {numbers[order][twice[0]]} stands there twice")
        for rows, found in ((part.volumes, volumes), (part.faces, faces)):
            for count in sorted({len(row) - 1 for row in rows}):
                if ((found is volumes) and count not in FACES) or count < 3:
                    continue
                node_numbers = np.array([row[1:] for row in rows if len(row) == count + 1])
                at = np.searchsorted(numbers, node_numbers, sorter=order)
                positions = order[np.minimum(at, numbers.size - 1)]
                if (numbers[positions] != node_numbers).any():
                    missing = node_numbers[numbers[positions] != node_numbers][0]
                    raise ValueError(
                        f"{path}: an element has the node {missing}, which *NODE lacks"
                    )
                found.setdefault(count, []).append(positions + len(names))
        names += [f"{part.prefix}{n}" for n in part.numbers]
        points.append(np.array(part.points).reshape(-1, 3))
    kept = {count: rows for count, rows in faces.items() if count in (3, 4, 6, 8)}
    return Mesh(
        names,
        np.concatenate(points),
        [np.concatenate(rows) for _, rows in sorted(volumes.items())],
        [np.concatenate(rows) for _, rows in sorted(kept.items())],
    )


def faces_in_plane(mesh: Mesh, frame: Frame) -> list[NDArray[np.int64]]:
    """Return the faces of elements that lie in the plane of the contact, rows of node indices."""
    height = frame.contact_place(mesh.points)[:, 2]
    extent = np.ptp(frame.contact_place(mesh.points), axis=0).max()
    inside = np.abs(height) <= IN_PLANE * extent
    faces: dict[int, list[NDArray[np.int64]]] = {}
    for elements in mesh.volumes:
        count = elements.shape[1]
        quadratic = count in (10, 15, 20)
        for face in FACES[count]:
            used = face if quadratic else face[: len(face) // 2]
            rows = elements[:, used]
            kept = rows[inside[rows].all(axis=1)]
            faces.setdefault(kept.shape[1], []).append(kept)
    for rows in mesh.faces:
        faces.setdefault(rows.shape[1], []).append(rows[inside[rows].all(axis=1)])
    whole = [np.concatenate(rows) for rows in faces.values()]
    # The same face may be given by an element and as an element of its own.
    once = [rows[np.unique(np.sort(rows, axis=1), axis=0, return_index=True)[1]] for rows in whole]
    return [rows for rows in once if rows.size]
