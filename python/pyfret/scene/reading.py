"""A map of heights as a file has it: numbers, pitch, channel, and what was assumed."""

from __future__ import annotations

import sys
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from pyfret._core import StoreError, shown
from pyfret._util.numbers import length

if TYPE_CHECKING:
    from os import PathLike

    from numpy.typing import NDArray

__all__ = ["Reading", "check_heights", "check_sizes", "remove_mean", "summarize"]

#: Smallest and largest side of a map of an instrument [m]: a scan of 0.1 um, a stage of 0.5 m.
SHORTEST, LONGEST = 1e-7, 0.5
#: Largest range of heights of an instrument [m]: steps of stages and of stitched maps.
HIGHEST = 0.5
#: Largest range of heights without a unit over the longer side of a map.
STEEPEST = 100.0
#: Lines whose mean is taken at a time: little memory.
LINES = 256


@dataclass
class Reading:
    """A map of heights of a file."""

    #: The format, with its edition.
    kind: str
    #: The library that reads it, and its release.
    reader: str
    #: Heights over (x, y) [m], NaN where nothing was measured.
    heights: NDArray[np.float64]
    #: Distance of the points along x and y [m].
    spacing: tuple[float, float]
    #: Names of the channels of heights, and the one that is read.
    channels: tuple[str, ...] = ()
    channel: str = ""
    #: What was assumed or chosen, a sentence each.
    notes: list[str] = field(default_factory=list)


def check_sizes(shape: tuple[int, ...], spacing: tuple[float, float]) -> None:
    """Refuse a map larger or smaller than any instrument measures: its unit is another one."""
    for axis, count, step in zip("xy", shape, spacing, strict=True):
        if count < 2:
            continue
        size = count * step
        if not SHORTEST <= size <= LONGEST:
            raise StoreError(
                f"the map is {length(size)} long in {axis}, {count} points of "
                f"{length(step)}: must be {length(SHORTEST)} to {length(LONGEST)}. "
                "The unit of its lengths is likely another one. If you know the pitch, give "
                "spacing=2e-6, in m"
            )


def check_heights(
    peak_to_valley: float, shape: tuple[int, ...], spacing: tuple[float, float]
) -> None:
    """Refuse heights without a unit that reach much further than the map is long."""
    side = max(count * step for count, step in zip(shape, spacing, strict=True))
    if peak_to_valley > STEEPEST * side:
        raise StoreError(
            f"the heights reach over {length(peak_to_valley)} if they are in m, and the map is "
            f'{length(side)} long: give their unit, such as unit="um"'
        )


def remove_mean(heights: NDArray[np.float64]) -> None:
    """Subtract the mean of the measured points, in place."""
    # Along the memory, whichever axis comes first in it.
    lines = heights if heights.flags.c_contiguous else heights.T
    total = float(lines.sum())
    count = heights.size
    if np.isnan(total):
        total, count = 0.0, 0
        for first in range(0, len(lines), LINES):
            rows = lines[first : first + LINES]
            measured = ~np.isnan(rows)
            total += float(np.sum(rows, where=measured))
            count += int(measured.sum())
    if count:
        lines -= total / count


def summarize(
    path: str | PathLike[str],
    shape: tuple[int, ...],
    spacing: tuple[float, float],
    rms: float,
    kind: str,
) -> None:
    """Print points, pitch, size and S_q of a map that was read, on standard error."""
    points = " x ".join(str(count) for count in shape)
    pitch = " x ".join(length(step) for step in spacing)
    size = " x ".join(length(n * step) for n, step in zip(shape, spacing, strict=True))
    text = f"{path}: {kind}, {points} points, pitch {pitch}, size {size}, S_q {length(rms)}"
    print(shown(text), file=sys.stderr)
