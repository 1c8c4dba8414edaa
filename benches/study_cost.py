"""Processor time of a study with a stress measure, over the time of its solutions alone.

    python benches/study_cost.py [CELLS]

18 coated contacts of a ball under two cycles of a shift, 64 cells along a side by default. Each is
solved alone, then all as a study with `interface_shear`. RAYON_NUM_THREADS=1 gives steady numbers.
"""

from __future__ import annotations

import sys
import time
import warnings
from concurrent.futures import ThreadPoolExecutor

import pyfret as fret

STEEL, TITANIUM = fret.Elastic(E=210e9, nu=0.3), fret.Elastic(E=117e9, nu=0.31)
R, W, MU = 8e-3, 60.0, 0.6
#: Thickness [m] and modulus [Pa] of the film: 6 x 3 points.
PARAMETERS = {
    "body2.coatings.0.thickness": [4e-6, 8e-6, 12e-6, 20e-6, 30e-6, 50e-6],
    "body2.coatings.0.E": [2e11, 3e11, 4.5e11],
}


def contact(cells: int) -> fret.Scene:
    """Make the contact whose film is varied."""
    a = fret.reference.hertz(R=R, bodies=(STEEL, TITANIUM), W=W).a
    film = fret.Coating(fret.Elastic(E=450e9, nu=0.25), thickness=8e-6)
    return fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Sphere(R=R)),
        body2=fret.Body(TITANIUM, coatings=[film]),
        friction=MU,
        grid=fret.Grid.centred(width=2.4 * a, n=cells),
        path=fret.LoadPath.start().normal(W).cycles(2, delta_x=3e-6),
    )


def main(cells: int) -> None:
    """Print the times and their ratio."""
    warnings.simplefilter("ignore")
    scene = contact(cells)
    names = list(PARAMETERS)
    points = [
        scene.replace(dict(zip(names, (thickness, E), strict=True)))
        for thickness in PARAMETERS[names[0]]
        for E in PARAMETERS[names[1]]
    ]
    fret.solve(scene, progress=False)
    started = time.process_time()
    for point in points:
        fret.solve(point, progress=False)
    alone = time.process_time() - started
    started = time.process_time()
    study = fret.study.run(
        scene,
        PARAMETERS,
        measure="interface_shear",
        executor=ThreadPoolExecutor(1),
        progress=False,
    )
    whole = time.process_time() - started
    print(f"{study!r}")
    print(f"{len(points)} solutions {alone:.1f} s, study {whole:.1f} s: {whole / alone:.2f} times")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 64)
