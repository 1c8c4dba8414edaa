"""Tractions, forces, stresses and loops for other programs, and what comes back from them."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import pyfret as fret
from pyfret import export
from pyfret.export.meshes import faces_in_plane, read_mesh

pytestmark = pytest.mark.solves

W, MU, R = 100.0, 0.3, 5e-3
STEEL = fret.Elastic(E=210e9, nu=0.0)
HERTZ = fret.reference.hertz(R=R, bodies=(STEEL, STEEL), W=W)
#: A contact on the top of a component that lies on its side, in millimetres.
FRAME = export.Frame(origin=(3.0, 20.0, -1.0), x=(0.0, 0.0, 1.0), z=(0.0, -1.0, 0.0), unit="mm")


@pytest.fixture(scope="module")
def result() -> fret.Result:
    scene = fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Sphere(R=R)),
        body2=fret.Body(STEEL),
        friction=MU,
        grid=fret.Grid.centred(width=2.4 * HERTZ.a, n=48),
        path=fret.LoadPath.start()
        .normal(W, increments=1)
        .cycles(1, T_x=0.8 * MU * W, increments=20),
    )
    return fret.solve(scene, save="all", progress=False)


def plane(kind: str, n: int, half: float) -> tuple[np.ndarray, np.ndarray]:
    """Nodes in the contact's plane [m] and faces: n faces a side."""
    twice = np.linspace(-half, half, 2 * n + 1)
    x, y = np.meshgrid(twice, twice, indexing="ij")
    nodes = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], -1)
    number = np.arange(x.size).reshape(x.shape)
    i, j = (v.ravel() for v in np.meshgrid(*[np.arange(0, 2 * n, 2)] * 2, indexing="ij"))

    def force_at(*places: tuple[int, int]) -> np.ndarray:
        return np.stack([number[i + k, j + m] for k, m in places], -1)

    corners = ((0, 0), (2, 0), (2, 2), (0, 2))
    if kind == "quad":
        return nodes, force_at(*corners)
    if kind == "quad8":
        return nodes, force_at(*corners, (1, 0), (2, 1), (1, 2), (0, 1))
    lower, upper = ((0, 0), (2, 0), (2, 2)), ((0, 0), (2, 2), (0, 2))
    if kind == "triangle6":
        lower, upper = (*lower, (1, 0), (2, 1), (1, 1)), (*upper, (1, 1), (1, 2), (0, 1))
    return nodes, np.concatenate([force_at(*lower), force_at(*upper)])


@pytest.mark.parametrize("kind", ["triangle", "triangle6", "quad", "quad8"])
@pytest.mark.parametrize("n", [3, 40])
@pytest.mark.parametrize("body_number", [1, 2])
def test_forces_on_nodes_have_the_force_and_the_moment_of_the_contact(
    result: fret.Result, kind: str, n: int, body_number: int
) -> None:
    state = result.at(3)
    nodes, faces = plane(kind, n, 2.0 * HERTZ.a)
    forces = export.nodal_forces(
        state, FRAME.place(nodes), [faces], frame=FRAME, body_number=body_number
    )
    sign = 1.0 if body_number == 2 else -1.0
    # Along the contact's axes: T_x, nothing, W into body 2.
    own_values = forces @ FRAME.axes.T
    np.testing.assert_allclose(
        own_values.sum(axis=0), [sign * state.T_x, 0.0, sign * W], atol=1e-9 * W
    )
    moment = np.cross(nodes, own_values).sum(axis=0)
    assert np.abs(moment).max() < 1e-9 * W * HERTZ.a


def test_uniform_pressure_on_a_quadratic_face_goes_to_its_nodes_as_the_textbook_says(
    result: fret.Result,
) -> None:
    """-1/12 to each corner, 1/3 between them: O. C. Zienkiewicz, The Finite Element Method."""
    grid, fields = result.scene.grid, result.at(1).dataset
    state = fret.Snapshot(fields.assign(p=0.0 * fields.p + 1e6))
    side = grid.nx * grid.dx
    nodes, faces = plane("quad8", 1, side / 2)
    forces = export.nodal_forces(state, nodes, [faces])[faces[0], 2] / (1e6 * side**2)
    # The middles of 48 cells a side: second order.
    np.testing.assert_allclose(forces[:4], -1.0 / 12.0, rtol=3e-3)
    np.testing.assert_allclose(forces[4:], 1.0 / 3.0, rtol=1e-3)


