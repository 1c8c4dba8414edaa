"""Bodies side by side: the numbers equal single runs, errors decide what differs."""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import pyfret as fret
from conftest import ROOT, SAME_PROCESS
from pyfret import fatigue, wear
from pyfret.study import Candidate

pytestmark = pytest.mark.solves

R, W = 6e-3, 20.0
TITANIUM = fret.Elastic(E=117e9, nu=0.31)
FILM = fret.Elastic(E=300e9, nu=0.25)
ALLOY = fatigue.Materials()["titanium_6Al4V"]


def contact(n: int = 14) -> tuple[fret.Scene, fret.LoadPath]:
    """A ball on a flat, and a cycle of partial slip."""
    ball = fret.Elastic(E=400e9, nu=0.23)
    a = fret.reference.hertz(R=R, bodies=(ball, TITANIUM), W=W).a
    scene = fret.Scene(
        body1=fret.Body(ball, shape=fret.Sphere(R=R)),
        body2=fret.Body(TITANIUM),
        friction=0.5,
        grid=fret.Grid.centred(width=2.6 * a, n=n),
        title="ball",
    )
    path = fret.LoadPath.start().normal(W, increments=2).cycles(1, T_x=6.0, increments=6)
    return scene, path


def bodies() -> dict[str, Candidate]:
    """A bare flat, and one with 20 um of a hard coating."""
    coated = fret.Body(TITANIUM, coatings=[fret.Coating(FILM, thickness=20e-6)])
    return {
        "bare": Candidate(fret.Body(TITANIUM), materials=ALLOY, wear=wear.Archard(1e-14)),
        "film": Candidate(
            coated,
            materials=ALLOY,
            mu=0.4,
            residual=(-1e9, 0.0),
            toughness=40.0,
            wear=[wear.Archard(1e-15), wear.Archard(1e-14)],
        ),
    }


@pytest.mark.parametrize("mu", [0.2, None])
def test_a_candidate_that_would_slide_is_named(mu: float | None) -> None:
    """The message has its friction and a remedy, or its name without friction of its own."""
    scene, path = contact()
    if mu is None:
        scene = scene.replace(friction=0.2)
    options = {
        "grippy": Candidate(fret.Body(TITANIUM), mu=0.6),
        "slippery": Candidate(fret.Body(TITANIUM), mu=mu),
    }
    with pytest.raises(fret.errors.InvalidSceneError) as refused:
        fret.compare(options, scene, path, questions=["energy"], progress=False)
    message = str(refused.value)
    assert message.count("slippery") == 1
    assert "grippy" not in message
    assert "T_x = 6" in message
    assert ("mu = 0.2: " in message and "delta_x" in message) is (mu is not None)


@pytest.fixture(scope="module")
def compared(tmp_path_factory: pytest.TempPathFactory) -> tuple[fret.study.Comparison, Path]:
    position = tmp_path_factory.mktemp("compare") / "study.zarr"
    scene, path = contact()
    comparison = fret.compare(
        bodies(), scene, path, cycles=1e3, executor=SAME_PROCESS, out=position, progress=False
    )
    return comparison, position


def test_numbers_are_those_of_single_runs(compared: tuple[fret.study.Comparison, Path]) -> None:
    computed = compared[0].dataset
    scene, path = contact()
    for name, entry in bodies().items():
        mu = entry.mu or scene.mu
        result = fret.solve(
            scene.replace(body2=entry.body, friction=mu), path, save="all", progress=False
        )
        selected = computed.sel(candidate=name)
        assert float(selected.energy) == pytest.approx(float(result.loops().dissipated[-1]))
        least = result.load_factors(entry.yield_stresses, residual=entry.residual).least(
            "von_mises"
        )
        assert float(selected.first_yield) == pytest.approx(least.value)
        ends = np.flatnonzero(np.diff(result.dataset.branch_of_increment.values, append=-1)) + 1
        largest = max(
            result.at(int(n)).stress(residual=entry.residual).maximum("s_1").value
            for n in ends[-2:]
        )
        assert float(selected.tension) == pytest.approx(largest)
        life = result.life(entry.layer_materials, "smith_watson_topper", residual=entry.residual)
        substrate = len(entry.body.coatings)
        # Over the critical distance of the material, as a single run.
        single = life.range_of(substrate)
        assert float(selected.life_of_substrate) == pytest.approx(single.best)
        assert float(selected.life_of_substrate_L) == pytest.approx(single.L)
        # A life beyond the tests is no endless one.
        words = compared[0].formatted("life_of_substrate")[compared[0].candidates.index(name)]
        assert ("or more" in words) == (math.isinf(single.high) and math.isfinite(single.low)), (
            words
        )
        assert (words == "endless") == math.isinf(single.low), words


