"""The search for the unknowns: least squares over solved contacts.

Every evaluation is a solve, so the Jacobian takes one for each unknown, solved side by side. The
offsets of gauges are unknowns as well, but cost none. The step of the differences is far above the
error of a prediction by the solver's tolerance. At the end the scene is solved once more on cells
twice as wide, and once with half of the increments (of the jumps, where it wears). To first order
both move the unknowns; this is the solver's part of the confidence.

The confidence of an unknown follows from the linear model where it is narrow. Where it is wide the
model is not linear over it, and each end is moved outwards. It ends where the sum of squares, least
over all other unknowns, has risen by what noise explains (a profile). This takes one or two solves
an end.
"""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor, ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from functools import partial
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._core import Branch, Grid, LoadPath, Scene
from pyfret._util.extras import application, needed
from pyfret.fit.data import Data, Indentation, Loops
from pyfret.fit.models import DRIFTS, Model, model_of, split
from pyfret.fit.outcome import FitResult, Known, Posterior
from pyfret.fit.ranges import USUAL, SearchRange, ranges, with_usual_ranges
from pyfret.quantities import quantities
from pyfret.study.design import with_values

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["fit"]

#: Steps of the search, each a solve and one more for each unknown.
MOST = 13
#: Half-width of a confidence, of ln of an unknown or of its range, beyond which its profile is
#: computed, and the largest ratio of its ends to the ends of the linear model.
WIDE, FARTHER = 0.15, 3.0
#: Threads that solve contacts side by side where nothing is said.
THREADS = 2
#: Errors of what a record leaves unsure that its part of a confidence of 95 % has.
SURE = 2.0
#: Least divisor of shares of errors.
TINY = 1e-300
#: Stiffness of a rig over the stiffness of rig and contact in series, to start with.
STIFFER = 1.5
#: Residual without a spring or a drift over the residual with them, up to which they are left out.
EXPLAINED = 1.2
#: Noise of data without a given one, over their range, to weigh sets of data.
NOISE = 0.02


@quantities
def fit(
    scene: Scene | str | PathLike[str],
    data: Data | Sequence[Data],
    *,
    unknown: Mapping[str, tuple[float, ...]] | Sequence[str] | str | None = None,
    executor: int | Executor | None = None,
    posterior: int = 0,
    seed: int = 0,
) -> FitResult:
    """Find unknowns of a scene from what was measured.

    Parameters
    ----------
    scene : Scene or path
        The contact with all known values; of its path loops and indentations take the normal force.
    data : Loops, Indentation, Scar, Lives, or list of these
        What was measured.
    unknown : mapping of str to (low, high) or (low, start, high), or names, optional
        Ranges by the keys of a scene file, such as ``"mu"``, ``"rig.stiffness"``,
        ``"body2.coatings.0.E"``, ``"body2.coatings.0.thickness"``, ``"body1.shape.sphere.R"``, and
        of its wear, ``"wear.body2.alpha"``, ``"wear.body2.share"``. Positive ranges are searched
        by their logarithm. The names alone are enough for ``"mu"``, sought in 0.05 to 2, and
        ``"rig.stiffness"``, in 1e5 to 1e10 N/m; these two are the default of loops.
    executor : int or Executor, optional
        What solves contacts side by side: so many threads (default: two), or an executor of
        ``concurrent.futures``.
    posterior : int
        Number of samples of the posterior (default: none), by ``emcee``, of a quadratic model of
        the contact around the best values; 16 more solves for three unknowns. The prior is flat
        in what is searched.
    seed : int
        Seed of these samples.

    Returns
    -------
    FitResult
        Values, their 95 % confidence, doubts; :meth:`FitResult.summary`. Tilt and drift that loops
        have by default are left out where they hide the unknowns and the residual stays the same.
        A doubt names them.

    Raises
    ------
    ValueError
        There is no unknown, or a range is missing or has no meaning.
    ModuleNotFoundError
        ``scipy`` (or ``emcee``) is not installed: ``pip install "fretting[fit]"``.

    Examples
    --------
    >>> loops = pyfret.fit.read_loops("loop.csv")  # doctest: +SKIP
    >>> fit("scene.toml", loops)["mu"]  # doctest: +SKIP
    >>> fit("scene.toml", loops, unknown={"mu": (0.1, 1.5)})  # doctest: +SKIP
    """
    needed("scipy.optimize", "fit")
    if posterior < 0:
        raise ValueError(f"posterior = {posterior}: must be a number of samples, 0 for none")
    if not isinstance(scene, Scene | str | PathLike):
        raise TypeError(f"scene = {scene!r:.60}: must be a Scene or the path of a scene file")
    if not isinstance(scene, Scene):
        scene = Scene.from_file(scene)
    sets: list[Data] = list(data) if isinstance(data, Sequence) else [data]
    whole = scene
    if all(isinstance(item, Loops | Indentation) for item in sets):
        scene = under_normal_force(scene)
    if unknown is None and sets and all(isinstance(item, Loops) for item in sets):
        unknown = tuple(USUAL)
    searched = ranges(with_usual_ranges(unknown, estimate_unknowns(scene, sets)))
    with warnings.catch_warnings():
        # Warnings are silenced during the search; the caller checks the final scene.
        warnings.simplefilter("ignore")
        search = Search(scene, [model_of(item) for item in sets], searched, executor)
        fitted, best = search.minimize()
        if not fitted.is_resolved:
            simpler_sets, left_out = without_defaults(sets)
            if left_out:
                simpler = Search(scene, [model_of(i) for i in simpler_sets], searched, executor)
                without, best_without = simpler.minimize()
                worst = max(
                    a / max(b, 1e-300) for a, b in zip(without.noise, fitted.noise, strict=True)
                )
                if without.is_resolved and worst < EXPLAINED:
                    solves = fitted.solves + without.solves
                    fitted = replace(without, solves=solves, left_out=left_out)
                    search, best = simpler, best_without
        fitted = replace(fitted, scene=with_found(whole, fitted))
        return search.with_posterior(fitted, best, posterior, seed) if posterior else fitted


