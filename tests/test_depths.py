"""Depths chosen from the layers find the largest stress and its error."""

from __future__ import annotations

import os
import warnings

import numpy as np
import pytest

import pyfret as fret
from conftest import R, W, sphere_on_flat
from pyfret.subsurface.tensor import COMPONENTS, LABELS

STEEL = fret.Elastic(E=210e9, nu=0.3)
HERTZ = fret.reference.hertz(R=R, bodies=(STEEL, STEEL), W=W)
#: Random contacts (as many as FRET_DEPTHS), and largest difference to ten times the depths.
CONTACTS, OFF = int(os.environ.get("FRET_DEPTHS", "4")), 0.02


def layered(coatings: list[fret.Coating], *, n: int = 24) -> fret.Scene:
    return fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Sphere(R=R)),
        body2=fret.Body(STEEL, coatings=coatings),
        friction=0.3,
        grid=fret.Grid.centred(width=3.0 * HERTZ.a, n=n),
    )


def random_coatings(random: np.random.Generator) -> list[fret.Coating]:
    """One to three layers, a fiftieth of the contact radius to all of it thick."""
    return [
        fret.Coating(
            fret.Elastic(
                E=float(210e9 * 2 ** random.uniform(-1, 2)), nu=float(random.uniform(0.15, 0.4))
            ),
            thickness=float(HERTZ.a * 50 ** random.uniform(-1, 0)),
        )
        for _ in range(random.integers(1, 4))
    ]


PATH = fret.LoadPath.start().normal(W, increments=1).tangential(0.6 * 0.3 * W, increments=1)


@pytest.mark.solves
@pytest.mark.timeout(600)
@pytest.mark.filterwarnings("ignore::pyfret.errors.SceneWarning")
def test_chosen_depths_find_the_largest_stress_of_random_layered_contacts() -> None:
    random = np.random.default_rng(1)
    covered, worst = [], 0.0
    for _ in range(CONTACTS):
        scene = layered(random_coatings(random))
        last = fret.solve(scene, PATH, progress=False).at(-1)
        many, _ = fret._core.chosen_depths(
            scene.body2, a=last.length, deepest=2 * last.length, finer=10.0
        )
        chosen, finer = last.stress(), last.stress(np.unique(many), y=0.0)
        for item in ("von_mises", "s_1", "interface_shear"):
            extremum, truth = chosen.maximum(item), finer.maximum(item)
            if item == "interface_shear":
                assert min(abs(extremum.z - z) for z in scene.interfaces()) < 1e-12
            # Both are values at points: the larger is nearer to the largest of the body.
            there = last.stress([extremum.z], x=extremum.x, y=extremum.y)
            in_layer = there.dataset.layer.values == extremum.layer
            assert there.measure(item).values[in_layer] == pytest.approx(extremum.value, rel=0.01)
            difference = max(truth.value - extremum.value, 0.0) / truth.value
            assert difference <= OFF, (scene.body2, item, extremum, truth)
            worst = max(worst, difference)
            covered.append(difference <= extremum.error / truth.value + 1e-9)
    print(f"{CONTACTS} contacts: off by {worst:.1e} at most, covered {np.mean(covered):.2f}")
    assert np.mean(covered) >= 0.9


@pytest.mark.solves
def test_a_thin_layer_is_not_missed() -> None:
    """A layer of a fiftieth of the contact radius, four times as stiff, below a thicker one."""
    stiff = fret.Elastic(E=4 * STEEL.E, nu=0.3)
    coatings = [
        fret.Coating(STEEL, thickness=0.3 * HERTZ.a),
        fret.Coating(stiff, thickness=HERTZ.a / 50),
    ]
    scene = layered(coatings)
    assert scene.interfaces() == pytest.approx([0.3 * HERTZ.a, 0.32 * HERTZ.a])
    assert scene.interfaces(1) == []
    contact = fret.solve(scene, PATH, progress=False).at(-1)
    below = contact.stress()
    assert set(np.unique(below.dataset.layer)) == {0, 1, 2}
    largest = below.maximum()
    assert largest.layer == 1, largest
    with pytest.warns(
        fret.errors.SceneWarning, match="interfaces at z = .* are not among the depths"
    ):
        even = contact.stress(np.linspace(0.0, 2 * HERTZ.a, 18), y=0.0).maximum()
    assert even.value < 0.9 * largest.value
    shear = below.maximum("interface_shear")
    assert any(shear.z == pytest.approx(z) for z in scene.interfaces())


