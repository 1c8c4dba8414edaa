"""Indentation and one increment of shear by pyfret: time and memory of grids of any size."""

from __future__ import annotations

import argparse
import json
import time

import hertz
from measuring import WARM_UP, peak_memory, spin

import pyfret as fret

MU = 0.3


def main() -> None:
    """Print one line of JSON."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--cells", type=int, required=True)
    options = parser.parse_args()
    steel = fret.Elastic(E=hertz.E, nu=hertz.NU)
    path = fret.LoadPath.start().normal(hertz.W, increments=1)
    scene = fret.Scene(
        body1=fret.Body(steel, shape=fret.Sphere(R=hertz.R)),
        body2=fret.Body(steel),
        friction=MU,
        grid=fret.Grid.centred(width=hertz.SHAPES["hertz"].width, n=options.cells),
        path=path.tangential([0.5 * MU * hertz.W], increments=1),
    )
    spin(WARM_UP)
    line = {"cells": options.cells, "memory_empty": peak_memory()}
    begun = time.perf_counter()
    march = fret._core.March(scene)
    for stage in ("set_up", "normal", "frictional"):
        if stage != "set_up":
            next(march)
        line[f"{stage}_s"] = time.perf_counter() - begun
        line[f"{stage}_memory"] = peak_memory()
        begun = time.perf_counter()
    print(json.dumps(line))


if __name__ == "__main__":
    main()
