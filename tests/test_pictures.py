"""Ten figures beside pictures of them that people have looked at, in ``tests/data/pictures``.

``FRET_PICTURES=write pytest tests/test_pictures.py`` draws the pictures anew: look at them.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import ClassVar

import matplotlib.pyplot as plt
import numpy as np
import pytest
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.testing.compare import compare_images

import pyfret as fret
from conftest import ROOT

pytestmark = pytest.mark.solves

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
    "shear_profiles": (
        fret.plot.shear_profiles,
        lambda r: fret.plot.shear_profiles(mirrored(r), units="SI"),
    ),
    "pressure_map": (
        lambda r: fret.plot.pressure_map(r.at(-1)),
        lambda r: fret.plot.pressure_map(r.at(10), units="SI"),
    ),
    "shear_streamlines": (
        lambda r: fret.plot.shear_streamlines(r.at(-1)),
        lambda r: fret.plot.pressure_map(r.at(-1)),
    ),
    "stress_map": (
        lambda r: fret.plot.stress_map(r.at(-1).stress()),
        lambda r: fret.plot.stress_map(r.at(-1).stress(), of="s_xx"),
    ),
    "stress_along_depth": (
        lambda r: fret.plot.stress_along_depth(r.at(-1).stress(x=0.0, y=0.0)),
        lambda r: fret.plot.stress_along_depth(r.at(-1).stress(x=r.a_H, y=0.0)),
    ),
    "zones_of_a_line_contact": (
        lambda _: fret.plot.stick_slip(line_contact()),
        lambda _: fret.plot.shear_streamlines(line_contact()),
    ),
    "study_map": (
        lambda _: fret.plot.study_map(Points(), kind="cells"),
        lambda _: fret.plot.study_map(Points(), kind="contour"),
    ),
}


@cache
def line_contact() -> fret.Result:
    """A cylinder on a flat, with a bulk stress."""
    steel = fret.Elastic(E=210e9, nu=0.3)
    line = fret.reference.line_contact(R=0.05, bodies=(steel, steel), W=4e5)
    scene = fret.Scene(
        body1=fret.Body(steel, shape=fret.Cylinder(R=0.05)),
        body2=fret.Body(steel),
        friction=0.6,
        grid=fret.Grid.strip(extent=2.6 * line.a, n=96),
    )
    path = fret.LoadPath.start().normal(4e5, increments=1)
    return fret.solve(scene, path.force(T_x=1.44e5, sigma_B=1e8, increments=6), progress=False)


class Points:
    """A study over two keys of a scene file in geometric steps."""

    parameters: ClassVar = ["body2.coatings.0.thickness", "body2.coatings.0.E"]
    measures: ClassVar = ["p_max"]

    @property
    def dataset(self) -> xr.Dataset:
        first, second = self.parameters
        thickness, E = np.geomspace(1e-6, 8e-6, 4), np.geomspace(1e11, 4e11, 3)
        p_max = 1e9 * (1 + np.log(thickness[:, None] / 1e-6) * np.log(E / 1e11))
        attrs = {"units": "Pa", "long_name": "largest pressure of the path"}
        return xr.Dataset(
            {
                "p_max": ((first, second), p_max, attrs),
                "status": ((first, second), np.ones(p_max.shape, int)),
            },
            coords={first: thickness, second: E},
        )


def drawn(draw: Draw, result: fret.Result, place: Path) -> Path:
    figure = draw(result).figure
    figure.set_size_inches(4.0, 3.0)  # type: ignore[union-attr]
    figure.savefig(place, dpi=60)
    plt.close(figure)  # type: ignore[arg-type]
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
    # A wrong figure exceeds the tolerance.
    alternative = drawn(wrong, coated, tmp_path / "wrong.png")
    assert compare_images(str(picture), str(alternative), tol=ALIKE) is not None
