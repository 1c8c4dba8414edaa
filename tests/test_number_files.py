"""Files of numbers of instruments and spreadsheets: read as what they are, or refused."""

from __future__ import annotations

import gzip
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyfret as fret
from pyfret.errors import SceneWarning, StoreError

RNG = np.random.default_rng(7)
HEIGHTS = 1e-6 * RNG.integers(-999, 999, (5, 4)) / 1000
ENCODINGS = ("utf-8", "utf-8-sig", "utf-16", "utf-16-be", "latin-1")
#: Separators and decimal signs that differ from each other.
STYLES = ((",", "."), (";", "."), (";", ","), ("\t", "."), ("\t", ","), (" ", "."), ("  ", ","))


def written(file: Path, rows: Any, parting: str, point: str, encoding: str = "utf-8") -> Path:
    """A table of text, with a row of titles if `rows` begins with words."""
    number = lambda v: v if isinstance(v, str) else f"{v:.9e}".replace(".", point)  # noqa: E731
    lines = [parting.join(number(v) for v in row) for row in rows]
    text = "\r\n".join(lines) + "\r\n"
    file.write_bytes(text.encode(encoding))
    return file


def points(order: Any = None) -> list[tuple[float, float, float]]:
    """The heights as points, 2 um apart along x and 3 um along y."""
    rows = [(2e-6 * i, 3e-6 * j, z) for (i, j), z in np.ndenumerate(HEIGHTS)]
    return rows if order is None else [rows[n] for n in order]


@pytest.mark.parametrize(("parting", "point"), STYLES)
@pytest.mark.parametrize("encoding", ENCODINGS)
@pytest.mark.parametrize("titles", ["none", "titles"])
def test_tables_of_every_style(
    tmp_path: Path, parting: str, point: str, encoding: str, titles: str
) -> None:
    rows = [*([["a", "b", "c", "d"]] if titles == "titles" else []), *HEIGHTS.tolist()]
    file = written(tmp_path / "z.csv", rows, parting, point, encoding)
    for read in (fret.read_surface, fret.SurfaceMap.from_file):
        surface = read(file, spacing=(2e-6, 3e-6))
        np.testing.assert_allclose(surface.values, HEIGHTS, rtol=1e-8)
        assert surface.spacing == (2e-6, 3e-6)


@pytest.mark.parametrize("columns", [(0, 1, 2), (2, 0, 1), (0, 2, 1)])
@pytest.mark.parametrize(("parting", "point"), STYLES)
@pytest.mark.parametrize("titles", ["none", "titles"])
def test_points_in_any_order(
    tmp_path: Path, columns: tuple[int, ...], parting: str, point: str, titles: str
) -> None:
    """Lines and columns have any order; micrometres come by title or argument."""
    order = RNG.permutation(HEIGHTS.size)
    rows: list[Any] = [[1e6 * p[c] for c in columns] for p in points(order)]
    if titles == "titles":
        rows.insert(0, [f"{'xyz'[c]} [um]" for c in columns])
    file = written(tmp_path / "z.xyz", rows, parting.replace("  ", "\t"), point)
    surface = fret.read_surface(file, unit=None if titles == "titles" else "um")
    np.testing.assert_allclose(surface.values, HEIGHTS, rtol=1e-6, atol=1e-15)
    np.testing.assert_allclose(surface.spacing, (2e-6, 3e-6), rtol=1e-6)
    with pytest.raises(StoreError, match="leave spacing out"):
        fret.read_surface(file, unit=None if titles == "titles" else "um", spacing=1e-6)


