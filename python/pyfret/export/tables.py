"""Tables of tractions and stresses that programs of finite elements read."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np

from pyfret._util.arrays import plain
from pyfret.export.frame import Frame
from pyfret.quantities import LayerStresses, Numbers, as_layers, quantities
from pyfret.subsurface import fields
from pyfret.subsurface.contact import loaded_by

if TYPE_CHECKING:
    import os
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from pyfret.run import State

__all__ = ["cells_of", "stress", "tractions"]

#: Cells without traction that are written around the contact: an interpolation ends at zero there.
MARGIN = 2
#: What a table may hold of the tractions, along the contact's axes.
TRACTIONS = ("p", "q_x", "q_y")
#: Components of the stress in a table.
STRESSES = ("s_xx", "s_yy", "s_zz", "s_xy", "s_xz", "s_yz")


def body_sign(body_number: int) -> float:
    """Return the sign of tractions on a body: 1 for body 2, -1 for body 1."""
    if body_number not in (1, 2):
        raise ValueError(f"body_number = {body_number}: must be 1 or 2")
    return 1.0 if body_number == 2 else -1.0


def cells_of(
    state: State, margin: int = 0
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Return x, y [m], p, and (q_x, q_y) [Pa] of the cells of the contact and a `margin`."""
    d = state.dataset
    p, q_x, q_y = (d[name].values for name in TRACTIONS)
    loaded = (p != 0.0) | (q_x != 0.0) | (q_y != 0.0)
    if not loaded.any():
        raise ValueError("nothing acts in this increment: there are no tractions to write")
    box = []
    for axis in (0, 1):
        where = np.flatnonzero(loaded.any(axis=1 - axis))
        box.append(slice(max(where[0] - margin, 0), where[-1] + margin + 1))
    x, y = np.meshgrid(d.x.values[box[0]], d.y.values[box[1]], indexing="ij")
    at = tuple(box)
    return x.ravel(), y.ravel(), p[at].ravel(), np.stack([q_x[at].ravel(), q_y[at].ravel()], -1)


@quantities
def tractions(
    state: State,
    path: str | os.PathLike[str],
    *,
    frame: Frame | None = None,
    body_number: int = 2,
    form: Literal["csv", "abaqus", "aster"] = "csv",
    of: Literal["p", "q_x", "q_y"] = "p",
) -> None:
    """Write the tractions of an increment as a table, a line for each cell around the contact.

    Parameters
    ----------
    state : Snapshot
        The increment, such as ``result.at(-1)``.
    path : path
        File to write; it must not exist.
    frame : Frame, optional
        Where the contact lies in the other model, and its units (default: the contact's own, SI).
    body_number : 1 or 2
        The body on which the tractions act.
    form : "csv", "abaqus" or "aster"
        ``"csv"``: with a head of names and units, as most programs take it. The columns are
        the place, ``p``, ``q_x``, ``q_y`` along the contact's axes and the vector ``t_1``, ``t_2``,
        ``t_3`` along the model's axes. ``"abaqus"``: place and one number, the point cloud of a
        mapped analytical field. ``"aster"``: the same columns as ``"csv"`` for ``LIRE_TABLE`` of
        code_aster.
    of : "p", "q_x" or "q_y"
        What ``"abaqus"`` writes. Shears are those along the contact's axes on the body.

    Raises
    ------
    FileExistsError
        There is something at the place.
    ValueError
        Nothing acts in the increment, or an argument is not one of those above.
    """
    frame = Frame() if frame is None else frame
    sign = body_sign(body_number)
    if form not in ("csv", "abaqus", "aster"):
        raise ValueError(f'form = {form!r}: must be "csv", "abaqus" or "aster"')
    if of not in TRACTIONS:
        raise ValueError(f"of = {of!r}: must be one of {', '.join(TRACTIONS)}")
    x, y, p, q = cells_of(state, MARGIN)
    points = frame.place(np.stack([x, y, np.zeros_like(x)], -1))
    vector = sign * frame.per_pascal * frame.vector(np.column_stack([q, p]))
    # Without the sign of zeros.
    along = frame.per_pascal * np.column_stack([p, sign * q]) + 0.0
    vector += 0.0
    if form == "abaqus":
        _write(path, "", np.column_stack([points, along[:, TRACTIONS.index(of)]]), ", ")
        return
    names = ("x", "y", "z", *TRACTIONS, "t_1", "t_2", "t_3")
    values = np.column_stack([points, along, vector])
    if form == "csv":
        _write(path, _head(names, frame), values, ",")
        return
    head = "\n".join(
        ("#DEBUT_TABLE", "#TITRE TRACTIONS", " ".join(names), " ".join("R" for _ in names))
    )
    _write(path, head, values, " ", end="#FIN_TABLE\n")


