"""Plastic strain below a contact, and what it leaves: residual stress and imprint."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._util.lazy import xr

if TYPE_CHECKING:
    import xarray

__all__ = ["PlasticState"]

COMPONENTS = ["xx", "yy", "zz", "xy", "xz", "yz"]


class PlasticState:
    """The plastic state of a body after an increment, on the cells and planes of its volume grid.

    Planes are those of the Gauss points: two in each element in depth. Tension is positive, z
    points into the body, components are in the axes of the scene.
    """

    def __init__(self, found: dict[str, Any]) -> None:
        tensor = ("z", "component", "x", "y")
        stress = {"units": "Pa"}
        self.dataset: xarray.Dataset = xr.Dataset(
            {
                "equivalent": (
                    ("z", "x", "y"),
                    found["equivalent"],
                    {"units": "1", "long_name": "equivalent plastic strain"},
                ),
                "strain": (
                    tensor,
                    found["strain"],
                    {"units": "1", "long_name": "plastic strain"},
                ),
                "stress": (
                    tensor,
                    found["stress"],
                    {**stress, "long_name": "stress, residual stress included"},
                ),
                "residual_stress": (
                    tensor,
                    found["residual_stress"],
                    {**stress, "long_name": "stress without the tractions of the contact"},
                ),
                "imprint": (
                    ("grid_x", "grid_y"),
                    found["imprint"],
                    {"units": "m", "long_name": "growth of the gap by plastic strain"},
                ),
            },
            coords={
                "z": ("z", found["z"], {"units": "m"}),
                "x": ("x", found["x"], {"units": "m"}),
                "y": ("y", found["y"], {"units": "m"}),
                "grid_x": ("grid_x", found["grid_x"], {"units": "m"}),
                "grid_y": ("grid_y", found["grid_y"], {"units": "m"}),
                "component": COMPONENTS,
                "layer": ("z", found["layer"].astype(int)),
                "height": ("z", found["height"], {"units": "m"}),
            },
        )
        self._area = float(found["area"])

    def largest(self) -> float:
        """Give the largest equivalent plastic strain.

        At the border of slip and at the rim of a soft layer it grows with every refinement.
        """
        return float(self.dataset["equivalent"].max())

    def volume(self) -> float:
        """Give the volume that has yielded [m^3], per length in plane strain [m^2]."""
        yielded = (self.dataset["equivalent"] > 0).sum(("x", "y"))
        return float((yielded * self.dataset["height"]).sum()) * self._area

    def depth(self) -> float:
        """Give the depth of the lowest point that has yielded [m], 0 where none has."""
        yielded = (self.dataset["equivalent"] > 0).any(("x", "y")).to_numpy()
        return float(np.max(self.dataset["z"].to_numpy(), where=yielded, initial=0.0))

    def on_axis(self, name: str) -> xarray.DataArray:
        """Give a variable in the middle x = y = 0, continued there from the cells around it.

        Parameters
        ----------
        name : str
            "equivalent", "strain", "stress" or "residual_stress".
        """
        values = self.dataset[name]
        for side in ("x", "y"):
            n = values.sizes[side]
            if n == 1:
                values = values.isel({side: 0})
                continue
            # Even about the middle: 9/8 of the mean of the nearest two less 1/8 of the next.
            if n % 2 == 1 or n < 4:
                values = values.interp({side: 0.0})
                continue
            m = n // 2
            near = 0.5 * (values.isel({side: m}, drop=True) + values.isel({side: m - 1}, drop=True))
            far = 0.5 * (
                values.isel({side: m + 1}, drop=True) + values.isel({side: m - 2}, drop=True)
            )
            values = near + (near - far) / 8.0
        return values

    def __repr__(self) -> str:
        """Give the numbers of the zone."""
        return (
            f"PlasticState(largest={self.largest():.3g}, volume={self.volume():.3g} m^3, "
            f"depth={self.depth():.3g} m)"
        )
