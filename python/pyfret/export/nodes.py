"""Forces on the nodes of a mesh that act like the tractions of a contact."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from pyfret._util.arrays import plain
from pyfret.export.frame import Frame
from pyfret.export.meshes import faces_in_plane, read_mesh
from pyfret.export.tables import body_sign, cells_of
from pyfret.quantities import Numbers, quantities

if TYPE_CHECKING:
    import os
    from collections.abc import Sequence

    from numpy.typing import ArrayLike, NDArray

    from pyfret.run import State

__all__ = ["loads", "nodal_forces"]

#: A cell is cut so that its parts are at most this part of the shortest side of a face.
PART = 0.5
#: Most parts that a side of a cell is cut into.
MOST = 8
#: Newton steps to a point's place in a face; a parallelogram takes one.
STEPS = 8
#: How far a point may lie outside a face, in the coordinates of the face.
OUTSIDE = 1e-9
#: Part of the load that may lie outside all faces: rounding.
LOST = 1e-9
#: Nodes of a triangle, a quadrilateral, and of those with nodes between the corners.
NODES = (3, 4, 6, 8)


def checked(rows: ArrayLike, nodes: int) -> NDArray[np.int64]:
    """Return the nodes of faces of one kind; a ValueError if an index is no node."""
    node_rows = np.asarray(plain(rows, "faces"), dtype=np.int64)
    if node_rows.size and (node_rows.ndim != 2 or node_rows.shape[1] not in NODES):
        raise ValueError(
            f"faces: an array of the shape {node_rows.shape}: must be (faces, nodes of each), "
            f"with {', '.join(map(str, NODES))} nodes"
        )
    if node_rows.size and not (node_rows.min() >= 0 and node_rows.max() < nodes):
        raise ValueError(f"faces: indices of nodes must be from 0 to {nodes - 1}")
    return node_rows


@quantities
def nodal_forces(
    state: State,
    points: Numbers,
    faces: Sequence[ArrayLike],
    *,
    frame: Frame | None = None,
    body_number: int = 2,
) -> NDArray[np.float64]:
    """Forces on nodes that do the same work on the faces as the tractions.

    Each cell lies in a face. The shape functions N_i of this face share the cell's force among its
    nodes: F_i = sum over the cells of t A N_i. Sums of forces and moments agree with the contact,
    whatever the sizes of cells and faces.

    Parameters
    ----------
    state : Snapshot
        The increment.
    points : array of shape (n, 3)
        Nodes, in the model's unit of length.
    faces : sequence of arrays of shape (m, 3), (m, 6), (m, 4) or (m, 8)
        Indices of the nodes of triangles and quadrilaterals, corners in turn, then those between
        them in turn; in the plane of the contact.
    frame, body_number
        As in :func:`tractions`.

    Returns
    -------
    array of shape (n, 3)
        Forces along the model's axes [N]; in plane strain forces per metre [N/m].

    Raises
    ------
    ValueError
        Part of the loaded cells lies outside the faces.
    """
    frame = Frame() if frame is None else frame
    sign = body_sign(body_number)
    nodes = plain(points, "points")
    if nodes.ndim != 2 or nodes.shape[1] != 3:
        raise ValueError(f"points has the shape {nodes.shape}: must be (n, 3), a row for each node")
    at = frame.contact_place(nodes)[:, :2]
    tables = [checked(rows, len(nodes)) for rows in faces]
    if not any(rows.size for rows in tables):
        raise ValueError("no face of the mesh lies in the plane z = 0 of the frame")
    grid = state.scene.grid
    x, y, p, q = cells_of(state)
    shortest = min(float(_side_lengths(at, rows).min()) for rows in tables if rows.size)
    if shortest == 0:
        raise ValueError("faces: one has two nodes at one place: must have sides of some length")
    parts = int(np.clip(np.ceil(max(grid.dx, grid.dy) / (PART * shortest)), 1, MOST))
    cut = (np.arange(parts) + 0.5) / parts - 0.5
    s, t = (v.ravel() for v in np.meshgrid(cut * grid.dx, cut * grid.dy, indexing="ij"))
    quadrature_points = np.stack([(x[:, None] + s).ravel(), (y[:, None] + t).ravel()], -1)
    area = grid.dx * grid.dy / parts**2
    force = np.repeat(sign * area * frame.vector(np.column_stack([q, p])), parts**2, axis=0)
    carried = np.zeros(len(quadrature_points), dtype=bool)
    forces = np.zeros_like(nodes)
    for rows in tables:
        for row in rows:
            _give(forces, carried, quadrature_points, force, row, at[row])
    lost = np.linalg.norm(force[~carried], axis=1).sum()
    if lost > LOST * np.linalg.norm(force, axis=1).sum():
        share = lost / np.linalg.norm(force, axis=1).sum()
        raise ValueError(
            f"{share:.1%} of the load lies outside the faces of the mesh in the plane of the "
            "contact. The mesh must reach beyond the contact. Check its place in frame"
        )
    return forces


@quantities
def loads(
    state: State,
    mesh: str | os.PathLike[str],
    path: str | os.PathLike[str],
    *,
    frame: Frame | None = None,
    body_number: int = 2,
) -> NDArray[np.float64]:
    """Write the forces on the nodes of a mesh as ``*CLOAD`` for CalculiX and Abaqus.

    The faces of the mesh lie in the plane of the contact, z = 0 of `frame`. A step takes the
    file by ``*INCLUDE``.

    Parameters
    ----------
    mesh : path
        An ``.inp`` file with ``*NODE`` and ``*ELEMENT`` (tetrahedra, wedges, hexahedra, linear or
        quadratic), in an assembly with its instances, or a format of :data:`FORMATS` that meshio
        reads. Keywords that move or generate nodes in other ways are refused by name.
    path : path
        File to write; it must not exist.
    state, frame, body_number
        As in :func:`nodal_forces`.

    Returns
    -------
    array of shape (n, 3)
        The forces [N] on the nodes in the order of the mesh.
    """
    frame = Frame() if frame is None else frame
    if state.scene.grid.plane_strain:
        raise ValueError("a line contact has no mesh of volumes: export its tractions as a table")
    read = read_mesh(mesh)
    forces = nodal_forces(
        state, read.points, faces_in_plane(read, frame), frame=frame, body_number=body_number
    )
    total = ", ".join(f"{component:.6g}" for component in forces.sum(axis=0))
    with Path(path).open("x", encoding="ascii", newline="\n") as file:
        file.write(f"** forces of a contact on body {body_number}, in all {total} N\n*CLOAD\n")
        for name, force in zip(read.names, forces.tolist(), strict=True):
            for axis, component in enumerate(force, 1):
                if component != 0.0:
                    file.write(f"{name}, {axis}, {component:.12g}\n")
    return forces


def _corners(rows: NDArray[np.int64]) -> int:
    """Return how many corners a face with so many nodes has."""
    count = rows.shape[-1]
    if count not in (3, 4, 6, 8):
        raise ValueError(f"faces of {count} nodes: must have 3, 6, 4 or 8")
    return 3 if count in (3, 6) else 4


def _side_lengths(at: NDArray[np.float64], rows: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return the lengths of the sides of faces [m]."""
    corners = at[rows[:, : _corners(rows)]]
    return np.asarray(np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2))


