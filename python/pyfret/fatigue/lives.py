"""Will it crack? A fatigue criterion over a closed cycle of a run, below the contact.

The stress is computed a few depths at a time, judged and let go: memory is bounded by the chunk. ::

    steel = fatigue.Materials()["steel_42CrMo4"]
    life = result.life(steel, "dang_van")
    life.worst  # place and margin of the worst point
    fret.plot.criterion_map(life)
"""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from pyfret._core import Material
from pyfret._util.labelled import Labelled
from pyfret._util.lazy import xr
from pyfret.fatigue.criteria import evaluate
from pyfret.fatigue.cycle_stress import CycleStress, judge
from pyfret.fatigue.section import Section, for_each_layer
from pyfret.fatigue.worst import largest
from pyfret.scene.tables import table

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray
    from typing_extensions import Unpack

    from pyfret._core import Assessment
    from pyfret.fatigue.criteria import CriterionName
    from pyfret.fatigue.cycle_stress import Found
    from pyfret.fatigue.section import SectionOptions
    from pyfret.run import Run

__all__ = ["Life", "Materials", "Worst", "life", "ruiz"]

#: A material for all layers, or one for each from the surface down, the substrate's last; layers of
#: ``None`` are not judged.
Materials = Material | Sequence[Material | None]


class Worst(NamedTuple):
    """The worst point of a section, between the samples."""

    #: Value of the criterion, in its unit.
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
    #: What the distances of the depths leave of an error of the value, estimated.
    error: float
    #: Normal of the critical plane at the nearest sample, where the criterion has one.
    normal: tuple[float, float, float] | None


class Life(Labelled):
    """A criterion on a section below the contact, or on several.

    :attr:`dataset` has ``value``, ``missed`` (no plane has more than value + missed), the shear and
    normal stresses that make the value, ``normal`` of the critical plane, and ``safety_factor``
    (limit over value) or ``life`` [cycles], over (depth, x) or (depth, y), for several sections
    over (depth, x, y) or (depth, y, x); NaN in layers without a material.
    """

    def __init__(self, dataset: xr.Dataset, assessments: Sequence[Assessment | None]) -> None:
        super().__init__(dataset)
        self._assessments = assessments

    @property
    def margin(self) -> xr.DataArray:
        """``safety_factor`` or ``life``, whichever the criterion gives."""
        return self.dataset[margin_name(self._assessments)[0]]

    @property
    def layers(self) -> list[int]:
        """The layers that are judged, from the surface down."""
        found = np.unique(self.dataset.layer.values).tolist()
        return [n for n in found if self._assessments[n] is not None]

    def section(self, place: float) -> Life:
        """Give the one of several sections that is nearest to a place on the axis across [m]."""
        if self.dataset.value.ndim == 2:
            return self
        across = str(self.dataset.value.dims[2])
        return Life(self.dataset.sel({across: place}, method="nearest"), self._assessments)

    def worst_of(self, layer: int) -> Worst:
        """Give the worst point of a layer; a ValueError where it is not judged."""
        peak = largest(self.dataset.value, layer)
        assessment = self._assessments[layer]
        assert assessment is not None
        d = self.dataset.isel(depth=self.dataset.layer.values == layer)
        near = d.isel(depth=int(np.abs(d.z.values - peak.z).argmin()))
        axes = {axis: at for axis, at in (("x", peak.x), ("y", peak.y)) if axis in near.dims}
        x, y, z = near.normal.sel(axes, method="nearest").values.tolist()
        margin = margin_of(assessment, peak.value)
        normal = (x, y, z) if assessment.criterion.has_plane else None
        return Worst(peak.value, margin, *peak[1:], normal=normal)

    @property
    def worst(self) -> Worst:
        """The point of the smallest margin; of equal ones, that of the larger value."""
        judged = [self.worst_of(layer) for layer in self.layers]
        return min(judged, key=lambda w: (np.nan_to_num(w.margin, nan=-np.inf), -w.value))

    def __eq__(self, other: object) -> bool:
        """Whether dataset and assessments are the same."""
        same = super().__eq__(other)
        return same and isinstance(other, Life) and other._assessments == self._assessments

    def _repr_html_(self) -> str:
        """The worst point of every layer, for notebooks."""
        name, _ = margin_name(self._assessments)
        unit = str(self.dataset.value.attrs.get("units", ""))
        rows = []
        for layer in self.layers:
            w = self.worst_of(layer)
            place = (f"{1e6 * at:.4g}" for at in (w.x, w.y, w.z))
            rows.append([str(layer), f"{w.margin:.4g}", f"{w.value:.5g} {unit}", *place])
        heading = ["layer", name.replace("_", " "), "value", "x [µm]", "y [µm]", "z [µm]"]
        criterion = escape(str(self.dataset.attrs["criterion"]))
        return f"<p><b>{criterion}</b></p>{table(heading, rows)}"

    def __repr__(self) -> str:
        """Say what was judged and how it ends."""
        w = self.worst
        name = margin_name(self._assessments)[0].replace("_", " ")
        return (
            f"Life({self.dataset.attrs['criterion']}, {name} {w.margin:.4g} at "
            f"x = {w.x:.4g} m, y = {w.y:.4g} m, z = {w.z:.4g} m, layer {w.layer})"
        )


