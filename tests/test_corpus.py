"""Every reader on files as other programs write them, and on what is no file.

`tests/data/files/README.md` lists the program of each form.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyfret as fret
from pyfret.export.meshes import read_mesh

FILES = Path(__file__).parent / "data" / "files"
ALL = sorted(path.name for path in FILES.iterdir() if path.suffix != ".md")

#: Heights of the surfaces [um], and the distance of their points [m].
X, Y = np.meshgrid(np.arange(4), np.arange(3), indexing="ij")
HEIGHTS = np.round(0.1 * X + 0.05 * Y**2 + 0.3 * ((X == 0) & (Y == 2)), 3)

#: All public readers of files, by name; each gets a path and gives what it reads.
READERS: dict[str, Callable[[Path], Any]] = {
    "surface": lambda path: fret.read_surface(path, unit="um", spacing=(1e-6, 1.5e-6)),
    "surface with units": lambda path: fret.read_surface(path),
    "surface in um": lambda path: fret.read_surface(path, unit="um"),
    "SurfaceMap": lambda path: fret.SurfaceMap.from_file(path, unit="um"),
    "loops": fret.fit.read_loops,
    "loops from line 3": lambda path: fret.fit.read_loops(path, skip=2, units={"Weg": "um"}),
    "indentation": fret.fit.read_indentation,
    "scar": lambda path: fret.fit.read_scar(path, wear={}),
    "lives": lambda path: fret.fit.read_lives(path, wear={}),
    "materials": fret.fatigue.Materials,
    "bulk_stress": fret.export.bulk_stress,
    "compliance": lambda path: fret.export.compliance(path, 1.0),
    "mesh": read_mesh,
    "history": fret.LoadPath.from_csv,
    "scene": fret.Scene.from_file,
    "open": fret.open,
    "study": fret.open,
    "wear": fret.open,
    "resume": lambda path: fret.resume(path, progress=False),
    "resume of wear": lambda path: fret.wear.resume(path, progress=False),
}


def heights(found: Any) -> bool:
    return found.values.shape == (4, 3) and np.allclose(
        found.values - found.values.mean(), 1e-6 * (HEIGHTS - HEIGHTS.mean()), atol=2e-9
    )


def on_their_grid(found: Any) -> bool:
    return heights(found) and np.allclose(found.spacing, (1e-6, 1.5e-6), rtol=2e-3)


def on_squares(found: Any) -> bool:
    return heights(found) and np.allclose(found.spacing, (1e-6, 1e-6))


def looped(found: Any) -> bool:
    # The shift turns near +-10 um, the force is near 0.5 N.
    return np.isclose(np.ptp(found.delta), 20e-6, rtol=1e-3) and np.isclose(
        np.abs(found.T).max(), 0.52, rtol=1e-2
    )


def block(found: Any) -> bool:
    low, high = found.points.min(axis=0), found.points.max(axis=0)
    return (
        np.allclose(low, (-0.5, -0.5, -1.0))
        and np.allclose(high, (0.5, 0.5, 0.0))
        and [rows.shape for rows in found.volumes] == [(1, 8)]
    )


def assembled(found: Any) -> bool:
    return block(found) and found.names[0] == "Block-1.1"


def turned(found: Any) -> bool:
    # A quarter turn about z takes the node at (-0.5, -0.5) to (0.5, -0.5).
    return assembled(found) and np.allclose(found.points[0], (0.5, -0.5, 0.0))


#: What reads a file right, and how that is seen; every other reader must refuse it.
RIGHT: dict[str, dict[str, Callable[[Any], bool]]] = {
    "surface_points.xyz": {"surface in um": on_their_grid, "surface": on_their_grid},
    "surface_stage.xyz": {"surface in um": on_their_grid, "surface": on_their_grid},
    "surface_esri.asc": {"surface in um": on_their_grid, "surface": on_their_grid},
    "surface_esri_centre.asc": {"surface in um": on_squares},
    "surface_pandas.csv": {"surface": on_their_grid},
    "surface_pandas_numbers.csv": {"surface": on_their_grid},
    "surface_r.txt": {"surface": on_their_grid},
    "surface_excel.csv": {"surface": on_their_grid},
    "surface_gwyddion.txt": {"surface with units": on_their_grid},
    "surface_iso.sdf": {"surface with units": on_their_grid},
    "surface_bcr.sdf": {"surface with units": on_their_grid},
    **{
        f"loops_{name}": {"loops": looped}
        for name in ("plain.csv", "logger.txt", "labview.lvm", "mts.dat")
    },
    "mesh_flat.inp": {"mesh": block},
    "mesh_continued.inp": {"mesh": block},
    "mesh_assembly.inp": {"mesh": assembled},
    "mesh_turned.inp": {"mesh": turned},
    "mesh_shells.inp": {"mesh": lambda found: [f.shape for f in found.faces] == [(1, 4)]},
    **{
        f"stress_{name}.frd": {"bulk_stress": lambda found: found == -5280.12}
        for name in ("linux", "windows", "short")
    },
    "stress_one.dat": {"bulk_stress": lambda found: found == 75.0},
    "stress_times.dat": {"bulk_stress": lambda found: found == 75.0},
    "materials_windows.toml": {"materials": lambda found: found["own"].name == "own"},
    "history_units.csv": {"history": lambda found: found.branches[-1].T_x == -1.5},
}
#: Part of the reason of those that the reader of their kind refuses.
REFUSED = {
    "surface_polar.xyz": ("surface in um", "no even grid"),
    "surface_pandas_no_header.csv": ("surface", "column 1 counts"),
    "surface_surfer.grd": ("surface", "Surfer"),
    "surface_grass.asc": ("surface", "GRASS"),
    "loops_no_units.txt": ("loops", "unit"),
    "loops_numbers_above.txt": ("loops", "must name the columns"),
    "mesh_system.inp": ("mesh", r"\*SYSTEM"),
    "mesh_include.inp": ("mesh", r"\*INCLUDE"),
    "mesh_ngen.inp": ("mesh", r"\*NGEN"),
    "mesh_transform.inp": ("mesh", r"\*TRANSFORM"),
    "mesh_cylindrical.inp": ("mesh", r"\*NODE, SYSTEM"),
    "mesh_nastran_cord.bdf": ("mesh", "coordinate systems"),
    "mesh_damaged.vtk": ("mesh", "mesh_damaged"),
    "stress_stars.frd": ("bulk_stress", r"\*\*\*"),
    "stress_binary_head.frd": ("bulk_stress", "format 2"),
    "stress_sets.dat": ("bulk_stress", "ENEAR, EFAR"),
    "stress_local.dat": ("bulk_stress", "OR_LOCAL"),
    "history_no_name.csv": ("history", "history_no_name"),
    "materials_yaml.toml": ("materials", "materials_yaml"),
}
CURVES = frozenset(("indentation", "loops from line 3"))
#: Tables of numbers that more than one reader may take: heights, lives and loops look alike.
TABLES = frozenset(("surface", "surface in um", "surface with units", "SurfaceMap", "lives"))


@pytest.mark.solves
@pytest.mark.parametrize("name", ALL)
def test_every_reader_is_right_or_refuses(name: str) -> None:
    """Right where it is the reader of the kind; else refused, by the name of the file."""
    right = RIGHT.get(name, {})
    for reader, read in READERS.items():
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                surface = read(FILES / name)
            except (ValueError, OSError, LookupError) as refused:
                surface, text = None, str(refused)
            else:
                text = ""
        if text:
            assert reader not in right, f"{reader}: {text}"
            assert name in text, f"{reader}: {text}"
            if REFUSED.get(name, ("", ""))[0] == reader:
                assert re.search(REFUSED[name][1], text), text
            continue
        assert REFUSED.get(name, ("", ""))[0] != reader, f"{reader} reads it"
        if reader in right:
            assert right[reader](surface), f"{reader}: {surface}"
        else:
            table = name.startswith(("surface", "loops", "history")) and reader in TABLES
            # Shift over force is an indentation as well; lines may be left out of any table.
            curve = reader in CURVES and name.startswith("loops")
            assert table or curve, f"{reader} takes it for {surface!r}"


def test_every_file_has_its_place() -> None:
    """Each is read right by someone, or refused for a reason that is tested."""
    assert set(ALL) == set(RIGHT) | set(REFUSED)
    assert len(ALL) >= 40


CODE = """
import resource, signal, sys
resource.setrlimit(resource.RLIMIT_AS, (6 << 30, 6 << 30))
sys.path.insert(0, {here!r})
import test_corpus
from pathlib import Path
for path in sys.argv[1:]:
    for name, read in test_corpus.READERS.items():
        signal.alarm(20)
        try:
            read(Path(path))
        except (ValueError, OSError, LookupError, MemoryError):
            print("refused", flush=True)
        else:
            print("READ", name, path, flush=True)
