"""The usual contacts in one call, and the table of materials that they take."""

from __future__ import annotations

import warnings
from typing import Any

import pytest

import pyfret as fret
from pyfret import reference, shapes

STEEL = fret.Elastic(E=210e9, nu=0.3)
COATED = fret.Body(STEEL, coatings=[fret.Coating(fret.Elastic(E=400e9, nu=0.25), thickness=6e-6)])


@pytest.mark.solves
def test_a_ball_a_cylinder_and_crossed_cylinders_have_the_pressure_of_hertz() -> None:
    ball = fret.Scene.ball_on_flat(STEEL, STEEL, R=5e-3, W=10.0, mu=0.4, T=2.0, quiet=True)
    crossed = fret.Scene.crossed_cylinders(STEEL, STEEL, R=5e-3, W=10.0, mu=0.4, quiet=True)
    right = reference.hertz(R=5e-3, bodies=(STEEL, STEEL), W=10.0).p0
    for scene in (ball, crossed):
        assert float(fret.solve(scene, progress=False).p_max.max()) == pytest.approx(
            right, rel=0.02
        )
    line = fret.Scene.cylinder_on_flat(STEEL, STEEL, R=0.05, W=2e5, mu=0.4, quiet=True)
    right = reference.line_contact(R=0.05, bodies=(STEEL, STEEL), W=2e5).p0
    assert float(fret.solve(line, progress=False).p_max[-1]) == pytest.approx(right, rel=0.02)


@pytest.mark.solves
def test_the_forces_and_motions_are_those_of_the_path() -> None:
    scene = fret.Scene.ball_on_flat("steel", COATED, R="5 mm", W="10 N", mu=0.4, T=2.0, cycles=3)
    assert scene.path == fret.LoadPath.start().normal(10.0).cycles(3, T_x=2.0)
    assert scene.body2.coatings == COATED.coatings
    assert scene.body1.substrate == fret.material("steel")
    moved = fret.Scene.ball_on_flat("steel", STEEL, R=5e-3, W=10.0, mu=0.4, shift=1e-6, quiet=True)
    assert moved.path == fret.LoadPath.start().normal(10.0).cycles(2, delta_x=1e-6)


@pytest.mark.solves
def test_the_grid_has_two_cells_in_a_film_and_is_printed(
    capsys: pytest.CaptureFixture[str],
) -> None:
    scene = fret.Scene.ball_on_flat(STEEL, COATED, R=5e-3, W=10.0, mu=0.4)
    assert COATED.coatings[0].thickness / scene.grid.dx == pytest.approx(2.0, rel=0.05)
    printed = capsys.readouterr().out
    assert f"grid: {scene.grid.nx} x {scene.grid.ny} cells" in printed
    assert "film: 6 um, 2 cells" in printed
    # A film that would take too many cells is said to be averaged.
    thin = COATED.replace(coatings=[fret.Coating(STEEL, thickness=5e-8)])
    fret.Scene.ball_on_flat(STEEL, thin, R=5e-3, W=10.0, mu=0.4)
    assert "averages over a cell" in capsys.readouterr().out


@pytest.mark.solves
def test_the_grid_holds_the_scar(capsys: pytest.CaptureFixture[str]) -> None:
    wear = {"cycles": 1e4, "body2": fret.wear.Archard(k=1e-14)}
    scene = fret.Scene.ball_on_flat(STEEL, STEEL, R=5e-3, W=10.0, mu=0.4, shift=1e-5, wear=wear)
    run = fret.wear.solve(scene, **wear, progress=False)
    assert run.status == "done"
    contact = 2.0 * reference.hertz(R=5e-3, bodies=(STEEL, STEEL), W=10.0).a
    assert scene.grid.nx * scene.grid.dx > 1.5 * contact


