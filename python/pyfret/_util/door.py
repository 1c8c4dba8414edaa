"""The door of a function or a class: its parameters take numbers in SI units, or pyfret's objects.

Which parameters are numbers follows from their annotations, so that a signature is the one place
that says so. The rules for the values are those of :mod:`pyfret._util.arrays`; numbers that seem to
have another unit are doubted by :mod:`pyfret._util.doubts`.
"""

from __future__ import annotations

import functools
import inspect
import math
import re
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from pyfret import _core
from pyfret._util.arrays import items, numbers, truths
from pyfret._util.called import by_name
from pyfret._util.doubts import doubt_numbers
from pyfret._util.guesses import PLACED, refuse_unknown, too_many
from pyfret._util.takers import keywords

if TYPE_CHECKING:
    from collections.abc import Callable

    from typing_extensions import dataclass_transform
else:

    def dataclass_transform(**_: Any) -> Any:
        """Nothing while the program runs: it is said to tools that read types."""
        return lambda of: of


__all__ = ["dataclass_transform", "numbers_only", "valued"]

T = TypeVar("T")
#: Annotations of a number, of what may be one, and of an array.
NUMBER = re.compile(r"(float|int|Quantity|AsNumber)( \| None)?|AsNumberOrNone")
COUNT = re.compile(r"int( \| None)?")
PERHAPS = re.compile(r"\b(float|int|Quantity|Quantities|YieldStresses)\b")
SEVERAL, TEXT = (
    re.compile(r"Sequence\[(float|Quantity)|Quantities"),
    re.compile(r"\b(str|Literal)\b"),
)
ARRAY = re.compile(r"(ArrayLike|NDArray\[np\.float64\])( \| None)?")
#: Annotations that have other meanings for True, or hold the numbers deeper.
ELSE = re.compile(r"\b(bool|Callable|Mapping|dict|Any)\b")
#: Annotations of objects alone, and of several of them.
OBJECTS = re.compile(r"(\w+\.)?[A-Z]\w*( \| ((\w+\.)?[A-Z]\w*|None))*")
SEVERAL_OBJECTS = re.compile(r"(Iterable|Sequence)\[([A-Z]\w*)\]")
#: Classes of other libraries that are no plain values either.
FOREIGN = re.compile(r"xr\.\w+|pd\.DataFrame|Axes|Figure")
MAPPING = re.compile(r"Mapping\[.*\]( \| None)?")
MAPPING_OF = re.compile(r"Mapping\[\w+, ([A-Z]\w*)\]")
#: Objects that others are made of, and how one comes by them.
MADE = {
    "Scene": "a scene, as in solve(scene, path)",
    "LoadPath": "a load path, as in solve(scene, path)",
    "Run": "the result of a run, fret.solve(scene, path) or fret.open(path)",
    "State": "an increment, result.at(-1)",
    "Stress": "the stress below an increment, result.at(-1).stress()",
    "Life": "a life, result.life(material, criterion)",
    "OverDistances": "lives over distances, life.over_distance()",
    "LoadFactors": "load factors, result.load_factors(s_y)",
    "Cracks": "cracks, result.crack(x)",
    "WearResult": "a run of wear, fret.wear.solve(scene, wear)",
    "SideBySide": "a comparison, fret.compare({...}, scene, path)",
    "Tabulated": "a study, fret.study.run(scene, {...}, measure=...)",
    "Study": "a study, fret.study.run(scene, {...}, measure=...)",
    "Material": "a material of fatigue, fatigue.Materials()['7075'], or its name",
    "Elastic": "an elastic material, fret.material('steel') or fret.Elastic(E=210e9, nu=0.3)",
    "Criterion": (
        "a criterion with its numbers, fatigue.Criterion.of('findley', material) or "
        "fatigue.Criterion.findley(k=0.3)"
    ),
    "Dataset": "an xarray.Dataset",
    "DataArray": "an xarray.DataArray",
}
#: Kinds of parameters that take no text but one with a unit.
UNITS = ("number", "array", "number or several", "number or else")
#: Those of them that may hold several.
SEVERAL_OF = UNITS[1:]
#: Parameters that are given by name, and that of further names.
NAMED = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)
FURTHER = inspect.Parameter.VAR_KEYWORD
#: Types of Python and numpy that are none of pyfret's objects.
PLAIN = (bool, int, float, complex, str, bytes, list, tuple, dict, set, np.ndarray, np.generic)


def numbers_only(of: T, *, but: tuple[str, ...] = ()) -> T:
    """Refuse, by the name of the parameter, what is no number where a number is meant.

    Booleans, complex numbers and missing values are refused wherever the annotation names a
    number. `but` names parameters that have a rule of their own: masks, arrays with holes. A number
    outside the range that its quantity is meant in is warned of.
    """
    if isinstance(of, type):
        of.__init__ = guarded(of.__init__, of.__qualname__, but)  # type: ignore[misc]
        return of
    call: Any = of
    return guarded(call, call.__qualname__, but)  # type: ignore[no-any-return]


