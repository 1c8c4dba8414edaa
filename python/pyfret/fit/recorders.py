"""Readers of the formats of recordings: TDMS, MAT, HDF5, MDF, and sheets of Excel."""

from __future__ import annotations

import zipfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._core import read_bytes, shown
from pyfret._util.extras import needed
from pyfret.fit.columns import RecordColumns
from pyfret.fit.recordings import Channel, Recording
from pyfret.fit.tables import read_table, table_from_rows

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Iterator

__all__ = ["kind_of_recording", "read_columns"]

#: First bytes of a file, and its format.
MARKS = (
    (b"TDSm", "TDMS"),
    (b"MATLAB 7.3 MAT-file", "MAT 7.3"),
    (b"MATLAB 5.0 MAT-file", "MAT 5"),
    (b"\x89HDF\r\n\x1a\n", "HDF5"),
    (b"MDF     ", "MDF"),
    (b"UnFinMF ", "MDF, unfinished"),
    (b"\xd0\xcf\x11\xe0", "Excel 97"),
)
#: Formats that are refused, and what to do.
REFUSED = {
    "MDF, unfinished": "the recording was not finished: finalize it in the recorder first",
    "Excel 97": "is a workbook of Excel 97 to 2003: save it as .xlsx",
    "OpenDocument": "is a sheet of OpenDocument: save it as .xlsx or .csv",
    "archive": "is an archive and no workbook of Excel",
}
#: RecordColumns of a matrix that count as channels.
MOST_COLUMNS = 64


def read_columns(
    path: str | os.PathLike[str],
    units: dict[str, str] | None = None,
    *,
    skip: int = 0,
    group: str | None = None,
) -> RecordColumns:
    """Read the columns of a file by its content.

    ``group`` is the group of channels, the sheet of a workbook or the structure that has them.
    """
    file = Path(path)
    kind = kind_of_recording(file)
    if kind == "text":
        if group is not None:
            raise ValueError(f"{file}: is text, which has no groups: leave group out")
        return read_table(file, units, skip=skip)
    if kind in REFUSED:
        raise ValueError(f"{file}: {REFUSED[kind]}")
    if skip and kind != "Excel":
        raise ValueError(f"{file}: skip = {skip}: only text and sheets have lines")
    try:
        if kind == "Excel":
            return read_sheet(file, units, skip, group)
        channels = list(READERS[kind](file))
    except ImportError:
        raise
    except Exception as error:
        if isinstance(error, ValueError) and str(error).startswith(str(file)):
            raise
        text = " ".join(str(error).split())[:300] or type(error).__name__
        raise ValueError(shown(f"{file}: is no whole {kind} file: {text}")) from error
    groups = list(dict.fromkeys(channel.group for channel in channels))
    if group is not None and group not in groups:
        raise ValueError(f"{file}: has no group {group!r}, but {', '.join(map(repr, groups))}")
    chosen = [channel for channel in channels if group in (None, channel.group)]
    return Recording(str(file), chosen, units)


def kind_of_recording(path: Path) -> str:
    """Return the format of a file by its first bytes; text for all other ones."""
    if not path.is_file():
        # The reason by the reader that refuses pipes and devices.
        read_bytes(path)
    with path.open("rb") as file:
        start = file.read(64)
    for mark, kind in MARKS:
        if start.startswith(mark):
            return kind
    if start.startswith(b"PK\x03\x04"):
        try:
            with zipfile.ZipFile(path) as archive:
                names = archive.namelist()
        except zipfile.BadZipFile as error:
            raise ValueError(f"{path}: is no whole archive or workbook: {error}") from error
        if "xl/workbook.xml" in names:
            return "Excel"
        return "OpenDocument" if "content.xml" in names else "archive"
    return "MAT 4" if path.suffix.lower() == ".mat" else "text"


