"""Figures of the contact temperature."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from pyfret._util.theme import colour_map
from pyfret.plot.scales import Units, scales
from pyfret.plot.sizes import Width
from pyfret.plot.style import add_colour_bar, axes, draw_cross, styled
from pyfret.plot.tables import must_hold

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

#: How the fields of a temperature are called in figures.
NAMES = {
    "steady": "mean temperature",
    "largest": "largest temperature",
    "flash": "largest less mean temperature",
}
#: Relative difference of temperatures that a figure cannot show.
SAME = 1e-3
#: Variables of temperatures, and what computes them.
FOUND = ("x", "y", "body", *NAMES)
MADE = "temperatures, result.temperature(conductor1, conductor2, frequency=...)"


def _degrees(temperatures: xr.Dataset) -> str:
    """Symbol of the temperature: a rise where the bodies are at 0 far away."""
    return r"\Delta T" if not np.any(temperatures.attrs["bulk"]) else "T"


@styled
def temperature(
    temperatures: xr.Dataset,
    *,
    units: Units = "auto",
    width: Width | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Mean and largest temperature of a cycle along x, through the hottest place, of both bodies.

    Where the bodies touch their mean and instantaneous temperatures are the same.

    Parameters
    ----------
    temperatures : xarray.Dataset
        From :meth:`Result.temperature`.
    units : "auto", "dimensionless" or "SI"
        Of the lengths: over a_H (default where there is one), or in um.
    width : "column" or "page", optional
        Width of a new figure: a column of 85 mm or a page of 170 mm.
    ax : matplotlib Axes, optional
        Where to draw.
    """
    must_hold(temperatures, "temperatures", FOUND, MADE)
    ax = axes(ax)
    length = scales(temperatures.attrs, units).length
    cut = temperatures.sel(y=temperatures.attrs["maximum_y"])
    for name, shown, colour in (("largest", "largest", "C1"), ("steady", "mean", "C0")):
        first, second = (cut[name].sel(body=body).values for body in (1, 2))
        # One line where both are as hot.
        same = bool(np.allclose(first, second, rtol=SAME, atol=0.0))
        curves = [(first, "-", "both bodies" if same else "body 1")]
        curves += [] if same else [(second, "--", "body 2")]
        for values, style, body in curves:
            label = f"{shown}, {body}"
            ax.plot(cut.x / length.value, values, color=colour, linestyle=style, label=label)
    ax.legend()
    ax.set_xlabel(length.label("x"))
    ax.set_ylabel(rf"${_degrees(temperatures)}$ [K]")
    return ax


@styled
def temperature_map(
    temperatures: xr.Dataset,
    *,
    of: Literal["steady", "largest", "flash"] = "largest",
    body_number: int = 2,
    units: Units = "auto",
    width: Width | None = None,
    ax: Axes | None = None,
    **image: Any,
) -> Axes:
    """Temperature over the surface of a body, with a cross at the hottest place of the cycle.

    Parameters
    ----------
    temperatures, units, width, ax
        As in :func:`temperature`.
    of : "steady", "largest" or "flash"
        Mean or largest temperature of the cycle, or the difference of both.
    body_number : 1 or 2
        The body.
    **image
        Passed on to ``imshow``, such as ``cmap`` and ``vmax``.
    """
    if of not in NAMES:
        raise ValueError(f"of = {of!r}: must be {', '.join(map(repr, NAMES))}")
    if body_number not in (1, 2):
        raise ValueError(f"body_number = {body_number}: must be 1 or 2")
    must_hold(temperatures, "temperatures", FOUND, MADE)
    ax = axes(ax, square=True)
    length = scales(temperatures.attrs, units).length
    x, y = temperatures.x.values / length.value, temperatures.y.values / length.value
    half_x, half_y = (x[1] - x[0]) / 2, (y[1] - y[0]) / 2
    extent = (x[0] - half_x, x[-1] + half_x, y[0] - half_y, y[-1] + half_y)
    values = temperatures[of].sel(body=body_number).values
    look = {"cmap": colour_map("warm"), "aspect": ax.get_aspect(), **image}
    drawn = ax.imshow(values.T, origin="lower", extent=extent, **look)
    hottest = (
        temperatures.attrs["maximum_x"] / length.value,
        temperatures.attrs["maximum_y"] / length.value,
    )
    draw_cross(ax, *hottest)
    ax.set_xlabel(length.label("x"))
    ax.set_ylabel(length.label("y"))
    add_colour_bar(ax, drawn, rf"{NAMES[of]} of body {body_number} [K]")
    return ax
