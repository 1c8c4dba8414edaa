"""Solving a scene: the whole load path at once, or one increment at a time."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Literal

from pyfret import _core
from pyfret._core import Scene
from pyfret._util.arrays import number
from pyfret._util.lazy import xr
from pyfret._util.progress import Progress
from pyfret.history.load_history import LoadHistory
from pyfret.quantities import Stiffness, quantities
from pyfret.result import Result, open_result
from pyfret.run.dataset import dataset
from pyfret.scene.warnings import doubt_run, doubt_scene
from pyfret.snapshot import Snapshot

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from pyfret._core import LoadPath
    from pyfret._util.types import FrictionFunction

__all__ = ["Increment", "march", "resume", "solve"]


@quantities
def solve(
    scene: Scene | str | os.PathLike[str],
    path: LoadPath | LoadHistory | None = None,
    *,
    rig_stiffness: Stiffness | None = None,
    save: Literal["branches", "all"] | Sequence[int] | None = None,
    out: str | os.PathLike[str] | None = None,
    checkpoint: float = 5.0,
    overwrite: bool = False,
    error: bool | Literal["coarser"] = False,
    like: Scene | None = None,
    progress: bool = True,
) -> Result:
    """Run through the load path and give the scalars of all increments and the fields of some.

    Parameters
    ----------
    scene : Scene or path
        What is in contact, or its scene file.
    path : LoadPath or LoadHistory, optional
        Load path (default: the scene's own), or a measured history that is marched as it is, after
        the branches of the scene that press the bodies.
    rig_stiffness : float, optional
        Stiffness of a spring along x in series with the contact, through which shifts are given
        and read [N/m] (default: the path's own, or none).
    save : "branches", "all" or sequence of int, optional
        Increments that keep their fields, counted from 1 (default: as in the scene, which is the
        last of each branch unless it was set).
    out : path, optional
        Result store to write while the run goes on; it must not exist. An interrupted run leaves
        everything so far in it, and :func:`resume` goes on from there. Without it the result is
        in memory only.
    checkpoint : float
        Seconds of the run between two checkpoints, what a crash may lose; 0 for one after every
        increment. The ends of branches have theirs too, unless that costs more than 3 % of the
        run.
    overwrite : bool
        Whether a store at `out` is replaced, once the first increment is solved (default False).
    error : bool or "coarser"
        Whether to run the path again on coarser and finer grids and with fewer increments, some
        times as long, for :meth:`Result.error_bars`. With ``"coarser"`` the errors come from
        coarser grids alone. This takes 0.8 to 1.4 times the work of the run instead of 5 to 8
        times. The errors are about twice as large.
    like : Scene, optional
        A neighbouring scene with the same kind of path, where increments are chosen: those that it
        needs are the first guess, which one comparison checks. Its own are chosen once in a
        process. The result depends on the two scenes alone.
    progress : bool
        Whether to draw a progress bar on a terminal or in a notebook.

    Raises
    ------
    InvalidSceneError
        The scene has no meaning; the message names the key, the value and what is allowed.
    OffGridError
        The contact reached the border of the grid.
    NoConvergenceError
        A solver stopped before its tolerance.

    Warns
    -----
    SceneWarning
        A number of the scene is allowed but hardly meant, such as one in another unit. Or the
        result is doubtful, such as a contact of few cells (:attr:`Result.doubts`).
    """
    seconds = number(checkpoint, "checkpoint")
    scene = read(scene)
    scene = scene.replace(path=as_path(path, scene), save=save)
    if rig_stiffness is not None:
        scene = scene.replace(path=scene.path.rig(rig_stiffness))
    doubt_scene(scene)
    with Progress(title=scene.title or "fretting", shown=progress) as bar:
        if out is not None:
            _core.solve(
                scene,
                store=out,
                checkpoint=seconds,
                overwrite=overwrite,
                error=error,
                like=like,
                on_increment=bar.update,
            )
            return warn_and_return(open_result(out))
        run = _core.solve_in_memory(scene, error=error, like=like, on_increment=bar.update)
    return warn_and_return(Result(dataset(*run)))


#: Turning points of a history that are marched at most.
MOST_TURNS = 20_000


def as_path(path: LoadPath | LoadHistory | None, scene: Scene) -> LoadPath | None:
    """Return a load path, or the path through a measured history."""
    if not isinstance(path, LoadHistory):
        return path
    if path.is_series and path.turns().size > MOST_TURNS:
        raise ValueError(
            f"the history has {path.turns().size} turning points: must be {MOST_TURNS} or fewer "
            "to be marched; fatigue.damage and wear.solve(history=...) take a table of few "
            "amplitudes"
        )
    return path.path(scene)


def warn_and_return(result: Result) -> Result:
    """The result; warned of is what the run came to, after :func:`doubt_scene`."""
    doubt_run(result.doubts, result.scene)
    return result


@quantities
def resume(
    store: str | os.PathLike[str],
    *,
    checkpoint: float = 5.0,
    friction_law: FrictionFunction | None = None,
    progress: bool = True,
) -> Result:
    """Go on with a run that was interrupted, crashed or killed, to the end of its load path.

    The result equals the uninterrupted run, bit by bit. A run that is done is
    opened as it is.

    Parameters
    ----------
    store : path
        Result store of the run, as given to :func:`solve` or to ``fret run``.
    friction_law : callable, optional
        The ``law`` of the run's :class:`Friction`, which no store can hold.
    checkpoint, progress
        As in :func:`solve`.

    Raises
    ------
    InvalidSceneError
        The run has a friction law that is a function and none is given, or the other way about.
    StoreError
        There is no store, another process writes it, or its checkpoint is damaged or of another
        version of pyfret.
    """
    with Progress(title="resumed", shown=progress) as bar:
        _core.resume(
            store, checkpoint=checkpoint, friction_law=friction_law, on_increment=bar.update
        )
    return warn_and_return(open_result(store))


def read(scene: Scene | str | os.PathLike[str]) -> Scene:
    """Return the scene, read from its file if its name is given."""
    if isinstance(scene, Scene):
        return scene
    if not isinstance(scene, (str, os.PathLike)):
        raise TypeError(
            f"scene = {scene!r:.60}: must be a scene, or the name of its file; the load path comes "
            "after it: solve(scene, path)"
        )
    return Scene.from_file(scene)


@quantities
def march(
    scene: Scene | str | os.PathLike[str], path: LoadPath | None = None
) -> Iterator[Increment]:
    """Run through the load path one increment at a time, the careful way.

    Parameters
    ----------
    scene : Scene or path
        What is in contact, or its scene file.
    path : LoadPath, optional
        Load history (default: the scene's own).

    Yields
    ------
    Increment
        The contact after each increment. Its fields are computed when they are asked for, which
        has to be before the next increment is.
    """
    scene = read(scene).replace(path=path)
    doubt_scene(scene)
    running = _core.March(scene)
    for scalars in running:
        yield Increment(running, scalars)
    doubt_run(running.doubts(), scene)


class Increment(Snapshot):
    """One increment of a running march: a snapshot whose fields are computed when asked for."""

    def __init__(self, running: _core.March, scalars: dict[str, float]) -> None:
        self._running = running
        self._scene = running.scene
        self._scalars = scalars
        self._labelled: xr.Dataset | None = None

    @property
    def dataset(self) -> xr.Dataset:
        """Return fields of dims (x, y), the scalars of the increment, and the attrs of the run."""
        if self._labelled is None:
            mine, reached = self._scalars["increment"], self._running.done
            if mine != reached:
                raise RuntimeError(
                    f"the march has gone on to increment {reached}; "
                    f"ask for the fields of increment {mine} before that"
                )
            labelled = dataset(self._running.variables(), self._running.attributes)
            if doubts := self._running.doubts():
                # Of the increments so far, as a store has them that ends here.
                labelled.attrs["doubts"] = "\n".join(doubts)
            self._labelled = labelled
        return self._labelled

    def __reduce__(self) -> tuple[type[Snapshot], tuple[xr.Dataset]]:
        """Pickle the snapshot, without the march."""
        return Snapshot, (self.dataset,)

    def __getattr__(self, name: str) -> xr.DataArray:
        """Give a scalar at once, a field by way of the dataset."""
        if not name.startswith("_") and name in self._scalars:
            return xr.DataArray(self._scalars[name], name=name)
        return super().__getattr__(name)
