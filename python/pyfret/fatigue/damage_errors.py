"""Errors of the damage by a load history, by their sources, at the worst point.

========== =====================================================================================
cells      change of the largest damage of its depth on cells twice as large
increments change by the error of the shear that the increments leave
amplitudes change to every second amplitude of the table, over 3: linear between amplitudes
classes    change to half as many classes of loops, over 3: linear within a class
memory     difference of the loops of a stretch that is marched, root mean square by damage
planes     most that another plane may have
========== =====================================================================================
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pyfret import _core
from pyfret._util.lazy import xr
from pyfret.fatigue.cycle_section import max_path_error, section_body
from pyfret.history.states import LoopStates, branch_ends
from pyfret.history.table import COARSE_FACTOR
from pyfret.quantities import as_layers

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from pyfret.fatigue.loop_damage import JudgedSection
    from pyfret.history.stretch import StretchCheck
    from pyfret.history.table import HistoryTable
    from pyfret.run.run import Run

__all__ = ["damage_errors"]

#: Classes of range and mean for the error of the classes.
FEWER_CLASSES = (20, 4)
#: Error over the change to half as many parts of a piecewise linear interpolation.
INTERPOLATION = 1.0 / 3.0


def damage_errors(
    judged: JudgedSection,
    states: LoopStates,
    dataset: xr.Dataset,
    table: HistoryTable | None,
) -> dict[str, float]:
    """Return the errors of the largest damage by their sources."""
    largest = float(dataset.damage.max())
    errors = {"planes": float(dataset.attrs["missed"])}
    if not largest > 0.0:
        return errors
    row, increments = judged.worst_row(judged.run)
    point = row[:, judged.worst_column]

    def change(changed: LoopStates, factor: float = 1.0) -> float:
        """Change of the damage at the worst point by other states of the loops."""
        parts = parts_at(judged, changed, factor * point, increments)
        return abs(float(parts.sum()) - float(by_states.sum()))

    by_states = parts_at(judged, states, point, increments)
    path_error = max_path_error(judged.run)
    if path_error is not None:
        errors["increments"] = change(states, 1.0 + path_error)
    coarse = None if table is None else table.coarse_run
    kept = np.searchsorted(increments, states.increments)
    errors["cells"] = cell_error(judged, states, row[kept], coarse)
    if table is not None:
        if table.amplitudes.size > 1:
            errors["amplitudes"] = INTERPOLATION * change(table.loop_states(coarse=True))
        if table.is_grouped:
            errors["classes"] = INTERPOLATION * change(table.loop_states(FEWER_CLASSES))
        if table.check is not None:
            relative = memory_error(judged, table.check, states.rows[:, 0], by_states)
            errors["memory"] = relative * largest
    return errors


def parts_at(
    judged: JudgedSection,
    states: LoopStates,
    stress: NDArray[np.float64],
    increments: NDArray[np.int64],
) -> NDArray[np.float64]:
    """Return the damage of each row of loops at a point, of its stress over the increments."""
    kept = np.searchsorted(increments, states.increments)
    of_loops = np.einsum("lmi,ic->lmc", states.weights, stress[kept])[:, :, None]
    fields = judged.judge(judged.worst_layer, of_loops, states.rows[:, 2], bounded=True)
    return np.asarray(fields["parts"][0])


def memory_error(
    judged: JudgedSection,
    check: StretchCheck,
    ranges: NDArray[np.float64],
    parts: NDArray[np.float64],
) -> float:
    """Return the part of the damage that the memory of the contact may change.

    Each loop of the stretch stands for the loops of the history that are nearest in range. The root
    mean square of their differences is the error of the sum if all loops err alike.
    """
    marched, by_table = (
        parts_at(judged, states, stress[:, judged.worst_column], increments) / states.rows[:, 2]
        for states, (stress, increments) in (
            (check.stretch.states, judged.worst_row(check.stretch.run)),
            (check.table_states, judged.worst_row(judged.run)),
        )
    )
    nearest = np.abs(ranges[:, None] - check.stretch.states.rows[None, :, 0]).argmin(axis=1)
    weights = np.bincount(nearest, parts, by_table.size)
    judged_loops = by_table > 0.0
    difference = np.where(
        judged_loops, marched / np.where(judged_loops, by_table, 1.0) - 1.0, marched > 0.0
    )
    total = float(weights.sum())
    return float(np.sqrt((weights * difference**2).sum() / total)) if total > 0.0 else 0.0


def cell_error(
    judged: JudgedSection, states: LoopStates, row: NDArray[np.float64], coarse_run: Run | None
) -> float:
    """Return the error of the largest damage by the cells.

    It is the change to the same table on half of the cells along each side. Without one the
    tractions are averaged over pairs of cells, and the larger change of two pairings counts. Damage
    is a power of the stress, so that its logarithm is compared.
    """
    fine = largest_of_row(judged, states, row)
    if coarse_run is not None:
        # The same branches have other increments on other cells.
        increments = np.array(sorted(set(branch_ends(coarse_run).values())))
        stress, of_stress = judged.worst_row(coarse_run)
        rows = [stress[np.searchsorted(of_stress, increments)]]
    else:
        rows = [averaged_row(judged, states, pairing) for pairing in (0, 1)]
    coarse = [largest_of_row(judged, states, row) for row in rows]
    changes = [abs(np.log(damage / fine)) for damage in coarse if damage > 0.0]
    return fine * float(np.expm1(COARSE_FACTOR * max(changes))) if changes else fine


def largest_of_row(judged: JudgedSection, states: LoopStates, row: NDArray[np.float64]) -> float:
    """Return the largest damage at points of the worst layer.

    ``row`` is their stress: (increment, point, component).
    """
    of_loops = np.einsum("lmi,ipc->lmpc", states.weights, row)
    fields = judged.judge(judged.worst_layer, of_loops, states.rows[:, 2])
    return float(fields["damage"].max())


def averaged_row(judged: JudgedSection, states: LoopStates, pairing: int) -> NDArray[np.float64]:
    """Return the stress along the worst depth under tractions on cells twice as large."""
    section, run = judged.section, judged.run
    stress = _core.section_of_states(
        section_body(run, section),
        averaged_states(run, states.increments, section.body_number, pairing),
        [judged.worst_depth],
        [judged.worst_layer],
        residual=as_layers(section.residual),
        **section.line.named(),
        body_number=section.body_number,
    )
    return np.moveaxis(stress, 1, -1)[:, 0]


def averaged_states(
    run: Run, increments: NDArray[np.int64], body_number: int, pairing: int
) -> _core.States:
    """Return states whose tractions are averaged over pairs of cells along x and y.

    They stand on the cells of the grid, so that the stress is at the same places. The second
    pairing begins one cell later.
    """
    grid, variables = run.scene.grid, run.dataset.variables
    saved = variables["saved_increment"].values
    places = [int(np.flatnonzero(saved == n)[-1]) for n in increments]

    def averaged(field: NDArray[np.float64], axis: int) -> NDArray[np.float64]:
        """Average a field over pairs of cells along an axis, the pairs beginning at `pairing`."""
        size = field.shape[axis]
        if size == 1:
            return field
        cells = np.moveaxis(field, axis, 0)
        padding = [(pairing, (size + pairing) % 2)] + [(0, 0)] * (field.ndim - 1)
        pairs = np.pad(cells, padding)
        means = np.repeat(0.5 * (pairs[0::2] + pairs[1::2]), 2, axis=0)
        return np.moveaxis(means[pairing : pairing + size], 0, axis)

    def means(name: str) -> list[NDArray[np.float64]]:
        """Return the averaged fields of a name for all increments."""
        fields = (variables[name].isel(saved=n).values.astype(float) for n in places)
        return [np.ascontiguousarray(averaged(averaged(field, 0), 1)) for field in fields]

    numbers = variables["increment"].values
    bulk = variables["sigma_B1" if body_number == 1 else "sigma_B"].values
    return _core.States(
        grid,
        **{name: means(name) for name in ("p", "q_x", "q_y")},
        stick=[mean > 0.0 for mean in means("stick")],
        sigma_B=[float(bulk[np.flatnonzero(numbers == n)[0]]) for n in increments],
        eigenstress=[],
    )
