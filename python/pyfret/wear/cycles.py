"""Cycles after which a run of wear has reached a value."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from pyfret import _core
from pyfret._util.numbers import in_words
from pyfret.fatigue.ranges import Range

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["Cycles", "RangeOfCycles", "reached", "spent"]


def ended(cycles: float) -> str:
    """Bounds for a run that ended before it reached a value."""
    return f"more than {_core.rough(cycles)} cycles (the run ended there)"


class Cycles(float):
    """A number of cycles; NaN where the run ended before, and infinite without any wear.

    Printed it has four digits. A number that the run did not reach is a lower bound there: the last
    cycle of the run.
    """

    #: The last cycle of the run, where the run ended before; None of a number that is known.
    beyond: float | None

    def __new__(cls, value: float, beyond: float | None = None) -> Cycles:
        """A number, or with `beyond` the last cycle of a run that ended before."""
        made = super().__new__(cls, value)
        made.beyond = beyond
        return made

    @classmethod
    def beyond_run(cls, last: float, rate: float) -> Cycles:
        """Make the cycles to an unreached value: endless without wear, else beyond the run."""
        return cls(math.nan, last) if rate > 0.0 else cls(math.inf)

    def __reduce__(self) -> tuple[type[Cycles], tuple[float, float | None]]:
        """Copies and pickles have the bound, too."""
        return Cycles, (float(self), self.beyond)

    def __repr__(self) -> str:
        """The number, or the bound in words."""
        if self.beyond is not None:
            return ended(self.beyond)
        return "endless: nothing wears" if math.isinf(self) else in_words(float(self))

    __str__ = __repr__


class RangeOfCycles(Range):
    """Cycles as a range; where the run ended before, ``low`` alone is known."""

    __slots__ = ()

    def __repr__(self) -> str:
        """The range in two digits, or the bound in words."""
        if math.isnan(self.best):
            return (
                f"more than {_core.rough(self.low)} cycles, scatter included (the run ended before)"
            )
        return "endless: nothing wears" if math.isinf(self.low) else super().__repr__()


def spent(d: xr.Dataset, energy: float) -> Cycles:
    """Cycles at which the dissipated energy [J] reaches a value: linear within a jump."""
    cycles, ends = (np.asarray(d[name].values, float) for name in ("cycles", "dissipated"))
    before = float(cycles[0] - d["length"][0])
    start = float(ends[0] - d["dissipated_per_cycle"][0] * d["length"][0])
    if energy > ends[-1]:
        return Cycles.beyond_run(float(cycles[-1]), float(d["dissipated_per_cycle"][-1]))
    return Cycles(np.interp(energy, [max(start, 0.0), *ends], [before, *cycles]))


def reached(d: xr.Dataset, name: str, target: float) -> Cycles:
    """Cycles at which a growing number of the jumps reaches a value, by parabolas.

    A run that ends where a coating is worn through may miss its bottom by rounding.
    """
    ends, middles, length = (np.asarray(d[k].values) for k in (name, f"{name}_halfway", "length"))
    if target <= 0.0:
        return Cycles(d.cycles[0] - length[0])
    quantity, body = name[:-1], int(name[-1])
    before = float(d.attrs[f"{quantity}_before"][body - 1])
    jumps = np.flatnonzero(ends >= target * (1.0 - _core.DEPTH_ROUNDING))
    if jumps.size == 0:
        last = float(ends[-1] - (ends[-2] if ends.size > 1 else before))
        return Cycles.beyond_run(float(d.cycles[-1]), last)
    n = int(jumps[0])
    start = float(ends[n - 1]) if n else before
    whole, energy_needed = float(ends[n]) - start, target - start
    if not (energy_needed > 0.0 and whole > 0.0):
        return Cycles(d.cycles[n] - length[n])
    half = min(max(float(middles[n]) - start, 0.25 * whole), 0.75 * whole)
    slope, bend = 4.0 * half - whole, 2.0 * whole - 4.0 * half
    part = (
        2.0 * energy_needed / (slope + math.sqrt(max(slope**2 + 4.0 * bend * energy_needed, 0.0)))
    )
    return Cycles(d.cycles[n] - length[n] * (1.0 - min(part, 1.0)))
