"""Runs of wear: solved, gone on with, opened."""

from __future__ import annotations

import math
from os import fspath
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np

from pyfret import _core
from pyfret._core import Scene, StoreError
from pyfret._util import files
from pyfret._util.progress import Progress
from pyfret.run.dataset import dataset
from pyfret.wear.result import WearResult

if TYPE_CHECKING:
    import os

    from numpy.typing import NDArray

    from pyfret._core import LoadPath
    from pyfret._core import _FrictionFunction as FrictionFunction
    from pyfret._core import _WearLaw as WearLaw

__all__ = ["open", "resume", "solve"]

#: How the contact of a cycle is solved, and what happens when a coating is worn through.
Cycling = Literal["march", "sliding"]
WornThrough = Literal["stop", "go_on"]


def solve(
    scene: Scene,
    path: LoadPath | None = None,
    *,
    cycles: float,
    body1: WearLaw | list[WearLaw | None] | None = None,
    body2: WearLaw | list[WearLaw | None] | None = None,
    share1: float | None = None,
    share2: float | None = None,
    debris_kept: float = 0.0,
    first_branch: int | None = None,
    cycling: Cycling = "march",
    frequency: float | None = None,
    rig_stiffness: float = math.inf,
    tolerance: float | None = None,
    jumps: int | None = None,
    explicit_jumps: int | None = None,
    worn_through: WornThrough = "stop",
    tell_from: float = 0.1,
    start: WearResult | None = None,
    out: str | os.PathLike[str] | None = None,
    overwrite: bool = False,
    progress: bool = True,
) -> WearResult:
    """Wear the surfaces of a scene over many cycles.

    Parameters
    ----------
    scene : Scene
        What is in contact.
    path : LoadPath, optional
        Load history (default: that of the scene): a part that leads in, then one cycle.
    cycles : float
        Number of cycles.
    body1, body2 : Archard, DissipatedEnergy, callable, or list of these, optional
        How a body wears: one law, or one for each coating from the outermost on and one for the
        substrate; None: the body or the layer does not wear. A callable takes
        arrays over the cells, of one cycle: ``pressed_way`` (integral of the pressure over the way
        slipped, Pa m), ``way`` (slipped, m), ``dissipated`` (energy per area, J/m^2), ``worn``
        (depth so far, m), and the number ``cycles`` so far, and gives the depth that the cycle
        takes, m.
    share1, share2 : float, optional
        Part of what its law says that a body loses (default 1).
    debris_kept : float
        Part of what both bodies lose that stays in the contact, 0 to 1: the gap grows by the rest.
        Debris lies where it was made and is as stiff as the body that it was.
    first_branch : int, optional
        First branch of the path that belongs to the cycle, counted from 0 (default: that of the
        last closed cycle); the cycle ends where it begins.
    cycling : "march" or "sliding"
        "march" solves the increments of the cycle, with stick and slip; "sliding" is for gross slip
        along x under given shifts, whatever the stroke: the normal contact alone at each place.
    frequency : float, optional
        Cycles per second [Hz], for coefficients that are functions of the power density.
    rig_stiffness : float
        Stiffness of a spring through which the shifts are given, N/m.
    tolerance : float, optional
        Error that a jump may leave of the worn depth (default 0.01); jumps are as long as that
        lets.
    jumps, explicit_jumps : int, optional
        That many jumps of equal length instead, implicit or explicit.
    worn_through : "stop" or "go_on"
        What happens when a coating is worn through.
    tell_from : float
        Part of the coatings' thickness from which a worn depth is an event.
    start : WearResult, optional
        Worn surfaces to begin on, those of its last block, as after another stroke; cycles, energy
        and volumes count on. The grid must be the same.
    out : path, optional
        Result store to write while the run goes on; it must not exist. :func:`resume` goes on
        with a run that was interrupted. Without it the result is in memory only.
    overwrite : bool
        Whether a store at `out` is replaced, once the first jump is done (default False).
    progress : bool
        Whether to draw a progress bar on a terminal or in a notebook.

    Raises
    ------
    InvalidSceneError, ValueError
        Scene or wear have no meaning; the message names the key, the value and what is allowed.
    """
    check_choice("cycling", cycling, get_args(Cycling))
    check_choice("worn_through", worn_through, get_args(WornThrough))
    check_counts(first_branch=first_branch, jumps=jumps, explicit_jumps=explicit_jumps)
    begins = None if start is None else surfaces(start)
    done = 0.0 if begins is None else begins[0]
    given = {"tolerance": tolerance, "jumps": jumps, "explicit_jumps": explicit_jumps}
    if sum(value is not None for value in given.values()) > 1:
        raise ValueError(f"{', '.join(given)}: one of them at most")
    for name, share, law in (("1", share1, body1), ("2", share2, body2)):
        if share is not None and law is None:
            raise ValueError(f"share{name} = {share}: must come with a law, body{name}")
    if path is not None:
        scene = scene.replace(path=path)

    with Progress(title=scene.title or "wear", shown=progress) as bar:
        kept = _core.wear(
            scene,
            body1=body1,
            body2=body2,
            cycles=cycles,
            store=out,
            overwrite=overwrite,
            share1=share1,
            share2=share2,
            first_branch=first_branch,
            debris_kept=debris_kept,
            frequency=frequency,
            start=begins,
            sliding=cycling == "sliding",
            rig_stiffness=rig_stiffness,
            tolerance=tolerance,
            jumps=jumps,
            explicit_jumps=explicit_jumps,
            go_on=worn_through == "go_on",
            tell_from=tell_from,
            on_jump=lambda now: bar.update(round(now - done), round(cycles)),
        )
    if kept is not None:
        return WearResult(dataset(*kept))
    if out is None:
        raise RuntimeError("a run without a store is in memory")
    return open(out)


