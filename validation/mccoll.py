"""The scar of R. McColl, J. Ding, S. B. Leen, Wear 256 (2004) 1114-1127, and elements of it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import matplotlib.pyplot as plt
import numpy as np

import pyfret as fret
from validation.pages import DPI, percent

if TYPE_CHECKING:
    from validation.truth import Array

DATA = Path(__file__).parents[1] / "tests" / "data" / "wear"
STEEL = fret.Elastic(E=200e9, nu=0.3)
#: Cells along the contact, and those of them over the first one, 0.072 mm wide.
CELLS, OVER_FIRST = 640, 64
#: Depth of the flat by finite elements [um] after so many cycles.
DEPTHS = {1000: 0.378, 5000: 1.131, 10000: 1.815, 18000: 2.713}
#: Worn area of the flat [mm^2] and ends of the scar [mm] by finite elements.
AREA, END = 9.38e-4, 0.26


def worn() -> fret.wear.WearResult:
    """Wear both bodies over 18 000 cycles, as scenes/wear_mccoll.toml."""
    path = fret.LoadPath.start().normal(18.5e3, increments=1)
    for to, increments in ((25e-6, 1), (-25e-6, 10), (25e-6, 10)):
        path = path.displace(delta_x=to, increments=increments)
    return fret.wear.solve(
        fret.Scene(
            body1=fret.Body(STEEL, shape=fret.Cylinder(R=6e-3)),
            body2=fret.Body(STEEL),
            friction=0.9,
            grid=fret.Grid.strip(extent=0.72e-3, n=CELLS),
        ),
        path=path,
        cycles=18000,
        first_branch=2,
        cycling="sliding",
        rig_stiffness=24.6e9,
        body1=fret.wear.Archard(1.9e-14),
        body2=fret.wear.Archard(2.9e-14),
        progress=False,
    )


class Row(NamedTuple):
    """A number of the finite elements, ours, and what is asked for."""

    name: str
    elements: str
    ours: str
    off: str
    asked: str


def rows(result: fret.wear.WearResult) -> list[Row]:
    """Depths of the flat, its worn area and the ends of its scar."""
    d = result.dataset
    found = []
    for cycles, truth in DEPTHS.items():
        depth = 1e6 * float(np.interp(cycles, d.cycles, d.depth2))
        name = f"depth after {cycles} cycles"
        found.append(Row(name, f"{truth} um", f"{depth:.3f} um", percent(depth / truth - 1), "3 %"))
    worn, x = d.worn2[-1, :, 0].values, 1e3 * d.x.values
    area = 1e3 * float(worn.sum()) * (x[1] - x[0])
    found.append(
        Row("worn area", f"{AREA} mm^2", f"{area:.3g} mm^2", percent(area / AREA - 1), "2 %")
    )
    scar = x[worn > 1e-9]
    ends = f"{scar[0]:.3f} to {scar[-1]:.3f} mm"
    off = max(abs(scar[0] + END), abs(scar[-1] - END))
    found.append(Row("scar", f"{-END} to {END} mm", ends, f"{off:.3f} mm", "0.02 mm"))
    return found


def profiles(result: fret.wear.WearResult, file: Path) -> None:
    """Draw ours, the finite elements and the measured scar."""
    elements = np.loadtxt(DATA / "mccoll_finite_elements.csv", delimiter=",", skiprows=1)
    measured = np.loadtxt(DATA / "mccoll_measured.csv", delimiter=",", skiprows=1)
    d = result.dataset
    with fret.plot.style():
        figure, ax = plt.subplots(figsize=(7.2, 3.6))
        ax.plot(*measured.T, color="0.7", label="measured, 18 000 cycles")
        for n, cycles in enumerate((1000, 18000)):
            at = elements[elements[:, 0] == cycles]
            block = int(np.abs(d.block_cycles.values - cycles).argmin())
            ours: Array = 1e6 * d.worn2[block, :, 0].values
            after = f"{float(d.block_cycles[block]):.0f} cycles"
            ax.plot(1e3 * d.x, ours, color=f"C{n}", label=f"ours, {after}")
            ax.plot(at[:, 1], at[:, 2], "o", ms=4, color=f"C{n}", label=f"elements, {cycles}")
        ax.set(xlim=(-0.36, 0.36), xlabel="$x$ [mm]", ylabel="depth of the flat [µm]")
        ax.invert_yaxis()
        ax.legend(fontsize=8, loc="center left", bbox_to_anchor=(1.0, 0.5))
        figure.savefig(file, dpi=DPI)
        plt.close(figure)
