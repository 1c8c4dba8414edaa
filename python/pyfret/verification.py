"""Verification on the user's own machine: a part of the validation book, in minutes.

Every number has a closed form as its truth, with its source. The error that it had when it was last
written down stands beside it. An error that is clearly larger is a finding.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from pyfret import reference
from pyfret._core import (
    RIGID,
    Body,
    Coating,
    Cylinder,
    Elastic,
    Grid,
    LoadPath,
    Scene,
    Sphere,
)
from pyfret._util.window import format_table
from pyfret.quantities import quantities
from pyfret.solution import solve

if TYPE_CHECKING:
    from pyfret.result import Result
    from pyfret.snapshot import Snapshot

__all__ = ["Check", "Verification", "verify"]

#: Radius [m], normal force [N], force per length of cylinders [N/m], friction coefficient.
R, W, LINE_W, MU = 0.018, 1e3, 1e5, 0.3
STEEL = Elastic(E=210e9, nu=0.3)
#: Without lateral contraction the shear kernel of like bodies is isotropic, as the closed forms
#: of partial slip have it.
CORK = Elastic(E=210e9, nu=0.0)
#: What an error may be over the one written down.
ROOM = 1.25
#: Errors below this are the solver's tolerance.
FLOOR = 2e-5


@dataclass(frozen=True)
class Check:
    """A number of ours beside its truth."""

    #: What it is.
    what: str
    #: Whose the truth is.
    source: str
    #: The number, its truth, and what the error is over.
    ours: float
    truth: float
    scale: float
    #: Error that was written down.
    last: float

    @property
    def error(self) -> float:
        """The error, of either sign, over the scale."""
        return (self.ours - self.truth) / self.scale

    @property
    def passed(self) -> bool:
        """Whether the error is no more than a quarter above what it was."""
        return bool(abs(self.error) <= max(ROOM * abs(self.last), FLOOR))


@dataclass(frozen=True)
class Verification:
    """All checks and how long they took."""

    checks: list[Check]
    seconds: float

    @property
    def passed(self) -> bool:
        """Whether all checks passed."""
        return all(check.passed for check in self.checks)

    def __str__(self) -> str:
        """A line for every check."""
        rows = [
            (
                c.what,
                "ok" if c.passed else "FAIL",
                f"{c.ours:.6g}",
                f"{c.truth:.6g}",
                f"{100 * c.error:+.4f}",
                f"{100 * c.last:+.4f}",
                c.source,
            )
            for c in self.checks
        ]
        titles = ["number", "check", "ours", "truth", "error\n[%]", "last\n[%]", "source"]
        bad = sum(not c.passed for c in self.checks)
        outcome = "all passed" if self.passed else f"{bad} FAILED"
        head = f"{len(self.checks)} numbers, {outcome}, {self.seconds:.0f} s"
        return f"{head}\n{format_table(titles, rows)}"

    __repr__ = __str__


#: Name, ours, truth, scale of the error (None: the truth).
Number = tuple[str, float, float, float | None]


def sphere(lower: Body, upper: Elastic, path: LoadPath, *, mu: float, n: int, a: float) -> Scene:
    """Build the scene of a sphere on a body, on a square of 2.4 contact radii."""
    return Scene(
        body1=Body(upper, shape=Sphere(R)),
        body2=lower,
        friction=mu,
        grid=Grid.centred(width=2.4 * a, n=n),
        path=path,
    )


def solved(scene: Scene) -> Result:
    """Solve a scene without a bar."""
    return solve(scene, progress=False)


def hertz(n: int) -> Iterator[Number]:
    """Yield the numbers of a sphere pressed on a flat, and of the stress on its axis."""
    truth = reference.hertz(R=R, bodies=(STEEL, STEEL), W=W)
    path = LoadPath.start().normal(W, increments=1)
    at = solved(sphere(Body(STEEL), STEEL, path, mu=0.0, n=n, a=truth.a)).at(-1)
    yield "contact radius [m]", float(at.contact_radius), truth.a, None
    yield "largest pressure [Pa]", float(at.p_max), truth.p0, None
    yield "approach [m]", float(at.delta_z), truth.delta_z, None
    z = np.linspace(0.3, 0.7, 81) * truth.a
    ours = float(at.stress(z, x=0.0, y=0.0).von_mises.max())
    closed = reference.HertzStress(a=truth.a, nu=STEEL.nu)
    axis = [[float(s[0]) for s in closed.pressure(np.array([0.0]), 0.0, float(d))] for d in z]
    largest = max(abs(s[2] - s[0]) for s in axis) * truth.p0
    yield "largest von Mises stress on the axis [Pa]", ours, largest, None


def partial_slip(n: int) -> Iterator[Number]:
    """Yield the numbers of a sphere pushed to and fro below the limit of friction."""
    round_ = reference.hertz(R=R, bodies=(CORK, CORK), W=W)
    truth = reference.CattaneoMindlin(round_, bodies=(CORK, CORK), mu=MU)
    T = 0.7 * MU * W
    path = LoadPath.start().normal(W, increments=1).tangential([T, -T, T], increments=50)
    result = solved(sphere(Body(CORK), CORK, path, mu=MU, n=n, a=round_.a))
    first = result.branches().isel(branch=1)
    stick = (truth.stick_radius(T) / round_.a) ** 2
    yield "stick ratio under 0.7 mu W", float(first.stick_ratio), stick, None
    shift = float(truth.shift_loading(np.array([T]))[0])
    yield "shift under 0.7 mu W [m]", float(first.delta_x), shift, None
    energy = float(result.loops().dissipated[-1])
    yield "energy of the loop [J]", energy, truth.loop_energy(T), None


def torsion(n: int) -> Iterator[Number]:
    """Yield the numbers of a sphere twisted below the limit of friction."""
    round_ = reference.hertz(R=R, bodies=(STEEL, STEEL), W=W)
    truth = reference.Lubkin(round_, bodies=(STEEL, STEEL), mu=MU)
    c = 0.5 * round_.a
    M_z = float(truth.M_z(np.array([c]))[0])
    path = LoadPath.start().normal(W, increments=1).torsion(M_z, increments=10)
    at = solved(sphere(Body(STEEL), STEEL, path, mu=MU, n=n, a=round_.a)).at(-1)
    yield (
        "rotation where c = 0.5 a [rad]",
        float(at.phi_z),
        float(truth.phi(np.array([c]))[0]),
        None,
    )


def coated(n: int) -> Iterator[Number]:
    """Yield the numbers of a rigid sphere on a stiff coating."""
    bare = reference.hertz(R=R, bodies=(RIGID, STEEL), W=W)
    coating = Coating(Elastic(E=2 * STEEL.E, nu=STEEL.nu), thickness=bare.a)
    truth = reference.coated_indentation(R=R, indenter=RIGID, coating=coating, substrate=STEEL, W=W)
    path = LoadPath.start().normal(W, increments=1)
    body = Body(STEEL, coatings=[coating])
    at = solved(sphere(body, RIGID, path, mu=0.0, n=n, a=truth.a)).at(-1)
    yield "contact radius [m]", float(at.contact_radius), truth.a, None
    yield "largest pressure [Pa]", float(at.p_max), float(truth.p(np.array([0.0]))[0]), None
    yield "approach [m]", float(at.delta_z), truth.delta_z, None


def coupled(n: int) -> Iterator[Number]:
    """Yield the numbers of dissimilar bodies pressed together: stick inside, slip outside."""
    mu = 0.2
    beta = reference.dundurs_beta(STEEL, RIGID)
    truth = reference.coupled_indentation(beta=beta, mu=mu)
    a = reference.hertz(R=R, bodies=(STEEL, RIGID), W=W).a / np.cbrt(truth.W)
    path = LoadPath.start().normal(W)
    result = solved(sphere(Body(RIGID), STEEL, path, mu=mu, n=n, a=a))
    at: Snapshot = result.at(-1)
    yield "c/a", math.sqrt(float(at.stick_ratio)), truth.stick_ratio, None
    yield "approach [m]", float(at.delta_z), truth.delta_z * a**2 / R, None


def line(n: int) -> Iterator[Number]:
    """Yield the numbers of a cylinder in partial slip."""
    truth = reference.line_contact(R=R, bodies=(STEEL, STEEL), W=LINE_W)
    T = 0.5 * MU * LINE_W
    scene = Scene(
        body1=Body(STEEL, shape=Cylinder(R=R)),
        body2=Body(STEEL),
        friction=MU,
        grid=Grid.strip(extent=2.4 * truth.a, n=n),
        path=LoadPath.start().normal(LINE_W, increments=1).tangential(T, increments=1),
    )
    at = solved(scene).at(-1)
    c = truth.stick_half_width(T=T, mu=MU)
    yield "largest pressure [Pa]", float(at.p_max), truth.p0, None
    yield "stick ratio under 0.5 mu W", float(at.stick_ratio), c / truth.a, None


#: Title and source of every group, its numbers, cells along a side, errors written down.
GROUPS: tuple[tuple[str, str, Callable[[int], Iterator[Number]], int, tuple[float, ...]], ...] = (
    (
        "Hertz",
        "Johnson, Contact Mechanics, ch. 3, 4",
        hertz,
        128,
        (6.8e-5, -7.0e-5, -1.1e-5, -1.5e-5),
    ),
    (
        "partial slip",
        "Cattaneo 1938; Mindlin, Deresiewicz, J. Appl. Mech. 20 (1953) 327",
        partial_slip,
        128,
        (2.2e-6, 9.5e-6, -1.6e-5),
    ),
    ("torsion", "Lubkin, J. Appl. Mech. 18 (1951) 183", torsion, 128, (6.5e-5,)),
    (
        "coating, E1/E2 = 2",
        "integral equation of the layer, pyfret.reference.coated_indentation",
        coated,
        128,
        (1.2e-4, -6.6e-5, -9.2e-6),
    ),
    (
        "coupled indentation",
        "Spence, J. Elasticity 5 (1975) 297",
        coupled,
        128,
        (-6.4e-4, -1.2e-5),
    ),
    ("cylinder", "Johnson, Contact Mechanics, sec. 4.2, 7.2", line, 256, (-1.3e-5, 3.4e-4)),
)


@quantities
def verify(*, on_check: Callable[[Check], object] | None = None) -> Verification:
    """Solve contacts that have closed forms, and compare: some minutes at most.

    Parameters
    ----------
    on_check : callable, optional
        Told every check as soon as it is done.

    Returns
    -------
    Verification
        Every number with its truth, its source, its error and the error that was last written down.
        ``passed``: no error is larger than that. Printed, it is a table.

    Examples
    --------
    >>> print(verify())  # doctest: +SKIP
    """
    started = time.perf_counter()
    checks = []
    for title, source, numbers, n, last in GROUPS:
        for (quantity, ours, truth, scale), before in zip(numbers(n), last, strict=True):
            over = abs(truth) if scale is None else scale
            check = Check(f"{title}: {quantity}", source, ours, truth, over, before)
            checks.append(check)
            if on_check is not None:
                on_check(check)
    return Verification(checks, time.perf_counter() - started)
