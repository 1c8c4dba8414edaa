"""One history in many forms: energy, wear, life and stress intensity beside its zigzag.

    python tests/campaign/histories.py [COUNT]

A cylinder on a flat under random swings of shear, alone or with a bulk stress in or out of phase.
The zigzag from reversal to reversal is the truth, out of phase a sine of 96 points. The same swing
comes as a sine of 8, 16 or 64 points at any phase, as a function, and as a file with noise of 0.1 %
and a given period. Each
line is a form of a history. The last lines are the shares within the printed errors. What is
refused is named.
"""

from __future__ import annotations

import math
import sys
import warnings
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

import pyfret as fret

TI = fret.Elastic(E=116e9, nu=0.32)
R, W, MU = 20e-3, 6e5, 0.5
A = fret.reference.line_contact(R=R, bodies=(TI, TI), W=W).a
PRESSED = fret.LoadPath.start().normal(W, increments=1)
LAW = fret.wear.Archard(k=1e-16)
#: Largest ratio of a difference to the errors of both.
MOST = 1.5
#: Increments from reversal to reversal.
FINE = 16

#: A number and its error.
Number = tuple[float, float]


@dataclass(frozen=True)
class History:
    """A swing of the shear, and of the bulk stress in or out of phase with it."""

    #: Amplitudes of T_x [N/m] and sigma_B [Pa].
    T: float
    sigma_B: float
    #: Phase at which the forms begin [rad].
    phase: float
    points: int
    seed: int
    #: Phase of the bulk stress behind the shear [rad].
    lag: float = 0.0

    @property
    def swings(self) -> dict[str, float]:
        """Amplitudes of the loads that swing."""
        amplitudes = {"T_x": self.T, "sigma_B": self.sigma_B}
        return {name: value for name, value in amplitudes.items() if value}

    @property
    def phases(self) -> dict[str, float]:
        """Phases of the loads that swing."""
        phases = {"T_x": self.phase, "sigma_B": self.phase - self.lag}
        return {name: phases[name] for name in self.swings}

    def truth(self) -> fret.LoadPath:
        """Go from reversal to reversal; out of phase along a smooth curve."""
        if self.lag:
            return PRESSED.sine(2, **self.swings, phase=self.phases, points=96, increments=1)
        path = PRESSED
        for sign in (1.0, -1.0, 1.0, -1.0, 1.0):
            loads = {name: sign * value for name, value in self.swings.items()}
            path = path.force(**loads, increments=FINE)
        return path

    def sampled(self, t: np.ndarray) -> dict[str, np.ndarray]:
        """The loads at phases t [periods]."""
        return {
            name: value * np.sin(2.0 * np.pi * t + self.phases[name])
            for name, value in self.swings.items()
        }

    def sine(self) -> fret.LoadPath:
        """A sine of a few points."""
        increments = max(1, 2 * FINE // self.points)
        return PRESSED.sine(
            2, **self.swings, phase=self.phases, points=self.points, increments=increments
        )

    def function(self) -> fret.LoadPath:
        """A function of time."""

        def loads(t: float) -> dict[str, float]:
            return {name: float(v) for name, v in self.sampled(np.asarray(t)).items()}

        return PRESSED.from_function(loads, period=1.0, points=64, increments=1)

    def file(self) -> fret.LoadPath:
        """Two periods and a half of a recording with noise of 0.1 %."""
        rng = np.random.default_rng(self.seed)
        n = np.arange(1, 161)
        loads = {
            name: values + 1e-3 * self.swings[name] * rng.standard_normal(n.size)
            for name, values in self.sampled(n / 64).items()
        }
        return PRESSED.waypoints(t=1.0 + n / 64, **loads, increments=1).repeats(period=1.0)


def drawn(seed: int) -> History:
    """Draw a history."""
    rng = np.random.default_rng([seed, 8701])
    history = History(
        T=float(rng.uniform(0.25, 0.9)) * MU * W,
        sigma_B=float(rng.uniform(5e7, 3e8)) if rng.random() < 0.5 else 0.0,
        phase=float(rng.uniform(0.0, 2.0 * np.pi)),
        points=int(rng.choice([8, 16, 64])),
        seed=seed,
    )
    lags = rng.random() < 0.4 and history.sigma_B > 0.0
    return replace(history, lag=float(rng.uniform(0.2, 3.0))) if lags else history


def scene(path: fret.LoadPath) -> fret.Scene:
    """The contact under a path."""
    return fret.Scene(
        body1=fret.Body(TI, shape=fret.Cylinder(R=R)),
        body2=fret.Body(TI),
        friction=MU,
        grid=fret.Grid.strip(extent=2.8 * A, n=96),
        path=path,
    )


def numbers(path: fret.LoadPath) -> dict[str, Number]:
    """Energy, wear, life and range of K of the last cycle, with their errors."""
    run = fret.solve(scene(path), progress=False, save="all", error=True)
    loops = run.loops().isel(cycle=-1)
    worn = fret.wear.solve(scene(path), cycles=2e3, jumps=2, body2=LAW, progress=False)
    life = run.life("Ti-6Al-4V", "smith_watson_topper", y=0.0).range
    crack = run.crack(-A, lengths=[0.2 * A])
    error = loops.get("dissipated_error")
    return {
        "energy": (float(loops.dissipated), math.nan if error is None else float(error)),
        "volume": (
            float(worn.dataset.volume2[-1]),
            float(worn.dataset.volume2[-1]) * worn.error_of("volume"),
        ),
        "life": (life.best, life.best * (math.sqrt(life.stress.high / life.stress.low) - 1.0)),
        "dK": (float(crack.dK()[0]), float(crack.dK_error()[0])),
    }


def forms(history: History) -> Iterator[tuple[str, fret.LoadPath]]:
    """The forms of a history, with their names."""
    yield f"sine of {history.points}", history.sine()
    yield "function", history.function()
    yield "file", history.file()


def compare(history: History) -> Iterator[tuple[str, str, float, str]]:
    """Form, number, difference over the errors, and all in words; refused forms have no number."""
    truth = numbers(history.truth())
    about = (
        f"T {history.T / (MU * W):.2f} mu W, sigma_B {1e-6 * history.sigma_B:.0f} MPa, "
        f"phase {history.phase:.2f}, lag {history.lag:.2f}"
    )
    for form, path in forms(history):
        try:
            rows = numbers(path)
        except (ValueError, fret.errors.SolveError) as error:
            yield form, "", 0.0, f"{about}, {form}: refused, {error}"
            continue
        for name, (value, bar) in rows.items():
            right, bar_of_truth = truth[name]
            off = 0.0 if value == right else abs(value - right)
            allowed = math.hypot(bar, bar_of_truth)
            ratio = off / allowed if allowed > 0.0 else math.inf
            words = f"{name} {value:.5g} +- {bar:.2g}, {right:.5g} +- {bar_of_truth:.2g}"
            yield form, name, 0.0 if off == 0.0 else ratio, f"{about}, {form}: {words}"


def main(count: int) -> None:
    """Print the forms and the shares."""
    warnings.simplefilter("ignore")
    ratios: dict[str, list[float]] = defaultdict(list)
    for seed in range(count):
        for form, name, ratio, words in compare(drawn(seed)):
            print(f"{seed} {ratio:.2f} {words}", flush=True)
            if name:
                ratios[f"{name}, {form}"].append(ratio)
    for name, values in sorted(ratios.items()):
        every = np.array(values)
        print(
            f"{name}: {np.mean(every <= MOST):.0%} of {every.size} within {MOST} errors, "
            f"median {np.median(every):.2f}, most {every.max():.2f}"
        )


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 50)
