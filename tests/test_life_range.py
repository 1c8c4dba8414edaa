"""A life is a range: what it comes from, and that measured values lie in it."""

from __future__ import annotations

import math
import pickle

import numpy as np
import pytest

import pyfret as fret
from pyfret import experiments, fatigue
from pyfret.fatigue.criteria import CriterionName
from pyfret.fatigue.ranges import known_as

R, W, MU = 76e-3, 300e3, 0.55
ALLOYS = (
    "7075-T6",
    "2024-T3",
    "Ti-6Al-4V",
    "4340",
    "42CrMo4",
    "100Cr6",
    "316L",
    "304",
    "C45",
    "Inconel 718",
)


def rig(n: int) -> fret.Result:
    """A rig of fretting fatigue on so many cells."""
    alloy = fret.material("7075")
    half_width = math.sqrt(4.0 * W * R * 2.0 * (1.0 - alloy.nu**2) / (math.pi * alloy.E))
    scene = fret.Scene(
        body1=fret.Body(alloy, shape=fret.Cylinder(R=R)),
        body2=fret.Body(alloy),
        friction=MU,
        grid=fret.Grid.strip(extent=2.8 * half_width, n=n),
    )
    path = fret.LoadPath.start().force(W=W, increments=2)
    for sign in (1, -1, 1):
        path = path.force(T_x=sign * 0.5 * MU * W, sigma_B=sign * 90e6, increments=8)
    return fret.solve(scene, path, save="all", progress=False)


@pytest.fixture(scope="module")
def life() -> fatigue.Life:
    """Its life by Smith, Watson and Topper's criterion."""
    return rig(96).life(fatigue.Materials()["7075"], "smith_watson_topper")


@pytest.mark.solves
def test_a_life_has_low_best_and_high(life: fatigue.Life) -> None:
    assert life.low < life.best < life.high
    assert life.range.factor < 10.0
    assert life.range.material == 3.0
    best, low, high = (fret._core.rough(item) for item in (life.best, life.low, life.high))
    assert f"{best} ({low} to {high})" in repr(life)
    # Twice as much scatter, a wider range; none leaves stress and distance.
    layer = life.worst.layer
    widths = [life.range_of(layer, scatter=s, L=life.range.L).factor for s in (1.0, 3.0, 6.0)]
    assert widths == sorted(widths)
    assert widths[0] > 1.0
    with pytest.raises(ValueError, match="scatter"):
        life.range_of(layer, scatter=0.5)


@pytest.fixture(scope="module")
def few_cells() -> fret.Result:
    """The rig on few cells."""
    return rig(40)


@pytest.mark.parametrize("name", fatigue.CRITERIA)
def test_the_range_of_a_point_holds_the_scatter_of_the_material(
    few_cells: fret.Result, name: CriterionName
) -> None:
    """Every criterion has the same scatter at a point and for a mean."""
    table = fatigue.Materials()["7075"].numbers()
    names = [number for number, _, _ in table]
    extra = [
        (entry_name, value, "test")
        for entry_name, value in (("S", 0.3), ("k", 0.5))
        if entry_name not in names
    ]
    alloy = fatigue.Material("own", [*table, *extra])
    life = few_cells.life(alloy, name)
    worst, scatter = life.worst, life.range.material
    assert scatter > 1.0
    (low, high), (least, upper) = worst.range, worst.whole
    assert math.isfinite(upper)
    assert least < low <= worst.margin <= high < upper
    # The logarithms add as squares.
    down = math.log(worst.margin / least) ** 2 - math.log(worst.margin / low) ** 2
    assert down == pytest.approx((0.5 * math.log(scatter)) ** 2, rel=1e-6)
    assert fret._core.with_range(worst.margin, least, upper) in repr(worst)


@pytest.mark.solves
def test_the_range_of_the_stress_is_that_of_the_mean_and_covers(life: fatigue.Life) -> None:
    """The mean over a distance is known better than the stress at the rim."""
    alloy = fatigue.Materials()["7075"]
    finer = life.range.stress
    L = fatigue.critical_distance(alloy)
    # On few cells the mean is off by less than its error, which is smaller than the worst point's.
    coarse = rig(32)
    computed = coarse.life(alloy, "smith_watson_topper")
    ranges = computed.range.stress
    assert ranges.low <= finer.best <= ranges.high
    low, high = computed.worst.range
    assert ranges.high / ranges.low < (high / low) ** 0.8
    means = fatigue.averages.average(coarse, alloy, "smith_watson_topper", L=L)
    truth = fatigue.averages.average(rig(96), alloy, "smith_watson_topper", L=L)
    off = np.abs(means.value - truth.value.interp(x=means.x))
    covered = (off <= means.error).where(means.error.notnull(), drop=True)
    assert float(covered.mean()) > 0.9
    assert means.error.attrs["units"] == means.value.attrs["units"]


