"""Are unknowns found inside their confidence? ``python -m validation.identification``.

Loops are computed on a fine grid with known values, given noise, and fitted on a coarser grid;
each draw has values and noise of its own. A 95 % confidence that is honest holds the true value in
about 95 of 100 draws.
"""

from __future__ import annotations

import argparse
import json
import time
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import matplotlib.pyplot as plt
import numpy as np

import pyfret as fret
from validation.pages import DPI, shrink

if TYPE_CHECKING:
    from numpy.typing import NDArray

#: Noise of the forces and of the approaches over their ranges, standard deviation.
NOISE = 0.02
#: Ranges of the true values; of the fit they are a factor 3 wider at either end.
TRUE = {
    "mu": (0.4, 0.8),
    "rig.stiffness": (5e6, 2e7),
    "body2.coatings.0.E": (2.5e11, 5e11),
}
UNITS = {"mu": "", "rig.stiffness": " [N/m]", "body2.coatings.0.E": " [Pa]"}
WIDER = 3.0
#: Cells a side and increments of a way, of the truth and of the fit.
FINE, WAYS, COARSE = 64, 80, 32
#: Normal force [N], amplitude of the shift over that at which the bodies slide, points of a way
#: and of the indentation.
W, BEYOND, POINTS, PRESSED = 20.0, 1.6, 60, 30
#: Draws in which each value is to lie within its confidence.
ASKED = 90
STEEL = fret.Elastic(E=210e9, nu=0.3)


def scene(n: int) -> fret.Scene:
    """A steel ball on steel with a coating of about half of the contact radius."""
    layer = fret.Coating(fret.Elastic(E=350e9, nu=0.25), thickness=40e-6)
    return fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Sphere(R=5e-3)),
        body2=fret.Body(STEEL, coatings=[layer]),
        friction=0.5,
        grid=fret.Grid.centred(width=0.26e-3, n=n),
        path=fret.LoadPath.start().normal(W),
    )


def drawn(rng: np.random.Generator) -> dict[str, float]:
    """True values, even in their logarithm."""
    return {key: float(np.exp(rng.uniform(*np.log(ends)))) for key, ends in TRUE.items()}


