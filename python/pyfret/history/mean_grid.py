"""Loops of several means, each on a branch of the largest loop: corrections of the rule of memory.

Of like bodies under a constant normal force a loop depends on its amplitude alone. Of other
contacts it depends on its mean and on the branch that it lies on, too. A grid of such loops is
marched beside the table. The rule of memory gives a state for the loop of a history. It also gives
the state of the loop of the grid with the same amplitude, mean and branch. The march of the grid
corrects both ::

    s = s_memory(history) + (s_march - s_memory)(grid)

The energy is multiplied by the ratio of the energies. Both are linear between the points of the
grid. They are exact for loops on the largest one, at the points.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from pyfret.history.memory import amplitude_weights

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

__all__ = ["MeanGrid", "grid_weights", "memory_of_loops"]

#: Amplitudes of the loops over the largest one.
SIZES = (0.25, 0.5, 0.75)
#: Means over the largest mean that the amplitude leaves room for.
MEANS = (-1.0, 0.0, 1.0)
#: Directions of the branch that the loops lie on: falling, rising.
SIDES = (-1.0, 1.0)


@dataclass(frozen=True)
class MeanGrid:
    """Branches of a path whose loops lie on the largest one.

    Attributes
    ----------
    outer, inner : array of int, over (side, size, mean)
        Branch at whose end the loop begins, and at whose end it turns.
    closed : array of int
        Branch at whose end the loop is closed.
    """

    outer: NDArray[np.int64]
    inner: NDArray[np.int64]
    closed: NDArray[np.int64]

    def shifted(self, branches: int) -> MeanGrid:
        """Return the grid with a number of branches before it."""
        return MeanGrid(self.outer + branches, self.inner + branches, self.closed + branches)

    @staticmethod
    def build(go: Callable[[float], int], top: float, mean: float) -> MeanGrid:
        """Lead a path through the loops, from the largest value of the outer loop to that again.

        `go` leads the path to a value of the counted channel, and returns the branch.
        """
        shape = len(SIDES), len(SIZES), len(MEANS)
        outer, inner, closed = (np.zeros(shape, dtype=np.int64) for _ in range(3))
        branch, current = -1, mean + top

        def lead(value: float) -> int:
            """Lead the path to a value; return the branch."""
            nonlocal branch, current
            if abs(value - current) > 1e-9 * top:
                branch, current = go(value), value
            return branch

        for i, side in enumerate(SIDES):
            loops = []
            for k, size in enumerate(SIZES):
                for j, position in enumerate(MEANS):
                    middle = position * (1.0 - size)
                    loops.append((side * middle + size, k, j, middle, size))
            # Each loop reaches further along the branch than the one before, and so takes it out
            # of the memory. Of loops that begin at the same value the larger one comes last.
            for _, k, j, middle, size in sorted(loops, key=lambda row: (row[0], row[4])):
                outer[i, k, j] = lead(mean + top * (middle + side * size))
                inner[i, k, j] = lead(mean + top * (middle - side * size))
                closed[i, k, j] = lead(mean + top * (middle + side * size))
            lead(mean + side * top)
        return MeanGrid(outer, inner, closed)


def memory_of_loops(
    amplitudes: NDArray[np.float64],
    top: float,
    middle: float,
    loops: NDArray[np.float64],
    sides: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the weights of D at both ends of loops on the largest one, by the rule of memory.

    `loops` are rows of amplitude and mean. A side is 1 for a loop on the rising branch, which
    begins at its largest value.
    """
    largest = amplitude_weights(amplitudes, np.array([top]))
    inside = amplitude_weights(amplitudes, loops[:, 0])
    # The outer end of the loop, on the branch from the other end of the largest loop.
    distance = sides * (loops[:, 1] - middle) + loops[:, 0] + top
    reach = amplitude_weights(amplitudes, np.clip(0.5 * distance, 0.0, top))
    outer = sides[:, None] * (2.0 * reach - largest)
    return outer, outer - sides[:, None] * 2.0 * inside


def grid_weights(loops: NDArray[np.float64], top: float, middle: float) -> NDArray[np.float64]:
    """Return the weights of the points (size, mean) of the grid in loops: rows amplitude, mean.

    The largest loop is in the table, so that the weights vanish there. Below the least size of the
    grid its points count in full.
    """
    size = np.clip(loops[:, 0] / top, 0.0, 1.0)
    room = np.maximum(top - loops[:, 0], 1e-12 * top)
    position = np.clip((loops[:, 1] - middle) / room, -1.0, 1.0)

    def hats(nodes: tuple[float, ...], values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the weights of linear interpolation between nodes, for each value."""
        return np.stack([np.interp(values, nodes, column) for column in np.eye(len(nodes))], axis=1)

    along_size = hats((*SIZES, 1.0), size)[:, : len(SIZES)]
    return np.asarray(np.einsum("lk,lj->lkj", along_size, hats(MEANS, position)))
