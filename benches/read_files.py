"""Time and memory of reading large files, over those of the reading library alone.

    python benches/read_files.py [POINTS] [SAMPLES] [--format FORMAT ...]

A map of POINTS x POINTS heights (4096 by default) as SDF, X3P and OPD, and a recording of SAMPLES
samples (1e7 by default) as TDMS. Each reading runs in its own process, library and pyfret in turn,
and the least of several counts. The bars: 1.3 times the time of the library and 2.5 maps of memory
for maps, 1.5 times the time of npTDMS for the recording.
"""

from __future__ import annotations

import argparse
import json
import os
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from measuring import peak_memory
from tables import table

if TYPE_CHECKING:
    from collections.abc import Callable

#: Readings of each kind.
TURNS = 5
#: Distance of the points [m].
PITCH = 1e-6
#: Samples of a cycle of the recording.
CYCLE = 1000


def heights(count: int) -> Any:
    """Heights of a rough map [m], in thousandths of a micrometre."""
    rng = np.random.default_rng(1)
    rows = rng.normal(0.0, 1e-6, (count, 1)) + rng.normal(0.0, 1e-6, (1, count))
    return np.round(rows, 9)


def write_sdf(path: Path, count: int) -> None:
    """Write 16-bit heights, as instruments store them."""
    import sdfio

    metadata = sdfio.Metadata(data_type=sdfio.DataType.INT16)
    sdfio.write(path, heights(count), x_scale=PITCH, y_scale=PITCH, metadata=metadata)


def write_x3p(path: Path, count: int) -> None:
    """Write heights in double precision."""
    import x3pio

    x3pio.write(path, heights(count), x_scale=PITCH, y_scale=PITCH)


def write_opd(path: Path, count: int) -> None:
    """Write the blocks that SurfaceTopography reads: the raster, pitch [mm] and wavelength [nm]."""
    raster = np.round(heights(count) / 1e-9).astype("<f4").tobytes()
    blocks = [
        ("RAW_DATA", 3, struct.pack("<HHH", count, count, 4) + raster),
        ("Wavelength", 7, struct.pack("<f", 1.0)),
        ("Mult", 6, struct.pack("<h", 1)),
        ("Aspect", 7, struct.pack("<f", 1.0)),
        ("Pixel_size", 7, struct.pack("<f", PITCH / 1e-3)),
    ]
    head = struct.Struct("<16shlH")
    with path.open("wb") as file:
        file.write(b"\x01\x00" + head.pack(b"Directory", 1, 24 * (len(blocks) + 1), 0xFFFF))
        for name, kind, content in blocks:
            file.write(head.pack(name.encode(), kind, len(content), 0))
        for _, _, content in blocks:
            file.write(content)


def write_tdms(path: Path, samples: int) -> None:
    """Write a shift and a force of a rig in segments, as LabVIEW streams them."""
    import nptdms

    steps = 1_000_000
    with nptdms.TdmsWriter(path) as file:
        for first in range(0, samples, steps):
            phase = 2 * np.pi * np.arange(first, min(first + steps, samples)) / CYCLE
            shift, force = 20.0 * np.sin(phase), 8.0 * np.tanh(3.0 * np.sin(phase - 0.4))
            clock = {"wf_increment": 1e-4, "wf_start_offset": 0.0}
            channels = [
                nptdms.ChannelObject("rig", name, values, {"unit_string": unit, **clock})
                for name, values, unit in (("delta", shift, "um"), ("T", force, "N"))
            ]
            file.write_segment(channels)


def read_sdf_alone(path: Path) -> Any:
    """Read by sdfio."""
    import sdfio

    return sdfio.read(path).data


def read_x3p_alone(path: Path) -> Any:
    """Read by x3pio."""
    import x3pio

    return x3pio.read(path).layers[0].z


def read_opd_alone(path: Path) -> Any:
    """Read by SurfaceTopography, in the millimetres of the file."""
    from SurfaceTopography.IO import open_topography

    return open_topography(str(path)).topography().heights()


def read_tdms_alone(path: Path) -> Any:
    """Read the two channels by npTDMS."""
    import nptdms

    with nptdms.TdmsFile.open(path) as file:
        return [file["rig"][name].read_data() for name in ("delta", "T")]