@dataclass_transform(frozen_default=True, field_specifiers=(field,))
def valued(
    *, kw_only: bool = False, eq: bool = True, repr: bool = True
) -> Callable[[type[T]], type[T]]:
    """Make a frozen dataclass behind the door; fields of the type AsNumber take quantities."""

    def made(cls: type[T]) -> type[T]:
        return numbers_only(dataclass(frozen=True, kw_only=kw_only, eq=eq, repr=repr)(cls))

    return made


def guarded(call: Callable[..., Any], owner: str, but: tuple[str, ...]) -> Any:
    """A function, or the constructor of a class, `owner`, behind the door."""
    signature = inspect.signature(call)
    parameters = signature.parameters.items()
    kinds = {n: None if n in but else kind(str(one.annotation)) for n, one in parameters}
    annotations = {n: str(one.annotation) for n, one in parameters if n not in but}
    # A material may be given by its name.
    objects = {n: of.replace("Material | str", "Material") for n, of in annotations.items()}
    defaults = {name: one.default for name, one in parameters}
    nothing = {n for n, of in objects.items() if "None" in of or defaults[n] is None}
    needed = {n for n in objects if kinds[n]} - nothing
    names = list(kinds)
    ranged = {n for n in names if _core.measured_by(f"{owner}.{n}")}

    named = {n for n, one in parameters if one.kind in NAMED}
    placed = [one for _, one in parameters if one.kind in PLACED]
    further = next((str(one.annotation) for _, one in parameters if one.kind is FURTHER), None)

    @functools.wraps(call)
    def checked(*values: Any, **given: Any) -> Any:
        if not named.issuperset(given):
            more = () if further is None else keywords(further)
            if more is not None:
                known = [n for n in names if n in named and n != "self"]
                refuse_unknown(owner, call, given, [*known, *more])
        if len(values) > len(placed):
            refusal = too_many(owner, signature.parameters.values(), values)
            if refusal is not None:
                raise refusal
        doubted: dict[str, Any] = {}
        values = (
            tuple(
                in_si(
                    by_name(value, name, objects.get(name, "")),
                    f"{owner}.{name}",
                    name,
                    kinds.get(name),
                )
                for name, value in zip(names, values, strict=False)
            )
            + values[len(names) :]
        )
        given = {
            name: in_si(
                by_name(value, name, objects.get(name, "")),
                f"{owner}.{name}",
                name,
                kinds.get(name),
            )
            for name, value in given.items()
        }
        for name, value in [*zip(names, values, strict=False), *given.items()]:
            if value is None and name in needed:
                raise TypeError(f"{name} = None: must be given")
            if value is not None and value is not defaults.get(name, inspect.Parameter.empty):
                check(value, name, kinds.get(name))
                check_object(value, name, objects.get(name, ""))
                if name in ranged:
                    doubted[name] = value
        # What a sequence says of its length is not handed on.
        places = [honest(value, name) for name, value in zip(names, values, strict=False)]
        others = {name: honest(value, name) for name, value in given.items()}
        found = call(*places, *values[len(places) :], **others)
        # What is refused is not doubted.
        doubt_numbers(owner, **doubted)
        return found

    return checked


def in_si(value: Any, key: str, name: str, of: str | None) -> Any:
    """A text with a unit, or a quantity of pint, as the number in SI; other values as they are.

    Raises
    ------
    ValueError
        The unit measures something else than the parameter.
    TypeError
        What the parameter measures is not known; the message has the number to write.
    """
    if of in SEVERAL_OF and type(value) in (list, tuple):
        if any(isinstance(one, str) or hasattr(one, "magnitude") for one in value):
            return type(value)(in_si(one, key, name, "number") for one in value)
        return value
    text = isinstance(value, str) and of in UNITS and any(map(str.isdigit, value))
    if not text and not (of and hasattr(value, "magnitude") and hasattr(value, "units")):
        return value
    try:
        return _core.si_of(key, value)
    except (TypeError, ValueError) as refused:
        raise type(refused)(f"{name} = {refused}") from None


def honest(value: Any, name: str) -> Any:
    """A list of a class of its own as a plain one, everything else as it is."""
    own = isinstance(value, list) and type(value) is not list
    return items(value, name) if own else value


def kind(annotation: str) -> str | None:
    """What a parameter takes: a count, a number, an array, several, or other things beside one."""
    if ELSE.search(annotation):
        return None
    if COUNT.fullmatch(annotation):
        return "count"
    if NUMBER.fullmatch(annotation):
        return "number"
    if ARRAY.fullmatch(annotation):
        return "array"
    if not PERHAPS.search(annotation):
        return None
    if TEXT.search(annotation):
        return "number or text"
    return "number or several" if SEVERAL.search(annotation) else "number or else"


