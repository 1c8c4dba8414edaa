"""Messages for a name that is not there: of an attribute, of an argument."""

from __future__ import annotations

import enum
import inspect
import sys
from difflib import get_close_matches
from typing import TYPE_CHECKING, Any

from pyfret._util.lazy import xr
from pyfret._util.names import meant
from pyfret._util.takers import called as call_name
from pyfret._util.takers import functions, takers

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

__all__ = [
    "missing",
    "names_of",
    "no_attribute",
    "offer_nearest",
    "refuse_unknown",
    "too_many",
    "unknown",
]

#: Classes whose missing names are another library's matter, or that only describe types.
OTHERS = (BaseException, enum.Enum, dict)
#: Parameters that are given by place.
PLACED = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
#: Dimensions of a dataset that are places.
PLACES = ("x", "y", "s", "z", "depth")


def alike(name: str, known: Iterable[str], most: int) -> list[str]:
    """The names that are nearest to one: those that it means to others, or those alike."""
    lower = {one.lower(): one for one in known}
    near = [lower[one] for one in get_close_matches(name.lower(), lower, n=most)]
    return (meant(name, list(lower.values())) or near)[:most]


def unknown(
    what: str, call: Callable[..., Any], given: Iterable[str], known: Sequence[str] | None
) -> TypeError | None:
    """The refusal of a keyword that is unknown: with the nearest one and all others.

    Parameters
    ----------
    what : str
        The function, with its class: ``"Result.life"``.
    call : callable
        The function itself. Others of the same object that take the keyword are named.
    given, known : names
        Keywords that were given, and those that it takes: None where these are any.
    """
    for name in given:
        if known is not None and name not in known:
            near = alike(name, known, 1)
            every = ", ".join(known) or "none"
            hint = f"the nearest is {near[0]!r} (of {every})" if near else f"it takes {every}"
            others = takers(what, call, name, anywhere=not near)
            if others:
                hint += f". It belongs to {' or '.join(f'{of}({name}=...)' for of in others)}"
            return TypeError(f"{what} has no argument {name!r}: {hint}")
    return None


def refuse_unknown(
    what: str, call: Callable[..., Any], given: Iterable[str], known: Sequence[str] | None
) -> None:
    """Refuse a keyword as :func:`unknown` does.

    Raises
    ------
    TypeError
        One of the names is none of those known.
    """
    refusal = unknown(what, call, given, known)
    if refusal is not None:
        raise refusal


def too_many(
    what: str, parameters: Iterable[inspect.Parameter], values: Sequence[Any]
) -> TypeError | None:
    """The refusal of values by place of parameters that are given by name, where there are any."""
    parameters = list(parameters)
    places = [one.name for one in parameters if one.kind in PLACED]
    by_name = [one.name for one in parameters if one.kind is inspect.Parameter.KEYWORD_ONLY]
    many = any(one.kind is one.VAR_POSITIONAL for one in parameters)
    if many or not by_name or len(values) <= len(places):
        return None
    first = "".join(f"{name}, " for name in places if name not in ("self", "cls"))
    wanted = ", ".join(f"{name}=..." for name in by_name)
    return TypeError(f"{what} takes arguments by name, {what}({first}{wanted})")


def no_attribute(
    owner: str, name: str, known: Iterable[str], elsewhere: Mapping[str, str]
) -> AttributeError:
    """Say that there is no such attribute, and where what was meant may be.

    Parameters
    ----------
    owner : str
        What was asked, such as ``"result"``.
    name : str
        The name that it does not have.
    known : iterable of str
        Names that it has.
    elsewhere : mapping of str to str
        Names that others have, and how they are got from the owner.
    """
    known = list(known)
    article = "an" if owner[:1] in "AEIOaeio" else "a"
    message = f"{article} {owner} has no {name!r}"
    if name in elsewhere:
        return AttributeError(f"{message}: {elsewhere[name]}")
    names = sorted(set(known))
    if called := meant(name, names):
        return AttributeError(f"{message}: it is called {' and '.join(called)}")
    if "dataset" in known and hasattr(xr.Dataset, name):
        return AttributeError(f"{message}: the xarray.Dataset has, {owner}.dataset.{name}")
    if of_package := functions(name):
        return AttributeError(f"{message}: it is a function, {' or '.join(of_package)}")
    near = alike(name, names, 3)
    if near:
        return AttributeError(f"{message}; did you mean {' or '.join(near)}?")
    return AttributeError(f"{message}; it has {', '.join(names)}")


def missing(self: Any, name: str) -> Any:
    """Give a variable or an attribute of the dataset, or refuse the name with the nearest.

    It is the ``__getattr__`` of classes without one.
    """
    of = type(self)
    if name.startswith("_"):
        raise AttributeError(f"{of.__name__!r} object has no attribute {name!r}")
    if any(name in vars(one) for one in of.__mro__):
        # A property that failed says why by itself.
        return object.__getattribute__(self, name)
    variables = self.dataset if hasattr(of, "dataset") else None
    if isinstance(variables, xr.Dataset):
        if name in variables.variables:
            return variables[name]
        if name in variables.attrs:
            return variables.attrs[name]
    public = [one for one in dir(self) if not one.startswith("_")]
    # Names that others have, and where what they mean is.
    elsewhere = dict(getattr(of, "_meant", {}))
    if isinstance(variables, xr.Dataset) and variables.sizes:
        dims = ", ".join(f"{dim}=-1" for dim in map(str, variables.sizes) if dim not in PLACES)
        if dims:
            called = call_name(of)
            elsewhere.setdefault("at", f"its last numbers are {called}.dataset.isel({dims})")
    raise no_attribute(of.__name__, name, public, elsewhere)


def names_of(dataset: xr.Dataset) -> list[str]:
    """Names that a thing with a dataset has by it: of its variables and of its attributes."""
    named = [str(of) for of in (*dataset.variables, *dataset.attrs)]
    return [of for of in named if of.isidentifier() and not of.startswith("_")]


def offer_nearest() -> None:
    """Let every class of the package, compiled or not, offer the nearest name that it has.

    A class with a ``__getattr__`` of its own keeps it.
    """
    for module_name, module in list(sys.modules.items()):
        if module_name.partition(".")[0] != "pyfret":
            continue
        for of in list(vars(module).values()):
            own = isinstance(of, type) and of.__module__.partition(".")[0] == "pyfret"
            if own and not hasattr(of, "__getattr__") and not issubclass(of, OTHERS):
                of.__getattr__ = missing