def read_map(path: Path) -> Any:
    """Read a map by pyfret."""
    import pyfret as fret

    return fret.read_surface(path)


def read_loops(path: Path) -> Any:
    """Read loops by pyfret."""
    import pyfret as fret

    return fret.fit.read_loops(path)


#: Format: how it is written, read by its library alone, and read by pyfret.
FORMATS: dict[str, tuple[Callable[..., None], Callable[..., Any], Callable[..., Any]]] = {
    "sdf": (write_sdf, read_sdf_alone, read_map),
    "x3p": (write_x3p, read_x3p_alone, read_map),
    "opd": (write_opd, read_opd_alone, read_map),
    "tdms": (write_tdms, read_tdms_alone, read_loops),
}


def read_here(kind: str, path: Path, small: Path, *, by_pyfret: bool, cold: bool) -> None:
    """Read a file after a small one of its format; print time [s] and memory [bytes] as JSON."""
    read = FORMATS[kind][2 if by_pyfret else 1]
    read(small)
    held = peak_memory()
    if cold:
        with path.open("rb") as file:
            os.posix_fadvise(file.fileno(), 0, 0, os.POSIX_FADV_DONTNEED)
    begin, used = time.perf_counter(), time.process_time()
    content = read(path)
    seconds, processor = time.perf_counter() - begin, time.process_time() - used
    line = {"seconds": seconds, "processor": processor, "memory": peak_memory() - held}
    print(json.dumps(line))
    del content


def measure_format(kind: str, folder: Path, count: int, *, cold: bool) -> list[str]:
    """Read a format by its library and by pyfret in turn; return a row of the table."""
    path, small = folder / f"large.{kind}", folder / f"small.{kind}"
    write = FORMATS[kind][0]
    write(path, count)
    with path.open("rb") as file:
        os.fsync(file.fileno())
    write(small, 64 if kind != "tdms" else 10 * CYCLE)
    least: dict[bool, dict[str, float]] = {False: {}, True: {}}
    for _ in range(TURNS):
        for by_pyfret in (False, True):
            command = [sys.executable, __file__, "--read", kind, str(path), str(small)]
            done = subprocess.run(
                [*command, *["--pyfret"] * by_pyfret, *["--cold"] * cold],
                capture_output=True,
                text=True,
                check=True,
            )
            line = json.loads(done.stdout)
            best = least[by_pyfret]
            for name, value in line.items():
                best[name] = min(value, best.get(name, value))
    path.unlink()
    alone, ours = least[False], least[True]
    channel = 8 * (count**2 if kind != "tdms" else 2 * count)
    return [
        kind,
        f"{alone['processor']:.3f}",
        f"{ours['processor']:.3f}",
        f"{ours['processor'] / alone['processor']:.2f}",
        f"{ours['seconds'] / alone['seconds']:.2f}",
        f"{alone['memory'] / channel:.2f}",
        f"{ours['memory'] / channel:.2f}",
    ]


def main() -> None:
    """Write the files, read them, and print a table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("points", nargs="?", type=int, default=4096)
    parser.add_argument("samples", nargs="?", type=int, default=10_000_000)
    parser.add_argument("--format", nargs="+", choices=FORMATS, default=list(FORMATS))
    parser.add_argument("--read", nargs=3, help=argparse.SUPPRESS)
    parser.add_argument("--pyfret", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("--cold", action="store_true", help="read from the disk, not from memory")
    options = parser.parse_args()
    if options.read:
        kind, path, small = options.read
        read_here(kind, Path(path), Path(small), by_pyfret=options.pyfret, cold=options.cold)
        return
    titles = ["format", "library, processor [s]", "pyfret, processor [s]", "ratio of processor"]
    titles += ["ratio of time", "memory of the library [maps]", "memory of pyfret [maps]"]
    with tempfile.TemporaryDirectory() as folder:
        rows = [
            measure_format(
                kind,
                Path(folder),
                options.samples if kind == "tdms" else options.points,
                cold=options.cold,
            )
            for kind in options.format
        ]
    print(table(titles, rows))


if __name__ == "__main__":
    main()
