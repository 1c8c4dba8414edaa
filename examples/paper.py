"""The paper's runs: coated fretting for E1/E2 = 0.5, 1, 2, 4, its figures and a table.

S. Spinu, Numerical Study on the Influence of the Coating in the Fretting Contact, Tribology in
Industry 42 (2020) 131-145. The scene is ``scenes/coated_fretting.toml``: a steel sphere on coated
steel, indentation, then two and a half cycles of tangential force. For E1/E2 = 1 the coating is
kept in the computation although it makes no difference, as in the paper's validation.

    python examples/paper.py --out out
"""

from __future__ import annotations

import argparse
import multiprocessing
import os
import shutil
import time
import warnings
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import matplotlib.pyplot as plt

import pyfret as fret

SCENE = Path(__file__).parents[1] / "scenes" / "coated_fretting.toml"
RATIOS = (0.5, 1.0, 2.0, 4.0)


def paper_scene(ratio: float, *, cells: int | None = None) -> fret.Scene:
    """The paper's scene for one ratio E1/E2, its fields kept at every tenth of the history."""
    settings = [
        f'title="Coated fretting, E1/E2 = {ratio:g}"',
        f"body2.coatings.0.E.E_substrate={ratio}",
        "skip.equal_layers=false",
    ]
    if cells is not None:
        settings.append(f"grid.n={cells}")
    scene = fret.Scene.from_file(SCENE, set=settings)
    tenths = [i for i, t in enumerate(scene.path.t, start=1) if abs(10 * t - round(10 * t)) < 1e-9]
    return scene.replace(save=tenths)


def one_jump(scene: fret.Scene) -> fret.Scene:
    """The indentation alone in one increment that leaves out the load history within it."""
    path = fret.LoadPath.start().normal(float(scene.path.W.max()), increments=1)
    alone = scene.replace(path=path, save="all", title=f"{scene.title}, one increment")
    settings = alone.settings.replace(cell_entry_correction=False, slip_rotation_correction=False)
    return alone.replace(settings=settings)


def front_page(results: dict[float, fret.Result], file: Path) -> None:
    """The README's figure: loops of all ratios, and stick and shear for E1/E2 = 2."""
    with fret.plot.style():
        figure, (loops, zones, shear) = plt.subplots(1, 3, figsize=(10.2, 3.6))
        for ratio, result in results.items():
            colour = fret.plot.paper.RATIO_COLOURS.get(ratio)
            fret.plot.fretting_loop(result, ax=loops, label=f"$E_1/E_2 = {ratio:g}$", color=colour)
        loops.legend()
        loops.set_box_aspect(1.0)
        fret.plot.stick_slip(results[2.0].at(1.0), ax=zones)
        fret.plot.shear_streamlines(results[2.0].at(0.9), ax=shear)
        # Above the legends of the maps.
        for ax, title in (
            (loops, "(a) fretting loops"),
            (zones, r"(b) $E_1/E_2 = 2$, $t = \tau$"),
            (shear, r"(c) shear, $E_1/E_2 = 2$, $t = 0.9\,\tau$"),
        ):
            ax.set_title(title, pad=18)
        figure.savefig(file, dpi=120)
        plt.close(figure)


def solve(scene: fret.Scene, out: Path) -> str:
    """Run a scene into the store `out`, whose last contents give way; its summary."""
    if out.exists():
        shutil.rmtree(out)
    return fret.solve(scene, out=out, progress=False).summary()


def begin(threads: int) -> None:
    """Begin a process that solves: its threads, and doubts in the summaries alone."""
    os.environ["RAYON_NUM_THREADS"] = str(threads)
    warnings.simplefilter("ignore", fret.errors.SceneWarning)


def solve_all(scenes: dict[Path, fret.Scene]) -> dict[Path, fret.Result]:
    """Run scenes into stores, one for each processor at a time."""
    processors = os.cpu_count() or 1
    workers = min(len(scenes), processors)
    with ProcessPoolExecutor(
        workers,
        mp_context=multiprocessing.get_context("spawn"),
        initializer=begin,
        initargs=(processors // workers,),
    ) as pool:
        for summary in pool.map(solve, scenes.values(), scenes):
            print(summary, end="\n\n", flush=True)
    return {out: fret.open(out) for out in scenes}


def main() -> None:
    """Run everything and say what came out."""
    parser = argparse.ArgumentParser(description="The paper's runs and figures.")
    parser.add_argument("--out", type=Path, default=Path("out"), help="folder of the results")
    parser.add_argument("--cells", type=int, help="cells along each side (default: the scene's)")
    options = parser.parse_args()
    out: Path = options.out
    out.mkdir(parents=True, exist_ok=True)

    started = time.perf_counter()
    of_ratio = {ratio: out / f"coated_{ratio:g}.zarr" for ratio in RATIOS}
    scenes = {of_ratio[r]: paper_scene(r, cells=options.cells) for r in RATIOS}
    alone = out / "one_increment_2.zarr"
    solved = solve_all({**scenes, alone: one_jump(scenes[of_ratio[2.0]])})
    results = {ratio: solved[store] for ratio, store in of_ratio.items()}
    jump = solved[alone]
    print(f"runs: {time.perf_counter() - started:.0f} s")
    front_page(results, out / "front_page.png")
    for figure in fret.plot.paper_figures(results, out, jump=jump):
        print(figure)


if __name__ == "__main__":
    main()
