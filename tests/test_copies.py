"""A copy can be opened whenever its writing is ended, and leftovers go with the next writing."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numcodecs
import numpy as np
import pytest
import xarray as xr

import pyfret as fret
from conftest import SAME_PROCESS
from pyfret._core import StoreError
from pyfret._util import files

pytestmark = [
    pytest.mark.solves,
    pytest.mark.skipif(os.name != "posix", reason="ends a process by a signal"),
]

#: Writes the number argv[2] to argv[1], and ends itself before move argv[3] of a file or folder.
WRITE = """
import os, sys
import xarray as xr
import pyfret as fret
from pyfret._core import StoreError
from pyfret._util import files
from pyfret.study.ledger import FILE
count = 0
def ending(move):
    def moved(source, target, **options):
        global count
        names = {os.path.basename(os.fspath(path)) for path in (source, target)}
        count += os.path.basename(sys.argv[1]) in names
        if count == int(sys.argv[3]):
            os.kill(os.getpid(), 9)
        return move(source, target, **options)
    return moved
os.replace = ending(os.replace)
files.write(xr.Dataset({"a": ("x", [float(sys.argv[2])])}), sys.argv[1], overwrite=True)
"""


def write(place: Path, number: float, ended_before: int = -1) -> int:
    """Write a number in a process of its own; return its exit code."""
    command = [sys.executable, "-c", WRITE, str(place), str(number), str(ended_before)]
    return subprocess.run(command, check=False).returncode


@pytest.mark.parametrize("name", ["copy.zarr", "copy.nc"])
def test_a_copy_opens_wherever_its_writing_is_ended(name: str, tmp_path: Path) -> None:
    place, dataset = tmp_path / name, xr.Dataset({"a": ("x", [1.0])})
    files.write(dataset, place)
    moves = 0
    for move in range(1, 5):
        code = write(place, 2.0, ended_before=move)
        if code == 0:
            break
        assert code == -signal.SIGKILL
        moves += 1
        assert float(files.opened(place).a[0]) in (1.0, 2.0)
        files.write(dataset, place, overwrite=True)
    assert moves == (2 if name.endswith(".zarr") else 1)
    assert [path.name for path in tmp_path.iterdir()] == [name]


#: Runs studies in folders of argv[1], each in a process of its own: one is whole, each of the
#: others is ended before a move of a file and run again. Prints what is wrong.
STUDIES = """
import os, sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
import zarr
import pyfret as fret
import pyfret.study.store
from pyfret._util.lazy import xr

xr.Dataset

def run(place, ended_before):
    child = os.fork()
    if child:
        return os.waitpid(child, 0)[1]
    count = 0
    def ending(move):
        def moved(source, target, **options):
            nonlocal count
            count += os.fspath(target).startswith(str(place.parent))
            if count == ended_before:
                os.kill(os.getpid(), 9)
            return move(source, target, **options)
        return moved
    os.replace, os.rename = ending(os.replace), ending(os.rename)
    steel = fret.Elastic(E=210e9, nu=0.3)
    scene = fret.Scene(
        body1=fret.Body(steel, shape=fret.Sphere(R=0.01)),
        body2=fret.Body(steel),
        friction=0.3,
        grid=fret.Grid.centred(width=8e-4, n=16),
        path=fret.LoadPath.start().normal(100.0, increments=1),
    )
    fret.study.run(
        scene, {"mu": [0.2]}, measure="p_max", executor=ThreadPoolExecutor(1), out=place,
        progress=False,
    )
    assert fret.open(place).count()["done"] == 1
    (place.parent / "moves").write_text(str(count))
    os._exit(0)

def contents(place):
    files = (path for path in place.rglob("*") if path.is_file())
    names = {str(path.relative_to(place)): path.read_bytes() for path in files}
    return {name: data for name, data in names.items() if not name.startswith("seconds/")}

root = Path(sys.argv[1])
(root / "whole").mkdir()
assert run(root / "whole" / "study.zarr", -1) == 0
expected = contents(root / "whole" / "study.zarr")
moves = int((root / "whole" / "moves").read_text())
for move in range(1, moves + 1):
    folder = root / str(move)
    folder.mkdir()
    place = folder / "study.zarr"
    if run(place, move) != 9:
        print(f"move {move}: was not ended")
    if run(place, -1) != 0:
        print(f"move {move}: does not go on")
    found = contents(place)
    if found != expected:
        names = {name for name in {**found, **expected} if found.get(name) != expected.get(name)}
        print(f"move {move}: {sorted(names)}")
    if {path.name for path in folder.iterdir()} != {"study.zarr", "moves"}:
        print(f"move {move}: leaves {sorted(path.name for path in folder.iterdir())}")
