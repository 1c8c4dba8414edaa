"""Criteria along the cycle of a contact: streaming, layers, critical distances, Ruiz, figures."""

from __future__ import annotations

import pickle
from dataclasses import fields
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest

import pyfret as fret
from conftest import T_MAX, sphere_on_flat
from conftest import W as LOAD
from pyfret import fatigue
from pyfret.fatigue import averages
from pyfret.fatigue.section import Section, SectionOptions

pytestmark = pytest.mark.solves

STEEL = fatigue.Materials()["steel_42CrMo4"]


@pytest.fixture(scope="module")
def cycled() -> fret.Result:
    """A coated sphere contact over one closed cycle, all increments kept."""
    path = fret.LoadPath.start().normal(LOAD, increments=4)
    path = path.tangential([T_MAX, -T_MAX, T_MAX], increments=15)
    return fret.solve(sphere_on_flat(ratio=2.0, n=32), path, save="all", progress=False)


@pytest.fixture(scope="module")
def few() -> fret.Result:
    """Solve the same on fewer cells, with fewer increments."""
    path = fret.LoadPath.start().normal(LOAD, increments=2)
    path = path.tangential([T_MAX, -T_MAX, T_MAX], increments=4)
    return fret.solve(sphere_on_flat(ratio=2.0, n=16), path, save="all", progress=False)


BOTH = [STEEL, STEEL]


def test_streamed_is_what_the_whole_history_gives(cycled: fret.Result) -> None:
    streamed = cycled.life(BOTH, "findley", residual=[-3e8, 1e8])
    z = np.unique(streamed.dataset.z)
    history = fatigue.history(cycled, z, y=0.0, residual=[-3e8, 1e8])
    whole = fatigue.evaluate_margin(history, STEEL, "findley")
    np.testing.assert_allclose(streamed.dataset.value, whole.value, rtol=1e-12)
    np.testing.assert_allclose(streamed.margin, whole.safety_factor, rtol=1e-12)
    assert streamed.dataset.value.dims == ("depth", "x")
    # Both sides of the interface are judged, each with its own stress.
    at_interface = streamed.dataset.z.values == cycled.scene.interfaces()[0]
    assert streamed.dataset.layer.values[at_interface].tolist() == [0, 1]


def test_worst_point_lies_between_the_cells(cycled: fret.Result) -> None:
    life = cycled.life(BOTH, "dang_van")
    worst = life.worst
    largest = float(life.dataset.value.max())
    assert worst.value >= largest
    # The rim lies between two samples: a third more than the largest, as on three times the cells.
    path = cycled.scene.path
    finer = fret.solve(sphere_on_flat(ratio=2.0, n=96), path, save="all", progress=False)
    truth = finer.life(BOTH, "dang_van").worst
    assert worst.value == pytest.approx(truth.value, rel=0.02)
    assert abs(worst.value - truth.value) < worst.error
    assert worst.errors.z < 0.05 * worst.value
    assert worst.margin == pytest.approx(STEEL.number("t_D") / worst.value, rel=1e-12)
    # The trailing edge, on the surface: fretting cracks start there.
    assert worst.z == 0.0
    assert 0.8 < abs(worst.x) / cycled.a_H < 1.1
    assert worst == life.worst_of(0)
    assert worst.normal is None
    on_a_plane = cycled.life(BOTH, "findley", [0.0]).worst
    assert np.linalg.norm(np.array(on_a_plane.normal)) == pytest.approx(1.0)
    assert abs(on_a_plane.inclination) <= 90.0
    assert "safety factor" in repr(life)


def test_a_volume_is_its_sections(few: fret.Result) -> None:
    places = (-3e-5, 1e-4)
    depths = [0.0, 2e-4]
    for across, along in (("y", "x"), ("x", "y")):
        whole = few.life(BOTH, "findley", depths, **{across: places})
        assert whole.dataset.value.dims == ("depth", along, across)
        for n, position in enumerate(places):
            item = few.life(BOTH, "findley", depths, **{across: position})
            np.testing.assert_array_equal(whole.dataset.value[..., n], item.dataset.value)
            assert whole.section(position).worst == item.worst
            again = pickle.loads(pickle.dumps(whole))
            assert again.worst == whole.worst
            assert again.section(position).worst == item.worst
        values = [whole.section(position).worst.value for position in places]
        assert whole.worst.value == max(values)
        assert getattr(whole.worst, across) == places[int(np.argmax(values))]
    with pytest.raises(ValueError, match="must be one number here"):
        averages.average(few, BOTH, "crossland", L=3e-5, y=places)
    with pytest.raises(ValueError, match="give x or y"):
        few.life(BOTH, "crossland", x=0.0, y=0.0)
    with pytest.raises(ValueError, match="cycle = 7: must be"):
        few.life(BOTH, "crossland", cycle=7)


