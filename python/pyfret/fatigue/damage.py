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
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeAlias, get_args

import numpy as np

from pyfret import _core
from pyfret._core import Assessment, Criterion, Scene
from pyfret._util.arrays import number
from pyfret._util.figures import Figured
from pyfret._util.labelled import Labelled
from pyfret._util.lazy import xr
from pyfret._util.numbers import format_number, um
from pyfret.fatigue.cycle_section import choose_depths, section_body, sections_of_cycle
from pyfret.fatigue.cycles import history as stress_history
from pyfret.fatigue.section import Materials, Section, SectionOptions, for_each_layer
from pyfret.history.ladder import follow_channels
from pyfret.history.load_history import LoadHistory
from pyfret.history.loops import CountedLoops
from pyfret.history.table import (
    HistoryTable,
    LoopStates,
    StretchCheck,
    branch_ends,
    loops_as_rows,
    marched_weights,
)
from pyfret.quantities import Lengths, Numbers, quantities
from pyfret.run.run import Run
from pyfret.saveable import Saveable

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from numpy.typing import NDArray
    from typing_extensions import Unpack

    from pyfret._core import Elastic
    from pyfret.fatigue.criteria import CriterionName
    from pyfret.subsurface.line import Line

__all__ = ["BelowKnee", "Damage", "DamageLaw", "damage", "damage_of_loops"]

