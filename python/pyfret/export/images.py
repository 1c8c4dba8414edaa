"""The tractions as an image that ParaView and PyVista open."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from pyfret._util.door import numbers_only
from pyfret.export.frame import Frame
from pyfret.export.tables import TRACTIONS, body_sign

if TYPE_CHECKING:
    import os

    from pyfret.run import State

__all__ = ["image"]

FIELDS = (*TRACTIONS, "contact", "stick")


@numbers_only
def image(
    state: State,
    path: str | os.PathLike[str],
    *,
    frame: Frame | None = None,
    body_number: int = 2,
) -> None:
    """Write tractions, contact and stick zone on the surface: VTK image data (``.vti``).

    Cell data over the grid, in the contact's axes; ``frame`` gives origin, directions and units.
    Stresses of the volume below: :meth:`pyfret.Snapshot.write_volume`.

    Parameters
    ----------
    state, frame, body_number
        As in :func:`tractions`.
    path : path
        File to write, ending in ``.vti``; it must not exist.
    """
    frame = Frame() if frame is None else frame
    sign = body_sign(body_number)
    if Path(path).suffix != ".vti":
        raise ValueError(f"{path}: must end in .vti")
    grid, d = state.scene.grid, state.dataset
    corner = frame.place([d.x.values[0] - grid.dx / 2, d.y.values[0] - grid.dy / 2, 0.0])
    spacing = [frame.per_metre * grid.dx, frame.per_metre * grid.dy, 1.0]
    numbers = {
        "WholeExtent": (0, grid.nx, 0, grid.ny, 0, 0),
        "Origin": corner.tolist(),
        "Spacing": spacing,
        "Direction": frame.axes.T.ravel().tolist(),
    }
    head = " ".join(f'{k}="{" ".join(f"{v:.9g}" for v in of)}"' for k, of in numbers.items())
    with Path(path).open("x", encoding="ascii", newline="\n") as file:
        file.write('<?xml version="1.0"?>\n<VTKFile type="ImageData" version="1.0">\n')
        file.write(
            f'<ImageData {head}>\n<Piece Extent="0 {grid.nx} 0 {grid.ny} 0 0">\n<CellData>\n'
        )
        for name in FIELDS:
            values = d[name].values.astype(float)
            if name in TRACTIONS:
                values = values * frame.per_pascal * (1.0 if name == "p" else sign)
            file.write(f'<DataArray type="Float32" Name="{name}" format="ascii">\n')
            np.savetxt(file, values.T, fmt="%.7g")
            file.write("</DataArray>\n")
        file.write("</CellData>\n</Piece>\n</ImageData>\n</VTKFile>\n")
