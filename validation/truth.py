"""A page of the book: a scene on several grids, and what is known of its solution."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    import pyfret as fret

    Array = NDArray[np.float64]


#: An order along the path is that of errors so many times what is left with the most increments,
#: which the cells leave.
LEFT_BY_CELLS = 2
#: Errors that the solver leaves with its default tolerance: numbers off by less show no order.
LEFT_BY_SOLVER = 1e-6
#: Places of the rim within the cells that errors are averaged over, if a truth says nothing else.
PLACES = 8


def root_mean_square(known: list[dict[str, Known]]) -> dict[str, Known]:
    """Of the errors of every number over several runs."""
    return {
        name: Known(float(np.sqrt(np.mean([of[name].error ** 2 for of in known]))), 0.0, 1.0)
        for name in known[0]
    }


class Known(NamedTuple):
    """A number of ours and what it should be; errors are over the truth, or over `scale`.

    `of` is the variable of the result, at its end, that it is, where that has an error bar.
    """

    ours: float
    truth: float
    scale: float | None = None
    of: str | None = None

    @property
    def error(self) -> float:
        """The error, of either sign, over the truth or the scale."""
        return (self.ours - self.truth) / abs(self.truth if self.scale is None else self.scale)


def l2(ours: Array, truth: Array, scale: Array | None = None) -> Known:
    """Distance of two fields in the L2 norm over that of the truth, or of `scale`."""
    norm = float(np.linalg.norm(truth if scale is None else scale))
    return Known(float(np.linalg.norm(ours - truth)), 0.0, norm)


@dataclass(frozen=True)
class Truth:
    """A page.

    Attributes
    ----------
    name : str
        File name.
    title : str
        Title.
    law : str
        What is known, and whose it is; Markdown.
    scene : callable
        The scene on a grid of so many cells a side.
    known : callable
        Numbers of a result beside the truth.
    draw : callable
        Draws ours and the truth of the result on the finest grid.
    grids : tuple of int
        Cells a side.
    path : callable, optional
        The scene with so many increments, where these matter, the rim at one of several places.
    increments : tuple of int
        Their numbers.
    path_places : int
        How many places.
    placed : callable, optional
        The scene on a grid of so many cells a side, the rim of the contact at one of several
        places within the cells: of errors that depend on that.
    placed_grids : tuple of int
        Cells a side of these.
    places : int
        How many places.
    remark : str
        What explains the errors; Markdown.
    has_error_bars : bool
        Whether the scene can be solved on half as many cells; not where it rolls by a cell.
    """

    name: str
    title: str
    law: str
    scene: Callable[[int], fret.Scene]
    known: Callable[[fret.Result], dict[str, Known]]
    draw: Callable[[Figure, fret.Result], None]
    grids: tuple[int, ...] = (64, 128, 256)
    path: Callable[[int, int], fret.Scene] | None = None
    increments: tuple[int, ...] = field(default=())
    path_places: int = 1
    placed: Callable[[int, int], fret.Scene] | None = None
    placed_grids: tuple[int, ...] = (32, 64, 128, 256)
    places: int = PLACES
    remark: str = ""
    has_error_bars: bool = True


def order(sizes: tuple[int, ...], errors: list[float]) -> float:
    """Order that the errors fall with in the number of cells or increments, by least squares.

    None (not a number) where all are the solver's.
    """
    known = [(n, abs(e)) for n, e in zip(sizes, errors, strict=True) if abs(e) > 1e-13]
    if len(known) < 2 or max(e for _, e in known) < LEFT_BY_SOLVER:
        return float("nan")
    n, e = np.log(np.array(known)).T
    return float(-np.polyfit(n, e, 1)[0])
