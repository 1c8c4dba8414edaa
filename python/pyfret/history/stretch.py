"""A stretch of a history that is marched in full, beside the table that stands for it.

The stretch has loops of every size. Its turning points are the ends of some loops of the history,
in their order. They are chosen so that the loops between two of them, in the order of their ranges,
have equal sums of range^4. The energy grows with about the third power and damage with a higher
one. Other channels that follow the counted one out of phase need their own turning points. So
there the stretch has the first turning points of the history, from its largest value.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from pyfret.history.counting import count_signal
from pyfret.history.load_history import press
from pyfret.history.loops import CountedLoops
from pyfret.history.states import LoopStates, loops_as_rows, marched_weights

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from pyfret._core import Scene
    from pyfret.history.ladder import Companions
    from pyfret.history.load_history import LoadHistory
    from pyfret.run.run import Run

__all__ = ["Stretch", "StretchCheck"]

#: Turning points of the stretch.
TURNS = 24
#: Exponent of the range in the choice of its loops.
EXPONENT = 4.0
#: Part of the variance of another channel that may not follow the counted one in phase.
IN_PHASE = 1e-6


@dataclass(frozen=True)
class Stretch:
    """A stretch of a history that is marched in full.

    Attributes
    ----------
    run : Run
        The march.
    values : array
        Values of the counted channel along it.
    loops : CountedLoops
        Its loops.
    states : LoopStates
        Their states.
    energy : float
        Energy dissipated in them [J].
    """

    run: Run
    values: NDArray[np.float64]
    loops: CountedLoops
    states: LoopStates
    energy: float

    @staticmethod
    def plan(
        scene: Scene, history: LoadHistory, loops: CountedLoops, companions: Companions
    ) -> tuple[Scene, NDArray[np.float64]]:
        """Return the scene of a stretch, from the largest value, and its counted channel."""
        channels = stretch_channels(history, loops, companions)
        # Back to where it began, so that its loops close.
        channels = {name: np.append(values, values[0]) for name, values in channels.items()}
        path = press(scene, channels, np.zeros(1, dtype=np.int64))
        # The first pass settles the contact.
        columns = {name: np.concatenate([column, column]) for name, column in channels.items()}
        path = path.waypoints(increments="auto", **columns)
        return scene.replace(path=path, save="branches"), channels[history.channel]

    @staticmethod
    def from_run(
        run: Run, values: NDArray[np.float64], history: LoadHistory, companions: Companions
    ) -> Stretch:
        """Read the loops of a stretch from its march, whose counted channel has these values."""
        before = len(run.scene.path.branches) - values.size
        dissipated = run.branches().dissipated.values
        energy = float(dissipated[before + 1 :].sum())
        counted = CountedLoops.from_rows(count_signal(values, "repeat"), history.channel, "stretch")
        d = counted.dataset
        samples = d["first"].values.astype(int), d["last"].values.astype(int)
        weights, increments = marched_weights(run, samples, before, turns=companions.turns)
        states = LoopStates(loops_as_rows(counted), weights, increments)
        return Stretch(run, values, counted, states, energy)


@dataclass(frozen=True)
class StretchCheck:
    """A marched stretch of a history beside its table.

    Attributes
    ----------
    stretch : Stretch
        The stretch.
    table_states : LoopStates
        States of its loops, by the table.
    table_energy : float
        Energy dissipated in its loops, by the table [J].
    """

    stretch: Stretch
    table_states: LoopStates
    table_energy: float

    @property
    def energy_error(self) -> float:
        """Difference of the energies over the energy of the march."""
        energy = self.stretch.energy
        return abs(self.table_energy - energy) / max(energy, 1e-300)


def stretch_channels(
    history: LoadHistory, loops: CountedLoops, companions: Companions
) -> dict[str, NDArray[np.float64]]:
    """Return the channels along the stretch, from the largest value of the counted one."""
    if not history.is_series:
        return {history.channel: series_of_loops(loops)}
    block = history.block()
    if companions.turns or companions.residual > IN_PHASE:
        places = block[: TURNS + 1] if block.size > TURNS + 1 else block[:-1]
    else:
        d = loops.dataset
        chosen = loops_to_solve(loops)
        ends = [d[name].values[chosen].astype(int) for name in ("first", "last")]
        places = np.unique(np.concatenate([*ends, block[:1]]))
        size = history.channels[history.channel].size
        places = places[np.argsort((places - int(block[0])) % size, kind="stable")]
    return {name: values[places] for name, values in history.channels.items()}


def loops_to_solve(loops: CountedLoops) -> NDArray[np.int64]:
    """Return the rows of the loops to solve: the largest, and others of equal parts of range^4."""
    d = loops.dataset
    order = np.argsort(-d["range"].values, kind="stable")
    weight = np.cumsum(d["count"].values[order[1:]] * d["range"].values[order[1:]] ** EXPONENT)
    count = TURNS // 2 - 1
    if weight.size <= count:
        return order
    parts = (np.arange(count) + 0.5) / count * weight[-1]
    return np.append(order[0], order[1 + np.unique(np.searchsorted(weight, parts))])


def series_of_loops(loops: CountedLoops) -> NDArray[np.float64]:
    """Return a series through loops without an order, the largest one first.

    Large and small ones take turns, so that small loops lie on branches of both directions.
    """
    d = loops.dataset
    chosen = loops_to_solve(loops)
    inner = chosen[1:]
    mixed = np.empty_like(inner)
    mixed[0::2], mixed[1::2] = inner[: (inner.size + 1) // 2], inner[(inner.size + 1) // 2 :]
    amplitude, mean = d.amplitude.values, d["mean"].values
    values = [mean[chosen[0]] + amplitude[chosen[0]], mean[chosen[0]] - amplitude[chosen[0]]]
    for row in mixed:
        values += [mean[row] + amplitude[row], mean[row] - amplitude[row]]
    series = np.array(values)
    return np.roll(series, -int(series.argmax()))
