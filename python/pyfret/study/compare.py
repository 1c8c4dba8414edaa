"""Comparison of several bodies, for example coatings, in the same contact."""

from __future__ import annotations

import json
import math
import warnings
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

from pyfret._core import Grid, InvalidSceneError, LoadPath, Scene
from pyfret._util.scene_warnings import SceneWarning
from pyfret.fatigue.criteria import CriterionName
from pyfret.heat import Conductors
from pyfret.quantities import Frequency, as_number, quantities
from pyfret.solution import read
from pyfret.study.candidate import Candidate, Duty, to_candidate
from pyfret.study.comparison import Comparison
from pyfret.study.loop import run
from pyfret.study.questions import NUMBERS, PLACES, QUESTIONS, Answers

if TYPE_CHECKING:
    import os
    from collections.abc import Callable

    from pyfret._core import Body
    from pyfret.wear.settings import Law as WearLaw

__all__ = ["compare"]

#: Refinement factor between the two solutions of every candidate, which give the error: the second
#: one has half as many cells along a side.
COARSER = 2


@quantities
def compare(
    bodies: Mapping[str, Body | Candidate],
    scene: Scene | str | os.PathLike[str],
    path: LoadPath | None = None,
    *,
    questions: Sequence[str] | None = None,
    body_number: Literal[1, 2] = 2,
    criterion: CriterionName = "smith_watson_topper",
    cycles: float | None = None,
    cycling: Literal["auto", "march", "sliding"] = "auto",
    frequency: Frequency | None = None,
    other_wear: WearLaw | list[WearLaw | None] | None = None,
    other_conductor: Conductors | None = None,
    executor: Any = None,
    out: str | os.PathLike[str] | None = None,
    again: bool = False,
    progress: bool = True,
    on_point: Callable[[int, int], object] | None = None,
) -> Comparison:
    """Compare several bodies, for example coatings, in the same contact.

    Every body is solved twice, on the grid of the scene and on cells twice as large. The error of a
    number is the difference of the two, or its own estimate if this is larger. Numbers whose ranges
    overlap are called "no difference". Errors common to all bodies, for example the scatter of one
    substrate's life, are not included.

    A life follows from the mean stress over the critical distance of the material. A material
    without one has the life of the worst point. The table names the stress.

    Parameters
    ----------
    bodies : mapping of str to Body or Candidate
        The bodies by their names. A :class:`pyfret.study.Candidate` is a body with data
        of its layers: friction, materials, strengths, laws of wear.
    scene : Scene or path
        The contact; the body `body_number` is exchanged.
    path : LoadPath, optional
        Load history (default: the scene's own). Most questions need a closed cycle.
    questions : sequence of str, optional
        Some of ``"tension"``, ``"yield"``, ``"adhesion"``, ``"life"``, ``"wear"``, ``"energy"`` and
        ``"temperature"`` (default: all). Questions that no body can answer are left out.
    body_number : 1 or 2
        The body that is exchanged.
    criterion : str
        Criterion of the lives, one of :data:`pyfret.fatigue.CRITERIA`.
    cycles : float, optional
        Cycles of wear.
    cycling : "auto", "march" or "sliding"
        As in :func:`pyfret.wear.solve`.
    frequency : float, optional
        Cycles per second [Hz], for the temperature.
    other_wear, other_conductor : optional
        How the body that stays wears and conducts heat.
    executor, out, again, progress, on_point
        As in :func:`pyfret.study.run`: a comparison is a study, of two points for each body.

    Returns
    -------
    Comparison
        The table; ``comparison.plot()`` draws it, ``comparison.summary()`` gives it as text.

    Raises
    ------
    ValueError
        There are no bodies, or a question is unknown.
    RuntimeError
        No body could be solved; the message has the reason of each.

    Examples
    --------
    >>> found = compare(
    ...     {"bare": bare, "TiN": coated}, scene, path, questions=["tension", "energy"]
    ... )  # doctest: +SKIP
    >>> print(found.summary())  # doctest: +SKIP
    """
    if not bodies:
        raise ValueError('bodies = {}: give some, such as {"bare": body, "TiN": coated}')
    if body_number not in (1, 2):
        raise ValueError(f"body_number = {body_number}: must be 1 or 2")
    question_names = tuple(QUESTIONS) if questions is None else tuple(questions)
    for name in question_names:
        if name not in QUESTIONS:
            raise ValueError(f"question {name!r}: must be one of {', '.join(QUESTIONS)}")
    duty = Duty(
        body_number=body_number,
        criterion=criterion,
        cycles=cycles,
        cycling=cycling,
        frequency=as_number(frequency),
        other_wear=other_wear,
        other_conductor=other_conductor,
    )
    candidates = {name: to_candidate(body) for name, body in bodies.items()}
    rows = own_rows(candidates)
    whole = read(scene).replace(path=path)
    answers = Answers(candidates, duty, question_names)
    variants = Variants(whole, answers)
    with warnings.catch_warnings():
        # Doubts stand in the table, once for each body.
        warnings.simplefilter("ignore", SceneWarning)
        for name, body in candidates.items():
            try:
                variants.scene_of(name, 1).check()
            except InvalidSceneError as error:
                raise type(error)(refusal_message(name, body, str(error))) from error
        study = run(
            variants,
            {"candidate": list(candidates), "coarser": [1, COARSER]},
            measure=answers,
            executor=executor,
            out=out,
            again=again,
            progress=progress,
            on_point=on_point,
        )
    missing: dict[str, str] = {}
    doubts = {name: variants.scene_of(name, 1).doubts() for name in candidates}
    for question in question_names:
        for name, body in candidates.items():
            if needed := QUESTIONS[question].missing(body, duty, whole):
                missing[f"{name}, {question}"] = needed
            else:
                doubts[name] += QUESTIONS[question].notes(body, duty)
    return Comparison.from_study(
        study,
        missing,
        title=whole.title,
        coatings=[len(body.body.coatings) for body in candidates.values()],
        doubts=doubts,
        rows=rows,
        layer_materials=[material_names(body) for body in candidates.values()],
    )


