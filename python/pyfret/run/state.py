"""The contact at the end of one increment: its scalars and its fields."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from pyfret import _core
from pyfret._util.attributes import attribute_error
from pyfret._util.numbers import in_words
from pyfret._util.tables import as_table
from pyfret._util.window import wrap
from pyfret.quantities import quantities
from pyfret.run.attributes import OfRun

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

    from pyfret._core import Body
    from pyfret._util.labelled_table import Table

__all__ = ["State"]

#: Scalars of a summary.
SUMMARY = (
    *("W", "T_x", "T_y", "M_z", "sigma_B", "delta_z", "delta_x", "delta_y", "phi_z"),
    *("contact_radius", "half_width", "contact_area", "real_area", "stick_ratio"),
    *("p_max", "q_max", "dissipated"),
)


class State(OfRun):
    """The contact at the end of one increment: its scalars and its fields.

    Every variable of :attr:`dataset` is an attribute as well, e.g. ``snapshot.p``.
    """

    table_axes = ("x", "y")

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
    half_width: xr.DataArray
    cells_per_radius: xr.DataArray
    real_area: xr.DataArray
    real_area_error: xr.DataArray
    nominal_area: xr.DataArray
    spots: xr.DataArray
    rms_slope: xr.DataArray
    slope_length: xr.DataArray
    largest_spot: xr.DataArray
    lone_share: xr.DataArray
    mean_gap: xr.DataArray
    mean_pressure: xr.DataArray
    p_max: xr.DataArray
    q_max: xr.DataArray
    q_rms: xr.DataArray
    q_scatter: xr.DataArray
    plastic_work: xr.DataArray
    plastic_volume: xr.DataArray
    largest_plastic_strain: xr.DataArray
    strain_at_rim: xr.DataArray
    yield_ratio: xr.DataArray
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
    path_grid: xr.DataArray
    parts: xr.DataArray
    p: xr.DataArray
    q_x: xr.DataArray
    q_y: xr.DataArray
    u_x: xr.DataArray
    u_y: xr.DataArray
    u_z: xr.DataArray
    gap: xr.DataArray
    indentation: xr.DataArray
    slip_x: xr.DataArray
    slip_y: xr.DataArray
    dissipated_density: xr.DataArray
    contact: xr.DataArray
    stick: xr.DataArray
    at_limit: xr.DataArray

    @property
    def dataset(self) -> xr.Dataset:
        """Fields of dims (x, y), the scalars of the increment, and the attrs of the run."""
        return super().dataset

    def __getattr__(self, name: str) -> xr.DataArray:
        """Give the variable or the attribute `name` of the dataset."""
        if name.startswith("_"):
            raise AttributeError(name)
        if name in self.dataset.variables:
            return self.dataset[name]
        if name in self.dataset.attrs:
            return self.dataset.attrs[name]  # type: ignore[no-any-return]
        public = (member for member in dir(type(self)) if not member.startswith("_"))
        names = [*self.names(), *map(str, self.dataset.attrs), *public]
        raise attribute_error("snapshot", name, names, self._elsewhere(name))

    def _elsewhere(self, name: str) -> dict[str, str]:
        """Return where a name is found that this object does not have."""
        hints = {"save": "result.save(path) writes the run, snapshot.to_csv(path) its fields"}
        if name == "contact_radius":
            hints[name] = "of a line contact it is half_width"
        for variable_name, variable in self.dataset.variables.items():
            meaning = str(variable.attrs.get("long_name", ""))
            if meaning.split(",")[0] == name:
                hints[name] = f"it is called {variable_name}, {meaning}"
        return hints

    def summary(self) -> str:
        """Give the scalars of the increment that are not zero, with units and meanings."""
        d = self.dataset
        lines = [f"increment {int(d.increment)}, t = {in_words(float(d.t))}"]
        for name in SUMMARY:
            if name in d.variables and float(d[name]) != 0.0:
                unit = d[name].attrs.get("units", "1")
                value = in_words(float(d[name])) + ("" if unit == "1" else f" {unit}")
                lines.append(f"{name} = {value}: {d[name].attrs.get('long_name', '')}")
        return wrap("\n".join(lines))

    def names(self) -> list[str]:
        """Names of all variables, in order."""
        return sorted(str(name) for name in self.dataset.variables)

    @property
    def length(self) -> float:
        """The length that results are measured in [m].

        a_H, or where there is no Hertz contact half the longer side of the box around the contact.
        """
        return self.scene.length(self.dataset["p"].values)

    @cached_property
    def outline(self) -> _core.Outline | None:
        """The outline of the contact: border, spots and direction of the shear.

        None without a contact.
        """
        tractions = {k: np.asarray(v, dtype=float) for k, v in self.tractions().items()}
        if not (tractions["p"] > 0.0).any():
            return None
        return _core.Outline(self.scene.grid, **tractions)

    def __dir__(self) -> list[str]:
        """The variables beside the methods."""
        return sorted({*super().__dir__(), *self.names()})

    def body(self, body_number: int = 2) -> Body:
        """The upper body (1) or the lower one (2)."""
        scene = self.scene
        return scene.body1 if body_number == 1 else scene.body2

    def tractions(self) -> dict[str, NDArray[np.float64]]:
        """Pressure, and shear tractions on body 2, by their names: arrays of (x, y) [Pa]."""
        return {k: self.dataset[k].values for k in ("p", "q_x", "q_y")}

    def bulk_stress(self, body_number: int = 2) -> float:
        """Bulk stress along x of the substrate of a body [Pa]."""
        return float(self.dataset["sigma_B1" if body_number == 1 else "sigma_B"])

    def p_continued(self) -> xr.DataArray:
        """Pressure at the centres of the cells [Pa], that at the rim continued from inside.

        Cells at the rim carry what balances the others, up to a tenth more or less than the
        pressure at their centres. The continued values are nearer to it. The sum of ``p`` is the
        load.
        """
        p = self.dataset["p"]
        return p.copy(data=_core.continued_pressure(p.values, self.scene.grid))

    @quantities
    def along_x(self, *, y: float = 0.0) -> Table:
        """Return the fields along the line of constant `y` [m], linear between rows."""
        rows = self.dataset.y.values
        if not rows[0] <= y <= rows[-1]:
            raise ValueError(f"y = {y}: must be {rows[0]} to {rows[-1]}, the rows of the grid")
        above = int(np.clip(np.searchsorted(rows, y), 1, rows.size - 1)) if rows.size > 1 else 0
        below = max(above - 1, 0)
        share = (y - rows[below]) / (rows[above] - rows[below]) if above else 0.0
        fields = self.dataset[[k for k, v in self.dataset.items() if v.dtype.kind == "f"]]
        row = fields.isel(y=below, drop=True) * (1 - share)
        on_line = row + fields.isel(y=above, drop=True) * share
        for name, values in on_line.items():
            values.attrs.update(self.dataset[name].attrs)
        return as_table(on_line)

    def __repr__(self) -> str:
        """Say which increment this is and under which loads."""
        d = self.dataset
        force = d.W.attrs["units"]
        return (
            f"{type(self).__name__}(increment {int(d.increment)}, t = {in_words(float(d.t))}, "
            f"W = {in_words(float(d.W))} {force}, T_x = {in_words(float(d.T_x))} {force})"
        )