"""
#: Endings by which readers recognise a file.
ENDINGS = ("", ".csv")


@pytest.mark.skipif(os.name != "posix", reason="pipes and devices of Unix")
def test_what_is_no_file_is_refused_by_every_reader(tmp_path: Path) -> None:
    """A pipe, a device, a folder, an empty file, a terabyte of nothing: at once, without memory."""
    paths = []
    for ending in ENDINGS:
        pipe, empty, huge, device, folder = (
            tmp_path / f"{name}{ending}" for name in ("pipe", "empty", "huge", "device", "folder")
        )
        os.mkfifo(pipe)
        empty.touch()
        with huge.open("wb") as file:
            file.truncate(1 << 40)
        device.symlink_to("/dev/zero")
        folder.mkdir()
        paths += [pipe, empty, huge, device, folder]
    command = [sys.executable, "-c", CODE.format(here=str(Path(__file__).parent))]
    done = subprocess.run(
        [*command, *map(str, paths)], capture_output=True, text=True, timeout=200, check=False
    )
    lines = done.stdout.splitlines()
    assert all(line == "refused" for line in lines), done.stdout.replace("refused\n", "")
    count = len(READERS)
    where = paths[min(len(lines) // count, len(paths) - 1)], [*READERS][len(lines) % count]
    assert len(lines) == count * len(paths), f"{where}: {done.stderr[-600:]}"
