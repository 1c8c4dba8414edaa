"""Running conditions, crack risk and energy over the loads, in one call and one figure."""

from __future__ import annotations

import pickle

import matplotlib.pyplot as plt
import numpy as np
import pytest

import pyfret as fret
from conftest import sphere_on_flat
from pyfret import fatigue

pytestmark = pytest.mark.solves

SOURCE = "bending and torsion tests of this test"
STEEL = fatigue.Material("steel", [("s_D", 400e6, SOURCE), ("t_D", 260e6, SOURCE)])


def test_a_material_of_ones_own_needs_its_sources() -> None:
    assert STEEL.number("s_D") == 400e6
    assert STEEL.title == "steel"
    assert pickle.loads(pickle.dumps(STEEL)) == STEEL
    for numbers, says in (
        ([("s_D", 400e6, " ")], r"material `mine`\.s_D: has no source"),
        ([("s_D", -1.0, SOURCE)], r"`mine`\.s_D: -1: must be positive"),
        ([("sD", 1.0, SOURCE)], r"`mine`\.sD: unknown; nearest is s_"),
    ):
        with pytest.raises(fret.errors.ArgumentError, match=says):
            fatigue.Material("mine", numbers)


def test_the_map_holds_what_each_point_gives() -> None:
    """Against a solution of one point by itself; more shear cracks sooner and dissipates more."""
    cracking = fret.study.Cracking(STEEL, "crossland")
    scene = sphere_on_flat(n=20)
    loads = {"W": [600.0, 1000.0], "T": [60.0, 150.0, 200.0]}
    table = fret.study.running_conditions(scene, **loads, increments=(3, 6), cracking=cracking)
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
