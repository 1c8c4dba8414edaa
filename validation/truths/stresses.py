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
