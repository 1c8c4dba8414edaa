"""Dissimilar bodies pressed together with friction."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

import pyfret as fret
from validation.scenes import CORK, STEEL, R, W, hertz, sphere, stretched
from validation.truth import PLACES, Known, Truth
from validation.truths.bodies import distance

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Material on a rigid plane and friction coefficient of each page.
PAIRS = {
    "nu = 0, mu = 0.5": (CORK, 0.5),
    "nu = 0.3, mu = 0.2": (STEEL, 0.2),
    "nu = 0.3, mu = 0.5": (STEEL, 0.5),
}


def pressed(n: int, increments: int, *, pair: str, extent: float = 2.2) -> fret.Scene:
    """Indentation in increments of equal contact radius."""
    material, mu = PAIRS[pair]
    path = fret.LoadPath.start().force(
        W=W, increments=increments, spacing=fret.Spacing.EQUAL_RADIUS
    )
    return sphere(material, fret.RIGID, path, n=n, mu=mu, extent=extent)


def closed_form(pair: str) -> tuple[fret.reference.CoupledIndentation, fret.reference.Hertz, float]:
    """The self-similar solution, Hertz's contact under the same load, and the contact radius."""
    material, mu = PAIRS[pair]
    beta = fret.reference.dundurs_beta(material, fret.RIGID)
    truth = fret.reference.coupled_indentation(beta=beta, mu=mu)
    round_ = hertz(material, fret.RIGID)
    return truth, round_, round_.a / np.cbrt(truth.W)


#: Distances from the axis between which the pressure is continued to it, over the square root of
#: cell times contact radius; with these the errors on all ladders of grids are small together.
TIP = (0.4, 2.0)


def tip(at: fret.Snapshot) -> float:
    """Pressure on the axis [Pa]: a parabola in the distance from it, by least squares.

    The slip that the stick zone has frozen in grows like the square of the distance, and so p has a
    cone on the axis. In the cells next to it that is what a contact of these few cells left, which
    dies out with the distance in cells; what a parabola leaves grows with the distance over the
    contact radius. Together they are least at a distance in between.
    """
    between = float(np.sqrt((at.x[1] - at.x[0]) * at.contact_radius))
    r = distance(at) / between
    near = (r >= TIP[0]) & (r < TIP[1])
    return float(np.polynomial.polynomial.polyfit(r[near], at.p.values[near], 2)[0])


def known(result: fret.Result, *, pair: str) -> dict[str, Known]:
    """Stick ratio, radius, peak and approach at the end."""
    truth, round_, a = closed_form(pair)
    at = result.at(-1)
    return {
        "c/a": Known(float(np.sqrt(at.stick_ratio)), truth.stick_ratio),
        "a": Known(float(at.contact_radius), a, of="contact_radius"),
        "p(0)": Known(tip(at), truth.p0 * truth.W ** (2 / 3) * round_.p0),
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


#: Cells of a slip ring that tell neither its border nor the rim.
THIN = 4


def slip_ring(pair: str) -> float:
    """Width of the slip ring at the end, in cells of 256 a side."""
    return (1 - closed_form(pair)[0].stick_ratio) * 256 / 2.2


def thin_ring(pair: str) -> str:
    """What a slip ring of few cells does to the radii."""
    if slip_ring(pair) > THIN:
        return ""
    return (
        f" Here the slip ring is {slip_ring(pair):.1f} cells wide on 256 cells a side: the cells "
        "that determine the rim lie in the stick zone, where the pressure follows another law, and "
        "a is off by up to a fifth of a cell until the ring is five cells wide."
    )


def page(pair: str) -> Truth:
    """The page of a pair."""
    thin = slip_ring(pair) < THIN
    # Where only fine grids tell, an increment is as long as four cells.
    coarser = 8 if thin else 2
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
        path=lambda k, place: pressed(384 if thin else 256, k, pair=pair, extent=stretched(place)),
        increments=(40, 80, 160, 320) if thin else (5, 10, 20, 40, 80),
        path_places=2 if thin else PLACES // 2,
        placed=lambda n, place: pressed(n, n // coarser, pair=pair, extent=stretched(place)),
        placed_grids=(192, 384, 768) if thin else (64, 96, 128, 192),
        places=2 if thin else PLACES,
        remark=(
            "On the ladders of grids the increments grow with the cells, so that an increment "
            f"stays as long as {'one cell, and four' if thin else 'a cell'}. p has a cone on the "
            "axis and is continued to it "
            f"by a parabola from {TIP[0]:g} to {TIP[1]:g} times the root of cell times contact "
            "radius away; the cell next to it is below p(0) by an error of first order."
            + thin_ring(pair)
        ),
    )


PAGES = tuple(page(pair) for pair in PAIRS)