def test_a_load_beside_the_mesh_is_refused(result: fret.Result) -> None:
    nodes, faces = plane("quad", 4, 0.5 * HERTZ.a)
    with pytest.raises(ValueError, match="lies outside the faces"):
        export.nodal_forces(result.at(3), nodes, [faces])


def test_tables_hold_the_load(result: fret.Result, tmp_path: Path) -> None:
    state, grid = result.at(3), result.scene.grid
    area = grid.dx * grid.dy * 1e6
    result.export(tmp_path / "t.csv", at=3, frame=FRAME)
    table = np.genfromtxt(tmp_path / "t.csv", delimiter=",", names=True)
    total = np.array([table[f"t_{k}_MPa"].sum() for k in (1, 2, 3)]) * area
    np.testing.assert_allclose(FRAME.axes @ total, [float(state.T_x), 0.0, W], atol=1e-6 * W)
    result.export(tmp_path / "a.csv", at=3, frame=FRAME, form="abaqus", of="p")
    cloud = np.loadtxt(tmp_path / "a.csv", delimiter=",")
    np.testing.assert_allclose(cloud[:, 3].sum() * area, W, rtol=1e-6)
    np.testing.assert_allclose(cloud[:, 1], 20.0)
    result.export(tmp_path / "t.tab", at=3, frame=FRAME, form="aster")
    lines = (tmp_path / "t.tab").read_text().splitlines()
    assert lines[0] == "#DEBUT_TABLE"
    assert lines[-1] == "#FIN_TABLE"
    assert len(lines) == len(table) + 5
    with pytest.raises(FileExistsError):
        result.export(tmp_path / "t.csv", at=3)


#: Frames along the axes of a model, in all kinds of turns, and two that lean.
AXES = [
    *((x, z) for x in range(3) for z in range(3) if x != z),
]
LEANING = export.Frame(origin=(3.0, 20.0, -1.0), x=(1.0, 1.0, 0.0), z=(1.0, -1.0, 1.0), unit="mm")


def at_cells(image: object, state: fret.Snapshot, frame: export.Frame) -> None:
    """Compare a file of VTK with the tractions: each cell has the value at its middle."""
    d = state.dataset
    places = frame.contact_place(image.cell_centers().points)  # type: ignore[attr-defined]
    np.testing.assert_allclose(places[:, 2], 0.0, atol=1e-8)
    i = np.rint((places[:, 0] - d.x.values[0]) / (d.x.values[1] - d.x.values[0])).astype(int)
    j = np.rint((places[:, 1] - d.y.values[0]) / (d.y.values[1] - d.y.values[0])).astype(int)
    assert len(set(zip(i.tolist(), j.tolist(), strict=True))) == d.x.size * d.y.size
    for name, factor in (("p", frame.per_pascal), ("q_x", frame.per_pascal), ("stick", 1.0)):
        expected = factor * d[name].values.astype(float)[i, j]
        scale = max(np.abs(expected).max(), 1e-30)
        np.testing.assert_allclose(image[name], expected, atol=1e-6 * scale)  # type: ignore[index]


@pytest.mark.parametrize("signs", [(1, 1), (1, -1), (-1, 1), (-1, -1)])
@pytest.mark.parametrize("axes", AXES)
def test_images_lie_where_the_contact_is(
    result: fret.Result, tmp_path: Path, axes: tuple[int, int], signs: tuple[int, int]
) -> None:
    """Cells, and a contour, which VTK draws without the attribute Direction."""
    pyvista = pytest.importorskip("pyvista")
    state = result.at(3)
    x, z = ((sign * np.eye(3)[axis]).tolist() for axis, sign in zip(axes, signs, strict=True))
    frame = export.Frame(origin=(3.0, 20.0, -1.0), x=tuple(x), z=tuple(z), unit="mm")
    for ending in ("vti", "vts"):
        result.export(tmp_path / f"t.{ending}", at=3, frame=frame)
        image = pyvista.read(str(tmp_path / f"t.{ending}"))
        at_cells(image, state, frame)
        smooth = image.cell_data_to_point_data()
        line = smooth.contour([0.5 * float(image["p"].max())], scalars="p")
        middle = 0.5 * (np.array(line.bounds[::2]) + np.array(line.bounds[1::2]))
        np.testing.assert_allclose(middle, frame.origin, atol=0.02 * 1e3 * HERTZ.a)


