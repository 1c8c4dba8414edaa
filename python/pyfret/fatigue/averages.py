"""Critical distances: criteria on the stress averaged over a length of the material."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, get_args

import numpy as np

from pyfret._core import Material
from pyfret._util.arrays import number
from pyfret._util.lazy import xr
from pyfret._util.material_names import as_material
from pyfret.fatigue.criteria import CriterionName
from pyfret.fatigue.cycle_section import cycle_section, section_body, sections_of_cycle
from pyfret.fatigue.fields import label_criterion_fields
from pyfret.fatigue.section import Materials, Section, SectionOptions, for_each_layer
from pyfret.quantities import Length, as_number, quantities
from pyfret.subsurface.fields import coordinates

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from pyfret.run import Run

__all__ = ["Averaging", "average", "critical_distance"]

#: Stress at L/2 below the top of the layer, its mean over the line down to 2 L, over the half disc
#: or the half ball of radius L.
Averaging = Literal["point", "line", "area", "volume"]


@quantities
def critical_distance(material: Material | str) -> float:
    """Compute the critical distance L = (dK_th/(2 s_D))^2/pi of a material [m].

    ``dK_th`` is the threshold range of the stress intensity, and 2 ``s_D`` the range of the fatigue
    limit. Both are fully reversed. Source: D. Taylor, The Theory of Critical Distances, Elsevier
    (2007). A ValueError names the number that is missing.
    """
    return as_material(material).critical_distance()


@quantities
def average(
    result: Run,
    material: Materials,
    criterion: CriterionName,
    *,
    L: Length | None = None,
    method: Averaging = "line",
    layer: int | None = None,
    tolerance: float = 1e-3,
    **section: Unpack[SectionOptions],
) -> xr.Dataset:
    """Judge the stress averaged over a critical distance in a layer below every place of a section.

    Contacts have steep stresses: what counts is the mean over a distance
    that belongs to the material, not the largest value. The stress is averaged, then judged.

    Parameters
    ----------
    result, criterion, tolerance
        As in :func:`pyfret.fatigue.life`.
    material : Material or sequence of Material or None
        Material of the layer, or one for each layer from the surface down, the substrate's last.
    L : float, optional
        Critical distance [m] (default: the material's own, :func:`critical_distance`).
    method : "point", "line", "area" or "volume"
        Point: the stress at L/2 below the top of the layer. Line: its mean from there to 2 L. Area:
        its mean over the half disc of radius L in the plane of the section. Volume: its mean over
        the half ball of radius L, which reaches beyond the section on both sides (D. Taylor, as in
        :func:`critical_distance`).
    layer : int, optional
        The layer that holds the distance, from the surface down (default: the outermost that has a
        material; of one material alone the substrate).
    **section
        ``x`` or ``y``, ``body_number``, ``cycle``, ``residual``, as in :func:`pyfret.fatigue.life`.

    Returns
    -------
    xarray.Dataset
        Over x or y, what :func:`pyfret.fatigue.life` gives over (depth, x), ``error``, the error of
        ``value``, and ``L`` [m]. The error is 1.25 times the change on cells twice as large, and
        the error of the increments of the path. For disc and ball, places nearer than L to the
        border of the grid are NaN; the error is NaN beside them.

    Raises
    ------
    ValueError
        As :func:`pyfret.fatigue.life`, and if the distance reaches beyond the layer.
    """
    first_section = sections_of_cycle(result, Section(**section))[0]
    layers = len(section_body(result, first_section).coatings) + 1
    if layer is not None and not 0 <= layer < layers:
        raise ValueError(f"layer = {layer}: must be 0 to {layers - 1}, from the surface down")
    if isinstance(material, Material) and layer is not None:
        materials: list[Material | None] = [None] * layers
        materials[layer] = material
    else:
        materials = for_each_layer(material, layers, "material", "materials")
    judged_layer = (
        next(n for n, m in enumerate(materials) if m is not None) if layer is None else layer
    )
    layer_material = materials[judged_layer]
    if layer_material is None:
        raise ValueError(f"layer = {judged_layer}: has no material")
    L = critical_distance(layer_material) if L is None else number(as_number(L), "L")
    if not (L > 0.0 and np.isfinite(L)):
        raise ValueError(f"L = {L}: must be a positive length in m")
    if method not in get_args(Averaging):
        raise ValueError(f"method = {method!r}: must be one of {', '.join(get_args(Averaging))}")
    below = cycle_section(result, first_section)
    fields = below.mean(L, method, judged_layer, materials, criterion, tolerance=tolerance)
    assessments = [None if m is None else m.assessment(criterion) for m in materials]
    along = first_section.axis
    places = coordinates(result.scene.grid, [0.0], [judged_layer], *first_section.line)
    result_fields = xr.Dataset(coords=places).drop_dims("depth")
    result_fields = result_fields.assign_coords(axis=["x", "y", "z"])
    for name, (values, attrs) in label_criterion_fields(fields, assessments).items():
        result_fields[name] = ((along, "axis")[: values.ndim - 1], values[0], attrs)
    meaning = "error of the value, by the cells and the increments of the path"
    result_fields["error"] = (
        along,
        fields["error"][0],
        {**result_fields.value.attrs, "long_name": meaning},
    )
    return result_fields.assign_attrs(criterion=criterion, method=method, L=L, layer=judged_layer)
