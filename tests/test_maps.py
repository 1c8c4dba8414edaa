"""Maps of instruments: sizes, heads, channels and editions."""

from __future__ import annotations

import struct
import warnings
from pathlib import Path

import numpy as np
import pytest

import pyfret as fret
from pyfret._core import check_sides, map_from_heights
from pyfret.scene import standard_maps
from pyfret.scene.reading import check_range

StoreError = fret.errors.StoreError
CORPUS = Path(__file__).parent / "data" / "corpus"
HEIGHTS = 1e-6 * np.add.outer(np.arange(5.0), 10.0 * np.arange(3))


@pytest.mark.parametrize(
    ("count", "step", "fits"),
    [
        (512, 0.3125, False),
        (512, 3.125e-7, True),
        (4, 1e-8, False),
        (4, 0.2, False),
        (1, 1.0, True),
    ],
)
def test_sizes_of_maps_have_a_range(count: int, step: float, *, fits: bool) -> None:
    for shape, spacing in (((count, 300), (step, 1e-6)), ((300, count), (1e-6, step))):
        if fits:
            check_sides(shape, spacing)
        else:
            with pytest.raises(StoreError, match=r"must be 1e-7 to 0.5 m"):
                check_sides(shape, spacing)


def nanofocus(path: Path) -> None:
    """Write a .nms of 32 x 32 points, 312.5 nm apart, as its instrument does."""
    nms = pytest.importorskip("SurfaceTopography.IO.NMS")
    content = bytearray(nms._HEADER_SIZE)
    struct.pack_into("<2d", content, nms._OFFSET_Z, 2.7, 6.0)
    struct.pack_into("<2I2d", content, nms._OFFSET_POINTS, 32, 32, 312.5, 312.5)
    content += np.random.default_rng(0).integers(0, 65534, 1024).astype("<u2").tobytes()
    path.write_bytes(bytes(content))


def test_a_map_as_wide_as_a_house_is_refused_until_its_pitch_is_given(tmp_path: Path) -> None:
    nanofocus(tmp_path / "map.nms")
    with pytest.raises(StoreError, match=r"10 m long in x.*give spacing"):
        fret.read_surface(tmp_path / "map.nms")
    with pytest.warns(fret.errors.SceneWarning, match="pitch of 312.5 mm is not used"):
        surface = fret.read_surface(tmp_path / "map.nms", spacing=312.5e-9)
    assert surface.spacing == (312.5e-9, 312.5e-9)
    # Without its ending no reader takes it by its size.
    (tmp_path / "map.nms").rename(tmp_path / "map.bin")
    with pytest.raises(StoreError, match="no file of an instrument"):
        fret.read_surface(tmp_path / "map.bin")


def test_numbers_with_a_spacing_in_micrometres_are_refused(tmp_path: Path) -> None:
    np.save(tmp_path / "z.npy", np.zeros((4, 3)))
    with pytest.raises(StoreError, match="8 m long"):
        fret.read_surface(tmp_path / "z.npy", spacing=2.0)


