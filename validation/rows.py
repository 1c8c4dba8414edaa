"""Indentations with friction, their increments chosen: every row of a table of beta and mu."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import numpy as np

import pyfret as fret
from validation.pages import percent
from validation.scenes import R, W, hertz, sphere

if TYPE_CHECKING:
    from pathlib import Path

#: Dundurs' beta and the friction coefficient.
ROWS = ((0.1, 0.05), (0.1, 0.1), (0.2, 0.1), (0.2, 0.2986), (2 / 7, 0.2), (2 / 7, 0.5), (0.5, 0.5))
CELLS = 256


def write(folder: Path, *, n: int = CELLS) -> str:
    """Solve every row, write the page; give its line of the front page."""
    rows = [
        "| beta | mu | increments | c/a | c/a, truth | error | p(0), error | a, error "
        "| delta_z, error | time |",
        "|---" * 10 + "|",
    ]
    worst, most = 0.0, 0
    for beta, mu in ROWS:
        # On a rigid plane beta = (1 - 2 nu)/(2 (1 - nu)).
        material = fret.Elastic(E=210e9, nu=(1 - 2 * beta) / (2 - 2 * beta))
        path = fret.LoadPath.start().force(W=W)
        scene = sphere(material, fret.RIGID, path, n=n, mu=mu, extent=2.2)
        started = time.process_time()
        result = fret.solve(scene, progress=False)
        seconds = time.process_time() - started
        truth = fret.reference.coupled_indentation(beta=beta, mu=mu)
        round_, at = hertz(material, fret.RIGID), result.at(-1)
        a = round_.a / np.cbrt(truth.W)
        c = float(np.sqrt(at.stick_ratio))
        errors = [
            c / truth.stick_ratio - 1,
            float(at.p_max) / (truth.p0 * truth.W ** (2 / 3) * round_.p0) - 1,
            float(at.contact_radius) / a - 1,
            float(at.delta_z) / (truth.delta_z * a**2 / R) - 1,
        ]
        count = result.dataset.sizes["increment"]
        worst, most = max(worst, abs(errors[0])), max(most, count)
        numbers = " | ".join(percent(error) for error in errors)
        rows.append(
            f"| {beta:.4g} | {mu:g} | {count} | {c:.5f} | {truth.stick_ratio:.5f} | {numbers} "
            f"| {seconds:.2f} s |"
        )
    parts = [
        "# Coupled indentation with chosen increments",
        f"A sphere pressed on a rigid plane, {n} x {n} cells, default settings: the increments are "
        "chosen for an error of the path. The truth is the self-similar solution by dual Abel "
        "transforms (`reference.coupled_indentation`); a stick zone that grows is known to a part "
        "of a cell.",
        "\n".join(rows),
        "[All pages](README.md)",
    ]
    (folder / "coupled_rows.md").write_text("\n\n".join(parts) + "\n", encoding="utf-8")
    return (
        f"| [Coupled indentation with chosen increments](coupled_rows.md) | {n} | c/a of "
        f"{len(ROWS)} pairs, at most {most} increments | {100 * worst:.2g} % | | |"
    )
