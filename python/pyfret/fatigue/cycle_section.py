"""Sections of a body over the kept increments of a closed cycle, as the core judges them."""

from __future__ import annotations

from typing import TYPE_CHECKING
from zlib import crc32

import numpy as np

from pyfret import _core
from pyfret._util.arrays import plain
from pyfret._util.lazy import xr
from pyfret._util.numbers import layer_name
from pyfret.fatigue.cycles import cycle_increments, moment_before
from pyfret.fatigue.plastic_strain import plastic_and_reference_work
from pyfret.quantities import as_layers
from pyfret.subsurface.fields import coordinates, interfaces
from pyfret.subsurface.moments import lines_of, moments_of

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import ArrayLike, NDArray

    from pyfret._core import Body
    from pyfret.fatigue.section import Section
    from pyfret.run import Run

__all__ = [
    "choose_depths",
    "concat_sections",
    "cycle_section",
    "label_fields",
    "section_body",
    "sections_of_cycle",
]


def section_body(result: Run, section: Section) -> Body:
    """Return the body that holds a section."""
    scene = result.scene
    return scene.body1 if section.body_number == 1 else scene.body2


def sections_of_cycle(result: Run, section: Section) -> list[Section]:
    """Return the section, or the default sections of the cycle where it has no place.

    The first default section stands along the shear: :func:`lines_of`.
    """
    if section.is_placed:
        return [section]
    kept = cycle_increments(result, section.cycle)
    lines = lines_of(result, kept, section.body_number, as_layers(section.residual))
    return [section.moved_below(line) for line in lines]


def cycle_section(result: Run, section: Section) -> _core.CycleSection:
    """Collect the stress of a section at one place over its cycle."""
    kept = cycle_increments(result, section.cycle)
    moments = moments_of(result, kept, section.body_number, moment_before(result, kept))
    return _core.CycleSection(
        section_body(result, section),
        result.scene.grid,
        moments,
        len(kept),
        **section.line.named(),
        body_number=section.body_number,
        residual=as_layers(section.residual),
        yielding=plastic_and_reference_work(result, kept, section.body_number),
        path_error=max_path_error(result),
        cache=shared_stress(result, kept, section.body_number),
    )


def shared_stress(result: Run, kept: NDArray[np.int64], body_number: int) -> _core.StressCache:
    """Return the stress below a body over increments, shared by all questions about a run.

    A run keeps the stress of one body and one cycle, at most 192 MB.
    """
    last = result.dataset.variables["p"].isel(saved=-1).values
    key = body_number, kept.tobytes(), crc32(np.ascontiguousarray(last).tobytes())
    kept_before = result.shared.get("stress")
    if kept_before is None or kept_before[0] != key:
        kept_before = result.shared["stress"] = (key, _core.StressCache())
    return kept_before[1]


def max_path_error(result: Run) -> float | None:
    """Return the largest error of the shear by the increments, where these were chosen."""
    errors = result.dataset.attrs.get("path_error")
    return float(np.max(errors)) if errors else None


def choose_depths(
    result: Run, section: Section, z: ArrayLike | None, judged_by: Sequence[object], quantity: str
) -> tuple[list[float], list[int]]:
    """Return the depths of a section with their layers: the given ones, or depths chosen by layer.

    `judged_by` has the limit or material of every layer, None where it is not judged. `quantity`
    names it in the error. A ValueError is raised where no depth lies in a judged layer.
    """
    body = section_body(result, section)
    if z is None:
        depths = _core.chosen_depths(body, a=result.length, deepest=2.0 * result.length)
    else:
        depths = _core.depths(body, np.unique(plain(z, "z")).tolist())
    judged = [n for n, limit in enumerate(judged_by) if limit is not None]
    if not set(judged) & set(depths[1]):
        tops = [0.0, *interfaces(body)]
        names = {n: layer_name(n, len(body.coatings)) for n in judged}
        begins = ", ".join(f"{layer} begins at {tops[n]:.4g} m" for n, layer in names.items())
        raise ValueError(
            f"z: no depth lies in a layer that has a {quantity} ({begins}); a material alone "
            "belongs to the substrate"
        )
    return depths


def label_fields(
    result: Run,
    section: Section,
    depths: tuple[list[float], list[int]],
    fields: Mapping[str, tuple[NDArray[np.float64], dict[str, str]]],
) -> xr.Dataset:
    """Label arrays over (depth, place) or (depth, place, axis) by the coordinates of a section."""
    places = coordinates(result.scene.grid, *depths, *section.line)
    labelled = xr.Dataset(coords={**xr.Dataset(coords=places).coords, "axis": ["x", "y", "z"]})
    for name, (values, attrs) in fields.items():
        labelled[name] = (("depth", section.axis, "axis")[: values.ndim], values, attrs)
    return labelled


def concat_sections(result: Run, section: Section, datasets: Sequence[xr.Dataset]) -> xr.Dataset:
    """Concatenate the sections of one or several places."""
    if np.ndim(section.places) == 0:
        whole = datasets[0]
    else:
        whole = xr.concat(datasets, dim=section.cross_axis, coords="minimal", compat="override")
        whole = whole.transpose("depth", section.axis, section.cross_axis, ...)
    yardsticks = {k: v for k, v in result.dataset.attrs.items() if k in ("a_H", "p_H")}
    return whole.assign_attrs(yardsticks, interfaces=interfaces(section_body(result, section)))