def channels_of_tdms(path: Path) -> Iterator[Channel]:
    """List the channels of a TDMS file, with the clocks of their waveforms."""
    nptdms = needed("nptdms", "rigs")
    with nptdms.TdmsFile.open(path) as file:
        listed = [(group.name, channel) for group in file.groups() for channel in group.channels()]
        channels = [
            (name, channel.name, channel.properties, len(channel), channel.dtype)
            for name, channel in listed
        ]
        incomplete = getattr(file.file_status, "incomplete_final_segment", False)
    if incomplete:
        raise ValueError(f"{path}: is no whole TDMS file: its last segment is not complete")
    for group, name, properties, size, dtype in channels:
        if np.dtype(dtype).kind not in "fiub":
            continue
        unit = str(properties.get("unit_string") or properties.get("NI_UnitDescription") or "")
        step = float(properties.get("wf_increment") or 0.0)
        begin = float(properties.get("wf_start_offset") or 0.0)
        start = properties.get("wf_start_time")
        if isinstance(start, np.datetime64):
            begin += float(start.astype("datetime64[us]").astype(np.int64)) * 1e-6
        clock = (begin, step) if step > 0.0 else None
        yield Channel(
            group,
            name,
            unit,
            size,
            _tdms_reader(path, group, name),
            _even_clock(clock, size),
            clock,
            _tdms_pieces(path, group, name),
        )


def _tdms_reader(path: Path, group: str, name: str) -> Callable[[], Any]:
    """Return a function that reads one channel of a TDMS file, scaled."""

    def read() -> Any:
        """Read the samples."""
        nptdms = needed("nptdms", "rigs")
        with nptdms.TdmsFile.open(path) as file:
            return file[group][name].read_data()

    return read


def _tdms_pieces(path: Path, group: str, name: str) -> Callable[[], Iterator[Any]]:
    """Return a function that iterates over the scaled samples of a channel, segment by segment."""

    def read() -> Iterator[Any]:
        nptdms = needed("nptdms", "rigs")
        with nptdms.TdmsFile.open(path) as file:
            for chunk in file[group][name].data_chunks():
                yield chunk[:]

    return read


def _even_clock(clock: tuple[float, float] | None, size: int) -> Callable[[], Any] | None:
    """Return a function that computes the instants of an even clock."""
    if clock is None:
        return None
    begin, step = clock
    return lambda: begin + step * np.arange(size)


def channels_of_mat(path: Path) -> Iterator[Channel]:
    """List the arrays of a MAT file up to version 7.2; structures are groups."""
    content = needed("scipy.io", "rigs").loadmat(path, simplify_cells=True)
    variables = {key: value for key, value in content.items() if not key.startswith("__")}
    yield from _channels_of_tree(variables, "")


def _channels_of_tree(tree: dict[str, Any], group: str) -> Iterator[Channel]:
    """List the arrays of nested structures; a field ``unit`` is the unit of its array."""
    for name, value in tree.items():
        if isinstance(value, dict):
            array = next((value[key] for key in ("data", "values", "y") if key in value), None)
            unit = next((value[key] for key in ("unit", "units") if key in value), None)
            if isinstance(array, np.ndarray) and isinstance(unit, str):
                yield from _columns_of_array(array, group, name, unit)
            else:
                yield from _channels_of_tree(value, f"{group}/{name}" if group else name)
        elif isinstance(value, np.ndarray) and value.dtype.kind in "fiub" and value.size > 1:
            yield from _columns_of_array(value, group, name, "")


def _columns_of_array(array: Any, group: str, name: str, unit: str) -> Iterator[Channel]:
    """List the columns of an array of one or two dimensions."""
    values = np.squeeze(np.asarray(array))
    if values.ndim == 1:
        yield Channel(group, name, unit, values.size, lambda: values)
    elif values.ndim == 2 and values.shape[1] <= MOST_COLUMNS:
        for n in range(values.shape[1]):
            yield Channel(
                group,
                f"{name}[:,{n}]",
                unit,
                values.shape[0],
                lambda n=n: values[:, n],  # type: ignore[misc]
            )


def channels_of_hdf5(path: Path) -> Iterator[Channel]:
    """List the arrays of an HDF5 file, or of a MAT file of version 7.3, by their groups."""
    h5py = needed("h5py", "rigs")
    with h5py.File(path, "r") as file:
        turned = file.userblock_size >= 512
        datasets: list[tuple[str, Any, str, Any]] = []

        def visit(name: str, node: Any) -> None:
            """Collect an array with its groups."""
            if not isinstance(node, h5py.Dataset) or name.startswith("#"):
                return
            unit = next((node.attrs[key] for key in ("units", "unit") if key in node.attrs), "")
            unit = unit.decode("utf-8", "replace") if isinstance(unit, bytes) else str(unit)
            names = node.attrs.get("columns", node.attrs.get("names"))
            datasets.append((name, (node.shape, node.dtype), unit, names))

        file.visititems(visit)
    for name, (shape, dtype), unit, names in datasets:
        group, _, short = name.rpartition("/")
        if dtype.names:
            for key in dtype.names:
                if dtype[key].kind in "fiub" and len(shape) == 1:
                    yield Channel(group, key, "", shape[0], _hdf5_reader(path, name, key))
            continue
        if dtype.kind not in "fiub" or dtype.shape:
            continue
        size = shape[::-1] if turned else shape
        if len([n for n in size if n > 1]) == 1:
            yield Channel(group, short, unit, max(size), _hdf5_reader(path, name, None))
        elif len(size) == 2 and size[1] <= MOST_COLUMNS and size[0] > 1:
            for n in range(size[1]):
                slot = (n, slice(None)) if turned else (slice(None), n)
                title = f"{short}[:,{n}]"
                if names is not None and len(names) == size[1]:
                    title = names[n].decode() if isinstance(names[n], bytes) else str(names[n])
                yield Channel(group, title, unit, size[0], _hdf5_reader(path, name, slot))


