"""The answer to a change: a preview at once, then the full run with its error bars."""

from __future__ import annotations

import ctypes
import os
import threading
import warnings
from collections import OrderedDict
from concurrent.futures import Future
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any, Generic, TypeVar

import numpy as np

from pyfret._core import NoConvergenceError, OffGridError, StoreError, rough, with_error
from pyfret._util.scene_warnings import SceneWarning
from pyfret.run.loops import frictionless, state_in_words
from pyfret.run.summary import directions
from pyfret.solution import solve
from pyfret.workbench.names import layer_labels

if TYPE_CHECKING:
    from collections.abc import Callable

    from pyfret._core import LoadPath, Scene
    from pyfret.result import Result
    from pyfret.subsurface.tensor import Stress

__all__ = ["PageAnswer", "PageNumber", "Recent", "answer_in_full", "preview", "solve_in_full"]

T = TypeVar("T")

#: A preview has the increments of the neighbouring scene over this, a least number in a branch.
FEWER, LEAST = 3, 4
#: Results that are kept: the last of several browsers.
KEPT = 6
#: Units of the page, by the unit in SI.
SHOWN = {
    "m": (1e6, "µm"),
    "rad": (1e6, "µrad"),
    "Pa": (1e-6, "MPa"),
    "J": (1e6, "µJ"),
    "J/m": (1e3, "mJ/m"),
}
#: Errors that a user meets, in words.
REFUSALS = (ValueError, RuntimeError, NoConvergenceError, OffGridError, StoreError, KeyError)


@dataclass(frozen=True)
class PageNumber:
    """A number of an answer, in the unit of the page."""

    name: str
    #: Value with its error, or why there is none.
    text: str
    unit: str = ""
    value: float | None = None
    low: float | None = None
    high: float | None = None
    #: Its place, or what it rests on.
    note: str = ""

    def as_row(self) -> dict[str, Any]:
        """Return the number for a store of the browser."""
        return asdict(self)


@dataclass(frozen=True)
class PageAnswer:
    """Numbers of a run, with what the figures are drawn from."""

    numbers: list[PageNumber]
    doubts: list[str]
    #: Increments of every branch.
    counts: list[int]
    result: Result
    below: Stress | None
    #: Places of the largest stress of every layer: x, y and depth [m].
    marks: tuple[tuple[float, float, float], ...] = ()


def number_with_error(
    name: str, value: float, error: float | None, unit: str = "", note: str = ""
) -> PageNumber:
    """Make a number of a value and its error, an estimate where the error is not known."""
    if error is None or not np.isfinite(error):
        return PageNumber(name, rough(value), unit, value, note=note)
    text = with_error(value, error).replace("+-", "±")
    return PageNumber(name, text, unit, value, value - error, value + error, note)


def in_increments(path: LoadPath, counts: list[int]) -> LoadPath:
    """Return the path with so many increments in each branch."""
    branches = [
        branch.replace(increments=count)
        for branch, count in zip(path.branches, counts, strict=True)
    ]
    return path.replace(branches=branches)


def quietly(action: Callable[[], Result]) -> Result:
    """Run an action without warnings of the scene, which the page shows at the fields."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SceneWarning)
        return action()


class Recent(Generic[T]):
    """The last values, by keys of text: each is computed once for several tabs."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._kept: OrderedDict[str, Future[T]] = OrderedDict()

    def fetch(self, key: str, compute: Callable[[], T]) -> T:
        """Return the value with a key: kept, computed by another thread, or computed here."""
        with self._lock:
            future = self._kept.get(key)
            is_first = future is None
            if future is None:
                future = self._kept[key] = Future()
            self._kept.move_to_end(key)
            while len(self._kept) > KEPT:
                self._kept.popitem(last=False)
        if is_first:
            try:
                future.set_result(compute())
            except BaseException as error:
                with self._lock:
                    self._kept.pop(key, None)
                future.set_exception(error)
            return_free_memory()
        return future.result()


def return_free_memory() -> None:
    """Return freed memory to the system; glibc keeps it for the threads that freed it."""
    trim = getattr(ctypes.CDLL(None), "malloc_trim", None) if os.name == "posix" else None
    if trim is not None:
        trim(0)


#: Previews by scenes and increments, results by scenes, answers by names of materials as well.
PREVIEWS: Recent[PageAnswer] = Recent()
RESULTS: Recent[Result] = Recent()
ANSWERS: Recent[PageAnswer] = Recent()


