"""The stress at places below the surface, and what follows from it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any
from zlib import crc32

import numpy as np

from pyfret import _core
from pyfret._util.attributes import attribute_error
from pyfret._util.figures import Figured
from pyfret._util.labelled import Labelled
from pyfret._util.lazy import xr
from pyfret._util.numbers import layer_index, layer_name, length
from pyfret._util.scene_warnings import warn
from pyfret._util.window import wrap
from pyfret.quantities import quantities
from pyfret.scene.tables import table
from pyfret.subsurface.extremum import Errors, Extremum, Place
from pyfret.subsurface.line import line_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from pyfret._util.csv_table import Tables

__all__ = ["COMPONENTS", "DISPLACEMENTS", "LABELS", "Stress"]

#: The six components, in their order.
COMPONENTS = ("s_xx", "s_yy", "s_zz", "s_xy", "s_xz", "s_yz")

#: Names of sections that other programs have, and how they are reached.
ELSEWHERE = {
    name: "result.at(-1).stress(x=0.0, y=0.0) is the stress on the line below a point"
    for name in ("line", "profile", "depth_profile", "along_z")
}
ELSEWHERE |= dict.fromkeys(
    ("first_yield", "load_factors", "yields", "shakedown", "safety_factor"),
    'result.load_factors("Ti-6Al-4V") has the factors of first yield over the cycle',
)
ELSEWHERE["save"] = "it is written by stress.to_csv(path); result.save(path) writes the run"

#: Numbers that follow from the components at a point, in the order of the columns of a table.
EQUIVALENT = ("von_mises", "tresca", "s_1", "s_2", "s_3", "hydrostatic")


class Stress(Labelled, Figured):
    """The six stresses somewhere below the surface, and what follows from them.

    ``stress.s_xx``, ``stress.von_mises``, ``stress.tresca``, ``stress.s_1`` (principal values, the
    largest first), ``stress.hydrostatic``, ``stress.interface_shear`` and
    ``stress.interface_peel`` are DataArrays; :attr:`dataset` holds the six components.
    """

    figure = "stress_map"

    @quantities
    def __init__(
        self,
        dataset: xr.Dataset,
        below: _core.Subsurface | None = None,
        materials: Sequence[_core.Elastic] = (),
        known: dict[tuple[object, ...], Any] | None = None,
    ) -> None:
        super().__init__(dataset)
        self._below = below
        #: Answers of :meth:`maximum` by measure, layer and samples, which copies share.
        self._known: dict[tuple[object, ...], Any] = {} if known is None else known
        #: Materials of the layers from the surface down, the substrate's last.
        self._materials = list(materials)

    def __reduce__(self) -> tuple[type[Stress], tuple[xr.Dataset]]:
        """Pickle the samples, without the tractions above them."""
        return Stress, (self.dataset,)

    def assign_attrs(self, attrs: dict[str, object]) -> Stress:
        """Give the same stress with more attributes of its dataset."""
        dataset = self.dataset.assign_attrs(attrs)
        return Stress(dataset, self._below, self._materials, self._known)

    def __copy__(self) -> Stress:
        """Copy the samples; the copy shares the search for largest values."""
        dataset = self.dataset.copy(deep=True)
        return Stress(dataset, self._below, self._materials, self._known)

    def _tensor(self) -> NDArray[np.float64]:
        """The components as an array of shape (6, number of points)."""
        return np.stack([self.dataset[c].values.ravel() for c in COMPONENTS])

    @quantities
    def measure(self, name: str) -> xr.DataArray:
        """Return a measure of the stress by its name, such as ``"von_mises"``."""
        if name in COMPONENTS:
            return self.dataset[name]
        units, meaning = LABELS[name]
        pattern = self.dataset[COMPONENTS[0]]
        values = _core.measure(name, self._tensor()).reshape(pattern.shape)
        attrs = {"units": units, "long_name": meaning}
        return pattern.copy(data=values).rename(name).assign_attrs(attrs)

    def __getattr__(self, name: str) -> xr.DataArray:
        """Give the measure `name`, or an attribute of the dataset."""
        if name.startswith("_"):
            raise AttributeError(name)
        if name in LABELS:
            return self.measure(name)
        if name in self.dataset.attrs:
            return self.dataset.attrs[name]  # type: ignore[no-any-return]
        public = (member for member in dir(type(self)) if not member.startswith("_"))
        names = [*LABELS, *map(str, self.dataset.attrs), *public, "dataset"]
        raise attribute_error("stress", name, names, ELSEWHERE)

    def _tables(self) -> Tables:
        """Return what makes the table: components, equivalent stresses and principal values."""
        return {
            "values": lambda: (
                self.dataset.assign({name: self.measure(name) for name in EQUIVALENT}),
                None,
            )
        }

    def summary(self) -> str:
        """Return the largest samples of the equivalent and principal stresses, and their places."""
        lines = [
            f"{self.dataset[COMPONENTS[0]].size} points; largest samples (maximum() searches "
            "between them and gives the error)"
        ]
        for name in EQUIVALENT:
            values = self.measure(name)
            largest = values.isel(values.argmax(...))
            position = ", ".join(
                f"{axis} = {length(float(value))}"
                for axis, value in largest.coords.items()
                if axis in ("x", "y", "z", "s")
            )
            lines.append(f"{name:11s} {1e-6 * float(largest):10.4g} MPa at {position}")
        return wrap("\n".join(lines))

    def _draw(self, *args: Any, **options: Any) -> Any:
        """Draw the map of a section, or on a line below a point the curves over the depth."""
        figure = "stress_map" if self.dataset[COMPONENTS[0]].ndim > 1 else "stress_along_depth"
        return getattr(self.plot, figure)(*args, **options)

    def principal(self) -> xr.Dataset:
        """Return the principal values, the largest first, and unit vectors of their directions."""
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

    @quantities
    def maximum(self, of: str = "von_mises", *, layer: int | str | None = None) -> Extremum:
        """Give the largest value and its place: a value at a point.

        Of a section that was asked for, the largest value on it; of the section that
        ``stress()`` chooses, the largest value in the whole body. The search begins at the highest
        samples, at the rim of the contact and at the border of its stick zone. It goes on between
        the samples. Where the samples of a layer still rise at the ends of the section, it is made
        up to 16 times as long. A maximum at the surface or at an interface stays there.
        ``interface_shear`` and ``interface_peel`` belong to the interfaces.

        Parameters
        ----------
        of : str
            The measure.
        layer : int or str, optional
            The layer to look in (default: all). Its number from the surface down, from 0. Or its
            name: "coating", "coating 2", "substrate", or the name of its material, "TiN".

        Raises
        ------
        ValueError
            The measure is unknown, or negative everywhere and 0 far from the contact, as the least
            principal stress often is.

        Warns
        -----
        SceneWarning
            A layer between the first and the last depth holds no depth, or not its borders: the
            largest value may lie there. Depths are chosen from the layers where none are given.
            Or the stress of a layer still rises at the ends of the longest section.
        """
        if of not in LABELS:
            raise ValueError(f"{of!r}: must be one of {', '.join(sorted(LABELS))}")
        self._doubt_depths()
        self._section_axis()
        depths = self.dataset.z.values.tolist()
        layers = self.dataset.layer.values.tolist()
        coatings = len(self.dataset.attrs.get("interfaces", ()))
        if layer is not None:
            layer = layer_index(layer, coatings, set(layers), self._materials)
        if self._below is None:
            raise ValueError("maximum() needs the full section; call `stress(...)` first")
        samples = self.measure(of).values
        error_bar = self.dataset.attrs.get("stress_error")
        anywhere = bool(self.dataset.attrs.get("anywhere", 0))
        line = line_of(self.dataset)
        checksum = crc32(np.ascontiguousarray(samples).tobytes())
        places = samples.shape, tuple(depths), tuple(layers), line
        key = (of, layer, checksum, *places, error_bar, anywhere)
        if key not in self._known:
            self._known[key] = self._below.maximum(
                of,
                samples,
                depths,
                layers,
                only=layer,
                error_bar=error_bar,
                anywhere=anywhere,
                **line.named(),
            )
        extremum, rises = self._known[key]
        if rises and extremum is None:
            raise ValueError(
                f"{of} is negative below the contact and rises with the distance from it: "
                'it has no largest value; "von_mises", "tresca" and "s_1" have one'
            )
        if rises:
            layers_said = " and ".join(layer_name(layer, coatings) for layer in rises)
            warn(
                f"{of} in {layers_said} still rises 8 lengths of the grid away from it: "
                "a larger value may lie beyond; use a longer grid",
            )
        if extremum is None and of.startswith("interface"):
            raise ValueError(f"{of}: no interface lies among the depths of the section")
        if extremum is None:
            raise ValueError("the section holds no number")
        value, x, y, z, in_layer, border, error, errors = extremum
        point = Place(x, y, z)
        return Extremum(
            value, error, point, in_layer, "Pa", border, Errors(*errors), coatings=coatings
        )

    def on_surface(self) -> Stress:
        """Give the stress at the first depth alone."""
        top = self.dataset.isel(depth=slice(1)).assign_attrs(interfaces=[])
        return Stress(top, self._below)

    def rims(self) -> Stress:
        """Give the surface stress where the section crosses the rim of the contact.

        It has a cusp there, such as the tension at the trailing edge. The stress belongs to
        tractions which vary within the cells and vanish at the rim.
        """
        return self._on_borders("rim")

    def stick_borders(self) -> Stress:
        """Give the surface stress where the section crosses the border of the stick zone."""
        return self._on_borders("stick border")

    def _on_borders(self, zone: str) -> Stress:
        """Return the surface stress on the borders of a zone, over a dimension named after it.

        "stick border" has the dimension ``stick``, "rim" the dimension ``rim``.
        """
        along = self._section_axis()
        surface = self.dataset.isel(depth=0)
        if float(surface.z) != 0.0:
            raise ValueError("the section has no surface: give stress(z=[0, ...], ...)")
        if self._below is None or not self._below.rim:
            raise ValueError(
                "tractions constant in each cell end nowhere within a cell: give rim=True"
            )
        line = line_of(self.dataset)
        borders = self._below.borders(**line.named())
        points = [(x, y) for x, y, border_zone, _ in borders if border_zone == zone]
        tensors = self._below.points([(x, y, 0.0, 0) for x, y in points])
        variables = {
            name: (zone.split()[0], values, surface[name].attrs)
            for name, values in zip(COMPONENTS, tensors.T, strict=True)
        }
        coords = {k: v for k, v in surface.coords.items() if along not in v.dims}
        coordinate_axes = {"x": 0, "y": 1} if along == "s" else {along: "xy".index(along)}
        for name, axis in coordinate_axes.items():
            coords[name] = (zone.split()[0], [place[axis] for place in points], {"units": "m"})
        if along == "s":
            coords["s"] = (zone.split()[0], [line.place(*at) for at in points], {"units": "m"})
        return Stress(xr.Dataset(variables, coords))

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
            warn(
                f"the interfaces at z = {places} m are not among the depths: the largest value may "
                "lie there; leave z out, or add scene.interfaces()",
            )

    def _section_axis(self) -> str:
        """Return the name of the dimension along the section."""
        dims = self.dataset[COMPONENTS[0]].dims
        if len(dims) != 2:
            raise ValueError(
                "this is known on a section: give stress(z, x=...) or stress(z, y=...)"
            )
        return str(dims[1])

    def _repr_html_(self) -> str:
        """Return the largest samples in every layer, for notebooks."""
        layers = self.dataset.layer.values
        rows = []
        for name in ("von_mises", "tresca", "s_1", "hydrostatic"):
            field = self.measure(name)
            for layer in np.unique(layers).tolist():
                in_layer = field.isel(depth=layers == layer) if "depth" in field.dims else field
                top = float(in_layer.max())
                z = float(in_layer.where(in_layer == top, drop=True).z.min())
                depth = f"{1e6 * z:.4g}"
                rows.append([LABELS[name][1], str(layer), f"{1e-6 * top:.4g}", depth])
        return table(["largest sample", "layer", "MPa", "z [µm]"], rows, words=True)

    def __repr__(self) -> str:
        """Give the places and the largest sample of von Mises' stress."""
        sizes = ", ".join(f"{n} {name}" for name, n in self.dataset[COMPONENTS[0]].sizes.items())
        largest = float(self.measure("von_mises").max())
        return f"Stress({sizes or 'one place'}; largest von Mises {largest:.4g} Pa)"


_PROBES = _core.probe_labels()
#: Name, unit and meaning of every measure of stress.
LABELS = {name: label for name, label in _PROBES.items() if label[0] == "Pa"}
#: Name, unit and meaning of the displacements.
DISPLACEMENTS = {name: _PROBES[name] for name in ("u_x", "u_y", "u_z")}
