"""Miner's sum: the law of lives below the knee, and the damage of loops by their values."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias, get_args

import numpy as np

from pyfret import _core
from pyfret._core import Assessment
from pyfret._util.arrays import number
from pyfret._util.numbers import format_number
from pyfret.history.load_history import LoadHistory
from pyfret.history.loops import CountedLoops
from pyfret.quantities import Numbers, quantities

__all__ = ["BelowKnee", "DamageLaw", "damage_of_loops", "equivalent_amplitude"]

#: Laws of the curve of lives below its knee.
BelowKnee: TypeAlias = Literal["original", "elementary", "haibach"]
LAWS = {
    "original": "loops below the knee do no damage (Miner, original)",
    "elementary": "the curve goes on below the knee with its slope (elementary)",
    "haibach": "below the knee the curve goes on with the exponent 2 m - 1 (Haibach)",
}


@dataclass(frozen=True)
class DamageLaw:
    """How lives go on below the knee of their curve, and the exponent of criteria with a limit.

    Attributes
    ----------
    below : "original", "elementary" or "haibach"
        The curve below the knee: no damage, the same slope, or the exponent 2 m - 1.
    knee : float
        Cycles at the knee. For a criterion with a limit the limit belongs to it.
    exponent : float, optional
        Exponent m of the lives above a limit, N = knee (limit/value)^m. Criteria with a strain-life
        curve have their own.
    """

    below: BelowKnee = "haibach"
    knee: float = _core.LONGEST_LIFE
    exponent: float | None = None

    def __post_init__(self) -> None:
        """Refuse an unknown law."""
        number(self.knee, "knee")
        if self.exponent is not None:
            number(self.exponent, "exponent")
        if self.below not in get_args(BelowKnee):
            raise ValueError(
                f"below = {self.below!r}: must be 'original', 'elementary' or 'haibach'"
            )

    def text(self) -> str:
        """Return the law in words."""
        slope = "" if self.exponent is None else f", exponent {format_number(self.exponent)}"
        return f"{LAWS[self.below]}; knee at {_core.rough(self.knee)} cycles{slope}"


@quantities
def damage_of_loops(
    values: Numbers, counts: Numbers, assessment: Assessment, law: DamageLaw | None = None
) -> float:
    """Return Miner's sum of loops by their values of a criterion.

    Parameters
    ----------
    values, counts : array
        Value of the criterion of each loop, and how often it occurs.
    assessment : Assessment
        Criterion with its limit or curve, such as ``material.assessment("smith_watson_topper")``.
    law : DamageLaw, optional
        The law below the knee.
    """
    law = law or DamageLaw()
    loop_values = np.ascontiguousarray(np.ravel(np.asarray(values, dtype=float)))
    occurs = np.ravel(np.asarray(counts, dtype=float))
    if loop_values.shape != occurs.shape:
        raise ValueError(f"{loop_values.size} values and {occurs.size} counts: must be as many")
    return float(
        occurs
        @ _core.damage_of_values(
            assessment, loop_values, below=law.below, knee=law.knee, exponent=law.exponent
        )
    )


@quantities
def equivalent_amplitude(history: LoadHistory | CountedLoops, exponent: float) -> float:
    """Return the amplitude of as many constant loops with the same sum of amplitude^exponent.

    Parameters
    ----------
    history : LoadHistory or CountedLoops
        The history, or its counted loops.
    exponent : float
        Exponent m of the curve N ~ amplitude^-m, or of the energy of a loop: 3 for small loops of
        partial slip.
    """
    return history.equivalent_amplitude(exponent)
