"""Make the files of finite elements: CalculiX 2.20, CalculiX GraphiX 2.17, Gmsh 4.8, VTK 9.7.

``python finite_elements.py FOLDER`` needs the programs ``ccx``, ``cgx`` and ``gmsh``.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from itertools import product
from pathlib import Path

import numpy as np

#: A bar of 2 x 1 x 1 mm of two elements, held at x = 0.
COUNT = (2, 1, 1)
STEEL = "*MATERIAL, NAME=STEEL\n*ELASTIC\n210000, 0.3\n*DENSITY\n7.8e-9\n"
SECTION = "*SOLID SECTION, ELSET=EALL, MATERIAL=STEEL\n*BOUNDARY\nFIX, 1, 3\n"
#: A force of 100 N along x: 100 MPa.
PULL = "*CLOAD\nLOAD, 1, {}\n"
OUTPUT = "*NODE FILE\nU\n*EL FILE\nS\n*EL PRINT, ELSET=EALL\nS\n"
STATIC = f"*STEP\n*STATIC\n{PULL.format(25.0)}{OUTPUT}*END STEP\n"


def bar() -> str:
    """Return nodes, elements and sets of the bar."""
    nodes = {ijk: n for n, ijk in enumerate(product(range(3), range(2), range(2)), 1)}
    text = "*NODE, NSET=NALL\n"
    text += "".join(f"{n}, {float(i)}, {float(j)}, {float(k)}\n" for (i, j, k), n in nodes.items())
    text += "*ELEMENT, TYPE=C3D8I, ELSET=EALL\n"
    for e in range(2):
        face = ((e, 0), (e + 1, 0), (e + 1, 1), (e, 1))
        row = (nodes[i, j, k] for k in range(2) for i, j in face)
        text += f"{e + 1}, " + ", ".join(map(str, row)) + "\n"
    for name, end in (("FIX", 0), ("LOAD", 2)):
        rows = (str(n) for (i, _, _), n in nodes.items() if i == end)
        text += f"*NSET, NSET={name}\n" + ", ".join(rows) + "\n"
    return text


def contact() -> str:
    """Return a job of two cubes that touch, which prints stresses, forces and contact stresses."""
    text, cubes = "*NODE, NSET=NALL\n", []
    for cube in range(2):
        number = {ijk: 8 * cube + n for n, ijk in enumerate(product((0, 1), repeat=3), 1)}
        cubes.append(number)
        text += "".join(f"{n}, {i}.0, {j}.0, {k + cube}.0\n" for (i, j, k), n in number.items())
    face = ((0, 0), (1, 0), (1, 1), (0, 1))
    for cube, number in enumerate(cubes, 1):
        row = ", ".join(str(number[i, j, k]) for k in (0, 1) for i, j in face)
        text += f"*ELEMENT, TYPE=C3D8, ELSET=E{cube}\n{cube}, {row}\n"
    for name, number, k in (("BOTTOM", cubes[0], 0), ("TOP", cubes[1], 1)):
        row = ", ".join(str(number[i, j, k]) for i, j in face)
        text += f"*NSET, NSET={name}\n{row}\n"
    return text + (
        "*ELSET, ELSET=EALL\nE1, E2\n*SURFACE, NAME=S1\n1, S2\n*SURFACE, NAME=S2\n2, S1\n"
        "*SURFACE INTERACTION, NAME=I\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1e7\n"
        "*FRICTION\n0.5, 1e5\n*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE\nS2, S1\n"
        f"{STEEL}*SOLID SECTION, ELSET=EALL, MATERIAL=STEEL\n"
        "*BOUNDARY\nBOTTOM, 1, 3\nTOP, 1, 2\n*STEP, NLGEOM\n*STATIC\n1, 1\n"
        "*BOUNDARY\nTOP, 3, 3, -0.001\nTOP, 1, 1, 0.0001\n"
        "*NODE FILE\nU\n*EL FILE\nS\n*CONTACT FILE\nCDIS, CSTR\n*EL PRINT, ELSET=E1\nS\n"
        "*NODE PRINT, NSET=BOTTOM, TOTALS=YES\nRF\n*CONTACT PRINT\nCDIS, CSTR\n"
        "*CONTACT PRINT, SLAVE=S2, MASTER=S1\nCF\n*END STEP\n"
    )


def jobs() -> dict[str, str]:
    """Return the input of each job of CalculiX by its name."""
    begin = bar() + STEEL + SECTION
    modes = "*STEP\n*FREQUENCY, STORAGE=YES\n2\n*END STEP\n"
    yields = f"{STEEL}*PLASTIC\n300, 0.0\n301, 1.0\n{SECTION}*STEP, NLGEOM, INC=100\n*STATIC\n"
    return {
        "static": begin + STATIC,
        "two_steps": begin + STATIC + STATIC.replace("25.0", "50.0"),
        "modal": f"{begin}{STATIC}*STEP\n*FREQUENCY\n2\n{OUTPUT}*END STEP\n",
        "buckling": f"{begin}*STEP\n*BUCKLE\n2\n{PULL.format(-25.0)}{OUTPUT}*END STEP\n",
        "steady_state": (
            f"{begin}{modes}*STEP\n*STEADY STATE DYNAMICS\n1000, 2000, 2\n"
            "*MODAL DAMPING\n1, 2, 0.01\n"
            f"{PULL.format(25.0)}{OUTPUT}*END STEP\n"
        ),
        "diverged": (
            bar() + yields + "0.25, 1.0, 0.25, 0.25\n" + PULL.format(120.0) + OUTPUT + "*END STEP\n"
        ),
        "contact": contact(),
    }


def run_calculix(folder: Path, work: Path) -> None:
    """Run CalculiX and keep its results."""
    for name, text in jobs().items():
        (work / f"{name}.inp").write_text(text)
        ended = subprocess.run(
            ["ccx", name], cwd=work, capture_output=True, text=True, timeout=60, check=False
        )
        if (name == "diverged") != ("best solution and residuals" in ended.stdout):
            raise RuntimeError(ended.stdout[-2000:])
        for ending in ("frd", "dat"):
            (folder / f"ccx_{name}.{ending}").write_bytes((work / f"{name}.{ending}").read_bytes())
    (folder / "ccx_diverged.sta").write_bytes((work / "diverged.sta").read_bytes())


def run_meshers(folder: Path, work: Path) -> None:
    """Write the mesh of a block by CalculiX GraphiX and by Gmsh in its formats."""
    (work / "mesh.inp").write_text(bar())
    (work / "send.fbd").write_text("read mesh.inp inp\nsend all abq\n")
    subprocess.run(
        ["cgx", "-bg", "send.fbd"], cwd=work, capture_output=True, timeout=60, check=False
    )
    (folder / "cgx_bar.msh").write_bytes((work / "all.msh").read_bytes())
    (work / "box.geo").write_text(
        "Point(1) = {-0.5, -0.5, -1}; "
        "l[] = Extrude {1, 0, 0} { Point{1}; Layers{2}; }; "
        "s[] = Extrude {0, 1, 0} { Line{l[1]}; Layers{2}; Recombine; }; "
        "Extrude {0, 0, 1} { Surface{s[1]}; Layers{1}; Recombine; }\n"
    )
    for name, options in (
        ("gmsh_box_41.msh", ["-format", "msh41"]),
        ("gmsh_box_22.msh", ["-format", "msh22"]),
        ("gmsh_box.inp", ["-format", "inp"]),
        ("gmsh_box.bdf", ["-format", "bdf"]),
        ("gmsh_box.vtk", ["-format", "vtk"]),
        ("gmsh_box.mesh", ["-format", "mesh"]),
    ):
        command = ["gmsh", "-3", "box.geo", *options, "-o", name]
        subprocess.run(command, cwd=work, capture_output=True, timeout=60, check=True)
        (folder / name).write_bytes((work / name).read_bytes())


def write_vtk(folder: Path) -> None:
    """Write a stress with and without names of its components, which VTK orders unlike Abaqus."""
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import VTK_HEXAHEDRON, vtkUnstructuredGrid
    from vtkmodules.vtkIOLegacy import vtkUnstructuredGridWriter
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

    corners = np.array([(i, j, k) for k in (0, 1) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))])
    for name, components in (("named", ("XX", "YY", "ZZ", "XY", "YZ", "ZX")), ("bare", ())):
        grid, points = vtkUnstructuredGrid(), vtkPoints()
        points.SetData(numpy_to_vtk(corners - [0.5, 0.5, 1.0], deep=True))
        grid.SetPoints(points)
        grid.InsertNextCell(VTK_HEXAHEDRON, 8, list(range(8)))
        stress = numpy_to_vtk(np.tile([100.0, 50.0, 20.0, 5.0, 30.0, 10.0], (8, 1)), deep=True)
        stress.SetName("S")
        for n, component in enumerate(components):
            stress.SetComponentName(n, component)
        grid.GetPointData().AddArray(stress)
        for writer, ending in (
            (vtkXMLUnstructuredGridWriter(), "vtu"),
            (vtkUnstructuredGridWriter(), "vtk"),
        ):
            writer.SetFileName(str(folder / f"vtk_{name}.{ending}"))
            writer.SetInputData(grid)
            if ending == "vtu":
                writer.SetDataModeToAscii()
            writer.Write()


if __name__ == "__main__":
    target = Path(sys.argv[1])
    with tempfile.TemporaryDirectory() as scratch:
        run_calculix(target, Path(scratch))
        run_meshers(target, Path(scratch))
    write_vtk(target)