@pytest.mark.solves
def test_the_best_is_that_of_the_mean_over_the_critical_distance(life: fatigue.Life) -> None:
    L = fatigue.critical_distance(fatigue.Materials()["7075"])
    assert pytest.approx(L) == life.range.L
    computed = life.over_distance([L / 2, L, 2 * L])
    assert float(computed.margin[1]) == pytest.approx(life.best)
    # Every row is the range over a distance that is given.
    for n, at in enumerate((L / 2, L, 2 * L)):
        row = life.range_of(life.worst.layer, L=at)
        pattern = [float(computed.dataset[side][n]) for side in ("low", "high")]
        assert (row.low, row.best, row.high) == (pattern[0], float(computed.margin[n]), pattern[1])
    # Steep stresses: the longer the distance, the longer the life; a point is the worst.
    assert np.all(np.diff(computed.margin.values) > 0.0)
    assert life.worst.margin < float(computed.margin[0])
    # A mean that goes deeper than half the width of the contact is noted wherever it is printed.
    notes = [life.range_of(life.worst.layer, L=at).notes for at in (L, 1e-3)]
    assert [any("not small against the contact" in item for item in item) for item in notes] == [
        False,
        True,
    ]
    assert "L = 1000 um is not small against the contact" in repr(life.over_distance([L, 1e-3]))
    longest = life.over_distance([1e-3]).rows()[0]
    assert longest[-1] == "1e7 or more"
    assert computed.dataset.attrs["L"] == pytest.approx(L)
    ax = fret.plot.life_over_distance(computed)
    assert "cycles" in ax.get_ylabel()
    assert "life" in repr(computed)


def test_no_life_is_told_beyond_the_tests_of_curves(life: fatigue.Life) -> None:
    far = life.range_of(life.worst.layer, L=5e-4)
    assert math.isinf(far.best)
    assert math.isinf(far.high)
    assert far.low <= 1e7
    assert repr(far) == f"{fret._core.rough(far.low)} or more"
    assert any("no tests beyond 1e7 cycles" in note for note in far.notes)
    # The parts of the range stay numbers.
    assert 1e7 < far.stress.best < math.inf


def test_a_wide_range_names_what_makes_it_wide() -> None:
    """A steel has an estimated threshold, and a flat curve."""
    steel = fatigue.Materials()["4340"]
    body = fret.material("4340")
    scene = fret.Scene(
        body1=fret.Body(body, shape=fret.Cylinder(R=40e-3)),
        body2=fret.Body(body),
        friction=MU,
        grid=fret.Grid.strip(extent=1.35e-3, n=64),
    )
    path = fret.LoadPath.start().force(W=500e3, increments=2)
    for sign in (1, -1, 1):
        path = path.force(T_x=sign * 0.6 * MU * 500e3, sigma_B=sign * 200e6, increments=6)
    life = fret.solve(scene, path, save="all", progress=False).life(steel, "fatemi_socie").range
    assert 10.0 < life.factor < 100.0
    assert life.distance is not None
    assert life.distance.factor > life.material
    assert any("measure dK_th" in note for note in life.notes)


def test_a_pickled_life_keeps_its_range(life: fatigue.Life) -> None:
    again = pickle.loads(pickle.dumps(life))
    assert again.range == life.range
    with pytest.raises(ValueError, match="unpickled"):
        again.over_distance([1e-5])


@pytest.mark.parametrize("name", ALLOYS)
def test_common_alloys_have_lives_and_distances(name: str) -> None:
    material = fatigue.Materials()[name]
    for criterion in ("smith_watson_topper", "fatemi_socie"):
        assert material.assessment(criterion).life(1e3) >= 0.0
    assert 5e-6 < fatigue.critical_distance(material) < 300e-6
    for _, _, source in material.numbers():
        assert source
    # An estimate is called one, and what is from memory is not called known.
    kinds = {known_as(source) for _, _, source in material.numbers()}
    assert "estimate" in kinds


