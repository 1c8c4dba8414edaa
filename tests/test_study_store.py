"""Stores of studies: after a kill nothing is lost, after damage nothing is read wrong."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

import pyfret as fret
from pyfret.errors import StoreError
from pyfret.study.ledger import FILE

pytestmark = pytest.mark.solves

STEEL = fret.Elastic(E=210e9, nu=0.3)
SCENE = fret.Scene(
    body1=fret.Body(STEEL, shape=fret.Sphere(R=5e-3)),
    body2=fret.Body(STEEL),
    friction=0.3,
    grid=fret.Grid.centred(width=2e-4, n=8),
    path=fret.LoadPath.start().normal(10.0, increments=1),
)
TOML = """schema = 1
body1 = { shape = { sphere = { R = 5e-3 } }, E = 210e9, nu = 0.3 }
body2 = { shape = "flat", E = 210e9, nu = 0.3 }
friction = { mu = 0.3 }
grid = { n = 8, extent = 2e-4 }
path = { file = "h.csv", increments = 1 }
"""


def solved(
    place: Path | None, values: object = (0.2, 0.3, 0.4), **options: object
) -> fret.study.Study:
    """The largest pressure over mu, in this process."""
    text = {"measure": "p_max", "executor": ThreadPoolExecutor(1), "progress": False} | options
    return fret.study.run(SCENE, {"mu": list(values)}, out=place, **text)  # type: ignore[call-overload]


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A store of three points."""
    path: Path = tmp_path_factory.mktemp("study") / "s.zarr"
    solved(path)
    return path


def files_of(store: Path) -> list[str]:
    """The files of a store, without documents that are read from the consolidated ones."""
    single = (".zattrs", ".zarray", ".zgroup")
    computed = [p.relative_to(store) for p in store.rglob("*") if p.is_file()]
    return sorted(str(p) for p in computed if p.name not in single)


