"""Counted loops: a table of range, mean and count, and the classes that stand for it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pyfret._util.arrays import number
from pyfret._util.figures import Figured
from pyfret._util.labelled import Labelled
from pyfret._util.lazy import xr
from pyfret._util.numbers import format_number
from pyfret._util.window import wrap
from pyfret.history.channels import channel_unit
from pyfret.history.counting import Residue, count_signal
from pyfret.history.spectrum import Distribution
from pyfret.quantities import quantities
from pyfret.saveable import Saveable

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from pyfret.history.spectrum import Spectrum

__all__ = ["CountedLoops", "distinct"]

#: Classes of the amplitude of a spectrum.
CLASSES = 400
#: Exponent of the amplitude whose mean a class keeps, by the energy of small loops of partial slip
#: (R. D. Mindlin, H. Deresiewicz, J. Appl. Mech. 20 (1953) 327-344).
SMALL_LOOPS = 3.0
#: Part of the largest amplitude by which equal ones may differ.
SAME = 1e-12
#: Text of the rules for ranges that do not close.
RULES = {
    "half": "ASTM E1049-85, 5.4.4: ranges that do not close are half cycles",
    "repeat": "ASTM E1049-85, 5.4.5: the history repeats as a block, so that every range closes",
}


class CountedLoops(Saveable, Labelled, Figured):
    """Loops of a load history.

    ``dataset`` has over ``loop``: ``range``, ``mean``, ``amplitude`` (half of the range),
    ``count``, and of a series the samples ``first`` and ``last`` between which the loop lies. Its
    attribute ``rule`` names the rule of counting.
    """

    figure = "loop_histogram"

    @classmethod
    def from_rows(cls, rows: NDArray[np.float64], channel: str, rule: str) -> CountedLoops:
        """Make a table of rows of range, mean, count, and perhaps first and last sample."""
        unit = channel_unit(channel)
        columns = {
            "range": (rows[:, 0], unit, "range of the loop"),
            "mean": (rows[:, 1], unit, "mean of the loop"),
            "amplitude": (0.5 * rows[:, 0], unit, "half of the range"),
            "count": (rows[:, 2], "1", "how often the loop occurs"),
        }
        if rows.shape[1] > 3:
            columns["first"] = (rows[:, 3], "1", "sample of the first turning point")
            columns["last"] = (rows[:, 4], "1", "sample of the second turning point")
        data = xr.Dataset(
            {
                name: ("loop", values.copy(), {"units": units, "long_name": text})
                for name, (values, units, text) in columns.items()
            }
        )
        return cls(data.assign_attrs(channel=channel, rule=rule))

    @classmethod
    def from_series(
        cls, values: NDArray[np.float64], residue: Residue, channel: str
    ) -> CountedLoops:
        """Count a series by rainflow."""
        return cls.from_rows(count_signal(values, residue), channel, RULES[residue])

    @classmethod
    def from_spectrum(
        cls,
        spectrum: Spectrum,
        distribution: Distribution,
        duration: float,
        mean: float,
        channel: str,
    ) -> CountedLoops:
        """Count the loops of a Gaussian load by its distribution, in classes of the amplitude."""
        cycles = spectrum.rate(distribution) * duration
        low, high = 0.0, 100.0 * spectrum.rms
        for _ in range(60):
            middle = 0.5 * (low + high)
            rare = float(spectrum.exceedance([middle], distribution)[0]) * cycles < 1.0
            low, high = (low, middle) if rare else (middle, high)
        edges = np.linspace(0.0, high, CLASSES + 1)
        exceeding = spectrum.exceedance(edges, distribution)
        # The last class has the loops that are larger.
        exceeding[-1] = 0.0
        a, b = edges[:-1], edges[1:]
        # Mean cube of an even density within the class.
        amplitude = ((b**4 - a**4) / (4.0 * (b - a))) ** (1.0 / SMALL_LOOPS)
        counts = cycles * np.maximum(exceeding[:-1] - exceeding[1:], 0.0)
        rows = np.column_stack([2.0 * amplitude, np.full(CLASSES, mean), counts])
        text = f"{distribution} distribution, amplitudes up to the one that is exceeded once"
        return cls.from_rows(rows[counts > 0.0], channel, text)

    @property
    def total(self) -> float:
        """Return the number of loops."""
        return float(self.dataset["count"].sum())

    @property
    def largest_range(self) -> float:
        """Range of the largest loop."""
        return float(self.dataset["range"].max()) if self.dataset.sizes["loop"] else 0.0

    def equivalent_amplitude(self, exponent: float) -> float:
        """Return the amplitude of as many constant loops with the same sum of amplitude^exponent.

        Parameters
        ----------
        exponent : float
            Exponent m of the curve N ~ amplitude^-m, or of the energy of a loop: 3 for small loops
            of partial slip.
        """
        m = number(exponent, "exponent")
        if not 0.0 < m <= 100.0:
            raise ValueError(f"exponent = {m}: must be above 0, at most 100")
        a, n = self.dataset.amplitude.values, self.dataset["count"].values
        if not n.sum() > 0.0:
            raise ValueError("there is no loop: the history is constant")
        top = float(a.max())
        mean_power = float((n * (a / top) ** m).sum() / n.sum())
        return float(top * mean_power ** (1.0 / m))

    def histogram(
        self, ranges: int = 24, means: int = 24
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """Return the edges of ranges and means, and the counts in between."""
        d = self.dataset
        counts, range_edges, mean_edges = np.histogram2d(
            d["range"].values,
            d["mean"].values,
            bins=(ranges, means),
            range=((0.0, max(self.largest_range, 1e-300)), padded(d["mean"].values)),
            weights=d["count"].values,
        )
        return range_edges, mean_edges, counts

    @quantities
    def classes(self, count: int) -> NDArray[np.float64]:
        """Return classes that stand for the loops: rows of amplitude, mean, count, largest first.

        Loops of few amplitudes are classes as they are. Otherwise a class keeps the number of its
        loops, their mean, and the sum of amplitude^3, to which the energy of small loops is
        proportional.
        """
        d = self.dataset
        a, m, n = d.amplitude.values, d["mean"].values, d["count"].values
        top = float(a.max())
        levels = distinct(a / top)
        if levels.size <= count:
            index = np.searchsorted(levels, a / top, side="right") - 1
            size = levels.size
        else:
            # Classes of equal parts of the energy of small loops, the largest one among them.
            index = np.minimum((a / top * count).astype(int), count - 1)
            size = count
        rows = []
        for k in range(size)[::-1]:
            inside = index == k
            number_of_loops = float(n[inside].sum())
            if number_of_loops == 0.0:
                continue
            cube = float((n[inside] * (a[inside] / top) ** SMALL_LOOPS).sum()) / number_of_loops
            mean = float((n[inside] * m[inside]).sum()) / number_of_loops
            amplitude = top * cube ** (1.0 / SMALL_LOOPS)
            if np.ptp(a[inside]) <= 1e-12 * top:
                amplitude = float(a[inside].max())
            rows.append([amplitude, mean, number_of_loops])
        return np.array(rows)

    def summary(self) -> str:
        """Describe the loops: how many, the largest, the rule of counting."""
        return wrap(repr(self))

    def __repr__(self) -> str:
        """The loops in a line."""
        unit = self.dataset["range"].attrs["units"]
        return (
            f"{self.dataset.attrs['channel']}: {format_number(self.total)} loops, ranges up to "
            f"{format_number(self.largest_range)} {unit} ({self.dataset.attrs['rule']})"
        )


def distinct(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the ascending values that differ by more than rounding from the one below."""
    ordered = np.sort(values)
    first = np.append(True, np.diff(ordered) > SAME * ordered[-1])
    return np.asarray(ordered[first])


def padded(values: NDArray[np.float64]) -> tuple[float, float]:
    """Return the ends of an axis that leaves some room around values."""
    low, high = float(values.min()), float(values.max())
    room = 0.5 * (high - low) / 24.0 or max(abs(low), 1.0) * 0.05
    return low - room, high + room
