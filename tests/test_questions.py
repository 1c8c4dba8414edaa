"""Numbers that people ask for: the grid, the stick zone, the regime, materials, tables."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

import pyfret as fret
from conftest import SAME_PROCESS

pytestmark = pytest.mark.solves

STEEL = fret.Elastic(E=210e9, nu=0.3)
R, W = 5e-3, 10.0
HERTZ = fret.reference.hertz(R=R, bodies=(STEEL, STEEL), W=W)
BALL, FLAT = fret.Body(STEEL, shape=fret.Sphere(R=R)), fret.Body(STEEL)
PATH = fret.LoadPath.start().normal(W).cycles(1, T_x=1.0, increments=4)
LAW = fret.wear.Archard(k=1e-15)


def of_pressure(grid: fret.Grid) -> float:
    """Error of the pressure of the ball, root mean square over Hertz's."""
    scene = fret.Scene(body1=BALL, body2=FLAT, friction=0.0, grid=grid)
    path = fret.LoadPath.start().normal(W, increments=1)
    p = fret.solve(scene, path, progress=False).at(-1).p
    r = np.hypot(p.x, p.y) / HERTZ.a
    truth = HERTZ.p0 * np.sqrt(np.maximum(1.0 - r**2, 0.0))
    return float(np.sqrt(((p - truth) ** 2).sum() / (truth**2).sum()))


@pytest.mark.parametrize("error", [0.02, 0.01, 0.005])
def test_a_grid_is_as_fine_as_an_error_asks_for(error: float) -> None:
    grid = fret.Grid.for_contact(BALL, FLAT, PATH, error=error)
    np.testing.assert_allclose(grid.nx * grid.dx, 2.4 * HERTZ.a, rtol=0.08)
    # Kept, and not at the cost of cells that nobody asked for.
    assert 0.3 * error < of_pressure(grid) < error


# The contact on the soft layer has a fifth of the radius of the ball, and squeezes it by 71 %.
@pytest.mark.filterwarnings("ignore:a/R = 0.19:pyfret.errors.SceneWarning")
@pytest.mark.filterwarnings("ignore:the pressure comes to:pyfret.errors.SceneWarning")
@pytest.mark.parametrize(
    ("upper", "lower", "half"),
    [
        (fret.Sphere(R=R), FLAT, HERTZ.a),
        # Nearly incompressible and a tenth as thick as the ball is round: it spreads far.
        (
            fret.Sphere(R=R),
            fret.Body(STEEL, coatings=fret.Coating(fret.Elastic(E=1e6, nu=0.4999), thickness=1e-4)),
            None,
        ),
        (fret.shapes.FlatPunch(radius=1e-4, edge=1e-3), FLAT, 1e-4),
    ],
)
def test_a_grid_is_as_long_as_the_contact_that_comes_out(
    upper: object, lower: fret.Body, half: float | None
) -> None:
    body = fret.Body(STEEL, shape=upper)  # type: ignore[arg-type]
    grid = fret.Grid.for_contact(body, lower, PATH, room=1.3)
    scene = fret.Scene(body1=body, body2=lower, friction=0.0, grid=grid)
    path = fret.LoadPath.start().normal(W, increments=1)
    at = fret.solve(scene, path, progress=False).at(-1)
    touched = at.x.values[at.contact.values.any(axis=1)]
    share = (np.ptp(touched) + grid.dx) / (grid.nx * grid.dx)
    assert 0.65 < share < 0.85
    if half is not None:
        np.testing.assert_allclose(np.ptp(touched) / 2, half, rtol=0.2)


def test_a_grid_of_a_line_contact_is_a_strip_and_of_an_ellipse_a_rectangle() -> None:
    line = fret.reference.line_contact(R=R, bodies=(STEEL, STEEL), W=1e5)
    path = fret.LoadPath.start().normal(1e5)
    cylinder = fret.Body(STEEL, shape=fret.Cylinder(R=R))
    strip = fret.Grid.for_contact(cylinder, FLAT, path, plane_strain=True)
    assert strip.plane_strain
    np.testing.assert_allclose(strip.nx * strip.dx, 2.4 * line.a, rtol=0.08)
    long = fret.Body(STEEL, shape=fret.shapes.Ellipsoid(R_x=R, R_y=10 * R))
    grid = fret.Grid.for_contact(long, FLAT, PATH)
    assert grid.ny > 3 * grid.nx
    np.testing.assert_allclose(grid.dx, grid.dy, rtol=0.1)


