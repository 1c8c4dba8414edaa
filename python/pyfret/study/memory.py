"""A study that is kept in memory, with the contents of a store."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._util.lazy import xr
from pyfret.study.point import FAILED, PARTLY
from pyfret.study.store import POINT_VARIABLES, REASON, Store, empty_dataset, reject_misfits

if TYPE_CHECKING:
    from pyfret.study.design import Design
    from pyfret.study.point import Outcome

__all__ = ["Columns"]


class Columns:
    """Outcomes of the points in memory, with the interface of a :class:`Store`."""

    def __init__(self, design: Design, attributes: dict[str, str]) -> None:
        self.design = design
        self.whole = empty_dataset(design, {**attributes, **Store.marks()}, POINT_VARIABLES)
        self.shapes: dict[str, dict[str, int]] = {}

    def open_points(self, *, again: bool) -> list[int]:
        """Return all points, since none is done; `again` has no effect."""
        del again
        return list(range(len(self.design)))

    def write(self, n: int, outcome: Outcome) -> None:
        """Keep the outcome of the n-th point."""
        outcome = reject_misfits(outcome, self.design, self.shapes)
        index = self.design.place(n)
        sizes = self.design.sizes
        for name, variable in outcome.measures.items():
            if name not in self.shapes:
                empty = np.full((*sizes.values(), *variable.shape), np.nan)
                self.whole[name] = ((*sizes, *variable.dims), empty, variable.attrs)
                self.shapes[name] = {str(dim): size for dim, size in variable.sizes.items()}
            self.whole[name].values[index] = variable.values
        point_values: dict[str, Any] = {
            "nx": outcome.nx,
            "ny": outcome.ny,
            "seconds": outcome.seconds,
        }
        if outcome.status in (FAILED, PARTLY):
            point_values["reason"] = outcome.reason[:REASON]
        for name, value in {**point_values, "status": outcome.status}.items():
            self.whole[name].values[index] = value

    def dataset(self) -> xr.Dataset:
        """Return the study."""
        return self.whole
