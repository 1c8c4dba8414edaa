"""Homogeneous bodies that slip in part: tangential forces, torsion, any path."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

import pyfret as fret
from validation.scenes import CORK, MU, STEEL, R, W, hertz, sphere, stretched
from validation.truth import Known, Truth, l2
from validation.truths.bodies import distance

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from validation.truth import Array

ROUND = hertz(CORK, CORK)
CATTANEO = fret.reference.CattaneoMindlin(ROUND, bodies=(CORK, CORK), mu=MU)
T_M = 0.9 * MU * W


def pressed() -> fret.LoadPath:
    """The sphere pressed on."""
    return fret.LoadPath.start().normal(W, increments=1)


def stick_radius(at: fret.Snapshot) -> float:
    """Radius of the circle of the stick zone's area [m]."""
    return float(np.sqrt(float(at.stick_area) / np.pi))


def q_along_x(at: fret.Snapshot) -> tuple[Array, Array]:
    """Places x and shear q_x on the row of cells next to y = 0."""
    return at.x.values, at.q_x.values[:, at.y.size // 2]


# --- Cattaneo-Mindlin ---------------------------------------------------------------------------

FORCES = (0.3, 0.6, 0.9)


def pushed(n: int, extent: float = 2.4) -> fret.Scene:
    """Pushed to three forces."""
    path = pressed().tangential([t * MU * W for t in FORCES], increments=3)
    return sphere(CORK, CORK, path, n=n, extent=extent)


def cattaneo_known(result: fret.Result) -> dict[str, Known]:
    """Stick radius, shift and shear of each force."""
    known = {}
    for n, part in enumerate(FORCES):
        T, at = part * MU * W, result.at(n + 2)
        c = CATTANEO.stick_radius(T)
        r = distance(at)
        known[f"c at {part:g} mu W"] = Known(stick_radius(at), c)
        known[f"delta_x at {part:g} mu W"] = Known(
            float(at.delta_x), float(CATTANEO.shift_loading(T))
        )
    q = CATTANEO.q_loading(r, T=T)
    known["stick ratio"] = Known(float(at.stick_ratio), (c / ROUND.a) ** 2, of="stick_ratio")
    known["delta_x"] = known.pop(f"delta_x at {part:g} mu W")._replace(of="delta_x")
    known[f"q_x at {part:g} mu W, L2"] = l2(at.q_x.values, q, MU * ROUND.p(r))
    return known


def cattaneo_drawn(figure: Figure, result: fret.Result) -> None:
    """Shear along x, and stick radius and shift against the force."""
    shear, curve = figure.subplots(1, 2)
    for n, part in enumerate(FORCES):
        x, q = q_along_x(result.at(n + 2))
        fine = np.linspace(-1.1, 1.1, 801) * ROUND.a
        truth = CATTANEO.q_loading(np.abs(fine), T=part * MU * W) / (MU * ROUND.p0)
        (drawn,) = shear.plot(fine / ROUND.a, truth, lw=1, label=rf"$T = {part:g}\,\mu W$")
        shear.plot(x / ROUND.a, q / (MU * ROUND.p0), ".", ms=3, color=drawn.get_color())
    shear.set(xlabel="$x/a$", ylabel=r"$q_x/(\mu p_0)$", title="lines: closed form, dots: ours")
    shear.legend()
    T = np.linspace(0, 1, 200) * MU * W
    ends = [result.at(n + 2) for n in range(len(FORCES))]
    curve.plot(T / (MU * W), [CATTANEO.stick_radius(t) / ROUND.a for t in T], label="$c/a$")
    curve.plot(
        T / (MU * W),
        CATTANEO.shift_loading(T) / CATTANEO.shift_limit,
        label=r"$\delta_x$ over that of sliding",
    )
    curve.plot(FORCES, [stick_radius(at) / ROUND.a for at in ends], "o", color="C0")
    curve.plot(FORCES, [float(at.delta_x) / CATTANEO.shift_limit for at in ends], "o", color="C1")
    curve.set(xlabel=r"$T/(\mu W)$")
    curve.legend()


# --- Mindlin-Deresiewicz -------------------------------------------------------------------------


def loop(n: int, increments: int) -> fret.Scene:
    """A force to and fro."""
    path = pressed().tangential([T_M, -T_M, T_M], increments=increments)
    return sphere(CORK, CORK, path, n=n)


def loop_known(result: fret.Result) -> dict[str, Known]:
    """Energy of the closed loop, and shift and shear at the ends of its branches."""
    back, forth = result.at(-2), result.at(-1)
    branch = result.dataset.branch_of_increment.values
    dissipated = float(result.dataset.dissipated.values[branch >= 2].sum())
    r, sliding = distance(back), MU * ROUND.p(distance(back))
    shift = CATTANEO.shift_limit
    return {
        "energy of the loop": Known(dissipated, CATTANEO.loop_energy(T_M)),
        "delta_x at -T_m": Known(
            float(back.delta_x), float(CATTANEO.shift_unloading(-T_M, T_m=T_M)), shift
        ),
        "delta_x at T_m": Known(
            float(forth.delta_x), float(CATTANEO.shift_reloading(T_M, T_m=T_M)), shift, "delta_x"
        ),
        "q_x at T_m, L2": l2(forth.q_x.values, CATTANEO.q_reloading(r, T=T_M, T_m=T_M), sliding),
    }


def loop_drawn(figure: Figure, result: fret.Result) -> None:
    """The loop, and the shear at the ends of its branches."""
    curve, shear = figure.subplots(1, 2)
    T = np.linspace(-T_M, T_M, 400)
    limit = CATTANEO.shift_limit
    d = result.dataset
    first = T[T >= 0]
    curve.plot(CATTANEO.shift_loading(first) / limit, first / (MU * W), color="0.6", lw=3)
    for shift in (CATTANEO.shift_unloading(T, T_m=T_M), CATTANEO.shift_reloading(T, T_m=T_M)):
        curve.plot(shift / limit, T / (MU * W), color="0.6", lw=3)
    curve.plot(d.delta_x / limit, d.T_x / (MU * W), ".-", ms=4, lw=0.6)
    curve.set(xlabel=r"$\delta_x$ over that of sliding", ylabel=r"$T_x/(\mu W)$")
    fine = np.linspace(-1.1, 1.1, 801) * ROUND.a
    r = np.abs(fine)
    for at, truth, label in (
        (result.at(-2), CATTANEO.q_unloading(r, T=-T_M, T_m=T_M), "$-T_m$"),
        (result.at(-1), CATTANEO.q_reloading(r, T=T_M, T_m=T_M), "$T_m$"),
    ):
        x, q = q_along_x(at)
        (drawn,) = shear.plot(fine / ROUND.a, truth / (MU * ROUND.p0), lw=1, label=label)
        shear.plot(x / ROUND.a, q / (MU * ROUND.p0), ".", ms=3, color=drawn.get_color())
    shear.set(xlabel="$x/a$", ylabel=r"$q_x/(\mu p_0)$", title="lines: closed form, dots: ours")
    shear.legend()


# --- Lubkin ---------------------------------------------------------------------------------------

TWISTED = hertz(STEEL, STEEL)
LUBKIN = fret.reference.Lubkin(TWISTED, bodies=(STEEL, STEEL), mu=MU)
RADII = (0.9, 0.5, 0.1)


def twisted(n: int, extent: float = 2.4) -> fret.Scene:
    """Torsion up to three stick radii."""
    path = pressed()
    for part in RADII:
        path = path.torsion(float(LUBKIN.M_z(part * TWISTED.a)), increments=1)
    return sphere(STEEL, STEEL, path, n=n, extent=extent)


def twisted_known(result: fret.Result) -> dict[str, Known]:
    """Rotation and stick radius of each moment."""
    known = {}
    for n, part in enumerate(RADII):
        c, at = part * TWISTED.a, result.at(n + 2)
        known[f"phi_z at c = {part:g} a"] = Known(float(at.phi_z), float(LUBKIN.phi(c)))
        known[f"c = {part:g} a"] = Known(stick_radius(at), c, TWISTED.a)
    known["phi_z"] = known.pop(f"phi_z at c = {part:g} a")._replace(of="phi_z")
    return known


def twisted_drawn(figure: Figure, result: fret.Result) -> None:
    """Moment against rotation, and the traction about the axis."""
    curve, shear = figure.subplots(1, 2)
    c = np.linspace(0.02, 0.999, 300) * TWISTED.a
    scale = MU * W * TWISTED.a
    curve.plot(LUBKIN.phi(c) * 1e3, LUBKIN.M_z(c) / scale, label="Lubkin")
    d = result.dataset
    curve.plot(d.phi_z[1:] * 1e3, d.M_z[1:] / scale, "o", label="ours")
    curve.axhline(LUBKIN.M_limit / scale, color="0.6", lw=0.8)
    curve.set(xlabel=r"$\varphi_z$ [mrad]", ylabel=r"$M_z/(\mu W a)$")
    curve.legend()
    for n, part in enumerate(RADII):
        at = result.at(n + 2)
        x, q = at.x.values, at.q_y.values[:, at.y.size // 2]
        truth = np.sign(x) * LUBKIN.q(np.abs(x), c=part * TWISTED.a)
        (drawn,) = shear.plot(
            x / TWISTED.a, truth / (MU * TWISTED.p0), lw=1, label=f"$c = {part:g}\\,a$"
        )
        shear.plot(x / TWISTED.a, q / (MU * TWISTED.p0), ".", ms=3, color=drawn.get_color())
    shear.set(xlabel="$x/a$", ylabel=r"$q_\theta/(\mu p_0)$", xlim=(-1.1, 1.1))
    shear.legend()


# --- Any path -------------------------------------------------------------------------------------

WAYPOINTS = 8


def wandering(n: int, increments: int) -> fret.Scene:
    """A path through random forces, `increments` to each of them."""
    rng = np.random.default_rng(7)
    load = rng.uniform(0.2, 1.0, WAYPOINTS) * W
    force = rng.uniform(-0.95, 0.95, WAYPOINTS) * MU * load
    path = fret.LoadPath.start().force(
        W=load[0], T_x=force[0], increments=increments, spacing=fret.Spacing.EQUAL_RADIUS
    )
    path = path.waypoints(W=load[1:], T_x=force[1:], increments=increments)
    return sphere(CORK, CORK, path, n=n, extent=2.3)


def springs(result: fret.Result, steps: int) -> Array:
    """Shift of the springs at every increment [m]."""
    row = fret.reference.Springs(ROUND, R=R, bodies=(CORK, CORK), mu=MU)
    d = result.dataset
    forces = zip(d.W.values, d.T_x.values, strict=True)
    return np.array([row.load(W=w, T=t, steps=steps) for w, t in forces])


def wandering_known(result: fret.Result) -> dict[str, Known]:
    """Shift at the end and at its worst."""
    truth, ours = springs(result, 2 if len(result.scene.path) > 100 else 20), result.delta_x.values
    ends = result.dataset.saved_increment.values - 1
    gap = float(np.abs(ours[ends] - truth[ends]).max())
    return {
        "delta_x, worst end of a branch": Known(gap, 0.0, float(np.ptp(truth))),
        "delta_x at the end": Known(ours[-1], truth[-1], float(np.ptp(truth)), "delta_x"),
    }


def wandering_drawn(figure: Figure, result: fret.Result) -> None:
    """The path, and force against shift."""
    path, curve = figure.subplots(1, 2)
    d = result.dataset
    path.plot(d.W / W, d.T_x / (MU * W), ".-", ms=3, lw=0.8)
    path.plot([0, 1], [0, 1], "k--", lw=0.8)
    path.plot([0, 1], [0, -1], "k--", lw=0.8)
    path.set(xlabel=r"$W/W_\max$", ylabel=r"$T_x/(\mu W_\max)$")
    curve.plot(springs(result, 2) * 1e6, d.T_x / (MU * W), lw=3, color="0.7", label="springs")
    curve.plot(d.delta_x * 1e6, d.T_x / (MU * W), ".-", ms=3, lw=0.8, label="ours")
    curve.set(xlabel=r"$\delta_x$ [µm]")
    curve.legend()


# --- Oblique --------------------------------------------------------------------------------------

SLOPE = 0.2


def oblique(n: int, increments: int = 3) -> fret.Scene:
    """W and T_x = W/5 together from nothing."""
    path = fret.LoadPath.start().force(W=W, T_x=SLOPE * W, increments=increments)
    scene = sphere(CORK, CORK, path, n=n)
    return scene.replace(settings=fret.Settings(tolerance=1e-9))


def oblique_known(result: fret.Result) -> dict[str, Known]:
    """Shear against k p, the stick ratio, and the shift."""
    at = result.at(-1)
    proportional = float(at.delta_z) * SLOPE * ROUND.E_star / (4 * CATTANEO.G_star)
    return {
        "q_x against k p, L2": l2(at.q_x.values, SLOPE * at.p.values),
        "stick ratio": Known(float(at.stick_ratio), 1.0),
        "delta_x": Known(float(at.delta_x), proportional, of="delta_x"),
    }


def oblique_drawn(figure: Figure, result: fret.Result) -> None:
    """Shear along x, and what it is off k p."""
    shear, off = figure.subplots(1, 2)
    at = result.at(-1)
    x, q = q_along_x(at)
    p = at.p.values[:, at.y.size // 2]
    fine = np.linspace(-1.1, 1.1, 401)
    shear.plot(fine, ROUND.p(np.abs(fine) * ROUND.a) / ROUND.p0, label="$k\\,p$ of Hertz")
    shear.plot(x / ROUND.a, q / (SLOPE * ROUND.p0), ".", ms=3, label="ours")
    shear.set(xlabel="$x/a$", ylabel="$q_x/(k\\,p_0)$")
    shear.legend()
    off.plot(x / ROUND.a, (q - SLOPE * p) / (SLOPE * ROUND.p0), ".-", ms=3, lw=0.8)
    off.set(xlabel="$x/a$", ylabel="$(q_x - k\\,p)/(k\\,p_0)$")


PAGES = (
    Truth(
        name="cattaneo_mindlin",
        title="Cattaneo-Mindlin",
        law=(
            "Similar spheres, $W$ constant, $T_x$ growing, $\\nu = 0$ so that the shear kernel is "
            "isotropic and the closed form exact: $c/a = (1 - T/(\\mu W))^{1/3}$, $\\delta_x = "
            "\\frac{3\\mu W}{16 a G^*}[1 - (1 - T/(\\mu W))^{2/3}]$ (C. Cattaneo 1938; R. D. "
            "Mindlin, J. Appl. Mech. 16 (1949) 259). The pressure stays, so that one increment "
            "from force to force is exact."
        ),
        scene=pushed,
        known=cattaneo_known,
        draw=cattaneo_drawn,
        placed=lambda n, place: pushed(n, stretched(place)),
        remark="The shear is over $\\mu p$ in the L2 norm.",
    ),
    Truth(
        name="mindlin_deresiewicz",
        title="Mindlin-Deresiewicz: a loop",
        law=(
            "$T_x$ to $0.9\\,\\mu W$, back and forth; the dissipated energy is $D = \\frac{9\\mu^2 "
            "W^2}{10 a G^*}\\{1-(1-q)^{5/3} - \\frac{5q}{6}[1+(1-q)^{2/3}]\\}$, $q = T_m/(\\mu W)$ "
            "(R. D. Mindlin, H. Deresiewicz, J. Appl. Mech. 20 (1953) 327)."
        ),
        scene=lambda n: loop(n, 25),
        known=loop_known,
        draw=loop_drawn,
        # Otherwise what the solver leaves would be in the errors.
        path=lambda k, _: loop(128, k).replace(settings=fret.Settings(tolerance=1e-8)),
        increments=(5, 25, 125),
        remark=(
            "The pressure stays, so that the number of increments makes no difference. (Runs that "
            "show that have a tolerance of 1e-8.)"
        ),
    ),
    Truth(
        name="torsion",
        title="Lubkin: torsion",
        law=(
            "$G a^2 \\varphi_z/(\\mu W) = \\frac{3}{4\\pi}[K(k) - E(k)]$, $k^2 = 1 - (c/a)^2$, "
            "exact "
            "for every $\\nu$ (J. L. Lubkin, J. Appl. Mech. 18 (1951) 183)."
        ),
        scene=twisted,
        known=twisted_known,
        draw=twisted_drawn,
        placed=lambda n, place: twisted(n, stretched(place)),
        # On 32 cells the smallest stick zone is one and a half cells wide.
        placed_grids=(64, 128, 256, 512),
    ),
    Truth(
        name="any_path",
        title="Any path of W and T",
        law=(
            "$W$ and $T_x$ wander through eight random states. Independent springs with friction "
            "give the shift of similar spheres with $\\nu = 0$ exactly (method of dimensionality "
            "reduction; V. L. Popov, M. Heß 2015)."
        ),
        scene=lambda n: wandering(n, 80),
        known=wandering_known,
        draw=wandering_drawn,
        grids=(32, 64, 128),
        path=lambda k, _: wandering(64, k),
        increments=(10, 20, 40, 80),
        remark="Errors are over the range of the shift.",
    ),
    Truth(
        name="oblique",
        title="Oblique loading from nothing",
        law=(
            "$W$ and $T_x = kW$, $k = 1/5 < \\mu$, grow together: nothing slips and $q_x = "
            "k\\,p$ in "
            "every cell, $\\delta_x = k\\,\\delta_z E^*/(4 G^*)$ (R. D. Mindlin, H. Deresiewicz "
            "1953)."
        ),
        scene=oblique,
        known=oblique_known,
        draw=oblique_drawn,
        path=lambda k, _: oblique(64, k),
        increments=(1, 5, 20),
        grids=(32, 64, 128),
        remark=(
            "Cells that come into contact within an increment stick where they entered; without "
            "that, five increments are off by a tenth."
        ),
    ),
)
