"""Sections of a body over the kept increments of a closed cycle, as the core judges them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pyfret import _core
from pyfret._util.arrays import plain
from pyfret._util.lazy import xr
from pyfret._util.numbers import layer_name
from pyfret.fatigue.cycles import cycle_increments, moment_before
from pyfret.fatigue.plastic_strain import yielding_of
from pyfret.subsurface.fields import coordinates, interfaces
from pyfret.subsurface.moments import lines_of, moments_of

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import ArrayLike, NDArray

    from pyfret._core import Body
    from pyfret.fatigue.section import Section
    from pyfret.run import Run

__all__ = [
    "body_of",
    "depths_of",
    "labelled",
    "over_cycle",
    "placed",
    "side_by_side",
]


def body_of(result: Run, section: Section) -> Body:
    """The body that a section lies in."""
    scene = result.scene
    return scene.body1 if section.body_number == 1 else scene.body2


def placed(result: Run, section: Section) -> list[Section]:
    """The section, or without a place those of the cycle, the first along its shear.

    A second section stands across the first. A round contact that is sheared along one line needs
    no second: its largest stress lies in the plane of the shear.
    """
    if section.is_placed:
        return [section]
    kept = cycle_increments(result, section.cycle)
    return [section.below(line) for line in lines_of(result, kept, section.body_number)]


def over_cycle(result: Run, section: Section) -> _core.CycleSection:
    """A section at one place over its cycle."""
    kept = cycle_increments(result, section.cycle)
    moments = moments_of(result, kept, section.body_number, moment_before(result, kept))
    return _core.CycleSection(
        body_of(result, section),
        result.scene.grid,
        moments,
        len(kept),
        **section.line.named(),
        body_number=section.body_number,
        residual=section.residual,
        yielding=yielding_of(result, kept, section.body_number),
        path_error=path_error_of(result),
    )


def path_error_of(result: Run) -> float | None:
    """The largest error of the shear by the increments, where these were chosen."""
    errors = result.dataset.attrs.get("path_error")
    return float(np.max(errors)) if errors else None


def depths_of(
    result: Run, section: Section, z: ArrayLike | None, each: Sequence[object], one: str
) -> tuple[list[float], list[int]]:
    """The depths of a section with their layers: those given, or those that the layers ask for.

    `each` holds what every layer is judged by, None where it is not judged. `one` is its name in
    the error. A ValueError is raised where no depth lies in a judged layer.
    """
    body = body_of(result, section)
    if z is None:
        depths = _core.chosen_depths(body, a=result.length, deepest=2.0 * result.length)
    else:
        depths = _core.depths(body, np.unique(plain(z, "z")).tolist())
    judged = [n for n, of in enumerate(each) if of is not None]
    if not set(judged) & set(depths[1]):
        tops = [0.0, *interfaces(body)]
        names = {n: layer_name(n, len(body.coatings)) for n in judged}
        begins = ", ".join(f"{of} begins at {tops[n]:.4g} m" for n, of in names.items())
        raise ValueError(
            f"z: no depth lies in a layer that has a {one} ({begins}); a material alone is that "
            "of the substrate"
        )
    return depths


def labelled(
    result: Run,
    section: Section,
    depths: tuple[list[float], list[int]],
    fields: Mapping[str, tuple[NDArray[np.float64], dict[str, str]]],
) -> xr.Dataset:
    """Arrays over (depth, place) or (depth, place, axis) of a section with their coordinates."""
    places = coordinates(result.scene.grid, *depths, *section.line)
    shown = xr.Dataset(coords={**xr.Dataset(coords=places).coords, "axis": ["x", "y", "z"]})
    for name, (values, attrs) in fields.items():
        shown[name] = (("depth", section.along, "axis")[: values.ndim], values, attrs)
    return shown


def side_by_side(result: Run, section: Section, found: Sequence[xr.Dataset]) -> xr.Dataset:
    """The sections of one or several places as one dataset."""
    if np.ndim(section.places) == 0:
        whole = found[0]
    else:
        whole = xr.concat(found, dim=section.across, coords="minimal", compat="override")
        whole = whole.transpose("depth", section.along, section.across, ...)
    yardsticks = {k: v for k, v in result.dataset.attrs.items() if k in ("a_H", "p_H")}
    return whole.assign_attrs(yardsticks, interfaces=interfaces(body_of(result, section)))
