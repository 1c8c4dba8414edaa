"""A life of an elastic stress beyond the yield stress of its material has a note."""

from __future__ import annotations

import functools
import re

import pytest

import pyfret as fret

pytestmark = pytest.mark.solves

TI = fret.Elastic(E=116e9, nu=0.32)
NAME = "Ti-6Al-4V"
S_Y = fret.fatigue.Materials()[NAME].number("s_y")
MU = 0.4


@functools.cache
def flank(
    W: float, edge: float | None, plastic: float | None = None, part: float = 0.6
) -> fret.Result:
    """A pad with rounded edges, or a roller of 20 mm, under shear to and fro."""
    law = None if plastic is None else fret.Plastic(s_y=plastic, hardening=1e10)
    body = fret.Elastic(E=TI.E, nu=TI.nu, plastic=law) if law else TI
    shape = (
        fret.Cylinder(R=20e-3) if edge is None else fret.shapes.FlatPunch(radius=1.5e-3, edge=edge)
    )
    scene = fret.Scene(
        body1=fret.Body(TI, shape=shape),
        body2=fret.Body(body),
        friction=MU,
        grid=fret.Grid.strip(extent=3.8e-3, n=96),
    )
    T = part * MU * W
    path = fret.LoadPath.start().normal(W, increments=4).cycles(1, T_x=T, increments=12)
    return fret.solve(scene, path, save="all", progress=False)


def notes(result: fret.Result) -> list[str]:
    """The notes on yield of a life."""
    life = result.life(NAME, "findley")
    return [note for note in life.notes if "beyond yield" in note]


@pytest.mark.parametrize(
    ("W", "edge", "part"),
    [(4e6, 3e-3, 0.6), (6e6, 1e-3, 0.6), (4.9e6, None, 0.1), (4.9e6, None, 0.9)],
)
def test_the_note_has_the_load_factors(W: float, edge: float | None, part: float) -> None:
    """It takes them from load_factors; what later cycles do follows from shakedown."""
    (note,) = notes(flank(W, edge, None, part))
    factors = flank(W, edge, None, part).load_factors(S_Y)
    first, shakedown = (factors.least(name).value for name in ("von_mises", "shakedown"))
    assert first < 1.0
    ratio = re.search(r"comes to ([\d.]+) \+- ([\d.]+) of the yield stress", note)
    assert ratio is not None
    assert abs(float(ratio[1]) - 1.0 / first) < float(ratio[2])
    assert f"{1e-6 * S_Y:.4g} MPa" in note
    assert ("every cycle yields" in note) == (shakedown < 1.0)
    assert ("later cycles are elastic" in note) == (shakedown >= 1.0)
    assert "Plastic(s_y=...)" in note


def test_a_residual_stress_does_not_grow_with_the_loads() -> None:
    """Below one the stress over the limit is not the inverse of the load factor."""
    result = flank(4e6, 3e-3)
    life = result.life(NAME, "findley", residual=-1.5e8)
    (note,) = [note for note in life.notes if "beyond yield" in note]
    assert "von Mises exceeds the yield stress of" in note
    factor = result.load_factors(S_Y, residual=-1.5e8).least("von_mises")
    assert fret._core.with_error(factor.value, factor.error) in note


def test_an_elastic_contact_has_no_note() -> None:
    """Nor one that yields in the run, whose stress is the right one."""
    assert flank(4e5, 3e-3).load_factors(S_Y).least().value > 1.0
    assert notes(flank(4e5, 3e-3)) == []
    yielded = flank(4e6, 3e-3, S_Y)
    assert float(yielded.largest_plastic_strain.max()) > 0.0
    assert notes(yielded) == []


def test_a_material_without_a_yield_stress_has_no_note() -> None:
    result = flank(4e6, 3e-3)
    ceramic = fret.fatigue.Material("ceramic", [("s_D", 1e8, "a test"), ("t_D", 6e7, "a test")])
    assert not any("beyond yield" in note for note in result.life(ceramic, "findley").notes)
