"""The page of wear: partial slip fully worn, late gross slip, finite elements, a measured scar."""

from __future__ import annotations

from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
import numpy as np

import pyfret as fret
from validation import mccoll
from validation.pages import DPI, percent
from validation.truth import order
from validation.worn import WornCylinder, WornSphere
from validation.worn_runs import SLID, FullyWorn, Slid, fully_worn, slid

if TYPE_CHECKING:
    from pathlib import Path

#: Amplitudes T/(mu W), and the side of the grid over the half-width of what they wear.
AMPLITUDES, EXTENT = (0.3, 0.5, 0.7, 0.875), 2.2
#: Those of the figure.
DRAWN = (0.5, 0.7)
#: Cells a side of the sphere, and along the cylinder.
CELLS = 256
#: Errors that are asked for; that of the stick zone is one cell.
ASKED = {"approach": "1 %", "p(0)": "1 %", "worn volume": "1 %", "largest depth": "2 %"}
#: Grids that have the order of a line contact, and places of the stick zone's border in the cells.
GRIDS, PLACES = (64, 128, 256, 512), 8

FULLY_WORN = (
    "W and the amplitude of T are constant, the bodies alike with nu = 0. The contact shrinks to "
    "Cattaneo's stick zone of the half-width c, which is unworn: $c/a = (1 - T/(\\mu W))^{1/3}$ "
    "under a sphere, $(1 - T/(\\mu W))^{1/2}$ under a cylinder (V. L. Popov, Sci. Rep. 4 (2014) "
    "3749). Its pressure is the sum of a Hertz contact and of a flat punch of that half-width, and "
    "what the unworn surfaces would overlap by outside is worn off."
)
CELLS_NEEDED = (
    "Under a cylinder the cell that the border of the stick zone runs through wears in part "
    "([Wear: how we know](../wear_evidence.md)). That is much: by the closed form a change of c by "
    "one part in a hundred "
    "moves the worn area by 13 of them at T = 0.3 mu W and by 6.4 at 0.5. Stick in the march "
    "is a property of whole cells. Under a sphere the border runs through its cells at all "
    "places, and its mean is known to a twentieth of one, of which the worn volume at "
    "T = 0.3 mu W, most sensitive, is off by up to 1 %. The 256 cells of a cylinder cost a second "
    "of a processor, the 256 x 256 of a sphere 16 to 30 s."
)
LATE = (
    "Once the scar is much wider than the first contact it has forgotten the elasticity: both "
    "bodies together have lost a segment or a cap of the half-width "
    "$b = (\\frac32 R k W s)^{1/3}$ (cylinder, W per length) or $(4 R k W s/\\pi)^{1/4}$ "
    "(sphere) and the depth $b^2/(2R)$, s the whole way slipped and k the sum of both bodies. The "
    "half-width follows from the parabola through the flank where it is a twentieth as deep."
)
MEASURED = (
    "A cylinder (R = 6 mm) on a flat, both bodies wearing, 18 000 cycles of gross slip: R. McColl, "
    "J. Ding, S. B. Leen, Wear 256 (2004) 1114-1127. What is known of the stroke and what is "
    "chosen: [Wear: how we know](../wear_evidence.md)."
)


def table_of_worn(found: list[FullyWorn]) -> str:
    """A row of each contact: errors of all numbers."""
    rows = [
        "| contact | T/(mu W) | cells | jumps | stick half-width | deepest in it "
        "| " + " | ".join(ASKED) + " |",
        "|---" * (6 + len(ASKED)) + "|",
        "| asked | | 256 | | 1 cell | 0 | " + " | ".join(ASKED.values()) + " |",
    ]
    for of in found:
        kind = "cylinder" if isinstance(of.truth, WornCylinder) else "sphere"
        errors = [percent(of.error(name)) if name in of.numbers else "" for name in ASKED]
        rows.append(
            f"| {kind} | {of.truth.amplitude:g} | {of.cells} | {of.jumps} | {of.stick:+.2f} cells "
            f"| {of.in_stick:.1g} | " + " | ".join(errors) + " |"
        )
    return "\n".join(rows)


