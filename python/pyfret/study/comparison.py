"""The result of a comparison of bodies: numbers side by side, each with its error."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from pyfret._core import LONGEST_LIFE, rough, with_error
from pyfret._util import files
from pyfret._util.figures import Figured
from pyfret._util.labelled import Labelled
from pyfret._util.lazy import xr
from pyfret._util.numbers import in_letters, in_words, length
from pyfret._util.page import svg_image, write_page
from pyfret._util.window import format_table, wrap
from pyfret.fatigue.ranges import Range
from pyfret.quantities import quantities
from pyfret.scene.tables import table
from pyfret.study.point import FAILED, PARTLY
from pyfret.study.questions import NUMBERS, Number

if TYPE_CHECKING:
    import os

    from pyfret.plot.comparison import Panel
    from pyfret.study.outcome import Study

__all__ = ["Comparison", "Preference"]

#: Endings of the names of places and of averaging distances.
PLACES = ("_x", "_z", "_layer", "_L")
#: Numbers of a run of wear.
OF_WEAR = ("wear_through", "worn_depth")
#: Digits of a number without an error.
DIGITS = 4


class Preference(NamedTuple):
    """The candidates that a number favours."""

    #: Candidates without a better one, beyond the errors.
    best: list[str]
    #: Candidates that are worse, beyond the errors.
    worse: list[str]
    #: Whether the number is one of the same material in all candidates.
    comparable: bool = True
    #: Candidates whose numbers have no upper end, since their runs left the grid: with several best
    #: ones nothing is decided.
    ended: Sequence[str] = ()

    def __str__(self) -> str:
        """Describe the preference in a few words."""
        if not self.comparable:
            return "different materials"
        if self.ended and len(self.best) > 1:
            return f"undecided: the grid is too small for {', '.join(self.ended)}"
        if not self.worse:
            return "no difference" if len(self.best) > 1 else ""
        alike = " (no difference)" if len(self.best) > 1 else ""
        return f"best: {', '.join(self.best)}{alike}"


class Comparison(Labelled, Figured):
    """Candidates side by side.

    Attributes
    ----------
    dataset : xarray.Dataset
        Over ``candidate``: the numbers in SI units, such as ``tension`` [Pa]. The error of each
        gives its range, ``tension_low`` and ``tension_high``. Numbers that a candidate does not
        have are NaN.
    missing : mapping of str to str
        Missing data, by candidate and question.
    unanswered : mapping of str to str
        Why a question has no answer, by candidate and question.
    failed : mapping of str to str
        Candidates without a solution, with the reason.
    study : Study
        The points of the comparison, on two grids.
    """

    table_axes = ("candidate",)
    figure = "comparison"

    def __init__(
        self,
        dataset: xr.Dataset,
        missing: Mapping[str, str],
        failed: Mapping[str, str],
        study: Study | None = None,
        unanswered: Mapping[str, str] | None = None,
    ) -> None:
        super().__init__(dataset)
        self.missing, self.failed, self.study = dict(missing), dict(failed), study
        self.unanswered = dict(unanswered or {})

    @classmethod
    def from_study(
        cls,
        study: Study,
        missing: Mapping[str, str],
        *,
        title: str,
        coatings: Sequence[int],
        doubts: Mapping[str, Sequence[str]],
        rows: Mapping[str, Sequence[float | str]] | None = None,
        layer_materials: Sequence[Sequence[str]] | None = None,
    ) -> Comparison:
        """Make the table from a study of the candidates on two grids.

        `coatings` and `doubts` are the number of coatings and the doubts of each candidate. `rows`
            are brought along by the candidates. A RuntimeError is raised if none was solved.
        """
        results = study.dataset
        names = [str(name) for name in results["candidate"].values]
        failed: dict[str, str] = {}
        for point, reason in study.failed():
            name = str(point["candidate"])
            failed[strip_quotes(name)] = reason
        fine = results.isel(coarser=0)
        if (fine["status"] == FAILED).all():
            reasons = "; ".join(f"{name}: {reason}" for name, reason in failed.items())
            raise RuntimeError(f"no candidate could be solved: {reasons}")
        dataset = xr.Dataset(
            {"coatings": ("candidate", list(coatings))},
            coords={"candidate": [strip_quotes(name) for name in names]},
            attrs={"title": title},
        )
        if layer_materials is not None:
            dataset.attrs["layer_materials"] = json.dumps(
                [list(names) for names in layer_materials]
            )
        for name, about in NUMBERS.items():
            if name in results and bool(np.isfinite(fine[name]).any() | np.isinf(fine[name]).any()):
                for suffix, values in range_on_two_grids(results, name, about).items():
                    dataset[f"{name}{suffix}"] = ("candidate", values, fine[name].attrs)
        places = [str(v) for v in fine.data_vars if str(v).endswith(PLACES)]
        for name in places:
            if bool(np.isfinite(fine[name]).any()):
                dataset[name] = ("candidate", fine[name].values, fine[name].attrs)
        for label, own_values in (rows or {}).items():
            kind = object if isinstance(own_values[0], str) else float
            values = np.asarray(list(own_values), dtype=kind)
            dataset[label] = ("candidate", values, {"own_row": 1, "long_name": label})
        unanswered: dict[str, str] = {}
        for n in np.flatnonzero(fine["status"].values == PARTLY).tolist():
            for line in str(fine["reason"].values[n]).splitlines():
                question, _, why = line.partition(": ")
                unanswered[f"{strip_quotes(names[n])}, {question}"] = why
        doubt_lines = [
            f"{name}: {doubt}"
            for name, doubts_of_candidate in doubts.items()
            for doubt in doubts_of_candidate
        ]
        if doubt_lines:
            dataset.attrs["doubts"] = "\n".join(doubt_lines)
        return cls(dataset, missing, failed, study, unanswered)

    @property
    def candidates(self) -> list[str]:
        """Names of the candidates."""
        return [str(name) for name in self.dataset["candidate"].values]

    @property
    def layer_names(self) -> list[list[str]]:
        """Names of the layers of every candidate, from the surface down."""
        return [layer_names(int(count)) for count in self.dataset["coatings"].values]

    @property
    def numbers(self) -> list[str]:
        """Names of the numbers that at least one candidate has."""
        return [name for name in NUMBERS if name in self.dataset]

    @quantities
    def preference(self, of: str) -> Preference:
        """Return the best candidates by a number, and the worse ones beyond the errors.

        A candidate is worse where its range does not overlap with the range of the best one. There
        is no best stress in different materials, since each of them has a strength of its own.
        ``ended`` names the best ones of whose wear only a bound is known: their run ended early.

        Parameters
        ----------
        of : str
            One of :attr:`numbers`, such as ``"energy"``.

        Raises
        ------
        ValueError
            No candidate has such a number.
        """
        if of not in self.numbers:
            raise ValueError(f"of = {of!r}: must be one of {', '.join(self.numbers)}")
        d = self.dataset
        if not self._same_material(of):
            return Preference([], [], comparable=False)
        sign = 1.0 if NUMBERS[of].better == "larger" else -1.0
        range_of = {
            name: sorted((sign * float(d[f"{of}_low"][n]), sign * float(d[f"{of}_high"][n])))
            for n, name in enumerate(self.candidates)
            if not math.isnan(float(d[of][n]))
        }
        values = {name: sign * float(d[of].sel(candidate=name)) for name in range_of}
        best_low = range_of[max(values, key=lambda name: values[name])][0]
        best = [name for name, (_, high) in range_of.items() if high >= best_low]
        ended = [
            name
            for name in best
            if of in OF_WEAR
            and f"{name}, wear" in self.unanswered
            and math.isinf(range_of[name][1])
        ]
        return Preference(best, [name for name in range_of if name not in best], ended=ended)

    def _same_material(self, of: str) -> bool:
        """Return whether a stress belongs to the same material in all candidates that have it."""
        layers, d = self.dataset.attrs.get("layer_materials"), self.dataset
        if NUMBERS[of].si != "Pa" or layers is None:
            return True
        materials: list[list[str]] = json.loads(layers)
        names = set()
        for n, layers_of_body in enumerate(materials):
            if math.isnan(float(d[of][n])):
                continue
            layer = float(d[f"{of}_layer"][n]) if f"{of}_layer" in d else math.nan
            names.add(layers_of_body[-1 if math.isnan(layer) else int(layer)])
        return len(names) <= 1

    def rows(self) -> list[list[str]]:
        """Return the table as text: a head, then a line for every number."""
        lines = [["", "", *self.candidates, "preference"]]
        for name in self.numbers:
            lines.append(self.row(name))
            if f"{name}_layer" in self.dataset:
                places = [self.place(name, n) for n in range(len(self.candidates))]
                lines.append(["  where", "", *places, ""])
            if f"{name}_L" in self.dataset:
                means = [describe_averaging(float(L)) for L in self.dataset[f"{name}_L"].values]
                lines.append(["  from the stress", "", *means, ""])
        for label, values in self.dataset.data_vars.items():
            if values.attrs.get("own_row"):
                lines.append([str(label), "", *map(format_own_cell, values.values.tolist()), ""])
        return lines

    def row(self, name: str) -> list[str]:
        """Return the row of a number as text."""
        about = NUMBERS[name]
        _, unit = table_unit(about, str(self.dataset[name].attrs["units"]))
        ends = [*self.formatted(name), str(self.preference(name))]
        return [about.title, "" if unit == "1" else unit, *ends]

    def formatted(self, name: str) -> list[str]:
        """Format a number of every candidate with its range, in the unit of the table."""
        about, d = NUMBERS[name], self.dataset
        scale, _ = table_unit(about, str(d[name].attrs["units"]))
        sides = zip(
            *(d[f"{name}{side}"].values / scale for side in ("", "_low", "_high")), strict=True
        )
        return [format_cell(about, *map(float, row)) for row in sides]

    def place(self, name: str, n: int) -> str:
        """Describe the place of a number of a candidate: the layer, and the point in it."""
        d = self.dataset
        layer = float(d[f"{name}_layer"][n])
        if math.isnan(layer):
            return ""
        x = f", x = {length(float(d[f'{name}_x'][n]))}" if f"{name}_x" in d else ""
        z = float(d[f"{name}_z"][n])
        depth = f"z = {length(z)}" if z else "surface"
        return f"{self.layer_names[n][int(layer)]}, {depth}{x}"

    def summary(self) -> str:
        """Return the table as text, with missing answers and doubts."""
        titles, *rows = self.rows()
        title = str(self.dataset.attrs["title"] or "comparison")
        return wrap("\n".join([title, format_table(titles, rows, keys=2), *self.notes()]))

    def notes(self) -> list[str]:
        """List missing answers, failed candidates and doubts."""
        lines = [
            f"no answer for {name}: missing is {missing_data}"
            for name, missing_data in self.missing.items()
        ]
        lines += [f"no answer for {name}: {why}" for name, why in self.unanswered.items()]
        lines += [f"{name} failed: {reason}" for name, reason in self.failed.items()]
        doubts = str(self.dataset.attrs.get("doubts", ""))
        return lines + [f"warning: {doubt}" for doubt in doubts.splitlines()]

    def panels(self) -> list[Panel]:
        """Return the numbers for a figure: in the units of the table, ordered by preference."""
        from pyfret.plot.comparison import Panel

        panels = []
        for name in self.numbers:
            about, d, preference = NUMBERS[name], self.dataset, self.preference(name)
            scale, unit = table_unit(about, str(d[name].attrs["units"]))
            alike = not preference.worse and len(preference.best) != 1
            order = [
                0 if alike else 1 if candidate in preference.best else 2
                for candidate in self.candidates
            ]
            values, low, high = (
                d[f"{name}{side}"].values / scale for side in ("", "_low", "_high")
            )
            panels.append(
                Panel(
                    about.title,
                    unit,
                    about.better if preference.comparable else "",
                    self.formatted(name),
                    about.logarithmic,
                    values,
                    low,
                    high,
                    order,
                )
            )
        return panels

    def save(self, path: str | os.PathLike[str], *, overwrite: bool = False) -> None:
        """Write the numbers to a Zarr folder (``.zarr``) or a NetCDF file (``.nc``).

        Parameters
        ----------
        path : path
            The place to write to; its ending selects the format.
        overwrite : bool
            Whether what pyfret saved there is replaced (default: the place must be free).
        """
        files.write(self.dataset, path, overwrite=overwrite)

    def report(self, path: str | os.PathLike[str]) -> None:
        """Write a page for a browser: the table and the figure."""
        import io

        drawn = io.BytesIO()
        self.plot().savefig(drawn, format="svg")
        title = str(self.dataset.attrs["title"] or "comparison")
        shown = svg_image(drawn.getvalue(), "the same numbers with their errors")
        content = f'<div class="side">{self._repr_html_()}</div>\n{shown}'
        write_page(Path(path), title, content)

    def _repr_html_(self) -> str:
        """The table for notebooks."""
        head, *rows = ([in_letters(text) for text in row] for row in self.rows())
        body = [[escape(text) for text in row] for row in rows]
        notes = "".join(f"<p>{escape(in_letters(note))}</p>" for note in self.notes())
        return f"{table([escape(text) for text in head], body)}{notes}"

    def __repr__(self) -> str:
        """Give the candidates and the numbers."""
        return f"Comparison({', '.join(self.candidates)}: {', '.join(self.numbers)})"


def layer_names(coatings: int) -> list[str]:
    """Names of the layers of a body: coatings count from one, the outermost first."""
    many = [f"coating {n + 1}" for n in range(coatings)]
    return [*(["coating"] if coatings == 1 else many), "substrate"]


def describe_averaging(L: float) -> str:
    """Describe the averaging of the stress of a margin: a distance [m], or a point."""
    if math.isnan(L):
        return ""
    return f"mean over L = {length(L)}" if L else "at the worst point"


def strip_quotes(name: str) -> str:
    """Remove the quotes of a name, which a study holds as text of TOML."""
    return name[1:-1] if name.startswith('"') else name


def range_on_two_grids(study: xr.Dataset, name: str, about: Number) -> dict[str, np.ndarray]:
    """Return a number on fine cells, with its range from coarse cells and its own error."""
    value = study[name].isel(coarser=0).values.astype(float)
    low, high = (study[f"{name}_{side}"].isel(coarser=0).values for side in ("low", "high"))
    coarse_value = study[name].isel(coarser=1).values.astype(float)
    with np.errstate(invalid="ignore", divide="ignore"):
        if about.logarithmic:
            # The range is symmetric as a factor; a life without end counts as one beyond the tests.
            fine, coarse = (np.where(np.isinf(v), LONGEST_LIFE, v) for v in (value, coarse_value))
            if about.ends_with_run:
                # Of a run that ended before, the last cycle is known.
                coarse_low = study[f"{name}_low"].isel(coarser=1).values.astype(float)
                fine = np.where(np.isinf(value), low, value)
                coarse = np.where(np.isinf(coarse_value), np.fmax(coarse_low, fine), coarse_value)
            factor = np.nan_to_num(np.maximum(fine / coarse, coarse / fine), nan=1.0)
            # Where both are without a number, the cells do not limit them.
            lower = np.where(np.isinf(value) & np.isinf(coarse_value), np.inf, fine / factor)
            upper = np.where(np.isinf(value) | np.isinf(coarse_value), np.inf, fine * factor)
        else:
            error = np.nan_to_num(np.abs(value - coarse_value))
            lower, upper = value - error, value + error
    return {"": value, "_low": np.fmin(low, lower), "_high": np.fmax(high, upper)}


def table_unit(about: Number, unit: str) -> tuple[float, str]:
    """Scale and unit of a number in the table; energies have the unit of the scene."""
    if about.si:
        return about.scale, about.unit
    return (1e-3, "mJ/m") if unit == "J/m" else (1e-6, "uJ")


def format_own_cell(value: float | str) -> str:
    """Format a value of a row that the candidates bring along."""
    if isinstance(value, str):
        return value or "-"
    return "-" if math.isnan(value) else in_words(value, DIGITS)


def format_cell(about: Number, value: float, low: float, high: float) -> str:
    """Format a number with its range."""
    if math.isnan(value):
        return "-"
    if math.isinf(value) and about.ends_with_run and math.isfinite(low):
        return f"more than {rough(low)} (the run ended there)"
    if about.logarithmic and math.isfinite(low):
        return repr(Range(low, value, high))
    if math.isinf(value):
        return about.endless
    error = max(value - low, high - value)
    return with_error(value, error) if error > 0.0 else in_words(value, DIGITS)
