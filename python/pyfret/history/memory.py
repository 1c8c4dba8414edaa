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

import numpy as np
from numpy.typing import NDArray

__all__ = ["amplitude_weights", "state_weights"]


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


def state_weights(
    values: NDArray[np.float64], amplitudes: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the weights of the table's D in the state at each value of a block.

    The block begins at its largest value; the state there is M + D of the largest amplitude.
    """
    size = amplitudes.size
    weights = np.zeros((values.size, size))
    weights[0, -1] = 1.0
    stack = [(float(values[0]), weights[0])]
    direction = -1.0
    grid = amplitudes.tolist()
    for n in range(1, values.size):
        value = float(values[n])
        before = float(values[n - 1])
        if (value - before) * direction < 0.0 and n > 1:
            # The last point was a reversal.
            stack.append((before, weights[n - 1]))
            direction = -direction
        while len(stack) > 2 and (value - stack[-2][0]) * direction >= 0.0:
            del stack[-2:]
        origin, start = stack[-1]
        half = 0.5 * abs(value - origin)
        row = weights[n]
        row[:] = start
        if half <= grid[0]:
            row[0] += 2.0 * direction * half / grid[0]
            continue
        upper = min(int(np.searchsorted(amplitudes, half)), size - 1)
        part = min((half - grid[upper - 1]) / (grid[upper] - grid[upper - 1]), 1.0)
        row[upper] += 2.0 * direction * part
        row[upper - 1] += 2.0 * direction * (1.0 - part)
    return weights
