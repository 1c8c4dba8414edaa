"""Cracks below a contact: the stress of a cycle taken to the tip."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pyfret import _core
from pyfret._util.lazy import xr
from pyfret.fatigue.cycles import cycle_increments
from pyfret.fracture.growth import Cracks

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike

    from pyfret.run import Run, State

__all__ = ["crack"]

#: Lengths of cracks over half the width of the contact, by default.
SHORTEST, LONGEST, LENGTHS = 0.01, 2.0, 24

UNITS = {"units": "Pa m^0.5"}


def crack(
    result: Run,
    x: float | None = None,
    *,
    lengths: ArrayLike | None = None,
    angle: float = 0.0,
    friction: float = 0.0,
    body_number: int = 2,
    cycle: int | None = -1,
    residual: Sequence[float] | None = None,
) -> Cracks:
    """Take the stress of a closed cycle to the tips of cracks of several lengths.

    Parameters
    ----------
    result : Result
        Solved with ``save="all"``, or with the increments of the cycle; its fields in the plane
        y = 0 are taken, as in plane strain.
    x : float, optional
        Place of the mouth [m] (default: that rim of the contact, at the largest contact of the
        cycle, below which the range of K is larger).
    lengths : array, optional
        Lengths of the crack [m] (default: 24 from 0.01 to 2 times half the width of the contact).
    angle : float
        Angle from the inward normal, positive towards +x [rad].
    friction : float
        Coefficient of friction between faces in contact, over the history of the cycle.
    body_number, cycle, residual
        As in :func:`pyfret.fatigue.life`.

    Returns
    -------
    Cracks
        K over (increment, length). Its ``error`` has the part of the quadrature, that of the
        tractions within the cells (their difference from constant ones) and, where layers differ,
        what published cracks in films change: K is that of the homogeneous half-plane.

    Raises
    ------
    ValueError
        There is no closed cycle, too few of its increments were kept, or the crack has no meaning.
    """
    kept = cycle_increments(result, cycle)
    states = [result.at(int(n)) for n in kept]
    if x is None:
        x = _worse_rim(states, angle, friction, body_number, residual)
    if lengths is None:
        a = max(_half_width(now) for now in states)
        lengths = a * np.geomspace(SHORTEST, LONGEST, LENGTHS)
    lengths = np.sort(np.atleast_1d(np.asarray(lengths, float)))
    found = _over(states, x, lengths, angle, friction, body_number, residual)
    names = {
        "K_I": "opening stress intensity",
        "K_II": "shear stress intensity",
        "K_I_linear": "opening stress intensity, faces pass through each other",
        "K_II_linear": "shear stress intensity, faces pass through each other",
        "error": "error bar of K",
    }
    dims = ("increment", "length")
    variables = {
        name: (dims, found[name], {**UNITS, "long_name": long}) for name, long in names.items()
    }
    variables["open"] = (
        dims,
        found["open"],
        {"units": "1", "long_name": "open share of the crack"},
    )
    coordinates = {
        "increment": kept,
        "length": ("length", lengths, {"units": "m", "long_name": "crack length"}),
    }
    about = {"x": x, "angle": angle, "friction": friction, "body_number": body_number}
    return Cracks(xr.Dataset(variables, coords=coordinates, attrs=about))


def _over(
    states: Sequence[State],
    x: float,
    lengths: np.ndarray,
    angle: float,
    friction: float,
    body_number: int,
    residual: Sequence[float] | None,
) -> dict[str, np.ndarray]:
    """K of the cracks from x in each of the states."""
    fields = {
        name: np.stack([now.dataset[name].values for now in states])
        for name in ("p", "q_x", "q_y", "stick")
    }
    fields["stick"] = fields["stick"].astype(bool)
    scene = states[0].scene
    return _core.crack_of_states(
        scene.body1 if body_number == 1 else scene.body2,
        scene.grid,
        **fields,
        sigma_B=[now.bulk_stress(body_number) for now in states],
        x=float(x),
        lengths=lengths.tolist(),
        angle=angle,
        friction=friction,
        residual=None if residual is None else list(residual),
        body_number=body_number,
    )


def _half_width(now: State) -> float:
    """Half the width of the contact [m], its radius in three dimensions."""
    grid = now.scene.grid
    if grid.plane_strain:
        return 0.5 * float(now.contact_area) / grid.dy
    return float(now.contact_radius)


def _worse_rim(
    states: Sequence[State],
    angle: float,
    friction: float,
    body_number: int,
    residual: Sequence[float] | None,
) -> float:
    """The rim of the largest contact below which the range of K of short cracks is larger."""
    largest = max(states, key=_half_width)
    a = _half_width(largest)
    loaded = largest.x.values[(largest.p.values > 0.0).any(axis=1)]
    if loaded.size == 0:
        raise ValueError("no increment of the cycle has contact: give the place x of the crack")
    middle = 0.5 * (loaded[0] + loaded[-1])
    lengths = a * np.array([0.05, 0.1, 0.2, 0.4])

    def range_at(x: float) -> float:
        K = _over(states, x, lengths, angle, friction, body_number, residual)["K_I"]
        return float((K.max(axis=0) - K.min(axis=0)).max())

    return float(max((middle - a, middle + a), key=range_at))