def test_roughness_has_eight_cells_in_its_shortest_wave() -> None:
    rough = fret.shapes.Rough(rms=1e-8, hurst=0.8, longest=5e-5, shortest=1e-5, seed=1)
    ball = fret.Body(STEEL, shape=fret.Sphere(R=R) + rough)
    grid = fret.Grid.for_contact(ball, FLAT, PATH, error=0.05)
    assert grid.dx <= 1e-5 / 8
    scene = fret.Scene(body1=ball, body2=FLAT, friction=0.0, grid=grid)
    fret.solve(scene, fret.LoadPath.start().normal(W, increments=1), progress=False)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"error": 0.0}, "error = 0.0"),
        ({"room": 1.0}, "room = 1.0"),
        ({"path": fret.LoadPath.start()}, "presses nothing"),
        ({"body1": FLAT}, "flat surfaces touch all over"),
        ({"error": 1e-5}, "cells along a side"),
        ({"wear": {"cycles": 1e3, "body2": fret.wear.Archard(k=1e-15)}}, "mu: must be given"),
        (
            {
                "path": fret.LoadPath.start().normal(W).cycles(1, delta_x=10e-6),
                "wear": {"cycles": 1e11, "body2": LAW, "cycling": "sliding", "jumps": 2},
                "mu": 0.3,
            },
            r"k is in m\^2/N",
        ),
    ],
)
def test_a_grid_that_cannot_be_chosen_says_why(change: dict[str, object], said: str) -> None:
    arguments: dict[str, object] = {"body1": BALL, "body2": FLAT, "path": PATH, **change}
    with pytest.raises(ValueError, match=said):
        fret.Grid.for_contact(**arguments)


MCCOLL = (
    fret.Body(fret.Elastic(E=200e9, nu=0.3), shape=fret.Cylinder(R=6e-3)),
    fret.LoadPath.start().normal(18.5e3).cycles(1, delta_x=25e-6),
)
SLIDES = fret.LoadPath.start().normal(W).cycles(1, delta_x=10e-6)


@pytest.mark.parametrize(
    ("ball", "path", "mu", "wear"),
    [
        (BALL, SLIDES, 0.5, {"cycles": 5e4, "body2": LAW, "cycling": "sliding"}),
        (
            BALL,
            fret.LoadPath.start().normal(W, increments=1).cycles(1, delta_x=6e-6, increments=4),
            0.5,
            {"cycles": 5e4, "body1": LAW, "body2": LAW, "debris_kept": 0.5, "jumps": 6},
        ),
        (
            *MCCOLL,
            0.9,
            {
                "cycles": 18e3,
                "body1": fret.wear.Archard(k=1.9e-14),
                "body2": fret.wear.Archard(k=2.9e-14),
                "cycling": "sliding",
                "rig_stiffness": 24.6e9,
            },
        ),
    ],
)
def test_a_grid_holds_the_scar_and_no_more(
    ball: fret.Body, path: fret.LoadPath, mu: float, wear: dict[str, object]
) -> None:
    strip = path is MCCOLL[1]
    grid = fret.Grid.for_contact(ball, FLAT, path, error=0.04, wear=wear, mu=mu, plane_strain=strip)
    scene = fret.Scene(body1=ball, body2=FLAT, friction=mu, grid=grid, path=path)
    worn = fret.wear.solve(scene, **wear, progress=False)  # type: ignore[arg-type]
    d = worn.dataset
    assert d.attrs["status"] == "done"
    touched = ((d.p > 0) | (d.worn1 > 0) | (d.worn2 > 0)).any("block").any("y").values
    share = 2 * np.abs(d.x.values[touched]).max() / (grid.nx * grid.dx)
    assert 0.7 < share < 0.9
    # The scar is longer than the contact that begins it, which has eight cells in its radius.
    assert grid.nx * grid.dx > 1.5 * 2.0 * scene.hertz.a  # type: ignore[union-attr]
    assert scene.hertz.a / grid.dx > 7.0  # type: ignore[union-attr]


@pytest.mark.parametrize("sigma_B", [0.0, 60e6])
def test_the_stick_zone_of_a_cylinder_is_where_theory_has_it(sigma_B: float) -> None:
    mu, load = 0.6, 4e5
    ti = fret.Elastic(E=116e9, nu=0.33)
    line = fret.reference.line_contact(R=0.05, bodies=(ti, ti), W=load)
    scene = fret.Scene(
        body1=fret.Body(ti, shape=fret.Cylinder(R=0.05)),
        body2=fret.Body(ti),
        friction=mu,
        grid=fret.Grid.strip(extent=2.6 * line.a, n=128),
    )
    T = 0.6 * mu * load
    path = fret.LoadPath.start().normal(load, increments=1)
    path = path.force(T_x=T, sigma_B=sigma_B, increments=8)
    at = fret.solve(scene, path, progress=False).at(-1)
    zone, cell = at.stick_zone(), scene.grid.dx
    half = line.stick_half_width(T=T, mu=mu)
    middle = line.stick_middle(eps_x=sigma_B * (1 - ti.nu**2) / ti.E, mu=mu)
    # Within the cells: a tenth of one.
    assert abs(zone.half_width - half) < 0.1 * cell
    assert abs(zone.middle - middle) < 0.1 * cell
    assert zone.inside == 0
    assert abs(at.contact_zone().half_width - line.a) < 0.1 * cell


