"""Stress and displacement below the contact of an increment."""

from __future__ import annotations

from copy import copy
from typing import TYPE_CHECKING
from zlib import crc32

import numpy as np

from pyfret import _core
from pyfret.scene.warnings import doubt_layers
from pyfret.subsurface import fields
from pyfret.subsurface.line import Line, line_through_point, main_line
from pyfret.subsurface.moments import states_of
from pyfret.subsurface.plastic import eigenstress
from pyfret.subsurface.tensor import Stress

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Sequence

    import xarray as xr
    from numpy.typing import ArrayLike, NDArray

    from pyfret.run import State

__all__ = [
    "displacement_below",
    "sample_borders",
    "sample_interfaces",
    "sample_sections",
    "stress_at_interfaces",
    "stress_below",
    "write_below",
]


def stress_below(
    state: State,
    z: ArrayLike | None = None,
    *,
    x: float | None = None,
    y: float | None = None,
    azimuth: float | None = None,
    body_number: int = 2,
    bulk: bool = True,
    residual: Sequence[ArrayLike] | None = None,
) -> Stress:
    """Stress below the contact of an increment: :meth:`pyfret.Snapshot.stress`."""
    body, grid = state.body(body_number), state.scene.grid
    doubt_layers(fields.interfaces(body), grid)
    line, chosen = line_below(state, z, x, y, azimuth)

    def sample() -> Stress:
        loaded = loaded_by(state, body_number, bulk=bulk, residual=residual)
        return fields.sampled_stress(loaded, body, grid, z, line, state.length)

    is_shared = chosen and bulk and residual is None and not body.yields
    below = shared_section(state, body_number, sample) if is_shared else sample()
    return with_contact(below, state, anywhere=chosen)


def shared_section(state: State, body_number: int, sample: Callable[[], Stress]) -> Stress:
    """Return the stress on the chosen section of a state, which all questions about a run share.

    A run keeps the last section of each body, with the search for its largest values.
    """
    tractions = [*state.tractions().values(), state.dataset["stick"].values]
    sums = [crc32(np.ascontiguousarray(field).tobytes()) for field in tractions]
    key = (*sums, state.bulk_stress(body_number))
    kept = state.shared.get(f"section of body {body_number}")
    if kept is None or kept[0] != key:
        kept = state.shared[f"section of body {body_number}"] = (key, sample())
    section: Stress = kept[1]
    return copy(section)


def stress_at_interfaces(state: State, *, body_number: int = 2) -> Stress:
    """Return the stress on both sides of every interface of a coated body.

    The section is the one that :func:`stress_below` chooses, with the interfaces as its depths.
    """
    body, grid = state.body(body_number), state.scene.grid
    doubt_layers(fields.interfaces(body), grid)
    loaded = loaded_by(state, body_number, bulk=True, residual=None)
    depths = fields.interfaces(body)
    below = fields.sampled_stress(loaded, body, grid, depths, main_line(state), state.length)
    return with_contact(below, state, anywhere=True)


#: Most memory of sections that are computed together [bytes].
TOGETHER = 32e6
#: Lines nearer than this part of a cell, and angles nearer than this [rad], are the same.
SAME_LINE = 1e-6


def sample_sections(
    states: Sequence[State],
    *,
    body_number: int = 2,
    residual: Sequence[ArrayLike] | None = None,
) -> list[tuple[NDArray[np.float64], list[int]]]:
    """Return the stress of states on the sections that :func:`stress_below` chooses.

    Each array has the shape (6, depths, places). The layers of the depths stand beside it.
    """

    def choose(body: _core.Body, length: float) -> tuple[list[float], list[int]]:
        return fields.choose_depths(body, None, length)

    return _sample_together(states, body_number, residual, choose)


def sample_interfaces(
    states: Sequence[State], *, body_number: int = 2
) -> list[NDArray[np.float64]]:
    """Return the stress of states above every interface on the chosen sections.

    Each array has the six components, then the samples. The stresses that act on an interface are
    the same on both sides.
    """

    def upper_sides(body: _core.Body, _: float) -> tuple[list[float], list[int]]:
        depths = fields.interfaces(body)
        return depths, list(range(len(depths)))

    sampled = _sample_together(states, body_number, None, upper_sides)
    return [np.reshape(section, (6, -1)) for section, _ in sampled]