def _hdf5_reader(path: Path, name: str, slot: Any) -> Callable[[], Any]:
    """Return a function that reads a dataset, or a part of it."""

    def read() -> Any:
        """Read the samples."""
        with needed("h5py", "rigs").File(path, "r") as file:
            values = file[name][() if slot is None else slot]
        return np.squeeze(values)

    return read


def channels_of_mdf(path: Path) -> Iterator[Channel]:
    """List the channels of an MDF file with the masters of their groups."""
    asammdf = needed("asammdf", "mdf")
    with asammdf.MDF(path) as file:
        for index, group in enumerate(file.groups):
            label = str(getattr(group.channel_group, "acq_name", "") or f"group {index}")
            size = int(group.channel_group.cycles_nr)
            masters = file.masters_db
            for n, channel in enumerate(group.channels):
                if n == masters.get(index) or size < 2:
                    continue
                signal = file.get(group=index, index=n)
                if signal.samples.dtype.kind not in "fiub" or signal.samples.ndim != 1:
                    continue
                samples, times = signal.samples, np.asarray(signal.timestamps, float)
                yield Channel(
                    label,
                    channel.name,
                    str(signal.unit or ""),
                    len(samples),
                    lambda samples=samples: samples,  # type: ignore[misc]
                    lambda times=times: times,  # type: ignore[misc]
                )


def read_sheet(
    path: Path, units: dict[str, str] | None, skip: int, group: str | None
) -> RecordColumns:
    """Read the sheet of a workbook that has a table of numbers."""
    pandas = needed("pandas", "rigs")
    needed("openpyxl", "rigs")
    sheets = pandas.read_excel(path, sheet_name=None, header=None, engine="openpyxl")
    if group is not None and group not in sheets:
        raise ValueError(f"{path}: has no sheet {group!r}, but {', '.join(map(repr, sheets))}")
    tables: dict[str, RecordColumns] = {}
    problems: list[str] = []
    for name, frame in sheets.items():
        if group not in (None, name):
            continue
        try:
            tables[name] = _table_of_frame(f"{path}, sheet {name}", frame, units, skip)
        except ValueError as error:
            problems.append(str(error))
    if len(tables) == 1:
        return next(iter(tables.values()))
    if tables:
        listed = ", ".join(map(repr, tables))
        raise ValueError(f"{path}: the sheets {listed} have tables: choose with group=")
    raise ValueError(problems[0] if problems else f"{path}: has no sheets")


def _table_of_frame(
    place: str, frame: Any, units: dict[str, str] | None, skip: int
) -> RecordColumns:
    """Make a table of the cells of a sheet."""
    frame = frame.dropna(axis="columns", how="all")
    rows: list[tuple[int, list[str]]] = []
    for n, row in enumerate(frame.itertuples(index=False), 1):
        if n <= skip:
            continue
        texts = ["" if value is None or value != value else _text(value) for value in row]
        rows.append((n, texts if any(texts) else []))
    while rows and not rows[0][1]:
        rows.pop(0)
    if len(rows) < 2:
        raise ValueError(f"{place}: must be a head and rows of numbers")
    return table_from_rows(place, rows, units)


def _text(value: Any) -> str:
    """Return the text of a cell, numbers in full."""
    if isinstance(value, bool):
        return str(value)
    return repr(float(value)) if isinstance(value, (int, float)) else str(value).strip()


READERS = {
    "TDMS": channels_of_tdms,
    "MAT 4": channels_of_mat,
    "MAT 5": channels_of_mat,
    "MAT 7.3": channels_of_hdf5,
    "HDF5": channels_of_hdf5,
    "MDF": channels_of_mdf,
}