print(f"{moves} moves")
"""


@pytest.mark.slow
def test_a_study_goes_on_wherever_its_writing_is_ended(tmp_path: Path) -> None:
    """Leave the same bytes and nothing else, with an end at every move of a file."""
    command = [sys.executable, "-c", STUDIES, str(tmp_path)]
    ended = subprocess.run(command, check=True, capture_output=True, text=True)
    *wrong, moves = ended.stdout.splitlines()
    assert not wrong, "\n".join(wrong)
    assert int(moves.removesuffix(" moves")) > 10


def test_leftovers_of_running_processes_stay(tmp_path: Path) -> None:
    place = tmp_path / "copy.nc"
    running = files.leftover(place, files.UNFINISHED, f"{files.platform.node()}-{os.getppid()}")
    elsewhere = files.leftover(place, files.UNFINISHED, "another-machine-1")
    running.touch()
    elsewhere.touch()
    files.write(xr.Dataset({"a": ("x", np.ones(2))}), place)
    assert running.exists()
    assert elsewhere.exists()


def contents(folder: Path) -> dict[str, bytes]:
    """Return the bytes of all files of a folder, by their names in it."""
    files_of = (path for path in folder.rglob("*") if path.is_file())
    return {str(path.relative_to(folder)): path.read_bytes() for path in files_of}


def test_the_same_numbers_give_the_same_bytes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Copies and studies, written at different times; a study without its processor times."""
    dataset = xr.Dataset({"a": ("x", np.linspace(0.0, 1.0, 1000))})
    places = [tmp_path / "one.zarr", tmp_path / "two.zarr"]
    for n, folder in enumerate(places):
        monkeypatch.setattr(time, "time", lambda n=n: 1e9 + n)
        files.write(dataset, folder)
    first, second = map(contents, places)
    assert first == second
    assert any(name.startswith("a/") for name in first)
    with xr.open_zarr(places[0], chunks=None) as read:
        np.testing.assert_array_equal(read.a, dataset.a)

    steel = fret.Elastic(E=210e9, nu=0.3)
    ball = fret.Body(steel, shape=fret.Sphere(R=0.01))
    scene = fret.Scene(
        body1=ball,
        body2=fret.Body(steel),
        friction=0.3,
        grid=fret.Grid.centred(width=8e-4, n=16),
        path=fret.LoadPath.start().normal(100.0, increments=1),
    )
    studies = [tmp_path / "study1.zarr", tmp_path / "study2.zarr"]
    for folder in studies:
        fret.study.run(
            scene,
            {"mu": [0.2, 0.4]},
            measure=["p_max"],
            executor=SAME_PROCESS,
            out=folder,
            progress=False,
        )
    first, second = map(contents, studies)
    assert first.keys() == second.keys()
    different = {name for name in first if first[name] != second[name]}
    assert all(name.startswith("seconds/") for name in different), different


@pytest.mark.parametrize("codec", ["gzip", "zlib", "zstd", "blosc"])
def test_a_chunk_that_unpacks_to_more_than_its_array_is_refused(codec: str, tmp_path: Path) -> None:
    """Before it is unpacked whole: a chunk of one megabyte that holds hundreds."""
    folder = tmp_path / "copy.zarr"
    files.write(xr.Dataset({"a": ("x", np.zeros(1000))}), folder)
    packers = {
        "gzip": numcodecs.GZip(level=1),
        "zlib": numcodecs.Zlib(level=1),
        "zstd": numcodecs.Zstd(level=1),
        "blosc": numcodecs.Blosc(),
    }
    for document in (folder / "a" / ".zarray", folder / ".zmetadata"):
        text = json.loads(document.read_text())
        array = text.get("metadata", {}).get("a/.zarray", text)
        array["compressor"] = packers[codec].get_config()
        document.write_text(json.dumps(text))
    chunk = folder / "a" / "0"
    chunk.write_bytes(packers[codec].encode(bytes(8000)))
    assert float(files.opened(folder).a.sum()) == 0.0
    chunk.write_bytes(packers[codec].encode(bytes(400 << 20)))
    assert chunk.stat().st_size < 1 << 22
    with pytest.raises(StoreError, match=r"a/0: unpacks to more than its 8000 bytes"):
        files.opened(folder)
