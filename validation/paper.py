"""The figures of the paper beside what its text says of them.

S. Spinu, Numerical Study on the Influence of the Coating in the Fretting Contact, Tribology in
Industry 42 (2020) 131-145.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

import pyfret as fret

if TYPE_CHECKING:
    from collections.abc import Callable

    from validation.truth import Array

    Results = dict[float, fret.Result]

SCENE = Path(__file__).parents[1] / "scenes" / "coated_fretting.toml"
RATIOS = (0.5, 1.0, 2.0, 4.0)


@dataclass(frozen=True)
class Figure:
    """A figure of the paper: files drawn, and each sentence on it with our number."""

    number: int
    title: str
    files: tuple[str, ...]
    sentences: tuple[tuple[str, Callable[[Results], str]], ...]
    caption: str = ""


def scene(ratio: float, n: int) -> fret.Scene:
    """The paper's scene, fields kept at every tenth of the history."""
    settings = [
        f'title="Coated fretting, E1/E2 = {ratio:g}"',
        f"body2.coatings.0.E.E_substrate={ratio}",
        "skip.equal_layers=false",
        f"grid.n={n}",
    ]
    scene = fret.Scene.from_file(SCENE, set=settings)
    tenths = [i for i, t in enumerate(scene.path.t, start=1) if abs(10 * t - round(10 * t)) < 1e-9]
    return scene.replace(save=tenths)


def solve(n: int) -> tuple[Results, fret.Result, float]:
    """All ratios, the indentation of E1/E2 = 2 in one increment, and the time that took [s]."""
    started = time.process_time()
    results = {ratio: fret.solve(scene(ratio, n), progress=False) for ratio in RATIOS}
    path = fret.LoadPath.start().normal(results[2.0].W_max, increments=1)
    alone = results[2.0].scene.replace(path=path, save="all")
    settings = alone.settings.replace(cell_entry_correction=False, slip_rotation_correction=False)
    jump = fret.solve(alone.replace(settings=settings), progress=False)
    return results, jump, time.process_time() - started


def q_over(result: fret.Result, t: float) -> Array:
    """q_x along y = 0 over mu p_H."""
    at = result.at(t)
    q: Array = at.along_x().q_x.values / (at.mu * at.p_H)
    return q


def outwards(result: fret.Result) -> float:
    """Mean outward shear on the coated body after the indentation, over mu p_H."""
    at = result.at(0.1)
    x, y = at.x.values[:, None], at.y.values[None, :]
    q_r = (at.q_x.values * x + at.q_y.values * y) / np.hypot(x, y)
    return float(q_r[at.contact.values].mean() / (at.mu * at.p_H))


