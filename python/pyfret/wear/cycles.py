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

__all__ = ["Cycles", "RangeOfCycles", "changed", "reached", "spent"]


def ended(cycles: float) -> str:
    """Return the text "more than N cycles", for a run that ended before it reached a value."""
    return f"more than {_core.rough(cycles)} cycles (the run ended there)"


class Cycles(float):
    """A number of cycles; NaN where the run ended before, and infinite without any wear.

    Printed it has four digits. A number that the run did not reach is a lower bound there: the last
    cycle of the run.
    """

    #: The last cycle of the run, where the run ended before; None of a number that is known.
    beyond: float | None
    #: The value at which wear has come to rest, with its unit; None where it goes on, or is zero.
    at_rest: str | None

    def __new__(
        cls, value: float, beyond: float | None = None, at_rest: str | None = None
    ) -> Cycles:
        """A number, or with `beyond` the last cycle of a run that ended before."""
        made = super().__new__(cls, value)
        made.beyond, made.at_rest = beyond, at_rest
        return made

    @classmethod
    def beyond_run(cls, last: float, rate: float, at_rest: str | None) -> Cycles:
        """Make the cycles to an unreached value: endless where wear rests, else beyond the run."""
        return cls(math.nan, last) if rate > 0.0 else cls(math.inf, at_rest=at_rest)

    def __reduce__(self) -> tuple[type[Cycles], tuple[float, float | None, str | None]]:
        """Copies and pickles have the bound, too."""
        return Cycles, (float(self), self.beyond, self.at_rest)

    def __repr__(self) -> str:
        """The number, or the bound in words."""
        if self.beyond is not None:
            return ended(self.beyond)
        if math.isinf(self) and self.at_rest is not None:
            return f"endless: wear has come to rest at {self.at_rest}"
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
        return repr(self.best) if math.isinf(self.low) else super().__repr__()


def in_unit(value: float, units: str) -> str | None:
    """Format a worn depth in um, anything else in its unit; None of zero."""
    if value <= 0.0:
        return None
    return f"{1e6 * value:.2g} um" if units == "m" else f"{value:.2g} {units}"


def spent(d: xr.Dataset, energy: float) -> Cycles:
    """Return the cycles at which the dissipated energy reaches `energy` [J]."""
    cycles, ends = (np.asarray(d[name].values, float) for name in ("cycles", "dissipated"))
    before = float(cycles[0] - d["length"][0])
    start = float(ends[0] - d["dissipated_per_cycle"][0] * d["length"][0])
    if energy > ends[-1]:
        amount = in_unit(float(ends[-1]), str(d["dissipated"].attrs.get("units", "J")))
        rate = float(d["dissipated_per_cycle"][-1])
        return Cycles.beyond_run(float(cycles[-1]), rate, amount)
    return Cycles(np.interp(energy, [max(start, 0.0), *ends], [before, *cycles]))


def changed(d: xr.Dataset, mu: float, fresh: float) -> Cycles:
    """Cycles at which the mean coefficient of friction has come to a value, from either side.

    The mean of each jump belongs to its middle, with straight lines between. Before the first one
    the coefficient is `fresh`; on surfaces that were worn before, the mean of the first jump.
    """
    was_worn = any(depth > 0.0 for depth in d.attrs["depth_before"])
    means, ends, lengths = (
        np.asarray(d[name].values, float) for name in ("mu", "cycles", "length")
    )
    start = float(means[0]) if was_worn else fresh
    # The last mean is kept up to the end.
    cycles = np.r_[ends[0] - lengths[0], ends - 0.5 * lengths, ends[-1]]
    values = np.r_[start, means, means[-1]]
    side = math.copysign(1.0, mu - start)
    beyond = np.flatnonzero(side * (values - mu) >= 0.0)
    if mu == start:
        return Cycles(cycles[0])
    if beyond.size == 0:
        return Cycles(math.nan, float(cycles[-1]))
    n = int(beyond[0])
    part = (mu - values[n - 1]) / (values[n] - values[n - 1])
    return Cycles(cycles[n - 1] + part * (cycles[n] - cycles[n - 1]))


def reached(d: xr.Dataset, name: str, target: float) -> Cycles:
    """Return the cycles at which a growing number of the jumps reaches a value, by parabolas.

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
        amount = in_unit(float(ends[-1]), str(d[name].attrs.get("units", "m")))
        return Cycles.beyond_run(float(d.cycles[-1]), last, amount)
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
