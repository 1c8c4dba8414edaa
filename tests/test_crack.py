"""Cracks below a contact: intensities, growth, arrest, maps, the command line."""

from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING

import matplotlib as mpl
import numpy as np
import pytest
import xarray as xr
from matplotlib.text import Text

import pyfret as fret
from conftest import SAME_PROCESS
from pyfret import fracture
from pyfret._cli import commands
from pyfret._util.scene_warnings import doubts_of
from pyfret.report.crack import CrackSection

if TYPE_CHECKING:
    from pathlib import Path

mpl.use("Agg")

STEEL = fret.Elastic(E=210e9, nu=0.3)
F_0 = 1.121522255231


@pytest.fixture(scope="module")
def rig() -> fret.Result:
    """A pad on a flat under half of the sliding force, back and forth."""
    W, mu, a = 2e5, 0.6, 3.3e-4
    scene = fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Cylinder(R=0.05)),
        body2=fret.Body(STEEL),
        friction=mu,
        grid=fret.Grid.strip(extent=3 * a, n=96),
    )
    T = 0.5 * mu * W
    path = fret.LoadPath.start().normal(W, increments=2).tangential([T, -T, T], increments=24)
    return fret.solve(scene, path, save="all")


@pytest.fixture(scope="module")
def pulled(rig: fret.Result) -> fret.Result:
    """Solve the same with a bulk stress in phase, from 0 to 200 MPa."""
    path = fret.LoadPath.start().normal(2e5, increments=2)
    for T, bulk in ((3e4, 200e6), (-3e4, 0.0), (3e4, 200e6)):
        path = path.force(T_x=T, sigma_B=bulk, increments=6)
    return fret.solve(rig.scene, path, save="all", progress=False)


@pytest.mark.solves
def test_the_worse_rim_is_the_trailing_one_and_short_cracks_stop(rig: fret.Result) -> None:
    cracks = rig.crack()
    assert abs(abs(cracks.dataset.attrs["x"]) / rig.a_H - 1.0) < 0.05
    # The force goes to and fro: both rims are trailing ones, each rim gives the range.
    mirrored = rig.crack(-cracks.dataset.attrs["x"], lengths=cracks.lengths)
    assert mirrored.dK() == pytest.approx(cracks.dK(), rel=0.05)
    dK = cracks.dK()
    assert np.all(cracks.dataset.K_I >= 0.0)
    low, high = 0.5 * dK.max(), 2.0 * dK.max()
    stops = cracks.arrest(fracture.Threshold(low), start=float(cracks.lengths[dK.argmax()]))
    assert stops.verdict == "stops"
    assert stops.margin < 1.0
    assert cracks.arrest(fracture.Threshold(high)).verdict == "dormant"
    life = cracks.life(
        fracture.Threshold(low),
        fracture.Paris(C=1e-11, m=3.0),
        start=float(cracks.lengths[dK.argmax()]),
    )
    assert life.stopped
    assert 0.0 < life.cycles < np.inf
    assert life.length == pytest.approx(stops.length)


def test_bulk_tension_opens_a_crack_as_it_should(pulled: fret.Result) -> None:
    """Far below a contact the bulk stress alone is left: checked by a run with it."""
    cracks = pulled.crack(lengths=[1e-5, 1e-4, 1e-3, 3e-3])
    K = F_0 * 200e6 * np.sqrt(np.pi * 3e-3)
    assert cracks.K_max[-1] == pytest.approx(K, rel=0.15)


