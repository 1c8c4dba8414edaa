"""Numbers that are hardly meant, or that switch an effect off, are not taken in silence."""

from __future__ import annotations

import inspect
import math
import re
import warnings
from typing import Any

import numpy as np
import pytest

import pyfret as fret
from pyfret import fatigue, reference, shapes
from pyfret.fatigue.ranges import known_as

STEEL = fret.Elastic(E=210e9, nu=0.3)
R, W = 8e-3, 60.0
PRESSED = fret.LoadPath.start().normal(W, increments=1)


def scene_of(shape: Any, path: fret.LoadPath = PRESSED) -> fret.Scene:
    bodies = fret.Body(STEEL, shape=fret.Sphere(R=R)), fret.Body(STEEL, shape=shape)
    grid = fret.Grid.centred(width=4e-4, n=16)
    return fret.Scene(body1=bodies[0], body2=bodies[1], friction=0.3, grid=grid, path=path)


#: Shapes with an angle, and their other parameters.
ANGLED: dict[str, dict[str, Any]] = {
    "Cylinder": {"R": 0.01},
    "CrownedRoller": {"R": 0.01, "length": 1e-3, "crown": 0.1},
    "Ellipsoid": {"R_x": 0.01, "R_y": 0.02},
    "Wedge": {"slope": 0.01},
    "Ridges": {"R": 0.01, "spacing": 1e-4},
    "Waviness": {"amplitude": 1e-8, "wavelength": 1e-4},
}


@pytest.mark.parametrize("name", ANGLED)
def test_an_angle_beyond_a_turn_is_doubted_with_both_readings(name: str) -> None:
    shape = getattr(shapes, name, None) or getattr(fret, name)
    angles = [key for key in inspect.signature(shape).parameters if key in ("angle", "phase")]
    assert angles
    for key in angles:
        for made in (
            shape(**ANGLED[name], **{key: 90}),
            fret.Sphere(R=0.1) + shape(**ANGLED[name], **{key: 90}),
        ):
            doubts = [d for d in scene_of(made).doubts() if f"{key} = 90" in d]
            assert doubts, (name, key)
            assert '"90 deg"' in doubts[0]
            assert "1.570796" in doubts[0]
        turned = shape(**ANGLED[name], **{key: "90 deg"})
        assert getattr(turned, key) == pytest.approx(math.pi / 2)
        assert not any(key in d for d in scene_of(turned).doubts())


def test_every_shape_with_an_angle_is_in_the_list() -> None:
    classes = {n: getattr(shapes, n) for n in shapes.__all__} | {"Cylinder": fret.Cylinder}
    angled = {
        name
        for name, shape in classes.items()
        if inspect.isclass(shape) and "angle" in inspect.signature(shape).parameters
    }
    assert angled == set(ANGLED)


@pytest.mark.parametrize("name", ["phi_x", "phi_y", "phi_z"])
def test_a_rotation_beyond_a_turn_is_doubted(name: str) -> None:
    path = PRESSED.displace(**{name: 45.0}, increments=1)
    doubts = scene_of(shapes.Flat(), path).doubts()
    assert any(f"{name} = 45" in doubt and '"45 deg"' in doubt for doubt in doubts)


@pytest.mark.parametrize("number", [1, 2])
def test_a_direction_of_a_bulk_stress_beyond_a_turn_is_doubted(number: int) -> None:
    scene = scene_of(shapes.Flat())
    name = f"body{number}"
    for azimuth, doubted in ((45.0, True), ("45 deg", False)):
        body = fret.Body(STEEL, shape=getattr(scene, name).shape, bulk_azimuth=azimuth)
        doubts = scene.replace(**{name: body}).doubts()
        key = f"{name}.bulk_azimuth = 45"
        assert any(key in doubt and '"45 deg"' in doubt for doubt in doubts) is doubted


@pytest.mark.parametrize("name", ["delta_x", "delta_y"])
def test_a_shift_of_metres_is_refused(name: str) -> None:
    path = PRESSED.displace(**{name: 3.0}, increments=1)
    refusal = rf"{name} = 3.*must be at most.*3 um is 3e-6"
    scene = scene_of(shapes.Flat(), path)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with pytest.raises(fret.errors.InvalidSceneError, match=refusal):
            fret.solve(scene, progress=False)


def closed_forms() -> list[tuple[str, Any, dict[str, Any]]]:
    """Forms that take bodies beside a radius, or beside a contact that has one."""
    hertz = reference.hertz(R=R, bodies=(STEEL, STEEL), W=W)
    film = fret.Coating(fret.Elastic(E=400e9, nu=0.25), thickness=2e-5)
    return [
        ("hertz", lambda a, b: reference.hertz(R=R, bodies=(a, b), W=W), {}),
        ("line_contact", lambda a, b: reference.line_contact(R=R, bodies=(a, b), W=2e4), {}),
        (
            "CattaneoMindlin",
            lambda a, b: reference.CattaneoMindlin(hertz, bodies=(a, b), mu=0.3),
            {},
        ),
        ("Lubkin", lambda a, b: reference.Lubkin(hertz, bodies=(a, b), mu=0.3), {}),
        ("Springs", lambda a, b: reference.Springs(hertz, R=R, bodies=(a, b), mu=0.3, n=50), {}),
        (
            "coated_indentation",
            lambda a, b: reference.coated_indentation(
                R=R, indenter=a, coating=film, substrate=b, W=W
            ),
            {},
        ),
    ]