@pytest.mark.parametrize(
    ("name", "key"),
    [
        ("steel", "steel"),
        ("Ti6Al4V", "titanium_6Al4V"),
        ("7075", "aluminium_7075_T6"),
        ("Al2O3", "alumina"),
        ("316L", "steel_316L"),
        ("ti-6al-4v", "titanium_6Al4V"),
        ("AISI 52100", "steel_100Cr6"),
    ],
)
def test_everyday_names_are_found(name: str, key: str) -> None:
    assert fatigue.Materials()[name].name == key


def test_a_wrong_name_gets_the_nearest_one() -> None:
    with pytest.raises(KeyError, match=r"the nearest are steel_42CrMo4, .*Elastic"):
        fret.material("42CrMo")
    with pytest.raises(KeyError, match="the nearest is PTFE; "):
        fret.material("PEEK")


def test_a_modulus_from_memory_is_marked() -> None:
    with pytest.warns(fret.errors.SceneWarning, match="from memory"):
        fret.material("316L")


def test_estimates_follow_their_rules() -> None:
    numbers = [("E", 210e9, "tests"), ("s_u", 600e6, "tests"), ("s_y", 400e6, "tests")]
    computed = fatigue.Material("ours", numbers).estimated("steel")
    assert computed.number("s_f") == pytest.approx(900e6)
    assert computed.number("e_f") == pytest.approx(0.59)
    s_D = 900e6 * 2e6**-0.087
    assert computed.number("s_D") == pytest.approx(s_D)
    assert computed.number("t_D") == pytest.approx(s_D / math.sqrt(3.0))
    # Both limits have the same value of Fatemi and Socie's criterion.
    k = computed.number("k")
    assert 2.0 * computed.number("t_D") == pytest.approx(s_D * (1.0 + k * s_D / (2.0 * 400e6)))
    assert computed.number("s_u") == 600e6
    assert {known_as(item) for n, _, item in computed.numbers() if n in ("s_u", "s_y", "E")} == {
        "known"
    }
    with pytest.raises(ValueError, match="must be one of steel"):
        fatigue.Material("ours", numbers).estimated("copper")


def test_estimates_widen_the_range() -> None:
    numbers = [("s_D", 4e8, "tests"), ("t_D", 2.5e8, "tests")]
    tests = fatigue.Material("ours", numbers)
    rule = fatigue.Material("ours", [(n, v, f"estimate: {s}") for n, v, s in numbers])
    factors = []
    for material in (tests, rule):
        item = material.assessment("crossland")
        _, (low, _, high), _, notes = item.range_at(2e8, 0.0, material)
        factors.append(high / low)
        assert bool(notes) == (material is rule)
    assert factors == pytest.approx([1.2, 1.5])


@pytest.mark.parametrize(("coating", "failed"), [("TiC", 0.8), ("TiN", 0.7)])
def test_published_lives_lie_in_their_ranges(coating: str, failed: float) -> None:
    """Failure at the energy density of the paper, a part of the thickness."""
    test = experiments.fouvry2007(coating)
    scene = test.scene
    coarse = scene.replace(
        grid=scene.grid.replace(nx=32, ny=32, dx=2 * scene.grid.dx, dy=2 * scene.grid.dy)
    )
    per_cycle = 4.0 * scene.mu * 100.0 * 75e-6
    cycles = (400.0 if coating == "TiC" else 200.0) / per_cycle
    options = {**test.arguments, "cycles": cycles, "jumps": 12, "worn_through": "go_on"}
    options.pop("tolerance", None)
    worn = fret.wear.solve(coarse, progress=False, **options)
    range_found = worn.range_of_cycles(part_of_coating=failed)
    assert range_found.factor < 10.0
    energy = float(worn.dissipated[-1] / worn.cycles[-1])
    area = math.pi * 183.3e-6**2
    rows = experiments.table(f"fouvry2007_{coating.lower()}_lives")
    inside = []
    for row in rows:
        # The life goes with the energy of a cycle, which is taken from the test.
        scale = energy / (row["mean_energy_density_J_per_m2_cycle"] * area)
        lived = row["cycles_to_failure"]
        inside.append(scale * range_found.low <= lived <= scale * range_found.high)
    assert sum(inside) >= 0.8 * len(rows)


