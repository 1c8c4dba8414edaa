"""The paper's runs: coated fretting for E1/E2 = 0.5, 1, 2, 4, its figures and a table.

S. Spinu, Numerical Study on the Influence of the Coating in the Fretting Contact, Tribology in
Industry 42 (2020) 131-145. The scene is ``scenes/coated_fretting.toml``: a steel sphere on coated
steel, indentation, then two and a half cycles of tangential force. For E1/E2 = 1 the coating is
kept in the computation although it makes no difference, as in the paper's validation.

    python examples/paper.py --out out
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path

import pyfret as fret

SCENE = Path(__file__).parents[1] / "scenes" / "coated_fretting.toml"
RATIOS = (0.5, 1.0, 2.0, 4.0)


def paper_scene(ratio: float, n: int | None = None) -> fret.Scene:
    """The paper's scene for one ratio E1/E2, its fields kept at every tenth of the history."""
    changes = {
        "title": f"coated fretting, E1/E2 = {ratio:g}",
        "body2.coatings[0].E.E_substrate": ratio,
        "skip.equal_layers": False,
    }
    if n is not None:
        changes["grid.n"] = n
    return fret.Scene.from_file(SCENE, changes=changes)


def one_jump(scene: fret.Scene) -> fret.Scene:
    """The indentation alone in one increment: what leaving out the load history costs."""
    path = fret.LoadPath.start().normal(scene.path.branches[0].W, increments=1)
    return scene.replace(path=path, title=f"{scene.title}, one increment")


def main() -> None:
    """Run everything and say what came out."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=Path("out"), help="folder of the results")
    parser.add_argument("--cells", type=int, help="cells along each side (default: the scene's)")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)

    started = time.perf_counter()
    results = {}
    for ratio in RATIOS:
        scene = paper_scene(ratio, options.cells)
        results[ratio] = fret.solve(scene, out=options.out / f"coated_{ratio:g}.zarr")
        print(results[ratio].summary(), end="\n\n")
    jump = fret.solve(one_jump(results[2.0].scene), out=options.out / "one_increment_2.zarr")
    print(f"runs: {time.perf_counter() - started:.0f} s")
    for figure in fret.plot.paper_figures(results, options.out, jump=jump):
        print(figure)


if __name__ == "__main__":
    main()
