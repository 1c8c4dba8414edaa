"""Wear: what many cycles do to the surfaces."""

from __future__ import annotations

import math
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, get_args

from pyfret import _core
from pyfret._util.lazy import xr
from pyfret._util.progress import Progress

if TYPE_CHECKING:
    import os

    from pyfret._core import LoadPath, Scene
    from pyfret._core import _WearLaw as WearLaw

__all__ = ["WearResult", "open", "resume", "solve"]

#: How the contact of a cycle is solved, and what happens when a coating is worn through.
Cycling = Literal["march", "sliding"]
WornThrough = Literal["stop", "go_on"]


class WearResult:
    """Worn surfaces over blocks of cycles, and the numbers of every jump.

    ``dataset`` has the scalars over ``jump`` (coordinate ``cycles``): ``volume1``, ``volume2``,
    ``depth1``, ``depth2``, ``dissipated``, ``p_max``, ``stick_ratio``, ``depth_error``, ...; the
    fields
    ``worn1``, ``worn2``, ``p``, ``stick`` over ``block``, ``x``, ``y`` (coordinate
    ``block_cycles``), and
    the friction loops ``loop_delta_x``, ``loop_T_x``, ... over ``block``, ``corner``.
    """

    def __init__(self, dataset: xr.Dataset) -> None:
        self.dataset = dataset

    def __getattr__(self, name: str) -> Any:
        """Give a variable or an attribute of the dataset."""
        if not name.startswith("_"):
            if name in self.dataset:
                return self.dataset[name]
            if name in self.dataset.attrs:
                return self.dataset.attrs[name]
        raise AttributeError(f"a wear result has no {name!r}")

    @property
    def worn(self) -> xr.DataArray:
        """Depth worn off both bodies together, read with no shift between them, m."""
        total: xr.DataArray = self.dataset.worn1 + self.dataset.worn2
        return total

    @property
    def events(self) -> list[dict[str, Any]]:
        """What happened to the coatings: kind, cycles, body, coating, x, y."""
        return list(self.dataset.attrs["events"])

    def __repr__(self) -> str:
        """Tell the cycles and the depths."""
        d = self.dataset
        return (
            f"WearResult({float(d.cycles[-1]):.0f} cycles in {d.sizes['jump']} jumps, depths "
            f"{float(d.depth1[-1]):.3e} m and {float(d.depth2[-1]):.3e} m)"
        )


def solve(
    scene: Scene,
    path: LoadPath | None = None,
    *,
    cycles: float,
    body1: WearLaw | list[WearLaw] | None = None,
    body2: WearLaw | list[WearLaw] | None = None,
    share1: float | None = None,
    share2: float | None = None,
    first_branch: int = 1,
    cycling: Cycling = "march",
    rig_stiffness: float = math.inf,
    tolerance: float | None = None,
    jumps: int | None = None,
    explicit_jumps: int | None = None,
    worn_through: WornThrough = "stop",
    tell_from: float = 0.1,
    out: str | os.PathLike[str] | None = None,
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
        substrate; None: it does not wear. A callable takes arrays over the cells, of one cycle:
        ``pressed_way`` (integral of the pressure over the way slipped, Pa m), ``way`` (slipped, m),
        ``dissipated`` (energy per area, J/m^2), ``worn`` (depth so far, m), and the number
        ``cycles`` so
        far, and gives the depth that the cycle takes, m.
    share1, share2 : float, optional
        Part of what its law says that a body loses (default 1).
    first_branch : int
        First branch of the path that belongs to the cycle, counted from 0; the cycle ends where it
        begins.
    cycling : "march" or "sliding"
        "march" solves the increments of the cycle, with stick and slip; "sliding" is for gross slip
        along x under given shifts, whatever the stroke: the normal contact alone at each place.
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
    out : path, optional
        Result store to write while the run goes on; it must not exist. :func:`resume` goes on
        with a run that was interrupted.
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
    given = {"tolerance": tolerance, "jumps": jumps, "explicit_jumps": explicit_jumps}
    if sum(value is not None for value in given.values()) > 1:
        raise ValueError(f"{', '.join(given)}: one of them at most")
    for name, share, law in (("1", share1, body1), ("2", share2, body2)):
        if share is not None and law is None:
            raise ValueError(f"share{name} = {share}: must come with a law, body{name}")
    if path is not None:
        scene = scene.replace(path=path)

    def run(store: str | os.PathLike[str]) -> None:
        with Progress(title=scene.title or "wear", shown=progress) as bar:
            _core.wear(
                scene,
                body1=body1,
                body2=body2,
                cycles=cycles,
                store=store,
                share1=share1,
                share2=share2,
                first_branch=first_branch,
                sliding=cycling == "sliding",
                rig_stiffness=rig_stiffness,
                tolerance=tolerance,
                jumps=jumps,
                explicit_jumps=explicit_jumps,
                go_on=worn_through == "go_on",
                tell_from=tell_from,
                on_jump=lambda done: bar.update(round(done), round(cycles)),
            )

    if out is not None:
        run(out)
        return open(out)
    with tempfile.TemporaryDirectory(prefix="pyfret-") as folder:
        store = Path(folder) / "wear.zarr"
        run(store)
        return WearResult(open(store).dataset.load())


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


def resume(store: str | os.PathLike[str], *, progress: bool = True) -> WearResult:
    """Go on with a run of :func:`solve` or ``fret wear`` that ended early, to the same bits.

    Raises
    ------
    StoreError
        There is no run of wear, or its checkpoint is damaged or of another version of pyfret.
    """
    with Progress(title="resumed", shown=progress):
        _core.resume_wear(store)
    return open(store)


def open(store: str | os.PathLike[str]) -> WearResult:
    """Open the store of a run of :func:`solve` or ``fret wear``."""
    data = xr.open_zarr(Path(store))
    return WearResult(data.set_coords(["cycles", "block_cycles"]))
