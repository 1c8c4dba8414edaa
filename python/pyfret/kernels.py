"""The response of a body to tractions and eigenstrains, for people who build their own models.

Columns of every response are the tractions q_x, q_y, p on the body. Tension is positive in
stresses. Displacements belong to the surface of body 2, z pointing into it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pyfret import _core
from pyfret._core import EigenstrainOperator, influence_coefficients, stress_at, stress_coefficients
from pyfret._util.arrays import plain
from pyfret._util.names import listing
from pyfret.quantities import Numbers, quantities

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from pyfret._core import Body, Grid

__all__ = [
    "EigenstrainOperator",
    "convert",
    "influence_coefficients",
    "stress_at",
    "stress_coefficients",
    "surface_frf",
]
__dir__ = listing(__all__)


@quantities
def surface_frf(body: Body, k_x: Numbers, k_y: Numbers) -> NDArray[np.complex128]:
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
    waves = np.broadcast_arrays(plain(k_x, "k_x"), plain(k_y, "k_y"))
    frf = _core.surface_frf(body, *(np.ravel(k) for k in waves))
    return frf.reshape(*waves[0].shape, 3, 3)


@quantities
def convert(
    frf: Callable[[NDArray[np.float64], NDArray[np.float64]], NDArray[np.complex128]],
    grid: Grid,
    *,
    enlargement: int = 8,
    aliases: int = 0,
) -> NDArray[np.float64]:
    """Influence coefficients of your own frequency response, by the paper's eq. (9)-(13).

    Parameters
    ----------
    frf : callable
        Gives the response at arrays k_x, k_y of shape (n,) [1/m], never both zero. The response is
        an array of shape (n, 3, 3) [m/Pa], rows u_x, u_y, u_z, columns q_x, q_y, p. It has f(-k) =
        conj f(k).
    grid : Grid
        The cells; only their number and size matter.
    enlargement : int
        How many times larger the domain of the inverse transform is, at least 2 (default 8).
    aliases : int
        Order of the alias sums (default 0, as in the paper).

    Returns
    -------
    array of shape (3, 3, 2 nx - 1, 2 ny - 1)
        As :func:`influence_coefficients` gives them.
    """
    conversion = _core.Conversion(grid, enlargement=enlargement, aliases=aliases)
    response = np.asarray(frf(*conversion.wave_vectors()), dtype=np.complex128)
    return conversion.convert(response)