@pytest.mark.slow
def test_growth_below_a_contact(rig: fret.Result, pulled: fret.Result) -> None:
    """The path settles; a straight first crack of the path has the K of a straight crack."""
    grown = pulled.grow_crack(start=2e-5, end=2e-4, angle=0.4, tolerance=0.05)
    data = grown.dataset
    assert data.attrs["end"] == "reached"
    assert grown.lengths[0] == pytest.approx(2e-5)
    assert grown.lengths[-1] == pytest.approx(2e-4)
    assert data.attrs["path_error"] < 0.05 * 1.8e-4
    straight = pulled.crack(data.attrs["x"], lengths=[2e-5], angle=0.4)
    assert grown.K_max[0] == pytest.approx(straight.K_max[0], rel=1e-4)
    # It turns towards the normal of the tension, and its tips are as far apart as it is long.
    steps = np.hypot(np.diff(data.x), np.diff(data.z))
    assert steps.sum() == pytest.approx(1.8e-4, rel=1e-2)
    assert abs(data.x[-1] - data.x[-2]) < 0.2 * (data.z[-1] - data.z[-2])
    finer = pulled.grow_crack(start=2e-5, end=2e-4, angle=0.4, tolerance=0.01)
    off = np.hypot(finer.dataset.x[-1] - data.x[-1], finer.dataset.z[-1] - data.z[-1])
    assert off <= data.attrs["path_error"]
    assert grown.arrest(fracture.Threshold(1e3)).verdict == "grows"
    # Without bulk stress a crack that shear has taken over ends before its length.
    alone = rig.grow_crack(start=2e-5, end=2e-4, angle=0.4, tolerance=0.05)
    assert alone.dataset.attrs["end"] != "reached"
    assert alone.lengths[-1] < 1.9e-4


@pytest.mark.solves
def test_a_kink_is_that_of_the_plain_crack(rig: fret.Result) -> None:
    x = -rig.a_H
    lengths = [3e-5, 1e-4]
    kinked = rig.crack(x, lengths=lengths, kink=(5e-5, 0.5)).dataset
    straight = rig.crack(x, lengths=lengths).dataset
    # Those that end before the kink are straight ones.
    close = 1e-4 * float(straight.K_I.max())
    assert kinked.K_I[:, 0].values == pytest.approx(straight.K_I[:, 0].values, abs=close)
    assert float(kinked.x[1] - x) == pytest.approx(5e-5 * np.sin(0.5))
    # A kink that does not turn is none.
    plain = rig.crack(x, lengths=[1e-4], kink=(5e-5, 0.0)).dataset
    assert plain.K_I_linear[:, 0].values == pytest.approx(
        straight.K_I_linear[:, 1].values, abs=close
    )
    assert float(abs(kinked.K_II_linear[:, 1] - straight.K_II_linear[:, 1]).max()) > 1e5
    with pytest.raises(ValueError, match="kink"):
        rig.crack(x, lengths=lengths, kink=(-5e-5, 0.5))


@pytest.mark.solves
def test_the_deepest_point_of_a_crack_under_a_ball() -> None:
    """A load along y turns the plane; the estimate is the plane value times the factor."""
    ball = fret.Body(STEEL, shape=fret.Sphere(R=5e-3))
    scene = fret.Scene(
        body1=ball, body2=fret.Body(STEEL), friction=0.5, grid=fret.Grid.centred(width=3.2e-4, n=20)
    )
    W, T = 20.0, 6.0

    def sheared(along: str) -> fret.Result:
        path = fret.LoadPath.start().normal(W, increments=2)
        for force, increments in ((T, 3), (-T, 5), (T, 5)):
            path = path.force(**{along: force}, increments=increments)
        return fret.solve(scene, path, save="all", progress=False)

    lengths = [1e-5, 3e-5]
    along_x, along_y = sheared("T_x"), sheared("T_y")
    plane = along_x.crack(lengths=lengths)
    turned = along_y.crack(plane.dataset.attrs["x"], lengths=lengths)
    assert plane.dataset.attrs["azimuth"] == 0.0
    assert turned.dataset.attrs["azimuth"] == pytest.approx(np.pi / 2)
    assert turned.K_max == pytest.approx(plane.K_max, rel=1e-3)
    estimate = along_x.crack(plane.dataset.attrs["x"], lengths=lengths, aspect=1.0)
    assert pytest.approx(0.590752 * plane.K_max, rel=1e-5) == estimate.K_max
    largest = estimate.dataset.isel(
        increment=int(estimate.dataset.K_I.values[:, 0].argmax()), length=0
    )
    assert float(largest.error) > 0.05 * float(largest.K_I)
    with pytest.raises(ValueError, match="aspect"):
        along_x.crack(lengths=lengths, aspect=2.0)


