"""The result of a study."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._util.bounds import is_bound
from pyfret._util.bounds import span as between
from pyfret._util.csv_table import PLACES, unit_of
from pyfret._util.figures import Figured
from pyfret._util.labelled import Labelled
from pyfret._util.lazy import xr
from pyfret._util.numbers import format_number
from pyfret._util.per_metre import PER_METRE, of_line_contacts
from pyfret._util.text import html, shown
from pyfret._util.window import format_table, wrap
from pyfret.quantities import quantities
from pyfret.saveable import Saveable
from pyfret.scene.tables import table
from pyfret.study.point import DONE, FAILED, OPEN, PARTLY
from pyfret.study.store import POINT_VARIABLES, read_study

if TYPE_CHECKING:
    import os

    import pandas as pd
    from matplotlib.axes import Axes

    from pyfret._util.csv_table import Tables
    from pyfret.plot.style import Drawn

__all__ = ["Study", "open_study"]


class Study(Saveable, Labelled, Figured):
    """The measures of all points of a study.

    Attributes
    ----------
    dataset : xarray.Dataset
        Over the parameters, or over ``point`` where they change together: the measures, NaN where a
        point has none. The error of a measure gives its range, such as ``von_mises_low`` and
        ``von_mises_high``. A measure of pyfret without an error has the attribute ``accuracy``:
        "estimate". Each point also has ``status`` (0 open, 1 done, 2 failed, 3 partly: a
        measure has no number), ``reason``,
        ``nx`` and ``ny``, its cells, and ``seconds``, its processor time.
    """

    figure = "study_map"

    @property
    def parameters(self) -> list[str]:
        """Names of the parameters."""
        return [str(name) for name in self.dataset.coords]

    @property
    def measures(self) -> list[str]:
        """Names of the measures, without the ends of their ranges."""
        names = [str(name) for name in self.dataset.data_vars if name not in POINT_VARIABLES]
        return [name for name in names if not is_bound(name, names)]

    def count(self) -> dict[str, int]:
        """Count the open, done and failed points, and those done in part."""
        status = self.dataset["status"].values
        codes = {"open": OPEN, "done": DONE, "failed": FAILED, "partly": PARTLY}
        return {name: int(np.count_nonzero(status == code)) for name, code in codes.items()}

    def failed(self) -> list[tuple[dict[str, Any], str]]:
        """List the failed points: their parameters, and the reason."""
        return self._points(FAILED)

    def unanswered(self) -> list[tuple[dict[str, Any], str]]:
        """List the solved points where measures have no number: parameters, and the reason.

        A measure without a number has a line, ``"stiffness: the path has no closed cycle"``.
        """
        return self._points(PARTLY)

    def _elsewhere(self, name: str) -> dict[str, str]:
        """Return where a name is found that this object does not have."""
        first = self._heads(self.dataset)[self.measures[0]] if self.measures else "p_max [Pa]"
        failures = "study.failed() lists the failed points, study.unanswered() missing numbers"
        ranked = f"study.to_dataframe().sort_values({first!r}) has the points, the smallest first"
        return {
            **dict.fromkeys(("failures", "errors", "failed_points", "failure"), failures),
            **dict.fromkeys(("best", "worst", "idxmin", "idxmax", "optimum", "minimum"), ranked),
        }

    def _points(self, status: int) -> list[tuple[dict[str, Any], str]]:
        """List the points of a status: their parameters, and the reason."""
        d = self.dataset
        points = []
        for index in np.argwhere(d["status"].values == status):
            point = d.isel(dict(zip(d["status"].dims, index.tolist(), strict=True)))
            values = {name: point[name].item() for name in self.parameters}
            points.append((values, str(point["reason"].item())))
        return points

    def _frame(self, of: str | None) -> pd.DataFrame:
        """Give a row for every point: its parameters, its measures and its outcome.

        Measures that are fields are left out, with a warning that names them; the ``dataset`` has
        them.
        """
        d = self.dataset
        self._maker(of)
        dims = set(d["status"].dims)
        field_dims = {
            str(name): [str(dim) for dim in variable.dims if dim not in dims]
            for name, variable in d.items()
        }
        if fields := [
            f"{name} (over {', '.join(dims)})" for name, dims in field_dims.items() if dims
        ]:
            warnings.warn(
                f"left out, since a row has no room for a field: {'; '.join(fields)}. "
                "study.dataset has them",
                UserWarning,
                stacklevel=2,
            )
        scalars = d[[name for name, dims in field_dims.items() if not dims]]
        from pyfret._util.frame import Frame

        rows = scalars.to_dataframe().reset_index()
        heads = self._heads(scalars)
        frame = Frame(rows.rename(columns=heads))
        if "point" not in dims:
            frame.attrs[PLACES] = [heads[name] for name in self.parameters]
        return frame

    def _heads(self, scalars: xr.Dataset) -> dict[str, str]:
        """Return the heads of the columns: names with their units, per metre in line contacts."""
        per_metre = of_line_contacts(self.dataset)
        heads = {}
        for name in scalars.variables:
            unit = unit_of(str(name), scalars[name])
            if per_metre and name in self.parameters:
                unit = PER_METRE.get(unit, unit)
            heads[str(name)] = f"{name} [{unit}]" if unit else str(name)
        return heads

    def _tables(self) -> Tables:
        """Return the name of the only table."""
        return {"points": lambda: (self.dataset, None)}

    def sensitivity(self, of: str | None = None) -> xr.DataArray:
        """Return the share of each parameter alone in the variance of a measure.

        It is the variance of the mean over all other parameters, over the variance of all points.
        All points count alike: the first-order index of I. M. Sobol' (Math. Model. Comput. Exp. 1
        (1993) 407-414) of the values studied. The remainder to 1 is interaction. Points without a
        value are refused, since they would weigh on one side.

        Parameters
        ----------
        of : str, optional
            The measure (default: the first).

        Returns
        -------
        DataArray over ``parameter``, the largest first.

        Raises
        ------
        ValueError
            There is no such measure, it is a field, a point has no value, or the parameters
            change together.
        """
        chosen = self.measures[0] if of is None else of
        if chosen not in self.measures:
            raise ValueError(f"of = {of!r}: must be one of {', '.join(self.measures)}")
        values = self.dataset[chosen].astype(float)
        if "point" in values.dims or set(values.dims) != set(self.dataset["status"].dims):
            raise ValueError(
                f"{chosen} over {', '.join(map(str, values.dims))}: must be a number at every "
                "point of a grid of parameters; samples are for packages such as SALib"
            )
        if (lost := int(values.isnull().sum())) > 0:
            failed = int(self.dataset["status"].isin([OPEN, FAILED]).sum())
            where = "study.failed() lists them"
            if failed < lost:
                where = (
                    f"{failed} have no answer, the others no such number, like the life of a "
                    "coating which outlives its run; study.dataset lists them"
                )
            raise ValueError(f"{lost} of {values.size} points have no {chosen}: {where}")
        names = [str(name) for name in values.dims]
        whole = float(values.var())
        parts = [
            float(values.mean([other_name for other_name in names if other_name != name]).var())
            / whole
            if whole > 0.0
            else 0.0
            for name in names
        ]
        order = np.argsort(parts)[::-1]
        return xr.DataArray(
            np.asarray(parts)[order],
            {"parameter": [names[n] for n in order]},
            name=chosen,
            attrs={"long_name": f"part of the variance of {chosen}", "units": "1"},
        )

    def summary(self) -> str:
        """Return the counts of points, the ranges of parameters and measures, and the failures.

        Measures have their errors, or two digits and the word "estimate".
        """
        rows = [(name, span, unit) for _, name, span, unit in self._spans()]
        counts = ", ".join(f"{n} {name}" for name, n in self.count().items() if n)
        lines = [f"{self._title()}: {counts}"]
        lines.append(format_table(["", "from, to", "unit"], rows))
        for name in self.measures:
            if excluded := self.dataset[name].attrs.get("without"):
                lines.append(f"{name}: its range is without {excluded}")
        missing: dict[str, int] = {}
        for _, why in self.unanswered():
            for reason in why.splitlines():
                missing[reason] = missing.get(reason, 0) + 1
        points = self.dataset["status"].size
        for reason, count in missing.items():
            lines.append(f"no number at {count} of {points} points: {reason}")
        for values, why in self.failed():
            position = ", ".join(
                f"{name} = {format_number(value)}" for name, value in values.items()
            )
            lines.append(f"failed at {position}: {' '.join(why.split())}")
        return wrap(shown("\n".join(lines)))

    def _spans(self) -> list[tuple[str, str, str, str]]:
        """Return kind, name, range and unit of every parameter and measure."""
        d = self.dataset
        rows = []
        for kind, names in (("parameter", self.parameters), ("measure", self.measures)):
            for name in names:
                values = d[name].values
                if values.dtype.kind in "ifb" and not np.isnan(values).all():
                    span = between(d, name)
                else:
                    lost = values.dtype.kind == "f" and bool(np.isnan(values).all())
                    span = "no number" if lost else f"{np.unique(values).size} values"
                unit = unit_of(name, d[name])
                # Measures have their unit; keys have the units of a three-dimensional contact.
                per_metre = kind == "parameter" and of_line_contacts(d)
                rows.append((kind, name, span, PER_METRE.get(unit, unit) if per_metre else unit))
        return rows

    def map(self, of: str | None = None, *, ax: Axes | None = None, **options: Any) -> Drawn:
        """Draw a measure over the parameters: :func:`pyfret.plot.study_map`."""
        from pyfret.plot import study_map

        return study_map(self, of, ax=ax, **options)

    def line(self, of: str | None = None, *, ax: Axes | None = None, **options: Any) -> Drawn:
        """Draw a measure over one parameter: :func:`pyfret.plot.study_line`."""
        from pyfret.plot import study_line

        return study_line(self, of, ax=ax, **options)

    def _repr_html_(self) -> str:
        """Return a table for notebooks."""
        return study_html(self)

    def __repr__(self) -> str:
        """Give the parameters, the measures and how many points are done."""
        counts = ", ".join(f"{n} {name}" for name, n in self.count().items() if n)
        sizes = " x ".join(str(n) for n in self.dataset["status"].shape)
        parameter_names, measure_names = ", ".join(self.parameters), ", ".join(self.measures)
        return shown(f"Study({sizes} points over {parameter_names}: {counts}; {measure_names})")


def study_html(study: Study) -> str:
    """Write a study as a table: range of every parameter and measure."""
    rows = [[kind, html(name), span, html(unit)] for kind, name, span, unit in study._spans()]
    counts = ", ".join(f"{n} {name}" for name, n in study.count().items() if n)
    return f"<p><b>Study</b>: {counts}</p>{table(['', '', 'from, to', 'unit'], rows)}"


@quantities
def open_study(store: str | os.PathLike[str]) -> Study:
    """Open the store of a study, whether it is done or not.

    Raises
    ------
    StoreError
        There is no study there.
    """
    return Study(read_study(store))