def draw_worn(found: list[FullyWorn], file: Path) -> None:
    """Pressure and worn depth along y = 0 of both contacts."""
    with fret.plot.style():
        figure, axes = plt.subplots(2, 2, figsize=(9.2, 5.6), sharex=True)
        for column, kind in enumerate((WornSphere, WornCylinder)):
            for n, amplitude in enumerate(DRAWN):
                of = next(
                    f for f in found if isinstance(f.truth, kind) and f.truth.amplitude == amplitude
                )
                few = slice(None, None, max(1, of.cells // 512))
                x = np.linspace(-1.4, 1.4, 4001)
                label = f"$T = {amplitude:g}\\,\\mu W$"
                for ax, truth, ours in (
                    (axes[0, column], of.truth.p(x), of.profile.p),
                    (axes[1, column], of.truth.depth(x), of.profile.depth),
                ):
                    ax.plot(x, truth, color=f"C{n}", lw=1, label=f"closed form, {label}")
                    ax.plot(of.profile.x[few], ours[few], ".", ms=3, color=f"C{n}", label="ours")
            axes[0, column].set(
                title=("sphere", "cylinder")[column], ylim=(0, 3.2), xlim=(-1.4, 1.4)
            )
            axes[1, column].set(xlabel="$x/a$")
            axes[1, column].invert_yaxis()
        axes[0, 0].set_ylabel("$p/p_0$")
        axes[1, 0].set_ylabel("worn depth over $a^2/R$")
        axes[1, 1].legend(fontsize=7, loc="lower center")
        figure.savefig(file, dpi=DPI)
        plt.close(figure)


def table_of_grids(*, quick: bool) -> str:
    """Root mean square errors of a line contact over places of the border in the cells."""
    truth = WornCylinder(0.5)
    grids = GRIDS[:2] if quick else GRIDS
    names = ("p(0)", "worn volume", "largest depth")
    means: dict[str, list[float]] = {name: [] for name in names}
    rows = [
        "| cells | " + " | ".join(names) + " | largest of worn volume |",
        "|---" * (len(names) + 2) + "|",
    ]
    for n in grids:
        runs = [fully_worn(truth, n=n, extent=2.6 * (1 + 0.0137 * k)) for k in range(PLACES)]
        for name in names:
            means[name].append(float(np.sqrt(np.mean([of.error(name) ** 2 for of in runs]))))
        largest = max((of.error("worn volume") for of in runs), key=abs)
        shown = " | ".join(f"{100 * means[name][-1]:.2g} %" for name in names)
        rows.append(f"| {n} | {shown} | {percent(largest)} |")
    orders = " | ".join(f"{order(grids, means[name]):.1f}" for name in names)
    rows.append(f"| observed order | {orders} | |")
    return "\n".join(rows)


def table_of_slid(found: list[Slid]) -> str:
    """A row of each contact."""
    rows = [
        "| contact | cells | jumps | b/a | depth | half-width |",
        "|---|---|---|---|---|---|",
        "| asked | | | | 1 % | 1 % |",
    ]
    for of in found:
        errors = f"{percent(of.depth - 1)} | {percent(of.half_width - 1)}"
        rows.append(f"| {of.kind} | {of.cells} | {of.jumps} | {of.late:.1f} | {errors} |")
    return "\n".join(rows)


def draw_slid(found: list[Slid], file: Path) -> None:
    """Worn depth of both bodies along y = 0."""
    with fret.plot.style():
        figure, axes = plt.subplots(1, 2, figsize=(9.2, 3.0), sharey=True)
        x = np.linspace(-1.3, 1.3, 1001)
        for ax, of in zip(axes, found, strict=True):
            ax.plot(x, np.maximum(1 - x**2, 0), lw=1, label="closed form")
            few = slice(None, None, max(1, of.cells // 128))
            ax.plot(of.profile.x[few], of.profile.depth[few], ".", ms=4, label="ours")
            ax.set(title=of.kind, xlabel="$x/b$")
        axes[0].invert_yaxis()
        axes[0].set_ylabel("worn depth over $b^2/(2R)$")
        axes[0].legend(loc="upper center")
        figure.savefig(file, dpi=DPI)
        plt.close(figure)


def write(folder: Path, *, quick: bool = False) -> str:
    """Run everything, write the page; give its line of the front page."""
    worn = [
        fully_worn(truth, n=CELLS // 4 if quick else CELLS, extent=EXTENT * truth.b)
        for kind in (WornSphere, WornCylinder)
        for truth in map(kind, AMPLITUDES)
    ]
    slides = [slid(kind) for kind in SLID]
    measured = mccoll.worn()
    draw_worn(worn, folder / "wear_partial_slip.png")
    draw_slid(slides, folder / "wear_gross_slip.png")
    mccoll.profiles(measured, folder / "wear_mccoll.png")
    d = measured.dataset
    elements = [
        "| | finite elements | ours | off by | asked |",
        "|---|---|---|---|---|",
        *("| " + " | ".join(row) + " |" for row in mccoll.rows(measured)),
    ]
    parts = [
        "# Wear",
        "## Partial slip, fully worn",
        FULLY_WORN,
        "![pressure and worn depth of both contacts](wear_partial_slip.png)",
        "Errors of ours less the closed form, over the closed form:",
        table_of_worn(worn),
        CELLS_NEEDED,
        f"Line contact, T = 0.5 mu W, root mean square over {PLACES} places of the border of the "
        "stick zone within the cells, and the largest of them:",
        table_of_grids(quick=quick),
        "## Gross slip, late",
        LATE,
        "![worn depth of both contacts](wear_gross_slip.png)",
        table_of_slid(slides),
        "## Finite elements and a measured scar",
        MEASURED,
        f"{mccoll.CELLS} cells, {mccoll.OVER_FIRST} over the first contact; {d.sizes['jump']} "
        "jumps; the error of the deepest depth that they leave is estimated as "
        f"{100 * float(d.depth_error[-1]):.1f} %.",
        "![profiles of the flat](wear_mccoll.png)",
        "\n".join(elements),
        "The measured scar is rough and reaches further on one side; the model has one k for all "
        "places and times.",
        "[All pages](README.md)",
    ]
    (folder / "wear.md").write_text("\n\n".join(parts) + "\n", encoding="utf-8")
    name, error = max(
        ((name, of.error(name)) for of in worn for name in of.numbers), key=lambda at: abs(at[1])
    )
    return (
        f"| [Wear](wear.md) | {worn[0].cells} | {name}, partial slip fully worn "
        f"| {percent(error)} | | |"
    )
