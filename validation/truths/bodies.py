"""Frictionless contacts of homogeneous bodies."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

import pyfret as fret
from validation.scenes import CORK, MU, STEEL, R, W, hertz, sphere, stretched
from validation.truth import Known, Truth, l2

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from validation.truth import Array

ROUND = hertz(STEEL, STEEL)


def pressed(n: int, extent: float = 2.4) -> fret.Scene:
    """A steel sphere pressed on a steel flat without friction."""
    path = fret.LoadPath.start().normal(W, increments=1)
    return sphere(STEEL, STEEL, path, n=n, mu=0.0, extent=extent)


def distance(at: fret.Snapshot) -> Array:
    """Distance of the cells from the middle [m], shape (nx, ny)."""
    r: Array = np.hypot(at.x.values[:, None], at.y.values[None, :])
    return r


def hertz_known(result: fret.Result) -> dict[str, Known]:
    """Radius, peak, approach and the pressure as a field."""
    at = result.at(-1)
    p = ROUND.p(distance(at))
    return {
        "a": Known(float(at.contact_radius), ROUND.a, of="contact_radius"),
        "p_max": Known(float(at.p_max), ROUND.p0, of="p_max"),
        "delta_z": Known(float(at.delta_z), ROUND.delta_z, of="delta_z"),
        "p, L2": l2(at.p.values, p),
        "p continued to the rim, L2": l2(at.p_continued().values, p),
    }


def hertz_drawn(figure: Figure, result: fret.Result) -> None:
    """Pressure along x, and its error near the rim."""
    whole, rim = figure.subplots(1, 2)
    at = result.at(-1)
    middle = at.y.size // 2
    x, y = at.x.values, float(at.y[middle])
    truth = ROUND.p(np.hypot(x, y))
    fine = np.linspace(-1.1, 1.1, 401)
    whole.plot(fine, ROUND.p(np.abs(fine) * ROUND.a) / ROUND.p0, label="Hertz")
    whole.plot(x / ROUND.a, at.p.values[:, middle] / ROUND.p0, ".", ms=3, label="ours")
    whole.set(xlabel="$x/a$", ylabel="$p/p_0$")
    whole.legend()
    cells = (ROUND.a - np.hypot(x, y)) / (x[1] - x[0])
    near = (x > 0) & (cells < 8) & (cells > -2)
    for p, label in ((at.p, "$p$"), (at.p_continued(), "$p$ continued to the rim")):
        error = (p.values[:, middle] - truth)[near] / ROUND.p0
        rim.plot(cells[near], error, "o-", label=label)
    rim.set(xlabel="cells from the rim", ylabel="error over $p_0$")
    rim.legend()


#: Relative radii of the ellipse.
STEEP, SHALLOW = R, 2.8 * R
OVAL = fret.reference.hertz_ellipse(R_x=SHALLOW, R_y=STEEP, E_star=CORK.E / 2, W=W)
#: Tangential force over mu W on the ellipse; its stick zone is the contact, this part as long.
T_OVAL = 0.6
STICK_OVAL = (1 - T_OVAL) ** (1 / 3)


def oval(n: int) -> fret.Scene:
    """An ellipsoid on a flat, as many cells along either axis."""
    path = fret.LoadPath.start().normal(W, increments=1)
    return fret.Scene(
        body1=fret.Body(CORK, shape=fret.shapes.Ellipsoid(R_x=SHALLOW, R_y=STEEP)),
        body2=fret.Body(CORK),
        friction=MU,
        grid=fret.Grid.from_spacing((n, n), (2.4 * OVAL.a_x / n, 2.4 * OVAL.a_y / n)),
        path=path.tangential(T_OVAL * MU * W, increments=1),
    )


def oval_known(result: fret.Result) -> dict[str, Known]:
    """Area, peak, approach, stick ratio and the pressure as a field."""
    at = result.at(-1)
    x, y = at.x.values[:, None] / OVAL.a_x, at.y.values[None, :] / OVAL.a_y
    p = OVAL.p0 * np.sqrt(np.maximum(1 - x**2 - y**2, 0))
    return {
        "contact area": Known(float(at.contact_area), np.pi * OVAL.a_x * OVAL.a_y),
        "p_max": Known(float(at.p_max), OVAL.p0, of="p_max"),
        "delta_z": Known(float(at.delta_z), OVAL.delta_z, of="delta_z"),
        "stick ratio": Known(float(at.stick_ratio), STICK_OVAL**2, of="stick_ratio"),
        "p, L2": l2(at.p.values, p),
    }


def oval_drawn(figure: Figure, result: fret.Result) -> None:
    """Contact and stick zone, and the pressure along both axes."""
    zones, profile = figure.subplots(1, 2)
    at = result.at(-1)
    x, y = at.x.values / OVAL.a_x, at.y.values / OVAL.a_y
    cells = at.contact.values.astype(int) + at.stick.values.astype(int)
    zones.pcolormesh(x, y, cells.T, cmap="Greys", vmax=3, shading="nearest")
    angle = np.linspace(0, 2 * np.pi, 200)
    for part, label in ((1.0, "contact"), (STICK_OVAL, "stick zone")):
        zones.plot(part * np.cos(angle), part * np.sin(angle), label=label)
    zones.set(aspect="equal", xlabel="$x/a_x$", ylabel="$y/a_y$")
    zones.legend(loc="upper right")
    s = np.linspace(-1.1, 1.1, 401)
    profile.plot(s, np.sqrt(np.maximum(1 - s**2, 0)), color="0.3", label="closed form")
    middle = at.x.size // 2
    profile.plot(x, at.p.values[:, middle] / OVAL.p0, ".", ms=3, label="along $x/a_x$")
    profile.plot(y, at.p.values[middle, :] / OVAL.p0, "x", ms=3, label="along $y/a_y$")
    profile.set(ylabel="$p/p_0$")
    profile.legend()


PAGES = (
    Truth(
        name="hertz",
        title="Hertz",
        law=(
            "Two paraboloids, no friction: $a^3 = 3WR/(4E^*)$, $p_0 = 3W/(2\\pi a^2)$, "
            "$\\delta_z = a^2/R$, $p = p_0\\sqrt{1-r^2/a^2}$ (K. L. Johnson, Contact Mechanics, "
            "eq. 4.22-4.24)."
        ),
        scene=pressed,
        known=hertz_known,
        draw=hertz_drawn,
        placed=lambda n, place: pressed(n, stretched(place)),
        remark=(
            "The rim is where the square of the pressure, continued from the third cell on, "
            "vanishes. Tractions are constant on a cell: the outermost cell carries up to a tenth "
            "more or less than the pressure at its centre, and that is nearly all of the error of "
            "the field."
        ),
    ),
    Truth(
        name="ellipse",
        title="Ellipse of Hertz and Cattaneo",
        law=(
            "Two principal radii, 2.8 to 1, $\\nu = 0$: an elliptical contact "
            "(K. L. Johnson, Contact Mechanics, sec. 4.2), and under $T_x = 0.6\\,\\mu W$ a stick "
            "zone of its shape, $(1 - T/(\\mu W))^{1/3}$ as long."
        ),
        scene=oval,
        known=oval_known,
        draw=oval_drawn,
    ),
)
