"""Stress below the paper's contact: figure 13, along depth, over the load path, running conditions.

    python examples/stress.py --out out

The increments are placed better than the paper's, so that few of them do. The fields are those of
256 x 256 cells and 256 depths unless ``--cells`` says less.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
import numpy as np

import pyfret as fret

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SCENE = Path(__file__).parents[1] / "scenes" / "coated_fretting.toml"
RATIOS = (0.5, 2.0, 4.0)


def few_increments(ratio: float, cells: int) -> fret.Scene:
    """The paper's scene with increments of equal radius, then ten per unit of T/(mu W)."""
    scene = fret.Scene.from_file(
        SCENE,
        set=[
            f'title="Coated fretting, E1/E2 = {ratio:g}"',
            f"body2.coatings.0.E.E_substrate={ratio}",
            f"grid.n={cells}",
        ],
    )
    first, *others = scene.path.branches
    path = fret.LoadPath.start().force(
        W=first.W, increments=30, spacing=fret.Spacing.EQUAL_RADIUS, t=first.t
    )
    for n, branch in enumerate(others):
        path = path.force(T_x=branch.T_x, increments=9 if n == 0 else 18, t=branch.t)
    return scene.replace(path=path)


def running_maps(scene: fret.Scene) -> Figure:
    """Running conditions over W and T, and over W and the shift."""
    W = np.linspace(200.0, 1000.0, 9)
    hertz = scene.hertz
    assert hertz is not None
    bodies = (scene.body1.substrate, scene.body2.substrate)
    uncoated = fret.reference.CattaneoMindlin(hertz, bodies=bodies, mu=scene.mu)
    T, delta = uncoated.T_limit, uncoated.shift_limit
    maps = (
        fret.study.running_conditions(scene, W=W, T=np.linspace(0.1, 1.2, 12) * T),
        fret.study.running_conditions(scene, W=W, delta=np.linspace(0.2, 2.0, 10) * delta),
    )
    figure, row = plt.subplots(1, 2, figsize=(9.0, 3.6), layout="constrained")
    for ax, table in zip(row, maps, strict=True):
        fret.plot.running_map(table, ax=ax)
    return figure


def main() -> None:
    """Solve, and draw every figure."""
    parser = argparse.ArgumentParser(description="Stress below the paper's contact.")
    parser.add_argument("--out", type=Path, default=Path("out"), help="folder of the figures")
    parser.add_argument("--cells", type=int, default=256, help="cells along each side")
    options = parser.parse_args()
    out: Path = options.out
    out.mkdir(parents=True, exist_ok=True)
    scenes = {ratio: few_increments(ratio, options.cells) for ratio in RATIOS}
    results = {ratio: fret.solve(scene) for ratio, scene in scenes.items()}
    a_H, p_H = results[2.0].a_H, results[2.0].p_H
    # With the interface, which is at a_H.
    z = np.union1d(np.linspace(0.0, 2.0, options.cells), 1.0) * a_H

    for ratio, result in results.items():
        below = result.at(-1).stress(z, y=0.0)
        largest = below.maximum()
        print(
            f"E1/E2 = {ratio:g}: largest von Mises stress {largest.value / p_H:.4f} p_H at "
            f"x = {largest.x / a_H:.3f}, z = {largest.z / a_H:.3f} a_H, "
            f"layer {largest.layer}; on the surface "
            f"{float(below.von_mises[0].max()) / p_H:.4f} p_H"
        )
    # Every increment of E1/E2 = 2, none of which is kept.
    every = fret.subsurface.envelope(scenes[2.0], fret.march(scenes[2.0]), z, y=0.0)

    with fret.plot.style():
        figures: dict[str, Figure] = {
            "figure_13": fret.plot.stress_maps(results),
            "stress_envelope": fret.plot.envelope_maps(every, a_H=a_H, p_H=p_H),
            "running_maps": running_maps(few_increments(2.0, 64)),
        }
        figures["stress_along_depth"], ax = plt.subplots()
        axis = results[2.0].at(-1).stress(z, x=0.0, y=0.0)
        fret.plot.stress_along_depth(axis, a_H=a_H, p_H=p_H, ax=ax)
        figures["stress_history"], ax = plt.subplots()
        fret.plot.stress_history(every, a_H=a_H, p_H=p_H, ax=ax)
        figures["loop_evolution"], ax = plt.subplots()
        fret.plot.loop_evolution(results[2.0], ax=ax)
        for name, figure in figures.items():
            figure.savefig(out / f"{name}.png")
            print(out / f"{name}.png")


if __name__ == "__main__":
    main()
