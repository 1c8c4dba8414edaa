"""The command line and Python: one solver, one answer; bad input."""

from __future__ import annotations

import subprocess
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import pyfret as fret
from conftest import ROOT, W

FRET = ROOT / "target" / "release" / "fret"


def fret_run(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run([FRET, *arguments], capture_output=True, text=True, check=False)


def test_the_same_scene_gives_the_same_bits(coated: fret.Result, tmp_path: Path) -> None:
    (tmp_path / "scene.toml").write_text(coated.scene.to_toml())
    run = fret_run("run", tmp_path / "scene.toml", "-o", tmp_path / "out.zarr")
    assert run.returncode == 0, run.stderr
    assert fret.open(tmp_path / "out.zarr").dataset.identical(coated.dataset)


@pytest.mark.parametrize(
    ("setting", "says"),
    [
        ("friction.mue=0.3", "unknown key"),
        ("friction.mu=-1.0", "friction.mu = -1: must be"),
        ("friction.mu=nan", "friction.mu = nan: must be"),
        ("body1.E=-210e9", "body1.E = -210000000000: must be"),
        ("body2.nu=0.5", "body2.nu = 0.5: must be"),
        ("body2.nu=-1.0", "body2.nu = -1: must be"),
        ("body2.coatings.0.thickness=0.0", "body2.coatings[0].thickness = 0: must be"),
        ("grid.n=0", "grid.n"),
        ("path.1.T_x.mu_W=1.01", "path[1].T_x = 303"),
        ("grid.extent=1e-5", "should be about"),
    ],
)
def test_a_bad_scene_is_refused_with_one_sentence(
    setting: str, says: str, scene_file: Path, tmp_path: Path
) -> None:
    out = tmp_path / "out.zarr"
    run = fret_run("run", scene_file, "--set", "grid.n=16", "--set", setting, "-o", out)
    assert run.returncode == 2, run.stderr
    assert says in run.stderr
    assert len(run.stderr.strip().splitlines()) == 1
    assert not out.exists()


def test_a_bad_file_names_the_line_and_the_nearest_key(scene_file: Path, tmp_path: Path) -> None:
    bad = tmp_path / "bad.toml"
    lines = scene_file.read_text().replace("mu = 0.3", "mue = 0.3").splitlines()
    bad.write_text("\n".join(lines))
    run = fret_run("run", bad, "-o", tmp_path / "out.zarr")
    assert run.returncode == 2
    assert f"bad.toml:{lines.index('mue = 0.3') + 1}:" in run.stderr
    assert "nearest valid key is `friction.mu`" in run.stderr


def test_what_is_there_is_not_overwritten(scene_file: Path, tmp_path: Path) -> None:
    (tmp_path / "out.zarr").write_text("precious")
    run = fret_run("run", scene_file, "-o", tmp_path / "out.zarr")
    assert run.returncode == 2
    assert (tmp_path / "out.zarr").read_text() == "precious"


def test_check_solves_nothing_and_says_what_is_skipped(scene_file: Path) -> None:
    run = fret_run("check", scene_file)
    assert run.returncode == 0, run.stderr
    for words in ("a_H", "p_H", "cells", "y < 0"):
        assert words in run.stdout


def test_stress_below_is_that_of_python(coated: fret.Result, tmp_path: Path) -> None:
    store = tmp_path / "out.zarr"
    result = fret.solve(coated.scene, out=store, progress=False)
    z = np.linspace(0.0, 2 * result.a_H, 17)
    of = ("von_mises", "s_xz")
    section = result.at(-1).stress(z, y=0.0)
    common = ("--depths", "17", "--of", ",".join(of))
    run = fret_run("stress", store, *common, "-o", tmp_path / "section.zarr")
    assert run.returncode == 0, run.stderr
    written = xr.open_zarr(tmp_path / "section.zarr", chunks=None)
    for name in of:
        np.testing.assert_array_equal(written[name], section.measure(name))
        assert f"largest {name} {section.maximum(name).value / result.p_H:.5f} p_H" in run.stdout
    for out in ("volume.zarr", "volume.vti"):
        run = fret_run("stress", store, "--volume", *common, "-o", tmp_path / out)
        assert run.returncode == 0, run.stderr
        snapshot = result.at(-1)
        snapshot.write_volume(tmp_path / f"python_{out}", z, of=of)
    assert (tmp_path / "volume.vti").read_bytes() == (tmp_path / "python_volume.vti").read_bytes()
    volume, ours = (
        xr.open_zarr(tmp_path / f"{n}volume.zarr", chunks=None) for n in ("", "python_")
    )
    for name in of:
        np.testing.assert_array_equal(volume[name], ours[name])
    first = fret_run("stress", store, "--increment", "10", "--along-y", "0", "--body", "1")
    assert first.returncode == 0, first.stderr
    assert first.stdout.startswith("increment 10: largest von_mises")


def test_stress_has_the_bulk_stress_unless_left_out(coated: fret.Result, tmp_path: Path) -> None:
    store = tmp_path / "out.zarr"
    path = fret.LoadPath.start().force(W=W, sigma_B=2e8, sigma_B1=-1e8, increments=3)
    snapshot = fret.solve(coated.scene, path, out=store, progress=False).at(-1)
    z = [0.0, 1e-4, 2e-4]
    for body in (1, 2):
        for bulk in (True, False):
            out = tmp_path / f"{body}{bulk}.zarr"
            options = ("--body", str(body), *(() if bulk else ("--no-bulk",)))
            run = fret_run(
                "stress",
                store,
                "--depths",
                "3",
                "--depth",
                "2e-4",
                "--of",
                "s_xx",
                *options,
                "-o",
                out,
            )
            assert run.returncode == 0, run.stderr
            written = xr.open_zarr(out, chunks=None).s_xx
            ours = snapshot.stress(z, y=0.0, body_number=body, bulk=bulk).s_xx
            np.testing.assert_array_equal(written, ours)


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (("--of", "mises"), "one of s_xx"),
        (("--increment", "3"), "one whose fields were kept"),
        (("--depth=-1.0",), "a depth in m, 0 or more"),
        (("--along-x", "1.0"), "a place above the grid"),
        (("-o", "section.vti"), "image data (.vti) is of a --volume"),
    ],
)
def test_stress_that_is_not_there_is_refused(
    coated: fret.Result, tmp_path: Path, arguments: tuple[str, ...], says: str
) -> None:
    store = tmp_path / "out.zarr"
    path = fret.LoadPath.start().normal(W, increments=4)
    fret.solve(coated.scene, path, save="branches", out=store, progress=False)
    run = fret_run("stress", store, "--depths", "3", *arguments)
    assert run.returncode == 2, run.stderr
    assert says in run.stderr
    assert len(run.stderr.strip().splitlines()) == 1
