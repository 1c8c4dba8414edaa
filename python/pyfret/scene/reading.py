"""A map of heights as a file has it: numbers, pitch, channel, and what was assumed."""

from __future__ import annotations

import sys
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from pyfret._core import StoreError, shown
from pyfret._util.numbers import length

if TYPE_CHECKING:
    from os import PathLike

    import numpy as np
    from numpy.typing import NDArray

__all__ = ["Reading", "check_heights", "check_range", "summarize"]

#: Largest range of heights of an instrument [m]: steps of stages and of stitched maps.
HIGHEST = 0.5
#: Largest range of heights without a unit over the longer side of a map.
STEEPEST = 100.0


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


def check_range(rms: float) -> None:
    """Refuse heights that no instrument measures; half of a range is the largest S_q."""
    if rms > 0.5 * HIGHEST:
        raise StoreError(
            f"S_q of the heights is {length(rms)}: must be {length(0.5 * HIGHEST)} at most. The "
            "unit of the heights is likely another one: give the numbers as an array, "
            "SurfaceMap(1e-6 * heights, spacing=2e-6)"
        )


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