def test_the_list_of_forms_with_bodies_is_whole() -> None:
    taking = {
        name
        for name in reference.__all__
        if {"bodies", "indenter"} & set(inspect.signature(getattr(reference, name)).parameters)
        and name != "LineContact"
    }
    assert taking == {name for name, *_ in closed_forms()}


@pytest.mark.parametrize("form", closed_forms(), ids=lambda form: form[0])
def test_a_closed_form_takes_no_body_of_another_shape(form: tuple[str, Any, Any]) -> None:
    name, make, _ = form
    right = fret.Cylinder(R) if name == "line_contact" else fret.Sphere(R=R)
    flat = fret.Body(STEEL)
    for good in (flat, fret.Body(STEEL, shape=right)):
        make(good, STEEL)
        make(good, flat)
    wrong = [fret.Sphere(R=5e-3), fret.Cylinder(5e-3), shapes.Ellipsoid(R_x=R, R_y=2 * R)]
    wrong.append(fret.Sphere(R=R) if name == "line_contact" else fret.Cylinder(R))
    for shape in wrong:
        with pytest.raises(ValueError, match=r"R = .* differs from the radius of the bodies"):
            make(fret.Body(STEEL, shape=shape), STEEL)
    # The curvatures of both bodies add up.
    with pytest.raises(ValueError, match="differs from the radius of the bodies"):
        make(fret.Body(STEEL, shape=right), fret.Body(STEEL, shape=right))


def reversed_history(residual: float) -> np.ndarray:
    """Bending with some shear, fully reversed, on a residual stress along the surface [Pa]."""
    stress = np.zeros((2, 6))
    stress[:, 0] = [200e6, -200e6]
    stress[:, 4] = [60e6, -60e6]
    stress[:, :2] += residual
    return stress


def test_peening_changes_every_margin_or_the_note_has_the_reason() -> None:
    """All criteria with a mean stress, for all materials of the table that have the numbers."""
    blind, seeing = set(), set()
    for material in fatigue.Materials().values():
        for criterion in fatigue.CRITERIA:
            try:
                assessment = material.assessment(criterion)
            except ValueError:
                continue
            fields = [
                fatigue.evaluate_margin(reversed_history(residual), material, criterion)
                for residual in (0.0, -500e6)
            ]
            if "life" in fields[0]:
                # Margins beyond 1e7 cycles are all infinite; the curve goes on.
                margins = [assessment.life(float(m.value)) for m in fields]
                for m, life in zip(fields, margins, strict=True):
                    assert float(m.life) == (life if life <= 1e7 else np.inf)
                assert np.isfinite(margins[0])
            else:
                margins = [float(m.safety_factor) for m in fields]
            note = assessment.mean_stress_note(material)
            changed = margins[1] > margins[0] * (1.0 + 1e-9)
            assert changed == (note is None), (material.name, criterion, margins, note)
            (seeing if changed else blind).add((material.name, criterion))
            if note is not None:
                assert f"t_D of {material.name} is an estimate" in note
                assert "dang_van" in note
                assert note in assessment.range_at(1e8, 0.0, material)[3]
    assert ("titanium_6Al4V", "crossland") in blind
    assert {criterion for _, criterion in blind} == {"crossland"}
    assert ("steel_42CrMo4", "crossland") in seeing
    assert len(seeing) > 50


@pytest.mark.parametrize(
    ("settings", "value"),
    [
        ({"preset": "spinu2020"}, fret.settings.Preset.SPINU2020),
        ({"preset": "FAST"}, fret.settings.Preset.FAST),
        ({"kernel": "hankel"}, fret.settings.Hankel()),
        ({"kernel": "inverse_fft"}, fret.settings.InverseFft()),
        ({"kernel": "frequency_domain"}, fret.settings.FrequencyDomain()),
    ],
)
def test_a_choice_takes_its_text(settings: dict[str, Any], value: Any) -> None:
    (name,) = settings
    made = fret.Settings(**settings)
    assert getattr(made, name) == value
    scene = scene_of(shapes.Flat()).replace(settings=made)
    assert getattr(fret.Scene.from_toml(scene.to_toml()).settings, name) == value
    with pytest.raises(ValueError, match=rf"{name} = 'nothing': must be one of"):
        fret.Settings(**{name: "nothing"})
    with pytest.raises(TypeError, match=f"{name} = 5"):
        fret.Settings(**{name: 5})


def test_members_of_an_enumeration_take_their_names() -> None:
    branch = fret.Branch(W=1.0, spacing="equal_radius", t=1.0)
    assert branch.spacing == fret.Spacing.EQUAL_RADIUS
    with pytest.raises(ValueError, match=r"spacing.*must be one of.*uniform"):
        fret.Branch(W=1.0, spacing="even", t=1.0)


def test_every_criterion_with_an_estimated_limit_names_it() -> None:
    """Criteria with a hydrostatic or normal stress: their notes have the limits by a rule."""
    criteria = set()
    for material in fatigue.Materials().values():
        sources = {name: source for name, _, source in material.numbers()}
        if known_as(sources.get("t_D", "")) != "estimate":
            continue
        for criterion in ("crossland", "dang_van", "findley", "matake", "mcdiarmid"):
            notes = material.assessment(criterion).range_at(1.0, 0.0, material)[3]
            text = "; ".join(notes)
            assert re.search(rf"t_D of {material.name} (is|are) (an )?estimate", text), text
            criteria.add(criterion)
    assert len(criteria) == 5
