"""Two studies of wear: wear rate against stroke, and a coating's life over load and stroke.

``python examples/wear.py --out out`` writes their figures, and those of a worn sphere.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import pyfret as fret

R, MU, K = 10e-3, 0.6, 1e-14
STEEL = fret.Elastic(E=200e9, nu=0.3)
HARD = fret.Elastic(E=400e9, nu=0.25)


def contact(
    W: float, *, coating: float | None = None, n: int = 48, reach: float = 1.8
) -> fret.Scene:
    """Give a steel sphere on a steel flat, which may have a hard coating of a thickness."""
    hertz = fret.reference.hertz(R=R, bodies=(STEEL, STEEL), W=W)
    coatings = [] if coating is None else [fret.Coating(HARD, thickness=coating)]
    return fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Sphere(R=R)),
        body2=fret.Body(STEEL, coatings=coatings),
        mu=MU,
        grid=fret.Grid.centred(extent=2 * reach * hertz.a, n=n),
    )


def moved(W: float, stroke: float, increments: int = 8) -> fret.LoadPath:
    """Press with W and move to and fro by a shift of +-`stroke`."""
    path = fret.LoadPath.start().normal(W, increments=1)
    path = path.displace(delta_x=stroke, increments=increments)
    path = path.displace(delta_x=-stroke, increments=increments)
    return path.displace(delta_x=stroke, increments=increments)


def wear_rate(out: Path) -> None:
    """Wear rate over the first cycles against stroke, from partial to gross slip."""
    W = 50.0
    scene = contact(W)
    hertz = fret.reference.hertz(R=R, bodies=(STEEL, STEEL), W=W)
    G = STEEL.E / (2 * (1 + STEEL.nu))
    # Cattaneo's shift at the onset of gross slip: 3 mu W/(16 a G*), 1/G* = 2 (2 - nu)/G.
    onset = 3 * MU * W / (16 * hertz.a) * 2 * (2 - STEEL.nu) / G
    strokes = onset * np.geomspace(0.3, 6.0, 9)
    rates = []
    for stroke in strokes:
        law = fret.Archard(K)
        result = fret.wear(
            scene,
            moved(W, stroke),
            cycles=2000,
            first_branch=2,
            body1=law,
            body2=law,
            jumps=2,
            progress=False,
        )
        d = result.dataset
        rates.append(float((d.volume1 + d.volume2)[-1]) / 2000)
    with fret.plot.style():
        figure, ax = plt.subplots()
        ax.loglog(1e6 * strokes, 1e18 * np.array(rates), "o-", label="both bodies")
        gross = 2 * K * W * 4 * np.maximum(strokes - onset, 0)
        far = gross > 0
        ax.loglog(
            1e6 * strokes[far],
            1e18 * gross[far],
            "--",
            label=r"$2\,k\,W\,4(\delta-\delta_\mathrm{gross})$",
        )
        ax.axvline(1e6 * onset, color="0.6", linewidth=1)
        ax.annotate("gross slip", (1e6 * onset * 1.05, 1e18 * min(r for r in rates if r > 0)))
        ax.set_xlabel("stroke [um]")
        ax.set_ylabel("wear per cycle [um$^3$]")
        ax.legend()
        figure.savefig(out / "wear_rate.png", dpi=150)


def coating_life(out: Path) -> None:
    """Cycles until a coating is worn through over load and stroke in gross slip."""
    loads, strokes = np.array([20.0, 50.0, 120.0]), np.array([2e-6, 5e-6, 12e-6, 30e-6])
    life = np.full((len(loads), len(strokes)), np.nan)
    thickness = 2e-6
    for i, W in enumerate(loads):
        for j, stroke in enumerate(strokes):
            result = fret.wear(
                contact(W, coating=thickness, reach=5.5, n=64),
                moved(W, stroke, increments=4),
                cycles=1e9,
                first_branch=2,
                cycling="sliding",
                body2=[fret.Archard(K), fret.Archard(10 * K)],
                tolerance=0.03,
                progress=False,
            )
            through = [e["cycles"] for e in result.events if e["kind"] == "worn through"]
            life[i, j] = through[0] if through else np.nan
    with fret.plot.style():
        figure, ax = plt.subplots()
        for W, cycles in zip(loads, life, strict=True):
            ax.loglog(1e6 * strokes, cycles, "o-", label=f"{W:.0f} N")
        ax.set_xlabel("stroke [um]")
        ax.set_ylabel(f"cycles until {1e6 * thickness:.0f} um of coating are through")
        ax.legend()
        figure.savefig(out / "coating_life.png", dpi=150)


def worn_sphere(out: Path) -> None:
    """Partial slip until nothing changes any more: profiles, map, history, loops."""
    W = 50.0
    T = 0.5 * MU * W
    path = fret.LoadPath.start().normal(W, increments=1).tangential([T, -T, T], increments=18)
    law = fret.Archard(K)
    result = fret.wear(
        contact(W, n=64, reach=1.4),
        path,
        cycles=1e6,
        first_branch=2,
        body1=law,
        body2=law,
        tolerance=0.03,
        progress=False,
    )
    with fret.plot.style():
        figure, axes = plt.subplots(2, 2, figsize=(9, 7.5), layout="constrained")
        fret.plot.wear_profiles(result, of="both", ax=axes[0, 0])
        fret.plot.depth_map(result, of="both", ax=axes[0, 1])
        fret.plot.wear_history(result, ax=axes[1, 0])
        fret.plot.wear_loops(result, ax=axes[1, 1])
        figure.savefig(out / "worn_sphere.png", dpi=150)


def main() -> None:
    """Make all figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out"))
    out = parser.parse_args().out
    out.mkdir(parents=True, exist_ok=True)
    worn_sphere(out)
    wear_rate(out)
    coating_life(out)


if __name__ == "__main__":
    main()
