"""Histories of 200 reversals, marched in full beside the table of few amplitudes."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import pyfret as fret
from conftest import MU, W, sphere_on_flat
from pyfret import fatigue
from pyfret.history.counting import turning_points
from pyfret.history.table import HistoryTable

pytestmark = pytest.mark.solves

PRESSED = fret.LoadPath.start().normal(W)
SWT = "smith_watson_topper"
DEPTHS = np.array([0.0, 2e-5, 6e-5])


def reversals(count: int, seed: int, top: float) -> np.ndarray:
    """Reversals of a wide band that begin and end at the largest, over the sliding force."""
    values = np.random.default_rng(seed).uniform(-0.85 * top, 0.95 * top, 3 * count)
    values[0], values[count // 2] = top, -0.9 * top
    values = values[turning_points(values)][: count + 1]
    values[-1] = values[0]
    return values


def narrow_band(count: int, seed: int, top: float) -> tuple[np.ndarray, np.ndarray]:
    """A narrow band of a number of reversals, and the same a quarter of a cycle later."""
    size = 4 * count
    random = np.random.default_rng(seed)
    frequency = np.fft.rfftfreq(size, 0.125)
    waves = random.standard_normal(frequency.size) - 1j * random.standard_normal(frequency.size)
    waves[(frequency < 0.7) | (frequency > 1.3)] = 0.0
    first, later = np.fft.irfft(waves, size), np.fft.irfft(-1j * waves, size)
    start, scale = -int(first.argmax()), top / float(np.abs(first).max())
    return tuple(scale * np.append(np.roll(v, start), v[-start]) for v in (first, later))  # type: ignore[return-value]


def scene_and_channels(kind: str, seed: int, count: int) -> tuple[fret.Scene, dict[str, Any]]:
    """Return a contact, and the channels of its history."""
    ratio = {"stiff_coating": 2.0, "soft_coating": 0.5}.get(kind, 1.0)
    scene = sphere_on_flat(n=32, ratio=ratio).replace(path=PRESSED)
    top = 0.5 + 0.35 * np.random.default_rng(seed).random()
    if kind == "bulk_out_of_phase":
        force, later = narrow_band(count, seed, top)
        return scene, {"T_x": force * MU * W, "sigma_B": 60e6 * later}
    force = reversals(count, seed, top)
    channels = {"T_x": force * MU * W}
    if kind == "bulk_in_phase":
        channels["sigma_B"] = 70e6 * force
    if kind == "varying_W":
        channels["W"] = W * (1.0 + 0.2 * force)
    return scene, channels


def compare(kind: str, seed: int, count: int) -> tuple[float, float, float, float]:
    """Return the differences of energy and damage to the march, and their printed errors.

    The error of the cells is left out: both have the same ones.
    """
    steel = fatigue.Materials()["steel_42CrMo4"]
    scene, channels = scene_and_channels(kind, seed, count)
    materials = [steel] * (1 + len(scene.body2.coatings))
    history = fret.LoadHistory.from_array(**channels)
    table = HistoryTable.build(scene, history, progress=False)
    by_table = fatigue.damage(scene, history, materials, SWT, DEPTHS, y=0.0, table=table)
    marched = fret.solve(scene, history, progress=False)
    by_march = fatigue.damage(marched, history, materials, SWT, DEPTHS, y=0.0)
    before = len(marched.scene.path.branches) - history.turns().size
    energy = float(marched.branches().dissipated[before + 1 :].sum())
    errors = dict(by_table.errors)
    errors.pop("cells")
    energy_errors = dict(table.energy_errors)
    energy_errors.pop("cells", None)
    return (
        abs(table.total_energy / energy - 1.0),
        sum(energy_errors.values()),
        abs(by_table.worst / by_march.worst - 1.0),
        sum(errors.values()) / by_table.worst,
    )


#: Ten contacts of no part in the choice of any constant.
CONTACTS = [
    ("like", 301),
    ("like", 302),
    ("stiff_coating", 303),
    ("stiff_coating", 304),
    ("soft_coating", 305),
    ("soft_coating", 306),
    ("bulk_in_phase", 307),
    ("bulk_in_phase", 308),
    ("bulk_out_of_phase", 309),
    ("bulk_out_of_phase", 310),
]


@pytest.mark.slow
@pytest.mark.timeout(1200)
def test_the_printed_errors_cover_the_march_of_200_reversals() -> None:
    covered = 0
    for kind, seed in CONTACTS:
        energy, energy_error, damage, damage_error = compare(kind, seed, 200)
        print(
            f"{kind} {seed}: energy {energy:.4f} ({energy_error:.4f}), damage {damage:.4f} "
            f"({damage_error:.4f})"
        )
        if kind in ("like", "bulk_in_phase"):
            assert energy < 0.01, (kind, seed)
            assert damage < 0.03, (kind, seed)
        covered += energy <= energy_error and damage <= damage_error
    assert covered >= 9


@pytest.mark.parametrize(("kind", "seed"), [("like", 1), ("soft_coating", 2), ("varying_W", 3)])
def test_the_printed_errors_cover_the_march(kind: str, seed: int) -> None:
    energy, energy_error, damage, damage_error = compare(kind, seed, 30)
    assert energy <= energy_error
    assert damage <= damage_error
    if kind == "like":
        assert energy < 0.01
        assert damage < 0.03


def narrow(width: float) -> fret.LoadHistory:
    """A band of some width [Hz] round 100 Hz, for 1e5 cycles."""
    rms = 0.13 * MU * W
    band = ([100.0 - 0.5 * width, 100.0 + 0.5 * width], [rms**2 / width] * 2)
    return fret.LoadHistory.from_spectrum(band, 1000.0)


def test_a_spectrum_is_its_series_of_1e5_cycles() -> None:
    # Rainflow of 1e5 cycles beside the distribution; the bars are 3 and 10 %. The bandwidth of 16
    # Hz is about the least at which two standard deviations of one record are within both bars.
    steel = fatigue.Materials()["steel_42CrMo4"]
    scene = sphere_on_flat(n=32).replace(path=PRESSED)
    spectrum = narrow(16.0)
    series = spectrum.sample(seed=2)
    assert series.count().total > 9e4
    energies, damages, scatters, texts = [], [], [], []
    for history in (spectrum, series):
        table = HistoryTable.build(scene, history, progress=False)
        damage = fatigue.damage(scene, history, steel, SWT, [0.0], y=0.0, table=table)
        energies.append(table.total_energy)
        damages.append(damage.worst)
        scatters.append((table.record_scatter, damage.record_scatter))
        texts.append((table.summary(), damage.summary()))
        assert damage.errors["cells"] > 0.0
    assert energies[0] == pytest.approx(energies[1], rel=0.03)
    assert damages[0] == pytest.approx(damages[1], rel=0.10)
    assert scatters[1] == (None, None)
    assert all("one record of 1000 s scatters by" in text for text in texts[0])
    energy_scatter, damage_scatter = scatters[0]
    assert energy_scatter is not None
    assert damage_scatter is not None
    assert 0.01 < energy_scatter < 0.015
    print(f"scatter of one record: {energy_scatter:.4f}, {damage_scatter:.4f}")
    assert damage_scatter < 0.05


@pytest.mark.slow
@pytest.mark.timeout(1200)
def test_a_very_narrow_band_scatters_as_printed() -> None:
    # 1 Hz round 100 Hz: a record of 1e5 cycles has a thousand independent envelopes. One record
    # may miss the bars of 3 and 10 %, the mean of twenty holds them.
    steel = fatigue.Materials()["steel_42CrMo4"]
    scene = sphere_on_flat(n=32).replace(path=PRESSED)
    spectrum = narrow(1.0)
    table = HistoryTable.build(scene, spectrum, progress=False)
    damage = fatigue.damage(scene, spectrum, steel, SWT, [0.0], y=0.0, table=table)
    d = damage.dataset
    judged = (d["part"] > 0.0).values
    amplitudes = 0.5 * d["range"].values[judged]
    each = (d["part"] / d["count"]).values[judged]
    order = np.argsort(amplitudes)
    sums = []
    for seed in range(20):
        levels = spectrum.sample(seed=seed).count().dataset
        a, count = levels.amplitude.values, levels["count"].values
        by_damage = np.exp(np.interp(np.log(a), np.log(amplitudes[order]), np.log(each[order])))
        sums.append((float(count @ table.energy(a)), float(count @ by_damage)))
    for values, mean, scatter, bar in (
        (np.array(sums)[:, 0], table.total_energy, table.record_scatter, 0.03),
        (np.array(sums)[:, 1], damage.worst, damage.record_scatter, 0.10),
    ):
        assert scatter is not None
        print(
            f"scatter {scatter:.3f}, of records {values.std() / mean:.3f}, {values.mean() / mean}"
        )
        assert values.std() / mean == pytest.approx(scatter, rel=0.4)
        assert values.mean() == pytest.approx(mean, rel=bar)
        assert 2.0 * scatter > bar


def test_loops_beyond_the_largest_one_are_within_the_table() -> None:
    # Two loops of which neither holds the other: the table reaches from the least value to the
    # largest.
    steel = fatigue.Materials()["steel_42CrMo4"]
    scene = sphere_on_flat(n=32).replace(path=PRESSED)
    matrix = fret.LoadHistory.from_matrix([200.0, 150.0], [-40.0, 80.0], [3.0, 5.0])
    table = HistoryTable.build(scene, matrix, progress=False)
    assert table.amplitudes[-1] == pytest.approx(0.5 * (155.0 + 140.0))
    # K. L. Johnson, Contact Mechanics (1985), eq. (7.44); the mean has no part in it.
    steel_body = scene.body2.substrate
    a = fret.reference.hertz(R=0.018, bodies=(steel_body, steel_body), W=W).a
    unit = 9.0 * (MU * W) ** 2 / (10.0 * a) * 2.0 * (2.0 - steel_body.nu) / steel_body.G

    def loop_energy(t: float) -> float:
        c = 1.0 - t
        return unit * (1.0 - c ** (5.0 / 3.0) - 5.0 * t / 6.0 * (1.0 + c ** (2.0 / 3.0)))

    expected = 3.0 * loop_energy(100.0 / (MU * W)) + 5.0 * loop_energy(75.0 / (MU * W))
    assert abs(table.total_energy - expected) < table.energy_error * expected
    assert table.total_energy == pytest.approx(expected, rel=0.05)
    damage = fatigue.damage(scene, matrix, steel, SWT, [0.0], y=0.0, table=table)
    assert damage.worst > 0.0


def test_the_errors_of_damage_have_their_sources() -> None:
    steel = fatigue.Materials()["steel_42CrMo4"]
    scene = sphere_on_flat(n=32).replace(path=PRESSED)
    history = fret.LoadHistory.from_array(T_x=reversals(900, 5, 0.8) * MU * W)
    damage = fatigue.damage(scene, history, steel, SWT, [0.0], y=0.0)
    assert set(damage.errors) == {"planes", "increments", "cells", "amplitudes", "classes"}
    assert all(0.0 <= error < 3.0 * damage.worst for error in damage.errors.values())
    assert 0.0 < damage.errors["amplitudes"] < 0.02 * damage.worst
    assert 0.0 < damage.errors["classes"] < 0.02 * damage.worst
    # Another grid is within the error of the cells.
    fine = sphere_on_flat(n=64).replace(path=PRESSED)
    by_fine = fatigue.damage(fine, history, steel, SWT, [0.0], y=0.0)
    assert abs(by_fine.worst - damage.worst) < damage.error
