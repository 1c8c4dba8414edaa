"""Random runs of wear with oxygen, debris, layers and their friction: mass, ends, error bars.

``python tests/campaign/third_body.py 0 100`` goes through the runs of these seeds. A run must end,
keep its mass to 1e-9 in every jump, and have a finite depth. A run on twice as many cells with a
fifth of the tolerance has the depth to compare with. The difference over the error bar is printed.
"""

from __future__ import annotations

import random
import sys
import time
import warnings
from dataclasses import dataclass
from typing import Any

import numpy as np

import pyfret as fret

TOLERANCE, CELLS = 0.02, 64
#: Times the error bar that a difference may be, and the part of the runs for which it must be less.
FACTOR, PART = 1.5, 0.95
#: Processor time after which a run counts as hanging [s].
LONGEST = 120.0


@dataclass(frozen=True)
class Drawn:
    """A contact that wears: a cylinder on a flat, with all options of the third body."""

    seed: int

    def scene(self, cells: int) -> tuple[fret.Scene, dict[str, Any]]:
        """Return the contact and the settings of its wear."""
        rng = random.Random(self.seed)

        def log_uniform(low: float, high: float) -> float:
            return float(np.exp(rng.uniform(np.log(low), np.log(high))))

        R, E, mu = log_uniform(5e-3, 80e-3), log_uniform(7e10, 3e11), rng.uniform(0.1, 0.9)
        material = fret.Elastic(E=E, nu=0.3)
        p_H = log_uniform(1e8, 8e8)
        star = E / (2 * (1 - 0.3**2))
        a = 2 * p_H * R / star
        W = 0.5 * np.pi * a * p_H
        slip = a * log_uniform(0.1, 1.0)
        cycles = log_uniform(1e2, 1e5)
        # The depth that all energy would wear off a contact of the first width, over a^2/2R.
        depth = log_uniform(0.3, 10.0) * a**2 / (2 * R)
        alpha = depth / (4 * mu * W * slip * cycles / (2 * a))
        starved = alpha * rng.choice([0.1, 0.3, 1.0])
        law = fret.wear.DissipatedEnergy(alpha, starved=starved)
        settings: dict[str, Any] = {"cycles": cycles, "body1": law, "share1": rng.random()}
        settings |= {"body2": law, "worn_through": "go_on", "cycling": "sliding"}
        frequency = settings["frequency"] = log_uniform(0.1, 50.0)
        # Without debris the scar grows as the cube root of the area.
        area = alpha * 4 * mu * W * slip * cycles * (1 + settings["share1"])
        half_width = max(1.3 * a, (1.5 * R * area) ** (1 / 3)) + 2 * slip
        if rng.random() < 0.8:
            distance = a * log_uniform(0.1, 3.0)
            power = 4 * mu * W * slip * frequency / (2 * a)
            if rng.random() < 0.5:
                settings["air"] = fret.wear.Air(
                    distance, power_density=power, power_exponent=rng.uniform(0.0, 1.0)
                )
            else:
                settings["air"] = fret.wear.Air(
                    distance,
                    pressure=p_H,
                    pressure_exponent=rng.uniform(0.0, 1.0),
                    frequency=frequency,
                    frequency_exponent=rng.uniform(0.0, 1.0),
                )
        if rng.random() < 0.8:
            # Debris crosses the contact in a part of the run, or in many of them.
            kappa = log_uniform(0.01, 100.0) * a**2 / (cycles * slip**2)
            settings["bed"] = fret.wear.DebrisBed(
                kappa=kappa,
                volume_ratio=rng.choice([1.0, 1.0, 1.5]),
                starved_yield=rng.choice([1.0, 0.5]),
                protecting_thickness=rng.choice([None, None, depth]),
            )
        friction: dict[str, Any] = {}
        coatings = []
        if rng.random() < 0.4:
            thickness = depth * rng.uniform(0.2, 2.0)
            coatings = [fret.Coating(material, thickness=thickness)]
            friction["layers"] = [mu, mu * rng.uniform(1.0, 3.0)]
            film = fret.wear.DissipatedEnergy(alpha * log_uniform(0.1, 1.0))
            settings["body2"] = [film, law]
        if "air" in settings and rng.random() < 0.5:
            friction["starved"] = mu * rng.uniform(0.7, 1.5)
        if "bed" in settings and rng.random() < 0.5:
            friction["bed"] = (mu * rng.uniform(0.7, 1.5), depth * rng.uniform(0.1, 1.0))
        path = fret.LoadPath.start().normal(W)
        for to in (slip, -slip, slip):
            path = path.displace(delta_x=to)
        scene = fret.Scene(
            body1=fret.Body(material, shape=fret.Cylinder(R=R)),
            body2=fret.Body(material, coatings=coatings),
            friction=fret.Friction(**({"mu": mu} | friction)),
            grid=fret.Grid.strip(extent=2.5 * half_width, n=cells),
            path=path,
        )
        return scene, settings

    def run(self, cells: int, tolerance: float) -> fret.wear.WearResult:
        """Wear the contact."""
        scene, settings = self.scene(cells)
        return fret.wear.solve(scene, progress=False, tolerance=tolerance, **settings)


def mass_error(worn: fret.wear.WearResult) -> float:
    """Return the largest part of the worn volume that neither lies in the bed nor has left."""
    if "bed" not in worn.table:
        return 0.0
    volume = worn.table["bed"].get("volume_ratio", 1.0) * (worn.volume1 + worn.volume2)
    return float(abs((worn.debris + worn.ejected) / volume - 1.0).max())


def deepest(worn: fret.wear.WearResult) -> float:
    """Return the deepest depth of both bodies [m]."""
    return max(float(worn.depth1[-1]), float(worn.depth2[-1]))


def audit(seed: int, *, fine: bool = True) -> tuple[list[str], float]:
    """Return the faults of a run, and the error of its depth over its error bar."""
    drawn = Drawn(seed)
    start = time.process_time()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", fret.errors.SceneWarning)
        worn = drawn.run(CELLS, TOLERANCE)
        spent = time.process_time() - start
        faults = [f"takes {spent:.0f} s"] if spent > LONGEST else []
        if not mass_error(worn) <= 1e-9:
            faults.append(f"loses {mass_error(worn):.1e} of its mass")
        depth = deepest(worn)
        if not (np.isfinite(depth) and depth > 0.0):
            faults.append(f"is {depth} m deep")
        if not fine:
            return faults, 0.0
        finer = deepest(drawn.run(2 * CELLS, TOLERANCE / 5))
    ratio = abs(depth - finer) / (worn.error_of("depth") * depth)
    return faults, ratio


def main(first: int, last: int) -> int:
    """Audit the runs of these seeds; return the number of faults."""
    ratios, count = [], 0
    for seed in range(first, last):
        try:
            faults, ratio = audit(seed)
        except fret.errors.PyfretError as error:
            faults, ratio = [f"fails: {error}"[:300]], np.inf
        ratios.append(ratio)
        count += len(faults)
        print(seed, f"{ratio:.2f}", *faults, flush=True)
    covered = float(np.mean(np.array(ratios) <= FACTOR))
    print(f"{covered:.0%} of {len(ratios)} depths within {FACTOR} error bars, {count} faults")
    return count + int(covered < PART)


if __name__ == "__main__":
    sys.exit(min(main(int(sys.argv[1]), int(sys.argv[2])), 100))
