"""A cycle may begin anywhere in its period: what zigzags, sines and functions have in common."""

from __future__ import annotations

import numpy as np
import pytest

import pyfret as fret

STEEL = fret.Elastic(E=200e9, nu=0.3)
R, W, MU = 20e-3, 100.0, 0.4
A = fret.reference.hertz(R=R, bodies=(STEEL, STEEL), W=W).a
PRESSED = fret.LoadPath.start().normal(W, increments=1)


def ball(n: int = 24) -> fret.Scene:
    """A ball on a flat."""
    return fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Sphere(R=R)),
        body2=fret.Body(STEEL),
        friction=MU,
        grid=fret.Grid.from_spacing((n, n), (2.4 * A / n, 2.4 * A / n)),
    )


@pytest.mark.parametrize("points", [8, 16, 64])
@pytest.mark.parametrize("phase", [0.0, 0.3, np.pi / 2, 4.0])
def test_a_sine_of_any_phase_has_its_periods(points: int, phase: float) -> None:
    """The last cycle is a period long; the first one may begin without shear."""
    # The turning points of the sine come on top, unless they are among the points.
    count = points + (0 if phase in (0.0, np.pi / 2) else 2)
    path = PRESSED.sine(2, T_x=0.5 * MU * W, points=points, phase=phase)
    first, last = path.whole_cycles()[-1]
    assert last + 1 - first == count
    two = PRESSED.sine(2, T_x=10.0, sigma_B=1e8, phase={"sigma_B": phase}, points=points)
    # Loads out of phase follow a curve: 64 points or more.
    count += 64 - points if phase else 0
    assert [last + 1 - first for first, last in two.whole_cycles()] == [count, count]


@pytest.mark.parametrize("points", [4, 5, 8, 16, 33])
@pytest.mark.parametrize("phase", np.linspace(0.0, 6.2, 7))
def test_a_swing_reaches_its_amplitude(points: int, phase: float) -> None:
    """A few points of a sine at any phase, or of a function: every load turns where it should."""
    T, sigma_B = 10.0, 1e8
    phases = {"T_x": phase, "sigma_B": 1.0 - phase}

    def loads(t: float) -> dict[str, float]:
        return {
            "T_x": T * float(np.sin(t + phases["T_x"])),
            "sigma_B": sigma_B * float(np.sin(t + phases["sigma_B"])),
        }

    sine = PRESSED.sine(2, T_x=T, sigma_B=sigma_B, phase=phases, points=points)
    function = PRESSED.from_function(loads, period=2 * np.pi, points=points)
    for path in (sine, function):
        for name, amplitude in (("T_x", T), ("sigma_B", sigma_B)):
            reached = np.asarray(getattr(path, name))
            assert float(reached.max()) == pytest.approx(amplitude, rel=2e-6)
            assert float(reached.min()) == pytest.approx(-amplitude, rel=2e-6)
        assert len(path.whole_cycles()) >= 1


def test_a_corner_of_a_function_is_kept() -> None:
    """A triangle whose corners lie between the points, and a trapezoid that rests."""
    corner = PRESSED.from_function(
        lambda t: {"T_x": 1.0 - 4.0 * abs(((t + 0.13) % 1.0) - 0.5)}, period=1.0, points=16
    )
    assert max(corner.T_x) == pytest.approx(1.0, rel=1e-4)
    rests = PRESSED.from_function(
        lambda t: {"T_x": float(np.clip(3.0 * np.sin(t), -1.0, 1.0))}, period=2 * np.pi, points=16
    )
    assert max(rests.T_x) == 1.0
    assert len(rests.whole_cycles()) == 2


def test_what_is_no_whole_cycle_is_refused_by_name() -> None:
    """Half a period more has no second cycle, and a part of a period has none."""
    t = 2 * np.pi * np.arange(1, 13) / 8
    assert len(PRESSED.waypoints(T_x=np.sin(t)).whole_cycles()) == 1
    part = PRESSED.waypoints(T_x=np.sin(t[:7] + 0.2))
    assert part.whole_cycles() == []
    assert "no closed cycle" in part.no_cycle()
    with pytest.raises(fret.errors.InvalidSceneError, match="as at its start"):
        PRESSED.from_function(lambda t: {"T_x": t}, period=1.0)


def test_noise_needs_its_period() -> None:
    """Measured loads do not return exactly; a given period takes them, and a file keeps it."""
    rng = np.random.default_rng(1)
    t = np.arange(1, 49)
    T = 10.0 * (np.sin(2 * np.pi * t / 16) + 1e-3 * rng.standard_normal(t.size))
    path = PRESSED.waypoints(t=1.0 + t, T_x=T)
    assert path.whole_cycles() == []
    assert "period" in path.no_cycle()
    assert len(path.repeats(period=16.0).whole_cycles()) == 3
    scene = ball().replace(path=path.repeats(period=16.0))
    assert fret.Scene.from_toml(scene.to_toml()).path == scene.path
    assert path.repeats(period=7.3).whole_cycles() == []
    with pytest.raises(ValueError, match="period"):
        path.repeats(period=-1.0)


@pytest.mark.solves
def test_loops_of_a_sine_are_those_of_a_zigzag() -> None:
    """Energy, force and opening of a cycle do not depend on how its way is given."""
    scene, T = ball(), 0.8 * MU * W
    zigzag = fret.solve(scene, PRESSED.cycles(1, T_x=T, increments=24), progress=False)
    right = zigzag.loops().isel(cycle=-1)
    for path in (
        PRESSED.sine(2, T_x=T, points=24, increments=1),
        PRESSED.sine(2, T_x=T, points=24, phase=1.0, increments=1),
        PRESSED.from_function(
            lambda t: {"T_x": T * np.cos(t)}, period=2 * np.pi, points=24, increments=1
        ),
    ):
        loops = fret.solve(scene, path, progress=False).loops()
        last = loops.isel(cycle=-1)
        assert abs(float(last.dissipated / right.dissipated) - 1.0) < 0.03
        assert abs(float(last["T"] / right["T"]) - 1.0) < 0.04
        assert abs(float(last.secant_stiffness / right.secant_stiffness) - 1.0) < 0.03
