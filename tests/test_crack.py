"""Cracks: below a contact and under plain histories; thresholds, arrest, the command line."""

from __future__ import annotations

import copy
import json
import pickle
import re
from typing import TYPE_CHECKING

import matplotlib as mpl
import numpy as np
import pytest
import xarray as xr
from matplotlib.text import Text

import pyfret as fret
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


def test_uniform_tension_on_a_normal_crack() -> None:
    crack = fracture.Crack(legs=[(1e-4, 0.0)])
    stress = np.zeros((2, len(crack.points), 6))
    stress[0, :, 0] = 100e6
    K = crack.intensity(stress)
    assert K["K_I"][0] == pytest.approx(F_0 * 100e6 * np.sqrt(np.pi * 1e-4), rel=1e-7)
    assert K["error"][0] < 1e-6 * K["K_I"][0]
    stress[1, :, 0] = -50e6
    closed = crack.intensity(stress, friction=0.3)
    assert closed["K_I"][1] == 0.0
    assert closed["open"].tolist() == pytest.approx([1.0, 0.0])
    with pytest.raises(ValueError, match="must be"):
        crack.intensity(stress[:, :-1])


@pytest.mark.solves
def test_cracks_are_values() -> None:
    crack = fracture.Crack(legs=[(1e-4, 0.0), (2e-4, 0.3)], x=-1e-3)
    for again in (pickle.loads(pickle.dumps(crack)), copy.copy(crack)):
        assert np.array_equal(again.points, crack.points)
    assert repr(crack) == "Crack(legs=[(0.0001, 0.0), (0.0002, 0.3)], x=-0.001)"
    with pytest.raises(ValueError, match="length"):
        fracture.Crack(legs=[(-1e-4, 0.0)])


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


def test_thresholds() -> None:
    haddad = fracture.Threshold(dK_th=2.1e6, dS_0=124e6)
    assert haddad.a_0 == pytest.approx(91.29465388e-6)
    assert haddad.range_at(1e-5) == pytest.approx(0.659821e6, rel=1e-5)
    assert fracture.Threshold(2.1e6).range_at([1e-6, 1.0]).tolist() == [2.1e6, 2.1e6]
    with pytest.raises(ValueError, match="dK_th"):
        fracture.Threshold(-1.0)
    unknown = fret.fatigue.Material("mine", [("s_D", 300e6, "a test")])
    with pytest.raises(ValueError, match="dK_th"):
        fracture.Threshold.from_material(unknown)
    own_material = fret.fatigue.Material(
        "mine", [("dK_th", 8e6, "a test"), ("s_D", 300e6, "another")]
    )
    assert fracture.Threshold.from_material(own_material) == fracture.Threshold(4e6, 300e6)


def test_growth_constants_of_the_table_of_materials() -> None:
    table = fret.fatigue.Materials()
    alloy = fracture.Threshold.from_material(table["aluminium_4Cu"])
    assert (alloy.dK_th, alloy.dS_0, alloy.walker) == (2.1e6, 124e6, None)
    assert alloy.a_0 == pytest.approx(91.29465388e-6)
    assert fracture.Paris.from_material(table["aluminium_7075_T6"]) == fracture.Paris(2.71e-11, 3.7)
    with pytest.raises(ValueError, match=r"aluminium_4Cu.*paris_C"):
        fracture.Paris.from_material(table["aluminium_4Cu"])
    own_material = fret.fatigue.Material(
        "mine", [("dK_th", 8e6, "a test"), ("s_D", 300e6, "one"), ("walker", 0.6, "another")]
    )
    assert fracture.Threshold.from_material(own_material).walker == 0.6
    assert fracture.Threshold.from_material(own_material, walker=0.9).walker == 0.9


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
def test_growth_under_a_plain_history() -> None:
    """Under tension to and fro an inclined crack turns normal to it, and K_II vanishes."""
    crack = fracture.Crack(legs=[(1e-4, np.radians(40))])

    def tension(points: np.ndarray) -> np.ndarray:
        stress = np.zeros((2, len(points), 6))
        stress[0, :, 0] = 100e6
        return stress

    grown = crack.grow(tension, end=5e-4)
    assert abs(grown["angle"][-1]) < 0.05
    assert np.abs(grown["K_II"][0, 1:]).max() < 3e-3 * grown["K_I"][0, -1]
    depth = grown["z"][-1]
    assert grown["K_I"][0, -1] == pytest.approx(F_0 * 100e6 * np.sqrt(np.pi * depth), rel=2e-2)
    assert grown["path_error"] < 1e-2 * 4e-4

    def wrong(points: np.ndarray) -> np.ndarray:
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        crack.grow(wrong, end=5e-4)
    with pytest.raises(ValueError, match="direction"):
        crack.grow(tension, end=5e-4, direction="down")  # type: ignore[arg-type]


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
        scene, W=2e5, T=[3e4, 9e4, 2e5], sigma_B=[0.0, 2e8], arrest=arrest, executor=1
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
        executor=1,
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
    loads = {"W": [1.5e5, 2e5], "T": [3e4, 8e4], "increments": (2, 8), "executor": 1}
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
        scene, W=2e5, T=[8e4], sigma_B=[2e8], arrest=arrest, increments=(2, 8), executor=1
    )
    margin = float(item.arrest_margin.sel(W=2e5, T=8e4))
    assert margin == pytest.approx(float(chart.arrest_margin[0, 0]), rel=1e-9)
    ax = fret.plot.running_map(table.sel(sigma_B=0.0))
    labels = [text.get_text() for text in ax.get_legend().get_texts()]
    assert any(label.startswith("crack stops at [µm], ±") for label in labels), labels
    with pytest.raises(ValueError, match="must be 0 with shifts"):
        fret.study.running_conditions(scene, W=[1e5], delta=[1e-6], sigma_B=1e8, executor=1)