def preview(scene: Scene, counts: list[int] | None) -> PageAnswer:
    """Solve a scene in few increments: a third of its neighbour's, or 4 in each branch.

    The stress is the one on the section along the shear. Numbers are estimates.
    """
    branches = len(scene.path.branches)
    if counts is None or len(counts) != branches:
        counts = [LEAST] * branches
    fewer = [max(LEAST, count // FEWER) for count in counts]
    coarse = scene.replace(path=in_increments(scene.path, fewer), save="branches")
    return PREVIEWS.fetch(coarse.to_toml(), lambda: make_preview(coarse, counts))


def make_preview(coarse: Scene, counts: list[int]) -> PageAnswer:
    """Make the numbers of a scene in few increments."""
    result = quietly(lambda: solve(coarse, progress=False))
    below = stress_below(result)
    numbers = scalars(result)
    if below is not None:
        largest = float(below.measure("von_mises").max()) / 1e6
        numbers.append(number_with_error("largest von Mises stress", largest, None, "MPa"))
    return PageAnswer(numbers, list(result.doubts), counts, result, below)


def solve_in_full(scene: Scene) -> Result:
    """Solve a scene with error bars, and keep the fields of all increments."""
    whole = scene.replace(save="all")

    def run() -> Result:
        return quietly(lambda: solve(whole, error="coarser", progress=False))

    return RESULTS.fetch(whole.to_toml(), run)


def answer_in_full(scene: Scene, names: dict[str, str]) -> PageAnswer:
    """Solve a scene in the chosen increments: numbers with errors, the largest stress of layers."""
    key = f"{sorted(names.items())}\n{scene.to_toml()}"
    return ANSWERS.fetch(key, lambda: make_answer(scene, names))


def make_answer(scene: Scene, names: dict[str, str]) -> PageAnswer:
    """Make the numbers of the full run of a scene."""
    result = solve_in_full(scene)
    below = stress_below(result)
    numbers = scalars(result)
    marks = []
    if below is not None:
        for number, spot in layer_maxima(below, layer_labels(scene, names)):
            numbers.append(number)
            marks.append(spot)
    counts = np.bincount(result.dataset.branch_of_increment.values)
    return PageAnswer(
        numbers, list(result.doubts), [int(n) for n in counts if n], result, below, tuple(marks)
    )


def stress_below(result: Result) -> Stress | None:
    """Return the stress on the section along the shear, None of a rigid body or without contact."""
    last = result.at(-1)
    if not bool(last.contact.any()) or not np.isfinite(last.scene.body2.substrate.E):
        return None
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SceneWarning)
        return last.stress()


def layer_maxima(
    below: Stress, labels: list[str]
) -> list[tuple[PageNumber, tuple[float, float, float]]]:
    """Return the largest von Mises stress of every layer with its place."""
    numbers = []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SceneWarning)
        for layer in sorted({int(n) for n in below.dataset.layer.values}):
            worst = below.maximum("von_mises", layer=layer)
            location = f"at x = {1e6 * worst.x:.3g} µm, depth {1e6 * worst.z:.3g} µm"
            name = f"largest von Mises stress, {labels[layer]}"
            value, error = 1e-6 * worst.value, 1e-6 * worst.error
            number = number_with_error(name, value, error, "MPa", location)
            numbers.append((number, (worst.x, worst.y, worst.z)))
    return numbers


def scalars(result: Result) -> list[PageNumber]:
    """Return contact, motions and loop at the end of the path, with errors where there are any."""
    ends = result.branches()
    bars = result.error_bars().sel(part="total") if result.dataset.attrs.get("error_bars") else None
    size = "half_width" if "half_width" in ends else "contact_radius"
    names = {"p_max": "largest pressure", size: size.replace("_", " "), "delta_z": "approach"}
    if not frictionless(result.scene):
        names["stick_ratio"] = "stick ratio at the end"
    numbers = []
    for key, name in names.items():
        factor, unit = SHOWN.get(str(ends[key].attrs["units"]), (1.0, ""))
        error = None if bars is None or key not in bars else factor * float(bars[key][-1])
        numbers.append(number_with_error(name, factor * float(ends[key][-1]), error, unit))
    return [*numbers, *loop_numbers(result)]


def loop_numbers(result: Result) -> list[PageNumber]:
    """Return energy, stiffness and state of the last cycle."""
    direction = next(iter(directions(result)), None)
    if direction is None:
        return []
    loops = result.loops(direction=direction)
    if not loops.sizes["cycle"]:
        return [PageNumber("energy of the last cycle", "no closed cycle")]
    last = loops.isel(cycle=-1)
    numbers = []
    for key, name in (
        ("dissipated", "energy of the last cycle"),
        ("energy_ratio", "energy ratio"),
        ("delta", "half the range of the shift"),
    ):
        factor, unit = SHOWN.get(str(last[key].attrs["units"]), (1.0, ""))
        error = factor * float(last[f"{key}_error"]) if f"{key}_error" in last else None
        if key == "delta" and error is None and "error_bars" in result.dataset.attrs:
            error = shift_error(result, direction)
        numbers.append(number_with_error(name, factor * float(last[key]), error, unit))
    return [
        *numbers,
        PageNumber("state of the last cycle", state_in_words(last.status, result.scene)),
    ]


def shift_error(result: Result, direction: str) -> float | None:
    """Return the error of half the range of the shift: the mean of both ends [page unit]."""
    bars = result.error_bars().sel(part="total")
    motion = "phi_z" if direction == "torsion" else f"delta_{direction}"
    if motion not in bars:
        return None
    return 1e6 * float(np.mean(bars[motion].values[-2:]))