def material_names(candidate: Candidate) -> list[str]:
    """Return a text for every layer that is the same for the same material."""
    body = candidate.body
    stiffness = [*(coating.material for coating in body.coatings), body.substrate]
    return [f"{elastic.E:.9g} {elastic.nu:.9g}" for elastic in stiffness]


def own_rows(candidates: Mapping[str, Candidate]) -> dict[str, list[float | str]]:
    """Collect the rows that the candidates bring along; NaN or "" if a candidate has none."""
    for label, of in candidates.items():
        if not isinstance(of.rows, Mapping):
            raise TypeError(
                f'candidate {label}: rows = {of.rows!r}: must be a table, {{"cost": 3.2}}'
            )
    names = dict.fromkeys(name for candidate in candidates.values() for name in candidate.rows)
    for name in names:
        if name in NUMBERS or name in PLACES or name in ("coatings", "candidate"):
            raise ValueError(f"rows: {name!r} is a number of the comparison; give another name")
    rows: dict[str, list[float | str]] = {}
    for name in names:
        values = [candidate.rows.get(name) for candidate in candidates.values()]
        text = any(isinstance(value, str) for value in values)
        none: float | str = "" if text else math.nan
        made = [none if value is None else str(value) if text else float(value) for value in values]
        rows[name] = made
    return rows


@dataclass(frozen=True)
class Variants:
    """A function that makes the scene of a point: a candidate on cells of a given size."""

    scene: Scene
    answers: Answers

    def __call__(self, point: dict[str, Any]) -> Scene:
        """Return the scene of a candidate, with its name as title."""
        return self.scene_of(point["candidate"], int(point["coarser"]))

    def scene_of(self, name: str, coarser: int) -> Scene:
        """Return the scene of a candidate on cells larger by the factor `coarser`."""
        candidate_of_point = self.answers.candidates[name]
        changes: dict[str, Any] = {
            "title": name,
            f"body{self.answers.duty.body_number}": candidate_of_point.body,
            "grid": on_larger_cells(self.scene.grid, coarser),
            "save": "all" if self.answers.needs_fields() else "branches",
        }
        if candidate_of_point.mu is not None:
            changes["friction"] = self.scene.friction.replace(mu=candidate_of_point.mu)
        return self.scene.replace(**changes)

    def describe(self) -> str:
        """Describe scene, bodies and questions, so that comparisons can be distinguished."""
        parts = [
            self.scene.to_toml(),
            {name: item.describe() for name, item in self.answers.candidates.items()},
            self.answers.duty.describe(),
            self.answers.questions,
        ]
        text = json.dumps(parts)
        return f"comparison of {', '.join(self.answers.candidates)}, {zlib.crc32(text.encode()):x}"


def refusal_message(name: str, body_data: Candidate, why: str) -> str:
    """Explain why a candidate has no scene, with a remedy if its friction is too low."""
    if body_data.mu is None:
        return f"candidate {name}: {why}"
    remedy = ""
    if "friction can carry" in why:
        remedy = (
            ". All candidates run the path of the scene: lower its force below the friction of "
            "every candidate, or prescribe the displacement (delta_x) in place of the force"
        )
    return f"candidate {name}, mu = {body_data.mu:g}: {why}{remedy}"


def on_larger_cells(grid: Grid, times: int) -> Grid:
    """Return a grid of the same size with larger cells."""

    def fewer(n: int) -> int:
        """Return a number of cells divided by `times`, at least one."""
        return max(-(-n // times), 2)

    if times == 1:
        return grid
    line = grid.plane_strain
    return grid.replace(
        nx=fewer(grid.nx),
        ny=1 if line else fewer(grid.ny),
        dx=grid.dx * times,
        dy=grid.dy if line else grid.dy * times,
    )
