"""No code and no settings of the current folder run with a command."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
MARK = "ran"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Modules that leave a mark when they are run, and settings that name a program."""
    for name in ("sitecustomize", "numpy", "xarray", "pyfret"):
        (tmp_path / f"{name}.py").write_text(f"open({MARK!r}, 'a').write({name!r})\n")
    (tmp_path / "matplotlibrc").write_text("animation.ffmpeg_path: ./program\n")
    return tmp_path


@pytest.mark.parametrize("path", [":", "", "{there}:", ":{there}", "{there}::", ".:{there}"])
def test_no_module_of_the_current_folder_runs(folder: Path, path: str) -> None:
    there = ROOT / "python"
    environment = {
        **os.environ,
        "FRET_PYTHON": sys.executable,
        "PYTHONPATH": path.format(there=there),
    }
    command = [ROOT / "target" / "release" / "fret", "cite"]
    ran = subprocess.run(
        command, capture_output=True, text=True, check=False, env=environment, cwd=folder
    )
    assert ran.returncode == 0, ran.stderr
    assert not (folder / MARK).exists(), (folder / MARK).read_text()


def test_settings_of_matplotlib_in_the_current_folder_are_passed_over(folder: Path) -> None:
    program = (
        "from pyfret._cli.commands import main; main(['cite']); import matplotlib, pathlib;"
        "print(matplotlib.rcParams['animation.ffmpeg_path'], pathlib.Path.cwd())"
    )
    environment = {**os.environ, "PYTHONSAFEPATH": "1", "PYTHONPATH": str(ROOT / "python")}
    for name in ("numpy", "xarray", "pyfret", "sitecustomize"):
        (folder / f"{name}.py").unlink()
    command = [sys.executable, "-c", program]
    ran = subprocess.run(
        command, capture_output=True, text=True, check=True, env=environment, cwd=folder
    )
    program_of_films, local = ran.stdout.splitlines()[-1].split(" ", 1)
    assert program_of_films == "ffmpeg"
    assert Path(local) == folder
