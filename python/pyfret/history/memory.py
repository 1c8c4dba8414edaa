"""The rule of memory: the state of a contact at the reversals of a history, from few loops.

Like bodies under a constant normal force have two rules (G. Masing, Proc. 2nd Int. Congr. Appl.
Mech. (1926) 332-335). Every branch is the virgin curve, doubled, from its last reversal. A branch
that closes a loop goes on as if the loop had not been. With D(a) half of the change of a state over
a loop of the amplitude a, a state is

    s = M + D(A) - 2 D(r_1/2) + 2 D(r_2/2) - ...

M is the middle of the largest loop, of amplitude A, and r_k are the ranges that are open. D is
linear between the amplitudes of a table. Below the least one it is proportional to the amplitude.
"""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

__all__ = ["amplitude_weights", "branch_origins", "state_weights"]


def amplitude_weights(
    amplitudes: NDArray[np.float64], wanted: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the weights of the table's D, ascending amplitudes, in the D of wanted amplitudes."""
    weights = np.zeros((wanted.size, amplitudes.size))
    rows = np.arange(wanted.size)
    upper = np.clip(np.searchsorted(amplitudes, wanted), 0, amplitudes.size - 1)
    lower = np.maximum(upper - 1, 0)
    span = amplitudes[upper] - amplitudes[lower]
    part = np.where(span > 0.0, (wanted - amplitudes[lower]) / np.where(span > 0.0, span, 1.0), 1.0)
    part = np.clip(part, 0.0, 1.0)
    weights[rows, upper] += part
    weights[rows, lower] += np.where(upper == lower, 0.0, 1.0 - part)
    below = wanted < amplitudes[0]
    weights[below] = 0.0
    weights[below, 0] = wanted[below] / amplitudes[0]
    return weights


def branch_origins(values: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return the reversal at which the branch of each value begins, loops that closed left out.

    The first value is the largest one, and its own origin.
    """
    origins = [0] * values.size
    series = values.tolist()
    stack = [0]
    falling = True
    previous = series[0]
    for n in range(1, len(series)):
        value = series[n]
        if n > 1 and (value > previous if falling else value < previous):
            # The last point was a reversal.
            stack.append(n - 1)
            falling = not falling
        while len(stack) > 2 and (
            value <= series[stack[-2]] if falling else value >= series[stack[-2]]
        ):
            del stack[-2:]
        origins[n] = stack[-1]
        previous = value
    return np.array(origins, dtype=np.int64)


def state_weights(
    values: NDArray[np.float64], amplitudes: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the weights of the table's D in the state at each value of a block.

    The block begins at its largest value; the state there is M + D of the largest amplitude.
    """
    origins = branch_origins(values)
    change = values - values[origins]
    weights = amplitude_weights(amplitudes, 0.5 * np.abs(change))
    weights *= 2.0 * np.sign(change)[:, None]
    weights[0] = 0.0
    weights[0, -1] = 1.0
    # A state adds its branch to the state of the origin, which lies one level higher.
    level = np.zeros(values.size, dtype=np.int64)
    levels = [0] * values.size
    for n, origin in enumerate(origins.tolist()):
        levels[n] = levels[origin] + 1 if n else 0
    level[:] = levels
    order = np.argsort(level, kind="stable")
    starts = np.searchsorted(level[order], np.arange(1, int(level.max()) + 2))
    for first, last in itertools.pairwise(starts):
        rows = order[first:last]
        weights[rows] += weights[origins[rows]]
    return weights
