"""Errors for a missing attribute: where its number is, or the nearest name."""

from __future__ import annotations

import inspect
from typing import TYPE_CHECKING, Any, NoReturn

from pyfret._util.keywords import nearest_names
from pyfret._util.lazy import xr
from pyfret._util.names import meant

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from types import ModuleType

__all__ = [
    "attribute_error",
    "dataset_attribute",
    "dataset_item",
    "dataset_names",
    "missing_attribute",
]

#: Modules of the public face that are loaded, by their names; the package enters them.
PUBLIC_MODULES: dict[str, ModuleType] = {}
#: Calls that print, draw and write an object, and what they do.
OUTPUTS = {
    "summary": "summary() describes",
    "plot": "plot() draws",
    "to_csv": 'to_csv("numbers.csv") writes',
    "to_dataframe": "to_dataframe() returns",
    "to_excel": 'to_excel("numbers.xlsx") writes',
    "save": 'save("saved.nc") writes',
}
#: Objects that draw and write the numbers of another class, as they are called in examples.
OWNERS = {
    "CrackArrest": "crack",
    "CrackLife": "crack",
    "CyclicResponse": "result",
    "Errors": "stress",
    "Extremum": "stress",
    "Form": "surface",
    "LifeRange": "life",
    "LoadPath": "fret.solve(scene, path)",
    "Place": "stress",
    "Posterior": "fitted",
    "Range": "life",
    "Scene": "fret.solve(scene)",
    "Statistics": "surface",
    "Zone": "result",
}
#: Numbers of the table of materials that an elastic material does not have.
TABLE = {
    **dict.fromkeys(("hardness", "h", "hv"), "hardness"),
    **dict.fromkeys(("yield_strength", "yield_stress", "yield_", "s_y", "rp02"), "s_y"),
    **dict.fromkeys(("conductivity", "thermal_conductivity"), "conductivity"),
    **dict.fromkeys(("density", "rho"), "density"),
    **dict.fromkeys(("fatigue_limit", "endurance_limit", "s_d"), "s_D"),
}
#: Kinds of parameters that a call needs if they have no default.
NEEDED = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)
#: Dimensions of a dataset that are coordinates of points.
PLACES = ("x", "y", "s", "z", "depth")


def public_functions(name: str) -> list[str]:
    """Return the calls of the public functions with a name; figures once their module is loaded."""
    modules = PUBLIC_MODULES.items()
    return [f"fret.{key}.{name}(...)" for key, module in modules if name in module.__all__]


def attribute_error(
    owner: str, name: str, known: Iterable[str], elsewhere: Mapping[str, str]
) -> AttributeError:
    """Return the error for an attribute that does not exist, with the attribute to use instead.

    Parameters
    ----------
    owner : str
        Object, such as ``"result"``.
    name : str
        Name of the attribute.
    known : iterable of str
        Names of its attributes.
    elsewhere : mapping of str to str
        Names of other objects' attributes, and how they are reached from the owner.
    """
    names = sorted(set(known))
    article = "an" if owner[:1] in "AEIOaeio" else "a"
    message = f"{article} {owner} has no {name!r}"
    if name in elsewhere:
        return AttributeError(f"{message}: {elsewhere[name]}")
    if synonyms := meant(name, names):
        return AttributeError(f"{message}: it is called {' and '.join(synonyms)}")
    if "dataset" in names and hasattr(xr.Dataset, name):
        return AttributeError(f"{message}: the xarray.Dataset has, {owner}.dataset.{name}")
    if functions := public_functions(name):
        return AttributeError(f"{message}: it is a function, {' or '.join(functions)}")
    if near := nearest_names(name, names, 3):
        return AttributeError(f"{message}; did you mean {' or '.join(near)}?")
    return AttributeError(f"{message}; it has {', '.join(names)}")


