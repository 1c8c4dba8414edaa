"""Questions about every candidate, and the numbers that answer them."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np

from pyfret import fracture
from pyfret._core import Scene, notes_on_materials
from pyfret._util.bounds import SIDES
from pyfret._util.lazy import xr
from pyfret._util.numbers import in_words, length
from pyfret.fatigue.cycles import cycle_increments
from pyfret.run.summary import directions
from pyfret.study.answer import Answer
from pyfret.study.measures import Reasoned
from pyfret.study.stresses import largest_of_sections, sample_together
from pyfret.wear.runs import solve_until_refused

if TYPE_CHECKING:
    from pyfret.result import Result
    from pyfret.study.candidate import Candidate, Duty
    from pyfret.wear.cycles import Cycles
    from pyfret.wear.result import WearResult

__all__ = ["NUMBERS", "QUESTIONS", "Answers", "Number", "Question"]


@dataclass(frozen=True)
class Number:
    """A number of the comparison."""

    #: Name in the table.
    title: str
    #: Unit in SI; empty for energies, which are per metre in line contacts.
    si: str
    #: Unit of the tables, and how much it is in SI.
    unit: str
    scale: float
    #: The better one of two: the smaller or the larger one.
    better: Literal["smaller", "larger"]
    #: Whether its error is a factor, for example for a life.
    logarithmic: bool = field(default=False, kw_only=True)
    #: Text for an infinite value.
    endless: str = field(default="no limit", kw_only=True)
    #: Whether an infinite value means that the run ended before, at the lower end of the range.
    ends_with_run: bool = field(default=False, kw_only=True)


#: Common settings of lives.
LIFE: dict[str, Any] = {"logarithmic": True, "endless": "endless"}
#: All numbers, in the order of the table.
NUMBERS: dict[str, Number] = {
    "tension": Number("largest tension", "Pa", "MPa", 1e6, "smaller"),
    "tension_in_substrate": Number("largest tension in the substrate", "Pa", "MPa", 1e6, "smaller"),
    "first_yield": Number("load factor of first yield", "1", "1", 1.0, "larger"),
    "film": Number("crack through the film, load over limit", "1", "1", 1.0, "smaller"),
    "interface": Number("interface, load over limit", "1", "1", 1.0, "smaller"),
    "crack": Number("crack in the substrate, load over limit", "1", "1", 1.0, "smaller"),
    "life_of_substrate": Number("life of the substrate", "cycles", "cycles", 1.0, "larger", **LIFE),
    "life_of_coating": Number("life of the coatings", "cycles", "cycles", 1.0, "larger", **LIFE),
    "safety_of_substrate": Number("safety factor of the substrate", "1", "1", 1.0, "larger"),
    "safety_of_coating": Number("safety factor of the coatings", "1", "1", 1.0, "larger"),
    "wear_through": Number(
        "coating worn through",
        "cycles",
        "cycles",
        1.0,
        "larger",
        **{**LIFE, "endless": "outlives the run", "ends_with_run": True},
    ),
    "worn_depth": Number("worn depth", "m", "um", 1e-6, "smaller"),
    "energy": Number("energy dissipated in a cycle", "", "uJ", 1e-6, "smaller"),
    "temperature": Number("largest rise of temperature", "K", "K", 1.0, "smaller"),
}

#: The answer to a question: numbers by name, places that belong to them, and, where the answer is
#: not whole, the reason.
Answered: TypeAlias = (
    "tuple[dict[str, Answer], dict[str, float]] | tuple[dict[str, Answer], dict[str, float], str]"
)


def no_notes(candidate: Candidate, duty: Duty) -> list[str]:
    """Return no notes."""
    return []


@dataclass(frozen=True)
class Question:
    """A question: its requirements, and the function that answers it."""

    #: Returns the missing data in words; nothing if the question can be answered.
    missing: Callable[[Candidate, Duty, Scene], str]
    #: The answer.
    ask: Callable[[Result, Candidate, Duty], Answered]
    #: Whether it needs the fields of the whole cycle.
    fields: bool = True
    #: Returns doubts of the answer, before the contact is solved.
    notes: Callable[[Candidate, Duty], list[str]] = field(default=no_notes, kw_only=True)


def nothing_missing(candidate: Candidate, duty: Duty, scene: Scene) -> str:
    """Return nothing, since no data are needed."""
    return ""


def branch_ends(result: Result) -> list[int]:
    """Return kept increments at branch ends of the last closed cycle, or of the path."""
    branch = result.dataset.branch_of_increment
    last = np.flatnonzero(np.diff(branch.values, append=branch.values[-1] + 1))
    kept_ends = set((last + 1).tolist()) & set(result.dataset.saved_increment.values.tolist())
    try:
        cycle = set(cycle_increments(result, -1).tolist())
    except ValueError:
        cycle = kept_ends
    return sorted(kept_ends & cycle) or sorted(kept_ends)


def tension(result: Result, candidate: Candidate, duty: Duty) -> Answered:
    """Find the largest principal stress of the body at the ends of the branches of the cycle."""
    last = candidate.layers - 1
    states = sample_together(
        [result.at(n) for n in branch_ends(result)], duty.body_number, candidate.residual
    )
    worst = largest_of_sections(states, "s_1")
    numbers = {"tension": Answer.from_error(worst.value, worst.error)}
    places = {
        "tension_x": worst.x,
        "tension_z": worst.z,
        "tension_layer": float(worst.layer),
    }
    in_substrate = worst if worst.layer == last else largest_of_sections(states, "s_1", last)
    numbers["tension_in_substrate"] = Answer.from_error(in_substrate.value, in_substrate.error)
    return numbers, places


def first_yield(result: Result, candidate: Candidate, duty: Duty) -> Answered:
    """Find the least load factor of first yield over the cycle, by von Mises' condition."""
    factors = result.load_factors(
        candidate.yield_stresses, body_number=duty.body_number, residual=candidate.residual
    )
    least = factors.least("von_mises")
    places = {"first_yield_layer": float(least.layer), "first_yield_z": least.z}
    return {"first_yield": Answer.from_error(least.value, least.error)}, places


