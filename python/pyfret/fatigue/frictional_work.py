"""Ruiz' parameters: frictional work and tension along the surface over a closed cycle."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from pyfret._util.door import numbers_only
from pyfret._util.lazy import xr
from pyfret.fatigue.cycles import cycle_increments, history
from pyfret.fatigue.section import Section

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from pyfret.fatigue.section import SectionOptions
    from pyfret.run import Run

__all__ = ["ruiz"]


def _work_until(result: Run, increment: int, y: float) -> xr.DataArray:
    """Frictional work per area along a line from the start to the end of an increment [J/m^2]."""
    if increment not in result.dataset.saved_increment.values:
        raise ValueError(
            f"increment {increment} was not kept: the work of a cycle needs the fields at both of "
            "its ends; solve with save='all' or save='branches'"
        )
    work: xr.DataArray = result.at(increment).along_x(y=y).dissipated_density
    return work.drop_vars(set(work.coords) - {"x"})


@numbers_only
def ruiz(result: Run, **section: Unpack[SectionOptions]) -> xr.Dataset:
    """Give Ruiz' two parameters along a line of the surface over a closed cycle.

    F1 is the frictional work per area and cycle, F2 its product with the largest s_xx at the
    surface: C. Ruiz, P. H. B. Boddington, K. C. Chen, Exp. Mech. 24 (1984) 208-217, in whose form
    F1 is the largest shear times the slip amplitude.

    Parameters
    ----------
    result : Result
        As in :func:`life`; the last increments before and of the cycle must be kept.
    **section
        ``y`` (default: 0), ``body_number``, ``cycle``, ``residual``, as in :func:`life`.

    Returns
    -------
    xarray.Dataset
        Over x: ``F1`` [J/m^2] and ``F2`` [J Pa/m^2]; F2 is 0 where the surface is never in tension.
    """
    where = Section(**section)
    if not where.is_placed:
        where = replace(where, y=0.0)
    if where.along != "x":
        raise ValueError("x is given: Ruiz' parameters are those along x, at a y")
    y = where.place
    kept = cycle_increments(result, where.cycle)
    branch = result.dataset.branch_of_increment
    cycle_branches = branch.sel(increment=kept).values
    inside = (branch >= cycle_branches.min()) & (branch <= cycle_branches.max())
    whole = result.dataset.increment.values[inside.values]
    # The field adds up over the path: the work of the cycle is the difference of its ends.
    work = _work_until(result, int(whole[-1]), y) - _work_until(result, int(whole[0]) - 1, y)
    stress = history(
        result,
        [0.0],
        y=y,
        body_number=where.body_number,
        cycle=where.cycle,
        residual=where.residual,
    )
    tension = np.maximum(stress.values[:, 0, :, 0].max(axis=0), 0.0)
    F1 = work.drop_vars(set(work.coords) - {"x"})
    F1 = F1.assign_attrs(units="J/m^2", long_name="frictional work per area and cycle")
    F2 = (F1 * tension).assign_attrs(units="J Pa/m^2", long_name="F1 times the largest s_xx")
    return xr.Dataset({"F1": F1, "F2": F2})
