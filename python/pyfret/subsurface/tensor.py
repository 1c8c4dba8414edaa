"""The stress at places below the surface, and what follows from it."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from pyfret import _core
from pyfret._util.guesses import no_attribute
from pyfret._util.lazy import xr
from pyfret.scene.warnings import SceneWarning

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["COMPONENTS", "DISPLACEMENTS", "LABELS", "Maximum", "Stress"]

#: The six components, in their order.
COMPONENTS = ("s_xx", "s_yy", "s_zz", "s_xy", "s_xz", "s_yz")


class Maximum(NamedTuple):
    """The largest value of a measure on a section, between the samples."""

    #: Value [Pa].
    value: float
    #: Place along the section [m].
    along: float
    #: Depth [m].
    z: float
    #: Layer from the surface down; their number for the substrate.
    layer: int
    #: What the distances of the depths leave of an error, estimated [Pa].
    error: float


class Stress:
    """The six stresses somewhere below the surface, and what follows from them.

    ``stress.s_xx``, ``stress.von_mises``, ``stress.tresca``, ``stress.s_1`` (principal values, the
    largest first), ``stress.hydrostatic``, ``stress.interface_shear`` and
    ``stress.interface_peel`` are DataArrays; :attr:`dataset` holds the six components.
    """

    def __init__(self, dataset: xr.Dataset) -> None:
        self.dataset = dataset

    def _tensor(self) -> NDArray[np.float64]:
        """The components as an array of shape (6, number of points)."""
        return np.stack([self.dataset[c].values.ravel() for c in COMPONENTS])

    def measure(self, name: str) -> xr.DataArray:
        """Give what follows from the stress by its name."""
        if name in COMPONENTS:
            return self.dataset[name]
        units, meaning = LABELS[name]
        pattern = self.dataset[COMPONENTS[0]]
        values = _core.measure(name, self._tensor()).reshape(pattern.shape)
        attrs = {"units": units, "long_name": meaning}
        return pattern.copy(data=values).rename(name).assign_attrs(attrs)

    def __getattr__(self, name: str) -> xr.DataArray:
        """Give the measure `name`."""
        if not name.startswith("_") and name in LABELS:
            return self.measure(name)
        if name.startswith("_"):
            raise AttributeError(name)
        public = (member for member in dir(type(self)) if not member.startswith("_"))
        raise no_attribute("stress", name, [*LABELS, *public, "dataset"], {})

    def principal(self) -> xr.Dataset:
        """Principal values, the largest first, and unit vectors of their directions."""
        pattern = self.dataset[COMPONENTS[0]]
        values, directions = _core.principal(self._tensor())
        shape = pattern.shape
        return xr.Dataset(
            {
                "value": (
                    (*pattern.dims, "principal"),
                    values.reshape(*shape, 3),
                    {"units": "Pa", "long_name": "principal stress, the largest first"},
                ),
                "direction": (
                    (*pattern.dims, "principal", "axis"),
                    directions.reshape(*shape, 3, 3),
                    {"units": "1", "long_name": "direction of the principal stress"},
                ),
            },
            coords={**pattern.coords, "axis": ["x", "y", "z"]},
        )

    def maximum(self, of: str = "von_mises") -> Maximum:
        """Give the largest value on a section and its place, refined below the cell.

        A maximum at the surface or at an interface stays there. On the surface the rims of the
        contact take part, as :meth:`rims` gives them. ``interface_shear`` and ``interface_peel``
        are those of the interfaces. The error is what the distances of the depths leave, estimated
        by leaving out every other one.

        Warns
        -----
        SceneWarning
            A layer between the first and the last depth holds no depth, or not its borders: the
            largest value may lie there. Depths are chosen from the layers where none are given.
        """
        if of not in LABELS:
            raise ValueError(f"{of!r}: must be one of {', '.join(sorted(LABELS))}")
        self._doubt_depths()
        along = self._along()
        depths = self.dataset.z.values.tolist()
        layers = self.dataset.layer.values.tolist()
        stress = np.stack([self.dataset[c].values for c in COMPONENTS])
        found = _core.maximum(of, stress, depths, layers, self.dataset[along].values.tolist())
        if found is None and of.startswith("interface"):
            raise ValueError(f"{of}: no interface lies among the depths of the section")
        if found is None:
            raise ValueError("the section holds no number")
        return Maximum(*found)

    def rims(self) -> Stress:
        """Give the surface stress at the rims of the contact, from a section that has z = 0.

        It has a cusp there, such as the tension at the trailing edge, whose top no sample reaches:
        samples near by are extrapolated. Rims that they do not show well enough are left out.
        """
        along = self._along()
        surface = self.dataset.isel(depth=0)
        if float(surface.z) != 0.0:
            raise ValueError("the section has no surface: give stress(z=[0, ...], ...)")
        stress = np.stack([surface[c].values for c in COMPONENTS])
        places, tensors = _core.rims(stress, surface[along].values.tolist())
        variables = {
            name: ("rim", values, surface[name].attrs)
            for name, values in zip(COMPONENTS, tensors, strict=True)
        }
        coords = {k: v for k, v in surface.coords.items() if k != along}
        return Stress(xr.Dataset(variables, {**coords, along: ("rim", places, {"units": "m"})}))

    def _doubt_depths(self) -> None:
        """Warn of interfaces that the depths leave out."""
        z = self.dataset.z.values
        missed = [
            depth
            for depth in self.dataset.attrs.get("interfaces", ())
            if z[0] < depth < z[-1] and np.count_nonzero(np.isclose(z, depth, rtol=1e-9)) < 2
        ]
        if missed:
            places = ", ".join(f"{depth:.4g}" for depth in missed)
            warnings.warn(
                f"the interfaces at z = {places} m are not among the depths: the largest value may "
                "lie there; leave z out, or add scene.interfaces()",
                SceneWarning,
                stacklevel=3,
            )

    def _along(self) -> str:
        dims = self.dataset[COMPONENTS[0]].dims
        if len(dims) != 2:
            raise ValueError(
                "this is known on a section: give stress(z, x=...) or stress(z, y=...)"
            )
        return str(dims[1])

    def __repr__(self) -> str:
        """Show the dataset."""
        return f"Stress({self.dataset!r})"


_PROBES = _core.probe_labels()
#: Name, unit and meaning of every measure of stress.
LABELS = {name: label for name, label in _PROBES.items() if label[0] == "Pa"}
#: Name, unit and meaning of the displacements.
DISPLACEMENTS = {name: _PROBES[name] for name in ("u_x", "u_y", "u_z")}