def check_object(value: Any, name: str, annotation: str) -> None:
    """Refuse what is no object of the class that is meant, and say how one is made.

    Raises
    ------
    TypeError
        It is of another type.
    """
    several = SEVERAL_OBJECTS.fullmatch(annotation)
    if several and isinstance(value, str | bytes) and is_own(several[2]):
        raise TypeError(f"{name} = {told(value)}: must be several of the class {several[2]}")
    if MAPPING.fullmatch(annotation) and not isinstance(value, Mapping):
        raise TypeError(f"{name} = {told(value)}: must be a mapping of names")
    each = MAPPING_OF.fullmatch(annotation)
    if each and is_own(each[1]):
        for key, one in value.items():
            check_object(one, f"{name}[{key!r}]", each[1])
    meant = [of for of in annotation.split(" | ") if of != "None"]
    if not OBJECTS.fullmatch(annotation) or not all(is_own(of) for of in meant):
        return
    if not any(is_one(value, of) for of in meant):
        what = " or ".join(MADE.get(of.rpartition(".")[2], f"of the class {of}") for of in meant)
        hint = ""
        if "Dataset" in annotation and hasattr(value, "dataset"):
            # A table that the value makes of itself has the name of the parameter.
            makes = callable(getattr(value, name, None))
            hint = f", its .{name}()" if makes else ", its .dataset"
        raise TypeError(f"{name} = {told(value)}: must be {what}{hint}")


def told(value: Any) -> str:
    """A plain value as it is written, an object by its class."""
    if not isinstance(value, PLAIN):
        return f"<{type(value).__name__}>"
    return f"{' '.join(repr(value).split()):.60}"


def is_one(value: Any, name: str) -> bool:
    """Whether a value is of a class of that name; where the class is not known, no plain value."""
    if isinstance(value, PLAIN):
        return False
    classes = classes_of(name)
    return not classes or any(holds(value, of) for of in classes)


def holds(value: Any, of: type) -> bool:
    """Whether a value is of a class, or has all that a protocol asks for."""
    if not getattr(of, "_is_protocol", False):
        return isinstance(value, of)
    names = {*vars(of), *getattr(of, "__annotations__", {})}
    return all(hasattr(value, name) for name in names if not name.startswith("_"))


@functools.cache
def classes_of(name: str) -> tuple[type, ...]:
    """The classes of pyfret, or of another library, that have this name."""
    module, _, name = name.rpartition(".")
    root = "xarray" if module == "xr" else "pyfret"
    own = [of for known, of in list(sys.modules.items()) if known.partition(".")[0] == root]
    found = {id(of): of for m in own if isinstance(of := vars(m).get(name), type)}
    return tuple(found.values())


@functools.cache
def is_own(name: str) -> bool:
    """Whether a class of pyfret, or a foreign one, has this name, and is no plain value."""
    if FOREIGN.fullmatch(name):
        return True
    name = name.rpartition(".")[2]
    own = [m for module, m in list(sys.modules.items()) if module.split(".")[0] == "pyfret"]
    found = [vars(module)[name] for module in own if name in vars(module)]
    # A name that stands for several types elsewhere takes what those take.
    return bool(found) and all(
        isinstance(one, type)
        and one.__module__.split(".")[0] == "pyfret"
        and not issubclass(one, PLAIN)
        for one in found
    )


def check(value: Any, name: str, of: str | None) -> None:
    """Refuse a value that is no number, or a missing one.

    Raises
    ------
    TypeError
        It is of another type.
    ValueError
        It is not a number, NaN.
    """
    if of is None or (hasattr(value, "magnitude") and hasattr(value, "units")):
        return
    if of == "array":
        numbers(value, name)
        return
    if truths(value):
        raise TypeError(f"{name} = {value!r:.60}: must be a number, which True and False are not")
    if isinstance(value, complex | np.complexfloating) or value is np.ma.masked:
        raise TypeError(f"{name} = {value!r:.60}: must be a real number")
    if isinstance(value, float | np.floating) and math.isnan(value):
        raise ValueError(f"{name} = nan: must be a number")
    if of == "number or several" and isinstance(value, Sequence | np.ndarray):
        found = value if isinstance(value, np.ndarray) else items(value, name)
        numbers([one for one in found if one is not None], name)
    if of != "number or text" and isinstance(value, str | bytes):
        raise TypeError(f"{name} = {value!r:.60}: must be a number, not a text")
    one = (hasattr(value, "__float__") or hasattr(value, "__index__")) and np.ndim(value) == 0
    if of == "count" and not (hasattr(value, "__index__") and np.ndim(value) == 0):
        raise TypeError(f"{name} = {value!r:.60}: must be a whole number")
    if of == "number" and not one:
        raise TypeError(f"{name} = {' '.join(repr(value).split()):.60}: must be a number")
