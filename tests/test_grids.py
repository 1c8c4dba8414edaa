"""Grids for contacts that are no balls."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

import pyfret as fret
from pyfret import shapes

STEEL = fret.Elastic(E=210e9, nu=0.3)
FLAT = fret.Body(STEEL)


def p_max(
    body: fret.Body, lower: fret.Body, path: fret.LoadPath, grid: fret.Grid
) -> tuple[float, float]:
    """Area and largest pressure on a grid."""
    scene = fret.Scene(body1=body, body2=lower, friction=0.0, grid=grid, path=path)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        at = fret.solve(scene, progress=False).at(-1)
    return float(at.contact_area), float(at.p_max)


@pytest.mark.solves
@pytest.mark.parametrize("length", [0.5e-3, 2e-3])
def test_a_roller_with_ends_has_a_grid_of_its_length(length: float) -> None:
    path = fret.LoadPath.start().normal(100.0, increments=1)
    # Half width of a line contact, Johnson (4.43); a grid is 1.2 times as wide, to a cell or so.
    E_star = STEEL.E / (2.0 * (1.0 - STEEL.nu**2))
    half_width = np.sqrt(4.0 * (100.0 / length) * 0.01 / (np.pi * E_star))
    for angle in (0.0, np.pi / 2):
        roller = fret.Body(STEEL, shape=shapes.Cylinder(R=0.01, length=length, angle=angle))
        with warnings.catch_warnings():
            # The pressure at its ends grows with the cells.
            warnings.simplefilter("ignore", fret.errors.SceneWarning)
            grid = fret.Grid.for_contact(roller, FLAT, path, error=0.1)
        sides = sorted((grid.nx * grid.dx, grid.ny * grid.dy))
        assert 1.1 * length < sides[1] < 1.4 * length
        assert sides[0] == pytest.approx(2.4 * half_width, rel=0.2)
        assert min(grid.nx, grid.ny) >= 24


def test_a_punch_with_round_edges_is_refined_until_its_pressure_is_known() -> None:
    punch = fret.Body(STEEL, shape=shapes.FlatPunch(radius=2e-3, edge=3e-3))
    path = fret.LoadPath.start().normal(3e5, increments=1)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        grid = fret.Grid.for_contact(punch, FLAT, path, error=0.02, plane_strain=True)
    computed = p_max(punch, FLAT, path, grid)
    finest = p_max(punch, FLAT, path, fret.Grid.strip(extent=grid.nx * grid.dx, n=2048))
    assert computed == pytest.approx(finest, rel=0.03)


@pytest.mark.solves
def test_cells_resolve_the_waves_of_a_measured_surface() -> None:
    n, spacing, wave = 120, 2e-6, 20e-6
    x = spacing * np.arange(n)
    heights = 5e-8 * np.cos(2 * np.pi * x / wave)[:, None] * np.cos(2 * np.pi * x / wave)[None, :]
    ball = fret.Body(STEEL, shape=fret.Sphere(R=2e-3))
    rough = fret.Body(STEEL, shape=shapes.SurfaceMap(heights, spacing=spacing))
    path = fret.LoadPath.start().normal(2.0, increments=1)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        grid = fret.Grid.for_contact(ball, rough, path, error=0.02)
    # The waves along the diagonals are shorter by the root of two.
    assert grid.dx <= wave / np.sqrt(2) / 7.0
    side = grid.nx * grid.dx
    computed = p_max(ball, rough, path, grid)
    finest = p_max(ball, rough, path, fret.Grid.centred(width=side, n=2 * grid.nx))
    assert caught or computed == pytest.approx(finest, rel=0.03)


def test_a_coating_thinner_than_a_cell_is_told() -> None:
    ball = fret.Body(STEEL, shape=fret.Sphere(R=5e-3))
    film = fret.Body(STEEL, coatings=[fret.Coating(fret.Elastic(E=400e9, nu=0.2), thickness=1e-7)])
    path = fret.LoadPath.start().normal(10.0, increments=1)
    with pytest.warns(fret.errors.SceneWarning, match="thick"):
        fret.Grid.for_contact(ball, film, path, error=0.02)


@pytest.mark.solves
@pytest.mark.parametrize("of", ["p_max", "s_xx", "loop"])
def test_a_grid_for_a_number_keeps_its_error(of: str) -> None:
    """The number on the grid is that on twice as many cells again, to the error asked for."""
    ball, load, mu, error = fret.Body(STEEL, shape=fret.Sphere(R=0.01)), 20.0, 0.4, 0.03
    path = fret.LoadPath.start().normal(load, increments=2)
    for T in (0.6, -0.6, 0.6):
        path = path.force(T_x=T * mu * load, increments=4)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        grid = fret.Grid.for_contact(ball, FLAT, path, error=error, mu=mu, of=of)
    side = grid.nx * grid.dx

    def number(n: int) -> float:
        grid = fret.Grid.centred(width=side, n=n)
        scene = fret.Scene(body1=ball, body2=FLAT, friction=mu, grid=grid, path=path)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            result = fret.solve(scene, progress=False)
            if of == "p_max":
                return float(result.at(-1).p_max)
            if of == "s_xx":
                return result.at(-1).stress().maximum("s_xx").value
        return float(result.dissipated.sum())

    assert number(grid.nx) == pytest.approx(number(2 * grid.nx), rel=error)


def test_a_grid_for_a_number_needs_friction_and_a_name() -> None:
    path = fret.LoadPath.start().normal(20.0, increments=1)
    ball = fret.Body(STEEL, shape=fret.Sphere(R=0.01))
    with pytest.raises(ValueError, match="mu: must be given with of = 'loop'"):
        fret.Grid.for_contact(ball, FLAT, path, of="loop")
    with pytest.raises(ValueError, match="of = 's_yy': must be one of p, p_max, s_xx, loop"):
        fret.Grid.for_contact(ball, FLAT, path, of="s_yy")  # type: ignore[arg-type]


@pytest.mark.solves
def test_a_grid_holds_a_contact_that_moments_move() -> None:
    ball = fret.Body(STEEL, shape=fret.Sphere(R=0.01))
    plain = fret.LoadPath.start().normal(20.0, increments=1)
    a = fret.reference.hertz(R=0.01, bodies=(STEEL, STEEL), W=20.0).a
    # M/W = a moves the contact by its radius.
    path = plain.force(M_y=20.0 * a, increments=1)
    grid = fret.Grid.for_contact(ball, FLAT, path, error=0.05)
    assert grid.nx * grid.dx > 1.5 * 1.2 * 2 * a
    assert p_max(ball, FLAT, path, grid)[0] == pytest.approx(np.pi * a**2, rel=0.03)


def measured() -> shapes.SurfaceMap:
    """A map of eight random waves along both axes."""
    random, x = np.random.default_rng(5), 2e-6 * np.arange(100)
    heights = np.zeros((100, 100))
    for k in range(1, 9):
        along, across = (
            np.cos(2 * np.pi * k * x / 2e-4 + random.uniform(0.0, 6.0)) for _ in range(2)
        )
        heights += 4e-8 / k**1.5 * along[:, None] * across[None, :]
    return shapes.SurfaceMap(heights, spacing=2e-6)


#: Upper and lower surface, load [N or N/m], whether it is a line contact.
SURFACES = {
    "ball": (fret.Sphere(R=0.01), shapes.Flat(), 20.0, False),
    "ellipsoid": (shapes.Ellipsoid(R_x=0.03, R_y=0.005), shapes.Flat(), 50.0, False),
    "short roller": (shapes.Cylinder(R=0.01, length=1e-3), shapes.Flat(), 100.0, False),
    "long roller": (shapes.Cylinder(R=0.005, length=8e-3), shapes.Flat(), 300.0, False),
    "crowned roller": (
        shapes.CrownedRoller(R=5e-3, length=1e-3, crown=0.5),
        shapes.Flat(),
        80.0,
        False,
    ),
    "rounded punch": (shapes.FlatPunch(radius=5e-4, edge=1e-3), shapes.Flat(), 100.0, False),
    "rounded strip": (shapes.FlatPunch(radius=2e-3, edge=3e-3), shapes.Flat(), 3e5, True),
    "wedge": (shapes.Wedge(slope=1e-3), shapes.Flat(), 1e4, True),
    "waves": (
        fret.Sphere(R=5e-3),
        shapes.Waviness(amplitude=2e-8, wavelength=3e-5),
        5.0,
        False,
    ),
    "map": (fret.Sphere(R=5e-3), measured(), 2.0, False),
}


@pytest.mark.solves
@pytest.mark.parametrize("name", SURFACES)
def test_a_grid_gives_the_numbers_of_the_finest_or_is_doubted(name: str) -> None:
    upper, lower, load, strip = SURFACES[name]
    bodies = fret.Body(STEEL, shape=upper), fret.Body(STEEL, shape=lower)
    path = fret.LoadPath.start().normal(load, increments=1)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        grid = fret.Grid.for_contact(*bodies, path, error=0.02, plane_strain=strip)
    computed = p_max(*bodies, path, grid)
    finer = 8
    while grid.nx * finer * (1 if strip else grid.ny * finer) > (4096 if strip else 7e5):
        finer //= 2
    if strip:
        finest = fret.Grid.strip(extent=grid.nx * grid.dx, n=finer * grid.nx)
    else:
        cells = (finer * grid.nx, finer * grid.ny)
        finest = fret.Grid.from_spacing(cells, (grid.dx / finer, grid.dy / finer))
    right = p_max(*bodies, path, finest)
    assert caught or (finer > 1 and computed == pytest.approx(right, rel=0.03))
    # An edge without a radius has no largest pressure.
    assert bool(caught) == (name in ("short roller", "long roller", "wedge"))


@pytest.mark.parametrize("plane_strain", [False, True], ids=["roller", "strip"])
def test_the_number_of_cells_may_be_given(*, plane_strain: bool) -> None:
    """They are square; the sides are those that are found for the contact."""
    path = fret.LoadPath.start().normal(100.0, increments=1)
    length = np.inf if plane_strain else 0.5e-3
    roller = fret.Body(STEEL, shape=shapes.Cylinder(R=0.01, length=length))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", fret.errors.SceneWarning)
        computed = fret.Grid.for_contact(roller, FLAT, path, error=0.1, plane_strain=plane_strain)
    grid = fret.Grid.for_contact(roller, FLAT, path, n=48, plane_strain=plane_strain)
    if plane_strain:
        assert grid == fret.Grid.strip(extent=computed.nx * computed.dx, n=48)
        return
    assert min(grid.nx, grid.ny) == 48
    assert grid.dx == grid.dy
    for n, d, there, cell in (
        (grid.nx, grid.dx, computed.nx, computed.dx),
        (grid.ny, grid.dy, computed.ny, computed.dy),
    ):
        assert there * cell <= n * d * (1.0 + 1e-9) < there * cell + 1.001 * d
    with pytest.raises(ValueError, match="n = 0: must be 2 to"):
        fret.Grid.for_contact(roller, FLAT, path, n=0)
    with pytest.raises(ValueError, match="cells along the longer side: at most"):
        fret.Grid.for_contact(roller, FLAT, path, n=4000)