def test_points_with_holes_channels_and_twice_the_same(tmp_path: Path) -> None:
    rows = [[*p, 10 * p[2]] for p in points()[1:]]
    file = written(tmp_path / "z.txt", [["x", "y", "force", "current"], *rows], ";", ",")
    with pytest.raises(StoreError, match="2 columns beside x and y: `force`, `current`"):
        fret.read_surface(file, missing="fill")
    with pytest.raises(StoreError, match="1 of 20 points have no number"):
        fret.read_surface(file, channel="current")
    with pytest.warns(UserWarning, match=r"1 of 20 points \(5.0 %\) were not measured"):
        surface = fret.read_surface(file, channel="current", missing="fill")
    assert surface.filled == 1
    np.testing.assert_allclose(surface.values[1:], 10 * HEIGHTS[1:], rtol=1e-8)
    written(file, [*points(), points()[3]], ",", ".")
    with pytest.raises(StoreError, match=r"lines 4 and 21 are points at one place"):
        fret.read_surface(file)
    scattered = [(*(1e-4 * RNG.random(2)).tolist(), 1e-6) for _ in range(40)]
    written(file, scattered, ",", ".")
    with pytest.raises(StoreError, match="on no even grid"):
        fret.read_surface(file, spacing=1e-6)


def test_headers_say_spacing_and_unit(tmp_path: Path) -> None:
    """Gwyddion's export and an ESRI grid: lines along x."""
    file = tmp_path / "z.txt"
    rows = "\n".join(" ".join(f"{1e9 * z:.6f}" for z in line) for line in HEIGHTS.T)
    head = "# Channel: Topo\n# Width: 10,0 \u00b5m\n# Height: 12.0 \u00b5m\n# Value units: nm\n"
    file.write_text(head + rows, encoding="utf-8")
    for options in ({}, {"spacing": (2e-6, 3e-6)}, {"channel": "Topo"}, {"unit": "nm"}):
        surface = fret.read_surface(file, **options)  # type: ignore[arg-type]
        np.testing.assert_allclose(surface.values, HEIGHTS, atol=1e-15)
        np.testing.assert_allclose(surface.spacing, (2e-6, 3e-6))
    for options, text in (
        ({"spacing": 1e-6}, "leave spacing out"),
        ({"unit": "um"}, "leave unit out"),
        ({"channel": "Phase"}, "has the channel `Topo`"),
    ):
        with pytest.raises(StoreError, match=text):
            fret.read_surface(file, **options)  # type: ignore[arg-type]
    grid = tmp_path / "z.asc"
    grid.write_text(
        "NCOLS 3\nNROWS 2\nXLLCENTER 0\nYLLCENTER 0\nCELLSIZE 2e-6\nNODATA_VALUE -99\n"
        "1e-9 2e-9 3e-9\n4e-9 5e-9 6e-9\n"
    )
    np.testing.assert_allclose(
        fret.read_surface(grid).values, 1e-9 * np.array([[4, 1], [5, 2], [6, 3]])
    )
    grid.write_text(grid.read_text().replace("5e-9", "-99"))
    with pytest.raises(StoreError, match="1 of 6 points have no number"):
        fret.read_surface(grid)
    grid.write_text(grid.read_text() + "7e-9\n")
    with pytest.raises(StoreError, match=r"has 7 numbers: must have ncols x nrows = 3 x 2"):
        fret.read_surface(grid)
    whole = grid.read_text()
    for count in ("99999999999", "-3", "3.5"):
        grid.write_text(whole.replace("NCOLS 3", f"NCOLS {count}"))
        with pytest.raises(
            StoreError, match=rf"ncols = {count}: must be a whole number from 1 to 1e9"
        ):
            fret.read_surface(grid)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("7 8 z\n1 2 3\n", r"line 1, column 3: `z` is no number"),
        ("1,2\n3,4 um\n", r"line 2, column 2: `4 um` is no number"),
        ("a,b\n1,2\n3\n", r"line 3 has 1 numbers: must have 2"),
        ("1;0.5\n2;0,5\n", r"decimal points and line 2 decimal commas"),
        ("x,height\n0,1\n1,2\n2,1\n", "profile"),
        ("1\n2\n3\n", "profile"),
        ("1 2 3 4 5\n", "profile"),
        ("z [counts],z [counts]\n1,2\n3,4\n", "`counts`, which is no unit of length"),
        ("", "no number"),
        ("nan,nan\n,\n", "no number"),
    ],
)
def test_what_cannot_be_meant_is_refused(tmp_path: Path, text: str, said: str) -> None:
    file = tmp_path / "z.csv"
    file.write_text(text)
    for read in (fret.read_surface, fret.SurfaceMap.from_file):
        with pytest.raises(StoreError, match=said) as refused:
            read(file, spacing=1e-6)
        assert "z.csv" in str(refused.value)
        assert "\n" not in str(refused.value)


