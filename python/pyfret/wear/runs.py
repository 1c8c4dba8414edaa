"""Runs of wear: solved, gone on with, opened."""

from __future__ import annotations

import os
from os import fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret import _core
from pyfret._core import ArgumentError, OffGridError, Scene, StoreError
from pyfret._util import files
from pyfret._util.progress import Progress
from pyfret.history.ladder import Ladder, check_sliding, follow_channels
from pyfret.history.load_history import LoadHistory
from pyfret.history.scene_file import read_history
from pyfret.quantities import quantities
from pyfret.run.dataset import dataset
from pyfret.wear.result import WearResult
from pyfret.wear.settings import Wear, check_laws, own, read

if TYPE_CHECKING:
    import os
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from pyfret._core import LoadPath
    from pyfret._util.types import FrictionFunction
    from pyfret.wear.settings import Law

__all__ = ["block_of_history", "open_run", "resume", "solve"]

#: End of the refusal of a grid that a scar leaves.
GRID_FOR_SCAR = (
    "Scene.ball_on_flat(..., wear={...}) and Grid.for_contact(..., wear={...}) choose a grid for "
    "the scar of all cycles"
)


@quantities
def solve(
    scene: Scene | str | os.PathLike[str],
    wear: Wear | None = None,
    *,
    path: LoadPath | None = None,
    history: LoadHistory | None = None,
    start: WearResult | None = None,
    out: str | os.PathLike[str] | None = None,
    overwrite: bool = False,
    progress: bool = True,
    **settings: Any,
) -> WearResult:
    """Wear the surfaces of a scene over many cycles.

    Parameters
    ----------
    scene : Scene or path
        What is in contact, or a scene file; what its tables ``[wear]`` and ``[history]`` hold need
        not be given.
    wear : Wear, optional
        What wears, over how many cycles, and how.
    path : LoadPath, optional
        Load path (default: the scene's own): a part that leads in, then one cycle.
    history : LoadHistory, optional
        A measured history or a spectrum instead of a path, as a block: `cycles` are its passes.
        Its loops wear with mixed rates: every class of amplitude counts as often as it occurs, in
        the same jump. Blocks of several histories follow one another by `start`.
    start : WearResult, optional
        Worn surfaces to begin on, from its last block, as after another stroke; cycles, energy
        and volumes count on. The grid must be the same.
    out : path, optional
        Result store to write while the run goes on; it must not exist. :func:`resume` goes on
        with a run that was interrupted. Without it the result is in memory only.
    overwrite : bool
        Whether a store at `out` is replaced, once the first jump is done (default False).
    progress : bool
        Whether to draw a progress bar on a terminal or in a notebook.
    **settings
        Settings by the names of :class:`Wear`, alone or in place of fields of `wear`.

    Raises
    ------
    InvalidSceneError, ArgumentError, ValueError
        Scene or wear have no meaning; the message names the key, the value and what is allowed.
    TypeError
        A setting has no such name; the message offers the nearest.
    """
    if not isinstance(scene, Scene):
        if not isinstance(scene, str | os.PathLike):
            raise TypeError(f"scene = {scene!r:.60}: must be a scene, or the name of its file")
        if history is None and path is None:
            history = read_history(scene)
        scene, of_file = _core.wear_of_file(scene)
        wear = read(of_file) if wear is None else wear
    if history is not None:
        if path is not None:
            raise ValueError("path and history: must be one of them")
        path, settings = block_of_history(scene, history, settings)
    wear = Wear.from_settings(wear, settings)
    table, functions = wear.document()
    begins = None if start is None else surfaces(start)
    done = 0.0 if begins is None else begins[0]
    worn_scene = scene if path is None else scene.replace(path=path)
    last_branch = len(worn_scene.path.branches) - 1
    if wear.first_branch is not None and wear.first_branch > max(last_branch, 1):
        raise ArgumentError(
            f"wear.first_branch = {wear.first_branch}: must be 1 to {max(last_branch, 1)}: "
            "a branch of the path after one that presses"
        )

    with Progress(title=worn_scene.title or "wear", shown=progress) as bar:
        try:
            kept = _core.wear(
                worn_scene,
                table,
                functions,
                store=out,
                overwrite=overwrite,
                start=begins,
                on_jump=lambda now: bar.update(round(now - done), round(wear.cycles)),
            )
        except OffGridError as error:
            raise OffGridError(f"{error}. {GRID_FOR_SCAR}") from None
    if kept is not None:
        return WearResult(dataset(*kept))
    if out is None:
        raise RuntimeError("a run without a store is in memory")
    return open_run(out)


