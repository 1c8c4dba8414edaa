"""Result stores that are damaged: read as they were written, or refused by name."""

from __future__ import annotations

import random
import shutil
from pathlib import Path

import pytest

import pyfret as fret
from conftest import W, sphere_on_flat
from damaging import damage

pytestmark = pytest.mark.solves

#: Damages of a store; `make kill` has hundreds.
STORES = 30


def test_a_damaged_store_is_read_as_it_was_or_refused_by_name(tmp_path: Path) -> None:
    """Every file of a store, in turn and at random."""
    good = tmp_path / "good.zarr"
    path = fret.LoadPath.start().normal(W, increments=2).tangential([50.0, -50.0], increments=3)
    written = fret.solve(sphere_on_flat(n=12), path, out=good, progress=False)
    written = fret.Result(written.dataset.load())
    files = sorted(f.relative_to(good) for f in good.rglob("*") if f.is_file())
    rng = random.Random(34)
    refused = 0
    bad = tmp_path / "bad.zarr"
    shutil.copytree(good, bad)
    for n in range(STORES):
        name = Path(".zmetadata") if n % 8 == 0 else rng.choice(files)
        damage(bad / name, rng)
        try:
            read = fret.open(bad).dataset.load()
        except fret.errors.StoreError as error:
            text = str(error)
            assert str(bad) in text, text
            assert "\n" not in text, text
            assert str(name.parent if name.name[0] != "." else name) in text, (name, text)
            refused += 1
        else:
            assert read.identical(written.dataset), name
        shutil.copy(good / name, bad / name)
    assert refused > STORES // 3


@pytest.mark.parametrize("name", ["nothing.zarr", "empty.zarr", "others.zarr"])
def test_what_is_no_store_is_refused_by_name(tmp_path: Path, name: str) -> None:
    """Nothing, an empty folder, the store of another program."""
    if name != "nothing.zarr":
        (tmp_path / name).mkdir()
    if name == "others.zarr":
        (tmp_path / name / ".zmetadata").write_text('{"metadata": {".zattrs": {}}}')
    why = "no such file or folder" if name == "nothing.zarr" else "is not a result store"
    with pytest.raises(fret.errors.StoreError, match=f"{name}.*{why}"):
        fret.open(tmp_path / name)


def worn(place: Path) -> fret.wear.WearResult:
    """A run of wear of four jumps."""
    path = (
        fret.LoadPath.start().normal(W, increments=1).tangential([50.0, -50.0, 50.0], increments=2)
    )
    return fret.wear.solve(
        sphere_on_flat(n=12),
        path=path,
        cycles=1e3,
        body2=fret.wear.Archard(1e-15),
        first_branch=2,
        jumps=4,
        out=place,
        progress=False,
    )


def test_a_damaged_store_of_wear_is_refused_by_name(tmp_path: Path) -> None:
    """Opened, and gone on with: neither takes other numbers for those that were written."""
    good, bad = tmp_path / "good.zarr", tmp_path / "bad.zarr"
    written = worn(good).dataset.load()
    files = sorted(f.relative_to(good) for f in good.rglob("*") if f.is_file())
    rng = random.Random(35)
    refused = 0
    shutil.copytree(good, bad)
    for n in range(STORES):
        name = Path(".zmetadata") if n % 8 == 0 else rng.choice(files)
        damage(bad / name, rng)
        for use in (fret.open, fret.wear.resume):
            try:
                read = use(bad).dataset.load()
            except fret.errors.StoreError as error:
                text = str(error)
                assert str(bad) in text, text
                assert "\n" not in text, text
                refused += 1
            else:
                assert read.identical(written), (name, use)
        shutil.copy(good / name, bad / name)
    assert refused > STORES // 3
