"""Measured surfaces as people have them, and results in the formats that people want."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import pyfret as fret

HEIGHTS = np.arange(12.0).reshape(4, 3) - 5.0


@pytest.mark.parametrize("kind", ["<f8", ">f8", "<f4", ">f4", "<i2", ">i4", "|i1"])
def test_arrays_of_any_kind_are_read(kind: str, tmp_path: Path) -> None:
    file = tmp_path / "heights.npy"
    np.save(file, HEIGHTS.astype(kind))
    for read in (fret.SurfaceMap.from_file, fret.read_surface):
        surface = read(file, spacing=2e-6, unit="um")
        np.testing.assert_allclose(surface.values, 1e-6 * HEIGHTS)
        assert surface.spacing == (2e-6, 2e-6)


@pytest.mark.parametrize(
    ("delimiter", "header", "point"),
    [
        (",", "", "."),
        (",", "a,b,c", "."),
        (";", "a;b;c", ","),
        ("\t", "", "."),
        (" ", "", "."),
    ],
)
def test_tables_of_any_kind_are_read(
    delimiter: str, header: str, point: str, tmp_path: Path
) -> None:
    file = tmp_path / "heights.csv"
    np.savetxt(file, HEIGHTS, delimiter=delimiter, header=header, comments="")
    file.write_text(file.read_text().replace(".", point))
    np.testing.assert_array_equal(fret.SurfaceMap.from_file(file, spacing=1e-6).values, HEIGHTS)


def test_holes_are_named_cut_off_or_filled(tmp_path: Path) -> None:
    file = tmp_path / "heights.npy"
    holed = HEIGHTS.copy()
    holed[0, :] = np.nan
    np.save(file, holed)
    expected = (
        r"3 of 12 points have no number, the first in row 1 and column 1, all within 1 of the edges"
    )
    with pytest.raises(fret.errors.StoreError, match=expected):
        fret.SurfaceMap.from_file(file, spacing=1e-6)
    with pytest.raises(fret.errors.InvalidSceneError, match="3 of 12 points have no number"):
        fret.SurfaceMap(holed, spacing=1e-6)
    cut = fret.SurfaceMap.from_file(file, spacing=1e-6, missing="crop")
    np.testing.assert_array_equal(cut.values, HEIGHTS[1:])
    with pytest.raises(fret.errors.InvalidSceneError, match=r"3 of 12 points \(25.0 %\)"):
        fret.SurfaceMap(holed, spacing=1e-6, missing="fill")
    with pytest.raises(
        fret.errors.InvalidSceneError, match=r'missing = leave: must be "refuse", "crop"'
    ):
        fret.SurfaceMap(holed, spacing=1e-6, missing="leave")  # type: ignore[arg-type]


def test_an_empty_table_holds_no_number(tmp_path: Path) -> None:
    file = tmp_path / "empty.csv"
    file.write_text("")
    with pytest.raises(fret.errors.StoreError, match=r"empty\.csv.*(no number|no line|empty)"):
        fret.SurfaceMap.from_file(file, spacing=1e-6)
    with pytest.raises(fret.errors.InvalidSceneError, match="no number"):
        fret.SurfaceMap(np.zeros((0, 4)), spacing=1e-6)


def test_plain_numbers_need_a_spacing(tmp_path: Path) -> None:
    np.save(tmp_path / "z.npy", HEIGHTS)
    with pytest.raises(fret.errors.StoreError, match="need the distance of the points"):
        fret.read_surface(tmp_path / "z.npy")


@pytest.mark.parametrize("ending", ["zarr", "nc"])
def test_a_result_is_saved_and_opened(coated: fret.Result, ending: str, tmp_path: Path) -> None:
    path = tmp_path / f"copy.{ending}"
    coated.save(path)
    with pytest.raises(FileExistsError):
        coated.save(path)
    computed = fret.open(path)
    xr.testing.assert_equal(computed.dataset.load(), coated.dataset)
    assert computed.scene == coated.scene
    assert computed.dataset.attrs["Conventions"] == "CF-1.11"
    assert computed.summary() == coated.summary()
    assert computed.at(-1).stress([0.0], y=0.0).von_mises.max() > 0
    computed.dataset.close()


def test_a_result_is_saved_as_what_its_name_says(coated: fret.Result, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"must end in \.zarr or \.nc"):
        coated.save(tmp_path / "copy.csv")


@pytest.mark.parametrize("flat", [False, True], ids=["rectangle", "strip"])
def test_a_map_that_is_too_small_is_refused_with_the_grid_that_fits(*, flat: bool) -> None:
    """The code in the refusal makes a scene."""
    steel = fret.Elastic(E=210e9, nu=0.3)
    spacing = (1e-6, 1.0 if flat else 3e-6)
    shape = fret.SurfaceMap(np.zeros((67, 1 if flat else 20)), spacing=spacing)
    grid = fret.Grid.strip(extent=1e-4, n=64) if flat else fret.Grid.centred(width=1e-4, n=64)
    path = fret.LoadPath.start().normal(1.0, increments=1)
    round_one = fret.Cylinder(R=1e-4) if flat else fret.Sphere(R=1e-4)
    upper, lower = fret.Body(steel, shape=round_one), fret.Body(steel, shape=shape)

    def scene(grid: fret.Grid) -> fret.Scene:
        made = fret.Scene(body1=upper, body2=lower, friction=0.3, grid=grid, path=path)
        made.check()
        return made

    with pytest.raises(fret.errors.InvalidSceneError, match="as large as the grid") as refused:
        scene(grid)
    match = re.search(r"Grid\.\w+\(.*?\)(?= at most)", str(refused.value))
    assert match is not None
    largest = eval(match[0], {"Grid": fret.Grid})
    assert scene(largest).grid == largest
    assert (largest.dx, largest.nx) == (pytest.approx(grid.dx, rel=1e-5), 42)
    if not flat:
        assert largest.ny == 38
        message = str(refused.value).partition("in a scene file ")[2].split(" and ")
        text = scene(largest).to_toml()
        table = "[grid]\n" + "\n".join(message)
        again = re.sub(r"\[grid\]\n(?:[^\[\n].*\n)*", table + "\n", text)
        assert fret.Scene.from_toml(again).grid.nx == largest.nx