#: Laws of the curve of lives below its knee.
BelowKnee: TypeAlias = Literal["original", "elementary", "haibach"]
LAWS = {
    "original": "loops below the knee do no damage (Miner, original)",
    "elementary": "the curve goes on below the knee with its slope (elementary)",
    "haibach": "below the knee the curve goes on with the exponent 2 m - 1 (Haibach)",
}
#: Error of the damage by the memory of a contact over the difference of one stretch, which is a
#: sample of it. Of six contacts (coated, bulk stress out of phase) the errors are 0.56 to 1.64
#: times the difference.
COVER = 2.0


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
        """The law in words."""
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
        """Error of the largest damage.

        It covers other planes (no plane has more), and for a table the memory of the contact.
        """
        return float(self.dataset.attrs["error"])

    @property
    def notes(self) -> list[str]:
        """Notes on the numbers: rule of counting, law below the knee, the table."""
        return [line for line in str(self.dataset.attrs["notes"]).split("\n") if line]

    @property
    def compressive(self) -> int:
        """Number of rows of loops without tension on the worst plane."""
        return int(self.dataset.compressive.sum())

    def contributions(self, bins: int = 16) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return edges of amplitude, and the part of the damage that loops in between have."""
        d = self.dataset
        amplitude = 0.5 * d["range"].values
        edges = np.linspace(0.0, float(amplitude.max()) * (1.0 + 1e-9), bins + 1)
        parts, _ = np.histogram(amplitude, edges, weights=d.part.values)
        return edges, parts / max(float(d.part.sum()), 1e-300)

    def summary(self) -> str:
        """Describe the damage: how much, where, the passes to a crack, notes."""
        x, y, z = self.place
        worst = _core.with_error(self.worst, self.error)
        if self.worst == 0.0:
            lines = ["no damage"]
        else:
            lines = [
                f"damage {worst} in one pass of the history, at x = {um(x)}, y = {um(y)}, "
                f"z = {um(z)}",
                f"{_core.rough(self.repeats)} passes until a crack has started",
            ]
        duration = self.dataset.attrs.get("duration")
        if duration and self.worst > 0.0:
            hours = float(duration) * self.repeats / 3600.0
            lines[-1] += f", {_core.rough(hours)} h"
        return "\n".join([*lines, *self.notes])

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
        made = table or HistoryTable.build(contact, history, progress=progress)
        run, states, notes = made.run, made.loop_states(), made.notes
        rule, check = str(made.loops.dataset.attrs["rule"]), made.check
    else:
        run, loops = contact, history.count()
        states, notes, check = states_of_march(run, history, loops), [], None
        rule = str(loops.dataset.attrs["rule"])
    options = {**section, "cycle": None}
    first, *_ = sections_of_cycle(run, Section(**options))  # type: ignore[arg-type]
    judged = Judged(run, first, materials, criterion, z, law)
    dataset = judged.damage_of(states)
    error = float(dataset.attrs.pop("missed"))
    if check is not None:
        relative = judged.compare(check)
        notes = [*notes, f"... and by {relative:.1e} in damage"]
        error += COVER * relative * float(dataset.damage.max())
    notes = [rule, law.text(), *notes, *judged.notes_on(dataset)]
    attrs = {
        "criterion": criterion,
        "channel": history.channel,
        "error": error,
        "notes": "\n".join(notes),
    }
    if history.duration is not None:
        attrs["duration"] = history.duration
    return Damage(dataset.assign_attrs(attrs))


def states_of_march(run: Run, history: LoadHistory, loops: CountedLoops) -> LoopStates:
    """Return the states at the ends of the loops of a march of the whole history.

    Raises
    ------
    ValueError
        The run is no march of the history.
    """
    if not history.is_series:
        return states_of_cycle(run, history, loops)
    places = history.turns()
    before = len(run.scene.path.branches) - places.size
    branches = run.scene.path.branches[max(before, 0) :]
    values = [getattr(branch, history.channel) for branch in branches]
    same = before >= 0 and all(
        value is not None and math.isclose(value, expected, rel_tol=1e-9, abs_tol=1e-12)
        for value, expected in zip(
            values, history.channels[history.channel][places].tolist(), strict=False
        )
    )
    if not same:
        raise ValueError(
            "the result is no march of this history: give fret.solve(scene, history), or the scene"
        )
    ends = branch_ends(run)
    d = loops.dataset
    samples = [np.searchsorted(places, d[name].values.astype(int)) for name in ("first", "last")]
    turns = follow_channels(history).turns
    weights, increments = marched_weights(run, (samples[0], samples[1]), before, ends, turns=turns)
    return LoopStates(loops_as_rows(loops), weights, increments)


def states_of_cycle(run: Run, history: LoadHistory, loops: CountedLoops) -> LoopStates:
    """Return the states of loops of one amplitude by the last closed cycle of a run."""
    cycles = run.loops()
    rows = loops_as_rows(loops)
    channel = run.dataset.get(history.channel)
    if cycles.sizes["cycle"] == 0 or channel is None or len(rows) != 1:
        raise ValueError(
            "the history has no order: give the scene, or for loops of one amplitude the result of "
            "one cycle of them"
        )
    last = cycles.isel(cycle=-1)
    branch = run.dataset.branch_of_increment.values
    saved = run.dataset.saved_increment.values
    inside = (branch >= int(last.first_branch)) & (branch <= int(last.last_branch))
    kept = np.array([n for n in run.dataset.increment.values[inside] if n in saved])
    values = channel.sel(increment=kept).values
    reach = 0.5 * float(np.ptp(values)), 0.5 * float(values.max() + values.min())
    expected = 0.5 * float(rows[0, 0]), float(rows[0, 1])
    if not np.allclose(reach, expected, rtol=1e-9, atol=1e-9 * expected[0]):
        raise ValueError(
            f"the cycle of the result has the amplitude {reach[0]:.6g} and the mean "
            f"{reach[1]:.6g}, and the loops have {expected[0]:.6g} and {expected[1]:.6g}: must be "
            "the same"
        )
    weights = np.eye(kept.size)[None]
    return LoopStates(rows, weights, kept)


class Judged:
    """A section of a run with the assessments of its layers."""

    def __init__(
        self,
        run: Run,
        section: Section,
        materials: Materials,
        criterion: CriterionName,
        z: Lengths | None,
        law: DamageLaw,
    ) -> None:
        self.run, self.section, self.law = run, section, law
        layers = len(section_body(run, section).coatings) + 1
        of_layers = for_each_layer(materials, layers, "material", "materials")
        body = section_body(run, section)
        if body.yields:
            raise ValueError(
                f"body{section.body_number}: yields, and loops of a history are elastic here: "
                "judge a cycle of it by result.life"
            )
        elastic = [*(coating.material for coating in body.coatings), body.substrate]
        self.assessments: list[Assessment | None] = [
            None if material is None else with_constants(material.assessment(criterion), constants)
            for material, constants in zip(of_layers, elastic, strict=True)
        ]
        self.depths, self.layers = choose_depths(run, section, z, of_layers, "material")

    def stress(self, run: Run) -> xr.DataArray:
        """Return the stress of the kept increments of a run: (increment, depth, place, 6)."""
        s = self.section
        line: Line = s.line
        depths = np.unique(np.array(self.depths))
        return stress_history(
            run,
            depths,
            x=line.x,
            y=line.y,
            azimuth=line.azimuth,
            body_number=s.body_number,
            cycle=None,
            residual=s.residual,
        )

    def _parts(
        self, stress: xr.DataArray, states: LoopStates, *, bounded: bool
    ) -> Iterator[tuple[int, NDArray[np.float64], Mapping[str, NDArray[np.float64]]]]:
        """Judge the depths of layers that have a material, one row of places at a time."""
        kept = np.searchsorted(stress.increment.values, states.increments)
        values = stress.values[kept]
        counts = np.ascontiguousarray(states.rows[:, 2])
        for n, layer in enumerate(stress.layer.values):
            assessment = self.assessments[int(layer)]
            if assessment is None:
                continue
            of_loops = np.einsum("lmi,ipc->lmpc", states.weights, values[:, n])
            fields = _core.damage_on(
                assessment,
                np.ascontiguousarray(of_loops),
                counts,
                below=self.law.below,
                knee=self.law.knee,
                exponent=self.law.exponent,
                bounded=bounded,
            )
            yield n, of_loops, fields

    def damage_of(self, states: LoopStates) -> xr.Dataset:
        """Return the fields of the damage, and the parts of the loops at the worst point."""
        stress = self.stress(self.run)
        _, depth, along, _ = stress.dims
        shape = (stress.sizes[depth], stress.sizes[along])
        field, normal = np.full(shape, np.nan), np.full((*shape, 3), np.nan)
        worst = (-1.0, 0, 0)
        for n, _, fields in self._parts(stress, states, bounded=False):
            field[n], normal[n] = fields["damage"], fields["normal"]
            k = int(field[n].argmax())
            if field[n, k] > worst[0]:
                worst = (float(field[n, k]), n, k)
        _, row, column = worst
        point = stress.isel({depth: [row], along: [column]})
        _, of_loops, fields = next(self._parts(point, states, bounded=True))
        n_worst = fields["normal"][0]
        s_n = normal_stress(of_loops[:, :, 0], n_worst)
        closed = (s_n <= 0.0).all(axis=1) & (states.rows[:, 2] > 0.0)
        coords = {name: c for name, c in stress.coords.items() if set(c.dims) <= {depth, along}}
        rows = states.rows
        return xr.Dataset(
            {
                "damage": (
                    (depth, along),
                    field,
                    {"units": "1", "long_name": "damage of one pass of the history"},
                ),
                "normal": (
                    (depth, along, "axis"),
                    normal,
                    {"units": "1", "long_name": "normal of the worst plane"},
                ),
                "range": ("loop", rows[:, 0], {"long_name": "range of the loop"}),
                "mean": ("loop", rows[:, 1], {"long_name": "mean of the loop"}),
                "count": ("loop", rows[:, 2], {"units": "1", "long_name": "number of loops"}),
                "part": (
                    "loop",
                    fields["parts"][0],
                    {"units": "1", "long_name": "damage of the loops at the worst point"},
                ),
                "value": (
                    "loop",
                    fields["values"][0],
                    {"long_name": "value of the criterion on the worst plane"},
                ),
                "compressive": (
                    "loop",
                    closed,
                    {"units": "1", "long_name": "no tension on the worst plane in the loop"},
                ),
            },
            coords={**xr.Dataset(coords=coords).coords, "axis": ["x", "y", "z"]},
            attrs={
                "place": place_of(point, self.section),
                "missed": float(fields["missed"][0]),
                **{k: v for k, v in self.run.dataset.attrs.items() if k in ("a_H", "p_H")},
            },
        )

    def notes_on(self, dataset: xr.Dataset) -> list[str]:
        """Notes on loops without tension, and on loops that an order would change."""
        notes = []
        closed = int(dataset.compressive.sum())
        if closed:
            notes.append(
                f"{closed} of {dataset.sizes['loop']} rows of loops have no tension on the worst "
                "plane"
            )
        return notes

    def compare(self, check: StretchCheck) -> float:
        """Return the difference of the damage of a stretch, by its march and by the table."""
        marched = self.peak_of(check.run, check.states)
        by_table = self.peak_of(self.run, check.table_states)
        return abs(by_table - marched) / max(marched, 1e-300) if marched or by_table else 0.0

    def peak_of(self, run: Run, states: LoopStates) -> float:
        """Return the largest damage of the section by the loops of a run."""
        stress = self.stress(run)
        return max(
            float(f["damage"].max()) for _, _, f in self._parts(stress, states, bounded=False)
        )


def with_constants(assessment: Assessment, elastic: Elastic) -> Assessment:
    """Return an assessment whose strains follow from the stress by the constants of the scene."""
    numbers = dict(assessment.criterion.numbers)
    scene_numbers = {"E": elastic.E, "nu": elastic.nu}
    changed = {name: value for name, value in scene_numbers.items() if name in numbers}
    if not changed or not math.isfinite(elastic.E):
        return assessment
    criterion = Criterion(assessment.criterion.name, **{**numbers, **changed})
    return Assessment(criterion, limit=assessment.limit, curve=assessment.curve)


def normal_stress(stress: NDArray[np.float64], n: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the normal stress on a plane; the last axis holds xx, yy, zz, xy, xz, yz."""
    if np.isnan(n).any():
        return np.asarray(stress[..., :3].max(axis=-1))
    x, y, z = n
    weights = np.array([x * x, y * y, z * z, 2 * x * y, 2 * x * z, 2 * y * z])
    return np.asarray(stress @ weights)


def place_of(point: xr.DataArray, section: Section) -> list[float]:
    """Return x, y, z of a point of a section [m]."""
    along = str(point.dims[2])
    position, z = float(point[along].values[0]), float(point.z.values[0])
    if "x" in point.coords and "y" in point.coords:
        return [float(np.ravel(point[axis].values)[0]) for axis in ("x", "y")] + [z]
    if along == "x":
        return [position, float(section.line.y or 0.0), z]
    return [float(section.line.x or 0.0), position, z]
