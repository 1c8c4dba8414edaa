"""Figures of what each kernel conversion costs and errs, from the tables of ``make bench-kernels``.

Written beside the tables: ``python examples/kernel_methods.py --out out``.
"""

from __future__ import annotations

import argparse
import csv
from pathlib import Path

import matplotlib.pyplot as plt
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

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
    """Largest error over the time to set up a method, and over the time of a convolution with it.

    The errors are measured against the Hankel integrals, a line here; how far those are from tables
    of higher precision, the tests of the kernels say.
    """
    figure, panels = plt.subplots(1, 2, figsize=(9.6, 4.0), layout="constrained", sharey=True)
    methods = [("inverse_fft", "0"), ("inverse_fft", "1"), ("frequency_domain", "0")]
    for axes, column, title in zip(
        panels,
        ("kernel_s", "convolution_s"),
        ("set-up, once", "one convolution, thousands of times"),
        strict=True,
    ):
        exact = next(row for row in rows if row["method"] == "hankel")
        axes.axvline(1e3 * float(exact[column]), color="C3", lw=2, label=NAMES["hankel"])
        for method, aliases in methods:
            line = [r for r in rows if r["method"] == method and r["aliases"] == aliases]
            times = [1e3 * float(row[column]) for row in line]
            errors = [abs(float(row["error_largest"])) for row in line]
            summed = f", alias sums of order {aliases}" if method == "inverse_fft" else ""
            axes.loglog(times, errors, "o-", label=NAMES[method] + summed)
            if column == "convolution_s" and method == "inverse_fft":
                continue
            for row, time, error in zip(line, times, errors, strict=True):
                label = rf"$\lambda = {row['lambda']}$"
                offset = (0, -12) if method == "frequency_domain" else (0, 6)
                axes.annotate(
                    label,
                    (time, error),
                    xytext=offset,
                    textcoords="offset points",
                    size=7,
                    ha="center",
                )
        axes.set_title(title, size=10)
        axes.set_xlabel("time [ms]")
        axes.margins(0.12)
        axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axes.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
        axes.xaxis.set_minor_formatter(NullFormatter())
    panels[0].set_ylabel(r"largest error of $C_{33}$ over $C_{33}(0, 0)$")
    figure.legend(
        *panels[0].get_legend_handles_labels(), fontsize=8, loc="outside lower center", ncols=2
    )
    figure.savefig(file, dpi=120)
    plt.close(figure)


def whole_runs(rows: list[dict[str, str]], file: Path) -> None:
    """Time of the whole run under each method, the same solver and path."""
    figure, axes = plt.subplots(figsize=(5.6, 2.4), layout="constrained")
    times = [float(row["seconds"]) for row in rows]
    bars = axes.barh([NAMES[row["method"]] for row in rows], times)
    axes.bar_label(bars, [f"{time:.1f} s" for time in times], padding=3)
    axes.set_xlim(0, 1.18 * max(times))
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
