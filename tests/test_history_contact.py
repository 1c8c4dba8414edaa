"""A load history on a contact: march, table, wear, damage."""

from __future__ import annotations

import json

import numpy as np
import pytest

import pyfret as fret
from conftest import MU, ROOT, W, sphere_on_flat
from pyfret import fatigue
from pyfret.history.table import HistoryTable

pytestmark = pytest.mark.solves

ROWS = json.loads((ROOT / "tests/data/vibration/rows.json").read_text())
PRESSED = fret.LoadPath.start().normal(W)
SWT = "smith_watson_topper"


def contact(n: int = 32, ratio: float = 1.0) -> fret.Scene:
    return sphere_on_flat(n=n, ratio=ratio).replace(path=PRESSED)


def random_force(reversals: int, seed: int) -> np.ndarray:
    """Reversals of a force that begins at its largest value, up to 0.85 of sliding."""
    values = np.random.default_rng(seed).uniform(-0.7, 0.8, reversals)
    values[0], values[reversals // 2] = 0.85, -0.75
    values[-1] = values[0]
    return values * MU * W


def test_loops_dissipate_what_mindlin_and_deresiewicz_give() -> None:
    row = ROWS["ball_history"]
    force = MU * W
    sizes, energies = np.array(row["loop_energy_at"])[1:].T
    history = fret.LoadHistory.from_matrix(2.0 * sizes * force, 0.0 * sizes, np.ones_like(sizes))
    table = HistoryTable.build(contact(96), history, progress=False)
    np.testing.assert_allclose(table.energies, energies, rtol=0.01)
    history = fret.LoadHistory.from_array(T_x=np.array(row["reversals_over_muW"]) * force)
    table = HistoryTable.build(contact(96), history, progress=False)
    halves = history.count().dataset.amplitude.values / force
    closed = np.array(row["closed_loops_half_range"])
    assert np.abs(halves[:, None] - closed).min(axis=0).max() < 1e-12
    energy = float(table.energy(closed * force).sum())
    assert energy == pytest.approx(row["energy_of_closed_loops"], rel=0.01)


def test_a_narrow_band_dissipates_the_mean_over_rayleigh() -> None:
    row = ROWS["ball_history"]
    rms = row["gaussian_sigma_over_muW"] * MU * W
    band = ([99.5, 100.5], [rms**2, rms**2])
    history = fret.LoadHistory.from_spectrum(band, 100.0, distribution="rayleigh")
    table = HistoryTable.build(contact(64), history, progress=False)
    per_loop = table.total_energy / history.count().total
    assert per_loop == pytest.approx(row["energy_per_cycle_narrow_band"], rel=0.01)
    assert table.energy_errors["amplitudes"] < 1e-3
    assert abs(per_loop / row["energy_per_cycle_narrow_band"] - 1.0) < table.energy_error
    # A series of 6000 cycles that the spectrum of a wider band makes.
    band = ([80.0, 120.0], [rms**2 / 40.0] * 2)
    history = fret.LoadHistory.from_spectrum(band, 60.0)
    table = HistoryTable.build(contact(32), history, progress=False)
    counted = HistoryTable.build(contact(32), history.sample(seed=5), progress=False)
    assert counted.total_energy == pytest.approx(table.total_energy, rel=0.08)


def slip_energy(shift: np.ndarray, contact_stiffness: float, rig: float) -> np.ndarray:
    """Energy of loops of a shift of a ball in series with a spring, in partial and gross slip.

    K. L. Johnson, Contact Mechanics (1985), eq. (7.41) and (7.44). In gross slip the contact slides
    by the rest of the shift, twice in a loop.
    """
    force = MU * W
    t = 1.0 - np.linspace(1.0, 0.0, 4001) ** 4
    compliance = 1.5 * force / contact_stiffness
    reach = compliance * (1.0 - (1.0 - t) ** (2.0 / 3.0)) + t * force / rig
    at = np.interp(shift, reach, t)
    outside = 1.0 - at
    unit = 7.2 * force**2 / contact_stiffness
    partial = 1.0 - outside ** (5.0 / 3.0) - 5.0 * at / 6.0 * (1.0 + outside ** (2.0 / 3.0))
    return unit * partial + 4.0 * force * np.maximum(shift - reach[-1], 0.0)


@pytest.mark.parametrize("radius", [0.2, 180.0, 18e3])
def test_gross_slip_under_a_random_shift(radius: float) -> None:
    # The row has no contact but the spring: the limit of a stiff contact, a large ball.
    row = ROWS["gross_slip_random_shift"]
    steel = fret.Elastic(E=210e9, nu=0.3)
    ball, flat = fret.Body(steel, shape=fret.Sphere(R=radius)), fret.Body(steel)
    a = fret.reference.hertz(R=radius, bodies=(steel, steel), W=W).a
    grid = fret.Grid.centred(width=2.6 * a, n=32)
    stiffness = 4.0 * a * steel.G / (2.0 - steel.nu)
    rig = 1.0 / (1.0 / row["stiffness"] - 1.0 / stiffness)
    scene = fret.Scene(body1=ball, body2=flat, friction=MU, grid=grid, path=PRESSED.rig(rig))
    sigma = row["sigma_shift"]
    history = fret.LoadHistory.from_spectrum(
        ([9.0, 11.0], [0.5 * sigma**2] * 2), 1000.0, channel="delta_x", distribution="rayleigh"
    )
    table = HistoryTable.build(scene, history, progress=False)
    per_loop = table.total_energy / history.count().total
    shifts = np.linspace(0.0, 6.0 * sigma, 6001)
    density = shifts / sigma**2 * np.exp(-0.5 * (shifts / sigma) ** 2)
    expected = float(np.trapezoid(density * slip_energy(shifts, stiffness, rig), shifts))
    assert abs(per_loop - expected) < max(table.energy_error, 2e-3) * expected
    assert table.energy_errors["amplitudes"] < 3e-3
    if stiffness > 40.0 * row["stiffness"]:
        assert per_loop == pytest.approx(row["energy_per_cycle"], rel=0.01)


@pytest.mark.parametrize("seed", [0, 1])
def test_the_table_is_the_march_of_like_bodies(seed: int) -> None:
    steel = fatigue.Materials()["steel_42CrMo4"]
    history = fret.LoadHistory.from_array(T_x=random_force(40, seed))
    scene = contact()
    depths = np.array([0.0, 2e-5])
    result = fret.solve(scene, history, progress=False)
    table = HistoryTable.build(scene, history, progress=False)
    assert table.is_exact
    # All branches after those that press and that begin the block.
    marched = float(result.branches().dissipated[2:].sum())
    assert marched == pytest.approx(table.total_energy, rel=0.01)
    by_table = fatigue.damage(scene, history, steel, SWT, depths, y=0.0, table=table)
    by_march = fatigue.damage(result, history, steel, SWT, depths, y=0.0)
    assert by_table.worst == pytest.approx(by_march.worst, rel=0.03)
    assert by_table.place == by_march.place


@pytest.mark.parametrize("criterion", [SWT, "fatemi_socie", "findley", "crossland"])
def test_constant_amplitude_is_cycles_over_life(criterion: fatigue.criteria.CriterionName) -> None:
    steel = fatigue.Materials()["steel_42CrMo4"]
    scene, depths = contact(24), np.array([0.0, 3e-5])
    history = fret.LoadHistory.from_matrix([400.0], [0.0], [1234.0])
    result = fret.solve(scene, PRESSED.cycles(1, T_x=200.0), progress=False)
    lives = criterion in (SWT, "fatemi_socie")
    law = fatigue.DamageLaw(below="elementary", exponent=None if lives else 7.0)
    damage = fatigue.damage(scene, history, steel, criterion, depths, y=0.0, law=law)
    life = result.life(steel, criterion, depths, y=0.0)
    if lives:
        expected = 1234.0 / life.extrapolated()
    else:
        expected = 1234.0 / law.knee * life.dataset.safety_factor.values**-7.0
    judged = expected > 1e-12
    computed = damage.dataset.damage.values[judged]
    assert np.abs(computed / expected[judged] - 1.0).max() < 1e-9
    same = fatigue.damage(result, history, steel, criterion, depths, y=0.0, law=law)
    np.testing.assert_allclose(same.dataset.damage, damage.dataset.damage, rtol=1e-9)


def test_a_mean_is_the_same_from_a_history_and_from_constant_amplitude() -> None:
    # Loops with negative and positive load ratio.
    steel = fatigue.Materials()["steel_42CrMo4"]
    scene = contact(24)
    for low, high in ((-150.0, 50.0), (20.0, 220.0), (-220.0, -20.0)):
        series = fret.LoadHistory.from_array(T_x=[high, low] * 5 + [high])
        matrix = fret.LoadHistory.from_matrix([high - low], [0.5 * (high + low)], [5.0])
        depths = np.array([0.0])
        by_series, by_matrix = (
            fatigue.damage(scene, history, steel, SWT, depths, y=0.0)
            for history in (series, matrix)
        )
        assert by_series.worst == pytest.approx(by_matrix.worst, rel=1e-9)
        assert by_series.dataset["count"].sum() == pytest.approx(5.0)


def test_the_law_below_the_knee_is_named_and_matters_there() -> None:
    steel = fatigue.Materials()["steel_42CrMo4"]
    scene = contact(24)
    history = fret.LoadHistory.from_matrix([60.0], [0.0], [1e6])
    table = HistoryTable.build(scene, history, progress=False)
    worst = {}
    for below in ("original", "haibach", "elementary"):
        law = fatigue.DamageLaw(below=below, knee=1e6)  # type: ignore[arg-type]
        damage = fatigue.damage(scene, history, steel, SWT, [0.0], y=0.0, law=law, table=table)
        worst[below] = damage.worst
        assert any(below.title() in note or below in note for note in damage.notes)
    assert worst["original"] <= worst["haibach"] <= worst["elementary"]
    with pytest.raises(ValueError, match="exponent = nothing: must be given: findley has a limit"):
        fatigue.damage(scene, history, steel, "findley", [0.0], y=0.0, table=table)
    with pytest.raises(ValueError, match="below = 'linear'"):
        fatigue.DamageLaw(below="linear")  # type: ignore[arg-type]


def test_compressive_loops_are_marked() -> None:
    steel = fatigue.Materials()["steel_42CrMo4"]
    scene = contact(24)
    history = fret.LoadHistory.from_array(T_x=[200.0, -200.0, 190.0, 180.0, 200.0])
    damage = fatigue.damage(scene, history, steel, "fatemi_socie", [1e-4], y=0.0, residual=[-5e9])
    assert damage.dataset.compressive.values.all()
    assert any("no tension" in note for note in damage.notes)


def test_the_order_of_loops_below_the_knee_is_bounded() -> None:
    steel = fatigue.Materials()["steel_42CrMo4"]
    history = fret.LoadHistory.from_matrix([400.0, 150.0], [0.0, 0.0], [1.0, 1e5])
    law = fatigue.DamageLaw(knee=1e6)
    damage = fatigue.damage(contact(24), history, steel, SWT, [0.0], y=0.0, law=law)
    values, counts = damage.dataset.value.values, damage.dataset["count"].values
    sums = [
        fatigue.damage_of_loops(
            values, counts, steel.assessment(SWT), fatigue.DamageLaw(below=below, knee=1e6)
        )
        for below in ("original", "haibach", "elementary")
    ]
    assert sums[0] < sums[1] < sums[2]
    assert damage.worst == pytest.approx(sums[1], rel=1e-3)
    note = next(note for note in damage.notes if note.startswith("Miner's sum"))
    assert "if loops below the knee come before all others" in note


def test_contributions_add_up_and_other_planes_are_bounded() -> None:
    steel = fatigue.Materials()["steel_42CrMo4"]
    history = fret.LoadHistory.from_array(T_x=random_force(30, 3))
    damage = fatigue.damage(contact(24), history, steel, SWT, [0.0], y=0.0)
    assert float(damage.dataset.part.sum()) == pytest.approx(damage.worst, rel=1e-9)
    edges, parts = damage.contributions()
    assert parts.sum() == pytest.approx(1.0)
    assert edges[-1] >= 0.5 * float(damage.dataset["range"].max())
    assert damage.error == pytest.approx(sum(damage.errors.values()))
    assert damage.errors["planes"] < 0.05 * damage.worst
    assert damage.repeats == pytest.approx(1.0 / damage.worst)


def test_a_block_of_equal_loops_wears_as_the_cycles() -> None:
    law = fret.wear.Archard(k=1e-14)
    scene = contact(24)
    cycles = fret.wear.solve(
        scene, path=PRESSED.cycles(1, T_x=200.0), cycles=1000, body2=law, progress=False
    )
    history = fret.LoadHistory.from_matrix([400.0], [0.0], [10.0])
    block = fret.wear.solve(scene, history=history, cycles=100, body2=law, progress=False)
    for name in ("depth2", "volume2", "dissipated"):
        assert float(block.dataset[name][-1]) == pytest.approx(
            float(cycles.dataset[name][-1]), rel=1e-6
        )


def test_a_block_wears_by_the_energy_of_its_loops() -> None:
    scene = contact(32)
    history = fret.LoadHistory.from_array(T_x=random_force(300, 4), frequency=100.0)
    table = HistoryTable.build(scene, history, progress=False)
    worn = fret.wear.solve(
        scene, history=history, cycles=1, jumps=1, body2=fret.wear.Archard(k=1e-18), progress=False
    )
    assert float(worn.dataset.dissipated[-1]) == pytest.approx(table.total_energy, rel=0.02)
    assert "frequency = 0.33" in worn.dataset.attrs["wear"]


def test_blocks_of_a_history_are_refused_where_they_have_no_meaning() -> None:
    scene = contact(16)
    history = fret.LoadHistory.from_array(T_x=[0.0, 100.0, -100.0])
    law = fret.wear.Archard(k=1e-15, threshold=1e-9)
    with pytest.raises(ValueError, match=r"branch_counts = given: must be left out for laws with"):
        fret.wear.solve(scene, history=history, cycles=1, body2=law, progress=False)
    power = fret.wear.Archard(k=1e-15, factor=("power_density", [(0.0, 1.0), (1.0, 2.0)]))
    with pytest.raises(ValueError, match=r"frequency = nothing"):
        fret.wear.solve(scene, history=history, cycles=1, body2=power, progress=False)
    air = fret.wear.Air(distance="1 mm", power_density=1e3, power_exponent=0.5)
    with pytest.raises(ValueError, match=r"frequency = nothing: must be given in Hz beside"):
        fret.wear.solve(
            scene,
            history=history,
            cycles=1,
            body2=fret.wear.Archard(k=1e-15),
            air=air,
            progress=False,
        )
    with pytest.raises(ValueError, match="path and history"):
        fret.wear.solve(scene, path=PRESSED, history=history, cycles=1, body2=power, progress=False)
    counts = fret.wear.Wear(cycles=1, body2=fret.wear.Archard(k=1e-15), branch_counts=[1.0, -2.0])
    cycle = PRESSED.cycles(1, T_x=100.0)
    with pytest.raises(ValueError, match=r"branch_counts\[1\] = -2"):
        fret.wear.solve(scene, counts, path=cycle, progress=False)
    with pytest.raises(ValueError, match="1 numbers: must be 2, one for each branch"):
        fret.wear.solve(scene, counts.replace(branch_counts=[1.0]), path=cycle, progress=False)


@pytest.mark.parametrize("channel", ["T_x", "T_y"])
def test_a_force_beyond_sliding_is_refused_with_its_row(channel: str) -> None:
    steel = fatigue.Materials()["steel_42CrMo4"]
    series = fret.LoadHistory.from_array(**{channel: [0.0, 100.0, -310.0, 50.0]})
    with pytest.raises(ValueError, match=rf"{channel}\[2\] = -310 N: must be below the sliding"):
        fatigue.damage(contact(16), series, steel, SWT, progress=False)
    matrix = fret.LoadHistory.from_matrix([500.0], [100.0], [1.0], channel=channel)
    with pytest.raises(ValueError, match="amplitude 250 N and mean 100 N: must stay below"):
        fret.wear.solve(contact(16), history=matrix, cycles=1, body2=fret.wear.Archard(k=1e-15))
    band = ([9.0, 11.0], [200.0, 200.0])
    spectrum = fret.LoadHistory.from_spectrum(band, 60.0, channel=channel, mean=250.0)
    with pytest.raises(ValueError, match="and mean 250 N: must stay below the sliding force"):
        fatigue.damage(contact(16), spectrum, steel, SWT, progress=False)


def test_a_result_of_another_history_is_refused() -> None:
    steel = fatigue.Materials()["steel_42CrMo4"]
    scene = contact(16)
    history = fret.LoadHistory.from_array(T_x=[0.0, 100.0, -100.0])
    changed = fret.LoadHistory.from_array(T_x=[0.0, 120.0, -100.0])
    result = fret.solve(scene, history, progress=False)
    with pytest.raises(ValueError, match="no march of this history"):
        fatigue.damage(result, changed, steel, SWT, [0.0], y=0.0)


def test_damage_is_saved_opened_and_drawn(tmp_path) -> None:  # type: ignore[no-untyped-def]
    steel = fatigue.Materials()["steel_42CrMo4"]
    history = fret.LoadHistory.from_array(T_x=random_force(20, 6), frequency=50.0)
    damage = fatigue.damage(contact(16), history, steel, SWT)
    damage.save(tmp_path / "damage.nc")
    again = fret.open(tmp_path / "damage.nc")
    assert again == damage
    assert again.summary() == damage.summary()
    for thing, figures in (
        (damage, ("damage_map", "damage_contributions")),
        (history, ("load_history",)),
        (history.count(), ("loop_histogram",)),
    ):
        for name in figures:
            assert getattr(thing.plot, name)().has_data()  # type: ignore[attr-defined]


def test_a_crack_grows_by_loops_as_by_cycles() -> None:
    # The cycle of a run, and ten loops of its amplitude in a pass.
    paris = fret.fracture.Paris(C=1e-11, m=3.0)
    threshold = fret.fracture.Threshold(dK_th=5e5)
    lengths = np.geomspace(2e-6, 2e-5, 24)
    scene = contact(32)
    result = fret.solve(scene, PRESSED.cycles(1, T_x=250.0), save="all", progress=False)
    cracks = result.crack(-4.8e-4, lengths=lengths, azimuth=0.0, offset=0.0)
    history = fret.LoadHistory.from_matrix([500.0], [0.0], [10.0])
    growth = fret.fracture.grow_by_history(
        scene, history, paris, -4.8e-4, lengths, threshold=threshold, progress=False
    )
    cycles = cracks.life(threshold, paris, start=lengths[0], end=lengths[-1]).cycles
    passes = growth.passes(lengths[0], lengths[-1])
    assert 10.0 * passes == pytest.approx(cycles, rel=0.01)
    half = history.from_matrix([500.0], [0.0], [0.5])
    slower = fret.fracture.grow_by_history(
        scene, half, paris, -4.8e-4, lengths, threshold=threshold, progress=False
    )
    np.testing.assert_allclose(20.0 * slower.growth, growth.growth, rtol=1e-9)
