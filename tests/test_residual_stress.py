"""Residual stress over depth: read, refused, and counted in all that takes a stress, by hand."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd
import pytest

import pyfret as fret
from pyfret import fatigue

if TYPE_CHECKING:
    from pathlib import Path

STEEL = fret.Elastic(E=210e9, nu=0.3)
COATING = fret.Elastic(E=400e9, nu=0.25)
TABLE = [[0.0, -600e6], [40e-6, -700e6], [120e-6, 50e6], [300e-6, 0.0]]
R, W = 10e-3, 100.0


def scene(body: fret.Body, **changes: Any) -> fret.Scene:
    """A rigid ball on a body."""
    arguments = {
        "body1": fret.Body(fret.RIGID, shape=fret.Sphere(R=R)),
        "body2": body,
        "friction": 0.0,
        "grid": fret.Grid.centred(width=6e-4, n=32),
        **changes,
    }
    return fret.Scene(**arguments)


def value_at(table: Any, depth: Any) -> Any:
    """The stress of a table."""
    z, s = np.transpose(table)[:2]
    return np.interp(depth, z, s)


@pytest.fixture(scope="module")
def pressed() -> fret.Result:
    """Pressed and let go again: a closed cycle of normal load."""
    body = fret.Body(STEEL, residual=TABLE)
    path = fret.LoadPath.start().normal(0.2 * W, increments=1).normal(W, increments=1)
    path = path.normal(0.2 * W, increments=1)
    return fret.solve(scene(body), path, save="all", progress=False)


def test_a_table_is_read_in_any_unit_and_written_back(tmp_path: Path) -> None:
    """Numbers, texts, arrays and tables of pandas are the same body, which a scene file holds."""
    texts = [["0 um", "-600 MPa"], ["40 um", "-0.7 GPa"], ["0.12 mm", "50 MPa"], [300e-6, 0]]
    frame = pd.DataFrame(TABLE, columns=["depth", "stress"])
    bodies = [fret.Body(STEEL, residual=item) for item in (TABLE, texts, np.array(TABLE), frame)]
    for body in bodies:
        np.testing.assert_allclose(body.residual, [[z, s, s] for z, s in TABLE], rtol=1e-14)
    assert fret.Body(STEEL, residual="-400 MPa").residual == -400e6
    assert fret.Body(STEEL).residual is None
    layer = fret.Coating(COATING, thickness=2e-6, residual=[[0.0, -1e9, -2e9], [2e-6, 0.0, 0.0]])
    body = fret.Body(STEEL, coatings=[layer], residual=TABLE)
    assert body.coatings[0] == layer
    assert eval(repr(body), vars(fret)) == body
    whole = scene(body, path=fret.LoadPath.start().normal(W))
    file = tmp_path / "scene.toml"
    file.write_text(whole.to_toml())
    assert fret.Scene.from_file(file).body2 == body


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ([[0.0, -1e8], [0.0, 0.0]], r"residual\[1\]\[0\] = 0: must be above 0e0 m"),
        ([[1e-5, -1e8], [0.0, 0.0]], r"residual\[1\]\[0\] = 0: must be above"),
        ([[-1e-6, -1e8], [0.0, 0.0]], r"residual\[0\]\[0\] = .*: must be a depth"),
        ([[0.0, math.nan], [1e-5, 0.0]], r"residual\[0\]\[1\] = NaN: must be a finite stress"),
        ([[math.nan, 0.0], [1e-5, 0.0]], r"residual\[0\]\[0\] = NaN: must be a depth"),
        (math.inf, r"residual = inf: must be a finite stress"),
        ([], "must be a stress in Pa, or a table"),
        ([0.0, -1e8], r"or a table .* such as \[\[0, -500e6\], \[1e-4, 0\]\]"),
        ([[0.0]], "must be a stress in Pa, or a table"),
        ([["0 MPa", "1 MPa"]], "must be a number in m"),
        ("3 um", "must be a number in Pa"),
    ],
)
def test_tables_without_meaning_are_refused_by_name(given: Any, message: str) -> None:
    """Depths that do not grow, numbers that are none, other shapes and units."""
    with pytest.raises(ValueError, match=message):
        fret.Body(STEEL, residual=given)
    with pytest.raises(ValueError, match=message):
        fret.Coating(COATING, thickness=1e-6, residual=given)


def test_a_layer_that_yields_bears_its_residual_stress() -> None:
    """More than the yield stress by von Mises is refused, and so is another one at the question."""
    soft = fret.Elastic(E=210e9, nu=0.3, plastic=fret.Plastic(s_y=500e6, hardening=1e9))
    with pytest.raises(
        ValueError, match=r"residual = 7e8 Pa by von Mises: must be within the yield"
    ):
        fret.Body(soft, residual=TABLE)
    # Of opposite signs it is sqrt(3) of one of them.
    with pytest.raises(ValueError, match=r"5\.196"):
        fret.Body(soft, residual=[[0.0, 300e6, -300e6]])


@pytest.mark.solves
def test_every_stress_has_the_residual_stress_of_its_depth(pressed: fret.Result) -> None:
    """Sections, points, planes, histories and envelopes, and what is given in its place."""
    now = pressed.at(-1)
    depths = [0.0, 20e-6, 90e-6, 200e-6, 5e-4]
    bare = [0.0]
    for position in ({"y": 0.0}, {"x": 1e-5, "y": 0.0}, {}):
        own_values, without = (
            now.stress(depths, **position),
            now.stress(depths, residual=bare, **position),
        )
        for name, expected in (
            ("s_xx", value_at(TABLE, depths)),
            ("s_yy", value_at(TABLE, depths)),
            ("s_zz", 0),
        ):
            added = (
                (getattr(own_values, name) - getattr(without, name)).transpose("depth", ...).values
            )
            flat = added.reshape(len(depths), -1)
            np.testing.assert_allclose(
                flat, np.broadcast_to(np.reshape(expected, (-1, 1)), flat.shape), atol=10.0
            )
    same = now.stress(depths, y=0.0, residual=[TABLE])
    np.testing.assert_array_equal(same.s_xx, now.stress(depths, y=0.0).s_xx)
    with pytest.raises(
        ValueError,
        match=r"2 of them: must be one for each of the 1 layers .*, \[\[0, -500e6\], \[1e-4, 0\]\]",
    ):
        now.stress(depths, y=0.0, residual=[0.0, 0.0])
    history = fatigue.history(pressed, depths, y=0.0)
    np.testing.assert_allclose(history[-1].sel(component="s_xx"), now.stress(depths, y=0.0).s_xx)


@pytest.mark.solves
def test_depths_count_from_the_top_of_the_layer() -> None:
    """A coated body in plane strain: the substrate's table begins below the coating."""
    layer = fret.Coating(COATING, thickness=10e-6, residual=[[0.0, -1e9, -5e8], [10e-6, 1e9, 5e8]])
    body = fret.Body(STEEL, coatings=[layer], residual=TABLE)
    line = scene(
        body,
        body1=fret.Body(fret.RIGID, shape=fret.Cylinder(R=R)),
        grid=fret.Grid.strip(extent=6e-4, n=64),
    )
    result = fret.solve(line, fret.LoadPath.start().normal(1e5, increments=1), progress=False)
    depths = [0.0, 5e-6, 10e-6, 50e-6]
    own_values, without = (
        result.at(-1).stress(depths, y=0.0, residual=r) for r in (None, [0.0, 0.0])
    )
    # Both sides of the interface.
    expected = {"s_xx": [-1e9, 0.0, 1e9, -600e6, -700e6], "s_yy": [-5e8, 0.0, 5e8, -600e6, -700e6]}
    for name, values in expected.items():
        added = (getattr(own_values, name) - getattr(without, name)).values
        np.testing.assert_allclose(added, np.reshape(values, (-1, 1)) * np.ones(64), atol=10.0)


