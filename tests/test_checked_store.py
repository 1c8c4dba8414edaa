"""Large stores: opened by their metadata, checked where they are read."""

from __future__ import annotations

import pickle
import shutil
from typing import TYPE_CHECKING

import numpy as np
import pytest

import pyfret as fret
from conftest import W, sphere_on_flat
from pyfret import _core
from pyfret.run import checked_store

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.solves


@pytest.fixture(scope="module")
def store(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the store of a run with five increments."""
    path = fret.LoadPath.start().normal(W, increments=2).tangential([50.0], increments=3)
    root = tmp_path_factory.mktemp("store") / "run.zarr"
    fret.solve(sphere_on_flat(n=12), path, save="all", out=root, progress=False)
    return root


@pytest.fixture
def every_store_is_large(monkeypatch: pytest.MonkeyPatch) -> None:
    """Check values when they are read, whatever the size of a store."""
    monkeypatch.setattr(checked_store, "CHECKED_AT_ONCE", 0)


@pytest.mark.usefixtures("every_store_is_large")
def test_a_large_store_has_the_values_of_a_small_one(
    store: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """All variables, attributes, single increments, parts of fields, and a copy by pickle."""
    large = fret.open(store)
    copy = pickle.loads(pickle.dumps(large.dataset))
    monkeypatch.undo()
    small = fret.open(store)
    assert large.dataset.attrs == small.dataset.attrs
    for n in (0, 3, -1):
        np.testing.assert_array_equal(large.dataset.p[n], small.dataset.p[n])
    picked = {"saved": [4, 1], "x": slice(2, 9, 3), "y": 5}
    np.testing.assert_array_equal(large.dataset.q_x.isel(picked), small.dataset.q_x.isel(picked))
    assert large.dataset.identical(small.dataset)
    assert copy.identical(small.dataset)


@pytest.mark.usefixtures("every_store_is_large")
def test_a_field_is_checked_where_it_is_read(store: Path, tmp_path: Path) -> None:
    """The damaged chunk of an increment is refused by name; the other increments are read."""
    bad = tmp_path / "bad.zarr"
    shutil.copytree(store, bad)
    chunk = bad / "p" / "3.0.0"
    content = bytearray(chunk.read_bytes())
    content[len(content) // 2] ^= 255
    chunk.write_bytes(bytes(content))
    (bad / "q_y" / "1.0.0").unlink()
    run = fret.open(bad)
    assert float(run.dataset.p[2].max()) > 0.0
    with pytest.raises(fret.errors.StoreError, match=r"p: the file p/3\.0\.0 is damaged"):
        run.dataset.p[3].load()
    with pytest.raises(fret.errors.StoreError, match=r"q_y/1\.0\.0 is missing"):
        run.dataset.q_y.load()
    with pytest.raises(fret.errors.StoreError, match=r"damaged|missing"):
        _core.verify(bad)


@pytest.mark.usefixtures("every_store_is_large")
def test_opening_reads_no_field(store: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The work of opening does not grow with the saved increments. Each is checked once."""
    parts: list[tuple[str, int, int]] = []
    check = checked_store.Checks.check

    def count(self: checked_store.Checks, name: str, entries: np.ndarray, length: int) -> None:
        unchecked = entries[~self.checked.get(name, np.zeros(length, bool))[entries]]
        parts.extend((name, int(n), length) for n in unchecked)
        check(self, name, entries, length)

    monkeypatch.setattr(checked_store.Checks, "check", count)
    run = fret.open(store)
    assert {name for name, _, _ in parts} <= {"increment", "saved", "x", "y", "saved_increment"}
    parts.clear()
    for _ in range(2):
        run.dataset.p[1].load()
        np.asarray(run.dataset.p[1:3])
    assert [part for part in parts if part[0] == "p"] == [("p", 1, 5), ("p", 2, 5)]


@pytest.mark.usefixtures("every_store_is_large")
@pytest.mark.parametrize("name", [".zmetadata", "x/0"])
def test_metadata_and_coordinates_are_checked_when_a_store_is_opened(
    store: Path, tmp_path: Path, name: str
) -> None:
    """Their damage is refused by name."""
    bad = tmp_path / "bad.zarr"
    shutil.copytree(store, bad)
    content = bytearray((bad / name).read_bytes())
    content[len(content) // 2] ^= 255
    (bad / name).write_bytes(bytes(content))
    with pytest.raises(fret.errors.StoreError, match=name):
        fret.open(bad)