def test_a_rim_beside_a_narrow_slip_zone_is_right_on_coarse_cells() -> None:
    """The shear rises to the border of the stick zone within a few cells of the rim."""
    path = fret.LoadPath.start().normal(W, increments=1).tangential(0.15 * W, increments=2)
    scene = sphere_on_flat(n=36).replace(path=path)
    finer = sphere_on_flat(n=128).replace(path=path)
    surface = [
        fret.solve(item, progress=False).at(-1).stress(z=[0.0], y=0.0).maximum().value
        for item in (scene, finer)
    ]
    assert surface[0] == pytest.approx(surface[1], rel=0.1)


def test_interface_measures_need_an_interface() -> None:
    contact = fret.solve(sphere_on_flat(n=16), PATH, progress=False).at(-1)
    with pytest.raises(ValueError, match="no interface lies among the depths"):
        contact.stress().maximum("interface_shear")
    with pytest.raises(ValueError, match="must be one of"):
        contact.stress().maximum("mises")


def test_a_layer_above_the_first_row_of_cells_is_told() -> None:
    scene = layered([fret.Coating(STEEL, thickness=HERTZ.a / 50)], n=16)
    contact = fret.solve(scene, fret.LoadPath.start().normal(W, increments=1), progress=False)
    with pytest.warns(fret.errors.SceneWarning, match="cells"):
        contact.at(-1).stress()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        fret.solve(sphere_on_flat(n=24), PATH, progress=False).at(-1).stress()


@pytest.mark.solves
@pytest.mark.parametrize("place", [0.0, 1e-5])
def test_a_measure_that_is_negative_everywhere_has_no_largest_value(place: float) -> None:
    """s_3 is 0 far from a contact: the end of a section is no place of a maximum."""
    x = fret.Grid.centred(width=2e-4, n=24).x - place
    ball = fret.SurfaceMap(-(x[:, None] ** 2 + x**2) / 0.01, spacing=2e-4 / 24)
    scene = fret.Scene(
        body1=fret.Body(fret.Elastic(E=210e9, nu=0.3), shape=ball),
        body2=fret.Body(fret.Elastic(E=210e9, nu=0.3)),
        friction=0.0,
        grid=fret.Grid.centred(width=2e-4, n=24),
        path=fret.LoadPath.start().normal(10.0),
    )
    stress = fret.solve(scene, progress=False).at(-1).stress()
    assert stress.s_3.max() < 0.0
    with pytest.raises(ValueError, match=r"s_3 is negative .* no largest value"):
        stress.maximum("s_3")
    assert stress.maximum("von_mises").value > 0.0


@pytest.mark.solves
def test_no_largest_value_is_below_a_sample_away_from_the_rim() -> None:
    """Samples of s_2 beside the rim are higher than its largest value, which lies deep."""
    steel, mu = fret.Elastic(E=159e9, nu=0.3), 0.32
    a = fret.reference.hertz(R=5e-3, bodies=(steel, steel), W=30.0).a
    scene = fret.Scene(
        body1=fret.Body(steel, shape=fret.Sphere(R=5e-3)),
        body2=fret.Body(steel),
        friction=mu,
        grid=fret.Grid.centred(width=3.6 * a, n=36),
        path=fret.LoadPath.start().normal(30.0).force(T_y=0.5 * mu * 30.0, increments=4),
    )
    stress = fret.solve(scene, progress=False).at(-1).stress()
    deep = stress.dataset.z.values > 0.2 * a
    for measure in LABELS:
        if measure.startswith("interface"):
            continue
        try:
            top = stress.maximum(measure)
        except ValueError:
            continue
        highest = float(stress.measure(measure).values[deep].max())
        assert top.value >= highest - 1e-9 * abs(highest), measure


@pytest.mark.solves
@pytest.mark.parametrize("n", [16, 17])
def test_a_section_close_to_a_row_of_cells_is_the_one_on_it(n: int) -> None:
    """Rows of cells on both sides of the section lie at nearly equal distances from it."""
    path = fret.LoadPath.start().normal(W, increments=1).tangential(0.1 * W, increments=2)
    last = fret.solve(sphere_on_flat(n=n), path, progress=False).at(-1)
    z = np.array([0.0, 0.02, 0.2]) * HERTZ.a
    on_row, cell = last.stress(z, y=0.0), float(last.dataset.x[1] - last.dataset.x[0])
    for part in (1e-12, 1e-6, 1e-3, 1e-2):
        beside = last.stress(z, y=part * cell)
        for name in COMPONENTS:
            off = np.abs(beside.dataset[name] - on_row.dataset[name]).max()
            # On a row other cells have loads that vary within them.
            assert off < (1e-3 + part) * HERTZ.p_H, (name, part)
