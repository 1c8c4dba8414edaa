"""Whether a crack stops: thresholds, arrest, cycles of growth, Kitagawa and Takahashi's diagram."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any, ClassVar, Literal, cast

import numpy as np

from pyfret import _core
from pyfret._util.arrays import items, plain, together
from pyfret._util.figures import Figured
from pyfret._util.labelled import Labelled
from pyfret._util.lazy import xr
from pyfret._util.material_names import as_material
from pyfret._util.window import format_table, wrap
from pyfret.fracture.arrest import CrackArrest, CrackLife
from pyfret.quantities import (
    CrackGrowth,
    CrackLengths,
    InSI,
    Length,
    Numbers,
    StressIntensity,
    YieldStress,
    as_number,
    by_default,
    part,
    quantities,
)
from pyfret.saveable import Saveable
from pyfret.subsurface.line import line_through_point

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    from pyfret._core import Material
    from pyfret.subsurface.line import Line

__all__ = ["Cracks", "Paris", "Threshold"]


@part()
class Threshold:
    """The range of K below which a crack does not grow.

    Ranges are positive parts, max(K_max, 0) - max(K_min, 0): a closed crack does not count.

    Parameters
    ----------
    dK_th : float
        Threshold of long cracks at R <= 0, positive part of the range [Pa m^0.5].
    dS_0 : float, optional
        Positive part of the range of stress at the fatigue limit of a smooth body [Pa]. With it
        short cracks have El Haddad's threshold dK_th sqrt(l/(l + a_0)), a_0 =
        (dK_th/(Y dS_0))^2/pi; without it the constant one.
    Y : float
        Geometry factor in a_0.
    walker : float, optional
        Exponent gamma of Walker: at R > 0 the range dK acts like dK (1 - R)^(gamma - 1) at R = 0.
    table : sequence of (float, float), optional
        Instead of it the threshold over R relative to that at R = 0, rows of (R, ratio).
    estimate : str, optional
        Names of its estimated numbers; all results from the threshold repeat them.
    growth : Paris, optional
        Law of growth of the same material, which :meth:`Cracks.life` takes where none is given.

    References
    ----------
    M. H. El Haddad, K. N. Smith, T. H. Topper, J. Eng. Mater. Technol. 101 (1979) 42-46;
    K. Walker, ASTM STP 462 (1970) 1-14.
    """

    #: A parameter of this type takes a material, or its name, too.
    _of_material: ClassVar[bool] = True

    dK_th: InSI[StressIntensity]
    dS_0: InSI[YieldStress | None] = by_default(None)
    Y: float = 1.0
    walker: float | None = None
    table: Sequence[tuple[float, float]] | None = None
    estimate: str | None = None
    growth: Paris | None = None

    def __post_init__(self) -> None:
        """Refuse values that no material has."""
        _core.threshold_at(self._numbers(), [])

    @classmethod
    @quantities
    def from_material(
        cls, material: Material | str, *, Y: float = 1.0, walker: float | None = None
    ) -> Threshold:
        """Take the threshold from ``dK_th`` and ``s_D`` of a material, both fully reversed.

        Half of the range ``dK_th`` at R = -1 is positive, and half of the range 2 ``s_D`` of
        stress. A material without one of them is refused by its name. The dependence on R is the
        material's ``walker`` where it has one and none is given. ``growth`` is its law of growth,
        where it has one.
        """
        table_material = as_material(material)
        numbers = {name: value for name, value, _ in table_material.numbers()}
        names = ["dK_th", "s_D"]
        if walker is None and "walker" in numbers:
            walker = numbers["walker"]
            names.append("walker")
        estimate = table_material.estimate_of(names)
        growth = (
            Paris.from_material(table_material) if {"paris_C", "paris_m"} <= set(numbers) else None
        )
        dK_th, dS_0 = table_material.number("dK_th") / 2.0, table_material.number("s_D")
        return cls(dK_th, dS_0, Y, walker, estimate=estimate, growth=growth)

    def _numbers(
        self,
    ) -> tuple[float, float | None, float, float | None, list[tuple[float, float]] | None]:
        """Return the numbers as the core takes them."""
        table = None if self.table is None else pairs_of(self.table)
        return self.dK_th, self.dS_0, self.Y, self.walker, table

    @property
    def mark(self) -> str:
        """Return the mark behind its numbers where they are printed."""
        return " (estimate)" if self.estimate else ""

    @property
    def a_0(self) -> float:
        """El Haddad's length [m]; 0 for the constant threshold."""
        return _core.threshold_at(self._numbers(), [])[1]

    @quantities
    def range_at(self, lengths: CrackLengths) -> NDArray[np.float64]:
        """Return the threshold range of cracks of these lengths [m] at R = 0 [Pa m^0.5]."""
        lengths = plain(lengths, "lengths")
        dK, _ = _core.threshold_at(self._numbers(), lengths.ravel().tolist())
        return np.reshape(dK, lengths.shape)


