"""Messages for a name that is not there: of an attribute, of an argument."""

from __future__ import annotations

from difflib import get_close_matches
from typing import TYPE_CHECKING

from pyfret._util.lazy import xr

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

__all__ = ["no_attribute", "refuse_unknown"]


def refuse_unknown(what: str, given: Iterable[str], known: Sequence[str]) -> None:
    """Refuse a keyword that is unknown, with the nearest one and all others.

    Raises
    ------
    TypeError
        One of the names is none of those known.
    """
    for name in given:
        if name not in known:
            near = get_close_matches(name, known, n=1)
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
    message = f"a {owner} has no {name!r}"
    if name in elsewhere:
        return AttributeError(f"{message}: {elsewhere[name]}")
    if hasattr(xr.Dataset, name):
        return AttributeError(f"{message}: the xarray.Dataset has, {owner}.dataset.{name}")
    names = sorted(known)
    near = get_close_matches(name, names, n=3)
    if near:
        return AttributeError(f"{message}; did you mean {' or '.join(near)}?")
    return AttributeError(f"{message}; it has {', '.join(names)}")
