"""Laws of hardening: as values, in scene files, refused by name, and below a contact."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import pyfret as fret

LAWS = (
    fret.Plastic(s_y=900e6, voce_Q=200e6, voce_b=20.0),
    fret.Plastic(s_y=900e6, swift_e_0=4e-3, swift_n=0.2),
    fret.Plastic(s_y=900e6, chaboche_C=60e9, chaboche_gamma=400.0),
    fret.Plastic(
        s_y=900e6,
        hardening=1e9,
        voce_Q=1e8,
        voce_b=5.0,
        kinematic=2e9,
        chaboche_C=[60e9, 4e9],
        chaboche_gamma=[400.0, 20.0],
    ),
)


def scene(law: fret.Plastic, n: int = 24) -> fret.Scene:
    """A rigid ball on a body that yields."""
    material = fret.Elastic(E=210e9, nu=0.3, plastic=law)
    return fret.Scene(
        body1=fret.Body(fret.RIGID, shape=fret.Sphere(R=10e-3)),
        body2=fret.Body(material),
        friction=0.0,
        grid=fret.Grid.centred(width=6.4e-4, n=n),
    )


@pytest.mark.parametrize("law", LAWS, ids=["voce", "swift", "chaboche", "sum"])
def test_a_law_is_a_value_and_stands_in_scene_files(law: fret.Plastic) -> None:
    """Repr, exchange of a part and the scene file give it again."""
    assert eval(repr(law), vars(fret)) == law
    assert law.replace(s_y=800e6).replace(s_y=900e6) == law
    whole = scene(law).replace(path=fret.LoadPath.start().normal(1.0))
    assert fret.Scene.from_toml(whole.to_toml()).body2.substrate.plastic == law


def test_units_are_texts() -> None:
    """Units give the same law."""
    texts = fret.Plastic(
        s_y="900 MPa",
        voce_Q="0.2 GPa",
        voce_b=20,
        chaboche_C=["60 GPa", 4e9],
        chaboche_gamma=[400, 20],
    )
    assert (texts.s_y, texts.voce_Q) == (900e6, 200e6)
    assert texts.chaboche_C == [60e9, 4e9]
    whole = scene(LAWS[0]).replace(path=fret.LoadPath.start().normal(1.0)).to_toml()
    head, tail = whole.split("plastic = {")
    law = 's_y = "900 MPa", chaboche_C = ["60 GPa", "4 GPa"], chaboche_gamma = [400, 20]'
    read = fret.Scene.from_toml(f"{head}plastic = {{ {law} }}{tail[tail.index('}') + 1 :]}")
    assert read.body2.substrate.plastic.chaboche_C == [60e9, 4e9]


@pytest.mark.parametrize(
    ("numbers", "message"),
    [
        ({"s_y": 0.0}, r"plastic\.s_y = 0"),
        ({"s_y": -1.0}, r"plastic\.s_y"),
        ({"s_y": float("nan")}, r"plastic\.s_y = NaN"),
        ({"hardening": -1.0}, r"plastic\.hardening"),
        ({"hardening": float("nan")}, r"plastic\.hardening = NaN"),
        ({"kinematic": -1.0}, r"plastic\.kinematic"),
        ({"voce_Q": 1e8}, r"plastic\.voce_b = 0: must be positive"),
        ({"voce_b": 1.0}, r"plastic\.voce_Q"),
        ({"voce_Q": -1e8, "voce_b": 1.0}, r"plastic\.voce_Q"),
        ({"swift_n": 0.2}, r"plastic\.swift_e_0"),
        ({"swift_n": 2.0, "swift_e_0": 1e-3}, r"plastic\.swift_n = 2: must be 0 \(none\) to 1"),
        ({"chaboche_gamma": 10.0}, r"plastic\.chaboche_C\[0\]"),
        ({"chaboche_C": [1e9, -1e9]}, r"plastic\.chaboche_C\[1\]"),
        ({"chaboche_C": [1e9] * 4}, "chaboche_C = 4 numbers: must be at most 3"),
        ({"s_y": "900 N"}, "must be a number in Pa"),
    ],
)
def test_numbers_without_meaning_are_refused_by_name(numbers: dict[str, Any], message: str) -> None:
    """Each by its name."""
    with pytest.raises(ValueError, match=message):
        fret.Plastic(**{"s_y": 900e6, **numbers})


def test_an_unknown_number_has_its_nearest_name() -> None:
    """A slip of the pen."""
    with pytest.raises(TypeError, match="the nearest is 'voce_Q'"):
        fret.Plastic(s_y=1e9, voce_q=1e8)


@pytest.mark.parametrize(
    "law", [fret.Plastic(s_y=1e8), fret.Plastic(s_y=4e7, voce_Q=6e7, voce_b=9.0)]
)
def test_more_than_the_hardness_is_refused_with_its_load(law: fret.Plastic) -> None:
    """A hardening that ends bears 2.8 of its largest yield stress, no more."""
    whole = scene(law)
    with pytest.raises(ValueError, match=r"body2\.plastic\.hardening.*a W of at most .* N.*2\.8"):
        fret.solve(whole, fret.LoadPath.start().normal(100.0), progress=False)


@pytest.mark.solves
def test_more_hardening_yields_less() -> None:
    """A law that saturates yields more than a linear one of the same initial slope."""
    path = fret.LoadPath.start().normal(150.0, increments=3).normal(2.0, increments=1)
    strain = {}
    laws = {
        "perfect": fret.Plastic(s_y=900e6),
        "voce": fret.Plastic(s_y=900e6, voce_Q=200e6, voce_b=100.0),
        "chaboche": fret.Plastic(s_y=900e6, chaboche_C=20e9, chaboche_gamma=100.0),
        "linear": fret.Plastic(s_y=900e6, hardening=20e9),
    }
    for name, law in laws.items():
        result = fret.solve(scene(law), path, progress=False)
        strain[name] = float(result.largest_plastic_strain.max())
        assert float(result.plastic_work.sum()) > 0.0
        assert result.at(-1).plastic.volume() > 0.0
        assert result.unloaded().is_elastic
    assert strain["perfect"] > strain["voce"] > strain["linear"]
    # One stroke: isotropic and kinematic hardening of one curve are alike where flow hardly turns.
    np.testing.assert_allclose(strain["voce"], strain["chaboche"], rtol=0.05)


#: Numbers of a body in units that are hardly Pa and m: law of yielding, residual stress.
ODD: dict[str, dict[str, object]] = {
    "chaboche_C in GPa": {"chaboche_C": [60, 4], "chaboche_gamma": [400, 20]},
    "chaboche_C in MPa": {"chaboche_C": [260e3], "chaboche_gamma": [400]},
    "voce_Q in MPa": {"voce_Q": 60, "voce_b": 8},
    "hardening in MPa": {"hardening": 500e3},
    "kinematic in GPa": {"kinematic": 20},
    "kinematic stiffer than elastic": {"kinematic": 1e12},
    "voce_Q beyond strength": {"voce_Q": 60e9, "voce_b": 8},
    "s_y beyond strength": {"s_y": 90e9},
    "s_y in MPa": {"s_y": 900},
}


@pytest.mark.parametrize("name", ODD)
def test_a_hardening_law_in_other_units_is_doubted(name: str) -> None:
    law = fret.Plastic(**{"s_y": 1e9, "hardening": 5e9, **ODD[name]})
    steel = fret.Elastic(E=210e9, nu=0.3)
    body = fret.Body(steel.replace(plastic=law))
    assert any(".plastic." in doubt for doubt in doubts_of(body)), name
    usual = fret.Plastic(
        s_y=300e6,
        hardening=2e9,
        voce_Q=50e6,
        voce_b=8,
        kinematic=1e9,
        chaboche_C=[60e9],
        chaboche_gamma=[400],
    )
    assert doubts_of(fret.Body(steel.replace(plastic=usual))) == []


@pytest.mark.parametrize(
    ("rows", "is_odd"),
    [
        ([[0, -600e6], [50, -750e6], [200, 0]], True),
        ([[0, -600e6], [0.05, -750e6], [0.2, 0]], True),
        ([[0, -600], [5e-5, -750], [2e-4, 0]], True),
        (-2e12, True),
        ([[0, -600e6], [5e-5, -750e6], [2e-4, 0]], False),
        (-600e6, False),
    ],
)
def test_residual_stress_in_other_units_is_doubted(rows: object, *, is_odd: bool) -> None:
    body = fret.Body(fret.Elastic(E=210e9, nu=0.3), residual=rows)
    assert any("residual" in doubt for doubt in doubts_of(body)) == is_odd


def doubts_of(body: fret.Body) -> list[str]:
    """Return the doubts of a body under a rigid ball."""
    scene = fret.Scene(
        body1=fret.Body(fret.RIGID, shape=fret.Sphere(R=0.01)),
        body2=body,
        friction=0.0,
        grid=fret.Grid.centred(width=3.6e-4, n=40),
        path=fret.LoadPath.start().normal(20.0, increments=2),
    )
    return scene.doubts()
