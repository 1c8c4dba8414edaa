"""Arrest and life of a crack: numbers, and their descriptions."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Literal, TypeAlias

from pyfret._core import rough, with_error, with_range
from pyfret._util.attributes import missing_attribute
from pyfret._util.numbers import um
from pyfret._util.window import wrap

__all__ = ["WORDS", "CrackArrest", "CrackLife"]

#: What a crack does.
Verdict: TypeAlias = Literal["dormant", "stops", "grows"]

#: The words of a verdict: tables, figures, pages and JSON have no others.
WORDS: dict[Verdict, str] = {
    "dormant": "does not grow",
    "stops": "stops",
    "grows": "grows through all lengths",
}
#: What a crack may do as well, within an error.
MAY = {"dormant": "not grow", "stops": "stop", "grows": "grow through all lengths"}
UNDECIDED = "not decided within the error of K"


def estimate_notes(*estimates: str | None, has_range: bool) -> list[str]:
    """Return notes on estimated numbers: ranges cover the error of K alone."""
    beyond = " (the ranges leave out the scatter of estimates)" if has_range else ""
    return [f"estimate: {note}{beyond}" for note in dict.fromkeys(estimates) if note]


@dataclass(frozen=True)
class CrackArrest:
    """The arrest of a crack that begins with a length.

    Parameters
    ----------
    verdict : {"dormant", "stops", "grows"}
        It does not grow from its first length; it stops; it grows to the last length looked at.
    start : float
        Its first length [m], from which the verdict holds.
    length : float or None
        Where it stops [m]; None where it does not grow, or does not stop.
    crossings : tuple of float
        Lengths at which the range of K crosses its threshold [m], shorter ones than `start` too.
    margin, margin_at : float
        Smallest range of K over its threshold from the first length on, and where [m]. Below 1 the
        crack stops.
    at_start : float
        Range of K over its threshold at the first length. Up to 1 the crack does not grow from it.
    computed : (float, float)
        The shortest and the longest length at which K is known [m].
    margin_error, at_start_error : float
        Errors of the margin and of `at_start` by the error of K; None where K came without an
        error.
    lengths : (float, float), optional
        Where it stops with the range of K less and more its error [m]. These are the shortest and
        the longest length, infinite where it grows through all lengths. None where K came without
        an error. The scatter of the threshold is no part of it.
    verdicts : tuple of str
        The verdicts that the error of K leaves, the one above first.
    estimate : str, optional
        Which numbers of the threshold are estimates, in words.
    """

    verdict: Verdict
    start: float
    length: float | None
    crossings: tuple[float, ...]
    margin: float
    margin_at: float
    at_start: float
    computed: tuple[float, float]
    margin_error: float | None = None
    at_start_error: float | None = None
    lengths: tuple[float, float] | None = None
    verdicts: tuple[Verdict, ...] = ()
    estimate: str | None = None

    @property
    def is_sure(self) -> bool:
        """Whether the error of K leaves one verdict: no bar reaches over the threshold."""
        undecided = any(e is not None and abs(value - 1.0) < e for value, e in self._deciding())
        return len(self.verdicts) == 1 and not undecided

    @property
    def tip(self) -> float:
        """Length that the crack has in the end [m]: where it stops, its first or the longest."""
        if self.length is not None:
            return self.length
        return self.start if self.verdict == "dormant" else self.computed[1]

    @property
    def growing(self) -> tuple[tuple[float, float], ...]:
        """Return the pairs of first lengths [m] between which a crack grows to the longer one."""
        ends = [self.computed[0], *self.crossings, self.computed[1]]
        crossings_before = sum(at < self.start for at in self.crossings)
        grows = self.at_start > 1.0
        pieces = enumerate(pairwise(ends))
        return tuple(piece for n, piece in pieces if ((n - crossings_before) % 2 == 0) == grows)

    def __repr__(self) -> str:
        """Give :meth:`describe`."""
        return f"CrackArrest({self.describe()})"

    def describe(self) -> str:
        """Verdict, from which length it holds, what others would do, and numbers with errors."""
        return "; ".join(self.notes())

    def summary(self) -> str:
        """Return :meth:`describe` with a line for each fact."""
        return wrap("\n".join(self.notes()))

    def notes(self) -> list[str]:
        """Give :meth:`describe` as a list, a fact each."""
        start, least = (
            f"dK/dK_th {with_error(value, error)}"
            for value, error in (
                (self.at_start, self.at_start_error),
                (self.margin, self.margin_error),
            )
        )
        begins = self.verdict == "dormant" or "dormant" in self.verdicts
        bars = [(value, error) for value, error in self._deciding() if error is not None]
        sentences = [
            f"{self._alone()} from a length of {self.describe_start()}{self._end()}"
            f"{self._unsure()}",
            *self.others(),
            *([f"{start} at that length"] if begins else []),
            *([] if self.verdict == "dormant" else [f"least {least} at {um(self.margin_at)}"]),
        ]
        if any(error >= of > 0.0 for of, error in bars):
            sentences.append("the error of K is as large as dK there")
        return [*sentences, *estimate_notes(self.estimate, has_range=self.lengths is not None)]

    def briefly(self) -> str:
        """Give the verdict in a few words, as figures have it."""
        marks = [UNDECIDED] if self.verdicts and not self.is_sure else []
        marks += ["estimate"] if self.estimate and self.length is None else []
        return self._alone() + (f" ({', '.join(marks)})" if marks else "")

    def describe_length(self) -> str:
        """Return the length at which the crack stops, with its range [um]."""
        if self.length is None:
            return "no length"
        if self.lengths is None:
            return f"{rough(1e6 * self.length)} um (estimate)"
        low, high = (1e6 * end for end in self.lengths)
        mark = " (estimate)" if self.estimate else ""
        return f"{with_range(1e6 * self.length, low, high)} um{mark}"

    def describe_start(self) -> str:
        """The first length [um], and whether shorter ones were computed."""
        shortest = self.start <= self.computed[0]
        return um(self.start) + (", the shortest computed" if shortest else "")

    def others(self) -> list[str]:
        """Describe the arrest of cracks of other first lengths, a sentence each."""
        sentences = []
        for low, high in self.growing:
            whole = high >= self.computed[1]
            if self.at_start > 1.0 and low <= self.start <= high:
                if low > self.computed[0]:
                    sentences.append(f"one shorter than {um(low)} would not grow")
            elif whole:
                sentences.append(f"one longer than {um(low)} would grow through all lengths")
            else:
                sentences.append(
                    f"one of {um(low)} to {um(high)} would grow, and stop at {um(high)}"
                )
        if not self.growing:
            sentences.append(f"nor would one of any length up to {um(self.computed[1])}")
        return sentences

    def _alone(self) -> str:
        """Return the sentence on this crack alone."""
        if self.verdict == "stops":
            return f"{WORDS['stops']} at {self.describe_length()}"
        return WORDS[self.verdict]

    def _end(self) -> str:
        """Return the sentence on where it ends."""
        return f", to {um(self.computed[1])}" if self.verdict == "grows" else ""

    def _unsure(self) -> str:
        """Return the sentence on a verdict that the errors could change."""
        if not self.verdicts or self.is_sure:
            return ""
        alternatives = [MAY[verdict] for verdict in self.verdicts if verdict != self.verdict]
        return f" ({UNDECIDED}{': it may ' if alternatives else ''}{' or '.join(alternatives)})"

    def _deciding(self) -> list[tuple[float, float | None]]:
        """Return the numbers that the verdict follows from, with their errors."""
        start = (self.at_start, self.at_start_error)
        least = (self.margin, self.margin_error)
        return [start] if self.verdict == "dormant" else [start, least]


@dataclass(frozen=True)
class CrackLife:
    """Cycles of growth, infinite where the rate goes to zero at arrest.

    Parameters
    ----------
    cycles : float
        Number of cycles; infinite for a crack that does not grow.
    length : float
        Where they end [m].
    stopped : bool
        Whether the crack stops there.
    arrest : CrackArrest
        What becomes of the crack, and its first length.
    low, high : float, optional
        Number of cycles with K_max more and less its error; None where K came without an error.
    estimate : str, optional
        Which numbers of the law of growth are estimates, in words.
    """

    cycles: float
    length: float
    stopped: bool
    arrest: CrackArrest
    low: float | None = None
    high: float | None = None
    estimate: str | None = None

    def __repr__(self) -> str:
        """Give :meth:`describe`, and what other first lengths do."""
        return f"CrackLife({'; '.join([self.describe(), *self.arrest.others()])})"

    def why_infinite(self) -> str | None:
        """Return why there is no finite number of cycles; None if there is."""
        if math.isfinite(self.cycles):
            return None
        if self.arrest.verdict == "dormant":
            return f"the crack does not grow from a length of {um(self.arrest.start)}"
        return f"the rate of growth goes to zero where the crack stops, at {um(self.length)}"

    def describe(self) -> str:
        """Cycles with their range, from which length and to which."""
        return "; ".join(self.notes())

    def notes(self) -> list[str]:
        """Give :meth:`describe` as a list, a fact each."""
        path_text = f"from {um(self.arrest.start)} to {um(self.length)}"
        path_text += ", where it stops" if self.stopped else ""
        if math.isinf(self.cycles):
            least = self.low is not None and math.isfinite(self.low)
            within = f" (within the error of K {rough(self.low or 0.0)} or more)"
            text = f"no number of cycles{within if least else ''}: {self.why_infinite()}"
        elif self.low is None or self.high is None:
            text = f"{rough(self.cycles)} cycles (estimate) {path_text}"
        else:
            text = f"{with_range(self.cycles, self.low, self.high)} cycles {path_text}"
        notes = self.arrest.estimate, self.estimate
        return [text, *estimate_notes(*notes, has_range=self.low is not None)]


if not TYPE_CHECKING:
    # A method within the class would let type checkers take any name.
    CrackArrest.__getattr__ = missing_attribute
    CrackLife.__getattr__ = missing_attribute
