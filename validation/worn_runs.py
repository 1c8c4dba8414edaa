"""Runs of wear whose ends have closed forms: partial slip fully worn, and late gross slip."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

import pyfret as fret
from validation.worn import Worn, WornCylinder, WornSphere

if TYPE_CHECKING:
    from validation.truth import Array

#: Without lateral contraction the shear moves the surfaces along x alone.
ALIKE = fret.Elastic(E=200e9, nu=0.0)
STEEL = fret.Elastic(E=200e9, nu=0.3)
#: Radius [m], force of the sphere [N] and of the cylinder [N/m], friction, wear of a body [1/Pa].
R, W, LINE_W, MU, K = 10e-3, 50.0, 2e5, 0.6, 5e-14
#: Cycles until nothing changes, and errors that a jump may leave.
CYCLES, TOLERANCE, LINE_TOLERANCE = 1e6, 0.03, 0.01
#: Late gross slip: force [N, N/m], half a stroke [m], cycles, cells a side.
SLID = {"sphere": (20.0, 1e-6, 2e6, 128), "cylinder": (18.5e3, 1e-6, 2e5, 512)}


@dataclass(frozen=True)
class Profile:
    """Pressure and depth of both bodies along y = 0 at the end, over a, p0 and a^2/R or b."""

    x: Array
    p: Array
    depth: Array


@dataclass(frozen=True)
class FullyWorn:
    """A fully worn contact beside its closed form."""

    truth: Worn
    cells: int
    jumps: int
    #: Half-width of the stick zone less the truth, in cells.
    stick: float
    #: Largest depth in the stick zone over the largest of all.
    in_stick: float
    #: Ours and the truth.
    numbers: dict[str, tuple[float, float]]
    profile: Profile

    def error(self, name: str) -> float:
        """Error of a number over its truth."""
        ours, truth = self.numbers[name]
        return ours / truth - 1


def yardsticks(material: fret.Elastic, force: float, *, line: bool) -> tuple[float, float]:
    """Give a [m] and p0 [Pa] of the unworn contact of Hertz."""
    bodies = (material, material)
    if line:
        contact = fret.reference.line_contact(R=R, bodies=bodies, W=force)
        return contact.a, contact.p0
    hertz = fret.reference.hertz(R=R, bodies=bodies, W=force)
    return hertz.a, hertz.p0


def square(side: float, n: int, *, line: bool) -> fret.Grid:
    """Return a grid of n cells along a side, a strip for a line contact."""
    return fret.Grid.strip(extent=side, n=n) if line else fret.Grid.centred(width=side, n=n)


def pulled(force: float, amplitude: float) -> fret.LoadPath:
    """Pressed on, then pulled to and fro."""
    T = amplitude * MU * force
    return fret.LoadPath.start().normal(force, increments=1).tangential([T, -T, T], increments=6)


def fully_worn(truth: Worn, *, n: int, extent: float) -> FullyWorn:
    """Wear a sphere or a cylinder in partial slip until nothing changes."""
    line = isinstance(truth, WornCylinder)
    a, p0 = yardsticks(ALIKE, LINE_W if line else W, line=line)
    scene = fret.Scene(
        body1=fret.Body(ALIKE, shape=fret.Cylinder(R=R) if line else fret.Sphere(R=R)),
        body2=fret.Body(ALIKE),
        friction=MU,
        grid=square(extent * a, n, line=line),
        path=pulled(LINE_W if line else W, truth.amplitude),
    )
    result = fret.wear.solve(
        scene,
        cycles=CYCLES,
        first_branch=2,
        body1=fret.wear.Archard(K),
        body2=fret.wear.Archard(K),
        tolerance=LINE_TOLERANCE if line else TOLERANCE,
        progress=False,
    )
    end = result.dataset.isel(block=-1)
    p, depth, stick = end.p.values, (end.worn1 + end.worn2).values, end.stick.values.astype(bool)
    dx = float(end.x[1] - end.x[0])
    deep = a**2 / R
    width = dx if line else dx**2
    c = 0.5 * stick.sum() * dx if line else np.sqrt(stick.sum() * dx**2 / np.pi)
    middle = tuple(size // 2 for size in p.shape)
    zero = np.zeros(1)
    numbers = {
        "p(0)": (float(p[middle]) / p0, float(truth.p(zero)[0])),
        "worn volume": (depth.sum() * width / (deep * (a if line else a**2)), truth.volume),
        "largest depth": (float(depth.max()) / deep, truth.deepest),
    }
    if isinstance(truth, WornSphere):
        numbers["approach"] = (approach(scene, p, depth, stick) / deep, truth.approach)
    along = depth.shape[1] // 2
    return FullyWorn(
        truth,
        n,
        result.dataset.sizes["jump"],
        float(c - truth.c * a) / dx,
        float(depth[stick].max() / depth.max()),
        numbers,
        Profile(end.x.values / a, p[:, along] / p0, depth[:, along] / deep),
    )


def approach(scene: fret.Scene, p: Array, depth: Array, stick: Array) -> float:
    """Approach at which the gap of the stick zone is closed [m], a mean over its cells."""
    u_z = fret.SurfaceOperator(scene.body1, scene.body2, scene.grid).displacement(p)[2]
    x, y = np.meshgrid(scene.grid.x, scene.grid.y, indexing="ij")
    return float((u_z + depth + (x**2 + y**2) / (2 * R))[stick].mean())


@dataclass(frozen=True)
class Slid:
    """A scar of late gross slip beside its closed form: lengths over b, depths over b^2/(2 R)."""

    kind: str
    cells: int
    jumps: int
    #: b over Hertz's a.
    late: float
    depth: float
    half_width: float
    profile: Profile


def slid(kind: str) -> Slid:
    """Slide a sphere or a cylinder to and fro until the scar has forgotten the elasticity.

    The segment (area 2 b^3/(3 R)) or cap (volume pi b^4/(4 R)) that both bodies have lost is k W
    times the way slipped, k that of both bodies.
    """
    line = kind == "cylinder"
    force, stroke, cycles, n = SLID[kind]
    lost = 2 * K * force * 4 * stroke * cycles
    path = fret.LoadPath.start().normal(force, increments=1)
    for to in (stroke, -stroke, stroke):
        path = path.displace(delta_x=to, increments=1)
    b = float(np.cbrt(1.5 * R * lost)) if line else (4 * R * lost / np.pi) ** 0.25
    result = fret.wear.solve(
        fret.Scene(
            body1=fret.Body(STEEL, shape=fret.Cylinder(R=R) if line else fret.Sphere(R=R)),
            body2=fret.Body(STEEL),
            friction=MU,
            grid=square(2.6 * b, n, line=line),
        ),
        path=path,
        cycles=cycles,
        first_branch=2,
        cycling="sliding",
        body1=fret.wear.Archard(K),
        body2=fret.wear.Archard(K),
        progress=False,
    )
    end = result.dataset.isel(block=-1)
    x, middle = end.x.values / b, end.y.size // 2
    depth = (end.worn1 + end.worn2).values[:, middle] / (b**2 / (2 * R))
    # The parabola of the flank ends at 0.95^(-1/2) times where it is a twentieth as deep.
    part = 0.05 * depth.max()
    out = len(x) // 2 + int(np.argmax(depth[len(x) // 2 :] < part))
    at_part = np.interp(part, depth[[out, out - 1]], x[[out, out - 1]])
    half_width = float(at_part) / np.sqrt(0.95)
    p = end.p.values[:, middle]
    return Slid(
        kind,
        n,
        result.dataset.sizes["jump"],
        b / yardsticks(STEEL, force, line=line)[0],
        float(depth.max()),
        half_width,
        Profile(x, p / p.max(), depth),
    )
