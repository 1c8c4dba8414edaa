"""Numbers to keep of the result of a point."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from pyfret import fracture, wear
from pyfret._core import TOO_FEW_INCREMENTS
from pyfret._util.bounds import split
from pyfret._util.keywords import nearest_names
from pyfret._util.lazy import xr
from pyfret._util.numbers import um
from pyfret.fatigue.criteria import CriterionName
from pyfret.fatigue.section import Materials
from pyfret.quantities import (
    Angle,
    CrackLength,
    FrictionCoefficient,
    InSI,
    LayerStresses,
    Length,
    Strength,
    Toughness,
    by_default,
    part,
    quantities,
)
from pyfret.run.summary import directions
from pyfret.study.answer import NO_ANSWER, Answer, estimate
from pyfret.study.identity import code_checksum
from pyfret.study.stresses import LargestStress, stress_measure
from pyfret.subsurface.tensor import LABELS

if TYPE_CHECKING:
    from pyfret.result import Result

__all__ = [
    "MEASURES",
    "Arrest",
    "Cracking",
    "FirstToFail",
    "LargestStress",
    "Measure",
    "Reasoned",
    "WornDepth",
    "evaluate_measures",
]

#: A name of :data:`MEASURES`, or a function of the result.
Measure: TypeAlias = "str | Callable[[Result], Any]"


def cycle_measure(name: str) -> Callable[[Result], float | Answer]:
    """Make a measure: a number of the last closed cycle with its error; NaN without a cycle."""

    def measure(result: Result) -> float | Answer:
        """Return the number with its error."""
        loops = result.loops(direction=next(iter(directions(result)), "x"))
        last = {
            key: float(column[-1]) if column.size else math.nan for key, column in loops.items()
        }
        error = last.get(f"{name}_error")
        return last[name] if error is None else Answer.from_error(last[name], error, least=0.0)

    return measure


def path_measure(name: str, reduce: Callable[[xr.DataArray], Any]) -> Callable[[Result], float]:
    """Make a measure: a scalar over the path, reduced to a number."""
    return lambda result: float(reduce(result.dataset[name]))


def half_length(result: Result) -> float:
    """Return the contact radius at the end, for a line contact half its width."""
    d = result.dataset
    return float(d["half_width" if "half_width" in d else "contact_radius"][-1])


#: Ready measures: unit, meaning, function of the result.
MEASURES: dict[str, tuple[str, str, Callable[[Result], float | Answer]]] = {
    "loop_energy": ("J", "energy dissipated in the last cycle", cycle_measure("dissipated")),
    "energy_ratio": ("1", "energy ratio of the last cycle", cycle_measure("energy_ratio")),
    "sliding_ratio": ("1", "sliding ratio of the last cycle", cycle_measure("sliding_ratio")),
    "stiffness": ("N/m", "stiffness right after the reversals", cycle_measure("stiffness")),
    "T": ("N", "half the range of the force", cycle_measure("T")),
    "delta": ("m", "half the range of the shift", cycle_measure("delta")),
    "regime": (
        "1",
        "last cycle: 0 no contact, 1 full stick, 2 partial slip, 3 gross slip",
        cycle_measure("status"),
    ),
    "stick_ratio": (
        "1",
        "stick ratio at the end of the path",
        path_measure("stick_ratio", lambda v: v[-1]),
    ),
    "least_stick_ratio": (
        "1",
        "smallest stick ratio of the path",
        path_measure("stick_ratio", lambda v: v.min()),
    ),
    "contact_radius": (
        "m",
        "contact radius, of a line contact half the width, at the end",
        half_length,
    ),
    "half_width": (
        "m",
        "half the width of a line contact, else the contact radius, at the end",
        half_length,
    ),
    "dissipated": (
        "J",
        "energy dissipated over the path",
        path_measure("dissipated", lambda v: v.sum()),
    ),
    "p_max": ("Pa", "largest pressure of the path", path_measure("p_max", lambda v: v.max())),
    "q_max": ("Pa", "largest shear traction of the path", path_measure("q_max", lambda v: v.max())),
    **{
        name: (
            "Pa",
            f"largest {LABELS[name][1].removeprefix('largest ')} in body 2",
            stress_measure(name),
        )
        for name in ("von_mises", "tresca", "s_1")
    },
    **{
        name: (
            "Pa",
            f"largest {LABELS[name][1].removeprefix('largest ')} of both bodies",
            stress_measure(name),
        )
        for name in ("interface_shear", "interface_peel")
    },
}
#: Ends of refusals of words for numbers that need more than the result.
OF_CLASSES = {
    **dict.fromkeys(
        ("life", "lives", "cycles", "fatigue", "safety_factor", "margin", "crack_depth"),
        '; a life needs a material: fret.study.Cracking("Ti-6Al-4V", "smith_watson_topper") has '
        "the life, fret.study.Cracking with another criterion the safety factor",
    ),
    **dict.fromkeys(
        ("wear", "worn_depth", "worn_volume", "depth", "volume", "wear_depth"),
        "; wear needs a law: fret.study.WornDepth(cycles=1e5, body2=fret.wear.Archard(k=1e-15))",
    ),
    **dict.fromkeys(
        ("arrest", "crack", "crack_arrest", "arrest_margin"),
        '; a crack needs a threshold: fret.study.Arrest("Al 7075")',
    ),
    **dict.fromkeys(
        ("max_stress", "largest_stress", "peak_stress", "stress"),
        '; the nearest is von_mises, tresca, s_1, or fret.study.LargestStress("s_xx")',
    ),
}
#: Measures of the last closed cycle.
OF_CYCLE = (
    "loop_energy",
    "energy_ratio",
    "sliding_ratio",
    "stiffness",
    "T",
    "delta",
    "regime",
)


#: Measures that are codes: they have no error.
CODES = ("regime", "first")


#: Scatter that ranges of a study exclude, since points of one material are compared.
SCATTER_OF_K = "the scatter of the wear coefficient, which WearResult.range_of_cycles() has"
SCATTER_OF_MATERIAL = "the scatter of the material, which Life.range has"


@part()
class WornDepth(wear.Wear):
    """A measure: wear by many cycles, from :func:`pyfret.wear.solve` on the scene of the point.

    Gives ``worn_volume1``, ``worn_volume2`` [m^3], ``worn_depth1``, ``worn_depth2`` [m], and, where
    a body is coated, ``coating_life1``, ``coating_life2`` [cycles], NaN for one that outlives the
    run. Each has its range, such as ``worn_depth1_low`` and ``worn_depth1_high``, from
    ``depth_error`` and ``volume_error``, the relative errors. The lives come from
    :meth:`pyfret.wear.WearResult.range_of_cycles` with ``scatter=1``: the scatter of the wear
    coefficient is no part of a comparison. ``range_of_cycles()`` adds a factor of 3 for it.

    Parameters
    ----------
    part : float
        Part of the outermost coating's thickness at which its life ends (default 1).
    cycles, body1, body2, cycling, ...
        The settings of :class:`pyfret.wear.Wear`.
    """

    part: float = field(default=1.0, kw_only=True)

    def __call__(self, result: Result) -> dict[str, xr.DataArray]:
        """Wear the scene of the result."""
        settings = {f.name: getattr(self, f.name) for f in fields(wear.Wear)}
        run = wear.solve(result.scene, wear.Wear(**settings), progress=False)
        worn = run.dataset
        numbers: dict[str, xr.DataArray] = {}
        for quantity, unit in (("volume", "m^3"), ("depth", "m")):
            part = float(worn[f"{quantity}_error"][-1])
            for body in (1, 2):
                value = float(worn[f"{quantity}{body}"][-1])
                answer = Answer.from_error(value, part * value)
                numbers |= answer.arrays(
                    f"worn_{quantity}{body}", unit, f"worn {quantity} of body {body}"
                )
        numbers["depth_error"] = worn["depth_error"][-1]
        for body in (1, 2):
            if (result.scene.body1 if body == 1 else result.scene.body2).coatings:
                # Candidates are compared: the scatter of a coefficient is left to the reader.
                life = run.range_of_cycles(scatter=1.0, part_of_coating=self.part, body_number=body)
                ends = (life.best, life.low, life.high)
                answer = Answer(*ends) if math.isfinite(life.best) else NO_ANSWER
                meaning = f"life of the coating of body {body}"
                numbers |= answer.arrays(
                    f"coating_life{body}", "cycles", meaning, without=SCATTER_OF_K
                )
        return numbers


@quantities
@dataclass(frozen=True)
class Cracking:
    """A measure: the smallest margin of a fatigue criterion over the last closed cycle.

    Gives ``safety_factor``, or ``life`` [cycles] for criteria with a strain-life curve, and
    ``crack_depth`` [m], the depth of the worst point, by :meth:`pyfret.Result.life`. The margin is
    evaluated on the mean stress over the critical distance of the material, as of
    :func:`pyfret.study.compare`, or at the worst point of a material without one. The error of the
    stress gives its range, ``safety_factor_low`` and ``safety_factor_high``.

    Parameters
    ----------
    materials : Material or sequence of Material or None
        Material of the substrate, or one for each layer from the surface down, the substrate's
        last.
    criterion : str, optional
        One of :data:`pyfret.fatigue.CRITERIA` (default: chosen as by :meth:`pyfret.Result.life`).
    body_number : 1 or 2
        The body.
    """

    materials: Materials
    criterion: CriterionName | None = None
    body_number: int = 2

    def __call__(self, result: Result) -> dict[str, xr.DataArray]:
        """Judge the body in the plane of the shear."""
        life = result.life(self.materials, self.criterion, body_number=self.body_number)
        least, margin = life.least_margin(), life.margin
        location = "at the worst point" if least.L is None else f"of the mean over {um(least.L)}"
        unit, meaning = margin.attrs["units"], f"{margin.attrs['long_name']} {location}"
        answer = Answer(least.best, least.low, least.high)
        depth = estimate(life.worst.z, "m", "depth of the worst point")
        numbers = answer.arrays(str(margin.name), unit, meaning, without=SCATTER_OF_MATERIAL)
        return {**numbers, "crack_depth": depth}


@part()
class Arrest:
    """A measure: whether a crack below the last closed cycle stops.

    ``arrest_margin`` is the smallest range of K over its threshold along its path, below 1 where a
    crack stops. ``arrest_length`` [m] is the first length where it does not grow at all, NaN where
    it grows through all lengths. ``start_margin`` is the range of K over its threshold at the first
    length, below 1 where the crack never starts.

    Parameters
    ----------
    threshold : pyfret.fracture.Threshold
        Threshold of the material.
    x, lengths, angle, azimuth, offset, aspect, friction, body_number, residual
        The crack, as in :func:`pyfret.fracture.crack`.
    """

    threshold: fracture.Threshold
    x: InSI[Length | None] = by_default(None)
    lengths: Sequence[CrackLength] | None = None
    angle: InSI[Angle] = by_default(0.0)
    azimuth: InSI[Angle | None] = by_default(None)
    offset: InSI[Length | None] = by_default(None)
    aspect: float | None = None
    friction: FrictionCoefficient = 0.0
    body_number: int = 2
    residual: LayerStresses | None = None

    def __call__(self, result: Result) -> dict[str, xr.DataArray]:
        """Follow the crack."""
        options = {f.name: getattr(self, f.name) for f in fields(self) if f.name != "threshold"}
        cracks = fracture.crack(result, **options)
        arrest = cracks.arrest(self.threshold)
        length = math.nan if arrest.verdict == "grows" else arrest.tip
        ends = (math.nan, math.nan) if arrest.lengths is None else arrest.lengths
        margin_error = math.nan if arrest.margin_error is None else arrest.margin_error
        start_error = math.nan if arrest.at_start_error is None else arrest.at_start_error
        mark = self.threshold.mark
        start = f"range of K over its threshold{mark} at the first length"
        return {
            **Answer.from_error(arrest.at_start, start_error).arrays("start_margin", "1", start),
            **Answer.from_error(arrest.margin, margin_error).arrays(
                "arrest_margin", "1", f"least range of K over its threshold{mark}"
            ),
            **Answer(length, *ends).arrays(
                "arrest_length", "m", f"length at which the crack stops{mark}"
            ),
        }


@part()
class FirstToFail:
    """A measure: whether film, interface or substrate goes first below the last closed cycle.

    ``film``, ``interface`` and ``substrate`` are each the load over the limit: 1 where it fails,
    NaN without a limit. ``first`` is the one with the largest of the three, where that is 1 or
    more: 0 nothing fails, 1 the film, 2 the interface, 3 the substrate.

    Parameters
    ----------
    toughness, peel_strength, shear_strength, threshold, residual, x, lengths, body_number
        As in :func:`pyfret.fracture.first_to_fail`.
    """

    toughness: InSI[Toughness | None] = by_default(None)
    peel_strength: InSI[Strength | None] = by_default(None)
    shear_strength: InSI[Strength | None] = by_default(None)
    threshold: fracture.Threshold | None = None
    residual: LayerStresses | None = None
    x: InSI[Length | None] = by_default(None)
    lengths: Sequence[CrackLength] | None = None
    body_number: int = 2

    def __call__(self, result: Result) -> dict[str, xr.DataArray]:
        """Compare film, interface and substrate."""
        options = {f.name: getattr(self, f.name) for f in fields(self)}
        failure = fracture.first_to_fail(result, **options)
        numbers: dict[str, xr.DataArray] = {}
        for name in fracture.PARTS:
            value, meaning = getattr(failure, name), f"{name}: load over limit"
            error = failure.errors[name]
            if error is None:
                numbers[name] = estimate(value, "1", meaning)
            else:
                numbers |= Answer.from_error(value, error).arrays(name, "1", meaning)
        order = f"0 none, {', '.join(f'{n + 1} {name}' for n, name in enumerate(fracture.PARTS))}"
        first = 0 if failure.first is None else 1 + fracture.PARTS.index(failure.first)
        attrs = {"units": "1", "long_name": f"what fails first: {order}"}
        return numbers | {"first": xr.DataArray(first, attrs=attrs)}


def code_checksums(measures: Sequence[Measure]) -> dict[str, str]:
    """Return checksums of the measures that are functions, by their names."""
    return {
        f"{name}{suffix}": code_checksum(measure)
        for measure, name, suffix in zip(
            measures, measure_names(measures), suffixes(measures), strict=True
        )
        if not isinstance(measure, str)
    }


def suffixes(measures: Sequence[Measure]) -> list[str]:
    """Number the measures of one class: nothing for the first, ``_2`` for the second."""
    kinds = [type(measure) if is_of_pyfret(measure) else None for measure in measures]
    counts = [kinds[: n + 1].count(kind) if kind else 1 for n, kind in enumerate(kinds)]
    return [f"_{count}" if count > 1 else "" for count in counts]


def is_of_pyfret(measure: Measure) -> bool:
    """Check that a measure is a class of this package, which names its numbers itself."""
    return isinstance(measure, (WornDepth, Cracking, Arrest, FirstToFail, LargestStress))


def describe_differences(measure: Any, measures: Sequence[Measure]) -> str:
    """Describe the fields in which a measure differs from the others of its class."""
    siblings = [
        other_measure
        for other_measure in measures
        if type(other_measure) is type(measure) and other_measure is not measure
    ]
    names = [
        f.name
        for f in fields(measure)
        if any(getattr(sibling, f.name) != getattr(measure, f.name) for sibling in siblings)
    ]
    return ", ".join(f"{name} = {getattr(measure, name)!r}" for name in names)


def measure_names(measures: Sequence[Measure]) -> list[str]:
    """Return the names of measures, which distinguish studies.

    A function without a name is called by its position, the first of them ``measure_1``.
    """
    names = [m if isinstance(m, str) else function_name(m) for m in measures]
    return [f"measure_{n}" if name == "<lambda>" else name for n, name in enumerate(names, 1)]


def function_name(function: Any) -> str:
    """Return the name of a function, of the function of a partial, or of a class."""
    function = getattr(function, "func", function)
    return str(getattr(function, "__name__", type(function).__name__))


def check_measures(measure: Measure | Sequence[Measure]) -> list[Measure]:
    """Return the measures as a list; a ValueError for an unknown measure lists the names."""
    if not (isinstance(measure, str | Iterable) or callable(measure)):
        raise TypeError(f"measure = {measure!r:.60}: must be a function or the name of a measure")
    if isinstance(measure, Mapping):
        name = str(next(iter(measure), "p_max"))
        raise TypeError(
            f"measure: must be names and functions, not a mapping; the name of a function names "
            f"its number: def {name:.60}(result): return ..."
        )
    measures = [measure] if isinstance(measure, str) or callable(measure) else list(measure)
    for entry in measures:
        if isinstance(entry, str) and entry not in MEASURES:
            near = nearest_names(entry, MEASURES, 3)
            hint = f"; the nearest is {' or '.join(near)}" if near else ""
            hint = OF_CLASSES.get(entry.lower(), hint)
            raise ValueError(
                f"measure {entry!r:.60}: must be a function or one of {', '.join(MEASURES)}{hint}"
            )
        if not (isinstance(entry, str) or callable(entry) or is_of_pyfret(entry)):
            raise TypeError(f"measure = {entry!r:.60}: must be a function or the name of a measure")
    names = measure_names(measures)
    for n, name in enumerate(names):
        if name in names[:n] and not is_of_pyfret(measures[n]):
            raise ValueError(
                f"two measures have the name {name}: give each a name of its own, "
                "def of_stress(result): ..."
            )
    return measures


class Reasoned(dict[str, "xr.DataArray"]):
    """The numbers of a measure, and why some of them are missing."""

    def __init__(self, numbers: Mapping[str, xr.DataArray], reasons: Sequence[str]) -> None:
        super().__init__(numbers)
        self.reasons = list(reasons)


def reason_without_number(result: Result, name: str) -> str:
    """Explain why a measure of :data:`MEASURES` has no number."""
    d = result.dataset
    if name in OF_CYCLE:
        loops = result.loops(direction=next(iter(directions(result)), "x"))
        if not loops.sizes["cycle"]:
            return "the path has no closed cycle, whose last branch ends where an earlier one ended"
        if name == "stiffness":
            return TOO_FEW_INCREMENTS
        return "the last closed cycle has no such number: it has no slip or no motion"
    if name.startswith("interface") and not any(
        body.coatings for body in (result.scene.body1, result.scene.body2)
    ):
        return "neither body has a coating"
    if name == "stick_ratio" and float(d.contact_area[-1]) == 0.0:
        return "there is no contact at the end of the path"
    if not any(bool(result.at(int(n)).contact.any()) for n in d.saved_increment.values):
        return "no increment that kept its fields has contact"
    return "the result has no such number"


def needs_more_increments(result: Result, measures: Sequence[Measure]) -> bool:
    """Check for a measure that lacks its number because branches have too few increments."""
    return "stiffness" in measures and any(
        reason.endswith(TOO_FEW_INCREMENTS)
        for reason in evaluate_measure(result, "stiffness", measures)[1]
    )


def evaluate_measures(
    result: Result, measures: Sequence[Measure], costs: dict[str, float] | None = None
) -> tuple[dict[str, xr.Variable], list[str]]:
    """Evaluate all measures of a result: numbers by name, and the reasons of missing ones.

    `costs` gets the processor time of each measure by its name [s].

    A measure that raises an error leaves the others as they are. Second and further measures of one
    class of this package have their number behind the name.

    Raises
    ------
    ValueError
        Two measures give one name.
    Exception
        No measure has a number: the error of the first.
    """
    numbers: dict[str, xr.Variable] = {}
    reasons: list[str] = []
    errors: list[Exception] = []
    names = measure_names(measures)
    for measure, called, suffix in zip(measures, names, suffixes(measures), strict=True):
        started = time.process_time()
        try:
            arrays, why = evaluate_measure(result, measure, measures, called)
        except Exception as error:
            errors.append(error)
            text = " ".join(str(error).split())
            reasons.append(f"{called}{suffix}: {type(error).__name__}: {text}")
            if isinstance(measure, str):
                units, meaning, _ = MEASURES[measure]
                units = result.scene.grid.unit_of(units)
                numbers[measure] = estimate(math.nan, units, meaning).variable
            continue
        finally:
            if costs is not None:
                costs[f"{called}{suffix}"] = time.process_time() - started
        reasons += why
        for name, value in arrays.items():
            base, side = split(name, arrays)
            if f"{base}{suffix}{side}" in numbers:
                raise ValueError(f"two measures give {name}: give each a name of its own")
            numbers[f"{base}{suffix}{side}"] = value
    if errors and len(errors) == len(measures):
        raise errors[0]
    return numbers, reasons


def evaluate_measure(
    result: Result, measure: Measure, measures: Sequence[Measure], called: str = ""
) -> tuple[dict[str, xr.Variable], list[str]]:
    """Evaluate one of the measures, which is `called` so: its numbers, reasons of missing ones."""
    if isinstance(measure, str):
        units, meaning, compute = MEASURES[measure]
        units, value = result.scene.grid.unit_of(units), compute(result)
        if isinstance(value, Answer):
            arrays = value.arrays(measure, units, meaning)
        else:
            arrays = {measure: estimate(value, units, meaning)}
            if measure in CODES:
                del arrays[measure].attrs["accuracy"]
        missing = math.isnan(value.value if isinstance(value, Answer) else value)
        reasons = [f"{measure}: {reason_without_number(result, measure)}"] if missing else []
        return {name: array.variable for name, array in arrays.items()}, reasons
    whole = measure(result)
    name = called or function_name(measure)
    numbers = to_variables(whole, name)
    if is_of_pyfret(measure):
        if words := describe_differences(measure, measures):
            for number in numbers.values():
                number.attrs["long_name"] = f"{number.attrs.get('long_name', '')} ({words})"
        return numbers, list(getattr(whole, "reasons", []))
    reasons = list(getattr(whole, "reasons", []))
    if not isinstance(whole, Reasoned):
        lost = [key for key, v in numbers.items() if v.size and bool(np.isnan(v.values).all())]
        reasons += [f"{key}: {name} gave NaN" for key in lost]
    return numbers, reasons


def to_variables(value: Any, name: str) -> dict[str, xr.Variable]:
    """Convert the value of a user's function to variables: a number, an array, or several."""
    if isinstance(value, xr.Dataset | Mapping):
        return {
            str(k): v
            for key, item in value.items()
            for k, v in to_variables(item, str(key)).items()
        }
    if isinstance(value, xr.DataArray):
        if value.dtype.kind not in "biufUS":
            raise TypeError(f"measure {name}: gave values of the type {value.dtype}, no numbers")
        return {name: value.variable}
    # None and a masked value are missing values.
    masked = np.ma.isMaskedArray(value) and np.ma.is_masked(value)
    number = np.ma.filled(np.ma.asarray(value, dtype=float), np.nan) if masked else value
    number = np.asarray(number, dtype=float)
    if number.ndim:
        raise TypeError(
            f"measure {name}: gave an array of shape {number.shape}; arrays need names of their "
            "dimensions: give an xarray.DataArray"
        )
    return {name: xr.Variable((), number)}
