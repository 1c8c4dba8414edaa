"""A load path through loops of several amplitudes, each closed within the one before.

It stands for a history: a run goes through it once, and the numbers of a loop count as often as the
loop occurs. ::

    largest:   top -> bottom -> top          each loop: two branches from a reversal
    next:      -> bottom -> top -> bottom    after one branch that leads to it
    next:      -> top -> bottom -> top

Other channels follow the counted one: by a ratio in phase, and by one a quarter of a cycle later.
Both ratios are least squares over the history. With a part out of phase a loop is an ellipse.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from pyfret.history.load_history import LoadHistory, press
from pyfret.history.mean_grid import MeanGrid

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from pyfret._core import LoadPath, Scene

__all__ = ["Companions", "Ladder", "check_sliding", "follow_channels"]

#: Branches of half of an ellipse.
HALF_TURN = 8
#: Part out of phase, over the part in phase, below which channels are in phase.
IN_PHASE = 1e-3
#: Part of the sliding force that a history may have.
MOST_SHEAR = 1.0 - 1e-9


@dataclass(frozen=True)
class Companions:
    """How the other channels follow the counted one.

    ``ratios`` has three numbers for each channel. They are its value at the mean of the counted
    channel, the ratio in phase, and the ratio a quarter of a cycle later. ``residual`` is the part
    of their variance that neither ratio explains.
    """

    mean: float
    ratios: dict[str, tuple[float, float, float]]
    residual: float

    @property
    def turns(self) -> bool:
        """Whether some channel is out of phase."""
        return any(abs(quarter) > 0.0 for _, _, quarter in self.ratios.values())

    def values(self, u: float, v: float) -> dict[str, float]:
        """Return the other channels at a value `u` of the counted one and its quarter `v`."""
        return {
            name: middle + ratio * (u - self.mean) + quarter * v
            for name, (middle, ratio, quarter) in self.ratios.items()
        }


def follow_channels(history: LoadHistory) -> Companions:
    """Find how the other channels follow the counted one, by least squares."""
    if not history.is_series:
        return Companions(0.0, {}, 0.0)
    u = history.channels[history.channel]
    mean = 0.5 * float(u.max() + u.min())
    others = {name: c for name, c in history.channels.items() if name != history.channel}
    if not others:
        return Companions(mean, {}, 0.0)
    centred = u - u.mean()
    quarter = quarter_later(centred)
    design = np.column_stack([np.ones_like(u), u - mean, quarter])
    ratios: dict[str, tuple[float, float, float]] = {}
    unexplained = []
    for name, c in others.items():
        middle, ratio, later = np.linalg.lstsq(design, c, rcond=None)[0].tolist()
        if abs(later) * float(quarter.std()) <= IN_PHASE * max(float(c.std()), 1e-300):
            middle, ratio = np.linalg.lstsq(design[:, :2], c, rcond=None)[0].tolist()
            later = 0.0
        ratios[name] = (middle, ratio, later)
        remainder = c - design @ np.array(ratios[name])
        unexplained.append(float(remainder.var()) / max(float(c.var()), 1e-300) if c.std() else 0.0)
    return Companions(mean, ratios, max(unexplained))


def quarter_later(centred: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the Hilbert transform: each wave a quarter of its cycle later."""
    waves = np.fft.rfft(centred)
    waves *= -1j
    waves[0] = 0.0
    if centred.size % 2 == 0:
        waves[-1] = 0.0
    return np.fft.irfft(waves, centred.size)


def check_sliding(scene: Scene, history: LoadHistory, levels: NDArray[np.float64]) -> None:
    """Refuse a force beyond sliding; levels are rows of amplitude and mean."""
    if history.channel not in ("T_x", "T_y") or scene.friction.map is not None:
        return
    forces = history.channels.get("W")
    if forces is None:
        path = press(scene, {}, np.zeros(1, dtype=np.int64))
        limit = np.array([scene.friction.mu * float(path.W[-1])])
    else:
        limit = scene.friction.mu * forces
    if history.is_series:
        values = np.abs(history.channels[history.channel])
        beyond = values > MOST_SHEAR * limit
        if beyond.any():
            row = int(np.argmax(beyond))
            force_limit = float(np.broadcast_to(limit, values.shape)[row])
            raise ValueError(
                f"{history.channel}[{row}] = {history.channels[history.channel][row]:.6g} N: must "
                f"be below the sliding force mu W = {force_limit:.6g} N; give the shift instead"
            )
        return
    reach = levels[:, 0] + np.abs(levels[:, 1])
    if (reach > MOST_SHEAR * limit[0]).any():
        row = int(reach.argmax())
        raise ValueError(
            f"loop of amplitude {levels[row, 0]:.6g} N and mean {levels[row, 1]:.6g} N: must stay "
            f"below the sliding force mu W = {limit[0]:.6g} N; give the shift delta instead"
        )


