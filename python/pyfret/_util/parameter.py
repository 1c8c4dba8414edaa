"""Rules for the parameters of a function, from their types."""

from __future__ import annotations

import enum
import functools
import inspect
import math
import os
import typing
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import BuiltinFunctionType
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pyfret import _core
from pyfret._util.arrays import contains_booleans, items, numbers
from pyfret._util.compiled import register_units
from pyfret._util.hints import Named, Options, members, read_hints
from pyfret._util.material_names import read_material
from pyfret._util.scene_warnings import sizes, warn
from pyfret._util.spelling import respelled

__all__ = ["Parameter", "Signature", "Unit", "unit_of"]


@dataclass(frozen=True)
class Unit:
    """Metadata of a quantity: its row in the table of quantities, and its SI unit.

    ``checked`` is False where the function has a rule of its own for the values.
    """

    quantity: str
    si: str = ""
    checked: bool = True

    @property
    def has_range(self) -> bool:
        """Whether the table of quantities has a plausible range for this one."""
        return self.quantity in plausible_quantities()

    def convert(self, value: Any) -> float:
        """Convert a text with a unit, or a quantity of pint, to SI."""
        try:
            return _core.quantity_in_si(self.quantity, value)
        except ValueError:
            number = respelled(value, self.si) if isinstance(value, str) else None
            if number is None:
                raise
            return number

    def warn(self, name: str, value: Any) -> None:
        """Warn of the numbers that are not plausible: of lists each, of arrays the largest."""
        doubts = (_core.doubt_quantity(self.quantity, name, size) for size in sizes(value))
        for doubt in dict.fromkeys(doubt for doubt in doubts if doubt is not None):
            warn(doubt)


@functools.cache
def plausible_quantities() -> frozenset[str]:
    """Return the names of the rows with a plausible range."""
    return frozenset(name for name, _, has_range in _core.quantities() if has_range)


#: Objects that other functions return, and how to get one.
MADE = {
    "Scene": "a scene, as in solve(scene, path)",
    "LoadPath": "a load path, as in solve(scene, path)",
    "Run": "the result of a run, fret.solve(scene, path) or fret.open(path)",
    "State": "an increment, result.at(-1)",
    "Stress": "the stress below an increment, result.at(-1).stress()",
    "Life": "a life, result.life(material, criterion)",
    "OverDistances": "lives over distances, life.over_distance()",
    "LoadFactors": "load factors, result.load_factors(s_y)",
    "CountedLoops": "counted loops, history.count()",
    "Cracks": "cracks, result.crack(x)",
    "Arrest": "the arrest of a crack, fret.study.Arrest(threshold)",
    "WearResult": "a run of wear, fret.wear.solve(scene, wear)",
    "SideBySide": "a comparison, fret.compare({...}, scene, path)",
    "Tabulated": "a study, fret.study.run(scene, {...}, measure=...)",
    "Study": "a study, fret.study.run(scene, {...}, measure=...)",
    "Damage": "fatigue damage, fatigue.damage(scene, history, material)",
    "LoadHistory": "a load history, fret.LoadHistory.from_csv('rig.csv')",
    "Material": "a material of fatigue, fatigue.Materials()['7075'], or its name",
    "Elastic": "an elastic material, fret.material('steel') or fret.Elastic(E=210e9, nu=0.3)",
    "Criterion": (
        "a criterion with its numbers, fatigue.Criterion.of('findley', material) or "
        "fatigue.Criterion.findley(k=0.3)"
    ),
    "Dataset": "an xarray.Dataset",
    "DataArray": "an xarray.DataArray",
}
#: Types of values that are no objects.
PLAIN = (bool, int, float, complex, str, bytes, list, tuple, dict, set, np.ndarray, np.generic)


#: Quantity of which a parameter takes a value for each layer.
OF_LAYERS = "residual stress"
#: Classes of values that are no numbers, wherever a number is taken.
NO_NUMBERS = (type, bytes, set, frozenset, BuiltinFunctionType, np.datetime64, np.timedelta64)
#: Whole numbers from here on are no floats.
LARGEST = 2**1024


