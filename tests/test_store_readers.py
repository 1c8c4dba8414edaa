"""Stores of pyfret in the libraries of others: zarr-python, tensorstore, GDAL."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import pyfret as fret
from conftest import W, sphere_on_flat

pytestmark = pytest.mark.solves


@pytest.fixture(scope="module", params=["run", "copy"])
def store(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A store that a run wrote, and one that `save` wrote."""
    folder = tmp_path_factory.mktemp("stores")
    path = fret.LoadPath.start().normal(W, increments=2)
    result = fret.solve(sphere_on_flat(n=16), path, out=folder / "run.zarr", progress=False)
    result.save(folder / "copy.zarr")
    return folder / f"{request.param}.zarr"


@pytest.fixture
def pressure(store: Path) -> np.ndarray:
    return np.asarray(fret.open(store).dataset["p"].values)


def test_zarr_python_reads_a_store_of_version_2(store: Path, pressure: np.ndarray) -> None:
    import zarr

    group = zarr.open_group(store, mode="r")
    assert group.metadata.zarr_format == 2
    np.testing.assert_array_equal(np.asarray(group["p"][...]), pressure)


def test_tensorstore_reads_it(store: Path, pressure: np.ndarray) -> None:
    tensorstore = pytest.importorskip("tensorstore")
    position = {"driver": "file", "path": f"{store / 'p'}/"}
    array = tensorstore.open({"driver": "zarr", "kvstore": position}).result().read().result()
    np.testing.assert_array_equal(array, pressure)


def test_gdal_reads_it(store: Path, pressure: np.ndarray) -> None:
    rasterio = pytest.importorskip("rasterio")
    with rasterio.open(f'ZARR:"{store}":/p:0') as image:
        np.testing.assert_array_equal(image.read(1), pressure[0])
