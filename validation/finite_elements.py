"""Our tractions on a block of finite elements: stress below the contact by CalculiX and by ours."""

from __future__ import annotations

import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
import numpy as np

import pyfret as fret
from pyfret import export
from pyfret.export.frd import read_frd
from validation.pages import DPI

if TYPE_CHECKING:
    from validation.truth import Array

STEEL = fret.Elastic(E=210e9, nu=0.3)
R, W, MU = 0.01, 200.0, 0.4
#: Half the side of the block and its depth, half the side of its fine part and the depth of that,
#: in contact radii.
BLOCK, FINE = 6.0, (1.25, 2.25)
#: Elements over a contact radius in the fine part, and the growth of those beyond.
OVER_RADIUS, GROWTH = 4, 1.6
#: Depths, in contact radii.
DEPTHS = np.linspace(0.2, 2.0, 10)
COMPONENTS = ("s_xx", "s_yy", "s_zz", "s_xz")


def sheared(n: int) -> fret.Result:
    """A ball pressed on a flat of its own kind and sheared to 0.6 of what makes it slide."""
    hertz = fret.reference.hertz(R=R, bodies=(STEEL, STEEL), W=W)
    path = fret.LoadPath.start().normal(W, increments=1).tangential([0.6 * MU * W], increments=4)
    scene = fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Sphere(R=R)),
        body2=fret.Body(STEEL),
        friction=MU,
        grid=fret.Grid.centred(width=2.4 * hertz.a, n=n),
        path=path,
    )
    return fret.solve(scene, progress=False)


def graded(fine: float, end: float, size: float) -> Array:
    """Places from 0 to `end`: even up to `fine`, then farther and farther apart."""
    places = list(np.linspace(0.0, fine, int(np.ceil(fine / size)) + 1))
    while places[-1] < end:
        places.append(places[-1] + GROWTH * (places[-1] - places[-2]))
    places[-1] = end
    return np.array(places)


def block(a: float) -> tuple[Array, Array]:
    """Nodes [m] and hexahedra of 20 nodes of a block below the plane z = 0."""
    side = graded(FINE[0] * a, BLOCK * a, a / OVER_RADIUS)
    along = np.concatenate([-side[:0:-1], side])
    down = graded(FINE[1] * a, BLOCK * a, a / OVER_RADIUS)

    def doubled(v: Array) -> Array:
        return np.interp(np.arange(2 * v.size - 1) / 2, np.arange(v.size), v)

    axes = [doubled(v) for v in (along, along, down)]
    shape = tuple(v.size for v in axes)
    used = np.full(shape, -1)
    odd = np.sum(np.meshgrid(*(np.arange(n) % 2 for n in shape), indexing="ij"), axis=0)
    used[odd <= 1] = np.arange(int((odd <= 1).sum()))
    places = np.stack(np.meshgrid(*axes, indexing="ij"), -1)[odd <= 1]
    corner = [
        (0, 0, 0),
        (2, 0, 0),
        (2, 2, 0),
        (0, 2, 0),
        (0, 0, 2),
        (2, 0, 2),
        (2, 2, 2),
        (0, 2, 2),
    ]
    between = [(1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0)]
    upper = [(i, j, 2) for i, j, _ in between]
    upright = [(0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1)]
    first = np.stack(
        np.meshgrid(*(np.arange(0, n - 1, 2) for n in shape), indexing="ij"), -1
    ).reshape(-1, 3)
    nodes = [used[tuple((first + at).T)] for at in [*corner, *between, *upper, *upright]]
    return places, np.stack(nodes, -1)


def far_field(points: Array, T: float) -> Array:
    """Displacement of a half-space under the point loads T along x and W along z at the origin.

    Boussinesq and Cerruti: K. L. Johnson, Contact Mechanics (1985), eq. (3.18), (3.76).
    """
    G, nu = STEEL.E / (2 * (1 + STEEL.nu)), STEEL.nu
    x, y, z = points.T
    rho = np.sqrt(x * x + y * y + z * z)
    near = rho + z
    u = W * np.stack(
        [
            x * z / rho**3 - (1 - 2 * nu) * x / (rho * near),
            y * z / rho**3 - (1 - 2 * nu) * y / (rho * near),
            z * z / rho**3 + 2 * (1 - nu) / rho,
        ],
        -1,
    )
    u += T * np.stack(
        [
            1 / rho + x * x / rho**3 + (1 - 2 * nu) * (1 / near - x * x / (rho * near**2)),
            x * y / rho**3 - (1 - 2 * nu) * x * y / (rho * near**2),
            x * z / rho**3 + (1 - 2 * nu) * x / (rho * near),
        ],
        -1,
    )
    return np.asarray(u / (4 * np.pi * G))


