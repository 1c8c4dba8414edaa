"""The kept increments of a run as the moments of a cycle, and the sections of that cycle."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret import _core
from pyfret.subsurface.line import Line
from pyfret.subsurface.plastic import eigenstress

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    from pyfret.run import Run

__all__ = ["lines_of", "moments_of"]


def moments_of(
    result: Run,
    kept: NDArray[np.int64],
    body_number: int,
    before: int | None = None,
    *,
    with_left: bool = True,
) -> Callable[[Sequence[int] | None], tuple[list[Any], ...] | None]:
    """Give the fields of some of the kept increments, by their numbers from 0.

    None asks for the increment `before` the cycle. `with_left`: and what plastic strain leaves.
    """

    def moments(which: Sequence[int] | None) -> tuple[list[Any], ...] | None:
        if which is None and before is None:
            return None
        increments = [before] if which is None else [int(kept[n]) for n in which]
        now = [result.at(int(n)) for n in increments if n is not None]
        fields = [
            [np.ascontiguousarray(one.dataset[name].values, dtype=float) for one in now]
            for name in ("q_x", "q_y", "p")
        ]
        stick = [np.ascontiguousarray(one.dataset["stick"].values, dtype=bool) for one in now]
        bulk = [one.bulk_stress(body_number) for one in now]
        each = now if with_left else []
        left = [of for one in each for of in eigenstress(one, body_number)]
        return (*fields, stick, bulk, left)

    return moments


def lines_of(result: Run, kept: NDArray[np.int64], body_number: int) -> list[Line]:
    """Give the lines below which some kept increments are looked at, the first along their shear.

    A second one stands across the first, unless the largest stress lies in the plane of the shear:
    below a round contact that is sheared to and fro along one line.
    """
    moments = moments_of(result, kept, body_number, with_left=False)
    lines = _core.cycle_sections(result.scene.grid, moments, len(kept))
    return [Line(*line) for line in lines]
