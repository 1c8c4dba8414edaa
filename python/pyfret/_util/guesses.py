"""Messages for a name that is not there: of an attribute, of an argument."""

from __future__ import annotations

import enum
import sys
from difflib import get_close_matches
from typing import TYPE_CHECKING, Any

from pyfret._util.lazy import xr

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

__all__ = ["no_attribute", "offer_nearest", "refuse_unknown"]

#: Classes whose missing names are another library's matter, or that only describe types.
OTHERS = (BaseException, enum.Enum, dict)


def alike(name: str, known: Iterable[str], most: int) -> list[str]:
    """The names that are nearest to one, whatever the case of their letters."""
    lower = {one.lower(): one for one in known}
    return [lower[one] for one in get_close_matches(name.lower(), lower, n=most)]


def refuse_unknown(what: str, given: Iterable[str], known: Sequence[str]) -> None:
    """Refuse a keyword that is unknown, with the nearest one and all others.

    Raises
    ------
    TypeError
        One of the names is none of those known.
    """
    for name in given:
        if name not in known:
            near = alike(name, known, 1)
            every = ", ".join(known) or "none"
            hint = f"the nearest is {near[0]!r} (of {every})" if near else f"it takes {every}"
            raise TypeError(f"{what} has no argument {name!r}: {hint}")


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
    if "dataset" in known and hasattr(xr.Dataset, name):
        return AttributeError(f"{message}: the xarray.Dataset has, {owner}.dataset.{name}")
    names = sorted(known)
    near = alike(name, names, 3)
    if near:
        return AttributeError(f"{message}; did you mean {' or '.join(near)}?")
    return AttributeError(f"{message}; it has {', '.join(names)}")


def missing(self: Any, name: str) -> Any:
    """Give a variable of the dataset, or refuse the name with the nearest that there is.

    It is the ``__getattr__`` of classes without one.
    """
    of = type(self)
    if name.startswith("_"):
        raise AttributeError(f"{of.__name__!r} object has no attribute {name!r}")
    if any(name in vars(one) for one in of.__mro__):
        # A property that failed says why by itself.
        return object.__getattribute__(self, name)
    variables = self.dataset if hasattr(of, "dataset") else None
    if isinstance(variables, xr.Dataset) and name in variables.variables:
        return variables[name]
    public = [one for one in dir(self) if not one.startswith("_")]
    # Names that others have, and where what they mean is.
    raise no_attribute(of.__name__, name, public, getattr(of, "_meant", {}))


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
