"""Make the maps: x3pio, sdfio, surfalize, SurfaceTopography, Gwyddion, Octave, GDAL, numpy, scipy.

``python maps.py FOLDER`` needs the programs ``gwyddion``, ``octave`` and ``gdal_translate``, and
surfalize 0.19.2. Each map has 5 points along x, 2 um apart, and 3 along y, 1 um apart. The height
at the point (i, j) is (10 j + i) um.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np
import scipy.io
import sdfio
import surfalize
import x3pio
from SurfaceTopography import Topography

STEPS = (2e-6, 1e-6)
#: Lines along x, as most formats have them.
LINES = 1e-6 * np.add.outer(10.0 * np.arange(3), np.arange(5.0))
HOLED = LINES.copy()
HOLED[1, 3] = np.nan


def write_x3p(folder: Path) -> None:
    """Write X3P of both revisions, with a hole, in whole numbers, of two layers, and a profile."""
    step = {"x_scale": STEPS[0], "y_scale": STEPS[1]}
    for name, revision in (
        ("2000", x3pio.Revision.ISO5436_2000),
        ("dam1", x3pio.Revision.ISO25178_72_2017_DAM1),
    ):
        x3pio.write(folder / f"x3pio_{name}.x3p", LINES, revision=revision, **step)
    x3pio.write(folder / "x3pio_hole.x3p", HOLED, z_type=x3pio.DataType.INT16, **step)
    x3pio.write(folder / "x3pio_layers.x3p", np.array([LINES, 2.0 * LINES]), **step)
    x3pio.write(folder / "x3pio_profile.x3p", LINES[0], x_scale=STEPS[0])
    Topography(LINES.T, (1e-5, 3e-6), unit="m").to_x3p(str(folder / "surfacetopography.x3p"))


def write_sdf(folder: Path) -> None:
    """Write SDF of three editions as text and binary."""
    step = {"x_scale": STEPS[0], "y_scale": STEPS[1]}
    for edition in ("ISO_1_0", "ISO_2_0", "BCR_1_0"):
        revision = getattr(sdfio.Revision, edition)
        for form in (sdfio.FileFormat.ASCII, sdfio.FileFormat.BINARY):
            kind = sdfio.DataType.INT32 if form is sdfio.FileFormat.ASCII else None
            metadata = sdfio.Metadata(revision=revision)
            if kind is not None:
                metadata = sdfio.Metadata(revision=revision, data_type=kind)
            name = f"sdfio_{edition.lower()}_{form.name.lower()}.sdf"
            # Lines of the first edition begin at the largest y in sdfio.
            lines = LINES[::-1] if edition == "BCR_1_0" else LINES
            sdfio.write(folder / name, lines, format=form, metadata=metadata, **step)
    sdfio.write(folder / "sdfio_hole.sdf", HOLED, **step)


def write_others(folder: Path) -> None:
    """Write the formats that surfalize and SurfaceTopography write."""
    surface = surfalize.Surface(1e6 * LINES, *(1e6 * step for step in STEPS))
    for ending in ("sur", "al3d", "sdf", "x3p"):
        surface.save(folder / f"surfalize.{ending}")
    topography = Topography(LINES.T, (1e-5, 3e-6), unit="m")
    topography.to_netcdf(str(folder / "surfacetopography.nc"))
    masked = Topography(np.ma.masked_invalid(HOLED.T), (1e-5, 3e-6), unit="m")
    masked.to_gwy(str(folder / "surfacetopography_mask.gwy"))


def write_by_programs(folder: Path, work: Path) -> None:
    """Write by Gwyddion, Octave and GDAL."""
    lines = "\n".join("\t".join(f"{1e9 * v:.0f}" for v in row) for row in LINES)
    (work / "map.asc").write_text(
        "# File Format = ASCII\n# x-pixels = 5\n# y-pixels = 3\n# x-length = 10000\n"
        f"# y-length = 3000\n# Bit2nm = 1.0\n# Start of Data:\n{lines}\n"
    )
    run = {"cwd": work, "check": True, "capture_output": True, "timeout": 120}
    subprocess.run(["gwyddion", "--convert-to-gwy=map.gwy", "map.asc"], **run)
    (folder / "gwyddion.gwy").write_bytes((work / "map.gwy").read_bytes())
    script = (
        "z = (0:4)' + 10 * (0:2); save('-v7', 'o7.mat', 'z'); save('-v6', 'o6.mat', 'z');"
        "save('-hdf5', 'o.h5', 'z'); dlmwrite('o.csv', z); save('-ascii', 'o.txt', 'z');"
    )
    subprocess.run(["octave", "--no-gui", "--eval", script], **run)
    for made, name in (
        *(("o7.mat", "octave_7.mat"), ("o6.mat", "octave_6.mat"), ("o.h5", "octave.h5")),
        *(("o.csv", "octave_dlmwrite.csv"), ("o.txt", "octave_ascii.txt")),
    ):
        (folder / name).write_bytes((work / made).read_bytes())
    # GDAL's first line is the northern one.
    grid = "ncols 5\nnrows 3\nxllcorner 0\nyllcorner 0\ndx 2e-6\ndy 1e-6\n"
    north = "\n".join(" ".join(f"{v:.9g}" for v in row) for row in LINES[::-1])
    (work / "grid.asc").write_text(grid + north + "\n")
    for form, name in (("AAIGrid", "gdal.asc"), ("XYZ", "gdal.xyz"), ("GSAG", "gdal_surfer.grd")):
        options = ["-co", "SIGNIFICANT_DIGITS=9"] if form == "AAIGrid" else []
        command = ["gdal_translate", "-ot", "Float64", "-of", form, *options, "grid.asc", name]
        subprocess.run(command, **run)
        (folder / name).write_bytes((work / name).read_bytes())
    subprocess.run(["gdal_translate", "-ot", "Float32", "grid.asc", "gdal.tif"], **run)
    (folder / "gdal.tif").write_bytes((work / "gdal.tif").read_bytes())


def write_arrays(folder: Path) -> None:
    """Write by numpy, scipy and h5py: heights in um, x first."""
    z = 1e6 * LINES.T
    np.save(folder / "numpy.npy", z.astype("float32"))
    np.savez(folder / "numpy.npz", z=z)
    np.savetxt(folder / "numpy_savetxt.txt", z, header="z [um]")
    scipy.io.savemat(folder / "scipy.mat", {"z": z, "name": "made up"})
    with h5py.File(folder / "h5py_73.mat", "w", userblock_size=512) as file:
        file.create_dataset("z", data=z.T).attrs["MATLAB_class"] = np.bytes_("double")
    with (folder / "h5py_73.mat").open("r+b") as raw:
        raw.write(b"MATLAB 7.3 MAT-file, Platform: none".ljust(124) + b"\x00\x02IM")


if __name__ == "__main__":
    target = Path(sys.argv[1])
    write_x3p(target)
    write_sdf(target)
    write_others(target)
    write_arrays(target)
    with tempfile.TemporaryDirectory() as scratch:
        write_by_programs(target, Path(scratch))
