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

__all__ = [
    "GROWS",
    "align_plastic_strain",
    "plastic_and_reference_work",
    "plastic_strain_grows",
    "plastic_strain_history",
]

#: Attribute of a stress history: the plastic strain grows within it.
GROWS = "plastic_strain_grows"


def plastic_and_reference_work(
    result: Run, kept: NDArray[np.int64], body_number: int
) -> tuple[float, float] | None:
    """Return the plastic work of some increments and the work to compare it with [J].

    The latter is the friction work of the increments, without friction the plastic work of the
    path. None for an elastic body.
    """
    if not (result.scene.body1 if body_number == 1 else result.scene.body2).yields:
        return None
    d = result.dataset
    inside = ((d.increment > kept[0]) & (d.increment <= kept[-1])).values
    friction_work = float(d.dissipated.values[inside].sum())
    reference = friction_work if friction_work > 0.0 else float(d.plastic_work.sum())
    return float(d.plastic_work.values[inside].sum()), reference


def plastic_strain_grows(result: Run, kept: NDArray[np.int64], body_number: int) -> bool:
    """Whether the plastic strain of a body grows within some increments."""
    work = plastic_and_reference_work(result, kept, body_number)
    return work is not None and work[0] > SHAKEN * work[1]


def plastic_strain_history(
    result: Run, kept: NDArray[np.int64], z: ArrayLike, line: Line, body_number: int
) -> xr.DataArray:
    """Return the plastic strain of some increments at the places of their stress."""
    body = result.scene.body1 if body_number == 1 else result.scene.body2
    depths, layers = _core.depths(body, np.atleast_1d(plain(z, "z")).tolist())
    places = xr.Dataset(coords=coordinates(result.scene.grid, depths, layers, *line))
    whole = xr.broadcast(places.z, places.layer, places.x, places.y)
    shape, dims = whole[0].shape, whole[0].dims
    deep, layer, x, y = (coordinate.values.ravel().tolist() for coordinate in whole)
    strain = np.zeros((kept.size, *shape, len(COMPONENTS)))
    for strain_now, increment in zip(strain, kept, strict=True):
        for eigenstrain in eigenstress(result.at(int(increment)), body_number):
            if eigenstrain is not None:
                strain_now[...] = eigenstrain.plastic_strain(x, y, deep, layer).reshape(
                    strain_now.shape
                )
    return xr.DataArray(
        strain,
        dims=("increment", *dims, "component"),
        coords={**places.coords, "increment": kept, "component": COMPONENTS},
        attrs={"units": "1", "long_name": "plastic strain"},
        name="plastic_strain",
    )


def align_plastic_strain(
    stress: ArrayLike, plastic_strain: ArrayLike | None, criterion: Criterion
) -> NDArray[np.float64] | None:
    """Return the plastic strain in the order of a stress of shape (time, points, 6), if given."""
    if plastic_strain is None:
        if criterion.takes_strain and getattr(stress, "attrs", {}).get(GROWS):
            raise ValueError(
                f"criterion = {criterion.name}: must be a criterion of stress such as dang_van, "
                "since the plastic strain grows in this cycle. Or give plastic_strain="
                "fatigue.history(..., of='plastic_strain')"
            )
        return None
    axes = labels(stress)
    aligned = plastic_strain
    if axes and sorted(map(str, axes)) == sorted(map(str, labels(aligned))):
        aligned = aligned.transpose(*axes)  # type: ignore[union-attr]
    return histories(aligned, "plastic_strain", COMPONENTS).values
