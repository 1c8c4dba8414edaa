"""The command line and Python: one solver, one answer; bad input."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

import pyfret as fret
from conftest import ROOT, sphere_on_flat

FRET = ROOT / "target" / "release" / "fret"


def fret_run(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run([FRET, *arguments], capture_output=True, text=True, check=False)


def test_the_same_scene_gives_the_same_bits(coated: fret.Result, tmp_path: Path) -> None:
    (tmp_path / "scene.toml").write_text(coated.scene.to_toml())
    run = fret_run("run", tmp_path / "scene.toml", "-o", tmp_path / "out.zarr")
    assert run.returncode == 0, run.stderr
    assert fret.open(tmp_path / "out.zarr").dataset.identical(coated.dataset)


@pytest.mark.parametrize(
    ("change", "names"),
    [
        ("mue = 0.3", "mu"),
        ("mu = -1.0", "friction.mu = -1"),
        ("mu = nan", "friction.mu = nan"),
    ],
)
def test_a_bad_scene_file_is_refused(change: str, names: str, tmp_path: Path) -> None:
    path = fret.LoadPath.start().normal(1e3, increments=1)
    text = sphere_on_flat().replace(path=path).to_toml()
    bad = tmp_path / "bad.toml"
    bad.write_text(text.replace("mu = 0.3", change))
    run = fret_run("run", bad, "-o", tmp_path / "out.zarr")
    assert run.returncode == 2
    assert names in run.stderr
    assert len(run.stderr.strip().splitlines()) == 1
    assert not (tmp_path / "out.zarr").exists()


def test_check_solves_nothing_and_says_what_is_skipped(scene_file: Path) -> None:
    run = fret_run("check", scene_file)
    assert run.returncode == 0, run.stderr
    for words in ("a_H", "p_H", "cells", "y < 0"):
        assert words in run.stdout
