"""How fast the shear comes to its limit as the increments of a branch grow in number."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
import numpy as np

import pyfret as fret
from validation.pages import DPI, percent
from validation.scenes import CORK, MU, STEEL, R, W, hertz, sphere
from validation.truth import order

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from validation.truth import Array

#: Increments of a branch, and those of the limit.
COUNTS, LIMIT = (5, 10, 20, 40), 320
#: Cells a side of scenes that are pushed, and of those that are pressed.
PUSHED, PRESSED = 64, 256
#: Otherwise what the solver leaves would be in the errors.
SETTINGS = fret.Settings(tolerance=1e-8)


def coated(ratio: float, path: fret.LoadPath, *, n: int) -> fret.Scene:
    """A sphere on a coating as thick as Hertz's contact radius."""
    a = hertz(STEEL, STEEL).a
    coating = fret.Coating(fret.Elastic(E=ratio * STEEL.E, nu=STEEL.nu), thickness=a)
    return fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Sphere(R=R)),
        body2=fret.Body(STEEL, coatings=[coating]),
        friction=MU,
        grid=fret.Grid.centred(width=(2.8 if ratio < 1 else 2.4) * a, n=n),
        path=path,
        settings=SETTINGS,
    )


def growing(increments: int) -> fret.LoadPath:
    """Pressed on in increments of equal contact radius."""
    return fret.LoadPath.start().force(
        W=W, increments=increments, spacing=fret.Spacing.EQUAL_RADIUS
    )


def to_and_fro(increments: int) -> fret.LoadPath:
    """Pressed on at once, pushed and pulled back."""
    path = fret.LoadPath.start().normal(W, increments=1)
    return path.tangential([0.8 * MU * W, -0.8 * MU * W], increments=increments)


def rigid(material: fret.Elastic, mu: float) -> Callable[[int, int], fret.Scene]:
    """A sphere pressed on a rigid plane."""

    def scene(increments: int, n: int) -> fret.Scene:
        path = growing(increments)
        whole = sphere(material, fret.RIGID, path, n=n, mu=mu, extent=2.2)
        return whole.replace(settings=SETTINGS)

    return scene


#: Scenes of so many increments on so many cells a side.
SCENES: dict[str, tuple[Callable[[int, int], fret.Scene], int]] = {
    "pushed and pulled back, E1/E2 = 0.5": (
        lambda k, n: coated(0.5, to_and_fro(k), n=n),
        PUSHED,
    ),
    "pushed and pulled back, E1/E2 = 2": (lambda k, n: coated(2.0, to_and_fro(k), n=n), PUSHED),
    "pressed on a rigid plane, nu = 0, mu = 0.5": (rigid(CORK, 0.5), PRESSED),
    "pressed on a rigid plane, nu = 0.3, mu = 0.2": (rigid(STEEL, 0.2), PRESSED),
    "pressed, E1/E2 = 2": (lambda k, n: coated(2.0, growing(k), n=n), PRESSED),
}


def means(q: Array) -> Array:
    """Means over 2 x 2 cells."""
    components, nx, ny = q.shape
    parts = q.reshape(components, nx // 2, 2, ny // 2, 2)
    return np.asarray(parts.mean((2, 4)))


def shear(scene: fret.Scene) -> Array:
    """Shear at the end, both components [Pa]."""
    at = fret.solve(scene, progress=False).at(-1)
    return np.stack([at.q_x.values, at.q_y.values])


def write(folder: Path, *, quick: bool = False) -> str:
    """Solve every scene, write the page; give its line of the front page."""
    started = time.process_time()
    counts = COUNTS[:2] if quick else COUNTS
    table = [
        "| scene | cells a side | " + " | ".join(map(str, counts)) + " | order | of means |",
        "|---" * (len(counts) + 4) + "|",
    ]
    orders = {}
    with fret.plot.style():
        figure, ax = plt.subplots(figsize=(7.2, 3.4))
        for name, (scene, n) in SCENES.items():
            cells = n // 4 if quick else n
            limit = shear(scene(LIMIT // 4 if quick else LIMIT, cells))
            found = [shear(scene(k, cells)) for k in counts]
            errors, of_means = (
                [
                    float(np.linalg.norm(part(q - limit)) / np.linalg.norm(part(limit)))
                    for q in found
                ]
                for part in (np.asarray, means)
            )
            orders[name] = order(counts, of_means)
            shown = " | ".join(
                f"{percent(error)}, {percent(mean)}"
                for error, mean in zip(errors, of_means, strict=True)
            )
            table.append(
                f"| {name} | {cells} | {shown} | {order(counts, errors):.1f} | {orders[name]:.1f} |"
            )
            (line,) = ax.loglog(counts, of_means, "o-", label=name)
            ax.loglog(counts, errors, ".", ms=3, color=line.get_color())
        for power, dash in ((1, ":"), (2, "--")):
            slope = [0.15 * (counts[0] / k) ** power for k in counts]
            ax.loglog(counts, slope, dash, color="0.6", lw=0.9, label=f"order {power}")
        ax.set(xlabel="increments of a branch", ylabel="error of q")
        ax.set_xticks(counts, [str(k) for k in counts])
        ax.minorticks_off()
        ax.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5))
        figure.savefig(folder / "path_order.png", dpi=DPI)
        plt.close(figure)
    parts = [
        "# Error along the path",
        f"Shear at the end, L2 norm, against {LIMIT} increments of a branch on the same cells: of "
        "the cells and, second and with lines in the figure, of means over 2 x 2 cells.",
        "\n".join(table),
        "![errors](path_order.png)",
        "Where the contact stays the error falls with nearly the second power of the increments. "
        "Where it grows, cells come in one after another, and what each has moved by then is not "
        "known exactly: a scatter from cell to cell that falls more slowly than the rest and is "
        "most of the error where an increment is of one or two cells. Means over 2 x 2 cells have "
        "less of it.",
        f"Spheres of R = {R} m under {W:g} N.",
        "[All pages](README.md)",
    ]
    (folder / "path_order.md").write_text("\n\n".join(parts) + "\n", encoding="utf-8")
    seconds = time.process_time() - started
    return (
        f"| [Error along the path](path_order.md) | {PUSHED}, {PRESSED} | means of q against the "
        f"increments, least order | | {min(orders.values()):.1f} | {seconds:.0f} s |"
    )
