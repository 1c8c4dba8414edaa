"""The page of a result: everything inside, nothing fetched, drawn at laptop and phone width."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pytest
import xarray as xr

import pyfret as fret
from conftest import ROOT, SAME_PROCESS, W, sphere_on_flat
from pyfret import verification
from pyfret._cli import commands
from pyfret._core import with_error
from pyfret.report import content
from pyfret.report import page as page_module
from pyfret.report.crack import CrackSection

pytestmark = pytest.mark.solves

PATH = fret.LoadPath.start().normal(W, increments=3).cycles(1, T_x=200.0, increments=8)
#: Widths and heights of a laptop and of a phone.
SCREENS = {"laptop": (1280, 800), "phone": (390, 844)}


@pytest.fixture(scope="module")
def result() -> fret.Result:
    scene = sphere_on_flat(ratio=2.0, n=24)
    return fret.solve(scene, PATH, save="all", error=True, progress=False)


@pytest.fixture(scope="module")
def worn() -> fret.wear.WearResult:
    scene = sphere_on_flat(ratio=2.0, n=16)
    return fret.wear.solve(
        scene, path=PATH, cycles=1e4, first_branch=2, body2=fret.wear.Archard(1e-14), progress=False
    )


@pytest.fixture(scope="module")
def page(result: fret.Result, worn: fret.wear.WearResult, tmp_path_factory: Any) -> Path:
    path: Path = tmp_path_factory.mktemp("page") / "run.html"
    figure = fret.plot.load_path(result).figure
    result.report(path, wear=worn, figures={"Load path": figure})
    plt.close("all")
    return path


@pytest.mark.usefixtures("without_overview")
def test_a_page_with_wear_says_which_surfaces_its_loops_are_of(
    page: Path, result: fret.Result, tmp_path: Path
) -> None:
    text = page.read_text(encoding="utf-8")
    assert "numbers of the run belong to the surfaces before wear" in text
    assert "are those on the worn surfaces" in text
    result.report(tmp_path / "alone.html")
    alone = (tmp_path / "alone.html").read_text(encoding="utf-8")
    assert "before wear" not in alone
    assert '<section id="lived" hidden>' in alone


def test_wear_of_other_bodies_is_refused(worn: fret.wear.WearResult, tmp_path: Path) -> None:
    alternative = fret.solve(sphere_on_flat(ratio=4.0, n=16), PATH, progress=False)
    with pytest.raises(ValueError, match="wear: is of other bodies than the run"):
        alternative.report(tmp_path / "page.html", wear=worn)
    assert not (tmp_path / "page.html").exists()


def test_a_folder_that_does_not_exist_is_refused_before_drawing(
    result: fret.Result, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(page_module, "stills", lambda *_: pytest.fail("the page was drawn"))
    with pytest.raises(FileNotFoundError):
        result.report(tmp_path / "missing" / "page.html")
    assert list(tmp_path.iterdir()) == []


def test_a_crack_in_other_bodies_is_refused(result: fret.Result, tmp_path: Path) -> None:
    alternative = fret.solve(sphere_on_flat(ratio=4.0, n=16), PATH, save="all", progress=False)
    crack = alternative.crack(lengths=[1e-5, 2e-5])
    with pytest.raises(ValueError, match="crack: is of other bodies than the run"):
        result.report(tmp_path / "page.html", crack=crack)
    assert not (tmp_path / "page.html").exists()


def test_a_crack_that_does_not_say_its_bodies_is_refused(
    result: fret.Result, tmp_path: Path
) -> None:
    """One that an older version saved, without its scene, and one from arrays."""
    saved = result.crack(lengths=[1e-5, 2e-5])
    del saved.dataset.attrs["scene"]
    saved.save(tmp_path / "old.nc")
    arrays = fret.fracture.Cracks.from_arrays([1e-5, 2e-5], [1e6, 1e6], [0.0, 0.0])
    for crack in (fret.open(tmp_path / "old.nc"), arrays):
        with pytest.raises(ValueError, match=r"crack: lacks the bodies.*result.crack"):
            result.report(tmp_path / "page.html", crack=crack)
    assert not (tmp_path / "page.html").exists()


def test_the_page_has_it_all_in_one_small_file(page: Path, result: fret.Result) -> None:
    text = page.read_text(encoding="utf-8")
    assert page.stat().st_size < 5e6
    assert not re.findall(r"(?:src|href)=\"(?!data:)", text)
    for part in (
        "E1/E2 = 2",
        "coating 1",
        "Ends of the branches",
        "&plusmn;",
        "What was left out",
        "mirror-symmetric",
        "10.24874/ti.2020.42.01.13",
        "[[body2.coatings]]",
        "Load path",
        "data:image/png",
    ):
        assert part in text, part
    assert result.scene.to_toml().splitlines()[0] in text


def test_the_numbers_of_the_figures_are_those_of_the_result(result: fret.Result) -> None:
    numbers = content.figures(result, None)
    last = numbers["fields"]["shown"][-1]
    assert last["increment"] == int(result.at(-1).increment)
    assert numbers["fields"]["largest"]["p"] == pytest.approx(
        1e-6 * float(result.dataset.p.max()), rel=1e-2
    )
    largest = result.at(-1).stress().maximum()
    arguments = numbers["stress"]["largest"]
    assert arguments["value"] == with_error(1e-6 * largest.value, 1e-6 * largest.error)
    assert arguments["at"] == [1e6 * largest.x, 1e6 * largest.y, 1e6 * largest.z]
    assert numbers["loop"]["y"][-1] == pytest.approx(200.0, rel=1e-4)
    assert content.short([1.23456, np.nan, 0.0, np.inf]) == [1.235, None, 0.0, None]


def test_scenes_without_increments_of_interest_have_their_page(tmp_path: Path) -> None:
    strip = fret.Grid.strip(extent=1e-3, n=352)
    steel = fret.Elastic(E=210e9, nu=0.3)
    scene = fret.Scene(
        body1=fret.Body(steel, shape=fret.Cylinder(R=0.01)),
        body2=fret.Body(fret.RIGID),
        friction=float("inf"),
        grid=strip,
        path=fret.LoadPath.start().normal(1e4, increments=2),
    )
    result = fret.solve(scene, progress=False)
    assert result.doubts == []
    result.report(tmp_path / "strip.html")
    text = (tmp_path / "strip.html").read_text(encoding="utf-8")
    assert "plane strain" in text
    assert "rigid" in text
    with pytest.raises(ValueError, match="must end in"):
        result.report(tmp_path / "page.pdf")


@pytest.fixture(scope="module")
def cracked(result: fret.Result, tmp_path_factory: Any) -> Path:
    path: Path = tmp_path_factory.mktemp("cracked") / "run.html"
    crack = result.crack(lengths=np.geomspace(5e-6, 4e-4, 12))
    with pytest.MonkeyPatch.context() as patch:
        # The other page has the six panels.
        patch.setattr("pyfret.plot.overview", lambda *_: plt.figure())
        result.report(path, crack=crack, threshold=fret.fracture.Threshold(3e6, 300e6))
    return path


def test_a_crack_is_in_the_section_with_its_numbers(result: fret.Result) -> None:
    crack = result.crack(lengths=np.geomspace(5e-6, 4e-4, 12))
    threshold = fret.fracture.Threshold(3e6, 300e6)
    numbers = content.figures(result, None, CrackSection(crack, threshold))
    arrest = crack.arrest(threshold)
    assert arrest.verdict == "stops"
    assert arrest.length is not None
    assert arrest.lengths is not None
    # The length with its range, in as many digits as the range allows.
    length, low, high = (f"{1e6 * value:.2g}" for value in (arrest.length, *arrest.lengths))
    assert f"stops at {length} ({low} to {high}) µm" in numbers["crack"]["says"]
    drawn = numbers["stress"]["crack"]
    # A normal crack: straight down from its mouth to where it stops, and on from there.
    mouth = 1e6 * crack.dataset.attrs["x"]
    assert drawn["grown"]["x"] == pytest.approx([mouth] * len(drawn["grown"]["x"]), rel=1e-3)
    assert drawn["rest"]["z"][0] == drawn["end"]["z"][0] == drawn["grown"]["z"][-1]
    drawn_length = float(numbers["crack"]["length"]) * 1e-6
    nearest = crack.dataset.sel(length=arrest.length, method="nearest")
    assert drawn_length == pytest.approx(float(nearest.length), rel=5e-3)
    np.testing.assert_allclose(numbers["crack"]["K_I"], 1e-6 * nearest.K_I, rtol=1e-3, atol=1e-9)
    diagram, truth = numbers["crack"]["kitagawa"], crack.kitagawa(threshold)
    np.testing.assert_allclose(diagram["limit"], 1e-6 * truth["limit"], rtol=1e-3)
    alone = content.figures(result, None, CrackSection(crack, None))["crack"]
    assert alone["kitagawa"] is None
    assert "stops" not in alone["says"]
    with pytest.raises(ValueError, match="needs a crack"):
        result.report("run.html", threshold=threshold)


@pytest.mark.usefixtures("without_overview")
def test_lives_are_on_the_page_when_asked(result: fret.Result, tmp_path: Path) -> None:
    steel = fret.fatigue.Materials()["steel_42CrMo4"]
    lives = fret.fatigue.lives(result, steel, ["findley", "crossland"])
    page = tmp_path / "run.html"
    result.report(page, life=list(lives.values()))
    text = page.read_text(encoding="utf-8")
    for name in lives:
        assert f"map of the criterion {name} below the contact" in text
    assert '<section id="lived" >' in text
    result.report(page, life=lives["findley"])
    assert page.read_text(encoding="utf-8").count("map of the criterion") == 1
    bare = fret.solve(sphere_on_flat(n=16), PATH, progress=False)
    with pytest.raises(ValueError, match="life: is of other bodies"):
        bare.report(page, life=lives["findley"])


@pytest.mark.usefixtures("without_overview")
def test_the_command_adds_a_life(
    result: fret.Result, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    result.save(tmp_path / "run.zarr")
    page = tmp_path / "run.html"
    call = ["report", str(tmp_path / "run.zarr"), "-o", str(page), "--life", "findley"]
    assert commands.main(call) == 2
    assert "--life: needs --material" in capsys.readouterr().err
    assert commands.main([*call, "--material", "steel_42CrMo4"]) == 0
    assert "map of the criterion findley" in page.read_text(encoding="utf-8")


@pytest.mark.timeout(180)
def test_a_comparison_fits_on_every_screen(tmp_path: Path) -> None:
    api = pytest.importorskip("playwright.sync_api")
    axe = pytest.importorskip("axe_playwright_python.sync_playwright")
    scene = sphere_on_flat(n=16).replace(path=PATH)
    film = fret.Coating(fret.Elastic(E=420e9, nu=0.25), thickness=2e-6)
    bodies = {
        "bare": scene.body2,
        "coated with a hard film": fret.Body(fret.Elastic(E=210e9, nu=0.3), coatings=film),
    }
    fret.compare(bodies, scene, executor=SAME_PROCESS, progress=False).report(
        tmp_path / "compare.html"
    )
    with api.sync_playwright() as play:
        chromium = browser(play)
        for width in (380, 800, 1280, 1920):
            view = chromium.new_page(viewport={"width": width, "height": 900})
            requests: list[str] = []
            view.on("request", lambda r, asked=requests: asked.append(r.url))
            view.goto((tmp_path / "compare.html").as_uri())
            assert view.evaluate("document.documentElement.scrollWidth") <= width
            assert view.locator("img").count() == 1
            for name in bodies:
                assert name in view.inner_text("table")
            if width >= 1280:
                table = "document.querySelector('.wide')"
                assert view.evaluate(f"{table}.scrollWidth <= {table}.clientWidth")
            assert axe.Axe().run(view).violations_count == 0
            assert [url for url in requests if not url.startswith(("file:", "data:"))] == []
            view.close()
        chromium.close()


def browser(play: Any) -> Any:
    """Chromium, or the test is skipped."""
    computed = shutil.which("chromium") or shutil.which("chromium-browser")
    try:
        return play.chromium.launch(executable_path=computed, args=["--no-sandbox"])
    except Exception as absent:
        pytest.skip(f"no browser: {str(absent).splitlines()[0]}")


@pytest.mark.timeout(180)
def test_it_is_drawn_in_a_browser_without_errors_or_requests(page: Path, cracked: Path) -> None:
    api = pytest.importorskip("playwright.sync_api")
    with api.sync_playwright() as play:
        chromium = browser(play)
        for width, height in SCREENS.values():
            view = chromium.new_page(viewport={"width": width, "height": height})
            text: list[str] = []
            requests: list[str] = []
            view.on("console", lambda m, said=text: said.append(m.text))
            view.on("pageerror", lambda e, said=text: said.append(str(e)))
            view.on("request", lambda r, asked=requests: asked.append(r.url))
            view.goto(page.as_uri())
            view.wait_for_selector("body[data-drawn=yes]", timeout=60_000)
            first = view.inner_text("#says")
            view.fill("#which", "4")
            assert view.inner_text("#number") == "5"
            assert view.inner_text("#says") != first
            assert text == []
            assert [url for url in requests if not url.startswith(("file:", "data:"))] == []
            assert view.evaluate("document.documentElement.scrollWidth") <= width
            for name in ("loop", "p", "q", "zone", "profile", "stress", "depths", "profiles"):
                assert view.locator(f"#{name} .main-svg").count() > 0, name
            view.goto(cracked.as_uri())
            view.wait_for_selector("body[data-drawn=yes]", timeout=60_000)
            assert "stops at" in view.inner_text("#verdict")
            assert text == []
            assert view.evaluate("document.documentElement.scrollWidth") <= width
            for name in ("stress", "intensity", "kitagawa"):
                assert view.locator(f"#{name} .main-svg").count() > 0, name
            view.close()
        chromium.close()


def test_notebooks_show_tables(result: fret.Result) -> None:
    scene, path = result.scene, result.scene.path
    assert "coating 1" in scene._repr_html_()
    assert "T<sub>x</sub> = -200 N" in path._repr_html_()
    assert "partial slip" in result._repr_html_()
    study = fret.study.run(scene, {"mu": [0.3]}, measure="p_max", executor=SAME_PROCESS)
    assert "p_max" in study._repr_html_()


@pytest.mark.usefixtures("without_overview")
def test_the_command_writes_the_page(
    result: fret.Result,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    result.save(tmp_path / "run.zarr")
    monkeypatch.chdir(tmp_path)
    assert commands.main(["report", "run.zarr"]) == 0
    assert (tmp_path / "run.html").stat().st_size > 1e6
    assert commands.main(["report", "none.zarr"]) == 2
    assert "none.zarr" in capsys.readouterr().err


def test_every_store_has_its_page(worn: fret.wear.WearResult, tmp_path: Path) -> None:
    """The command takes wear and saved results; options of a run are refused."""
    store, page = tmp_path / "worn.zarr", tmp_path / "worn.html"
    worn.save(store)
    assert commands.main(["report", str(store), "-o", str(page)]) == 0
    assert "largest pressure" in page.read_text()
    assert commands.main(["report", str(store), "-o", str(page), "--wear", str(store)]) == 2


def test_the_page_of_a_study_takes_the_options_of_its_figure(tmp_path: Path) -> None:
    """A study of three parameters shows two; the third is chosen, as for the map."""
    places = {key: [1.0, 2.0, 3.0] for key in "abc"}
    total = xr.DataArray(np.arange(27.0).reshape(3, 3, 3), places, name="total")
    status = xr.full_like(total, 1, dtype=np.int8).rename("status")
    study, page = fret.study.Study(xr.merge([total, status])), tmp_path / "study.html"
    with pytest.raises(
        ValueError, match=r"3 parameters: give the values of 1 .* at=\{name: value\}"
    ):
        study.report(page)
    assert not page.exists()
    study.report(page, at={"c": 2.0})
    assert "27 done" in page.read_text()
    plt.close("all")


def test_a_film_of_a_cycle(result: fret.Result, tmp_path: Path) -> None:
    from PIL import Image

    fret.plot.animate(result, tmp_path / "cycle.gif", increments=[3, 11], dpi=40)
    with Image.open(tmp_path / "cycle.gif") as film:
        assert film.n_frames == 2
    with pytest.raises(ValueError, match="must end in"):
        fret.plot.animate(result, tmp_path / "cycle.avi")
    pytest.importorskip("imageio_ffmpeg")
    fret.plot.animate(result, tmp_path / "cycle.mp4", increments=[3, 11], dpi=40, fps=4)
    film = frames_of(tmp_path / "cycle.mp4", 296, 112)
    assert len(film) == 2
    # Outside the maps, the dot and the time, all frames are alike: axes and scales are fixed.
    corner = film[0].shape[0] - 12
    for frame in film[1:]:
        assert np.abs(frame[corner:].astype(int) - film[0][corner:]).mean() < 1.0
        assert np.abs(frame.astype(int) - film[0]).mean() > 0.1


def frames_of(film: Path, width: int, height: int) -> list[Any]:
    """Frames of a film."""
    from pyfret.plot.film_writers import find_ffmpeg

    program = find_ffmpeg()
    assert program is not None
    raw = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-loglevel", "error", "-"]
    pixels = subprocess.run([program, "-i", film, *raw], capture_output=True, check=True).stdout
    frames = np.frombuffer(pixels, np.uint8).reshape(-1, height, width, 3)
    return list(frames)


def test_a_film_without_the_program_is_refused(
    result: fret.Result, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from pyfret.plot import film_writers

    monkeypatch.setattr(film_writers, "find_ffmpeg", lambda: None)
    with pytest.raises(ValueError, match="imageio-ffmpeg"):
        fret.plot.animate(result, tmp_path / "cycle.mp4")


def test_a_gif_has_its_name_checked(result: fret.Result, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="needs more"):
        fret.plot.animate(result, tmp_path / "cycle.gif", increments=[3])


def test_verification_ships_with_the_package() -> None:
    computed = fret.verify()
    assert computed.passed, str(computed)
    assert len(computed.checks) >= 15
    message = str(computed)
    assert "Lubkin" in message
    assert "all passed" in message
    worse = verification.Check("x", "y", ours=1.1, truth=1.0, scale=1.0, last=0.01)
    assert not worse.passed
    assert "1 FAILED" in str(verification.Verification([worse], 1.0))
    # JSON knows no other kind of it.
    assert all(type(check.passed) is bool for check in computed.checks)


def test_fret_hands_over_to_python() -> None:
    environment = {**os.environ, "FRET_PYTHON": sys.executable}
    command = [ROOT / "target" / "release" / "fret", "cite"]
    ran = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
    assert ran.stdout.strip() == fret.cite()
    environment["FRET_PYTHON"] = "no-such-python"
    ran = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
    assert ran.returncode == 2
    assert "FRET_PYTHON" in ran.stderr


@pytest.mark.timeout(180)
def test_captions_stand_below_the_labels_of_their_figures(page: Path) -> None:
    api = pytest.importorskip("playwright.sync_api")
    below = """() => [...document.querySelectorAll("figure")].map((of) => {
        const title = of.querySelector(".xtitle"), caption = of.querySelector("figcaption");
        return title && caption.getBoundingClientRect().top - title.getBoundingClientRect().bottom;
    }).filter((of) => of !== null)"""
    with api.sync_playwright() as play:
        chromium = browser(play)
        for width, height in SCREENS.values():
            view = chromium.new_page(viewport={"width": width, "height": height})
            view.goto(page.as_uri())
            view.wait_for_selector("body[data-drawn=yes]", timeout=60_000)
            room = view.evaluate(below)
            assert len(room) > 5
            assert min(room) > 2.0
            view.close()
        chromium.close()