@pytest.mark.solves
def test_crossland_by_hand(pressed: fret.Result) -> None:
    """Amplitude of the contact, largest hydrostatic stress with 2/3 of the residual."""
    z, alpha = 60e-6, 0.3
    bare, own_values = (
        fatigue.history(pressed, [z], x=0.0, y=0.0, residual=given_values).values.reshape(-1, 6)
        for given_values in ([0.0], None)
    )
    # On the axis the path of the deviator is a straight line, sqrt(J2) of half its length.
    ends = bare[:, 0] - bare[:, 2]
    amplitude = (ends.max() - ends.min()) / 2.0 / math.sqrt(3.0)
    hydrostatic = (bare[:, :3].sum(axis=1) / 3.0).max() + 2.0 / 3.0 * value_at(TABLE, z)
    fields = fatigue.evaluate_criterion(own_values, fatigue.Criterion.crossland(alpha=alpha))
    assert float(fields.value) == pytest.approx(amplitude + alpha * hydrostatic, rel=1e-6)


@pytest.mark.solves
def test_load_factor_of_first_yield_by_hand(pressed: fret.Result) -> None:
    """The least factor f at which f (s_xx - s_zz) + s_R comes to the yield stress, over depth."""
    s_y, z = 1500e6, np.linspace(10e-6, 200e-6, 20)
    bare = fatigue.history(pressed, z, x=0.0, y=0.0, residual=[0.0])
    d = (bare.sel(component="s_xx") - bare.sel(component="s_zz")).values.reshape(-1, z.size)
    d = d[np.abs(d).max(axis=1).argmax()]
    # d > 0 below the contact: compression along z is larger.
    s_R = value_at(TABLE, z)
    factors = np.where(d > 0, (s_y - s_R) / d, (-s_y - s_R) / d)
    computed = pressed.load_factors(s_y, z, y=0.0).dataset.von_mises
    on_axis = computed.isel(x=[15, 16]).mean("x").values
    np.testing.assert_allclose(on_axis, factors, rtol=5e-3)


