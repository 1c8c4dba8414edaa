"""The page of what if: its answers are those of ``solve``, in a real browser."""

from __future__ import annotations

import shutil
import time
import urllib.error
import urllib.request
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

import pyfret as fret
from pyfret.what_if.answer import FEWER, answer
from pyfret.what_if.controls import changed, controls
from pyfret.what_if.page import as_python

pytest.importorskip("dash")


def scene() -> fret.Scene:
    """A coated ball contact with a cycle of partial slip."""
    steel, film = fret.Elastic(E=210e9, nu=0.3), fret.Elastic(E=400e9, nu=0.25)
    R, W = 5e-3, 10.0
    a = fret.reference.hertz(R=R, bodies=(steel, steel), W=W).a
    return fret.Scene(
        body1=fret.Body(steel, shape=fret.Sphere(R=R)),
        body2=fret.Body(steel, coatings=[fret.Coating(film, thickness=20e-6)]),
        friction=0.4,
        grid=fret.Grid.centred(width=2.6 * a, n=32),
        path=fret.LoadPath.start().normal(W).cycles(1, T_x=2.0),
        title="ball",
    )


def test_sliders_change_what_they_name() -> None:
    base_scene = scene()
    assert [control.name for control in controls(base_scene)] == [
        "load",
        "mu",
        "thickness",
        "modulus",
        "radius",
    ]
    for control in controls(base_scene):
        before = control.read(base_scene)
        assert before is not None
        made = changed(base_scene, {control.name: 1.5 * before}, n=24)
        assert control.read(made) == pytest.approx(1.5 * before)
        others = [item for item in controls(base_scene) if item.name != control.name]
        assert all(item.read(made) == pytest.approx(item.read(base_scene)) for item in others)
        # The grid follows the contact.
        assert made.hertz is not None
        assert base_scene.hertz is not None
        width = made.grid.nx * made.grid.dx / made.hertz.a
        assert width == pytest.approx(base_scene.grid.nx * base_scene.grid.dx / base_scene.hertz.a)
    bare = base_scene.replace(body2=fret.Body(base_scene.body2.substrate))
    assert [control.name for control in controls(bare)] == ["load", "mu", "radius"]


def test_loads_keep_their_ratios() -> None:
    made = changed(scene(), {"load": 20.0}, n=24)
    assert np.max(made.path.T_x) == pytest.approx(4.0)


@pytest.mark.solves
def test_a_preview_has_fewer_increments_and_nearly_the_same_numbers() -> None:
    base_scene = changed(scene(), {}, n=32)
    full = answer(base_scene)
    result = fret.solve(base_scene, progress=False)
    assert full.largest == pytest.approx(result.at(-1).stress().maximum("von_mises").value)
    assert sum(full.counts) == result.dataset.sizes["increment"]
    near = changed(scene(), {"mu": 0.42}, n=32)
    early, late = answer(near, full.counts), answer(near)
    assert early.largest == pytest.approx(late.largest, rel=0.03)
    assert early.counts == full.counts
    assert max(4, max(full.counts) // FEWER) < max(full.counts)


def test_what_has_no_solution_is_told() -> None:
    base_scene = scene()
    with pytest.raises(ValueError, match=r"T_x|friction|slide|resist"):
        answer(changed(base_scene, {"mu": 0.05}, n=24))


@pytest.mark.solves
def test_the_script_runs(monkeypatch: pytest.MonkeyPatch, capsys: Any) -> None:
    import matplotlib.pyplot as plt

    monkeypatch.setattr(plt, "show", lambda: None)
    exec(as_python(changed(scene(), {"mu": 0.5}, n=16).to_toml()), {})
    assert "cycle 1" in capsys.readouterr().out


def test_the_page_is_on_this_machine_alone() -> None:
    page = fret.explore(scene())
    try:
        assert page.url.startswith("http://127.0.0.1:")
        with urllib.request.urlopen(page.url) as answered:
            assert answered.status == 200
        request = urllib.request.Request(page.url, headers={"Host": "elsewhere.example"})
        with pytest.raises(urllib.error.HTTPError, match="403"):
            urllib.request.urlopen(request)
    finally:
        page.stop()


@pytest.fixture
def browser() -> Iterator[Any]:
    api = pytest.importorskip("playwright.sync_api", reason="no playwright")
    computed = shutil.which("chromium") or shutil.which("chromium-browser")
    if computed is None:
        pytest.skip("there is no Chromium")
    with api.sync_playwright() as play:
        chromium = play.chromium.launch(executable_path=computed, args=["--no-sandbox"])
        yield chromium
        chromium.close()


#: Keeps every text of the line of the state, so that none is missed on a busy machine.
WATCH = """
window.states = [];
new MutationObserver(() => {
  const text = document.querySelector('#state')?.textContent;
  if (text && text !== window.states.at(-1)) window.states.push(text);
}).observe(document, {subtree: true, childList: true, characterData: true});
"""


def shown(view: Any, *states: str) -> None:
    """Wait until the page has shown these states in this order since :func:`forget`."""
    view.wait_for_function(
        """wanted => {
          let from = 0;
          for (const text of window.states) if (text.startsWith(wanted[from])) from += 1;
          return from >= wanted.length;
        }""",
        arg=list(states),
        timeout=120_000,
    )


def forget(view: Any) -> None:
    """Forget the states that were shown."""
    view.evaluate("window.states = []")


def largest(view: Any) -> float:
    """The largest stress that the page shows."""
    view.wait_for_selector("#largest", state="attached")
    return float(view.get_attribute("#largest", "data-largest"))


def test_a_slider_is_moved_in_a_browser(browser: Any, capsys: Any) -> None:
    page = fret.explore(scene())
    requests: list[str] = []
    try:
        first, second = (browser.new_context().new_page() for _ in range(2))
        first.on("request", lambda request: requests.append(request.url))
        first.set_viewport_size({"width": 1300, "height": 900})
        for view in (first, second):
            view.add_init_script(WATCH)
            view.goto(page.url)
            shown(view, "full answer")
        before = largest(first)
        whole = changed(scene(), {}, n=48)
        assert before == pytest.approx(answer(whole).largest, rel=1e-4)
        times = []
        handle = first.locator("#slider-mu [role=slider]")
        handle.focus()
        for _ in range(3):
            forget(first)
            start = time.perf_counter()
            first.keyboard.press("PageUp")
            shown(first, "preview")
            times.append(time.perf_counter() - start)
            shown(first, "preview", "full answer")
        value = 10.0 ** float(handle.get_attribute("aria-valuenow"))
        assert value > 0.4
        made = changed(scene(), {"mu": value}, n=48)
        # Increments are those of the scene that the page begins with.
        expected = answer(made, like=whole.replace(save="branches")).largest
        assert largest(first) == pytest.approx(expected, rel=1e-4)
        assert largest(first) == pytest.approx(answer(made).largest, rel=1e-2)
        assert largest(first) != pytest.approx(before, rel=1e-3)
        # The other browser has its own scene.
        assert largest(second) == before
        # Nothing comes from outside.
        assert requests
        assert all(url.startswith((page.url, "data:", "blob:")) for url in requests)
        with first.expect_download() as saved:
            first.click("#as-scene")
        text = saved.value.path().read_text(encoding="utf-8")
        assert fret.Scene.from_toml(text).mu == pytest.approx(value)
        with capsys.disabled():
            print(f" median {sorted(times)[1]:.2f} s from change to picture", end="")
    finally:
        page.stop()
