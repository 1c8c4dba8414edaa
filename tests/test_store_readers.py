"""Stores of pyfret in the libraries of others: zarr-python, tensorstore, GDAL, netCDF-C.

And copies by other libraries in the command, whatever their compressor and their masks are.
"""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import numpy as np
import pytest

import pyfret as fret
from conftest import W, sphere_on_flat
from pyfret._core import run_command

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


def test_netcdf_reads_it(store: Path, pressure: np.ndarray) -> None:
    netcdf = pytest.importorskip("netCDF4")
    with netcdf.Dataset(f"file://{store}#mode=zarr") as group:
        np.testing.assert_array_equal(np.asarray(group["p"][...]), pressure)
        assert set(np.unique(group["stick"][...])) <= {0, 1}


def test_masks_are_masks_to_xarray(store: Path) -> None:
    xarray = pytest.importorskip("xarray")
    with xarray.open_zarr(store) as dataset:
        assert dataset["stick"].dtype == bool
        assert fret.open(store).dataset["stick"].dtype == bool


@pytest.mark.parametrize("codec", ["zlib", "gzip", None])
@pytest.mark.parametrize("store", ["run"], indirect=True)
def test_the_command_reads_copies_of_xarray(
    codec: str | None, store: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    """Masks are booleans of Zarr, which netCDF-C does not have."""
    numcodecs = pytest.importorskip("numcodecs")
    import zarr

    kind = {"zlib": numcodecs.Zlib(level=1), "gzip": numcodecs.GZip(level=1)}.get(codec)
    copy = tmp_path / "copy.zarr"
    shutil.copytree(store, copy)
    # A copy has no checksums of chunks.
    metadata = json.loads((copy / ".zmetadata").read_text())
    metadata = {key: metadata[key] for key in ("zarr_consolidated_format", "metadata")}
    for name, _ in zarr.open_group(store, mode="r").arrays():
        document = json.loads((copy / name / ".zarray").read_text())
        document["compressor"] = kind and kind.get_config()
        if document["dtype"] == "|u1":
            document["dtype"] = "|b1"
        (copy / name / ".zarray").write_text(json.dumps(document))
        metadata["metadata"][f"{name}/.zarray"] = document
        for file in (path for path in (copy / name).iterdir() if not path.name.startswith(".")):
            values = numcodecs.Zlib().decode(file.read_bytes())
            file.write_bytes(kind.encode(values) if kind else bytes(values))
    (copy / ".zmetadata").write_text(json.dumps(metadata))
    texts = []
    for folder in (store, copy):
        assert run_command(["fret", "stress", str(folder), "--depths", "3"]) == 0
        texts.append(capfd.readouterr().out)
    assert texts[0] == texts[1]
    assert (fret.open(copy).dataset["stick"] == fret.open(store).dataset["stick"]).all()
