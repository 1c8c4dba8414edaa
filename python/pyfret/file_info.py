"""Description of a file: its format, what would be read of it, units, axes, size and doubts."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from pyfret import _core
from pyfret._core import StoreError
from pyfret._util.numbers import length
from pyfret._util.toml import read_toml
from pyfret.export.dat import list_prints
from pyfret.export.foreign import FORMATS, is_keyword_file, read_by_meshio, read_component_names
from pyfret.export.frd import list_increments
from pyfret.export.increments import FAILED, mark_failure
from pyfret.export.meshes import read_mesh
from pyfret.fit.recorders import kind_of_recording, read_columns
from pyfret.fit.recordings import Recording
from pyfret.opening import open as open_store
from pyfret.scene.standard_maps import is_sdf, is_x3p
from pyfret.scene.surfaces import HEADS, beginning, is_text, read_map, read_surface

if TYPE_CHECKING:
    import os
    from collections.abc import Sequence

    from pyfret.export.increments import StoredIncrement
    from pyfret.fit.columns import RecordColumns

__all__ = ["FileInfo", "describe_file"]

#: Increments, channels and fields that are listed.
LISTED = 40


@dataclass
class FileInfo:
    """Description of a file.

    Attributes
    ----------
    path, format : str
        The file, and its format with the library that reads it.
    reader : str
        The function that reads it.
    content : dict
        Lines of the description by their titles.
    doubts : list of str
        What was assumed, and what keeps the file from being read as it is.
    """

    path: str
    format: str
    reader: str
    content: dict[str, str] = field(default_factory=dict)
    doubts: list[str] = field(default_factory=list)

    def __str__(self) -> str:
        """Lines for people."""
        rows = {"format": self.format, "read by": self.reader, **self.content}
        width = max(len(title) for title in rows)
        lines = [f"{title:{width}}  {text}" for title, text in rows.items()]
        return "\n".join([self.path, *lines, *(f"doubt: {doubt}" for doubt in self.doubts)])


def describe_file(path: str | os.PathLike[str]) -> FileInfo:
    """Describe a file: a map, a recording, a mesh, results of finite elements, a store of pyfret.

    Raises
    ------
    ValueError, StoreError
        No reader takes the file.
    """
    source = Path(path)
    ending = source.suffix.lower()
    if source.is_dir() or ending == ".zarr":
        return _store(source)
    if ending == ".toml":
        return _document(source)
    start = beginning(source)
    if ending == ".frd":
        return _results(source, "CalculiX FRD", list_increments(source), "block")
    if ending == ".dat" and (prints := list_prints(source)):
        return _results(source, "CalculiX DAT", prints, "set")
    if ending == ".inp" or (ending in FORMATS and not source.name.endswith(".mesh.txt")):
        return _mesh(source)
    if is_sdf(start) or is_x3p(source, start):
        return _map(source, start)
    kind = kind_of_recording(source)
    if kind != "text" or is_text(source, start):
        return _table_or_map(source, start, kind)
    return _map(source, start)


def _store(path: Path) -> FileInfo:
    """Describe a store of pyfret."""
    result = open_store(path)
    lines = {"content": type(result).__name__}
    dataset = getattr(result, "dataset", None)
    if dataset is not None:
        lines["axes"] = ", ".join(f"{name} ({n})" for name, n in dataset.sizes.items())
        lines["size"] = f"{dataset.nbytes / 1e6:.3g} MB"
    return FileInfo(str(path), "store of pyfret", "fret.open", lines)


def _document(path: Path) -> FileInfo:
    """Describe a scene, or a file of `fret study` or `fret compare`."""
    table = read_toml(path)
    for key, command in (("parameters", "study"), ("candidates", "compare")):
        if key in table:
            names = ", ".join(map(str, table[key]))
            return FileInfo(str(path), "TOML", f"fret {command}", {"content": f"{key} {names}"})
    scene = _core.Scene.from_file(path)
    grid = scene.grid
    lines = {"content": "Scene"} | ({"title": scene.title} if scene.title else {})
    lines["grid"] = f"{grid.nx} x {grid.ny} cells of {length(grid.dx)} x {length(grid.dy)}"
    lines["described by"] = "fret check, scene.summary()"
    lines["solved by"] = "fret run, fret.solve(scene)"
    return FileInfo(str(path), "scene of pyfret", "fret.Scene.from_file", lines)


def _results(path: Path, kind: str, increments: Sequence[StoredIncrement], title: str) -> FileInfo:
    """Describe results of finite elements by their increments."""
    increments = mark_failure(increments, path)
    loads = [n for n in increments if n.kind in ("load", FAILED)]
    lines = {"increments": str(len(increments))}
    for n, increment in enumerate(increments[-LISTED:], max(1, len(increments) - LISTED + 1)):
        names = ", ".join(increment.blocks)
        lines[f"  {n}"] = f"step={increment.label!r}: {title} {names}"
    lines["units"] = "the units of the model: Frame(unit=) names m, N, Pa or mm, N, MPa"
    info = FileInfo(str(path), kind, "fret.export.bulk_stress, fret.export.compliance", lines)
    if not loads:
        info.doubts.append("has no increment under load: step= chooses another one")
    elif loads[-1].kind == FAILED:
        info.doubts.append(f"the run did not converge at time {loads[-1].value:g}: give step=")
    else:
        lines["read"] = f"step={loads[-1].label!r}, the last one under load"
        if not loads[-1].blocks.keys() & {"STRESS", "DISP"} and title == "block":
            info.doubts.append("the last increment has neither STRESS nor DISP")
    return info


def _mesh(path: Path) -> FileInfo:
    """Describe a mesh with its fields."""
    mesh = read_mesh(path)
    size = np.ptp(mesh.points, axis=0)
    kinds = [f"{len(rows)} of {rows.shape[1]} nodes" for rows in mesh.volumes]
    kinds += [f"{len(rows)} faces of {rows.shape[1]} nodes" for rows in mesh.faces]
    lines = {
        "nodes": str(len(mesh.points)),
        "elements": ", ".join(kinds) or "none",
        "size": " x ".join(f"{v:g}" for v in size) + " in the unit of the model",
    }
    keywords = path.suffix.lower() == ".inp" or is_keyword_file(path)
    kind = "keywords of Abaqus" if keywords else f"{FORMATS[path.suffix.lower()]}, by meshio"
    info = FileInfo(str(path), kind, "fret.export.loads", lines)
    if not keywords:
        for name, values in list(read_by_meshio(path).point_data.items())[:LISTED]:
            count = values.shape[1] if values.ndim > 1 else 1
            names = read_component_names(path, name)
            lines[f"field {name}"] = f"{count} components: {', '.join(names) or 'without names'}"
            if count == 6 and not names:
                info.doubts.append(f"{name}: the order of its components is not in the file")
            info.reader = "fret.export.loads, fret.export.bulk_stress"
    return info


def _table_or_map(path: Path, start: bytes, kind: str) -> FileInfo:
    """Describe a recording or a table of loops; a map if it is none."""
    is_map_head = HEADS.search(start) is not None
    try:
        if is_map_head or start.startswith(b"\x93NUMPY"):
            raise ValueError("a map")
        columns = read_columns(path)
        shift = columns.column("length", ("delta", "d_", "weg", "x", "shift", "disp"), None)
        force = columns.column("force", ("t", "q", "kraft", "f", "force"), None)
    except (ValueError, ImportError) as reason:
        try:
            return _map(path, start, kind)
        except (ValueError, StoreError) as refusal:
            return _columns(path, kind, reason, refusal)
    lines = _listed(columns)
    lines["read"] = f"shift {columns.names[shift]!r} over force {columns.names[force]!r}"
    info = FileInfo(str(path), kind, "fret.fit.read_loops", lines)
    try:
        shifts, forces = columns.numbers(shift, force)
        lines["points"] = str(len(shifts))
        low, high = length(float(shifts.min())), length(float(shifts.max()))
        lines["range"] = f"shift {low} to {high}, force to {np.abs(forces).max():.4g} N"
    except ValueError as refusal:
        info.doubts.append(str(refusal))
    info.doubts += columns.notes
    return info


def _columns(path: Path, kind: str, reason: Exception, refusal: Exception) -> FileInfo:
    """Describe the columns of a file that is read with arguments only."""
    try:
        columns = read_columns(path)
    except (ValueError, ImportError):
        raise refusal from reason
    doubts = [str(reason).removeprefix(f"{path}: "), str(refusal).removeprefix(f"{path}: ")]
    reader = "fret.fit.read_loops or fret.read_surface, with arguments"
    return FileInfo(str(path), kind, reader, _listed(columns), list(dict.fromkeys(doubts)))


def _listed(columns: RecordColumns) -> dict[str, str]:
    """List the columns of a recording with their units, samples and clocks."""
    lines = {}
    for n, (name, unit) in enumerate(zip(columns.names, columns.units, strict=True)):
        if n == LISTED:
            lines["column ..."] = f"{len(columns.names) - LISTED} more"
            break
        text = f"[{unit}]" if unit else "without a unit"
        if unit and _core.unit_of(unit) is None:
            text += ", not known: read only if it is not needed"
        if isinstance(columns, Recording):
            channel = columns.channels[n]
            clock = f", {channel.even[1]:g} s apart" if channel.even else ""
            text += f", {channel.size} samples{clock}"
        lines[f"column {name}"] = text
    return lines


def _map(path: Path, start: bytes, kind: str = "array") -> FileInfo:
    """Describe a map of heights."""
    info = FileInfo(str(path), "", "fret.read_surface")
    text = is_text(path, start) and not is_sdf(start) and not HEADS.search(start)
    if text:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            try:
                surface = read_surface(path, missing="fill")
            except StoreError as error:
                if "spacing" not in str(error):
                    raise
                reason = str(error).removeprefix(f"{path}: ")
                return FileInfo(str(path), "numbers of a map", info.reader, {}, [reason])
        values, spacing, info.format = surface.values, surface.spacing, "text or NumPy array"
        info.doubts += [str(warning.message) for warning in caught]
    else:
        try:
            reading = read_map(path, start, None, None, None, "center")
        except StoreError as error:
            if not any(f"give {name}" in str(error) for name in ("unit", "spacing")):
                raise StoreError(f"{path}: {error}") from error
            return FileInfo(str(path), f"{kind}, a map", info.reader, {}, [str(error)])
        values, spacing = reading.heights, reading.spacing
        info.format = f"{reading.kind}, by {reading.reader}"
        info.doubts += reading.notes
        if len(reading.channels) > 1:
            info.content["channels"] = ", ".join(map(repr, reading.channels))
    holes = int(np.isnan(values).sum())
    info.content |= {
        "points": " x ".join(map(str, values.shape)) + " along x and y",
        "pitch": " x ".join(length(step) for step in spacing),
        "size": " x ".join(length(n * step) for n, step in zip(values.shape, spacing, strict=True)),
        "S_q": length(float(np.nanstd(values))),
        "S_z": length(float(np.nanmax(values) - np.nanmin(values))),
        "not measured": f"{holes} points" if holes else "no points",
        "unit": "heights in m, out of the surface",
    }
    try:
        _core.check_sides(values.shape, spacing)
    except StoreError as error:
        info.doubts.append(str(error))
    return info
