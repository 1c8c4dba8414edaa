"""Every number with an error of random line contacts, beside a grid of four times the cells.

    python tests/campaign/lines.py FIRST COUNT

Cylinders on flats: bare or coated, of like or unlike bodies, with a bulk stress in or out of phase
with the shear, or with a normal force that varies. 64 cells against 256. Each line is a scene. The
last lines are the ratios of the true error to the printed error by number, and the numbers whose
ratio is beyond 1.5.
"""

from __future__ import annotations

import math
import sys
import warnings
from collections import defaultdict
from collections.abc import Iterator

import numpy as np

import pyfret as fret

#: Cells of the strip, and how many times as many the truth has.
CELLS, FINER = 64, 4
#: Largest ratio of a true error to its bar.
MOST = 1.5
#: Numbers that vanish in plane strain.
VANISHING = ("M_x", "M_z", "delta_y", "phi_x", "phi_z")
#: Range of K below which a crack counts as shut [Pa m^0.5].
SHUT = 1e4

#: A number: its kind, what it is, its value, its error.
Number = tuple[str, str, float, float]


def drawn(seed: int, n: int) -> fret.Scene:
    """A contact on a strip of n cells."""
    rng = np.random.default_rng([seed, 82])
    E, nu = float(rng.uniform(7e10, 2.2e11)), float(rng.uniform(0.25, 0.35))
    flat = fret.Elastic(E=E, nu=nu)
    unlike = rng.random() < 0.5
    counter = fret.Elastic(E=E * float(rng.uniform(0.4, 3.0)), nu=0.28) if unlike else flat
    R, p0 = float(rng.uniform(5e-3, 5e-2)), float(rng.uniform(2e8, 8e8))
    mu, part = float(rng.uniform(0.25, 0.8)), float(rng.uniform(0.3, 0.9))
    modulus = 1.0 / ((1 - flat.nu**2) / flat.E + (1 - counter.nu**2) / counter.E)
    a = 2.0 * p0 * R / modulus
    W = 0.5 * math.pi * a * p0
    coatings = []
    if rng.random() < 0.5:
        coating = fret.Elastic(E=E * 2 ** float(rng.uniform(-1, 1.3)), nu=0.3)
        coatings.append(fret.Coating(coating, thickness=a * float(rng.uniform(0.12, 0.6))))
    load = str(rng.choice(["shear", "bulk", "bulk", "varying"]))
    phase = float(rng.choice([1.0, 0.0, -1.0]))
    sigma = float(rng.uniform(0.05, 0.3)) * p0
    share = float(rng.uniform(0.6, 0.9))
    width = float(rng.uniform(2.7, 3.3)) * a
    path = fret.LoadPath.start().normal(W)
    T = part * mu * W
    if load == "varying":
        for sign in (1.0, -1.0, 1.0, -1.0, 1.0):
            path = path.force(T_x=sign * T * share, W=W if sign > 0 else share * W)
    elif load == "bulk" and phase == 0.0:
        for sign in (1.0, -1.0, 1.0, -1.0):
            path = path.force(T_x=sign * T).force(sigma_B=sign * sigma)
        path = path.force(T_x=T)
    else:
        for sign in (1.0, -1.0, 1.0):
            bulk = {"sigma_B": sign * phase * sigma} if load == "bulk" else {}
            path = path.force(T_x=sign * T, **bulk)
    return fret.Scene(
        body1=fret.Body(counter, shape=fret.Cylinder(R=R)),
        body2=fret.Body(flat, coatings=coatings),
        friction=mu,
        grid=fret.Grid.strip(extent=width, n=n),
        path=path,
    )


def of_cracks(result: fret.Result, a: float) -> Iterator[Number]:
    """The range of K of cracks, where the mouth is not given and where it is."""
    for name, x in (("dK", None), ("dK at a", -a)):
        lengths = np.array([0.02, 0.1, 0.5]) * a
        crack = result.crack(x, lengths=lengths)
        for length, dK, error in zip((0.02, 0.1, 0.5), crack.dK(), crack.dK_error(), strict=True):
            if dK > SHUT:
                yield name, f"{length} a", float(dK), float(error)


