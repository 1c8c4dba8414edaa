"""One list of quantities and of units, for scenes, wear, heat, fatigue, cracks, fits and tables."""

from __future__ import annotations

import re
import typing
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyfret as fret
from pyfret import _core, fatigue, fracture, heat, quantities, subsurface, wear
from pyfret.errors import SceneWarning
from pyfret.fit.ranges import ranges
from pyfret.study.design import Design

HISTORY = np.ones((3, 2, 6)) * 1e8
#: A number in the unit of another program, and the text of its doubt.
SLIPS: dict[str, tuple[Callable[[], Any], str]] = {
    "conductivity in W/(mm K)": (
        lambda: heat.Conductor(conductivity=0.045, heat_capacity=3.6e6),
        r"W/\(m K\)",
    ),
    "heat capacity of a mass": (
        lambda: heat.Conductor(conductivity=45.0, heat_capacity=460.0),
        r"J/\(m\^3 K\)",
    ),
    "k in mm^3/(N m)": (lambda: wear.Archard(1e-5), r"m\^2/N"),
    "alpha in mm^3/J": (lambda: wear.DissipatedEnergy(alpha=1e-5), r"m\^3/J"),
    "threshold in MPa m^0.5": (lambda: fracture.Threshold(dK_th=4.0), r"Pa m\^0.5"),
    "strength in MPa": (lambda: fracture.Threshold(dK_th=4e6, dS_0=500.0), "dS_0 = 500 Pa"),
    "growth in SI": (lambda: fracture.Paris(C=5e-30, m=3.0), "at 1 MPa"),
    "yield stress in MPa": (lambda: fatigue.first_yield(HISTORY, s_y=300.0), "s_y = 300 Pa"),
    "stress in MPa": (
        lambda: fatigue.evaluate_margin(
            HISTORY / 1e6, fatigue.Materials()["steel_42CrMo4"], "crossland"
        ),
        "stress = 100 Pa",
    ),
    "expansion in um/(m K)": (
        lambda: subsurface.thermal_stress(
            fret.Elastic(E=2e11, nu=0.3),
            alpha_coating=9.4,
            alpha_substrate=1.2e-5,
            temperature_change=-500.0,
        ),
        "alpha_coating = 9.4 1/K",
    ),
    "loop in um": (
        lambda: fret.fit.Loops.from_arrays([0, 9, 0, -9, 0], [0, 5, 0, -5, 0]),
        "delta = 9 m",
    ),
    "indentation in um": (
        lambda: fret.fit.Indentation.from_arrays([1.0, 2.0], [1.0, 2.0]),
        "delta_z = 2 m",
    ),
    "friction of a fit in per cent": (lambda: ranges({"mu": (20.0, 60.0)}), "mu = 20"),
    "modulus of a fit in GPa": (lambda: ranges({"body2.E": (100.0, 300.0)}), "E = 100 Pa"),
    "rig of a fit in N/um": (lambda: ranges({"rig.stiffness": (1.0, 50.0)}), "stiffness = 1 N/m"),
    "bulk stress of a fit in MPa": (lambda: ranges({"path.*.sigma_B": (50.0, 200.0)}), "= 50 Pa"),
    "wear of a fit in mm^3/J": (lambda: ranges({"wear.body2.alpha": (1e-6, 1e-4)}), r"m\^3/J"),
    "friction of a study in per cent": (
        lambda: Design.from_values({"mu": [20.0]}, "grid"),
        "mu = 20",
    ),
    "bulk stress of a study": (
        lambda: Design.from_values({"path.1.sigma_B": [99.0]}, "grid"),
        "= 99 Pa",
    ),
}


@pytest.mark.parametrize("slip", SLIPS)
def test_a_number_in_another_unit_is_doubted(slip: str) -> None:
    call, message = SLIPS[slip]
    with warnings.catch_warnings(record=True) as doubts:
        warnings.simplefilter("always")
        call()
    text = [str(doubt.message) for doubt in doubts if doubt.category is SceneWarning]
    assert any(re.search(message, element) for element in text), text


