"""Solving a scene: the whole load path at once, or one increment at a time."""

from __future__ import annotations

import os
import shutil
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from pyfret import _core
from pyfret._core import Scene
from pyfret._util.lazy import xr
from pyfret._util.progress import Progress
from pyfret.result import Result, Snapshot, open
from pyfret.scene.warnings import doubt_run, doubt_scene

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from pyfret._core import LoadPath

__all__ = ["Increment", "march", "resume", "solve"]


def solve(
    scene: Scene | str | os.PathLike[str],
    path: LoadPath | None = None,
    *,
    rig_stiffness: float | None = None,
    save: Literal["branches", "all"] | Sequence[int] | None = None,
    out: str | os.PathLike[str] | None = None,
    checkpoint: float = 5.0,
    error: bool = False,
    progress: bool = True,
) -> Result:
    """Run through the load path and give the scalars of all increments and the fields of some.

    Parameters
    ----------
    scene : Scene or path
        What is in contact, or its scene file.
    path : LoadPath, optional
        Load history (default: that of the scene).
    rig_stiffness : float, optional
        Stiffness of a spring along x in series with the contact, through which shifts are given
        and read [N/m] (default: that of the path, or none).
    save : "branches", "all" or sequence of int, optional
        Increments that keep their fields, counted from 1 (default: as the scene says, which is the
        last of each branch unless it was set).
    out : path, optional
        Result store to write while the run goes on; it must not exist. An interrupted run leaves
        everything so far in it, and :func:`resume` goes on from there. Without it the result is
        in memory only.
    checkpoint : float
        Seconds of the run between two checkpoints, what a crash may lose; 0 for one after every
        increment. The ends of branches have theirs too, unless that costs more than 3 % of the
        run.
    error : bool
        Whether to run the path again on coarser and finer grids and with fewer increments, some
        times as long, for :meth:`Result.error_bars`.
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
        Something of the scene is allowed but hardly meant, such as a number in another unit; or of
        what the run came to, such as a contact of few cells (:attr:`Result.doubts`).
    """
    scene = read(scene).replace(path=path, save=save)
    if rig_stiffness is not None:
        scene = scene.replace(path=scene.path.rig(rig_stiffness))
    doubt_scene(scene)
    with Progress(title=scene.title or "fretting", shown=progress) as bar:
        if out is not None:
            _core.solve(
                scene, store=out, checkpoint=checkpoint, error=error, on_increment=bar.update
            )
            return told(open(out))
        tidy()
        name = PASSING.format(os.getpid())
        with tempfile.TemporaryDirectory(prefix=name, dir=memory(scene)) as folder:
            store = Path(folder) / "run.zarr"
            _core.solve(scene, store=store, error=error, on_increment=bar.update)
            return told(Result(open(store).dataset.load()))


def told(result: Result) -> Result:
    """The result, whose doubts are warned of."""
    doubt_run(result.doubts)
    return result


def resume(
    store: str | os.PathLike[str],
    *,
    checkpoint: float = 5.0,
    progress: bool = True,
) -> Result:
    """Go on with a run that was interrupted, crashed or killed, to the end of its load path.

    The result is that of the run without the interruption, bit by bit. A run that is done is
    opened as it is.

    Parameters
    ----------
    store : path
        Result store of the run, as given to :func:`solve` or to ``fret run``.
    checkpoint, progress
        As in :func:`solve`.

    Raises
    ------
    StoreError
        There is no store, another process writes it, or its checkpoint is damaged or of another
        version of pyfret.
    """
    with Progress(title="resumed", shown=progress) as bar:
        _core.resume(store, checkpoint=checkpoint, on_increment=bar.update)
    return told(open(store))


#: A file system in memory, where there is one.
SHARED_MEMORY = Path("/dev/shm")
#: The largest store that is written there [bytes]; larger ones would double the memory of a result.
SMALL = 64 << 20
#: What the folders of passing stores are called, with the number of their process.
PASSING = "pyfret-{}-"


