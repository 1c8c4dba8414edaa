"""The stress of a run over a closed cycle of its load path."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, TypeAlias, get_args

import numpy as np

from pyfret import _core
from pyfret._util.arrays import plain
from pyfret._util.lazy import xr
from pyfret.fatigue.criteria import COMPONENTS
from pyfret.fatigue.plastic_strain import GROWS, plastic_strain_grows, plastic_strain_history
from pyfret.quantities import (
    Angle,
    LayerStresses,
    Length,
    Lengths,
    as_layers,
    as_number,
    quantities,
)
from pyfret.subsurface.contact import stress_below
from pyfret.subsurface.fields import coordinates
from pyfret.subsurface.line import Line
from pyfret.subsurface.moments import states_of_increments

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike, NDArray

    from pyfret.run import Run

__all__ = ["cycle_increments", "history", "moment_before"]

#: The quantity of a history.
HistoryKind: TypeAlias = Literal["stress", "plastic_strain"]
#: Increments whose stresses are computed together: the kernels of a depth cost as much as ten.
TOGETHER = 32


@quantities
def cycle_increments(result: Run, cycle: int | None = -1) -> NDArray[np.int64]:
    """Return the kept increments of a closed cycle of the path, from 1; all of them for None.

    A ValueError for a missing cycle, or one with fewer than two kept increments.
    """
    saved = np.asarray(result.dataset.saved_increment.values)
    kept = saved if cycle is None else saved[_is_in_cycle(result, saved, cycle)]
    if kept.size < 2:
        kind = "path" if cycle is None else "cycle"
        raise ValueError(
            f"{kept.size} increments of the {kind} were kept: solve with save='all' or more of them"
        )
    return kept


def moment_before(result: Run, kept: NDArray[np.int64]) -> int | None:
    """Return the increment at which the branch of the first kept one begins; None if not kept."""
    branch = result.dataset.branch_of_increment
    first = int(branch.sel(increment=int(kept[0])))
    begin = int(result.dataset.increment.values[(branch == first).values][0])
    saved = result.dataset.saved_increment.values
    return begin - 1 if begin - 1 in saved else None


def _is_in_cycle(result: Run, saved: NDArray[np.int64], cycle: int) -> NDArray[np.bool_]:
    """Mark the kept increments that lie in a cycle."""
    branches = result.dataset.branch_of_increment
    cycles = result.scene.path.whole_cycles(increments=branches.size)
    count = len(cycles)
    if count == 0:
        raise ValueError(
            f"{result.scene.path.no_cycle()}: a cycle is needed, as path.cycles(1, T_x=...) or "
            "path.sine(2, T_x=...) make it. The stress of one state is result.at(-1).stress()"
        )
    if not -count <= cycle < count:
        raise ValueError(f"cycle = {cycle}: must be {-count} to {count - 1}, a cycle of the path")
    first, last = cycles[cycle]
    branch = branches.sel(increment=saved).values
    return np.asarray((branch >= first) & (branch <= last))


@quantities
def history(
    result: Run,
    z: Lengths,
    *,
    x: Length | None = None,
    y: Length | None = None,
    azimuth: Angle | None = None,
    body_number: int = 2,
    cycle: int | None = -1,
    residual: LayerStresses | None = None,
    of: HistoryKind = "stress",
) -> xr.DataArray:
    """Return the stress over a closed cycle of a run whose increments were kept.

    It is the input of a criterion. A criterion of strain also takes the plastic strain, where it
    grows within the cycle.

    Parameters
    ----------
    result : Result
        Solved with ``save="all"``, or with the increments of the cycle.
    z, x, y, azimuth, body_number
        Where, as in :meth:`Snapshot.stress`.
    cycle : int, optional
        Which of the closed cycles of the load path, the last by default; None for all increments
        that were kept.
    residual : sequence, optional
        Residual stress of every layer, as in :class:`Section`.
    of : str
        The stress, or the plastic strain at the same points (tensor components xx, yy, zz, xy, xz,
        yz; zero in a body that stays elastic).

    Returns
    -------
    DataArray of dims (increment, ..., component)
        Stress [Pa] or strain with the coordinates of the places, ``layer`` among them.
    """
    if of not in get_args(HistoryKind):
        raise ValueError(f"of = {of!r}: must be 'stress' or 'plastic_strain'")
    kept = cycle_increments(result, cycle)
    line = Line(as_number(x), as_number(y), as_number(azimuth))
    if of == "plastic_strain":
        return plastic_strain_history(result, kept, z, line, body_number)
    stress = _cycle_stress(result, kept, z, line, body_number, as_layers(residual))
    return (
        stress.assign_attrs({GROWS: True})
        if plastic_strain_grows(result, kept, body_number)
        else stress
    )


def _cycle_stress(
    result: Run,
    kept: NDArray[np.int64],
    z: ArrayLike,
    line: Line,
    body_number: int,
    residual: Sequence[ArrayLike] | None,
) -> xr.DataArray:
    """Compute the stress of the increments of a cycle."""
    x, y, azimuth = line
    if azimuth is None and (x is None) == (y is None):
        return _stack_snapshot_stresses(result, kept, z, x, y, body_number, residual)
    scene = result.scene
    body = scene.body1 if body_number == 1 else scene.body2
    wanted_depths = np.atleast_1d(plain(z, "z")).tolist()
    depths, layers = _core.depths(body, wanted_depths)
    parts = []
    for group in np.array_split(kept, int(np.ceil(kept.size / TOGETHER))):
        stress = _core.section_of_states(
            body,
            states_of_increments(result, group.tolist(), body_number),
            depths,
            layers,
            residual=residual,
            x=x,
            y=y,
            azimuth=azimuth,
            body_number=body_number,
        )
        parts.append(np.moveaxis(stress, 1, -1))
    along = line.axis
    stacked = xr.DataArray(
        np.concatenate(parts),
        dims=("increment", "depth", along, "component"),
        coords={
            **xr.Dataset(coords=coordinates(scene.grid, depths, layers, x, y, azimuth)).coords,
            "increment": kept,
            "component": list(COMPONENTS),
        },
    )
    return stacked.assign_attrs(units="Pa", long_name="stress").rename("stress")


def _stack_snapshot_stresses(
    result: Run,
    kept: NDArray[np.int64],
    z: ArrayLike,
    x: float | None,
    y: float | None,
    body_number: int,
    residual: Sequence[ArrayLike] | None,
) -> xr.DataArray:
    """Compute the stress of every increment by itself, where it is no section."""
    snapshots = (
        stress_below(result.at(int(n)), z, x=x, y=y, body_number=body_number, residual=residual)
        for n in kept
    )
    # Its scalars differ from increment to increment; the places are the same.
    stresses = [stress.dataset[list(COMPONENTS)].to_array("component") for stress in snapshots]
    stacked = xr.concat(stresses, dim="increment", coords="minimal", compat="override")
    stacked = stacked.assign_coords(increment=kept)
    dims = [d for d in stacked.dims if d not in ("increment", "component")]
    stacked = stacked.transpose("increment", *dims, "component").copy()
    return stacked.assign_attrs(units="Pa", long_name="stress").rename("stress")