def test_kitagawa_of_uniform_tension() -> None:
    lengths = np.geomspace(1e-6, 1e-3, 20)
    K = 100e6 * np.sqrt(np.pi * lengths)
    cracks = fracture.Cracks.from_arrays(lengths, K, 0 * K)
    diagram = cracks.kitagawa(fracture.Threshold(2.1e6, 124e6))
    assert diagram["load"].values == pytest.approx(100e6)
    assert diagram.limit.values[0] == pytest.approx(124e6, rel=1e-2)
    assert cracks.scaled(0.5).K_max == pytest.approx(0.5 * K)
    assert fracture.ellipse_factor(1.0) == pytest.approx(0.590752, rel=1e-5)


def test_films() -> None:
    film = fret.Coating(STEEL, thickness=4e-6)
    G = fracture.channel_release(film, STEEL, 1e9)
    assert pytest.approx(1.975766 * 1e18 * 4e-6 * 0.91 / 210e9, rel=1e-5) == G
    assert fracture.channel_release(film, STEEL, -1e9) == 0.0
    stiff = fret.Coating(fret.Elastic(E=300.0 * STEEL.E, nu=0.3), thickness=1e-6)
    with pytest.raises(ValueError, match="channel_release: no solution"):
        fracture.channel_release(stiff, STEEL, 1e9)
    K = fracture.film_intensity(film, STEEL, 2e-6, 1e9)
    assert pytest.approx(F_0 * 1e9 * np.sqrt(np.pi * 2e-6), rel=1e-6) == K
    with pytest.raises(ValueError, match="depth"):
        fracture.film_intensity(film, STEEL, 5e-6, 1e9)


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
    grown = ["crack", str(store), "--grow", "tangential_stress", "--lengths", "3e-5,2e-4"]
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


def test_what_becomes_of_a_crack_has_the_error_of_k() -> None:
    """K falls as 1/l: it stops where dK (1 +- 5 %) is the threshold, and the margin has 5 %."""
    lengths = np.geomspace(1e-5, 1e-3, 400)
    plain = fracture.Cracks.from_arrays(lengths, 3e6 * (1e-4 / lengths), np.zeros(400))
    error = (0.05 * plain.dataset.K_I).assign_attrs(units="Pa m^0.5")
    cracks = fracture.Cracks(plain.dataset.assign(error=error))
    threshold = fracture.Threshold(dK_th=3e6)
    without, arrest = plain.arrest(threshold), cracks.arrest(threshold)
    assert without.margin_error is None
    assert without.lengths is None
    assert "(estimate)" in without.describe()
    assert arrest.verdict == "stops"
    assert arrest.is_sure
    assert arrest.length == pytest.approx(1e-4, rel=2e-3)
    assert arrest.lengths == pytest.approx((0.95e-4, 1.05e-4), rel=2e-3)
    assert arrest.margin_error == pytest.approx(0.05 * arrest.margin, rel=1e-6)
    assert "100 (95 to 105) um" in arrest.describe()
    assert "+-" in arrest.describe()
    # At 1.02 times the threshold at its first length the error leaves two verdicts.
    unsure = cracks.arrest(fracture.Threshold(dK_th=3e7 / 1.02))
    assert (unsure.verdict, set(unsure.verdicts)) == ("stops", {"stops", "dormant"})
    assert "not decided within the error of K: it may not grow" in unsure.describe()
    assert "dK/dK_th 1.020 +- 0.051 at that length" in unsure.describe()
    assert not unsure.is_sure
    # The bar of the margin reaches over 1 where both of its ends grow: not decided.
    sure = cracks.arrest(fracture.Threshold(dK_th=2.9e5))
    assert (sure.verdict, sure.is_sure) == ("grows", False)
    assert "not decided within the error of K" in sure.briefly()


