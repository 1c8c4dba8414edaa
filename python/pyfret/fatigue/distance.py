"""A life over the critical distance."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from typing import TYPE_CHECKING

import numpy as np

from pyfret import _core
from pyfret._util.figures import Figured
from pyfret._util.labelled import Labelled
from pyfret._util.lazy import xr
from pyfret._util.numbers import length
from pyfret._util.window import wrap
from pyfret.saveable import Saveable
from pyfret.scene.tables import table

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from pyfret._core import Material
    from pyfret.fatigue.ranges import LifeRange

__all__ = ["OverDistance", "default_distances", "distance_of_material"]


def format_margin(margin: float, *, lives: bool) -> str:
    """Format a life or a safety factor in two digits; a longer life than the tests as a bound."""
    if np.isfinite(margin):
        return _core.rough(margin)
    return _core.with_range(margin, _core.LONGEST_LIFE if lives else margin, margin)


class OverDistance(Saveable, Labelled, Figured):
    """Lives or safety factors over the distance that the stress is averaged over.

    :attr:`dataset` has ``life`` or ``safety_factor`` over ``L`` [m], and its range, ``low`` and
    ``high``, from the error of the stress and the scatter of the material. Attribute ``L`` is the
    critical distance of the material, where it has one. The figure is
    :func:`pyfret.plot.life_over_distance`.
    """

    @classmethod
    def from_ranges(
        cls,
        L: NDArray[np.float64],
        rows: Sequence[LifeRange],
        name: str,
        meaning: str,
        method: str,
        critical: float | None,
    ) -> OverDistance:
        """Collect the ranges of several distances L [m] in a table."""
        about = {"units": "m", "long_name": "distance that the stress is averaged over"}
        dataset = xr.Dataset(coords={"L": ("L", L, about)}, attrs={"method": method})
        for key, long_name, values in (
            (name, meaning, [row.best for row in rows]),
            ("low", f"{meaning}, lowest", [row.low for row in rows]),
            ("high", f"{meaning}, highest", [row.high for row in rows]),
        ):
            unit = "cycles" if name == "life" else "1"
            dataset[key] = ("L", values, {"units": unit, "long_name": long_name})
        if critical is not None:
            dataset.attrs["L"] = critical
        # Notes on the shortest and on the longest distance.
        notes = dict.fromkeys([*rows[0].notes, *rows[-1].notes]) if rows else []
        dataset.attrs["notes"] = "\n".join(notes)
        return cls(dataset)

    figure = "life_over_distance"

    def summary(self) -> str:
        """Return the table as text."""
        return wrap(repr(self))

    @property
    def margin(self) -> xr.DataArray:
        """``life`` or ``safety_factor``, whichever the criterion gives."""
        return self.dataset["life" if "life" in self.dataset else "safety_factor"]

    @property
    def best(self) -> xr.DataArray:
        """The best estimates, between ``low`` and ``high``: :attr:`margin`."""
        return self.margin

    @property
    def notes(self) -> list[str]:
        """Notes on the shortest and the longest distance."""
        return str(self.dataset.attrs.get("notes", "")).splitlines()

    def rows(self) -> list[list[str]]:
        """Return a line for every distance: L, low, best, high."""
        d, lives = self.dataset, self.margin.name == "life"
        columns = (d.low, self.margin, d.high)
        return [
            [
                length(float(d.L[n])),
                *(format_margin(float(column[n]), lives=lives) for column in columns),
            ]
            for n in range(d.sizes["L"])
        ]

    def _repr_html_(self) -> str:
        """The table for notebooks."""
        return table(["L", "low", "best", "high"], self.rows())

    def __repr__(self) -> str:
        """Return the table as text."""
        rows = [["L", "low", str(self.margin.name), "high"], *self.rows()]
        widths = [max(len(row[k]) for row in rows) for k in range(4)]
        lines = [
            "  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True))
            for row in rows
        ]
        return "\n".join([*lines, *self.notes]).replace("µ", "u")


def distance_of_material(material: Material | None) -> float | None:
    """The critical distance of a material; none if it has no such number."""
    with suppress(ValueError):
        return None if material is None else material.critical_distance()
    return None


def default_distances(
    material: Material | None, deepest: float, thickness: float
) -> NDArray[np.float64]:
    """Choose distances around the critical distance of a material, within its layer [m].

    Parameters
    ----------
    material : Material, optional
        Material of the layer; without a critical distance the depth of the section counts.
    deepest : float
        Largest depth of the section [m].
    thickness : float
        Thickness of the layer [m]; a mean along a line goes down to 2 L.
    """
    L = distance_of_material(material)
    ends = (L / 4.0, 4.0 * L) if L else (deepest / 100.0, deepest / 4.0)
    lengths = np.geomspace(*ends, 9)
    inside = lengths[2.0 * lengths <= thickness]
    if not inside.size:
        raise ValueError(f"L: the layer of {thickness:.3g} m is thinner than 2 L: give distances")
    return np.asarray(inside)