def test_several_criteria_by_the_same_stress(few: fret.Result) -> None:
    criteria: list[fatigue.CriterionName] = ["findley", "crossland"]
    life = fatigue.lives(few, [STEEL, STEEL], criteria, y=[0.0, 2e-5])
    assert list(life) == criteria
    for name, entry in life.items():
        assert entry == few.life([STEEL, STEEL], name, y=[0.0, 2e-5])
        assert entry.worst == few.life([STEEL, STEEL], name, y=[0.0, 2e-5]).worst
    with pytest.raises(ValueError, match="one or more"):
        fatigue.lives(few, STEEL, [])


def test_keywords_are_the_fields_of_a_section() -> None:
    assert set(SectionOptions.__annotations__) == {f.name for f in fields(Section)}


def test_each_layer_with_its_own_material(cycled: fret.Result) -> None:
    only = cycled.life([None, STEEL], "crossland", [0.0, 2e-4, 7e-4])
    judged = np.isfinite(only.dataset.value.values)
    assert judged[only.dataset.layer.values == 1].all()
    assert not judged[only.dataset.layer.values == 0].any()
    assert only.worst.layer == 1
    with pytest.raises(ValueError, match="layer 0 is not judged"):
        only.worst_of(0)
    with pytest.raises(ValueError, match="1 materials: must be one, or one for each"):
        cycled.life([STEEL], "crossland")
    # One material is the substrate's and does not judge a coating.
    alone = cycled.life(STEEL, "crossland", [0.0, 2e-4, 7e-4])
    np.testing.assert_array_equal(alone.dataset.value, only.dataset.value)
    with pytest.raises(ValueError, match=r"no depth lies .* .the substrate begins at 0.00048"):
        cycled.life(STEEL, "crossland", [0.0, 2e-4])
    with pytest.raises(ValueError, match="no layer has a material"):
        cycled.life([None, None], "crossland")
    with pytest.raises(ValueError, match="residual = 1 of them"):
        cycled.life(BOTH, "crossland", residual=[1e6])
    with pytest.raises(ValueError, match=r"alumina`\.s_D"):
        cycled.life(fatigue.Materials()["alumina"], "crossland")


def test_averages_are_those_of_the_stress(cycled: fret.Result) -> None:
    L = 3e-5
    point = averages.average(cycled, BOTH, "crossland", L=L, method="point")
    there = cycled.life(BOTH, "crossland", [L / 2])
    np.testing.assert_allclose(point.value, there.dataset.value[0], rtol=1e-12)
    # The mean of the stress over the line, by the midpoint rule on many depths.
    line = averages.average(cycled, BOTH, "crossland", L=L, method="line")
    z = (np.arange(60) + 0.5) / 60 * 2 * L
    mean = fatigue.history(cycled, z, y=0.0).mean("depth")
    brute = fatigue.evaluate_margin(
        mean.transpose("increment", "x", "component"), STEEL, "crossland"
    )
    # Far outside there is next to no stress, and a large safety factor is no number to compare.
    used, expected = 1 / line.safety_factor, 1 / brute.safety_factor
    np.testing.assert_allclose(used, expected, rtol=2e-3, atol=1e-4)
    # A distance far below the cell leaves the stress of the surface.
    surface = cycled.life(BOTH, "crossland", [0.0]).dataset.value[0]
    for method in ("point", "line", "area"):
        tiny = averages.average(cycled, BOTH, "crossland", L=1e-9, method=method)
        inside = np.isfinite(tiny.value.values)
        assert inside.sum() >= surface.size - 2
        # At the rim the stress of the surface has a cusp.
        off = np.abs(tiny.value.values - surface.values)[inside]
        assert off.max() < 2e-2 * float(surface.max())
    area = averages.average(cycled, BOTH, "crossland", L=L, method="area")
    assert float(area.value.max()) < float(surface.max())
    with pytest.raises(ValueError, match="belongs to one material"):
        averages.average(cycled, BOTH, "crossland", L=1.0)
    unknown = fatigue.Material("mine", [("s_D", 398e6, "a test"), ("t_D", 260e6, "a test")])
    with pytest.raises(ValueError, match="dK_th"):
        averages.average(cycled, unknown, "crossland")
    with pytest.raises(ValueError, match="positive length"):
        averages.average(cycled, BOTH, "crossland", L=0.0)


