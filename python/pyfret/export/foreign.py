"""Meshes and results that meshio reads, of the formats that it reads right."""

from __future__ import annotations

import contextlib
import io
from typing import TYPE_CHECKING, Any

from pyfret._core import read_bytes, shown
from pyfret._util.extras import needed

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["FORMATS", "read_by_meshio"]

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


def read_by_meshio(path: Path) -> Any:
    """What meshio reads of a file; a ValueError if that is of another format, or misses a part."""
    ending = path.suffix.lower()
    if ending not in FORMATS:
        known = ", ".join(FORMATS)
        raise ValueError(f"{path}: must end in .inp, or in one of {known}")
    content = read_bytes(path)
    for mark, what in PASSED_OVER.get(ending, ()):
        lines = (line.lstrip() for line in content.splitlines())
        if any(line.startswith(mark) if mark.isalpha() else mark in line for line in lines):
            raise ValueError(f"{path}: has {what}, which is not read; write the mesh without it")
    meshio = needed("meshio", "mesh")
    nowhere = io.StringIO()
    try:
        with contextlib.redirect_stdout(nowhere), contextlib.redirect_stderr(nowhere):
            return meshio.read(path)
    except (Exception, SystemExit) as error:
        said = " ".join(str(error).split()) or type(error).__name__
        reason = f"is no {FORMATS[ending]} file that can be read" if said == "1" else said
        raise ValueError(shown(f"{path}: {reason}")) from error
