"""A number that is known within a range: low, best, high, and what the range comes from."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Literal, NamedTuple, TypeAlias

if TYPE_CHECKING:
    from pyfret._core import Assessment, Material

__all__ = [
    "DISTANCE",
    "LIFE",
    "STRENGTH",
    "Known",
    "LifeRange",
    "Range",
    "known_as",
    "of_error",
    "scatter_of",
    "told_of",
]

#: How a number of a material is known: from a source, by a rule, or from memory alone.
Known: TypeAlias = Literal["known", "estimate", "recalled"]
#: What the sources of numbers that are not known begin with.
MARKS: dict[str, Known] = {"estimate:": "estimate", "recalled:": "recalled"}

#: Life that 90 % of the specimens reach less than over that which 10 % do, where nothing better is
#: known: a stated default, no measurement.
LIFE: dict[Known, float] = {"known": 3.0, "estimate": 5.0, "recalled": 5.0}
#: The same of strengths, for criteria with a limit.
STRENGTH: dict[Known, float] = {"known": 1.2, "estimate": 1.5, "recalled": 1.5}
#: Longest over shortest critical distance: it goes with the square of a threshold over a strength.
DISTANCE: dict[Known, float] = {"known": 2.0, "estimate": 3.0, "recalled": 3.0}


class Range(NamedTuple):
    """A number and the range that it lies in."""

    low: float
    best: float
    high: float

    @property
    def factor(self) -> float:
        """The highest over the lowest value."""
        return self.high / self.low if self.low > 0.0 else math.inf

    def __repr__(self) -> str:
        """Give the best value and the range in two digits, since it is not known better."""
        return in_two_digits(self.low, self.best, self.high)


class LifeRange(NamedTuple):
    """A life [cycles] or a safety factor: its range of 10 to 90 %, and the parts of the range."""

    low: float
    best: float
    high: float
    #: From the error of the stress.
    stress: Range
    #: Highest over lowest by the scatter of the material.
    material: float
    #: From the critical distance; None where the value is that at a point.
    distance: Range | None
    #: The critical distance [m].
    L: float | None
    #: What to know of it.
    notes: tuple[str, ...]

    @classmethod
    def of(
        cls,
        stress: Range,
        material: tuple[float, str],
        distance: Range | None,
        L: float | None,
        notes: Sequence[str],
    ) -> LifeRange:
        """Put the parts together: their logarithms are independent and add as squares."""
        best, (scatter, note) = stress.best, material
        parts = [stress, *([distance] if distance is not None else [])]
        half = 0.5 * math.log(scatter)
        down = math.hypot(half, *(ratio(best, min(of)) for of in parts))
        up = math.hypot(half, *(ratio(max(of), best) for of in parts))
        low = best * math.exp(-down) if math.isfinite(best) else least(parts) * math.exp(-half)
        high = best * math.exp(up) if math.isfinite(up) else math.inf
        told = [*notes, note] if note else list(notes)
        return cls(low, best, high, stress, scatter, distance, L, tuple(told))

    @property
    def factor(self) -> float:
        """The highest over the lowest value."""
        return self.high / self.low if self.low > 0.0 else math.inf

    def __repr__(self) -> str:
        """Give the best value and the range in two digits, since it is not known better."""
        return in_two_digits(self.low, self.best, self.high)


def in_two_digits(low: float, best: float, high: float) -> str:
    """A range as text."""
    upper = f"to {high:.2g}" if math.isfinite(high) else "or more"
    return f"{best:.2g} ({low:.2g} {upper})"


def ratio(larger: float, smaller: float) -> float:
    """The logarithm of a ratio, 0 or more; infinite where the larger one is."""
    if larger == smaller:
        return 0.0
    if math.isinf(larger) or smaller <= 0.0:
        return math.inf
    return max(math.log(larger / smaller), 0.0)


def least(parts: Iterable[Range]) -> float:
    """The smallest of all ends."""
    return min(min(of) for of in parts)


def of_error(assessment: Assessment, value: float, error: float) -> Range:
    """The margin, a life or a safety factor, of a value of a criterion and of its error.

    The margin falls as the value grows: its lowest is that of the value and its error together.
    """
    margin = assessment.life if assessment.limit is None else assessment.safety_factor
    return Range(margin(value + error), margin(value), margin(max(value - error, 0.0)))


def known_as(source: str) -> Known:
    """How a number is known, by what its source begins with."""
    return next((kind for mark, kind in MARKS.items() if source.startswith(mark)), "known")


def scatter_of(material: Material | None, names: Iterable[str] | None = None) -> Known:
    """How the worst known of some numbers of a material is known."""
    if material is None:
        return "known"
    wanted = None if names is None else set(names)
    kinds = {
        known_as(source)
        for name, _, source in material.numbers()
        if wanted is None or name in wanted
    }
    return "recalled" if "recalled" in kinds else "estimate" if "estimate" in kinds else "known"


def told_of(
    assessment: Assessment, material: Material | None, scatter: float | None
) -> tuple[float, str]:
    """The scatter of a material, and a note where its numbers are not known."""
    lives = assessment.limit is None
    names = (*CURVE, *OWN.get(assessment.criterion.name, ())) if lives else LIMITS
    kind = scatter_of(material, names)
    factor = (LIFE if lives else STRENGTH)[kind] if scatter is None else scatter
    if not factor >= 1.0:
        raise ValueError(f"scatter = {factor}: must be 1 or more, the highest over the lowest")
    if kind == "known" or material is None:
        return factor, ""
    which = ", ".join(
        name for name, _, source in material.numbers() if name in names and known_as(source) == kind
    )
    how = "estimates by a rule" if kind == "estimate" else "from memory, without a source"
    return factor, f"{which} of {material.name} are {how}: take numbers of your own"


#: Numbers of a material that a strain-life curve has, those of single criteria beside them, and
#: those of limits.
CURVE = ("s_f", "b", "e_f", "c")
OWN = {"fatemi_socie": ("k", "s_y"), "brown_miller": ("S",)}
LIMITS = ("s_D", "t_D")