def names_path(hint: Any) -> bool:
    """Return whether a type is a path."""
    return (typing.get_origin(hint) or hint) is os.PathLike


def is_text(hint: Any) -> bool:
    """Return whether a type is a text, a choice of texts, or a path."""
    if typing.get_origin(hint) is Literal:
        return all(isinstance(choice, str) for choice in typing.get_args(hint))
    return hint is str or names_path(hint)


def is_texts(hint: Any) -> bool:
    """Return whether a type is a sequence of texts."""
    items_of = [kind for kind in typing.get_args(hint) if kind is not Ellipsis]
    several = typing.get_origin(hint) in (Sequence, tuple, list)
    return several and bool(items_of) and all(is_text(m) for k in items_of for m in members(k))


def is_array(hint: Any) -> bool:
    """Whether a type is an array of numbers, or of what numpy makes one of."""
    if typing.get_origin(hint) is Annotated:
        hint = typing.get_args(hint)[0]
    return bool(hint == ArrayLike or hint == NDArray[np.float64])


def is_object(hint: Any) -> bool:
    """Whether a type is a class of pyfret, or another one that has an entry in the list MADE."""
    if isinstance(hint, Named) or getattr(hint, "__name__", "") in MADE:
        return hint.__name__ in MADE
    is_class_of_pyfret = isinstance(hint, type) and hint.__module__.partition(".")[0] == "pyfret"
    return is_class_of_pyfret and not issubclass(hint, (*PLAIN, enum.Enum))


def is_instance(value: Any, kind: type) -> bool:
    """Return whether a value is an instance of a class, or has the attributes of a protocol."""
    if isinstance(value, PLAIN):
        return False
    if isinstance(kind, Named):
        return kind.__name__ in {base.__name__ for base in type(value).__mro__}
    if not getattr(kind, "_is_protocol", False):
        return isinstance(value, kind)
    names = {*vars(kind), *getattr(kind, "__annotations__", {})}
    return all(hasattr(value, name) for name in names if not name.startswith("_"))


def has_unit(value: Any) -> bool:
    """Whether a value is a quantity of pint."""
    return hasattr(value, "magnitude") and hasattr(value, "units")


def short_repr(value: Any) -> str:
    """Return a plain value as it is written, and an object as the name of its class."""
    if not isinstance(value, PLAIN):
        return f"<{type(value).__name__}>"
    try:
        return f"{' '.join(repr(value).split()):.60}"
    except RecursionError:
        return f"<{type(value).__name__}>"


def choices_of(hint: Any) -> list[str]:
    """Return the texts that a type is a choice of."""
    if typing.get_origin(hint) is not Literal:
        return []
    return [choice for choice in typing.get_args(hint) if isinstance(choice, str)]


def fold_choice(text: str) -> str:
    """Return a choice in small letters, its words joined by ``_``: "Dang Van" is "dang_van"."""
    return text.lower().replace("-", "_").replace(" ", "_")


@dataclass(frozen=True)
class Remedy:
    """Metadata of a type: what to do with a value of another class, for its refusal."""

    text: str


def split_remedies(kinds: list[Any]) -> tuple[list[Any], str]:
    """Return types without their remedies, and the remedy."""
    plain, text = [], ""
    for kind in kinds:
        remedies = [m for m in getattr(kind, "__metadata__", ()) if isinstance(m, Remedy)]
        text = remedies[0].text if remedies else text
        plain += members(typing.get_args(kind)[0]) if remedies and not unit_of(kind) else [kind]
    return plain, text


