"""Plastic strain over the increments of a cycle, beside their stress."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pyfret import _core
from pyfret._core import SHAKEN
from pyfret._util.arrays import histories, labels, plain
from pyfret._util.lazy import xr
from pyfret.subsurface.fields import coordinates
from pyfret.subsurface.plastic import COMPONENTS, eigenstress

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from pyfret._core import Criterion
    from pyfret.run import Run
    from pyfret.subsurface.line import Line

__all__ = ["GROWS", "grows", "strains_beside", "strains_of", "yielding_of"]

#: Attribute of a stress history: the plastic strain grows within it.
GROWS = "plastic_strain_grows"


def yielding_of(
    result: Run, kept: NDArray[np.int64], body_number: int
) -> tuple[float, float] | None:
    """Plastic work of some increments, and that beside which it is small [J]; None if elastic."""
    if not (result.scene.body1 if body_number == 1 else result.scene.body2).yields:
        return None
    d = result.dataset
    inside = ((d.increment > kept[0]) & (d.increment <= kept[-1])).values
    rubbed = float(d.dissipated.values[inside].sum())
    beside = rubbed if rubbed > 0.0 else float(d.plastic_work.sum())
    return float(d.plastic_work.values[inside].sum()), beside


def grows(result: Run, kept: NDArray[np.int64], body_number: int) -> bool:
    """Whether the plastic strain of a body grows within some increments."""
    work = yielding_of(result, kept, body_number)
    return work is not None and work[0] > SHAKEN * work[1]


def strains_of(
    result: Run, kept: NDArray[np.int64], z: ArrayLike, line: Line, body_number: int
) -> xr.DataArray:
    """The plastic strain of some increments at the places of their stress."""
    body = result.scene.body1 if body_number == 1 else result.scene.body2
    depths, layers = _core.depths(body, np.atleast_1d(plain(z, "z")).tolist())
    places = xr.Dataset(coords=coordinates(result.scene.grid, depths, layers, *line))
    whole = xr.broadcast(places.z, places.layer, places.x, places.y)
    shape, dims = whole[0].shape, whole[0].dims
    deep, layer, x, y = (of.values.ravel().tolist() for of in whole)
    strain = np.zeros((kept.size, *shape, len(COMPONENTS)))
    for now, increment in zip(strain, kept, strict=True):
        for left in eigenstress(result.at(int(increment)), body_number):
            if left is not None:
                now[...] = left.plastic_strain(x, y, deep, layer).reshape(now.shape)
    return xr.DataArray(
        strain,
        dims=("increment", *dims, "component"),
        coords={**places.coords, "increment": kept, "component": COMPONENTS},
        attrs={"units": "1", "long_name": "plastic strain"},
        name="plastic_strain",
    )


def strains_beside(
    stress: ArrayLike, plastic_strain: ArrayLike | None, criterion: Criterion
) -> NDArray[np.float64] | None:
    """The plastic strain beside a stress of shape (time, points, 6), if it is given."""
    if plastic_strain is None:
        if criterion.takes_strain and getattr(stress, "attrs", {}).get(GROWS):
            raise ValueError(
                f"criterion = {criterion.name}: must be a criterion of stress such as dang_van, "
                "since the plastic strain grows in this cycle. Or give plastic_strain="
                "fatigue.history(..., of='plastic_strain')"
            )
        return None
    axes = labels(stress)
    given = plastic_strain
    if axes and sorted(map(str, axes)) == sorted(map(str, labels(given))):
        given = given.transpose(*axes)  # type: ignore[union-attr]
    return histories(given, "plastic_strain", COMPONENTS).values
