"""The compiled module refuses wrong arguments as the functions of Python do.

The module itself calls :func:`guard` when it is loaded, so that nothing stands outside.
"""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Sequence
from types import BuiltinFunctionType, MethodDescriptorType
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._util.keywords import check_places, nearest_names, unknown_keyword
from pyfret._util.names import meant
from pyfret._util.refusals import refuse_clearly

if TYPE_CHECKING:
    from types import ModuleType

__all__ = ["guard", "register_materials", "register_units"]

#: The class that a constructor gets.
CLASS = inspect.Parameter("cls", inspect.Parameter.POSITIONAL_ONLY)
#: Ways of a load cycle in the closed forms.
LOADINGS = ("loading", "reloading", "unloading")
#: Parameters that are given by name.
NAMED = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)


def guard(module: ModuleType, constructors: dict[type, Callable[..., Any]]) -> None:
    """Put the functions, methods and constructors of a module behind :func:`refusing`.

    Parameters
    ----------
    module : module
        It changes in place.
    constructors : dict of type to callable
        What makes an object of a class, from the class and the arguments.
    """
    for name, member in list(vars(module).items()):
        if isinstance(member, BuiltinFunctionType):
            setattr(module, name, refusing(taking_materials(member), name))
        elif isinstance(member, type) and not issubclass(member, BaseException):
            guard_methods(member)
            members = [key for key in vars(member) if isinstance(getattr(member, key), member)]
            if member in constructors and member.__text_signature__ is not None:
                guard_constructor(member, constructors[member])
            elif members:
                refuse_construction(member, members)


#: The compiled methods by class and name. Their signatures are read for a refusal alone.
METHODS: dict[str, dict[str, MethodDescriptorType]] = {}
#: Methods that take any keyword, and the method whose keywords they take in turn.
OTHERS_TAKE = {"LoadPath.waypoints": "LoadPath.force"}


def guard_methods(kind: type) -> None:
    """Put the methods of a class behind :func:`refusing`."""
    METHODS[kind.__name__] = {
        key: member
        for key, member in vars(kind).items()
        if isinstance(member, MethodDescriptorType) and not key.startswith("_")
    }
    for key, member in list(vars(kind).items()):
        if key.startswith("_"):
            continue
        name = f"{kind.__name__}.{key}"
        if isinstance(member, MethodDescriptorType):
            setattr(kind, key, refusing(taking_units(member, name), name))
        elif isinstance(member, staticmethod):
            function = taking_materials(member.__func__)
            setattr(kind, key, staticmethod(refusing(function, name)))


def guard_constructor(kind: type, make: Callable[..., Any]) -> None:
    """Put the constructor of a class behind :func:`refusing`."""
    signature = inspect.signature(kind)
    parameters = material_parameters(kind)

    def __new__(cls: type, /, *values: Any, **keywords: Any) -> Any:  # noqa: N807
        if parameters:
            values, keywords = with_materials(parameters, values, keywords)
        return make(cls, *values, **keywords)

    __new__.__signature__ = signature.replace(parameters=[CLASS, *signature.parameters.values()])  # type: ignore[attr-defined]
    __new__.__doc__ = kind.__doc__
    __new__.__qualname__ = f"{kind.__qualname__}.__new__"
    __new__.__module__ = kind.__module__
    kind.__new__ = staticmethod(refusing(__new__, kind.__name__))  # type: ignore[method-assign]


#: Elastic materials among the parameters of constructors and functions: they take the names of the
#: table, too. A test compares them with the signatures.
MATERIALS = {
    "Body": ("substrate",),
    "Coating": ("material",),
    **dict.fromkeys(("CattaneoMindlin", "Lubkin", "Springs", "hertz", "line_contact"), ("bodies",)),
    "coated_indentation": ("indenter", "substrate"),
    "dundurs_beta": ("body1", "body2"),
    **dict.fromkeys(("channel_crack", "partial_crack"), ("film_", "below")),
    "of_layer": ("material",),
}
#: The function that reads a material by its name: one, once the package is imported.
MATERIAL_READERS: list[Callable[[Any, str], Any]] = []


