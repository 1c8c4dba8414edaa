"""All public figures at all widths and under styles of the user: nothing cut, only the theme."""

from __future__ import annotations

import io
import re
import sys
from collections.abc import Iterator
from functools import cache
from inspect import signature
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.colors import to_hex, to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.testing.compare import compare_images

from conftest import ROOT
from overlaps import faults
from pyfret import plot
from pyfret._util import theme
from pyfret.plot import sizes

sys.path.insert(0, str(ROOT / "tools"))
import plot_page

# The first figure waits for all runs and studies that the page draws.
pytestmark = [pytest.mark.filterwarnings("ignore"), pytest.mark.timeout(1200)]

CODE = {name: code for figures in plot_page.FIGURES.values() for name, code in figures.items()}
#: Colours of curves in the theme, beside greys.
CURVES = {
    colour.lower()
    for colour in (
        *theme.CATEGORIES,
        *(theme.STICK, theme.SLIP, theme.MARK, theme.REFERENCE, theme.CRACK),
    )
}
#: Rounding of colours that are steps of a map.
NEAR = 3.0 / 255.0
#: First colours of matplotlib, and plain red, green and blue.
OUTSIDE = {"#1f77b4", "#ff7f0e", "#2ca02c", "#d62728", "#9467bd", "#ff0000", "#00ff00", "#0000ff"}


@cache
def names() -> dict[str, Any]:
    """Return the objects that the code of the figures draws."""
    return plot_page.names()


def drawn(name: str, **options: str) -> Figure:
    """Draw a figure of the page with further options."""
    code = CODE[name]
    call = code[:-1] + ("" if code.endswith("()") else ", ") + "**options)"
    picture = eval(call, {**names(), "options": options})
    figure = picture if isinstance(picture, Figure) else picture.get_figure()
    assert isinstance(figure, Figure)
    return figure


@pytest.fixture(autouse=True)
def close_figures() -> Iterator[None]:
    """Close all figures after a test."""
    yield
    plt.close("all")


def test_every_figure_has_a_width() -> None:
    """One panel takes axes, too."""
    for name in CODE:
        parameters = signature(getattr(plot, name)).parameters
        assert "width" in parameters, name
        panels = signature(getattr(plot, name)).return_annotation == "Figure"
        assert panels != ("ax" in parameters), name


@pytest.mark.slow
@pytest.mark.parametrize("width", [None, "page", "column"])
@pytest.mark.parametrize("name", CODE)
def test_no_text_is_cut_or_overlaps(name: str, width: sizes.Width | None) -> None:
    figure = drawn(name, **({} if width is None else {"width": width}))
    if width is not None:
        assert figure.get_size_inches()[0] == pytest.approx(theme.WIDTHS[width])
    assert faults(figure) == []


@pytest.mark.slow
@pytest.mark.parametrize("user", ["default", "dark_background", "ggplot"])
@pytest.mark.parametrize("name", CODE)
def test_a_file_has_the_theme(name: str, user: str) -> None:
    shades = theme.colour_map("order")(np.linspace(0.0, 1.0, 256))[:, :3]
    with plt.style.context(user):
        figure = drawn(name)
        svg, pdf = io.StringIO(), io.BytesIO()
        figure.savefig(svg, format="svg")
        figure.savefig(pdf, format="pdf")
    text = svg.getvalue()
    colours = {c.lower() for c in re.findall(r"(?:stroke|fill): (#\w{6})", text)}
    assert not colours & OUTSIDE
    assert "<text" in text
    assert b"/Type3" not in pdf.getvalue()
    assert sum(to_rgb(figure.get_facecolor())) > 2.9
    for line in figure.findobj(Line2D):
        assert isinstance(line, Line2D)
        if str(line.get_color()) == "none":
            continue
        rgb = np.array(to_rgb(line.get_color()))
        grey = np.ptp(rgb) < NEAR
        stepped = np.abs(shades - rgb).max(axis=1).min() < NEAR
        assert grey or stepped or to_hex(rgb) in CURVES, (name, line.get_color())


#: Root-mean-square difference, of 255, up to which a picture of the book is the one of the code.
ALIKE = 8.0