@pytest.mark.slow
def test_film_interface_or_substrate(rig: fret.Result) -> None:
    film = fret.Coating(fret.Elastic(E=400e9, nu=0.25), thickness=1e-5)
    scene = rig.scene.replace(body2=fret.Body(STEEL, coatings=[film]), path=rig.scene.path)
    result = fret.solve(scene, save="all", progress=False)
    limits = {
        "toughness": 20.0,
        "peel_strength": 500e6,
        "shear_strength": 500e6,
        "threshold": fracture.Threshold(2e6, 200e6),
        "lengths": [2e-5, 5e-5, 1e-4, 3e-4],
    }
    plain = fracture.first_to_fail(result, **limits)
    pulled = fracture.first_to_fail(result, **limits, residual=[2e9, 0.0])
    pressed = fracture.first_to_fail(result, **limits, residual=[-5e9, 0.0])
    # Residual stress loads the film alone of the first two; half the energy, a root of two more.
    assert pulled.film > plain.film > 0.0
    assert pulled.interface == plain.interface > 0.0
    assert pressed.film == 0.0
    tougher = fracture.first_to_fail(result, toughness=40.0)
    assert plain.film / tougher.film == pytest.approx(np.sqrt(2.0))
    assert np.isnan(tougher.substrate)
    assert pulled.first == "film"
    computed = fret.study.FirstToFail(**limits, residual=[2e9, 0.0])(result)
    assert int(computed["first"]) == 1
    with pytest.raises(ValueError, match="no coating"):
        fracture.first_to_fail(rig, toughness=1.0)


@pytest.mark.solves
def test_the_arrest_map_holds_what_each_point_gives(rig: fret.Result) -> None:
    scene = rig.scene.replace(grid=fret.Grid.strip(extent=1e-3, n=64))
    arrest = fret.study.Arrest(fracture.Threshold(3e6, 300e6))
    table = fret.study.arrest_map(
        scene, W=2e5, T=[3e4, 9e4, 2e5], sigma_B=[0.0, 2e8], arrest=arrest, executor=SAME_PROCESS
    )
    assert table.arrest_margin.dims == ("T", "sigma_B")
    assert np.isnan(table.arrest_margin[2]).all()
    # Without bulk stress every crack stops, whatever the threshold: deep down nothing opens it.
    assert (table.arrest_margin[:2, 0] < 1.0).all()
    assert table.arrest_length[1, 0] > table.arrest_length[0, 0]
    assert (table.arrest_margin[:2, 1] > table.arrest_margin[:2, 0]).all()
    path = fret.LoadPath.start().normal(2e5, increments=2)
    for T, bulk, increments in ((9e4, 2e8, 4), (-9e4, 0.0, 8), (9e4, 2e8, 8)):
        path = path.force(T_x=T, sigma_B=bulk, increments=increments)
    alone = fret.solve(scene, path, save="all", progress=False).crack()
    margin = alone.arrest(arrest.threshold).margin
    assert float(table.arrest_margin[1, 1]) == pytest.approx(margin, rel=1e-9)
    ax = fret.plot.arrest_map(table)
    assert "stops" in [text.get_text() for text in ax.get_legend().get_texts()]


@pytest.mark.solves
def test_the_running_map_has_the_lengths_at_which_cracks_stop(rig: fret.Result) -> None:
    scene = rig.scene.replace(grid=fret.Grid.strip(extent=1e-3, n=64))
    arrest = fret.study.Arrest(fracture.Threshold(2e6, 300e6), lengths=[5e-6, 2e-5, 1e-4, 4e-4])
    table = fret.study.running_conditions(
        scene,
        W=[1.5e5, 2e5],
        T=[6e4, 8e4, 1e5],
        increments=(2, 6),
        arrest=arrest,
        executor=SAME_PROCESS,
    )
    length = table.arrest_length.transpose("W", "T").values
    # More shear takes them deeper; at 1e5 N the smaller force slides.
    assert (length[:, 1] > length[:, 0]).all()
    assert np.isnan(length[0, 2])
    assert (table.arrest_margin.values[np.isfinite(table.arrest_margin)] < 1.0).all()
    ax = fret.plot.fretting_map(table)
    labels = [text.get_text() for text in ax.get_legend().get_texts()]
    assert any(label.startswith("crack stops at [µm], within") for label in labels), labels