def test_a_file_of_two_n_squared_bytes_is_no_terrain(tmp_path: Path) -> None:
    for size in (2 * 23 * 23, 2 * 100 * 100):
        (tmp_path / "map.bin").write_bytes(b"\x01\x02" * (size // 2))
        with pytest.raises(StoreError, match="no file of an instrument"):
            fret.read_surface(tmp_path / "map.bin", unit="um", spacing=1e-6)


def test_an_x3p_that_is_padded_or_renamed_is_read(tmp_path: Path) -> None:
    content = (CORPUS / "x3pio_dam1.x3p").read_bytes()
    (tmp_path / "map.bin").write_bytes(content)
    surface = fret.read_surface(tmp_path / "map.bin")
    np.testing.assert_allclose(
        surface.values - surface.values.mean(), HEIGHTS - HEIGHTS.mean(), atol=1e-15
    )


@pytest.mark.parametrize("kind", ["SPIP", "Nova", "Attocube"])
def test_heads_of_instruments_in_text_are_read(tmp_path: Path, kind: str) -> None:
    """Their lines run along x."""
    heads = {
        "SPIP": "# File Format = ASCII\n# x-pixels = 5\n# y-pixels = 3\n# x-length = 10000\n"
        "# y-length = 3000\n# Bit2nm = 1.0\n# Start of Data:\n",
        "Nova": "File Format = ASCII\nNX = 5\nNY = 3\nScale X = 2000\nScale Y = 1000\n"
        "Unit X = nm\nUnit Y = nm\nUnit Data = nm\nStart of Data :\n",
        "Attocube": "# x-pixels: 5\n# y-pixels: 3\n# x-length: 10000\n# y-length: 3000\n"
        "# x-unit: nm\n# y-unit: nm\n# z-unit: nm\n",
    }
    lines = "\n".join("\t".join(f"{1e9 * v:.0f}" for v in row) for row in HEIGHTS.T)
    for ending in ("asc", "txt"):
        path = tmp_path / f"map.{ending}"
        path.write_text(heads[kind] + lines + "\n")
        surface = fret.read_surface(path)
        assert surface.values.shape == (5, 3)
        np.testing.assert_allclose(surface.spacing, (2e-6, 1e-6))
        np.testing.assert_allclose(
            surface.values - surface.values.mean(), HEIGHTS - HEIGHTS.mean(), atol=1e-12
        )
        with pytest.raises(StoreError, match=r"leave (spacing|unit) out"):
            fret.read_surface(path, spacing=(2e-6, 1e-6), unit="nm")


def test_a_head_that_is_not_read_is_doubted(tmp_path: Path) -> None:
    table = "\n".join(" ".join(f"{1e6 * v:g}" for v in row) for row in HEIGHTS)
    path = tmp_path / "map.txt"
    path.write_text(f"# scan size x: 10 um\n{table}\n")
    with pytest.warns(fret.errors.SceneWarning, match=r"not read: '# scan size x: 10 um'"):
        fret.read_surface(path, unit="um", spacing=(2e-6, 1e-6))
    path.write_text(f"# a comment\n{table}\n")
    with warnings.catch_warnings():
        warnings.simplefilter("error", fret.errors.SceneWarning)
        fret.read_surface(path, unit="um", spacing=(2e-6, 1e-6))


@pytest.mark.parametrize("name", ["x3pio_layers.x3p"])
def test_the_choice_of_a_channel_is_warned_of(name: str) -> None:
    with pytest.warns(fret.errors.SceneWarning, match="layer 0, layer 1: the first is read"):
        fret.read_surface(CORPUS / name)
    for channel in (1, "layer 1"):
        with warnings.catch_warnings():
            warnings.simplefilter("error", fret.errors.SceneWarning)
            surface = fret.read_surface(CORPUS / name, channel=channel)
        assert surface.peak_to_valley == pytest.approx(48e-6)
    with pytest.raises(StoreError, match="has no channel 2"):
        fret.read_surface(CORPUS / name, channel=2)


@pytest.mark.parametrize("name", ["x3pio_dam1.x3p", "sdfio_iso_2_0_binary.sdf", "gwyddion.gwy"])
def test_trends_are_subtracted_alike_by_all_readers(name: str) -> None:
    """The heights are a plane."""
    surface = fret.read_surface(CORPUS / name, detrend="plane")
    assert surface.peak_to_valley < 1e-12
    assert fret.read_surface(CORPUS / name).values.mean() == pytest.approx(0.0, abs=1e-18)


def test_the_mean_is_over_measured_points() -> None:
    heights = np.arange(12.0).reshape(4, 3)
    heights[2, 1] = np.nan
    with pytest.warns(UserWarning, match="1 of 12 points"):
        surface, rms = map_from_heights(heights, spacing=(1e-6, 1e-6), missing="fill")
    measured = heights - np.nanmean(heights)
    np.testing.assert_allclose(
        np.where(np.isnan(heights), np.nan, surface.values), measured, atol=1e-14
    )
    assert surface.filled == 1
    assert rms == surface.rms


@pytest.mark.parametrize("turned", [False, True])
def test_heights_in_any_order_of_memory_are_centred(*, turned: bool) -> None:
    heights = np.random.default_rng(2).normal(size=(64, 96))
    view = heights.T if turned else heights[::2, ::-3]
    surface, rms = map_from_heights(view, spacing=(1e-6, 2e-6), missing="refuse")
    np.testing.assert_allclose(surface.values, view - view.mean(), atol=1e-14)
    assert rms == pytest.approx(view.std(), rel=1e-12)
    assert rms == pytest.approx(surface.rms, rel=1e-12)
    for wrong in (np.inf, -np.inf):
        holed = np.array(view)
        holed[3, 4] = wrong
        with pytest.raises(ValueError, match=r"map.z\[3, 4\]"):
            map_from_heights(holed, spacing=(1e-6, 2e-6), missing="fill")
    for empty in (np.full((3, 4), np.nan), np.empty((0, 4))):
        with pytest.raises(ValueError, match=r"holds no number|empty"):
            map_from_heights(empty, spacing=(1e-6, 2e-6), missing="fill")


def test_heights_have_a_range() -> None:
    check_range(1e-3)
    with pytest.raises(StoreError, match=r"S_q of the heights is 1 m: must be 250 mm at most"):
        check_range(1.0)


MAP_IN_A_SCENE = """
    schema = 1
    friction.mu = 0.3
    [body1]
    E = 210e9
    nu = 0.3
    shape.height_map = {{ file = "z.npy", spacing = {spacing} }}
    [body2]
    E = 210e9
    nu = 0.3
    shape = "flat"
    [grid]
    extent = 1e-5
    n = 10
    [[path]]
    W = 1.0
    increments = 1
"""


def test_a_map_named_in_a_scene_has_a_size(tmp_path: Path) -> None:
    np.save(tmp_path / "z.npy", 1e-7 * np.random.default_rng(0).random((20, 20)))
    scene = tmp_path / "scene.toml"
    for spacing, side in ((1.0, "20 m"), (1e-9, "2.000e-8 m")):
        scene.write_text(MAP_IN_A_SCENE.format(spacing=spacing))
        with pytest.raises(ValueError, match=rf"{side} long in x.*must be 1e-7 to 0.5 m"):
            fret.Scene.from_file(scene)
    scene.write_text(MAP_IN_A_SCENE.format(spacing=1e-6))
    assert fret.Scene.from_file(scene).grid.nx == 10


@pytest.mark.filterwarnings("ignore:.*BCR-1.0 fixes no direction")
@pytest.mark.parametrize("revision", ["ISO_1_0", "ISO_2_0", "BCR_1_0"])
@pytest.mark.parametrize("kind", ["INT16", "BINARY64"])
def test_a_large_sdf_is_read_in_pieces(
    revision: str, kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sdfio = pytest.importorskip("sdfio")
    heights = np.round(np.random.default_rng(0).normal(0.0, 1e-6, (23, 17)), 10)
    metadata = sdfio.Metadata(revision=sdfio.Revision[revision], data_type=sdfio.DataType[kind])
    path = tmp_path / "map.sdf"
    sdfio.write(path, heights, x_scale=1e-6, y_scale=2e-6, metadata=metadata)
    whole = fret.read_surface(path)
    calls = []
    reading = sdfio.read
    monkeypatch.setattr(sdfio, "read", lambda source: calls.append(source) or reading(source))
    monkeypatch.setattr(standard_maps, "PIECE", 5 * 17)
    in_pieces = fret.read_surface(path)
    assert len(calls) == 6
    # The order of the lines rounds the mean.
    np.testing.assert_allclose(in_pieces.values, whole.values, rtol=0.0, atol=4e-22)
    assert in_pieces.spacing == (1e-6, 2e-6)
    # A head that counts more points than the file has is no reason to reserve them.
    path.write_bytes(path.read_bytes()[:-9])
    with pytest.raises(StoreError, match="no whole SDF file"):
        fret.read_surface(path)


def test_an_unknown_revision_is_refused_by_name(tmp_path: Path) -> None:
    import zipfile

    with zipfile.ZipFile(CORPUS / "x3pio_dam1.x3p") as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    members["main.xml"] = members["main.xml"].replace(b"ISO25178-72:2017/DAM1", b"ISO25178-72:2040")
    with zipfile.ZipFile(tmp_path / "map.x3p", "w") as archive:
        for name, content in members.items():
            archive.writestr(name, content)
    with pytest.raises(StoreError, match="2040"):
        fret.read_surface(tmp_path / "map.x3p")


def test_an_old_release_of_the_library_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """Releases before 1.27.1 read undefined points of a .sur as heights."""
    monkeypatch.setattr("importlib.metadata.version", lambda _: "1.25.0")
    with pytest.raises(StoreError, match=r"1\.27\.1 or later, and 1\.25\.0 is installed"):
        fret.read_surface(CORPUS / "gwyddion.gwy")


def test_a_form_is_subtracted_from_text_too(tmp_path: Path) -> None:
    x = np.linspace(0.0, 1.0, 24)
    heights = 1e-6 * (3.0 * x[:, None] - x[None, :] + 0.1 * np.cos(40.0 * x)[:, None])
    np.savetxt(tmp_path / "map.csv", heights, delimiter=",")
    read = lambda **options: fret.read_surface(tmp_path / "map.csv", spacing=1e-5, **options)  # noqa: E731
    assert read(detrend="plane") == read().level()
    assert read(detrend="paraboloid") == read().level("paraboloid")
    assert read(detrend="center").values.mean() == pytest.approx(0.0, abs=1e-18)
    with pytest.raises(ValueError, match=r"detrend = 'banana': must be one of 'center', 'plane'"):
        read(detrend="banana")


def test_heights_that_reach_further_than_the_map_need_their_unit(tmp_path: Path) -> None:
    heights = np.random.default_rng(1).normal(size=(16, 16))
    np.savetxt(tmp_path / "map.csv", heights, delimiter=",")
    with pytest.raises(fret.errors.StoreError, match=r"the map is .* long: give their unit"):
        fret.read_surface(tmp_path / "map.csv", spacing=2e-6)
    surface = fret.read_surface(tmp_path / "map.csv", spacing=2e-6, unit="um")
    assert surface.rms == pytest.approx(1e-6 * heights.std(), rel=1e-6)
