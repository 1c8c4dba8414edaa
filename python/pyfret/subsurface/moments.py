"""The kept increments of a run as the moments of a cycle, and the sections of that cycle."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret import _core
from pyfret.subsurface.line import Line
from pyfret.subsurface.plastic import eigenstress

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import ArrayLike, NDArray

    from pyfret.run import Run, State

__all__ = ["lines_of", "moments_of", "states_of", "states_of_increments"]


def states_of(
    snapshots: Sequence[State], body_number: int, *, with_left: bool = True
) -> _core.States:
    """Give snapshots of a run as the states above a body.

    `with_left`: with the residual stress of its plastic strain.
    """

    def fields(name: str, kind: type) -> list[Any]:
        """Return a field of all snapshots."""
        return [
            np.ascontiguousarray(snapshot.dataset[name].values, dtype=kind)
            for snapshot in snapshots
        ]

    yielded_snapshots = snapshots if with_left else []
    return _core.States(
        snapshots[0].scene.grid,
        **{name: fields(name, float) for name in ("p", "q_x", "q_y")},
        stick=fields("stick", bool),
        sigma_B=[snapshot.bulk_stress(body_number) for snapshot in snapshots],
        eigenstress=[
            eigenstress_of_state
            for snapshot in yielded_snapshots
            for eigenstress_of_state in eigenstress(snapshot, body_number)
        ],
    )


def states_of_increments(
    result: Run, increments: Sequence[int], body_number: int, *, with_left: bool = True
) -> _core.States:
    """Give kept increments of a run as the states above a body, as :func:`states_of`.

    The fields are read one by one: a snapshot takes all variables of the dataset along.
    """
    scene, variables = result.scene, result.dataset.variables
    body = scene.body1 if body_number == 1 else scene.body2
    if with_left and body.yields:
        return states_of([result.at(int(n)) for n in increments], body_number)
    saved, numbers = variables["saved_increment"].values, variables["increment"].values
    places = [int(np.flatnonzero(saved == n)[-1]) for n in increments]
    bulk_stress = variables["sigma_B1" if body_number == 1 else "sigma_B"].values

    def fields(name: str, kind: type) -> list[Any]:
        """Return a field of all increments."""
        field = variables[name]
        return [np.ascontiguousarray(field.isel(saved=n).values, dtype=kind) for n in places]

    return _core.States(
        scene.grid,
        **{name: fields(name, float) for name in ("p", "q_x", "q_y")},
        stick=fields("stick", bool),
        sigma_B=[float(bulk_stress[np.flatnonzero(numbers == n)[0]]) for n in increments],
        eigenstress=[],
    )


def moments_of(
    result: Run,
    kept: NDArray[np.int64],
    body_number: int,
    before: int | None = None,
    *,
    with_left: bool = True,
) -> Callable[[Sequence[int] | None], _core.States | None]:
    """Give the states of some of the kept increments, by their numbers from 0.

    None asks for the increment `before` the cycle. `with_left`: and the residual stress of plastic
    strain.
    """

    def moments(which: Sequence[int] | None) -> _core.States | None:
        """Return the states of some increments, or the one before the cycle for None."""
        if which is None and before is None:
            return None
        increments = [before] if which is None else [int(kept[n]) for n in which]
        now = [int(n) for n in increments if n is not None]
        return states_of_increments(result, now, body_number, with_left=with_left)

    return moments


def lines_of(
    result: Run,
    kept: NDArray[np.int64],
    body_number: int,
    residual: Sequence[ArrayLike] | None = None,
) -> list[Line]:
    """Give the lines below which some kept increments are looked at, the first along their shear.

    The lines pass through the centre of the largest contact. A second one stands across the first,
    and two more between them where bulk or residual stress has another direction than the shear. A
    round contact needs the first alone if all stress acts along one line.
    """
    moments = moments_of(result, kept, body_number, with_left=False)
    scene = result.scene
    body = scene.body1 if body_number == 1 else scene.body2
    lines = _core.cycle_sections(
        body,
        scene.grid,
        moments,
        len(kept),
        residual=None if residual is None else list(residual),
    )
    return [Line(*line) for line in lines]
