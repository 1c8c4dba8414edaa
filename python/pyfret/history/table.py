"""The table of a history: loops of a few amplitudes, marched once, for any number of counted ones.

The energy of a loop is interpolated over its amplitude, as energy over amplitude^3, and a state by
the rule of memory (:mod:`pyfret.history.memory`). Both are exact for elastically like bodies under
a constant normal force, up to the interpolation. For other contacts one stretch of the history is
marched, and the difference is the error.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret import _core
from pyfret._util.numbers import format_number
from pyfret._util.progress import Progress
from pyfret.history.counting import count_signal, rearranged
from pyfret.history.ladder import Companions, Ladder, check_sliding, follow_channels
from pyfret.history.load_history import LoadHistory, press
from pyfret.history.loops import CountedLoops
from pyfret.history.memory import amplitude_weights, state_weights
from pyfret.run.dataset import dataset
from pyfret.run.run import Run

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from pyfret._core import Scene

__all__ = ["HistoryTable", "LoopStates", "StretchCheck"]

#: Amplitudes of a table: at first, and at most.
FEWEST, MOST = 8, 16
#: Part of the energy that the interpolation may leave.
TOLERANCE = 5e-3
#: Loops whose states are followed one by one. More of them become classes of range and mean.
MOST_LOOPS, RANGES, MEANS = 400, 40, 8
#: Turning points of the stretch that is marched.
STRETCH = 24
#: Line of the plan of a scene whose pressure does not depend on its shear.
UNCOUPLED = "skipped: normal-tangential coupling"
#: Settling loops of a contact whose pressure depends on its shear.
SETTLING = 2


@dataclass(frozen=True)
class LoopStates:
    """States at the moments of loops, as sums of states of a run.

    Attributes
    ----------
    rows : array
        Rows of range, mean, count.
    weights : array of shape (loops, moments, increments)
        Weights of the states of the increments.
    increments : array of int
        Kept increments of the run.
    """

    rows: NDArray[np.float64]
    weights: NDArray[np.float64]
    increments: NDArray[np.int64]


@dataclass(frozen=True)
class StretchCheck:
    """A stretch of the history, marched in full beside the table.

    Attributes
    ----------
    run : Run
        The march.
    states : LoopStates
        States of its loops, by the march.
    table_states : LoopStates
        The same by the table.
    energy, table_energy : float
        Energy dissipated in its loops [J].
    """

    run: Run
    states: LoopStates
    table_states: LoopStates
    energy: float
    table_energy: float

    @property
    def energy_error(self) -> float:
        """Difference of the energies over the energy of the march."""
        return abs(self.table_energy - self.energy) / max(self.energy, 1e-300)


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
        dissipated = run.branches().dissipated.values
        energy = [float(dissipated[first : last + 1].sum()) for first, last in ladder.branches]
        #: Amplitudes, ascending, and the energy of their loops [J].
        self.amplitudes = ladder.levels[::-1, 0].copy()
        self.energies = np.array(energy[::-1])
        self.check: StretchCheck | None = None

    @classmethod
    def build(
        cls,
        scene: Scene,
        history: LoadHistory,
        *,
        tolerance: float = TOLERANCE,
        check: bool | None = None,
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
        progress : bool
            Whether to draw a progress bar.
        """
        loops = history.count()
        if loops.dataset.sizes["loop"] == 0:
            raise ValueError("the history has no loop: must vary")
        companions = follow_channels(history)
        check_sliding(scene, history, loops_as_levels(loops))
        table = None
        for count in (FEWEST, MOST):
            levels = table_levels(loops, count)
            settling = 0 if table is None or table.is_uncoupled else SETTLING
            table = cls._march(
                scene, history, loops, companions, levels, settling, progress=progress
            )
            if not table.is_uncoupled and settling == 0:
                table = cls._march(
                    scene, history, loops, companions, levels, SETTLING, progress=progress
                )
            if len(levels) < count or table.interpolation_error <= tolerance:
                break
        assert table is not None
        if (not table.is_exact if check is None else check) and history.is_series:
            table.check = table._check_stretch(progress=progress)
        return table

    @classmethod
    def _march(
        cls,
        scene: Scene,
        history: LoadHistory,
        loops: CountedLoops,
        companions: Companions,
        levels: NDArray[np.float64],
        settling: int,
        *,
        progress: bool,
    ) -> HistoryTable:
        ladder = Ladder.build(scene, history, levels, companions, settling=settling)
        run = march(scene.replace(path=ladder.path, save="branches"), "table", progress=progress)
        return cls(scene, history, loops, companions, ladder, run)

    @property
    def is_uncoupled(self) -> bool:
        """Whether the pressure does not depend on the shear."""
        return any(line.startswith(UNCOUPLED) for line in self.run.dataset.attrs["plan"])

    @property
    def is_exact(self) -> bool:
        """Whether the rule of memory holds: like bodies, constant W, channels in phase."""
        varies = "W" in self.companions.ratios and self.companions.ratios["W"][1:] != (0.0, 0.0)
        yields = self.scene.body1.yields or self.scene.body2.yields
        in_phase = not self.companions.turns and self.companions.residual < 1e-6
        return self.is_uncoupled and in_phase and not varies and not yields

    def energy(self, amplitude: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the energy of loops of some amplitudes [J]."""
        return interpolate_energy(self.amplitudes, self.energies, amplitude)

    @property
    def total_energy(self) -> float:
        """Energy that the loops of the history dissipate [J]."""
        d = self.loops.dataset
        return float((d["count"].values * self.energy(d.amplitude.values)).sum())

    @property
    def interpolation_error(self) -> float:
        """Difference of the energy to the one by every second amplitude, over the energy."""
        if self.amplitudes.size < 4:
            return 0.0
        kept = np.arange(self.amplitudes.size - 1, -1, -2)[::-1]
        d = self.loops.dataset
        a, n = d.amplitude.values, d["count"].values
        coarse = interpolate_energy(self.amplitudes[kept], self.energies[kept], a)
        # Of a piecewise linear interpolation, half of the distance leaves a quarter of the error.
        return (
            abs(float((n * coarse).sum()) - self.total_energy) / max(self.total_energy, 1e-300) / 3
        )

    @property
    def energy_error(self) -> float:
        """Part of the energy that may be wrong: by interpolation, and by memory where marched."""
        memory = self.check.energy_error if self.check is not None else 0.0
        return self.interpolation_error + memory

    @property
    def notes(self) -> list[str]:
        """Notes on the table: amplitudes, and what its error covers."""
        lines = [
            f"{self.amplitudes.size} amplitudes marched, "
            f"interpolation {self.interpolation_error:.1e}"
        ]
        if self.is_exact:
            lines.append("memory exact: elastically like bodies, constant normal force")
        elif self.check is not None:
            lines.append(
                "memory approximate: a stretch of the history marched in full differs by "
                f"{self.check.energy_error:.1e} in energy"
            )
        else:
            lines.append(
                "memory approximate, and its error unknown: the history has no order to march"
            )
        if self.companions.residual > 1e-2:
            lines.append(
                f"{format_number(100 * self.companions.residual)} % of the variance of another "
                "channel follow the counted one neither in phase nor a quarter later"
            )
        return lines

    def loop_states(self) -> LoopStates:
        """Return the states at the ends of the loops, or of classes of many loops."""
        history = self.history
        if not history.is_series:
            return self._states_without_order(loops_as_levels(self.loops))
        values = history.channels[history.channel]
        return self._states_of_series(values, self.loops)

    def _states_of_series(self, values: NDArray[np.float64], loops: CountedLoops) -> LoopStates:
        d = loops.dataset
        firsts, lasts = (d[name].values.astype(int) for name in ("first", "last"))
        turns = rearranged(values)
        # Ends of the series that are no turning points of the block stand in their order.
        start = int(turns[0])
        ends = np.setdiff1d(np.unique(np.concatenate([firsts, lasts])), turns)
        order = np.concatenate([turns[:-1], ends])
        order = order[np.argsort((order - start) % values.size, kind="stable")]
        weights = state_weights(values[order], self.amplitudes)
        position = {int(sample): n for n, sample in enumerate(order)}
        start_weights, end_weights = (
            weights[[position[int(sample)] for sample in samples]] for samples in (firsts, lasts)
        )
        rows = loops_as_rows(loops)
        if len(rows) > MOST_LOOPS:
            rising = values[lasts] > values[firsts]
            rows, start_weights, end_weights = group_loops(rows, start_weights, end_weights, rising)
        return self._on_increments(rows, start_weights, end_weights)

    def _states_without_order(self, levels: NDArray[np.float64]) -> LoopStates:
        """States of loops that hang on the rising or on the falling branch of the largest loop."""
        top, middle = float(self.ladder.levels[0, 0]), float(self.ladder.levels[0, 1])
        rows, start_weights, end_weights = [], [], []
        largest = amplitude_weights(self.amplitudes, np.array([top]))[0]
        for amplitude, mean, count in levels:
            inside = amplitude_weights(self.amplitudes, np.array([amplitude]))[0]
            sides = (1.0, -1.0) if amplitude < top * (1.0 - 1e-12) else (1.0,)
            for side in sides:
                # The outer end of the loop, on the branch from the other end of the largest loop.
                distance = side * (mean - middle) + amplitude + top
                reach = amplitude_weights(
                    self.amplitudes, np.array([np.clip(0.5 * distance, 0.0, top)])
                )
                end = side * (2.0 * reach[0] - largest)
                rows.append([2.0 * amplitude, mean, count / len(sides)])
                start_weights.append(end)
                end_weights.append(end - side * 2.0 * inside)
        return self._on_increments(np.array(rows), np.array(start_weights), np.array(end_weights))

    def _on_increments(
        self,
        rows: NDArray[np.float64],
        start_weights: NDArray[np.float64],
        end_weights: NDArray[np.float64],
    ) -> LoopStates:
        """Turn weights of half changes D into weights of the states of the run."""
        ends = branch_ends(self.run)
        tops = np.array([ends[b] for b in self.ladder.tops[::-1]])
        bottoms = np.array([ends[b] for b in self.ladder.bottoms[::-1]])
        increments = np.unique(np.concatenate([tops, bottoms]))
        size, levels = increments.size, tops.size
        half = np.zeros((levels, size))
        np.add.at(half, (np.arange(levels), np.searchsorted(increments, tops)), 0.5)
        np.add.at(half, (np.arange(levels), np.searchsorted(increments, bottoms)), -0.5)
        middle = np.abs(half[-1])
        moments = [start_weights @ half + middle, end_weights @ half + middle]
        if self.companions.turns:
            falling, rising = np.array(
                [[ends[a], ends[b]] for a, b in self.ladder.quarters[::-1]]
            ).T
            increments_all = np.unique(np.concatenate([increments, falling, rising]))
            wide = np.zeros((levels, increments_all.size))
            np.add.at(wide, (np.arange(levels), np.searchsorted(increments_all, falling)), 0.5)
            np.add.at(wide, (np.arange(levels), np.searchsorted(increments_all, rising)), -0.5)
            spread = np.zeros((size, increments_all.size))
            spread[np.arange(size), np.searchsorted(increments_all, increments)] = 1.0
            moments = [moment @ spread for moment in moments]
            quarter = amplitude_weights(self.amplitudes, 0.5 * rows[:, 0]) @ wide
            mean = 0.5 * (moments[0] + moments[1])
            moments += [mean + quarter, mean - quarter]
            increments = increments_all
        return LoopStates(rows, np.stack(moments, axis=1), increments)

    def _check_stretch(self, *, progress: bool) -> StretchCheck:
        """March a stretch of the block, from its largest value, and compare."""
        history = self.history
        block = history.block()
        stretch = block[: STRETCH + 1] if block.size > STRETCH + 1 else block[:-1]
        # Back to where it began, so that its loops close.
        places = np.concatenate([stretch, block[:1]])
        settle = np.concatenate([places, places])
        path = press(self.scene, history.channels, places)
        columns = {name: values[settle] for name, values in history.channels.items()}
        path = path.waypoints(increments="auto", **columns)
        run = march(self.scene.replace(path=path, save="branches"), "stretch", progress=progress)
        before = len(path.branches) - places.size
        dissipated = run.branches().dissipated.values
        energy = float(dissipated[before + 1 :].sum())
        values = history.channels[history.channel][places]
        loops = CountedLoops.from_rows(count_signal(values, "repeat"), history.channel, "stretch")
        d = loops.dataset
        table_energy = float((d["count"].values * self.energy(d.amplitude.values)).sum())
        ends = branch_ends(run)
        samples = d["first"].values.astype(int), d["last"].values.astype(int)
        weights, increments = marched_weights(
            run, samples, before, ends, turns=self.companions.turns
        )
        states = LoopStates(loops_as_rows(loops), weights, increments)
        return StretchCheck(
            run, states, self._states_of_series(values, loops), energy, table_energy
        )

    def summary(self) -> str:
        """Describe the table: loops, energy with its error, notes."""
        unit = self.scene.grid.unit_of("J")
        energy = _core.with_error(self.total_energy, self.energy_error * self.total_energy)
        lines = [
            self.loops.summary(),
            f"energy of the loops {energy} {unit}",
            *self.notes,
        ]
        return "\n".join(lines)

    __repr__ = summary


def march(scene: Scene, title: str, *, progress: bool, **options: Any) -> Run:
    """Run a scene in memory."""
    with Progress(title=scene.title or title, shown=progress) as bar:
        run = _core.solve_in_memory(scene, on_increment=bar.update, **options)
    return Run(dataset(*run))


def branch_ends(run: Run) -> dict[int, int]:
    """Return the last increment of every branch."""
    branch = run.dataset.branch_of_increment.values
    increments = run.dataset.increment.values
    return {int(b): int(n) for b, n in zip(branch, increments, strict=True)}


def marched_weights(
    run: Run,
    samples: tuple[NDArray[np.int64], NDArray[np.int64]],
    before: int,
    ends: dict[int, int],
    *,
    turns: bool,
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Return the weights of the increments of a march in the moments of its loops.

    `before` is the branch that ends at the first sample. With channels out of phase all states
    between the two ends of a loop are moments, up to the number of two.
    """
    increments = np.array(sorted(set(ends.values())))
    moments = []
    for ends_of_loops in samples:
        weights = np.zeros((ends_of_loops.size, increments.size))
        position = np.searchsorted(
            increments, [ends[before + int(sample)] for sample in ends_of_loops]
        )
        weights[np.arange(ends_of_loops.size), position] = 1.0
        moments.append(weights)
    if turns:
        middles = 0.5 * (samples[0] + samples[1])
        for side in (np.floor(middles), np.ceil(middles)):
            weights = np.zeros((middles.size, increments.size))
            position = np.searchsorted(increments, [ends[before + int(sample)] for sample in side])
            weights[np.arange(middles.size), position] = 1.0
            moments.append(weights)
    return np.stack(moments, axis=1), increments


def interpolate_energy(
    amplitudes: NDArray[np.float64], energies: NDArray[np.float64], wanted: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Interpolate energy over amplitude^3, constant for small loops, over the amplitude."""
    resolved = energies > 0.0
    if not resolved.any():
        return np.zeros_like(wanted)
    a, ratio = amplitudes[resolved], np.log(energies[resolved] / amplitudes[resolved] ** 3)
    return np.exp(np.interp(wanted, a, ratio)) * wanted**3


def loops_as_rows(loops: CountedLoops) -> NDArray[np.float64]:
    """Return rows of range, mean, count."""
    d = loops.dataset
    return np.column_stack([d["range"].values, d["mean"].values, d["count"].values])


def loops_as_levels(loops: CountedLoops) -> NDArray[np.float64]:
    """Return rows of amplitude, mean, count."""
    rows = loops_as_rows(loops)
    rows[:, 0] *= 0.5
    return rows


def table_levels(loops: CountedLoops, count: int) -> NDArray[np.float64]:
    """Choose the amplitudes of a table: those that occur if they are few, else equal parts.

    All loops of the table have the mean of the largest one.
    """
    classes = loops_as_levels(loops)
    largest = int(classes[:, 0].argmax())
    top, mean = float(classes[largest, 0]), float(classes[largest, 1])
    distinct = np.unique(np.round(classes[:, 0] / top, 12))
    parts = distinct if distinct.size <= count else np.arange(1, count + 1) / count
    levels = np.zeros((parts.size, 3))
    levels[:, 0], levels[:, 1] = top * parts[::-1], mean
    levels[0, 0] = top
    return levels


def group_loops(
    rows: NDArray[np.float64],
    start_weights: NDArray[np.float64],
    end_weights: NDArray[np.float64],
    rising: NDArray[np.bool_],
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Merge many loops into classes of range, mean and direction, which keep their mean states."""
    top = float(rows[:, 0].max())
    low, high = float(rows[:, 1].min()), float(rows[:, 1].max())
    by_range = np.minimum((rows[:, 0] / top * RANGES).astype(int), RANGES - 1)
    by_mean = np.minimum(
        ((rows[:, 1] - low) / max(high - low, 1e-300) * MEANS).astype(int), MEANS - 1
    )
    key = (by_range * MEANS + by_mean) * 2 + rising
    _, position = np.unique(key, return_inverse=True)
    size = int(position.max()) + 1
    counts = np.bincount(position, rows[:, 2], size)

    def mean_of(values: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.stack(
            [np.bincount(position, rows[:, 2] * column, size) / counts for column in values.T],
            axis=1,
        )

    middle = mean_of(rows[:, :2])
    return np.column_stack([middle, counts]), mean_of(start_weights), mean_of(end_weights)
