"""Prediction of a measurement: the scene with given unknowns, solved."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

import numpy as np

from pyfret import wear
from pyfret._core import LoadPath, OffGridError, Scene
from pyfret._util.extras import needed
from pyfret.fit.data import Data, Indentation, Lives, Loops, Measured, Scar
from pyfret.fit.turns import find_turns
from pyfret.solution import solve
from pyfret.study.design import with_values
from pyfret.study.point import GROWTHS, enlarge_grid

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["Model", "model_of", "wear_arguments"]

T = TypeVar("T")
#: What should have been measured, of offsets and of how far what is unsure is moved.
Predicted: TypeAlias = "Callable[[NDArray[np.float64], float], NDArray[np.float64]]"
Curve: TypeAlias = "Callable[[NDArray[np.float64]], NDArray[np.float64]]"

#: Increments of a way of the loop and of an indentation, unless the scene's path has others.
WAY, INDENTATION = 24, 16
#: What of the measurement of loops may be unknown.
SHIFT, FORCE = "offset of the shift [m]", "offset of the force [N]"
TILT = "spring beside the contact [N/m]"
DRIFTS = ("drift of the shift [m]", "drift of the force [N]")
#: Default tolerance of the jumps of a run of wear.
TOLERANCE = 0.01


@dataclass(frozen=True, eq=False, repr=False)
class Model(Measured):
    """How a kind of data is computed.

    Attributes
    ----------
    offsets : tuple of str
        What of the measurement itself is unknown besides: zeros and drifts of its gauges, springs
        beside the contact; free of solves.
    scales : array
        About the size of each offset.
    zeros : array
        What each offset is counted from.
    solves : int
        Solves that one prediction takes.
    predict : callable
        Computes the measured numbers under a scene; offsets are added afterwards. ``moved`` shifts
        the uncertain parts of the record (the turns of a loop) by so many of their errors.
        ``finer`` = 1/2 takes half as many increments and jumps as usual.
    """

    offsets: tuple[str, ...]
    scales: NDArray[np.float64]
    solves: int
    predict: Callable[[Scene, Mapping[str, float], float], Predicted]
    noise: float | None
    zeros: NDArray[np.float64]

    def strip_callables(self) -> Measured:
        """Return the measurement without its callables."""
        return Measured(self.data, self.measured, self.along, self.labels)


def model_of(data: Data) -> Model:
    """Build the model of a kind of data."""
    for kind, make in ((Loops, loops_model), (Indentation, indentation_model), (Scar, scar_model)):
        if isinstance(data, kind):
            return make(data)  # type: ignore[arg-type]
    if isinstance(data, Lives):
        return lives_model(data)
    raise TypeError(
        "data: must be loops, an indentation, a scar or lives (fret.fit.read_loops(...)), "
        f"not {data!r}"
    )


def interpolate_smoothly(x: NDArray[np.float64], y: NDArray[np.float64]) -> Curve:
    """Return a smooth curve through points without overshoot, straight beyond its ends."""
    interpolate = needed("scipy.interpolate", "fit")
    order = np.argsort(x, kind="stable")
    x, y = x[order], y[order]
    fresh = np.r_[True, np.diff(x) > 1e-12 * max(np.ptp(x), 1e-300)]
    x, y = x[fresh], y[fresh]
    curve = interpolate.PchipInterpolator(x, y, extrapolate=True)
    ends = [(x[k], y[k], float(curve(x[k], 1))) for k in (0, -1)]

    def extended(where: NDArray[np.float64]) -> NDArray[np.float64]:
        """Evaluate the curve, by straight lines beyond its ends."""
        y = np.asarray(curve(where))
        (low, y_low, s_low), (high, y_high, s_high) = ends
        y = np.where(where < low, y_low + s_low * (where - low), y)
        return np.where(where > high, y_high + s_high * (where - high), y)

    return extended


def loops_model(data: Loops) -> Model:
    """Build the model of measured loops: a closed cycle between the measured turns, under W."""
    cycles = range(int(data.cycle.max()) + 1)
    many = len(cycles) > 1 or (data.turns is not None and len(data.turns) > 1)
    drifts = data.drifts if data.drifts is not None else many
    time = np.linspace(-0.5, 0.5, data.delta.size)
    steady = data.delta - (drift_of_turns(data.delta, time) * time if drifts else 0.0)
    of_cycle = [steady[data.cycle == n] for n in cycles]
    reach = 0.5 * float(np.median([np.ptp(shift) for shift in of_cycle]))
    middle = float(np.median([0.5 * (s.max() + s.min()) for s in of_cycle]))
    unsure = 0.0
    if reach_and_error := reach_of_turns(data, drifts=drifts):
        reach, unsure = reach_and_error
    force = 0.5 * float(np.median([np.ptp(data.T[data.cycle == n]) for n in cycles]))
    tilts = data.tilt if data.tilt is not None else data.sliding_slope is not None

    def predict(scene: Scene, _: Mapping[str, float], finer: float) -> Predicted:
        """Solve the cycle on the scene, with increments `finer` times as many."""
        W = data.W if data.W is not None else normal_force(scene)
        path = LoadPath.start().normal(W, increments=1).rig(scene.path.rig_stiffness)
        for to, ways in ((reach, 0.5), (-reach, 1.0), (reach, 1.0)):
            path = path.displace(delta_x=to, increments=round(WAY * ways * finer))
        d = growing(scene, lambda s: solve(s, path, save=[len(path)], progress=False)).dataset
        branch = d.branch_of_increment.values
        shift, T = d.delta_x.values, d.T_x.values
        curves = []
        for n in (2, 3):
            first = int(np.flatnonzero(branch == n)[0])
            ways = np.r_[first - 1, np.flatnonzero(branch == n)]
            curves.append(interpolate_smoothly(shift[ways], T[ways]))

        def predicted(offsets: NDArray[np.float64], moved: float = 0.0) -> NDArray[np.float64]:
            """Return the force at the measured shifts, with offsets and moved turns."""
            values_of_offsets = dict(zip(offset_scales, offsets, strict=True))
            where = (
                data.delta
                - middle
                - values_of_offsets[SHIFT]
                - values_of_offsets.get(DRIFTS[0], 0.0) * time
            )
            # Turns farther out move the branches apart.
            down, up = (
                curve(where - sign * moved * unsure)
                for sign, curve in zip((1.0, -1.0), curves, strict=True)
            )
            beside = (
                values_of_offsets[FORCE]
                + values_of_offsets.get(DRIFTS[1], 0.0) * time
                + values_of_offsets.get(TILT, 0.0) * where
            )
            return np.asarray(np.where(data.down, down, up) + beside)

        return predicted

    offset_scales = {SHIFT: reach, FORCE: force}
    if tilts:
        offset_scales[TILT] = force / reach
    if drifts:
        offset_scales |= dict(zip(DRIFTS, (reach, force), strict=True))
    scales = np.array(list(offset_scales.values()))
    zeros = np.array([middle, *np.zeros(len(offset_scales) - 1)])
    labels = ("shift [m]", "force [N]")
    along, names = data.delta, tuple(offset_scales)
    return Model(data, data.T, along, labels, names, scales, 1, predict, data.noise, zeros)


def reach_of_turns(data: Loops, *, drifts: bool) -> tuple[float, float] | None:
    """Fit half the distance of the turns, the same in all cycles, and its error [m].

    Least squares of middle, reach and drift; None if the record has too few turns.
    """
    if data.turns is None:
        return None
    at, shift, error = data.turns.T
    upper = shift > 0.5 * (data.delta.max() + data.delta.min())
    columns = [np.where(upper, 1.0, -1.0), np.ones(at.size)]
    if drifts:
        columns.append(at / data.delta.size - 0.5)
    if at.size < len(columns) or upper.all() or not upper.any():
        return None
    matrix = np.stack(columns, axis=1)
    coefficients = np.linalg.lstsq(matrix, shift, rcond=None)[0]
    residual = shift - matrix @ coefficients
    spare = at.size - len(columns)
    scatter = float(np.sqrt(residual @ residual / spare)) if spare else 0.0
    point_error = max(scatter, float(np.sqrt(np.mean(error**2))))
    of_reach = float(np.sqrt(np.linalg.inv(matrix.T @ matrix)[0, 0]))
    return float(coefficients[0]), point_error * of_reach


def drift_of_turns(delta: NDArray[np.float64], time: NDArray[np.float64]) -> float:
    """Fit the slope of the turns over time, the same for both ends of the loop [m/s]."""
    # The ends of a record need not be turns.
    turns = [n for n in find_turns(delta) if 0 < n < delta.size - 1]
    if len(turns) < 3:
        return 0.0
    upper = delta[turns] > 0.5 * (delta.max() + delta.min())
    columns = np.stack([time[turns], upper, ~upper], axis=1).astype(float)
    return float(np.linalg.lstsq(columns, delta[turns], rcond=None)[0][0])


def indentation_model(data: Indentation) -> Model:
    """Build the model of an indentation curve: the approach at the measured forces."""
    W_max = float(data.W.max())

    def predict(scene: Scene, _: Mapping[str, float], finer: float) -> Predicted:
        """Solve the indentation to the largest force."""
        path = LoadPath.start()
        steps = np.linspace(0, 1, round(INDENTATION * finer) + 1)[1:] ** 1.5
        for part in steps:
            path = path.normal(W_max * float(part), increments=1)
        d = growing(scene, lambda s: solve(s, path, save=[len(path)], progress=False)).dataset
        # Over W^(2/3) the curve of a homogeneous sphere is straight.
        curve = interpolate_smoothly(
            np.r_[0.0, d.W.values] ** (2 / 3), np.r_[0.0, d.delta_z.values]
        )
        approach = curve(data.W ** (2 / 3))
        frame = data.W if data.frame else np.zeros_like(data.W)

        def predicted(offsets: NDArray[np.float64], _: float = 0.0) -> NDArray[np.float64]:
            """Return the approach at the measured forces, with the offset and the frame."""
            return np.asarray(approach + offsets[0] + offsets[-1] * frame)

        return predicted

    reach = float(np.ptp(data.delta_z))
    scales, zeros = np.array([reach, reach / W_max]), np.zeros(2)
    labels = ("normal force [N]", "approach [m]")
    offsets: tuple[str, ...] = ("offset of the approach [m]", "compliance of the frame [m/N]")
    if not data.frame:
        offsets, scales, zeros = offsets[:1], scales[:1], zeros[:1]
    along = data.W
    return Model(data, data.delta_z, along, labels, offsets, scales, 1, predict, data.noise, zeros)


def scar_model(data: Scar) -> Model:
    """Build the model of a scar: the worn depth along x at y = 0, at the end of a run of wear."""
    half = float(np.ptp(data.x[data.depth > 0.1 * data.depth.max()])) / 2

    def predict(scene: Scene, values: Mapping[str, float], finer: float) -> Predicted:
        """Run the wear with `finer` times as many jumps."""
        arguments = jumping(wear_arguments(data.wear, values), finer)
        d = growing(scene, lambda s: wear.solve(s, progress=False, **arguments)).dataset
        fields = {1: d.worn1, 2: d.worn2, 0: d.worn1 + d.worn2}
        profile = fields[data.body_number][-1].sel(y=0.0, method="nearest")
        x, depth = d.x.values, profile.values

        def predicted(offsets: NDArray[np.float64], _: float = 0.0) -> NDArray[np.float64]:
            """Return the depth at the measured places, moved by the offsets."""
            return np.asarray(np.interp(data.x - offsets[0], x, depth, left=0.0, right=0.0))

        return predicted

    labels = ("x [m]", "worn depth [m]")
    offsets = ("offset of x [m]",)
    scales, zeros = np.array([half]), np.zeros(1)
    return Model(data, data.depth, data.x, labels, offsets, scales, 1, predict, data.noise, zeros)


def lives_model(data: Lives) -> Model:
    """Build the model of lives: ln of the cycles to a part of the thickness in each test."""

    def predict(scene: Scene, values: Mapping[str, float], finer: float) -> Predicted:
        """Run the wear of every test."""
        lives = []
        for n, settings in enumerate(data.settings):
            arguments = jumping(wear_arguments(data.wear, {**values, **split(settings)[1]}), finer)
            arguments.setdefault("cycles", 4 * float(data.cycles[n]))
            worn = wear.solve(with_values(scene, split(settings)[0]), progress=False, **arguments)
            cycles = worn.cycles_to(part_of_coating=data.part, body_number=data.body_number)
            # A coating that outlives the run by far counts as one that lives four times as long.
            longest = 4 * float(data.cycles[n])
            lives.append(longest if cycles.beyond is not None else min(cycles, longest))
        logs = np.log(lives)

        def predicted(_: NDArray[np.float64], __: float = 0.0) -> NDArray[np.float64]:
            """Return the logarithms of the cycles."""
            return logs

        return predicted

    labels = ("test", "ln of the cycles")
    count = len(data.cycles)
    along = np.arange(count, dtype=float)
    measured, none = np.log(data.cycles), np.zeros(0)
    return Model(data, measured, along, labels, (), none, count, predict, data.noise, none)


def jumping(arguments: dict[str, Any], finer: float) -> dict[str, Any]:
    """Return the arguments of a run of wear with `finer` times as many jumps."""
    counted = [key for key in ("jumps", "explicit_jumps") if arguments.get(key) is not None]
    if finer == 1:
        return arguments
    if counted:
        return arguments | {key: max(round(finer * arguments[key]), 1) for key in counted}
    return arguments | {"tolerance": (arguments.get("tolerance") or TOLERANCE) / finer}


def growing(scene: Scene, run: Callable[[Scene], T]) -> T:
    """Run a scene; where the contact leaves the grid, run it again on a larger one."""
    for _ in range(GROWTHS):
        try:
            return run(scene)
        except OffGridError:
            scene = scene.replace(grid=enlarge_grid(scene.grid))
    return run(scene)


def normal_force(scene: Scene) -> float:
    """Return the largest normal force of the path [N]."""
    W = max((float(branch.W or 0.0) for branch in scene.path.branches), default=0.0)
    if not W > 0:
        raise ValueError("W: no normal force in the path of the scene: give that of the loops, W=")
    return W


def split(settings: Mapping[str, float]) -> tuple[dict[str, float], dict[str, float]]:
    """Split values into keys of a scene and keys of its wear."""
    of_wear = {key: v for key, v in settings.items() if key.startswith("wear.")}
    return {key: v for key, v in settings.items() if key not in of_wear}, of_wear


def wear_arguments(given: Mapping[str, Any], values: Mapping[str, float]) -> dict[str, Any]:
    """Return the arguments of a run of wear with values such as ``wear.body2.alpha`` put in."""
    arguments = dict(given)
    for key, value in split(values)[1].items():
        name, _, law_key = key.removeprefix("wear.").partition(".")
        if name in ("body1", "body2") and law_key in ("k", "alpha", "threshold"):
            law = arguments.get(name)
            if isinstance(law, wear.Archard | wear.DissipatedEnergy) and hasattr(law, law_key):
                arguments[name] = law.replace(**{law_key: value})
            else:
                arguments[name] = {"k": wear.Archard, "alpha": wear.DissipatedEnergy}[law_key](
                    value
                )
        elif name in ("body1", "body2") and law_key == "share":
            arguments[f"share{name[-1]}"] = value
        elif not law_key:
            arguments[name] = value
        else:
            raise ValueError(
                f"{key}: must be wear.body1.k, wear.body2.alpha, wear.body2.share, ..."
            )
    return arguments
