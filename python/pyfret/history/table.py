"""The table of a history: loops of a few amplitudes, marched once, for any number of counted ones.

The energy of a loop is interpolated over its amplitude (:mod:`pyfret.history.energy_curve`), and a
state by the rule of memory (:mod:`pyfret.history.memory`). Both are exact for elastically like
bodies under a constant normal force, up to the interpolation. For other contacts a grid of means is
marched as well (:mod:`pyfret.history.mean_grid`). One stretch of the history is marched, too, and
the difference is the error (:mod:`pyfret.history.stretch`).
"""

from __future__ import annotations

import math
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from pyfret import _core
from pyfret._core import InvalidSceneError, NoConvergenceError, OffGridError
from pyfret._util.numbers import format_number
from pyfret._util.window import wrap
from pyfret.history.channels import load_of
from pyfret.history.counting import rearranged
from pyfret.history.energy_curve import EnergyCurve
from pyfret.history.ladder import Companions, Ladder, check_sliding, follow_channels
from pyfret.history.load_history import LoadHistory, press
from pyfret.history.loops import CountedLoops, distinct
from pyfret.history.marching import Marches
from pyfret.history.mean_grid import MEANS, SIDES, SIZES, grid_weights, memory_of_loops
from pyfret.history.memory import amplitude_weights, state_weights
from pyfret.history.parts import build_parts, join_ladders, join_runs
from pyfret.history.scatter import record_scatter
from pyfret.history.states import (
    LoopStates,
    branch_ends,
    group_loops,
    loops_as_levels,
    loops_as_rows,
)
from pyfret.history.stretch import Stretch, StretchCheck

if TYPE_CHECKING:
    import os

    from numpy.typing import NDArray

    from pyfret._core import Scene
    from pyfret.run.run import Run

__all__ = ["HistoryTable"]

#: Amplitudes of a table: at first, and at most.
FEWEST, MOST = 8, 16
#: Part of the energy that the interpolation may leave.
TOLERANCE = 5e-3
#: Loops whose states are followed one by one. More of them become classes of range and mean.
MOST_LOOPS, CLASSES = 400, (40, 8)
#: Line of the plan of a scene whose pressure does not depend on its shear.
UNCOUPLED = "skipped: normal-tangential coupling"
#: Settling loops of a contact whose pressure depends on its shear.
SETTLING = 2
#: Error over the change to cells twice as large, as for the worst point of a criterion.
COARSE_FACTOR = 1.25
#: Cells along x from which half of them are marched, too.
LEAST_CELLS = 32


