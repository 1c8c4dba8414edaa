"""Energy and stiffness of the fretting loops of a run."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

from pyfret import _core
from pyfret._util.lazy import xr

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from numpy.typing import NDArray

    from pyfret._core import Grid, Scene

__all__ = ["STATUS", "frictionless", "loops_of_corners", "loops_of_cycles", "state_in_words"]

#: What the codes of ``status`` mean.
STATUS = ("no contact", "full stick", "partial slip", "gross slip")
#: The state of a contact that transmits no shear: it neither sticks nor slips.
NO_FRICTION = "no friction"


def frictionless(scene: Scene) -> bool:
    """Whether a contact transmits no shear: it has neither stick zones nor a stick ratio."""
    return scene.friction.mu == 0.0


def state_in_words(code: float, scene: Scene) -> str:
    """A code of ``status`` in words, as the command prints it."""
    return NO_FRICTION if code and frictionless(scene) else STATUS[int(code)]


#: What :meth:`pyfret.Result.loops` gives: unit and meaning.
LOOP = {
    "first_branch": ("1", "first branch of the cycle, from 0"),
    "last_branch": ("1", "last branch of the cycle"),
    "dissipated": ("J", "energy dissipated in the cycle"),
    "dissipated_error": ("J", "error of the dissipated energy, where the run has error bars"),
    "T": ("N", "half the range of the force"),
    "delta": ("m", "half the range of the shift"),
    "stiffness": (
        "N/m",
        "stiffness right after the reversals, NaN where it is not known to 2 %, in torsion to 6 %",
    ),
    "stiffness_error": ("N/m", "estimated error of the stiffness"),
    "secant_stiffness": ("N/m", "stiffness of the whole loop"),
    "opening": ("m", "half the opening at the middle force, NaN as sliding_ratio"),
    "opening_error": (
        "m",
        "error of the opening; without error bars by increments and width of the slip zone",
    ),
    "energy_ratio": ("1", "dissipated energy over the area of the surrounding rectangle"),
    "energy_ratio_error": ("1", "error of the energy ratio, where the run has error bars"),
    "sliding_ratio": ("1", "opening over the range of the shift, NaN where not known to 0.05"),
    "sliding_ratio_error": (
        "1",
        "error of the sliding ratio; without error bars by increments and width of the slip zone",
    ),
    "status": ("1", "0 no contact, 1 full stick, 2 partial slip, 3 gross slip"),
}
#: Those of them that a run without error bars lacks.
OF_BARS = ("dissipated_error", "energy_ratio_error")
#: Those of them that follow from the corners of a loop.
OF_CORNERS = ("dissipated", "T", "delta", "secant_stiffness", "opening", "energy_ratio")


def loops_of_cycles(
    dataset: xr.Dataset, scene: Scene, direction: Literal["x", "y", "torsion"]
) -> xr.Dataset:
    """Give the loops of every closed cycle; parameters as of :meth:`pyfret.Result.loops`."""
    if direction not in ("x", "y", "torsion"):
        raise ValueError(f'direction = {direction!r}: must be "x", "y" or "torsion"')
    torsion = direction == "torsion"
    bars = dataset.attrs.get("error_bars")
    force, shift = ("M_z", "phi_z") if torsion else (f"T_{direction}", f"delta_{direction}")
    loop_numbers = _core.loops(
        scene.path,
        torsion=torsion,
        branch=dataset.branch_of_increment.values.tolist(),
        T=dataset[force].values.tolist(),
        delta=dataset[shift].values.tolist(),
        dissipated=dataset.dissipated.values.tolist(),
        status=dataset.status.values.tolist(),
        grid=scene.grid,
        contact_area=dataset.contact_area.values.tolist(),
        stick_ratio=dataset.stick_ratio.values.tolist(),
        errors=[[bar[n]["total"] for n in ("dissipated", force, shift)] for bar in bars or []],
    )
    units = {"N": "N m", "m": "rad", "N/m": "N m/rad"} if torsion else {}
    names = [name for name in LOOP if bars or name not in OF_BARS]
    table = tabulated(loop_numbers, names, "cycle", scene.grid, units)
    return table.assign_attrs(dataset.attrs)


def loops_of_corners(
    delta: NDArray[np.float64],
    T: NDArray[np.float64],
    dissipated: NDArray[np.float64],
    grid: Grid,
) -> xr.Dataset:
    """Return numbers of loops from their corners, arrays over (block, corner), and energy.

    Numbers that need increments within a branch, such as the stiffness right after a reversal, are
    left out.
    """
    loop_numbers: list[dict[str, float]] = []
    for shift, force, energy in zip(delta, T, dissipated, strict=True):
        first = int(shift.argmax())
        u, f = (np.r_[values[first:], values[: first + 1]] for values in (shift, force))
        back = min(max(int(u.argmin()), 1), u.size - 2) if u.size > 2 else 1
        path = _core.LoadPath.start().force(W=1.0, increments=1).force(T_x=1.0, increments=1)
        path = path.force(T_x=-1.0, increments=back)
        path = path.force(T_x=1.0, increments=max(u.size - 1 - back, 1))
        counts = [1, 1, back, u.size - 1 - back]
        loop_numbers += _core.loops(
            path,
            torsion=False,
            branch=np.repeat(np.arange(4), counts).tolist(),
            T=[f[0], *f],
            delta=[u[0], *u],
            dissipated=[*[0.0] * u.size, float(energy)],
            status=[0] * (u.size + 1),
            grid=grid,
            contact_area=[0.0] * (u.size + 1),
            stick_ratio=[1.0] * (u.size + 1),
            errors=[],
        )
    return tabulated(loop_numbers, OF_CORNERS, "block", grid, {})


def tabulated(
    found: Sequence[Mapping[str, float]],
    names: Iterable[str],
    dim: str,
    grid: Grid,
    units: Mapping[str, str],
) -> xr.Dataset:
    """Return numbers of :data:`LOOP` over `dim`; `units` replaces units, N by N m in torsion."""
    return xr.Dataset(
        {
            name: (
                dim,
                [row[name] for row in found],
                {
                    "units": grid.unit_of(units.get(LOOP[name][0], LOOP[name][0])),
                    "long_name": LOOP[name][1],
                },
            )
            for name in names
        }
    )