@dataclass(frozen=True)
class Ladder:
    """The path through loops of falling amplitude, and where each of them is on it.

    Attributes
    ----------
    path : LoadPath
        What presses the bodies, then the loops.
    levels : array
        Rows of amplitude, mean, count, largest first.
    first_branch : int
        First branch of the loops: the path is closed from there.
    counts : array
        How often each branch from there on occurs.
    branches : list of (int, int)
        First and last branch of each loop.
    tops, bottoms : list of int
        Branch at whose end the loop has its largest and its least value.
    quarters : list of (int, int)
        Branches at whose ends it passes its mean, falling and rising; the ends of ellipses alone.
    grid : MeanGrid, optional
        Loops of several means after them.
    """

    path: LoadPath
    levels: NDArray[np.float64]
    first_branch: int
    counts: NDArray[np.float64]
    branches: list[tuple[int, int]]
    tops: list[int]
    bottoms: list[int]
    quarters: list[tuple[int, int]]
    grid: MeanGrid | None = None

    @staticmethod
    def build(
        scene: Scene,
        history: LoadHistory,
        levels: NDArray[np.float64],
        companions: Companions,
        *,
        settling: int = 0,
        with_means: bool = False,
    ) -> Ladder:
        """Build the path of some levels; `settling` loops of the first one come before it.

        `with_means`: a grid of loops of several means follows.
        """
        samples = history.block().tolist() if history.is_series else [0]
        lead_in = press(scene, history.channels, np.array(samples, dtype=np.int64))
        names = [history.channel, *companions.ratios]
        points: list[list[float]] = []
        counts: list[float] = []

        def add_point(u: float, v: float, count: float) -> None:
            """Append a target of the channels, and the number of loops it stands for."""
            others = companions.values(u, v)
            points.append([u, *(others[name] for name in names[1:])])
            counts.append(count)

        def half(amplitude: float, mean: float, count: float, *, falling: bool) -> None:
            """Go half a loop, to its other end, and note how many loops it stands for."""
            steps = HALF_TURN if companions.turns else 1
            start = 0.0 if falling else np.pi
            for k in range(1, steps + 1):
                angle = start + np.pi * k / steps
                u = mean + amplitude * (np.cos(angle) if companions.turns else (1 - 2 * falling))
                add_point(
                    float(u), float(amplitude * np.sin(angle)) if companions.turns else 0.0, count
                )

        before = len(lead_in.branches)
        branches, tops, bottoms, quarters = [], [], [], []
        is_top = True
        for n, (amplitude, mean, count) in enumerate(levels.tolist()):
            is_top = not is_top if n else True
            add_point(mean + amplitude if is_top else mean - amplitude, 0.0, 0.0)
            for _ in range(settling if n == 0 else 0):
                half(amplitude, mean, 0.0, falling=is_top)
                half(amplitude, mean, 0.0, falling=not is_top)
            first = before + len(points)
            half(amplitude, mean, count, falling=is_top)
            middle = before + len(points) - 1
            half(amplitude, mean, count, falling=not is_top)
            last = before + len(points) - 1
            branches.append((first, last))
            tops.append(last if is_top else middle)
            bottoms.append(middle if is_top else last)
            step = HALF_TURN // 2
            passes = (middle - step, last - step) if companions.turns else (middle, last)
            quarters.append(passes if is_top else passes[::-1])
        if len(levels) > 1:
            # Back to where the loops began.
            add_point(float(levels[0, 1] + levels[0, 0]), 0.0, 0.0)
        counted = len(points)

        def lead(u: float) -> int:
            """Add a branch to a value of the counted channel; return its number."""
            add_point(u, 0.0, 0.0)
            return before + len(points) - 1

        grid = None
        if with_means:
            grid = MeanGrid.build(lead, float(levels[0, 0]), float(levels[0, 1]))
        table = np.array(points)
        path = lead_in.waypoints(
            increments="auto", **{name: table[:, k] for k, name in enumerate(names)}
        )
        return Ladder(
            path,
            levels,
            before + 1,
            np.array(counts[1:counted]),
            branches,
            tops,
            bottoms,
            quarters,
            grid,
        )
