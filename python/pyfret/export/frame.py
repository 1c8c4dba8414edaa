"""Position of a contact in another model, and the units of that model."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from pyfret._util.arrays import plain

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["Frame"]

#: Units of length: how many of them are a metre, how many of their stresses a pascal, and these.
UNITS = {"m": (1.0, 1.0, "Pa"), "mm": (1e3, 1e-6, "MPa")}
#: Cosine between the axes beyond which they are no right angle.
SKEW = 1e-9


@dataclass(frozen=True, kw_only=True)
class Frame:
    """The axes of a contact in another model, and the units of that.

    Forces are in N in both systems: m, N, Pa and mm, N, MPa.
    """

    #: The middle of the grid, in the model's unit of length.
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)
    #: Direction of the contact's axis x.
    x: tuple[float, float, float] = (1.0, 0.0, 0.0)
    #: Direction of the contact's axis z, into body 2.
    z: tuple[float, float, float] = (0.0, 0.0, 1.0)
    #: The model's unit of length.
    unit: Literal["m", "mm"] = "m"

    def __post_init__(self) -> None:
        """Refuse what is no frame."""
        if not isinstance(self.unit, str) or self.unit not in UNITS:
            shown = (
                repr(self.unit) if isinstance(self.unit, str) else f"<{type(self.unit).__name__}>"
            )
            raise ValueError(f'unit = {shown}: must be "m" or "mm"')
        for name in ("origin", "x", "z"):
            value = plain(getattr(self, name), name)
            if value.shape != (3,):
                raise ValueError(f"{name} = {getattr(self, name)!r}: must be three finite numbers")
        lengths = [float(np.linalg.norm(axis)) for axis in (self.x, self.z)]
        if min(lengths) == 0.0 or abs(np.dot(self.x, self.z)) > SKEW * lengths[0] * lengths[1]:
            raise ValueError(f"x = {self.x}, z = {self.z}: must be two directions at right angles")

    @property
    def axes(self) -> NDArray[np.float64]:
        """The contact's unit vectors x, y, z as rows."""
        x, z = (np.asarray(axis, float) / np.linalg.norm(axis) for axis in (self.x, self.z))
        return np.array([x, np.cross(z, x), z])

    @property
    def per_metre(self) -> float:
        """How many of the model's units of length are a metre."""
        return UNITS[self.unit][0]

    @property
    def per_pascal(self) -> float:
        """How many of the model's units of stress are a pascal."""
        return UNITS[self.unit][1]

    @property
    def unit_of_stress(self) -> str:
        """The model's unit of stress."""
        return UNITS[self.unit][2]

    def place(self, points: ArrayLike) -> NDArray[np.float64]:
        """Places of the contact, shape (..., 3) [m], in the model and its unit."""
        return np.asarray(self.origin) + self.per_metre * (plain(points, "points") @ self.axes)

    def contact_place(self, points: ArrayLike) -> NDArray[np.float64]:
        """Places of the model, shape (..., 3), in the contact's axes [m]."""
        away = plain(points, "points") - np.asarray(self.origin)
        return np.asarray(away @ self.axes.T / self.per_metre)

    def vector(self, vectors: ArrayLike) -> NDArray[np.float64]:
        """Rotate vectors, shape (..., 3), from the contact's axes to the model's axes."""
        return np.asarray(plain(vectors, "vectors") @ self.axes)

    def contact_stress(self, stress: ArrayLike) -> NDArray[np.float64]:
        """Stresses of the model, shape (..., 3, 3), along the contact's axes [Pa]."""
        turned = self.axes @ plain(stress, "stress") @ self.axes.T
        return np.asarray(turned / self.per_pascal)

    def stress(self, stress: ArrayLike) -> NDArray[np.float64]:
        """Rotate stresses, shape (..., 3, 3) [Pa], from the contact's axes to the model's axes."""
        turned = self.axes.T @ plain(stress, "stress") @ self.axes
        return np.asarray(turned * self.per_pascal)
