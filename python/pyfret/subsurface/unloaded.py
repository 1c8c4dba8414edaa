"""Unloaded state of bodies that yielded: residual stress, and the imprint as a shape."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._core import SurfaceMap
from pyfret._util.scene_warnings import warn as doubt
from pyfret.subsurface import fields
from pyfret.subsurface.contact import line_below
from pyfret.subsurface.line import Line
from pyfret.subsurface.plastic import body_of, columns_of, eigenstress, plastic_points

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike, NDArray

    from pyfret._core import Sum
    from pyfret.run import State
    from pyfret.subsurface.tensor import Stress

__all__ = ["Unloaded"]


class Unloaded:
    """The bodies of an increment with the contact taken apart.

    The plastic strain belongs to the increment. Taking off the tractions changes the stress
    elastically. Where that would yield in reverse, a :class:`SceneWarning` is given. The load path
    then needs a branch that takes the load off.

    Parameters
    ----------
    state : Snapshot
        The increment.
    warn : bool
        Whether to warn where taking off the load would yield (default: yes).
    """

    def __init__(self, state: State, *, warn: bool = True) -> None:
        self._state = state
        bodies = [n for n in (1, 2) if state.body(n).yields]
        if not bodies:
            raise ValueError(
                "both bodies stay elastic, nothing is left after unloading: give a material "
                "plastic=Plastic(s_y=..)"
            )
        if warn and not self.is_elastic:
            doubt(
                "taking the load off yields in reverse: let the load path end with a branch that "
                "takes it off, such as .normal(0.01 * W)",
            )

    @cached_property
    def is_elastic(self) -> bool:
        """Whether the stress without the tractions yields nowhere."""
        number = 2 if self._state.body(2).yields else 1
        return body_of(self._state, number).unloads_elastically(columns_of(self._state))

    def stress(
        self,
        z: ArrayLike | None = None,
        *,
        x: float | None = None,
        y: float | None = None,
        azimuth: float | None = None,
        body_number: int = 2,
        residual: Sequence[Any] | None = None,
    ) -> Stress:
        """Residual stress of a body; parameters as in :meth:`Snapshot.stress`.

        Where nothing is given, the section along the shear, through the centre of the contact.
        Without a contact it passes the centre of the points that have yielded. Its ``maximum``
        searches the whole body.
        """
        state = self._state
        body, grid = state.body(body_number), state.scene.grid
        none = (None, None, None)
        eigenstress_of_body = eigenstress(state, body_number)
        below = fields.subsurface(
            body, grid, none, body_number, 0.0, residual, left=eigenstress_of_body
        )
        line, chosen = line_below(state, z, x, y, azimuth)
        if chosen and state.outline is None:
            line = Line(None, self._centre(body_number)[1])
        length = state.length
        sampled = fields.sampled_stress(
            below, body, grid, z, line, length if length > 0 else fields.loaded_length(grid)
        )
        yardsticks = {k: v for k, v in state.dataset.attrs.items() if k in ("a_H", "p_H")}
        return sampled.assign_attrs(yardsticks | {"anywhere": int(chosen)})

    def _centre(self, body_number: int) -> tuple[float, float]:
        """Return the mean place of yielded points, weighted by plastic strain [m]."""
        if not self._state.body(body_number).yields:
            return 0.0, 0.0
        points = plastic_points(self._state, body_number)
        weights = points.equivalent.values
        if not weights.sum() > 0.0:
            return 0.0, 0.0
        x, y = (float(np.average(points[name].values, weights=weights)) for name in "xy")
        return x, y

    def _depth(self, body_number: int) -> NDArray[np.float64]:
        """Return the depth of the surface of a body without load [m], shape (nx, ny)."""
        state = self._state
        if not state.body(body_number).yields:
            grid = state.scene.grid
            return np.zeros((grid.nx, grid.ny))
        return body_of(state, body_number).imprint(columns_of(state))["depth"]

    def depth(self, body_number: int = 2) -> float:
        """Give the largest depth of the imprint in a body [m]."""
        return float(self._depth(body_number).max())

    def imprint(self, body_number: int = 2) -> SurfaceMap:
        """Give the imprint in a body as heights out of it [m], on the cells of the grid.

        In plane strain the map has two equal columns along y.
        """
        grid = self._state.scene.grid
        heights = -self._depth(body_number)
        if grid.plane_strain:
            heights = np.repeat(heights, 2, axis=1)
        return SurfaceMap(heights, spacing=(grid.dx, grid.dy))

    def shape(self, body_number: int = 2) -> Sum:
        """Give the shape of a body with its imprint, for another scene or a run of wear.

        That scene begins without residual stress and plastic strain.

        Examples
        --------
        >>> left = result.unloaded()  # doctest: +SKIP
        >>> worn = scene.body2.replace(shape=left.shape(2))  # doctest: +SKIP
        """
        return self._state.body(body_number).shape + self.imprint(body_number)

    def __repr__(self) -> str:
        """Give the depths of the imprints."""
        depths = [
            f"imprint in body {n} {1e6 * self.depth(n):.3g} um"
            for n in (1, 2)
            if self._state.body(n).yields
        ]
        return f"Unloaded({', '.join(depths)})"