@pytest.mark.slow
@pytest.mark.parametrize("name", CODE)
def test_the_sheet_of_the_book_is_as_new_as_the_code(name: str, tmp_path: Path) -> None:
    """``python tools/plot_page.py`` draws the sheet anew: look at it."""
    plot_page.picture(eval(CODE[name], names()), tmp_path / "now.png")
    picture = plot_page.PICTURES / f"{name}.png"
    assert compare_images(str(picture), str(tmp_path / "now.png"), tol=ALIKE) is None


@pytest.mark.slow
def test_the_cards_of_the_book_are_as_new_as_the_code(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    cards = plot_page.PICTURES.parent / "cards"
    monkeypatch.setattr(plot_page, "PICTURES", tmp_path / "plots")
    plot_page.draw_cards(names())
    for name in plot_page.CARDS:
        drawn_now = str(tmp_path / "cards" / f"{name}.png")
        assert compare_images(str(cards / f"{name}.png"), drawn_now, tol=ALIKE) is None, name


def lightness(colour: str) -> float:
    """CIE L* of a colour, as it is seen in grey print."""
    rgb = np.array(to_rgb(colour))
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    Y = float(linear @ [0.2126, 0.7152, 0.0722])
    return 116.0 * np.cbrt(Y) - 16.0 if Y > 0.008856 else 903.3 * Y


#: Deuteranopia at full severity in linear RGB: G. M. Machado, M. M. Oliveira, L. A. F. Fernandes,
#: IEEE Trans. Vis. Comput. Graph. 15 (2009) 1291-1298, table 1.
DEUTERANOPIA = np.array(
    [
        [0.367322, 0.860646, -0.227968],
        [0.280085, 0.672501, 0.047413],
        [-0.011820, 0.042940, 0.968881],
    ]
)


def seen(colour: str, *, deuteranope: bool) -> float:
    """Lightness of a colour, for a reader without receptors for green."""
    if not deuteranope:
        return lightness(colour)
    rgb = np.array(to_rgb(colour))
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    linear = np.clip(DEUTERANOPIA @ linear, 0.0, 1.0)
    back = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    return lightness(to_hex(np.clip(back, 0.0, 1.0)))


@pytest.mark.parametrize("deuteranope", [False, True])
@pytest.mark.parametrize("colours", [theme.CATEGORIES, theme.ON_DARK], ids=["light", "dark"])
def test_neighbouring_curves_differ_in_lightness(
    colours: tuple[str, ...], *, deuteranope: bool
) -> None:
    steps = [seen(colour, deuteranope=deuteranope) for colour in (*colours, colours[0])]
    assert np.abs(np.diff(steps)).min() >= 15.0, np.diff(steps)


def test_areas_differ_in_lightness_or_are_hatched() -> None:
    from pyfret.plot.areas import HATCHES

    areas = (theme.NEUTRAL, theme.SAFE, theme.MIDDLE, theme.DANGER)
    for n, first in enumerate(areas):
        for second in areas[n + 1 :]:
            differ = abs(lightness(first) - lightness(second)) >= 15.0
            hatched = HATCHES.get(first) != HATCHES.get(second)
            assert differ or hatched or {first, second} == {theme.NEUTRAL, theme.MIDDLE}


@pytest.mark.parametrize("kind", theme.MAPS)
def test_maps_of_colours_are_even_in_grey(kind: theme.Kind) -> None:
    """Sequential maps go in one direction; a diverging one is lightest in the middle."""
    shades = [lightness(to_hex(theme.colour_map(kind)(x))) for x in np.linspace(0.0, 1.0, 33)]
    steps = np.diff(shades)
    if kind == "diverging":
        assert (steps[:15] > 0.0).all()
        assert (steps[-15:] < 0.0).all()
        assert max(shades[0], shades[-1]) < max(shades) - 35.0
    else:
        assert (steps < 0.0).all() or (steps > 0.0).all()
        assert abs(shades[0] - shades[-1]) > 40.0


def test_a_width_belongs_to_a_new_figure() -> None:
    _, ax = plt.subplots()
    with pytest.raises(ValueError, match="width: belongs to a new figure"):
        plot.haigh_diagram(None, width="page", ax=ax)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match='must be "column" or "page"'):
        plot.haigh_diagram(None, width="wide")  # type: ignore[arg-type]
