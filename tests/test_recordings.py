"""Recordings of rigs: columns, units, clocks, turns and drift."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import pyfret as fret
from pyfret.fit.recorders import kind_of_recording, read_columns
from pyfret.fit.recordings import Channel, Recording
from pyfret.fit.turns import TURN, find_turns, remove_drift

CORPUS = Path(__file__).parent / "data" / "corpus"
TURN_OF_LOOP = np.linspace(0.0, 4.0 * np.pi, 201)
SHIFT, FORCE = 20.0 * np.sin(TURN_OF_LOOP), 8.0 * np.tanh(3.0 * np.sin(TURN_OF_LOOP - 0.4))


def one_by_one(delta: np.ndarray) -> list[int]:
    """Find turns point by point."""
    least = TURN * float(np.ptp(delta))
    turns: list[int] = []
    middle = 0.5 * (delta.max() + delta.min())
    extreme, direction = 0, 0
    for n, value in enumerate(delta):
        ahead = value - delta[extreme]
        if direction == 0:
            if abs(ahead) > least:
                if abs(delta[extreme] - middle) > 0.4 * np.ptp(delta):
                    turns.append(extreme)
                direction, extreme = int(np.sign(ahead)), n
        elif direction * ahead >= 0:
            extreme = n
        elif -direction * ahead > least:
            turns.append(extreme)
            direction, extreme = -direction, n
    if abs(delta[extreme] - middle) > 0.4 * np.ptp(delta):
        turns.append(extreme)
    return turns


@pytest.mark.parametrize("seed", range(12))
def test_turns_are_those_of_the_definition(seed: int) -> None:
    rng = np.random.default_rng(seed)
    count = int(rng.integers(500, 6000))
    cycles = float(rng.uniform(0.7, 40.0))
    delta = np.sin(np.linspace(rng.uniform(0, 6), 2 * np.pi * cycles, count))
    delta += rng.uniform(0.0, 0.2) * rng.standard_normal(count)
    # Equal values in a row, as a gauge of few bits has them.
    delta = np.round(delta, int(rng.integers(1, 6)))
    assert find_turns(delta) == one_by_one(delta)


def test_a_shift_that_stands_still_has_no_turns() -> None:
    assert find_turns(np.zeros(5000)) == []
    assert find_turns(np.zeros(0)) == []


@pytest.mark.parametrize("unit", ["°C", "V", "mm/s", "kOhm", "bar", "J", "kg", "-", "a word"])
@pytest.mark.parametrize("named", [True, False])
def test_units_of_columns_that_are_not_used_do_not_matter(
    tmp_path: Path, unit: str, *, named: bool
) -> None:
    table = tmp_path / "rig.csv"
    rows = "\n".join(f"{d:.5f};{f:.5f};24.5" for d, f in zip(SHIFT, FORCE, strict=True))
    table.write_text(f"delta [um];T [N];other [{unit}]\n{rows}", encoding="utf-8")
    names = {"delta": "delta", "T": "T"} if named else {}
    loops = fret.fit.read_loops(table, **names)
    assert np.ptp(loops.delta) == pytest.approx(4e-5, rel=1e-3)
    with pytest.raises(ValueError, match=r"column 'other'|unit of length"):
        fret.fit.read_loops(table, delta="other", T="T")


@pytest.mark.parametrize("cell", ["12:00:01", "2026-11-29 12:00", "ok", "", "NaN", "#N/A"])
def test_cells_of_columns_that_are_not_used_do_not_matter(tmp_path: Path, cell: str) -> None:
    table = tmp_path / "rig.csv"
    rows = "\n".join(f"{cell};{d:.5f};{f:.5f}" for d, f in zip(SHIFT, FORCE, strict=True))
    table.write_text(f"when;delta [um];T [N]\n{rows}", encoding="utf-8")
    assert fret.fit.read_loops(table).delta.max() == pytest.approx(2e-5, rel=1e-3)
    holed = table.read_text(encoding="utf-8").replace(f"{SHIFT[20]:.5f}", "x", 1)
    table.write_text(holed, encoding="utf-8")
    with pytest.raises(ValueError, match=r"rig\.csv:22: must be numbers"):
        fret.fit.read_loops(table)


@pytest.mark.parametrize("separator", [";", "\t", ",", " "])
@pytest.mark.parametrize(
    "head",
    ["delta [um]{0}T [N]", "written by a script\ndelta [um]{0}T [N]", "delta{0}T\n[um]{0}[N]"],
)
@pytest.mark.parametrize("mark", ["# ", "#", "% "])
def test_the_last_comment_above_the_numbers_is_their_head(
    tmp_path: Path, separator: str, head: str, mark: str
) -> None:
    text = head.format(separator)
    np.savetxt(
        tmp_path / "rig.txt",
        np.c_[SHIFT, FORCE],
        delimiter=separator,
        header=text,
        comments=mark,
    )
    loops = fret.fit.read_loops(tmp_path / "rig.txt")
    assert loops.delta.max() == pytest.approx(2e-5, rel=1e-6)


def test_a_comment_of_another_number_of_fields_is_no_head(tmp_path: Path) -> None:
    np.savetxt(tmp_path / "rig.txt", np.c_[SHIFT, FORCE], header="delta [um]", delimiter=";")
    with pytest.raises(ValueError, match="the head, line 1, has 1"):
        fret.fit.read_loops(tmp_path / "rig.txt")


def channel(
    name: str, values: np.ndarray, step: float | None, begin: float = 0.0, unit: str = "um"
) -> Channel:
    """Make a channel of a recording in memory."""
    clock = None if step is None else (begin, step)
    instants = None if step is None else begin + step * np.arange(values.size)
    return Channel(
        "rig",
        name,
        unit,
        values.size,
        lambda: values,
        None if instants is None else lambda: instants,
        clock,
    )


def test_channels_of_one_clock_are_paired_as_they_are() -> None:
    values = np.random.default_rng(0).standard_normal((2, 50))
    for step in (None, 0.01):
        recording = Recording(
            "made up", [channel("a", values[0], step), channel("b", values[1], step)]
        )
        np.testing.assert_array_equal(recording.raw((0, 1)), values)
        assert recording.notes == []
        # The samples of the file stay as they are.
        recording.numbers(0, 1)
        np.testing.assert_allclose(recording.numbers(0, 1), 1e-6 * values)


def test_channels_of_different_clocks_are_resampled_to_the_slower_one_by_a_printed_rule() -> None:
    slow, fine = np.arange(11.0), np.linspace(0.0, 10.0, 101) ** 2
    recording = Recording("made up", [channel("a", slow, 1.0), channel("b", fine, 0.1)])
    np.testing.assert_allclose(recording.raw((0, 1))[1], slow**2, rtol=1e-12)
    assert "b, 101 samples, is interpolated linearly at the 11 instants of a" in recording.notes
    # A late begin: where both were recorded.
    late = Recording("made up", [channel("a", slow, 1.0), channel("b", fine, 0.1, begin=2.5)])
    rows = late.raw((0, 1))
    np.testing.assert_allclose(rows[0], np.arange(3.0, 11.0))
    np.testing.assert_allclose(rows[1], (rows[0] - 2.5) ** 2, atol=0.01)
    # The same number of samples at other instants is another clock.
    shifted = Recording("made up", [channel("a", slow, 1.0), channel("b", slow, 1.0, begin=0.5)])
    np.testing.assert_allclose(shifted.raw((0, 1))[1], shifted.raw((0, 1))[0] - 0.5)


def test_whole_numbers_are_held_not_interpolated() -> None:
    count = np.arange(0, 101, dtype="i4") // 30
    recording = Recording("made up", [channel("a", np.arange(11.0), 1.0), channel("n", count, 0.1)])
    held = recording.raw((0, 1))[1]
    np.testing.assert_array_equal(held, np.arange(0, 101, 10) // 30)
    assert any("the last whole number before" in note for note in recording.notes)


def test_channels_that_cannot_be_aligned_are_refused() -> None:
    with pytest.raises(ValueError, match=r"a has 11, b has 101 samples, and a has no clock"):
        Recording(
            "made up", [channel("a", np.zeros(11), None), channel("b", np.zeros(101), 0.1)]
        ).raw((0, 1))
    with pytest.raises(ValueError, match="recorded at different times"):
        Recording(
            "made up",
            [channel("a", np.zeros(11), 1.0), channel("b", np.zeros(11), 1.0, begin=50.0)],
        ).raw((0, 1))


def test_names_in_several_groups_are_chosen_with_their_group(tmp_path: Path) -> None:
    h5py = pytest.importorskip("h5py")
    path = tmp_path / "runs.h5"
    with h5py.File(path, "w") as file:
        for run, factor in (("first", 1.0), ("second", 2.0)):
            for name, values, unit in (("delta", factor * SHIFT, "um"), ("T", FORCE, "N")):
                file.create_dataset(f"{run}/{name}", data=values).attrs["unit"] = unit
    with pytest.raises(ValueError, match=r"more than one column.*first/delta"):
        fret.fit.read_loops(path)
    for options in ({"group": "second"}, {"delta": "second/delta", "T": "second/T"}):
        loops = fret.fit.read_loops(path, **options)  # type: ignore[arg-type]
        assert loops.delta.max() == pytest.approx(4e-5, rel=1e-3)
    with pytest.raises(ValueError, match="has no group 'third', but 'first', 'second'"):
        fret.fit.read_loops(path, group="third")


@pytest.mark.parametrize(
    ("name", "content", "reason"),
    [
        ("a.mf4", b"UnFinMF 4.10", "finalize it"),
        ("a.xls", b"\xd0\xcf\x11\xe0" + bytes(600), "save it as .xlsx"),
        ("a.tdms", b"TDSm" + bytes(10), r"a\.tdms: (is no whole|has no channels)"),
        ("a.mat", b"MATLAB 5.0 MAT-file" + bytes(200), r"a\.mat"),
        ("a.h5", b"\x89HDF\r\n\x1a\n" + bytes(100), "no whole HDF5 file"),
        ("a.xlsx", b"PK\x03\x04" + bytes(100), "no whole archive"),
    ],
)
def test_other_and_damaged_recordings_are_refused_by_name(
    tmp_path: Path, name: str, content: bytes, reason: str
) -> None:
    (tmp_path / name).write_bytes(content)
    with pytest.raises(ValueError, match=reason):
        fret.fit.read_loops(tmp_path / name)


def test_the_content_decides_the_format(tmp_path: Path) -> None:
    for name, kind in (
        ("nptdms.tdms", "TDMS"),
        ("octave_rig.mat", "MAT 5"),
        ("h5py_rig_73.mat", "MAT 7.3"),
        ("asammdf.mf4", "MDF"),
        ("pandas.xlsx", "Excel"),
        ("pandas_rig.csv", "text"),
    ):
        copied = tmp_path / "record.bin"
        copied.write_bytes((CORPUS / name).read_bytes())
        assert kind_of_recording(copied) == kind
        assert len(read_columns(copied).names) >= 2


def test_a_drift_is_removed_on_request(capsys: pytest.CaptureFixture[str]) -> None:
    angle = np.linspace(0.0, 12.0 * np.pi, 3000)
    shift = 1e-6 * np.cos(angle) + 5e-7 * angle / angle[-1]
    force = 5.0 * np.sin(angle) + 0.1 * angle
    drifting = fret.fit.Loops.from_arrays(shift, force)
    still = fret.fit.Loops.from_arrays(shift, force, detrend=True)
    assert abs(drifting.drift[1]) > 2.5
    assert abs(still.drift[1]) < 0.05
    assert abs(still.drift[0]) < 0.02 * abs(drifting.drift[0])
    assert still.drifts is False
    assert "drift removed" in capsys.readouterr().err
    with pytest.raises(ValueError, match="two whole cycles"):
        remove_drift(shift, [0, 500])


def test_measured_loops_are_described_and_drawn() -> None:
    # A spring of 8 N/um in series with friction of 60 N; 4.5 cycles of 50 um: one is not whole.
    t = np.linspace(0.0, 5.0, 1801)
    shift = 50e-6 * np.sin(2.0 * np.pi * t)
    force, slid = np.zeros_like(shift), 0.0
    for n, value in enumerate(shift):
        force[n] = np.clip(8e6 * (value - slid), -60.0, 60.0)
        slid = value - force[n] / 8e6
    loops = fret.fit.Loops.from_arrays(shift, force)
    expected = 4.0 * 60.0 * (50e-6 - 60.0 / 8e6)
    np.testing.assert_allclose(loops.energies, expected, rtol=2e-3)
    assert loops.energies.size == 4
    text = loops.summary()
    assert "4 whole cycles" in text
    assert "energy per cycle 0.0102 J" in text
    assert "the loops slide" in text
    ax = loops.plot()
    assert ax.get_ylabel() == "force [N]"


def test_one_cycle_with_two_turns_is_one_loop() -> None:
    t = np.linspace(0.0, 1.0, 400)
    loops = fret.fit.Loops.from_arrays(1e-6 * np.sin(2.0 * np.pi * t), np.cos(2.0 * np.pi * t))
    assert int(loops.cycle.max()) == 0
    assert loops.down.sum() == pytest.approx(200, abs=2)
    np.testing.assert_allclose(loops.energies, 1e-6 * np.pi, rtol=1e-3)
