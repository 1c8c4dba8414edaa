"""Make the recordings of a rig: npTDMS, asammdf, Octave, scipy, h5py, pandas, openpyxl, numpy.

``python recordings.py FOLDER`` needs the program ``octave``. Each recording has the shift
20 um sin(t) and the force 8 N tanh(3 sin(t - 0.4)) over two cycles in 81 points, 0.05 s apart, and
the temperature of the rig in degrees Celsius, which no fit uses.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

import asammdf
import h5py
import numpy as np
import pandas as pd
import scipy.io
from nptdms import ChannelObject, RootObject, TdmsWriter

STEP = 0.05
TIME = STEP * np.arange(81)
ANGLE = np.linspace(0.0, 4.0 * np.pi, TIME.size)
SHIFT = 20.0 * np.sin(ANGLE)
FORCE = 8.0 * np.tanh(3.0 * np.sin(ANGLE - 0.4))
WARMTH = np.round(24.5 + 0.01 * np.arange(TIME.size), 3)
NAMES = {"delta [um]": SHIFT, "T [N]": FORCE, "rig [°C]": WARMTH}


def write_tdms(folder: Path) -> None:
    """Write TDMS: one clock, and a force sampled at twice the rate of the shift."""
    with TdmsWriter(folder / "nptdms.tdms") as writer:
        channels = [
            ChannelObject(
                "rig", name, values, properties={"unit_string": unit, "wf_increment": STEP}
            )
            for name, unit, values in (
                ("delta", "um", SHIFT),
                ("T", "N", FORCE),
                ("warmth", "°C", WARMTH),
            )
        ]
        writer.write_segment([RootObject({"title": "made up"}), *channels])
    fine = np.linspace(0.0, 4.0 * np.pi, 2 * TIME.size - 1)
    with TdmsWriter(folder / "nptdms_two_clocks.tdms") as writer:
        rows = (
            ("delta", "um", SHIFT, STEP),
            ("T", "N", 8.0 * np.tanh(3.0 * np.sin(fine - 0.4)), STEP / 2),
        )
        for name, unit, values, step in rows:
            properties = {"unit_string": unit, "wf_increment": step}
            writer.write_segment([ChannelObject("rig", name, values, properties=properties)])


def write_mdf(folder: Path) -> None:
    """Write MDF 4: shift and force of two clocks, and a counter."""
    fine = np.linspace(0.0, 4.0 * np.pi, 2 * TIME.size - 1)
    with asammdf.MDF(version="4.10") as file:
        file.append([asammdf.Signal(SHIFT, TIME, name="delta", unit="um")])
        force = 8.0 * np.tanh(3.0 * np.sin(fine - 0.4))
        times = 0.5 * STEP * np.arange(fine.size)
        file.append([asammdf.Signal(force, times, name="T", unit="N")])
        count = np.arange(TIME.size, dtype="u2")
        file.append([asammdf.Signal(count, TIME, name="count", unit="")])
        file.save(folder / "asammdf.mf4", overwrite=True)


def write_mat(folder: Path, work: Path) -> None:
    """Write MAT by Octave, by scipy with structures, and of version 7.3 by h5py."""
    np.savetxt(work / "rows.txt", np.c_[SHIFT, FORCE, WARMTH])
    script = (
        "a = load('rows.txt'); delta_um = a(:,1); T_N = a(:,2); warmth = a(:,3);"
        "save('-v7', 'o.mat', 'delta_um', 'T_N', 'warmth');"
    )
    subprocess.run(["octave", "--no-gui", "--eval", script], cwd=work, check=True, timeout=120)
    (folder / "octave_rig.mat").write_bytes((work / "o.mat").read_bytes())
    rig = {
        "delta": {"data": SHIFT, "unit": "um"},
        "T": {"data": FORCE, "unit": "N"},
        "warmth": {"data": WARMTH, "unit": "°C"},
    }
    scipy.io.savemat(folder / "scipy_rig.mat", {"rig": rig})
    with h5py.File(folder / "h5py_rig_73.mat", "w", userblock_size=512) as file:
        for name, values in (("delta_um", SHIFT), ("T_N", FORCE)):
            data = file.create_dataset(name, data=values[None, :])
            data.attrs["MATLAB_class"] = np.bytes_("double")
    with (folder / "h5py_rig_73.mat").open("r+b") as raw:
        raw.write(b"MATLAB 7.3 MAT-file, Platform: none".ljust(124) + b"\x00\x02IM")


def write_tables(folder: Path) -> None:
    """Write HDF5, sheets and text."""
    with h5py.File(folder / "h5py_rig.h5", "w") as file:
        for name, values in NAMES.items():
            key, unit = name.rstrip("]").split(" [")
            file.create_dataset(f"run 1/{key}", data=values).attrs["units"] = unit
    frame = pd.DataFrame(NAMES).round(6)
    frame.to_excel(folder / "pandas.xlsx", index=False)
    with pd.ExcelWriter(folder / "pandas_head.xlsx") as book:
        frame.to_excel(book, sheet_name="loops", index=False, startrow=3)
        pd.DataFrame({"about": ["made up"]}).to_excel(book, sheet_name="about", index=False)
    frame.to_csv(folder / "pandas_rig.csv", index=False)
    frame.insert(0, "time", pd.Timestamp("2026-11-29") + pd.to_timedelta(TIME, "s"))
    frame.to_csv(folder / "pandas_times.csv", index=False, sep=";")
    table = np.column_stack(list(NAMES.values()))
    for name, separator in (("csv", ";"), ("txt", "\t"), ("dat", " ")):
        np.savetxt(
            folder / f"numpy_rig.{name}",
            table,
            fmt="%.6f",
            delimiter=separator,
            header="written by a script\n" + separator.join(NAMES),
            encoding="utf-8",
        )


if __name__ == "__main__":
    target = Path(sys.argv[1])
    write_tdms(target)
    write_mdf(target)
    write_tables(target)
    with tempfile.TemporaryDirectory() as scratch:
        write_mat(target, Path(scratch))
