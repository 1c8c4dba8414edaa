"""Energies of Ti-6Al-4V under a constant force."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret import experiments
from validation.experiments.page import Claim, Page, drawn, spread, table

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["page"]

#: Length of the contact [m].
LENGTH = 8e-3
#: A test whose stroke is suspect.
SUSPECT = 6


def page(out: Path) -> Page:
    """Energies with one coefficient of friction."""
    rows = [
        r
        for r in experiments.table("vanpeteghem2011")
        if r["normal_force"] == "constant" and r["test"] != SUSPECT
    ]
    ratios, cells = [], []
    for r in rows:
        worn = experiments.vanpeteghem2011(int(r["test"])).wear(jumps=1).dataset
        energy = float(worn.dissipated[-1]) * LENGTH
        ratios.append(energy / r["accumulated_energy_J"])
        cells.append(
            [
                f"{r['test']:.0f}",
                f"{r['cycles']:.0f}",
                f"{1e6 * r['slip_stroke_m']:.0f}",
                f"{r['accumulated_energy_J']:.0f}",
                f"{energy:.0f}",
                f"{ratios[-1]:.2f}",
            ]
        )

    def draw(ax: Any) -> None:
        measured = np.array([r["accumulated_energy_J"] for r in rows])
        ax.loglog(measured, measured * np.array(ratios), "o")
        ax.plot([6e2, 3e4], [6e2, 3e4], color="0.6", lw=1)
        ax.set(xlabel="energy, measured [J]", ylabel="with mu_e = 0.55 [J]")

    head = ["test", "cycles", "stroke [um]", "energy [J]", "computed [J]", "ratio"]
    off = np.abs(np.array(ratios) - 1)
    return Page(
        name="experiment_vanpeteghem2011",
        title="Ti-6Al-4V under a constant force: energies",
        test=experiments.vanpeteghem2011(1),
        conditions="Cylinder, R = 80 mm, on flat, both of Ti-6Al-4V (119 GPa, 0.29), 8 mm long, "
        "8523 N, gross slip. `fret.experiments.vanpeteghem2011(1)` is the scene of a test.",
        fitted="one coefficient of friction for all tests, mu_e = 0.55, with which the geometric "
        "mean of the ratios is 1 (the stable force over W is about 0.7: loops are no rectangles).",
        predicted="how the energies of tests differ that differ in stroke and cycles.",
        comparison=[
            table(head, cells),
            drawn(out, "experiment_vanpeteghem2011", draw),
            "In gross slip the energy is 4 mu_e W slip N; the solver adds no error to it.",
        ],
        claims=[
            Claim(
                "energies by one coefficient of friction",
                "within 20 %",
                spread(ratios, 0.20),
                bool(off.max() <= 0.20),
            ),
        ],
        verdict="A check of the data and of the units. Tests whose contact opens in every cycle "
        "need their waveform, which is not published, and are left out.",
    )