class Parameter:
    """Rules for one parameter, from its type."""

    def __init__(self, name: str, hint: Any, default: Any) -> None:
        self.name, self.default = name, default
        arguments = members(hint)
        kinds = [kind for kind in arguments if kind is not type(None)]
        kinds, self.remedy = split_remedies(kinds)
        self.optional = len(kinds) < len(arguments) or default is None
        self.unit = next(filter(None, map(unit_of, kinds)), None)
        self.material = _core.Material in kinds or any(
            _core.Material in members(part) for kind in kinds for part in typing.get_args(kind)
        )
        #: Classes that a material makes, such as its threshold.
        self.laws = [kind for kind in kinds if hasattr(kind, "_of_material")]
        self.number = number_kind(kinds)
        self.mapping = any(typing.get_origin(kind) is Mapping for kind in kinds)
        self.mapping = self.mapping and str not in kinds
        if self.material:
            kinds = [kind for kind in kinds if kind is not str]
        self.objects = kinds if kinds and all(map(is_object, kinds)) else []
        #: Whether it takes texts alone, and whether these may be paths.
        self.text = bool(kinds) and all(map(is_text, kinds))
        self.texts = not self.text and bool(kinds)
        self.texts = self.texts and all(is_text(k) or is_texts(k) for k in kinds)
        self.function = bool(kinds) and all(typing.get_origin(k) is Callable for k in kinds)
        #: Whether it is a stress of each layer, of which a single one may be a number.
        several = any(typing.get_origin(kind) is Sequence for kind in kinds)
        self.layers = several and self.unit is not None and self.unit.quantity == OF_LAYERS
        #: Texts that it has a choice of, by their words in small letters.
        self.choices = {fold_choice(c): c for kind in kinds for c in choices_of(kind)}
        self.path = any(names_path(kind) for kind in kinds)
        parts = [typing.get_args(kind) for kind in kinds if len(kinds) == 1]
        self.items = parts[0][-1] if parts and parts[0] and is_object(parts[0][-1]) else None

    def read(self, value: Any) -> Any:
        """Convert a value to SI, find a material by its name, and check the type.

        Raises
        ------
        TypeError
            The value is of a class that the parameter does not take, or lists lie too deep in it.
        """
        try:
            return self.read_checked(value)
        except RecursionError:
            raise TypeError(f"{self.name}: lists lie too deep in it") from None

    def read_checked(self, value: Any) -> Any:
        """Convert and check a value whose lists are not too deep."""
        value = self.find(value)
        self.check_class(value)
        if self.choices and isinstance(value, str):
            value = self.choices.get(fold_choice(value), value)
        if self.layers and (has_unit(value) or isinstance(value, str | int | float)):
            assert self.unit is not None
            return [self.unit.convert(value)]
        if self.number is not None:
            value = self.convert(value)
        if value is None and self.number is not None and not self.optional:
            raise TypeError(f"{self.name} = None: must be given")
        if value is not None and value is not self.default:
            if self.number is not None and not has_unit(value):
                self.check_number(value)
            self.check_object(value)
        return items(value, self.name) if is_own_list(value) else value

    def warn(self, value: Any) -> None:
        """Warn of numbers outside the plausible range."""
        if value is not None and value is not self.default and self.unit and self.unit.has_range:
            self.unit.warn(self.name, value)

    def find(self, value: Any) -> Any:
        """Return the material of a name, converted to the class that the parameter takes."""
        if self.laws and isinstance(value, str | _core.Material):
            material = read_material(value, self.name) if isinstance(value, str) else value
            return self.laws[0].from_material(material)
        if not self.material:
            return value
        if type(value) in (list, tuple):
            return type(value)(map(self.find, value))
        number = self.number is not None and isinstance(value, str) and value[:1].isdigit()
        return read_material(value, self.name) if isinstance(value, str) and not number else value

    def convert(self, value: Any) -> Any:
        """Convert a text with a unit, or a quantity of pint, to SI."""
        if self.number in ("array", "several", "other") and type(value) in (list, tuple):
            rows = (str,) if self.layers else (str, list, tuple)
            if any(isinstance(item, rows) or has_unit(item) for item in value):
                return type(value)(map(self.convert, value))
            return value
        text = isinstance(value, str) and any(map(str.isdigit, value))
        if not (text and self.number not in ("text", "count")) and not has_unit(value):
            return value
        try:
            with_unit = self.unit is not None and self.unit.quantity
            return self.unit.convert(value) if with_unit else _core.si_of("", value)  # type: ignore[union-attr]
        except (TypeError, ValueError) as refused:
            hint = f"; {self.remedy}" if self.remedy else ""
            raise type(refused)(f"{self.name} = {refused}{hint}") from None

    def check_number(self, value: Any) -> None:
        """Refuse a value that is no number, or a missing one.

        Raises
        ------
        TypeError
            It is of another type.
        ValueError
            It is not a number, NaN.
        """
        name, kind = self.name, self.number
        if kind == "array":
            numbers(value, name)
            return
        if contains_booleans(value):
            raise TypeError(
                f"{name} = {value!r:.60}: must be a number, which True and False are not"
            )
        if isinstance(value, complex | np.complexfloating) or value is np.ma.masked:
            raise TypeError(f"{name} = {value!r:.60}: must be a real number")
        if isinstance(value, float | np.floating) and math.isnan(value):
            raise ValueError(f"{name} = nan: must be a number")
        if kind == "several" and isinstance(value, Sequence | np.ndarray):
            entries = value if isinstance(value, np.ndarray) else items(value, name)
            # Of a material the number is taken, of a layer without one nothing.
            plain = [item for item in entries if item is not None and not self.is_material(item)]
            if plain:
                numbers(plain, name)
        if kind != "text" and isinstance(value, str | bytes):
            digits = isinstance(value, str) and value.isascii() and value.isdigit()
            written = f": write {int(value)}" if digits else ""
            hint = f"; {self.remedy}" if self.remedy else ""
            message = f"{name} = {value!r:.60}: must be a number, not a text{written:.40}"
            raise TypeError(message + hint)
        single = np.ndim(value) == 0
        if kind == "count" and not (single and hasattr(value, "__index__")):
            raise TypeError(f"{name} = {value!r:.60}: must be a whole number")
        if kind == "number" and not (
            single and (hasattr(value, "__float__") or hasattr(value, "__index__"))
        ):
            raise TypeError(f"{name} = {' '.join(repr(value).split()):.60}: must be a number")

    def check_class(self, value: Any) -> None:
        """Refuse a value of a class that no number and no text is made of.

        Raises
        ------
        TypeError
            The text has the name of the parameter.
        ValueError
            It is a whole number beyond the largest float.
        """
        if value is None or value is self.default:
            return
        if self.text and not isinstance(value, (str, os.PathLike) if self.path else str):
            allowed = "a path, such as 'file.csv'" if self.path else "a text"
            remedy = f"; {self.remedy}" if self.remedy else ""
            raise TypeError(f"{self.name} = {short_repr(value)}: must be {allowed}{remedy}")
        if self.texts and not isinstance(value, str | os.PathLike):
            several = isinstance(value, Sequence | np.ndarray | set | frozenset)
            if not several or not all(isinstance(i, str | os.PathLike) for i in value):
                raise TypeError(f"{self.name} = {short_repr(value)}: must be a text, or several")
        if self.function and not callable(value):
            raise TypeError(f"{self.name} = {short_repr(value)}: must be a function")
        if self.number is None and not self.layers:
            return
        if isinstance(value, NO_NUMBERS) or (isinstance(value, dict) and not self.mapping):
            raise TypeError(f"{self.name} = {short_repr(value)}: must be a number, or several")
        if isinstance(value, int) and not -LARGEST < value < LARGEST:
            raise ValueError(f"{self.name}: is a whole number beyond 1.8e308")

    def is_material(self, value: Any) -> bool:
        """Whether a value is a material in the place of its number."""
        return self.material and isinstance(value, _core.Material)

    def check_object(self, value: Any) -> None:
        """Refuse an object of another class, with how one of the right class is made.

        Raises
        ------
        TypeError
            It is of another class.
        """
        name = self.name
        if self.mapping and not isinstance(value, Mapping):
            raise TypeError(f"{name} = {short_repr(value)}: must be a mapping of names")
        if self.items is not None and isinstance(value, str | bytes):
            several = f"several of the class {self.items.__name__}"
            raise TypeError(f"{name} = {short_repr(value)}: must be {several}")
        inner = value.items() if self.mapping and self.items is not None else ()
        for key, item in inner:
            Parameter(f"{name}[{key!r}]", self.items, inspect.Parameter.empty).check_object(item)
        if not self.objects or any(is_instance(value, kind) for kind in self.objects):
            return
        names = [kind.__name__ for kind in self.objects]
        kinds = " or ".join(MADE.get(kind, f"of the class {kind}") for kind in names)
        hint = ""
        if "Dataset" in names and hasattr(value, "dataset"):
            # A method with the name of the parameter makes its table.
            makes = callable(getattr(value, name, None))
            hint = f", its .{name}()" if makes else ", its .dataset"
        raise TypeError(f"{name} = {short_repr(value)}: must be {kinds}{hint}")


