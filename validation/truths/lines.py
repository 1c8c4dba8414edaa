"""Cylinders in plane strain."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

import pyfret as fret
from validation.scenes import LINE_W, MU, STEEL, R, cylinder, line, stretched
from validation.truth import Known, Truth, l2

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from validation.truth import Array

LINE = line()
T = 0.6 * MU * LINE_W
SHIFTED = 0.3 * 4 * MU * LINE.p0
HALF = LINE.stick_half_width(T=T, mu=MU)


def pressed() -> fret.LoadPath:
    """The cylinder pressed on."""
    return fret.LoadPath.start().normal(LINE_W, increments=1)


def stretched_in_phase(n: int, extent: float = 2.4) -> fret.Scene:
    """The tangential force and the bulk stress together."""
    path = pressed().force(T_x=T, sigma_B=SHIFTED, increments=10)
    return cylinder(path, n=n, extent=extent)


def q_bulk(x: Array) -> Array:
    """Shear with the bulk stress [Pa]."""
    eps_x = SHIFTED * (1 - STEEL.nu**2) / STEEL.E
    return LINE.q(x, T=T, mu=MU, middle=LINE.stick_middle(eps_x=eps_x, mu=MU))


def bulk_known(result: fret.Result) -> dict[str, Known]:
    """Contact width, stick ratio and tractions."""
    at = result.at(-1)
    x, sliding = at.x.values, MU * LINE.p(at.x.values)
    return {
        "contact width": Known(float(at.contact_area), 2 * LINE.a),
        "stick ratio": Known(float(at.stick_ratio), HALF / LINE.a, of="stick_ratio"),
        "p_max": Known(float(at.p_max), LINE.p0, of="p_max"),
        "p, L2": l2(at.p.values[:, 0], LINE.p(x)),
        "q_x, L2": l2(at.q_x.values[:, 0], q_bulk(x), sliding),
    }


def bulk_drawn(figure: Figure, result: fret.Result) -> None:
    """Shear along x."""
    ax = figure.subplots()
    at = result.at(-1)
    x = np.linspace(-1.1, 1.1, 801) * LINE.a
    ax.plot(x / LINE.a, q_bulk(x) / (MU * LINE.p0), label="closed form")
    ax.plot(
        x / LINE.a,
        LINE.q(x, T=T, mu=MU) / (MU * LINE.p0),
        "--",
        color="0.6",
        label="without the bulk stress",
    )
    ax.plot(at.x / LINE.a, at.q_x.values[:, 0] / (MU * LINE.p0), ".", ms=3, label="ours")
    ax.set(xlabel="$x/a$", ylabel=r"$q_x/(\mu p_0)$")
    ax.legend()


#: Way rolled over the half-width.
WAY = 6.0


def rolling(n: int, extent: float = 2.4) -> fret.Scene:
    """Rolling by a cell an increment."""
    dx = extent * LINE.a / n
    steps = round(WAY * LINE.a / dx)
    path = pressed().tangential(T, increments=1).force(rolled=steps * dx, increments=steps)
    scene = cylinder(path, n=n, extent=extent)
    # What increments leave of slip shows in the border of the stick zone after a thousand of them.
    return scene.replace(settings=fret.Settings(tolerance=1e-9))


def rolling_known(result: fret.Result) -> dict[str, Known]:
    """Creepage, stick ratio and shear at the end."""
    at = result.at(-1)
    d = result.dataset
    creepage = float((d.delta_x[-1] - d.delta_x[-2]) / (d.rolled[-1] - d.rolled[-2]))
    x = at.x.values
    carter = LINE.q(x, T=T, mu=MU, middle=LINE.a - HALF)
    return {
        "creepage": Known(creepage, MU * (LINE.a - HALF) / R),
        "stick ratio": Known(float(at.stick_ratio), HALF / LINE.a),
        "q_x, L2": l2(at.q_x.values[:, 0], carter, MU * LINE.p(x)),
    }


def rolling_drawn(figure: Figure, result: fret.Result) -> None:
    """Shear before and after, and the creepage on the way."""
    shear, creep = figure.subplots(1, 2)
    x = np.linspace(-1.1, 1.1, 801) * LINE.a
    for which, middle, name in ((2, 0.0, "Cattaneo"), (-1, LINE.a - HALF, "Carter")):
        at = result.at(which)
        (drawn,) = shear.plot(
            x / LINE.a, LINE.q(x, T=T, mu=MU, middle=middle) / (MU * LINE.p0), lw=1, label=name
        )
        q = at.q_x.values[:, 0] / (MU * LINE.p0)
        shear.plot(at.x / LINE.a, q, ".", ms=3, color=drawn.get_color())
    shear.set(xlabel="$x/a$", ylabel=r"$q_x/(\mu p_0)$", title="lines: closed form, dots: ours")
    shear.legend()
    d = result.dataset
    slope = np.diff(d.delta_x.values[1:]) / np.diff(d.rolled.values[1:])
    creep.plot(d.rolled.values[2:] / LINE.a, slope * R / (MU * (LINE.a - HALF)))
    creep.axhline(1.0, color="0.4", ls="--", lw=0.8)
    creep.set(xlabel="way rolled over $a$", ylabel="creepage over Carter's")
    creep.set_ylim(bottom=0.0)


PAGES = (
    Truth(
        name="cylinder_bulk_stress",
        title="Cattaneo's cylinder with a bulk stress",
        law=(
            "Plane strain, $T_x = 0.6\\,\\mu W$ and a bulk stress in body 2 in phase: the stick "
            "zone "
            "keeps its width and moves by $a\\,\\sigma_B/(4\\mu p_0)$ (D. Nowell, D. A. Hills, "
            "Int. J. "
            "Mech. Sci. 29 (1987) 355)."
        ),
        scene=stretched_in_phase,
        known=bulk_known,
        draw=bulk_drawn,
        grids=(64, 128, 256, 512),
        placed=lambda n, place: stretched_in_phase(n, stretched(place)),
        placed_grids=(64, 128, 256, 512),
    ),
    Truth(
        name="carter",
        title="Carter: rolling",
        law=(
            "A cylinder that rolls under $T_x = 0.6\\,\\mu W$: the stick zone moves to the leading "
            "edge and the creepage tends to $\\mu(a - c)/R$ (F. W. Carter, Proc. R. Soc. A 112 "
            "(1926) 151)."
        ),
        scene=rolling,
        known=rolling_known,
        draw=rolling_drawn,
        has_error_bars=False,
        grids=(64, 128, 256, 512),
        placed=lambda n, place: rolling(n, stretched(place)),
        remark=f"After a way of {WAY:g} half-widths the transient is nearly over.",
    ),
)
