"""Figures of what each kernel conversion costs and errs, from the tables of ``make bench-kernels``.

Written beside the tables: ``python examples/kernel_methods.py --out out``.
"""

from __future__ import annotations

import argparse
import csv
from pathlib import Path

import matplotlib.pyplot as plt

NAMES = {
    "hankel": "closed form + Hankel integrals",
    "inverse_fft": "inverse FFT (the paper)",
    "frequency_domain": "frequency domain (its reference [15])",
    "hankel_mirror": "Hankel, half of the grid",
}


def read(file: Path) -> list[dict[str, str]]:
    """The rows of a table."""
    with file.open(newline="") as table:
        return list(csv.DictReader(table))


def error_against_time(rows: list[dict[str, str]], file: Path) -> None:
    """Largest error of the coefficients over the time to compute them, one line per method."""
    figure, axes = plt.subplots(figsize=(5.6, 4.0), layout="constrained")
    exact = next(row for row in rows if row["method"] == "hankel")
    # Its error is measured against tables of higher precision: see tests/data.
    axes.loglog(float(exact["kernel_s"]), 1e-14, "*", ms=12, label=NAMES["hankel"])
    for aliases in ("0", "1"):
        line = [r for r in rows if r["method"] == "inverse_fft" and r["aliases"] == aliases]
        times = [float(row["kernel_s"]) for row in line]
        errors = [abs(float(row["error_largest"])) for row in line]
        label = f"{NAMES['inverse_fft']}, alias sums of order {aliases}"
        axes.loglog(times, errors, "o-", label=label)
        for row, time, error in zip(line, times, errors, strict=True):
            label = rf"$\lambda = {row['lambda']}$"
            axes.annotate(label, (time, error), xytext=(2, 5), textcoords="offset points", size=7)
    axes.set_xlabel("time [s]")
    axes.set_ylabel(r"largest error of $C_{33}$ over $C_{33}(0, 0)$")
    axes.legend(fontsize=8, loc="center right")
    figure.savefig(file, dpi=120)
    plt.close(figure)


def whole_runs(rows: list[dict[str, str]], file: Path) -> None:
    """Time of the whole run under each method, the same solver and path."""
    figure, axes = plt.subplots(figsize=(5.6, 2.4), layout="constrained")
    times = [float(row["seconds"]) for row in rows]
    bars = axes.barh([NAMES[row["method"]] for row in rows], times)
    axes.bar_label(bars, [f"{time:.1f} s" for time in times], padding=3)
    axes.margins(x=0.15)
    axes.invert_yaxis()
    axes.set_xlabel("time of the run [s]")
    figure.savefig(file, dpi=120)
    plt.close(figure)


def main() -> None:
    """Draw both figures into a folder that holds the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out"))
    out = parser.parse_args().out
    error_against_time(read(out / "kernel_methods.csv"), out / "kernel_methods.png")
    whole_runs(read(out / "kernel_methods_run.csv"), out / "kernel_methods_run.png")


if __name__ == "__main__":
    main()
