"""Line contacts: forces, moments and energies on one metre of their width."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from pyfret._util.toml import parse_toml

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["PER_METRE", "of_line_contacts"]

#: Units of a line contact, on one metre.
PER_METRE = {"N": "N/m", "N m": "N m/m", "J": "J/m"}


def of_line_contacts(d: xr.Dataset) -> bool:
    """Return whether the stored scene of a study is a line contact with forces per metre."""
    try:
        grid = parse_toml(json.loads(d.attrs["study"])["scene"])["grid"]
    except (KeyError, ValueError):
        # A function makes its scenes, or it was put together by hand.
        return False
    spacing = grid.get("spacing")
    width = spacing[-1] if isinstance(spacing, list) else grid.get("width", 1.0)
    return bool(grid.get("plane_strain")) and width == 1.0
