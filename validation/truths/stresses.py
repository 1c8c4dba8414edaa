"""Stress below the contact."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

import pyfret as fret
from pyfret.plot.stresses import SYMBOLS
from validation.scenes import LINE_W, MU, STEEL, W, cylinder, hertz, line, sphere
from validation.truth import Known, Truth, l2

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from validation.truth import Array

ROUND, LINE = hertz(STEEL, STEEL), line()
CATTANEO = fret.reference.CattaneoMindlin(ROUND, bodies=(STEEL, STEEL), mu=MU)
DEPTHS = np.linspace(0.05, 2.0, 40) * ROUND.a
LINE_T = 0.6 * MU * LINE_W


def hamilton(z: Array) -> dict[str, Array]:
    """Stress on the axis of a sphere: G. M. Hamilton, Proc. IMechE 197C (1983) 53."""
    a, nu, scale = ROUND.a, STEEL.nu, 3 * W / (2 * np.pi * ROUND.a**3)
    across = (1 + nu) * (z * np.arctan(a / z) - a) + a**3 / (2 * (a**2 + z**2))
    return {"s_xx": scale * across, "s_zz": -scale * a**3 / (a**2 + z**2)}


def below(result: fret.Result) -> fret.subsurface.Stress:
    """Stress along the axis."""
    return result.at(-1).stress(DEPTHS, x=0.0, y=0.0)


def axis_known(result: fret.Result) -> dict[str, Known]:
    """Components along the axis, and the largest von Mises stress there."""
    ours, truth = below(result), hamilton(DEPTHS)
    known = {f"{k}, L2": l2(ours.measure(k).values, s) for k, s in truth.items()}
    mises = np.abs(truth["s_zz"] - truth["s_xx"]).max()
    known["largest von Mises"] = Known(float(ours.von_mises.max()), float(mises))
    return known


def axis_drawn(figure: Figure, result: fret.Result) -> None:
    """Components over depth."""
    ax = figure.subplots()
    ours = below(result)
    for name, s in hamilton(DEPTHS).items():
        (drawn,) = ax.plot(DEPTHS / ROUND.a, s / ROUND.p0, lw=1, label=f"${SYMBOLS[name]}$")
        values = ours.measure(name).values / ROUND.p0
        ax.plot(DEPTHS / ROUND.a, values, ".", ms=4, color=drawn.get_color())
    ax.set(xlabel="$z/a$", ylabel=r"$\sigma/p_0$", title="lines: closed form, dots: ours")
    ax.legend()


# --- Sliding sphere -------------------------------------------------------------------------------

#: Depths over the contact radius.
BELOW = (0.1, 0.25, 0.5, 1.0)
NAMES = ("s_xx", "s_yy", "s_zz", "s_xy", "s_xz", "s_yz")


def slid(n: int) -> fret.Scene:
    """Pressed, and moved along x far beyond the shift at which everything slips."""
    path = fret.LoadPath.start().normal(W, increments=1)
    shift = 300 * CATTANEO.shift_limit
    return sphere(STEEL, STEEL, path.displace(delta_x=shift, increments=4), n=n, extent=2.4)


def slid_stress(result: fret.Result, z: float) -> tuple[Array, dict[str, Array], dict[str, Array]]:
    """Places on the row of cells next to y = 0, our components and Hamilton's at a depth over a."""
    at = result.at(-1)
    y = float(at.y.values[at.y.size // 2])
    ours = at.stress([z * ROUND.a], y=y)
    x = ours.s_xx.x.values
    form = fret.reference.HertzStress(a=ROUND.a, nu=STEEL.nu)
    pairs = zip(form.pressure(x, y, z * ROUND.a), form.shear(x, y, z * ROUND.a), strict=True)
    truth = [ROUND.p0 * (p + MU * q) for p, q in pairs]
    return (
        x,
        {name: ours.measure(name).values.ravel() for name in NAMES},
        dict(zip(NAMES, truth, strict=True)),
    )


def slid_known(result: fret.Result) -> dict[str, Known]:
    """All components along x, and the largest von Mises stress there, at every depth."""
    known = {}
    for z in BELOW:
        _, ours, truth = slid_stress(result, z)
        every = [np.concatenate([s[name] for name in NAMES]) for s in (ours, truth)]
        known[f"stress at {z:g} a, L2"] = l2(*every)
        largest, true = (float(von_mises(s).max()) for s in (ours, truth))
        known[f"largest von Mises at {z:g} a"] = Known(largest, true)
    return known


def von_mises(s: dict[str, Array]) -> Array:
    """Von Mises stress [Pa]."""
    normal = (s["s_xx"] - s["s_yy"]) ** 2 + (s["s_yy"] - s["s_zz"]) ** 2
    normal = (normal + (s["s_zz"] - s["s_xx"]) ** 2) / 2
    shear = 3 * (s["s_xy"] ** 2 + s["s_xz"] ** 2 + s["s_yz"] ** 2)
    mises: Array = np.sqrt(normal + shear)
    return mises


def slid_drawn(figure: Figure, result: fret.Result) -> None:
    """s_xx and s_xz along x at every depth."""
    for ax, name in zip(figure.subplots(1, 2), ("s_xx", "s_xz"), strict=True):
        for z in BELOW:
            x, ours, truth = slid_stress(result, z)
            (drawn,) = ax.plot(x / ROUND.a, truth[name] / ROUND.p0, lw=1, label=f"$z = {z:g}\\,a$")
            ax.plot(x / ROUND.a, ours[name] / ROUND.p0, ".", ms=2, color=drawn.get_color())
        ax.set(
            xlabel="$x/a$", ylabel=f"${SYMBOLS[name]}/p_0$", title="lines: closed form, dots: ours"
        )
        ax.legend()


PLACES = (0.1, 0.5, 1.0)


def line_stress(result: fret.Result, z: float) -> tuple[Array, dict[str, Array], dict[str, Array]]:
    """Places, our components and McEwen's at a depth over a."""
    at = result.at(-1).stress([z * LINE.a], y=0.0)
    x = at.s_xx.x.values
    names = ("s_xx", "s_zz", "s_xz")
    ours = {name: at.measure(name).values.ravel() for name in names}
    truth = LINE.stress(x, z * LINE.a, T=LINE_T, mu=MU)
    return x, ours, dict(zip(names, truth, strict=True))


def line_known(result: fret.Result) -> dict[str, Known]:
    """Every component at every depth, over the peak pressure."""
    known = {}
    for z in PLACES:
        _, ours, truth = line_stress(result, z)
        for name, s in truth.items():
            known[f"{name} at {z:g} a, L2"] = l2(ours[name], s)
    return known


def line_drawn(figure: Figure, result: fret.Result) -> None:
    """s_xx and s_xz along x at every depth."""
    for ax, name in zip(figure.subplots(1, 2), ("s_xx", "s_xz"), strict=True):
        for z in PLACES:
            x, ours, truth = line_stress(result, z)
            (drawn,) = ax.plot(x / LINE.a, truth[name] / LINE.p0, lw=1, label=f"$z = {z:g}\\,a$")
            ax.plot(x / LINE.a, ours[name] / LINE.p0, ".", ms=2, color=drawn.get_color())
        ax.set(
            xlabel="$x/a$", ylabel=f"${SYMBOLS[name]}/p_0$", title="lines: closed form, dots: ours"
        )
        ax.legend()


PAGES = (
    Truth(
        name="hamilton",
        title="Hamilton: stress on the axis of a sphere",
        law=(
            "$\\sigma_{zz} = -p_0 a^2/(a^2 + z^2)$ and $\\sigma_{xx}$ below a frictionless sphere "
            "(G. M. Hamilton, Proc. IMechE 197C (1983) 53), $z$ from $0.05\\,a$ to $2\\,a$."
        ),
        scene=lambda n: sphere(
            STEEL, STEEL, fret.LoadPath.start().normal(W, increments=1), n=n, mu=0.0
        ),
        known=axis_known,
        draw=axis_drawn,
    ),
    Truth(
        name="sliding_sphere",
        title="Hamilton: stress below a sliding sphere",
        law=(
            "A sphere that slides along $+x$, $\\mu = 0.3$, $\\nu = 0.3$: stresses of the "
            "pressure and of $q_x = \\mu p$ (G. M. Hamilton, Proc. IMechE 197C (1983) 53), along "
            "$x$ at four depths."
        ),
        scene=slid,
        known=slid_known,
        draw=slid_drawn,
        has_error_bars=False,
        remark=(
            "Moved a long way: at first slip has a small part across, $u_y$ of the shear itself, "
            "which Hamilton's leaves out; once that no longer changes the shear is along $x$."
        ),
    ),
    Truth(
        name="mcewen",
        title="McEwen: stress below a cylinder in partial slip",
        law=(
            "Plane strain, $T_x = 0.6\\,\\mu W$: the difference of two elliptical tractions (E. "
            "McEwen, "
            "Phil. Mag. 40 (1949) 454)."
        ),
        scene=lambda n: cylinder(
            fret.LoadPath.start().normal(LINE_W, increments=1).tangential(LINE_T, increments=1),
            n=n,
        ),
        known=line_known,
        draw=line_drawn,
        grids=(64, 128, 256, 512),
    ),
)
