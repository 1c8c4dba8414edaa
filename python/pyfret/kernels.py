"""The response of a body to tractions on its surface, for people who build their own models.

Columns of every response are the tractions q_x, q_y, p on the body; tension is positive in
stresses, and displacements are those of the surface of body 2, z pointing into it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pyfret import _core
from pyfret._core import influence_coefficients, stress_at, stress_coefficients

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from pyfret._core import Body

__all__ = ["influence_coefficients", "stress_at", "stress_coefficients", "surface_frf"]


def surface_frf(body: Body, k_x: ArrayLike, k_y: ArrayLike) -> NDArray[np.complex128]:
    """Surface displacements under tractions exp(i (k_x x + k_y y)).

    Parameters
    ----------
    body : Body
        Homogeneous or coated.
    k_x, k_y : array
        Wave numbers [1/m] of any shapes that broadcast, never both zero.

    Returns
    -------
    array of shape (..., 3, 3)
        Rows u_x, u_y, u_z, columns q_x, q_y, p [m/Pa].
    """
    waves = np.broadcast_arrays(np.asarray(k_x, dtype=float), np.asarray(k_y, dtype=float))
    frf = _core.surface_frf(body, *(np.ravel(k) for k in waves))
    return frf.reshape(*waves[0].shape, 3, 3)
