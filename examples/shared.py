"""What the figures of loads.py and balances.py share: the contact, and the command line."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import pyfret as fret

#: Radius of the sphere [m], largest normal force [N], friction coefficient.
R, W, MU = 0.018, 1e3, 0.3
STEEL = fret.Elastic(E=210e9, nu=0.3)

Array = NDArray[np.float64]
#: By name: what draws a figure into a file and says what came out, and its cells along a side.
Figures = dict[str, tuple[Callable[[Path, int], str], int]]


def solved(scene: fret.Scene) -> fret.Result:
    """The scene's result, without a progress bar."""
    return fret.solve(scene, progress=False)


def draw(figures: Figures, *, prefix: str, description: str) -> None:
    """Draw the figures asked for and say what came out."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--out", type=Path, default=Path("out"), help="folder of the figures")
    parser.add_argument("--only", choices=list(figures), help="one of the figures")
    parser.add_argument("--cells", type=int, help="cells along a side (default: the figure's own)")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    for name, (figure, n) in figures.items():
        if options.only in (None, name):
            print(f"{name}: {figure(options.out / f'{prefix}_{name}.png', options.cells or n)}")