#: Classes of amplitude of a block of wear.
CLASSES = 12


def block_of_history(
    scene: Scene, history: LoadHistory, settings: Mapping[str, Any]
) -> tuple[LoadPath, dict[str, Any]]:
    """Return the path through the classes of a history, and the settings that count its loops."""
    loops = history.count()
    if loops.dataset.sizes["loop"] == 0:
        raise ValueError("the history has no loop: must vary")
    levels = loops.classes(CLASSES)
    check_sliding(scene, history, levels)
    ladder = Ladder.build(scene, history, levels, follow_channels(history))
    block: dict[str, Any] = {
        **settings,
        "first_branch": ladder.first_branch,
        "branch_counts": ladder.counts.tolist(),
    }
    # The surfaces lie still: classes of many strokes share one cycle.
    block.setdefault("cycling", "march")
    if history.duration is not None:
        block.setdefault("frequency", 1.0 / history.duration)
    return ladder.path, block


def solve_until_refused(
    scene: Scene, out: str | os.PathLike[str], **settings: Any
) -> tuple[WearResult, str | None]:
    """Wear the surfaces until all cycles are done, or the contact leaves the grid.

    Parameters
    ----------
    scene, out, **settings
        As in :func:`solve`; `out` keeps what a run that ends early has reached.

    Returns
    -------
    WearResult, str or None
        The run to its last jump, and why it ended early.

    Raises
    ------
    OffGridError
        The contact leaves the grid before the first jump is done.
    """
    try:
        return solve(scene, out=out, progress=False, **settings), None
    except OffGridError as error:
        if not Path(out).exists():
            raise
        return open_run(out), " ".join(str(error).split())


def surfaces(start: WearResult) -> tuple[float, float, list[NDArray[np.float64]], float]:
    """Return the worn surfaces at the end of a run as the core takes them."""
    if not isinstance(start, WearResult):
        raise TypeError(f"start = {start!r:.60}: must be the result of a run of wear")
    d = start.dataset
    names = ("worn1", "worn2", "energy1", "energy2", "slid", "bed")
    fields = [np.asarray(d[name][-1].values, dtype=float) for name in names if name in d]
    ejected = float(d.ejected[-1]) if "ejected" in d else 0.0
    return float(d.block_cycles[-1]), float(d.dissipated[-1]), fields, ejected


@quantities
def resume(
    store: str | os.PathLike[str],
    *,
    body1: Law | Sequence[Law | None] | None = None,
    body2: Law | Sequence[Law | None] | None = None,
    friction_law: FrictionFunction | None = None,
    progress: bool = True,
) -> WearResult:
    """Go on with a run of :func:`solve` or ``fret wear`` that ended early, to the same bits.

    Parameters
    ----------
    store : path
        Store of the run.
    body1, body2 : law or list of laws, optional
        Laws that the run wore by; the functions among them are taken, which no store can hold.
    friction_law : callable, optional
        The function of its friction, ``Friction(mu, law=...)``, which no store can hold either.
    progress : bool
        Whether to draw a progress bar.

    Raises
    ------
    StoreError
        There is no run of wear, or its checkpoint is damaged or of another version of pyfret.
    """
    check_laws(body1, "body1")
    check_laws(body2, "body2")
    with Progress(title="resumed", shown=progress):
        _core.resume_wear(store, [own(body1), own(body2)], friction_law=friction_law)
    return open_run(store)


@quantities
def open_run(store: str | os.PathLike[str]) -> WearResult:
    """Open the store of a run of :func:`solve` or ``fret wear``, or what was saved of one.

    Every file of a store is checked before: what is read is what was written. What
    :meth:`WearResult.save` wrote has no checksums and is not checked.

    Raises
    ------
    StoreError
        There is no run of wear, or a file of it is missing or damaged; the message names both.
    """
    files.checked(store)
    if not files.is_copy(store):
        _core.verify_wear(store)
    data = files.opened(store)
    if "wear" not in data.attrs or "block" not in data.sizes:
        raise StoreError(f"{fspath(store)}: holds no run of wear")
    return WearResult(data.set_coords(["cycles", "block_cycles"]))