def bump(threshold: float = 1e6) -> fracture.Cracks:
    """K that is above a threshold of 1 MPa m^0.5 between about 17 and 92 um, 0.5 to 600 um."""
    lengths = np.geomspace(5e-6, 6e-4, 24)
    K = 2.0 * threshold * np.exp(-(np.log(lengths / 4e-5) ** 2))
    plain = fracture.Cracks.from_arrays(lengths, K, np.zeros(24))
    error = (0.1 * plain.dataset.K_I).assign_attrs(units="Pa m^0.5")
    return fracture.Cracks(plain.dataset.assign(error=error))


@pytest.mark.parametrize(
    ("start", "verdict", "words"),
    [
        (None, "dormant", ["from a length of 5 um, the shortest computed", "one of 17.4 um to 91"]),
        (2e-5, "stops", ["from a length of 20 um", "one shorter than 17.4 um would not grow"]),
        (1e-4, "dormant", ["from a length of 100 um", "one of 17.4 um to 91"]),
    ],
)
def test_a_verdict_says_for_which_length_it_holds_and_what_others_do(
    start: float | None, verdict: str, words: list[str]
) -> None:
    cracks, threshold = bump(), fracture.Threshold(dK_th=1e6)
    arrest = cracks.arrest(threshold, start=start)
    life = cracks.life(threshold, fracture.Paris(C=1e-11, m=3.0), start=start)
    assert arrest.verdict == verdict
    assert arrest.start == (5e-6 if start is None else start)
    ((low, high),) = arrest.growing
    assert (low, high) == pytest.approx((17.40e-6, 91.97e-6), rel=1e-3)
    for word in words:
        assert word in arrest.describe()
    assert arrest.describe().startswith(arrest.briefly())
    if verdict == "dormant":
        assert arrest.length is None
        assert arrest.tip == arrest.start
        assert "stop at 91.97 um" in repr(life)
        assert "no number of cycles" in life.describe()
        assert "does not grow" in str(life.why_infinite())
        # A crack of the length that it names does grow.
        longer = cracks.arrest(threshold, start=1.01 * low)
        assert longer.verdict == "stops"
        assert longer.length == pytest.approx(high)
    else:
        assert arrest.tip == arrest.length == pytest.approx(high)
        assert "cycles from 20 um to 91.97 um, where it stops" in life.describe()


def test_growth_through_all_lengths_and_through_none() -> None:
    cracks = bump()
    none = cracks.arrest(fracture.Threshold(dK_th=1e7))
    assert none.growing == ()
    assert "nor would one of any length up to 600 um" in none.describe()
    even = fracture.Cracks.from_arrays(cracks.lengths, np.full(24, 1e6), np.zeros(24))
    every = even.arrest(fracture.Threshold(dK_th=2e4))
    assert every.growing == ((5e-6, 6e-4),)
    assert every.describe().startswith(
        "grows through all lengths from a length of 5 um, the shortest computed, to 600 um; least"
    )


def test_an_error_as_large_as_the_number_is_told() -> None:
    cracks = bump()
    wide = cracks.dataset.assign(error=(1.2 * cracks.dataset.K_I).assign_attrs(units="Pa m^0.5"))
    arrest = fracture.Cracks(wide).arrest(fracture.Threshold(dK_th=1e6), start=4e-5)
    assert "the error of K is as large as dK" in arrest.describe()
    assert not arrest.is_sure


def test_what_rests_on_an_estimate_says_so() -> None:
    """Threshold, length, cycles, figures: the word stands at each; a measured one has none."""
    table = fret.fatigue.Materials()
    estimated = fracture.Threshold.from_material(table["titanium_6Al4V"])
    assert "dK_th" in str(estimated.estimate)
    measured = fracture.Threshold.from_material(table["aluminium_4Cu"])
    assert measured.estimate is None
    cracks = bump(estimated.dK_th)
    paris = fracture.Paris(C=1e-11, m=3.0)
    for threshold, marked in ((estimated, True), (measured, False)):
        arrest = cracks.arrest(threshold, start=4e-5)
        life = cracks.life(threshold, paris, start=4e-5)
        assert arrest.verdict == "stops"
        for text in (arrest.describe(), arrest.briefly(), arrest.describe_length(), repr(life)):
            assert ("estimate" in text) == marked, text
        axes = (
            fret.plot.crack_arrest(cracks, threshold, start=4e-5),
            fret.plot.kitagawa(cracks, threshold),
        )
        for ax in axes:
            legend = [text.get_text() for text in ax.get_legend().get_texts()]
            assert any("(estimate)" in item for item in legend) == marked


def test_too_few_lengths_are_refused_with_what_to_do() -> None:
    lengths = [1e-5, 1e-4]
    cracks = fracture.Cracks.from_arrays(lengths, [1e6, 2e6], [0.0, 0.0])
    expected = r"number of lengths of the crack = 2: must be 4 or more.*more lengths.*default"
    with pytest.raises(ValueError, match=expected):
        cracks.arrest(fracture.Threshold(dK_th=1e6))
    with pytest.raises(ValueError, match=expected):
        cracks.life(fracture.Threshold(dK_th=1e6), fracture.Paris(C=1e-11, m=3.0))


@pytest.mark.solves
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
