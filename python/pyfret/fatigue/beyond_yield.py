"""A note on elastic stress beyond the yield stress of the judged materials."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from pyfret._core import with_error
from pyfret._util.numbers import place
from pyfret.fatigue.cycle_section import section_body
from pyfret.fatigue.factors import load_factors

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from pyfret._core import Body, Material
    from pyfret.fatigue.section import Section, SectionOptions
    from pyfret.run import Run

__all__ = ["note_on_yield"]

#: Least load factor of the samples of a section from which on none between them is below 1.
BETWEEN_SAMPLES = 1.25


def note_on_yield(
    result: Run,
    materials: Sequence[Material | None],
    z: ArrayLike | None,
    layers: Sequence[int],
    section: Section,
    options: SectionOptions,
) -> list[str]:
    """Compare the elastic stress of a cycle with the yield stress of the layers that have one.

    `layers` are the layers of the depths. A body that has yielded in the run needs no note: its
    stress is the right one. Nor does a stress below first yield.
    """
    body = section_body(result, section)
    if body.yields and float(result.largest_plastic_strain.max()) > 0.0:
        return []
    limits = [
        material.number("s_y")
        if material is not None and n in layers and "s_y" in names_of_numbers(material)
        else None
        for n, material in enumerate(materials)
    ]
    if all(limit is None for limit in limits):
        return []
    factors = load_factors(result, limits, z, **options)
    if float(factors.dataset.von_mises.min()) > BETWEEN_SAMPLES:
        return []
    first = factors.least("von_mises")
    if first.value >= 1.0:
        return []
    material, s_y = materials[first.layer], limits[first.layer]
    assert material is not None
    assert s_y is not None
    limit_in_words = f"the yield stress of {material.name}, {1e-6 * s_y:.4g} MPa"
    comparison = f"von Mises exceeds {limit_in_words}"
    if not has_residual_stress(body, section):
        ratio = with_error(1.0 / first.value, first.error / first.value**2)
        comparison = f"von Mises comes to {ratio} of {limit_in_words}"
    elastic = with_error(first.value, first.error)
    where = place(first, len(body.coatings))
    shakedown = factors.least_of(first.layer, "shakedown")
    limit = with_error(shakedown.value, shakedown.error)
    later = (
        f"up to {limit} of them later cycles are elastic"
        if shakedown.value >= 1.0
        else f"beyond {limit} of them every cycle yields"
    )
    return [
        f"elastic stress beyond yield: {comparison}, at {where}. First yield is at {elastic} of "
        f"the loads, and {later}. Elastic(..., plastic=Plastic(s_y=...)) computes what yields. A "
        "larger radius or a smaller load keeps it elastic"
    ]


def has_residual_stress(body: Body, section: Section) -> bool:
    """Check for a residual stress, which does not grow with the loads."""
    stresses = [body.residual, *(coating.residual for coating in body.coatings)]
    return section.residual is not None or any(stress is not None for stress in stresses)


def names_of_numbers(material: Material) -> list[str]:
    """Return the names of the numbers that a material has."""
    return [name for name, *_ in material.numbers()]