def by_calculix(state: fret.Snapshot, a: float, folder: Path) -> tuple[Array, Array]:
    """Nodes below the middle [m] and their stress, xx, yy, zz, xz [Pa]; mm, N, MPa in the files."""
    places, elements = block(a)
    frame = export.Frame(unit="mm")
    mesh = folder / "block.inp"
    with mesh.open("w", encoding="ascii") as file:
        file.write("*NODE, NSET=ALL\n")
        for number, at in enumerate((1e3 * places).tolist(), 1):
            file.write(f"{number}, {at[0]:.12g}, {at[1]:.12g}, {at[2]:.12g}\n")
        file.write("*ELEMENT, TYPE=C3D20R, ELSET=BLOCK\n")
        for number, row in enumerate((elements + 1).tolist(), 1):
            text = [str(v) for v in (number, *row)]
            file.write(", ".join(text[:11]) + ",\n" + ", ".join(text[11:]) + "\n")
    export.loads(state, mesh, folder / "loads.inp", frame=frame)
    edge = np.abs(places).max(axis=1) >= BLOCK * a * (1 - 1e-9)
    given = far_field(places[edge], float(state.T_x))
    with (folder / "job.inp").open("w", encoding="ascii") as file:
        file.write("*INCLUDE, INPUT=block.inp\n*MATERIAL, NAME=STEEL\n*ELASTIC\n")
        file.write(
            f"{STEEL.E / 1e6:g}, {STEEL.nu:g}\n*SOLID SECTION, ELSET=BLOCK, MATERIAL=STEEL\n"
        )
        file.write("*STEP\n*STATIC\n*BOUNDARY\n")
        for node, shift in zip((np.flatnonzero(edge) + 1).tolist(), 1e3 * given, strict=True):
            for axis, value in enumerate(shift.tolist(), 1):
                file.write(f"{node}, {axis}, {axis}, {value:.12g}\n")
        file.write("*INCLUDE, INPUT=loads.inp\n*NODE FILE\nU\n*EL FILE\nS\n*END STEP\n")
    subprocess.run(["ccx", "job"], cwd=folder, check=True, capture_output=True)
    points, stress = read_frd(folder / "job.frd", "STRESS")
    below = (np.abs(points[:, :2]) < 1e-6 * 1e3 * a).all(axis=1) & (points[:, 2] > 0)
    order = np.argsort(points[below][:, 2])
    return 1e-3 * points[below][order], 1e6 * stress[below][order][:, [0, 1, 2, 0], [0, 1, 2, 2]]


def compared(n: int) -> tuple[Array, Array, Array, float]:
    """Depths over a, the stress of the elements and ours over p_H there, and the largest miss.

    The miss of a component is told over the largest component at its depth.
    """
    state = sheared(n).at(-1)
    a, p_H = state.a_H, state.p_H
    with tempfile.TemporaryDirectory() as folder:
        points, theirs = by_calculix(state, a, Path(folder))
    # Values at nodes are means of what the elements around extrapolate to them.
    at = np.array([int(np.abs(points[:, 2] - z * a).argmin()) for z in DEPTHS])
    ours = export.stress(state, points[at])[:, [0, 1, 2, 4]]
    off = np.abs(ours - theirs[at]).max(axis=1) / np.abs(ours).max(axis=1)
    return points[at, 2] / a, theirs[at] / p_H, ours / p_H, float(off.max())


def write(folder: Path, *, quick: bool = False) -> str:
    """Write the page; give its line of the front page, or a word where there is no CalculiX."""
    if shutil.which("ccx") is None:
        return "Finite elements under our tractions: skipped, there is no `ccx` (CalculiX) here."
    z, theirs, ours, off = compared(64 if quick else 128)
    with fret.plot.style():
        figure, ax = plt.subplots(figsize=(6.4, 3.6))
        for k, name in enumerate(COMPONENTS):
            ax.plot(ours[:, k], z, color=f"C{k}", label=f"ours, {name}")
            ax.plot(theirs[:, k], z, "o", ms=4, color=f"C{k}", label=f"CalculiX, {name}")
        ax.set(xlabel="stress below the middle [p_H]", ylabel="depth [a_H]")
        ax.invert_yaxis()
        ax.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5))
        figure.savefig(folder / "finite_elements.png", dpi=DPI)
        plt.close(figure)
    rows = ["| depth [a_H] | " + " | ".join(f"{c}, ours | CalculiX" for c in COMPONENTS) + " |"]
    rows.append("|---" * (2 * len(COMPONENTS) + 1) + "|")
    for k in range(z.size):
        pairs = zip(ours[k].tolist(), theirs[k].tolist(), strict=True)
        rows.append(f"| {z[k]:.2f} | " + " | ".join(f"{o:.4f} | {t:.4f}" for o, t in pairs) + " |")
    parts = [
        "# Finite elements under our tractions",
        "A ball of steel on steel, sheared to 0.6 of what makes it slide. The tractions went to "
        "the nodes of a block of quadratic hexahedra as `*CLOAD` (`pyfret.export.loads`); on "
        "the far faces the block has the displacement of a half-space under the two forces "
        "(Boussinesq, Cerruti). CalculiX computed the stress, and `pyfret.export` read it back.",
        "![stress below the middle](finite_elements.png)",
        f"Over p_H; the largest difference, over the largest component at its depth, is {off:.2%}; "
        "2 % are allowed.",
        "\n".join(rows),
        "[All pages](README.md)",
    ]
    (folder / "finite_elements.md").write_text("\n\n".join(parts) + "\n", encoding="utf-8")
    return (
        "Stress below our tractions on a block of finite elements, by CalculiX: within "
        f"{off:.1%} at ten depths ([page](finite_elements.md))."
    )
