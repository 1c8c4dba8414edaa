"""A study that is kept in memory, with the contents of a store."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._util.lazy import xr
from pyfret.study.point import FAILED
from pyfret.study.store import OWN, REASON, Store, fitting, template

if TYPE_CHECKING:
    from pyfret.study.design import Design
    from pyfret.study.point import Outcome

__all__ = ["Columns"]


class Columns:
    """Collects what becomes of the points; the same steps as those of a :class:`Store`."""

    def __init__(self, design: Design, said: dict[str, str]) -> None:
        self.design = design
        self.whole = template(design, {**said, **Store.marks()}, OWN)
        self.shapes: dict[str, dict[str, int]] = {}

    def open_points(self, *, again: bool) -> list[int]:
        """All points: none is done, whether those that failed are to be solved `again` or not."""
        del again
        return list(range(len(self.design)))

    def write(self, n: int, outcome: Outcome) -> None:
        """Keep what became of the n-th point."""
        outcome = fitting(outcome, self.design, self.shapes)
        place = self.design.place(n)
        sizes = self.design.sizes
        for name, of in outcome.measures.items():
            if name not in self.shapes:
                empty = np.full((*sizes.values(), *of.shape), np.nan)
                self.whole[name] = ((*sizes, *of.dims), empty, of.attrs)
                self.shapes[name] = {str(dim): size for dim, size in of.sizes.items()}
            self.whole[name].values[place] = of.values
        own: dict[str, Any] = {"nx": outcome.nx, "ny": outcome.ny, "seconds": outcome.seconds}
        if outcome.status == FAILED:
            own["reason"] = outcome.reason[:REASON]
        for name, value in {**own, "status": outcome.status}.items():
            self.whole[name].values[place] = value

    def dataset(self) -> xr.Dataset:
        """The study."""
        return self.whole