def unit_of(hint: Any) -> Unit | None:
    """Return the unit of a type, or of the items of a sequence."""
    if typing.get_origin(hint) is Annotated:
        return next((data for data in hint.__metadata__ if isinstance(data, Unit)), None)
    inner = (unit_of(member) for part in typing.get_args(hint) for member in members(part))
    return next(filter(None, inner), None)


#: Types for which True is a value, or whose numbers lie deeper.
UNCHECKED = (bool, Any, Callable, Mapping, dict)


def number_kind(kinds: list[Any]) -> str | None:
    """Return the kind of a parameter: count, number, array, several, text; None for others."""
    leaves = set(map(leaf, kinds))
    if "unchecked" in leaves or not leaves & {"number", "count", "array", "several", "counts"}:
        return None
    if len(leaves) == 1:
        (only,) = leaves
        return "other" if only == "counts" else only
    return next((kind for kind in ("text", "several") if kind in leaves), "other")


def leaf(hint: Any) -> str:
    """Classify a member of a union."""
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if hint in UNCHECKED or origin in UNCHECKED:
        return "unchecked"
    if origin is Annotated:
        unit = unit_of(hint)
        if unit is None or not unit.checked:
            return "unchecked"
        return "array" if is_array(hint) else "number"
    if hint == NDArray[np.float64]:
        return "array"
    if hint is str or origin is Literal:
        return "text"
    if hint in (float, int):
        return "number" if hint is float else "count"
    inner = {leaf(member) for part in arguments for member in members(part)}
    if "number" in inner:
        return "several" if origin is Sequence else "counts"
    return "counts" if "count" in inner else "object"


