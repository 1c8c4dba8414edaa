"""Units of a run: a line contact on a strip one metre wide gives everything per metre."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pyfret._util.lazy import xr

if TYPE_CHECKING:
    from pyfret._core import Grid

__all__ = ["is_per_metre", "line_contact", "unit_on"]

#: Units of what grows with the length of a line contact, by those on a strip one metre wide.
PER_METRE = {"N": "N/m", "N m": "N m/m", "J": "J/m", "m^2": "m^2/m", "m^3": "m^3/m"}
#: Those of what is told of them.
STIFFNESS = {"N/m": "N/m per m", "N m/rad": "N m/rad per m"}


def is_per_metre(grid: Grid) -> bool:
    """Whether forces and energies on a grid are those per metre of a line contact.

    On a strip of another width they are those on that width, in newtons and joules.
    """
    return bool(grid.plane_strain and grid.dy == 1.0)


def unit_on(grid: Grid, unit: str) -> str:
    """The unit of a number of a contact on a grid, by that of a contact of two directions."""
    return {**PER_METRE, **STIFFNESS}.get(unit, unit) if is_per_metre(grid) else unit


def line_contact(dataset: xr.Dataset, grid: Grid) -> xr.Dataset:
    """The dataset of a run on a strip, in its own units and with its half width.

    The radius of a circle of the same area and the radius that goes with the approach depend on
    the width and the length of the strip; they are left out.
    """
    changed = dataset
    if "contact_radius" in dataset and "contact_area" in dataset:
        attrs = {"units": "m", "long_name": "half the width of the contact"}
        width = dataset["contact_area"].variable / (2.0 * grid.dy)
        changed = dataset.drop_vars("contact_radius").assign(
            half_width=xr.Variable(width.dims, width.values, attrs)
        )
    changed = changed.copy()
    changed.attrs.pop("R", None)
    if is_per_metre(grid):
        for variable in changed.variables.values():
            unit = variable.attrs.get("units")
            if unit in PER_METRE:
                variable.attrs["units"] = PER_METRE[unit]
    return changed
