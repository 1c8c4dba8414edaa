"""Will it crack? A fatigue criterion over a closed cycle of a run, below the contact.

The core computes the stress a few depths at a time, judges it and lets it go. ::

    steel = fatigue.Materials()["steel_42CrMo4"]
    life = result.life(steel, "dang_van")
    life.worst  # place and margin of the worst point
    fret.plot.criterion_map(life)
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated, TypeAlias

import numpy as np

from pyfret._core import Material
from pyfret._util.lazy import xr
from pyfret._util.parameter import Remedy
from pyfret.fatigue.beyond_yield import note_on_yield
from pyfret.fatigue.criteria import CriterionName
from pyfret.fatigue.cycle_section import (
    choose_depths,
    concat_sections,
    cycle_section,
    label_fields,
    section_body,
    sections_of_cycle,
)
from pyfret.fatigue.cycles import HistoryKind, history
from pyfret.fatigue.fields import label_criterion_fields
from pyfret.fatigue.judged import Life
from pyfret.fatigue.section import Materials, Section, SectionOptions, for_each_layer
from pyfret.quantities import Lengths, quantities
from pyfret.subsurface.extremum import Extremum

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from typing_extensions import Unpack

    from pyfret._core import CriterionBelow
    from pyfret.run import Run

#: The name of one criterion.
SingleCriterion: TypeAlias = Annotated[
    CriterionName, Remedy("fatigue.lives(result, materials, [...]) evaluates several")
]
#: Criteria in the order in which they are taken where none is given.
USUAL: tuple[CriterionName, ...] = ("smith_watson_topper", "dang_van", "crossland")

__all__ = ["Life", "Materials", "life", "lives"]


@quantities
def life(
    result: Run,
    materials: Materials,
    criterion: SingleCriterion | None = None,
    z: Lengths | None = None,
    *,
    tolerance: float = 1e-3,
    **section: Unpack[SectionOptions],
) -> Life:
    """Judge a section below the contact, or several, over a closed cycle of the load path.

    Strains follow from the stress by the scene's E and nu, and from the plastic strain.

    Parameters
    ----------
    result : Result
        Solved with ``save="all"``, or with the increments of the cycle. The bulk stress of the body
        is part of the stress as the path has it, in or out of phase with the other loads.
    materials : Material or sequence of Material or None
        Material of the substrate, or one for each layer from the surface down, the substrate's
        last. Layers of ``None`` are not judged, nor coatings where one material is given.
    criterion : str, optional
        One of :data:`pyfret.fatigue.CRITERIA`. Default: the first of Smith, Watson and Topper,
        Dang Van and Crossland whose numbers all materials have; the result is printed with it.
    z : array, optional
        Depths [m] (default: chosen by layer, both sides of every interface).
    tolerance : float
        Largest part of the value that another plane may be proved to have more.
    **section
        ``x`` or ``y`` (several for a volume), or ``x``, ``y`` and ``azimuth``; ``body_number``,
        ``cycle``, ``residual``: the fields of :class:`pyfret.fatigue.Section`. By default the
        section stands along the shear, through the centre of the contact. The worst point is also
        looked for in the section across it. A round contact that is sheared along one line does not
        need that section.

    Raises
    ------
    ValueError
        There is no closed cycle, or too few of its increments were kept. A material lacks a number
        that the criterion needs, or no depth lies in a layer that has a material.
    """
    if criterion is None:
        criterion = usual_criterion(materials)
    return lives(result, materials, [criterion], z, tolerance=tolerance, **section)[criterion]


def usual_criterion(materials: Materials) -> CriterionName:
    """Return the first of the usual criteria whose numbers all materials have.

    Raises
    ------
    ValueError
        The materials have the numbers of none of them.
    """
    listed = materials if isinstance(materials, Sequence) else [materials]
    judged = [material for material in listed if isinstance(material, Material)]
    refusals = []
    for name in USUAL:
        try:
            for material in judged:
                material.assessment(name)
        except ValueError as error:
            refusals.append(str(error))
        else:
            return name
    raise ValueError(f"criterion = nothing: must be given; {refusals[0]}")


@quantities
def lives(
    result: Run,
    materials: Materials,
    criteria: Sequence[CriterionName],
    z: Lengths | None = None,
    *,
    tolerance: float = 1e-3,
    **section: Unpack[SectionOptions],
) -> dict[CriterionName, Life]:
    """Judge a section as :func:`life` does by several criteria, all by the same stress.

    Parameters
    ----------
    criteria : sequence of str
        Names of :data:`pyfret.fatigue.CRITERIA`, each once.
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
    if isinstance(criteria, str) or not isinstance(criteria, Sequence):
        raise TypeError(f"criteria = <{type(criteria).__name__}>: must be several names, a list")
    names = list(dict.fromkeys(criteria))
    if not names:
        raise ValueError("criteria = []: must be one or more of fatigue.CRITERIA")
    first, *extra = sections_of_cycle(result, Section(**section))
    layers = len(section_body(result, first).coatings) + 1
    layer_materials = for_each_layer(materials, layers, "material", "materials")
    depths = choose_depths(result, first, z, layer_materials, "material")
    sections: dict[CriterionName, list[CriterionBelow]] = {name: [] for name in names}
    labelled_sections: dict[CriterionName, list[xr.Dataset]] = {name: [] for name in names}
    notes: list[str] = []
    for section_at_place in [*first.split(), *extra]:
        below = cycle_section(result, section_at_place)
        judged = below.by_criteria(*depths, layer_materials, names, tolerance=tolerance)
        for name, criterion_section in zip(names, judged, strict=True):
            sections[name].append(criterion_section)
            if section_at_place in extra:
                continue
            fields = label_criterion_fields(
                criterion_section.fields(), criterion_section.assessments
            )
            labelled_sections[name].append(label_fields(result, section_at_place, depths, fields))
        if not notes and first.cycle is not None:
            notes.extend(filter(None, [below.note_on_cycle()]))
    notes.extend(note_on_yield(result, layer_materials, z, depths[1], first, section))

    def life_by(name: CriterionName) -> Life:
        """Judge by one criterion."""
        whole = concat_sections(result, first, labelled_sections[name]).assign_attrs(criterion=name)
        return Life(
            whole,
            sections[name],
            [*sections[name][0].notes, *notes],
            layer_materials,
            history_of_worst,
        )

    def history_of_worst(worst: Extremum, of: HistoryKind) -> NDArray[np.float64]:
        """Return the history of stress or plastic strain at a worst point."""
        stresses = history(
            result,
            [worst.z],
            x=worst.x,
            y=worst.y,
            body_number=first.body_number,
            cycle=first.cycle,
            residual=first.residual,
            of=of,
        )
        # At an interface both sides are there.
        in_layer = stresses.isel(depth=stresses.layer.values == worst.layer)
        return np.asarray(in_layer.isel(depth=0).transpose("increment", "component").values)

    return {name: life_by(name) for name in names}