def test_the_same_study_at_another_time_writes_the_same_bytes(
    whole: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """All files are equal but the processor times of the points."""
    clock = time.time
    monkeypatch.setattr(time, "time", lambda: clock() + 1e6)
    solved(tmp_path / "s.zarr")
    files = sorted(p.relative_to(whole) for p in whole.rglob("*") if p.is_file())
    assert files == sorted(
        p.relative_to(tmp_path / "s.zarr") for p in (tmp_path / "s.zarr").rglob("*") if p.is_file()
    )
    changed = [
        str(file)
        for file in files
        if (whole / file).read_bytes() != (tmp_path / "s.zarr" / file).read_bytes()
    ]
    assert [file for file in changed if "seconds" not in file] == []


def test_every_damage_is_named_or_harmless(whole: Path, tmp_path: Path) -> None:
    """Each file missing, cut, and with a byte changed: an error, or the right values."""
    right = fret.open(whole).dataset.load()
    assert len(files_of(whole)) > 7
    wrong = []
    for name in files_of(whole):
        for kind in ("gone", "cut", "changed"):
            path = tmp_path / "copy.zarr"
            shutil.rmtree(path, ignore_errors=True)
            shutil.copytree(whole, path)
            file = path / name
            content = file.read_bytes()
            if kind == "gone":
                file.unlink()
            elif kind == "cut":
                file.write_bytes(content[: len(content) // 2])
            else:
                middle = len(content) // 2
                file.write_bytes(
                    content[:middle] + bytes([content[middle] ^ 0x24]) + content[middle + 1 :]
                )
            try:
                computed = fret.open(path).dataset.load()
            except StoreError as error:
                if "copy.zarr" not in str(error):
                    wrong.append(f"{name} {kind}: {error}")
            except Exception as raw:
                wrong.append(f"{name} {kind}: {type(raw).__name__} {raw}")
            else:
                if not computed.identical(right):
                    wrong.append(f"{name} {kind}: read as other values")
    assert not wrong, "\n".join(wrong)


def test_a_line_that_is_not_finished_is_left_out(whole: Path, tmp_path: Path) -> None:
    path = tmp_path / "s.zarr"
    shutil.copytree(whole, path)
    ledger = (path / FILE).read_bytes()
    lines = ledger.splitlines(keepends=True)
    # The status of its point stands in the arrays: the file has been cut off later.
    (path / FILE).write_bytes(b"".join(lines[:-1]) + lines[-1][:-9])
    with pytest.raises(StoreError, match="has a status and no line"):
        fret.open(path)


@pytest.mark.parametrize("after", ["values", "line"])
def test_a_kill_within_a_point(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, after: str) -> None:
    """After the values, or after the line in the ledger: the point is solved again, or counts."""
    from pyfret.study import ledger, store

    path, count = tmp_path / "s.zarr", 0

    def killed(*_: object) -> None:
        nonlocal count
        count += 1
        if count == 2:
            raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        item = ledger.Ledger if after == "values" else store.Store
        name = "add" if after == "values" else "write_status"
        true = getattr(item, name)

        def call(self: object, *arguments: object) -> None:
            killed()
            true(self, *arguments)

        patch.setattr(item, name, call)
        with pytest.raises(KeyboardInterrupt):
            solved(path)
    assert fret.open(path).count()["done"] == 1
    assert solved(path).count()["done"] == 3
    np.testing.assert_array_equal(
        fret.open(path).dataset.p_max, solved(tmp_path / "other.zarr").dataset.p_max
    )


def test_a_kill_while_it_is_laid_out_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from pyfret.study import store

    path = tmp_path / "s.zarr"

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(store.Ledger, "begin", full)
        with pytest.raises(OSError, match="No space left"):
            solved(path)
    assert not list(tmp_path.iterdir())
    assert solved(path).count()["done"] == 3


def test_failed_points_are_solved_again_in_place(tmp_path: Path) -> None:
    path, fails = tmp_path / "s.zarr", [True]

    def sometimes(result: fret.Result) -> float:
        if fails[0]:
            sys.exit(3)
        return float(result.p_max.max())

    # What it refers to changes, what it measures does not.
    sometimes.version = "1"  # type: ignore[attr-defined]
    first = solved(path, measure=[sometimes])
    assert first.count()["failed"] == 3
    assert "SystemExit" in str(first.dataset.reason.values[0])
    fails[0] = False
    assert solved(path, measure=[sometimes]).count()["failed"] == 3
    assert solved(path, measure=[sometimes], again=True).count()["done"] == 3


def test_a_store_has_one_writer(whole: Path, tmp_path: Path) -> None:
    if os.name != "posix":
        pytest.skip("folders cannot be locked")
    from pyfret.study.lock import only_writer

    with only_writer(whole), pytest.raises(StoreError, match="is being written by another process"):
        solved(whole)
    assert solved(whole).count()["done"] == 3
    assert not list(tmp_path.iterdir())


def test_a_scene_whose_files_have_changed_is_another_study(tmp_path: Path) -> None:
    (tmp_path / "s.toml").write_text(TOML)
    (tmp_path / "h.csv").write_text("W\n10\n")

    def go() -> fret.study.Study:
        return fret.study.run(
            tmp_path / "s.toml",
            {"mu": [0.2]},
            measure="p_max",
            executor=ThreadPoolExecutor(1),
            out=tmp_path / "s.zarr",
            progress=False,
        )

    go()
    go()
    (tmp_path / "h.csv").write_text("W\n1\n")
    with pytest.raises(StoreError, match=r"h\.csv has changed since"):
        go()


def named(name: str, value: float) -> Callable[[fret.Result], float]:
    def measure(_: fret.Result) -> float:
        return value

    measure.__name__ = name
    return measure


def test_names_that_say_nothing_are_refused() -> None:
    with pytest.raises(ValueError, match="two measures have the name go"):
        solved(None, measure=[named("go", 2.0), named("go", 3.0)])
    with pytest.raises(ValueError, match="muu: the nearest is mu"):
        fret.study.run(SCENE, {"muu": [0.2, 0.3]}, measure="p_max", progress=False)
    with pytest.raises(ValueError, match=r"no point of the study has a scene.*coatings"):
        fret.study.run(SCENE, {"body2.coatings.3.E": [1e9]}, measure="p_max", progress=False)


SCRIPT = """
import sys, time
import pyfret as fret
from test_study_store import SCENE

def slow(result):
    time.sleep(60)
    return 1.0

if __name__ == "__main__":
    fret.study.run(SCENE, {"mu": [0.1, 0.2, 0.3]}, measure=[slow], executor=2, out=sys.argv[1])
"""


def children(of: int) -> list[int]:
    """Processes below a process."""
    lines = subprocess.run(
        ["ps", "-eo", "pid=,ppid="], capture_output=True, text=True, check=True
    ).stdout.splitlines()
    pairs = [tuple(int(n) for n in line.split()) for line in lines]
    computed = [pid for pid, parent in pairs if parent == of]
    return computed + [below for pid in computed for below in children(pid)]


def alive(pid: int) -> bool:
    """Whether a process is there and no zombie."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


@pytest.mark.skipif(not Path("/proc").is_dir(), reason="no /proc")
def test_workers_end_with_a_caller_that_is_killed(tmp_path: Path) -> None:
    script = tmp_path / "caller.py"
    script.write_text(SCRIPT)
    folder = str(Path(__file__).parent)
    command = [sys.executable, str(script), str(tmp_path / "s.zarr")]
    with subprocess.Popen(command, env=os.environ | {"PYTHONPATH": folder}) as caller:
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline and len(children(caller.pid)) < 2:
            time.sleep(0.2)
        time.sleep(1.0)
        below = children(caller.pid)
        caller.send_signal(signal.SIGKILL)
    assert below
    deadline = time.monotonic() + 30
    while time.monotonic() < deadline and any(alive(pid) for pid in below):
        time.sleep(0.2)
    assert not [pid for pid in below if alive(pid)]
    # What it has left goes on.
    assert solved(tmp_path / "other.zarr").count()["done"] == 3
