"""Will it crack? A fatigue criterion over a closed cycle of a run, below the contact.

The stress is computed a few depths at a time, judged and let go: memory is bounded by the chunk. ::

    steel = fatigue.Materials()["steel_42CrMo4"]
    life = result.life(steel, "dang_van")
    life.worst  # place and margin of the worst point
    fret.plot.criterion_map(life)
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from pyfret import _core, subsurface
from pyfret._core import Material
from pyfret.cycle_stress import CycleStress
from pyfret.fatigue import COMPONENTS, evaluate
from pyfret.lazy import xr

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from pyfret._core import Assessment
    from pyfret.fatigue import CriterionName
    from pyfret.results import Result

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
    #: Place along the section [m].
    along: float
    #: Depth [m].
    z: float
    #: Layer from the surface down; their number for the substrate.
    layer: int
    #: What the distances of the depths leave of an error of the value, estimated.
    error: float


class Life:
    """A criterion on a section below the contact.

    :attr:`dataset` has ``value``, ``missed`` (no plane has more than value + missed), the shear and
    normal stresses that make the value, ``normal`` of the critical plane, and ``safety_factor``
    (limit over value) or ``life`` [cycles], over (depth, x) or (depth, y); NaN in layers without a
    material.
    """

    def __init__(self, dataset: xr.Dataset, assessments: Sequence[Assessment | None]) -> None:
        self.dataset = dataset
        self._assessments = assessments

    @property
    def margin(self) -> xr.DataArray:
        """``safety_factor`` or ``life``, whichever the criterion gives."""
        return self.dataset[margin_name(self._assessments)[0]]

    def worst_of(self, layer: int) -> Worst:
        """Give the worst point of a layer; a ValueError where it is not judged."""
        assessment = self._assessments[layer]
        of_layer = self.dataset.layer.values == layer
        if assessment is None or not of_layer.any():
            raise ValueError(f"layer {layer} is not judged: it has no material or no depth")
        here = self.dataset.value.isel(depth=of_layer)
        field = np.zeros((6, *here.shape))
        field[0] = here.values
        along = here[str(here.dims[1])].values.tolist()
        found = _core.maximum("s_xx", field, here.z.values.tolist(), [layer] * len(field[0]), along)
        if found is None:
            raise ValueError("the section holds no number")
        value, place, z, layer, error = found
        return Worst(value, margin_of(assessment, value), place, z, layer, error)

    @property
    def worst(self) -> Worst:
        """The point of the smallest margin; of equal ones, that of the larger value."""
        layers = np.unique(self.dataset.layer.values)
        judged = [self.worst_of(int(n)) for n in layers if self._assessments[int(n)] is not None]
        return min(judged, key=lambda w: (np.nan_to_num(w.margin, nan=-np.inf), -w.value))

    def __repr__(self) -> str:
        """Say what was judged and how it ends."""
        w = self.worst
        name = margin_name(self._assessments)[0].replace("_", " ")
        return (
            f"Life({self.dataset.attrs['criterion']}, {name} {w.margin:.4g} at "
            f"{w.along:.4g} m, z = {w.z:.4g} m, layer {w.layer})"
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
    if isinstance(materials, Material):
        materials = [materials] * layers
    if len(materials) != layers:
        raise ValueError(
            f"{len(materials)} materials: must be one for all layers, or one for each of the "
            f"{layers} from the surface down, the substrate's last; None leaves a layer out"
        )
    if all(m is None for m in materials):
        raise ValueError("no layer has a material: nothing is judged")
    return [None if m is None else m.assessment(criterion) for m in materials]


def life(
    result: Result,
    materials: Materials,
    criterion: CriterionName,
    z: ArrayLike | None = None,
    *,
    x: float | None = None,
    y: float | None = None,
    body_number: int = 2,
    cycle: int = -1,
    residual: Sequence[float] | None = None,
    tolerance: float = 1e-3,
) -> Life:
    """Judge a section below the contact over a closed cycle of the load path.

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
    x, y : float, optional
        The section along x at that y (default: y = 0), or along y at that x [m].
    body_number : 1 or 2
        The body.
    cycle : int
        Which of the closed cycles; the last by default.
    residual : sequence of float, optional
        Residual stress of every layer from the surface down, the substrate's last [Pa]: biaxial and
        uniform, added to s_xx and s_yy. It has no effect on the contact.
    tolerance : float
        Largest part of the value that another plane may be proved to have more.

    Raises
    ------
    ValueError
        There is no closed cycle, too few of its increments were kept, or a material lacks a number
        that the criterion needs.
    """
    if x is None and y is None:
        y = 0.0
    of = CycleStress(result, x=x, y=y, body_number=body_number, cycle=cycle, residual=residual)
    assessments = _assessments(materials, criterion, of.layers)
    if z is None:
        z, _ = _core.chosen_depths(of.body, a=result.length, deepest=2.0 * result.length)
    parts = []
    for some in of.chunks(np.unique(np.asarray(z, dtype=float))):
        history, places = of.history(some)
        parts.append(_judged(history, places, assessments, tolerance))
    whole = xr.concat(parts, dim="depth", data_vars="minimal", coords="minimal")
    yardsticks = {k: v for k, v in result.dataset.attrs.items() if k in ("a_H", "p_H")}
    attrs = {**yardsticks, "criterion": criterion, "interfaces": subsurface.interfaces(of.body)}
    return Life(whole.assign_attrs(attrs), assessments)


def _judged(
    history: NDArray[np.float64],
    places: xr.Dataset,
    assessments: Sequence[Assessment | None],
    tolerance: float,
) -> xr.Dataset:
    """The criterion on a history of shape (time, depth, along, 6)."""
    layers = places.layer.values
    dims = places[COMPONENTS[0]].dims
    name, meaning = margin_name(assessments)
    whole: dict[str, NDArray[np.float64]] = {}
    attrs: dict[str, dict[str, str]] = {}
    for layer in np.unique(layers):
        assessment = assessments[int(layer)]
        if assessment is None:
            continue
        here = layers == layer
        found = evaluate(history[:, here], assessment.criterion, tolerance=tolerance)
        margins = [margin_of(assessment, v) for v in found.value.values.ravel().tolist()]
        values = {str(k): v.values for k, v in found.data_vars.items()}
        values[name] = np.reshape(margins, found.value.shape)
        attrs.update({str(k): v.attrs for k, v in found.data_vars.items()})
        for key, value in values.items():
            shape = (layers.size, *value.shape[1:])
            whole.setdefault(key, np.full(shape, np.nan))[here] = value
    attrs[name] = {"units": "1", "long_name": meaning}
    shown = xr.Dataset(coords={**places.coords, "axis": ["x", "y", "z"]})
    for key, value in whole.items():
        shown[key] = ((*dims, "axis")[: value.ndim], value, attrs[key])
    return shown


def _work_until(result: Result, increment: int, y: float) -> xr.DataArray:
    """Frictional work per area along a line from the start to the end of an increment [J/m^2]."""
    if increment not in result.dataset.saved_increment.values:
        raise ValueError(
            f"increment {increment} was not kept: the work of a cycle needs the fields at both of "
            "its ends; solve with save='all' or save='branches'"
        )
    work: xr.DataArray = result.at(increment).along_x(y=y).dissipated_density
    return work.drop_vars(set(work.coords) - {"x"})


def ruiz(result: Result, *, y: float = 0.0, body_number: int = 2, cycle: int = -1) -> xr.Dataset:
    """Give Ruiz' two parameters along a line of the surface over a closed cycle.

    F1 is the frictional work per area and cycle, F2 its product with the largest s_xx at the
    surface: C. Ruiz, P. H. B. Boddington, K. C. Chen, Exp. Mech. 24 (1984) 208-217, in whose form
    F1 is the largest shear times the slip amplitude.

    Parameters
    ----------
    result, y, body_number, cycle
        As in :func:`life`; the last increments before and of the cycle must be kept.

    Returns
    -------
    xarray.Dataset
        Over x: ``F1`` [J/m^2] and ``F2`` [J Pa/m^2]; F2 is 0 where the surface is never in tension.
    """
    of = CycleStress(result, x=None, y=y, body_number=body_number, cycle=cycle, residual=None)
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
