"""Every figure is drawn without a screen and shows its numbers."""

from __future__ import annotations

import sys
import types
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest
import xarray as xr
from PIL import Image

import pyfret as fret
from conftest import paper_path, sphere_on_flat

pytestmark = pytest.mark.solves


def test_the_loop_starts_at_the_end_of_indentation(coated: fret.Result) -> None:
    (line,) = fret.plot.fretting_loop(coated, label="2").lines
    assert line.get_xdata()[0] == 0.0
    np.testing.assert_allclose(np.max(line.get_ydata()), 0.9)


def test_the_first_figure_of_a_notebook_leaves_it_interactive(coated: fret.Result) -> None:
    """The backend of a notebook turns it on when the first figure is made, within the look."""
    plt.ioff()
    try:
        with fret.plot.style():
            plt.ion()
        assert plt.isinteractive()
        fret.plot.fretting_loop(coated)
        assert plt.isinteractive()
        plt.ioff()
        fret.plot.fretting_loop(coated)
        assert not plt.isinteractive()
    finally:
        plt.ioff()


def test_a_notebook_shows_a_figure_once(
    coated: fret.Result, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It shows the value of a cell, and then every figure that is open."""
    shown: list[bytes] = []
    notebook = types.ModuleType("IPython.display")
    vars(notebook).update(Image=bytes, display=shown.append)
    monkeypatch.setitem(sys.modules, "IPython.display", notebook)
    monkeypatch.setattr("matplotlib.get_backend", lambda: "inline")
    figure = fret.plot.envelope_maps(coated.envelope([0.0, 1e-5], y=0.0))
    assert plt.fignum_exists(figure.number)  # type: ignore[attr-defined]
    figure._ipython_display_()  # type: ignore[attr-defined]
    assert not plt.fignum_exists(figure.number)  # type: ignore[attr-defined]
    (picture,) = shown
    assert picture.startswith(b"\x89PNG")


def test_depths_given_on_both_sides_of_an_interface_are_one_line(coated: fret.Result) -> None:
    pair = coated.at(-1).stress().dataset.z.values
    figure = fret.plot.envelope_maps(coated.envelope(pair, y=0.0))
    dashed = [line for line in figure.axes[0].lines if line.get_linestyle() == "--"]
    assert len(dashed) == 1


def test_the_map_shows_stick_inside_slip(coated: fret.Result) -> None:
    ax = fret.plot.stick_slip(coated.at(-1))
    zones = np.asarray(ax.images[0].get_array())
    middle = zones.shape[0] // 2
    assert zones[middle, middle] == 2
    assert zones[0, 0] == 0
    assert 1 in zones


def test_profiles_are_dimensionless(coated: fret.Result) -> None:
    (pressure,) = fret.plot.pressure_profile(coated.at(-1)).lines
    (shear,) = fret.plot.shear_profile(coated.at(-1)).lines
    assert 1.1 < np.max(pressure.get_ydata()) < 1.25
    assert np.max(shear.get_ydata()) < np.max(pressure.get_ydata())


def test_curves_can_be_laid_over_each_other(coated: fret.Result) -> None:
    ax = fret.plot.stick_ratio(coated, label="a")
    assert fret.plot.stick_ratio(coated, ax=ax, label="b") is ax
    assert len(ax.lines) == 2


def test_the_load_path_can_be_drawn_before_it_is_run() -> None:
    ax = fret.plot.load_path(paper_path(), mu=0.3)
    assert np.max(ax.lines[0].get_ydata()) == 1.0


def test_streamlines(coated: fret.Result) -> None:
    assert fret.plot.shear_streamlines(coated.at(0.1)).collections


def test_the_users_own_settings_stay_as_they_were(coated: fret.Result) -> None:
    before = dict(plt.rcParams)
    fret.plot.fretting_loop(coated)
    assert dict(plt.rcParams) == before


@pytest.mark.usefixtures("without_layout")
def test_the_figures_of_the_paper_in_one_call(coated: fret.Result, tmp_path: Path) -> None:
    saved = coated.dataset.saved_increment.values.tolist()
    results = {2.0: coated}
    for ratio in (0.5, 1.0, 4.0):
        scene = sphere_on_flat(ratio=ratio)
        results[ratio] = fret.solve(scene, coated.scene.path, save=saved, progress=False)
    jump = fret.LoadPath.start().normal(1e3, increments=1)
    figures = fret.plot.paper_figures(
        results, tmp_path, jump=fret.solve(sphere_on_flat(ratio=2.0), jump, progress=False)
    )
    numbers = ["04", "05", "06", "07a", "07b", "07c", "08", "09", "10", "11", "12", "13"]
    assert [figure.name for figure in figures] == [f"figure_{n}.png" for n in numbers]
    for figure in figures:
        with Image.open(figure) as image:
            assert min(image.size) > 500
            assert len(image.convert("L").getcolors() or []) > 20, f"{figure.name} is empty"


def test_text_of_others_is_shown_as_it_is_in_figures_of_studies() -> None:
    """Names of parameters and meanings of measures: no formula, no turn of the reading."""
    values = xr.DataArray(
        [1.0, 2.0, 3.0],
        {"a$b\u202e": [1.0, 2.0, 3.0]},
        ("a$b\u202e",),
        attrs={"long_name": "x$^{y\u202e", "units": "1"},
    )
    study = fret.study.Study(
        xr.Dataset({"of": values, "status": xr.ones_like(values).astype(np.int8)})
    )
    axes = fret.plot.study_map(study, "of")
    assert axes.get_xlabel() == r"a\$b\u202e"
    assert axes.get_ylabel() == r"x\$^{y\u202e"
    axes.figure.canvas.draw()


@pytest.mark.parametrize(("noise", "contours"), [(0.0, True), (0.01, True), (0.1, False)])
def test_scatter_of_a_study_is_drawn_in_cells(noise: float, *, contours: bool) -> None:
    """Values from 0 to 2 in ten contours: islands would show a scatter of half a contour."""
    x, y = np.meshgrid(np.linspace(0.0, 1.0, 20), np.linspace(0.0, 1.0, 10), indexing="ij")
    scattered = x**2 + np.sin(2.0 * y) + noise * np.random.default_rng(5).normal(size=x.shape)
    item = xr.DataArray(scattered, {"a": x[:, 0], "b": y[0]}, name="of")
    status = xr.full_like(item, 1, dtype=np.int8).rename("status")
    drawn = fret.study.Study(xr.merge([item, status])).map("of").collections[0]
    assert hasattr(drawn, "levels") == contours