def _sample_together(
    states: Sequence[State],
    body_number: int,
    residual: Sequence[ArrayLike] | None,
    choose_depths: Callable[[_core.Body, float], tuple[list[float], list[int]]],
) -> list[tuple[NDArray[np.float64], list[int]]]:
    """Return the stress of states on their chosen sections, with the layers of the depths.

    `choose_depths` takes the body and the length of the contact. States whose sections lie below
    one line share their kernels, which cost as much as ten states.
    """
    groups: dict[tuple[object, ...], list[int]] = {}
    lines = [main_line(state) for state in states]
    for n, (state, line) in enumerate(zip(states, lines, strict=True)):
        cell = SAME_LINE * state.scene.grid.dx
        steps = (cell, cell, SAME_LINE)
        key = [
            None if at is None else round(at / step) for at, step in zip(line, steps, strict=True)
        ]
        groups.setdefault((*key, state.length), []).append(n)
    sampled: dict[int, tuple[NDArray[np.float64], list[int]]] = {}
    for members in groups.values():
        first = states[members[0]]
        body, grid = first.body(body_number), first.scene.grid
        z, layers = choose_depths(body, first.length)
        size = 48.0 * len(z) * max(grid.nx, grid.ny)
        count = max(int(TOGETHER / size), 1)
        for start in range(0, len(members), count):
            part = members[start : start + count]
            sections = _core.section_of_states(
                body,
                states_of([states[n] for n in part], body_number),
                z,
                layers,
                residual=residual,
                body_number=body_number,
                **lines[members[0]].named(),
            )
            sampled |= {n: (section, layers) for n, section in zip(part, sections, strict=True)}
    return [sampled[n] for n in range(len(states))]


def sample_borders(
    state: State, *, body_number: int = 2, residual: Sequence[ArrayLike] | None = None
) -> NDArray[np.float64]:
    """Return the surface stress where the chosen section crosses rims and stick borders.

    The array has the six components, then the crossings.
    """
    loaded = loaded_by(state, body_number, bulk=True, residual=residual)
    return loaded.border_stress(**main_line(state).named()).T


def with_contact(below: Stress, state: State, *, anywhere: bool) -> Stress:
    """Add the scales of the contact, and the error of its tractions, to a stress below it.

    `anywhere`: the largest value belongs to the whole body, not to the section.
    """
    scales = {k: v for k, v in state.dataset.attrs.items() if k in ("a_H", "p_H")}
    return below.assign_attrs(scales | stress_error(state) | {"anywhere": int(anywhere)})


def loaded_by(
    state: State, body_number: int, *, bulk: bool, residual: Sequence[ArrayLike] | None
) -> _core.Subsurface:
    """Return a body under the tractions of an increment and its stress by plastic strain."""
    p, q_x, q_y = (state.tractions()[name] for name in ("p", "q_x", "q_y"))
    return fields.subsurface(
        state.body(body_number),
        state.scene.grid,
        (p, q_x, q_y),
        body_number,
        state.bulk_stress(body_number) if bulk else 0.0,
        residual,
        left=eigenstress(state, body_number),
        rim=True,
        stick=state.dataset["stick"].values,
    )


def line_below(
    state: State,
    z: ArrayLike | None,
    x: float | None,
    y: float | None,
    azimuth: float | None,
) -> tuple[Line, bool]:
    """Return the section, and whether it is the default one of the contact.

    That one lies along the shear, through the centre of the contact.
    """
    outline = state.outline
    if azimuth is not None:
        centre = (0.0, 0.0) if outline is None else outline.centre
        x, y = (c if at is None else at for at, c in zip((x, y), centre, strict=True))
        return line_through_point(x, y, azimuth), False
    if z is not None or x is not None or y is not None:
        return Line(x, y), False
    return main_line(state), True


def stress_error(state: State) -> dict[str, float]:
    """The error bar of the stress over its size, where the run has error bars."""
    bars = state.dataset.attrs.get("error_bars")
    if not bars:
        return {}
    of_branch = bars[int(state.dataset.branch_of_increment)]
    if "stress" not in of_branch:
        # A store of an older version has the errors of the fields alone.
        return {"stress_error": float(np.hypot(*(of_branch[k]["total"] for k in ("p", "q"))))}
    return {"stress_error": of_branch["stress"]["total"]}


def displacement_below(
    state: State,
    z: ArrayLike | None = None,
    *,
    x: float | None = None,
    y: float | None = None,
    azimuth: float | None = None,
    body_number: int = 2,
) -> xr.Dataset:
    """Displacements below the contact of an increment: :meth:`pyfret.Snapshot.displacement`."""
    line, _ = line_below(state, z, x, y, azimuth)
    return fields.displacement(
        state.body(body_number),
        state.scene.grid,
        z,
        x=line.x,
        y=line.y,
        azimuth=line.azimuth,
        body_number=body_number,
        length=state.length,
        **state.tractions(),
    )


def write_below(
    state: State,
    out: str | os.PathLike[str],
    z: ArrayLike | None = None,
    *,
    of: Sequence[str] = ("von_mises",),
    body_number: int = 2,
    bulk: bool = True,
    residual: Sequence[ArrayLike] | None = None,
) -> None:
    """Write the volume below the contact of an increment: :meth:`pyfret.Snapshot.write_volume`."""
    fields.write(
        loaded_by(state, body_number, bulk=bulk, residual=residual),
        state.body(body_number),
        out,
        z,
        fields.loaded_length(state.scene.grid, *state.tractions().values()),
        of,
        repr(state),
    )