def test_a_margin_says_what_the_stress_is_and_what_is_doubted() -> None:
    """Every candidate has them, for a criterion with lives and for one with a limit."""
    scene, path = contact(n=12)
    known_values = fatigue.Materials()
    material = {
        "alloy": Candidate(scene.body2, materials=known_values["titanium_6Al4V"]),
        "other": Candidate(scene.body2, materials=known_values["7075"]),
    }
    tests = "bending and torsion tests"
    bare = fatigue.Material("own", [("s_D", 4.1e8, tests), ("t_D", 2.7e8, tests)])
    at_a_point = fret.compare(
        {"own": Candidate(scene.body2, materials=bare)},
        scene,
        path,
        questions=["life"],
        criterion="crossland",
        executor=SAME_PROCESS,
        progress=False,
    )
    assert float(at_a_point.dataset.safety_of_substrate_L[0]) == 0.0
    assert "at the worst point" in at_a_point.summary()
    for criterion, kind in (("fatemi_socie", "life"), ("crossland", "safety")):
        comparison = fret.compare(
            material,
            scene,
            path,
            questions=["life"],
            criterion=criterion,
            executor=SAME_PROCESS,
            progress=False,
        )
        table = comparison.summary()
        for name, body in material.items():
            result = fret.solve(scene.replace(title=name), path, save="all", progress=False)
            single = result.life(body.materials, criterion)
            selected = comparison.dataset.sel(candidate=name)
            assert float(selected[f"{kind}_of_substrate_L"]) == pytest.approx(single.L)
            pattern = [
                note for note in single.notes if "the scene has" in note or "estimate" in note
            ]
            assert all(f"warning: {name}: {note}" in table for note in pattern)
        assert table.count("mean over L = ") == 2
        assert "the scene has E = " in table


def test_an_error_is_what_larger_cells_change(
    compared: tuple[fret.study.Comparison, Path],
) -> None:
    computed, _ = compared
    scene, path = contact(n=7)
    result = fret.solve(scene, path, progress=False)
    selected = computed.dataset.sel(candidate="bare")
    changed = abs(float(selected.energy) - float(result.loops().dissipated[-1]))
    assert float(selected.energy_high - selected.energy) == pytest.approx(changed)


def test_missing_numbers_are_named(compared: tuple[fret.study.Comparison, Path]) -> None:
    computed, _ = compared
    assert computed.missing["bare, adhesion"] == "a coating"
    assert "conductor" in computed.missing["film, temperature"]
    assert "no answer for bare, adhesion: missing is a coating" in computed.summary()
    assert np.isnan(float(computed.dataset.film.sel(candidate="bare")))


def test_alike_bodies_make_no_difference() -> None:
    scene, path = contact(n=12)
    body = fret.Body(TITANIUM)
    comparison = fret.compare(
        {"one": body, "other": body, "slippery": Candidate(body, mu=0.32)},
        scene,
        path,
        questions=["energy"],
        executor=SAME_PROCESS,
        progress=False,
    )
    verdict = comparison.preference("energy")
    assert verdict.best == ["one", "other"]
    assert verdict.worse == ["slippery"]
    assert str(verdict) == "best: one, other (no difference)"
    same = fret.compare(
        {"one": body, "other": body},
        scene,
        path,
        questions=["energy"],
        progress=False,
        executor=SAME_PROCESS,
    )
    assert "no difference" in same.summary()


def test_it_goes_on_after_an_interrupt(tmp_path: Path) -> None:
    scene, path = contact(n=12)
    position = tmp_path / "study.zarr"
    some = {name: entry.body for name, entry in bodies().items()}

    def stop(done: int, total: int) -> None:
        if done == 2:
            raise KeyboardInterrupt

    options = {
        "questions": ["energy"],
        "executor": SAME_PROCESS,
        "out": position,
        "progress": False,
    }
    with pytest.raises(KeyboardInterrupt):
        fret.compare(some, scene, path, on_point=stop, **options)  # type: ignore[arg-type]
    progress: list[int] = []
    comparison = fret.compare(
        some, scene, path, on_point=lambda done, total: progress.append(done), **options
    )  # type: ignore[arg-type]
    assert progress == [3, 4]
    alone = fret.compare(some, scene, path, **{**options, "out": None})  # type: ignore[arg-type]
    assert comparison == alone
    with pytest.raises(fret.errors.StoreError, match="another study"):
        fret.compare(some, scene.replace(friction=0.3), path, **options)  # type: ignore[arg-type]


