"""The bodies that the closed forms are about."""

from __future__ import annotations

import pyfret as fret

R, W, MU = 0.018, 1e3, 0.3
#: Force per length of cylinders [N/m].
LINE_W = 1e5
STEEL = fret.Elastic(E=210e9, nu=0.3)
#: Without lateral contraction the shear kernel is isotropic.
CORK = fret.Elastic(E=210e9, nu=0.0)


def hertz(upper: fret.Elastic, lower: fret.Elastic) -> fret.reference.Hertz:
    """The Hertz contact of a pair."""
    return fret.reference.hertz(R=R, bodies=(upper, lower), W=W)


def sphere(
    upper: fret.Elastic,
    lower: fret.Elastic,
    path: fret.LoadPath,
    *,
    n: int,
    mu: float = MU,
    extent: float = 2.4,
) -> fret.Scene:
    """A sphere on a flat, on a square of `extent` Hertz radii."""
    side = extent * hertz(upper, lower).a
    return fret.Scene(
        body1=fret.Body(upper, shape=fret.Sphere(R=R)),
        body2=fret.Body(lower),
        friction=mu,
        grid=fret.Grid.centred(width=side, n=n),
        path=path,
    )


def stretched(place: int) -> float:
    """Extents that put the rim at different places within the cells, over the contact radius."""
    return 2.3 * (1 + 0.0137 * place)


def cylinder(path: fret.LoadPath, *, n: int, extent: float = 2.4) -> fret.Scene:
    """A steel cylinder on a steel flat, plane strain, on a strip of `extent` half-widths."""
    return fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Cylinder(R=R)),
        body2=fret.Body(STEEL),
        friction=MU,
        grid=fret.Grid.strip(extent=extent * line().a, n=n),
        path=path,
    )


def line() -> fret.reference.LineContact:
    """The line contact of that cylinder."""
    return fret.reference.line_contact(R=R, bodies=(STEEL, STEEL), W=LINE_W)