@pytest.mark.solves
@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("empty.x3p", b""),
        ("cut.x3p", b"PK\x03\x04" + bytes(300)),
        ("words.sur", b"this is no surface, " * 9),
        ("packed.x3p.gz", gzip.compress(b"PK\x03\x04" + bytes(300), mtime=0)),
        ("scan.dat", bytes([0x88, 0x1B, 0x03, 0x6F, 0, 1]) + bytes(900)),
        ("nothing.al3d", None),
    ],
)
def test_files_of_no_instrument(tmp_path: Path, name: str, content: bytes | None) -> None:
    pytest.importorskip("SurfaceTopography")
    file = tmp_path / name
    if content is not None:
        file.write_bytes(content)
    with pytest.raises(StoreError) as refused:
        fret.read_surface(file)
    assert name in str(refused.value)
    assert "\n" not in str(refused.value)


def test_masks_are_holes_or_refused() -> None:
    heights = np.full((6, 6), 1e-9)
    heights[1, 2] = 5e-6
    masked = np.ma.array(heights, mask=heights > 1e-6)
    with pytest.raises(fret.errors.InvalidSceneError, match="1 of 36 points have no number"):
        fret.SurfaceMap(masked, spacing=1e-4)
    with pytest.warns(UserWarning, match="1 of 36"):
        filled = fret.SurfaceMap(masked, spacing=1e-4, missing="fill")
    assert np.ptp(filled.values) == 0.0
    with pytest.raises(fret.errors.InvalidSceneError, match="have no number"):
        fret.Friction(0.3, map=fret.SurfaceMap(masked, spacing=1e-4))
    stress = np.ma.array(np.ones((4, 1, 6)), mask=False)
    stress[2] = np.ma.masked
    calls: dict[str, Callable[[], object]] = {
        "evaluate": lambda: fret.fatigue.evaluate_criterion(
            stress, fret.fatigue.Criterion.findley(k=0.3)
        ),
        "first_yield": lambda: fret.fatigue.first_yield(stress, s_y=1e8),
        "moving_load": lambda: fret.fatigue.moving_load(stress, s_y=1e8),
        "to_pylife": lambda: fret.fatigue.to_pylife(stress),
        "surface_frf": lambda: fret.kernels.surface_frf(
            fret.Body(fret.Elastic(E=2e11, nu=0.3)), np.ma.array([1e3, 2e3], mask=[0, 1]), 0.0
        ),
        "stress": lambda: fret.subsurface.stress(
            fret.Body(fret.Elastic(E=2e11, nu=0.3)),
            fret.Grid.centred(width=6e-4, n=6),
            [1e-5],
            p=masked,
        ),
    }
    for name, call in calls.items():
        with pytest.raises(ValueError, match="masked"):
            print(name, call())


def test_few_small_holes_are_filled() -> None:
    heights = 1e-7 * RNG.standard_normal((40, 40))
    for part, fits in ((0.05, True), (0.3, False), (0.99, False)):
        holed = np.where(RNG.random(heights.shape) < part, np.nan, heights)
        if fits:
            with pytest.warns(UserWarning, match=r"of 1600 points \([0-9.]+ %\)"):
                fret.SurfaceMap(holed, spacing=1e-6, missing="fill")
        else:
            with pytest.raises(fret.errors.InvalidSceneError, match="too many to fill"):
                fret.SurfaceMap(holed, spacing=1e-6, missing="fill")
    heights[5:17, 5:17] = np.nan
    with pytest.raises(fret.errors.InvalidSceneError, match="too large to fill"):
        fret.SurfaceMap(heights, spacing=1e-6, missing="fill")


