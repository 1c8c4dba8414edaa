"""A trial of elements: tractions constant on a cell against tractions linear between cells.

Hertz's contact, solved twice by the same conjugate gradients in NumPy, once with the pressure
constant on each cell, once with bilinear pyramids on the centres of the cells. A pyramid is the
cell's box smeared over a cell, so its coefficients are the means of the box's over a cell.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
import numpy as np

import pyfret as fret
from validation.pages import DPI
from validation.truth import order

if TYPE_CHECKING:
    from pathlib import Path

    from validation.truth import Array

SIZES = (32, 48, 64, 96, 128, 192)
#: Side of the square over the contact radius.
EXTENT = 2.4
#: Gauss nodes each way on a quarter of a cell.
NODES = 12
#: Residual of the gap over the approach at which the iteration ends.
TOLERANCE = 1e-10
#: Most iterations.
MOST = 2000
ELEMENTS = ("constant", "bilinear")


def love(x: Array, y: Array) -> Array:
    """Integral of 1/r over the unit square about the origin, at (x, y)."""

    def corner(u: Array, v: Array) -> Array:
        r = np.hypot(u, v)
        tiny = 1e-300
        value: Array = u * np.log(np.maximum(v + r, tiny)) + v * np.log(np.maximum(u + r, tiny))
        return value

    # By symmetry with both coordinates positive: then no argument of a logarithm cancels for long.
    x, y = np.abs(x), np.abs(y)
    total: Array = (
        corner(x + 0.5, y + 0.5)
        - corner(x - 0.5, y + 0.5)
        - corner(x + 0.5, y - 0.5)
        + corner(x - 0.5, y - 0.5)
    )
    return total


def coefficients(n: int, element: str) -> Array:
    """Integrals of 1/r under an element at all offsets 0 to n - 1, in cells."""
    k = np.arange(n, dtype=float)
    x, y = np.meshgrid(k, k, indexing="ij")
    if element == "constant":
        return love(x, y)
    # The box's coefficients have kinks at its edges: a Gauss rule for each quarter of a cell.
    node, weight = np.polynomial.legendre.leggauss(NODES)
    node, weight = node / 4, weight / 4
    total = np.zeros((n, n))
    for middle_x in (-0.25, 0.25):
        for middle_y in (-0.25, 0.25):
            for dx, w_x in zip(node, weight, strict=True):
                for dy, w_y in zip(node, weight, strict=True):
                    total += w_x * w_y * love(x + middle_x + dx, y + middle_y + dy)
    return total


def solve(n: int, element: str) -> tuple[Array, Array, float, int]:
    """Distances, pressure over p0, approach over a^2/R, iterations; lengths over a.

    Conjugate gradients on the contact cells for a given force (I. A. Polonsky, L. M. Keer, Wear 231
    (1999) 206): u = (1/pi) int p/r with p over p0 times pi/2 makes Hertz's paraboloid r^2/2.
    """
    h = EXTENT / n
    x = (np.arange(n) - (n - 1) / 2) * h
    r = np.hypot(x[:, None], x[None, :])
    half = coefficients(n, element) * h * 2 / np.pi**2
    ring = np.concatenate([np.arange(n), np.zeros(1, int), np.arange(n - 1, 0, -1)])
    kernel = np.fft.rfft2(half[ring[:, None], ring[None, :]])

    def apply(p: Array) -> Array:
        u: Array = np.fft.irfft2(np.fft.rfft2(p, (2 * n, 2 * n)) * kernel, (2 * n, 2 * n))
        return u[:n, :n]

    force = 2 * np.pi / 3
    p = np.where(r < 1.1, force / (np.pi * 1.21), 0.0)
    p *= force / (p.sum() * h * h)
    t, delta, before, iteration = np.zeros_like(p), 0.0, 1.0, 0
    while iteration < MOST:
        iteration += 1
        inside = p > 0
        gap = apply(p) + r**2 / 2
        approach = gap[inside].mean()
        gap -= approach
        squares = (gap[inside] ** 2).sum()
        t = np.where(inside, gap + delta * squares / before * t, 0.0)
        before = squares
        image = apply(t)
        image -= image[inside].mean()
        step = (gap * t)[inside].sum() / (image * t)[inside].sum()
        p = np.maximum(np.where(inside, p - step * t, 0.0), 0.0)
        enters = (p == 0) & (gap < 0) & ~inside
        delta = 0.0 if enters.any() else 1.0
        p[enters] -= step * gap[enters]
        p *= force / (p.sum() * h * h)
        if delta == 1.0 and np.sqrt(squares / inside.sum()) < TOLERANCE:
            break
    return r, p, float(approach), iteration


def errors(n: int, element: str) -> tuple[dict[str, float], int, float]:
    """Errors of a size, iterations, and the time of the solution [s]."""
    started = time.process_time()
    r, p, approach, iterations = solve(n, element)
    seconds = time.process_time() - started
    truth = np.sqrt(np.maximum(1 - r**2, 0))
    inner = r < 0.9
    # The rim where p^2, linear in r^2, vanishes: from cells a little inside.
    h = EXTENT / n
    near = (r > 1 - 8 * h) & (r < 1 - 2.5 * h)
    slope, at_zero = np.polyfit(r[near] ** 2, p[near] ** 2, 1)
    found = {
        "p, L2": float(np.linalg.norm(p - truth) / np.linalg.norm(truth)),
        "p, L2 within 0.9 a": float(
            np.linalg.norm((p - truth)[inner]) / np.linalg.norm(truth[inner])
        ),
        "radius": abs(float(np.sqrt(-at_zero / slope)) - 1),
        "approach": abs(float(approach) - 1),
    }
    return found, iterations, seconds


def write(folder: Path, *, quick: bool = False) -> str:
    """Solve with both elements, draw the errors, write the page; give its line in front."""
    sizes = SIZES[:3] if quick else SIZES
    found = {element: [errors(n, element) for n in sizes] for element in ELEMENTS}
    names = list(found["constant"][0][0])
    rows = [
        "| element | cells a side | " + " | ".join(names) + " | iterations | processor time |",
        "|---" * (len(names) + 4) + "|",
    ]
    for element in ELEMENTS:
        for n, (of, iterations, seconds) in zip(sizes, found[element], strict=True):
            numbers = " | ".join(f"{100 * of[name]:.2g} %" for name in names)
            rows.append(f"| {element} | {n} | {numbers} | {iterations} | {seconds:.2f} s |")
        orders = [order(sizes, [of[name] for of, *_ in found[element]]) for name in names]
        shown = " | ".join(f"{value:.1f}" for value in orders)
        rows.append(f"| {element} | observed order | {shown} | | |")
    with fret.plot.style():
        figure, axes = plt.subplots(1, len(names), figsize=(11.5, 3.0))
        for ax, name in zip(axes, names, strict=True):
            for element, mark in zip(ELEMENTS, "os", strict=True):
                ax.loglog(sizes, [of[name] for of, *_ in found[element]], mark + "-", label=element)
            ax.set(xlabel="cells a side", title=name)
            ax.set_xticks(sizes, [str(n) for n in sizes], fontsize=7)
            ax.minorticks_off()
        axes[0].set_ylabel("error")
        axes[0].legend()
        figure.savefig(folder / "elements.png", dpi=DPI)
        plt.close(figure)
    parts = [
        "# Constant or bilinear elements",
        (__doc__ or "").split("\n", 2)[2].strip(),
        "![errors of both elements](elements.png)",
        "\n".join(rows),
        "The radius is where the square of the pressure, continued from inside by a straight line "
        "in $r^2$, vanishes. Both cost the same per iteration.",
        "[All pages](README.md)",
    ]
    (folder / "elements.md").write_text("\n\n".join(parts) + "\n", encoding="utf-8")
    return "[Constant or bilinear elements](elements.md): a trial on Hertz's contact."