def missing_yield_stress(candidate: Candidate, duty: Duty, scene: Scene) -> str:
    """Return the missing yield stress, in words."""
    return "" if any(s_y is not None for s_y in candidate.yield_stresses) else "s_y of a layer"


def adhesion(result: Result, candidate: Candidate, duty: Duty) -> Answered:
    """Compute load over limit of film, interface and substrate."""
    failure = fracture.first_to_fail(
        result,
        toughness=candidate.toughness,
        peel_strength=candidate.peel_strength,
        shear_strength=candidate.shear_strength,
        threshold=candidate.threshold,
        residual=candidate.residual,
        body_number=duty.body_number,
    )
    names = dict(zip(fracture.PARTS, ("film", "interface", "crack"), strict=True))
    # The change on coarser cells is added to all of them.
    return {
        names[part]: Answer.from_error(
            getattr(failure, part), failure.errors[part] or 0.0, least=0.0
        )
        for part in fracture.PARTS
    }, {}


def missing_limits(candidate: Candidate, duty: Duty, scene: Scene) -> str:
    """Return a missing coating or its missing limits, in words."""
    if candidate.layers == 1:
        return "a coating"
    limits = (candidate.toughness, candidate.threshold, candidate.peel_strength)
    if all(limit is None for limit in limits):
        return "toughness, peel_strength and shear_strength, or threshold"
    return ""


def life(result: Result, candidate: Candidate, duty: Duty) -> Answered:
    """Compute lives or safety factors of substrate and coatings, and their averaging distances.

    The stress is averaged over the critical distance of the material, where it has one, as for
    a single run. The range covers the error of this mean: the scatter of the material is the
    same for all candidates.
    """
    judged = result.life(
        candidate.layer_materials,
        duty.criterion,
        body_number=duty.body_number,
        residual=candidate.residual,
    )
    kind = "life" if judged.margin.name == "life" else "safety"
    substrate = candidate.layers - 1
    numbers: dict[str, Answer] = {}
    places: dict[str, float] = {}
    for part, layers in (
        ("substrate", [n for n in judged.layers if n == substrate]),
        ("coating", [n for n in judged.layers if n != substrate]),
    ):
        if layers:
            least = judged.least_margin(layers)
            name = f"{kind}_of_{part}"
            numbers[name] = Answer(least.best, least.low, least.high)
            places[f"{name}_L"] = least.L or 0.0
    return numbers, places