def material_parameters(call: Any) -> tuple[tuple[int, str], ...]:
    """Return the elastic materials among the parameters of a function, with their places."""
    taken = MATERIALS.get(call.__name__, ())
    if not taken:
        return ()
    parameters = inspect.signature(call).parameters
    return tuple((index, name) for index, name in enumerate(parameters) if name in taken)


def taking_materials(call: Callable[..., Any]) -> Callable[..., Any]:
    """Return a function that takes materials by their names, or the function itself."""
    parameters = material_parameters(call)
    if not parameters:
        return call

    @functools.wraps(call)
    def with_names(*values: Any, **keywords: Any) -> Any:
        values, keywords = with_materials(parameters, values, keywords)
        return call(*values, **keywords)

    return with_names


def with_materials(
    parameters: Sequence[tuple[int, str]], values: tuple[Any, ...], keywords: dict[str, Any]
) -> tuple[tuple[Any, ...], dict[str, Any]]:
    """Return arguments with elastic materials in place of names or rows of the table."""
    for read in MATERIAL_READERS:
        for index, name in parameters:
            if index < len(values):
                material = read_materials(read, values[index], name)
                values = (*values[:index], material, *values[index + 1 :])
            elif name in keywords:
                keywords = {**keywords, name: read_materials(read, keywords[name], name)}
    return values, keywords


def read_materials(read: Callable[[Any, str], Any], value: Any, name: str) -> Any:
    """Return the material of a name, or of each name of a pair."""
    if name != "bodies":
        return read(value, name)
    is_pair = isinstance(value, tuple | list)
    return tuple(read(item, name) for item in value) if is_pair else value


def register_materials(read: Callable[[Any, str], Any]) -> None:
    """Enter the function that reads a material by its name, from a value and its parameter."""
    MATERIAL_READERS[:] = [read]


LENGTH, FORCE = ("length", "m"), ("load of a closed form", "N")
#: Arrays of quantities among the parameters of methods, with their quantity and unit: they take
#: texts with units, too. A test compares them with the signatures.
ARRAYS: dict[str, dict[str, tuple[str, str]]] = {
    **{f"CattaneoMindlin.q_{loading}": {"r": LENGTH} for loading in LOADINGS},
    **{f"CattaneoMindlin.shift_{loading}": {"T": FORCE} for loading in LOADINGS},
    **{name: {"r": LENGTH} for name in ("CoatedIndentation.p", "Hertz.p", "Lubkin.q")},
    **{f"HertzStress.{name}": dict.fromkeys("xyz", LENGTH) for name in ("pressure", "shear")},
    **{f"LineContact.{name}": {"x": LENGTH} for name in "pq"},
    "LineContact.stress": dict.fromkeys("xz", LENGTH),
    **{f"Lubkin.{name}": {"c": LENGTH} for name in ("M_z", "phi")},
}
#: The function that reads an array of quantities: one, once the package is imported.
UNIT_READERS: list[Callable[[str, Any, str, str], Any]] = []


def taking_units(call: Callable[..., Any], name: str) -> Callable[..., Any]:
    """Return a method whose arrays of quantities may be texts with units, or the method itself."""
    arrays = ARRAYS.get(name)
    if arrays is None:
        return call
    # The places begin behind the object.
    places = {key: index for index, key in enumerate(inspect.signature(call).parameters)}

    @functools.wraps(call)
    def with_units(*values: Any, **keywords: Any) -> Any:
        for key, unit in arrays.items():
            if key in keywords:
                keywords = {**keywords, key: in_si(key, keywords[key], unit)}
            elif (at := places[key]) < len(values):
                values = (*values[:at], in_si(key, values[at], unit), *values[at + 1 :])
        return call(*values, **keywords)

    return with_units


