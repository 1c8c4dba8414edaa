"""The stress below a contact over a closed cycle, a few depths at a time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pyfret import subsurface
from pyfret.fatigue import COMPONENTS, cycle_increments

if TYPE_CHECKING:
    from collections.abc import Sequence

    import xarray as xr
    from numpy.typing import ArrayLike, NDArray

    from pyfret.results import Result

__all__ = ["CycleStress"]

#: Largest size of the stress that is held at a time [bytes].
CHUNK = 64e6


class CycleStress:
    """The stress of a body over the kept increments of a closed cycle."""

    def __init__(
        self,
        result: Result,
        *,
        x: float | None,
        y: float | None,
        body_number: int,
        cycle: int,
        residual: Sequence[float] | None,
    ) -> None:
        self.result = result
        self.kept = cycle_increments(result, cycle)
        scene = result.scene
        self.body = scene.body1 if body_number == 1 else scene.body2
        self.grid = scene.grid
        self.body_number = body_number
        self.place = {"x": x, "y": y}
        self.layers = len(self.body.coatings) + 1
        if residual is not None and len(residual) != self.layers:
            raise ValueError(
                f"residual has {len(residual)} numbers: must be one for each of the "
                f"{self.layers} layers, the substrate last"
            )
        self.residual = np.zeros(self.layers) if residual is None else np.asarray(residual, float)

    def history(self, z: ArrayLike) -> tuple[NDArray[np.float64], xr.Dataset]:
        """The stress of shape (time, depth, along, 6), and a dataset with its places."""
        moments = []
        for n in self.kept:
            now = self.result.at(int(n))
            stress = subsurface.stress(
                self.body,
                self.grid,
                z,
                p=now.p.values,
                q_x=now.q_x.values,
                q_y=now.q_y.values,
                x=self.place["x"],
                y=self.place["y"],
                body_number=self.body_number,
                sigma_B=now.bulk_stress(self.body_number),
                rim=True,
                stick=now.dataset["stick"].values,
            ).dataset
            moments.append(np.stack([stress[c].values for c in COMPONENTS], axis=-1))
        history = np.stack(moments)
        history[..., :2] += self.residual[stress.layer.values][:, None, None]
        return history, stress

    def chunks(self, z: NDArray[np.float64]) -> list[NDArray[np.float64]]:
        """The depths, as many together as memory allows."""
        along = self.grid.nx if self.place["x"] is None else self.grid.ny
        each = 8.0 * 6 * along * len(self.kept)
        return np.array_split(z, max(1, int(np.ceil(z.size * each / CHUNK))))
