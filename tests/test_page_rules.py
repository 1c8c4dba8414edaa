"""Rules of the page of a result: accessible, the theme's colours, figures on paper."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

import pyfret as fret
from conftest import W, sphere_on_flat
from pyfret._util import theme
from test_report import browser

pytestmark = pytest.mark.solves

#: Widths of a phone, a tablet, a laptop and a screen.
WIDTHS = (380, 800, 1280, 1920)


@pytest.fixture(scope="module")
def page(tmp_path_factory: Any) -> Path:
    path = fret.LoadPath.start().normal(W, increments=2)
    path = path.force(T_x=200.0, sigma_B=2e7, increments=4)
    result = fret.solve(sphere_on_flat(ratio=2.0, n=16), path, save="all", progress=False)
    target: Path = tmp_path_factory.mktemp("rules") / "run.html"
    result.report(target)
    return target


def test_a_page_has_figures_without_a_program(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    assert 'src="data:image/svg+xml;base64,' in text
    assert all(re.search('alt="[^"]+"', tag) for tag in re.findall("<img[^>]*>", text))
    assert "@media print" in text
    assert "&sigma;<sub>B</sub> [MPa]" in text
    assert "hidden>\n<h2>Crack" in text
    assert "+-" not in re.sub("<(script|style).*?</(script|style)>", "", text, flags=re.DOTALL)
    assert all(name in text for name in theme.variables())


def test_tables_name_their_columns(page: Path) -> None:
    assert "<th></th>" not in page.read_text(encoding="utf-8")


@pytest.mark.slow
@pytest.mark.timeout(240)
def test_a_page_is_accessible_at_all_widths(page: Path) -> None:
    api = pytest.importorskip("playwright.sync_api")
    axe = pytest.importorskip("axe_playwright_python.sync_playwright").Axe()
    with api.sync_playwright() as play:
        chromium = browser(play)
        for width in WIDTHS:
            view = chromium.new_page(viewport={"width": width, "height": 900})
            view.goto(page.as_uri())
            view.wait_for_selector("body[data-drawn=yes]", timeout=60_000)
            violations = axe.run(view).response["violations"]
            assert [(rule["id"], len(rule["nodes"])) for rule in violations] == []
            assert view.evaluate("document.documentElement.scrollWidth") <= width
            view.emulate_media(media="print")
            assert view.locator(".still img").first.is_visible()
            assert not view.locator("#loop").is_visible()
            view.close()
        chromium.close()
