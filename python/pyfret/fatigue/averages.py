"""Critical distances: criteria on the stress averaged over a length of the material."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, NamedTuple, get_args

import numpy as np

from pyfret.fatigue.criteria import assess
from pyfret.fatigue.cycle_stress import CycleStress
from pyfret.fatigue.section import Section
from pyfret.subsurface.fields import interfaces

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray
    from typing_extensions import Unpack

    from pyfret._core import Material
    from pyfret.fatigue.criteria import CriterionName
    from pyfret.fatigue.section import SectionOptions
    from pyfret.run import Run

__all__ = ["Averaging", "average", "critical_distance"]

#: Stress at L/2 below the surface, its mean over the line down to 2 L, over the half disc or the
#: half ball of radius L.
Averaging = Literal["point", "line", "area", "volume"]

#: Depths of the quadrature over lines and discs; its error is far below that of the stress.
NODES = 16
#: Discs of the quadrature over a ball.
DISCS = 8


def critical_distance(material: Material) -> float:
    """Critical distance L = (dK_th/(2 s_D))^2/pi of a material [m].

    ``dK_th`` is the threshold range of the stress intensity and 2 ``s_D`` the range of the fatigue
    limit, both fully reversed: D. Taylor, The Theory of Critical Distances, Elsevier (2007). A
    ValueError says which of the two is missing.
    """
    return (material.number("dK_th") / (2.0 * material.number("s_D"))) ** 2 / np.pi


def average(
    result: Run,
    material: Material,
    criterion: CriterionName,
    *,
    L: float | None = None,
    method: Averaging = "line",
    tolerance: float = 1e-3,
    **section: Unpack[SectionOptions],
) -> xr.Dataset:
    """Judge the stress averaged over a critical distance below every place of the surface.

    Contacts have steep stresses: what counts is not the largest value but that over a distance
    which belongs to the material. The stress is averaged, then judged.

    Parameters
    ----------
    result, criterion, tolerance
        As in :func:`pyfret.fatigue.life`.
    material : Material
        That of the outermost layer, which holds the distance.
    L : float, optional
        Critical distance [m] (default: that of the material, :func:`critical_distance`).
    method : "point", "line", "area" or "volume"
        Stress at z = L/2; its mean over the line from the surface to z = 2 L; over the half disc of
        radius L in the plane of the section; over the half ball of radius L: D. Taylor, as in
        :func:`critical_distance`. The ball reaches beyond the section to either side.
    **section
        ``x`` or ``y``, ``body_number``, ``cycle``, ``residual``, as in :func:`pyfret.fatigue.life`.

    Returns
    -------
    xarray.Dataset
        Over x or y, what :func:`pyfret.fatigue.life` gives over (depth, x), and ``L`` [m]. For disc
        and ball, places nearer than L to the border of the grid are NaN.

    Raises
    ------
    ValueError
        As :func:`pyfret.fatigue.life`, and if the distance reaches beyond the outermost layer.
    """
    L = critical_distance(material) if L is None else float(L)
    if not (L > 0.0 and np.isfinite(L)):
        raise ValueError(f"L = {L}: must be a positive length in m")
    if method not in get_args(Averaging):
        raise ValueError(f"method = {method!r}: must be one of {', '.join(get_args(Averaging))}")
    where = Section(**section)
    of = CycleStress(result, where)
    _check_reach(of, L, method)
    mean = np.zeros(())
    for disc in _discs(method, L):
        # In plane strain all sections are the same.
        offset = 0.0 if of.grid.plane_strain else disc.offset
        beside = CycleStress(result, where.at(where.place + offset))
        mean = mean + disc.share * _mean(beside, disc.radius, method)
    along = where.along
    places = np.asarray(of.grid.x if along == "x" else of.grid.y)
    inside = np.isfinite(mean).all(axis=(0, 2))
    judged = assess(mean[:, inside], material, criterion, tolerance=tolerance)
    judged = judged.rename(dim_0=along).assign_coords({along: places[inside]})
    attrs = {"criterion": criterion, "method": method, "L": L}
    return judged.reindex({along: places}).assign_attrs(attrs)


def _check_reach(of: CycleStress, L: float, method: Averaging) -> None:
    """Refuse a distance that leaves the outermost layer."""
    reach = _depth(L, method)
    borders = interfaces(of.body)
    if borders and borders[0] < reach:
        raise ValueError(
            f"the {method} method reaches {reach:.3e} m deep, beyond the outermost layer of "
            f"{borders[0]:.3e} m: a critical distance belongs to one material"
        )


def _depth(L: float, method: Averaging) -> float:
    """How deep a mean reaches [m]."""
    return {"point": L / 2, "line": 2 * L}.get(method, L)


class _Disc(NamedTuple):
    """A section through what the stress is averaged over."""

    #: Distance from the place that is judged [m].
    offset: float
    #: Radius, or critical distance of a point and a line [m].
    radius: float
    #: Part of the whole mean.
    share: float


def _discs(method: Averaging, L: float) -> list[_Disc]:
    """The one section that a mean is over, or the half discs side by side that fill a half ball."""
    if method != "volume":
        return [_Disc(0.0, L, 1.0)]
    nodes, weights = np.polynomial.legendre.leggauss(DISCS)
    areas = weights * (1.0 - nodes * nodes)
    pairs = zip(nodes, areas / areas.sum(), strict=True)
    return [_Disc(L * s, L * np.sqrt(1.0 - s * s), share) for s, share in pairs]


def _mean(of: CycleStress, L: float, method: Averaging) -> NDArray[np.float64]:
    """The stress averaged in the plane of a section, of shape (time, along, 6)."""
    nodes, weights = np.polynomial.legendre.leggauss(NODES)
    nodes, weights = (nodes + 1) / 2, weights / 2
    if method == "point":
        nodes, weights = np.array([1.0]), np.array([1.0])
    disc = method in ("area", "volume")
    if disc:
        weights = weights * np.sqrt(1.0 - nodes * nodes)
    weights = weights / weights.sum()
    depths = nodes * _depth(L, method)
    mean = np.zeros(())
    for some, share in zip(of.chunks(depths), of.chunks(weights), strict=True):
        history, places = of.history(some)
        if disc:
            along = places[of.section.along].values
            history = _over_width(history, along, np.sqrt(L * L - some * some))
        mean = mean + np.einsum("k,tkxc->txc", share, history)
    return mean


def _over_width(
    history: NDArray[np.float64], x: NDArray[np.float64], half: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Means over x - half ... x + half of a history linear between its places; NaN beyond them."""
    steps = (history[:, :, 1:] + history[:, :, :-1]) / 2 * np.diff(x)[:, None]
    whole = np.concatenate([np.zeros_like(history[:, :, :1]), np.cumsum(steps, axis=2)], axis=2)
    found = np.full_like(history, np.nan)
    d = x[1] - x[0]

    def up_to(k: int, at: NDArray[np.float64]) -> NDArray[np.float64]:
        """The integral from x[0] to `at`: of a linear piece, exact."""
        i = np.clip(((at - x[0]) / d).astype(int), 0, x.size - 2)
        s = ((at - x[i]) / d)[:, None]
        low, high = history[:, k, i], history[:, k, i + 1]
        return np.asarray(whole[:, k, i] + d * s * (low + s / 2 * (high - low)))

    for k, b in enumerate(half):
        inside = (x - b >= x[0]) & (x + b <= x[-1])
        mean = (up_to(k, x[inside] + b) - up_to(k, x[inside] - b)) / (2 * b)
        found[:, k, inside] = mean
    return found
