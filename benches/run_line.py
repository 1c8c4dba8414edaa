"""The coated line contact of `make bench-fe` by pyfret, alone in its process: time and memory.

::

    python benches/run_line.py --ratio 2 --cells 128 --press auto --branch auto --repeat 5
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from pathlib import Path
from statistics import median

import numpy as np
from measuring import peak_memory

sys.path.insert(0, str(Path(__file__).parent.parent))

from validation.coated_line import line, tractions

import pyfret as fret


def main() -> None:
    """Solve, and print the median of the processor times, the memory and the tractions."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--ratio", type=float, required=True)
    parser.add_argument("--cells", type=int, required=True)
    parser.add_argument("--press", default="auto")
    parser.add_argument("--branch", default="auto")
    parser.add_argument("--repeat", type=int, default=5)
    options = parser.parse_args()
    press = options.press if options.press == "auto" else int(options.press)
    branch = None if options.branch == "auto" else int(options.branch)
    empty = peak_memory()
    times = []
    for _ in range(options.repeat):
        # A scene of its own each time: the kernels are computed again.
        scene = line(options.ratio, options.cells, press, branch)
        begun = time.process_time()
        result = fret.solve(scene, progress=False)
        times.append(time.process_time() - begun)
    row = {"ratio": options.ratio, "cells": options.cells, "press": press, "branch": branch}
    row |= {"seconds": median(times), "first": times[0], "memory": peak_memory() - empty}
    row["increments"] = int(result.dataset.sizes["increment"])
    if press != "auto":
        known = fret.solve(scene, progress=False, error=True)
        row["q_error"] = 1e-6 * float(known.error_bars().q_max.sel(part="total")[0])
    steps = [
        {key: np.round(values, 9).tolist() for key, values in zip("xpq", step, strict=True)}
        for step in tractions(result)
    ]
    print(json.dumps(row | {"steps": steps}))


if __name__ == "__main__":
    main()
