"""Three figures beside pictures of them that people have looked at, in ``tests/data/pictures``.

``FRET_PICTURES=write pytest tests/test_pictures.py`` draws the pictures anew: look at them.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest
from matplotlib.axes import Axes
from matplotlib.testing.compare import compare_images

import pyfret as fret
from conftest import ROOT

PICTURES = ROOT / "tests" / "data" / "pictures"
#: Root-mean-square difference, of 255, up to which two pictures are the same: versions of
#: matplotlib set letters a pixel apart.
ALIKE = 6.0


def mirrored(result: fret.Result) -> fret.Result:
    return fret.Result(result.dataset.assign(delta_x=-result.dataset.delta_x))


def all_stick(result: fret.Result) -> fret.Result:
    return fret.Result(result.dataset.assign(stick=result.dataset.contact))


Draw = Callable[[fret.Result], Axes]
#: What is drawn, and what could be drawn in its place and is wrong.
FIGURES: dict[str, tuple[Draw, Draw]] = {
    "fretting_loop": (
        fret.plot.fretting_loop,
        lambda r: fret.plot.fretting_loop(mirrored(r)),
    ),
    "stick_slip": (
        lambda r: fret.plot.stick_slip(r.at(-1)),
        lambda r: fret.plot.stick_slip(all_stick(r).at(-1)),
    ),
    "shear_profile": (
        lambda r: fret.plot.shear_profile(r.at(-1)),
        lambda r: fret.plot.pressure_profile(r.at(-1)),
    ),
}


def drawn(draw: Draw, result: fret.Result, place: Path) -> Path:
    figure = draw(result).figure
    figure.set_size_inches(4.0, 3.0)  # type: ignore[union-attr]
    figure.savefig(place, dpi=60)
    return place


@pytest.mark.parametrize("name", FIGURES)
def test_a_figure_is_the_picture_that_was_looked_at(
    name: str, coated: fret.Result, tmp_path: Path
) -> None:
    right, wrong = FIGURES[name]
    picture = PICTURES / f"{name}.png"
    if os.environ.get("FRET_PICTURES") == "write":
        drawn(right, coated, picture)
    now = drawn(right, coated, tmp_path / "now.png")
    assert compare_images(str(picture), str(now), tol=ALIKE) is None
    # The tolerance tells a wrong figure.
    other = drawn(wrong, coated, tmp_path / "wrong.png")
    assert compare_images(str(picture), str(other), tol=ALIKE) is not None