def test_a_leaning_frame_takes_a_structured_grid(result: fret.Result, tmp_path: Path) -> None:
    pyvista = pytest.importorskip("pyvista")
    with pytest.raises(ValueError, match=r"must end in \.vts"):
        result.export(tmp_path / "t.vti", at=3, frame=LEANING)
    result.export(tmp_path / "t.vts", at=3, frame=LEANING)
    at_cells(pyvista.read(str(tmp_path / "t.vts")), result.at(3), LEANING)
    assert "Direction" not in (tmp_path / "t.vts").read_text()


def hexahedra(path: Path, *, quadratic: bool) -> None:
    """A block below the contact in the axes of FRAME, nodes numbered from 1001."""
    n, half = 3, 2.0 * HERTZ.a
    steps = np.linspace(-half, half, 2 * n + 1)
    places = np.stack(np.meshgrid(steps, steps, steps + half, indexing="ij"), -1)
    number = np.arange(places[..., 0].size).reshape(places.shape[:3]) + 1001
    with path.open("w") as file:
        file.write("** a block\n*NODE, NSET=ALL\n")
        for k, at in zip(number.ravel(), FRAME.place(places).reshape(-1, 3), strict=True):
            file.write(f"{k}, {at[0]:.15g}, {at[1]:.15g}, {at[2]:.15g}\n")
        file.write("*ELEMENT, TYPE=C3D20, ELSET=E\n" if quadratic else "*Element, type=C3D8\n")
        lower = [(0, 0), (2, 0), (2, 2), (0, 2)]
        between = [(1, 0), (2, 1), (1, 2), (0, 1)]
        use = [(i, j, 0) for i, j in lower] + [(i, j, 2) for i, j in lower]
        if quadratic:
            use += [(i, j, k) for k in (0, 2) for i, j in between] + [(i, j, 1) for i, j in lower]
        for e, (i, j, k) in enumerate(np.ndindex(n, n, n), 1):
            row = [e, *(number[2 * i + a, 2 * j + b, 2 * k + c] for a, b, c in use)]
            text = [str(v) for v in row]
            file.write(
                ", ".join(text[:11]) + (",\n" + ", ".join(text[11:]) if quadratic else "") + "\n"
            )


@pytest.mark.parametrize("quadratic", [False, True])
def test_loads_on_a_mesh_of_volumes(
    result: fret.Result, tmp_path: Path, *, quadratic: bool
) -> None:
    hexahedra(tmp_path / "block.inp", quadratic=quadratic)
    (faces,) = faces_in_plane(read_mesh(tmp_path / "block.inp"), FRAME)
    assert faces.shape == (9, 8 if quadratic else 4)
    result.export(tmp_path / "loads.inp", at=3, frame=FRAME, mesh=tmp_path / "block.inp")
    head, keyword, *rows = (tmp_path / "loads.inp").read_text().splitlines()
    assert head.startswith("**")
    assert keyword == "*CLOAD"
    total = np.zeros(3)
    for row in rows:
        node, axis, force = row.split(",")
        assert int(node) > 1000
        total[int(axis) - 1] += float(force)
    expected = [float(result.at(3).T_x), 0.0, W]
    np.testing.assert_allclose(FRAME.axes @ total, expected, atol=1e-8 * W)


def test_stress_at_points_is_that_below_the_contact(result: fret.Result, tmp_path: Path) -> None:
    state = result.at(3)
    depths = np.array([0.3, 0.6, 1.0]) * HERTZ.a
    points = FRAME.place(np.column_stack([np.zeros(3), np.zeros(3), depths]))
    result.export(tmp_path / "s.csv", at=3, frame=FRAME, points=points)
    table = np.genfromtxt(tmp_path / "s.csv", delimiter=",", names=True)
    below = state.stress(depths, x=0.0, y=0.0)
    # The contact's z is the model's -y, its x the model's z.
    np.testing.assert_allclose(table["s_yy_MPa"], 1e-6 * below.s_zz, rtol=1e-6)
    np.testing.assert_allclose(table["s_zz_MPa"], 1e-6 * below.s_xx, rtol=1e-6)
    with pytest.raises(ValueError, match="outside body 2"):
        export.stress(state, [[3.0, 21.0, -1.0]], frame=FRAME)