def under_normal_force(scene: Scene) -> Scene:
    """Return the scene with its largest normal force alone: loops bring their own motion."""
    path = scene.path
    if all(branch.W is not None and not moves(branch) for branch in path.branches):
        return scene
    W = max((branch.W or 0.0 for branch in path.branches), default=0.0)
    pressed = LoadPath.start().normal(W, increments=1) if W > 0.0 else LoadPath.start()
    return scene.replace(path=pressed.rig(path.rig_stiffness))


def with_found(scene: Scene, fitted: FitResult) -> Scene:
    """Return the user's scene with the values found; the searched one if its path refuses them."""
    values = split({key: unknown.value for key, unknown in fitted.known.items()})[0]
    try:
        return with_values(scene, values) if values else scene
    except ValueError:
        return fitted.scene


def moves(branch: Branch) -> bool:
    """Whether a branch has a tangential force or shift."""
    return any(getattr(branch, name) for name in ("T_x", "T_y", "delta_x", "delta_y"))


def estimate_unknowns(scene: Scene, sets: Sequence[Data]) -> dict[str, float]:
    """Estimate friction and rig from the first loops, to start a search there.

    The force is at most mu W, and the rig is stiffer than rig and contact in series.
    """
    loops = next((item for item in sets if isinstance(item, Loops)), None)
    if loops is None:
        return {}
    W = max((branch.W or 0.0 for branch in scene.path.branches), default=0.0)
    W = loops.W if loops.W is not None else W
    estimates = {"mu": 0.55 * float(np.ptp(loops.T)) / W} if W > 0.0 else {}
    secant = float(np.ptp(loops.T)) / max(float(np.ptp(loops.delta)), 1e-300)
    estimates["rig.stiffness"] = STIFFER * (loops.flank_slope or secant)
    return estimates


def without_defaults(sets: Sequence[Data]) -> tuple[list[Data], tuple[str, ...]]:
    """Return data without the offsets that are unknown by default, and the names of these."""
    simpler: list[Data] = []
    left_out: dict[str, None] = {}
    for item in sets:
        changes: dict[str, bool] = {}
        if isinstance(item, Loops):
            has_drifts = set(DRIFTS) <= set(model_of(item).offsets)
            if item.tilt is None and item.sliding_slope is not None:
                changes["tilt"] = False
                left_out["tilt"] = None
            if item.drifts is None and has_drifts:
                changes["drifts"] = False
                left_out["drift"] = None
        simpler.append(replace(item, **changes) if changes else item)  # type: ignore[arg-type]
    return simpler, tuple(left_out)


