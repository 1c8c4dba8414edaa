"""What is kept of the result of a point."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from pyfret import fracture, wear
from pyfret._util.bounds import split
from pyfret._util.lazy import xr
from pyfret._util.numbers import um
from pyfret.fatigue.section import Materials
from pyfret.quantities import (
    Angle,
    CrackLength,
    FrictionCoefficient,
    InSI,
    ResidualStresses,
    Strength,
    Toughness,
    by_default,
    part,
    quantities,
)
from pyfret.run.summary import directions
from pyfret.study.answer import NOTHING, Answer, estimate
from pyfret.study.identity import identity
from pyfret.subsurface.tensor import LABELS

if TYPE_CHECKING:
    from pyfret.fatigue.criteria import CriterionName
    from pyfret.result import Result
    from pyfret.subsurface.tensor import Stress

__all__ = ["MEASURES", "Arrest", "Cracking", "FirstToFail", "Measure", "WornDepth", "measured"]

#: A name of :data:`MEASURES`, or a function of the result.
Measure: TypeAlias = "str | Callable[[Result], Any]"


def of_last_cycle(name: str) -> Callable[[Result], float | Answer]:
    """A number of the last closed cycle, with its error where it has one; NaN without a cycle."""

    def measure(result: Result) -> float | Answer:
        loops = result.loops(direction=next(iter(directions(result)), "x"))
        last = {key: float(of[-1]) if of.size else math.nan for key, of in loops.items()}
        error = last.get(f"{name}_error")
        return last[name] if error is None else Answer.within(last[name], error, least=0.0)

    return measure


def of_path(name: str, of: Callable[[xr.DataArray], Any]) -> Callable[[Result], float]:
    """A number of a scalar over the path."""
    return lambda result: float(of(result.dataset[name]))


#: Difference of a largest stress and the highest sample of its section, over the stress, up to
#: which the samples show the increment at which it is largest.
OFF_SECTION = 0.05


def on_section(below: Stress, name: str) -> float:
    """The highest sample of a measure on a section, the rim of the contact among them."""
    samples = [below.measure(name)]
    if not name.startswith("interface"):
        samples += [border.measure(name) for border in (below.rims(), below.stick_borders())]
    return max(float(of.max()) for of in samples if of.size)


def largest(name: str) -> Callable[[Result], Answer]:
    """The largest value of a measure of stress in body 2, over the increments with fields."""

    def measure(result: Result) -> Answer:
        layered = bool(result.scene.body2.coatings)
        if name.startswith("interface") and not layered:
            return NOTHING
        kept = (result.at(int(n)) for n in result.dataset.saved_increment.values)
        below = [at.stress() for at in kept if bool(at.contact.any())]
        if not below:
            return NOTHING
        tops = [on_section(of, name) for of in below]
        highest = int(np.argmax(tops))
        worst = below[highest].maximum(name)
        if not abs(worst.value - tops[highest]) <= OFF_SECTION * abs(worst.value):
            # The sections do not show at which increment the largest value is.
            worst = max((of.maximum(name) for of in below), key=lambda of: of.value)
        return Answer.within(worst.value, worst.error, least=-math.inf if name in SIGNED else 0.0)

    return measure


def half_length(result: Result) -> float:
    """The contact radius at the end, of a line contact half its width."""
    d = result.dataset
    return float(d["half_width" if "half_width" in d else "contact_radius"][-1])


#: Ready measures: unit, meaning, function of the result.
MEASURES: dict[str, tuple[str, str, Callable[[Result], float | Answer]]] = {
    "loop_energy": ("J", "energy dissipated in the last cycle", of_last_cycle("dissipated")),
    "energy_ratio": ("1", "energy ratio of the last cycle", of_last_cycle("energy_ratio")),
    "sliding_ratio": ("1", "sliding ratio of the last cycle", of_last_cycle("sliding_ratio")),
    "stiffness": ("N/m", "stiffness right after the reversals", of_last_cycle("stiffness")),
    "T": ("N", "half the range of the force", of_last_cycle("T")),
    "delta": ("m", "half the range of the shift", of_last_cycle("delta")),
    "regime": (
        "1",
        "last cycle: 0 no contact, 1 full stick, 2 partial slip, 3 gross slip",
        of_last_cycle("status"),
    ),
    "stick_ratio": (
        "1",
        "stick ratio at the end of the path",
        of_path("stick_ratio", lambda v: v[-1]),
    ),
    "least_stick_ratio": (
        "1",
        "smallest stick ratio of the path",
        of_path("stick_ratio", lambda v: v.min()),
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
        of_path("dissipated", lambda v: v.sum()),
    ),
    "p_max": ("Pa", "largest pressure of the path", of_path("p_max", lambda v: v.max())),
    "q_max": ("Pa", "largest shear traction of the path", of_path("q_max", lambda v: v.max())),
    **{
        name: ("Pa", f"largest {LABELS[name][1].removeprefix('largest ')} in body 2", largest(name))
        for name in ("von_mises", "tresca", "s_1", "interface_shear", "interface_peel")
    },
}


#: Largest stresses that may be compression; the others are sizes.
SIGNED = ("interface_peel",)
#: Measures that are codes: they have no error.
CODES = ("regime", "first")


#: What ranges of a study leave out, since points of one material are compared.
SCATTER_OF_K = "the scatter of the wear coefficient, which WearResult.range_of_cycles() has"
SCATTER_OF_MATERIAL = "the scatter of the material, which Life.range has"


@part()
class WornDepth(wear.Wear):
    """A measure: what many cycles wear off, by :func:`pyfret.wear.solve` on the scene of the point.

    Gives ``worn_volume1``, ``worn_volume2`` [m^3], ``worn_depth1``, ``worn_depth2`` [m], and, where
    a body is coated, ``coating_life1``, ``coating_life2`` [cycles], NaN for one that outlives the
    run. Each has its range, such as ``worn_depth1_low`` and ``worn_depth1_high``, from
    ``depth_error``, the error of the depths over the depths. The lives are those of
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
        part = float(worn["depth_error"][-1])
        for of, unit in (("volume", "m^3"), ("depth", "m")):
            for body in (1, 2):
                value = float(worn[f"{of}{body}"][-1])
                answer = Answer.within(value, part * value)
                numbers |= answer.arrays(f"worn_{of}{body}", unit, f"worn {of} of body {body}")
        numbers["depth_error"] = worn["depth_error"][-1]
        for body in (1, 2):
            if (result.scene.body1 if body == 1 else result.scene.body2).coatings:
                # Candidates are compared: the scatter of a coefficient is left to the reader.
                life = run.range_of_cycles(scatter=1.0, part_of_coating=self.part, body_number=body)
                ends = (life.best, life.low, life.high)
                answer = Answer(*ends) if math.isfinite(life.best) else NOTHING
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
    that of the mean stress over the critical distance of the material, as of
    :func:`pyfret.study.compare`, and at the worst point of a material without one. The error of the
    stress gives its range, ``safety_factor_low`` and ``safety_factor_high``.

    Parameters
    ----------
    materials : Material or sequence of Material or None
        That of the substrate, or one for each layer from the surface down, the substrate's last.
    criterion : str
        One of :data:`pyfret.fatigue.CRITERIA`.
    body_number : 1 or 2
        The body.
    """

    materials: Materials
    criterion: CriterionName
    body_number: int = 2

    def __call__(self, result: Result) -> dict[str, xr.DataArray]:
        """Judge the body in the plane of the shear."""
        life = result.life(self.materials, self.criterion, body_number=self.body_number)
        least, margin = life.least_margin(), life.margin
        of = "at the worst point" if least.L is None else f"of the mean over {um(least.L)}"
        unit, meaning = margin.attrs["units"], f"{margin.attrs['long_name']} {of}"
        answer = Answer(least.best, least.low, least.high)
        depth = estimate(life.worst.z, "m", "depth of the worst point")
        numbers = answer.arrays(str(margin.name), unit, meaning, without=SCATTER_OF_MATERIAL)
        return {**numbers, "crack_depth": depth}


@part()
class Arrest:
    """A measure: whether a crack below the last closed cycle stops.

    ``arrest_margin`` is the smallest range of K over its threshold on the way, below 1 where a
    crack stops. ``arrest_length`` [m] is the first length where it does not grow at all, NaN where
    it grows through all lengths. ``start_margin`` is the range of K over its threshold at the first
    length, below 1 where the crack never starts.

    Parameters
    ----------
    threshold : pyfret.fracture.Threshold
        Of the material.
    x, lengths, angle, azimuth, aspect, friction, body_number, residual
        The crack, as in :func:`pyfret.fracture.crack`.
    """

    threshold: fracture.Threshold
    x: float | None = None
    lengths: Sequence[CrackLength] | None = None
    angle: InSI[Angle] = by_default(0.0)
    azimuth: InSI[Angle | None] = by_default(None)
    aspect: float | None = None
    friction: FrictionCoefficient = 0.0
    body_number: int = 2
    residual: Sequence[ResidualStresses] | None = None

    def __call__(self, result: Result) -> dict[str, xr.DataArray]:
        """Follow the crack."""
        options = {f.name: getattr(self, f.name) for f in fields(self) if f.name != "threshold"}
        cracks = fracture.crack(result, **options)
        found = cracks.arrest(self.threshold)
        length = math.nan if found.verdict == "grows" else found.tip
        ends = (math.nan, math.nan) if found.lengths is None else found.lengths
        off = math.nan if found.margin_error is None else found.margin_error
        off_start = math.nan if found.at_start_error is None else found.at_start_error
        mark = self.threshold.mark
        start = f"range of K over its threshold{mark} at the first length"
        return {
            **Answer.within(found.at_start, off_start).arrays("start_margin", "1", start),
            **Answer.within(found.margin, off).arrays(
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
    residual: Sequence[ResidualStresses] | None = None
    x: float | None = None
    lengths: Sequence[CrackLength] | None = None
    body_number: int = 2

    def __call__(self, result: Result) -> dict[str, xr.DataArray]:
        """Compare the three."""
        options = {f.name: getattr(self, f.name) for f in fields(self)}
        found = fracture.first_to_fail(result, **options)
        numbers: dict[str, xr.DataArray] = {}
        for name in fracture.PARTS:
            value, meaning = getattr(found, name), f"{name}: load over limit"
            error = found.errors[name]
            if error is None:
                numbers[name] = estimate(value, "1", meaning)
            else:
                numbers |= Answer.within(value, error).arrays(name, "1", meaning)
        order = f"0 none, {', '.join(f'{n + 1} {name}' for n, name in enumerate(fracture.PARTS))}"
        first = 0 if found.first is None else 1 + fracture.PARTS.index(found.first)
        attrs = {"units": "1", "long_name": f"what fails first: {order}"}
        return numbers | {"first": xr.DataArray(first, attrs=attrs)}


def code_of(measures: Sequence[Measure]) -> dict[str, str]:
    """Checksums of the measures that are functions, by their names."""
    return {
        f"{name_of(one)}{suffix}": identity(one)
        for one, suffix in zip(measures, suffixes(measures), strict=True)
        if not isinstance(one, str)
    }


def suffixes(measures: Sequence[Measure]) -> list[str]:
    """What tells measures of one class apart: nothing for the first, ``_2`` for the second."""
    kinds = [type(one) if is_own(one) else None for one in measures]
    counts = [kinds[: n + 1].count(kind) if kind else 1 for n, kind in enumerate(kinds)]
    return [f"_{count}" if count > 1 else "" for count in counts]


def is_own(measure: Measure) -> bool:
    """Whether a measure is one of this package, which names what it gives itself."""
    return isinstance(measure, (WornDepth, Cracking, Arrest, FirstToFail))


def differing(measure: Any, measures: Sequence[Measure]) -> str:
    """In what a measure of this package differs from the others of its class, in words."""
    others = [one for one in measures if type(one) is type(measure) and one is not measure]
    names = [
        f.name
        for f in fields(measure)
        if any(getattr(one, f.name) != getattr(measure, f.name) for one in others)
    ]
    return ", ".join(f"{name} = {getattr(measure, name)!r}" for name in names)


def names_of(measures: Sequence[Measure]) -> list[str]:
    """Names of measures, to tell studies apart."""
    return [m if isinstance(m, str) else name_of(m) for m in measures]


def name_of(function: Any) -> str:
    """Name of a function, of that which a partial one was made of, or of a class."""
    function = getattr(function, "func", function)
    return str(getattr(function, "__name__", type(function).__name__))


def checked(measure: Measure | Sequence[Measure]) -> list[Measure]:
    """The measures as a list; a ValueError with what is allowed if there is no such measure."""
    measures = [measure] if isinstance(measure, str) or callable(measure) else list(measure)
    for one in measures:
        if isinstance(one, str) and one not in MEASURES:
            raise ValueError(f"measure {one!r}: must be a function or one of {', '.join(MEASURES)}")
        if not (isinstance(one, str) or callable(one) or is_own(one)):
            raise TypeError(f"measure = {one!r:.60}: must be a function or the name of a measure")
    names = names_of(measures)
    for n, name in enumerate(names):
        if name in names[:n] and not is_own(measures[n]):
            raise ValueError(
                f"two measures have the name {name}: give each a name of its own, "
                "def of_stress(result): ..."
            )
    return measures


def measured(result: Result, measures: Sequence[Measure]) -> dict[str, xr.Variable]:
    """All measures of a result by name; a ValueError if two of them give one name.

    Second and further measures of one class of this package have their number behind the name.
    """
    found: dict[str, xr.Variable] = {}
    for one, suffix in zip(measures, suffixes(measures), strict=True):
        if isinstance(one, str):
            units, meaning, of = MEASURES[one]
            units, found_here = result.scene.grid.unit_of(units), of(result)
            if isinstance(found_here, Answer):
                arrays = found_here.arrays(one, units, meaning)
            else:
                arrays = {one: estimate(found_here, units, meaning)}
                if one in CODES:
                    del arrays[one].attrs["accuracy"]
            given = {name: array.variable for name, array in arrays.items()}
        else:
            given = variables(one(result), name_of(one))
            if is_own(one) and (words := differing(one, measures)):
                for of_one in given.values():
                    of_one.attrs["long_name"] = f"{of_one.attrs.get('long_name', '')} ({words})"
        for name, value in given.items():
            base, side = split(name, given)
            if f"{base}{suffix}{side}" in found:
                raise ValueError(f"two measures give {name}: give each a name of its own")
            found[f"{base}{suffix}{side}"] = value
    return found


def variables(value: Any, name: str) -> dict[str, xr.Variable]:
    """What a user's function gave, as variables: a number, an array of xarray, or several."""
    if isinstance(value, xr.Dataset | Mapping):
        return {str(k): v for key, of in value.items() for k, v in variables(of, str(key)).items()}
    if isinstance(value, xr.DataArray):
        if value.dtype.kind not in "biufUS":
            raise TypeError(f"measure {name}: gave values of the type {value.dtype}, no numbers")
        return {name: value.variable}
    # Nothing and a masked value are missing ones.
    masked = np.ma.isMaskedArray(value) and np.ma.is_masked(value)
    number = np.ma.filled(np.ma.asarray(value, dtype=float), np.nan) if masked else value
    number = np.asarray(number, dtype=float)
    if number.ndim:
        raise TypeError(
            f"measure {name}: gave an array of shape {number.shape}; arrays need names of their "
            "dimensions: give an xarray.DataArray"
        )
    return {name: xr.Variable((), number)}
