"""The design chart of coatings: film, interface or substrate, which goes first."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np
from matplotlib.lines import Line2D

from pyfret._util.theme import DANGER, MIDDLE, NEUTRAL, SAFE
from pyfret.fracture.first import PARTS
from pyfret.plot.areas import Raster
from pyfret.plot.parameters import parameter_label
from pyfret.plot.sizes import Width
from pyfret.plot.style import axes, styled
from pyfret.plot.tables import must_hold

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.patches import Patch

__all__ = ["design_chart"]

#: What fails first, by the codes of ``first``, each with its colour.
FIRST = {0: ("nothing fails", NEUTRAL), 1: ("nearest to failure: film", DANGER)}
FIRST |= {2: ("nearest to failure: interface", MIDDLE)}
FIRST |= {3: ("nearest to failure: substrate", SAFE)}
#: Lines of the limits of film, interface and substrate.
STYLES: tuple[Literal["solid", "dashed", "dotted"], ...] = ("solid", "dashed", "dotted")


@styled
def design_chart(
    table: xr.Dataset,
    x: str,
    y: str,
    *,
    labels: tuple[str, str] | None = None,
    width: Width | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Film, interface or substrate: what fails first over two parameters of a study.

    The colour of an area names the part that is nearest to its limit, or farthest beyond it. Where
    none has reached its limit the area is white. A line shows where a part begins to fail. Between
    the points of the study the loads are interpolated.

    Parameters
    ----------
    table : xarray.Dataset
        Of a study measured by :class:`pyfret.study.FirstToFail`.
    x, y : str
        The parameters along the axes.
    labels : (str, str), optional
        Of the axes, in SI units (default: the names of the parameters in words, with units that
        engineers read).
    width : "column" or "page", optional
        Width of a new figure: a column of 85 mm or a page of 170 mm.
    ax : matplotlib Axes, optional
        Where to draw.
    """
    made = "the dataset of a study of these parameters, measure=fret.study.FirstToFail(...)"
    must_hold(table, "table", (x, y, *PARTS), made)
    ax = axes(ax)
    table = table.transpose(y, x)
    names, units = zip(*(parameter_label(name) for name in (x, y)), strict=True)
    if labels is not None:
        names, units = labels, (1.0, 1.0)
    at_x, at_y = table[x].values / units[0], table[y].values / units[1]
    raster = Raster(at_x, at_y)
    loads = np.array([raster.resample(table[name].values) for name in PARTS])
    has_value = np.isfinite(loads)
    worst = np.where(has_value, loads, -np.inf)
    first = np.where(worst.max(axis=0) >= 1.0, 1.0 + worst.argmax(axis=0), 0.0)
    first[~has_value.any(axis=0)] = np.nan
    entries: list[Patch | Line2D] = [*raster.draw(ax, first, FIRST)]
    for name, style in zip(PARTS, STYLES, strict=True):
        load = table[name].values
        if min(load.shape) > 1 and np.nanmin(load) < 1.0 < np.nanmax(load):
            fine = raster.resample(load)
            ax.contour(raster.x, raster.y, fine, levels=[1.0], colors="0.2", linestyles=style)
            label = f"the {name} fails beyond"
            entries.append(Line2D([], [], color="0.2", linestyle=style, label=label))
    ax.set_xlabel(names[0])
    ax.set_ylabel(names[1])
    ax.legend(handles=entries, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2)
    return ax
