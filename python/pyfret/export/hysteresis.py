"""The law of a contact in a joint: force against shift, from one loading to every loop."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pyfret._util.lazy import xr
from pyfret.quantities import quantities

if TYPE_CHECKING:
    from typing import Literal

    from numpy.typing import NDArray

    from pyfret.run import Run

__all__ = ["hysteresis"]


@quantities
def hysteresis(result: Run, *, direction: Literal["x", "y", "torsion"] = "x") -> xr.Dataset:
    """Hysteresis of a contact for the dynamics of a joint, as a table.

    The first branch at constant normal force along which the force of `direction` grows from zero
    is the backbone T = F(delta). By Masing's rule (G. Masing, Proc. 2nd Int. Congr. Appl. Mech.,
    1926) each loop of the half range delta dissipates

    D(delta) = 4 (2 integral of F from 0 to delta - delta F(delta)).

    Parameters
    ----------
    result : Result
        A path that presses, then shears from no shear: ``start().normal(W).cycles(1, ...)``. More
        and shorter increments give more rows.
    direction : "x", "y" or "torsion"
        The motion; in torsion T is the moment [N m] and delta the rotation [rad].

    Returns
    -------
    xarray.Dataset
        Over ``amplitude``: ``delta``, ``T``, ``stiffness`` (dT/ddelta), ``secant_stiffness``,
        ``dissipated`` (a loop). ``attrs``: ``W``, ``mu``, ``masing_error``. The last is the
        relative difference between the energy of the run's last closed loop and Masing's at its
        half range. It is NaN without a closed loop. For CSV:
        ``hysteresis(result).to_dataframe().to_csv(path)``.

    Raises
    ------
    ValueError
        No branch shears the contact from no shear at a constant normal force.
    """
    if direction not in ("x", "y", "torsion"):
        raise ValueError(f'direction = {direction!r}: must be "x", "y" or "torsion"')
    torsion = direction == "torsion"
    force, shift = ("M_z", "phi_z") if torsion else (f"T_{direction}", f"delta_{direction}")
    delta, T = _backbone(result.dataset, force, shift)
    stiffness = np.gradient(T, delta, edge_order=2 if delta.size > 2 else 1)
    secant = np.divide(T, delta, out=np.full_like(T, stiffness[0]), where=delta > 0.0)
    energy = _masing(delta, T)
    lengths, forces = ("rad", "N m") if torsion else ("m", "N")
    per = result.scene.grid.unit_of
    stiffnesses, forces = per(f"{forces}/{lengths}"), per(forces)
    columns = {
        "delta": (delta, lengths, "half range of the shift"),
        "T": (T, forces, "half range of the force"),
        "stiffness": (stiffness, stiffnesses, "tangent of the backbone"),
        "secant_stiffness": (secant, stiffnesses, "force over shift"),
        "dissipated": (energy, per("J"), "energy dissipated in a loop, by Masing's rule"),
    }
    table = xr.Dataset(
        {
            name: ("amplitude", values, {"units": unit, "long_name": meaning})
            for name, (values, unit, meaning) in columns.items()
        }
    )
    last = result.dataset.isel(increment=-1)
    return table.assign_attrs(
        W=float(last.W), mu=result.mu, masing_error=_masing_error(result, direction, table)
    )


def _backbone(
    dataset: xr.Dataset, force: str, shift: str
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return shift and force from zero shear along the first branch that shears at constant W."""
    branch = dataset.branch_of_increment.values
    W, T, delta = (dataset[name].values for name in ("W", force, shift))
    for number in np.unique(branch).tolist():
        inside = np.flatnonzero(branch == number)
        before = inside[0] - 1
        if before < 0 or T[inside[-1]] == 0.0:
            continue
        rows = np.append(before, inside)
        constant = np.allclose(W[rows], W[rows[0]], rtol=1e-9)
        if constant and abs(T[before]) <= 1e-9 * abs(T[inside[-1]]):
            sign = np.sign(T[inside[-1]])
            return sign * (delta[rows] - delta[before]), sign * T[rows]
    raise ValueError(
        f"no branch takes {force} from zero at a constant normal force: the backbone needs one, "
        "such as LoadPath.start().normal(W).cycles(1, T_x=...)"
    )


def _masing(delta: NDArray[np.float64], T: NDArray[np.float64]) -> NDArray[np.float64]:
    """Compute the energy of loops at the half ranges `delta` [J] from the backbone.

    The integral uses parabolas through three rows each, so that it is of third order.
    """
    area = np.zeros_like(delta)
    for k in range(1, delta.size):
        n = min(max(k - 1, 0), max(delta.size - 3, 0))
        rows = slice(n, n + 3)
        curve = np.polynomial.Polynomial.fit(delta[rows], T[rows], min(2, delta.size - 1))
        whole = curve.integ()
        area[k] = area[k - 1] + whole(delta[k]) - whole(delta[k - 1])
    return 4.0 * (2.0 * area - delta * T)


def _masing_error(result: Run, direction: Literal["x", "y", "torsion"], table: xr.Dataset) -> float:
    """Return the relative error of Masing's energy in the last closed loop."""
    loops = result.loops(direction=direction)
    if loops.sizes["cycle"] == 0:
        return float("nan")
    last = loops.isel(cycle=-1)
    half, loop_energy = float(last.delta), float(last.dissipated)
    if loop_energy <= 0.0 or half > float(table.delta[-1]) * (1 + 1e-6):
        return float("nan")
    masing_energy = float(np.interp(half, table.delta.values, table.dissipated.values))
    return abs(masing_energy - loop_energy) / loop_energy
