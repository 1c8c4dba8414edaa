"""A crack in the section below a contact, and all that decides about it in one figure."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pyfret._util.numbers import in_letters
from pyfret._util.theme import CRACK
from pyfret.fracture.growth import Cracks, Threshold
from pyfret.plot.cracks import crack_arrest, intensity_history, kitagawa
from pyfret.plot.scales import Units, scales
from pyfret.plot.sizes import Width, new_panels
from pyfret.plot.stresses import section_map
from pyfret.plot.style import inside_legend, styled
from pyfret.quantities import Length, quantities
from pyfret.subsurface.contact import stress_below

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from pyfret.run import Run

__all__ = ["crack_panels", "crack_path"]

#: Depth of the section over half the width of the contact, and number of depths.
DEEPEST, DEPTHS = 1.5, 40


@styled
@quantities
def crack_path(
    cracks: Cracks,
    threshold: Threshold | None = None,
    *,
    start: Length | None = None,
    units: Units = "auto",
    ax: Axes,
) -> Axes:
    """Draw a crack into the figure of a section, such as :func:`section_map` gives it.

    The line runs to where the crack stops, or to its first length where it does not grow. A dot
    marks this place, and the line goes on dashed to the longest length. Without a threshold the
    line runs to the longest.

    Parameters
    ----------
    cracks : Cracks
        From :meth:`Result.crack` or :meth:`Result.grow_crack`.
    threshold : Threshold, optional
        Of the material.
    start : float, optional
        Length that the crack begins with [m] (default: the shortest).
    units : "auto", "dimensionless" or "SI"
        Those of the figure: over a_H where it has an axis of x/a_H (default), or in um.
    ax : matplotlib Axes
        The figure of the section.
    """
    dataset = cracks.dataset
    scale = scales(dataset.attrs, units).length.value
    if units == "auto" and "a_H" not in ax.get_xlabel():
        scale = scales(dataset.attrs, "SI").length.value
    mouth = dataset.attrs["x"]
    x = cracks.places(np.concatenate([[mouth], dataset.x.values])) / scale
    z = np.concatenate([[0.0], dataset.z.values]) / scale
    s = np.concatenate([[0.0], cracks.lengths])
    arrest = None if threshold is None else cracks.arrest(threshold, start=start)
    end = s[-1] if arrest is None else arrest.tip
    grown = np.append(s[s < end], end)
    ax.plot(np.interp(grown, s, x), np.interp(grown, s, z), color="k", linewidth=1.8, zorder=4)
    if arrest is not None and arrest.verdict != "grows":
        unreached = np.insert(s[s > end], 0, end)
        line = np.interp(unreached, s, x), np.interp(unreached, s, z)
        ax.plot(*line, color="k", linewidth=0.8, linestyle="dashed", zorder=4)
        text = in_letters(f"the crack {arrest.briefly()}")
        ax.plot(line[0][0], line[1][0], "o", color=CRACK, markersize=4, zorder=5, label=text)
        inside_legend(ax)
    return ax


@styled
@quantities
def crack_panels(
    result: Run,
    cracks: Cracks,
    threshold: Threshold,
    *,
    start: Length | None = None,
    width: Width | None = None,
) -> Figure:
    """Draw the crack in the stress at its largest K_I, K over the cycle, arrest and Kitagawa.

    Parameters
    ----------
    result : Result
        The run whose cycle the cracks are of.
    cracks : Cracks
        From :meth:`Result.crack` or :meth:`Result.grow_crack`.
    threshold : Threshold
        Of the material.
    start : float, optional
        Length that the crack begins with [m] (default: the shortest).
    width : "column" or "page", optional
        Width of a new figure: a column of 85 mm or a page of 170 mm.
    """
    about = cracks.dataset.attrs
    figure, grid = new_panels(4, size=(4.2, 3.3), across=(2, 2, 1))
    axes = grid.ravel()
    K_I = cracks.dataset.K_I
    shown = K_I.isel(length=int(K_I.max("increment").values.argmax()))
    moment = result.at(int(K_I.increment[int(shown.values.argmax())]))
    body = about["body_number"]
    depths = np.linspace(0.0, DEEPEST * about["half_width"], DEPTHS)
    layered = (result.scene.body1 if body == 1 else result.scene.body2).coatings
    inner = np.cumsum([coating.thickness for coating in layered])
    line = cracks.line
    stress = stress_below(moment, np.union1d(depths, inner), **line.named(), body_number=body)
    cos, sin = np.cos(line.angle), np.sin(line.angle)
    # The normal stress across a crack along the depth.
    across = cos**2 * stress.s_xx + 2.0 * sin * cos * stress.s_xy + sin**2 * stress.s_yy
    names = {"x": r"\sigma_{xx}", "y": r"\sigma_{yy}", "s": r"\sigma_{ss}"}
    section_map(across.assign_attrs(stress.s_xx.attrs), symbol=names[line.axis], ax=axes[0])
    crack_path(cracks, threshold, start=start, ax=axes[0])
    arrest = cracks.arrest(threshold, start=start)
    length = cracks.lengths[len(cracks.lengths) // 2] if arrest.verdict == "grows" else arrest.tip
    intensity_history(cracks, float(length), ax=axes[1])
    crack_arrest(cracks, threshold, start=start, ax=axes[2])
    kitagawa(cracks, threshold, ax=axes[3])
    return figure
