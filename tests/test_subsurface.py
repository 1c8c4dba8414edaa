"""Stress below the surface, from Python: what a tribologist would doubt."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import pyfret as fret
from conftest import MU, SAME_PROCESS, W, pair, paper_path, sphere_on_flat

pytestmark = pytest.mark.solves

STEEL, _ = pair(0.3)


def hertz_load(n: int) -> tuple[fret.Grid, np.ndarray]:
    """Unit Hertz pressure on r < 1."""
    grid = fret.Grid.centred(width=2.4, n=n)
    x, y = np.meshgrid(grid.x, grid.y, indexing="ij")
    return grid, np.sqrt(np.maximum(1 - x**2 - y**2, 0))


def test_yield_starts_half_a_radius_below_a_pressed_sphere() -> None:
    # K. L. Johnson, Contact Mechanics, sec. 4.5(a): tau_max = 0.31 p0 at 0.48 a for nu = 0.3.
    grid, p = hertz_load(128)
    z = np.linspace(0, 1.5, 61)
    below = fret.subsurface.stress(fret.Body(STEEL), grid, z, p=p, y=0.0)
    assert below.s_xx.dims == ("depth", "x")
    largest = below.maximum("tresca")
    assert largest.value / 2 == pytest.approx(0.310, abs=1e-3)
    assert largest.z == pytest.approx(0.481, abs=3e-3)
    assert largest.x == pytest.approx(0.0, abs=1e-3)
    assert largest.layer == 0


@pytest.mark.parametrize("n", [64, 101])
def test_the_trailing_edge_pulls_as_hamilton_says(n: int) -> None:
    # G. M. Hamilton (1983) at the trailing edge on the surface.
    mu, nu = 0.3, STEEL.nu
    grid, p = hertz_load(n)
    body = fret.Body(STEEL)
    below = fret.subsurface.stress(body, grid, [0.0, 0.5], p=p, q_x=mu * p, y=0.0, rim=True)
    rims = below.rims()
    np.testing.assert_allclose(rims.dataset.x, [-1.0, 1.0], atol=0.1 * grid.dx)
    tension = (1 - 2 * nu) / 3 + np.pi * mu * (4 + nu) / 8
    assert float(rims.s_xx[0]) == pytest.approx(tension, abs=0.01)
    largest = below.maximum("s_xx")
    assert (largest.border, largest.z) == ("rim", 0.0)
    assert largest.value == pytest.approx(tension, abs=max(0.01, largest.error))
    # The parts do not know of one another: the root of the sum of their squares.
    parts = [error for error in largest.errors if error is not None]
    assert largest.error == pytest.approx(np.sqrt(np.nansum(np.square(parts))))
    assert largest.errors.tractions > 0.0
    assert below.stick_borders().s_xx.size == 0
    # Samples beside the rim are right as well.
    x = below.s_xx.x.values
    form = fret.reference.HertzStress(a=1.0, nu=nu)
    exact = np.asarray(form.pressure(x, 0.0, 1e-9)) + mu * np.asarray(form.shear(x, 0.0, 1e-9))
    constant = fret.subsurface.stress(body, grid, [0.0], p=p, q_x=mu * p, y=0.0)
    off = [np.abs(s.s_xx[0].values - exact[0]).max() for s in (constant, below)]
    assert off[1] < 0.015 < 0.02 < off[0]
    with pytest.raises(ValueError, match="stick has the shape"):
        fret.subsurface.stress(body, grid, [0.0], p=p, rim=True, stick=p[:-1] > 0)
    with pytest.raises(ValueError, match="no surface"):
        fret.subsurface.stress(body, grid, [0.5], p=p, y=0.0, rim=True).rims()
    with pytest.raises(ValueError, match="rim=True"):
        constant.rims()


@pytest.mark.parametrize("n", [48, 64, 129, 256])
def test_the_largest_stress_in_partial_slip_is_within_its_error(n: int) -> None:
    # R. D. Mindlin and E. McEwen: p less than mu p on a stick zone, in plane strain.
    force, mu, radius = 1e5, 0.76, 0.01
    load = 0.44 * mu * force
    line = fret.reference.line_contact(R=radius, bodies=(STEEL, STEEL), W=force)
    scene = fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Cylinder(R=radius)),
        body2=fret.Body(STEEL),
        friction=mu,
        grid=fret.Grid.strip(extent=2.3 * line.a, n=n),
    )
    path = fret.LoadPath.start().normal(force, increments=1).tangential([load], increments=4)
    result = fret.solve(scene, path, error=True, progress=False)
    bars = result.error_bars().isel(branch=-1).sel(part="total")
    below = result.at(-1).stress(y=0.0)

    x = np.linspace(-1.05, 1.05, 2101) * line.a
    z = np.concatenate([[0.0], np.geomspace(1e-3, 2.0, 300)]) * line.a
    s_xx, s_zz, s_xz = np.swapaxes([line.stress(x, at, T=load, mu=mu) for at in z], 0, 1)
    s_yy = STEEL.nu * (s_xx + s_zz)
    deviator = (s_xx - s_yy) ** 2 + (s_yy - s_zz) ** 2 + (s_zz - s_xx) ** 2
    plane = np.hypot((s_xx - s_zz) / 2, s_xz)
    exact = {
        "von_mises": np.sqrt(deviator / 2 + 3 * s_xz**2),
        "s_1": np.maximum((s_xx + s_zz) / 2 + plane, s_yy),
        "s_xx": s_xx,
    }
    for entry, field in exact.items():
        extremum, right = below.maximum(entry), field.max()
        assert extremum.errors.solution == pytest.approx(float(bars.stress) * abs(extremum.value))
        assert abs(extremum.value - right) <= extremum.error
        assert abs(extremum.value - right) <= (0.01 if n >= 64 else 0.02) * line.p0
    if n >= 64:
        largest = below.maximum()
        assert largest.error < 0.05 * largest.value


def test_the_largest_stress_of_a_layer(coated: fret.Result) -> None:
    below = coated.at(-1).stress()
    largest = [below.maximum("s_1", layer=layer) for layer in (0, 1)]
    assert [m.layer for m in largest] == [0, 1]
    assert below.maximum("s_1") == max(largest)
    with pytest.raises(ValueError, match="layer = 2: must be one of"):
        below.maximum("s_1", layer=2)


def test_sections_lines_and_planes_agree(coated: fret.Result) -> None:
    snapshot = coated.at(-1)
    z = [0.0, 0.3 * coated.a_H, coated.a_H]
    planes = snapshot.stress(z).dataset
    assert dict(planes.sizes) == {"depth": 4, "x": 32, "y": 32}
    assert planes.layer.values.tolist() == [0, 0, 0, 1]
    x, y = float(planes.x[20]), float(planes.y[5])
    along_x, along_y = snapshot.stress(z, y=y).dataset, snapshot.stress(z, x=x).dataset
    line = snapshot.stress(z, x=x, y=y).dataset
    scale = 1e-9 * coated.p_H
    for name in planes:
        plane = planes[name]
        np.testing.assert_allclose(along_x[name], plane[:, :, 5], atol=scale)
        np.testing.assert_allclose(along_y[name], plane[:, 20, :], atol=scale)
        # A single point cuts the cells around it more finely than points that share the parts.
        np.testing.assert_allclose(line[name], plane[:, 20, 5], atol=1e-3 * coated.p_H)
        np.testing.assert_allclose(line[name][1:], plane[1:, 20, 5], atol=1e-5 * coated.p_H)
    # On the surface they are the tractions, at the rim those that are continued to it.
    inside = snapshot.contact.rolling(x=3, y=3, center=True).min().fillna(0) > 0
    # Beside a cell whose middle lies outside the rim they match a grid five times as fine,
    # which the cell's own pressure is not; elsewhere linear between the middles, with the load of
    # the cells: off by half the bend over one.
    fine = sphere_on_flat(ratio=2.0, n=160)
    ends = fret.solve(fine, paper_path(), save="branches", progress=False)
    p = ends.at(-1).p[2::5, 2::5].values
    bend = coated.p_H * (coated.scene.grid.dx / coated.a_H) ** 2
    off, of_cells = np.abs(planes.s_zz[0] + p), np.abs(snapshot.p - p)
    assert (off.where(inside, 0.0) <= of_cells + 0.6 * bend).all()
    assert np.sqrt((off.where(inside) ** 2).mean()) < 0.4 * bend
    assert np.abs(planes.s_xz[0] + snapshot.q_x).max() < 0.05 * coated.p_H
    np.testing.assert_allclose(planes.s_zz[2], planes.s_zz[3], atol=scale)
    assert abs(planes.s_xx[2] - planes.s_xx[3]).max() > 0.1 * coated.p_H


def test_relative_displacement_is_that_of_the_two_surfaces(coated: fret.Result) -> None:
    snapshot = coated.at(-1)
    below, above = (snapshot.displacement(0.0, body_number=b) for b in (2, 1))
    # To the tolerance of the kernels.
    for axis in "xyz":
        difference = (below - above)[f"u_{axis}"].isel(depth=0)
        expected = snapshot.dataset[f"u_{axis}"]
        np.testing.assert_allclose(difference, expected, atol=1e-7 * abs(expected).max())


def test_principal_stresses_and_the_rest_follow_from_the_components(coated: fret.Result) -> None:
    below = coated.at(-1).stress(np.linspace(0, 2 * coated.a_H, 7), y=0.0)
    principal = below.principal()
    first, second, third = (principal.value.isel(principal=i) for i in range(3))
    np.testing.assert_allclose(below.s_1, first)
    np.testing.assert_allclose(below.tresca, first - third)
    np.testing.assert_allclose(below.hydrostatic, (first + second + third) / 3, atol=1.0)
    direction = principal.direction.isel(principal=0)
    np.testing.assert_allclose((direction**2).sum("axis"), 1.0)
    with pytest.raises(AttributeError, match="von_mises"):
        _ = below.mises


def test_volumes_open_in_vtk_and_xarray(coated: fret.Result, tmp_path: Path) -> None:
    import pyvista
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLImageDataReader

    snapshot = coated.at(-1)
    z = np.linspace(0, 2 * coated.a_H, 9)
    item = ("von_mises", "u_z", "s_xz", "u_x")
    snapshot.write_volume(tmp_path / "stress.vti", z, of=item)
    snapshot.write_volume(tmp_path / "stress.zarr", z, of=item)
    reader = vtkXMLImageDataReader()
    reader.SetFileName(str(tmp_path / "stress.vti"))
    reader.Update()
    image = reader.GetOutput()
    assert image.GetDimensions() == (32, 32, 9)
    np.testing.assert_allclose(image.GetSpacing()[2], z[1])
    np.testing.assert_allclose(image.GetOrigin()[:2], (snapshot.x[0], snapshot.y[0]))
    stored = xr.open_zarr(tmp_path / "stress.zarr", chunks=None)
    assert stored.von_mises.dims == ("depth", "x", "y")
    planes = snapshot.stress(z)
    # PyVista is how most people open it.
    assert pyvista.read(tmp_path / "stress.vti").dimensions == (32, 32, 9)
    # The depth in the middle is the interface: the volume shows the layer above.
    keep = np.flatnonzero(np.diff(planes.dataset.z.values, prepend=-1.0))
    for name in ("von_mises", "s_xz"):
        values = planes.measure(name).values[keep]
        np.testing.assert_allclose(stored[name], values, atol=1e-9 * coated.p_H)
        drawn = vtk_to_numpy(image.GetPointData().GetArray(name)).reshape(9, 32, 32)
        np.testing.assert_allclose(drawn, values.transpose(0, 2, 1), rtol=1e-6, atol=1.0)
    u = snapshot.displacement(z)
    for name in ("u_x", "u_z"):
        assert stored[name].attrs["units"] == "m"
        np.testing.assert_allclose(stored[name], u[name].values[keep], rtol=1e-9, atol=1e-18)
        drawn = vtk_to_numpy(image.GetPointData().GetArray(name)).reshape(9, 32, 32)
        np.testing.assert_allclose(drawn.transpose(0, 2, 1), stored[name], rtol=1e-6)
    with pytest.raises(ValueError, match="one of s_xx"):
        snapshot.write_volume(tmp_path / "other.vti", z, of=("mises",))
    with pytest.raises(fret.errors.StoreError, match="exists"):
        snapshot.write_volume(tmp_path / "stress.vti", z)


def test_the_envelope_streams(tmp_path: Path) -> None:
    path = paper_path(indentation=4, cycles=9)
    scene = sphere_on_flat(ratio=2.0, n=16).replace(path=path)
    z = np.array([0.1, 0.5, 1.2]) * scene.hertz.a
    streamed = fret.subsurface.envelope(scene, fret.march(scene), z, y=0.0, of=("s_xx",))
    result = fret.solve(scene, save="all", progress=False)
    xr.testing.assert_allclose(streamed, result.envelope(z, y=0.0, of=("s_xx",)))
    every = np.stack([result.at(n).stress(z, y=0.0).s_xx.values for n in range(1, len(path) + 1)])
    np.testing.assert_allclose(streamed.s_xx_max, every.max(axis=0))
    np.testing.assert_array_equal(streamed.s_xx_increment, every.argmax(axis=0) + 1)
    assert list(zip(streamed.first_branch.values, streamed.last_branch.values, strict=True)) == [
        (2, 3),
        (4, 5),
    ]
    branch = result.dataset.branch_of_increment.values
    last = every[(branch >= 4)]
    amplitude = (last.max(axis=0) - last.min(axis=0)) / 2
    np.testing.assert_allclose(streamed.s_xx_amplitude.isel(cycle=1), amplitude)
    with warnings.catch_warnings():
        # The depths leave the interface out.
        warnings.simplefilter("ignore", fret.errors.SceneWarning)
        largest = [result.at(n).stress(z, y=0.0).maximum("s_xx") for n in range(1, len(path) + 1)]
    # Between samples a parabola stands for the stress; at borders both are evaluated.
    value = np.array([m.value for m in largest])
    off = np.abs(streamed.s_xx_largest.values - value)
    error = 1.5 * streamed.s_xx_largest_error.values + 1e-3 * np.abs(value)
    # The section of an envelope ends with the grid, beyond which `maximum` goes on.
    inside = np.abs([m.x for m in largest]) <= float(streamed.x[-1]) + 0.5 * scene.grid.dx
    assert (off <= error)[inside].all()
    assert (streamed.s_xx_largest.values <= value + error).all()
    assert inside.any()
    layers = np.array([m.layer for m in largest])
    np.testing.assert_array_equal(streamed.s_xx_largest_layer.values[inside], layers[inside])
    planes = result.envelope(z[:1], of=("s_xx",))
    assert planes.s_xx_max.dims == ("depth", "x", "y")
    across = result.envelope(z[:1], y=float(planes.y[5]), of=("s_xx",))
    np.testing.assert_allclose(planes.s_xx_max[..., 5], across.s_xx_max, rtol=1e-9)


def test_the_bulk_stress_is_part_of_the_stress(tmp_path: Path) -> None:
    ratio, lower, upper = 2.0, 3e8, -1e8
    scene = sphere_on_flat(ratio=ratio, n=16)
    path = (
        fret.LoadPath.start()
        .normal(W, increments=2)
        .force(T_x=0.4 * MU * W, sigma_B=lower, sigma_B1=upper, increments=2)
    )
    snapshot = fret.solve(scene, path, progress=False).at(-1)
    assert (float(snapshot.sigma_B), float(snapshot.sigma_B1)) == (lower, upper)
    far = snapshot.stress([100 * snapshot.a_H], x=0.0, y=0.0).dataset
    assert float(far.s_xx[0]) == pytest.approx(lower, rel=1e-3)
    # Equal nu: the coating takes `ratio` times as much, along x alone.
    z = [0.0, 0.5 * snapshot.a_H]
    for body_number, bulk in ((1, upper), (2, ratio * lower)):
        pulled = snapshot.stress(z, y=0.0, body_number=body_number)
        bare = snapshot.stress(z, y=0.0, body_number=body_number, bulk=False)
        np.testing.assert_allclose(pulled.s_xx - bare.s_xx, bulk, rtol=1e-6)
        np.testing.assert_allclose(pulled.s_yy, bare.s_yy, atol=1.0)
        np.testing.assert_allclose(pulled.s_zz, bare.s_zz)
    planes = snapshot.stress(z)
    np.testing.assert_allclose(
        planes.s_xx - snapshot.stress(z, bulk=False).s_xx, ratio * lower, rtol=1e-6
    )
    snapshot.write_volume(tmp_path / "pulled.zarr", z, of=("s_xx",))
    stored = xr.open_zarr(tmp_path / "pulled.zarr", chunks=None)
    np.testing.assert_allclose(stored.s_xx, planes.s_xx)
    over_path = fret.subsurface.envelope(
        scene.replace(path=path), fret.march(scene, path), z, y=0.0, of=("s_xx",)
    )
    last = snapshot.stress(z, y=0.0).s_xx
    assert float((over_path.s_xx_max - last).min()) >= -1.0
    np.testing.assert_allclose(over_path.s_xx_max.where(over_path.s_xx_increment == 4, last), last)


def test_loops_of_similar_bodies_are_mindlins() -> None:
    bodies = pair(0.0)
    scene = sphere_on_flat(nu=0.0, n=64)
    T = 0.5 * MU * W
    path = fret.LoadPath.start().normal(W, increments=1).tangential([T, -T, T], increments=125)
    cycle = fret.solve(scene, path, progress=False).loops().isel(cycle=0)
    closed = fret.reference.CattaneoMindlin(scene_hertz(bodies), bodies=bodies, mu=MU)
    assert float(cycle.energy_ratio) == pytest.approx(closed.energy_ratio(T), rel=0.05)
    assert float(cycle.dissipated) == pytest.approx(closed.loop_energy(T), rel=0.05)


def scene_hertz(bodies: tuple[fret.Elastic, fret.Elastic]) -> fret.Hertz:
    """Hertz contact of the scenes here."""
    return fret.reference.hertz(R=0.018, bodies=bodies, W=W)


def test_loops_of_torsion_and_of_given_shifts() -> None:
    scene = sphere_on_flat(n=24)
    start = fret.LoadPath.start().normal(W, increments=4)
    M = 0.5 * 3 * np.pi / 16 * MU * W * scene_hertz(pair(0.3)).a
    torsion = fret.solve(scene, start.torsion([M, -M, M], increments=20), progress=False)
    loop = torsion.loops(direction="torsion").isel(cycle=0)
    assert float(loop["T"]) == pytest.approx(M)
    assert loop.stiffness.attrs["units"] == "N m/rad"
    assert 0 < float(loop.energy_ratio) < 0.2
    assert float(loop.dissipated) == pytest.approx(
        np.abs(np.trapezoid(torsion.dataset.M_z[-17:], torsion.dataset.phi_z[-17:])), rel=0.05
    )
    # Between shifts ten times as large as what slides, the loop is nearly a rectangle.
    for turn in (4e-5, -4e-5, 4e-5):
        start = start.displace(delta_x=turn, increments=25)
    slid = fret.solve(scene, start, progress=False).loops().isel(cycle=-1)
    assert slid.first_branch == 2
    assert float(slid["T"]) == pytest.approx(MU * W, rel=1e-6)
    assert slid.status == 3
    assert 0.8 < float(slid.energy_ratio) < 1.0
    assert 0.8 < float(slid.sliding_ratio) < 1.0


def test_the_running_map_slides_above_the_friction_limit() -> None:
    table = fret.study.running_conditions(
        sphere_on_flat(n=24),
        W=[500.0, W],
        T=[30.0, 120.0, 240.0],
        increments=(4, 8),
        executor=SAME_PROCESS,
    )
    assert table.status.values.tolist() == [[2, 2, 3], [2, 2, 2]]
    ratio = table.energy_ratio.values
    assert np.isnan(ratio[0, 2])
    assert ratio[1, 0] < ratio[1, 1] < ratio[1, 2] < 0.2
    assert ratio[0, 1] > ratio[1, 1]
    assert fret.plot.running_map(table).get_ylabel() == "$T$ [N]"
    with pytest.raises(ValueError, match="one of them"):
        fret.study.running_conditions(sphere_on_flat(n=24), W=W)


def test_the_running_map_of_shifts_parts_partial_from_gross_slip() -> None:
    uncoated = fret.reference.CattaneoMindlin(scene_hertz(pair(0.3)), bodies=pair(0.3), mu=MU)
    shifts = np.array([0.5, 3.0]) * uncoated.shift_limit
    table = fret.study.running_conditions(
        sphere_on_flat(n=24), W=[500.0, W], delta=shifts, increments=(4, 12), executor=SAME_PROCESS
    )
    assert table.status.values.tolist() == [[2, 3], [2, 3]]
    assert (table.energy_ratio[:, 0] < 0.2).all()
    assert (table.energy_ratio[:, 1] > 0.2).all()
    np.testing.assert_allclose(table["T"][:, 1], MU * table.W, rtol=1e-6)
    assert fret.plot.running_map(table).get_ylabel().startswith(r"$\delta$")


def maps_of(figure: Figure) -> list[Axes]:
    """The axes of a figure, its colour scales aside."""
    return [ax for ax in figure.axes if ax.get_label() != "<colorbar>"]


def test_figures_of_stress(coated: fret.Result) -> None:
    z = np.union1d(np.linspace(0, 2 * coated.a_H, 33), [coated.a_H])
    snapshot = coated.at(-1)
    yard = {"a_H": coated.a_H, "p_H": coated.p_H}
    ax = fret.plot.stress_map(snapshot.stress(z, y=0.0), **yard)
    assert ax.get_ylim() == (2.0, 0.0)
    (cross,) = (line for line in ax.lines if line.get_marker() == "x")
    assert 0 <= cross.get_ydata()[0] <= 1.0
    line = fret.plot.stress_along_depth(snapshot.stress(z, x=0.0, y=0.0), **yard)
    assert all(np.isfinite(curve.get_ydata()).all() for curve in line.lines[:4])
    assert len(maps_of(fret.plot.stress_maps({2.0: coated}, layers=17))) == 1
    maps = fret.plot.envelope_maps(coated.envelope(z, y=0.0), **yard)
    assert len(maps_of(maps)) == 3
    history = fret.plot.stress_history(coated.envelope(z, y=0.0), **yard)
    assert history.lines[0].get_xdata().size == coated.dataset.sizes["saved"]
    assert len(fret.plot.loop_evolution(coated).lines) == 3
