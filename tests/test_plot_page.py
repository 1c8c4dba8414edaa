"""The page of all figures has all of them, and is the one that its tool writes."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from PIL import Image

from conftest import ROOT
from pyfret import plot

sys.path.insert(0, str(ROOT / "tools"))
import plot_page

pytestmark = pytest.mark.solves
NAMES = [name for figures in plot_page.FIGURES.values() for name in figures]


def test_every_figure_has_its_entry() -> None:
    assert sorted([*NAMES, *plot_page.OTHERS]) == sorted(plot.__all__)


def test_the_page_is_that_of_the_docstrings() -> None:
    written = (plot_page.DOCS / "reference" / "figures.md").read_text(encoding="utf-8")
    assert written == plot_page.page(), "python tools/plot_page.py"


@pytest.mark.parametrize("name", NAMES)
def test_a_picture_can_be_read(name: str) -> None:
    place: Path = plot_page.PICTURES / f"{name}.png"
    assert 1000 < place.stat().st_size < 120_000
    with Image.open(place) as image:
        # At least three inches at the size of the text of a page.
        assert 330 <= image.width <= plot_page.WIDTH
        assert image.height >= 200
        assert len(image.convert("L").getcolors() or []) > 5