def check_choice(name: str, value: str, allowed: tuple[str, ...]) -> None:
    """Refuse what is none of the words that are allowed."""
    if value not in allowed:
        words = " or ".join(f'"{word}"' for word in allowed)
        raise ValueError(f"{name} = {value!r}: must be {words}")


def check_counts(**counts: int | None) -> None:
    """Refuse numbers below 1; None is left to its default."""
    for name, count in counts.items():
        if count is not None and count < 1:
            raise ValueError(f"{name} = {count}: must be 1 or more")


def surfaces(start: WearResult) -> tuple[float, float, list[NDArray[np.float64]]]:
    """The worn surfaces at the end of a run."""
    d = start.dataset
    names = ("worn1", "worn2", "energy1", "energy2", "slid")
    fields = [np.asarray(d[name][-1].values, dtype=float) for name in names]
    return float(d.block_cycles[-1]), float(d.dissipated[-1]), fields


def resume(
    store: str | os.PathLike[str],
    *,
    body1: WearLaw | list[WearLaw | None] | None = None,
    body2: WearLaw | list[WearLaw | None] | None = None,
    friction_law: FrictionFunction | None = None,
    progress: bool = True,
) -> WearResult:
    """Go on with a run of :func:`solve` or ``fret wear`` that ended early, to the same bits.

    Parameters
    ----------
    store : path
        Store of the run.
    body1, body2 : law or list of laws, optional
        Functions that the run wore by, which no store can hold.
    friction_law : callable, optional
        The function of its friction, ``Friction(mu, law=...)``, which no store can hold either.
    progress : bool
        Whether to draw a progress bar.

    Raises
    ------
    StoreError
        There is no run of wear, or its checkpoint is damaged or of another version of pyfret.
    """
    with Progress(title="resumed", shown=progress):
        _core.resume_wear(store, body1=body1, body2=body2, friction_law=friction_law)
    return open(store)


def open(store: str | os.PathLike[str]) -> WearResult:
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
