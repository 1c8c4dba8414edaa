"""Wear: what many cycles do to the surfaces."""

from __future__ import annotations

import math
import sys
import tempfile
from importlib import import_module
from os import fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, get_args

import numpy as np

from pyfret import _core
from pyfret._core import Scene, StoreError
from pyfret._util import files
from pyfret._util.labelled import Labelled
from pyfret._util.progress import Progress
from pyfret.scene.tables import table

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

if TYPE_CHECKING:
    import os

    import xarray as xr
    from numpy.typing import NDArray

    from pyfret._core import LoadPath
    from pyfret._core import _FrictionFunction as FrictionFunction
    from pyfret._core import _WearLaw as WearLaw

__all__ = ["WearResult", "open", "resume", "solve"]

#: How the contact of a cycle is solved, and what happens when a coating is worn through.
Cycling = Literal["march", "sliding"]
WornThrough = Literal["stop", "go_on"]


class WearResult(Labelled):
    """Worn surfaces over blocks of cycles, and the numbers of every jump.

    ``dataset`` has the scalars over ``jump`` (coordinate ``cycles``): ``volume1``, ``volume2``,
    ``depth1``, ``depth2``, ``debris``, ``dissipated``, ``p_max``, ``stick_ratio``,
    ``depth_error``, ...; the fields ``worn1``, ``worn2``, ``energy1``, ``energy2``, ``slid``,
    ``p``, ``stick`` over ``block``, ``x``, ``y`` (coordinate ``block_cycles``), and the friction
    loops ``loop_delta_x``, ``loop_T_x``, ... over ``block``, ``corner``.
    """

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

    def cycles_to(
        self,
        *,
        depth: float | None = None,
        part_of_coating: float | None = None,
        volume: float | None = None,
        body: int = 2,
        coating: int = 0,
    ) -> float:
        """Cycles after which a body has worn so far; infinite if the run does not get there.

        Within a jump the depth and the volume follow the parabola through its ends and its middle,
        so the error is that of the jumps (``depth_error``).

        Parameters
        ----------
        depth : float
            Deepest worn depth [m].
        part_of_coating : float
            The deepest depth, as a part of a coating's thickness: 1 is worn through.
        volume : float
            Volume lost [m^3].
        body : 1 or 2
            The body.
        coating : int
            The coating, 0 the outermost; those above it are worn through before.

        Raises
        ------
        ValueError
            Not one of the three is given, or the body has no such coating.
        """
        given = {"depth": depth, "part_of_coating": part_of_coating, "volume": volume}
        if sum(value is not None for value in given.values()) != 1:
            raise ValueError(f"{', '.join(given)}: give one of them")
        if body not in (1, 2):
            raise ValueError(f"body = {body}: must be 1 or 2")
        if part_of_coating is not None:
            scene = Scene.from_toml(self.dataset.attrs["scene"])
            coatings = (scene.body1 if body == 1 else scene.body2).coatings
            if not 0 <= coating < len(coatings):
                raise ValueError(f"coating = {coating}: body {body} has {len(coatings)} coatings")
            above = sum(layer.thickness for layer in coatings[:coating])
            depth = above + part_of_coating * coatings[coating].thickness
        name, target = ("volume", volume) if depth is None else ("depth", depth)
        return reached(self.dataset, f"{name}{body}", float(target or 0.0))

    @property
    def gap(self) -> xr.DataArray:
        """By how much the gap has grown: what both bodies lost less the debris that stays, m."""
        opened: xr.DataArray = (1.0 - self.debris_kept) * self.worn
        return opened

    @property
    def debris_kept(self) -> float:
        """Part of what both bodies lose that stays in the contact."""
        return float(tomllib.loads(self.dataset.attrs["wear"])["wear"].get("debris_kept", 0.0))

    def summary(self) -> str:
        """Depths, volumes, energy, jumps, laws and what happened to the coatings, as text."""
        d = self.dataset
        last = {name: float(d[name][-1]) for name in d.data_vars if d[name].dims == ("jump",)}
        volume, energy = (d[name].attrs["units"] for name in ("volume1", "dissipated"))
        lines = [
            str(d.attrs.get("title") or "wear"),
            f"{float(d.cycles[-1]):.6g} cycles in {d.sizes['jump']} jumps, status: "
            f"{d.attrs['status']}",
        ]
        for body in (1, 2):
            if last[f"volume{body}"] > 0:
                lines.append(
                    f"body {body}: {1e6 * last[f'depth{body}']:.4g} um deep "
                    f"(+- {last['depth_error']:.1%} of the jumps), {last[f'volume{body}']:.4g} "
                    f"{volume}"
                )
        if self.debris_kept:
            lines.append(
                f"debris: {self.debris_kept:g} of it stays in the contact, {last['debris']:.4g} "
                f"{volume}"
            )
        lines.append(
            f"energy: {last['dissipated']:.4g} {energy}, {last['dissipated_per_cycle']:.4g} in "
            "the last cycle"
        )
        lines.append(
            f"largest pressure: {1e-6 * last['p_max']:.4g} MPa, stick ratio "
            f"{last['stick_ratio']:.3f}"
        )
        lines += [
            f"{event['kind']} after {event['cycles']:.0f} cycles: body {event['body']}, coating "
            f"{event['coating']}, at x = {1e6 * event['x']:.1f} um, y = {1e6 * event['y']:.1f} um"
            for event in self.events
        ]
        says = tomllib.loads(d.attrs["wear"])["wear"]
        for body in (1, 2):
            laws = says.get(f"body{body}", {}).get("laws", [])
            lines += [f"law of body {body}: {written(law)}" for law in laws]
        return "\n".join(lines)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the result to a Zarr folder (``.zarr``) or a NetCDF file (``.nc``).

        :func:`open` opens both. The place must be free.

        Raises
        ------
        FileExistsError
            There is something already.
        ValueError
            The ending is another.
        """
        files.write(self.dataset.load().drop_encoding(), path)

    def report(self, path: str | os.PathLike[str]) -> None:
        """Write a page for a browser: the contact on its unworn surfaces, and what wears."""
        # Reports and solutions stand above wear.
        above = [import_module(f"pyfret.{name}") for name in ("solution", "report")]
        scene = Scene.from_toml(self.dataset.attrs["scene"])
        above[1].report(above[0].solve(scene, progress=False), path, wear=self)

    @property
    def events(self) -> list[dict[str, Any]]:
        """What happened to the coatings: kind, cycles, body, coating, x, y."""
        return list(self.dataset.attrs["events"])

    def _repr_html_(self) -> str:
        """Cycles and depths of the blocks, for notebooks."""
        d = self.dataset
        at = [int(abs(d.cycles.values - of).argmin()) for of in d.block_cycles.values]
        rows = [
            [f"{float(d.cycles[n]):.4g}"]
            + [f"{1e6 * float(d[name][n]):.4g}" for name in ("depth1", "depth2")]
            + [f"{1e-6 * float(d.p_max[n]):.4g}"]
            for n in at
        ]
        heading = ["cycles", "depth, body 1 [µm]", "depth, body 2 [µm]", "p_max [MPa]"]
        return table(heading, rows)

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


def surfaces(start: WearResult) -> tuple[float, float, list[NDArray[np.float64]]]:
    """The worn surfaces at the end of a run."""
    d = start.dataset
    names = ("worn1", "worn2", "energy1", "energy2", "slid")
    fields = [np.asarray(d[name][-1].values, dtype=float) for name in names]
    return float(d.block_cycles[-1]), float(d.dissipated[-1]), fields


def reached(d: xr.Dataset, name: str, target: float) -> float:
    """Cycles at which a growing number of the jumps reaches a value, by parabolas."""
    ends, middles, length = (np.asarray(d[k].values) for k in (name, f"{name}_halfway", "length"))
    if target <= 0.0:
        return float(d.cycles[0] - length[0])
    jumps = np.flatnonzero(ends >= target)
    if jumps.size == 0:
        return math.inf
    n = int(jumps[0])
    quantity, body = name[:-1], int(name[-1])
    start = float(ends[n - 1]) if n else float(d.attrs[f"{quantity}_before"][body - 1])
    whole, asked = float(ends[n]) - start, target - start
    if not (asked > 0.0 and whole > 0.0):
        return float(d.cycles[n] - length[n])
    half = min(max(float(middles[n]) - start, 0.25 * whole), 0.75 * whole)
    slope, bend = 4.0 * half - whole, 2.0 * whole - 4.0 * half
    part = 2.0 * asked / (slope + math.sqrt(max(slope**2 + 4.0 * bend * asked, 0.0)))
    return float(d.cycles[n] - length[n] * (1.0 - min(part, 1.0)))


def written(law: dict[str, Any]) -> str:
    """A law in words."""
    if law.get("own"):
        return "a function"
    name, unit = ("k", "m^2/N") if "k" in law else ("alpha", "m^3/J")
    if not law[name]:
        return "does not wear"
    text = f"{name} = {law[name]:.4g} {unit}"
    if law.get("threshold"):
        text += f", threshold {law['threshold']:.4g}"
    return text + (f", times a function of {law['factor']['of']}" if "factor" in law else "")


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
    if not files.is_copy(store):
        _core.verify_wear(store)
    data = files.opened(store)
    if "wear" not in data.attrs or "block" not in data.sizes:
        raise StoreError(f"{fspath(store)}: holds no run of wear")
    return WearResult(data.set_coords(["cycles", "block_cycles"]))