def tidy() -> None:
    """Remove the passing stores in shared memory whose processes were killed."""
    for folder in SHARED_MEMORY.glob(PASSING.format("*") + "*"):
        process = folder.name.split("-")[1]
        if process.isdigit() and not Path("/proc", process).exists():
            shutil.rmtree(folder, ignore_errors=True)


#: Increments of a branch that are chosen, with room to spare.
CHOSEN = 200


def read(scene: Scene | str | os.PathLike[str]) -> Scene:
    """The scene, read from its file if it is the name of one."""
    if isinstance(scene, Scene):
        return scene
    if not isinstance(scene, (str, os.PathLike)):
        raise TypeError(
            f"{scene!r}: must be a scene, or the name of its file; the load path comes after it: "
            "solve(scene, path)"
        )
    return Scene.from_file(scene)


def memory(scene: Scene) -> Path | None:
    """Where a passing store is written: in memory if it is small, else the usual folder."""
    branches = scene.path.branches
    increments = sum(CHOSEN if b.increments is None else b.increments for b in branches)
    kept = increments if scene.settings.save == "all" else len(branches)
    if isinstance(scene.settings.save, list):
        kept = len(scene.settings.save)
    size = 8 * (len(_core.labels()) * (increments + kept * scene.grid.nx * scene.grid.ny))
    try:
        free = shutil.disk_usage(SHARED_MEMORY).free
        return SHARED_MEMORY if size < min(SMALL, free / 2) else None
    except OSError:
        return None


def march(
    scene: Scene | str | os.PathLike[str], path: LoadPath | None = None
) -> Iterator[Increment]:
    """Run through the load path one increment at a time, the careful way.

    Parameters
    ----------
    scene : Scene or path
        What is in contact, or its scene file.
    path : LoadPath, optional
        Load history (default: that of the scene).

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
    doubt_run(running.doubts())


def labelled(running: _core.March, scalars: dict[str, float]) -> xr.Dataset:
    """The last increment of a march as a dataset, labelled as in a result store."""
    labels = {
        name: {"units": units, "long_name": meaning}
        for name, (units, meaning) in _core.labels().items()
    }
    scene = running.scene
    hertz = scene.hertz
    attrs = {"title": scene.title, "mu": scene.mu, "scene": scene.to_toml()}
    if hertz is not None:
        attrs |= {"a_H": hertz.a, "p_H": hertz.p0, "R": hertz.a**2 / hertz.delta_z}
    coordinates = ("increment", "t", "branch_of_increment")
    return xr.Dataset(
        {k: ((), v, labels[k]) for k, v in scalars.items() if k not in coordinates}
        | {k: (("x", "y"), v, labels[k]) for k, v in running.fields().items()},
        coords={k: ((), scalars[k], labels[k]) for k in coordinates}
        | {"x": scene.grid.x, "y": scene.grid.y},
        attrs=attrs,
    )


class Increment(Snapshot):
    """One increment of a running march: a snapshot whose fields are computed when asked for."""

    def __init__(self, running: _core.March, scalars: dict[str, float]) -> None:
        self._running = running
        self._scene = running.scene
        self._scalars = scalars
        self._labelled: xr.Dataset | None = None

    @property
    def dataset(self) -> xr.Dataset:
        """Fields of dims (x, y), the scalars of the increment, and the attrs of the run."""
        if self._labelled is None:
            mine, reached = self._scalars["increment"], self._running.done
            if mine != reached:
                raise RuntimeError(
                    f"the march has gone on to increment {reached}; "
                    f"ask for the fields of increment {mine} before that"
                )
            self._labelled = labelled(self._running, self._scalars)
        return self._labelled

    def __getattr__(self, name: str) -> xr.DataArray:
        """Give a scalar at once, a field by way of the dataset."""
        if not name.startswith("_") and name in self._scalars:
            return xr.DataArray(self._scalars[name], name=name)
        return super().__getattr__(name)
