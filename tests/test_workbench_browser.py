"""The workbench in a real browser: three jobs, four widths, two browsers, axe-core."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyfret as fret

pytest.importorskip("dash")
pytest.importorskip("playwright.sync_api", reason="no playwright")

from campaign.browsers import act_at_random
from pyfret.workbench import edits
from pyfret.workbench.page import explore
from pyfret.workbench.presets import FIRST, make_preset
from pyfret.workbench.runs import ALPHAS, FRICTIONS, law_of, loop_path
from workbench_pages import PATIENCE, User, check_texts, open_browser

pytestmark = [
    pytest.mark.browser,
    pytest.mark.solves,
    pytest.mark.timeout(900),
    pytest.mark.filterwarnings("ignore::pyfret._util.scene_warnings.SceneWarning"),
]
TABS = ("contact", "answers", "compare", "files", "out")
CORPUS = Path(__file__).parent / "data" / "corpus"
#: Actions that a job may take.
MOST_ACTIONS = 12


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with open_browser() as chromium:
        yield chromium


@pytest.fixture
def page() -> Iterator[Any]:
    page = explore()
    yield page
    page.stop()


@pytest.mark.slow
def test_a_coating_is_chosen(browser: Any, page: Any) -> None:
    user = User(browser, page.url)
    user.wait()
    user.click(".headline [data-event=pin]")
    user.choose("#material-body2-coatings-0", "DLC_ta_C_H")
    user.click(".headline [data-event=pin]")
    user.type("#number-body2-coatings-0-thickness", "1.5")
    user.click(".headline [data-event=pin]")
    user.settle()
    user.go("compare")
    head = user.view.locator("#comparison thead th")
    assert head.count() == 4
    row = user.view.locator("#comparison tr", has_text="largest von Mises stress, coating")
    texts = row.locator("td").all_inner_texts()
    assert len(texts) == 3
    assert "smaller" in texts[1]
    user.go("answers")
    shown = user.number("largest von Mises stress, DLC_ta_C_H (coating)")
    assert user.actions <= MOST_ACTIONS
    scene = edits.replace_material(make_preset(FIRST)[0], "body2.coatings.0", "DLC_ta_C_H")
    scene = edits.replace_value(scene, "body2.coatings.0.thickness", 1.5e-6)
    result = fret.solve(scene, save="all", error="coarser", progress=False)
    worst = result.at(-1).stress().maximum("von_mises", layer=0)
    assert shown == pytest.approx(1e-6 * worst.value, rel=1e-9)
    user.close()


def write_rough_map(path: Path) -> None:
    """Write a measured surface as points: x, y and z in micrometres."""
    n, pitch = 64, 5.0
    waves = np.random.default_rng(3).normal(0.0, 1.0, (n, n))
    k = np.hypot(*np.meshgrid(np.fft.fftfreq(n), np.fft.fftfreq(n), indexing="ij"))
    smooth = np.fft.ifft2(np.fft.fft2(waves) * np.exp(-((k / 0.08) ** 2))).real
    z = 0.05 * smooth / smooth.std()
    x = pitch * np.arange(n)
    lines = [f"{x[i]:.1f} {x[j]:.1f} {z[i, j]:.6f}" for i in range(n) for j in range(n)]
    path.write_text("x[um] y[um] z[um]\n" + "\n".join(lines), encoding="utf-8")


@pytest.mark.slow
def test_a_rough_surface_under_a_ball(browser: Any, page: Any, tmp_path: Path) -> None:
    measured = tmp_path / "rough.xyz"
    write_rough_map(measured)
    user = User(browser, page.url)
    user.wait()
    user.go("files")
    user.drop(measured)
    user.view.wait_for_selector("#files .card .plot .heatmaplayer image", timeout=PATIENCE)
    user.click("#files [data-event=surface][data-part=body2]")
    user.settle()
    user.go("answers")
    shown = user.number("largest pressure")
    assert user.actions <= MOST_ACTIONS
    scene = make_preset(FIRST)[0]
    surface = fret.read_surface(measured, missing="fill")
    scene = edits.fit_grid(scene.replace(body2=scene.body2.replace(shape=surface)))
    result = fret.solve(scene, save="all", error="coarser", progress=False)
    assert shown == pytest.approx(1e-6 * float(result.p_max[-1]), rel=1e-9)
    smooth = fret.solve(make_preset(FIRST)[0], progress=False)
    assert abs(shown / (1e-6 * float(smooth.p_max[-1])) - 1.0) > 0.05
    user.close()


def write_tests_of_rig(folder: Path, scene: fret.Scene, cycles: float) -> tuple[Path, Path]:
    """Write a loop and the profile of a scar that a rig would have measured."""
    reach = 0.8e-6
    true = scene.replace({"mu": 0.55}).replace(path=loop_path(scene, reach))
    fine = (
        fret.LoadPath.start().normal(10.0).displace(delta_x=[reach, -reach, reach], increments=60)
    )
    loop = fret.solve(true, fine, progress=False).dataset
    rows = zip(1e6 * loop.delta_x.values[-48:], loop.T_x.values[-48:], strict=True)
    noise = np.random.default_rng(1)
    lines = [f"{x:.5f};{T + noise.normal(0.0, 0.02):.4f}" for x, T in rows]
    (folder / "loop.csv").write_text("shift [um];T [N]\n" + "\n".join(lines), encoding="utf-8")
    worn = fret.wear.solve(true, cycles=cycles, progress=False, **law_of(2, 1e-15))
    cut = worn.dataset.worn2[-1].sel(y=0.0, method="nearest")
    rows = zip(1e6 * worn.dataset.x.values, 1e6 * cut.values, strict=True)
    lines = [f"{x:.4f};{z + noise.normal(0.0, 2e-5):.7f}" for x, z in rows]
    (folder / "scar.csv").write_text("x [um];depth [um]\n" + "\n".join(lines), encoding="utf-8")
    return folder / "loop.csv", folder / "scar.csv"


@pytest.mark.slow
def test_a_loop_and_a_scar_lead_to_a_depth(browser: Any, page: Any, tmp_path: Path) -> None:
    scene = edits.replace_value(make_preset(FIRST)[0], "grid.n", 24)
    loop, scar = write_tests_of_rig(tmp_path, scene, 1e4)
    user = User(browser, page.url)
    user.wait()
    user.type("#number-grid-n", "24")
    user.settle()
    user.go("files")
    user.drop(loop, scar)
    user.view.wait_for_selector("#fit-cycles", timeout=PATIENCE)
    user.type("#fit-cycles", "1e4")
    user.type("#fit-predict", "2e4")
    user.click("#files [data-event=fit]")
    user.click("#files [data-event=show]")
    user.view.wait_for_selector("#jobs .card", timeout=PATIENCE)
    # The run survives a reload of the page.
    user.view.reload()
    user.view.wait_for_selector("#jobs .card.ended", timeout=4 * PATIENCE)
    depth = user.number("worn depth", "#jobs")
    mu = user.number("friction coefficient", "#jobs")
    alpha = user.number("wear coefficient", "#jobs")
    assert user.actions <= MOST_ACTIONS
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        loops = fret.fit.read_loops(loop)
        start = scene.replace(path=loop_path(scene, 0.5 * float(np.ptp(loops.delta))))
        friction = fret.fit(start, loops, unknown={"mu": FRICTIONS}, executor=1)
        wear = {"cycles": 1e4, **law_of(2, ALPHAS[1])}
        profile = fret.fit.read_scar(scar, wear=wear)
        key = "wear.body2.alpha"
        worn = fret.fit(friction.scene, profile, unknown={key: ALPHAS}, executor=1)
        law = law_of(2, worn.known[key].value)
        predicted = fret.wear.solve(friction.scene, cycles=2e4, progress=False, **law)
    assert mu == pytest.approx(friction.known["mu"].value, rel=1e-6)
    assert mu == pytest.approx(0.55, rel=0.05)
    assert alpha == pytest.approx(worn.known[key].value, rel=1e-6)
    assert alpha == pytest.approx(1e-15, rel=0.1)
    assert depth == pytest.approx(1e6 * float(predicted.dataset.depth2[-1]), rel=1e-6)
    user.close()


@pytest.mark.slow
def test_a_long_run_is_cancelled_and_a_study_ends(browser: Any, page: Any) -> None:
    user = User(browser, page.url)
    user.wait()
    user.go("answers")
    user.type("#wear-cycles", "1e9")
    user.type("#wear-alpha", "1e-13")
    user.click("[data-event=wear]")
    user.view.wait_for_selector("#jobs .running progress", timeout=PATIENCE)
    user.click("#jobs [data-event=cancel]")
    user.view.wait_for_selector("#jobs .ended:has-text('cancelled')", timeout=PATIENCE)
    user.type("#study-count", "2")
    user.click("[data-event=study]")
    row = user.view.locator("#jobs [data-number]")
    row.nth(1).wait_for(timeout=2 * PATIENCE)
    shown = [float(row.nth(n).get_attribute("data-value") or "nan") for n in (0, 1)]
    key = {"friction.mu": [0.2, 0.8]}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        study = fret.study.run(
            make_preset(FIRST)[0], key, measure="loop_energy", executor=1, progress=False
        )
    values = study.dataset.loop_energy.values
    assert shown[1] == pytest.approx(values[1], rel=1e-6)
    assert np.isnan(shown[0]) == np.isnan(values[0])
    user.close()


@pytest.mark.slow
def test_a_doubt_is_removed_by_its_button_and_a_link_opens_the_scene(
    browser: Any, page: Any
) -> None:
    user = User(browser, page.url)
    user.wait()
    user.type("#number-friction-mu", "0.2")
    box = user.view.locator(".doubt", has_text="largest force that friction can carry")
    box.locator("button").click(timeout=PATIENCE)
    user.settle()
    assert user.view.input_value("#number-friction-mu") == "0.2"
    user.go("out")
    link = user.view.input_value("#link")
    with user.view.expect_download() as saved:
        user.click("[data-event=out][data-name='scene.toml']")
    scene = fret.Scene.from_toml(saved.value.path().read_text(encoding="utf-8"))
    assert scene.mu == 0.2
    second = User(browser, page.url + link)
    second.see("#number-friction-mu", "0.2")
    second.settle()
    second.go("out")
    assert "mu = 0.2" in second.view.inner_text("#toml")
    second.close()
    user.close()


def test_keys_alone_reach_tabs_fields_and_sliders(browser: Any, page: Any) -> None:
    user = User(browser, page.url)
    user.wait()
    user.view.focus("#tab-contact")
    for tab in TABS[1:]:
        user.view.keyboard.press("ArrowRight")
        assert user.view.get_attribute(f"#tab-{tab}", "aria-selected") == "true"
    for _ in TABS[1:]:
        user.view.keyboard.press("ArrowLeft")
    before = float(user.view.input_value("#number-friction-mu"))
    user.view.focus("#slider-friction-mu")
    user.view.keyboard.press("ArrowRight")
    user.settle()
    after = float(user.view.input_value("#number-friction-mu"))
    assert after > before
    # No click in between: the browser shows the focus of keys alone.
    user.view.focus("#tab-contact")
    for _ in TABS[1:]:
        user.view.keyboard.press("ArrowRight")
    assert fret.Scene.from_toml(user.view.inner_text("#toml")).mu == pytest.approx(after)
    user.view.focus("#panel-out [data-event=out]")
    focused = user.view.evaluate("() => getComputedStyle(document.activeElement).outlineStyle")
    assert focused == "solid"
    user.close()


def show_everything(user: User) -> None:
    """Fill all five tabs: two variants, three files, a run of wear."""
    user.wait()
    user.click(".headline [data-event=pin]")
    user.type("#number-friction-mu", "0.6")
    user.click(".headline [data-event=pin]")
    user.drop(CORPUS / "pandas_rig.csv", CORPUS / "gwyddion.gwy", CORPUS / "README.md")
    user.view.locator("#files .card").nth(2).wait_for(state="attached", timeout=PATIENCE)
    user.go("answers")
    user.click("[data-event=wear]")
    user.view.wait_for_selector("#jobs .ended", timeout=4 * PATIENCE)
    user.view.wait_for_selector("#crack table", timeout=4 * PATIENCE)
    user.settle()


def serious(view: Any) -> list[str]:
    """Return the serious violations that axe-core finds."""
    package = pytest.importorskip("axe_playwright_python", reason="no axe-core")
    source = Path(package.__file__).with_name("axe.min.js").read_text(encoding="utf-8")
    view.evaluate(source)
    report = view.evaluate("() => axe.run()")
    return [
        f"{fault['id']}: {fault['nodes'][0]['html'][:160]}"
        for fault in report["violations"]
        if fault["impact"] in ("serious", "critical")
    ]


@pytest.mark.slow
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_all_tabs_fit_at_four_widths(browser: Any, page: Any, scheme: str) -> None:
    user = User(browser, page.url, scheme=scheme)
    show_everything(user)
    for width in (380, 800, 1280, 1920):
        user.view.set_viewport_size({"width": width, "height": 900})
        for tab in TABS:
            user.go(tab)
            user.view.wait_for_timeout(700)
            assert check_texts(user.view) == [], (width, tab)
            assert serious(user.view) == [], (width, tab)
            if folder := os.environ.get("FRET_WORKBENCH_PICTURES"):
                path = Path(folder) / f"{tab}-{width}-{scheme}.png"
                user.view.screenshot(path=path, full_page=True)
    user.close()


def drop_folder(user: User, folder: Path) -> None:
    """Drop a folder of this machine on the page."""
    user.actions += 1
    session = user.context.new_cdp_session(user.view)
    box = user.view.locator("#drop").bounding_box()
    place = {"x": box["x"] + 20.0, "y": box["y"] + 20.0}
    data = {"items": [], "files": [str(folder)], "dragOperationsMask": 1}
    for kind in ("dragEnter", "dragOver", "drop"):
        session.send("Input.dispatchDragEvent", {"type": kind, **place, "data": data})


def test_the_folder_of_a_store_is_dropped(browser: Any, page: Any, tmp_path: Path) -> None:
    scene = edits.replace_value(make_preset(FIRST)[0], "grid.n", 24)
    path = fret.LoadPath.start().normal(7.0, increments=2)
    fret.solve(scene, path, out=tmp_path / "rig.zarr", progress=False)
    user = User(browser, page.url)
    user.wait()
    user.go("files")
    drop_folder(user, tmp_path / "rig.zarr")
    card = user.view.locator("#files .card", has_text="rig.zarr")
    card.wait_for(timeout=PATIENCE)
    assert "store of pyfret" in card.inner_text()
    user.click("#files [data-event=open]")
    user.go("contact")
    user.see("#number-grid-n", "24")
    user.settle()
    user.go("out")
    assert fret.Scene.from_toml(user.view.inner_text("#toml")).path.branches[0].W == 7.0
    user.close()


@pytest.mark.slow
def test_two_browsers_that_act_at_random_mix_nothing(browser: Any, page: Any) -> None:
    sizes = act_at_random(browser, page.url, seconds=15.0)
    assert len(sizes) >= 5
