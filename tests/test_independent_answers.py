"""One question without an answer leaves the others as they are, and has its reason."""

from __future__ import annotations

import math
import warnings

import numpy as np
import pytest

import pyfret as fret
from conftest import SAME_PROCESS
from pyfret.study import MEASURES, Candidate
from pyfret.study.measures import evaluate_measures

STEEL = fret.Elastic(E=210e9, nu=0.3)
W = 20.0
A = fret.reference.hertz(R=5e-3, bodies=(STEEL, STEEL), W=W).a
FILM = fret.Coating(fret.Elastic(E=450e9, nu=0.25), thickness=3e-5)


def scene(*, upper: object = (), lower: object = (), cycles: int = 1) -> fret.Scene:
    path = fret.LoadPath.start().normal(W, increments=2)
    if cycles:
        path = path.cycles(cycles, T_x=6.0, increments=6)
    return fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Sphere(R=5e-3), coatings=upper),
        body2=fret.Body(STEEL, coatings=lower),
        friction=0.5,
        grid=fret.Grid.centred(width=2.6 * A, n=20),
        path=path,
    )


@pytest.mark.solves
@pytest.mark.parametrize("cycles", [0, 1])
def test_every_measure_has_a_number_or_a_reason(cycles: int) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        result = fret.solve(scene(cycles=cycles), save="all", progress=False)
        numbers, reasons = evaluate_measures(result, list(MEASURES))
    without = {reason.partition(":")[0] for reason in reasons}
    for name in MEASURES:
        assert name in numbers, name
        assert math.isnan(float(numbers[name])) == (name in without), name
    assert all(len(reason.partition(": ")[2]) > 10 for reason in reasons)


@pytest.mark.solves
def test_a_measure_that_raises_leaves_the_others() -> None:
    def broken(result: fret.Result) -> float:
        raise ValueError("the load cell was off")

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        answers = fret.study.run(
            scene(cycles=0),
            {"friction.mu": [0.5]},
            measure=["p_max", broken],
            executor=SAME_PROCESS,
            progress=False,
        )
    assert float(answers.dataset.p_max[0]) > 1e8
    assert answers.count() == {"open": 0, "done": 0, "failed": 0, "partly": 1}
    ((_, reason),) = answers.unanswered()
    assert reason == "broken: ValueError: the load cell was off"


@pytest.mark.solves
def test_interfaces_of_both_bodies_are_measured() -> None:
    answers = []
    for bodies in ({"upper": FILM}, {"lower": FILM}):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            result = fret.solve(scene(**bodies), save="all", progress=False)
            answers.append(evaluate_measures(result, ["interface_shear", "interface_peel"])[0])
    upper, lower = answers
    for name in ("interface_shear", "interface_peel"):
        assert float(upper[name]) == pytest.approx(float(lower[name]), rel=0.02), name


@pytest.mark.solves
def test_a_question_of_a_comparison_leaves_the_others() -> None:
    """A body that yields has no load factor of first yield; tension and energy remain."""
    alloy = fret.fatigue.Materials()["titanium_6Al4V"]
    yields = STEEL.replace(plastic=fret.Plastic(s_y=600e6, hardening=5e9))
    candidates = {
        "elastic": Candidate(fret.Body(STEEL), materials=alloy, rows={"cost [EUR]": 3.2}),
        "yields": Candidate(fret.Body(yields), materials=alloy, rows={"supplier": "own"}),
    }
    answers = fret.compare(
        candidates,
        scene(),
        questions=["tension", "yield", "energy"],
        executor=SAME_PROCESS,
        progress=False,
    )
    d = answers.dataset
    assert np.isfinite(d.tension.values).all()
    assert np.isfinite(d.energy.values).all()
    assert list(answers.unanswered) == ["yields, yield"]
    text = answers.summary()
    assert "no answer for yields, yield: " in text
    lines = {line.split("  ")[0]: line for line in text.splitlines()}
    assert lines["cost [EUR]"].split()[-2:] == ["3.2", "-"]
    assert lines["supplier"].split()[-1] == "own"


@pytest.mark.solves
def test_wear_that_leaves_the_grid_gives_what_it_reached() -> None:
    path = fret.LoadPath.start().normal(W, increments=2).cycles(1, delta_x=4e-6, increments=8)
    worn = Candidate(
        fret.Body(STEEL, coatings=FILM),
        wear=[fret.wear.Archard(k=3e-13), fret.wear.Archard(k=3e-13)],
    )
    answers = fret.compare(
        {"soft": worn},
        scene().replace(path=path),
        questions=["wear", "energy"],
        cycles=1e6,
        executor=SAME_PROCESS,
        progress=False,
    )
    row = next(line for line in answers.summary().splitlines() if "worn through" in line)
    assert "more than" in row
    assert "(the run ended there)" in row
    assert "the run ended after" in answers.unanswered["soft, wear"]
    assert np.isfinite(answers.dataset.energy.values).all()


@pytest.mark.solves
def test_the_grid_of_a_scar_is_estimated_before_the_run() -> None:
    path = fret.LoadPath.start().normal(W, increments=2).cycles(1, delta_x=4e-6, increments=8)
    worn = {"cycling": "sliding", "body2": fret.wear.Archard(k=3e-13)}
    with (
        pytest.warns(fret.errors.SceneWarning, match=r"V = k W s N") as doubts,
        pytest.raises(fret.errors.OffGridError),
    ):
        fret.wear.solve(scene().replace(path=path), cycles=1e6, progress=False, **worn)
    assert "use a grid of" in str(doubts[0].message)
    with warnings.catch_warnings():
        warnings.simplefilter("error", fret.errors.SceneWarning)
        fret.wear.solve(scene().replace(path=path), cycles=10, progress=False, **worn)
