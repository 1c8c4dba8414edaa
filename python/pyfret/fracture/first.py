"""First failure below a coated contact: film, interface or substrate."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Literal, NamedTuple, TypeAlias

import numpy as np

from pyfret._core import with_error
from pyfret._util.attributes import missing_attribute
from pyfret._util.numbers import um
from pyfret._util.window import wrap
from pyfret.fatigue.cycle_section import sections_of_cycle
from pyfret.fatigue.cycles import history
from pyfret.fatigue.section import Section
from pyfret.fracture.below import crack
from pyfret.fracture.film import channel_release
from pyfret.fracture.growth import Threshold
from pyfret.fracture.interface import over_cycle
from pyfret.quantities import (
    CrackLength,
    LayerStresses,
    Length,
    Strength,
    Toughness,
    as_layers,
    as_number,
    quantities,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pyfret._core import Material
    from pyfret.fracture.arrest import CrackArrest
    from pyfret.run import Run

__all__ = ["PARTS", "FailureOrder", "first_to_fail"]

Part: TypeAlias = Literal["film", "interface", "substrate"]
#: What may fail, from the surface down.
PARTS: tuple[Part, ...] = ("film", "interface", "substrate")


class FailureOrder(NamedTuple):
    """Load over what it can bear, 1 at failure; NaN where no limit was given."""

    #: Root of the energy that a channel crack releases over the toughness of the film.
    film: float
    #: Root of the quadratic criterion of the interfaces.
    interface: float
    #: Smallest range of K over its threshold of a crack that has come through the coatings.
    substrate: float
    #: Error of `substrate` by the error of K; the other two are estimates.
    substrate_error: float | None = None
    #: What becomes of the crack in the substrate, by its length; None without a threshold.
    arrest: CrackArrest | None = None

    @property
    def first(self) -> Part | None:
        """The part with the largest of the three; None where none fails."""
        parts = (self.film, self.interface, self.substrate)
        loads = [-math.inf if math.isnan(load) else load for load in parts]
        largest = int(np.argmax(loads))
        return PARTS[largest] if loads[largest] >= 1.0 else None

    @property
    def errors(self) -> dict[Part, float | None]:
        """The errors of the three; None of an estimate."""
        return {"film": None, "interface": None, "substrate": self.substrate_error}

    def _sentences(self) -> list[str]:
        """Return the sentences of the summary."""
        sentences = [
            f"{part} {with_error(getattr(self, part), self.errors[part])}" for part in PARTS
        ]
        if self.arrest is not None:
            mark = (
                " (estimate)" if self.arrest.estimate and self.substrate_error is not None else ""
            )
            start, at = um(self.arrest.start), um(self.arrest.margin_at)
            sentences[-1] += f"{mark} (least dK/dK_th from a length of {start} on, at {at})"
        return sentences

    def __repr__(self) -> str:
        """The three with their errors."""
        return f"FailureOrder({', '.join(self._sentences())}; first: {self.first or 'none'})"

    def summary(self) -> str:
        """Describe the loads of film, interface and substrate, which fails first, and the crack."""
        crack = [] if self.arrest is None else [f"a crack {self.arrest.describe()}"]
        return wrap(
            "\n".join([*self._sentences(), f"first to fail: {self.first or 'none'}", *crack])
        )


@quantities
def first_to_fail(
    result: Run,
    *,
    toughness: Toughness | None = None,
    peel_strength: Strength | None = None,
    shear_strength: Strength | None = None,
    threshold: Threshold | Material | str | None = None,
    residual: LayerStresses | None = None,
    x: Length | None = None,
    lengths: Sequence[CrackLength] | None = None,
    body_number: int = 2,
    cycle: int | None = -1,
) -> FailureOrder:
    """Compare what a closed cycle does to film, interface and substrate.

    All three are looked for in the section along the shear. Other sections are added where the
    contact, bulk or residual stress have another direction.

    All three are proportional to the stress, so that without residual stress the largest goes first
    as loads grow.

    Parameters
    ----------
    result : Result
        Of a coated body, solved with ``save="all"``, or with the increments of the cycle.
    toughness : float, optional
        Energy release rate at which a crack channels through the outermost coating [J/m^2]. Its
        stress is the largest of the cycle along these, residual stress included. It is looked
        for at the top and the bottom of the coating and at the depths of a table of its residual
        stress. The result is on the safe side where the stress varies through the thickness.
    peel_strength, shear_strength : float, optional
        Strengths of the interfaces [Pa], both or neither: :func:`over_cycle`.
    threshold : Threshold, Material or str, optional
        Of the substrate, or its material, or the name of that. It is for a normal crack that has
        come through the coatings: :func:`crack`. Its number is ``margin`` of :meth:`Cracks.arrest`
        from the shortest of `lengths`.
    residual : sequence, optional
        Residual stress of every layer, as in :class:`pyfret.fatigue.Section`.
    x : float, optional
        Its mouth [m] (default: the rim of the contact below which the range of K is larger).
    lengths : array, optional
        Lengths of the crack [m] (default: as in :func:`crack`).
    body_number, cycle
        As in :func:`pyfret.fatigue.life`.

    Raises
    ------
    ValueError
        The body has no coating, one strength is given alone, or as :func:`crack`.
    """
    scene = result.scene
    body = scene.body1 if body_number == 1 else scene.body2
    if not body.coatings:
        raise ValueError(f"body {body_number} has no coating and no interface")
    film = interface = substrate = math.nan
    toughness = as_number(toughness)
    error = arrest = None
    if toughness is not None:
        if not (toughness > 0.0 and np.isfinite(toughness)):
            raise ValueError(f"toughness = {toughness}: must be positive, in J/m^2")
        coating = body.coatings[0]
        below = body.coatings[1].material if len(body.coatings) > 1 else body.substrate
        # The surface, the depths of a table of residual stress, and both sides of the first
        # interface: the upper one is the film's.
        layers = as_layers(residual)
        film_stress = coating if layers is None else coating.replace(residual=layers[0])
        table = film_stress.residual
        rows = table if isinstance(table, list) else []
        inside = [row[0] for row in rows if 0.0 < row[0] < coating.thickness]
        where = Section(body_number=body_number, cycle=cycle, residual=residual)
        depths = [0.0, *inside, coating.thickness]
        sections = sections_of_cycle(result, where)
        largest = max(tension_along(result, section, depths) for section in sections)
        film = math.sqrt(channel_release(coating, below, largest) / toughness)
    if peel_strength is not None or shear_strength is not None:
        where = Section(body_number=body_number, cycle=cycle, residual=residual)
        criteria = [
            over_cycle(
                result,
                peel_strength=peel_strength,
                shear_strength=shear_strength,
                body_number=body_number,
                cycle=cycle,
                **section.line.named(),
            ).criterion
            for section in sections_of_cycle(result, where)
        ]
        interface = math.sqrt(max(float(criterion.max()) for criterion in criteria))
    if threshold is not None:
        at = None if lengths is None else [as_number(length) for length in lengths]
        cracks = crack(
            result, x, lengths=at, body_number=body_number, cycle=cycle, residual=residual
        )
        arrest = cracks.arrest(threshold)
        substrate, error = arrest.margin, arrest.margin_error
    return FailureOrder(film, interface, substrate, error, arrest)


def tension_along(result: Run, section: Section, depths: list[float]) -> float:
    """Return the largest stress of the film along a section over its cycle [Pa]."""
    line = section.line
    stress = history(
        result,
        depths,
        **line.named(),
        body_number=section.body_number,
        cycle=section.cycle,
        residual=section.residual,
    )
    of_film = stress.isel(depth=stress.layer.values == 0)
    xx, yy, xy = (of_film.sel(component=name, drop=True) for name in ("s_xx", "s_yy", "s_xy"))
    cos, sin = np.cos(line.angle), np.sin(line.angle)
    return float((cos**2 * xx + 2.0 * cos * sin * xy + sin**2 * yy).max())


if not TYPE_CHECKING:
    # A method within the class would let type checkers take any name.
    FailureOrder.__getattr__ = missing_attribute
