"""The dataset of a run in memory."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from pyfret._util.lazy import xr

if TYPE_CHECKING:
    from collections.abc import Mapping

    from pyfret._util.types import Variable

__all__ = ["dataset"]

#: Variables that are coordinates, as in a store.
COORDINATES = frozenset(
    (
        *("x", "y", "increment", "t", "branch_of_increment", "saved_increment", "saved_t"),
        *("cycles", "block_cycles"),
    )
)


def dataset(variables: Mapping[str, Variable], attributes: str) -> xr.Dataset:
    """Make a dataset of variables (dimensions, values, attributes) and of attributes as JSON."""
    attrs = json.loads(attributes)
    # A store lists its coordinates.
    attrs.pop("coordinates", None)
    return xr.Dataset(
        {k: variable for k, variable in variables.items() if k not in COORDINATES},
        coords={k: variable for k, variable in variables.items() if k in COORDINATES},
        attrs=attrs,
    )
