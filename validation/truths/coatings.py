"""Coated bodies: indentation, thin layers, kernels."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

import pyfret as fret
from validation.scenes import STEEL, R, W, hertz
from validation.truth import Known, Truth, l2
from validation.truths.bodies import distance

if TYPE_CHECKING:
    from matplotlib.figure import Figure

BARE = hertz(fret.RIGID, STEEL)
#: E1/E2 and h/a0 of each page.
ROWS = ((0.25, 0.25), (2.0, 0.25), (0.5, 0.5), (4.0, 0.5), (0.25, 1.0), (2.0, 1.0), (4.0, 2.0))


def coating(ratio: float, h: float) -> fret.Coating:
    """A coating of E1 = ratio E2 and thickness h a0."""
    material = fret.Elastic(E=ratio * STEEL.E, nu=STEEL.nu)
    return fret.Coating(material, thickness=h * BARE.a)


def closed_form(ratio: float, h: float) -> fret.reference.CoatedIndentation:
    """The solution of the integral equation."""
    return fret.reference.coated_indentation(
        R=R, indenter=fret.RIGID, coating=coating(ratio, h), substrate=STEEL, W=W
    )


def pressed(n: int, *, ratio: float, h: float) -> fret.Scene:
    """A rigid sphere on the coated body."""
    return fret.Scene(
        body1=fret.Body(fret.RIGID, shape=fret.Sphere(R=R)),
        body2=fret.Body(STEEL, coatings=[coating(ratio, h)]),
        friction=0.0,
        grid=fret.Grid.centred(width=2.4 * closed_form(ratio, h).a, n=n),
        path=fret.LoadPath.start().normal(W, increments=1),
    )


def known(result: fret.Result, *, ratio: float, h: float) -> dict[str, Known]:
    """Radius, peak, approach and the pressure as a field."""
    truth, at = closed_form(ratio, h), result.at(-1)
    p = truth.p(distance(at))
    return {
        "a": Known(float(at.contact_radius), truth.a, of="contact_radius"),
        "p_max": Known(float(at.p_max), float(truth.p(0.0)), of="p_max"),
        "delta_z": Known(float(at.delta_z), truth.delta_z, of="delta_z"),
        "p, L2": l2(at.p.values, p),
        "p continued to the rim, L2": l2(at.p_continued().values, p),
    }


def drawn(figure: Figure, result: fret.Result, *, ratio: float, h: float) -> None:
    """Pressure along x and what it is off."""
    truth, at = closed_form(ratio, h), result.at(-1)
    whole, off = figure.subplots(1, 2)
    middle = at.y.size // 2
    x, y = at.x.values, float(at.y[middle])
    p = at.p.values[:, middle]
    fine = np.linspace(-1.15, 1.15, 401) * truth.a
    whole.plot(fine / BARE.a, truth.p(np.abs(fine)) / BARE.p0, label="integral equation")
    whole.plot(x / BARE.a, p / BARE.p0, ".", ms=3, label="ours")
    whole.plot(fine / BARE.a, BARE.p(np.abs(fine)) / BARE.p0, "--", color="0.6", label="bare")
    whole.set(xlabel="$x/a_0$", ylabel="$p/p_0$")
    whole.legend()
    off.plot(x / truth.a, (p - truth.p(np.hypot(x, y))) / BARE.p0, ".-", ms=3, lw=0.8)
    off.set(xlabel="$x/a$", ylabel="error over $p_0$")


def page(ratio: float, h: float) -> Truth:
    """The page of a coating."""
    return Truth(
        name=f"coated_{ratio:g}_{h:g}".replace(".", ""),
        title=f"Coated indentation, E1/E2 = {ratio:g}, h = {h:g} a0",
        law=(
            "A rigid sphere on a coated half-space, no friction: the dual integral equations of "
            "the "
            "layered response, solved by Gauss quadrature. $a_0$, $p_0$ are Hertz's of the bare "
            "substrate."
        ),
        scene=partial(pressed, ratio=ratio, h=h),
        known=partial(known, ratio=ratio, h=h),
        draw=partial(drawn, ratio=ratio, h=h),
    )


# --- Thin compressible layer ----------------------------------------------------------------------

LAYER = fret.Elastic(E=1e9, nu=0.3)
#: Thickness of the layer [m] and the contact radius on it over that thickness.
THICKNESS, WIDE = 2e-6, 1000.0
#: Modulus of a layer that cannot spread sideways [Pa].
M = 2 * LAYER.G * (1 - LAYER.nu) / (1 - 2 * LAYER.nu)
THIN_W = np.pi * M * (WIDE * THICKNESS) ** 4 / (4 * THICKNESS * R)


def thin(n: int) -> fret.Scene:
    """A rigid sphere on a thin layer on a rigid base."""
    return fret.Scene(
        body1=fret.Body(fret.RIGID, shape=fret.Sphere(R=R)),
        body2=fret.Body(fret.RIGID, coatings=[fret.Coating(LAYER, thickness=THICKNESS)]),
        friction=0.0,
        grid=fret.Grid.centred(width=2.4 * WIDE * THICKNESS, n=n),
        path=fret.LoadPath.start().normal(THIN_W, increments=1),
    )


def thin_known(result: fret.Result) -> dict[str, Known]:
    """Radius, peak and approach."""
    at, a = result.at(-1), WIDE * THICKNESS
    return {
        "a": Known(float(at.contact_radius), a),
        "p_max": Known(float(at.p_max), M * a**2 / (2 * R * THICKNESS)),
        "delta_z": Known(float(at.delta_z), a**2 / (2 * R)),
    }


def thin_drawn(figure: Figure, result: fret.Result) -> None:
    """The parabolic pressure."""
    ax = figure.subplots()
    at, a = result.at(-1), WIDE * THICKNESS
    x = at.x.values
    top = M * a**2 / (2 * R * THICKNESS)
    ax.plot(x / a, np.maximum(1 - (x / a) ** 2, 0), label="thin layer")
    ax.plot(x / a, at.p.values[:, at.y.size // 2] / top, ".", ms=3, label="ours")
    ax.set(xlabel="$x/a$", ylabel="$p/p_0$")
    ax.legend()


PAGES = (
    *(page(ratio, h) for ratio, h in ROWS),
    Truth(
        name="thin_layer",
        title="A thin compressible layer on a rigid base",
        law=(
            "$p = (M/h)(\\delta_z - r^2/2R)$, $M = 2G(1-\\nu)/(1-2\\nu)$, $W = \\pi M "
            "a^4/(4hR)$: the "
            "limit of a layer much thinner than the contact (K. L. Johnson, Contact Mechanics, "
            "sec. 5.8), here $a = 1000\\,h$."
        ),
        scene=thin,
        known=thin_known,
        draw=thin_drawn,
        remark="The limit itself is off by about $h/a$: the errors tend to that, not to zero.",
    ),
)