@pytest.mark.solves
def test_a_pad_and_a_rough_ball_are_solved() -> None:
    pad = fret.Scene.flat_pad(STEEL, STEEL, width=1e-3, edge=2e-3, W=1e5, mu=0.4, T=1e4, quiet=True)
    run = fret.solve(pad, progress=False)
    assert float(run.half_width[-1]) > 0.5e-3
    heights = shapes.Rough(rms=5e-8, hurst=0.8, longest=4e-5, shortest=2e-5, seed=1)
    scene = fret.Scene.rough_on_flat(
        STEEL, STEEL, surface=heights, R=5e-3, W=5.0, mu=0.4, quiet=True, n=48
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        result = fret.solve(scene, progress=False)
    assert float(result.W[-1]) == pytest.approx(5.0)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"T": 1.0, "shift": 1e-6}, "T and shift: give one of them"),
        ({"cycles": 0}, "cycles = 0"),
        ({"ball": 5}, "ball = 5: must be a Body"),
        ({"ball": fret.Body(STEEL, shape=fret.Sphere(R=1e-3))}, "ball: has a shape already"),
        ({"ball": "tiatnium"}, "tiatnium.*titanium"),
    ],
)
def test_what_has_no_meaning_is_refused_by_name(options: dict[str, Any], message: str) -> None:
    arguments = {"ball": STEEL, "flat": STEEL, "R": 5e-3, "W": 10.0, "mu": 0.3, **options}
    ball, flat = arguments.pop("ball"), arguments.pop("flat")
    with pytest.raises((ValueError, TypeError, KeyError), match=message):
        fret.Scene.ball_on_flat(ball, flat, **arguments)


def test_the_materials_are_a_table_with_units_and_sources() -> None:
    table = fret.materials()
    usual = [
        "chromium",
        "nickel",
        "WC_Co",
        "MoS2",
        "PTFE",
        "bronze",
        "brass",
        "gold",
        "silver",
        "tin_metal",
        "zirconia",
    ]
    usual += ["silicon_nitride", "sapphire", "glass", "steel_S355", "copper"]
    assert set(usual) <= set(table.index)
    assert table.loc["chromium", "E [Pa]"] == 279e9
    assert (table.loc[usual, "hardness [Pa]"].count()) >= 12
    sources = fret.materials(sources=True)
    assert set(sources.known) == {"measured", "estimated", "recalled"}
    assert sources.source.str.len().min() > 5
    assert len(sources) == int(
        table.filter(regex=r"\[|^nu$|^b$|^c$|^e_f$|^k$|^S$|^paris_m$|^walker$").count().sum()
    )


@pytest.mark.parametrize(("name", "kind"), [("Mo", "metal"), ("TiC", "coating"), ("stel", "steel")])
def test_an_unknown_name_has_neighbours_of_its_kind(name: str, kind: str) -> None:
    with pytest.raises(KeyError) as refused:
        fret.material(name)
    listed = str(refused.value).partition("the nearest are ")[2].partition(";")[0].split(", ")
    kinds = fret.materials().kind
    allowed = {"ceramic", "coating"} if kind == "coating" else {kind}
    assert {kinds[near] for near in listed} <= allowed
    assert fret.material("Cr") == fret.material("chromium")


@pytest.mark.parametrize("motion", [{"T": "80 N/mm"}, {"shift": 2e-6}, {}])
def test_bulk_stress_is_in_phase_with_the_motion(motion: dict[str, Any]) -> None:
    scene = fret.Scene.cylinder_on_flat(
        "steel", "steel", R=0.01, W=2e5, mu=0.6, sigma_B="150 MPa", cycles=2, n=32, **motion
    )
    branches = scene.path.branches[1:]
    assert [branch.sigma_B for branch in branches] == [1.5e8, -1.5e8, 1.5e8, -1.5e8, 1.5e8]
    if "T" in motion:
        assert [branch.T_x for branch in branches] == [8e4, -8e4, 8e4, -8e4, 8e4]
    if "shift" in motion:
        assert [branch.delta_x for branch in branches] == [2e-6, -2e-6, 2e-6, -2e-6, 2e-6]
