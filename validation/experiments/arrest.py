"""The evidence book: cracks that stop, and those that do not."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

import pyfret as fret
from pyfret import experiments, fracture
from validation.experiments.page import Claim, Page, drawn, table

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["page"]

#: Lengths of cracks over half the width of the contact, for the rows of the conference paper.
LENGTHS = np.geomspace(0.01, 3.0, 32)
#: Half-widths [m] and bulk stresses [Pa] under p_0 = 157 MPa, mu = 0.75, T = 0.6 mu W.
WIDTHS = np.array([0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.7, 1.0]) * 1e-3
BULK = (0.0, 60e6, 92.7e6)
P_0, MU, SHARE = 157e6, 0.75, 0.6
MEGA, MICRO = 1e-6, 1e6


def shuts(cracks: fracture.Cracks) -> float:
    """Length beyond which nothing opens the crack [m]; NaN if something does at all lengths."""
    largest = cracks.dataset.K_I_linear.max("increment").values
    closed = np.flatnonzero(largest <= 0.0)
    if closed.size == 0:
        return float("nan")
    n = closed[0]
    if n == 0:
        return float(cracks.lengths[0])
    part = largest[n - 1] / (largest[n - 1] - largest[n])
    return float(cracks.lengths[n - 1] + part * (cracks.lengths[n] - cracks.lengths[n - 1]))


def padded(a: float, bulk: float, n: int = 128) -> fracture.Cracks:
    """Cracks below a pad of a half-width [m] under a bulk stress [Pa], fully reversed in phase."""
    alloy = fret.Elastic(E=74e9, nu=0.33)
    E_star = alloy.E / (2.0 * (1.0 - alloy.nu**2))
    W = np.pi * a * P_0 / 2.0
    scene = fret.Scene(
        body1=fret.Body(alloy, shape=fret.Cylinder(R=E_star * a / (2.0 * P_0))),
        body2=fret.Body(alloy),
        friction=MU,
        grid=fret.Grid.strip(extent=2.6 * a, n=n),
    )
    path = fret.LoadPath.start().normal(W, increments=1)
    for way, increments in ((1, 4), (-1, 8), (1, 8)):
        path = path.force(T_x=way * SHARE * MU * W, sigma_B=way * bulk, increments=increments)
    result = fret.solve(scene, path, save="all", progress=False)
    return result.crack(lengths=np.geomspace(2e-6, 1e-3, 28))


def page(out: Path) -> Page:
    """Plain fretting cracks stop; wide contacts fail where narrow ones do not."""
    cells, stopped, plain = [], 0, 0
    tests = []
    for row in experiments.table("icf13_952_thresholds"):
        test = experiments.icf13(str(row["test"]), n=128)
        tests.append(test)
        result = fret.solve(test.scene, progress=False)
        cracks = result.crack(lengths=result.a_H * LENGTHS)
        dK, end = cracks.dK() * MEGA, shuts(cracks)
        top = int(dK[: len(dK) // 2].argmax())
        beyond = dK[top:].min()
        ends = np.isfinite(end)
        if str(row["test"]).startswith("PF"):
            plain, stopped = plain + 1, stopped + int(ends)
        cells.append(
            [
                str(row["test"]),
                f"{1e-6 * row['sigma_bulk_max_Pa']:.0f}",
                f"{1e-3 * row['Q_threshold_N_per_m']:.0f}",
                f"{dK[top]:.2f} at {MICRO * cracks.lengths[top]:.0f}",
                f"{MICRO * end:.0f}" if ends else "",
                "stops" if ends else f"grows if dK_th < {beyond:.2f}",
            ]
        )
    head = ["test", "bulk [MPa]", "Q [N/mm]", "largest dK", "shut from [um] on", "a crack"]
    rows_of_tests = table(head, cells)

    threshold = fracture.Threshold.from_material(fret.fatigue.Materials()["aluminium_4Cu"])
    margins = np.zeros((len(BULK), len(WIDTHS)))
    cells = []
    for n, bulk in enumerate(BULK):
        for k, a in enumerate(WIDTHS):
            found = padded(float(a), bulk).arrest(threshold)
            margins[n, k] = found.margin
            stop = "" if found.length is None else f"{MICRO * found.length:.1f}"
            cells.append(
                [f"{1e3 * a:.2f}", f"{MEGA * bulk:.1f}", found.verdict, stop, f"{found.margin:.3f}"]
            )

    def draw(ax: Any) -> None:
        for bulk, margin in zip(BULK, margins, strict=True):
            label = f"bulk stress {MEGA * bulk:.1f} MPa"
            ax.plot(1e3 * WIDTHS, margin, "o-", markersize=3, label=label)
        ax.axhline(1.0, color="0.4", linestyle="--", linewidth=1)
        ax.annotate("stops below", (1.0, 1.0), ha="right", va="top", fontsize=8)
        ax.set(xlabel="half-width of the contact [mm]", ylabel="least range of K / threshold")
        ax.set_ylim(bottom=0.0)
        ax.legend()

    critical = [
        f"{1e3 * np.interp(1.0, margin, WIDTHS):.2f} mm at {MEGA * bulk:.1f} MPa"
        for bulk, margin in zip(BULK, margins, strict=True)
        if margin.min() < 1.0 < margin.max()
    ]
    head = ["half-width [mm]", "bulk [MPa]", "a crack", "at [um]", "least dK/dK_th"]
    least, most = margins.min(axis=0), margins.max(axis=0)
    trend = bool((np.diff(margins[-1]) > 0.0).all())
    verdict = "; ".join(critical) or "none"
    return Page(
        name="experiment_arrest",
        title="Cracks that stop: plain fretting, narrow contacts",
        test=tests[0],
        conditions=(
            "**Plain fretting and fretting fatigue of steel.** Normal cracks at the rim, at the "
            "measured thresholds of initiation.\n\n"
            "**The width of the contact** (D. Nowell, D. A. Hills, Wear 136 (1990) 329-343; "
            "thresholds and loads as quoted by J. A. Araujo, D. Nowell, Int. J. Fatigue 21 (1999) "
            "947-956). Cylinders on Al-4%Cu, all with p_0 = 157 MPa, mu = 0.75, T = 0.6 mu W and "
            "the bulk stress in phase, fully reversed: the stress at the surface is the same, and "
            "wide contacts failed where narrow ones did not. El Haddad's threshold with dK_th = "
            "2.1 MPa m^0.5 and 124 MPa (positive halves), a_0 = "
            f"{MICRO * threshold.a_0:.1f} um."
        ),
        fitted="nothing; the threshold of Al-4%Cu is taken from the literature.",
        predicted="the range of K over the length of a crack, and whether and where it stops.",
        comparison=[
            "No threshold of K of the steel is known to the page, and none is needed for plain "
            "fretting: from some depth on no instant of the cycle opens a crack, so that each "
            "stops, whatever its threshold. Under bulk stress the range of K has a least value "
            "beyond its first maximum, and a crack grows through if its threshold is below that "
            "(cracks of up to three half-widths; FF_7 has a static bulk stress, so that its range "
            "falls on further down). dK in MPa m^0.5, faces in contact without friction.",
            rows_of_tests,
            drawn(out, "experiment_arrest", draw),
            table(head, cells),
        ],
        claims=[
            Claim(
                "plain fretting",
                "cracks stop",
                f"{stopped} of {plain} rows stop whatever the threshold",
                stopped == plain,
            ),
            Claim(
                "width of the contact",
                "wide contacts fail, narrow ones do not",
                f"from {verdict}",
                trend and bool(least.min() < 1.0 < most.max()),
            ),
        ],
        verdict=f"The half-width at which the verdict changes: {verdict}.",
    )
