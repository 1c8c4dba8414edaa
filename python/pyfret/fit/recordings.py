"""Recordings of data acquisition: channels with clocks, of which two are read and aligned.

TDMS of LabVIEW by npTDMS, MAT files by scipy (up to 7.2) and h5py (7.3), HDF5 by h5py, MDF by
asammdf. Channels are listed first. The samples of the two that are used are read alone.

Channels of different clocks are resampled: the one with more samples onto the instants of the other
one, linearly, where both were recorded. Whole numbers are held until the next sample. A note has
the rule. Channels of different lengths without clocks are refused.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from pyfret.fit.columns import RecordColumns, kind_of, split_unit

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from numpy.typing import NDArray

__all__ = ["Channel", "Recording"]

#: Part of the interval of a clock by which two clocks of one beat may differ.
SAME_CLOCK = 1e-6


@dataclass(frozen=True)
class Channel:
    """A channel of a recording; its samples are read when they are asked for."""

    #: Group and name.
    group: str
    name: str
    unit: str
    size: int
    #: Reads the samples.
    read: Callable[[], NDArray[np.generic]]
    #: Reads the instants of the samples [s]; None for a channel without a clock.
    clock: Callable[[], NDArray[np.float64]] | None = None
    #: Begin, interval of an even clock [s].
    even: tuple[float, float] | None = None
    #: Reads the samples in pieces, as the file has them; None: at once.
    pieces: Callable[[], Iterable[NDArray[np.generic]]] | None = None


class Recording(RecordColumns):
    """Channels of a file as columns.

    ``units`` are those that the user gives beside the file.
    """

    def __init__(
        self, place: str, channels: Sequence[Channel], units: dict[str, str] | None = None
    ) -> None:
        if not channels:
            raise ValueError(f"{place}: has no channels of numbers")
        short = [channel.name for channel in channels]
        names, measures = [], []
        for channel in channels:
            alone = short.count(channel.name) == 1
            name, unit = (channel.name, channel.unit) if channel.unit else split_unit(channel.name)
            names.append(name if alone else f"{channel.group}/{name}")
            measures.append(unit)
        super().__init__(place, tuple(names), tuple(measures))
        self.channels = tuple(channels)
        for name, unit in (units or {}).items():
            index = self.index(name)
            if kind_of(self.units[index]) and self.units[index] != unit:
                raise ValueError(
                    f"{place}: units: {name!r} is given in {unit!r}, and the file has "
                    f"{self.units[index]!r}: leave it out"
                )
            self.units = (*self.units[:index], unit, *self.units[index + 1 :])

    def raw(self, indices: tuple[int, ...]) -> list[NDArray[np.float64]]:
        """Read channels in their units, aligned in time."""
        chosen = [self.channels[index] for index in indices]
        if not self.is_one_clock(chosen):
            return list(self.aligned(chosen).T.copy())
        columns = []
        for channel in chosen:
            samples = channel.read()
            self.must_be_whole(channel, len(samples))
            columns.append(samples.astype(float))
        return columns

    def scaled(self, indices: tuple[int, ...], factors: list[float]) -> list[NDArray[np.float64]]:
        """Read channels times a factor each, pieces in turn if the file has them."""
        chosen = [self.channels[index] for index in indices]
        readers = [channel.pieces for channel in chosen if channel.pieces is not None]
        if len(readers) < len(chosen) or not self.is_one_clock(chosen):
            return super().scaled(indices, factors)
        columns = []
        for channel, factor, read_pieces in zip(chosen, factors, readers, strict=True):
            values = np.empty(channel.size)
            count = 0
            for piece in read_pieces():
                end = count + len(piece)
                if end <= channel.size:
                    np.multiply(piece, factor, out=values[count:end])
                count = end
            self.must_be_whole(channel, count)
            columns.append(values)
        return columns

    def must_be_whole(self, channel: Channel, count: int) -> None:
        """Refuse a channel with more or fewer samples than the file states."""
        if count != channel.size:
            raise ValueError(
                f"{self.place}: {channel.name}: {count} samples of {channel.size}: the file is not "
                "whole"
            )

    def is_one_clock(self, channels: Sequence[Channel]) -> bool:
        """Check that channels have samples at the same instants."""
        first = channels[0]
        if any(channel.size != first.size for channel in channels):
            return False
        evens = [channel.even for channel in channels if channel.even is not None]
        if evens and len(evens) == len(channels):
            begin, step = evens[0]
            limit = SAME_CLOCK * abs(step)
            return all(
                abs(start - begin) <= limit and abs(dt - step) * first.size <= max(limit, abs(step))
                for start, dt in evens
            )
        clocks = [channel.clock() for channel in channels if channel.clock is not None]
        if len(clocks) < len(channels) or len(clocks) < 2:
            return True
        step = float(np.ptp(clocks[0])) / max(first.size - 1, 1)
        return all(np.abs(clock - clocks[0]).max() <= SAME_CLOCK * step for clock in clocks[1:])

    def aligned(self, channels: Sequence[Channel]) -> NDArray[np.float64]:
        """Read channels of different clocks at the instants of the slowest one."""
        bare = [channel for channel in channels if channel.clock is None]
        if bare:
            sizes = ", ".join(f"{channel.name} has {channel.size}" for channel in channels)
            raise ValueError(
                f"{self.place}: {sizes} samples, and {bare[0].name} has no clock: must have as many"
            )
        clocks = [channel.clock() for channel in channels if channel.clock is not None]
        samples = [channel.read() for channel in channels]
        slowest = min(range(len(channels)), key=lambda n: channels[n].size)
        begin = max(clock[0] for clock in clocks)
        end = min(clock[-1] for clock in clocks)
        instants = clocks[slowest]
        instants = instants[(instants >= begin) & (instants <= end)]
        if instants.size < 2:
            raise ValueError(f"{self.place}: the channels were recorded at different times")
        rows = np.empty((instants.size, len(channels)))
        for column, (clock, values) in enumerate(zip(clocks, samples, strict=True)):
            name = channels[column].name
            if (np.diff(clock) <= 0.0).any():
                raise ValueError(f"{self.place}: the clock of {name} does not grow")
            if column == slowest:
                rows[:, column] = values[(clock >= begin) & (clock <= end)]
                continue
            held = values.dtype.kind in "iub"
            if held:
                rows[:, column] = values[np.searchsorted(clock, instants, side="right") - 1]
            else:
                rows[:, column] = np.interp(instants, clock, values.astype(float))
            rule = "the last whole number before" if held else "interpolated linearly at"
            self.notes.append(
                f"{name}, {values.size} samples, is {rule} the {instants.size} instants of "
                f"{channels[slowest].name}"
            )
        return rows