def test_the_mean_over_a_ball_is_near_that_over_its_disc() -> None:
    path = fret.LoadPath.start().normal(LOAD, increments=1)
    path = path.tangential([T_MAX, -T_MAX, T_MAX], increments=3)
    result = fret.solve(sphere_on_flat(n=16), path, save="all", progress=False)
    L = 3e-5
    ball, disc = (
        averages.average(result, STEEL, "crossland", L=L, method=m) for m in ("volume", "area")
    )
    surface = result.life(STEEL, "crossland", [0.0]).dataset.value
    assert 0.0 < float(ball.value.max()) < float(surface.max())
    # Far from the rim they differ by their mean depths, in a gradient of p_H/a_H at most.
    middle = np.abs(ball.x.values) < 0.3 * result.a_H
    deeper = (4 / (3 * np.pi) - 3 / 8) * L
    off = np.abs(ball.value - disc.value).values[middle]
    assert 0.0 < off.max() < deeper / result.a_H * result.p_H


def test_a_critical_distance_in_the_substrate(cycled: fret.Result) -> None:
    L = 3e-5
    top = cycled.scene.interfaces()[0]
    below = averages.average(cycled, STEEL, "crossland", L=L)
    by_name = averages.average(cycled, STEEL, "crossland", L=L, layer=1)
    np.testing.assert_array_equal(below.value, by_name.value)
    z = top + (np.arange(60) + 0.5) / 60 * 2 * L
    mean = fatigue.history(cycled, z, y=0.0).mean("depth")
    brute = fatigue.evaluate_margin(
        mean.transpose("increment", "x", "component"), STEEL, "crossland"
    )
    np.testing.assert_allclose(below.value, brute.value, rtol=2e-3, atol=1e5)
    with pytest.raises(ValueError, match="layer = 2: must be 0 to 1"):
        averages.average(cycled, STEEL, "crossland", L=L, layer=2)


def test_strains_are_those_of_the_scene(cycled: fret.Result) -> None:
    aluminium = fatigue.Materials()["aluminium_7075_T6"]
    life = cycled.life(aluminium, "smith_watson_topper")
    assert any("the scene has E = " in note for note in life.notes)
    assert "the scene has E = " in repr(life)
    # The cycle begins with the first shear and ends with its reversal back.
    assert fatigue.Materials()["steel_42CrMo4"] == STEEL


def test_ruiz_work_adds_up_to_the_energy_of_the_loop(cycled: fret.Result) -> None:
    grid = cycled.scene.grid
    ends = fatigue.cycle_increments(cycled)[[0, -1]]
    start, end = (cycled.at(int(n)).dissipated_density for n in (ends[0] - 1, ends[1]))
    work = end.drop_vars("increment", errors="ignore") - start.values
    whole = float(work.sum()) * grid.dx * grid.dy
    assert whole == pytest.approx(float(cycled.loops().dissipated[-1]), rel=1e-6)
    y = float(grid.y[16])
    ruiz = fatigue.ruiz(cycled, y=y)
    np.testing.assert_allclose(ruiz.F1, work.values[:, 16], rtol=1e-12)
    tension = fatigue.history(cycled, [0.0], y=y).sel(component="s_xx").max("increment")[0]
    np.testing.assert_allclose(ruiz.F2, ruiz.F1 * np.maximum(tension, 0.0))


def test_what_was_not_kept_is_refused() -> None:
    path = fret.LoadPath.start().normal(LOAD, increments=2)
    path = path.tangential([T_MAX, -T_MAX, T_MAX], increments=6)
    result = fret.solve(sphere_on_flat(n=16), path, save="branches", progress=False)
    # The ends are enough for the work of the cycle.
    whole = fret.solve(sphere_on_flat(n=16), path, save="all", progress=False)
    F1 = fatigue.ruiz(result).F1
    np.testing.assert_allclose(F1, fatigue.ruiz(whole).F1, rtol=1e-9, atol=1e-9 * float(F1.max()))
    last = fret.solve(sphere_on_flat(n=16), path, save=[4, 8], progress=False)
    with pytest.raises(ValueError, match=r"increment \d was not kept"):
        fatigue.ruiz(last)
    short = fret.LoadPath.start().normal(LOAD, increments=2)
    with pytest.raises(ValueError, match="no closed cycle"):
        fret.solve(sphere_on_flat(n=16), short, progress=False).life(STEEL, "crossland")