@pytest.mark.solves
def test_residual_stress_intensity_of_a_crack() -> None:
    """An edge crack under s_0 + (s_1 - s_0) z/a: sqrt(pi a) (1.1215 s_0 + 0.6829 (s_1 - s_0))."""
    line = scene(
        fret.Body(STEEL, residual=[[0.0, 400e6], [100e-6, -100e6]]),
        body1=fret.Body(fret.RIGID, shape=fret.Cylinder(R=R)),
        grid=fret.Grid.strip(extent=6e-4, n=64),
    )
    path = fret.LoadPath.start().normal(2e4, increments=1).normal(1e5, increments=1)
    result = fret.solve(line, path.normal(2e4, increments=1), save="all", progress=False)
    lengths = np.array([10e-6, 50e-6, 100e-6])
    own_values, bare = (
        result.crack(x=5e-5, lengths=lengths, residual=given_values).dataset
        for given_values in (None, [0.0])
    )
    end = 400e6 - 5e12 * lengths
    K = np.sqrt(np.pi * lengths) * (1.121522255 * 400e6 + 0.682862878 * (end - 400e6))
    for added in (own_values.K_I_linear - bare.K_I_linear).values:
        np.testing.assert_allclose(added, K, rtol=2e-3)
    # Uniform in place of the table.
    same = result.crack(x=5e-5, lengths=lengths, residual=[1e8]).dataset
    added = (same.K_I_linear - bare.K_I_linear).values[0]
    np.testing.assert_allclose(added, 1.121522255e8 * np.sqrt(np.pi * lengths), rtol=2e-3)


@pytest.mark.solves
def test_a_body_that_yields_takes_its_own_residual_stress() -> None:
    """Another one at the question is refused; the stress after unloading holds the scene's."""
    law = fret.Plastic(s_y=1000e6, hardening=5e9)
    soft = fret.Elastic(E=210e9, nu=0.3, plastic=law)
    path = fret.LoadPath.start().normal(200.0, increments=2).normal(2.0, increments=1)
    table = [[0.0, -500e6], [300e-6, 0.0]]
    body = fret.Body(soft, residual=table)
    result = fret.solve(scene(body), path, progress=False)
    now, z = result.at(-1), [0.0, 2e-4, 4e-4]
    with pytest.raises(ValueError, match="residual = given: must be left out here"):
        now.stress(z, y=0.0, residual=[0.0])
    far = result.unloaded().stress(z, y=0.0)
    # Far from the contact nothing has yielded.
    np.testing.assert_allclose(far.s_xx.isel(x=0), value_at(table, z), atol=15e6)
    on_axis = now.plastic.on_axis("stress")
    mises = on_axis.sel(component="xx") - on_axis.sel(component="zz")
    R_of_p = law.s_y + law.hardening * now.plastic.on_axis("equivalent")
    assert float((np.abs(mises) / R_of_p).max()) < 1.001
    remaining = now.plastic.on_axis("residual_stress").sel(component="xx")
    own_values = result.unloaded().stress(remaining.z.values, x=0.0, y=0.0).s_xx.squeeze()
    np.testing.assert_allclose(remaining, own_values, atol=30e6)
