"""Wear in gross slip beside fine runs and closed forms, and the errors that are printed.

    python tests/campaign/gross_slip.py [COUNT [KIND]]

Cylinders, balls, rows of 5 and 20 ridges, waviness and rough maps slide +-0.2 to +-20 half-widths
of a spot. One body wears, or both. Each line is a run: its true errors against a run of more cells
and more places along the stroke, beside the printed errors. The volume is V = k W s N. The last
lines are the shares of depths within 1.5 errors.
"""

from __future__ import annotations

import math
import sys
import time
import warnings
from dataclasses import dataclass

import numpy as np

import pyfret as fret

STEEL = fret.Elastic(E=200e9, nu=0.3)
MU = 0.3
#: Largest ratio of a true error to its bar, and the largest relative error of a volume.
MOST, VOLUME = 1.5, 1e-3
KINDS = ("cylinder", "5 ridges", "20 ridges", "waviness", "ball", "rough map")
#: Kinds that are solved on a grid of both directions.
ROUND = ("ball", "rough map")


@dataclass(frozen=True)
class Case:
    """A contact that slides, without its grid."""

    kind: str
    #: Shape of body 1, and the normal force (of a strip per length).
    shape: fret.shapes.Shape
    W: float
    #: Half-width of a spot [m], amplitude of the stroke over it.
    a: float
    stroke: float
    #: Coefficients of wear of body 1 and body 2 [m^2/N], and the cycles.
    k: tuple[float, float]
    cycles: float
    #: Lengths of the grid [m], and its cells for one cell in a half-width.
    lengths: tuple[float, float]

    @property
    def amplitude(self) -> float:
        """Amplitude of the stroke [m]."""
        return self.stroke * self.a

    @property
    def volumes(self) -> list[float]:
        """Volumes that both bodies lose: V = k W s N, the slip of a cycle being four amplitudes."""
        return [k * self.W * 4.0 * self.amplitude * self.cycles for k in self.k]

    def scene(self, cells: float) -> fret.Scene:
        """Return the contact on a grid of so many cells in the half-width of a spot."""
        nx, ny = (max(8, 2 * math.ceil(0.5 * cells * side / self.a)) for side in self.lengths)
        if self.kind in ROUND:
            grid = fret.Grid.from_spacing((nx, ny), (self.lengths[0] / nx, self.lengths[1] / ny))
        else:
            grid = fret.Grid.strip(extent=self.lengths[0], n=nx)
        return fret.Scene(
            body1=fret.Body(STEEL, shape=self.shape),
            body2=fret.Body(STEEL),
            friction=MU,
            grid=grid,
        )

    def wear(
        self, cells: float, *, places: int | None = None, tolerance: float = 0.01
    ) -> fret.wear.WearResult:
        """Wear it, with the places along the stroke that the run chooses or with so many."""
        how = {} if places is None else {"increments": places}
        path = fret.LoadPath.start().normal(self.W).cycles(1, delta_x=self.amplitude, **how)
        laws = [fret.wear.Archard(k=k) if k else None for k in self.k]
        return fret.wear.solve(
            self.scene(cells),
            path=path,
            cycles=self.cycles,
            body1=laws[0],
            body2=laws[1],
            tolerance=tolerance,
            cycling="sliding",
            progress=False,
        )


def rough_map(rng: np.random.Generator, side: float, depth: float) -> fret.shapes.Shape:
    """A dome with waves of random phase on it, as a measured map."""
    n = 64
    x = np.linspace(-0.5, 0.5, n)
    z = np.zeros((n, n))
    for _ in range(40):
        number = rng.uniform(2.0, 7.0)
        angle, phase = rng.uniform(0.0, 2.0 * np.pi, 2)
        along = np.cos(angle) * x[:, None] + np.sin(angle) * x[None, :]
        z += number**-1.8 * np.cos(2.0 * np.pi * number * along + phase)
    z *= depth / z.std()
    return fret.shapes.SurfaceMap(z, spacing=side / (n - 1))


