"""Figures keep their theme on saving, show signs, and do not hide how few increments there are."""

from __future__ import annotations

import io
import re
import subprocess
import sys
from functools import cache
from itertools import cycle

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.colors import to_hex, to_rgb
from matplotlib.text import Text

import pyfret as fret
from pyfret._util.theme import CATEGORIES, MAPS, Kind, colour_map, plotly_scale
from pyfret.plot.histories import FEW
from pyfret.plot.stresses import contour_levels, is_signed

pytestmark = [
    pytest.mark.solves,
    # Thin layers on few cells are meant here.
    pytest.mark.filterwarnings("ignore::pyfret.errors.SceneWarning"),
]

#: The first colours of matplotlib, which are none of the theme.
OUTSIDE = {"#1f77b4", "#ff7f0e", "#2ca02c", "#d62728", "#9467bd"}
STYLES = ("default", "dark_background", "ggplot")


@cache
def coated(increments: int = 12) -> fret.Result:
    """Solve a ball on 3 um over 0.5 um on titanium that slides in both directions."""
    titanium = fret.material("titanium_6Al4V")
    hard, soft = fret.Elastic(E=450e9, nu=0.25), fret.Elastic(E=279e9, nu=0.21)
    layers = [fret.Coating(hard, thickness=3e-6), fret.Coating(soft, thickness=0.5e-6)]
    ball = fret.Body(fret.Elastic(E=380e9, nu=0.23), shape=fret.Sphere(R=8e-3))
    flat = fret.Body(titanium, coatings=layers)
    path = fret.LoadPath.start().normal(60.0, increments=1)
    path = path.cycles(1, delta_x=4e-6, increments=increments)
    grid = fret.Grid.from_spacing((32, 32), (12e-6, 12e-6))
    scene = fret.Scene(body1=ball, body2=flat, friction=0.6, grid=grid)
    return fret.solve(scene, path, save="all", progress=False)


FIGURES = {
    "stress_along_depth": lambda: fret.plot.stress_along_depth(
        coated().at(-1).stress(x=0.0, y=0.0)
    ),
    "stress_map": lambda: fret.plot.stress_map(coated().at(-1).stress()),
    "pressure_profile": lambda: fret.plot.pressure_profile(coated().at(-1)),
    "shear_profile": lambda: fret.plot.shear_profile(coated().at(-1)),
    "stick_slip": lambda: fret.plot.stick_slip(coated().at(-1)),
    "fretting_loop": lambda: fret.plot.fretting_loop(coated()),
    "stick_ratio": lambda: fret.plot.stick_ratio(coated()),
    "load_path": lambda: fret.plot.load_path(coated()),
}


@pytest.mark.usefixtures("without_layout")
@pytest.mark.parametrize(("name", "user"), list(zip(FIGURES, cycle(STYLES), strict=False)))
def test_a_saved_figure_keeps_the_theme(name: str, user: str) -> None:
    """`test_every_figure.py` has all figures under each of the styles."""
    with plt.style.context(user):
        axes = FIGURES[name]()
        figure = axes.figure
        svg, pdf = io.StringIO(), io.BytesIO()
        figure.savefig(svg, format="svg")
        figure.savefig(pdf, format="pdf")
        colours = {c.lower() for c in re.findall(r"(?:stroke|fill): (#\w{6})", svg.getvalue())}
        assert not colours & OUTSIDE
        assert "<text" in svg.getvalue()
        assert b"/Type3" not in pdf.getvalue()
        ground, label = figure.get_facecolor(), axes.xaxis.label.get_color()
        assert sum(to_rgb(ground)) > 2.9 > 1.0 > sum(to_rgb(label))
    plt.close("all")


def test_axes_of_the_user_get_colours_that_hold() -> None:
    _, ax = plt.subplots()
    fret.plot.stress_along_depth(coated().at(-1).stress(x=0.0, y=0.0), ax=ax)
    colours = {str(line.get_color())[:7] for line in ax.get_lines()}
    assert {c.lower() for c in CATEGORIES[:2]} <= colours
    plt.close("all")