def test_a_bulk_stress_comes_back(tmp_path: Path) -> None:
    meshio = pytest.importorskip("meshio")
    rng = np.random.default_rng(5)
    own_values = np.diag([120e6, -30e6, 10e6]) + 5e6 * (np.ones((3, 3)) - np.eye(3))
    model = FRAME.stress(own_values)
    points = FRAME.place(rng.uniform(-1e-3, 1e-3, (30, 3)))
    values = np.tile(model[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]], (30, 1))
    cells = [("vertex", np.arange(30)[:, None])]
    shift = np.tile(FRAME.vector([2e-3, 0.0, 1e-3]), (30, 1))
    meshio.write(
        tmp_path / "c.vtu", meshio.Mesh(points, cells, {"stress": values, "displacement": shift})
    )
    assert export.bulk_stress(tmp_path / "c.vtu", frame=FRAME) == pytest.approx(120e6)
    assert export.compliance(tmp_path / "c.vtu", 50.0, frame=FRAME) == pytest.approx(4e-8)
    frd = ["    1C", "    2C                            30                                     1"]
    frd += [
        f" -1{n + 1:10d}" + "".join(f"{v:12.5E}" for v in at)
        for n, at in enumerate(points.tolist())
    ]
    frd += [" -3", "  100CL  101 1.0          30", " -4  STRESS      6    1", " -5  SXX   1"]
    turned = values[:, [0, 1, 2, 3, 5, 4]]
    frd += [
        f" -1{n + 1:10d}" + "".join(f"{v:12.5E}" for v in s) for n, s in enumerate(turned.tolist())
    ]
    (tmp_path / "c.frd").write_text("\n".join([*frd, " -3", " 9999"]) + "\n")
    assert export.bulk_stress(tmp_path / "c.frd", frame=FRAME) == pytest.approx(120e6, rel=1e-4)
    with pytest.raises(ValueError, match="has no block DISP"):
        export.compliance(tmp_path / "c.frd", 50.0, frame=FRAME)
    rows = [f"  {n + 1} 1 " + " ".join(f"{v:.6E}" for v in values[0]) for n in range(4)]
    head = "\n stresses (elem, integ.pnt.,sxx,syy,szz,sxy,sxz,syz) for set E and time 1.0\n\n"
    (tmp_path / "c.dat").write_text(head + "\n".join(rows) + "\n")
    assert export.bulk_stress(tmp_path / "c.dat", frame=FRAME) == pytest.approx(120e6)


def test_a_hysteresis_read_by_numpy_has_mindlins_energy(
    result: fret.Result, tmp_path: Path
) -> None:
    """Energy of a loop: R. D. Mindlin et al., 1951; exact for nu = 0."""
    law = export.hysteresis(result)
    law.to_dataframe().to_csv(tmp_path / "law.csv")
    table = np.genfromtxt(tmp_path / "law.csv", delimiter=",", names=True)
    q, G_star = 0.8, STEEL.E / 2 / 4
    loop = 1 - (1 - q) ** (5 / 3) - 5 * q / 6 * (1 + (1 - q) ** (2 / 3))
    exact = 9 * (MU * W) ** 2 / (10 * HERTZ.a * G_star) * loop
    assert table["dissipated"][-1] == pytest.approx(exact, rel=1e-3)
    assert table["dissipated"][-1] == pytest.approx(float(result.loops().dissipated[-1]), rel=1e-3)
    assert law.masing_error < 1e-3
    with pytest.raises(ValueError, match="constant normal force"):
        export.hysteresis(result, direction="torsion")


def test_the_command_writes_the_same(result: fret.Result, tmp_path: Path) -> None:
    result.save(tmp_path / "r.zarr")
    out = tmp_path / "t.csv"
    arguments = ["export", str(tmp_path / "r.zarr"), "-o", str(out), "--at", "3", "--unit", "mm"]
    subprocess.run([sys.executable, "-m", "pyfret", *arguments], check=True)
    result.export(tmp_path / "own.csv", at=3, frame=export.Frame(unit="mm"))
    assert out.read_bytes() == (tmp_path / "own.csv").read_bytes()
    ran = subprocess.run(
        [sys.executable, "-m", "pyfret", *arguments[:4], "--origin", "0,0"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert ran.returncode == 2
    assert "three numbers" in ran.stderr
