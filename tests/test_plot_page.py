"""The page of all figures has all of them, and is the one that its tool writes."""

from __future__ import annotations

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import pytest
from PIL import Image

import pyfret as fret
from conftest import ROOT
from pyfret import plot
from pyfret._util.figures import figures_of, first_types
from pyfret.history import CountedLoops
from pyfret.subsurface.tensor import Stress

sys.path.insert(0, str(ROOT / "tools"))
import plot_page

pytestmark = pytest.mark.solves
NAMES = [name for figures in plot_page.FIGURES.values() for name in figures]


def test_every_figure_has_its_entry() -> None:
    assert sorted([*NAMES, *plot_page.OTHERS]) == sorted(plot.__all__)


def test_the_page_is_that_of_the_docstrings() -> None:
    written = (plot_page.DOCS / "reference" / "figures.md").read_text(encoding="utf-8")
    assert written == plot_page.page(), "python tools/plot_page.py"


def test_a_figure_gives_its_axes_or_the_whole_figure() -> None:
    """All figures: what comes back has `.figure`, of which matplotlib's `savefig` is."""
    for name in NAMES:
        assert getattr(plot, name).__annotations__["return"] in ("Axes", "Figure"), name
    drawn = plt.figure()
    assert drawn.figure is drawn
    assert drawn.add_subplot().figure is drawn
    plt.close(drawn)


#: What figures are drawn of that is no result: they are functions alone.
PLAIN = {"xr.Dataset", "xr.DataArray", "ArrayLike", "Mapping[float, Run]", "SurfaceMap"}
#: All results that have figures.
RESULTS = (
    *(fret.Result, fret.Snapshot, Stress, fret.fatigue.Life, fret.fatigue.LoadFactors),
    *(fret.fatigue.OverDistance, fret.fracture.Cracks, fret.wear.WearResult, fret.study.Study),
    *(fret.study.Comparison, fret.LoadHistory, CountedLoops, fret.fatigue.Damage),
)


def test_a_figure_of_a_result_is_a_method_of_it() -> None:
    """All figures, by the type of their first argument."""
    methods = {name for picture in RESULTS for name in figures_of(picture)}
    for name in NAMES:
        alone = first_types(getattr(plot, name)) <= PLAIN
        assert alone != (name in methods), name
    assert {"wear_history", "wear_profiles", "wear_loops", "depth_map", "third_body"} == set(
        figures_of(fret.wear.WearResult)
    )
    assert "life_over_distance" in figures_of(fret.fatigue.OverDistance)
    assert "criterion_map" not in figures_of(fret.fatigue.OverDistance)


@pytest.mark.parametrize("name", NAMES)
def test_a_picture_can_be_read(name: str) -> None:
    path: Path = plot_page.PICTURES / f"{name}.png"
    assert 1000 < path.stat().st_size < 120_000
    with Image.open(path) as image:
        # At least three inches at the size of the text of a page.
        assert 330 <= image.width <= plot_page.WIDTH
        assert image.height >= 200
        assert len(image.convert("L").getcolors() or []) > 5
