"""Wear in gross slip: V = k W s N, whatever the shapes, the spots and the stroke."""

from __future__ import annotations

import re

import numpy as np
import pytest

import pyfret as fret

STEEL = fret.Elastic(E=207e9, nu=0.3)
W, MU, K = 50.0, 0.3, 1e-15


def grid(length: float | tuple[float, float], n: int | tuple[int, int]) -> fret.Grid:
    """A grid of these lengths."""
    sides = length if isinstance(length, tuple) else (length, length)
    cells = n if isinstance(n, tuple) else (n, n)
    return fret.Grid.from_spacing(cells, (sides[0] / cells[0], sides[1] / cells[1]))


def worn(scene: fret.Scene, stroke: float, cycles: float, **how: object) -> fret.wear.WearResult:
    """Slide to and fro by a stroke, where body 2 wears."""
    path = fret.LoadPath.start().normal(W).cycles(1, delta_x=stroke)
    laws = {"body2": fret.wear.Archard(k=K)} | how
    return fret.wear.solve(scene, path=path, cycles=cycles, progress=False, **laws)  # type: ignore[arg-type]


def scene(body1: fret.shapes.Shape, body2: fret.shapes.Shape, on: fret.Grid) -> fret.Scene:
    """Two steel bodies."""
    upper, lower = fret.Body(STEEL, shape=body1), fret.Body(STEEL, shape=body2)
    return fret.Scene(body1=upper, body2=lower, friction=MU, grid=on)


@pytest.mark.solves
@pytest.mark.parametrize("stroke", [0.3, 1.0, 5.0])
def test_the_volume_is_that_of_archard(stroke: float) -> None:
    """V = k W 4 d N of a ball that slides by parts and multiples of its radius of contact."""
    a = fret.reference.hertz(R=5e-3, bodies=(STEEL, STEEL), W=W).a
    d = stroke * a
    on = grid((4.0 * a + 2.5 * d, 4.0 * a), (48, 32))
    run = worn(scene(fret.Sphere(R=5e-3), fret.shapes.Flat(), on), d, 2e3)
    assert 'cycling = "sliding"' in run.summary()
    assert abs(float(run.dataset.volume2[-1]) / (K * W * 4.0 * d * 2e3) - 1.0) < 1e-3


@pytest.mark.solves
def test_a_ball_in_a_groove_is_the_ellipsoid_on_a_flat() -> None:
    """A groove that is straight along the stroke does not change below the contact."""
    R, groove = 6.35e-3, 6.6e-3
    on = grid((6e-4, 2.4e-3), (32, 48))
    pairs = [
        (fret.Sphere(R=R), fret.Cylinder(R=-groove, angle=np.pi / 2)),
        (fret.shapes.Ellipsoid(R_x=R, R_y=1 / (1 / R - 1 / groove)), fret.shapes.Flat()),
        (fret.Cylinder(R=-groove, angle=np.pi / 2), fret.Sphere(R=R)),
    ]
    depths = []
    for n, (upper, lower) in enumerate(pairs):
        law = {"body1": fret.wear.Archard(k=K), "body2": None} if n == 2 else {}
        run = worn(scene(upper, lower, on), 30e-6, 1e4, **law)
        depths.append(float(run.dataset[f"depth{1 if n == 2 else 2}"][-1]))
    assert np.ptp(depths) < 0.01 * max(depths)


@pytest.mark.solves
def test_curved_bodies_follow_their_geometry() -> None:
    """Two balls: moved by d, the contact lies d/2 away from the tip of each."""
    on = grid(4e-4, 40)
    balls = scene(fret.Sphere(R=5e-3), fret.Sphere(R=5e-3), on)
    d = 60e-6
    run = worn(balls, d, 1e3)
    along = run.dataset.worn2[-1].sum("y").values
    x = run.dataset.x.values
    reach = np.abs(x[along > 0.2 * along.max()]).max()
    flat = worn(scene(fret.Sphere(R=2.5e-3), fret.shapes.Flat(), on), d, 1e3)
    along = flat.dataset.worn2[-1].sum("y").values
    whole = np.abs(x[along > 0.2 * along.max()]).max()
    # The scar on a flat reaches d further than the contact, on the ball d/2.
    assert abs((whole - reach) - d / 2) < 1.5 * on.dx
    assert abs(float(run.dataset.volume2[-1]) / (K * W * 4.0 * d * 1e3) - 1.0) < 1e-3


