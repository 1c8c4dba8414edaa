"""Ruiz' parameters: frictional work and tension along the surface over a closed cycle."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pyfret._util.lazy import xr
from pyfret.fatigue.cycle_section import sections_of_cycle
from pyfret.fatigue.cycles import cycle_increments, history
from pyfret.fatigue.section import Section, SectionOptions
from pyfret.quantities import quantities
from pyfret.subsurface.line import fields_on

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from pyfret.run import Run
    from pyfret.subsurface.line import Line

__all__ = ["ruiz"]


def _work_until(result: Run, increment: int, line: Line) -> xr.DataArray:
    """Return the frictional work per area along a line up to the end of an increment [J/m^2]."""
    if increment not in result.dataset.saved_increment.values:
        raise ValueError(
            f"increment {increment} was not kept: the work of a cycle needs the fields at both of "
            "its ends; solve with save='all' or save='branches'"
        )
    work: xr.DataArray = fields_on(result.at(increment), line).dissipated_density
    return work


@quantities
def ruiz(result: Run, **section: Unpack[SectionOptions]) -> xr.Dataset:
    """Give Ruiz' two parameters along a line of the surface over a closed cycle.

    F1 is the frictional work per area and cycle. F2 is its product with the largest stress along
    the line at the surface (s_xx on a line along x). In the form of the source, F1 is the largest
    shear times the slip amplitude: C. Ruiz, P. H. B. Boddington, K. C. Chen, Exp. Mech. 24 (1984)
    208-217.

    Parameters
    ----------
    result : Result
        As in :func:`life`; the last increments before and of the cycle must be kept.
    **section
        The line and the body, as in :func:`life` (default: the line along the shear of the cycle,
        through the centre of its largest contact).

    Returns
    -------
    xarray.Dataset
        Over x, y or, on an oblique line, s [m]: ``F1`` [J/m^2] and ``F2`` [J Pa/m^2]; F2 is
        0 where the surface is never in tension.
    """
    first_section = sections_of_cycle(result, Section(**section))[0]
    line = first_section.line
    kept = cycle_increments(result, first_section.cycle)
    branch = result.dataset.branch_of_increment
    cycle_branches = branch.sel(increment=kept).values
    inside = (branch >= cycle_branches.min()) & (branch <= cycle_branches.max())
    whole = result.dataset.increment.values[inside.values]
    # The field adds up over the path: the work of the cycle is the difference of its ends.
    ends = (int(whole[0]) - 1, int(whole[-1]))
    start, end = (_work_until(result, increment, line) for increment in ends)
    F1 = end - start
    stress = history(
        result,
        [0.0],
        **line.named(),
        body_number=first_section.body_number,
        cycle=first_section.cycle,
        residual=first_section.residual,
    )
    cos, sin = np.cos(line.angle), np.sin(line.angle)
    s_xx, s_yy, s_xy = (
        stress.sel(component=component).values[:, 0] for component in ("s_xx", "s_yy", "s_xy")
    )
    along = cos**2 * s_xx + 2.0 * cos * sin * s_xy + sin**2 * s_yy
    tension = np.maximum(along.max(axis=0), 0.0)
    F1 = F1.assign_attrs(units="J/m^2", long_name="frictional work per area and cycle")
    F2 = (F1 * tension).assign_attrs(
        units="J Pa/m^2", long_name="F1 times the largest stress along the line"
    )
    return xr.Dataset({"F1": F1, "F2": F2})
