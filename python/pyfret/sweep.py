"""The same contact under many loads: the running-condition map."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import xarray as xr

from pyfret._core import LoadPath, OffGridError
from pyfret.solving import solve

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import ArrayLike

    from pyfret._core import Scene

__all__ = ["running_map"]

#: What the map shows of the last cycle.
SHOWN = ("status", "energy_ratio", "sliding_ratio", "dissipated", "delta", "stiffness")


def running_map(
    scene: Scene,
    *,
    W: ArrayLike,
    T: ArrayLike,
    cycles: int = 1,
    increments: tuple[int, int] = (20, 20),
    on_point: Callable[[int, int], object] | None = None,
) -> xr.Dataset:
    """Running conditions of fretting cycles between -T and T under the normal force W.

    Every combination of loads is solved: indentation, first loading, then `cycles` cycles.

    Parameters
    ----------
    scene : Scene
        The contact; its grid must hold the contact at the largest W.
    W : array
        Normal forces [N].
    T : array
        Amplitudes of the tangential force [N]; those above mu W slide and are marked so without
        being solved, since no static solution exists.
    cycles : int
        Number of cycles; the map shows the last.
    increments : (int, int)
        Increments of the indentation and of a full stroke from -T to T.
    on_point : callable, optional
        Told how many points are done, and how many there are.

    Returns
    -------
    xarray.Dataset
        Over (W, T): ``status`` (0 no contact, 1 full stick, 2 partial slip, 3 gross slip),
        ``energy_ratio``, ``sliding_ratio``, ``dissipated`` [J], ``delta`` [m], ``stiffness`` [N/m];
        NaN where it slides, except the status.
    """
    normal, tangential = (np.atleast_1d(np.asarray(v, dtype=float)) for v in (W, T))
    shape = (normal.size, tangential.size)
    table = {name: np.full(shape, np.nan) for name in SHOWN}
    attrs: dict[str, dict[str, object]] = {}
    for done, (i, j) in enumerate(np.ndindex(*shape)):
        if tangential[j] > scene.mu * normal[i] * (1 - 1e-9):
            table["status"][i, j] = 3
        else:
            path = _path(float(normal[i]), float(tangential[j]), cycles, increments)
            try:
                last = solve(scene, path, save=[len(path)], progress=False).loops().isel(cycle=-1)
            except OffGridError as error:
                raise OffGridError(f"W = {normal[i]} N: {error}") from None
            for name in SHOWN:
                table[name][i, j] = last[name]
                attrs[name] = dict(last[name].attrs)
        if on_point is not None:
            on_point(done + 1, int(np.prod(shape)))
    return xr.Dataset(
        {name: (("W", "T"), values, attrs.get(name, {})) for name, values in table.items()},
        coords={
            "W": ("W", normal, {"units": "N", "long_name": "normal force"}),
            "T": ("T", tangential, {"units": "N", "long_name": "amplitude of the force"}),
        },
        attrs={"title": scene.title, "mu": scene.mu},
    )


def _path(W: float, T: float, cycles: int, increments: tuple[int, int]) -> LoadPath:
    indentation, stroke = increments
    path = LoadPath.start().normal(W, increments=indentation)
    turns: Sequence[float] = [T, *([-T, T] * cycles)]
    for n, value in enumerate(turns):
        path = path.force(T_x=value, increments=max(stroke // 2, 1) if n == 0 else stroke)
    return path