def notes_on_life(candidate: Candidate, duty: Duty) -> list[str]:
    """Return notes on the materials for the criterion of the lives, and on its mean stress."""
    notes = notes_on_materials(duty.criterion, candidate.body, candidate.layer_materials)
    for material in filter(None, candidate.layer_materials):
        note = material.assessment(duty.criterion).mean_stress_note(material)
        if note and note not in notes:
            notes.append(note)
    return notes


def missing_materials(candidate: Candidate, duty: Duty, scene: Scene) -> str:
    """Return missing materials or numbers of the criterion, in words."""
    if all(material is None for material in candidate.layer_materials):
        return "materials"
    for material in filter(None, candidate.layer_materials):
        try:
            material.assessment(duty.criterion)
        except ValueError as error:
            return str(error)
    return ""


def wear(result: Result, candidate: Candidate, duty: Duty) -> Answered:
    """Compute the cycles until the outermost coating is worn through, and the final depth.

    A run that leaves the grid gives what it reached: the coating lasts that many cycles or more.
    """
    assert duty.cycles is not None
    body1, body2 = duty.pair(candidate.wear, duty.other_wear)
    with TemporaryDirectory() as folder:
        run, ended = solve_until_refused(
            result.scene,
            Path(folder) / "wear.zarr",
            cycles=duty.cycles,
            cycling=duty.cycling,
            body1=body1,
            body2=body2,
            worn_through="go_on" if candidate.layers == 1 or layered(candidate.wear) else "stop",
        )
        part = float(run.depth_error[-1])
        depth = float(run.dataset[f"depth{duty.body_number}"][-1])
        reached = float(run.cycles[-1])
        numbers: dict[str, Answer] = {}
        if candidate.layers > 1:
            numbers["wear_through"] = worn_through(run, part, duty.body_number)
    if reached >= duty.cycles:
        numbers["worn_depth"] = Answer.from_error(depth, part * depth)
    if ended is None:
        return numbers, {}
    lost = (
        f"the run ended after {in_words(reached, 3)} of {in_words(duty.cycles, 3)} cycles, at a "
        f"worn depth of {length(depth)}: {ended}"
    )
    return numbers, {}, lost


def worn_through(run: WearResult, part: float, body_number: int) -> Answer:
    """Cycles to the end of the outermost coating; infinite where the run ended before.

    `part` is the error of the depths over the depths. The ends of the range are the cycles at which
    the depth with and without this error reaches the thickness.
    """

    def cycles_to(share: float) -> Cycles:
        """Return the cycles at which a share of the thickness is worn."""
        return run.cycles_to(part_of_coating=share, body_number=body_number)

    best, first = cycles_to(1.0), cycles_to(1.0 / (1.0 + part))
    low = first if first.beyond is None else first.beyond
    if math.isnan(best):
        return Answer(math.inf, float(low), math.inf)
    return Answer(float(best), min(float(low), float(best)), float(best) * (1.0 + part))


def layered(law: object) -> bool:
    """Check that every layer has its own law."""
    return isinstance(law, list)


def missing_law(candidate: Candidate, duty: Duty, scene: Scene) -> str:
    """Return a missing law of wear or number of cycles, in words."""
    return "wear" if candidate.wear is None else "cycles" if duty.cycles is None else ""


def energy(result: Result, candidate: Candidate, duty: Duty) -> Answered:
    """Return the energy that the last cycle dissipates."""
    loops = result.loops(direction=next(iter(directions(result)), "x"))
    value = float(loops.dissipated[-1]) if loops.sizes["cycle"] else math.nan
    return {"energy": Answer.from_error(value)}, {}