def drawn(seed: int, kind: str) -> Case:
    """Draw a contact of a kind."""
    rng = np.random.default_rng([seed, KINDS.index(kind), 87])
    R, p0 = 0.01, float(rng.uniform(3e8, 1e9))
    modulus = 0.5 * STEEL.E / (1.0 - STEEL.nu**2)
    few = kind in ROUND
    stroke = float(np.exp(rng.uniform(math.log(0.2), math.log(5.0 if few else 20.0))))
    bodies = [(1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (1.0, 0.2)]
    k1, k2 = bodies[int(rng.integers(len(bodies)))]
    count = {"5 ridges": 5, "20 ridges": 20, "waviness": 5}.get(kind, 1)
    # Worn depth of body 1 over the approach of a spot, if it wears alone.
    wear = float(np.exp(rng.uniform(math.log(0.2), math.log(20.0 if count == 1 else 4.0))))
    shape: fret.shapes.Shape
    if few:
        a = math.pi * p0 * R / (2.0 * modulus)
        W = 2.0 / 3.0 * math.pi * a**2 * p0
        depth = wear * a**2 / R
        lost = math.pi * R * depth**2
        reach = a + math.sqrt(2.0 * R * depth)
        shape = fret.Sphere(R=R)
        if kind == "rough map":
            side = 2.4 * (reach + stroke * a)
            shape = shape + rough_map(rng, 2.2 * side, 0.05 * a**2 / R)
        lengths = (2.5 * (reach + stroke * a), 2.5 * reach)
    else:
        a = 2.0 * p0 * R / modulus
        W = count * 0.5 * math.pi * a * p0
        depth = wear * a**2 / (2.0 * R)
        reach = a + math.sqrt(2.0 * R * depth)
        lost = count * (2.0 * R * depth) ** 1.5 / (1.5 * R)
        spacing = float(rng.uniform(2.2, 3.5)) * reach
        if kind == "waviness":
            # The crests have the radius R; the smooth cylinder would touch half a crest further.
            shape = fret.shapes.Waviness(
                amplitude=spacing**2 / (4.0 * math.pi**2 * R), wavelength=spacing
            )
            bow = math.pi * modulus * ((0.5 * count + 0.5) * spacing) ** 2 / (4.0 * W)
            shape = shape + fret.Cylinder(R=bow)
            lengths = ((count + 6) * spacing + 2.4 * stroke * a, 1.0)
        elif count > 1:
            shape = fret.shapes.Ridges(R=R, spacing=spacing, count=count)
            lengths = ((count - 1) * spacing + 3.2 * (reach + stroke * a), 1.0)
        else:
            shape = fret.Cylinder(R=R)
            lengths = (2.4 * (reach + stroke * a), 1.0)
    cycles = 1e4
    k = lost / (W * 4.0 * stroke * a * cycles)
    return Case(kind, shape, W, a, stroke, (k1 * k, k2 * k), cycles, lengths)


def numbers(run: fret.wear.WearResult) -> dict[str, float]:
    """Depths of the bodies that wear."""
    depths = {f"depth{body}": float(run.dataset[f"depth{body}"][-1]) for body in (1, 2)}
    return {name: value for name, value in depths.items() if value > 0.0}


def worn_cylinder(stroke: float, b: float = 2e-4) -> Case:
    """A cylinder that has lost the segment 2 b^3/(3 R) on a flat that does not wear.

    Its first half-width is b/50, so that the elastic part of the depth is 1/2500 of b^2/(2 R).
    The stroke is in half-widths b.
    """
    R, a, cycles = 0.01, b / 50.0, 1e5
    W = math.pi * 0.5 * STEEL.E / (1.0 - STEEL.nu**2) * a**2 / (4.0 * R)
    k = b**3 / (1.5 * R) / (W * 4.0 * stroke * b * cycles)
    lengths = (2.6 * (1.0 + stroke) * b, 1.0)
    return Case("cylinder", fret.Cylinder(R=R), W, a, 50.0 * stroke, (k, 0.0), cycles, lengths)


def compare_with_segment(stroke: float, cells: float = 30.0) -> tuple[float, str]:
    """Compare a worn cylinder with b^2/(2 R): ratio of the error and the printed one, in words."""
    b = 2e-4
    case = worn_cylinder(stroke, b)
    run = case.wear(cells / 50.0)
    depth, right = numbers(run)["depth1"], b**2 / (2.0 * 0.01)
    bar = run.error_of("depth")
    words = (
        f"worn cylinder +-{stroke:g} b: depth {depth / right - 1.0:+.2%} +- {bar:.2%} of b^2/(2 R)"
    )
    # The elastic part is missing in the formula.
    return abs(depth / right - 1.0) / (bar + 1.0 / 2500.0), words


def chosen_places(run: fret.wear.WearResult) -> int:
    """Places along the stroke of a run, both ways together."""
    return int(run.dataset.loop_delta_x.shape[1])


def compare(case: Case, seed: int) -> tuple[dict[str, float], float, str]:
    """Compare a run with a finer one: ratios of errors, worst volume, and all in words."""
    rng = np.random.default_rng([seed, 1987])
    if case.kind in ROUND:
        bound = case.a * math.sqrt(1200.0 / math.prod(case.lengths))
        cells, finer = max(2.0, min(float(rng.uniform(3.0, 5.0)), bound)), 2.0
    else:
        bound = 200.0 * case.a / case.lengths[0]
        cells, finer = max(2.0, min(float(rng.uniform(2.0, 12.0)), bound)), 2.5
    begun = time.process_time()
    run = case.wear(cells)
    spent = time.process_time() - begun
    places = 2 * chosen_places(run)
    truth = numbers(case.wear(finer * cells, places=places))
    volume = max(
        abs(float(run.dataset[f"volume{body}"][-1]) / right - 1.0)
        for body, right in zip((1, 2), case.volumes, strict=True)
        if right > 0.0
    )
    bar, deepest = run.error_of("depth"), max(truth.values())
    off = {name: (value - truth[name]) for name, value in numbers(run).items()}
    ratios = {name: abs(value) / (bar * deepest) for name, value in off.items()}
    doubted = any("cells" in doubt for doubt in run.doubts)
    words = ", ".join(f"{name} {value / truth[name]:+.2%}" for name, value in off.items())
    about = f"{case.kind} +-{case.stroke:.2f} a, {cells:.1f} cells in a, n {run.scene.grid.nx}"
    return (
        ratios,
        volume,
        f"{about}, depth/bar {max(ratios.values()):.2f}: {words} +- {bar:.2%}, "
        f"volume {volume:.1e}, {chosen_places(run)} places, {spent:.1f} s"
        f"{', doubted' if doubted else ''}",
    )


def main(count: int, kinds: tuple[str, ...]) -> None:
    """Print the runs and the shares."""
    warnings.simplefilter("ignore")
    within: list[bool] = []
    volumes: list[float] = []
    for stroke in (0.2, 1.0, 5.0, 20.0):
        print(compare_with_segment(stroke)[1], flush=True)
    for seed in range(count):
        kind = kinds[seed % len(kinds)]
        case = drawn(seed, kind)
        try:
            ratios, volume, words = compare(case, seed)
        except (fret.errors.InvalidSceneError, fret.errors.SolveError) as error:
            print(f"{seed} {kind} +-{case.stroke:.2f} a: refused, {error}", flush=True)
            continue
        print(seed, words, flush=True)
        within += [ratio <= MOST for ratio in ratios.values()]
        volumes.append(volume)
    print(
        f"{np.mean(within):.1%} of {len(within)} depths within {MOST} errors, volumes within "
        f"{max(volumes):.1e}"
    )


if __name__ == "__main__":
    main(
        int(sys.argv[1]) if len(sys.argv) > 1 else 60,
        tuple(sys.argv[2:]) or KINDS,
    )