class HistoryTable:
    """Loops of a few amplitudes on a contact, for the counted loops of a history.

    Made by :meth:`build`.
    """

    def __init__(
        self,
        scene: Scene,
        history: LoadHistory,
        loops: CountedLoops,
        companions: Companions,
        ladder: Ladder,
        run: Run,
    ) -> None:
        self.scene, self.history, self.loops = scene, history, loops
        self.companions, self.ladder, self.run = companions, ladder, run
        #: Amplitudes, ascending, and the energy of their loops [J].
        self.amplitudes = ladder.levels[::-1, 0].copy()
        self.energies = self._energies_of(ladder.branches[::-1])
        #: Energy over the amplitude.
        self.curve = self._curve_of(run)
        self.check: StretchCheck | None = None
        #: The run on half of the cells along each side.
        self.coarse_run: Run | None = None

    def _energies_of(
        self, branches: list[tuple[int, int]], run: Run | None = None
    ) -> NDArray[np.float64]:
        """Return the energy of ranges of branches, first to last [J]."""
        dissipated = (run or self.run).branches().dissipated.values
        return np.array([float(dissipated[a : b + 1].sum()) for a, b in branches])

    def _curve_of(self, run: Run) -> EnergyCurve:
        """Return the energy over the amplitude, from the loops of a run."""
        ladder, ends, d = self.ladder, branch_ends(run), run.dataset
        tops, bottoms = (
            np.searchsorted(d.increment.values, [ends[branch] for branch in branches[::-1]])
            for branches in (ladder.tops, ladder.bottoms)
        )
        sticks = d["stick_ratio"].values
        slides = (sticks[tops] == 0.0) & (sticks[bottoms] == 0.0)
        # Gross slip of loops of smaller ones would be an effect of the cells.
        slides = np.logical_and.accumulate(slides[::-1])[::-1]
        force = d[load_of(self.history.channel)].values
        reach = abs(float(force[tops[-1]] - force[bottoms[-1]]))
        energies = self._energies_of(ladder.branches[::-1], run)
        return EnergyCurve(self.amplitudes, energies, slides, reach)

    @classmethod
    def build(
        cls,
        scene: Scene,
        history: LoadHistory,
        *,
        tolerance: float = TOLERANCE,
        check: bool | None = None,
        store: str | os.PathLike[str] | None = None,
        progress: bool = True,
    ) -> HistoryTable:
        """March the loops of a table: 8 amplitudes, or 16 where 8 are too few.

        Parameters
        ----------
        scene : Scene
            The contact; the first branches of its path press the bodies.
        history : LoadHistory
            The history.
        tolerance : float
            Part of the energy that the interpolation over the amplitude may leave.
        check : bool, optional
            Whether a stretch of the history is marched beside the table (default: where the rule of
            memory is no more than an approximation).
        store : path, optional
            Folder that keeps the runs of the table. A call that was interrupted goes on from there.
        progress : bool
            Whether to draw a progress bar.
        """
        loops = history.count()
        if loops.dataset.sizes["loop"] == 0:
            raise ValueError("the history has no loop: must vary")
        companions = follow_channels(history)
        check_sliding(scene, history, loops_as_levels(loops))
        first = history.block()[:1] if history.is_series else np.zeros(1, dtype=np.int64)
        marches = Marches(store, progress=progress)
        path = press(scene, history.channels, first)
        pressed = marches.run(scene.replace(path=path, save="branches"), "pressed")
        exact = keeps_memory(pressed, companions)
        settling = 0 if is_uncoupled(pressed) else SETTLING
        if check is None:
            check = not exact
        beside: dict[str, Scene] = {}
        if check:
            beside["stretch"], values = Stretch.plan(scene, history, loops, companions)
        table, onset = None, None
        for count in (FEWEST, MOST):
            levels = table_levels(loops, count, onset)
            parts = build_parts(scene, history, levels, companions, exact=exact, settling=settling)
            paths = scenes_of(scene, parts)
            runs = marches.run_all({**beside, **paths})
            ladder = join_ladders(parts)
            run = join_runs([runs[name] for name in parts])
            table = cls(scene, history, loops, companions, ladder, run)
            error = max(table.straight_error, table.interpolation_error)
            if len(levels) < count or error <= tolerance:
                break
            onset = table.curve.onset
        assert table is not None
        if check:
            stretch = Stretch.from_run(runs["stretch"], values, history, companions)
            states = table.states_of_series(stretch.values, stretch.loops)
            table.check = StretchCheck(stretch, states, table.energy_of_loops(stretch.loops))
        if scene.grid.nx % 4 == 0 and scene.grid.nx >= LEAST_CELLS:
            table.coarse_run = table.march_coarse(marches, parts)
        return table

    @property
    def is_exact(self) -> bool:
        """Whether the rule of memory holds: like bodies, constant W, channels in phase."""
        return keeps_memory(self.run, self.companions)

    def march_coarse(self, marches: Marches, parts: dict[str, Ladder]) -> Run | None:
        """March the table on half of the cells along each side; None where they are too few."""
        grid = self.scene.grid
        ny = grid.ny if grid.plane_strain else grid.ny // 2
        dy = grid.dy if grid.plane_strain else 2.0 * grid.dy
        if not grid.plane_strain and grid.ny % 2:
            return None
        cells = grid.replace(nx=grid.nx // 2, ny=ny, dx=2.0 * grid.dx, dy=dy)
        coarse = self.scene.replace(grid=cells)
        scenes = {f"half_of_the_cells_{k}": v for k, v in scenes_of(coarse, parts).items()}
        try:
            runs = marches.run_all(scenes)
        except (InvalidSceneError, OffGridError, NoConvergenceError):
            return None
        return join_runs(list(runs.values()))

    @property
    def _every_second(self) -> slice:
        """Every second amplitude, the largest one among them."""
        return slice((self.amplitudes.size + 1) % 2, None, 2)

    def energy(self, amplitude: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the energy of loops of some amplitudes at the mean of the largest one [J]."""
        return self.curve.evaluate(amplitude)

    def energy_of_loops(self, loops: CountedLoops) -> float:
        """Return the energy that loops dissipate, by amplitude and mean [J]."""
        levels = loops_as_levels(loops)
        energy = self.energy(levels[:, 0])
        grid = self.ladder.grid
        if grid is not None:
            # Both branches of the largest loop have as many loops.
            shape = grid.outer.shape
            ranges = zip(
                (grid.outer + 1).ravel().tolist(), grid.closed.ravel().tolist(), strict=True
            )
            marched = self._energies_of(list(ranges)).reshape(shape).mean(axis=0)
            by_table = self.energy(float(self.ladder.levels[0, 0]) * np.array(SIZES))
            with np.errstate(divide="ignore", invalid="ignore"):
                excess = np.nan_to_num(marched / by_table[:, None] - 1.0, posinf=0.0, neginf=0.0)
            weights = grid_weights(levels, *self._largest)
            energy = energy * (1.0 + np.einsum("lkj,kj->l", weights, excess))
        return float((levels[:, 2] * energy).sum())

    @property
    def _largest(self) -> tuple[float, float]:
        """Amplitude and mean of the largest loop."""
        top, middle = self.ladder.levels[0, :2].tolist()
        return top, middle

    @cached_property
    def total_energy(self) -> float:
        """Energy that the loops of the history dissipate [J]."""
        return self.energy_of_loops(self.loops)

    @property
    def is_interpolated(self) -> bool:
        """Return whether some loops have amplitudes between the ones of the table."""
        occurring = distinct(self.loops.dataset.amplitude.values)
        nearest = self.amplitudes[
            np.abs(self.amplitudes[:, None] - occurring[None, :]).argmin(axis=0)
        ]
        return bool((np.abs(nearest - occurring) > 1e-9 * occurring).any())

    @cached_property
    def interpolation_error(self) -> float:
        """Return the change of the energy if every second amplitude is left out, over the energy.

        Where gross slip begins between two amplitudes, half of the distance of the bounds counts as
        well.
        """
        if self.amplitudes.size < 4 or not self.is_interpolated:
            return 0.0
        amplitude, count = loops_as_levels(self.loops)[:, [0, 2]].T
        unknown = float((count * self.curve.half_width(amplitude)).sum())
        return self._halving_error(linear=False) + unknown / max(self.total_energy, 1e-300)

    @cached_property
    def straight_error(self) -> float:
        """Error of the energy if it were straight between the amplitudes, as states are."""
        if self.amplitudes.size < 4 or not self.is_interpolated:
            return 0.0
        return self._halving_error(linear=True)

    def _halving_error(self, *, linear: bool) -> float:
        """Return the relative change of the energy without every second amplitude."""
        amplitude, count = loops_as_levels(self.loops)[:, [0, 2]].T
        by_all, by_half = (
            float((count * curve.evaluate(amplitude, linear=linear)).sum())
            for curve in (self.curve, self.curve.every_second())
        )
        # Half of the distance leaves a quarter of the error of straight pieces, and less of cubic
        # ones. The onset of gross slip is a singular end of these: there the whole change counts.
        change = abs(by_half - by_all) / max(self.total_energy, 1e-300)
        return change if self.curve.slides.any() and not linear else change / 3.0

    @cached_property
    def energy_errors(self) -> dict[str, float]:
        """Return the relative errors of the energy by their sources, as for damage."""
        path_error = self.run.dataset.attrs.get("path_error")
        errors = {
            "amplitudes": self.interpolation_error,
            "increments": float(np.max(path_error)) if path_error else 0.0,
        }
        if self.check is not None:
            errors["memory"] = self.check.energy_error
        if self.coarse_run is not None:
            coarse = self._curve_of(self.coarse_run)
            levels = loops_as_levels(self.loops)
            by_coarse, by_fine = (
                float((levels[:, 2] * curve.evaluate(levels[:, 0])).sum())
                for curve in (coarse, self.curve)
            )
            errors["cells"] = COARSE_FACTOR * abs(by_coarse / max(by_fine, 1e-300) - 1.0)
        return errors

    @property
    def energy_error(self) -> float:
        """Part of the energy that may be wrong: the sum of :attr:`energy_errors`."""
        return math.fsum(self.energy_errors.values())

    @property
    def record_scatter(self) -> float | None:
        """Return the relative scatter of the energy of one record of a spectrum, or None."""
        spectrum, duration = self.history.spectrum, self.history.duration
        if spectrum is None or duration is None:
            return None
        amplitude, count = loops_as_levels(self.loops)[:, [0, 2]].T
        return record_scatter(spectrum, amplitude, count, self.energy(amplitude), duration)

    @property
    def notes(self) -> list[str]:
        """Notes on the table: amplitudes, and what its error covers."""
        means = "" if self.ladder.grid is None else f", {self.ladder.grid.outer[0, 0].size} means"
        lines = [
            f"{self.amplitudes.size} amplitudes{means} marched, "
            f"interpolation {_core.rough(100.0 * self.interpolation_error)} %"
        ]
        if self.record_scatter is not None:
            lines.append(
                f"the energy of one record of {format_number(self.history.duration)} s scatters by "
                f"{_core.rough(100.0 * self.record_scatter)} % (standard deviation)"
            )
        if self.is_exact:
            lines.append("memory exact: elastically like bodies, constant normal force")
        elif self.check is not None:
            lines.append(
                "memory approximate: a stretch of the history marched in full differs by "
                f"{_core.rough(100.0 * self.check.energy_error)} % in energy"
            )
        else:
            lines.append("memory approximate, and its error unknown: no stretch was marched")
        if self.companions.residual > 1e-2:
            lines.append(
                f"{format_number(100 * self.companions.residual)} % of the variance of another "
                "channel follow the counted one neither in phase nor a quarter later"
            )
        return lines

    def loop_states(
        self, classes: tuple[int, int] = CLASSES, *, coarse: bool = False
    ) -> LoopStates:
        """Return the states at the ends of the loops, or of classes of many loops.

        `classes`: numbers of classes of range and of mean. `coarse`: by every second amplitude of
        the table.
        """
        rows, moments, sides = self._memory_of_history
        if self.is_grouped:
            rows, moments, sides = group_loops(rows, moments, sides, classes)
        return self._on_increments(rows, moments, sides, coarse=coarse)

    @property
    def is_grouped(self) -> bool:
        """Whether the loops are so many that classes of them stand for them."""
        return self.history.is_series and self.loops.dataset.sizes["loop"] > MOST_LOOPS

    @cached_property
    def _memory_of_history(
        self,
    ) -> tuple[NDArray[np.float64], list[NDArray[np.float64]], NDArray[np.float64]]:
        """Return what the loops remember: an array for each of three things.

        Rows of range, mean and count. For each loop the weights of the solved states that give its
        state at both ends. And its side: 1 on the rising, -1 on the falling branch of the largest
        loop.
        """
        history = self.history
        if history.is_series:
            return self._memory_of_series(history.channels[history.channel], self.loops)
        levels = loops_as_levels(self.loops)
        top, middle = self._largest
        inside = levels[:, 0] < top * (1.0 - 1e-12)
        # Loops without an order lie on the rising and on the falling branch of the largest one.
        loops = np.concatenate([levels, levels[inside]])
        loops[: len(levels), 2] *= np.where(inside, 0.5, 1.0)
        loops[len(levels) :, 2] *= 0.5
        sides = np.concatenate([np.ones(len(levels)), -np.ones(int(inside.sum()))])
        moments = memory_of_loops(self.amplitudes, top, middle, loops[:, :2], sides)
        return np.column_stack([2.0 * loops[:, 0], loops[:, 1:]]), list(moments), sides

    def _memory_of_series(
        self, values: NDArray[np.float64], loops: CountedLoops
    ) -> tuple[NDArray[np.float64], list[NDArray[np.float64]], NDArray[np.float64]]:
        """Return the same as :meth:`_memory_of_history` for loops of a series of values."""
        d = loops.dataset
        firsts, lasts = (d[name].values.astype(int) for name in ("first", "last"))
        turns = rearranged(values)
        # Ends of the series that are no turning points of the block stand in their order.
        missing = np.zeros(values.size, dtype=bool)
        missing[firsts] = missing[lasts] = True
        missing[turns] = False
        order = np.concatenate([turns[:-1], np.flatnonzero(missing)])
        order = order[np.argsort((order - int(turns[0])) % values.size, kind="stable")]
        position = np.zeros(values.size, dtype=np.int64)
        position[order] = np.arange(order.size)
        weights = state_weights(values[order], self.amplitudes)
        moments = [weights[position[samples]] for samples in (firsts, lasts)]
        # A loop that begins at its least value lies on a falling branch.
        sides = np.where(values[lasts] > values[firsts], -1.0, 1.0)
        return loops_as_rows(loops), moments, sides

    def states_of_series(self, values: NDArray[np.float64], loops: CountedLoops) -> LoopStates:
        """Return the states at the ends of the loops of a series, one by one."""
        return self._on_increments(*self._memory_of_series(values, loops))

    def _on_increments(
        self,
        rows: NDArray[np.float64],
        moments: list[NDArray[np.float64]],
        sides: NDArray[np.float64],
        *,
        coarse: bool = False,
    ) -> LoopStates:
        """Turn weights of half changes D into weights of the states of the run."""
        ends = branch_ends(self.run)
        increments = np.array(sorted(set(ends.values())))
        position = {branch: int(np.searchsorted(increments, n)) for branch, n in ends.items()}

        def half_changes(pairs: list[tuple[int, int]]) -> NDArray[np.float64]:
            """Return half of each high increment minus its low one, shape (pair, increment)."""
            half = np.zeros((len(pairs), increments.size))
            for row, (high, low) in enumerate(pairs):
                half[row, position[high]] += 0.5
                half[row, position[low]] -= 0.5
            return half

        ladder = self.ladder
        pairs = list(zip(ladder.tops, ladder.bottoms, strict=True))[::-1]
        half = half_changes(pairs)
        middle = np.abs(half[-1])
        if coarse:
            kept = self._every_second
            half = amplitude_weights(self.amplitudes[kept], self.amplitudes) @ half[kept]
        states = [moment @ half + middle for moment in moments]
        if ladder.grid is not None:
            grid = ladder.grid
            top, mean = self._largest
            nodes = np.array(
                [
                    [top * size, mean + position_over_room * top * (1.0 - size)]
                    for size in SIZES
                    for position_over_room in MEANS
                ]
            )
            weights = grid_weights(np.column_stack([0.5 * rows[:, 0], rows[:, 1]]), top, mean)
            flat = weights.reshape(len(rows), -1)
            for i, side in enumerate(SIDES):
                of_side = np.full(len(nodes), side)
                by_memory = memory_of_loops(self.amplitudes, top, mean, nodes, of_side)
                for m, branches in enumerate((grid.outer[i], grid.inner[i])):
                    marched = np.zeros((len(nodes), increments.size))
                    columns = [position[int(branch)] for branch in branches.ravel()]
                    marched[np.arange(len(nodes)), columns] = 1.0
                    correction = marched - (by_memory[m] @ half + middle)
                    states[m] = states[m] + (flat * (sides == side)[:, None]) @ correction
        if self.companions.turns:
            quarters = half_changes(ladder.quarters[::-1])
            quarter = amplitude_weights(self.amplitudes, 0.5 * rows[:, 0]) @ quarters
            mean_state = 0.5 * (states[0] + states[1])
            states += [mean_state + quarter, mean_state - quarter]
        return LoopStates(rows, np.stack(states, axis=1), increments)

    def summary(self) -> str:
        """Describe the table: loops, energy with its error, notes."""
        unit = self.scene.grid.unit_of("J")
        energy = _core.with_error(self.total_energy, self.energy_error * self.total_energy)
        lines = [
            self.loops.summary(),
            f"energy of the loops {energy} {unit}",
            *self.notes,
        ]
        return wrap("\n".join(lines))

    __repr__ = summary


def scenes_of(scene: Scene, parts: dict[str, Ladder]) -> dict[str, Scene]:
    """Return the scenes of the parts of a table, by their names."""
    return {name: scene.replace(path=part.path, save="branches") for name, part in parts.items()}


def is_uncoupled(run: Run) -> bool:
    """Return whether the pressure of a run does not depend on its shear."""
    return any(line.startswith(UNCOUPLED) for line in run.dataset.attrs["plan"])


def keeps_memory(run: Run, companions: Companions) -> bool:
    """Return whether the rule of memory holds on the contact of a run.

    Coefficients of friction that depend on the slip before break it, as bodies that yield do.
    """
    scene = run.scene
    varies = "W" in companions.ratios and companions.ratios["W"][1:] != (0.0, 0.0)
    yields = scene.body1.yields or scene.body2.yields
    in_phase = not companions.turns and companions.residual < 1e-6
    friction = scene.friction
    ages = any(law is not None for law in (friction.kinetic, friction.history, friction.law))
    return is_uncoupled(run) and in_phase and not (varies or yields or ages)


def table_levels(
    loops: CountedLoops, count: int, onset: float | None = None
) -> NDArray[np.float64]:
    """Choose the amplitudes of a table: those that occur if they are few, else equal parts.

    Where gross slip begins among them, `onset` is one of the amplitudes.

    All loops of the table have the mean of the largest one, which holds all others. Where no loop
    of a list of loops holds the others, that is a loop from the least to the largest value.
    """
    classes = loops_as_levels(loops)
    largest = int(classes[:, 0].argmax())
    top, mean = float(classes[largest, 0]), float(classes[largest, 1])
    low = float((classes[:, 1] - classes[:, 0]).min())
    high = float((classes[:, 1] + classes[:, 0]).max())
    hull = 0.5 * (high - low)
    amplitudes = distinct(classes[:, 0])
    if hull > top * (1.0 + 1e-9):
        top, mean = hull, 0.5 * (high + low)
        amplitudes = np.append(amplitudes, top)
    if amplitudes.size <= count:
        parts = amplitudes / top
    elif onset is None:
        parts = np.arange(1, count + 1) / count
    else:
        parts = distinct(np.append(np.arange(1, count) / (count - 1), onset / top))
    levels = np.zeros((parts.size, 3))
    levels[:, 0], levels[:, 1] = top * parts[::-1], mean
    levels[0, 0] = top
    return levels