@part()
class Paris:
    """Paris' law, dl/dN = C (dK/(1 MPa m^0.5))^m, dK the equivalent range at R = 0.

    Parameters
    ----------
    C : float
        Growth per cycle at dK = 1 MPa m^0.5 [m].
    m : float
        Exponent.
    threshold_in : {"plain", "powers", "difference"}
        Above the threshold C dK^m, C (dK^m - dK_th^m) or C (dK - dK_th)^m; below it nothing grows.
    short : bool
        Whether the law takes El Haddad's l + a_0 in place of the length l.
    estimate : str, optional
        Which of its numbers are estimates, in words.
    """

    #: A parameter of this type takes a material, or its name, too.
    _of_material: ClassVar[bool] = True

    C: InSI[CrackGrowth]
    m: float
    threshold_in: Literal["plain", "powers", "difference"] = "plain"
    short: bool = False
    estimate: str | None = None

    def __post_init__(self) -> None:
        """Refuse a choice that is neither True nor False."""
        if not isinstance(self.short, bool | np.bool_):
            raise TypeError(f"short = {self.short!r:.60}: must be True or False")

    @classmethod
    @quantities
    def from_material(cls, material: Material | str) -> Paris:
        """Take ``paris_C`` and ``paris_m`` of a material; one without them is refused by name."""
        table_material = as_material(material)
        estimate = table_material.estimate_of(["paris_C", "paris_m"])
        return cls(
            table_material.number("paris_C"), table_material.number("paris_m"), estimate=estimate
        )


