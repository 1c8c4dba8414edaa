"""The order of the components of a tensor or a vector, from their names in the file."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

__all__ = ["ORDERS", "read_order", "to_matrices", "to_vectors"]

#: Orders of six components without names, and who has them: Abaqus and MED, VTK, XDMF (Tensor6).
ORDERS = {
    "Abaqus": ("xx", "yy", "zz", "xy", "xz", "yz"),
    "VTK": ("xx", "yy", "zz", "xy", "yz", "xz"),
    "XDMF": ("xx", "xy", "xz", "yy", "yz", "zz"),
}
#: Order of nine components without names.
ROWS = ("xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz")
#: A component of a stress: an axis twice, perhaps behind a letter of stress.
STRESS = re.compile(r"(?:S|SI|SIG|SIGMA|STRESS|T)?[_\- ]?([XYZ123])[_\- ]?([XYZ123])", re.I)
#: A component of a vector.
VECTOR = re.compile(r"(?:[A-Z]*[_\- ]?)?([XYZ123])", re.I)
#: Part of the largest component by which the halves of a tensor, or two orders, may differ.
EQUAL = 1e-4


def read_order(names: Sequence[str]) -> tuple[str, ...]:
    """Read the order of the components of a stress from names such as S11, sxx.

    A ValueError for names of other fields: strains, contact pressures, principal stresses.
    """
    order = []
    for name in names:
        match = STRESS.fullmatch(name.strip())
        if match is None:
            raise ValueError(
                f"its components are {', '.join(names)}: these are no stresses xx to zz"
            )
        order.append("".join("xyz"["xyz123".index(axis.lower()) % 3] for axis in match.groups()))
    whole = {"".join(sorted(pair)) for pair in order}
    if len(set(order)) != len(order) or not {"xx", "yy", "zz", "xy"} <= whole:
        raise ValueError(
            f"its components are {', '.join(names)}: a stress must have xx, yy, zz, xy, xz, yz"
        )
    return tuple(order)


def to_matrices(values: NDArray[np.float64], order: Sequence[str]) -> NDArray[np.float64]:
    """Arrange tensors as matrices, shape (n, 3, 3); components that the order lacks are zero."""
    matrices = np.zeros((len(values), 3, 3))
    for column, pair in enumerate(order):
        i, j = ("xyz".index(axis) for axis in pair)
        matrices[:, i, j] = values[:, column]
        if pair[::-1] not in order:
            matrices[:, j, i] = values[:, column]
    size = float(np.abs(matrices).max(initial=0.0))
    if np.abs(matrices - matrices.transpose(0, 2, 1)).max(initial=0.0) > EQUAL * size:
        raise ValueError("its nine components are no symmetric tensor in rows xx, xy, ..., zz")
    return matrices


def to_vectors(values: NDArray[np.float64], names: Sequence[str]) -> NDArray[np.float64]:
    """Arrange vectors along x, y, z, shape (n, 3), by the names of their components, if any."""
    if values.shape[1] < 3:
        raise ValueError(f"{values.shape[1]} components: a displacement must have three")
    axes = [VECTOR.fullmatch(name.strip()) for name in names]
    kinds = [match and "xyz123".index(match[1].lower()) % 3 for match in axes]
    if not names or not any(kind is not None for kind in kinds):
        return values[:, :3]
    if not all(kinds.count(axis) == 1 for axis in range(3)):
        raise ValueError(f"its components are {', '.join(names)}: must be those along x, y, z")
    return values[:, [kinds.index(axis) for axis in range(3)]]
