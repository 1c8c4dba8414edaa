"""Dissimilar bodies pressed together with friction."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

import pyfret as fret
from validation.scenes import CORK, STEEL, R, W, hertz, sphere
from validation.truth import Known, Truth

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Material on a rigid plane and friction coefficient of each page.
PAIRS = {
    "nu = 0, mu = 0.5": (CORK, 0.5),
    "nu = 0.3, mu = 0.2": (STEEL, 0.2),
    "nu = 0.3, mu = 0.5": (STEEL, 0.5),
}


def pressed(n: int, increments: int, *, pair: str) -> fret.Scene:
    """Indentation in increments of equal contact radius."""
    material, mu = PAIRS[pair]
    path = fret.LoadPath.start().force(
        W=W, increments=increments, spacing=fret.Spacing.EQUAL_RADIUS
    )
    return sphere(material, fret.RIGID, path, n=n, mu=mu, extent=2.2)


def closed_form(pair: str) -> tuple[fret.reference.CoupledIndentation, fret.reference.Hertz, float]:
    """The self-similar solution, Hertz's contact under the same load, and the contact radius."""
    material, mu = PAIRS[pair]
    beta = fret.reference.dundurs_beta(material, fret.RIGID)
    truth = fret.reference.coupled_indentation(beta=beta, mu=mu)
    round_ = hertz(material, fret.RIGID)
    return truth, round_, round_.a / np.cbrt(truth.W)


def known(result: fret.Result, *, pair: str) -> dict[str, Known]:
    """Stick ratio, radius, peak and approach at the end."""
    truth, round_, a = closed_form(pair)
    at = result.at(-1)
    return {
        "c/a": Known(float(np.sqrt(at.stick_ratio)), truth.stick_ratio),
        "a": Known(float(at.contact_radius), a, of="contact_radius"),
        "p(0)": Known(float(at.p_max), truth.p0 * truth.W ** (2 / 3) * round_.p0, of="p_max"),
        "delta_z": Known(float(at.delta_z), truth.delta_z * a**2 / R, of="delta_z"),
    }


def drawn(figure: Figure, result: fret.Result, *, pair: str) -> None:
    """The stick ratio as the contact grows, and tractions along x."""
    truth, round_, a = closed_form(pair)
    growth, tractions = figure.subplots(1, 2)
    d = result.dataset
    growth.plot(d.contact_radius / a, np.sqrt(d.stick_ratio), ".-", ms=3, lw=0.8, label="ours")
    growth.axhline(truth.stick_ratio, color="C1", label="closed form")
    growth.set(xlabel="contact radius over that at the end", ylabel="$c/a$", ylim=(0, 1.02))
    growth.legend()
    at = result.at(-1)
    middle = at.y.size // 2
    x, mu = at.x.values / a, PAIRS[pair][1]
    tractions.plot(x, at.p.values[:, middle] / round_.p0, label="$p$")
    tractions.plot(x, at.q_x.values[:, middle] / (mu * round_.p0), label=r"$q_x/\mu$")
    for side in (-1, 1):
        tractions.axvline(side * truth.stick_ratio, color="0.6", lw=0.8, ls="--")
    tractions.plot(0, truth.p0 * truth.W ** (2 / 3), "x", color="k", label="$p(0)$, closed form")
    tractions.set(xlabel="$x/a$", ylabel="over $p_H$")
    tractions.legend()


def page(pair: str) -> Truth:
    """The page of a pair."""
    return Truth(
        name="coupled_indentation_" + pair.replace(" = ", "").replace(", ", "_").replace(".", ""),
        title=f"Coupled indentation, {pair}, on a rigid plane",
        law=(
            "A sphere pressed on a rigid plane sticks in the middle and slips outside; contact and "
            "stick zone grow without changing their shape, so that $c/a$ does not depend on $W$ "
            "(D. A. Spence, J. Elasticity 5 (1975) 297; here by dual Abel transforms, fully "
            "coupled)."
        ),
        scene=lambda n: pressed(n, n // 2, pair=pair),
        known=partial(known, pair=pair),
        draw=partial(drawn, pair=pair),
        grids=(64, 128, 256),
        path=lambda k: pressed(128, k, pair=pair),
        increments=(10, 20, 40, 80),
        remark=(
            "On the ladder of grids the increments grow with the cells, so that an increment stays "
            "as long as a cell. A stick zone that grows is known to whole cells."
        ),
    )


PAGES = tuple(page(pair) for pair in PAIRS)
