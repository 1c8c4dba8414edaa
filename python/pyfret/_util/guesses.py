"""What to say where a name is asked for that is not there."""

from __future__ import annotations

from difflib import get_close_matches
from typing import TYPE_CHECKING

from pyfret._util.lazy import xr

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

__all__ = ["no_attribute"]


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