@quantities
def stress(
    state: State,
    points: Numbers,
    path: str | os.PathLike[str] | None = None,
    *,
    frame: Frame | None = None,
    body_number: int = 2,
    bulk: bool = True,
    residual: LayerStresses | None = None,
) -> NDArray[np.float64]:
    """Stress of a contact at the points of another model, and a table of it.

    Parameters
    ----------
    state : Snapshot
        The increment.
    points : array of shape (n, 3)
        Places in the model, in its unit of length; those outside the body are refused.
    path : path, optional
        CSV file to write, a line for each point: place and the six components along the model's
        axes, tension positive; it must not exist.
    frame, body_number
        As in :func:`tractions`.
    bulk : bool
        Whether the body's bulk stress is part of the stress.
    residual : sequence, optional
        Residual stress of every layer, as in :func:`pyfret.subsurface.stress`.

    Returns
    -------
    array of shape (n, 6)
        xx, yy, zz, xy, xz, yz along the model's axes, in its unit.
    """
    frame = Frame() if frame is None else frame
    sign = body_sign(body_number)
    places = np.atleast_2d(plain(points, "points"))
    if places.ndim != 2 or places.shape[1] != 3 or not np.isfinite(places).all():
        raise ValueError(f"points of shape {np.shape(points)}: must be finite, of shape (n, 3)")
    at = frame.contact_place(places)
    # Depth is counted into the body; a point on the surface may be off by the rounding of a mesh.
    depth = sign * at[:, 2]
    rounding = 1e-9 * (1.0 + np.abs(at).max()) * state.length
    if (depth < -rounding).any():
        n = int(np.argmin(depth))
        raise ValueError(f"point {n}, {places[n].tolist()}: lies outside body {body_number}")
    depth = np.maximum(depth, 0.0)
    body = state.body(body_number)
    tops = np.concatenate([[0.0], fields.interfaces(body)])
    layer = np.searchsorted(tops, depth, side="right") - 1
    below = loaded_by(state, body_number, bulk=bulk, residual=as_layers(residual))
    wanted_points = [
        (x, y, z, n)
        for x, y, z, n in zip(
            at[:, 0].tolist(), at[:, 1].tolist(), depth.tolist(), layer.tolist(), strict=True
        )
    ]
    stresses = below.points(wanted_points)
    xx, yy, zz, xy, xz, yz = np.asarray(stresses).T
    tensor = np.stack([xx, xy, xz, xy, yy, yz, xz, yz, zz], -1).reshape(-1, 3, 3)
    tensor = frame.stress(tensor)
    values = tensor[:, [0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    if path is not None:
        _write(
            path, _head(("x", "y", "z", *STRESSES), frame), np.column_stack([places, values]), ","
        )
    return values


def _head(names: Sequence[str], frame: Frame) -> str:
    """The head of a CSV table: each name with its unit in the model."""
    units = (frame.unit if name in ("x", "y", "z") else frame.unit_of_stress for name in names)
    return ",".join(f"{name} [{unit}]" for name, unit in zip(names, units, strict=True))


def _write(
    path: str | os.PathLike[str],
    head: str,
    values: NDArray[np.float64],
    delimiter: str,
    *,
    end: str = "",
) -> None:
    """Write a table to a file that is not there yet."""
    with Path(path).open("x", encoding="ascii", newline="\n") as file:
        if head:
            file.write(head + "\n")
        np.savetxt(file, values, fmt="%.9g", delimiter=delimiter)
        file.write(end)