def test_numbers_of_a_scene_in_another_unit_are_doubted() -> None:
    steel = fret.Elastic(E=210e9, nu=0.3)
    grid = fret.Grid.centred(width=5e-4, n=24)
    path = fret.LoadPath.start().normal(100.0, increments=1)
    soft = fret.Elastic(E=210e9, nu=0.3, plastic=fret.Plastic(s_y=300.0, hardening=1e3))
    coat = fret.Coating(steel, thickness=1e-4, bond=fret.Bond(normal=1.0))

    def doubts(**changed: Any) -> str:
        item: dict[str, Any] = {
            "body1": fret.Body(steel, shape=fret.Sphere(R=0.01)),
            "body2": fret.Body(steel),
            "friction": 0.3,
            "grid": grid,
            "path": path,
        }
        return "\n".join(fret.Scene(**item | changed).doubts())

    assert doubts() == ""
    assert "body2.plastic.s_y = 300 Pa" in doubts(body2=fret.Body(soft))
    assert "body2.plastic.hardening = 1000 Pa" in doubts(body2=fret.Body(soft))
    assert "body2.coatings[0].bond_normal = 1 m/Pa" in doubts(
        body2=fret.Body(steel, coatings=[coat])
    )
    assert "friction.kinetic = 30" in doubts(friction=fret.Friction(30.0, kinetic=30.0))
    assert "rig.stiffness = 20 N/m" in doubts(path=path.rig(20.0))
    assert "rig" not in doubts(path=path.rig("20 N/um"))


def test_types_of_quantities_are_the_rows_of_the_table() -> None:
    """Every type has a row with its unit, and every row has a type."""
    hints = [typing.get_args(hint)[1:] for hint in vars(quantities).values()]
    units = {
        data.quantity: data.si
        for metadata in hints
        for data in metadata
        if isinstance(data, quantities.Unit) and data.quantity
    }
    assert units == {name: unit for name, unit, _ in _core.quantities()}


@pytest.mark.parametrize(
    ("head", "units", "expected"),
    [
        ("delta;T", {}, "no column with a unit"),
        ("delta [N];T [N]", {}, "no column with a unit of length"),
        ("delta;T", {"delta": "parsec", "T": "N"}, "parsec"),
        ("delta;T", {"weg": "um", "T": "N"}, "no column 'weg'"),
        ("delta [um];T [N]", {"delta": "mm"}, "the file says 'um'"),
        ("delta;T\num;N", {"delta": "mm"}, "the file says 'um'"),
    ],
)
def test_units_of_columns_are_asked_for(
    tmp_path: Path, head: str, units: dict[str, str], expected: str
) -> None:
    table = tmp_path / "loop.csv"
    table.write_text(f"{head}\n0;0\n1;4\n0;-4\n-1;-5\n0;4\n1;5\n")
    with pytest.raises(ValueError, match=expected):
        fret.fit.read_loops(table, units=units)


def test_lives_name_the_units_of_what_was_set(tmp_path: Path) -> None:
    table = tmp_path / "lives.csv"
    thickness = "body2.coatings.0.thickness"
    for head, pattern in (
        (f"cycles;{thickness}", "must have a unit of length"),
        (f"cycles;{thickness} [N]", "must have a unit of length"),
        ("cycles;path.*.W [um]", "must have a unit of force"),
    ):
        table.write_text(f"{head}\n1e5;3\n2e5;4\n")
        with pytest.raises(ValueError, match=pattern):
            fret.fit.read_lives(table, wear={})
    table.write_text(f"cycles;{thickness} [um];mu\n1e5;3;0.3\n")
    assert fret.fit.read_lives(table, wear={}).settings == [
        {thickness: pytest.approx(3e-6), "mu": 0.3}
    ]


def test_units_are_those_of_scene_files() -> None:
    """One list: what a scene file takes for a length a table does, and measured surfaces do."""
    for unit, kind, size in (
        ("um", "length", 1e-6),
        ("µm", "length", 1e-6),
        ("mil", "length", 25.4e-6),
        ("kgf", "force", 9.80665),
        ("N/um", "stiffness", 1e6),
        ("MPa m^0.5", "stress intensity", 1e6),
        ("mm^3/(N m)", "wear coefficient", 1e-9),
        ("ksi", "stress", 6894757.293168),
    ):
        assert _core.unit_of(unit) == (kind, size)
    assert _core.unit_of("counts") is None
    assert pytest.approx(30 * 6894757.293168) == fret.Elastic(E="30 ksi", nu=0.3).E
    assert fret.LoadPath.start().rig("20 N/um").rig_stiffness == pytest.approx(2e7)
