"""The solution of a scene without start-up and files: coefficients and all increments."""

from __future__ import annotations

import argparse
import json
import time
from pathlib import Path

from measuring import WARM_UP, spin

import pyfret as fret


def main() -> None:
    """Print one line of JSON."""
    parser = argparse.ArgumentParser()
    parser.add_argument("scene", type=Path)
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--repetitions", type=int, default=10)
    options = parser.parse_args()
    scene = fret.Scene.from_toml(options.scene.read_text(), set=options.set)
    spin(WARM_UP)
    times = []
    for _ in range(options.repetitions):
        begun = time.perf_counter()
        increments = sum(1 for _ in fret._core.March(scene))
        times.append(time.perf_counter() - begun)
    print(json.dumps({"seconds": min(times), "increments": increments}))


if __name__ == "__main__":
    main()