def margin_name(assessments: Sequence[Assessment | None]) -> tuple[str, str]:
    """Name and meaning of the margin: a life as soon as one layer has a strain-life curve."""
    lives = any(a is not None and a.limit is None for a in assessments)
    if lives:
        return "life", "cycles until a crack has started"
    return "safety_factor", "limit over value"


def margin_of(assessment: Assessment, value: float) -> float:
    """Safety factor, or life in cycles."""
    give = assessment.life if assessment.limit is None else assessment.safety_factor
    return give(value)


def _assessments(
    materials: Materials, criterion: CriterionName, layers: int
) -> list[Assessment | None]:
    each = for_each_layer(materials, layers, "material", "materials")
    return [None if m is None else m.assessment(criterion) for m in each]


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

    Parameters
    ----------
    result : Result
        Solved with ``save="all"``, or with the increments of the cycle. The bulk stress of the body
        is part of the stress as the path has it, in or out of phase with the other loads.
    materials : Material or sequence of Material or None
        One for all layers, or one for each from the surface down, the substrate's last; layers of
        ``None`` are not judged.
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
        There is no closed cycle, too few of its increments were kept, or a material lacks a number
        that the criterion needs.
    """
    where = Section(**section)
    scene = result.scene
    body = scene.body1 if where.body_number == 1 else scene.body2
    assessments = _assessments(materials, criterion, len(body.coatings) + 1)
    name, meaning = margin_name(assessments)

    def of_layer(stress: NDArray[np.float64], layer: int) -> Found | None:
        assessment = assessments[layer]
        if assessment is None:
            return None
        found = evaluate(stress, assessment.criterion, tolerance=tolerance)
        margins = [margin_of(assessment, v) for v in found.value.values.ravel().tolist()]
        values: Found = {str(k): (v.values, v.attrs) for k, v in found.data_vars.items()}
        attrs = {"units": "1", "long_name": meaning}
        values[name] = (np.reshape(margins, found.value.shape), attrs)
        return values

    whole = judge(result, where, z, of_layer)
    return Life(whole.assign_attrs(criterion=criterion), assessments)


def _work_until(result: Run, increment: int, y: float) -> xr.DataArray:
    """Frictional work per area along a line from the start to the end of an increment [J/m^2]."""
    if increment not in result.dataset.saved_increment.values:
        raise ValueError(
            f"increment {increment} was not kept: the work of a cycle needs the fields at both of "
            "its ends; solve with save='all' or save='branches'"
        )
    work: xr.DataArray = result.at(increment).along_x(y=y).dissipated_density
    return work.drop_vars(set(work.coords) - {"x"})


def ruiz(result: Run, **section: Unpack[SectionOptions]) -> xr.Dataset:
    """Give Ruiz' two parameters along a line of the surface over a closed cycle.

    F1 is the frictional work per area and cycle, F2 its product with the largest s_xx at the
    surface: C. Ruiz, P. H. B. Boddington, K. C. Chen, Exp. Mech. 24 (1984) 208-217, in whose form
    F1 is the largest shear times the slip amplitude.

    Parameters
    ----------
    result : Result
        As in :func:`life`; the last increments before and of the cycle must be kept.
    **section
        ``y``, ``body_number``, ``cycle``, ``residual``, as in :func:`life`.

    Returns
    -------
    xarray.Dataset
        Over x: ``F1`` [J/m^2] and ``F2`` [J Pa/m^2]; F2 is 0 where the surface is never in tension.
    """
    of = CycleStress(result, Section(**section))
    if of.section.along != "x":
        raise ValueError("x is given: Ruiz' parameters are those along x, at a y")
    y = of.place
    branch = result.dataset.branch_of_increment
    cycle_branches = branch.sel(increment=of.kept).values
    inside = (branch >= cycle_branches.min()) & (branch <= cycle_branches.max())
    whole = result.dataset.increment.values[inside.values]
    # The field adds up over the path: the work of the cycle is the difference of its ends.
    work = _work_until(result, int(whole[-1]), y) - _work_until(result, int(whole[0]) - 1, y)
    history, _ = of.history([0.0])
    tension = np.maximum(history[:, 0, :, 0].max(axis=0), 0.0)
    F1 = work.drop_vars(set(work.coords) - {"x"})
    F1 = F1.assign_attrs(units="J/m^2", long_name="frictional work per area and cycle")
    F2 = (F1 * tension).assign_attrs(units="J Pa/m^2", long_name="F1 times the largest s_xx")
    return xr.Dataset({"F1": F1, "F2": F2})
