"""Units of figures: SI, or over the yardsticks of the Hertz contact and of Coulomb's law."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeAlias

import numpy as np

from pyfret._util.parameter import Remedy
from pyfret.run import Run, State

if TYPE_CHECKING:
    from collections.abc import Mapping

#: Units that a figure has with "SI".
UNITS_OF_SI = ("um", "µm", "MPa", "N")
#: Dimensionless where there is a Hertz contact and SI elsewhere, or one of both.
Units: TypeAlias = Annotated[
    Literal["auto", "dimensionless", "SI"],
    Remedy(
        '"SI" draws um, MPa and N, "dimensionless" draws over a_H, p_H and mu W; numbers in other '
        'units are .to_dataframe(units={"m": "mm"})'
    ),
]


@dataclass(frozen=True)
class Scale:
    """A divisor of numbers, with its name."""

    #: The divisor, in SI units.
    value: float
    #: Symbol of the divisor, or the name of the unit.
    name: str
    #: Whether the divisor is a unit.
    is_unit: bool

    def label(self, symbol: str) -> str:
        """The label of an axis that shows `symbol`."""
        return f"${symbol}$ [{self.name}]" if self.is_unit else rf"${symbol}/{self.name}$"


@dataclass(frozen=True)
class Scales:
    """Scales of lengths, stresses and shear."""

    length: Scale
    stress: Scale
    shear: Scale

    @property
    def dimensionless(self) -> bool:
        """Whether the yardsticks come from the Hertz contact."""
        return not self.length.is_unit


MICRO = Scale(1e-6, "µm", is_unit=True)
MEGA = Scale(1e6, "MPa", is_unit=True)


def has_friction_scale(mu: float) -> bool:
    """Whether mu is finite and positive, so that mu times a force is a unit of friction forces."""
    return bool(np.isfinite(mu)) and mu > 0.0


def scales(attrs: Mapping[Any, Any], units: Units, *, mu: float = 1.0) -> Scales:
    """Return the scales of a dataset, with or without a_H and p_H among its attributes."""
    hertz = "a_H" in attrs and "p_H" in attrs
    if units in UNITS_OF_SI:
        units = "SI"
    if units not in ("auto", "dimensionless", "SI"):
        raise ValueError(
            f'units = {units!r}: must be "auto", "dimensionless" or "SI", which draws um, MPa and N'
        )
    if units == "dimensionless" and not hertz:
        raise ValueError('units = "dimensionless": there is no Hertz contact; give "SI"')
    if units == "SI" or not hertz:
        return Scales(MICRO, MEGA, MEGA)
    length = Scale(float(attrs["a_H"]), "a_H", is_unit=False)
    stress = Scale(float(attrs["p_H"]), "p_H", is_unit=False)
    shear = (
        Scale(mu * stress.value, r"(\mu\, p_H)", is_unit=False)
        if has_friction_scale(mu)
        else stress
    )
    return Scales(length, stress, shear)


def scales_of_snapshot(snapshot: State, units: Units) -> Scales:
    """Return the scales of an increment."""
    return scales(snapshot.dataset.attrs, units, mu=snapshot.mu)


def last_of(shown: Run | State) -> State:
    """The increment itself, or the last one that a result has kept."""
    return shown.at(-1) if isinstance(shown, Run) else shown


def run_of(shown: Any) -> Run:
    """Return the result of a run; refuse anything else."""
    if not isinstance(shown, Run):
        raise TypeError(
            f"{type(shown).__name__}: must be the result of a run, as solve(...) or open(...) "
            "give it: the figure shows all increments"
        )
    return shown