@pytest.mark.solves
def test_bulk_stress_moves_the_line_of_arrest_in_the_running_map(rig: fret.Result) -> None:
    scene = rig.scene.replace(grid=fret.Grid.strip(extent=1e-3, n=64))
    arrest = fret.study.Arrest(fracture.Threshold(3e6, 300e6), lengths=[5e-6, 2e-5, 1e-4, 4e-4])
    loads = {"W": [1.5e5, 2e5], "T": [3e4, 8e4], "increments": (2, 8), "executor": SAME_PROCESS}
    table = fret.study.running_conditions(scene, **loads, sigma_B=[0.0, 2e8], arrest=arrest)
    assert set(table.arrest_margin.dims) == {"W", "T", "sigma_B"}
    assert table.sigma_B.attrs["units"] == "Pa"
    assert (table.arrest_margin.sel(sigma_B=2e8) > table.arrest_margin.sel(sigma_B=0.0)).all()
    item = fret.study.running_conditions(scene, **loads, sigma_B=2e8, arrest=arrest)
    assert item.attrs["sigma_B"] == 2e8
    np.testing.assert_allclose(
        item.arrest_margin, table.arrest_margin.sel(sigma_B=2e8).transpose(*item.arrest_margin.dims)
    )
    # A point equals the map of shear and bulk stress.
    chart = fret.study.arrest_map(
        scene,
        W=2e5,
        T=[8e4],
        sigma_B=[2e8],
        arrest=arrest,
        increments=(2, 8),
        executor=SAME_PROCESS,
    )
    margin = float(item.arrest_margin.sel(W=2e5, T=8e4))
    assert margin == pytest.approx(float(chart.arrest_margin[0, 0]), rel=1e-9)
    ax = fret.plot.running_map(table.sel(sigma_B=0.0))
    labels = [text.get_text() for text in ax.get_legend().get_texts()]
    assert any(label.startswith("crack stops at [µm], ±") for label in labels), labels
    with pytest.raises(ValueError, match="must be 0 with shifts"):
        fret.study.running_conditions(
            scene, W=[1e5], delta=[1e-6], sigma_B=1e8, executor=SAME_PROCESS
        )


@pytest.mark.solves
def test_figures(rig: fret.Result) -> None:
    cracks, threshold = rig.crack(), fracture.Threshold(2e6, 200e6)
    for ax in (
        fret.plot.intensity_history(cracks, 1e-4),
        fret.plot.crack_arrest(cracks, threshold),
        fret.plot.kitagawa(cracks, threshold),
    ):
        assert ax.get_xlabel()
        assert ax.lines
    panels = fret.plot.crack_panels(rig, cracks, threshold)
    section = panels.axes[0]
    # The crack stands where it is, in the units of the section.
    crack = next(line for line in section.lines if line.get_zorder() == 4)
    x = cracks.dataset.attrs["x"]
    assert abs(crack.get_xdata()[0]) == pytest.approx(abs(x) * 1e6, rel=1e-6)
    table = xr.Dataset(
        {
            name: (("h", "s"), values)
            for name, values in {
                "film": [[0.5, 1.5], [0.5, 2.0]],
                "interface": [[0.2, 0.2], [1.2, 1.2]],
                "substrate": [[0.1, 0.1], [0.1, 0.1]],
                "first": [[0, 1], [2, 1]],
            }.items()
        },
        coords={"h": [1.0, 2.0], "s": [0.0, 1.0]},
    )
    chart = fret.plot.design_chart(table, "s", "h")
    by_name = [text.get_text() for text in chart.get_legend().get_texts()]
    nearest = "nearest to failure:"
    assert by_name[:3] == ["nothing fails", f"{nearest} film", f"{nearest} interface"]
    assert "the film fails beyond" in by_name