def loop(true: dict[str, float], rng: np.random.Generator) -> fret.fit.Loops:
    """A loop that slides, with noise on the force."""
    of = scene(FINE).replace(true)
    elastic = true["mu"] * W * (1 / true["rig.stiffness"] + 1 / 1.3e7)
    reach = BEYOND * elastic
    path = of.path.displace(delta_x=[reach, -reach, reach], increments=WAYS)
    d = fret.solve(of, path, progress=False).dataset
    ways = np.arange(d.sizes["increment"])[-2 * WAYS :: max(WAYS // POINTS, 1)]
    T = d.T_x.values[ways]
    return fret.fit.Loops.from_arrays(
        d.delta_x.values[ways], T + rng.normal(0, NOISE * np.ptp(T), T.size)
    )


def indentation(true: dict[str, float], rng: np.random.Generator) -> fret.fit.Indentation:
    """An indentation curve of the same pair, without the rig, with noise on the approach."""
    of = scene(FINE).replace({k: v for k, v in true.items() if k != "rig.stiffness"})
    path = fret.LoadPath.start()
    for part in np.linspace(0, 1, PRESSED + 1)[1:]:
        path = path.normal(W * float(part), increments=1)
    d = fret.solve(of, path, progress=False).dataset
    delta_z = d.delta_z.values
    return fret.fit.Indentation.from_arrays(
        d.W.values, delta_z + rng.normal(0, NOISE * np.ptp(delta_z), delta_z.size)
    )


def draw(seed: int, *, pressed: bool) -> dict[str, Any]:
    """One draw: true values, values found, confidence, solves."""
    rng = np.random.default_rng(seed)
    true = drawn(rng)
    data: list[Any] = [loop(true, rng)]
    if pressed:
        data.append(indentation(true, rng))
    unknown = {key: (low / WIDER, high * WIDER) for key, (low, high) in TRUE.items()}
    started = time.perf_counter()
    found = fret.fit.fit(scene(COARSE), data, unknown=unknown, executor=1)
    return {
        "seed": seed,
        "true": true,
        "known": {k: [v.value, v.low, v.high, v.noise, v.solver] for k, v in found.known.items()},
        "solves": found.solves,
        "converged": found.converged,
        "doubts": found.doubts,
        "seconds": time.perf_counter() - started,
    }


def run(count: int, *, pressed: bool, workers: int, log: Path) -> list[dict[str, Any]]:
    """All draws; those that the log holds already are not repeated."""
    done = [json.loads(line) for line in log.read_text().splitlines()] if log.exists() else []
    left = [seed for seed in range(count) if seed not in {d["seed"] for d in done}]
    with ThreadPoolExecutor(workers) as pool, log.open("a", encoding="utf-8") as file:
        for one in pool.map(partial(draw, pressed=pressed), left):
            file.write(json.dumps(one) + "\n")
            file.flush()
            done.append(one)
    return sorted((d for d in done if d["seed"] < count), key=lambda d: d["seed"])


def inside(draws: list[dict[str, Any]], key: str) -> int:
    """Draws whose confidence holds the true value."""
    return sum(d["known"][key][1] <= d["true"][key] <= d["known"][key][2] for d in draws)


def errors(draws: list[dict[str, Any]], key: str) -> NDArray[np.float64]:
    """Relative errors of the values."""
    return np.array([d["known"][key][0] / d["true"][key] - 1 for d in draws])


def widths(draws: list[dict[str, Any]], key: str) -> NDArray[np.float64]:
    """Half-widths of the confidence over the true values."""
    half = [0.5 * (d["known"][key][2] - d["known"][key][1]) / d["true"][key] for d in draws]
    return np.array(half)


def table(draws: list[dict[str, Any]]) -> str:
    """A row for each unknown."""
    lines = [
        "| unknown | true values | inside the 95 % confidence | median error | median half-width |",
        "|---|---|---|---|---|",
    ]
    for key, (low, high) in TRUE.items():
        held = inside(draws, key)
        mark = "" if 100 * held >= ASKED * len(draws) else " (**too few**)"
        lines.append(
            f"| `{key}`{UNITS[key]} | {low:g} to {high:g} | {held} of {len(draws)}{mark} | "
            f"{100 * np.median(np.abs(errors(draws, key))):.1f} % | "
            f"{100 * np.median(widths(draws, key)):.0f} % |"
        )
    return "\n".join(lines)


def figure(sets: dict[str, list[dict[str, Any]]], out: Path) -> None:
    """Values over true ones with their confidence, a panel for each unknown and kind of data."""
    limits = {"mu": (0.96, 1.04), "rig.stiffness": (0.5, 2.0), "body2.coatings.0.E": (0.1, 10.0)}
    with fret.plot.style():
        figure, axes = plt.subplots(
            len(sets),
            len(TRUE),
            figsize=(2.7 * len(TRUE), 2.4 * len(sets)),
            layout="constrained",
            squeeze=False,
            sharex=True,
        )
        for row, (title, draws) in zip(axes, sets.items(), strict=True):
            for ax, (key, (low, high)) in zip(row, limits.items(), strict=True):
                found = 1 + errors(draws, key)
                order = np.argsort(found)
                for n, k in enumerate(order):
                    ends = [draws[k]["known"][key][end] / draws[k]["true"][key] for end in (1, 2)]
                    held = ends[0] <= 1 <= ends[1]
                    ax.plot([n, n], ends, color="C0" if held else "C1", lw=0.8)
                ax.plot(found[order], ".", color="k", ms=2)
                ax.axhline(1, color="0.6", lw=0.8)
                if high > 1.5:
                    ax.set_yscale("log")
                    ticks = [t for t in (0.1, 0.2, 0.5, 1, 2, 5, 10) if low <= t <= high]
                    ax.set_yticks(ticks, [f"{t:g}" for t in ticks])
                    ax.minorticks_off()
                ax.set_ylim(low, high)
                ax.set_title(f"{key}\n{title}", fontsize="small")
            row[0].set_ylabel("found over true")
        for ax in axes[-1]:
            ax.set_xlabel("draw, sorted")
        figure.savefig(out / "identification.png", dpi=DPI)
        plt.close(figure)
    shrink(out)


def page(sets: dict[str, list[dict[str, Any]]]) -> str:
    """The page of the book."""
    parts = [
        "# Identification: are unknowns found inside their confidence?",
        "Written by `python -m validation.identification`. A steel ball (R = 5 mm, 20 N) on steel "
        "with 40 um of a coating is driven through a rig of unknown stiffness. Friction, stiffness "
        "and the modulus of the coating are drawn at random, the loop is computed on "
        f"{FINE} x {FINE} cells with {WAYS} increments a way, and gets noise of "
        f"{100 * NOISE:.0f} % of the range of its force. `fret.fit` then finds all three, and the "
        "zeros of "
        f"both gauges, on {COARSE} x {COARSE} cells. A confidence of 95 % that is honest holds the "
        "true value in about 95 of 100 draws; asked were at least 90.",
    ]
    for title, draws in sets.items():
        solves = [d["solves"] for d in draws]
        apart, open_ = (
            sum(any(words in said for said in d["doubts"]) for d in draws)
            for words in ("told apart", "not resolved")
        )
        parts += [
            f"## {title[0].upper() + title[1:]}",
            table(draws),
            f"Solves: {np.median(solves):.0f} in the middle, {max(solves)} at most; "
            f"{sum(d['converged'] for d in draws)} of {len(draws)} searches ended by themselves; "
            f"in {apart} the summary has two unknowns that it cannot separate, in {open_} "
            "one that is not resolved.",
        ]
    parts += [
        "![Errors and confidence of every draw](identification.png)",
        "Lines are confidence intervals, orange where they miss the true value; points the values.",
        "Friction follows from the height of the loop, within two per cent. A loop alone does not "
        "separate the spring of the rig from the coating, both of which tilt it, and the summary "
        "has this doubt; its intervals are wide, and right. An indentation curve, which the rig "
        "does not enter, separates the two. Intervals that miss the modulus lie below it: the "
        "stiffer the coating, the less it changes either curve.",
    ]
    return "\n\n".join(parts) + "\n"


def main() -> None:
    """Run or continue the draws and write the page."""
    parser = argparse.ArgumentParser(description="Draws of identification, and their page.")
    parser.add_argument("--out", type=Path, default=Path("docs/validation"), help="its folder")
    parser.add_argument("--log", type=Path, default=Path("out"), help="folder of the draws' logs")
    parser.add_argument("--draws", type=int, default=100)
    parser.add_argument("--workers", type=int, default=2)
    options = parser.parse_args()
    options.log.mkdir(parents=True, exist_ok=True)
    sets = {}
    for name, title, pressed in (
        ("loops", "a loop alone", False),
        ("both", "a loop and an indentation curve", True),
    ):
        log = options.log / f"identification_{name}.jsonl"
        sets[title] = run(options.draws, pressed=pressed, workers=options.workers, log=log)
        print(title, table(sets[title]), sep="\n", flush=True)
    figure(sets, options.out)
    (options.out / "identification.md").write_text(page(sets), encoding="utf-8")


if __name__ == "__main__":
    main()
