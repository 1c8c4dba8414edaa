"""Thresholds: the load at which a criterion, a life or a yield factor reaches a value.

A margin is nearly a power of the load. In logarithms it is nearly a straight line over the load, so
that few solves bracket the threshold.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import product
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from pyfret._core import Grid, Scene
from pyfret._util.extras import needed
from pyfret._util.holds_arrays import HoldsArrays
from pyfret._util.lazy import xr
from pyfret._util.parameters import in_si
from pyfret.fatigue.averages import Averaging, average
from pyfret.fatigue.criteria import CriterionName, Material
from pyfret.fatigue.lives import life
from pyfret.quantities import InSI, Length, as_number, by_default, part, quantities
from pyfret.solution import solve
from pyfret.study.design import check_source, with_values

if TYPE_CHECKING:
    import os

    from numpy.typing import NDArray

    from pyfret.fatigue.ranges import LifeRange

__all__ = ["Averaged", "Limits", "ThresholdLoad", "fit_limits", "threshold"]

#: A scene, its file, or a function that makes one of the value of the parameters.
Source: TypeAlias = "Scene | str | os.PathLike[str] | Callable[[dict[str, Any]], Scene]"
#: Most solves of a threshold.
MAX_SOLVES = 24


@part()
class Averaged:
    """A measure: the smallest margin of a criterion on the stress averaged over a distance.

    Parameters
    ----------
    material : Material
        The material with its limits.
    criterion : str
        One of :data:`pyfret.fatigue.CRITERIA`.
    L : float, optional
        Critical distance [m] (default: the material's own).
    method : "point", "line", "area" or "volume"
        As in :func:`pyfret.fatigue.average`.
    body_number : 1 or 2
        The body.
    """

    material: Material
    criterion: CriterionName = "crossland"
    L: InSI[Length | None] = by_default(None)
    method: Averaging = "line"
    body_number: int = 2

    def __call__(self, result: Any) -> float:
        """Return the smallest margin of a result along the surface: safety factor or life."""
        margins = average(
            result,
            self.material,
            self.criterion,
            L=self.L,
            method=self.method,
            body_number=self.body_number,
        )
        margin = margins.life if "life" in margins else margins.safety_factor
        return float(margin.min())

    @property
    def estimate(self) -> str | None:
        """Names of the used material numbers that are estimates."""
        notes = self.material.assessment(self.criterion).range_at(1.0, 0.0, self.material)[3]
        if self.L is None:
            notes.append(self.material.estimate_of(["dK_th", "s_D"]) or "")
        return "; ".join(filter(None, notes)) or None

    def range_of(self, result: Any) -> LifeRange:
        """Return the range of the margin of a result, 10 to 90 %: stress, material and distance."""
        judged = life(result, self.material, self.criterion, body_number=self.body_number)
        return judged.range_of(judged.worst.layer, L=self.L, method=self.method)


@dataclass(frozen=True)
class ThresholdLoad:
    """A load at which a measure reaches its value.

    Attributes
    ----------
    value : float
        The threshold; infinite or zero where the measure does not reach its value within the range.
    error : float
        Half of the bracket, plus the change on cells twice as wide.
    solves : int
        Contacts solved.
    path : tuple of (float, float)
        Loads tried and their measures.
    low, high : float
        The range of 10 to 90 % of the specimens, from the range of the margin at the threshold (for
        :class:`Averaged`); NaN where the measure has no range or ``error=False``.
    estimate : str or None
        Names of the material numbers of an :class:`Averaged` that are estimates.
    """

    value: float
    error: float
    solves: int
    path: tuple[tuple[float, float], ...] = field(repr=False)
    low: float = math.nan
    high: float = math.nan
    estimate: str | None = None

    def __float__(self) -> float:
        """Return the threshold."""
        return self.value


@quantities
def threshold(
    scene: Source,
    parameter: str,
    *,
    measure: Callable[[Any], float],
    between: tuple[float, float],
    value: float = 1.0,
    over: Mapping[str, Sequence[float | str]] | None = None,
    tolerance: float = 5e-3,
    error: bool = True,
) -> ThresholdLoad | xr.Dataset:
    """Find the load at which a measure reaches a value.

    Parameters
    ----------
    scene : Scene, path or callable
        The contact with its path, its file, or a function that makes the scene of a ``dict`` of
        values, as in :func:`pyfret.study.run`.
    parameter : str
        The searched parameter: a key of the scene file, ``"path.1.T_x"``, or a name of your own
        where `scene` is a function.
    measure : callable
        A function of the :class:`pyfret.Result` that grows or falls with the parameter, such as
        :class:`Averaged` (a safety factor or a life).
    between : (float, float)
        Range that is searched, above 0.
    value : float
        The value that the measure shall reach (default 1).
    over : mapping of str to list, optional
        A curve over other parameters: every combination of their values, numbers in SI or texts
        with a unit.
    tolerance : float
        Width of the bracket at the end, over the threshold.
    error : bool
        Whether to solve once more on cells twice as wide, for the error.

    Returns
    -------
    ThresholdLoad, or Dataset over the other parameters
        ``threshold``, its ``error``, ``low`` and ``high`` of its range, and ``solves``.

    Raises
    ------
    ValueError
        The measure is on one side of its value within the whole range. The message names the side.
    """
    check_source(scene)
    if over is None:
        return find_threshold(scene, parameter, measure, between, value, {}, tolerance, error=error)
    lists: dict[str, Sequence[Any]] = dict(over)
    if not callable(scene) or isinstance(scene, Scene):
        lists = {name: [in_si(name, item) for item in items] for name, items in over.items()}
    names = list(over)
    shape = [len(over[name]) for name in names]
    thresholds = [
        find_threshold(
            scene,
            parameter,
            measure,
            between,
            value,
            dict(zip(names, point, strict=True)),
            tolerance,
            error=error,
        )
        for point in product(*lists.values())
    ]
    fields = {
        "threshold": np.reshape([f.value for f in thresholds], shape),
        "error": np.reshape([f.error for f in thresholds], shape),
        "low": np.reshape([f.low for f in thresholds], shape),
        "high": np.reshape([f.high for f in thresholds], shape),
        "solves": np.reshape([f.solves for f in thresholds], shape),
    }
    return xr.Dataset(
        {name: (names, values) for name, values in fields.items()},
        coords={name: np.asarray(lists[name], dtype=float) for name in names},
        attrs={"parameter": parameter, "value": value, **estimate_attribute(measure)},
    )


def estimate_attribute(measure: Callable[[Any], float]) -> dict[str, str]:
    """Return the estimates that a measure uses, as an attribute."""
    note = measure.estimate if isinstance(measure, Averaged) else None
    return {"estimate": note} if note else {}


def find_threshold(
    source: Source,
    parameter: str,
    measure: Callable[[Any], float],
    between: tuple[float, float],
    value: float,
    other_values: Mapping[str, float],
    tolerance: float,
    *,
    error: bool,
) -> ThresholdLoad:
    """Find one threshold."""
    low, high = (float(v) for v in between)
    if not 0 < low < high:
        raise ValueError(f"between = {between}: must be two loads above 0, the smaller one first")
    if not 0 < value < math.inf:
        raise ValueError(f"value = {value}: must be above 0")
    optimize = needed("scipy.optimize", "fit")
    first = scene_of(source, {**other_values, parameter: low})
    tried: dict[float, float] = {}

    def log_margin(load: float, coarser: int = 1) -> float:
        """Return the logarithm of the margin under a load."""
        scene = scene_of(source, {**other_values, parameter: load})
        if coarser > 1:
            scene = scene.replace(grid=widen_cells(scene.grid, coarser))
        measured = float(measure(solve_silently(scene, like=first)))
        if not measured > 0:
            raise ValueError(f"{parameter} = {load:g}: the measure is {measured}: must be above 0")
        # A life without end counts as long.
        return min(math.log(measured / value), 700.0)

    def solved_margin(log_load: float) -> float:
        """Return the logarithm of the margin, with the load noted."""
        load = math.exp(log_load)
        if load not in tried:
            tried[load] = log_margin(load)
        return tried[load]

    ends = math.log(low), math.log(high)
    sides = solved_margin(ends[0]), solved_margin(ends[1])
    if sides[0] * sides[1] > 0:
        where = "above" if sides[0] > 0 else "below"
        raise ValueError(
            f"{parameter}: the measure is {where} {value:g} from {low:g} "
            f"({value * math.exp(sides[0]):.4g}) "
            f"to {high:g} ({value * math.exp(sides[1]):.4g}): widen `between`"
        )
    root = float(
        optimize.toms748(
            solved_margin, *ends, xtol=0.5 * tolerance, rtol=1e-6, maxiter=MAX_SOLVES, k=1
        )
    )
    solved_margin(root)
    points = sorted((math.log(load), m) for load, m in tried.items())
    near = min(points, key=lambda p: abs(p[1]))
    root = near[0] if abs(near[1]) < abs(tried[math.exp(root)]) else root
    bracket = 0.5 * tolerance * math.exp(root)
    solves, grid_error, spread = len(tried), 0.0, (math.nan, math.nan)
    if error:
        slope = slope_at(points, root)
        grid_error = (
            abs(log_margin(math.exp(root), 2) - solved_margin(root))
            / max(abs(slope), 1e-3)
            * math.exp(root)
        )
        solves += 1
        if isinstance(measure, Averaged):
            root_scene = scene_of(source, {**other_values, parameter: math.exp(root)})
            spread = threshold_range(
                measure.range_of(solve_silently(root_scene, like=first)), math.exp(root), slope
            )
            solves += 1
    path = tuple((load, value * math.exp(m)) for load, m in tried.items())
    note = estimate_attribute(measure).get("estimate")
    return ThresholdLoad(math.exp(root), bracket + grid_error, solves, path, *spread, note)


def threshold_range(margin: LifeRange, load: float, slope: float) -> tuple[float, float]:
    """Return the range of a threshold, for a margin that is a power of the load.

    `load` is the threshold of the mean material, `slope` is d ln(margin)/d ln(load).
    Specimens with the margin m have the threshold load (m/best)^(-1/slope).
    """
    power = -1.0 / math.copysign(max(abs(slope), 0.05), slope)
    ends = [load * (m / margin.best) ** power for m in (margin.low, margin.high)]
    return min(ends), max(ends)


def solve_silently(scene: Scene, *, like: Scene) -> Any:
    """Solve a scene with the increments of a similar one, without warnings."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return solve(scene, like=like, progress=False)


def slope_at(points: list[tuple[float, float]], root: float) -> float:
    """Return the slope of the logarithms at the root, between the nearest distinct loads."""
    near = sorted(points, key=lambda p: abs(p[0] - root))
    nearest = near[0]
    for neighbour in near[1:]:
        if abs(neighbour[0] - nearest[0]) > 1e-3:
            return (neighbour[1] - nearest[1]) / (neighbour[0] - nearest[0])
    return 1.0


def scene_of(source: Source, values: dict[str, Any]) -> Scene:
    """Return the scene of some values."""
    if callable(source) and not isinstance(source, Scene):
        return source(values)
    return with_values(source, values)


def widen_cells(grid: Grid, times: int) -> Grid:
    """Return a grid over the same area with wider cells."""
    nx = max(grid.nx // times, 1)
    ny = grid.ny if grid.plane_strain else max(grid.ny // times, 1)
    return grid.replace(nx=nx, ny=ny, dx=grid.dx * grid.nx / nx, dy=grid.dy * grid.ny / ny)


@dataclass(frozen=True, eq=False, repr=False)
class Limits(HoldsArrays):
    """A critical distance and a limit fitted to tests at their thresholds.

    Attributes
    ----------
    material : Material
        The material with its limits scaled to the tests.
    L : float
        Critical distance [m].
    limit : float
        Factor on the limits of the given material.
    scatter : float
        Standard deviation of ln of the the ratios of computed to measured thresholds.
    ratios : array
        Threshold computed over measured of each test, to first order.
    L_range : (float, float)
        Distances whose scatter is not significantly larger [m].
    """

    material: Material
    L: float
    limit: float
    scatter: float
    ratios: NDArray[np.float64]
    L_range: tuple[float, float]

    def measure(
        self, criterion: CriterionName = "crossland", method: Averaging = "line"
    ) -> Averaged:
        """Return the measure of :func:`threshold` with these numbers."""
        return Averaged(self.material, criterion, self.L, method)


#: Load ratio for the sensitivity of the margin.
LOAD_RATIO = 0.9


@quantities
def fit_limits(
    tests: Sequence[tuple[Callable[[float], Scene], float]],
    material: Material,
    criterion: CriterionName = "crossland",
    *,
    L: tuple[Length, Length] = (5e-6, 2e-4),
    known: float = math.inf,
    method: Averaging = "line",
    n: int = 9,
) -> Limits:
    """Fit a critical distance and the limit of a criterion to tests at their thresholds.

    Both limits of the material, ``s_D`` and ``t_D``, are scaled alike. A margin m that falls with
    the load as its power -s puts the threshold at m^(1/s) of the load. The distance is the one at
    which these thresholds scatter least. The limit makes the mean of their logarithms 0. A scatter
    of margins alone would favour distances at which no load matters. Few tests determine the
    distance badly. The uncertainty of the limits beforehand, `known`, then is added.

    Parameters
    ----------
    tests : sequence of (callable, float)
        The scene of a test as a function of its load, and the load at which a crack began. The
        increments of a closed cycle are kept.
    material : Material
        Limits to begin with.
    criterion : str
        A criterion with a safety factor that goes as 1 over the limits, such as ``"crossland"``.
    L : (float, float)
        Range of the distance [m].
    known : float
        Standard deviation of ln of the material's limits before the tests, 0.1 for limits that are
        known to 10 % (default: not at all).
    method : "point", "line", "area" or "volume"
        How the stress is averaged.
    n : int
        Distances that are tried before the best is refined.
    """
    if not isinstance(tests, Sequence) or len(tests) < 3:
        count = len(tests) if isinstance(tests, Sequence) else 0
        raise ValueError(f"tests: {count} tests, two numbers need 3 at least")
    pairs = [
        [solve(scene(part * load), save="all", progress=False) for part in (1.0, LOAD_RATIO)]
        for scene, load in tests
    ]
    solved: dict[float, tuple[float, NDArray[np.float64]]] = {}

    def thresholds(log_L: float) -> tuple[float, NDArray[np.float64]]:
        """Return the factor of the limits, and ln of computed over measured thresholds."""
        if log_L not in solved:
            judge = Averaged(material, criterion, math.exp(log_L), method)
            logs = np.log([[judge(result) for result in pair] for pair in pairs])
            slopes = np.maximum((logs[:, 1] - logs[:, 0]) / -math.log(LOAD_RATIO), 0.05)
            factor = -float(np.sum(logs[:, 0] / slopes) / np.sum(1 / slopes))
            solved[log_L] = math.exp(factor), (logs[:, 0] + factor) / slopes
        return solved[log_L]

    def scatter(log_L: float) -> float:
        """Return the scatter of computed over measured thresholds."""
        return float(np.sqrt(np.sum(thresholds(log_L)[1] ** 2) / (len(tests) - 2)))

    def misfit(log_L: float) -> float:
        """Return minus the logarithm of the likelihood with unknown scatter and the prior."""
        prior = 0.5 * (math.log(thresholds(log_L)[0]) / known) ** 2
        return len(tests) * math.log(scatter(log_L)) + prior

    low, high = (math.log(as_number(bound)) for bound in L)
    distances = np.linspace(low, high, n)
    best = int(np.argmin([misfit(float(t)) for t in distances]))
    optimize = needed("scipy.optimize", "fit")
    ends = float(distances[max(best - 1, 0)]), float(distances[min(best + 1, n - 1)])
    optimize.minimize_scalar(misfit, bounds=ends, method="bounded", options={"maxiter": 5})
    best_log_L = min(solved, key=misfit)
    factor, logs = thresholds(best_log_L)
    # Variances of ratio 1 + 4/(tests - 2) cannot be distinguished by this number of tests.
    alike = scatter(best_log_L) * math.sqrt(1 + 4 / (len(tests) - 2))
    good = [log_L for log_L in solved if scatter(log_L) <= alike]
    numbers = [
        (name, factor * number if name in ("s_D", "t_D") else number, source)
        for name, number, source in material.numbers()
    ]
    return Limits(
        material=Material(material.name, numbers, material.title),
        L=math.exp(best_log_L),
        limit=factor,
        scatter=scatter(best_log_L),
        ratios=np.exp(logs),
        L_range=(math.exp(min(good)), math.exp(max(good))),
    )
