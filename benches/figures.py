"""Work-precision figures: error against time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, NullFormatter

import pyfret as fret

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    Row = dict[str, Any]

COLOURS = {
    "pyfret": "C3",
    "pyfret, spinu2020": "C1",
    "Tamaas": "C0",
    "ContactMechanics": "C2",
}

#: Programs of the fretting part as its legend calls them.
NAMES = {"pyfret": "pyfret", "spinu2020": "pyfret, spinu2020"}


def of(rows: Sequence[Row], **wanted: Any) -> list[Row]:
    """The rows measured with these values."""
    return [
        row
        for row in rows
        if "missing" not in row and all(row.get(k) == v for k, v in wanted.items())
    ]


def frictionless(grids: Sequence[Row], ladder: Sequence[Row], file: Path) -> None:
    """Error of Hertz's pressure over the grids; residual of the waves over the tolerances."""
    with fret.plot.style():
        figure, (left, right) = plt.subplots(1, 2, figsize=(9.6, 4.2), layout="constrained")
        for program, colour in COLOURS.items():
            line = of(grids, program=program)
            x = [row["set_up_s"] + row["solve_s"] for row in line]
            y = [row["error_p"] for row in line]
            left.loglog(x, y, "o-", color=colour, label=program)
            # The curves run in pairs: those at the border of the picture say the grids.
            if program in ("pyfret", "ContactMechanics"):
                side = -1 if program == "pyfret" else 1
                for row, at, error in zip(line, x, y, strict=True):
                    left.annotate(
                        str(row["cells"]),
                        (at, error),
                        xytext=(6 * side, 3 * side),
                        textcoords="offset points",
                        size=7,
                        ha="right" if side < 0 else "left",
                        va="center",
                    )
            line = of(ladder, program=program)
            x = [row["solve_s"] for row in line]
            right.loglog(x, [row["residual"] for row in line], "o-", color=colour, label=program)
        cells = {row["cells"] for row in of(ladder)}
        size = " x ".join(2 * [str(max(cells))]) if cells else ""
        left.margins(x=0.1)
        left.set_title("Hertz contact, grids of n x n cells", size=10)
        left.set_ylabel("error of p against the closed form (L2)")
        right.set_title(f"Sphere with waves, {size} cells", size=10)
        right.set_ylabel("residual: gap or overlap over the approach")
        left.set_xlabel("time of set-up and solution [s]")
        right.set_xlabel("time of the solution [s]")
        figure.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=4)
        figure.savefig(file, dpi=120)
        plt.close(figure)


def fretting(rows: Sequence[Row], file: Path) -> None:
    """Error of the shear against time, one panel per coating."""
    ratios = sorted({row["ratio"] for row in rows})
    with fret.plot.style():
        figure, panels = plt.subplots(
            1,
            len(ratios),
            figsize=(max(5.0, 3.6 * len(ratios)), 4.2),
            layout="constrained",
            sharey=True,
            squeeze=False,
        )
        labels: dict[tuple[str, int, int], Any] = {}
        for axes, ratio in zip(panels[0], ratios, strict=True):
            mine = of(rows, ratio=ratio)
            groups = sorted({(row["cells"], row["increments"], row["program"]) for row in mine})
            for cells, increments, program in groups:
                line = of(mine, cells=cells, increments=increments, program=program)
                x = [row["seconds"] for row in line]
                plain = program != "pyfret"
                shade = {64: 0.35, 128: 0.65, 256: 1.0}.get(cells, 0.35)
                (drawn,) = axes.loglog(
                    x,
                    [row["error_q"] for row in line],
                    "s" if plain else "o",
                    linestyle="-" if increments == 1000 else "--",
                    color="C1" if plain else "C3",
                    alpha=shade,
                )
                labels[program, cells, int(increments)] = drawn
            axes.set_title(f"$E_1/E_2 = {ratio:g}$", size=10)
            # Labels within a decade would run into each other.
            axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 3.0)))
            axes.xaxis.set_major_formatter("{x:g}")
            axes.xaxis.set_minor_formatter(NullFormatter())
            axes.set_xlabel("time [s]")
        panels[0][0].set_ylabel("error of q (L2), largest of the branch ends")
        # A column for each program, from the coarsest grid on; the shorter one ends with blanks.
        programs = sorted({program for program, _, _ in labels})
        columns = [sorted(key for key in labels if key[0] == program) for program in programs]
        lines, names = [], []
        for column in columns:
            blanks = max(map(len, columns)) - len(column)
            lines += [*(labels[key] for key in column), *([Line2D([], [], ls="none")] * blanks)]
            names += [f"{NAMES[of]}, {n} x {n}, {k} increments" for of, n, k in column]
            names += [""] * blanks
        figure.legend(lines, names, loc="outside lower center", ncols=len(columns))
        figure.savefig(file, dpi=120)
        plt.close(figure)
