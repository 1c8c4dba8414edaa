"""Increments of a file of results: loads, modes and failed iterations, and the choice of one."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from pyfret._core import read_text
from pyfret._util.scene_warnings import warn
from pyfret.export.numbers import number

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

__all__ = ["FAILED", "StoredIncrement", "choose_increment", "mark_failure"]

#: Blocks that CalculiX writes of an iteration that did not converge: displacements and residual
#: forces, in a thermal step temperatures and fluxes (``storeresidual.f`` of ccx 2.20).
RESIDUAL = frozenset(("DISP", "FORC", "NDTEMP", "RFL"))
#: Kinds of increments that are read: loads by themselves, the others by their names.
FAILED = "failed iteration"
READ = ("load", "mode", "buckling mode", FAILED)
#: Part of a time by which two files may differ in it: digits that are written.
SAME_TIME = 2e-5


@dataclass
class StoredIncrement:
    """An increment of a file of results."""

    #: "load", "mode", "buckling mode", or the words for what is refused.
    kind: str
    #: Time, frequency or buckling factor.
    value: float
    #: Number of the step and of the increment in it, None if the file has neither.
    step: int | None = None
    number: int | None = None
    #: Number of a mode.
    mode: int | None = None
    #: Where a field stands, by its name.
    blocks: dict[str, Any] = field(default_factory=dict)

    @property
    def label(self) -> str:
        """Return the words that choose this increment."""
        if self.kind == "load":
            return f"time {self.value:g}"
        if self.mode is not None:
            return f"{self.kind} {self.mode}"
        return f"{self.kind} {self.value:g}"

    def is_same(self, second: StoredIncrement) -> bool:
        """Check that a block of another increment belongs to this one."""
        return (self.value, self.step, self.number, self.mode) == (
            *(second.value, second.step, second.number, second.mode),
        )

    def __str__(self) -> str:
        """The label with the number of the step."""
        return f"{self.label} (step {self.step})" if self.step is not None else self.label


def choose_increment(
    increments: Sequence[StoredIncrement], block: str, step: int | str | None, path: Path
) -> StoredIncrement:
    """Return the last increment under load with a field, or the one that `step` names.

    Refused are files whose last load has no such field, and iterations that did not converge.
    """
    increments = mark_failure(increments, path)
    if step is not None:
        return _named_increment(increments, block, step, path)
    loads = [increment for increment in increments if increment.kind in ("load", FAILED)]
    if not loads:
        kinds = ", ".join(str(increment) for increment in increments[:8]) or "nothing"
        choice = _choices(increments, block)
        raise ValueError(f"{path}: has no increment under load, but {kinds}{choice}")
    last = loads[-1]
    if last.kind == FAILED:
        raise ValueError(
            f"{path}: the run did not converge at time {last.value:g}: the displacements "
            f"there are from a failed iteration{_choices(loads[:-1], block)}"
        )
    if block not in last.blocks:
        raise ValueError(
            f"{path}: the last increment, {last}, has no block {block}: the step does not write "
            f"it, or the run ended there{_choices(loads[:-1], block)}"
        )
    if is_bare(last) and _end_of_status(path) is None:
        warn(
            f"{path}: the increment at {last} has displacements and forces only, like an iteration "
            f"that did not converge; {path.with_suffix('.sta').name} beside it would decide"
        )
    return last


def is_bare(increment: StoredIncrement) -> bool:
    """Check that an increment holds what CalculiX writes of a failed iteration, and no more."""
    names = increment.blocks.keys()
    return names <= RESIDUAL and bool(names & {"FORC", "RFL"})


def mark_failure(increments: Sequence[StoredIncrement], path: Path) -> list[StoredIncrement]:
    """Return the increments, the last load marked if its iteration failed.

    The ``.sta`` file decides, if it is of the same run. Without it an iteration counts as failed
    if it has displacements and residuals only, and increments before it have more.
    """
    marked = list(increments)
    last = next((n for n in reversed(marked) if n.kind == "load"), None)
    if last is None:
        return marked
    end = _end_of_status(path)
    if end is not None and end[0] >= last.value * (1.0 - SAME_TIME):
        time, failed = end
        if failed and time > last.value * (1.0 + SAME_TIME):
            marked.append(StoredIncrement(FAILED, time))
        elif failed:
            marked[marked.index(last)] = replace(last, kind=FAILED)
        return marked
    earlier = {name for n in marked if n.kind == "load" for name in n.blocks}
    if is_bare(last) and earlier - last.blocks.keys():
        marked[marked.index(last)] = replace(last, kind=FAILED)
    return marked


def _named_increment(
    increments: Sequence[StoredIncrement], block: str, step: int | str, path: Path
) -> StoredIncrement:
    """Return the increment of a label, or the last one of a step's number."""
    if isinstance(step, str):
        matching = [n for n in increments if step in (n.label, str(n))]
    else:
        matching = [n for n in increments if n.step == step]
    whole = [n for n in matching if block in n.blocks]
    if not whole:
        problem = f"no block {block} there" if matching else "no such increment"
        raise ValueError(f"{path}: step = {step!r}: {problem}{_choices(increments, block)}")
    if isinstance(step, str) and len(whole) > 1:
        listed = ", ".join(repr(str(n)) for n in whole)
        raise ValueError(f"{path}: step = {step!r}: there are {listed}")
    if not isinstance(step, str) and any(n.kind != "load" for n in whole):
        raise ValueError(f"{path}: step = {step}: is no step of loads{_choices(whole, block)}")
    if whole[-1].kind not in READ:
        raise ValueError(f"{path}: {whole[-1]}: amplitudes of a vibration are not read")
    return whole[-1]


def _choices(increments: Sequence[StoredIncrement], block: str) -> str:
    """Return the last increments that could be chosen, for a message."""
    labels = [repr(n.label) for n in increments if block in n.blocks and n.kind in READ]
    return "; step= chooses one of " + ", ".join(labels[-4:]) if labels else ""


def _end_of_status(path: Path) -> tuple[float, bool] | None:
    """Return the time of the last attempt in the ``.sta`` file beside the results, and its failure.

    Its columns are step, increment, attempt, iterations, total time, time in the step and length of
    the increment. A failed attempt has a U and the time before it.
    """
    status = path.with_suffix(".sta")
    if not status.is_file():
        return None
    rows = [line.split() for line in read_text(status).splitlines()]
    rows = [words for words in rows if len(words) == 7 and words[0].isdigit()]
    if not rows:
        return None
    failed = rows[-1][2].endswith("U")
    try:
        return number(rows[-1][4]) + (number(rows[-1][6]) if failed else 0.0), failed
    except ValueError:
        return None