def _give(
    forces: NDArray[np.float64],
    carried: NDArray[np.bool_],
    place: NDArray[np.float64],
    force: NDArray[np.float64],
    row: NDArray[np.int64],
    corners: NDArray[np.float64],
) -> None:
    """Distribute the forces at places in a face, which no other face carries yet, to its nodes."""
    corners = corners[: _corners(row)]
    low, high = corners.min(axis=0), corners.max(axis=0)
    room = OUTSIDE * (high - low)
    near = ((place >= low - room) & (place <= high + room)).all(axis=1) & ~carried
    inside = np.flatnonzero(near)
    if inside.size == 0:
        return
    local = _local(place[inside], corners)
    is_inside = _is_inside(local, len(corners))
    inside, local = inside[is_inside], local[is_inside]
    carried[inside] = True
    for node, shape in zip(row.tolist(), _shapes(local, row.size), strict=True):
        forces[node] += shape @ force[inside]


def _is_inside(local: NDArray[np.float64], corners: int) -> NDArray[np.bool_]:
    """Return which places lie in the face, by their coordinates in it."""
    if corners == 3:
        areas = np.column_stack([local, 1.0 - local.sum(axis=1)])
        return np.asarray((areas >= -OUTSIDE).all(axis=1))
    return np.asarray((np.abs(local) <= 1.0 + OUTSIDE).all(axis=1))


def _local(place: NDArray[np.float64], corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return coordinates in a face: of areas in a triangle, -1 to 1 in a quadrilateral."""
    if len(corners) == 3:
        edges = np.column_stack([corners[1] - corners[0], corners[2] - corners[0]])
        return np.linalg.solve(edges, (place - corners[0]).T).T
    local = np.zeros_like(place)
    for _ in range(STEPS):
        r, s = local.T
        shapes = _shapes(local, 4)
        missing = place - np.einsum("ik,ij->kj", shapes, corners)
        along_r = np.array([-(1 - s), 1 - s, 1 + s, -(1 + s)]) / 4
        along_s = np.array([-(1 - r), -(1 + r), 1 + r, 1 - r]) / 4
        slopes = np.stack([along_r.T @ corners, along_s.T @ corners], axis=-1)
        local = local + np.linalg.solve(slopes, missing[..., None])[..., 0]
    return local


def _shapes(local: NDArray[np.float64], nodes: int) -> NDArray[np.float64]:
    """Compute the shape functions of faces with straight sides, shape (nodes, places)."""
    r, s = local.T
    if nodes in (3, 6):
        areas = np.array([1.0 - r - s, r, s])
        if nodes == 3:
            return areas
        a, b, c = areas
        return np.array([*(2 * v * v - v for v in areas), 4 * a * b, 4 * b * c, 4 * c * a])
    signs = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    bilinear = np.array([(1 + i * r) * (1 + j * s) / 4 for i, j in signs])
    if nodes == 4:
        return bilinear
    corner = [n * (i * r + j * s - 1) for n, (i, j) in zip(bilinear, signs.tolist(), strict=True)]
    along_r, along_s = 1 - r * r, 1 - s * s
    between = [along_r * (1 - s), along_s * (1 + r), along_r * (1 + s), along_s * (1 - r)]
    return np.array([*corner, *(v / 2 for v in between)])
