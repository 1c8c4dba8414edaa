"""Runs a truth on its grids and with its increments."""

from __future__ import annotations

import time
from dataclasses import dataclass
from itertools import takewhile
from typing import TYPE_CHECKING

import pyfret as fret
from validation.truth import LEFT_BY_CELLS, Known, Truth, order, root_mean_square

if TYPE_CHECKING:
    from collections.abc import Callable


@dataclass(frozen=True)
class Ladder:
    """A truth met by ever finer runs: errors of every number, order, processor time, error bars."""

    sizes: tuple[int, ...]
    seconds: list[float]
    known: list[dict[str, Known]]
    #: Estimated error of every number that has an error bar, in its own unit.
    bars: list[dict[str, float]]

    def names(self) -> list[str]:
        """Names of the numbers."""
        return list(self.known[-1])

    def errors(self, name: str) -> list[float]:
        """Errors of a number, over its truth or its scale."""
        return [known[name].error for known in self.known]

    def honesty(self) -> list[float]:
        """True error over estimated error of every number with an error bar, on every grid."""
        return [
            abs(known[name].ours - known[name].truth) / bar
            for known, bars in zip(self.known, self.bars, strict=True)
            for name, bar in bars.items()
            if bar > 0
        ]

    def order(self, name: str) -> float:
        """Order that a number converges with."""
        return order(self.sizes, self.errors(name))

    def order_along_path(self, name: str) -> float:
        """Order in the increments, as long as the error is not that of the cells."""
        errors = self.errors(name)
        left = LEFT_BY_CELLS * abs(errors[-1])
        of_path = list(takewhile(lambda error: abs(error) > left, errors))
        return order(self.sizes[: len(of_path)], of_path)


@dataclass(frozen=True)
class Outcome:
    """All that a page shows."""

    truth: Truth
    finest: fret.Result
    grids: Ladder
    increments: Ladder | None
    #: Root mean square over the places of the rim within the cells.
    placed: Ladder | None = None

    @property
    def worst(self) -> tuple[str, float]:
        """The number with the largest error on the finest grid, and that error."""
        name = max(self.grids.names(), key=lambda name: abs(self.grids.errors(name)[-1]))
        return name, self.grids.errors(name)[-1]

    @property
    def ordered(self) -> Ladder:
        """The ladder that tells orders: of all places of the rim if there is one."""
        return self.grids if self.placed is None else self.placed


def climb(
    truth: Truth, scene: Callable[[int], fret.Scene], sizes: tuple[int, ...]
) -> tuple[Ladder, fret.Result]:
    """Solve the scene at every size, with error bars; the ladder, and the last result."""
    seconds, known, bars = [], [], []
    for size in sizes:
        started = time.process_time()
        result = fret.solve(scene(size), progress=False, error=truth.has_error_bars)
        seconds.append(time.process_time() - started)
        known.append(truth.known(result))
        bars.append(error_bars(result, known[-1]) if truth.has_error_bars else {})
    return Ladder(sizes, seconds, known, bars), result


def error_bars(result: fret.Result, known: dict[str, Known]) -> dict[str, float]:
    """Estimated errors of the numbers that have one."""
    bars = result.error_bars().sel(part="total")
    return {name: float(bars[k.of][-1]) for name, k in known.items() if k.of is not None}


def run(truth: Truth, *, quick: bool = False) -> Outcome:
    """Solve a truth; `quick` on its two coarsest grids and with its two smallest numbers."""
    part = slice(2) if quick else slice(None)
    grids, finest = climb(truth, truth.scene, truth.grids[part])
    increments = None
    if truth.path is not None:
        sizes = truth.increments[part]
        increments = over_places(truth, truth.path, sizes, truth.path_places)
    placed = None
    if truth.placed is not None:
        placed = over_places(truth, truth.placed, truth.placed_grids[part], truth.places)
    return Outcome(truth, finest, grids, increments, placed)


def over_places(
    truth: Truth,
    scene: Callable[[int, int], fret.Scene],
    sizes: tuple[int, ...],
    places: int,
) -> Ladder:
    """Solve the scene at every size with the rim at several places within the cells."""
    seconds, known = [], []
    for size in sizes:
        started = time.process_time()
        runs = [fret.solve(scene(size, k), progress=False) for k in range(places)]
        seconds.append((time.process_time() - started) / places)
        numbers = [truth.known(run) for run in runs]
        known.append(numbers[0] if places == 1 else root_mean_square(numbers))
    return Ladder(sizes, seconds, known, [{} for _ in sizes])
