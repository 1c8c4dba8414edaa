"""Parts of a table that are marched at the same time, and the table that they make together.

Where the rule of memory holds, a loop does not depend on larger loops before it. So every second
amplitude, or every fourth, has a path of its own. Elsewhere the loops of several means have a path
of their own, which begins with the largest loop. The number of parts does not depend on the
processors, so that every machine gets the same bits.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._core import LoadPath
from pyfret._util.lazy import xr
from pyfret.history.ladder import Ladder
from pyfret.run.run import Run

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from pyfret._core import Scene
    from pyfret.history.ladder import Companions
    from pyfret.history.load_history import LoadHistory
    from pyfret.history.mean_grid import MeanGrid

__all__ = ["build_parts", "join_ladders", "join_runs"]

#: Amplitudes of a part where the rule of memory holds.
AMPLITUDES = 4
#: Name of the part with loops of several means.
MEANS_PART = "means"


def build_parts(
    scene: Scene,
    history: LoadHistory,
    levels: NDArray[np.float64],
    companions: Companions,
    *,
    exact: bool,
    settling: int,
) -> dict[str, Ladder]:
    """Build the paths of a table by the names of their runs.

    Parameters
    ----------
    scene, history, companions
        Contact, history, and how its other channels follow the counted one.
    levels : array
        Rows of amplitude, mean, count, largest first.
    exact : bool
        Whether the rule of memory holds.
    settling : int
        Loops of the largest amplitude that settle the contact.
    """
    count = len(levels)
    number = -(-count // AMPLITUDES) if exact else 1
    name = f"{count}_amplitudes"
    parts = {
        name if number == 1 else f"{name}_{k + 1}_of_{number}": Ladder.build(
            scene, history, levels[k::number], companions, settling=settling
        )
        for k in range(number)
    }
    if not exact and not companions.turns and count > 1:
        parts[MEANS_PART] = Ladder.build(
            scene, history, levels[:1], companions, settling=settling, with_means=True
        )
    return parts


def join_ladders(parts: dict[str, Ladder]) -> Ladder:
    """Join ladders to one, whose branches are numbered through all paths."""
    first = next(iter(parts.values()))
    rows: list[tuple[Any, ...]] = []
    grid: MeanGrid | None = None
    before = 0
    for name, part in parts.items():
        if name == MEANS_PART:
            assert part.grid is not None
            grid = part.grid.shifted(before)
        else:
            ends = zip(part.branches, part.tops, part.bottoms, part.quarters, strict=True)
            for level, (branches, top, bottom, quarters) in zip(part.levels, ends, strict=True):
                numbers = (*branches, top, bottom, *quarters)
                rows.append((level, *(before + number for number in numbers)))
        before += len(part.path.branches)
    rows.sort(key=lambda row: -row[0][0])
    levels, starts, ends_of_loops, tops, bottoms, falling, rising = zip(*rows, strict=True)
    return replace(
        first,
        path=join_paths([part.path for part in parts.values()]),
        levels=np.array(levels),
        branches=list(zip(starts, ends_of_loops, strict=True)),
        tops=list(tops),
        bottoms=list(bottoms),
        quarters=list(zip(falling, rising, strict=True)),
        grid=grid,
    )


def join_paths(paths: Sequence[LoadPath]) -> LoadPath:
    """Join paths to one, in which each begins at the time when the one before it ends."""
    branches = []
    time = 0.0
    for path in paths:
        branches += [branch.replace(t=time + branch.t) for branch in path.branches]
        time += path.branches[-1].t
    return LoadPath(branches, rig_stiffness=paths[0].rig_stiffness)


def join_runs(runs: Sequence[Run]) -> Run:
    """Join runs of the same cells; increments and branches are numbered through all of them."""
    if len(runs) == 1:
        return runs[0]
    datasets, errors = [], []
    increments = branches = 0
    time = 0.0
    for run in runs:
        d = run.dataset
        shifts = {
            "increment": increments,
            "saved_increment": increments,
            "branch_of_increment": branches,
            "t": time,
            "saved_t": time,
        }
        coords = {
            name: (d[name].dims, d[name].values + d[name].dtype.type(shift), d[name].attrs)
            for name, shift in shifts.items()
        }
        datasets.append(d.assign_coords(coords))
        increments = int(coords["increment"][1][-1])
        branches = int(coords["branch_of_increment"][1][-1]) + 1
        time = float(coords["t"][1][-1])
        errors += list(d.attrs.get("path_error") or [])
    along = {
        dim: [d[[k for k, v in d.variables.items() if dim in v.dims]] for d in datasets]
        for dim in ("increment", "saved")
    }
    joined = xr.merge(
        [xr.concat(parts, dim=dim) for dim, parts in along.items()],
        combine_attrs="override",
    )
    scene = runs[0].scene.replace(path=join_paths([run.scene.path for run in runs]))
    attrs = {**runs[0].dataset.attrs, "scene": scene.to_toml()}
    if errors:
        attrs["path_error"] = errors
    return Run(joined.assign_attrs(attrs))