def pairs_of(table: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """Return the rows of a table of thresholds as pairs of numbers.

    Raises
    ------
    TypeError
        They are no pairs of numbers.
    """
    rows = items(table, "table")
    try:
        return [(float(r), float(ratio)) for r, ratio in rows]
    except (TypeError, ValueError, OverflowError):
        raise TypeError("table: must be rows of (R, ratio), such as [(0.0, 1.0)]") from None


class Cracks(Saveable, Labelled, Figured):
    """K of a cycle over the length of a crack, and what follows.

    ``dataset`` has ``K_I`` and ``K_II`` over (increment, length) and their ``error`` [Pa m^0.5].
    ``K_I_linear`` and ``K_II_linear`` belong to faces that may pass through each other [Pa m^0.5].
    ``open`` is the share of the crack that is open. The tip of each length is at ``x``, ``z`` [m].
    """

    figure = "intensity"

    @classmethod
    @quantities
    def from_arrays(cls, lengths: CrackLengths, K_max: Numbers, K_min: Numbers) -> Cracks:
        """Take the largest and the smallest K_I [Pa m^0.5] at lengths [m] from elsewhere."""
        at, largest, smallest = together(lengths=lengths, K_max=K_max, K_min=K_min)
        K = np.stack([largest, smallest])
        about = {"units": "m", "long_name": "crack length"}
        length = ("length", at, about)
        return cls(xr.Dataset({"K_I": (("increment", "length"), K)}, coords={"length": length}))

    def _elsewhere(self, name: str) -> dict[str, str]:
        """Return where a name is found that this object does not have."""
        counted = (
            'cracks.life("Al 7075") counts the cycles of its growth, cracks.arrest("Al 7075") '
            "has the length at which it stops; result.grow_crack(x) lets it turn as it grows"
        )
        words = ("growth", "grow", "growth_rate", "propagate", "propagation", "cycles", "paris")
        return dict.fromkeys(words, counted)

    @property
    def line(self) -> Line:
        """The line on the surface in whose plane the cracks lie, its origin nearest to the axis."""
        azimuth = float(self.dataset.attrs.get("azimuth", 0.0))
        return line_through_point(*self._coordinates(0.0), azimuth)

    def _coordinates(self, away: Any) -> tuple[Any, Any]:
        """Return x and y of distances along the plane of the cracks [m]."""
        azimuth, offset = (
            float(self.dataset.attrs.get(name, 0.0)) for name in ("azimuth", "offset")
        )
        cos, sin = np.cos(azimuth), np.sin(azimuth)
        return away * cos - offset * sin, away * sin + offset * cos

    @quantities
    def places(self, x: Numbers) -> NDArray[np.float64]:
        """Places on :attr:`line` of distances `x` from the axis in the plane of the cracks [m]."""
        return np.asarray(self.line.place(*self._coordinates(np.asarray(x, float))))

    @property
    def lengths(self) -> NDArray[np.float64]:
        """Return the lengths [m]."""
        return np.asarray(self.dataset.length.values, float)

    @property
    def K_max(self) -> NDArray[np.float64]:
        """Largest K_I of the cycle at each length [Pa m^0.5]."""
        return np.asarray(self.dataset.K_I.max("increment").values)

    @property
    def K_min(self) -> NDArray[np.float64]:
        """Smallest K_I of the cycle at each length [Pa m^0.5]."""
        return np.asarray(self.dataset.K_I.min("increment").values)

    @property
    def error(self) -> NDArray[np.float64]:
        """Error of the largest K_I at each length [Pa m^0.5]; NaN where none came with it."""
        return self._error_where(self.K_max, np.nanmax)

    @property
    def K_min_error(self) -> NDArray[np.float64]:
        """Error of the smallest K_I at each length [Pa m^0.5]; NaN where none came with it."""
        return self._error_where(self.K_min, np.nanmin)

    @property
    def K_I_error(self) -> NDArray[np.float64]:
        """Error of K_I over (increment, length) [Pa m^0.5]; NaN where none came with it.

        It is ``dataset.error`` where the crack is open somewhere. K_I of a crack that is closed all
        along is 0, whatever the pressure between its faces. Its error is then max(``K_I_linear`` +
        ``error``, 0): by this it may be open.
        """
        data = self.dataset
        if "error" not in data:
            return np.full(data.K_I.shape, np.nan)
        error = np.asarray(data["error"].values, float)
        if "open" not in data:
            return error
        limited = np.clip(np.asarray(data["K_I_linear"].values, float) + error, 0.0, error)
        return np.where(np.asarray(data["open"].values) > 0.0, error, limited)

    @quantities
    def at_length(self, length: Length) -> xr.Dataset:
        """Give K over the cycle at the nearest length [m], ``K_I_error`` and ``K_II_error`` too."""
        d = self.dataset
        with_errors = d.assign(K_I_error=d.K_I.copy(data=self.K_I_error), K_II_error=d["error"])
        return with_errors.sel(length=as_number(length), method="nearest")

    def _error_where(
        self, extreme: NDArray[np.float64], of: Callable[..., Any]
    ) -> NDArray[np.float64]:
        """The largest or smallest error of the states that have an extreme K_I."""
        if "error" not in self.dataset:
            return np.full(self.lengths.shape, np.nan)
        at = np.asarray(self.dataset.K_I.values) == extreme
        return np.asarray(of(np.where(at, self.K_I_error, np.nan), axis=0), float)

    @quantities
    def dK_error(self, threshold: Threshold | None = None) -> NDArray[np.float64]:
        """Error of :meth:`dK` at each length [Pa m^0.5]; NaN where K came without an error.

        It is the larger change of the range with K_max more and less its error, as in
        :meth:`arrest`.
        """
        changes = [np.abs(self._range(threshold, e) - self.dK(threshold)) for e in self._ends()]
        return np.maximum(*changes)

    def _ends(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The error of K_max, to be taken from it and added to it."""
        return -self.error, self.error

    @quantities
    def scaled(self, factor: float) -> Cracks:
        """Return the same cracks with every K times a factor, such as :func:`ellipse_factor`."""
        return Cracks(
            xr.Dataset(
                {
                    name: variable
                    if name == "open"
                    else (variable * factor).assign_attrs(variable.attrs)
                    for name, variable in self.dataset.data_vars.items()
                },
                attrs=self.dataset.attrs,
            )
        )

    def summary(self) -> str:
        """Tabulate K of the cycle over the length: um, and MPa m^0.5."""
        unit = "MPa m^0.5"
        numbers = zip(self.lengths, self.K_max, self.K_min, self.dK(), strict=True)
        rows = [
            (f"{1e6 * length:.4g}", f"{1e-6 * high:.3g}", f"{1e-6 * low:.3g}", f"{1e-6 * span:.4g}")
            for length, high, low, span in numbers
        ]
        titles = ["length\n[um]", f"K_max\n[{unit}]", f"K_min\n[{unit}]", f"range\n[{unit}]"]
        lines = [self._describe_place(), format_table(titles, rows)]
        if "error" in self.dataset:
            for name, error in (("K_max", self.error), ("range", self.dK_error())):
                lines.append(f"error of {name}: {1e-6 * error.max():.2g} {unit} at most")
        return wrap("\n".join(lines))

    def _describe_place(self) -> str:
        """Describe where the crack starts, and its angle from the inward normal."""
        about = self.dataset.attrs
        if "x" not in about:
            return "crack"
        start = f"crack from x = {1e6 * float(about['x']):.4g} um"
        return f"{start}, {math.degrees(float(about.get('angle', 0.0))):.3g} deg from the normal"

    @quantities
    def dK(self, threshold: Threshold | None = None) -> NDArray[np.float64]:
        """Positive part of the range of K_I at each length, at R = 0 with a threshold's R rule."""
        return self._range(threshold, 0.0)

    def _range(
        self, threshold: Threshold | None, more: NDArray[np.float64] | float
    ) -> NDArray[np.float64]:
        """Return the positive part of the range of K, with `more` added to K_max.

        With a threshold it is the range at R = 0 that is as severe.
        """
        _, largest, smallest = self._curve(more)
        if threshold is None or not np.all(np.isfinite(largest)):
            return np.maximum(largest, 0.0) - np.maximum(smallest, 0.0)
        return np.asarray(_core.equivalent_range(threshold._numbers(), largest, smallest))

    def _curve(
        self, more: NDArray[np.float64] | float = 0.0
    ) -> tuple[list[float], list[float], list[float]]:
        """Lengths, K_max with `more` of it, and K_min."""
        largest = np.maximum(self.K_max + more, self.K_min)
        return self.lengths.tolist(), largest.tolist(), self.K_min.tolist()

    @quantities
    def arrest(
        self, threshold: Threshold | Material | str, *, start: Length | None = None
    ) -> CrackArrest:
        """Say whether a crack of the length `start` [m] (default: the shortest) grows and stops.

        The threshold may be a material or its name.

        With the errors of K its verdict, length and margin have theirs: the crack is followed again
        with K_max less and more its error.
        """
        first = float(self.lengths[0]) if start is None else as_number(start)
        below = cast("Threshold", threshold)

        def arrest_with_more(more: NDArray[np.float64] | float) -> tuple[Any, ...]:
            """Return verdict, length, crossings, start, margin and place with `more` on K_max."""
            return _core.arrest(*self._curve(more), below._numbers(), first)

        verdict, length, crossings, at_start, margin, at = arrest_with_more(0.0)
        arrest = CrackArrest(
            verdict,
            first,
            length if verdict == "stops" else None,
            tuple(crossings),
            margin,
            at,
            at_start,
            (float(self.lengths[0]), float(self.lengths[-1])),
            estimate=below.estimate,
        )
        if "error" not in self.dataset:
            return arrest
        ends = [arrest_with_more(error) for error in self._ends()]
        stops = [
            {"dormant": first, "grows": math.inf}.get(end[0], end[1])
            for end in (*ends, [verdict, length])
        ]
        return replace(
            arrest,
            margin_error=max(abs(end[4] - margin) for end in ends),
            at_start_error=max(abs(end[3] - at_start) for end in ends),
            lengths=(float(min(stops)), float(max(stops))),
            verdicts=tuple(dict.fromkeys([verdict, *(end[0] for end in ends)])),
        )

    @quantities
    def life(
        self,
        threshold: Threshold | Material | str,
        paris: Paris | Material | str | None = None,
        *,
        start: Length | None = None,
        end: Length | None = None,
    ) -> CrackLife:
        """Count the cycles from the length `start` [m] to `end` [m] or to arrest.

        By default from the shortest to the longest crack, by the law of growth of the material that
        the threshold is of. Threshold and law are given as such, or as a material or its name.

        With the errors of K the cycles have a range, as :meth:`arrest`. The scatter of the
        threshold and of the law of growth is no part of it.
        """
        below = cast("Threshold", threshold)
        growth = below.growth if paris is None else cast("Paris", paris)
        if growth is None:
            raise ValueError(
                "paris: the threshold has no law of growth, give Paris(C, m), or a material that "
                "has paris_C and paris_m"
            )

        def arrest_with_more(more: NDArray[np.float64] | float) -> tuple[float, float, bool]:
            """Return the life with `more` added to K_max."""
            return _core.crack_life(
                *self._curve(more),
                below._numbers(),
                C=growth.C * 1e-6**growth.m,
                m=growth.m,
                growth=growth.threshold_in,
                short=growth.short,
                start=float(self.lengths[0]) if start is None else as_number(start),
                end=float(self.lengths[-1]) if end is None else as_number(end),
            )

        life = CrackLife(
            *arrest_with_more(0.0), self.arrest(threshold, start=start), estimate=growth.estimate
        )
        if "error" not in self.dataset:
            return life
        ends = [arrest_with_more(error)[0] for error in self._ends()]
        return replace(life, low=min(life.cycles, *ends), high=max(life.cycles, *ends))

    @quantities
    def kitagawa(self, threshold: Threshold) -> xr.Dataset:
        """Give Kitagawa and Takahashi's diagram: ranges of stress over the length of the crack.

        ``limit`` is dK_th(l)/(Y sqrt(pi l)). ``load`` is the range of K of the cycle over the same
        Y sqrt(pi l) [Pa]. A crack grows where the load is above the limit.

        References
        ----------
        H. Kitagawa, S. Takahashi, Proc. 2nd Int. Conf. Mechanical Behavior of Materials (1976) 627.
        """
        root = threshold.Y * np.sqrt(np.pi * self.lengths)
        units = {"units": "Pa"}
        return xr.Dataset(
            {
                "limit": ("length", threshold.range_at(self.lengths) / root, units),
                "load": ("length", self.dK(threshold) / root, units),
            },
            coords={"length": self.dataset.length},
        )

    def __repr__(self) -> str:
        """Lengths and the largest range."""
        lengths = self.lengths
        return (
            f"Cracks of {lengths.size} lengths from {lengths[0] * 1e6:.4g} to "
            f"{lengths[-1] * 1e6:.4g} um, dK up to {self.dK().max() / 1e6:.4g} MPa m^0.5"
        )
