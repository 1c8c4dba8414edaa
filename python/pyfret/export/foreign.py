"""Meshes and results that meshio reads, of the formats that it reads right."""

from __future__ import annotations

import contextlib
import io
import re
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._core import read_bytes, shown
from pyfret._util.extras import needed

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["FORMATS", "is_keyword_file", "read_by_meshio", "read_component_names"]

#: Endings that are read, and what they are.
FORMATS = {
    ".vtk": "VTK",
    ".vtu": "VTK",
    ".msh": "Gmsh",
    ".med": "MED of Salome and code_aster",
    ".xdmf": "XDMF",
    ".bdf": "Nastran",
    ".nas": "Nastran",
    ".fem": "Nastran",
    ".mesh": "Medit",
    ".ply": "PLY",
    ".stl": "STL",
}
#: What meshio passes over in the text of a format: a mark of it, and what it is.
PASSED_OVER = {
    ".bdf": ((b"CORD", "coordinate systems (CORD...)"), (b"INCLUDE", "INCLUDE")),
    ".xdmf": ((b'"Temporal"', "several times"),),
}
PASSED_OVER |= {".nas": PASSED_OVER[".bdf"], ".fem": PASSED_OVER[".bdf"]}


#: Heads of a component's name in XML, and of all names of a field in the older text of VTK.
ATTRIBUTE = re.compile(rb'(\w+)\s*=\s*(?:"([^"]*)"|\'([^\']*)\')')
LEGACY = (
    rb"^%s [^\n]*\n(?:(?!METADATA)[^\n]*\n)*?METADATA\s*\n"
    rb"COMPONENT_NAMES\s*\n((?:(?!INFORMATION)[^\n]+\n)*)"
)


def is_keyword_file(path: Path) -> bool:
    """Check that a mesh is written in keywords of Abaqus, whatever the ending of the file."""
    for line in read_bytes(path)[:65536].splitlines():
        text = line.strip()
        if text and not text.startswith(b"**"):
            return re.match(rb"\*[A-Za-z]", text) is not None
    return False


def check_mesh(mesh: Any) -> None:
    """Refuse places that are not finite, and elements whose nodes the file does not have."""
    points = np.asarray(mesh.points)
    if points.ndim != 2 or not 1 <= points.shape[1] <= 3 or not np.isfinite(points).all():
        raise ValueError("has nodes without a finite place in space")
    for block in mesh.cells:
        data = np.asarray(block.data)
        if data.dtype.kind not in "iu" or data.ndim != 2:
            raise ValueError(f"has elements {block.type!r} of different numbers of nodes")
        if data.size and not 0 <= data.min() <= data.max() < len(points):
            raise ValueError(f"has elements {block.type!r} of nodes that the file does not have")


def read_component_names(path: Path, field: str) -> tuple[str, ...]:
    """Read the names of the components of a field at the nodes; none if the file has none."""
    ending = path.suffix.lower()
    if ending == ".vtu":
        return _names_in_xml(read_bytes(path), field.encode())
    if ending == ".vtk":
        name = re.escape(field.replace(" ", "%20").encode())
        match = re.search(LEGACY % name, read_bytes(path), re.MULTILINE)
        return tuple(match[1].decode("utf-8", "replace").split()) if match else ()
    if ending == ".med":
        h5py = needed("h5py", "mesh")
        with h5py.File(path, "r") as file:
            # A field of several times has its number and time behind its name.
            base = re.sub(r"\[\d+\] - \S+$", "", field)
            raw = file["CHA"][base].attrs.get("NOM", b"") if base in file["CHA"] else b""
        return tuple(raw.decode("latin-1").split())
    return ()


def _names_in_xml(content: bytes, field: bytes) -> tuple[str, ...]:
    """Read ComponentName0, ComponentName1, ... of a field at the nodes."""
    begin, end = content.find(b"<PointData"), content.find(b"</PointData>")
    for tag in re.findall(rb"<DataArray\b[^>]*>", content[max(begin, 0) : end]):
        attributes = {key: first or second for key, first, second in ATTRIBUTE.findall(tag)}
        if attributes.get(b"Name") != field:
            continue
        numbered = [attributes.get(b"ComponentName%d" % n) for n in range(9)]
        return tuple(name.decode("utf-8", "replace") for name in numbered if name)
    return ()


def read_by_meshio(path: Path) -> Any:
    """Read a file by meshio; a ValueError if it has another format or a part is missing."""
    ending = path.suffix.lower()
    if ending not in FORMATS:
        endings = ", ".join(FORMATS)
        raise ValueError(f"{path}: must end in .inp, or in one of {endings}")
    if is_keyword_file(path):
        raise ValueError(f"{path}: holds keywords of Abaqus; name it .inp")
    content = read_bytes(path)
    if ending == ".msh" and not content.lstrip().startswith((b"$", b"(")):
        raise ValueError(f"{path}: is no Gmsh file: must begin with $MeshFormat")
    for mark, part in PASSED_OVER.get(ending, ()):
        lines = (line.lstrip() for line in content.splitlines())
        if any(line.startswith(mark) if mark.isalpha() else mark in line for line in lines):
            raise ValueError(f"{path}: has {part}, which is not read; write the mesh without it")
    meshio = needed("meshio", "mesh")
    nowhere = io.StringIO()
    try:
        with contextlib.redirect_stdout(nowhere), contextlib.redirect_stderr(nowhere):
            mesh = meshio.read(path)
        check_mesh(mesh)
        return mesh
    except (Exception, SystemExit) as error:
        message = " ".join(str(error).split()) or type(error).__name__
        reason = f"is no {FORMATS[ending]} file that can be read" if message == "1" else message
        raise ValueError(shown(f"{path}: {reason}")) from error
