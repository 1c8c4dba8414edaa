"""Overview of a run in one figure."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pyfret._util.text import literal
from pyfret._util.theme import REFERENCE
from pyfret.plot.along import look_along
from pyfret.plot.histories import driven, fretting_loop, load_path, stick_ratio
from pyfret.plot.maps import pressure_map, shear_streamlines, slip_map, stick_slip
from pyfret.plot.scales import Scales, Units, last_of, scales_of_snapshot
from pyfret.plot.sizes import Width, new_panels
from pyfret.plot.stresses import stress_map
from pyfret.plot.style import apart, note, styled
from pyfret.run import Run, State
from pyfret.subsurface.contact import stress_below
from pyfret.subsurface.line import fields_on, main_line, main_shear

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["overview"]


@styled
def overview(shown: Run | State, *, units: Units = "auto", width: Width | None = None) -> Figure:
    """Draw the six panels of the report: the loop, tractions, zones and the stress below.

    Of a path without a cycle the loads over the path stand in place of the loop. Of a line contact
    slip and the stick ratio stand in place of maps. ``result.plot()`` is the same.

    Parameters
    ----------
    shown : Result or Snapshot
        The run, whose last increment with fields is shown, or an increment, without its loop.
    units : "auto", "dimensionless" or "SI"
        Over a_H and p_H (default where there is a Hertz contact), or in um and MPa.
    width : "column" or "page", optional
        Width of a new figure: a column of 85 mm or a page of 170 mm.
    """
    at = last_of(shown)
    by = scales_of_snapshot(at, units)
    figure, grid = new_panels(6, size=(3.93, 3.5), across=(3, 2, 1))
    apart(figure)
    first, second, third, fourth, fifth, sixth = grid.ravel()
    names = ["", "tractions", "pressure", "shear", "stick and slip", "stress"]
    names[0] = _draw_loading(shown, first, units)
    _tractions(second, at, by)
    if at.scene.grid.plane_strain:
        names[1:5] = "tractions", "stick and slip", "slip", "stick area"
        stick_slip(at, units=units, ax=third)
        slip_map(at, units=units, ax=fourth)
        if isinstance(shown, Run):
            stick_ratio(shown, ax=fifth)
        else:
            names[4] = "shear"
            shear_streamlines(at, units=units, ax=fifth)
    else:
        pressure_map(at, units=units, ax=third)
        shear_streamlines(at, units=units, ax=fourth)
        stick_slip(at, units=units, ax=fifth)
    if bool(at.contact.any()) and np.isfinite(at.scene.body2.substrate.E):
        stress_map(stress_below(at), units=units, ax=sixth)
    else:
        sixth.set_axis_off()
        note(sixth, "the lower body is rigid" if at.contact.any() else "no contact")
    for ax, letter, name in zip(grid.ravel(), "abcdef", names, strict=True):
        ax.set_title(f"({letter}) {name}")
    title = literal(at.dataset.attrs["title"])
    when = f"increment {int(at.dataset.increment)}, t = {float(at.dataset.t):.4g}"
    figure.suptitle(f"{title}: {when}" if title else when, x=0.01, ha="left", fontsize=9)
    return figure


def _draw_loading(shown: Run | State, ax: Axes, units: Units) -> str:
    """Draw the loop or the loads of a run, or the slip of an increment; return what was drawn."""
    if not isinstance(shown, Run):
        if shown.scene.grid.plane_strain:
            shear_streamlines(shown, units=units, ax=ax)
            return "shear"
        slip_map(shown, units=units, ax=ax)
        return "slip"
    force = {"x": "T_x", "y": "T_y", "torsion": "M_z"}[driven(shown.scene.path)]
    if np.any(shown.dataset[force].values):
        fretting_loop(shown, units=units, ax=ax)
        return "loop"
    load_path(shown, ax=ax)
    return "loads"


def _tractions(ax: Axes, at: State, by: Scales) -> None:
    """Pressure and shear along the shear on one scale, with the bounds of friction."""
    line = main_line(at)
    cut = fields_on(at, line)
    x = cut[line.axis] / by.length.value
    ax.plot(x, cut.p / by.stress.value, label="$p$")
    q = main_shear(cut)
    ax.plot(x, cut[q] / by.stress.value, label=f"${q}$")
    if np.isfinite(at.mu):
        for sign, label in ((1, r"$\pm\mu p$"), (-1, None)):
            bound = sign * at.mu * cut.p / by.stress.value
            ax.plot(x, bound, color=REFERENCE, linestyle=":", linewidth=1.0, label=label)
    look_along(ax, at, by.length, line, fresh=True)
    ax.set_xlabel(by.length.label(line.axis))
    ax.set_ylabel(f"traction [{by.stress.name}]" if by.stress.is_unit else r"traction over $p_H$")
    ax.legend(loc="upper right", ncols=3, bbox_to_anchor=(1.02, 1.12), borderpad=0.1)
