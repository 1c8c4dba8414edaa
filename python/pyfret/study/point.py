"""One point of a study, solved in any process."""

from __future__ import annotations

import os
import time
import warnings
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from pyfret._core import Grid, OffGridError, Scene
from pyfret._util.scene_warnings import SceneWarning
from pyfret.solution import solve
from pyfret.study.design import with_values
from pyfret.study.measures import evaluate_measures, needs_more_increments

if TYPE_CHECKING:
    from collections.abc import Sequence

    import xarray as xr

    from pyfret.result import Result
    from pyfret.study.measures import Measure

__all__ = ["DONE", "FAILED", "OPEN", "PARTLY", "Outcome", "solve_point"]

#: Codes of the status of a point, and their meanings: "partly" where a measure has no number.
OPEN, DONE, FAILED, PARTLY = 0, 1, 2, 3
MEANINGS = "open done failed partly"
#: Growth factor of a grid that is too small, and the largest number of growths: 7.5 times in all.
GROWTH, GROWTHS = 1.4, 6
#: Factor on the increments of a path whose branches have too few for a measure.
REFINEMENT = 3


@dataclass(frozen=True)
class Outcome:
    """The outcome of a point."""

    status: int
    reason: str = ""
    measures: dict[str, xr.Variable] = field(default_factory=dict)
    #: Processor time of all threads [s].
    seconds: float = 0.0
    #: Cells along x and y that it took.
    nx: int = 0
    ny: int = 0
    #: Processor time of the solution and of each measure [s].
    costs: dict[str, float] = field(default_factory=dict)


def failure(error: BaseException) -> Outcome:
    """Make the outcome of a point without an answer, with the reason."""
    return Outcome(FAILED, f"{type(error).__name__}: {' '.join(str(error).split())}")


def enlarge_grid(grid: Grid) -> Grid:
    """Return the grid with more cells of the same size; even numbers stay even."""

    def more(n: int) -> int:
        """Return a number of cells enlarged by the factor."""
        return n + 2 * max(round(n * (GROWTH - 1) / 2), 1)

    return grid.replace(nx=more(grid.nx), ny=grid.ny if grid.plane_strain else more(grid.ny))


def with_more_increments(scene: Scene, result: Result) -> Scene | None:
    """Return a scene with more increments than its result has, on the branches that choose them.

    Branches on which the normal force changes stay as they are. None if no branch is left.
    """
    branches, taken = scene.path.branches, result.scene.path.branches
    settings = {
        f"path.{n}.increments": REFINEMENT * (taken[n].increments or 1)
        for n in range(1, len(branches))
        if branches[n].increments is None and branches[n].W == branches[n - 1].W
    }
    return with_values(scene, settings) if settings else None


def solve_point(
    scene: Scene,
    measures: Sequence[Measure],
    *,
    like: Scene | None,
    grow: bool,
    threads: int | None,
    home: int,
) -> Outcome:
    """Solve a scene and measure its result.

    Parameters
    ----------
    scene : Scene
        The scene with its load path.
    measures : sequence of str or callable
        Numbers to keep.
    like : Scene, optional
        The scene of the study whose increments are the first guess.
    grow : bool
        Whether a grid that is too small grows.
    threads : int, optional
        Threads of this process, if it is another than `home` and has not begun to solve.
    home : int
        Number of the process that runs the study.
    """
    if threads is not None and os.getpid() != home:
        os.environ.setdefault("RAYON_NUM_THREADS", str(threads))
    started = time.process_time()
    costs: dict[str, float] = {}
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", SceneWarning)
            result: Any = None
            for growths_left in reversed(range(GROWTHS + 1)):
                try:
                    result = solve(scene, like=like, progress=False)
                    break
                except OffGridError:
                    if not (grow and growths_left):
                        raise
                    scene = scene.replace(grid=enlarge_grid(scene.grid))
            if needs_more_increments(result, measures):
                finer = with_more_increments(scene, result)
                result = result if finer is None else solve(finer, progress=False)
            costs["solution"] = time.process_time() - started
            values, reasons = evaluate_measures(result, measures, costs)
    except (Exception, SystemExit) as error:
        return failure(error)
    seconds = time.process_time() - started
    status = PARTLY if reasons else DONE
    reason = "\n".join(reasons) if reasons else " ".join(result.doubts)
    return Outcome(status, reason, values, seconds, scene.grid.nx, scene.grid.ny, costs)
