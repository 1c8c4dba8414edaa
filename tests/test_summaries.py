"""Every summary fits its window: no line is wider, no number loses its unit to the next line."""

from __future__ import annotations

import re
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import pytest

import pyfret as fret
from test_outputs import CLASSES

pytestmark = [pytest.mark.solves, pytest.mark.filterwarnings("ignore")]

#: Line that ends between a number and its unit, its error or its symbol.
TORN = re.compile(
    r"(?:[\d.)]\n *(?:[kmMGnuµ]?(?:m|N|Pa|J)|%)(?![\w^])|(?:=|\+-)\n|\n *(?:=|\+-) )", re.MULTILINE
)


def described() -> dict[str, Any]:
    """One of every class that has a summary, many with long sentences."""
    film = fret.Body("Ti-6Al-4V", coatings=[fret.Coating("TiN", thickness="20 um")])
    scene = fret.Scene.cylinder_on_flat(
        "100Cr6", film, R="5 mm", W="200 N/mm", T="70 N/mm", mu=0.5, cycles=1, n=16, quiet=True
    )
    run = fret.solve(scene, save="all", progress=False)
    pressed = scene.replace(path=fret.LoadPath.start().normal("200 N/mm", increments=2))
    law, thread = fret.wear.Archard(1e-14), ThreadPoolExecutor(1)
    loop = fret.fit.Loops.from_arrays(
        1e-6 * np.sin(np.linspace(0.0, 13.0, 99)), 5e4 * np.cos(np.linspace(0.0, 13.0, 99))
    )
    history = fret.LoadHistory.from_array(T_x=7e4 * np.sin(np.arange(20)), frequency=50.0)
    threshold, paris = fret.fracture.Threshold(dK_th=2e6), fret.fracture.Paris(C=1e-11, m=3.0)
    lengths = np.geomspace(2e-6, 2e-5, 4)
    cracks = run.crack(lengths=lengths)
    life = run.life(["7075", "7075"], "smith_watson_topper")
    x = np.linspace(-1e-3, 1e-3, 21)
    scar = 1e-6 * np.maximum(1 - (x / 5e-4) ** 2, 0)
    heights = 1e-7 * np.random.default_rng(1).normal(size=(16, 16))
    made: list[Any] = [
        *(scene, run, run.at(-1), run.at(-1).stress(), run.loops(), run.branches()),
        *(life, life.over_distance(), run.load_factors([1e9, 5e8])),
        *(cracks, cracks.arrest(threshold)),
        fret.fracture.first_to_fail(run, toughness=20.0, threshold=threshold),
        fret.fracture.grow_by_history(
            pressed, history, paris, 1e-4, lengths, threshold=threshold, progress=False
        ),
        fret.fatigue.damage(pressed, history, "7075", "smith_watson_topper", [3e-5]),
        *(history, history.count()),
        fret.wear.solve(scene, cycles=1000, body2=[law, law], jumps=1, progress=False),
        fret.study.run(scene, {"mu": [0.1, 0.5]}, measure="p_max", executor=thread, progress=False),
        fret.study.compare(
            {"bare": fret.Body("Ti-6Al-4V"), "film": film}, scene,
            questions=["energy"], executor=thread, progress=False,
        ),
        fret.fit(pressed, loop, executor=thread, unknown={"mu": (0.3, 0.9)}),
        *(fret.SurfaceMap(part, spacing=2e-6) for part in (heights, heights - x[3:19, None] ** 2)),
        *(loop, fret.fit.Scar.from_arrays(x, scar, wear={"cycles": 1e5, "body2": law})),
        fret.fit.Indentation.from_arrays([1.0, 2.0], [1e-6, 2e-6]),
        fret.fit.Lives(np.array([1e5, 2e5]), [{}, {}], {}),
    ]  # fmt: skip
    return {f"{type(item).__name__} {n}": item for n, item in enumerate(made)}


@pytest.fixture(scope="module")
def objects() -> dict[str, Any]:
    """The objects with a summary, computed once."""
    return described()


def test_there_is_one_of_every_class(objects: dict[str, Any]) -> None:
    kinds = {type(item) for item in objects.values()}
    assert not {name for name, kind in CLASSES.items() if hasattr(kind, "summary")} - {
        kind.__name__ for kind in kinds
    }


@pytest.mark.parametrize("width", [60, 80, 100])
def test_a_summary_fits_the_window(
    objects: dict[str, Any], width: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name, item in objects.items():
        monkeypatch.setenv("COLUMNS", "4000")
        whole = item.summary()
        monkeypatch.setenv("COLUMNS", str(width))
        text = item.summary()
        assert max(map(len, text.splitlines())) <= width, (name, text)
        assert not TORN.findall(text), (name, text)
        # No word is broken: all of them are there. Tables have other blocks.
        assert set(whole.replace("-", " ").split()) <= set(text.replace("-", " ").split()), name
