"""Fatigue damage below a contact by a load history: Miner's sum on the worst plane.

The history is counted by rainflow. The states at the two ends of each loop come from a march of the
whole history, or from a table of few amplitudes (:mod:`pyfret.history.table`). Their stress gives
the value of a criterion on every plane, and a plane sums count/N. ::

    steel = fatigue.Materials()["steel_42CrMo4"]
    damage = fatigue.damage(scene, history, steel, "smith_watson_topper")
    damage.worst, damage.repeats
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret import _core
from pyfret._core import Scene
from pyfret._util.figures import Figured
from pyfret._util.labelled import Labelled
from pyfret._util.lazy import xr
from pyfret._util.numbers import format_number, um
from pyfret._util.window import wrap
from pyfret.fatigue.criteria import CriterionName
from pyfret.fatigue.cycle_section import sections_of_cycle
from pyfret.fatigue.damage_errors import damage_errors
from pyfret.fatigue.damage_law import BelowKnee, DamageLaw, damage_of_loops
from pyfret.fatigue.loop_damage import JudgedSection
from pyfret.fatigue.section import Materials, Section, SectionOptions
from pyfret.history.load_history import LoadHistory
from pyfret.history.scatter import record_scatter
from pyfret.history.states import states_of_march
from pyfret.history.table import HistoryTable
from pyfret.quantities import Lengths, Numbers, quantities
from pyfret.run.run import Run
from pyfret.saveable import Saveable

if TYPE_CHECKING:
    import os
    from collections.abc import Sequence

    from numpy.typing import NDArray
    from typing_extensions import Unpack

    from pyfret.history.spectrum import Spectrum

#: Note on a sum of blocks.
BLOCKS = "a sum of blocks, each on its own worst plane, without an effect of one block on another"

__all__ = ["BelowKnee", "Damage", "DamageLaw", "add_damages", "damage", "damage_of_loops"]


class Damage(Saveable, Labelled, Figured):
    """Miner's damage by a load history on a section below a contact.

    ``dataset`` has over (depth, x) or (depth, y) the ``damage`` of one pass of the history on the
    worst plane, and the ``normal`` of this plane. Points of layers without a material are NaN. Over
    ``loop`` it has ``range``, ``mean`` and ``count`` of the loops, and their ``part`` in the damage
    of the worst point.
    """

    figure = "damage_map"

    @property
    def worst(self) -> float:
        """Largest damage of one pass of the history."""
        return float(self.dataset.damage.max())

    @property
    def place(self) -> tuple[float, float, float]:
        """Place (x, y, z) of the largest damage [m]."""
        x, y, z = self.dataset.attrs["place"]
        return float(x), float(y), float(z)

    @property
    def repeats(self) -> float:
        """Passes of the history until a crack has started, where Miner's sum reaches 1."""
        return 1.0 / self.worst if self.worst > 0.0 else math.inf

    @property
    def error(self) -> float:
        """Error of the largest damage: the sum of :attr:`errors`."""
        return math.fsum(self.errors.values())

    @property
    def errors(self) -> dict[str, float]:
        """Errors of the largest damage by their sources.

        ``cells`` of the grid, ``increments`` of the path, other ``planes``. For a table of few
        amplitudes also ``amplitudes`` and ``classes`` of loops, and ``memory`` where the rule of
        memory is an approximation.
        """
        names = str(self.dataset.attrs["error_sources"]).split(", ")
        return dict(zip(names, np.ravel(self.dataset.attrs["errors"]).tolist(), strict=True))

    @property
    def notes(self) -> list[str]:
        """Notes on the numbers: rule of counting, law below the knee, the table."""
        return [line for line in str(self.dataset.attrs["notes"]).split("\n") if line]

    @property
    def compressive(self) -> int:
        """Number of rows of loops without tension on the worst plane."""
        return int(self.dataset.compressive.sum())

    @property
    def record_scatter(self) -> float | None:
        """Standard deviation of the damage of one record over its mean; None: no spectrum."""
        scatter = self.dataset.attrs.get("record_scatter")
        return None if scatter is None else float(scatter)

    def contributions(self, bins: int = 16) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return edges of amplitude, and the part of the damage that loops in between have."""
        d = self.dataset
        amplitude = 0.5 * d["range"].values
        edges = np.linspace(0.0, float(amplitude.max()) * (1.0 + 1e-9), bins + 1)
        parts, _ = np.histogram(amplitude, edges, weights=d.part.values)
        return edges, parts / max(float(d.part.sum()), 1e-300)

    @property
    def worst_text(self) -> str:
        """The largest damage with its error; with an upper bound where the error exceeds it."""
        if self.error > self.worst > 0.0:
            return f"{_core.rough(self.worst)}, at most {_core.rough(self.worst + self.error)}"
        return _core.with_error(self.worst, self.error)

    @property
    def _repeats_text(self) -> str:
        """The passes of the history, with the fewest where the error exceeds the damage."""
        passes = f"{_core.rough(self.repeats)} passes"
        if self.error > self.worst > 0.0:
            return f"{passes}, at least {_core.rough(1.0 / (self.worst + self.error))},"
        return passes

    def summary(self) -> str:
        """Describe the damage: how much, where, the passes to a crack, notes."""
        x, y, z = self.place
        worst = self.worst_text
        if self.worst == 0.0:
            lines = ["no damage"]
        else:
            lines = [
                f"damage {worst} in one pass of the history, at x = {um(x)}, y = {um(y)}, "
                f"z = {um(z)}",
                f"{self._repeats_text} until a crack has started",
            ]
        parts = [
            f"{name} {_core.rough(100.0 * error / self.worst)} %"
            for name, error in self.errors.items()
            if self.worst > 0.0 and error > 5e-4 * self.worst
        ]
        if parts:
            lines.insert(1, f"error of the damage: {', '.join(parts)}")
        duration = self.dataset.attrs.get("duration")
        if duration and self.worst > 0.0:
            hours = float(duration) * self.repeats / 3600.0
            lines[-1] += f", {_core.rough(hours)} h"
        return wrap("\n".join([*lines, *self.notes]))

    __repr__ = summary


@quantities
def damage(
    contact: Run | Scene,
    history: LoadHistory,
    materials: Materials,
    criterion: CriterionName,
    z: Lengths | None = None,
    *,
    law: DamageLaw | None = None,
    table: HistoryTable | None = None,
    store: str | os.PathLike[str] | None = None,
    progress: bool = True,
    **section: Unpack[SectionOptions],
) -> Damage:
    """Sum the fatigue damage of a load history below a contact, on the worst plane of every point.

    Parameters
    ----------
    contact : Scene or Result
        The contact: a table of few amplitudes is marched. Or the result of ``fret.solve(scene,
        history)``, the march of the whole history.
    history : LoadHistory
        The history.
    materials : Material or sequence of Material or None
        Material of the substrate, or one for each layer, as in :func:`life`.
    criterion : str
        One of :data:`pyfret.fatigue.CRITERIA`. Criteria with a limit need ``law.exponent``.
    z : array, optional
        Depths [m] (default: chosen by layer).
    law : DamageLaw, optional
        The curve of lives below its knee (default: Haibach, knee at 1e7 cycles). It is printed.
    table : HistoryTable, optional
        The table of the same contact and history, where it is at hand.
    store : path, optional
        Folder that keeps the runs of the table. A call that was interrupted goes on from there, to
        the same bits.
    progress : bool
        Whether to draw a progress bar.
    **section
        As in :func:`life`: ``x`` or ``y``, ``azimuth``, ``body_number``, ``residual``.

    Raises
    ------
    ValueError
        A force beyond sliding, a criterion without lives, a result of another history.
    """
    law = law or DamageLaw()
    if isinstance(contact, Scene):
        made = table or HistoryTable.build(contact, history, store=store, progress=progress)
        run, states, notes = made.run, made.loop_states(), made.notes
        rule = str(made.loops.dataset.attrs["rule"])
    else:
        made, run, loops = None, contact, history.count()
        states, notes = states_of_march(run, history, loops), []
        rule = str(loops.dataset.attrs["rule"])
    options = {**section, "cycle": None}
    first, *_ = sections_of_cycle(run, Section(**options))  # type: ignore[arg-type]
    judged = JudgedSection(run, first, materials, criterion, z, law)
    dataset = judged.damage_of(states)
    errors = damage_errors(judged, states, dataset, made)
    del dataset.attrs["missed"]
    notes = [rule, law.text(), *notes, *judged.notes_on(dataset)]
    attrs: dict[str, Any] = {
        "criterion": criterion,
        "channel": history.channel,
        "error_sources": ", ".join(errors),
        "errors": list(errors.values()),
        "notes": "\n".join(notes),
    }
    if history.duration is not None:
        attrs["duration"] = history.duration
    if history.spectrum is not None and history.duration is not None:
        scatter = scatter_of_record(dataset, history.spectrum, history.duration)
        attrs["record_scatter"] = scatter
        attrs["notes"] += (
            f"\nthe damage of one record of {format_number(history.duration)} s scatters by "
            f"{_core.rough(100.0 * scatter)} % (standard deviation)"
        )
    return Damage(dataset.assign_attrs(attrs))


def scatter_of_record(dataset: xr.Dataset, spectrum: Spectrum, duration: float) -> float:
    """Return the standard deviation of the damage of one record, over its mean."""
    count, part = dataset["count"].values, dataset["part"].values
    single = np.divide(part, count, out=np.zeros_like(part), where=count > 0.0)
    return record_scatter(spectrum, 0.5 * dataset["range"].values, count, single, duration)


@quantities
def add_damages(damages: Sequence[Damage], passes: Numbers) -> Damage:
    """Add the damage of blocks at every point, such as blocks of a history between blocks of wear.

    The worst point of the sum may differ from the worst points of the blocks, since wear moves it.

    Parameters
    ----------
    damages : sequence of Damage
        Damage of one pass of each block, on the same section: the same ``x`` or ``y``, and ``z``.
    passes : array
        Passes of each block.

    Returns
    -------
    Damage
        Of all passes together. Each block counts on its own worst plane, so that the sum is never
        too small. The loops of all blocks follow one another, each with its part at the worst point
        of its block.
    """
    blocks = list(damages)
    counts = np.ravel(np.asarray(passes, dtype=float))
    if not blocks or len(blocks) != counts.size:
        raise ValueError(f"{len(blocks)} damages and {counts.size} passes: must be as many")
    if not (np.isfinite(counts) & (counts >= 0.0)).all():
        raise ValueError("passes: must be 0 or more")
    first = blocks[0].dataset
    fields = [block.dataset.damage for block in blocks]
    for n, field in enumerate(fields):
        if field.dims != first.damage.dims or not all(
            np.allclose(field[name], first.damage[name], rtol=1e-9, atol=0.0)
            for name in (*field.dims, "z")
            if name in field.coords
        ):
            raise ValueError(
                f"damages[{n}]: is on another section: must have the places and depths of the first"
            )
    total = first.damage.copy(data=sum(n * f.values for n, f in zip(counts, fields, strict=True)))
    row, column = np.unravel_index(int(np.nanargmax(total.values)), total.shape)
    leading = int(
        np.argmax([n * f.values[row, column] for n, f in zip(counts, fields, strict=True)])
    )
    loops = xr.concat(
        [
            block.dataset[["range", "mean", "count", "part", "value", "compressive"]].assign(
                count=n * block.dataset["count"], part=n * block.dataset.part
            )
            for n, block in zip(counts, blocks, strict=True)
        ],
        dim="loop",
    )
    x, y, _ = blocks[leading].place
    along, depth = str(total.dims[1]), float(total.z.values[row])
    position = float(total[along].values[column])
    point = [position if along == "x" else x, position if along == "y" else y, depth]
    if along == "s":
        point = [float(np.ravel(total[axis].values)[column]) for axis in ("x", "y")] + [depth]
    names = list(dict.fromkeys(name for block in blocks for name in block.errors))
    errors = [
        sum(n * block.errors.get(name, 0.0) for n, block in zip(counts, blocks, strict=True))
        for name in names
    ]
    attrs: dict[str, Any] = {
        **first.attrs,
        "place": point,
        "error_sources": ", ".join(names),
        "errors": [float(error) for error in errors],
        "notes": "\n".join(
            dict.fromkeys([*(note for block in blocks for note in block.notes), BLOCKS])
        ),
    }
    attrs.pop("duration", None)
    attrs.pop("record_scatter", None)
    dataset = loops.assign(damage=total, normal=blocks[leading].dataset.normal)
    return Damage(dataset.assign_attrs(attrs))
