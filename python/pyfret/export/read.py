"""Bulk stress and compliance at the contact from a model of the component."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from pyfret.export.components import EQUAL, ORDERS, ROWS, read_order, to_matrices, to_vectors
from pyfret.export.dat import read_printed
from pyfret.export.foreign import read_by_meshio, read_component_names
from pyfret.export.frame import Frame
from pyfret.export.frd import read_frd
from pyfret.quantities import Force, as_number, quantities

if TYPE_CHECKING:
    import os
    from collections.abc import Sequence

    from numpy.typing import NDArray

__all__ = ["bulk_stress", "compliance"]

#: Nearest nodes that a value at the contact is taken from.
NEAREST = 8


@quantities
def bulk_stress(
    path: str | os.PathLike[str],
    *,
    frame: Frame | None = None,
    field: str = "stress",
    step: int | str | None = None,
    components: Sequence[str] | None = None,
) -> float:
    """Bulk stress along the contact's x at the contact, from the results of another program [Pa].

    The component is computed without the contact. The stress at the middle of the grid is a mean
    over the nearest nodes. Its weights are the inverse squares of their distances.

    Parameters
    ----------
    path : path
        ``.frd`` of CalculiX: ``*NODE FILE`` S. ``.dat`` of CalculiX: ``*EL PRINT`` S, the mean over
        the points. Or a mesh that meshio reads, with a stress of six or nine components at its
        nodes.
    frame : Frame, optional
        Where the contact lies in the model, and its units.
    field : str
        Name of the stress in the files of meshio; of a ``.dat`` with several sets, the set.
    step : int or str, optional
        Which increment of a ``.frd`` or ``.dat``: the number of a step, for its last one, or a
        label such as ``"time 0.5"`` or ``"mode 1"``. Default: the last one under load. Modes of
        vibration and of buckling are no loads. A run that did not converge is refused.
    components : sequence of str, optional
        Order of the components of the stress, such as ``("xx", "yy", "zz", "xy", "yz", "xz")``.
        Default: the names in the file. Six components without names are refused if the orders of
        Abaqus and VTK give different results.

    Returns
    -------
    float
        ``sigma_B`` of :meth:`pyfret.LoadPath.bulk`, tension positive.
    """
    frame = Frame() if frame is None else frame
    source = Path(path)
    ending = source.suffix.lower()
    if ending in (".dat", ".frd"):
        if ending == ".dat":
            stress = read_printed(source, field, step).mean(axis=0)
        else:
            stress = _at_contact(*read_frd(source, "STRESS", step), frame)
        return float(frame.contact_stress(stress)[0, 0])
    points, values = _nodal(source, field, step)
    mean = _at_contact(points, values, frame)[None]
    results: dict[str, float] = {}
    for name, order in _orders(source, field, mean.shape[1], components).items():
        try:
            matrix = to_matrices(mean, order)[0]
        except ValueError as error:
            raise ValueError(f"{source}: {field}: {error}") from error
        results[name] = float(frame.contact_stress(matrix)[0, 0])
    result = next(iter(results.values()))
    limit = EQUAL * float(np.abs(mean).max()) / frame.per_pascal
    if any(abs(value - result) > limit for value in results.values()):
        listed = ", ".join(
            f"{value:.5g} Pa as {' '.join(ORDERS[name])} ({name})"
            for name, value in results.items()
        )
        raise ValueError(
            f"{source}: {field} has six components without names, which gives {listed}: give the "
            f"order, as in components={ORDERS['VTK']}"
        )
    return result


@quantities
def compliance(
    path: str | os.PathLike[str],
    force: Force,
    *,
    frame: Frame | None = None,
    field: str = "displacement",
    step: int | str | None = None,
) -> float:
    """Compliance of the component along the contact's x at the contact [m/N].

    Its inverse is the ``rig_stiffness`` of a rig that drives through it.

    Parameters
    ----------
    path : path
        As in :func:`bulk_stress`, with displacements (``*NODE FILE`` U).
    force : float
        Force along x that the model was loaded with at the contact [N].
    frame, field, step
        As in :func:`bulk_stress`.
    """
    frame, force = Frame() if frame is None else frame, as_number(force)
    if not np.isfinite(force) or force == 0.0:
        raise ValueError(f"force = {force}: must be a finite force other than zero, in N")
    source = Path(path)
    if source.suffix.lower() == ".frd":
        points, values = read_frd(source, "DISP", step)
    else:
        points, values = _nodal(source, field, step)
        try:
            values = to_vectors(values, read_component_names(source, field))
        except ValueError as error:
            raise ValueError(f"{source}: {field}: {error}") from error
    shift = _at_contact(points, values, frame) @ frame.axes[0]
    return float(shift / frame.per_metre / force)


def _at_contact(
    points: NDArray[np.float64], values: NDArray[np.float64], frame: Frame
) -> NDArray[np.float64]:
    """Interpolate a field from the nodes around to the middle of the grid."""
    distance = np.linalg.norm(points - np.asarray(frame.origin), axis=1)
    near = np.argsort(distance, kind="stable")[:NEAREST]
    extent = np.ptp(points, axis=0).max()
    if distance[near[0]] > extent:
        raise ValueError(
            f"the nearest node is {distance[near[0]]:.3g} {frame.unit} from the contact, farther "
            "than the model is long: frame.origin must be in the model's unit of length"
        )
    weight = 1.0 / np.maximum(distance[near], 1e-9 * extent) ** 2
    return np.asarray(np.tensordot(weight, values[near], axes=1) / weight.sum())


def _nodal(
    path: Path, field: str, step: int | str | None
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Read nodes (n, 3) and a field on them (n, components) by meshio."""
    if step is not None:
        raise ValueError(f"{path}: step = {step!r}: only .frd and .dat of CalculiX have steps")
    mesh = read_by_meshio(path)
    if field not in mesh.point_data:
        names = ", ".join(mesh.point_data) or "none"
        raise ValueError(f"{path}: has no field {field!r} at its nodes; it has {names}")
    points = np.zeros((len(mesh.points), 3))
    points[:, : mesh.points.shape[1]] = mesh.points
    if not len(points):
        raise ValueError(f"{path}: has no nodes")
    values = np.asarray(mesh.point_data[field], float).reshape(len(points), -1)
    if not np.isfinite(values).all():
        raise ValueError(f"{path}: {field}: must be finite at all nodes")
    return points, values


def _orders(
    path: Path, field: str, count: int, components: Sequence[str] | None
) -> dict[str, tuple[str, ...]]:
    """Return the orders that the components of a stress may have, the first one preferred."""
    names = read_component_names(path, field) if components is None else tuple(components)
    if names:
        source = "components" if components is not None else f"{path}: {field}"
        try:
            order = read_order(names)
        except ValueError as error:
            raise ValueError(f"{source}: {error}") from error
        if len(order) != count:
            raise ValueError(f"{source}: {len(order)} names, and the field has {count} components")
        return {"file": order}
    if count == 9:
        return {"file": ROWS}
    if count != 6:
        raise ValueError(f"{path}: {field} has {count} components: a stress must have six or nine")
    kinds = ("Abaqus", "VTK", "XDMF") if path.suffix.lower() == ".xdmf" else ("Abaqus", "VTK")
    return {kind: ORDERS[kind] for kind in kinds}
