"""Page, report, studies and command line: questions about one run evaluate the stress once."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import pyfret as fret
from pyfret import _core
from pyfret._cli.commands import main
from pyfret.fracture import below as cracks
from pyfret.report.content import figures
from pyfret.subsurface import fields
from pyfret.workbench import answers as page

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

pytestmark = pytest.mark.solves

STEEL = fret.Elastic(E=210e9, nu=0.3)
FILM = fret.Coating(fret.Elastic(E=300e9, nu=0.25), thickness=20e-6)


def ball(n: int = 16) -> fret.Scene:
    """Return a ball on a coated flat over a cycle of shear."""
    path = fret.LoadPath.start().normal(20.0, increments=2).cycles(1, T_x=6.0, increments=4)
    scene = fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Sphere(R=5e-3)),
        body2=fret.Body(STEEL, coatings=[FILM]),
        friction=0.5,
        grid=fret.Grid.centred(width=0.25e-3, n=n),
        path=path,
    )
    return scene.replace(save="all")


@pytest.fixture(scope="module")
def solved() -> fret.Result:
    return fret.solve(ball(), progress=False)


@pytest.fixture
def run(solved: fret.Result) -> fret.Result:
    """A result of which nothing was asked."""
    return fret.Result(solved.dataset)


def counted(
    monkeypatch: pytest.MonkeyPatch, module: Any, name: str, key: Callable[..., Any]
) -> list[Any]:
    """Count the calls of a function, by what a key makes of its arguments."""
    calls: list[Any] = []
    function = getattr(module, name)

    def count(*arguments: Any, **options: Any) -> Any:
        calls.append(key(*arguments, **options))
        return function(*arguments, **options)

    monkeypatch.setattr(module, name, count)
    return calls


@pytest.fixture
def sections(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """Evaluations of whole sections."""
    return counted(monkeypatch, fields, "sampled_stress", lambda *arguments: len(arguments))


def test_measures_of_a_section_share_it(run: fret.Result, sections: list[Any]) -> None:
    largest = [run.at(-1).stress().maximum(name) for name in ("von_mises", "s_1", "von_mises")]
    assert len(sections) == 1
    assert largest[0] == largest[2]
    alone = fret.Result(run.dataset).at(-1).stress().maximum("s_1")
    assert (largest[1].value, largest[1].error) == (alone.value, alone.error)


def test_layers_share_their_search(run: fret.Result) -> None:
    together = run.at(-1).stress()
    of_layers = [together.maximum("von_mises", layer=layer).value for layer in (0, 1)]
    for layer, value in enumerate(of_layers):
        alone = fret.Result(run.dataset).at(-1).stress().maximum("von_mises", layer=layer)
        assert value == alone.value
    assert together.maximum("von_mises").value == max(of_layers)


def test_each_state_and_body_has_its_own_section(run: fret.Result, sections: list[Any]) -> None:
    values = [
        float(run.at(which).stress(body_number=number).von_mises.max())
        for which, number in ((-1, 2), (1, 2), (-1, 1), (-1, 2))
    ]
    # The last section of each body is kept.
    assert len(sections) == 4
    assert values[0] == values[3]
    assert len(set(values)) == 3
    run.at(-1).stress(body_number=1)
    assert len(sections) == 4


def test_a_changed_stress_is_nobody_elses(run: fret.Result, sections: list[Any]) -> None:
    first = run.at(-1).stress()
    before = float(first.s_xx.max())
    first.dataset["s_xx"].values[...] = 0.0
    assert float(run.at(-1).stress().s_xx.max()) == before
    run.dataset["p"].values[...] *= 0.5
    run.at(-1).stress()
    assert len(sections) == 2
    run.dataset["p"].values[...] *= 2.0


def test_sections_that_are_asked_for_are_evaluated(run: fret.Result, sections: list[Any]) -> None:
    state = run.at(-1)
    assert not state.stress(y=0.0).dataset.identical(state.stress(bulk=False).dataset)
    assert len(sections) == 2


@pytest.mark.usefixtures("without_layout")
def test_a_report_evaluates_one_section(run: fret.Result, sections: list[Any]) -> None:
    figures(run)
    run.plot()
    assert len(sections) == 1


@pytest.mark.usefixtures("without_layout")
def test_the_page_evaluates_one_section(
    sections: list[Any], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(page, "RESULTS", page.Recent())
    monkeypatch.setattr(page, "ANSWERS", page.Recent())
    solutions = counted(monkeypatch, page, "solve", lambda *_, **options: options)
    names = dict.fromkeys(("body1", "body2"), "steel_100Cr6") | {"body2.coatings.0": "TiN"}
    scene = ball()
    answer = page.answer_in_full(scene, names)
    page.answer_in_full(scene, names)
    result = page.solve_in_full(scene)
    result.report(tmp_path / "page.html")
    assert len(sections) == len(solutions) == 1
    assert answer.result is result


def test_threads_share_the_preview_that_one_of_them_solves(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(page, "PREVIEWS", page.Recent())
    solutions = counted(monkeypatch, page, "solve", lambda *_, **options: options)
    scene = ball()
    with ThreadPoolExecutor(3) as threads:
        answers = list(threads.map(lambda _: page.preview(scene, None), range(3)))
    assert len(solutions) == 1
    assert all(answer is answers[0] for answer in answers)


def test_a_refusal_is_not_kept() -> None:
    recent: page.Recent[int] = page.Recent()

    def refuse() -> int:
        raise ValueError("no answer")

    with pytest.raises(ValueError, match="no answer"):
        recent.fetch("key", refuse)
    assert recent.fetch("key", lambda: 1) == 1


def test_life_and_yield_of_the_page_share_the_cycle(
    run: fret.Result, monkeypatch: pytest.MonkeyPatch
) -> None:
    made = counted(monkeypatch, _core, "StressCache", lambda: 1)
    run.life("steel_42CrMo4", "dang_van")
    run.load_factors(900e6)
    run.life("steel_42CrMo4", "crossland")
    assert made == [1]


def test_measures_of_a_study_share_sections_and_cracks(
    run: fret.Result, sections: list[Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    prepared = counted(monkeypatch, cracks._core, "ContactForCracks", lambda *_, **__: 1)
    threshold = fret.fracture.Threshold(dK_th=4e6)
    arrest = fret.study.Arrest(threshold)
    first = fret.study.FirstToFail(threshold=threshold, toughness=3e6)
    numbers = fret.study.answers(run, ["von_mises", "s_1", "tresca", arrest, first])
    assert prepared == [1]
    assert 0 < len(sections) <= 2
    alone = fret.study.answers(fret.Result(run.dataset), arrest)
    for name in alone:
        np.testing.assert_array_equal(numbers[name], alone[name])


@pytest.mark.usefixtures("without_layout")
def test_the_command_report_evaluates_one_section(
    sections: list[Any], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    store = tmp_path / "run.zarr"
    fret.solve(ball(), out=store, progress=False)
    assert main(["report", str(store), "--out", str(tmp_path / "page.html")]) == 0
    capsys.readouterr()
    assert len(sections) == 1
