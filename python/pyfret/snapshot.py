"""The contact at the end of one increment: its fields, and the stress below it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pyfret import _core, subsurface
from pyfret.doubts import doubt_layers
from pyfret.guesses import no_attribute
from pyfret.of_run import OfRun
from pyfret.stress import LABELS

if TYPE_CHECKING:
    import os
    from collections.abc import Sequence

    import xarray as xr
    from numpy.typing import ArrayLike

    from pyfret._core import Body
    from pyfret.subsurface import Stress

__all__ = ["Snapshot"]


class Snapshot(OfRun):
    """The contact at the end of one increment: its scalars and its fields.

    Every variable of :attr:`dataset` is an attribute as well, e.g. ``snapshot.p``.
    """

    # The variables of a result store, for editors and type checkers.
    x: xr.DataArray
    y: xr.DataArray
    increment: xr.DataArray
    t: xr.DataArray
    branch_of_increment: xr.DataArray
    W: xr.DataArray
    T_x: xr.DataArray
    T_y: xr.DataArray
    M_x: xr.DataArray
    M_y: xr.DataArray
    M_z: xr.DataArray
    sigma_B: xr.DataArray
    sigma_B1: xr.DataArray
    rolled: xr.DataArray
    delta_z: xr.DataArray
    delta_x: xr.DataArray
    delta_y: xr.DataArray
    phi_x: xr.DataArray
    phi_y: xr.DataArray
    phi_z: xr.DataArray
    status: xr.DataArray
    contact_area: xr.DataArray
    stick_area: xr.DataArray
    stick_ratio: xr.DataArray
    contact_radius: xr.DataArray
    p_max: xr.DataArray
    q_max: xr.DataArray
    work: xr.DataArray
    elastic: xr.DataArray
    dissipated: xr.DataArray
    opening: xr.DataArray
    quadrature: xr.DataArray
    residual_gap: xr.DataArray
    residual_penetration: xr.DataArray
    residual_coulomb: xr.DataArray
    residual_stick: xr.DataArray
    residual_direction: xr.DataArray
    residual_angle: xr.DataArray
    residual_balance: xr.DataArray
    residual_energy: xr.DataArray
    convolutions: xr.DataArray
    alternations: xr.DataArray
    normal_iterations: xr.DataArray
    tangential_iterations: xr.DataArray
    parts: xr.DataArray
    p: xr.DataArray
    q_x: xr.DataArray
    q_y: xr.DataArray
    u_x: xr.DataArray
    u_y: xr.DataArray
    u_z: xr.DataArray
    gap: xr.DataArray
    slip_x: xr.DataArray
    slip_y: xr.DataArray
    dissipated_density: xr.DataArray
    contact: xr.DataArray
    stick: xr.DataArray

    @property
    def dataset(self) -> xr.Dataset:
        """Fields of dims (x, y), the scalars of the increment, and the attrs of the run."""
        return super().dataset

    def __getattr__(self, name: str) -> xr.DataArray:
        """Give the variable `name` of the dataset."""
        if name.startswith("_"):
            raise AttributeError(name)
        if name in self.dataset.variables:
            return self.dataset[name]
        elsewhere = {of: f"it is a stress, snapshot.stress().{of}" for of in LABELS}
        for known, variable in self.dataset.variables.items():
            meaning = str(variable.attrs.get("long_name", ""))
            if meaning.split(",")[0] == name:
                elsewhere[name] = f"it is called {known}, {meaning}"
        public = (member for member in dir(type(self)) if not member.startswith("_"))
        raise no_attribute("snapshot", name, [*self.names(), *public], elsewhere)

    def names(self) -> list[str]:
        """Names of all variables, in order."""
        return sorted(str(name) for name in self.dataset.variables)

    @property
    def length(self) -> float:
        """The length that results are measured in [m].

        a_H, or where there is no Hertz contact half the longer side of the box around the contact.
        """
        return self.scene.length(self.dataset["p"].values)

    def __dir__(self) -> list[str]:
        """The variables beside the methods."""
        return sorted({*super().__dir__(), *self.names()})

    def _body(self, body_number: int) -> Body:
        scene = self.scene
        return scene.body1 if body_number == 1 else scene.body2

    def _tractions(self) -> dict[str, np.ndarray]:
        return {k: self.dataset[k].values for k in ("p", "q_x", "q_y")}

    def bulk_stress(self, body_number: int = 2) -> float:
        """Bulk stress along x of the substrate of a body [Pa]."""
        return float(self.dataset["sigma_B1" if body_number == 1 else "sigma_B"])

    def stress(
        self,
        z: ArrayLike | None = None,
        *,
        x: float | None = None,
        y: float | None = None,
        body_number: int = 2,
        bulk: bool = True,
        rim: bool = True,
        residual: Sequence[float] | None = None,
    ) -> Stress:
        """Stress below the contact, in the lower body unless `body_number` is 1.

        Parameters
        ----------
        z : float or array, optional
            Depths [m]; those on an interface appear twice, once in each layer (default: those that
            the layers ask for, down to twice :attr:`length`).
        x, y : float, optional
            With `y`, the section along x at that y; with `x`, that along y; with both, the line
            below a point; with neither, the whole plane at every depth given, or where none is, the
            section at y = 0.
        body_number : 1 or 2
            The body.
        bulk : bool
            Whether its bulk stress is part of the stress.
        rim : bool
            Whether tractions vary within the cells beside the rim and the stick zone, as in
            :func:`pyfret.subsurface.stress`.
        residual : sequence of float, optional
            Residual stress of every layer from the surface down, the substrate's last [Pa], tension
            positive: biaxial and uniform, added to s_xx and s_yy. It has no effect on the contact.

        Warns
        -----
        SceneWarning
            The first interface is nearer to the surface than a cell is long.

        Examples
        --------
        >>> below = result.at(-1).stress()  # doctest: +SKIP
        >>> below.maximum("von_mises")  # doctest: +SKIP
        """
        body, grid = self._body(body_number), self.scene.grid
        doubt_layers(subsurface.interfaces(body), grid)
        sigma_B = self.bulk_stress(body_number) if bulk else 0.0
        below = subsurface.stress(
            body,
            grid,
            z,
            x=x,
            y=y,
            body_number=body_number,
            sigma_B=sigma_B,
            rim=rim,
            stick=self.dataset["stick"].values,
            length=self.length,
            residual=residual,
            **self._tractions(),
        )
        yardsticks = {k: v for k, v in self.dataset.attrs.items() if k in ("a_H", "p_H")}
        return subsurface.Stress(below.dataset.assign_attrs(yardsticks))

    def p_continued(self) -> xr.DataArray:
        """Pressure at the centres of the cells [Pa], that at the rim continued from inside.

        Cells at the rim carry what balances the others, up to a tenth more or less than the
        pressure at their centres; this is nearer to that. The sum of ``p`` is the load.
        """
        p = self.dataset["p"]
        return p.copy(data=_core.continued_pressure(p.values, self.scene.grid))

    def displacement(
        self,
        z: ArrayLike | None = None,
        *,
        x: float | None = None,
        y: float | None = None,
        body_number: int = 2,
    ) -> xr.Dataset:
        """Displacements u_x, u_y, u_z of a body below the contact [m], as in :meth:`stress`."""
        body, grid = self._body(body_number), self.scene.grid
        loads = self._tractions()
        return subsurface.displacement(
            body, grid, z, x=x, y=y, body_number=body_number, length=self.length, **loads
        )

    def write_volume(
        self,
        out: str | os.PathLike[str],
        z: ArrayLike | None = None,
        *,
        of: Sequence[str] = ("von_mises",),
        body_number: int = 2,
        bulk: bool = True,
        residual: Sequence[float] | None = None,
        rim: bool = True,
    ) -> None:
        """Write stress, displacement in the volume: :func:`pyfret.subsurface.write_volume`."""
        body, grid = self._body(body_number), self.scene.grid
        subsurface.write_volume(
            body,
            grid,
            out,
            z,
            of=of,
            body_number=body_number,
            sigma_B=self.bulk_stress(body_number) if bulk else 0.0,
            residual=residual,
            rim=rim,
            stick=self.dataset["stick"].values,
            title=repr(self),
            **self._tractions(),
        )

    def along_x(self, *, y: float = 0.0) -> xr.Dataset:
        """Fields along the line of constant `y` [m], linear between the rows of cells."""
        rows = self.dataset.y.values
        if not rows[0] <= y <= rows[-1]:
            raise ValueError(f"y = {y}: must be {rows[0]} to {rows[-1]}, the rows of the grid")
        above = int(np.clip(np.searchsorted(rows, y), 1, rows.size - 1)) if rows.size > 1 else 0
        below = max(above - 1, 0)
        share = (y - rows[below]) / (rows[above] - rows[below]) if above else 0.0
        fields = self.dataset[[k for k, v in self.dataset.items() if v.dtype.kind == "f"]]
        row = fields.isel(y=below, drop=True) * (1 - share)
        return row + fields.isel(y=above, drop=True) * share

    def __repr__(self) -> str:
        """Say which increment this is and under which loads."""
        d = self.dataset
        return (
            f"Snapshot(increment {int(d.increment)}, t = {float(d.t):.4g}, "
            f"W = {float(d.W):.4g} N, T_x = {float(d.T_x):.4g} N)"
        )
