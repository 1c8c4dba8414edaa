"""The same contact with one body or another: which of these coatings."""

from __future__ import annotations

import json
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
from pyfret.study.candidate import Candidate, Duty, candidate
from pyfret.study.comparison import Comparison
from pyfret.study.loop import run
from pyfret.study.questions import QUESTIONS, Answers

if TYPE_CHECKING:
    import os
    from collections.abc import Callable

    from pyfret._core import Body
    from pyfret.wear.settings import Law as WearLaw

__all__ = ["compare"]

#: Cells of the second solution of every candidate, which tells the error: along a side half as
#: many.
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
    cycling: Literal["march", "sliding"] = "march",
    frequency: Frequency | None = None,
    other_wear: WearLaw | list[WearLaw | None] | None = None,
    other_conductor: Conductors | None = None,
    executor: Any = None,
    out: str | os.PathLike[str] | None = None,
    again: bool = False,
    progress: bool = True,
    on_point: Callable[[int, int], object] | None = None,
) -> Comparison:
    """Put several bodies side by side in the same contact, such as one with several coatings.

    Every body is solved twice, on the grid of the scene and on cells twice as large. The error of a
    number is what the two differ by, or its own estimate where that is larger. Numbers whose ranges
    overlap are called "no difference". What is common to all bodies, such as the scatter of one
    substrate's life, is no part of these errors.

    A life is that of the mean stress over the critical distance of the material. A material without
    one has the life of the worst point. The table names the stress.

    Parameters
    ----------
    bodies : mapping of str to Body or Candidate
        What is compared, by its name. A :class:`pyfret.study.Candidate` is a body and what is known
        of its layers: friction, materials, strengths, laws of wear.
    scene : Scene or path
        The contact; the body `body_number` is exchanged.
    path : LoadPath, optional
        Load history (default: that of the scene). Most questions need a closed cycle.
    questions : sequence of str, optional
        Of ``"tension"``, ``"yield"``, ``"adhesion"``, ``"life"``, ``"wear"``, ``"energy"`` and
        ``"temperature"`` (default: all). Those that no body can answer are left out.
    body_number : 1 or 2
        The body that is exchanged.
    criterion : str
        Of the lives, one of :data:`pyfret.fatigue.CRITERIA`.
    cycles : float, optional
        Cycles of wear.
    cycling : "march" or "sliding"
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
    asked = tuple(QUESTIONS) if questions is None else tuple(questions)
    for name in asked:
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
    of = {name: candidate(body) for name, body in bodies.items()}
    whole = read(scene).replace(path=path)
    answers = Answers(of, duty, asked)
    variants = Variants(whole, answers)
    with warnings.catch_warnings():
        # What is doubted stands in the table, once for each body.
        warnings.simplefilter("ignore", SceneWarning)
        for name, body in of.items():
            try:
                variants.scene_of(name, 1).check()
            except InvalidSceneError as error:
                raise type(error)(refusal(name, body, str(error))) from error
        found = run(
            variants,
            {"candidate": list(of), "coarser": [1, COARSER]},
            measure=answers,
            executor=executor,
            out=out,
            again=again,
            progress=progress,
            on_point=on_point,
        )
    missing: dict[str, str] = {}
    doubts = {name: variants.scene_of(name, 1).doubts() for name in of}
    for question in asked:
        for name, body in of.items():
            if needed := QUESTIONS[question].missing(body, duty, whole):
                missing[f"{name}, {question}"] = needed
            else:
                doubts[name] += QUESTIONS[question].notes(body, duty)
    return Comparison.of(
        found,
        missing,
        title=whole.title,
        coatings=[len(body.body.coatings) for body in of.values()],
        doubts=doubts,
    )


@dataclass(frozen=True)
class Variants:
    """Makes the scene of a point: a body in its place, on cells of a size."""

    scene: Scene
    answers: Answers

    def __call__(self, point: dict[str, Any]) -> Scene:
        """The scene of a candidate, with its name as title."""
        return self.scene_of(point["candidate"], int(point["coarser"]))

    def scene_of(self, name: str, coarser: int) -> Scene:
        """The scene of a candidate on cells so many times as large."""
        of = self.answers.candidates[name]
        changes: dict[str, Any] = {
            "title": name,
            f"body{self.answers.duty.body_number}": of.body,
            "grid": on_larger_cells(self.scene.grid, coarser),
            "save": "all" if self.answers.needs_fields() else "branches",
        }
        if of.mu is not None:
            changes["mu"] = self.scene.friction.replace(mu=of.mu)
        return self.scene.replace(**changes)

    def describe(self) -> str:
        """Tell this comparison from others: its scene, its bodies and what is asked."""
        said = [
            self.scene.to_toml(),
            {name: of.describe() for name, of in self.answers.candidates.items()},
            self.answers.duty.describe(),
            self.answers.questions,
        ]
        text = json.dumps(said)
        return f"comparison of {', '.join(self.answers.candidates)}, {zlib.crc32(text.encode()):x}"


def refusal(name: str, of: Candidate, why: str) -> str:
    """Why a candidate has no scene, and how it gets one where its own friction is too low."""
    if of.mu is None:
        return f"candidate {name}: {why}"
    way = ""
    if "friction can carry" in why:
        way = (
            ". All candidates run the path of the scene: lower its force below the friction of "
            "every candidate, or prescribe the displacement (delta_x) in place of the force"
        )
    return f"candidate {name}, mu = {of.mu:g}: {why}{way}"


def on_larger_cells(grid: Grid, times: int) -> Grid:
    """The grid of the same size with larger cells."""

    def fewer(n: int) -> int:
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
