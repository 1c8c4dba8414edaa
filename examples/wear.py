"""Studies of wear: its rate against stroke, a coating's life, and runs seen whole.

``python examples/wear.py --out out`` writes wear rate over stroke from partial to gross slip, the
life of a coating over load and stroke, and profiles, depth maps, histories and loops of a bare and
a coated sphere in partial slip, of a sphere in gross slip and of the cylinder of McColl, Ding and
Leen.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Literal

import matplotlib.pyplot as plt
import numpy as np

import pyfret as fret

R, MU, K = 10e-3, 0.6, 1e-14
STEEL = fret.Elastic(E=200e9, nu=0.3)
DATA = Path(__file__).parents[1] / "tests" / "data" / "wear"
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
        friction=MU,
        grid=fret.Grid.centred(width=2 * reach * hertz.a, n=n),
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
        law = fret.wear.Archard(K)
        result = fret.wear.solve(
            scene,
            path=moved(W, stroke),
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
        ticks = [0.5, 1, 2, 5, 10]
        ax.set_xticks(ticks, [str(tick) for tick in ticks], minor=False)
        ax.minorticks_off()
        ax.set_xlabel("stroke [µm]")
        ax.set_ylabel("wear per cycle [µm$^3$]")
        ax.legend()
        figure.savefig(out / "wear_rate.png", dpi=150)


def coating_life(out: Path) -> None:
    """Cycles until a coating is worn through over load and stroke in gross slip."""
    loads, strokes = np.array([20.0, 50.0, 120.0]), np.array([2e-6, 5e-6, 12e-6, 30e-6])
    life = np.full((len(loads), len(strokes)), np.nan)
    thickness = 2e-6
    for i, W in enumerate(loads):
        for j, stroke in enumerate(strokes):
            result = fret.wear.solve(
                contact(W, coating=thickness, reach=5.5, n=64),
                path=moved(W, stroke, increments=4),
                cycles=1e9,
                first_branch=2,
                cycling="sliding",
                body2=[fret.wear.Archard(K), fret.wear.Archard(10 * K)],
                tolerance=0.03,
                progress=False,
            )
            through = [e["cycles"] for e in result.events if e["kind"] == "worn through"]
            life[i, j] = through[0] if through else np.nan
    with fret.plot.style():
        figure, ax = plt.subplots()
        for W, cycles in zip(loads, life, strict=True):
            ax.loglog(1e6 * strokes, cycles, "o-", label=f"{W:.0f} N")
        ax.set_xticks(1e6 * strokes, [f"{1e6 * stroke:.0f}" for stroke in strokes], minor=False)
        ax.minorticks_off()
        ax.set_xlabel("stroke [µm]")
        ax.set_ylabel(f"cycles until {1e6 * thickness:.0f} µm of coating are through")
        ax.legend()
        figure.savefig(out / "coating_life.png", dpi=150)


def panels(
    result: fret.wear.WearResult, file: Path, *, of: Literal["body2", "both"] = "both"
) -> None:
    """Write profiles, map, history and loops of a run; a line contact has no map."""
    with fret.plot.style():
        figure, axes = plt.subplots(2, 2, figsize=(9, 7.5), layout="constrained")
        fret.plot.wear_profiles(result, of=of, ax=axes[0, 0])
        if result.dataset.sizes["y"] > 1:
            fret.plot.depth_map(result, of=of, ax=axes[0, 1])
        else:
            fret.plot.wear_profiles(result, of="body1", ax=axes[0, 1])
            axes[0, 0].set_title("body 2")
            axes[0, 1].set_title("body 1")
        fret.plot.wear_history(result, ax=axes[1, 0])
        fret.plot.wear_loops(result, ax=axes[1, 1])
        figure.savefig(file, dpi=150)
        plt.close(figure)


def partial_slip(out: Path) -> None:
    """Partial slip of a bare and of a coated sphere until the stick zone carries nearly all."""
    W, law = 50.0, fret.wear.Archard(5 * K)
    T = 0.5 * MU * W
    path = fret.LoadPath.start().normal(W, increments=1).tangential([T, -T, T], increments=18)
    for name, coating in (("worn_sphere", None), ("worn_coated_sphere", 20e-6)):
        result = fret.wear.solve(
            contact(W, n=64, reach=1.4, coating=coating),
            path=path,
            cycles=1e5,
            first_branch=2,
            body1=law,
            body2=law,
            progress=False,
        )
        panels(result, out / f"{name}.png")


def gross_slip(out: Path) -> None:
    """Gross slip of a sphere, the stroke half as long as the contact: the flat wears over more."""
    W = 50.0
    result = fret.wear.solve(
        contact(W, n=72, reach=3.4),
        path=moved(W, 80e-6, increments=8),
        cycles=3000,
        first_branch=2,
        cycling="sliding",
        body1=fret.wear.Archard(K),
        body2=fret.wear.Archard(K),
        tolerance=0.03,
        progress=False,
    )
    panels(result, out / "gross_slip.png", of="body2")


def mccoll(out: Path) -> None:
    """Draw McColl, Ding and Leen's cylinder beside finite elements and the measurement."""
    steel = fret.Elastic(E=200e9, nu=0.3)
    path = fret.LoadPath.start().normal(18.5e3, increments=1)
    for to, increments in ((25e-6, 1), (-25e-6, 8), (25e-6, 8)):
        path = path.displace(delta_x=to, increments=increments)
    result = fret.wear.solve(
        fret.Scene(
            body1=fret.Body(steel, shape=fret.Cylinder(R=6e-3)),
            body2=fret.Body(steel),
            friction=0.9,
            grid=fret.Grid.strip(extent=0.72e-3, n=320),
        ),
        path=path,
        cycles=18000,
        first_branch=2,
        cycling="sliding",
        rig_stiffness=24.6e9,  # of both half-planes down to 6 mm, docs/wear.md
        body1=fret.wear.Archard(1.9e-14),
        body2=fret.wear.Archard(2.9e-14),
        tolerance=0.02,
        progress=False,
    )
    panels(result, out / "mccoll.png", of="body2")
    elements = np.loadtxt(DATA / "mccoll_finite_elements.csv", delimiter=",", skiprows=1)
    measured = np.loadtxt(DATA / "mccoll_measured.csv", delimiter=",", skiprows=1)
    with fret.plot.style():
        figure, ax = plt.subplots()
        ax.plot(measured[:, 0], measured[:, 1], color="0.7", label="measured, 18 000 cycles")
        block = int(np.abs(np.asarray(result.block_cycles) - 1000).argmin())
        for cycles, at, colour in ((1000, block, "C0"), (18000, -1, "C1")):
            rows = elements[elements[:, 0] == cycles]
            name = f"{float(result.dataset.block_cycles[at]):.0f} cycles"
            ax.plot(rows[:, 1], rows[:, 2], "o", color=colour, label=f"finite elements, {cycles}")
            ax.plot(1e3 * result.x, 1e6 * result.worn2[at, :, 0], color=colour, label=name)
        ax.set_xlim(-0.36, 0.36)
        ax.invert_yaxis()
        ax.set_xlabel("$x$ [mm]")
        ax.set_ylabel("depth of the flat [µm]")
        ax.legend(fontsize="small")
        figure.savefig(out / "mccoll_profiles.png", dpi=150)
        plt.close(figure)


def main() -> None:
    """Make all figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out"))
    out = parser.parse_args().out
    out.mkdir(parents=True, exist_ok=True)
    for study in (mccoll, gross_slip, partial_slip, wear_rate, coating_life):
        study(out)


if __name__ == "__main__":
    main()
