"""Running conditions, crack risk and energy over the loads, in one call and one figure."""

from __future__ import annotations

import pickle

import matplotlib.pyplot as plt
import numpy as np
import pytest
import xarray as xr

import pyfret as fret
from conftest import MU, SAME_PROCESS, R, sphere_on_flat
from pyfret import fatigue

pytestmark = pytest.mark.solves

SOURCE = "bending and torsion tests of this test"
STEEL = fatigue.Material("steel", [("s_D", 400e6, SOURCE), ("t_D", 260e6, SOURCE)])


def test_a_material_of_ones_own_needs_its_sources() -> None:
    assert STEEL.number("s_D") == 400e6
    assert STEEL.title == "steel"
    assert pickle.loads(pickle.dumps(STEEL)) == STEEL
    for numbers, expected in (
        ([("s_D", 400e6, " ")], r"material `mine`\.s_D: has no source"),
        ([("s_D", -1.0, SOURCE)], r"`mine`\.s_D: -1: must be positive"),
        ([("sD", 1.0, SOURCE)], r"`mine`\.sD: unknown; nearest is s_"),
    ):
        with pytest.raises(fret.errors.ArgumentError, match=expected):
            fatigue.Material("mine", numbers)


def test_the_map_holds_what_each_point_gives() -> None:
    """Against a solution of one point by itself; more shear cracks sooner and dissipates more."""
    cracking = fret.study.Cracking(STEEL, "crossland")
    scene = sphere_on_flat(n=20)
    loads = {"W": [600.0, 1000.0], "T": [60.0, 150.0, 200.0]}
    table = fret.study.running_conditions(
        scene, **loads, increments=(3, 6), cracking=cracking, executor=SAME_PROCESS
    )
    assert table.status.values.tolist() == [[2, 2, 3], [2, 2, 2]]
    assert np.isnan(table.safety_factor[0, 2])
    assert (
        np.diff(table.safety_factor.values)[np.isfinite(np.diff(table.safety_factor))] < 0
    ).all()
    assert table.dissipated[1, 1] > table.dissipated[1, 0]
    path = fret.LoadPath.start().normal(1000.0, increments=3)
    for T, increments in ((150.0, 3), (-150.0, 6), (150.0, 6)):
        path = path.force(T_x=T, increments=increments)
    alone = fret.solve(scene, path, save="all", progress=False).life(STEEL, "crossland", y=0.0)
    np.testing.assert_allclose(table.safety_factor[1, 1], alone.worst.margin, rtol=1e-9)
    np.testing.assert_allclose(table.crack_depth[1, 1], alone.worst.z, rtol=1e-9, atol=1e-15)
    ax = fret.plot.fretting_map(table)
    labels = [text.get_text() for text in ax.get_legend().get_texts()]
    assert labels[:2] == ["partial slip", "gross slip"]
    assert any("energy" in label for label in labels)
    plt.close("all")


def test_gross_slip_begins_at_the_shift_of_mindlin() -> None:
    """The line of a bare ball, between samples that are far apart, goes with W^(2/3)."""
    scene = sphere_on_flat(ratio=1.0, n=24)
    W, limits = np.array([300.0, 1000.0]), []
    for load in W:
        hertz = fret.reference.hertz(R=R, bodies=(scene.body1, scene.body2), W=load)
        bodies = (scene.body1.substrate, scene.body2.substrate)
        limits.append(fret.reference.CattaneoMindlin(hertz, bodies=bodies, mu=MU).shift_limit)
    shifts = max(limits) * np.array([0.2, 1.5])
    table = fret.study.running_conditions(
        scene, W=W, delta=shifts, increments=(3, 6), executor=SAME_PROCESS
    )
    np.testing.assert_allclose(table.slides_from, limits, rtol=0.02)
    ax = fret.plot.running_map(table)
    drawn = ax.lines[0]
    middle = np.interp(np.sqrt(W.prod()), drawn.get_xdata(), drawn.get_ydata())
    assert middle == pytest.approx(1e6 * np.sqrt(np.prod(limits)), rel=0.02)
    forces = fret.study.running_conditions(
        scene, W=W, T=[30.0], increments=(3, 4), executor=SAME_PROCESS
    )
    np.testing.assert_allclose(forces.slides_from, MU * W)
    plt.close("all")


def test_borders_lie_between_the_samples() -> None:
    """Areas of a chart end where the interpolated load is 1, not half way between two points."""
    x, y = np.array([1.0, 3.0]), np.array([1.0, 2.0, 4.0, 8.0])
    load = np.repeat([[0.5, 2.5]], 4, axis=0)
    table = xr.Dataset(
        {
            name: (("y", "x"), load * part)
            for name, part in zip(fret.fracture.PARTS, (1.0, 0.5, 0.1), strict=True)
        }
        | {"first": (("y", "x"), (load > 1.0).astype(int))},
        coords={"x": x, "y": y},
    )
    ax = fret.plot.design_chart(table, "x", "y")
    codes = ax.collections[0].get_array()
    row = np.asarray(codes).reshape(300, 300)[0]
    assert np.linspace(1.0, 3.0, 300)[int(np.argmax(row >= 1.0))] == pytest.approx(1.5, abs=0.01)
    assert ax.get_yscale() == "log"
    plt.close("all")
