"""Load histories: reading, counting, spectra; each known trap of counting is a test."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyfret as fret
from conftest import ROOT, sphere_on_flat
from pyfret import fatigue
from pyfret.history import Spectrum
from pyfret.history.counting import count_signal, rearranged, turning_points
from pyfret.history.energy_curve import EnergyCurve
from pyfret.history.memory import state_weights
from pyfret.history.scatter import record_scatter

ROWS = json.loads((ROOT / "tests/data/vibration/rows.json").read_text())


def walk(size: int, seed: int) -> np.ndarray:
    return np.cumsum(np.random.default_rng(seed).normal(size=size))


def by_range(rows: np.ndarray) -> dict[str, float]:
    counts: dict[str, float] = {}
    for size, count in rows[:, [0, 2]]:
        counts[f"{size:g}"] = counts.get(f"{size:g}", 0.0) + count
    return counts


def test_the_example_of_the_standard_is_counted_exactly() -> None:
    row = ROWS["rainflow_E1049"]
    assert by_range(fatigue.rainflow(row["series"])) == row["cycles_by_range"]


@pytest.mark.parametrize("residue", ["half", "repeat"])
@pytest.mark.parametrize("seed", range(12))
def test_the_largest_range_is_that_of_the_history(residue: Any, seed: int) -> None:
    # The sum of counts does not show a lost cycle.
    values = walk(60 + 37 * seed, seed)
    rows = count_signal(values, residue)
    assert rows[:, 0].max() == pytest.approx(np.ptp(values), rel=1e-14)
    ends = values[rows[:, 3:].astype(int)]
    np.testing.assert_allclose(np.abs(ends[:, 0] - ends[:, 1]), rows[:, 0], rtol=1e-12)
    np.testing.assert_allclose(ends.mean(axis=1), rows[:, 1], atol=1e-12 * np.ptp(values))


@pytest.mark.parametrize("seed", range(8))
def test_every_reversal_of_a_block_is_in_one_loop(seed: int) -> None:
    values = walk(200, seed)
    turns = rearranged(values)
    rows = count_signal(values, "repeat")
    assert (rows[:, 2] == 1.0).all()
    # A block of n ranges has n/2 loops, and their ranges add up to half of its way.
    assert len(rows) == (turns.size - 1) / 2
    length = np.abs(np.diff(values[turns])).sum()
    assert 2.0 * rows[:, 0].sum() == pytest.approx(length, rel=1e-12)


@pytest.mark.parametrize("seed", range(6))
def test_the_block_is_counted_as_by_four_points(seed: int) -> None:
    rainflow = pytest.importorskip("pylife.stress.rainflow")
    values = walk(150, seed)
    recorder = rainflow.FullRecorder()
    detector = rainflow.FourPointDetector(recorder=recorder)
    detector.process(values[rearranged(values)])
    theirs = np.sort(np.abs(np.array(recorder.values_from) - np.array(recorder.values_to)))
    ours = np.sort(count_signal(values, "repeat")[:, 0])
    # The largest loop stays in the residue of the four points.
    np.testing.assert_allclose(theirs, ours[:-1], rtol=1e-12)
    assert ours[-1] == pytest.approx(np.ptp(values))


def test_one_hump_is_counted() -> None:
    rows = fatigue.rainflow([0, 100, 0])
    assert rows[:, 0].tolist() == [100.0, 100.0]
    assert rows[:, 2].sum() == 1.0
    assert count_signal(np.array([0.0, 100.0, 0.0]), "repeat")[:, :3].tolist() == [
        [100.0, 50.0, 1.0]
    ]
    assert fatigue.rainflow([5.0, 5.0]).shape == (0, 3)
    assert fatigue.rainflow([0.0, 7.0]).tolist() == [[7.0, 3.5, 0.5]]


def test_whole_numbers_of_a_logger_do_not_wrap() -> None:
    counts = np.array([0, -20000, 20000, -20000, 0], dtype=np.int16)
    assert fatigue.rainflow(counts)[:, 0].max() == 40000.0
    history = fret.LoadHistory.from_array(T_x=counts)
    assert history.count().largest_range == 40000.0
    narrow = np.array([0, 250, 5, 250], dtype=np.uint8)
    assert fatigue.rainflow(narrow)[:, 0].max() == 250.0


def test_a_hole_beside_a_peak_is_refused_with_its_row() -> None:
    with pytest.raises(ValueError, match=r"signal\[2\] = nan"):
        fatigue.rainflow([0.0, 90.0, np.nan, 0.0])
    with pytest.raises(ValueError, match=r"T_x\[1\] = nan"):
        fret.LoadHistory.from_array(T_x=[0.0, np.nan, 1.0])
    with pytest.raises(ValueError, match="masked"):
        fatigue.rainflow(np.ma.masked_equal([0.0, 1.0, 5.0, 1.0], 5.0))


def test_range_amplitude_and_double_amplitude() -> None:
    loops = fret.LoadHistory.from_array(T_x=[50.0, -30.0]).count().dataset
    assert float(loops["range"].item()) == 80.0
    assert float(loops.amplitude.item()) == 40.0
    assert float(loops["mean"].item()) == 10.0


def test_end_points_count_and_plateaus_do_not() -> None:
    values = np.array([3.0, 3.0, 1.0, 1.0, 1.0, 2.0, 2.0, 0.0])
    assert turning_points(values).tolist() == [0, 2, 5, 7]
    assert fatigue.rainflow(values)[:, 0].max() == 3.0


def test_a_flat_band_has_fewer_crossings_than_peaks() -> None:
    spectrum = Spectrum.from_arrays([0.0, 100.0], [4.0, 4.0])
    assert spectrum.up_crossings == pytest.approx(57.735, rel=1e-4)
    assert spectrum.peaks == pytest.approx(77.460, rel=1e-4)
    assert spectrum.rate("rayleigh") == spectrum.up_crossings
    assert spectrum.rate("dirlik") == spectrum.peaks


def test_the_density_is_one_sided_per_hz() -> None:
    history = fret.LoadHistory.from_spectrum(([0.0, 100.0], [4.0, 4.0]), 60.0)
    assert history.spectrum is not None
    assert history.spectrum.rms == pytest.approx(20.0)
    sample = history.sample(seed=3)
    values = sample.channels["T_x"]
    assert values.std() == pytest.approx(20.0, rel=0.01)
    assert values.mean() == pytest.approx(0.0, abs=1e-9)
    assert np.array_equal(values, history.sample(seed=3).channels["T_x"])
    assert not np.array_equal(values, history.sample(seed=4).channels["T_x"])
    # Crossings of the series follow from the moments.
    up = ((values[:-1] < 0.0) & (values[1:] >= 0.0)).sum() / 60.0
    assert up == pytest.approx(57.7, rel=0.05)


def test_lines_are_peak_or_rms_as_they_are_named() -> None:
    frequencies = np.arange(5.0, 50.0, 5.0)
    peaks = np.linspace(1.0, 3.0, frequencies.size)
    by_peak = Spectrum.from_arrays(frequencies, peaks, of="peak")
    by_rms = Spectrum.from_arrays(frequencies, peaks, of="rms")
    assert by_peak.rms**2 == pytest.approx(0.5 * (peaks**2).sum(), rel=1e-12)
    assert by_rms.rms**2 == pytest.approx((peaks**2).sum(), rel=1e-12)
    with pytest.raises(ValueError, match="of = 'amplitude'"):
        Spectrum.from_arrays(frequencies, peaks, of="amplitude")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="line at 0 Hz is a mean"):
        Spectrum.from_arrays([0.0, 1.0, 2.0], [1.0, 1.0, 1.0], of="peak")


def test_the_spectra_are_those_of_flife() -> None:
    FLife = pytest.importorskip("FLife")
    frequencies = np.linspace(1.0, 60.0, 4000)
    density = 5.0 * np.exp(-(((frequencies - 12.0) / 4.0) ** 2)) + np.exp(
        -(((frequencies - 40.0) / 6.0) ** 2)
    )
    ours = Spectrum.from_arrays(frequencies, density)
    data = FLife.SpectralData(input={"PSD": density, "f": frequencies})
    m, C = 5.0, 1e12
    for name, method in (("rayleigh", FLife.Narrowband), ("dirlik", FLife.Dirlik)):
        theirs = 1.0 / method(data).get_life(C=C, k=m)
        damage = ours.rate(name) * ours.mean_power(m, name) / C  # type: ignore[arg-type]
        assert damage == pytest.approx(theirs, rel=2e-4), name


def test_the_damage_of_a_narrow_band() -> None:
    row = ROWS["miner_narrow_band"]
    narrow = Spectrum.from_arrays([10.0, 10.0 + 1e-5], [row["sigma_MPa"] ** 2 * 1e5] * 2)
    damage = row["cycles"] * narrow.mean_power(row["m"], "rayleigh") / row["C"]
    assert damage == pytest.approx(row["damage"], rel=1e-9)


def test_classes_of_a_spectrum_keep_counts_and_powers() -> None:
    history = fret.LoadHistory.from_spectrum(([5.0, 40.0], [2.0, 2.0]), 1e4)
    loops, spectrum = history.count(), history.spectrum
    assert spectrum is not None
    assert loops.total == pytest.approx(spectrum.peaks * 1e4, rel=1e-9)
    for m in (3.0, 5.0):
        exact = spectrum.mean_power(m, "dirlik") ** (1.0 / m)
        assert history.equivalent_amplitude(m) == pytest.approx(exact, rel=2e-3)
    # And a time series has them, too.
    counted = history.sample(seed=1, duration=2000.0).equivalent_amplitude(3.0)
    assert counted == pytest.approx(history.equivalent_amplitude(3.0), rel=0.05)


def test_classes_keep_loops_and_the_cube_of_the_amplitude() -> None:
    loops = fret.LoadHistory.from_array(T_x=walk(5000, 2)).count()
    classes = loops.classes(12)
    assert len(classes) <= 12
    assert (np.diff(classes[:, 0]) < 0.0).all()
    assert classes[:, 2].sum() == pytest.approx(loops.total)
    cubes = (loops.dataset["count"] * loops.dataset.amplitude**3).sum()
    assert (classes[:, 2] * classes[:, 0] ** 3).sum() == pytest.approx(float(cubes))
    few = fret.LoadHistory.from_matrix([2.0, 4.0], [0.0, 0.0], [10.0, 0.5]).count().classes(12)
    assert few.tolist() == [[2.0, 0.0, 0.5], [1.0, 0.0, 10.0]]


def test_a_matrix_has_ranges_by_means() -> None:
    counts = np.array([[1.0, 2.0, 0.0], [0.0, 0.25, 4.0]])
    history = fret.LoadHistory.from_matrix([10.0, 20.0], [-1.0, 0.0, 1.0], counts)
    loops = history.count()
    assert loops.total == 7.25
    assert loops.largest_range == 20.0
    assert loops.equivalent_amplitude(3.0) == pytest.approx(
        ((3.0 * 5.0**3 + 4.25 * 10.0**3) / 7.25) ** (1 / 3)
    )
    for wrong, message in (
        (([10.0], [0.0], [-1.0]), r"counts\[0\] = -1"),
        (([10.0, -2.0], [0.0, 0.0], [1.0, 1.0]), r"range\[1\] = -2"),
        (([10.0], [0.0, 1.0], [1.0]), "as many numbers"),
        (([10.0], [0.0], [0.0]), "above 0 for one loop"),
    ):
        with pytest.raises(ValueError, match=message):
            fret.LoadHistory.from_matrix(*wrong)


@pytest.mark.parametrize(
    ("channels", "message"),
    [
        ({"T_x": [0, 1, 2], "W": [1, 2]}, "W has 2 values and T_x has 3: must be as many"),
        ({"T_x": [0, 1], "t": [0, 1, 2]}, "t has 3 values: must have 2"),
        ({"T_x": [0, 1, 0], "t": [0, 2, 1]}, r"t\[2\] = 1 s: must be later"),
        ({"T_x": [0, 1, 0, 1, 0], "t": [0, 1, 2, 3, 9]}, r"t\[4\] = 9 s: comes 6 s"),
        ({"T_x": [0, 1], "delta_x": [0, 1]}, "must be one of them, the one that drives"),
        ({"force": [0, 1]}, "channel = 'force': must be one of T_x"),
        ({"T_x": [1, 1, 1]}, "is constant: must vary"),
        ({"T_x": [1.0]}, "must have 2 or more"),
        ({"T_x": [[0, 1], [1, 0]]}, "one dimension"),
        ({}, "no channel"),
        ({"T_x": [0, 1], "residue": "full"}, "residue = 'full'"),
        ({"T_x": [0, 1], "frequency": 0.0}, "frequency = 0.0 Hz: must be above 0"),
        ({"T_x": [0, 1], "frequency": 1.0, "t": [0, 1]}, "t and frequency"),
    ],
)
def test_bad_channels_are_refused_by_name(channels: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        fret.LoadHistory.from_array(**channels)


@pytest.mark.parametrize(
    ("psd", "message"),
    [
        (([1.0, 2.0], [1.0, -3.0]), r"density\[1\] = -3"),
        (([2.0, 1.0], [1.0, 1.0]), r"frequency\[1\] = 1"),
        (([1.0, np.nan], [1.0, 1.0]), r"frequencies\[1\] = nan"),
        (([1.0, 2.0], [1.0]), "must be as many numbers"),
        (([1.0, 2.0], [0.0, 0.0]), "above 0"),
    ],
)
def test_bad_spectra_are_refused_with_the_row(psd: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        fret.LoadHistory.from_spectrum(psd, 10.0)


def test_a_recording_is_read_by_its_heads(tmp_path: Path) -> None:
    file = tmp_path / "rig.csv"
    rows = ["time [s];T_x [kN];W [N];note"]
    rows += [f"{0.01 * n:.2f};{0.1 * (-1) ** n:.1f};1000;x" for n in range(6)]
    file.write_text("\n".join(rows), encoding="utf-8")
    history = fret.LoadHistory.from_csv(file)
    assert history.channels["T_x"].tolist() == [100.0, -100.0] * 3
    assert history.channels["W"][0] == 1000.0
    assert history.duration == pytest.approx(0.06)
    history = fret.LoadHistory.from_csv(file, columns={"T_y": "T_x"})
    assert history.channel == "T_y"
    file.write_text("T_x;W [N]\n1;2\n2;3\n", encoding="utf-8")
    with pytest.raises(ValueError, match="'T_x' without a unit: must have a unit of force"):
        fret.LoadHistory.from_csv(file)
    file.write_text("kraft [N];weg [um]\n1;1\n2;3\n", encoding="utf-8")
    with pytest.raises(ValueError, match="no column is named as a channel"):
        fret.LoadHistory.from_csv(file)
    file.write_text("t [s];T_x [N]\n0;1\n1;2\n2;x\n3;1\n", encoding="utf-8")
    with pytest.raises(ValueError, match=":4: must be numbers"):
        fret.LoadHistory.from_csv(file)


def test_a_recording_of_labview_is_read() -> None:
    pytest.importorskip("nptdms")
    file = ROOT / "tests/data/corpus/nptdms.tdms"
    from pyfret.fit.recorders import read_columns

    columns = read_columns(file)
    forces = [n for n, u in zip(columns.names, columns.units, strict=True) if u in ("N", "kN")]
    history = fret.LoadHistory.from_csv(file, columns={"T_x": forces[0]})
    assert history.channels["T_x"].size > 2


def test_a_recording_has_one_clock_and_keeps_it(tmp_path: Path) -> None:
    nptdms = pytest.importorskip("nptdms")
    path = tmp_path / "rig.tdms"

    def write(step: float, size: int) -> None:
        channels = [
            nptdms.ChannelObject(
                "rig",
                name,
                np.arange(n, dtype=float) % 7.0,
                properties={"unit_string": "N", "wf_increment": dt},
            )
            for name, n, dt in (("T_x", 50, 0.01), ("W", size, step))
        ]
        with nptdms.TdmsWriter(path) as file:
            file.write_segment(channels)

    write(0.01, 50)
    history = fret.LoadHistory.from_csv(path)
    assert history.duration == pytest.approx(0.5)
    assert set(history.channels) == {"T_x", "W"}
    for step, size in ((0.1, 5), (0.02, 50)):
        write(step, size)
        with pytest.raises(ValueError, match="different clocks: must have one"):
            fret.LoadHistory.from_csv(path)


@pytest.mark.parametrize("spring", [1e9, 1.0, 0.03])
@pytest.mark.parametrize("top", [0.9, 1.5, 5.7])
def test_the_energy_between_loops_is_within_its_bounds(spring: float, top: float) -> None:
    # A ball in series with a spring; unit force of sliding, unit shift of the ball then.
    t = 1.0 - np.linspace(1.0, 0.0, 4001) ** 4
    d = 1.0 - (1.0 - t) ** (2.0 / 3.0)
    reach = d + t / (1.5 * spring)
    onset = float(reach[-1])

    def energy(shift: np.ndarray) -> np.ndarray:
        at = np.interp(shift, reach, d)
        partial = 8.0 * (at - 0.4 * (1.0 - (1.0 - at) ** 2.5)) - 4.0 * at * (1 - (1 - at) ** 1.5)
        return partial + 4.0 * np.maximum(shift - onset, 0.0)

    shifts = np.linspace(0.1, 1.0, 500) * top * onset
    previous = None
    for count in (8, 16):
        nodes = top * onset * np.arange(1, count + 1) / count
        if previous is not None and previous.onset is not None:
            nodes = np.sort(np.append(nodes[:-1] * count / (count - 1), previous.onset))
            nodes[-1] = top * onset
        curve = EnergyCurve(nodes, energy(nodes), nodes > onset, 2.0)
        difference = np.abs(curve.evaluate(shifts) - energy(shifts))
        change = np.abs(curve.evaluate(shifts) - curve.every_second().evaluate(shifts))
        allowed = change + curve.half_width(shifts)
        assert difference.sum() <= allowed.sum()
        previous = curve
    assert float(difference.sum() / energy(shifts).sum()) < 2e-3
    if top > 1.0:
        assert curve.onset == pytest.approx(onset, rel=0.03)


def test_the_memory_of_a_linear_contact_is_its_load() -> None:
    amplitudes = np.array([0.1, 0.35, 0.6, 1.0])
    values = np.random.default_rng(0).uniform(-1.0, 1.0, 3000)
    values[0], values[7] = 1.0, -1.0
    np.testing.assert_allclose(state_weights(values, amplitudes) @ amplitudes, values, atol=1e-12)


def test_the_memory_closes_loops() -> None:
    amplitudes = np.array([0.25, 0.5, 0.75, 1.0])
    curve = amplitudes**2

    def state(*values: float) -> float:
        return float((state_weights(np.array([1.0, -1.0, *values]), amplitudes) @ curve)[-1])

    assert state(0.5, -0.5, 0.5) == pytest.approx(state(0.5))
    assert state(0.5, -0.5, 0.8) == pytest.approx(state(0.8))
    assert state(0.5, -0.5, 0.8) != pytest.approx(state(0.8, -0.5, 0.6))
    assert state(1.0) == pytest.approx(1.0)
    # A cell that slips at once is at its limit after every reversal.
    saturated = np.minimum(amplitudes / 0.25, 1.0)
    values = np.array([1.0, -1.0, 0.5, -0.3, 0.9, -0.2, 0.4])
    signs = state_weights(values, amplitudes) @ saturated
    np.testing.assert_allclose(signs, [1, -1, 1, -1, 1, -1, 1], atol=1e-12)


def test_a_history_presses_by_the_scene_or_by_itself() -> None:
    history = fret.LoadHistory.from_array(T_x=[0.0, 100.0, -100.0])
    scene = sphere_on_flat()
    pressed = scene.replace(path=fret.LoadPath.start().normal(1e3).cycles(2, T_x=50.0))
    path = history.path(pressed)
    assert [branch.T_x for branch in path.branches] == [0.0, 0.0, 100.0, -100.0]
    assert {branch.W for branch in path.branches} == {1e3}
    with pytest.raises(ValueError, match="nothing presses the bodies"):
        history.path(scene.replace(path=fret.LoadPath.start().tangential([1.0])))
    history = fret.LoadHistory.from_array(T_x=[0.0, 100.0, -100.0], W=[900.0, 1e3, 800.0])
    path = history.path(scene.replace(path=fret.LoadPath.start().tangential([1.0])))
    assert [branch.W for branch in path.branches] == [900.0, 900.0, 1e3, 800.0]
    with pytest.raises(ValueError, match="have no order"):
        fret.LoadHistory.from_matrix([1.0], [0.0], [1.0]).path(pressed)
    assert pressed.path.branches


def test_a_history_is_compared_and_shown() -> None:
    first, second = (fret.LoadHistory.from_array(T_x=[0.0, 1.0, 0.5]) for _ in range(2))
    assert first == second
    assert first != fret.LoadHistory.from_array(T_x=[0.0, 1.0, 0.6])
    assert "T_x: 3 values, 0 to 1 N" in repr(first)
    spectrum = fret.LoadHistory.from_spectrum(([1.0, 2.0], [1.0, 1.0]), 100.0, mean="2 kN")
    assert spectrum.mean == 2000.0
    assert "up-crossings" in spectrum.summary()


def test_counted_loops_are_saved_and_opened(tmp_path: Path) -> None:
    loops = fret.LoadHistory.from_array(T_x=walk(100, 1)).count()
    loops.save(tmp_path / "loops.nc")
    again = fret.open(tmp_path / "loops.nc")
    assert again == loops
    assert again.summary() == loops.summary()
    assert "repeats as a block" in loops.summary()


@pytest.mark.solves
def test_the_scatter_of_records_is_that_of_their_envelopes() -> None:
    # Sums of amplitude^3 and amplitude^8 over 60 records of 2000 cycles, in a band of 4 Hz.
    spectrum = Spectrum.from_arrays([98.0, 102.0], [0.25, 0.25])
    history = fret.LoadHistory.from_spectrum(spectrum, 20.0, distribution="rayleigh")
    d = history.count().dataset
    a, count = d.amplitude.values, d["count"].values
    sums = []
    for seed in range(60):
        _, values = spectrum.sample(20.0, seed=seed)
        rows = count_signal(values, "repeat")
        sums.append([float(rows[:, 2] @ (0.5 * rows[:, 0]) ** m) for m in (3.0, 8.0)])
    for column, m in zip(np.array(sums).T, (3.0, 8.0), strict=True):
        scatter = record_scatter(spectrum, a, count, a**m, 20.0)
        # The standard deviation of 60 records is known to a tenth, of a power of 8 to a quarter.
        assert column.std() / column.mean() == pytest.approx(scatter, rel=0.1 * m)
        # Four times as long a record has half of the scatter.
        assert record_scatter(spectrum, a, count, a**m, 80.0) == pytest.approx(
            0.5 * scatter, rel=0.02
        )
