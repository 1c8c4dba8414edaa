"""Processor time of wear with oxygen and a bed over the time without: McColl's scar, a ball.

``python benches/third_body.py`` prints the ratios. Both runs of a pair make equal jumps of a number
that is given, so that they do the same work beside the third body.
"""

from __future__ import annotations

import time
import warnings
from typing import Any

import pyfret as fret

STEEL = fret.Elastic(E=200e9, nu=0.3)
#: Largest ratio of processor times.
MOST = 1.3
#: Each run is timed so often, and the least time counts.
REPEATS = 3


def mccoll() -> tuple[fret.Scene, dict[str, Any]]:
    """R. McColl, J. Ding, S. B. Leen, Wear 256 (2004) 1114-1127, as scenes/wear_mccoll.toml."""
    path = fret.LoadPath.start().normal(18.5e3, increments=1)
    for to, increments in ((25e-6, 1), (-25e-6, 10), (25e-6, 10)):
        path = path.displace(delta_x=to, increments=increments)
    scene = fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Cylinder(R=6e-3)),
        body2=fret.Body(STEEL),
        friction=0.9,
        grid=fret.Grid.strip(extent=0.72e-3, n=640),
        path=path,
    )
    laws = {"body1": fret.wear.Archard(1.9e-14), "body2": fret.wear.Archard(2.9e-14)}
    settings = {"cycles": 18000, "first_branch": 2, "cycling": "sliding", "jumps": 24}
    return scene, settings | laws


def ball() -> tuple[fret.Scene, dict[str, Any]]:
    """A ball in gross slip on 128 x 128 cells."""
    path = fret.LoadPath.start().normal(50.0, increments=1)
    for to in (25e-6, -25e-6, 25e-6):
        path = path.displace(delta_x=to, increments=4)
    scene = fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Sphere(R=10e-3)),
        body2=fret.Body(STEEL),
        friction=0.6,
        grid=fret.Grid.centred(width=8e-4, n=128),
        path=path,
    )
    law = fret.wear.Archard(1e-14)
    return scene, {"cycles": 5000, "cycling": "sliding", "jumps": 6, "body1": law, "body2": law}


def seconds(scene: fret.Scene, settings: dict[str, Any]) -> tuple[float, int]:
    """Return the least processor time of a run [s], and its number of jumps."""
    times = []
    for _ in range(REPEATS):
        start = time.process_time()
        worn = fret.wear.solve(scene, progress=False, **settings)
        times.append(time.process_time() - start)
    return min(times), worn.dataset.sizes["jump"]


def main() -> None:
    """Print the times and their ratio."""
    warnings.simplefilter("ignore", fret.errors.SceneWarning)
    air = fret.wear.Air(distance=2e-4, power_density=1e5, power_exponent=0.5)
    for name, (scene, settings) in {"McColl": mccoll(), "ball": ball()}.items():
        bed = fret.wear.DebrisBed(kappa=1e-2)
        plain, jumps = seconds(scene, settings)
        third_body = {"air": air, "bed": bed, "frequency": 20.0}
        with_it, more_jumps = seconds(scene, {**settings, **third_body})
        ratio = with_it / plain
        print(
            f"{name}: {plain:.2f} s in {jumps} jumps, with oxygen and bed {with_it:.2f} s in "
            f"{more_jumps} jumps, ratio {ratio:.2f} (at most {MOST})",
            flush=True,
        )


if __name__ == "__main__":
    main()
