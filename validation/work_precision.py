"""Error against time: the paper's method and increments, ours fixed, ours chosen by a tolerance."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Literal

import matplotlib.pyplot as plt
import numpy as np

import pyfret as fret
from validation import paper
from validation.pages import DPI
from validation.scenes import CORK, STEEL, W, sphere

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from validation.truth import Array

    Count = int | Literal["auto"]
    #: A scene with increments of the first branch, those of the others going with them, on so many
    #: cells a side, the first branch in steps of force or of contact radius.
    Family = Callable[[Count, int, fret.Spacing], fret.Scene]

#: Increments of the first branch, of the paper's method fewer, and tolerances of automatic ones.
FIXED, OLD = (10, 25, 100), (10, 25, 50)
TOLERANCES = (2e-2, 5e-3, 1e-3)
#: Increments of the first branch of the reference; the whole path has ten times as many.
REFERENCE = 250
RADII = fret.Spacing.EQUAL_RADIUS


def coated(ratio: float) -> Family:
    """The paper's scene: the branches of the tangential force have as many, or twice as many."""

    def scene(increments: Count, n: int, spacing: fret.Spacing) -> fret.Scene:
        whole = paper.scene(ratio, n)
        first, *others = whole.path.branches
        path = fret.LoadPath.start()
        path = path.force(W=first.W, increments=increments, spacing=spacing, t=first.t)
        for k, branch in enumerate(others):
            count = increments if increments == "auto" or k == 0 else 2 * increments
            path = path.force(T_x=branch.T_x, increments=count, t=branch.t)
        return whole.replace(path=path, save="branches")

    return scene


def indentation(material: fret.Elastic, mu: float) -> Family:
    """A sphere pressed on a rigid plane."""

    def scene(increments: Count, n: int, spacing: fret.Spacing) -> fret.Scene:
        path = fret.LoadPath.start().force(W=W, increments=increments, spacing=spacing)
        return sphere(material, fret.RIGID, path, n=n, mu=mu, extent=2.2)

    return scene


FAMILIES: dict[str, Family] = {
    "coated, E1/E2 = 0.5": coated(0.5),
    "coated, E1/E2 = 2": coated(2.0),
    "coated, E1/E2 = 4": coated(4.0),
    "indentation, nu = 0": indentation(CORK, 0.5),
    "indentation, nu = 0.3": indentation(STEEL, 0.5),
}


def ends(result: fret.Result) -> tuple[Array, Array]:
    """Pressure and shear at the ends of the branches that are compared, the last five."""
    d = result.dataset.isel(saved=slice(-5, None))
    return d.p.values, np.stack([d.q_x.values, d.q_y.values])


def runs(family: Family, n: int) -> dict[str, list[tuple[str, Callable[[], fret.Result]]]]:
    """What is run: name of the method, then how finely, and the run."""
    old = fret.Settings(
        preset=fret.settings.Preset.SPINU2020,
        cell_entry_correction=False,
        slip_rotation_correction=False,
    )

    def fixed(k: int, settings: fret.Settings, spacing: fret.Spacing) -> Callable[[], fret.Result]:
        scene = family(k, n, spacing).replace(settings=settings)
        return lambda: fret.solve(scene, progress=False)

    def chosen(tolerance: float) -> Callable[[], fret.Result]:
        scene = family("auto", n, RADII).replace(settings=fret.Settings(path_tolerance=tolerance))
        return lambda: fret.solve(scene, progress=False)

    return {
        "the paper's method": [(f"{k}", fixed(k, old, fret.Spacing.UNIFORM)) for k in OLD],
        "ours, fixed": [(f"{k}", fixed(k, fret.Settings(), RADII)) for k in FIXED],
        "ours, automatic": [(f"{t:g}", chosen(t)) for t in TOLERANCES],
    }


def write(folder: Path, *, n: int) -> str:
    """Run everything, draw the figure, write the page; give its line of the front page."""
    rows = [
        "| scene | method | increments | error of q | error of p | processor time |",
        "|---|---|---|---|---|---|",
    ]
    with fret.plot.style():
        figure, axes = plt.subplots(
            2, len(FAMILIES), figsize=(2.7 * len(FAMILIES), 5.2), sharex=True, sharey="row"
        )
        for (q_ax, p_ax), (name, family) in zip(axes.T, FAMILIES.items(), strict=True):
            p_ref, q_ref = ends(fret.solve(family(REFERENCE, n, RADII), progress=False))
            for method, of_method in runs(family, n).items():
                points = []
                for _, solve in of_method:
                    started = time.process_time()
                    result = solve()
                    seconds = time.process_time() - started
                    p, q = ends(result)
                    e_p = float(np.linalg.norm(p - p_ref) / np.linalg.norm(p_ref))
                    e_q = float(np.linalg.norm(q - q_ref) / np.linalg.norm(q_ref))
                    points.append((seconds, e_q, e_p))
                    count = result.dataset.sizes["increment"]
                    rows.append(
                        f"| {name} | {method} | {count} | {100 * e_q:.2g} % | {100 * e_p:.2g} % "
                        f"| {seconds:.2f} s |"
                    )
                seconds_, e_q_, e_p_ = zip(*points, strict=True)
                q_ax.loglog(seconds_, e_q_, "o-", label=method)
                p_ax.loglog(seconds_, e_p_, "o-")
            q_ax.set_title(name)
            p_ax.set_xlabel("processor time [s]")
        axes[0, 0].set_ylabel("error of q")
        axes[1, 0].set_ylabel("error of p")
        axes[0, 0].legend(fontsize=7)
        figure.savefig(folder / "work_precision.png", dpi=DPI)
        plt.close(figure)
    parts = [
        "# Work and precision",
        f"Errors in the L2 norm at the ends of the last five branches against a run of ten times "
        f"{REFERENCE} increments (the indentations: {REFERENCE}) on the same {n} x {n} cells, "
        "against the time of the whole run. The paper's method goes up to W in equal steps, "
        "without the treatment of entering cells and turning slip; ours in equal steps of the "
        "contact radius.",
        "![work and precision](work_precision.png)",
        "\n".join(rows),
        "[All pages](README.md)",
    ]
    (folder / "work_precision.md").write_text("\n\n".join(parts) + "\n", encoding="utf-8")
    return (
        "[Work and precision](work_precision.md): error of q and p against time.\n\n"
        "![work and precision](work_precision.png)"
    )
