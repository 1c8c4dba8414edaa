"""The tractions as files that ParaView and PyVista open: image data and structured grids.

VTK's filter for contours ignores the attribute Direction of image data (VTK 9.7). None is written:
an image has its rows along the axes of the model.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from pyfret.export.frame import Frame
from pyfret.export.tables import TRACTIONS, body_sign
from pyfret.quantities import quantities

if TYPE_CHECKING:
    import os

    from numpy.typing import NDArray

    from pyfret.run import State

__all__ = ["image"]

FIELDS = (*TRACTIONS, "contact", "stick")
#: Cosine beyond which an axis of the contact is not along one of the model: rounding.
ALONG = 1e-9


@quantities
def image(
    state: State,
    path: str | os.PathLike[str],
    *,
    frame: Frame | None = None,
    body_number: int = 2,
) -> None:
    """Write tractions, contact and stick zone on the surface: ``.vti`` or ``.vts`` of VTK.

    Cell data over the grid; ``frame`` gives its place in the model and the units. ``q_x`` and
    ``q_y`` are along the contact's axes. Stresses of the volume below:
    :meth:`pyfret.Snapshot.write_volume`.

    Parameters
    ----------
    state, frame, body_number
        As in :func:`tractions`.
    path : path
        File to write; it must not exist. ``.vti`` is image data, along the axes of the model.
        ``.vts`` is a structured grid, in any directions.

    Raises
    ------
    ValueError
        The ending is another one, or ``.vti`` for a frame that is not along the model's axes.
    """
    frame = Frame() if frame is None else frame
    sign = body_sign(body_number)
    ending = Path(path).suffix
    if ending not in (".vti", ".vts"):
        raise ValueError(f"{path}: must end in .vti or .vts")
    d = state.dataset
    fields = {}
    for name in FIELDS:
        values = d[name].values.astype(float)
        if name in TRACTIONS:
            values = values * frame.per_pascal * (1.0 if name == "p" else sign)
        fields[name] = values
    if ending == ".vti":
        kind, head, extent, fields, points = _image(state, frame, path, fields)
    else:
        kind, head, extent, points = _structured(state, frame)
    with Path(path).open("x", encoding="ascii", newline="\n") as file:
        file.write(f'<?xml version="1.0"?>\n<VTKFile type="{kind}" version="1.0">\n')
        file.write(f'<{kind} WholeExtent="{extent}"{head}>\n<Piece Extent="{extent}">\n')
        file.write("<CellData>\n")
        for name, values in fields.items():
            file.write(f'<DataArray type="Float32" Name="{name}" format="ascii">\n')
            np.savetxt(file, values.T, fmt="%.7g")
            file.write("</DataArray>\n")
        file.write("</CellData>\n")
        if points is not None:
            file.write('<Points>\n<DataArray type="Float64" NumberOfComponents="3" ')
            file.write('format="ascii">\n')
            np.savetxt(file, points, fmt="%.12g")
            file.write("</DataArray>\n</Points>\n")
        file.write(f"</Piece>\n</{kind}>\n</VTKFile>\n")


def _image(
    state: State,
    frame: Frame,
    path: str | os.PathLike[str],
    fields: dict[str, NDArray[np.float64]],
) -> tuple[str, str, str, dict[str, NDArray[np.float64]], None]:
    """Return kind, head, extent and fields of image data, with rows along the model's axes."""
    axes = np.rint(frame.axes).astype(int)
    if np.abs(frame.axes - axes).max() > ALONG:
        raise ValueError(
            f"{path}: the frame is not along the model's axes: must end in .vts, a structured grid"
        )
    grid, d = state.scene.grid, state.dataset
    corners = frame.place(
        [
            [d.x.values[n] + n_x * grid.dx / 2, d.y.values[n] + n_x * grid.dy / 2, 0.0]
            for n, n_x in ((0, -1.0), (-1, 1.0))
        ]
    )
    counts, spacing = np.zeros(3, int), np.ones(3)
    columns = [int(np.flatnonzero(row)[0]) for row in axes[:2]]
    for column, count, step in zip(columns, (grid.nx, grid.ny), (grid.dx, grid.dy), strict=True):
        counts[column], spacing[column] = count, frame.per_metre * step
    turned = {}
    for name, values in fields.items():
        forward = values[:: axes[0].sum(), :: axes[1].sum()]
        # The first axis of the model runs fastest in the file.
        turned[name] = forward if columns[0] < columns[1] else forward.T
    origin = " ".join(f"{v:.12g}" for v in corners.min(axis=0))
    extent = " ".join(f"0 {count}" for count in counts)
    steps = " ".join(f"{v:.12g}" for v in spacing)
    return "ImageData", f' Origin="{origin}" Spacing="{steps}"', extent, turned, None


def _structured(state: State, frame: Frame) -> tuple[str, str, str, NDArray[np.float64]]:
    """Return kind, head, extent and points of a structured grid, the contact's x fastest."""
    grid, d = state.scene.grid, state.dataset
    x = d.x.values[0] + grid.dx * (np.arange(grid.nx + 1) - 0.5)
    y = d.y.values[0] + grid.dy * (np.arange(grid.ny + 1) - 0.5)
    places = np.stack([np.tile(x, y.size), np.repeat(y, x.size), np.zeros(x.size * y.size)], -1)
    return "StructuredGrid", "", f"0 {grid.nx} 0 {grid.ny} 0 0", frame.place(places)