def test_published_lives_of_a_solid_lubricant_lie_in_their_ranges() -> None:
    """MoS2 between Ti-6Al-4V: the capacity of the three shortest lives foretells the others."""
    rows = experiments.table("fouvry2007_mos2_lives")
    density, lived = (
        np.array([row[item] for row in rows])
        for item in ("mean_energy_density_J_per_m2_cycle", "cycles_to_failure")
    )
    capacity = float(np.exp(np.log(density[:3] * lived[:3]).mean()))
    titanium = fret.Elastic(E=119e9, nu=0.29)
    W, mu, slip = 133e3, 0.1, 50e-6
    a = fret.reference.line_contact(R=0.01, bodies=(titanium, titanium), W=W).a
    scene = fret.Scene(
        body1=fret.Body(titanium, shape=fret.Cylinder(R=0.01)),
        body2=fret.Body(titanium),
        friction=mu,
        grid=fret.Grid.strip(extent=2.6 * a + 4 * slip, n=48),
        path=fret.LoadPath.start().normal(W).displace(delta_x=[slip, -slip, slip]),
    )
    # It fails before the substrate wears.
    options = {"cycling": "sliding", "body2": fret.wear.Archard(1e-20), "jumps": 2}
    worn = fret.wear.solve(scene, cycles=1e6, progress=False, **options)
    range_found = worn.range_of_cycles(energy=capacity * 2 * a)
    assert range_found.best == pytest.approx(capacity * 2 * a / (4 * mu * W * slip), rel=0.01)
    assert range_found.factor < 10.0
    # The life goes with the energy of a cycle, which is taken from the test.
    scale = 4 * mu * W * slip / (2 * a) / density[3:]
    inside = (scale * range_found.low <= lived[3:]) & (lived[3:] <= scale * range_found.high)
    assert inside.sum() >= 0.8 * inside.size
    assert worn.cycles_to(energy=1e12).beyond == float(worn.cycles[-1])


#: Limits and distance of the page on these tests, fitted to plain fretting.
FITTED = [("s_D", 443e6, "fitted to plain fretting"), ("t_D", 297e6, "fitted to plain fretting")]


@pytest.mark.solves
def test_published_thresholds_lie_in_their_ranges() -> None:
    """Each range at a measured threshold of the safety factor contains 1, in eight of ten tests."""
    steel = fatigue.Material("35NCD16", FITTED)
    inside = []
    for row in experiments.table("icf13_952_thresholds"):
        result = fret.solve(experiments.icf13(str(row["test"]), n=48).scene, progress=False)
        life = result.life(steel, "crossland").range_of(0, L=39e-6)
        assert life.factor < 2.0
        inside.append(life.low <= 1.0 <= life.high)
    assert sum(inside) >= 0.8 * len(inside)


@pytest.mark.solves
def test_a_threshold_has_the_range_of_its_margin() -> None:
    steel = fatigue.Material("35NCD16", FITTED)
    threshold_load = fret.study.threshold(
        lambda values: experiments.icf13("FF_1", Q=values["Q"], n=48).scene,
        "Q",
        measure=fret.study.Averaged(steel, "crossland", 39e-6),
        between=(1.5e5, 6e5),
        tolerance=0.05,
    )
    assert threshold_load.low < threshold_load.value < threshold_load.high
    # The measured threshold lies within it; the range is one of strengths, not of lives.
    assert threshold_load.low <= 2.73e5 <= threshold_load.high
    assert threshold_load.high / threshold_load.low < 2.0


def test_a_stress_of_a_criterion_has_its_unit(life: fatigue.Life) -> None:
    """The value of Smith, Watson and Topper, a stress times a strain, is one of them."""
    assert life.worst.units == "Pa"
    assert " MPa, x = " in repr(life.worst)
    assert " MPa</td>" in life._repr_html_()


def test_endless_lives_have_no_number() -> None:
    item = fatigue.ranges.Range
    assert repr(item(math.inf, math.inf, math.inf)) == "endless"
    assert repr(item(3.2e6, math.inf, math.inf)) == "3.2e6 or more"
    assert repr(item(3.2e6, 5e6, math.inf)) == "5.0e6 (3.2e6 or more)"
