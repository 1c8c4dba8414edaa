"""Evaluations of a contact of the campaign: heat, cracks, wear with debris, an own law.

Everything is computed for every result; a number is finite, or the call is refused for a reason.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

import pyfret as fret

#: Refusals that are about what was asked for.
REFUSED = (ValueError, TypeError, fret.errors.NoConvergenceError, fret.errors.SlidingError)


def conductor(rng: random.Random) -> fret.heat.Conductor:
    """A material that conducts heat."""
    return fret.heat.Conductor(
        conductivity=10 ** rng.uniform(0.0, 2.5), heat_capacity=10 ** rng.uniform(6.0, 6.7)
    )


def warm(result: fret.Result, rng: random.Random) -> Any:
    """The temperature of the last cycle."""
    heat = result.temperature(
        conductor(rng), conductor(rng), frequency=10 ** rng.uniform(0.0, 3.0), harmonics=4
    )
    return [heat.largest.values, heat.attrs["maximum"]]


def cracked(result: fret.Result, rng: random.Random) -> Any:
    """Stress intensity of cracks, straight or with a kink, with friction of their faces."""
    lengths = 10 ** rng.uniform(-6.0, -4.5) * np.array([1.0, 2.0, 4.0])
    kink = (float(0.4 * lengths[0]), rng.uniform(-0.8, 0.8)) if rng.random() < 0.5 else None
    computed = result.crack(
        0.0,
        lengths=lengths,
        angle=rng.uniform(-0.9, 0.9),
        kink=kink,
        friction=rng.choice([0.0, 0.3, 0.6, 0.9]),
    )
    return [computed.dataset.K_I.values, computed.dataset.K_II.values]


def own_wear(
    pressure_times_slip: Any, slip_distance: Any, dissipated: Any, worn: Any, cycles: Any
) -> Any:
    """A law that falls with the depth and ends."""
    del slip_distance, dissipated, cycles
    return 1e-15 * pressure_times_slip * np.clip(1.0 - worn / 1e-7, 0.0, 1.0)


def worn(scene: fret.Scene, rng: random.Random) -> Any:
    """Solve the wear of a few cycles, with debris that stays."""
    law: Any = rng.choice([own_wear, fret.wear.Archard(1e-15), fret.wear.DissipatedEnergy(1e-15)])
    computed = fret.wear.solve(
        scene,
        cycles=10 ** rng.uniform(1.0, 4.0),
        body2=law,
        debris_kept=rng.choice([0.0, 0.3, 0.9]),
        jumps=2,
        worn_through="go_on",
        progress=False,
    )
    return [computed.dataset.worn2.values]


FOLLOWS: dict[str, Callable[[Any, random.Random], Any]] = {
    "heat": warm,
    "crack": cracked,
    "wear": worn,
}


def own_friction(scene: fret.Scene, rng: random.Random) -> fret.Scene:
    """The scene with a law of friction of its own, where it has one coefficient alone."""
    item = scene.friction
    if item.map or item.history or item.kinetic or item.mu_y or not 0.0 < item.mu < 10.0:
        return scene
    mu, fall = item.mu, rng.uniform(0.0, 0.5)

    def law(x: Any, y: Any, p: Any, slip: Any, dissipated: Any) -> Any:
        del x, y, slip, dissipated
        return mu * (1.0 - fall * p / (p.max() + 1.0))

    return scene.replace(friction=fret.Friction(mu, law=law))


def follows(scene: fret.Scene, seed: int) -> Iterator[tuple[str, str]]:
    """Yield the name of each evaluation, with the reason if it was refused."""
    rng = random.Random(f"follows {seed}")
    if rng.random() < 0.3:
        scene = own_friction(scene, rng)
    try:
        W = float(fret.solve(scene, progress=False).dataset.W.max())
        amplitude = rng.uniform(0.1, 0.9) * min(scene.friction.mu, 1.0) * W
        path = fret.LoadPath.start().normal(W, increments=2).cycles(1, T_x=amplitude, increments=4)
        scene = scene.replace(path=path)
        result = fret.solve(scene, save="all", progress=False)
    except REFUSED as error:
        yield "cycle", reason(error)
        return
    yield "cycle", ""
    for name, follow in FOLLOWS.items():
        try:
            # A result has no functions of its scene.
            computed = follow(scene if follow is worn else result, rng)
        except REFUSED as error:
            yield name, reason(error)
        else:
            if not all(np.isfinite(values).all() for values in computed):
                raise ArithmeticError(f"{name}: not finite")
            yield name, ""


def reason(error: BaseException) -> str:
    """The reason of a refusal."""
    text = " ".join(str(error).split())
    if not text:
        raise ArithmeticError(f"{type(error).__name__} without a word")
    return text
