"""The same contact under many loads: the running-condition map."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import xarray as xr

from pyfret._core import LoadPath, OffGridError
from pyfret.solving import solve

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import ArrayLike

    from pyfret._core import Scene

__all__ = ["running_map"]

#: Number of gross slip, and what the numbers mean.
SLIDES = 3
STATUS = "0 no contact, 1 full stick, 2 partial slip, 3 gross slip"

#: What the map shows of the last cycle.
SHOWN = ("energy_ratio", "sliding_ratio", "dissipated", "T", "delta", "stiffness")


def running_map(
    scene: Scene,
    *,
    W: ArrayLike,
    T: ArrayLike | None = None,
    delta: ArrayLike | None = None,
    cycles: int = 1,
    increments: tuple[int, int] = (20, 20),
    on_point: Callable[[int, int], object] | None = None,
) -> xr.Dataset:
    """Running conditions of fretting cycles under the normal force W.

    Every combination is solved: indentation, first loading, then `cycles` cycles between -T and T,
    or between the shifts -delta and delta.

    Parameters
    ----------
    scene : Scene
        The contact; its grid must hold the contact at the largest W.
    W : array
        Normal forces [N].
    T : array, optional
        Amplitudes of the tangential force [N]; those above mu W slide and are marked so without
        being solved, since no static solution exists.
    delta : array, optional
        Amplitudes of the shift [m], instead of `T`: gross slip is solved as well.
    cycles : int
        Number of cycles; the map shows the last.
    increments : (int, int)
        Increments of the indentation and of a full stroke.
    on_point : callable, optional
        Told how many points are done, and how many there are.

    Returns
    -------
    xarray.Dataset
        Over W and T or delta: ``status`` (0 no contact, 1 full stick, 2 partial slip, 3 gross
        slip), ``energy_ratio``, ``sliding_ratio``, ``dissipated`` [J], ``stiffness`` [N/m], and
        ``delta`` [m] or ``T`` [N], half of their ranges; NaN where a force slides, except the
        status.
    """
    if (T is None) == (delta is None):
        raise ValueError("give the amplitudes T or delta, one of them")
    driven = "T" if delta is None else "delta"
    given = T if delta is None else delta
    normal, tangential = (np.atleast_1d(np.asarray(v, dtype=float)) for v in (W, given))
    shape = (normal.size, tangential.size)
    shown = [name for name in SHOWN if name != driven]
    table = {name: np.full(shape, np.nan) for name in shown}
    status = np.full(shape, SLIDES)
    attrs: dict[str, dict[str, object]] = {"status": {"long_name": STATUS}}
    for done, (i, j) in enumerate(np.ndindex(*shape)):
        load, amplitude = float(normal[i]), float(tangential[j])
        if driven == "delta" or amplitude <= scene.mu * load * (1 - 1e-9):
            path = _path(load, {driven: amplitude}, cycles, increments)
            try:
                last = solve(scene, path, save=[len(path)], progress=False).loops().isel(cycle=-1)
            except OffGridError as error:
                raise OffGridError(f"W = {load} N: {error}") from None
            status[i, j] = last["status"]
            for name in shown:
                table[name][i, j] = last[name]
                attrs[name] = dict(last[name].attrs)
        if on_point is not None:
            on_point(done + 1, int(np.prod(shape)))
    units = {"T": ("N", "amplitude of the force"), "delta": ("m", "amplitude of the shift")}
    unit, meaning = units[driven]
    return xr.Dataset(
        {
            name: (("W", driven), values, attrs.get(name, {}))
            for name, values in {"status": status, **table}.items()
        },
        coords={
            "W": ("W", normal, {"units": "N", "long_name": "normal force"}),
            driven: (driven, tangential, {"units": unit, "long_name": meaning}),
        },
        attrs={"title": scene.title, "mu": scene.mu},
    )


def _path(
    W: float, amplitude: dict[str, float], cycles: int, increments: tuple[int, int]
) -> LoadPath:
    indentation, stroke = increments
    path = LoadPath.start().normal(W, increments=indentation)
    ((driven, value),) = amplitude.items()
    for n, turn in enumerate([value, *([-value, value] * cycles)]):
        part = max(stroke // 2, 1) if n == 0 else stroke
        if driven == "T":
            path = path.force(T_x=turn, increments=part)
        else:
            path = path.displace(delta_x=turn, increments=part)
    return path
