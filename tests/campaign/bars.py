"""Error bars of what follows from a run, beside the same scene on three times the cells.

    python tests/campaign/bars.py FIRST COUNT

Scenes are balls, ellipsoids and cylinders, bare or coated, sheared in partial slip, half of them
under a bulk stress in phase. Each line is a scene; the last ones are the ratios of the true error
to the error bar by number, and the numbers whose ratio is beyond 1.5.
"""

from __future__ import annotations

import math
import sys
import warnings
from collections import defaultdict
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

import pyfret as fret
from pyfret import fatigue, shapes

if TYPE_CHECKING:
    from pyfret.fatigue.criteria import CriterionName

#: Cells across the grid of a point contact (a line contact has twice as many), and how many times
#: as many the truth has.
CELLS, FINER = 40, 3
#: Largest ratio of a true error to its bar.
MOST = 1.5
#: Range of K below which a crack counts as shut [Pa m^0.5].
SHUT = 1e4
OF_BRANCHES = ("contact_radius", "stick_ratio", "p_max", "delta_z", "delta_x", "dissipated")
CRITERIA: tuple[CriterionName, ...] = (
    "crossland",
    "dang_van",
    "findley",
    "smith_watson_topper",
)

#: A number: what it is, its value, its error.
Number = tuple[str, float, float]


def drawn(seed: int, n: int) -> tuple[fret.Scene, fatigue.Material]:
    """A contact on n cells across, and the material of the body that is judged."""
    rng = np.random.default_rng([seed, 58])
    names = ["steel_42CrMo4", "titanium_6Al4V", "aluminium_7075_T6"]
    material = fatigue.Materials()[str(rng.choice(names))]
    flat = fret.Elastic(E=material.number("E"), nu=material.number("nu"))
    counter = fret.Elastic(E=flat.E * float(rng.choice([1.0, 0.6, 1.8])), nu=0.3)
    kind = str(rng.choice(["ball", "ellipsoid", "cylinder"]))
    mu, part = float(rng.uniform(0.25, 0.8)), float(rng.uniform(0.3, 0.9))
    p_H = float(rng.uniform(2e8, 8e8))
    ratio = float(rng.uniform(1.2, 2.0)) ** 0.5 if kind == "ellipsoid" else 1.0
    R = float(rng.uniform(5e-3, 5e-2))
    E_star = 1.0 / ((1 - flat.nu**2) / flat.E + (1 - counter.nu**2) / counter.E)
    if kind == "cylinder":
        a = 2.0 * p_H * R / E_star
        W = 0.5 * math.pi * a * p_H
        shape: shapes.Cylinder | shapes.Ellipsoid = shapes.Cylinder(R=R)
        grid = fret.Grid.strip(extent=3.0 * a, n=2 * n)
    else:
        W = (math.pi * p_H) ** 3 * R**2 / (6.0 * E_star**2)
        whole = fret.reference.hertz_ellipse(R_x=R * ratio, R_y=R / ratio, E_star=E_star, W=W)
        a = min(whole.a_x, whole.a_y)
        shape = shapes.Ellipsoid(R_x=R * ratio, R_y=R / ratio)
        grid = fret.Grid.centred(width=2.7 * max(whole.a_x, whole.a_y), n=n)
    coatings = []
    if rng.random() < 0.5:
        coating = fret.Elastic(E=flat.E * 2 ** float(rng.uniform(-1, 1.3)), nu=0.3)
        coatings.append(fret.Coating(coating, thickness=a * float(rng.uniform(0.12, 0.6))))
    sigma = float(rng.uniform(0.1, 0.3)) * p_H if rng.random() < 0.5 else 0.0
    path = fret.LoadPath.start().normal(W)
    for sign in (1.0, -1.0, 1.0):
        path = path.force(T_x=sign * part * mu * W, sigma_B=sign * sigma)
    scene = fret.Scene(
        body1=fret.Body(counter, shape=shape),
        body2=fret.Body(flat, coatings=coatings),
        friction=mu,
        grid=grid,
        path=path,
    )
    return scene, material


def numbers(scene: fret.Scene, material: fatigue.Material) -> Iterator[Number]:
    """Yield the numbers that a user reads of a scene."""
    result = fret.solve(scene, progress=False, save="all", error=True)
    bars = result.error_bars().sel(part="total")
    for branch, row in result.branches().groupby("branch"):
        for name in (name for name in OF_BRANCHES if name in bars):
            yield f"{name} {branch}", row[name].item(), float(bars[name].sel(branch=branch))
    loops = result.loops()
    for name in ("stiffness", "sliding_ratio"):
        yield name, float(loops[name][-1]), float(loops[f"{name}_error"][-1])
    below = result.at(-1).stress()
    for measure in ("s_1", "von_mises", "s_xx"):
        worst = below.maximum(measure)
        yield f"largest {measure}", worst.value, worst.error
    factors = result.load_factors(900e6)
    for rule in ("von_mises", "tresca", "shakedown"):
        least = factors.least(rule)
        yield f"factor {rule}", least.value, least.error
    substrate = len(scene.body2.coatings)
    for criterion in CRITERIA:
        life = result.life([material] * (substrate + 1), criterion)
        of_substrate = life.worst_of(substrate)
        yield f"value {criterion}", of_substrate.value, of_substrate.error
    # A length that the cells have no part in.
    length = 0.05 * scene.grid.nx * scene.grid.dx
    crack = result.crack(lengths=[length])
    dK = float(crack.dK().max())
    if dK > SHUT:
        yield "dK", dK, float(2.0 * crack.dataset.error.max())


def ratios(seed: int) -> Iterator[tuple[str, float, str]]:
    """Yield name, true error over error bar, and both as text, for each number of a scene."""
    coarse, fine = ({n[0]: n for n in numbers(*drawn(seed, c))} for c in (CELLS, FINER * CELLS))
    for name, value, bar in coarse.values():
        if name not in fine or not math.isfinite(value) or not bar > 0.0:
            continue
        right = fine[name][1]
        words = f"{seed} {name}: {value:.5g} +- {bar:.2g}, {right:.5g} on {FINER} times the cells"
        yield (
            name.rstrip("0123456789 ") if name[-2] == " " else name,
            abs(value - right) / bar,
            words,
        )


def main(first: int, count: int) -> None:
    """Print the ratios of scenes, and what lies beyond the most."""
    warnings.simplefilter("ignore")
    by_name: dict[str, list[float]] = defaultdict(list)
    beyond: list[str] = []
    for seed in range(first, first + count):
        computed = list(ratios(seed))
        for name, ratio, words in computed:
            by_name[name].append(ratio)
            if ratio > MOST:
                beyond.append(words)
        print(
            f"{seed}: {len(computed)} numbers, {sum(r > MOST for _, r, _ in computed)} beyond",
            flush=True,
        )
    print(*beyond, sep="\n")
    for name, of_name in by_name.items():
        all_of = np.array(of_name)
        print(
            f"{name:26s} of {all_of.size:4d}: {np.sum(all_of <= MOST):4d} at most {MOST}, "
            f"middle {np.median(all_of):.2f}, most {all_of.max():.2f}"
        )
    together = np.concatenate([np.array(r) for r in by_name.values()])
    print(f"{'all numbers':26s} of {together.size:4d}: {np.mean(together <= MOST):.1%}")


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]))