@dataclass
class Search:
    """Residuals and their derivatives, each contact solved once."""

    scene: Scene
    models: list[Model]
    ranges: list[SearchRange]
    executor: int | Executor | None
    solves: int = 0
    #: Whether cells twice as wide and half of the increments could be solved, too.
    solver_known: bool = True
    known: dict[tuple[float, ...], list[Any]] = field(default_factory=dict)

    def start(self) -> NDArray[np.float64]:
        """The first guess: unknowns, then offsets over their scales."""
        first = [min(max(r.to_u(r.start), 1e-3), 1 - 1e-3) for r in self.ranges]
        return np.concatenate([first, np.zeros(self.gauges)])

    def minimize(self) -> tuple[FitResult, NDArray[np.float64]]:
        """Search the least squares; return the fit, and the unknowns and offsets there."""
        minimum = needed("scipy.optimize", "fit").least_squares(
            self.residual,
            self.start(),
            jac=self.jacobian,
            bounds=self.bounds(),
            x_scale=1.0,
            xtol=1e-4,
            ftol=1e-5,
            gtol=1e-9,
            max_nfev=MOST,
        )
        best = np.asarray(minimum.x)
        return self.outcome(best, converged=bool(minimum.status > 0)), best

    @property
    def gauges(self) -> int:
        """Return the number of offsets of gauges that are fitted."""
        return sum(len(model.offsets) for model in self.models)

    def bounds(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the lower and upper ends of unknowns and offsets."""
        n = len(self.ranges)
        low = np.r_[np.zeros(n), np.full(self.gauges, -1.0)]
        return low, np.r_[np.ones(n), np.full(self.gauges, 1.0)]

    def values(self, u: Sequence[float] | NDArray[np.float64]) -> dict[str, float]:
        """Return the values of the unknowns at u, their places in the ranges."""
        return {r.key: r.value(float(x)) for r, x in zip(self.ranges, u, strict=False)}

    def predictions(self, scene: Scene, u: tuple[float, ...], finer: float = 1.0) -> list[Any]:
        """Solve all models at u, with `finer` times their increments."""
        values = self.values(u)
        of_scene, _ = split(values)
        changed = with_values(scene, of_scene) if of_scene else scene
        return [model.predict(changed, values, finer) for model in self.models]

    def solved(self, points: list[tuple[float, ...]]) -> None:
        """Solve at points that are not known yet, in parallel."""
        fresh = [u for u in dict.fromkeys(points) if u not in self.known]
        if not fresh:
            return
        predict = partial(self.predictions, self.scene)
        if isinstance(self.executor, Executor):
            done = list(self.executor.map(predict, fresh))
        else:
            with ThreadPoolExecutor(self.executor or THREADS) as pool:
                done = list(pool.map(predict, fresh))
        self.solves += len(fresh) * sum(model.solves for model in self.models)
        self.known |= dict(zip(fresh, done, strict=True))

    def weights(self) -> list[float]:
        """Return the noise that each set of data is divided by.

        Raises
        ------
        ValueError
            All data of a set are equal, and its noise is not given.
        """
        for model in self.models:
            if model.noise is None and not np.ptp(model.measured) > 0:
                raise ValueError(
                    f"data: all {model.measured.size} values of a {type(model.data).__name__} are "
                    "equal, so their scatter is unknown: give noise=, its standard deviation in SI "
                    "units"
                )
        return [
            model.noise
            if model.noise is not None
            else NOISE * max(float(np.ptp(model.measured)), 1e-300)
            for model in self.models
        ]

    def computed(
        self, predictions: list[Any], gauges: NDArray[np.float64], moved: float = 0.0
    ) -> list[NDArray[np.float64]]:
        """Return the predicted measurements with offsets of the gauges."""
        predicted, first = [], 0
        for model, predict in zip(self.models, predictions, strict=True):
            offsets = gauges[first : first + len(model.offsets)] * model.scales
            first += len(model.offsets)
            predicted.append(predict(offsets, moved))
        return predicted

    def weighted(
        self, predictions: list[Any], gauges: NDArray[np.float64], moved: float = 0.0
    ) -> NDArray[np.float64]:
        """Computed over noise, all data in a row."""
        parts = zip(self.computed(predictions, gauges, moved), self.weights(), strict=True)
        return np.concatenate([part / noise for part, noise in parts])

    def parted(self, x: NDArray[np.float64]) -> tuple[tuple[float, ...], NDArray[np.float64]]:
        """Split a vector into the unknowns and the offsets."""
        n = len(self.ranges)
        return tuple(float(u) for u in x[:n]), x[n:]

    def residual(self, x: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return computed less measured values, over the noise."""
        u, gauges = self.parted(x)
        self.solved([u])
        measured = [m.measured / w for m, w in zip(self.models, self.weights(), strict=True)]
        return self.weighted(self.known[u], gauges) - np.concatenate(measured)

    def jacobian(self, x: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the derivatives of the residual, by differences."""
        u, gauges = self.parted(x)
        stepped = []
        for k, r in enumerate(self.ranges):
            step = r.step if u[k] + r.step <= 1 else -r.step
            stepped.append((*u[:k], u[k] + step, *u[k + 1 :]))
        self.solved([u, *stepped])
        weighted_here = self.weighted(self.known[u], gauges)
        columns = [
            (self.weighted(self.known[to], gauges) - weighted_here) / (to[k] - u[k])
            for k, to in enumerate(stepped)
        ]
        for g in range(self.gauges):
            aside = np.zeros(self.gauges)
            aside[g] = 1e-4
            ahead = self.weighted(self.known[u], gauges + aside)
            behind = self.weighted(self.known[u], gauges - aside)
            columns.append((ahead - behind) / 2e-4)
        return np.stack(columns, axis=1)

    def outcome(self, x: NDArray[np.float64], *, converged: bool) -> FitResult:
        """Return values, confidence and correlation at the end of the search."""
        stats = needed("scipy.stats", "fit")
        u, gauges = self.parted(x)
        n = len(self.ranges)
        residual, jacobian = self.residual(x), self.jacobian(x)
        degrees = max(residual.size - x.size, 1)
        variance = float(residual @ residual) / degrees
        has_noise = all(model.noise is not None for model in self.models)
        if has_noise:
            variance = max(variance, 1.0)
        scale = np.linalg.norm(jacobian, axis=0)
        scale[scale == 0] = 1.0
        inverse = np.linalg.pinv(jacobian / scale, rcond=1e-9)
        covariance = variance * (inverse @ inverse.T) / np.outer(scale, scale)
        spread = np.sqrt(np.diag(covariance))
        safe = np.where(spread > 0, spread, 1.0)
        correlation = covariance[:n, :n] / np.outer(safe[:n], safe[:n])
        # Student's t is for a scatter that is known from the residuals alone.
        is_scatter_known = has_noise and variance == 1.0
        t = float(stats.norm.ppf(0.975) if is_scatter_known else stats.t.ppf(0.975, degrees))
        ends_by_model = [
            (t * spread_of_unknown, t * spread_of_unknown) for spread_of_unknown in spread[:n]
        ]
        for k, r in enumerate(self.ranges):
            if t * spread[k] * r.width > WIDE and min(u[k], 1 - u[k]) > 0:
                ends_by_model[k] = self.profile(x, k, covariance, (jacobian, t * np.sqrt(variance)))
        to_all = (inverse.T / scale).T
        parts_of_solver = [np.abs(to_all @ off) for off in self.solver_errors(u, gauges)]
        moved = sum(parts_of_solver)
        unknowns = {}
        for k, r in enumerate(self.ranges):
            value = r.value(u[k])
            low, high = (r.value(u[k] + s * (ends_by_model[k][s > 0] + moved[k])) for s in (-1, 1))
            slope = value * r.width if r.by_log else r.width
            unknowns[r.key] = Known(
                value,
                low,
                high,
                slope * 0.5 * sum(ends_by_model[k]),
                slope * moved[k],
                bool(min(u[k], 1 - u[k]) < 2e-3),
            )
        names = [name for model in self.models for name in model.offsets]
        scales = [float(s) for model in self.models for s in model.scales]
        zeros = [float(zero) for model in self.models for zero in model.zeros]
        offsets = [float(g) * s + z for g, s, z in zip(gauges, scales, zeros, strict=True)]
        half_widths = (t * spread + moved)[n:].tolist()
        offset_errors = [half_width * s for half_width, s in zip(half_widths, scales, strict=True)]
        computed = self.computed(self.known[u], gauges)
        residuals = [m.measured - c for m, c in zip(self.models, computed, strict=True)]
        values = split(self.values(u))[0]
        return FitResult(
            known=unknowns,
            offsets=dict(zip(names, offsets, strict=True)),
            offset_errors=dict(zip(names, offset_errors, strict=True)),
            correlation=correlation,
            residual=residuals,
            computed=computed,
            sets=[model.strip_callables() for model in self.models],
            noise=[float(np.sqrt(np.mean(r**2))) for r in residuals],
            solves=self.solves,
            solver_known=self.solver_known,
            turns_share=float(np.max(parts_of_solver[0][:n] / np.maximum(moved[:n], TINY))),
            converged=converged,
            scene=with_values(self.scene, values) if values else self.scene,
        )

    def with_posterior(
        self, result: FitResult, x: NDArray[np.float64], count: int, seed: int
    ) -> FitResult:
        """Return the fit with samples of the posterior around x."""
        u, gauges = self.parted(x)
        n = len(self.ranges)
        jacobian, residual = self.jacobian(x), self.residual(x)
        variance = float(residual @ residual) / max(residual.size - x.size, 1)
        has_noise = all(model.noise is not None for model in self.models)
        before = self.solves

        def residuals_at(points: list[NDArray[np.float64]]) -> list[NDArray[np.float64]]:
            """Solve at points of the posterior; return their residuals."""
            places = [tuple(float(v) for v in point) for point in points]
            self.solved(places)
            return [self.weighted(self.known[point], gauges) for point in places]

        samples, error = application("pyfret.fit.posterior").sampled(
            residuals_at,
            np.array(u),
            np.asarray(variance * np.linalg.pinv(jacobian.T @ jacobian)[:n, :n], np.float64),
            self.weighted(self.known[u], gauges) - residual,
            jacobian[:, n:],
            noise=np.sqrt(max(variance, 1.0)) if has_noise else None,
            count=count,
            seed=seed,
        )
        values = {
            r.key: np.array([r.value(float(u_k)) for u_k in samples[:, k]])
            for k, r in enumerate(self.ranges)
        }
        posterior = Posterior(values, error, self.solves - before)
        return replace(result, posterior=posterior, solves=self.solves)

    def profile(
        self,
        x: NDArray[np.float64],
        k: int,
        covariance: NDArray[np.float64],
        known: tuple[NDArray[np.float64], float],
    ) -> tuple[float, float]:
        """Distances down and up at which the root of the sum of squares has risen enough.

        The other unknowns follow to first order, which overestimates the rise: no distance is
        shorter than in the linear model. ``known``: the Jacobian, and the root of the rise
        asked for.
        """
        jacobian, rise_wanted = known
        others = np.delete(jacobian, k, axis=1)
        along = covariance[:, k] / covariance[k, k]
        linear = rise_wanted / float(np.linalg.norm(jacobian @ along))
        residual = self.residual(x)
        least = float(residual @ residual)

        def risen(to: float) -> float:
            """Return the root of the rise of the misfit at a distance along the direction."""
            there = x + to * along
            there[: len(self.ranges)] = np.clip(there[: len(self.ranges)], 0.0, 1.0)
            residual = self.residual(there)
            fitted = others @ np.linalg.lstsq(others, residual, rcond=None)[0]
            unfitted = residual - fitted
            return float(np.sqrt(max(float(unfitted @ unfitted) - least, 0.0)))

        def end(sign: float, room: float) -> float:
            """Return the distance to the end of the confidence interval, at most `room`."""
            if linear >= room:
                return linear
            rise = max(risen(sign * linear), 1e-3 * rise_wanted)
            if rise >= rise_wanted:
                return linear
            to = min(linear * min(rise_wanted / rise, FARTHER), room)
            further = risen(sign * to)
            if further <= max(rise_wanted, rise):
                return to
            return linear + (to - linear) * (rise_wanted - rise) / (further - rise)

        return end(-1, x[k]), end(1, 1 - x[k])

    def solver_errors(
        self, u: tuple[float, ...], gauges: NDArray[np.float64]
    ) -> list[NDArray[np.float64]]:
        """Return the changes of the predictions on cells twice as wide and half of the increments.

        Each is larger than the error of cells and increments. Turns of a loop that the record
        leaves uncertain are moved by :data:`SURE` errors.
        """
        reference = self.weighted(self.known[u], gauges)
        coarse = self.scene.replace(grid=coarser(self.scene.grid))
        changes = [self.weighted(self.known[u], gauges, SURE) - reference]
        for scene, finer in ((coarse, 1.0), (self.scene, 0.5)):
            try:
                predictions = self.predictions(scene, u, finer)
            except (RuntimeError, ValueError):
                # On cells that are too wide for the contact there is no telling.
                self.solver_known = False
                changes.append(np.zeros_like(reference))
            else:
                changes.append(self.weighted(predictions, gauges) - reference)
                self.solves += sum(model.solves for model in self.models)
        return changes


def coarser(grid: Grid) -> Grid:
    """Return a grid over the same area with cells twice as wide."""
    nx = max(grid.nx // 2, 1)
    ny = grid.ny if grid.plane_strain else max(grid.ny // 2, 1)
    dx, dy = grid.dx * grid.nx / nx, grid.dy * grid.ny / ny
    return grid.replace(nx=nx, ny=ny, dx=dx, dy=dy)