@pytest.mark.solves
def test_places_follow_the_size_of_a_spot() -> None:
    """Three ridges need as many places as one: many given increments make no other depth."""
    wave, load = 0.2e-3, 420.0
    shape = fret.shapes.Waviness(amplitude=5e-6, wavelength=wave)
    ridges = fret.Scene(
        body1=fret.Body(STEEL, shape=shape),
        body2=fret.Body(STEEL),
        friction=MU,
        grid=fret.Grid.strip(extent=3 * wave, n=450),
    )
    law = fret.wear.Archard(k=1e-16)
    depths = []
    for increments in ({}, {"increments": 160}):
        path = fret.LoadPath.start().normal(3 * load).cycles(1, delta_x=5e-6, **increments)
        run = fret.wear.solve(
            ridges, path=path, cycles=2e5, body1=law, body2=law, cycling="sliding", progress=False
        )
        depths.append([float(run.dataset[name][-1]) for name in ("depth1", "depth2")])
    assert np.allclose(depths[0], depths[1], rtol=0.03)


@pytest.mark.solves
def test_a_march_through_gross_slip_is_refused() -> None:
    """It keeps the worn surfaces in place."""
    a = fret.reference.hertz(R=5e-3, bodies=(STEEL, STEEL), W=W).a
    ball = scene(fret.Sphere(R=5e-3), fret.shapes.Flat(), grid(8.0 * a, 24))
    with pytest.raises(fret.errors.ArgumentError, match="keeps the worn surfaces in place"):
        worn(ball, 2.0 * a, 10.0, cycling="march")
    short = worn(ball, 0.5 * a, 10.0, cycling="march", jumps=1)
    assert any("march" in doubt for doubt in short.doubts)
    assert 'cycling = "march"' in worn(ball, 0.05 * a, 10.0, jumps=1).summary()


@pytest.mark.solves
@pytest.mark.parametrize("stroke", [25e-6, 200e-6])
def test_the_width_that_is_named_is_enough(stroke: float) -> None:
    """A scar that does not fit is warned of, and ends the run with the width that it needs."""
    brass = fret.Elastic(E=110e9, nu=0.34)
    a = fret.reference.hertz(R=3e-3, bodies=(brass, brass), W=1.0).a
    path = fret.LoadPath.start().normal(1.0).cycles(1, delta_x=stroke)
    extent = 4.5 * a + 2 * stroke

    def run(side: float) -> fret.wear.WearResult:
        ball = fret.Scene(
            body1=fret.Body(brass, shape=fret.Sphere(R=3e-3)),
            body2=fret.Body(brass),
            friction=0.4,
            grid=grid(side, 32),
        )
        law = fret.wear.Archard(k=1e-13)
        return fret.wear.solve(
            ball, path=path, cycles=20000, body2=law, cycling="sliding", progress=False
        )

    with (
        pytest.warns(fret.errors.SceneWarning, match="V = k W s N"),
        pytest.raises(fret.errors.OffGridError) as refused,
    ):
        run(extent)
    width = re.search(r"about ([0-9.e+-]+) m", str(refused.value))
    assert width is not None
    assert run(float(width.group(1))).dataset.attrs["status"] == "done"


@pytest.mark.solves
def test_wear_that_rests_is_not_called_none() -> None:
    """Wear in partial slip ends when the slip zone carries nothing."""
    a = fret.reference.hertz(R=3e-3, bodies=(STEEL, STEEL), W=1.0).a
    ball = fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Sphere(R=3e-3)),
        body2=fret.Body(STEEL),
        friction=0.4,
        grid=grid(3.0 * a, 20),
    )
    path = fret.LoadPath.start().normal(1.0).cycles(1, T_x=0.2, increments=8)
    run = fret.wear.solve(
        ball, path=path, cycles=1e9, body2=fret.wear.Archard(k=1e-12), progress=False
    )
    words = str(run.cycles_to(depth=1.0))
    assert "nothing wears" not in words
