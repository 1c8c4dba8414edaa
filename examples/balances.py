"""What must hold whatever the load: twins, moment balance, energy.

    python examples/balances.py --out out

Twins are one contact in other coordinates, other units or with its bodies exchanged; moments are
those of the pressure under a tilted punch and in a conformal seat; energy is that of a path on
which cells enter, leave, stick, slip and turn.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Literal

import matplotlib.pyplot as plt
import numpy as np
from shared import MU, STEEL, Array, Figures, R, W, draw

import pyfret as fret

SOFT = fret.Elastic(E=120e9, nu=0.15)
HARD = fret.Elastic(E=330e9, nu=0.25)
#: Twins differ by rounding alone, but rounding decides where in the tolerance the solver ends.
TIGHT = fret.Settings(tolerance=1e-11)

#: Maps a vector field (x, y) and the pressure of a twin back to the scene.
Back = Callable[[Array, Array, Array], tuple[Array, Array, Array]]


def coated_ellipsoid(
    angle: float = 0.3, *, n: tuple[int, int], length: float = 1.0, modulus: float = 1.0
) -> fret.Scene:
    """An ellipsoid on a coated flat, dissimilar; lengths and moduli in other units."""

    def material(m: fret.Elastic) -> fret.Elastic:
        return fret.Elastic(E=m.E * modulus, nu=m.nu)

    hertz = fret.reference.hertz(R=1.3 * R, bodies=(SOFT, STEEL), W=W)
    side = 2.9 * hertz.a * length
    return fret.Scene(
        body1=fret.Body(
            material(SOFT),
            shape=fret.shapes.Ellipsoid(R_x=R * length, R_y=1.7 * R * length, angle=angle),
        ),
        body2=fret.Body(
            material(STEEL), coatings=[fret.Coating(material(HARD), thickness=2e-4 * length)]
        ),
        friction=MU,
        grid=fret.Grid.from_spacing(n, (side / n[0], 1.06 * side / n[1])),
        settings=TIGHT,
    )


def path(turn: Callable[[float, float], tuple[float, float]], unit: float = 1.0) -> fret.LoadPath:
    """W, then T_x and T_y that change their direction while W falls."""
    loads = fret.LoadPath.start().normal(W * unit, increments=6)
    for normal, x, y in ((1.0, 0.15, 0.05), (0.8, 0.02, -0.16)):
        T_x, T_y = turn(x * W * unit, y * W * unit)
        loads = loads.force(W=normal * W * unit, T_x=T_x, T_y=T_y, increments=4)
    return loads


def twins(file: Path, n: int) -> str:
    """One contact turned, mirrored, exchanged and scaled: the same to nine digits."""
    cells = (n, n - 2)
    scene = coated_ellipsoid(n=cells)
    across = cells[::-1]
    d = (scene.grid.dy, scene.grid.dx)
    length, modulus = 3.0, 7.0

    def with_bodies(body1: fret.Body, body2: fret.Body, grid: fret.Grid) -> fret.Scene:
        return fret.Scene(body1=body1, body2=body2, friction=MU, grid=grid, settings=TIGHT)

    twin_of: dict[str, tuple[fret.Scene, fret.LoadPath, Back]] = {
        "turned by 90°": (
            with_bodies(
                fret.Body(
                    SOFT, shape=fret.shapes.Ellipsoid(R_x=R, R_y=1.7 * R, angle=0.3 + np.pi / 2)
                ),
                scene.body2,
                fret.Grid.from_spacing(across, d),
            ),
            path(lambda x, y: (-y, x)),
            lambda p, x, y: (p.T[:, ::-1], y.T[:, ::-1], -x.T[:, ::-1]),
        ),
        "mirrored": (
            coated_ellipsoid(-0.3, n=cells),
            path(lambda x, y: (-x, y)),
            lambda p, x, y: (p[::-1], -x[::-1], y[::-1]),
        ),
        "exchanged": (
            with_bodies(scene.body2, scene.body1, scene.grid),
            path(lambda x, y: (-x, -y)),
            lambda p, x, y: (p, -x, -y),
        ),
        "scaled": (
            coated_ellipsoid(n=cells, length=length, modulus=modulus),
            path(lambda x, y: (x, y), unit=modulus * length**2),
            lambda p, x, y: (p / modulus, x / modulus, y / modulus),
        ),
    }

    def fields(scene: fret.Scene, loads: fret.LoadPath) -> tuple[Array, Array, Array]:
        end = fret.solve(scene, loads, progress=False).at(-1)
        return end.p.to_numpy(), end.q_x.to_numpy(), end.q_y.to_numpy()

    ours = fields(scene, path(lambda x, y: (x, y)))
    scale = float(np.linalg.norm(ours[0]))
    off = {
        name: [
            max(float(np.linalg.norm(a - b)) / scale, 1e-17)
            for a, b in zip(ours, back(*fields(twin, loads)), strict=True)
        ]
        for name, (twin, loads, back) in twin_of.items()
    }
    with fret.plot.style():
        figure, (zones, distance) = plt.subplots(1, 2, figsize=(8.8, 3.5))
        x, y = scene.grid.x / R * 1e3, scene.grid.y / R * 1e3
        image = zones.pcolormesh(x, y, ours[0].T / 1e9, cmap="Greys")
        some = (slice(None, None, 2), slice(None, None, 2))
        zones.quiver(
            x[::2], y[::2], ours[1][some].T, ours[2][some].T, color="C1", scale=3e9, width=0.005
        )
        zones.set(aspect="equal", xlabel="$1000\\,x/R$", ylabel="$1000\\,y/R$")
        zones.set_title("pressure [GPa] and shear")
        figure.colorbar(image, ax=zones)
        for k, (field, marker) in enumerate((("p", "o"), ("$q_x$", "s"), ("$q_y$", "^"))):
            distance.semilogy(list(off), [of[k] for of in off.values()], marker, label=field)
        distance.axhline(1e-9, color="0.5", lw=0.8, ls="--")
        distance.set(
            xlim=(-0.5, 3.5),
            ylim=(3e-18, 1e-7),
            ylabel="distance from the scene over the norm of p",
            title="at 1e-17: the same bits",
        )
        distance.legend(fontsize=8)
        figure.savefig(file)
        plt.close(figure)
    return f"twins within {max(max(of) for of in off.values()):.1e}"


def tilt(file: Path, n: int) -> str:
    """Moments on a flat punch with a rounded edge and on a ball in a seat."""
    a = 1e-3
    seat_hertz = fret.reference.hertz(R=1 / (1 / R - 1 / (1.1 * R)), bodies=(STEEL, STEEL), W=W)
    punch = fret.Body(STEEL, shape=fret.shapes.FlatPunch(radius=0.8 * a, edge=0.02))
    contacts = {
        "flat punch, rounded edge": (punch, fret.Body(SOFT), 0.8 * a, 2.6 * a),
        "ball in a seat of 1.1 R": (
            fret.Body(STEEL, shape=fret.Sphere(R=R)),
            fret.Body(STEEL, shape=fret.Sphere(R=-1.1 * R)),
            seat_hertz.a,
            3.4 * seat_hertz.a,
        ),
    }
    parts = np.array([0.0, 0.1, 0.2, 0.3])
    worst = 0.0
    with fret.plot.style():
        figure, axes = plt.subplots(1, 3, figsize=(11.4, 3.4))
        for ax, (name, (body1, body2, radius, extent)) in zip(axes, contacts.items(), strict=False):
            loads = fret.LoadPath.start().normal(W, increments=2)
            for part in parts:
                loads = loads.force(
                    M_x=0.5 * part * W * radius, M_y=-part * W * radius, increments=1
                )
            grid = fret.Grid.centred(width=extent, n=n)
            scene = fret.Scene(body1=body1, body2=body2, friction=0.0, grid=grid)
            result = fret.solve(scene, loads, save="branches", progress=False)
            found = []
            for moment, part in zip(result.dataset.saved_increment.values[1:], parts, strict=True):
                end = result.at(int(moment))
                p = end.p.to_numpy()
                x, y = grid.x / radius, grid.y / radius
                ax.plot(x, p[:, n // 2] / 1e9, label=f"$-M_y = {part:.1f}\\,W a$")
                area = grid.dx * grid.dy / W
                moments = (float((p * y).sum() * area), float(-(p * x[:, None]).sum() * area))
                found.append(moments)
                worst = max(worst, abs(moments[0] - 0.5 * part), abs(moments[1] + part))
            ax.set(xlabel="$x/a$", ylabel="p(x, 0) [GPa]", title=name)
            ax.legend(fontsize=7)
            asked = np.array(found)
            size = 10 if body1 is punch else 5
            for k, (along, what) in enumerate(((-asked[:, 1], "-M_y"), (asked[:, 0], "M_x"))):
                label = f"{name}: ${what}$"
                axes[2].plot(parts, along, "os"[k], ms=size, mfc="none", label=label)
        axes[2].plot(parts, parts, "k-", lw=0.8)
        axes[2].plot(parts, 0.5 * parts, "k-", lw=0.8)
        axes[2].set(xlabel="moment asked for, over $W a$", ylabel="moment of the pressure")
        axes[2].set_title(f"within {worst:.0e}")
        axes[2].legend(fontsize=6)
        figure.savefig(file)
        plt.close(figure)
    return f"moments within {worst:.1e} W a"


def mixed(increments: int, n: int, save: Literal["branches", "all"]) -> fret.Result:
    """W and T to and fro on a coated body."""
    hertz = fret.reference.hertz(R=R, bodies=(SOFT, STEEL), W=W)
    coating = fret.Coating(HARD, thickness=0.5 * hertz.a)
    scene = fret.Scene(
        body1=fret.Body(SOFT, shape=fret.Sphere(R=R)),
        body2=fret.Body(STEEL, coatings=[coating]),
        friction=MU,
        grid=fret.Grid.centred(width=2.5 * hertz.a, n=n),
    )
    loads = fret.LoadPath.start().force(
        W=W, increments=increments, spacing=fret.Spacing.EQUAL_RADIUS
    )
    for normal, part in ((1.0, 0.6), (0.5, -0.3), (1.0, 0.4)):
        loads = loads.force(W=normal * W, T_x=part * MU * W, increments=increments)
    return fret.solve(scene, loads, save=save, progress=False)


def energy(file: Path, n: int) -> str:
    """The identity, the dissipation of each cell, and how fast the two quadratures meet."""
    result = mixed(24, n, "all")
    d = result.dataset
    work = np.cumsum(np.abs(d.work.values))
    imbalance = d.work - d.elastic - d.dissipated - d.opening + d.quadrature
    density = d.dissipated_density.values
    least = np.diff(density, axis=0, prepend=0.0).min(axis=(1, 2)) / density.max()
    counts = np.array([6, 12, 24, 48])
    runs = [mixed(int(k), n, "branches").dataset for k in counts]
    total = float(d.dissipated.sum())
    with fret.plot.style():
        figure, ((sums, small), (checks, order)) = plt.subplots(2, 2, figsize=(9.0, 6.4))
        increment = d.increment.values
        sums.plot(
            increment, np.cumsum(d.work) * 1e3, "k", lw=3, alpha=0.3, label="work of the loads"
        )
        parts = d.elastic + d.dissipated + d.opening - d.quadrature
        sums.plot(increment, np.cumsum(parts) * 1e3, ".", ms=4, label="sum of the others")
        sums.plot(increment, np.cumsum(d.elastic) * 1e3, lw=0.9, label="elastic")
        for name in ("dissipated", "opening", "quadrature"):
            small.plot(increment, np.cumsum(d[name]) * 1e3, lw=1.2, label=name)
        small.set(xlabel="increment", ylabel="energy [mJ]")
        small.legend(fontsize=7)
        sums.set(xlabel="increment", ylabel="energy [mJ]")
        sums.legend(fontsize=7, loc="lower center")
        missing = np.maximum(np.abs(imbalance.values) / work, 1e-17)
        checks.semilogy(increment, missing, ".", ms=3, label="imbalance over work")
        given = np.maximum(-least, 1e-17)
        checks.semilogy(
            increment, given, "x", ms=3, label="most that a cell gives\nover the largest density"
        )
        checks.axhline(1e-6, color="0.5", lw=0.8, ls="--")
        checks.set(xlabel="increment", ylim=(1e-18, 1e-4))
        checks.legend(fontsize=7)
        for name in ("quadrature", "opening"):
            values = [float(np.abs(run[name]).sum()) / total for run in runs]
            order.loglog(counts, values, "o-", ms=4, lw=0.8, label=name)
        order.loglog(counts, values[0] * (counts[0] / counts) ** 2, "k--", lw=0.8, label="slope -2")
        order.set(xlabel="increments per branch", ylabel="sum of sizes over dissipation")
        order.set_xticks(counts, [str(k) for k in counts])
        order.minorticks_off()
        order.legend(fontsize=7)
        figure.savefig(file)
        plt.close(figure)
    return (
        f"imbalance at most {missing.max():.1e} of the work; a cell gives at most {given.max():.1e}"
    )


FIGURES: Figures = {
    "twins": (twins, 26),
    "tilt": (tilt, 64),
    "energy": (energy, 48),
}


if __name__ == "__main__":
    draw(FIGURES, prefix="balance", description="What must hold whatever the load.")