@pytest.mark.solves
def test_command(pulled: fret.Result, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    store = tmp_path / "rig.nc"
    pulled.save(store)
    figure = tmp_path / "crack.png"
    lengths = "1e-5,3e-5,1e-4,3e-4"
    message = ["crack", str(store), "--lengths", lengths, "--dK-th", "2e6", "-o", str(figure)]
    assert commands.main(message) == 0
    output = capsys.readouterr().out
    assert output.count("MPa m^0.5") == 4
    assert "dK/dK_th" in output
    assert "would" in output or "grows through" in output
    assert figure.stat().st_size > 0
    assert commands.main(["crack", str(store), "--dS-0", "1e8"]) == 2
    assert "--dK-th" in capsys.readouterr().err
    grown = ["crack", str(store), "--grow", "tangential_stress", "--lengths", "1e-4,2e-4"]
    assert commands.main([*grown, "--dK-th", "1e3", "--paris", "1e-11,3"]) == 0
    output = capsys.readouterr().out
    rows = [line for line in output.splitlines() if re.match(r"\s*[\d.]+ um ", line)]
    assert len(rows) >= 9, output
    assert output.count("MPa m^0.5") == 4
    assert " cycles" in output
    kinked = ["crack", str(store), "--lengths", lengths, "--kink", "5e-5,20", "--aspect", "0.8"]
    assert commands.main(kinked) == 0
    assert commands.main([*grown, "--kink", "5e-5,20"]) == 2
    assert "--grow" in capsys.readouterr().err


@pytest.mark.solves
@pytest.mark.usefixtures("without_overview")
@pytest.mark.parametrize("dK_th", ["2e4", "4e6", "3e7"])
def test_command_figure_page_and_json_have_one_verdict(
    pulled: fret.Result, tmp_path: Path, capsys: pytest.CaptureFixture[str], dK_th: str
) -> None:
    pulled.save(tmp_path / "rig.nc")
    message = ["crack", str(tmp_path / "rig.nc"), "--lengths", "1e-5,3e-5,1e-4,3e-4"]
    message += ["--dK-th", dK_th, "--paris", "1e-11,3"]
    assert commands.main(message) == 0
    line = capsys.readouterr().out.splitlines()[0]
    assert commands.main([*message, "--json"]) == 0
    row = json.loads(capsys.readouterr().out.splitlines()[-1])
    cracks = pulled.crack(lengths=[1e-5, 3e-5, 1e-4, 3e-4])
    threshold = fracture.Threshold(float(dK_th))
    arrest = cracks.arrest(threshold)
    assert row["told"] == arrest.describe()
    assert arrest.describe() in line
    assert f"from x = {1e6 * row['x']:.4g} um" in line
    assert (row["length"] is None) == ("length_why" in row)
    drawn = fret.plot.crack_panels(pulled, cracks, threshold)
    options = {text.get_text() for text in drawn.findobj(Text)}
    brief = arrest.briefly().replace(" um", " µm").replace("+-", "±")
    assert f"the crack {brief}" in options
    assert any("stops" in text for text in options) == (arrest.verdict == "stops")
    page = tmp_path / "page.html"
    pulled.report(page, crack=cracks, threshold=threshold)
    assert (
        CrackSection(cracks, threshold)
        .numbers()["says"]
        .endswith(f" body {arrest.describe()}.".replace(" um", " µm").replace("+-", "±"))
    )


@pytest.mark.solves
def test_a_note_on_estimates_stands_once_in_a_line(
    pulled: fret.Result, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pulled.save(tmp_path / "rig.nc")
    message = ["crack", str(tmp_path / "rig.nc"), "--lengths", "1e-5,3e-5,1e-4,3e-4"]
    assert commands.main([*message, "--material", "titanium_6Al4V", "--paris", "1e-11,3"]) == 0
    assert capsys.readouterr().out.count("estimate: ") == 1


def test_an_angle_in_degrees_is_refused_in_radians(pulled: fret.Result) -> None:
    with pytest.raises(
        fret.errors.InvalidSceneError, match=r"angle of the crack = 20: must be in radians"
    ):
        pulled.crack(angle=20.0)
    assert "angles are in radians" in doubts_of("crack", azimuth=45.0)[0]


def test_what_becomes_of_a_crack_is_a_sentence_with_units(pulled: fret.Result) -> None:
    cracks = pulled.crack()
    threshold = fracture.Threshold(dK_th=1e6)
    assert repr(cracks.arrest(threshold)).startswith("CrackArrest(grows through all lengths")
    life = cracks.life(threshold, fracture.Paris(C=1e-11, m=3.0))
    assert repr(life).endswith(" um)")
    assert "cycles from 3.323 um to" in repr(life)
