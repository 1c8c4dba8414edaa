"""A coated fretting line contact beside finite elements: pressure, shear, stick limits, cost.

The runs of CalculiX are kept in ``coated_line.json``, which `make bench-fe` writes, so that the
page needs no CalculiX.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import matplotlib.pyplot as plt
import numpy as np

import pyfret as fret
from validation.calculix import BRANCHES, MU, NU, THICKNESS, A, E, R, Tractions, W
from validation.pages import DPI

if TYPE_CHECKING:
    from validation.truth import Array

#: Runs of CalculiX and of pyfret.
KEPT = Path(__file__).with_suffix(".json")
#: Side of the grid [A].
WIDTH = 2.6
#: Cells, increments of the pressing and of half a branch of the reference.
FINEST = (1024, 512, 48)
#: Error of the shear at which the processor times are compared.
EQUAL = 0.02
#: Part of the contact in which the tractions are compared: nodes at the rim carry means.
INNER = 0.9
#: A point sticks if its shear is below this part of the friction limit.
STUCK = 0.995


class Errors(NamedTuple):
    """Errors of a run against the reference, tractions over those of the reference."""

    #: Pressure after the pressing, L2 over the inner part of the contact.
    p: float
    #: Shear at the end of the worst branch, likewise.
    q: float
    #: Ends of the stick zone at the end of the worst branch, over A.
    stick: float


def line(ratio: float, cells: int, press: int | str, branch: int | None) -> fret.Scene:
    """Return the scene; the first branch has `branch` increments, the others twice as many."""
    steel = fret.Elastic(E=1e6 * E, nu=NU)
    film = fret.Coating(fret.Elastic(E=1e6 * ratio * E, nu=NU), thickness=1e-3 * THICKNESS)
    force = 1e3 * W
    forces = [share * MU * force for share in BRANCHES]
    path = fret.LoadPath.start().normal(force, increments=press)  # type: ignore[arg-type]
    if branch is None:
        path = path.tangential(forces)
    else:
        # The increments are shared out in proportion to the change of the force: 1, 2, 2.
        path = path.tangential(forces, increments=5 * branch)
    return fret.Scene(
        body1=fret.Body(steel, shape=fret.Cylinder(R=1e-3 * R)),
        body2=fret.Body(steel, coatings=[film]),
        friction=MU,
        grid=fret.Grid.strip(extent=1e-3 * WIDTH * A, n=cells),
        path=path,
    )


def solve(ratio: float, cells: int, press: int | str, branch: int | None) -> list[Tractions]:
    """Return the tractions after the pressing and after each branch."""
    result = fret.solve(line(ratio, cells, press, branch), progress=False)
    return tractions(result)


def tractions(result: fret.Result) -> list[Tractions]:
    """Return the tractions at the ends of the branches [mm, MPa]."""
    data = result.dataset
    x = 1e3 * data.x.values
    return [
        Tractions(x, 1e-6 * data.p.values[n].ravel(), 1e-6 * data.q_x.values[n].ravel())
        for n in range(data.sizes["saved"])
    ]


def stick_limits(step: Tractions) -> tuple[float, float]:
    """Return the ends of the stick zone [mm], continued from its points.

    Near an end the shear that friction leaves, mu p - |q|, falls as the root of the distance, so
    that a straight line through its square at the last two stuck points has its zero at the end.
    """
    left = np.where(step.p > 0.0, MU * step.p - np.abs(step.q), 0.0)
    stuck = np.flatnonzero((step.p > 0.0) & (np.abs(step.q) < STUCK * MU * step.p))
    if stuck.size < 4:
        # Ends half a cell beyond the stuck points; the middle of the contact without any.
        half = 0.5 * abs(step.x[1] - step.x[0])
        points = step.x[stuck] if stuck.size else np.array([half, -half])
        return float(points.min() - half), float(points.max() + half)
    ends = []
    for k, inner in ((stuck[0], stuck[0] + 1), (stuck[-1], stuck[-1] - 1)):
        near, far = left[k] ** 2, left[inner] ** 2
        slope = (far - near) / (step.x[inner] - step.x[k])
        beyond = 0.0 if slope == 0.0 else near / slope
        size = abs(step.x[inner] - step.x[k])
        ends.append(float(step.x[k] - np.clip(beyond, -size, size)))
    return ends[0], ends[1]


def on_cells(reference: Tractions, x: Array) -> Tractions:
    """Return tractions of a fine grid between its cells."""
    p, q = (np.interp(x, reference.x, values) for values in (reference.p, reference.q))
    return Tractions(x, p, q)


def aligned(steps: list[Tractions], sign: float) -> list[Tractions]:
    """Return tractions with pressure and the shear of the first branch positive."""
    return [Tractions(step.x, np.abs(step.p), sign * step.q) for step in steps]


def errors(steps: list[Tractions], reference: list[Tractions]) -> Errors:
    """Return the errors of tractions at the ends of branches."""
    pressed = reference[0].x[reference[0].p > 0.0]
    inner = INNER * float(np.abs(pressed).max())

    def distance(ours: Array, truth: Array, x: Array) -> float:
        near = np.abs(x) < inner
        return float(np.linalg.norm((ours - truth)[near]) / np.linalg.norm(truth[near]))

    truths = [on_cells(of, step.x) for of, step in zip(reference, steps, strict=True)]
    pairs = list(zip(steps, truths, strict=True))
    ends = list(zip(steps[1:], reference[1:], strict=True))
    stick = [
        max(abs(a - b) for a, b in zip(stick_limits(step), stick_limits(truth), strict=True)) / A
        for step, truth in ends
    ]
    return Errors(
        distance(steps[0].p, truths[0].p, steps[0].x),
        max(distance(step.q, truth.q, step.x) for step, truth in pairs[1:]),
        max(stick),
    )


def of_elements(row: dict[str, Any]) -> list[Tractions]:
    """Return the tractions of a kept run of CalculiX, signs as ours."""
    steps = [Tractions(*(np.array(step[key]) for key in "xpq")) for step in row["steps"]]
    return aligned(steps, float(np.sign(steps[1].q.sum())))


def equal_time(rows: list[tuple[float, float]]) -> float:
    """Return the time at the error `EQUAL` of the cheapest run that is as good."""
    good = [seconds for error, seconds in rows if error <= EQUAL]
    return min(good) if good else float("nan")


def write(folder: Path, *, quick: bool = False) -> str:
    """Write the page from the kept runs; give its line of the front page."""
    kept = json.loads(KEPT.read_text())
    cells, press, branch = (256, 64, 12) if quick else FINEST
    references = {
        ratio: solve(ratio, cells, press, branch)
        for ratio in {row["ratio"] for row in kept["ours"] + kept["elements"]}
    }
    theirs = [
        (row, of_elements(row), errors(of_elements(row), references[row["ratio"]]))
        for row in sorted(kept["elements"], key=order)
    ]
    ours = []
    for row in kept["ours"]:
        steps = [Tractions(*(np.array(step[key]) for key in "xpq")) for step in row["steps"]]
        ours.append((row, steps, errors(steps, references[row["ratio"]])))
    draw(folder / "coated_line.png", references[2.0], theirs, ours)
    coated = [item for item in theirs if item[0]["ratio"] != 1.0]
    chosen = [item for item in ours if item[0]["ratio"] != 1.0 and item[0]["press"] == "auto"]
    cost = compare_costs(coated, chosen)
    parts = [
        "# A coated fretting line contact by finite elements",
        f"A cylinder of R = {R:g} mm on a flat, plane strain, both of steel (E = {E / 1e3:g} GPa, "
        f"nu = {NU:g}), mu = {MU:g}. The film is {THICKNESS:g} mm thick. W = {W:.3g} N/mm gives "
        f"a = {A:g} mm without the film. After the pressing T goes to 0.9, -0.9 and 0.9 mu W. "
        "CalculiX 2.20 solved it with two blocks of elements CPE4 (`make bench-fe`). Their far "
        f"faces are 60 a away. The runs of CalculiX are kept in `{KEPT.name}`, so that this page "
        "needs no CalculiX.",
        "![shear by both programs](coated_line.png)",
        f"Errors are differences from {cells} cells with {press} and {5 * branch} increments: L2 "
        f"norms over those of the reference in the inner {INNER:g} of the contact, since nodes of "
        "elements at the rim carry means. Errors of the ends of the stick zone are over a. The "
        "worst end of a branch counts. q_max after the pressing has its printed error where "
        "increments are given.",
        table(theirs, ours),
        f"{cost.text} The time of pyfret is the median of five solutions in one process, kernels "
        "included, on one thread. Start and imports of Python take 0.5 s more.",
        *explanation(references, theirs, ours),
        "[All pages](README.md)",
    ]
    (folder / "coated_line.md").write_text("\n\n".join(parts) + "\n", encoding="utf-8")
    return (
        "[A coated fretting line contact by finite elements](coated_line.md): in less than "
        f"1/{cost.ratio:.0f} of the processor time of CalculiX at an error of the shear of "
        f"{cost.error:.2g} %."
    )


class Cost(NamedTuple):
    """Processor times at an equal error [%], as a ratio and as text."""

    error: float
    ratio: float
    text: str


def compare_costs(theirs: list[Any], ours: list[Any]) -> Cost:
    """Compare the cheapest runs with an error of the shear of `EQUAL` or less.

    Where no run of CalculiX is as good, its best one counts. Its error is larger then, so that the
    ratio at an equal error is larger than the one given.
    """
    slow = equal_time([(error.q, row["seconds"]) for row, _, error in theirs])
    fast = equal_time([(error.q, row["seconds"]) for row, _, error in ours])
    reached = f"At an error of the shear of {EQUAL:.0%} or less pyfret takes {1e3 * fast:.2g} ms"
    if np.isfinite(slow):
        text = (
            f"{reached} of processor time, CalculiX {slow:.3g} s: a ratio of 1/{slow / fast:.0f}."
        )
        return Cost(100.0 * EQUAL, slow / fast, text)
    best_row, _, best = min(theirs, key=lambda item: item[2].q)
    slow = best_row["seconds"]
    text = (
        f"{reached} of processor time. No run of CalculiX is as good: the best one has "
        f"{100 * best.q:.2g} % and takes {slow:.3g} s, a ratio of 1/{slow / fast:.0f} at least."
    )
    return Cost(100.0 * EQUAL, slow / fast, text)


def order(row: dict[str, Any]) -> tuple[float, ...]:
    """Return the place of a run of CalculiX in the table."""
    return tuple(float(row[key]) for key in ("ratio", "cells", "press", "branch", "stick"))


def table(theirs: list[Any], ours: list[Any]) -> str:
    """Return the table of all runs."""
    heads = ["run", "E1/E2", "p", "q", "stick limits [a]", "q_max after pressing [MPa]"]
    heads += ["processor time", "memory"]
    lines = ["| " + " | ".join(heads) + " |", "|---" * len(heads) + "|"]
    for row, steps, error in theirs:
        name = (
            f"CalculiX, a/{row['cells']}, {row['press']} + {5 * row['branch']} increments, stick "
            f"{row['stick']:.2g} N/mm^3"
        )
        lines.append(line_of_table(name, row, steps, error))
    for row, steps, error in ours:
        count = (
            f"{row['increments']} chosen increments"
            if row["press"] == "auto"
            else f"{row['press']} + {5 * row['branch']} increments"
        )
        lines.append(line_of_table(f"pyfret, {row['cells']} cells, {count}", row, steps, error))
    return "\n".join(lines)


def line_of_table(name: str, row: dict[str, Any], steps: list[Tractions], error: Errors) -> str:
    """Return the line of a run."""
    known = f" +- {row['q_error']:.1f}" if "q_error" in row else ""
    cells = [
        name,
        f"{row['ratio']:g}",
        *(f"{100 * part:.2g} %" for part in error),
        f"{largest(steps[0]):.1f}{known}",
        f"{row['seconds']:.3g} s",
        f"{row['memory'] / 1e6:.0f} MB",
    ]
    return "| " + " | ".join(cells) + " |"


def largest(step: Tractions) -> float:
    """Return the largest shear [MPa]."""
    return float(np.abs(step.q).max())


def explanation(
    references: dict[float, list[Tractions]], theirs: list[Any], ours: list[Any]
) -> list[str]:
    """Return the paragraphs that explain the differences."""

    def elements(**numbers: float) -> Any:
        wanted = {"ratio": 2.0, "branch": 12, "stick": 5e7} | numbers
        for item in theirs:
            if all(item[0][key] == value for key, value in wanted.items()):
                return item
        return None

    parts = ["## Where the differences come from"]
    soft, usual, hard = (elements(cells=10, press=8, stick=s) for s in (1e7, 5e7, 2.5e8))
    if soft and usual and hard:
        parts.append(
            "*Stick stiffness.* CalculiX lets stuck points slide elastically: by q over the stick "
            "stiffness. The slip of the contact is of the order mu p_0 a/E* = "
            f"{1e6 * MU * 4.0 * W * (1.0 - NU**2) / (np.pi * E):.0f} nm. A shear of 100 MPa over "
            "5e7 N/mm^3 is an elastic slip of 2 nm, 1.3 % of it. With 1e7, 5e7 and 2.5e8 N/mm^3 "
            f"the shear on a/10 differs by {100 * soft[2].q:.2g}, {100 * usual[2].q:.2g} and "
            f"{100 * hard[2].q:.2g} %. A soft stick lowers the shear in the stick zone, a stiff "
            "one makes it ragged from node to node."
        )
    meshes = [elements(cells=n, press=p) for n, p in ((5, 8), (10, 8), (20, 32))]
    meshes = [item for item in meshes if item]
    if meshes:
        shown = ", ".join(f"{100 * item[2].q:.2g} % (a/{item[0]['cells']})" for item in meshes)
        parts.append(
            f"*Mesh.* The shear differs by {shown}. It has its largest value at the border of the "
            "stick zone, with a vertical tangent. Linear elements round this peak off."
        )
    fine = elements(cells=10, press=8, branch=48)
    if fine and usual:
        parts.append(
            "*Increments of the branches.* Four times as many change the difference from "
            f"{100 * usual[2].q:.2g} to {100 * fine[2].q:.2g} %."
        )
    few, many = elements(cells=10, press=8), elements(cells=10, press=32)
    truth = largest(references[2.0][0])
    if few and many:
        by_press = {row["press"]: (row, steps) for row, steps, _ in ours if row["press"] != "auto"}
        printed = [
            f"{largest(steps[0]):.1f} +- {row['q_error']:.1f} MPa ({n})"
            for n, (row, steps) in by_press.items()
        ]
        parts.append(
            "*Shear after the pressing alone.* The film is stiffer than the flat, so that pressing "
            "shears the surface. A point that comes into contact within an increment sticks where "
            "the increment began. Each increment so leaves a ring of points with too much shear. "
            f"CalculiX has a largest shear of {largest(few[1][0]):.1f} MPa with 8 increments and "
            f"{largest(many[1][0]):.1f} MPa with 32; the converged one is {truth:.1f} MPa. "
            f"pyfret has {', '.join(printed)}, each with its printed error (`error=True`). "
            "The branches of shear slide over most of these rings: at their ends both programs "
            "agree as in the table."
        )
    parts.append(
        "*Similar bodies* (E1/E2 = 1) have no shear after the pressing, and the closed form of "
        "Cattaneo and Mindlin. What CalculiX has there comes from its penalties and its mesh alone."
    )
    return parts


def draw(file: Path, reference: list[Tractions], theirs: list[Any], ours: list[Any]) -> None:
    """Draw the shear after the pressing and the first branch, and the errors against the time."""
    coated = [item for item in theirs if item[0]["ratio"] != 1.0]
    chosen = [item for item in ours if item[0]["ratio"] != 1.0 and item[0]["press"] == "auto"]
    best = min(coated, key=lambda item: item[2].q)
    with fret.plot.style():
        figure, axes = plt.subplots(1, 3, figsize=(11.5, 3.3))
        for ax, n, title in zip(
            axes[:2], (0, 1), ("after the pressing", "at T = 0.9 mu W"), strict=True
        ):
            ax.plot(reference[n].x / A, reference[n].q, label="pyfret")
            step = best[1][n]
            ax.plot(step.x / A, step.q, "o", ms=3, label=f"CalculiX, a/{best[0]['cells']}")
            ax.set(xlabel="x [a]", ylabel="q [MPa]", title=title, xlim=(-1.15, 1.15))
        axes[0].legend()
        for name, items, mark in (("CalculiX", coated, "o"), ("pyfret", chosen, "s")):
            times = [row["seconds"] for row, *_ in items]
            axes[2].loglog(times, [error.q for *_, error in items], mark, label=name)
        axes[2].set(xlabel="processor time [s]", ylabel="error of q", title="ends of branches")
        axes[2].legend()
        figure.savefig(file, dpi=DPI)
        plt.close(figure)
