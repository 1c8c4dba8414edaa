"""Measures of a study: largest stresses below the contact."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple
from zlib import crc32

import numpy as np

from pyfret._core import measure
from pyfret.quantities import LayerStresses, as_layers, part
from pyfret.study.answer import NO_ANSWER, Answer
from pyfret.subsurface.contact import (
    sample_borders,
    sample_interfaces,
    sample_sections,
    stress_at_interfaces,
)
from pyfret.subsurface.tensor import LABELS

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

    from pyfret.result import Result
    from pyfret.snapshot import Snapshot
    from pyfret.subsurface.extremum import Extremum
    from pyfret.subsurface.tensor import Stress

__all__ = ["LargestStress", "stress_measure"]

#: Largest relative difference of a largest stress and the highest sample of its section at which
#: the samples show the increment of the largest stress.
SECTION_TOLERANCE = 0.05
#: Largest factor of the stress on a border over the highest sample of the section.
CUSP = 2.0
#: Largest stresses that may be compression; the others are absolute values.
SIGNED = ("interface_peel",)


def on_interfaces(name: str) -> bool:
    """Check that a stress belongs to the interfaces."""
    return name.startswith("interface")


@dataclass(frozen=True)
class SampledState:
    """The stress below a body in one state: on its section, and where borders cross the section.

    Sections of many states are sampled together, which takes a third to a sixth of the time.
    """

    state: Snapshot
    body_number: int
    residual: LayerStresses | None
    samples: NDArray[np.float64]
    layers: NDArray[np.int64]

    @property
    def section(self) -> Stress:
        """Stress on the section, for the search of the largest value."""
        return self.state.stress(body_number=self.body_number, residual=self.residual)

    @cached_property
    def borders(self) -> NDArray[np.float64]:
        """Stress on the surface where rims and stick borders cross the section."""
        residual = as_layers(self.residual)
        return sample_borders(self.state, body_number=self.body_number, residual=residual)

    def highest(self, name: str, layer: int | None = None) -> float:
        """Return the highest sample of a stress on the section; in a `layer`."""
        samples = self.samples if layer is None else self.samples[:, self.layers == layer]
        return float(measure(name, np.reshape(samples, (6, -1))).max())

    def highest_on_borders(self, name: str, layer: int | None = None) -> float:
        """Return the highest stress on borders; in a `layer`."""
        if layer not in (None, 0) or not self.borders.size:
            return -math.inf
        return float(measure(name, self.borders).max())


class InterfaceState(NamedTuple):
    """The stress at the interfaces of a body in one state, sampled above each of them."""

    state: Snapshot
    body_number: int
    samples: NDArray[np.float64]

    @property
    def section(self) -> Stress:
        """Stress on both sides of the interfaces, for the search of the largest value."""
        return stress_at_interfaces(self.state, body_number=self.body_number)

    def highest(self, name: str, layer: int | None = None) -> float:
        """Return the highest sample of a stress; interfaces have no layer."""
        return float(measure(name, self.samples).max())

    def highest_on_borders(self, name: str, layer: int | None = None) -> float:
        """Return no stress: interfaces lie below the borders."""
        return -math.inf


#: Most memory of sections that the stress measures of a result share [bytes].
SHARED_SECTIONS = 128e6


def sample_states(
    result: Result, name: str, increments: Sequence[int], body_number: int
) -> list[SampledState] | list[InterfaceState]:
    """Return the stress of increments with contact, which the stress measures of a result share.

    Sections are sampled once for all measures. They are kept with the result up to 128 MB.
    """
    p = result.dataset.variables["p"].isel(saved=-1).values
    key = tuple(increments), crc32(np.ascontiguousarray(p).tobytes())
    section_kind = f"{'interfaces' if on_interfaces(name) else 'sections'} of body {body_number}"
    kept = result.shared.get(section_kind)
    if kept is not None and kept[0] == key:
        sampled: list[SampledState] = kept[1]
        return sampled
    states = [state for state in map(result.at, increments) if bool(state.contact.any())]
    if on_interfaces(name):
        samples = sample_interfaces(states, body_number=body_number)
        at_interfaces = [
            InterfaceState(state, body_number, of_state)
            for state, of_state in zip(states, samples, strict=True)
        ]
        result.shared[section_kind] = (key, at_interfaces)
        return at_interfaces
    sampled = sample_together(states, body_number)
    if sum(state.samples.nbytes for state in sampled) <= SHARED_SECTIONS:
        result.shared[section_kind] = (key, sampled)
    return sampled


def sample_together(
    states: Sequence[Snapshot], body_number: int, residual: LayerStresses | None = None
) -> list[SampledState]:
    """Sample the sections of states, and the surface where borders of the contact cross them."""
    layers_stress = as_layers(residual)
    sections = sample_sections(states, body_number=body_number, residual=layers_stress)
    return [
        SampledState(
            state,
            body_number,
            residual,
            samples,
            np.asarray(layers),
        )
        for state, (samples, layers) in zip(states, sections, strict=True)
    ]


def largest_of_sections(
    states: Sequence[SampledState | InterfaceState], name: str, layer: int | None = None
) -> Extremum:
    """Return the largest value of a stress in some states, all sampled before.

    The ascent starts below the state with the highest sample. Where the largest value is farther
    from that sample than `SECTION_TOLERANCE`, all states are searched.
    """
    tops = [state.highest(name, layer) for state in states]
    # A cusp on a border exceeds the samples beside it by less than this factor.
    least = max(tops) / CUSP if max(tops) > 0.0 else -math.inf
    tops = [
        max(top, state.highest_on_borders(name, layer)) if top >= least else top
        for top, state in zip(tops, states, strict=True)
    ]
    highest = int(np.argmax(tops))
    largest = states[highest].section.maximum(name, layer=layer)
    if abs(largest.value - tops[highest]) <= SECTION_TOLERANCE * abs(largest.value):
        return largest
    # The samples do not show at which increment the largest value is.
    others = (state.section.maximum(name, layer=layer) for state in states)
    return max(others, key=lambda extremum: extremum.value)


def largest_of_states(
    result: Result, name: str, increments: Sequence[int], body_number: int
) -> Answer:
    """Return the largest value of a stress in a body below some increments."""
    states = sample_states(result, name, increments, body_number)
    if not states:
        return NO_ANSWER
    largest = largest_of_sections(states, name)
    least = -math.inf if name in SIGNED else 0.0
    return Answer.from_error(largest.value, largest.error, least=least)


def largest_of_bodies(
    result: Result, name: str, increments: Sequence[int], body_number: int | None
) -> Answer:
    """Return the largest value of a stress in one body, or of its interfaces in both."""
    if body_number is None and not on_interfaces(name):
        body_number = 2
    bodies = ((1, result.scene.body1), (2, result.scene.body2))
    answers = [
        largest_of_states(result, name, increments, number)
        for number, body in bodies
        if body_number in (None, number) and (body.coatings or not on_interfaces(name))
    ]
    return max(answers, key=lambda answer: answer.value, default=NO_ANSWER)


def stress_measure(name: str) -> Callable[[Result], Answer]:
    """Make a measure: the largest stress below the increments with fields.

    Interfaces belong to both bodies, all other stresses to body 2.
    """

    def largest(result: Result) -> Answer:
        increments = [int(n) for n in result.dataset.saved_increment.values]
        return largest_of_bodies(result, name, increments, None)

    return largest


@part()
class LargestStress:
    """A measure: the largest value of a stress below some increments.

    Gives ``largest_von_mises`` for ``stress="von_mises"``, with its range. The time of the measure
    grows with the number of increments.

    Parameters
    ----------
    stress : str
        A stress, such as ``"von_mises"``, ``"s_1"`` or ``"interface_shear"``.
    increments : sequence of int
        Increments with fields, as of ``result.at``: -1 is the last (default).
    body_number : 1, 2 or None
        The body (default: body 2; a stress of interfaces belongs to both bodies).

    Examples
    --------
    >>> LargestStress("interface_shear", increments=[-1]).stress
    'interface_shear'
    """

    stress: str
    increments: Sequence[int] = (-1,)
    body_number: int | None = None

    def __post_init__(self) -> None:
        """Reject an unknown stress, and an empty list of increments."""
        object.__setattr__(self, "increments", tuple(self.increments))
        if self.stress not in LABELS:
            raise ValueError(
                f"stress = {self.stress!r:.60}: must be one of {', '.join(sorted(LABELS))}"
            )
        if len(self.increments) == 0:
            raise ValueError("increments: must have one at least, such as [-1], the last")
        if self.body_number not in (None, 1, 2):
            raise ValueError(f"body_number = {self.body_number!r:.60}: must be 1, 2 or None")

    def __call__(self, result: Result) -> dict[str, xr.DataArray]:
        """Find the largest value below the increments."""
        answer = largest_of_bodies(result, self.stress, list(self.increments), self.body_number)
        units, meaning = LABELS[self.stress]
        where = ", ".join(map(str, self.increments))
        label = f"largest {meaning.removeprefix('largest ')} below the increments {where}"
        return answer.arrays(f"largest_{self.stress}", units, label)
