"""A section of a run whose loops are judged: the damage on the worst plane of every point."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from pyfret import _core
from pyfret._core import Assessment, Criterion
from pyfret._util.lazy import xr
from pyfret.fatigue.criteria import CriterionName
from pyfret.fatigue.cycle_section import choose_depths, section_body
from pyfret.fatigue.cycles import history as stress_history
from pyfret.fatigue.section import Materials, Section, for_each_layer

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from numpy.typing import NDArray

    from pyfret._core import Elastic
    from pyfret.fatigue.damage_law import DamageLaw
    from pyfret.history.states import LoopStates
    from pyfret.quantities import Lengths
    from pyfret.run.run import Run
    from pyfret.subsurface.line import Line

__all__ = ["JudgedSection"]

#: Note on the order of the loops.
ORDER = "Miner's sum takes the loops in any order"
#: Part of the damage that the order must change to be noted.
LEAST_DIFFERENCE = 0.01


class JudgedSection:
    """A section of a run with the assessments of its layers.

    Attributes
    ----------
    worst_depth : float
        Depth of the largest damage [m], once the damage is computed.
    worst_layer, worst_column : int
        Its layer, and its place along the section.
    """

    worst_depth = 0.0
    worst_layer = worst_column = 0

    def __init__(
        self,
        run: Run,
        section: Section,
        materials: Materials,
        criterion: CriterionName,
        z: Lengths | None,
        law: DamageLaw,
    ) -> None:
        self.run, self.section, self.law = run, section, law
        layers = len(section_body(run, section).coatings) + 1
        of_layers = for_each_layer(materials, layers, "material", "materials")
        body = section_body(run, section)
        if body.yields:
            raise ValueError(
                f"body{section.body_number}: yields, and loops of a history are elastic here: "
                "judge a cycle of it by result.life"
            )
        elastic = [*(coating.material for coating in body.coatings), body.substrate]
        self.assessments: list[Assessment | None] = [
            None if material is None else with_constants(material.assessment(criterion), constants)
            for material, constants in zip(of_layers, elastic, strict=True)
        ]
        self.depths, self.layers = choose_depths(run, section, z, of_layers, "material")

    def stress(self, run: Run, depths: Lengths | None = None) -> xr.DataArray:
        """Return the stress of the kept increments of a run: (increment, depth, place, 6)."""
        s = self.section
        line: Line = s.line
        if depths is None:
            depths = np.unique(np.array(self.depths))
        return stress_history(
            run,
            depths,
            x=line.x,
            y=line.y,
            azimuth=line.azimuth,
            body_number=s.body_number,
            cycle=None,
            residual=s.residual,
        )

    def _parts(
        self, stress: xr.DataArray, states: LoopStates, *, bounded: bool
    ) -> Iterator[tuple[int, NDArray[np.float64], Mapping[str, NDArray[np.float64]]]]:
        """Yield the index, the loop stress and the damage fields of each depth with a material.

        The stress is (loop, moment, place, component).
        """
        kept = np.searchsorted(stress.increment.values, states.increments)
        values = stress.values[kept]
        counts = np.ascontiguousarray(states.rows[:, 2])
        for n, layer in enumerate(stress.layer.values):
            assessment = self.assessments[int(layer)]
            if assessment is None:
                continue
            of_loops = np.einsum("lmi,ipc->lmpc", states.weights, values[:, n])
            yield n, of_loops, self.judge(int(layer), of_loops, counts, bounded=bounded)

    def judge(
        self,
        layer: int,
        of_loops: NDArray[np.float64],
        counts: NDArray[np.float64],
        *,
        bounded: bool = False,
    ) -> Mapping[str, NDArray[np.float64]]:
        """Judge the stress of loops at points of a layer: (loops, moments, points, 6)."""
        assessment = self.assessments[layer]
        assert assessment is not None
        return _core.damage_on(
            assessment,
            np.ascontiguousarray(of_loops),
            np.ascontiguousarray(counts),
            below=self.law.below,
            knee=self.law.knee,
            exponent=self.law.exponent,
            bounded=bounded,
        )

    def order_range(self, dataset: xr.Dataset) -> tuple[float, float]:
        """Return the damage of the worst point with small loops first, and with small loops last.

        Loops below the knee do no damage before any above it has occurred (original law). After
        those the curve goes on below the knee with its slope (elementary law).
        """
        assessment = self.assessments[self.worst_layer]
        if assessment is None:
            return 0.0, 0.0
        values = np.ascontiguousarray(dataset.value.values)
        sums = [
            float(
                dataset["count"].values
                @ _core.damage_of_values(
                    assessment, values, below=law, knee=self.law.knee, exponent=self.law.exponent
                )
            )
            for law in ("original", "elementary")
        ]
        return sums[0], sums[1]

    def worst_row(self, run: Run) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        """Return the stress of the increments of a run at the depth of the largest damage.

        The stress has the shape (increment, place, 6). The second array has the increments.
        """
        stress = self.stress(run, [self.worst_depth])
        layers = stress.layer.values.astype(int)
        row = int(np.flatnonzero(layers == self.worst_layer)[0])
        return stress.values[:, row], stress.increment.values

    def damage_of(self, states: LoopStates) -> xr.Dataset:
        """Return the fields of the damage, and the parts of the loops at the worst point."""
        stress = self.stress(self.run)
        _, depth, along, _ = stress.dims
        shape = (stress.sizes[depth], stress.sizes[along])
        field, normal = np.full(shape, np.nan), np.full((*shape, 3), np.nan)
        worst = (-1.0, 0, 0)
        for n, _, fields in self._parts(stress, states, bounded=False):
            field[n], normal[n] = fields["damage"], fields["normal"]
            k = int(field[n].argmax())
            if field[n, k] > worst[0]:
                worst = (float(field[n, k]), n, k)
        _, row, column = worst
        self.worst_depth, self.worst_column = float(stress.z.values[row]), column
        self.worst_layer = int(stress.layer.values[row])
        point = stress.isel({depth: [row], along: [column]})
        _, of_loops, fields = next(self._parts(point, states, bounded=True))
        n_worst = fields["normal"][0]
        s_n = normal_stress(of_loops[:, :, 0], n_worst)
        closed = (s_n <= 0.0).all(axis=1) & (states.rows[:, 2] > 0.0)
        coords = {name: c for name, c in stress.coords.items() if set(c.dims) <= {depth, along}}
        rows = states.rows
        return xr.Dataset(
            {
                "damage": (
                    (depth, along),
                    field,
                    {"units": "1", "long_name": "damage of one pass of the history"},
                ),
                "normal": (
                    (depth, along, "axis"),
                    normal,
                    {"units": "1", "long_name": "normal of the worst plane"},
                ),
                "range": ("loop", rows[:, 0], {"long_name": "range of the loop"}),
                "mean": ("loop", rows[:, 1], {"long_name": "mean of the loop"}),
                "count": ("loop", rows[:, 2], {"units": "1", "long_name": "number of loops"}),
                "part": (
                    "loop",
                    fields["parts"][0],
                    {"units": "1", "long_name": "damage of the loops at the worst point"},
                ),
                "value": (
                    "loop",
                    fields["values"][0],
                    {"long_name": "value of the criterion on the worst plane"},
                ),
                "compressive": (
                    "loop",
                    closed,
                    {"units": "1", "long_name": "no tension on the worst plane in the loop"},
                ),
            },
            coords={**xr.Dataset(coords=coords).coords, "axis": ["x", "y", "z"]},
            attrs={
                "place": place_of(point, self.section),
                "missed": float(fields["missed"][0]),
                **{k: v for k, v in self.run.dataset.attrs.items() if k in ("a_H", "p_H")},
            },
        )

    def notes_on(self, dataset: xr.Dataset) -> list[str]:
        """Return notes on loops without tension, and on the order of the loops."""
        last, first = self.order_range(dataset)
        notes = [ORDER]
        if first > (1.0 + LEAST_DIFFERENCE) * last:
            notes = [
                f"{ORDER}: {_core.rough(last)} in one pass at least, if loops below the knee come "
                f"before all others, and {_core.rough(first)} at most, if they come after them"
            ]
        closed = int(dataset.compressive.sum())
        if closed:
            notes.append(
                f"{closed} of {dataset.sizes['loop']} rows of loops have no tension on the worst "
                "plane"
            )
        return notes


def with_constants(assessment: Assessment, elastic: Elastic) -> Assessment:
    """Return an assessment whose strains follow from the stress by the constants of the scene."""
    numbers = dict(assessment.criterion.numbers)
    scene_numbers = {"E": elastic.E, "nu": elastic.nu}
    changed = {name: value for name, value in scene_numbers.items() if name in numbers}
    if not changed or not math.isfinite(elastic.E):
        return assessment
    criterion = Criterion(assessment.criterion.name, **{**numbers, **changed})
    return Assessment(criterion, limit=assessment.limit, curve=assessment.curve)


def normal_stress(stress: NDArray[np.float64], n: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the normal stress on a plane; the last axis holds xx, yy, zz, xy, xz, yz."""
    if np.isnan(n).any():
        return np.asarray(stress[..., :3].max(axis=-1))
    x, y, z = n
    weights = np.array([x * x, y * y, z * z, 2 * x * y, 2 * x * z, 2 * y * z])
    return np.asarray(stress @ weights)


def place_of(point: xr.DataArray, section: Section) -> list[float]:
    """Return x, y, z of a point of a section [m]."""
    along = str(point.dims[2])
    position, z = float(point[along].values[0]), float(point.z.values[0])
    if "x" in point.coords and "y" in point.coords:
        return [float(np.ravel(point[axis].values)[0]) for axis in ("x", "y")] + [z]
    if along == "x":
        return [position, float(section.line.y or 0.0), z]
    return [float(section.line.x or 0.0), position, z]