def missing_attribute(self: Any, name: str, elsewhere: Mapping[str, str] | None = None) -> NoReturn:
    """Refuse an attribute: the ``__getattr__`` of classes without a dataset.

    Raises
    ------
    AttributeError
        The message has the nearest name, or where the number is.
    """
    kind = type(self)
    if name.startswith("_"):
        raise AttributeError(f"{kind.__name__!r} object has no attribute {name!r}")
    if any(name in vars(base) for base in kind.__mro__):
        # A property that failed has its own error.
        object.__getattribute__(self, name)
    public = [member for member in dir(self) if not member.startswith("_")]
    if kind.__name__ == "Elastic" and (of_table := TABLE.get(name.lower())):
        row = 'fret.fatigue.Materials()["Ti-6Al-4V"]'
        hint = f"it is a number of the table of materials, {row}.number({of_table!r})"
        raise attribute_error(kind.__name__, name, public, {name: hint})
    if kind.__name__ == "Elastic" and name in ("summary", "table", "sources"):
        listed = "the numbers of a material with their sources are fret.materials(sources=True)"
        raise attribute_error(kind.__name__, name, public, {name: f'{listed}.loc["TiN"]'})
    # A word for a method of its own comes before another way to write or draw the whole.
    outputs = {k: call for k, call in output_calls(kind).items() if not meant(k, sorted(public))}
    synonyms = [call_of(kind, synonym) for synonym in meant(name, sorted(public))]
    called = {name: f"it is called {' and '.join(synonyms)}"} if synonyms else {}
    where = {**outputs, **called, **(elsewhere or {})}
    raise attribute_error(kind.__name__, name, public, where)


def call_of(kind: type, name: str) -> str:
    """Return a method with what it needs, ``preference(of)``, or the name of a property."""
    method = inspect.getattr_static(kind, name, None)
    if not callable(method):
        return name
    _, *parameters = inspect.signature(method).parameters.values()
    needed = [p.name for p in parameters if p.default is p.empty and p.kind in NEEDED]
    return f"{name}({', '.join(needed)})"


def output_calls(kind: type) -> dict[str, str]:
    """Return what prints, draws or writes an object of a class that cannot do so itself."""
    owner = next((OWNERS[base.__name__] for base in kind.__mro__ if base.__name__ in OWNERS), None)
    printed = "print(x) gives its numbers"
    if owner is None:
        written = "to_csv(path) writes its numbers" if hasattr(kind, "to_csv") else printed
        return {**dict.fromkeys(OUTPUTS, written), "summary": printed}
    kept = "its numbers are attributes"
    calls = {name: f"{kept}; {owner}.{call} the whole" for name, call in OUTPUTS.items()}
    return {**calls, "summary": printed}


def dataset_attribute(self: Any, name: str) -> Any:
    """Return a variable or an attribute of the dataset: the ``__getattr__`` of classes with one.

    Raises
    ------
    AttributeError
        There is none; the message has the nearest name.
    """
    is_internal = name.startswith("_") or any(name in vars(base) for base in type(self).__mro__)
    if is_internal:
        missing_attribute(self, name)
    dataset = self.dataset
    if name in dataset.variables:
        return dataset[name]
    if name in dataset.attrs:
        return dataset.attrs[name]
    dims = ", ".join(f"{dim}=-1" for dim in map(str, dataset.sizes) if dim not in PLACES)
    last = {"at": f"its last numbers are its .dataset.isel({dims})"} if dims else {}
    first = next(map(str, dataset.data_vars), "")
    drawn = {"plot": f"xarray draws its numbers, .dataset[{first!r}].plot()"}
    missing_attribute(self, name, {**drawn, "save": "it is written by .to_csv(path)", **last})


def dataset_item(self: Any, name: str, hint: str = "") -> Any:
    """Return an array of an object by its name: the ``__getitem__`` of classes with a dataset.

    Parameters
    ----------
    self : object
        Its attribute ``dataset`` has the variables. Other arrays are attributes of it.
    name : str
        Name of the array.
    hint : str
        Clause for a key that is no name.

    Raises
    ------
    TypeError
        The key is no text.
    KeyError
        There is no such array; the message has the nearest names.
    """
    dataset = self.dataset
    if not isinstance(name, str):
        first = next(map(str, dataset.data_vars), "")
        raise TypeError(f"{name!r:.60}: must be the name of a variable, such as {first!r}{hint}")
    if name in dataset.variables:
        return dataset[name]
    try:
        array = getattr(self, name)
    except AttributeError as error:
        raise KeyError(str(error)) from None
    if not isinstance(array, xr.DataArray):
        raise KeyError(f"{name!r:.60} is no array: it is the attribute .{name}")
    return array


def dataset_names(dataset: xr.Dataset) -> list[str]:
    """Return the names of variables and attributes of a dataset that are identifiers."""
    names = [str(name) for name in (*dataset.variables, *dataset.attrs)]
    return [name for name in names if name.isidentifier() and not name.startswith("_")]