def of_zones(result: fret.Result) -> Iterator[Number]:
    """The ends of the stick zone and of the contact."""
    for increment in [-1]:
        state = result.at(increment)
        for kind, zone in (("stick end", state.stick_zone()), ("rim", state.contact_zone())):
            for side in ("left", "right"):
                value = getattr(zone, side)
                if math.isfinite(value) and zone.error:
                    yield kind, f"{side} {increment}", value, zone.error


def of_loops(result: fret.Result) -> Iterator[Number]:
    """The numbers of the last loop."""
    loops = result.loops()
    for number in ("stiffness", "sliding_ratio", "dissipated", "energy_ratio", "opening"):
        error = loops.get(f"{number}_error")
        bar = math.nan if error is None else float(error[-1])
        yield f"loop {number}", "", float(loops[number][-1]), bar


def of_branches(result: fret.Result) -> Iterator[Number]:
    """The numbers of branches."""
    bars = result.error_bars().sel(part="total") if "error_bars" in result.dataset.attrs else {}
    for branch, row in result.branches().groupby("branch"):
        for name in row.data_vars:
            error = float(bars[name].sel(branch=branch)) if name in bars else math.nan
            if row[name].dtype.kind == "f":
                yield str(name), str(branch), row[name].item(), error


def of_stress(result: fret.Result) -> Iterator[Number]:
    """Largest stresses."""
    below = result.at(-1).stress()
    for measure in ("s_1", "von_mises", "s_xx"):
        worst = below.maximum(measure)
        yield f"largest {measure}", "", worst.value, worst.error


def numbers(scene: fret.Scene, *, error: bool) -> dict[tuple[str, str], tuple[float, float]]:
    """All numbers of a scene with their errors."""
    result = fret.solve(scene, progress=False, save="all", error=error)
    a = fret.reference.line_contact(
        R=scene.body1.shape.R,
        bodies=(scene.body1.substrate, scene.body2.substrate),
        W=float(result.dataset.W.max()),
    ).a
    rows = [
        *of_zones(result),
        *of_cracks(result, a),
        *of_stress(result),
        *of_loops(result),
        *of_branches(result),
    ]
    return {(kind, which): (value, error) for kind, which, value, error in rows}


def ratios(seed: int) -> Iterator[tuple[str, float, str]]:
    """Kinds of the numbers of a scene, true errors over printed errors, both in words."""
    truth = numbers(drawn(seed, FINER * CELLS), error=False)
    for label, coarse in (
        ("", numbers(drawn(seed, CELLS), error=True)),
        ("plain ", numbers(drawn(seed, CELLS), error=False)),
    ):
        for key, (value, bar) in coarse.items():
            right = truth.get(key)
            if (
                right is None
                or not math.isfinite(value)
                or not math.isfinite(right[0])
                or not math.isfinite(bar)
            ):
                continue
            off = abs(value - right[0])
            if key[0] in VANISHING or (bar == 0.0 and off <= 1e-9 * abs(value)):
                continue
            kind, which = key
            words = (
                f"{seed} {label}{kind} {which}: {value:.5g} +- {bar:.2g}, "
                f"{right[0]:.5g} on {FINER} times the cells"
            )
            yield label + kind, off / bar if bar > 0.0 else math.inf, words


def main(first: int, count: int) -> None:
    """Print the ratios of scenes, and what lies beyond the most."""
    warnings.simplefilter("ignore")
    by_kind: dict[str, list[float]] = defaultdict(list)
    beyond: list[str] = []
    for seed in range(first, first + count):
        rows = list(ratios(seed))
        for kind, ratio, words in rows:
            by_kind[kind].append(ratio)
            if ratio > MOST:
                beyond.append(f"{ratio:5.1f} {words}")
        print(
            f"{seed}: {len(rows)} numbers, {sum(r > MOST for _, r, _ in rows)} beyond", flush=True
        )
    print(*beyond, sep="\n")
    for kind, of_kind in by_kind.items():
        every = np.array(of_kind)
        print(
            f"{kind:26s} of {every.size:4d}: {np.mean(every <= MOST):6.1%} at most {MOST}, "
            f"median {np.median(every):.2f}, most {every.max():.2f}"
        )
    together = np.concatenate([np.array(r) for r in by_kind.values()])
    print(f"{'all numbers':26s} of {together.size:4d}: {np.mean(together <= MOST):.1%}")


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]))