def test_nothing_sticks_after_gross_slip_and_all_of_it_before_slip() -> None:
    scene = fret.Scene(
        body1=BALL, body2=FLAT, friction=0.3, grid=fret.Grid.centred(width=2.4 * HERTZ.a, n=32)
    )
    pressed = fret.LoadPath.start().normal(W, increments=1)
    slid = fret.solve(scene, pressed.cycles(1, delta_x=2e-6, increments=4), progress=False)
    assert np.isnan(slid.at(-1).stick_zone().middle)
    assert slid.regimes() == ["gross slip"]
    first = slid.at(1)
    assert first.stick_zone() == first.contact_zone()
    partial = fret.solve(scene, pressed.cycles(1, T_x=1.0, increments=4), progress=False)
    assert partial.regimes() == ["partial slip"]


def test_materials_have_names() -> None:
    names = list(fret.fatigue.Materials())
    numbers = {n: fret.fatigue.Materials()[n].numbers() for n in names}
    known_items = [
        n
        for n in names
        if any(k == "E" and "recalled" not in entry_name for k, _, entry_name in numbers[n])
    ]
    assert len(known_items) > 5
    for name in known_items:
        elastic = fret.material(name, nu=0.3)
        assert 1e8 < elastic.E < 1.5e12
        assert elastic.nu == 0.3
    assert fret.material("titanium_6Al4V").nu != 0.3
    with pytest.warns(fret.errors.SceneWarning, match="no Poisson's ratio"):
        assert fret.material("CrN").nu == 0.25
    assert fret.fatigue.Materials()["TiN"].number("E") == fret.material("TiN", nu=0.3).E
    assert fret.material("TiN").nu == 0.25
    assert fret.material("steel_42CrMo4") == fret.Elastic(E=207e9, nu=0.30)
    with pytest.raises(KeyError, match=r"there are .*TiN"):
        fret.material("TiNN")


def test_a_study_is_a_table_of_points() -> None:
    scene = fret.Scene(
        body1=BALL,
        body2=FLAT,
        friction=0.3,
        grid=fret.Grid.centred(width=2.4 * HERTZ.a, n=24),
        path=fret.LoadPath.start().normal(W, increments=1),
    )

    def profile(result: fret.Result) -> object:
        return result.at(-1).along_x().p.rename("p")

    study = fret.study.run(
        scene, {"mu": [0.2, 0.3]}, measure=["p_max", profile], executor=SAME_PROCESS, progress=False
    )
    with pytest.warns(UserWarning, match=r"left out.* profile \(over x\)"):
        table = study.to_dataframe()
    assert list(table.columns)[:1] == ["mu"]
    assert "profile" not in table.columns
    assert len(table) == 2
    assert (table["p_max [Pa]"] > 0.9 * HERTZ.p0).all()


def test_a_summary_tells_its_errors() -> None:
    scene = fret.Scene(
        body1=BALL, body2=FLAT, friction=0.3, grid=fret.Grid.centred(width=2.4 * HERTZ.a, n=32)
    )
    path = fret.LoadPath.start().normal(W, increments=2)
    result = fret.solve(scene, path, error=True, progress=False)
    titles, _, _, row = result.summary().partition("Hertz, without coatings\n")[2].splitlines()[:4]
    begins = [titles.index(name) + len(name) for name in ("T_x", "a/a_H")]
    value, error = (float(part) for part in row[slice(*begins)].split("+-"))
    assert abs(value - 1.0) < 3 * error < 0.1


def test_error_bars_of_a_line_contact_are_of_its_half_width() -> None:
    line = fret.reference.line_contact(R=R, bodies=(STEEL, STEEL), W=1e5)
    errors, halves = [], []
    for n in (32, 64):
        scene = fret.Scene(
            body1=fret.Body(STEEL, shape=fret.Cylinder(R=R)),
            body2=FLAT,
            friction=0.3,
            grid=fret.Grid.strip(extent=2.6 * line.a, n=n),
        )
        path = fret.LoadPath.start().normal(1e5, increments=1)
        result = fret.solve(scene, path, error=True, progress=False)
        bars = result.error_bars()
        assert "contact_radius" not in bars
        errors.append(float(bars.half_width.sel(part="total")[-1]))
        halves.append(float(result.half_width[-1]))
    for half, error in zip(halves, errors, strict=True):
        assert abs(half - line.a) < 3 * error < 0.2 * line.a
    assert all(b < a for a, b in pairwise(errors))
