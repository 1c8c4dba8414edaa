"""One door: what is written follows from the ending of the file and from what is given."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Literal

from pyfret.export.images import image
from pyfret.export.nodes import loads
from pyfret.export.tables import stress, tractions
from pyfret.quantities import Numbers, quantities

if TYPE_CHECKING:
    import os

    from pyfret.export.frame import Frame
    from pyfret.run import State

__all__ = ["write"]


@quantities
def write(
    state: State,
    path: str | os.PathLike[str],
    *,
    frame: Frame | None = None,
    body_number: int = 2,
    form: Literal["csv", "abaqus", "aster"] = "csv",
    of: Literal["p", "q_x", "q_y"] = "p",
    mesh: str | os.PathLike[str] | None = None,
    points: Numbers | None = None,
) -> None:
    """Write the tractions of an increment, or the stress at points, for another program.

    Parameters
    ----------
    state : Snapshot
        The increment.
    path : path
        File to write; it must not exist. ``.vti`` gives an image of the tractions,
        ``.vts`` a structured grid of them.
    frame, body_number, form, of
        As in :func:`tractions`.
    mesh : path, optional
        Forces on the nodes of this mesh: :func:`loads`.
    points : array of shape (n, 3), optional
        The stress at these places of the model: :func:`stress`.
    """
    if mesh is not None and points is not None:
        raise ValueError("give mesh, for forces on its nodes, or points, for the stress there")
    if points is not None:
        stress(state, points, path, frame=frame, body_number=body_number)
    elif mesh is not None:
        loads(state, mesh, path, frame=frame, body_number=body_number)
    elif Path(path).suffix in (".vti", ".vts"):
        image(state, path, frame=frame, body_number=body_number)
    else:
        tractions(state, path, frame=frame, body_number=body_number, form=form, of=of)