def test_it_is_drawn_and_written(
    compared: tuple[fret.study.Comparison, Path], tmp_path: Path
) -> None:
    computed, _ = compared
    figure = computed.plot()
    titles = {ax.get_title(loc="left") for ax in figure.axes}
    assert {"largest tension", "energy dissipated in a cycle"} <= titles
    computed.report(tmp_path / "page.html")
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert "load factor of first yield" in page
    assert "http://" not in page.replace("http://www.w3.org", "")
    computed.save(tmp_path / "numbers.nc")
    computed.to_csv(tmp_path / "numbers.csv")
    head, *rows = (tmp_path / "numbers.csv").read_text().splitlines()
    assert head.startswith("candidate,")
    assert len(rows) == computed.dataset.sizes["candidate"]
    assert (tmp_path / "numbers.nc").exists()


def test_what_is_no_comparison_is_refused() -> None:
    scene, path = contact(n=8)
    with pytest.raises(ValueError, match="bodies"):
        fret.compare({}, scene, path)
    with pytest.raises(ValueError, match="must be one of tension"):
        fret.compare({"bare": scene.body2}, scene, path, questions=["hardness"])


FILE = """
scene = "scene.toml"
questions = ["tension", "energy", "wear", "yield"]
cycles = 500

[candidates.bare]
material = "titanium_6Al4V"
wear = { k = 1e-14 }

[candidates.film]
coatings = [{ E = 300e9, nu = 0.25, thickness = 20e-6 }]
material = ["", "titanium_6Al4V"]
mu = 0.4
residual = [-1e9, 0.0]
wear = [{ k = 1e-15 }, { k = 1e-14 }]
"""


def command(*arguments: str, folder: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [ROOT / "target" / "release" / "fret", "compare", *arguments],
        capture_output=True,
        text=True,
        cwd=folder,
        check=False,
        env={**os.environ, "FRET_PYTHON": sys.executable, "MPLBACKEND": "Agg"},
    )


def test_the_command_reads_a_file(tmp_path: Path) -> None:
    scene, path = contact(n=12)
    (tmp_path / "scene.toml").write_text(scene.replace(path=path).to_toml())
    (tmp_path / "coatings.toml").write_text(FILE)
    ran = command(
        "coatings.toml", "--workers", "1", "--json", "--figure", "all.png", folder=tmp_path
    )
    assert ran.returncode == 0, ran.stderr
    answer = json.loads(ran.stdout)
    low, best, high = answer["numbers"]["energy"]["values"]["film"]
    assert low < best < high
    options = {"bare": bodies()["bare"], "film": bodies()["film"]}
    same = fret.compare(
        options, scene, path, questions=["energy"], executor=SAME_PROCESS, progress=False
    )
    assert best == pytest.approx(float(same.dataset.energy.sel(candidate="film")))
    assert (tmp_path / "all.png").exists()
    again = command("coatings.toml", folder=tmp_path)
    assert "largest tension" in again.stdout


@pytest.mark.parametrize(
    ("before", "after", "expected"),
    [
        ("mu = 0.4", "muu = 0.4", "nearest valid key is `mu`"),
        ("k = 1e-15", "kk = 1e-15", "nearest valid key is `k`"),
        ("scene =", "scen =", "nearest valid key is `scene`"),
        ("thickness = 20e-6", "thickness = -1.0", "candidates.film"),
    ],
)
def test_a_wrong_file_says_where(tmp_path: Path, before: str, after: str, expected: str) -> None:
    scene, path = contact(n=8)
    (tmp_path / "scene.toml").write_text(scene.replace(path=path).to_toml())
    (tmp_path / "coatings.toml").write_text(FILE.replace(before, after))
    ran = command("coatings.toml", folder=tmp_path)
    assert ran.returncode == 2
    assert expected in ran.stderr