def test_figures(cycled: fret.Result) -> None:
    aluminium = fatigue.Materials()["aluminium_7075_T6"]
    for life in (
        cycled.life(BOTH, "dang_van"),
        cycled.life([None, aluminium], "smith_watson_topper"),
    ):
        ax = fret.plot.criterion_map(life)
        assert ax.lines
        assert ax.get_ylim()[0] > ax.get_ylim()[1]
    stress = fatigue.history(cycled, [0.0], y=0.0)[:, 0, 2].values
    criterion = aluminium.assessment("smith_watson_topper").criterion
    assert len(fret.plot.critical_plane_rose(stress, criterion).lines) == 3
    with pytest.raises(ValueError, match="no critical plane"):
        fret.plot.critical_plane_rose(stress, fatigue.Criterion.dang_van(alpha=0.4))
    assert len(fret.plot.dang_van_diagram(stress, material=STEEL).lines) == 3
    judged = cycled.life([STEEL, STEEL], "findley", [0.0, 1e-4, 2e-4, 6e-4, 7e-4])
    ax = fret.plot.haigh_diagram(judged, material=STEEL)
    # Points and worst point of both layers, and the limit, through s_D without a mean.
    assert len(ax.lines) == 5
    mean, amplitude = ax.lines[-1].get_data()
    assert np.interp(0.0, mean, amplitude) == pytest.approx(STEEL.number("s_D") / 1e6)
    worst, d = judged.worst_of(0), judged.dataset
    marked = ax.lines[1].get_xydata()[0] * 1e6
    n = np.unravel_index(int(np.nanargmax(d.value)), d.value.shape)
    # On 32 cells the trailing edge lies between two samples and has a third more.
    assert worst.border == "rim"
    assert 1.0 <= worst.value / float(d.value[n]) < 1.4
    np.testing.assert_allclose(marked, [float(d.normal_mean[n]), float(d.normal_amplitude[n])])
    with pytest.raises(ValueError, match="no critical plane"):
        fret.plot.haigh_diagram(cycled.life(BOTH, "dang_van", [0.0]))
    plt.close("all")


def test_mean_stress_costs_amplitude_as_the_criterion_says(tmp_path: Path) -> None:
    slope, after = fatigue.mean_stress_slope(STEEL)
    assert after == "Dang Van"
    mean = 150e6
    amplitude = STEEL.number("s_D") - slope * mean
    stress = np.zeros((2, 6))
    stress[:, 0] = mean + amplitude, mean - amplitude
    assert float(fatigue.evaluate_margin(stress, STEEL, "dang_van").safety_factor) == pytest.approx(
        1.0
    )
    table = tmp_path / "mine.toml"
    table.write_text(
        'schema = 1\n[materials.mine]\ns_D = { value = 4e8, source = "test" }\n'
        's_u = { value = 9e8, source = "test" }\n',
        encoding="utf-8",
    )
    goodman = fatigue.mean_stress_slope(fatigue.Materials(table)["mine"])
    assert goodman == (pytest.approx(4 / 9), "Goodman")
    with pytest.raises(ValueError, match="s_D"):
        fatigue.mean_stress_slope(fatigue.Material("mine", [("s_u", 5e8, "a test")]))


def test_the_mean_over_a_critical_distance_knows_the_width_of_the_contact() -> None:
    """Nowell and Hills' cylinders: one stress at the surface, a larger mean below wide ones."""
    alloy = fret.Elastic(E=74e9, nu=0.33)
    p_0, mu, L = 157e6, 0.75, 91e-6
    swt = fatigue.Criterion.smith_watson_topper(E=alloy.E, nu=alloy.nu)
    surface, mean = [], []
    for a in (0.1e-3, 0.28e-3, 0.95e-3):
        W = np.pi * a * p_0 / 2
        R = alloy.E / (2 * (1 - alloy.nu**2)) * a / (2 * p_0)
        grid = fret.Grid.strip(extent=5 * a, n=64)
        cylinder, flat = fret.Body(alloy, shape=fret.Cylinder(R)), fret.Body(alloy)
        scene = fret.Scene(body1=cylinder, body2=flat, friction=mu, grid=grid)
        path = fret.LoadPath.start().normal(W, increments=1)
        for direction in (1, -1, 1):
            path = path.force(
                T_x=direction * 0.45 * mu * W, sigma_B=direction * 92.7e6, increments=3
            )
        result = fret.solve(scene, path, save="all", progress=False)
        assert result.a_H == pytest.approx(a, rel=1e-9)
        stress = fatigue.history(result, [0.0, *((np.arange(10) + 0.5) / 5 * L)], y=0.0)
        surface.append(float(fatigue.evaluate_criterion(stress.isel(depth=0), swt).value.max()))
        below = stress.isel(depth=slice(1, None)).mean("depth")
        mean.append(float(fatigue.evaluate_criterion(below, swt).value.max()))
    np.testing.assert_allclose(surface, surface[0], rtol=1e-4)
    assert 1.2 * mean[0] < mean[1] < 0.7 * mean[2] < 0.5 * surface[0]