def test_a_coarse_map_is_a_doubt() -> None:
    steel = fret.Elastic(E=210e9, nu=0.3)
    for spacing, doubted in ((0.3, True), (1e-5, False)):
        rough = fret.SurfaceMap(1e-9 * RNG.random((40, 40)), spacing=spacing)
        scene = fret.Scene(
            body1=fret.Body(steel, shape=fret.Sphere(R=5e-3) + rough),
            body2=fret.Body(steel),
            friction=0.3,
            grid=fret.Grid.centred(width=2e-4, n=16),
            path=fret.LoadPath.start().normal(10.0, increments=1),
        )
        assert any("map" in d for d in scene.doubts()) == doubted


def test_the_scene_file_reads_by_the_same_rules(tmp_path: Path) -> None:
    # Wide enough for the sphere to part from the flat: 1.8 um at the border, more than the heights.
    rows = [[20e6 * x, 20e6 * y, 1e6 * z] for x, y, z in points()]
    written(tmp_path / "z.txt", rows, ";", ",")
    (tmp_path / "h.txt").write_bytes(
        "t;W;T_x;delta_x\ns;N;mN;um\n1;10;0;0\n2;10;500;0,05\n".encode("utf-16")
    )
    text = """schema = 1
body1 = { shape = { sum = [{ sphere = { R = 1e-3 } },
  { height_map = { file = "z.txt", unit = "um" } }] }, E = 210e9, nu = 0.3 }
body2 = { shape = "flat", E = 210e9, nu = 0.3 }
friction = { mu = 0.3 }
grid = { n = 32, extent = 120e-6 }
path = { file = "h.txt", increments = 1, drive = "T_x" }
"""
    (tmp_path / "s.toml").write_bytes(text.encode("utf-16"))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SceneWarning)
        scene = fret.Scene.from_file(tmp_path / "s.toml")
    assert scene.path.T_x.tolist() == [0.0, 0.5]
    assert scene.body1.shape == fret.Sphere(R=1e-3) + fret.read_surface(
        tmp_path / "z.txt", unit="um"
    )
    (tmp_path / "s.toml").write_text(text.replace(', drive = "T_x"', ""))
    with pytest.raises(fret.errors.InvalidSceneError, match="choose the one that drives"):
        fret.Scene.from_file(tmp_path / "s.toml")


def test_of_a_loop_one_column_drives(tmp_path: Path) -> None:
    file = written(
        tmp_path / "loop.csv",
        [["W", "T_x", "delta_x [um]"], [10.0, 0.0, 0.0], [10.0, 1.0, 0.5]],
        "\t",
        ",",
    )
    with pytest.raises(StoreError, match="T_x and delta_x both stand in it"):
        fret.LoadPath.from_csv(file)
    moved = fret.LoadPath.from_csv(file, drive="delta_x")
    start = fret.LoadPath.start()
    assert moved == start.waypoints(increments=1, W=[10, 10], delta_x=[0, 0.5e-6])
    forced = fret.LoadPath.from_csv(file, drive=["T_x"])
    assert forced.T_x.tolist() == [0.0, 1.0]


def test_a_map_has_the_height_parameters_of_iso_25178() -> None:
    """S_q of a sine of amplitude a is a/sqrt(2), about the mean; S_z is 2 a."""
    a, phase = 3e-7, 2.0 * np.pi * np.arange(64) / 64
    heights = 1e-6 + a * np.sin(phase)[:, None] * np.ones(8)
    surface = fret.SurfaceMap(heights, spacing=1e-6)
    assert surface.rms == pytest.approx(a / np.sqrt(2.0), rel=1e-9)
    assert surface.peak_to_valley == pytest.approx(2.0 * a, rel=1e-9)
