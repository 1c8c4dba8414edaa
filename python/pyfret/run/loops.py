"""Energy and stiffness of the fretting loops of a run."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from pyfret import _core
from pyfret._util.lazy import xr

if TYPE_CHECKING:
    from pyfret._core import Scene

__all__ = ["of_cycles"]

#: What the codes of ``status`` mean.
STATUS = ("no contact", "full stick", "partial slip", "gross slip")
#: What :meth:`pyfret.Result.loops` gives: unit and meaning.
LOOP = {
    "first_branch": ("1", "first branch of the cycle, from 0"),
    "last_branch": ("1", "last branch of the cycle"),
    "dissipated": ("J", "energy dissipated in the cycle"),
    "T": ("N", "half the range of the force"),
    "delta": ("m", "half the range of the shift"),
    "stiffness": (
        "N/m",
        "stiffness right after the reversals, NaN where it is not known to 2 %, in torsion to 6 %",
    ),
    "stiffness_error": ("N/m", "estimated error of the stiffness"),
    "secant_stiffness": ("N/m", "stiffness of the whole loop"),
    "opening": ("m", "half the opening of the loop at the middle force"),
    "energy_ratio": ("1", "dissipated energy over that of the surrounding rectangle"),
    "sliding_ratio": ("1", "opening over the range of the shift, NaN where not known to 0.05"),
    "sliding_ratio_error": ("1", "bound of the error of the sliding ratio"),
    "status": ("1", "0 no contact, 1 full stick, 2 partial slip, 3 gross slip"),
}


def of_cycles(
    dataset: xr.Dataset, scene: Scene, direction: Literal["x", "y", "torsion"]
) -> xr.Dataset:
    """Give the loops of every closed cycle; parameters as of :meth:`pyfret.Result.loops`."""
    if direction not in ("x", "y", "torsion"):
        raise ValueError(f'direction = {direction!r}: must be "x", "y" or "torsion"')
    torsion = direction == "torsion"
    force, shift = ("M_z", "phi_z") if torsion else (f"T_{direction}", f"delta_{direction}")
    found = _core.loops(
        scene.path,
        torsion=torsion,
        branch=dataset.branch_of_increment.values.tolist(),
        T=dataset[force].values.tolist(),
        delta=dataset[shift].values.tolist(),
        dissipated=dataset.dissipated.values.tolist(),
        status=dataset.status.values.tolist(),
    )
    units = {"N": "N m", "m": "rad", "N/m": "N m/rad"} if torsion else {}
    grid = scene.grid
    return xr.Dataset(
        {
            name: (
                "cycle",
                [cycle[name] for cycle in found],
                {"units": grid.unit_of(units.get(unit, unit)), "long_name": of},
            )
            for name, (unit, of) in LOOP.items()
        },
        attrs=dataset.attrs,
    )
