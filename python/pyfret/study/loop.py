"""The loop over all points of a study."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._core import LoadPath, OffGridError, Scene
from pyfret._util.numbers import in_words
from pyfret._util.progress import Progress
from pyfret.quantities import quantities
from pyfret.study.design import Combine, Design, Source, check_source
from pyfret.study.lock import only_writer
from pyfret.study.measures import Measure, check_measures, code_checksums, measure_names
from pyfret.study.memory import Columns
from pyfret.study.outcome import Study, open_study
from pyfret.study.point import Outcome, failure, solve_point
from pyfret.study.store import Store, check_names
from pyfret.study.workers import Workers

if TYPE_CHECKING:
    from concurrent.futures import Executor, Future

__all__ = ["run"]

#: The default measures.
DEFAULT = ("loop_energy", "energy_ratio", "stick_ratio", "p_max")


@quantities
def run(
    scene: Source,
    parameters: Mapping[str, Any],
    *,
    path: LoadPath | None = None,
    combine: Combine = "grid",
    measure: Measure | Sequence[Measure] = DEFAULT,
    executor: Any = None,
    out: str | os.PathLike[str] | None = None,
    grow: bool = True,
    again: bool = False,
    progress: bool = True,
    on_point: Callable[[int, int], object] | None = None,
) -> Study:
    """Solve a contact for many values of its parameters.

    Parameters
    ----------
    scene : Scene, path or callable
        The contact: a scene with its load path, its file, or a function that makes the scene
        of a ``dict`` of values. A file keeps its own measures, such as ``{ a_H = 1.0 }``, a
        :class:`Scene` has all numbers in SI units.
    parameters : mapping of str to values
        Values by the keys of a scene file, as after ``fret run --set``, such as
        ``{"body2.coatings.0.E": [1e11, 2e11], "mu": [0.2, 0.4]}``; ``"mu"`` is short for
        ``"friction.mu"``. A text with its unit, ``"2 um"``, is the number in SI, 2e-6. Names of
        your own where `scene` is a function.
        ``"W"`` is the normal force of every branch, ``"path.*.W"``.
    path : LoadPath, optional
        The load path, in place of the one of a :class:`Scene`, as in :func:`pyfret.solve`.
    combine : "grid" or "zip"
        Every combination of the values, or the values in step: the first of each, then the
        second of each. Samples (SALib, Latin hypercubes) are of the second kind.
    measure : str, callable, or sequence of these
        Numbers to keep of each result: names of :data:`pyfret.study.MEASURES`, or functions of the
        :class:`Result`. A function gives a number, an :class:`xarray.DataArray`, or a mapping or
        dataset of these. Default: energy and energy ratio of the last cycle, stick ratio at the
        end, largest pressure.
    executor : int, Executor or distributed.Client, optional
        The workers: so many processes of this machine (default: one for each processor, which
        they share out), an executor of ``concurrent.futures``, or a client of a Dask cluster.
    out : path, optional
        Store that is filled while the study goes on. Where there is one of the same study its
        points are kept and the open ones solved. Without it the study is in memory only.
    grow : bool
        Whether a grid that proves too small gets more cells of the same size, up to 7.5 times as
        many along a side (default True).
    again : bool
        Whether points that failed before are solved again.
    progress : bool
        Whether to draw a progress bar on a terminal or in a notebook.
    on_point : callable, optional
        A function called with the number of points done, and of all points.

    Returns
    -------
    Study
        The measures over the parameters; each point has its status, and its reason if it failed.

    Raises
    ------
    StoreError
        The place `out` is taken, or holds another study. The message names the difference.
    ValueError
        Parameters or measures have no meaning.

    Examples
    --------
    >>> table = run(
    ...     "coated.toml",
    ...     {"body2.coatings.0.E.E_substrate": [0.5, 1, 2], "mu": [0.2, 0.4]},
    ...     measure=["loop_energy", "von_mises"],
    ...     out="study.zarr",
    ... )  # doctest: +SKIP
    >>> table.map("von_mises")  # doctest: +SKIP
    """
    if path is not None:
        if not isinstance(scene, Scene):
            raise TypeError("path: must be left out, as scene is no Scene; put it into the scene")
        scene = scene.replace(path=path)
    check_source(scene)
    keys = isinstance(scene, Scene | str | os.PathLike)
    design, measures = Design.from_values(parameters, combine, keys=keys), check_measures(measure)
    check_names(design, measures)
    attributes = {
        "study": design.describe(scene, {} if out is None else code_checksums(measures)),
        "measures": ", ".join(measure_names(measures)),
        "title": scene.title if isinstance(scene, Scene) else "",
    }

    design.check(scene)

    def go_through(store: Store | Columns) -> None:
        """Solve all points that are left, and write their outcomes."""
        points = store.open_points(again=again)
        done, total = len(design) - len(points), len(design)
        costs = Costs()
        with Progress(title=attributes["title"] or "study", shown=progress) as bar:
            for n, outcome in outcomes(points, design, scene, measures, executor, grow=grow):
                store.write(n, outcome)
                done += 1
                costs.add(outcome.costs)
                bar.note = str(costs)
                bar.update(done - total + len(points), len(points))
                if on_point is not None:
                    on_point(done, total)

    if out is None:
        columns = Columns(design, attributes)
        go_through(columns)
        study = Study(columns.dataset())
    else:
        Store.prepare(out, design, attributes)
        with only_writer(Path(out)):
            go_through(Store(out, design, attributes))
        study = open_study(out)
    # Measures have no values where every point failed.
    for name in (
        measure_name
        for measure_name in measures
        if isinstance(measure_name, str) and measure_name not in study.dataset
    ):
        status = study.dataset["status"]
        study.dataset[name] = (status.dims, np.full(status.shape, np.nan))
    return study


class Costs:
    """Mean processor times of the points of a study, by what takes them."""

    def __init__(self) -> None:
        self.sums: dict[str, float] = {}
        self.points = 0

    def add(self, costs: Mapping[str, float]) -> None:
        """Add the times of a point [s]; a point without an answer has none."""
        self.points += bool(costs)
        for name, seconds in costs.items():
            self.sums[name] = self.sums.get(name, 0.0) + seconds

    def __str__(self) -> str:
        """Give the mean times of a point, the largest first: "solution 0.3 s, von_mises 0.2 s"."""
        dear = sorted(self.sums.items(), key=lambda item: item[1], reverse=True)
        times = [
            f"{name} {in_words(seconds / self.points, 2)} s"
            for name, seconds in dear
            if seconds >= CHEAP * dear[0][1]
        ]
        return f"{', '.join(times[:SHOWN])} a point" if times else ""


#: Part of the largest time from which on another is printed, and the number of times printed.
CHEAP, SHOWN = 0.05, 4


def middle_scene(design: Design, source: Source) -> Scene | None:
    """Return the scene in the middle of the study, the first guess of the increments of all others.

    It depends on the study alone, so that a study that goes on gives the same bits.
    """
    sizes = tuple(design.sizes.values())
    point = int(np.ravel_multi_index([size // 2 for size in sizes], sizes)) if sizes else 0
    try:
        scene = design.scene(source, point)
        scene.check()
    except Exception:
        return None
    return scene


def outcomes(
    points: list[int],
    design: Design,
    source: Source,
    measures: list[Measure],
    executor: Any,
    *,
    grow: bool,
) -> Iterator[tuple[int, Outcome]]:
    """Solve the points; yield each point with its outcome."""
    scenes: dict[int, Scene] = {}
    home = os.getpid()
    for n in points:
        try:
            scenes[n] = design.scene(source, n)
            scenes[n].check()
        except Exception as error:
            # A grid that is too small may grow.
            if n not in scenes or not isinstance(error, OffGridError):
                scenes.pop(n, None)
                yield n, failure(error)
    if not scenes:
        return
    workers = Workers(executor, len(scenes))
    like = middle_scene(design, source)

    def submit(to: Executor, n: int) -> Future[Outcome]:
        """Hand a point to a worker."""
        return to.submit(
            solve_point,
            scenes[n],
            measures,
            like=like,
            grow=grow,
            threads=workers.threads,
            home=home,
        )

    yield from workers.run(list(scenes), submit)
