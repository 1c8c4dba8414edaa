"""Files that are none: pipes, devices, links; names as people give them."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

import pyfret as fret
from conftest import ROOT, W, sphere_on_flat

FRET = ROOT / "target" / "release" / "fret"
pytestmark = pytest.mark.skipif(os.name != "posix", reason="no pipes, no devices")

SCENE = """
schema = 1
body1 = { shape.sphere.R = 0.018, E = 210e9, nu = 0.3 }
body2 = { shape = "flat", E = 210e9, nu = 0.3 }
friction.mu = 0.3
grid = { n = 8, extent = { a_H = 3.0 } }
"""


def fret_(*arguments: str | Path, cwd: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [FRET, *arguments], cwd=cwd, capture_output=True, text=True, timeout=40, check=False
    )


@pytest.mark.parametrize("what", ["pipe", "device", "folder"])
def test_a_history_or_a_scene_that_is_no_file_is_refused_at_once(tmp_path: Path, what: str) -> None:
    """Neither waited for nor read without end."""
    name = tmp_path / "history.csv"
    if what == "pipe":
        os.mkfifo(name)
    elif what == "device":
        name.symlink_to("/dev/zero")
    else:
        name.mkdir()
    with pytest.raises(fret.errors.StoreError, match="is not a file"):
        fret.LoadPath.from_csv(name)
    scene = tmp_path / "scene.toml"
    scene.write_text(SCENE + 'path.file = "history.csv"\n')
    for arguments in (["check", scene, "--allow-outside"], ["check", name]):
        ended = fret_(*arguments, cwd=tmp_path)
        assert ended.returncode == 2
        assert "is not a file" in ended.stderr


@pytest.mark.parametrize("columns", ["W,W", "W,delta_z", "t,t", "W,T_x,delta_x"])
def test_columns_that_say_the_same_are_refused(tmp_path: Path, columns: str) -> None:
    """A motion and its load are driven by one column."""
    name = tmp_path / "history.csv"
    row = ",".join("1" for _ in columns.split(","))
    name.write_text(f"{columns}\n{row}\n")
    with pytest.raises(fret.errors.StoreError, match=r"both stand in it|two columns are called"):
        fret.LoadPath.from_csv(name)


@pytest.mark.parametrize(
    "names",
    [
        ("scene.toml", "run.zarr"),
        ("./a/../scene.toml", "a/run.zarr/"),
        ("mit Lücken/Größe µ.toml", "mit Lücken/Lösung 1.zarr"),
        ("日本語.toml", "./結果.zarr//"),
        ("-scene.toml", "-run.zarr"),
    ],
)
def test_names_as_people_give_them(tmp_path: Path, names: tuple[str, str]) -> None:
    """Check, run, refuse, replace, resume; nothing is left beside the store."""
    scene, out = names
    (tmp_path / "a").mkdir()
    (tmp_path / scene).parent.mkdir(exist_ok=True)
    (tmp_path / scene).write_text(SCENE + "path = [{ W = 1000.0, increments = 2 }]\n")
    assert fret_("check", "--", scene, cwd=tmp_path).returncode == 0
    run = ["run", f"--out={out}", "--quiet"]
    assert fret_(*run, "--", scene, cwd=tmp_path).returncode == 0
    assert fret_(*run, "--", scene, cwd=tmp_path).returncode == 2
    assert fret_(*run, "--overwrite", "--", scene, cwd=tmp_path).returncode == 0
    done = fret_("resume", "--", out, cwd=tmp_path)
    assert done.returncode == 0
    assert "is done" in done.stderr
    assert fret.open(tmp_path / out).status == "done"
    assert not [f for f in tmp_path.rglob(".*zarr*") if "zarr." in f.name]


def test_a_link_to_a_store_is_followed(tmp_path: Path) -> None:
    """The link stays, the store that it leads to is replaced; one to nowhere is refused at once."""
    scene = tmp_path / "scene.toml"
    scene.write_text(SCENE + "path = [{ W = 1000.0, increments = 2 }]\n")
    disk = tmp_path / "disk"
    disk.mkdir()
    link = tmp_path / "run.zarr"
    link.symlink_to(disk / "run.zarr")
    nowhere = fret_("run", scene, "-o", link, cwd=tmp_path)
    assert nowhere.returncode == 2
    assert "leads nowhere" in nowhere.stderr
    assert "are kept" not in nowhere.stderr
    assert fret_("run", scene, "-o", disk / "run.zarr", cwd=tmp_path).returncode == 0
    assert fret_("run", scene, "-o", link, "--overwrite", cwd=tmp_path).returncode == 0
    assert link.is_symlink()
    assert fret.open(link).status == "done"
    assert sorted(f.name for f in disk.iterdir()) == ["run.zarr"]


def test_increments_that_the_path_has_not_are_not_kept(tmp_path: Path) -> None:
    """`save` names increments of the path."""
    scene = sphere_on_flat(n=8)
    path = fret.LoadPath.start().normal(W, increments=3)
    of_path = "1 to 3, the increments of the path"
    for index, expected in ((0, "a whole number >= 1"), (4, of_path), (99, of_path)):
        with pytest.raises(fret.errors.InvalidSceneError, match=expected):
            fret.solve(scene, path, save=[index], progress=False)