def temperature(result: Result, candidate: Candidate, duty: Duty) -> Answered:
    """Compute the largest rise of the surface temperature."""
    assert duty.frequency is not None
    conductors = duty.pair(candidate.conductor, duty.other_conductor)
    table = result.temperature(*conductors, frequency=duty.frequency)
    return {"temperature": Answer.from_error(float(table.attrs["maximum"]))}, {}


def missing_heat_data(candidate: Candidate, duty: Duty, scene: Scene) -> str:
    """Return missing conductors or the missing frequency, in words."""
    if scene.grid.plane_strain:
        return "a contact that is not in plane strain"
    needed = {
        "conductor": candidate.conductor,
        "other_conductor": duty.other_conductor,
        "frequency": duty.frequency,
    }
    return ", ".join(name for name, value in needed.items() if value is None)


#: All questions by name.
QUESTIONS: dict[str, Question] = {
    "tension": Question(nothing_missing, tension),
    "yield": Question(missing_yield_stress, first_yield),
    "adhesion": Question(missing_limits, adhesion),
    "life": Question(missing_materials, life, notes=notes_on_life),
    "wear": Question(missing_law, wear, fields=False),
    "energy": Question(nothing_missing, energy, fields=False),
    "temperature": Question(missing_heat_data, temperature),
}


#: Questions of which a part may be missing by what is known of a candidate.
MAY_LACK = ("adhesion",)


@dataclass(frozen=True)
class Answers:
    """A measure of a study: the answers of the candidate that the title of the scene names."""

    candidates: Mapping[str, Candidate]
    duty: Duty
    questions: tuple[str, ...]

    def __call__(self, result: Result) -> Reasoned:
        """Ask all questions that the candidate can answer; one without an answer has a reason."""
        candidate = self.candidates[result.scene.title]
        table: dict[str, float] = {}
        reasons: list[str] = []
        for name in self.questions:
            if QUESTIONS[name].missing(candidate, self.duty, result.scene):
                continue
            try:
                numbers, places, *lost = QUESTIONS[name].ask(result, candidate, self.duty)
            except Exception as error:
                reasons.append(f"{name}: {' '.join(str(error).split())}")
                continue
            reasons += [f"{name}: {why}" for why in lost]
            reasons += [
                f"{name}: the result has no {NUMBERS[number].title}"
                for number, answer in numbers.items()
                if math.isnan(answer.value) and name not in MAY_LACK
            ]
            for number, answer in numbers.items():
                table |= {f"{number}{side}": value for side, value in answer.sides()}
            table |= places
        energy = result.scene.grid.unit_of("J")
        arrays = {}
        for number, about in NUMBERS.items():
            for side, which in SIDES.items():
                attrs = {"units": about.si or energy, "long_name": f"{about.title}{which}"}
                name = f"{number}{side}"
                arrays[name] = xr.DataArray(table.get(name, math.nan), attrs=attrs)
        for name, (unit, meaning) in PLACES.items():
            attrs = {"units": unit, "long_name": meaning}
            arrays[name] = xr.DataArray(table.get(name, math.nan), attrs=attrs)
        return Reasoned(arrays, reasons)

    def needs_fields(self) -> bool:
        """Check whether the fields of all increments are needed."""
        return any(QUESTIONS[name].fields for name in self.questions)


#: Meaning of an averaging distance.
AVERAGING_DISTANCE = "critical distance that the stress is averaged over, for the margin"
#: Places that belong to numbers: unit and meaning.
PLACES = {
    "tension_x": ("m", "place of the largest tension"),
    "tension_z": ("m", "depth of the largest tension"),
    "tension_layer": ("1", "layer of the largest tension, from the surface down"),
    "first_yield_z": ("m", "depth of first yield"),
    "first_yield_layer": ("1", "layer of first yield, from the surface down"),
    **{
        f"{kind}_of_{part}_L": (
            "m",
            f"{AVERAGING_DISTANCE} of the {part}, 0 for the value at a point",
        )
        for kind in ("life", "safety")
        for part in ("substrate", "coating")
    },
}