def in_si(name: str, value: Any, unit: tuple[str, str]) -> Any:
    """Return a value or a list with numbers in SI units in place of texts and quantities."""
    for read in UNIT_READERS:
        value = read(name, value, *unit)
    return value


def register_units(read: Callable[[str, Any, str, str], Any]) -> None:
    """Enter the function that reads an array, from its name, value, quantity and unit."""
    UNIT_READERS[:] = [read]


def refuse_construction(kind: type, members: list[str]) -> None:
    """Let the constructor of a class that has members alone name these."""

    def __new__(cls: type, /, *_: Any, **__: Any) -> Any:  # noqa: N807
        every = ", ".join(f"{cls.__name__}.{name}" for name in members)
        raise TypeError(f"{cls.__name__} is not made: it is one of {every}")

    __new__.__signature__ = inspect.Signature([CLASS])  # type: ignore[attr-defined]
    __new__.__module__, __new__.__qualname__ = kind.__module__, f"{kind.__qualname__}.__new__"
    kind.__new__ = staticmethod(__new__)  # type: ignore[method-assign]


def refusing(call: Callable[..., Any], name: str) -> Callable[..., Any]:
    """Return a function whose refusal of an unknown keyword names the nearest known one."""

    def parameters() -> list[inspect.Parameter]:
        """Return the parameters of the function, read at the first refusal."""
        return list(inspect.signature(call).parameters.values())

    return refuse_clearly(
        call,
        name,
        lambda: [parameter.name for parameter in parameters()],
        lambda values, keywords: refuse_call(name, parameters(), values, keywords),
    )


def named_parameters(call: Callable[..., Any]) -> tuple[str, ...]:
    """Return the names of the parameters that can be given by keyword."""
    if getattr(call, "__text_signature__", None) is None:
        return ()
    parameters = inspect.signature(call).parameters.values()
    return tuple(parameter.name for parameter in parameters if parameter.kind in NAMED)


def taken_elsewhere(call: str, keyword: str) -> str:
    """Return a clause that names the methods of a class which take a keyword or its synonym."""
    kind, _, method = call.partition(".")
    siblings = {key: named_parameters(member) for key, member in METHODS.get(kind, {}).items()}
    takers = []
    for name in siblings:
        source = OTHERS_TAKE.get(f"{kind}.{name}", f"{kind}.{name}").partition(".")[2]
        keys = siblings.get(source, ())
        if name != method and (keyword in keys or meant(keyword, keys)):
            word = keyword if keyword in keys else meant(keyword, keys)[0]
            takers.append(f"{kind}.{name}({word}=...)")
    return f"; it is an argument of {' and '.join(takers)}" if takers else ""


def refuse_call(
    name: str, parameters: list[inspect.Parameter], values: Sequence[Any], keywords: dict[str, Any]
) -> TypeError | None:
    """Return the refusal of arguments with unknown names or too many values; None if they fit."""
    # The first value of a constructor is the class.
    if name == "Material" and len(values) == 2 and not keywords:
        return TypeError(
            f"Material takes a name and numbers; {str(values[1])[:60]!r} of the table is "
            f"fret.fatigue.Materials()[{str(values[1])[:60]!r}]"
        )
    if name == "LoadPath.force":
        for key, value in keywords.items():
            if not isinstance(value, str) and hasattr(value, "__len__") and np.ndim(value):
                several = f"LoadPath.waypoints({key}=[...], increments=PerRange(40))"
                return TypeError(
                    f"{key}: must be a number, for one branch; {several} takes several"
                )
    if not any(parameter.kind is parameter.VAR_KEYWORD for parameter in parameters):
        keys = [parameter.name for parameter in parameters if parameter.kind in NAMED]
        keys = [key for key in keys if key != "self"]
        refusal = unknown_keyword(name, keywords, keys)
        if refusal is not None:
            unknown = next(key for key in keywords if key not in keys)
            elsewhere = "" if nearest_names(unknown, keys, 1) else taken_elsewhere(name, unknown)
            return TypeError(f"{refusal}{elsewhere}")
    return check_places(name, parameters, values)
