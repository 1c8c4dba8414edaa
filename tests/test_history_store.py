"""Histories in a scene file, runs that are killed and go on, blocks of wear and damage."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import pyfret as fret
from conftest import MU, W, sphere_on_flat
from pyfret import fatigue
from pyfret._core import run_command
from pyfret._util.progress import Progress
from pyfret.history import read_history
from pyfret.history.table import HistoryTable

PRESSED = fret.LoadPath.start().normal(W)
SWT = "smith_watson_topper"
FORCE = np.array([0.8, -0.5, 0.3, -0.7, 0.6, -0.2, 0.8]) * MU * W
LAW = fret.wear.Archard(k=1e-14)


def contact(n: int = 24, ratio: float = 1.0) -> fret.Scene:
    return sphere_on_flat(n=n, ratio=ratio).replace(path=PRESSED)


def scene_with(folder: Path, section: str, n: int = 24) -> Path:
    """Write a scene file with a table [history], and a recording beside it."""
    rows = "\n".join(f"{0.01 * k:.2f};{force:.6f}" for k, force in enumerate(FORCE))
    (folder / "rig.csv").write_text(f"t [s];T_x [N]\n{rows}\n", encoding="utf-8")
    wear = "[wear]\ncycles = 10\nbody2 = { k = 1e-14 }\n"
    file = folder / "scene.toml"
    file.write_text(f"{contact(n).to_toml()}\n{wear}\n{section}", encoding="utf-8")
    return file


def test_a_recording_is_named_in_the_scene_file(tmp_path: Path) -> None:
    file = scene_with(tmp_path, '[history]\nfile = "rig.csv"\nresidue = "half"\n')
    history = read_history(file)
    assert history is not None
    np.testing.assert_allclose(history.channels["T_x"], FORCE, rtol=1e-6)
    assert history.residue == "half"
    changed = read_history(file, {"history.residue": "repeat"})
    assert changed is not None
    assert changed.residue == "repeat"
    assert read_history(scene_with(tmp_path, "")) is None
    assert fret.Scene.from_file(file).path.W[-1] == W


def test_spectra_and_loops_are_in_the_scene_file(tmp_path: Path) -> None:
    spectrum = "{ frequencies = [9.0, 11.0], values = [50.0, 50.0], duration = 60.0, mean = 5.0 }"
    history = read_history(scene_with(tmp_path, f"[history]\nspectrum = {spectrum}\n"))
    assert history is not None
    assert history.spectrum is not None
    assert history.spectrum.rms == pytest.approx(10.0)
    assert history.mean == 5.0
    matrix = "{ range = [100.0, 200.0], mean = [0.0], counts = [[5.0], [1.0]], channel = 'T_y' }"
    history = read_history(scene_with(tmp_path, f"[history]\nmatrix = {matrix}\n"))
    assert history is not None
    assert history.count().total == 6.0
    assert history.channel == "T_y"


@pytest.mark.parametrize(
    ("section", "message"),
    [
        ("[history]\n", "no source: must have one of file, spectrum, matrix"),
        ("[history]\nfile = 3\n", "must be the name of a file"),
        ('[history]\nfile = "absent.csv"\n', "absent.csv"),
        ('[history]\nfile = "../rig.csv"\n', "must lie in the folder of the scene"),
        ('[history]\nfile = "rig.csv"\nresidue = "full"\n', "residue = 'full'"),
        ("[history]\nspectrum = { frequencies = [1.0, 2.0] }\n", "values is missing"),
        (
            "[history]\nspectrum = { frequencies = [1, 2], values = [1, -3], duration = 9 }\n",
            r"density\[1\] = -3",
        ),
        (
            "[history]\nt = 'time'\nmatrix = { range = [1.0], mean = [0.0], counts = [1.0] }\n",
            "history.t: must be left out beside matrix",
        ),
        ("[history]\nmatrix = { range = [-1.0], mean = [0], counts = [1] }\n", r"range\[0\] = -1"),
    ],
)
def test_histories_of_scene_files_are_refused_by_name(
    section: str, message: str, tmp_path: Path
) -> None:
    with pytest.raises((ValueError, OSError), match=message):
        read_history(scene_with(tmp_path, section))


@pytest.mark.solves
def test_the_command_takes_the_history_of_the_scene(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    file = scene_with(tmp_path, '[history]\nfile = "rig.csv"\n', n=16)
    command = [sys.executable, "-m", "pyfret", "damage", str(file)]
    block = tmp_path / "block.toml"
    run = subprocess.run(
        [*command, "--material", "steel_42CrMo4", "--json", "--block", str(block)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    answer = json.loads(run.stdout)
    assert answer["loops"] == 3
    assert sum(answer["errors"].values()) == pytest.approx(answer["error"])
    # What wears by the block wears by the history.
    assert run_command(["fret", "wear", str(block), "-o", str(tmp_path / "w.zarr"), "-q"]) == 0
    by_block = fret.open(tmp_path / "w.zarr")
    by_file = fret.wear.solve(file, progress=False)
    np.testing.assert_array_equal(by_block.dataset.worn2, by_file.dataset.worn2)
    assert float(by_file.depth2[-1]) > 0.0
    capfd.readouterr()
    assert run_command(["fret", "wear", str(file), "-o", str(tmp_path / "v.zarr")]) == 2
    assert "fret damage SCENE --block FILE" in capfd.readouterr().err


def kill_when(store: Path, code: str, path: Path) -> None:
    """Run code in a process of its own, and kill it once a file or folder is there."""
    script = f"import sys; sys.path.insert(0, {str(Path(__file__).parent)!r})\n{code}"
    process = subprocess.Popen([sys.executable, "-c", script])
    deadline = time.monotonic() + 120.0
    while not path.exists() and process.poll() is None and time.monotonic() < deadline:
        time.sleep(0.005)
    process.send_signal(signal.SIGKILL)
    assert process.wait() == -signal.SIGKILL
    assert store.exists()


@pytest.mark.solves
def test_damage_goes_on_to_the_same_bytes(tmp_path: Path) -> None:
    store = tmp_path / "store"
    code = (
        "from test_history_store import damage_of\nfrom pathlib import Path\n"
        f"damage_of(Path({str(store)!r}))"
    )
    kill_when(store, code, store / "4_amplitudes.zarr")
    damage = damage_of(store)
    whole = damage_of(tmp_path / "whole")
    assert damage.summary() == whole.summary()
    for name, values in whole.dataset.variables.items():
        assert values.values.tobytes() == damage.dataset[name].values.tobytes(), name
    # Once more everything is there.
    assert damage_of(store) == damage


def damage_of(store: Path) -> fatigue.Damage:
    """Damage by a table whose runs are in a folder."""
    steel = fatigue.Materials()["steel_42CrMo4"]
    history = fret.LoadHistory.from_array(T_x=np.append(FORCE[:-1], [0.1 * W, -0.1 * W, FORCE[0]]))
    scene = contact(32)
    return fatigue.damage(scene, history, steel, SWT, [0.0], y=0.0, store=store, progress=False)


@pytest.mark.solves
def test_a_store_of_another_history_is_refused(tmp_path: Path) -> None:
    history = fret.LoadHistory.from_array(T_x=FORCE)
    HistoryTable.build(contact(16), history, store=tmp_path, progress=False)
    changed = fret.LoadHistory.from_array(T_x=0.9 * FORCE)
    with pytest.raises(ValueError, match="holds the table of another scene or history"):
        HistoryTable.build(contact(16), changed, store=tmp_path, progress=False)


@pytest.mark.solves
def test_the_runs_of_a_table_are_counted_for_a_progress_bar(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    counts: list[tuple[int, int]] = []
    monkeypatch.setattr(Progress, "observer", lambda done, total: counts.append((done, total)))
    history = fret.LoadHistory.from_array(T_x=FORCE)
    HistoryTable.build(contact(16), history)
    # One run presses the bodies, one goes through the loops.
    assert sum(done == total for done, total in counts) == 2


def wear_of(store: Path) -> None:
    """Wear by a history, in a store."""
    history = fret.LoadHistory.from_array(T_x=FORCE)
    fret.wear.solve(
        contact(), history=history, cycles=2e4, jumps=12, body2=LAW, out=store, progress=False
    )


@pytest.mark.solves
def test_wear_by_a_history_goes_on_to_the_same_bytes(tmp_path: Path) -> None:
    store = tmp_path / "wear.zarr"
    code = (
        "from test_history_store import wear_of\nfrom pathlib import Path\n"
        f"wear_of(Path({str(store)!r}))"
    )
    kill_when(store, code, store / ".zattrs")
    resumed = fret.wear.resume(store, progress=False)
    wear_of(tmp_path / "whole.zarr")
    whole = fret.open(tmp_path / "whole.zarr")
    for name, values in whole.dataset.variables.items():
        assert values.values.tobytes() == resumed.dataset[name].values.tobytes(), name


@pytest.mark.solves
def test_wear_moves_the_worst_point() -> None:
    steel = fatigue.Materials()["steel_42CrMo4"]
    history = fret.LoadHistory.from_array(T_x=FORCE)
    scene = contact(32)
    worn = fret.wear.solve(scene, history=history, cycles=4e4, body2=LAW, progress=False)
    fresh, later = (
        fatigue.damage(s, history, steel, SWT, [0.0, 2e-5], y=0.0, progress=False)
        for s in (scene, worn.worn_scene)
    )
    assert later.place != fresh.place
    total_damage = fatigue.add_damages([fresh, later], [1000.0, 2000.0])
    total = 1000.0 * fresh.dataset.damage + 2000.0 * later.dataset.damage
    np.testing.assert_allclose(total_damage.dataset.damage, total)
    assert total_damage.worst == pytest.approx(float(total.max()))
    assert total_damage.worst < 1000.0 * fresh.worst + 2000.0 * later.worst
    assert total_damage.error == pytest.approx(1000.0 * fresh.error + 2000.0 * later.error)
    with pytest.raises(ValueError, match="2 damages and 1 passes"):
        fatigue.add_damages([fresh, later], [1.0])
    elsewhere = fatigue.damage(scene, history, steel, SWT, [3e-5], y=0.0, progress=False)
    with pytest.raises(ValueError, match=r"damages\[1\]: is on another section"):
        fatigue.add_damages([fresh, elsewhere], [1.0, 1.0])


def test_the_equivalent_amplitude_of_a_history_and_of_its_loops() -> None:
    history = fret.LoadHistory.from_matrix([2.0, 4.0], [0.0, 0.0], [3.0, 1.0])
    expected = ((3.0 * 1.0**5 + 2.0**5) / 4.0) ** 0.2
    assert fatigue.equivalent_amplitude(history, 5.0) == pytest.approx(expected)
    assert fatigue.equivalent_amplitude(history.count(), 5.0) == pytest.approx(expected)
