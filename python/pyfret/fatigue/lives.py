"""Will it crack? A fatigue criterion over a closed cycle of a run, below the contact.

The core computes the stress a few depths at a time, judges it and lets it go. ::

    steel = fatigue.Materials()["steel_42CrMo4"]
    life = result.life(steel, "dang_van")
    life.worst  # place and margin of the worst point
    fret.plot.criterion_map(life)
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from pyfret._core import Material, with_error, with_range
from pyfret._util.labelled import Labelled
from pyfret._util.lazy import xr
from pyfret._util.numbers import place
from pyfret._util.text import html
from pyfret.fatigue.cycle_section import (
    body_of,
    depths_of,
    labelled,
    over_cycle,
    side_by_side,
)
from pyfret.fatigue.ranges import Range
from pyfret.fatigue.section import Section, for_each_layer
from pyfret.scene.tables import table

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray
    from typing_extensions import Unpack

    from pyfret._core import Assessment, CriterionBelow
    from pyfret.fatigue.criteria import CriterionName
    from pyfret.fatigue.section import SectionOptions
    from pyfret.run import Run

__all__ = ["Errors", "Life", "Materials", "Worst", "life", "lives"]

#: Part of the largest traction by which the ends of a cycle may differ before that is told.
UNSETTLED = 0.02
#: What is told of a worst point there.
RIM = (
    "the worst point is at the rim of the contact: a point value depends on the grid, use a "
    "critical distance (fatigue.average)"
)

#: The material of the substrate, or one for each layer from the surface down, the substrate's last;
#: layers of ``None`` are not judged.
Materials = Material | Sequence[Material | None]


class Errors(NamedTuple):
    """What may be wrong with the value at a worst point, by its sources, in its unit."""

    #: What the search along x and y leaves.
    x: float
    y: float
    #: What the search over the depths leaves.
    z: float
    #: By how much the tractions on cells twice as large give another value.
    tractions: float | None

    @property
    def sum(self) -> float:
        """All together."""
        return self.x + self.y + self.z + (self.tractions or 0.0)


class Worst(NamedTuple):
    """The worst point of a section, between the samples, rims of the contact included."""

    #: Value of the criterion, in its unit: that of the stress at the point.
    value: float
    #: Safety factor, or life in cycles for criteria with a strain-life curve.
    margin: float
    #: Place [m].
    x: float
    y: float
    #: Depth [m].
    z: float
    #: Layer from the surface down; their number for the substrate.
    layer: int
    #: What may be wrong with the value, by its sources.
    errors: Errors
    #: The border that it lies on: of the "contact" or of the zone of "stick".
    at: str | None
    #: Normal of the critical plane, where the criterion has one.
    normal: tuple[float, float, float] | None
    #: Angle of the critical plane to the surface normal in the section [degrees], positive where it
    #: leans towards larger x or y with depth.
    inclination: float | None
    #: The margins of value + error and of value - error: the least and the largest.
    range: tuple[float, float]

    @property
    def error(self) -> float:
        """What may be wrong with the value, all together."""
        return self.errors.sum

    def __repr__(self) -> str:
        """Give margin, value, error and place in a few digits."""
        margin, value = with_range(self.margin, *self.range), with_error(self.value, self.error)
        at = f", at={self.at!r}" if self.at else ""
        angle = "" if self.inclination is None else f", inclination={self.inclination:.1f} degrees"
        return f"Worst(margin={margin}, value={value}, {place(self)}{at}{angle})"


class Life(Labelled):
    """A criterion on a section below the contact, or on several.

    :attr:`dataset` has ``value``, ``missed`` (no plane has more than value + missed), the shear and
    normal stresses that make the value, ``normal`` of the critical plane, and ``safety_factor``
    (limit over value) or ``life`` [cycles], over (depth, x) or (depth, y), for several sections
    over (depth, x, y) or (depth, y, x); NaN in layers without a material.
    """

    def __init__(
        self,
        dataset: xr.Dataset,
        sections: Sequence[CriterionBelow],
        notes: Sequence[str],
    ) -> None:
        super().__init__(dataset)
        self._sections = list(sections)
        self._assessments = self._sections[0].assessments
        self._notes = list(notes)
        self._worst: dict[int, Worst] = {}
        # Those of a pickled life, which has no sections to look in.
        self._parts: list[Life] = []

    @property
    def margin(self) -> xr.DataArray:
        """``safety_factor`` or ``life``, whichever the criterion gives."""
        return self.dataset[margin_name(self._assessments)[0]]

    @property
    def layers(self) -> list[int]:
        """The layers that are judged, from the surface down."""
        found = np.unique(self.dataset.layer.values).tolist()
        return [n for n in found if self._assessments[n] is not None]

    @property
    def notes(self) -> list[str]:
        """What to know of the numbers: other elastic constants, a cycle that is not settled."""
        at_rim = [RIM] if self.worst.at == "contact" else []
        return [*self._notes, *at_rim]

    def section(self, place: float) -> Life:
        """Give the one of several sections that is nearest to a place on the axis across [m]."""
        if self.dataset.value.ndim == 2:
            return self
        across = str(self.dataset.value.dims[2])
        n = int(np.abs(self.dataset[across].values - place).argmin())
        if self._parts:
            return self._parts[n]
        return Life(self.dataset.isel({across: n}), [self._sections[n]], self._notes)

    def worst_of(self, layer: int) -> Worst:
        """Give the worst point of a layer; a ValueError where it is not judged."""
        if layer not in self._worst:
            here = self.dataset.value.isel(depth=self.dataset.layer.values == layer)
            if not np.isfinite(here.values).any():
                raise ValueError(f"layer {layer} is not judged: it has no material or no depth")
            # A section whose samples are lower may have the worst point between them.
            found = max(
                filter(None, (section.worst(layer) for section in self._sections)),
                key=lambda worst: worst["score"],
                default=None,
            )
            if found is None:
                raise ValueError("the section holds no number")
            self._worst[layer] = Worst(
                found["score"],
                found["margin"],
                found["x"],
                found["y"],
                found["z"],
                found["layer"],
                Errors(*found["errors"]),
                found["at"],
                tuple(found["normal"]) if "normal" in found else None,
                found.get("inclination"),
                (found["range"][0], found["range"][1]),
            )
        return self._worst[layer]

    def margin_of(self, layer: int) -> Range:
        """Give the margin at the worst point of a layer, from the error of its stress alone.

        The scatter of the material is no part of it: it is the same for two contacts of one
        material that are compared.
        """
        worst = self.worst_of(layer)
        return Range(worst.range[0], worst.margin, worst.range[1])

    @property
    def worst(self) -> Worst:
        """The point of the smallest margin; of equal ones, that of the larger value."""
        judged = [self.worst_of(layer) for layer in self.layers]
        return min(judged, key=lambda w: (np.nan_to_num(w.margin, nan=-np.inf), -w.value))

    def __eq__(self, other: object) -> bool:
        """Whether dataset and assessments are the same."""
        if not isinstance(other, Life):
            return NotImplemented
        return super().__eq__(other) is True and other._assessments == self._assessments

    def __getstate__(self) -> dict[str, object]:
        """What is pickled: the worst points in place of what finds them."""
        for layer in self.layers:
            # A layer without a number is refused when it is asked for.
            with suppress(ValueError):
                self.worst_of(layer)
        parts = self._parts
        if self.dataset.value.ndim > 2 and not parts:
            across = str(self.dataset.value.dims[2])
            parts = [self.section(place) for place in self.dataset[across].values.tolist()]
        return {**self.__dict__, "_sections": [], "_parts": parts}

    def _repr_html_(self) -> str:
        """The worst point of every layer, for notebooks."""
        name, _ = margin_name(self._assessments)
        unit = str(self.dataset.value.attrs.get("units", ""))
        rows = []
        for layer in self.layers:
            w = self.worst_of(layer)
            place = (f"{1e6 * at:.4g}" for at in (w.x, w.y, w.z))
            scale, unit_shown = (1e-6, "MPa") if unit == "Pa" else (1.0, unit)
            value = f"{with_error(scale * w.value, scale * w.error)} {unit_shown}"
            rows.append([str(layer), with_range(w.margin, *w.range), value, *place])
        heading = ["layer", name.replace("_", " "), "value", "x [µm]", "y [µm]", "z [µm]"]
        criterion = html(str(self.dataset.attrs["criterion"]))
        return f"<p><b>{criterion}</b></p>{table(heading, rows)}"

    def __repr__(self) -> str:
        """Say what was judged and how it ends."""
        w = self.worst
        name = margin_name(self._assessments)[0].replace("_", " ")
        plane = ""
        if w.inclination is not None and np.isfinite(w.inclination):
            plane = f", plane {w.inclination:.1f} degrees from the surface normal"
        return (
            f"Life({self.dataset.attrs['criterion']}, {name} {with_range(w.margin, *w.range)} at "
            f"{place(w)}{plane})" + "".join(f"\n  {note}" for note in self.notes)
        )


def margin_name(assessments: Sequence[Assessment | None]) -> tuple[str, str]:
    """Name and meaning of the margin: a life as soon as one layer has a strain-life curve."""
    lives = any(a is not None and a.limit is None for a in assessments)
    if lives:
        return "life", "cycles until a crack has started"
    return "safety_factor", "limit over value"


#: What is found at every point: unit and meaning; that of the value is the criterion's.
FOUND = {
    "value": ("", "value of the criterion"),
    "planes": ("1", "planes looked at"),
    "missed": ("", "most that another plane may have more"),
    "shear_amplitude": ("Pa", "shear amplitude, radius of the smallest circle"),
    "shear_chord": ("Pa", "half of the longest chord of the shear path"),
    "normal_max": ("Pa", "largest normal stress on the critical plane"),
    "normal_min": ("Pa", "smallest normal stress on the critical plane"),
    "normal": ("1", "normal of the critical plane"),
}


def described(
    found: dict[str, NDArray[np.float64]], assessments: Sequence[Assessment | None]
) -> dict[str, tuple[NDArray[np.float64], dict[str, str]]]:
    """What the core found at points, with names and units."""
    unit = next(a.criterion.unit for a in assessments if a is not None)
    shown = {
        name: (found[name], {"units": of or unit, "long_name": meaning})
        for name, (of, meaning) in FOUND.items()
    }
    most, least = found["normal_max"], found["normal_min"]
    mean = {"units": "Pa", "long_name": "mean normal stress on the critical plane"}
    shown["normal_mean"] = ((most + least) / 2, mean)
    amplitude = {"units": "Pa", "long_name": "amplitude of the normal stress there"}
    shown["normal_amplitude"] = ((most - least) / 2, amplitude)
    name, meaning = margin_name(assessments)
    shown[name] = (found["margin"], {"units": "1", "long_name": meaning})
    return shown


def life(
    result: Run,
    materials: Materials,
    criterion: CriterionName,
    z: ArrayLike | None = None,
    *,
    tolerance: float = 1e-3,
    **section: Unpack[SectionOptions],
) -> Life:
    """Judge a section below the contact, or several, over a closed cycle of the load path.

    The strains of a criterion follow from the stress by the scene's E and nu.

    Parameters
    ----------
    result : Result
        Solved with ``save="all"``, or with the increments of the cycle. The bulk stress of the body
        is part of the stress as the path has it, in or out of phase with the other loads.
    materials : Material or sequence of Material or None
        That of the substrate, or one for each layer from the surface down, the substrate's last;
        layers of ``None``, and coatings where one material is given, are not judged.
    criterion : str
        One of :data:`pyfret.fatigue.CRITERIA`.
    z : array, optional
        Depths [m] (default: those that the layers ask for, both sides of every interface).
    tolerance : float
        Largest part of the value that another plane may be proved to have more.
    **section
        ``x`` or ``y`` (several for a volume), ``body_number``, ``cycle``, ``residual``: the fields
        of :class:`pyfret.fatigue.Section`.

    Raises
    ------
    ValueError
        There is no closed cycle, too few of its increments were kept, a material lacks a number
        that the criterion needs, or no depth lies in a layer that has one.
    """
    return lives(result, materials, [criterion], z, tolerance=tolerance, **section)[criterion]


def lives(
    result: Run,
    materials: Materials,
    criteria: Sequence[CriterionName],
    z: ArrayLike | None = None,
    *,
    tolerance: float = 1e-3,
    **section: Unpack[SectionOptions],
) -> dict[CriterionName, Life]:
    """Judge a section as :func:`life` does by several criteria, all by the same stress.

    Parameters
    ----------
    criteria : sequence of str
        Of :data:`pyfret.fatigue.CRITERIA`, each once.
    result, materials, z, tolerance, **section
        As in :func:`life`.

    Returns
    -------
    dict of str to Life
        By criterion, in the order given.

    Raises
    ------
    ValueError
        As in :func:`life`, or no criterion is given.
    """
    names = list(dict.fromkeys(criteria))
    if not names:
        raise ValueError("criteria = []: must be one or more of fatigue.CRITERIA")
    where = Section(**section)
    layers = len(body_of(result, where).coatings) + 1
    each = for_each_layer(materials, layers, "material", "materials")
    depths = depths_of(result, where, z, each, "material")
    found: dict[CriterionName, list[CriterionBelow]] = {name: [] for name in names}
    shown: dict[CriterionName, list[xr.Dataset]] = {name: [] for name in names}
    notes: list[str] = []
    for one in where.each():
        below = over_cycle(result, one)
        judged = below.by_criteria(*depths, each, names, tolerance=tolerance)
        for name, by in zip(names, judged, strict=True):
            found[name].append(by)
            fields = described(by.fields(), by.assessments)
            shown[name].append(labelled(result, one, depths, fields))
        if not notes and where.cycle is not None:
            much = below.unsettled()
            if much is not None and much > UNSETTLED:
                notes.append(
                    f"the cycle is not settled: its tractions end {100 * much:.0f} % of the "
                    "largest one off from where they began; go through it more often"
                )

    def of(name: CriterionName) -> Life:
        whole = side_by_side(result, where, shown[name]).assign_attrs(criterion=name)
        return Life(whole, found[name], [*found[name][0].notes, *notes])

    return {name: of(name) for name in names}
