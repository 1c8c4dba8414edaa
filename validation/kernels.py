"""The kernels beside tables of them computed with many digits."""

from __future__ import annotations

import json
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

import matplotlib.pyplot as plt
import numpy as np

import pyfret as fret
from validation.pages import DPI

#: The colour of each number of layers, the same in all panels.
LAYER_COLOURS = {0: "C3", 1: "C0", 2: "C1", 3: "C2", 5: "C4"}

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    Entry = dict[str, Any]
    #: Number of layers above the substrate, and the error of the entry.
    Errors = Iterator[tuple[int, float]]

TABLES = Path(__file__).parents[1] / "tests" / "data"


def body(entry: Entry) -> fret.Body:
    """The layered body of an entry."""
    substrate = fret.Elastic(**entry["substrate"])
    coatings = [
        fret.Coating(fret.Elastic(E=layer["E"], nu=layer["nu"]), thickness=layer["h"])
        for layer in entry["layers"]
    ]
    return fret.Body(substrate, coatings=coatings)


def responses(entries: list[Entry]) -> Errors:
    """Surface displacement under waves of traction, over the largest of an entry."""
    for entry in (entry for entry in entries if entry["x3"] == 0):
        truth = np.array(entry["u_re"]) + 1j * np.array(entry["u_im"])
        ours = fret.kernels.surface_frf(body(entry), entry["m"], entry["n"])
        yield len(entry["layers"]), float(np.abs(ours - truth).max() / np.abs(truth).max())


def coefficients(entries: list[Entry]) -> Errors:
    """Surface displacement under one loaded cell, over that of the cell itself under pressure."""
    groups: dict[str, list[Entry]] = {}
    for entry in entries:
        key = json.dumps([entry[k] for k in ("layers", "substrate", "d1", "d2")])
        groups.setdefault(key, []).append(entry)
    for group in groups.values():
        nx, ny = (max(abs(entry[k]) for entry in group) + 1 for k in ("i", "j"))
        first = group[0]
        grid = fret.Grid.from_spacing((nx, ny), (first["d1"], first["d2"]))
        C = fret.kernels.influence_coefficients(body(first), grid)
        for entry in group:
            ours = C[:, :, nx - 1 + entry["i"], ny - 1 + entry["j"]]
            error = np.abs(ours - np.array(entry["C"])).max() / entry["self_C33"]
            yield len(entry["layers"]), float(error)


def stresses(entries: list[Entry]) -> Errors:
    """Stress below one loaded cell, over the largest component of an entry."""
    for entry in entries:
        truth = np.array(entry["s"])
        ours = fret.kernels.stress_at(
            body(entry),
            (entry["d1"], entry["d2"]),
            (entry["x1"], entry["x2"], entry["x3"]),
            layer=entry["layer_index"],
        )
        yield len(entry["layers"]), float(np.abs(ours - truth).max() / np.abs(truth).max())


#: Name, table and errors of every kernel.
KERNELS: tuple[tuple[str, str, Callable[[list[Entry]], Errors]], ...] = (
    ("frequency response of the surface", "kernel_frf.json", responses),
    ("influence coefficients", "kernel_ic.json", coefficients),
    ("stress below a cell", "kernel_stress.json", stresses),
)


def write(folder: Path) -> str:
    """Compare every table, draw the errors, write the page; give its line of the front page."""
    rows = [
        "| kernel | entries | layers | largest error | processor time |",
        "|---|---|---|---|---|",
    ]
    worst = 0.0
    with fret.plot.style():
        figure, axes = plt.subplots(1, len(KERNELS), figsize=(9.6, 3.0), sharey=True)
        for ax, (name, file, errors_of) in zip(axes, KERNELS, strict=True):
            entries = json.loads((TABLES / file).read_text(encoding="utf-8"))["entries"]
            started = time.process_time()
            found = list(errors_of(entries))
            seconds = time.process_time() - started
            layers, errors = (np.array(column) for column in zip(*found, strict=True))
            worst = max(worst, float(errors.max()))
            for count in np.unique(layers):
                of = np.flatnonzero(layers == count)
                shown = np.maximum(errors[of], 1e-17)
                label = f"{count} layer" if count == 1 else f"{count} layers"
                ax.semilogy(of, shown, ".", ms=4, color=LAYER_COLOURS[int(count)], label=label)
            ax.set(xlabel="entry", title=name)
            ax.legend(fontsize=7)
            counts = ", ".join(str(count) for count in np.unique(layers))
            rows.append(
                f"| {name} | {errors.size} | {counts} | {errors.max():.1e} | {seconds:.2f} s |"
            )
        axes[0].set_ylabel("error")
        figure.savefig(folder / "kernels.png", dpi=DPI)
        plt.close(figure)
    parts = [
        "# Kernels of layered bodies",
        "Tables computed with 40 to 90 digits (`tests/data`), every component under every "
        "traction: thin and thick layers, soft and hard, one to five of them. Errors are over the "
        "largest component of an entry; errors of the influence coefficients are over the "
        "loaded cell's under pressure.",
        "![errors of the kernels](kernels.png)",
        "\n".join(rows),
        "[All pages](README.md)",
    ]
    (folder / "kernels.md").write_text("\n\n".join(parts) + "\n", encoding="utf-8")
    return (
        f"| [Kernels of layered bodies](kernels.md) | | any component | {100 * worst:.1g} % | | |"
    )
