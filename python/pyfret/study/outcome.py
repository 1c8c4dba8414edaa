"""What a study came to."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._util.labelled import Labelled
from pyfret.scene.tables import number, table
from pyfret.study.point import DONE, FAILED, OPEN
from pyfret.study.store import read

if TYPE_CHECKING:
    import os

    import pandas as pd
    from matplotlib.axes import Axes

__all__ = ["Study", "open"]


class Study(Labelled):
    """The measures of all points of a study.

    Attributes
    ----------
    dataset : xarray.Dataset
        Over the parameters, or over ``point`` where they change together: the measures, NaN where
        a point has none; ``status`` (0 open, 1 done, 2 failed), ``reason``, ``nx`` and ``ny``,
        the cells that the point took, and ``seconds``, its processor time.
    """

    @property
    def parameters(self) -> list[str]:
        """Names of the parameters."""
        return [str(name) for name in self.dataset.coords]

    @property
    def measures(self) -> list[str]:
        """Names of the measures."""
        own = {"status", "reason", "nx", "ny", "seconds"}
        return [str(name) for name in self.dataset.data_vars if name not in own]

    def count(self) -> dict[str, int]:
        """How many points are open, done and failed."""
        status = self.dataset["status"].values
        codes = {"open": OPEN, "done": DONE, "failed": FAILED}
        return {name: int(np.count_nonzero(status == code)) for name, code in codes.items()}

    def failed(self) -> list[tuple[dict[str, Any], str]]:
        """Points that failed: their parameters, and why."""
        d = self.dataset
        found = []
        for place in np.argwhere(d["status"].values == FAILED):
            point = d.isel(dict(zip(d["status"].dims, place.tolist(), strict=True)))
            values = {name: point[name].item() for name in self.parameters}
            found.append((values, str(point["reason"].item())))
        return found

    def to_dataframe(self) -> pd.DataFrame:
        """Give a row for every point: its parameters, its measures and what became of it.

        Measures that are fields are left out. ``study.to_dataframe().to_csv("points.csv")`` writes
        a table, ``to_excel`` and ``groupby`` are those of pandas.
        """
        d = self.dataset
        dims = set(d["status"].dims)
        scalars = d[[name for name, of in d.data_vars.items() if set(of.dims) <= dims]]
        return scalars.to_dataframe().reset_index()

    def map(self, of: str | None = None, *, ax: Axes | None = None, **options: Any) -> Axes:
        """Draw a measure over the parameters: :func:`pyfret.plot.study_map`."""
        from pyfret.plot import study_map

        return study_map(self, of, ax=ax, **options)

    def _repr_html_(self) -> str:
        """A table for notebooks."""
        return study_html(self)

    def __repr__(self) -> str:
        """Give the parameters, the measures and how many points are done."""
        counts = ", ".join(f"{n} {name}" for name, n in self.count().items() if n)
        sizes = " x ".join(str(n) for n in self.dataset["status"].shape)
        over, of = ", ".join(self.parameters), ", ".join(self.measures)
        return f"Study({sizes} points over {over}: {counts}; {of})"


def study_html(study: Study) -> str:
    """A study as a table: range of every parameter and measure."""
    d = study.dataset
    rows = []
    for kind, names in (("parameter", study.parameters), ("measure", study.measures)):
        for name in names:
            values = d[name].values
            if values.dtype.kind in "ifb" and np.isfinite(values).any():
                span = f"{number(np.nanmin(values))} to {number(np.nanmax(values))}"
            else:
                span = f"{np.unique(values).size} values"
            unit = str(d[name].attrs.get("units", ""))
            rows.append([kind, escape(name), span, "" if unit == "1" else escape(unit)])
    counts = ", ".join(f"{n} {name}" for name, n in study.count().items() if n)
    return f"<p><b>Study</b>: {counts}</p>{table(['', '', 'from, to', 'unit'], rows)}"


def open(store: str | os.PathLike[str]) -> Study:
    """Open the store of a study, whether it is done or not.

    Raises
    ------
    StoreError
        There is no study there.
    """
    return Study(read(store))