def stick_middle(result: fret.Result, t: float) -> float:
    """Midway between the ends of the stick zone along y = 0 [a_H]."""
    at = result.at(t)
    stuck = at.x.values[at.stick.values[:, at.y.size // 2]]
    return float((stuck[0] + stuck[-1]) / 2 / at.a_H)


def largest_mises(result: fret.Result) -> tuple[float, float, float]:
    """Largest von Mises stress at the end over p_H, its place along x and depth [a_H]."""
    z = np.union1d(np.linspace(0.0, 2.0, 128), 1.0) * result.a_H
    largest = result.at(1.0).stress(z, y=0.0).maximum("von_mises")
    return largest.value / result.p_H, largest.x / result.a_H, largest.z / result.a_H


def history_left_out(results: Results) -> str:
    """Shear after the indentation, with and without the history."""
    with_history = np.abs(q_over(results[2.0], 0.1)).max()
    return f"largest $\\lvert q_1 \\rvert/(\\mu p_H)$ with the history {with_history:.3f}"


def similar(results: Results) -> str:
    """Shear after the indentation of similar bodies."""
    largest = np.abs(q_over(results[1.0], 0.1)).max()
    return f"largest $\\lvert q_1 \\rvert/(\\mu p_H)$ of ours {largest:.1e}"


def cycles(results: Results) -> str:
    """Change of the shear from one cycle to the next."""
    parts = []
    for ratio, result in results.items():
        last, before = q_over(result, 1.0), q_over(result, 0.6)
        change = np.linalg.norm(last - before) / np.linalg.norm(last)
        parts.append(f"{100 * change:.2g} % ({ratio:g})")
    return "$q_1$ at $\\tau$ against $0.6\\,\\tau$ in the L2 norm: " + ", ".join(parts)


def directions(results: Results) -> str:
    """Radial shear after the indentation."""
    return ", ".join(
        f"mean $q_r/(\\mu p_H)$ on the coated body {outwards(results[r]):+.4f} for {r:g}"
        for r in (0.5, 2.0)
    )


def balanced(results: Results) -> str:
    """Resultant of the shear after the indentation."""
    parts = []
    for ratio in (0.5, 2.0):
        at = results[ratio].at(0.1)
        force = float(at.q_x.values.sum() / np.abs(at.q_x.values).sum())
        parts.append(f"{force:.1e} ({ratio:g})")
    return "sum of $q_1$ over the sum of $\\lvert q_1 \\rvert$: " + ", ".join(parts)


def during_indentation(results: Results) -> str:
    """Stick ratio at the end of the indentation."""
    return "stick ratio at $0.1\\,\\tau$: " + ", ".join(
        f"{float(result.at(0.1).stick_ratio):.3f} ({ratio:g})" for ratio, result in results.items()
    )


def at_reversal(results: Results) -> str:
    """Stick ratio right after a reversal, and at the end."""
    parts = []
    for ratio, result in results.items():
        of = result.dataset.branch_of_increment.values
        first = int(np.flatnonzero(of == of.max())[0])
        stick = result.dataset.stick_ratio.values
        parts.append(f"{stick[first]:.3f}, {stick[-1]:.3f} ({ratio:g})")
    return "stick ratio one increment after the last reversal, at the end: " + "; ".join(parts)


def superposed(results: Results) -> str:
    """Energies of the two loops."""
    parts = []
    for ratio, result in results.items():
        energy = result.loops().dissipated.values
        parts.append(f"{100 * abs(energy[-1] / energy[-2] - 1):.2g} % ({ratio:g})")
    return "energies of the two loops differ by " + ", ".join(parts)


def compliance(results: Results) -> str:
    """Shift at the end."""
    return "$\\delta_1$ at $\\tau$ [µm]: " + ", ".join(
        f"{1e6 * float(result.delta_x[-1]):.4f} ({ratio:g})" for ratio, result in results.items()
    )


def largest_at(ratio: float) -> Callable[[Results], str]:
    """Where the largest von Mises stress is."""

    def said(results: Results) -> str:
        value, x, z = largest_mises(results[ratio])
        return f"{value:.4f} $p_H$ at $x_1 = {x:.3f}\\,a_H$, $x_3 = {z:.3f}\\,a_H$"

    return said


#: Middle of the stick zone at 0.2 tau [a_H], of the sketch that the method was tried in.
MIDDLES = {0.5: -0.066, 2.0: 0.084, 4.0: 0.169}


def moved(results: Results) -> str:
    """The middle of the stick zone under the largest force, forth and back."""
    parts = [
        f"{stick_middle(results[ratio], 0.2):+.3f} (sketch {middle:+.3f}), "
        f"{stick_middle(results[ratio], 0.4):+.3f}, {stick_middle(results[ratio], 1.0):+.3f} "
        f"({ratio:g})"
        for ratio, middle in MIDDLES.items()
    ]
    return (
        "midway between the ends of the stick zone on $x_1$ at $0.2\\,\\tau$, $0.4\\,\\tau$, "
        "$\\tau$ [$a_H$]: " + "; ".join(parts)
    )


FIGURES = (
    Figure(
        5,
        "Shear with and without the loading history",
        ("figure_05.png",),
        (
            (
                "The state after the indentation needs the loading history and the tangential "
                "effects; left out, the shear is another.",
                history_left_out,
            ),
        ),
        "The one increment is solved with `cell_entry_correction = false` and "
        "`slip_rotation_correction = false`: each cell then "
        "begins to stick at the end of the load, wherever it came into contact. By default the "
        "solver follows the history within an increment, and one increment has the shear of 100. "
        "The peaks of one increment in (b) lie where slip begins; between the middles of the cells "
        "the curves are straight.",
    ),
    Figure(
        6,
        "Similar bodies, with a coating of the substrate's material",
        ("figure_06.png",),
        (
            (
                "Equal coefficients of both bodies would leave no shear after the indentation; the "
                "paper's conversion leaves some numerical oscillations.",
                similar,
            ),
        ),
    ),
    Figure(
        7,
        "Shear profiles",
        ("figure_07a.png", "figure_07b.png", "figure_07c.png"),
        (
            (
                "Corresponding states of the first cycles differ a little; the cycle settles after "
                "the first one.",
                cycles,
            ),
        ),
    ),
    Figure(
        8,
        "Streamlines of the shear after the indentation",
        ("figure_08.png",),
        (
            (
                "The shear points outwards on the more compliant body and inwards on the stiffer "
                "one.",
                directions,
            ),
            ("It balances itself in any radial direction.", balanced),
        ),
    ),
    Figure(
        9,
        "Streamlines of the last stroke, E1/E2 = 0.5",
        ("figure_09.png",),
        (("The stick zone moves towards negative $x_1$ for $E_1/E_2 < 1$.", moved),),
    ),
    Figure(
        10,
        "Streamlines of the last stroke, E1/E2 = 2",
        ("figure_10.png",),
        (("The stick zone moves the opposite way for $E_1/E_2 > 1$.", moved),),
    ),
    Figure(
        11,
        "Stick ratio",
        ("figure_11.png",),
        (
            ("There is slip during the indentation.", during_indentation),
            ("Instantaneous stick sets in when the force turns.", at_reversal),
        ),
    ),
    Figure(
        12,
        "Fretting loops",
        ("figure_12.png",),
        (
            ("The two loops lie on each other.", superposed),
            ("A more compliant coating shifts further.", compliance),
        ),
    ),
    Figure(
        13,
        "Von Mises stress at the end",
        ("figure_13.png",),
        (
            ("Largest in the coating for $E_1/E_2 = 0.5$.", largest_at(0.5)),
            ("On the free surface for $E_1/E_2 = 2$.", largest_at(2.0)),
            (
                "At the interface, $x_3 = a_H$, for $E_1/E_2 = 4$.",
                largest_at(4.0),
            ),
        ),
    ),
)


def write(folder: Path, *, n: int) -> list[str]:
    """Solve, draw and write the pages; give their lines of the front page."""
    results, jump, seconds = solve(n)
    fret.plot.paper_figures(results, folder, jump=jump)
    (folder / "figure_04.png").unlink()
    rows = []
    for figure in FIGURES:
        name = f"figure_{figure.number:02d}"
        parts = [
            f"# Figure {figure.number} of the paper: {figure.title}",
            f"Four runs of 1000 increments on {n} x {n} cells, E1/E2 = 0.5, 1, 2, 4 (in brackets), "
            f"and one of a single increment: {seconds:.0f} s of a processor in all.",
            *(f"![figure {figure.number}]({file})" for file in figure.files),
            *([figure.caption] if figure.caption else []),
            "\n".join(
                ["| the paper | ours |", "|---|---|"]
                + [f"| {said} | {ours(results)} |" for said, ours in figure.sentences]
            ),
            "## Scene",
            f"```toml\n{results[2.0].scene.to_toml().strip()}\n```",
            "[All pages](README.md)",
        ]
        (folder / f"{name}.md").write_text("\n\n".join(parts) + "\n", encoding="utf-8")
        first_said, first_ours = figure.sentences[0]
        rows.append(
            f"| [Figure {figure.number}: {figure.title}]({name}.md) | {first_said} "
            f"| {first_ours(results)} |"
        )
    return rows
