"""A criterion evaluated on a section below a contact, or on several."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from typing import TYPE_CHECKING

import numpy as np

from pyfret._core import degrees, range_of_life
from pyfret._util.arrays import items
from pyfret._util.figures import Figured
from pyfret._util.labelled import Labelled
from pyfret._util.numbers import layer_index, layer_name, length, place
from pyfret._util.text import html
from pyfret._util.window import wrap
from pyfret.fatigue import stored
from pyfret.fatigue.averages import Averaging
from pyfret.fatigue.cycles import HistoryKind
from pyfret.fatigue.distance import OverDistance, default_distances, distance_of_material
from pyfret.fatigue.fields import margin_name
from pyfret.fatigue.ranges import LifeRange, Range
from pyfret.quantities import Length, Lengths, as_number, quantities
from pyfret.saveable import Saveable
from pyfret.scene.tables import table
from pyfret.subsurface.extremum import Errors, Extremum, Place, format_value

if TYPE_CHECKING:
    from collections.abc import Callable

    import xarray as xr
    from numpy.typing import NDArray

    from pyfret._core import Criterion, CriterionBelow, Material


__all__ = ["Life"]

#: Why a life that was pickled or saved has no stress.
NO_STRESS = "a life that was saved or unpickled has no stress: judge the result again"
#: Note on a worst point at the rim.
RIM_NOTE = (
    "the worst point is at the rim of the contact: a point value depends on the grid, use a "
    "critical distance (fatigue.average)"
)


class Life(Saveable, Labelled, Figured):
    """A criterion on a section below the contact, or on several.

    :attr:`dataset` has ``value``, ``missed`` (no plane has more than value + missed), the shear and
    normal stresses that make the value, ``normal`` of the critical plane, and ``safety_factor``
    (limit over value) or ``life`` [cycles], over (depth, x) or (depth, y), for several sections
    over (depth, x, y) or (depth, y, x); NaN in layers without a material.

    A file of it has fields, worst points and ranges, not the stress: other distances and scatters
    need the run.
    """

    def __init__(
        self,
        dataset: xr.Dataset,
        sections: Sequence[CriterionBelow],
        notes: Sequence[str],
        materials: Sequence[Material | None],
        history: Callable[[Extremum, HistoryKind], NDArray[np.float64]] | None = None,
    ) -> None:
        super().__init__(dataset)
        self._history = history
        self._materials = list(materials)
        self._ranges: dict[int, LifeRange] = {}
        self._sections = list(sections)
        self._assessments = self._sections[0].assessments if sections else []
        self._notes = list(notes)
        self._worst: dict[int, Extremum] = {}
        # Margins for sorting, with lives beyond the tests from the curve.
        self._order: dict[int, float] = {}
        # Sections of a pickled life, which cannot be searched.
        self._parts: list[Life] = []

    figure = "criterion_map"

    @classmethod
    def from_dataset(cls, dataset: xr.Dataset) -> Life:
        """Rebuild a saved life, without the stress."""
        state = stored.life_from_dataset(dataset.load())
        attrs = {name: attribute for name, attribute in dataset.attrs.items() if name != stored.KEY}
        # A file may have no lists of one length.
        attrs["interfaces"] = np.atleast_1d(attrs.get("interfaces", [])).tolist()
        kept = dataset.copy()
        kept.attrs = attrs
        life = cls(kept, [], [], [])
        life.__dict__.update(state)
        return life

    def _as_saved(self) -> xr.Dataset:
        """Fields, worst points and ranges, without the stress.

        Other distances and scatters need the run.
        """
        about = {stored.KEY: stored.life_to_json(self.__getstate__()), "kind": "Life"}
        return super()._as_saved().assign_attrs(about)

    def summary(self) -> str:
        """Say what was judged and how it ends: the range, where, over which distance, notes."""
        return wrap(repr(self))

    @property
    def L(self) -> float | None:
        """Critical distance that the range is averaged over [m]; None for a value at a point."""
        return self.range.L

    @property
    def margin(self) -> xr.DataArray:
        """``safety_factor`` or ``life``, whichever the criterion gives."""
        return self.dataset[margin_name(self._assessments)[0]]

    def extrapolated(self) -> NDArray[np.float64]:
        """Return the margin of every point for contours, lives beyond the tests by the curve."""
        margin, value = self.margin.values.copy(), self.dataset.value.values
        for n, row in enumerate(self.dataset.layer.values):
            assessment = self._assessments[int(row)]
            if assessment is not None and assessment.limit is None:
                beyond = np.isinf(margin[n])
                margin[n][beyond] = [
                    assessment.life(float(point_value)) for point_value in value[n][beyond]
                ]
        return np.asarray(margin)

    @property
    def layers(self) -> list[int]:
        """The layers that are judged, from the surface down."""
        present = np.unique(self.dataset.layer.values).tolist()
        return [n for n in present if self._assessments[n] is not None]

    @property
    def notes(self) -> list[str]:
        """Notes on the numbers: other elastic constants, a cycle that does not close."""
        at_rim = [RIM_NOTE] if self.worst.border == "rim" and self.range.distance is None else []
        return [*self._notes, *self.range.notes, *at_rim]

    @quantities
    def section(self, place: Length) -> Life:
        """Return the section nearest to a place on the axis across [m]."""
        if self.dataset.value.ndim == 2:
            return self
        across = str(self.dataset.value.dims[2])
        n = int(np.abs(self.dataset[across].values - as_number(place)).argmin())
        if self._parts:
            return self._parts[n]
        return Life(
            self.dataset.isel({across: n}),
            [self._sections[n]],
            self._notes,
            self._materials,
            self._history,
        )

    @quantities
    def _material_of(self, layer: int) -> Material | None:
        """Return the material of a layer; None where it has none."""
        return self._materials[layer]

    def _layer(self, layer: int | str) -> int:
        """Return the number of a layer by its name."""
        if not isinstance(layer, str):
            return layer
        coatings = len(self.dataset.attrs.get("interfaces", ()))
        return layer_index(layer, coatings, range(coatings + 1), self._materials)

    def worst_of(self, layer: int | str) -> Extremum:
        """Return the worst point of a layer; a ValueError if it is not judged."""
        layer = self._layer(layer)
        if layer not in self._worst:
            value_of_layer = self.dataset.value.isel(depth=self.dataset.layer.values == layer)
            if not np.isfinite(value_of_layer.values).any():
                raise ValueError(f"layer {layer} is not judged: it has no material or no depth")
            material = self._materials[layer]
            # A section whose samples are lower may have the worst point between them.
            worst = max(
                filter(None, (section.worst(layer, material) for section in self._sections)),
                key=lambda worst: worst["score"],
                default=None,
            )
            if worst is None:
                raise ValueError("the section holds no number")
            self._order[layer] = worst["order"]
            errors = Errors(*worst["errors"])
            self._worst[layer] = Extremum(
                worst["score"],
                errors.sum,
                Place(worst["x"], worst["y"], worst["z"]),
                worst["layer"],
                units=str(self.dataset.value.attrs.get("units", "1")),
                border=worst["at"],
                errors=errors,
                margin=worst["margin"],
                margin_units=str(self.margin.attrs.get("units", "1")),
                range=(worst["range"][0], worst["range"][1]),
                whole=(worst["whole"][0], worst["whole"][1]),
                normal=tuple(worst["normal"]) if "normal" in worst else None,
                inclination=worst.get("inclination"),
                coatings=len(self.dataset.attrs.get("interfaces", ())),
            )
        return self._worst[layer]

    def history(self, of: HistoryKind = "stress") -> NDArray[np.float64]:
        """Give the stress [Pa] or the plastic strain at the worst point over the cycle: (time, 6).

        In the order xx, yy, zz, xy, xz, yz; :func:`pyfret.plot.critical_plane_rose` draws both.
        """
        if self._history is None:
            raise ValueError(NO_STRESS)
        return self._history(self.worst, of)

    @property
    def criterion(self) -> Criterion:
        """The criterion, with the numbers of the material of the worst point."""
        assessment = self._assessments[self.worst.layer]
        assert assessment is not None
        return assessment.criterion

    @quantities
    def margin_of(self, layer: int | str) -> LifeRange:
        """Give the margin of a layer from the error of its stress alone: for contacts side by side.

        It is :meth:`range_of` for the mean stress over the critical distance of its material, at
        the worst point where it has none. The scatter of the material and of its distance is no
        part of it, since they are the same for two contacts of one material.
        """
        layer = self._layer(layer)
        if not 0 <= layer < len(self._materials):
            raise ValueError(f"layer = {layer}: must be one of {self.layers}")
        return self.range_of(layer, scatter=1.0, L=distance_of_material(self._materials[layer]))

    @quantities
    def least_margin(self, layers: Sequence[int] | None = None) -> LifeRange:
        """Return the smallest margin of some layers (default: all that are judged)."""
        chosen = self.layers if layers is None else items(layers, "layers")
        if not chosen:
            raise ValueError("layers = []: must name a layer")
        margins = [self.margin_of(layer) for layer in chosen]
        least = min(margins, key=lambda margin: (margin.best, margin.low))
        return least._replace(
            low=min(margin.low for margin in margins), high=min(margin.high for margin in margins)
        )

    @property
    def range(self) -> LifeRange:
        """Low, best and high of the margin of the worst layer: :meth:`range_of`."""
        return self.range_of(self.worst.layer)

    @property
    def low(self) -> float:
        """The lowest margin of :attr:`range`."""
        return self.range.low

    @property
    def best(self) -> float:
        """The best estimate of :attr:`range`."""
        return self.range.best

    @property
    def high(self) -> float:
        """The highest margin of :attr:`range`."""
        return self.range.high

    @quantities
    def range_of(
        self,
        layer: int | str,
        *,
        scatter: float | None = None,
        L: Length | None = None,
        method: Averaging = "line",
    ) -> LifeRange:
        """Give low, best and high of a life or of a safety factor, the range of 10 to 90 %.

        Three parts make the range; their logarithms are independent and add as squares. *Stress*:
        the error of the value of the criterion. *Material*: its scatter. *Distance*: the stress is
        averaged along a line from the surface to 2 L, and L is known to a factor. A material
        without a critical distance keeps the value at the worst point, which is on the safe side.
        So does a layer that is thinner than 2 L.

        Parameters
        ----------
        layer : int or str
            "TiN", "coating 1", "substrate", or the number of the layer from the surface down, from
            0: coating 1 is 0.
        scatter : float, optional
            Ratio of the 90th to the 10th percentile of life (default: 3, or 5
            where numbers of the material are estimates); for a safety factor the ratio of strengths
            (default: 1.2, or 1.5).
        L : float, optional
            Critical distance [m] (default: the material's own).
        method : "point", "line", "area" or "volume"
            How the stress is averaged over it, as in :func:`pyfret.fatigue.average`.
        """
        layer = self._layer(layer)
        default = scatter is None and L is None and method == "line"
        if default and layer in self._ranges:
            return self._ranges[layer]
        if not self._sections:
            raise ValueError(NO_STRESS)
        worst = self.worst_of(layer)
        low_to_high, stress, scatter_factor, distance, length, notes = range_of_life(
            self._sections,
            layer,
            self._materials[layer],
            (worst.value, worst.error),
            method=method,
            scatter=scatter,
            L=as_number(L),
        )
        life_range = LifeRange(
            *low_to_high,
            stress=Range(*stress),
            material=scatter_factor,
            distance=None if distance is None else Range(*distance),
            L=length,
            notes=tuple(notes),
        )
        if default:
            self._ranges[layer] = life_range
        return life_range

    @quantities
    def over_distance(
        self,
        L: Lengths | None = None,
        *,
        method: Averaging = "line",
        layer: int | str | None = None,
    ) -> OverDistance:
        """Evaluate the margin over several distances L.

        Parameters
        ----------
        L : array, optional
            Critical distances [m] (default: nine from a quarter of the material's distance to four
            times it; without one from a hundredth to a quarter of the depth of the section;
            distances that reach beyond the layer are left out).
        method : "point", "line", "area" or "volume"
            As in :func:`pyfret.fatigue.average`.
        layer : int or str, optional
            The layer, as in :meth:`range_of` (default: the layer of the worst point).

        Returns
        -------
        OverDistance
            Low, best and high margin over L: every row is :meth:`range_of` its L.
            :func:`pyfret.plot.life_over_distance` draws them.

        Raises
        ------
        ValueError
            The life was unpickled, or a distance reaches beyond the layer.
        """
        if not self._sections:
            raise ValueError(NO_STRESS)
        chosen_layer = self.worst.layer if layer is None else self._layer(layer)
        material = self._materials[chosen_layer]
        borders = [0.0, *self.dataset.attrs["interfaces"], np.inf]
        lengths = (
            default_distances(
                material,
                float(self.dataset.z.max()),
                borders[chosen_layer + 1] - borders[chosen_layer],
            )
            if L is None
            else np.atleast_1d(np.asarray(L, float))
        )
        rows = [self.range_of(chosen_layer, L=L_n, method=method) for L_n in lengths.tolist()]
        for L_n, row in zip(lengths.tolist(), rows, strict=True):
            if row.L is None:
                raise ValueError(f"L = {length(L_n)}: {row.notes[0]}".replace("µ", "u"))
        name, meaning = margin_name(self._assessments)
        return OverDistance.from_ranges(
            lengths, rows, name, meaning, method, distance_of_material(material)
        )

    @property
    def worst(self) -> Extremum:
        """The point of the smallest margin; of equal ones, the point of the larger value."""
        judged = [self.worst_of(layer) for layer in self.layers]
        order = {layer: np.nan_to_num(self._order[layer], nan=-np.inf) for layer in self.layers}
        return min(judged, key=lambda w: (order[w.layer], -w.value))

    def __eq__(self, other: object) -> bool:
        """Whether dataset and assessments are the same."""
        if not isinstance(other, Life):
            return NotImplemented
        return super().__eq__(other) is True and other._assessments == self._assessments

    def __getstate__(self) -> dict[str, object]:
        """Return the state to pickle: the worst points, without the sections."""
        for layer in self.layers:
            # A layer without a number is refused when it is asked for.
            with suppress(ValueError):
                self.range_of(layer)
        parts = self._parts
        if self.dataset.value.ndim > 2 and not parts:
            across = str(self.dataset.value.dims[2])
            parts = [self.section(position) for position in self.dataset[across].values.tolist()]
        return {**self.__dict__, "_sections": [], "_parts": parts, "_history": None}

    def _repr_html_(self) -> str:
        """Return a table of the worst point of every layer, for notebooks."""
        name, _ = margin_name(self._assessments)
        rows, coatings = [], len(self.dataset.attrs["interfaces"])
        for layer in self.layers:
            w = self.worst_of(layer)
            coordinates = (f"{1e6 * at:.4g}" for at in (w.x, w.y, w.z))
            value = format_value(w.value, w.error, w.units)
            point = w.format_margin()
            rows.append(
                [
                    layer_name(layer, coatings),
                    repr(self.range_of(layer)),
                    point,
                    value,
                    *coordinates,
                ]
            )
        title = name.replace("_", " ")
        heading = [
            "layer",
            f"{title}, 10 to 90 %",
            f"{title} at the point, 10 to 90 %",
            "value",
            "x [µm]",
            "y [µm]",
            "z [µm]",
        ]
        criterion = html(str(self.dataset.attrs["criterion"]))
        return f"<p><b>{criterion}</b></p>{table(heading, rows)}"

    def __repr__(self) -> str:
        """Give criterion, range and worst point."""
        w = self.worst
        name = margin_name(self._assessments)[0].replace("_", " ")
        plane = ""
        if w.inclination is not None and np.isfinite(w.inclination):
            plane = f", plane {degrees(w.inclination)} from the surface normal"
        coatings, L = len(self.dataset.attrs["interfaces"]), self.range.L
        over = "value at a point" if L is None else f"mean over L = {length(L)}".replace("µ", "u")
        return (
            f"Life({self.dataset.attrs['criterion']}, {name} {self.range!r}, {over}, at "
            f"{place(w, coatings)}{plane})" + "".join(f"\n  {note}" for note in self.notes)
        )
