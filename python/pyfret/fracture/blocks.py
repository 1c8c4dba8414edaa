"""Growth of a crack by the loops of a load history, pass by pass.

In one pass a crack grows by the sum of count dl/dN(dK) over the loops. The range dK follows from
the stress intensity at the two ends of a loop. Counts may be fractions. Loops do not act on one
another: there is no retardation.
"""

from __future__ import annotations

import math

import numpy as np

from pyfret import _core
from pyfret._core import Scene
from pyfret._util.arrays import plain
from pyfret._util.labelled import Labelled
from pyfret._util.lazy import xr
from pyfret._util.numbers import um
from pyfret._util.window import wrap
from pyfret.fracture.growth import Paris, Threshold
from pyfret.history.load_history import LoadHistory
from pyfret.history.states import states_of_march
from pyfret.history.table import HistoryTable
from pyfret.quantities import Angle, CrackLengths, Length, as_number, quantities
from pyfret.run.run import Run
from pyfret.subsurface.moments import states_of_increments

__all__ = ["BlockGrowth", "grow_by_history"]

#: Unit of dK in Paris' law [Pa m^0.5].
UNIT = 1e6
#: A threshold that nothing is compared with [Pa m^0.5].
NO_THRESHOLD = 4e6


class BlockGrowth(Labelled):
    """Growth of cracks in one pass of a load history.

    ``dataset`` has over ``length``: ``growth`` of one pass [m], and ``dK_max``, the largest
    equivalent range of a loop [Pa m^0.5].
    """

    def passes(self, start: Length, end: Length) -> float:
        """Return the passes in which a crack grows from one length to another.

        Infinite where it stops in between.
        """
        first, last = as_number(start), as_number(end)
        lengths, growth = self.dataset.length.values, self.dataset.growth.values
        if not lengths[0] <= first < last <= lengths[-1]:
            raise ValueError(
                f"start = {first} m, end = {last} m: must lie within the lengths, {lengths[0]:.4g} "
                f"to {lengths[-1]:.4g} m, in this order"
            )
        grid = np.unique(
            np.concatenate([[first, last], lengths[(lengths > first) & (lengths < last)]])
        )
        rate = np.interp(grid, lengths, growth)
        if (rate <= 0.0).any():
            return math.inf
        # 1/rate is integrated exactly for rates that are powers of the length.
        power = np.diff(np.log(rate)) / np.diff(np.log(grid))
        a, b, r = grid[:-1], grid[1:], rate[:-1]
        exponent = 1.0 - power
        ratio = np.log(b / a)
        part = np.where(
            np.abs(exponent) * ratio < 1e-9, ratio, np.expm1(exponent * ratio) / exponent
        )
        return float((a / r * part).sum())

    def summary(self) -> str:
        """Describe the growth at the ends of the lengths."""
        d = self.dataset
        ends = [0, -1]
        return wrap(
            "\n".join(
                f"{um(float(d.growth[k]))} in one pass at a length of {um(float(d.length[k]))}"
                for k in ends
            )
        )

    __repr__ = summary


@quantities
def grow_by_history(
    contact: Run | Scene,
    history: LoadHistory,
    growth: Paris,
    x: Length,
    lengths: CrackLengths,
    *,
    threshold: Threshold | None = None,
    angle: Angle = 0.0,
    azimuth: Angle = 0.0,
    offset: Length = 0.0,
    body_number: int = 2,
    table: HistoryTable | None = None,
    progress: bool = True,
) -> BlockGrowth:
    """Sum the growth of cracks in one pass of a load history, without retardation.

    Parameters
    ----------
    contact, history, table, progress
        As in :func:`pyfret.fatigue.damage`.
    growth : Paris or material
        Law of growth.
    x : float
        Place of the mouth [m].
    lengths : array
        Lengths of the cracks [m].
    threshold : Threshold or material, optional
        Range below which a loop does not count (default: none).
    angle, azimuth, offset, body_number
        As in :func:`crack`.

    Raises
    ------
    ValueError
        The law subtracts its threshold; a force beyond sliding; a result of another history.
    """
    if growth.threshold_in != "plain":
        raise ValueError(
            f"growth.threshold_in = {growth.threshold_in!r}: must be 'plain' for a history of loops"
        )
    if isinstance(contact, Scene):
        made = table or HistoryTable.build(contact, history, progress=progress)
        run, states = made.run, made.loop_states()
    else:
        run, states = contact, states_of_march(contact, history, history.count())
    long = np.sort(np.atleast_1d(plain(lengths, "lengths")))
    scene = run.scene
    body = scene.body1 if body_number == 1 else scene.body2
    moments = states_of_increments(run, [int(n) for n in states.increments], body_number)
    below = _core.ContactForCracks(body, moments, body_number=body_number)
    intensity = below.intensity(
        x=as_number(x),
        lengths=long.tolist(),
        angle=as_number(angle),
        azimuth=as_number(azimuth),
        offset=as_number(offset),
    )
    # Without contact of the faces K is a sum of the states.
    K = np.einsum("lmi,ic->lmc", states.weights, intensity["K_I_linear"])
    K_max, K_min = K.max(axis=1), K.min(axis=1)
    # The equivalent range depends on the load ratio, not on the threshold.
    numbers = (threshold or Threshold(dK_th=NO_THRESHOLD))._numbers()
    ranges = np.array(
        _core.equivalent_range(numbers, K_max.ravel().tolist(), K_min.ravel().tolist())
    ).reshape(K_max.shape)
    least = np.zeros(long.size) if threshold is None else threshold.range_at(long)
    counted = np.where(ranges > least, ranges, 0.0)
    rate = growth.C * (counted / UNIT) ** growth.m
    in_pass = states.rows[:, 2] @ rate
    return BlockGrowth(
        xr.Dataset(
            {
                "growth": (
                    "length",
                    in_pass,
                    {"units": "m", "long_name": "growth in one pass of the history"},
                ),
                "dK_max": (
                    "length",
                    ranges.max(axis=0),
                    {"units": "Pa m^0.5", "long_name": "largest equivalent range of a loop"},
                ),
            },
            coords={"length": ("length", long, {"units": "m"})},
        )
    )
