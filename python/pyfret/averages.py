"""Critical distances: criteria on the stress averaged over a length of the material."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

from pyfret import subsurface
from pyfret.cycle_stress import CycleStress
from pyfret.fatigue import evaluate
from pyfret.life import margin_name, margin_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    import xarray as xr
    from numpy.typing import NDArray

    from pyfret._core import Material
    from pyfret.fatigue import CriterionName
    from pyfret.results import Result

__all__ = ["Averaging", "average", "critical_distance"]

#: Stress at L/2 below the surface, its mean over the line down to 2 L, or over the half disc of
#: radius L.
Averaging = Literal["point", "line", "area"]

#: Depths of the quadrature over lines and discs; its error is far below that of the stress.
NODES = 16


def critical_distance(material: Material) -> float:
    """Critical distance L = (dK_th/(2 s_D))^2/pi of a material [m].

    ``dK_th`` is the threshold range of the stress intensity and 2 ``s_D`` the range of the fatigue
    limit, both fully reversed: D. Taylor, The Theory of Critical Distances, Elsevier (2007). A
    ValueError says which of the two is missing.
    """
    return (material.number("dK_th") / (2.0 * material.number("s_D"))) ** 2 / np.pi


def average(
    result: Result,
    material: Material,
    criterion: CriterionName,
    *,
    L: float | None = None,
    method: Averaging = "line",
    y: float = 0.0,
    body_number: int = 2,
    cycle: int = -1,
    residual: Sequence[float] | None = None,
    tolerance: float = 1e-3,
) -> xr.Dataset:
    """Judge the stress averaged over a critical distance below every place of the surface.

    Contacts have steep stresses: what counts is not the largest value but that over a distance
    which belongs to the material. The stress is averaged, then judged.

    Parameters
    ----------
    result, criterion, body_number, cycle, residual, tolerance
        As in :func:`life`.
    material : Material
        That of the outermost layer, which holds the distance.
    L : float, optional
        Critical distance [m] (default: that of the material, :func:`critical_distance`).
    method : "point", "line" or "area"
        Stress at z = L/2; its mean over the line from the surface to z = 2 L; its mean over the
        half disc of radius L in the plane of the section: D. Taylor, as in
        :func:`critical_distance`.
    y : float
        The section along x at that y [m].

    Returns
    -------
    xarray.Dataset
        Over x, what :func:`life` gives over (depth, x), and ``L`` [m]. For the half disc, places
        nearer than L to the border of the grid are NaN.

    Raises
    ------
    ValueError
        As :func:`life`, and if the distance reaches beyond the outermost layer.
    """
    L = critical_distance(material) if L is None else float(L)
    if not (L > 0.0 and np.isfinite(L)):
        raise ValueError(f"L = {L}: must be a positive length in m")
    of = CycleStress(result, x=None, y=y, body_number=body_number, cycle=cycle, residual=residual)
    reach = {"point": L / 2, "line": 2 * L, "area": L}
    if method not in reach:
        raise ValueError(f"method = {method!r}: must be one of {', '.join(reach)}")
    borders = subsurface.interfaces(of.body)
    if borders and borders[0] < reach[method]:
        raise ValueError(
            f"the {method} method reaches {reach[method]:.3e} m deep, beyond the outermost layer "
            f"of {borders[0]:.3e} m: a critical distance belongs to one material"
        )
    nodes, weights = np.polynomial.legendre.leggauss(NODES)
    nodes, weights = (nodes + 1) / 2, weights / 2
    if method == "point":
        nodes, weights = np.array([1.0]), np.array([1.0])
    depths = nodes * reach[method]
    if method == "area":
        weights = weights * np.sqrt(1.0 - nodes * nodes)
    weights = weights / weights.sum()
    mean, places = np.zeros(()), None
    for some, share in zip(of.chunks(depths), of.chunks(weights), strict=True):
        history, places = of.history(some)
        if method == "area":
            history = _over_width(history, places.x.values, np.sqrt(L * L - some * some))
        mean = mean + np.einsum("k,tkxc->txc", share, history)
    assert places is not None
    inside = np.isfinite(mean).all(axis=(0, 2))
    judged = evaluate(
        mean[:, inside], material.assessment(criterion).criterion, tolerance=tolerance
    )
    assessment = material.assessment(criterion)
    name, meaning = margin_name([assessment])
    margins = [margin_of(assessment, v) for v in judged.value.values.tolist()]
    judged[name] = ("dim_0", margins, {"units": "1", "long_name": meaning})
    judged = judged.rename(dim_0="x").assign_coords(x=places.x[inside])
    attrs = {"criterion": criterion, "method": method, "L": L}
    return judged.reindex(x=places.x).assign_attrs(attrs)


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
