"""Sheets of every figure on every kind of scene, to be looked at: ``python tests/sheets.py OUT``.

A sheet is a page of all figures of one scene of ``test_figures.py``, at their own size. Further
arguments choose scenes by their names.
"""

from __future__ import annotations

import io
import sys
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import matplotlib as mpl
import matplotlib.pyplot as plt
from PIL import Image, ImageDraw

import pyfret as fret
from pyfret import plot
from test_figures import SCENES

#: Cells a side, so that a picture shows a real run.
CELLS = 48
#: Pixels of a sheet's width, and about a figure.
WIDTH, GAP = 2400, 12


def finer(scene: fret.Scene) -> fret.Scene:
    """The scene on a grid that is good enough to be looked at."""
    grid = scene.grid
    extent = grid.nx * grid.dx
    if grid.plane_strain:
        return scene.replace(grid=fret.Grid.strip(extent=extent, n=4 * CELLS, width=grid.dy))
    return scene.replace(grid=fret.Grid.centred(width=extent, n=CELLS))


def figures(result: fret.Result) -> Iterator[tuple[str, Callable[[], Any]]]:
    """Every figure of a run."""
    last = result.at(-1)
    below = last.stress()
    yield "result.plot()", result.plot
    yield "fretting_loop", lambda: plot.fretting_loop(result)
    yield "fretting_loop, SI", lambda: plot.fretting_loop(result, units="SI")
    yield "loop_evolution", lambda: plot.loop_evolution(result)
    yield "stick_ratio", lambda: plot.stick_ratio(result)
    yield "load_path", lambda: plot.load_path(result)
    yield "load_path of a path", lambda: plot.load_path(result.scene.path)
    yield "stick_slip", lambda: plot.stick_slip(last)
    yield "pressure_map", lambda: plot.pressure_map(last)
    yield "pressure_map, SI", lambda: plot.pressure_map(last, units="SI")
    yield "spots", lambda: plot.spots(last)
    yield "gap_map", lambda: plot.gap_map(last)
    yield "pressure_histogram", lambda: plot.pressure_histogram(last)
    yield "area_over_load", lambda: plot.area_over_load(result)
    yield "slip_map", lambda: plot.slip_map(last)
    yield "shear_streamlines", lambda: plot.shear_streamlines(last)
    yield "pressure_profile", lambda: plot.pressure_profile(last)
    yield "shear_profile", lambda: plot.shear_profile(last)
    yield "shear_profiles", lambda: plot.shear_profiles(result)
    yield "stress_map", lambda: plot.stress_map(below)
    yield "stress_map of s_xx, SI", lambda: plot.stress_map(below, of="s_xx", units="SI")
    yield "stress_along_depth", lambda: plot.stress_along_depth(last.stress(x=0.0, y=0.0))
    envelope = result.envelope(below.dataset.z.values, y=0.0)
    yield "stress_history", lambda: plot.stress_history(envelope)
    yield "envelope_maps", lambda: plot.envelope_maps(envelope)
    steel = fret.fatigue.Materials()["steel_42CrMo4"]
    judged = (None,) * len(result.scene.body2.coatings) + (steel,)
    try:
        life = result.life(judged, "dang_van", below.dataset.z.values, y=0.0)
    except ValueError:
        return
    yield "criterion_map", lambda: plot.criterion_map(life)
    factors = result.load_factors((None,) * (len(judged) - 1) + (650e6,), y=0.0)
    yield "load_factor_map", lambda: plot.load_factor_map(factors)


def picture(draw: Callable[[], Any], name: str) -> Image.Image:
    """A figure with its name above."""
    drawn = draw()
    figure = drawn if hasattr(drawn, "savefig") else drawn.get_figure()
    file = io.BytesIO()
    figure.savefig(file, dpi=100)
    plt.close(figure)
    image = Image.open(file).convert("RGB")
    page = Image.new("RGB", (image.width, image.height + 16), "white")
    page.paste(image, (0, 16))
    ImageDraw.Draw(page).text((4, 2), name, fill="#a00000")
    ImageDraw.Draw(page).rectangle((0, 0, page.width - 1, page.height - 1), outline="#cccccc")
    return page


def sheet(pictures: list[Image.Image]) -> Image.Image:
    """Pictures in rows."""
    places, x, y, high = [], 0, 0, 0
    for picture in pictures:
        if x and x + picture.width > WIDTH:
            x, y, high = 0, y + high + GAP, 0
        places.append((x, y))
        x, high = x + picture.width + GAP, max(high, picture.height)
    page = Image.new("RGB", (WIDTH, y + high), "white")
    for picture, position in zip(pictures, places, strict=True):
        page.paste(picture, position)
    return page


def main(out: str, *names: str) -> None:
    """Draw the sheets."""
    mpl.use("agg")
    warnings.simplefilter("ignore")
    folder = Path(out)
    folder.mkdir(parents=True, exist_ok=True)
    for name in names or SCENES:
        result = fret.solve(finer(SCENES[name]), save="all", progress=False)
        pictures = [picture(draw, item) for item, draw in figures(result)]
        path = folder / f"{name.replace(' ', '_').replace(',', '')}.png"
        sheet(pictures).save(path)
        print(path)


if __name__ == "__main__":
    main(*sys.argv[1:])