def read_array(name: str, value: Any, quantity: str, si: str) -> Any:
    """Return an array of quantities with numbers in SI units in place of texts and quantities."""
    return Parameter(name, Annotated[ArrayLike, Unit(quantity, si)], None).convert(value)


register_units(read_array)


class Signature:
    """Names and rules of the parameters of a function, or of the constructor of a dataclass."""

    def __init__(self, call: Callable[..., Any], dataclass: type | None = None) -> None:
        self.parameters = inspect.signature(call).parameters
        hints = read_hints(dataclass or call, globals())
        self.names = list(self.parameters)
        self.keywords: list[str] | None = []
        self.rules = {}
        for name, parameter in self.parameters.items():
            if parameter.kind is parameter.VAR_KEYWORD:
                options, *marks = typing.get_args(hints.get(name)) or (None,)
                option_names = list(options.__annotations__) if Options in marks else None
                self.keywords = (
                    None if option_names is None else [*(self.keywords or ()), *option_names]
                )
            elif parameter.kind is not parameter.VAR_POSITIONAL and name in hints:
                self.rules[name] = Parameter(name, hints[name], parameter.default)
            if parameter.kind in NAMED and name != "self" and self.keywords is not None:
                self.keywords.append(name)


#: Parameters that are given by name.
NAMED = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)


def is_own_list(value: Any) -> bool:
    """Whether a value is of a class derived from list, whose length is not trusted."""
    return isinstance(value, list) and type(value) is not list