def test_fields_of_both_signs_have_zero_in_the_middle() -> None:
    stress = coated().at(-1).stress()
    signed = 0
    for measure in ("s_xx", "s_yy", "s_zz", "s_xz", "s_1", "s_3", "von_mises"):
        field = stress.measure(measure).values
        steps, colours = contour_levels(field, 12)
        if is_signed(field):
            signed += 1
            assert colours is colour_map("diverging")
            assert steps[0] == -steps[-1]
            lightness = [sum(colours(x)[:3]) for x in (0.0, 0.5, 1.0)]
            assert lightness[1] > lightness[0] + 0.8
            assert lightness[1] > lightness[2] + 0.8
        else:
            assert colours is not colour_map("diverging")
    assert signed >= 3
    # Contours that are given keep the colours of one sign unless they are symmetric.
    assert contour_levels(np.array([[-1.0, 2.0]]), [-1.0, 0.0, 2.0])[1] is not colour_map(
        "diverging"
    )


@pytest.mark.parametrize("increments", [12, 4 * FEW])
def test_few_increments_have_dots(increments: int) -> None:
    for draw in (fret.plot.fretting_loop, fret.plot.stick_ratio, fret.plot.load_path):
        markers = {line.get_marker() for line in draw(coated(increments)).get_lines()}
        assert markers == ({"o"} if increments < FEW else {"None"}), draw.__name__
    plt.close("all")


def test_the_stick_ratio_steps_up_at_a_reversal() -> None:
    line = fret.plot.stick_ratio(coated()).get_lines()[0]
    t, ratio = (np.asarray(values) for values in line.get_data())
    steps = np.flatnonzero(np.diff(t) == 0.0)
    assert steps.size == 2
    assert (ratio[steps + 1] == 1.0).all()
    plt.close("all")


@pytest.mark.parametrize("name", ["stress_map", "stress_along_depth"])
def test_layers_on_a_stretched_axis_have_names(name: str) -> None:
    texts = " ".join(text.get_text() for text in FIGURES[name]().figure.findobj(Text))
    for word in ("coating 1", "coating 2", "substrate", "each layer has its own scale"):
        assert word in texts
    plt.close("all")


def test_a_mark_beyond_the_drawn_section_is_inside_the_axes() -> None:
    from pyfret.plot.style import mark

    for x, y in ((-2.0, 0.5), (3.0, 1.5), (0.2, -1.0), (0.5, 0.5)):
        for down in (False, True):
            _, ax = plt.subplots()
            ax.set_xlim(0.0, 1.0)
            ax.set_ylim(*((1.0, 0.0) if down else (0.0, 1.0)))
            mark(ax, (x, y), "worst point")
            for value, limits in ((x, ax.get_xlim()), (y, ax.get_ylim())):
                assert min(limits) <= value <= max(limits)
            assert ax.yaxis_inverted() == down
            if 0.0 <= x <= 1.0:
                assert ax.get_xlim() == (0.0, 1.0)
            plt.close("all")


@pytest.mark.parametrize("kind", MAPS)
def test_colours_are_the_ones_of_cmcrameri(kind: Kind) -> None:
    """They are read from its tables, without its import."""
    cm = pytest.importorskip("cmcrameri.cm")
    name, low, high = MAPS[kind]
    expected = getattr(cm, name)(np.linspace(low, high, 256))
    np.testing.assert_allclose(colour_map(kind).colors, expected[:, :3], atol=1e-12)
    shades = [text for _, text in plotly_scale(kind)]
    assert shades == [to_hex(c) for c in colour_map(kind)(np.linspace(0.0, 1.0, 17))]


@pytest.mark.parametrize(
    ("module", "left_out"),
    [
        ("pyfret", ("matplotlib.pyplot", "cmcrameri", "plotly", "scipy")),
        ("pyfret.plot", ("cmcrameri", "matplotlib.animation", "matplotlib.patheffects", "plotly")),
    ],
)
def test_an_import_leaves_out_what_single_figures_need(
    module: str, left_out: tuple[str, ...]
) -> None:
    code = f"import sys, {module}; print([m for m in {left_out!r} if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
