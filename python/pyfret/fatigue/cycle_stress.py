"""The stress below a contact over a closed cycle, a few depths at a time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pyfret import _core
from pyfret._util.lazy import xr
from pyfret.fatigue.cycles import cycle_increments
from pyfret.subsurface.fields import coordinates, interfaces

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import ArrayLike, NDArray

    from pyfret.fatigue.section import Section
    from pyfret.run import Run

__all__ = ["CycleStress", "judge"]

#: Largest size of the stress that is held at a time [bytes].
CHUNK = 64e6
#: Increments whose stresses are computed together: the kernels of a depth cost as much as ten.
STATES = 32


class CycleStress:
    """The stress of a body over the kept increments of a closed cycle, on one section."""

    def __init__(self, result: Run, section: Section) -> None:
        self.result = result
        self.section = section
        self.place = section.place
        self.kept = cycle_increments(result, section.cycle)
        scene = result.scene
        self.body = scene.body1 if section.body_number == 1 else scene.body2
        self.grid = scene.grid
        self.layers = len(self.body.coatings) + 1

    def history(
        self, z: ArrayLike, *, residual: bool = True
    ) -> tuple[NDArray[np.float64], xr.Dataset]:
        """The stress of shape (time, depth, along, 6) [Pa], and the coordinates of its places.

        Without `residual` it is what the loads alone cause.
        """
        depths, layers = _core.depths(self.body, np.atleast_1d(np.asarray(z, float)).tolist())
        number = self.section.body_number
        x = self.place if self.section.across == "x" else None
        y = self.place if self.section.across == "y" else None
        parts = []
        for some in np.array_split(self.kept, int(np.ceil(self.kept.size / STATES))):
            moments = [self.result.at(int(n)) for n in some]
            fields = {
                name: np.stack([now.dataset[name].values for now in moments])
                for name in ("p", "q_x", "q_y", "stick")
            }
            fields["stick"] = fields["stick"].astype(bool)
            stress = _core.section_of_states(
                self.body,
                self.grid,
                depths,
                layers,
                **fields,
                sigma_B=[now.bulk_stress(number) for now in moments],
                residual=self.section.residual if residual else None,
                x=x,
                y=y,
                body_number=number,
            )
            parts.append(np.moveaxis(stress, 1, -1))
        places = coordinates(self.grid, depths, layers, x, y)
        return np.concatenate(parts), xr.Dataset(coords=places)

    def chunks(self, z: NDArray[np.float64]) -> list[NDArray[np.float64]]:
        """The depths, as many together as memory allows."""
        along = self.grid.nx if self.section.along == "x" else self.grid.ny
        each = 8.0 * 6 * along * len(self.kept)
        return np.array_split(z, max(1, int(np.ceil(z.size * each / CHUNK))))


#: What a judge finds in the points of a layer: values over (depth, along, ...) with their attrs.
Found = dict[str, tuple["NDArray[np.float64]", dict[str, str]]]


def judge(
    result: Run,
    section: Section,
    z: ArrayLike | None,
    judge_layer: Callable[[NDArray[np.float64], int], Found | None],
    *,
    residual: bool = True,
) -> xr.Dataset:
    """Judge the layers of a section over its cycle, a few depths at a time.

    Parameters
    ----------
    result, section
        The run and where to judge it.
    z : array, optional
        Depths [m] (default: those that the layers ask for, both sides of every interface).
    judge_layer : callable
        Takes the stress of shape (time, depth, along, 6) [Pa] and the layer from the surface down;
        gives names, values and attrs of what it finds, or None where the layer is not judged.
    residual : bool
        Whether the residual stress of the section is part of the stress.

    Returns
    -------
    xarray.Dataset
        Over (depth, x) or (depth, y), and over (depth, x, y) or (depth, y, x) for several sections;
        NaN in layers that are not judged.
    """
    sections = section.each()
    found = [
        _on_one(CycleStress(result, one), z, judge_layer, residual=residual) for one in sections
    ]
    if np.ndim(section.places) == 0:
        whole = found[0]
    else:
        whole = xr.concat(found, dim=section.across, coords="minimal", compat="override")
        whole = whole.transpose("depth", section.along, section.across, ...)
    body = result.scene.body1 if section.body_number == 1 else result.scene.body2
    yardsticks = {k: v for k, v in result.dataset.attrs.items() if k in ("a_H", "p_H")}
    return whole.assign_attrs(yardsticks, interfaces=interfaces(body))


def _on_one(
    of: CycleStress,
    z: ArrayLike | None,
    judge_layer: Callable[[NDArray[np.float64], int], Found | None],
    *,
    residual: bool,
) -> xr.Dataset:
    if z is None:
        z, _ = _core.chosen_depths(of.body, a=of.result.length, deepest=2.0 * of.result.length)
    parts = []
    for some in of.chunks(np.unique(np.asarray(z, dtype=float))):
        history, places = of.history(some, residual=residual)
        layers, dims = places.layer.values, ("depth", of.section.along)
        shown = xr.Dataset(coords={**places.coords, "axis": ["x", "y", "z"]})
        whole: Found = {}
        for layer in np.unique(layers).tolist():
            here = layers == layer
            for name, (values, attrs) in (judge_layer(history[:, here], layer) or {}).items():
                shape = (layers.size, *values.shape[1:])
                whole.setdefault(name, (np.full(shape, np.nan), attrs))[0][here] = values
        for name, (values, attrs) in whole.items():
            shown[name] = ((*dims, "axis")[: values.ndim], values, attrs)
        parts.append(shown)
    return xr.concat(parts, dim="depth", data_vars="minimal", coords="minimal")
