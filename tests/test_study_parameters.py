"""Parameters of studies: quantities in SI whatever their form, and one rule for their names."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyfret as fret
from pyfret._util.parameters import in_si, one_of, opposite, part
from pyfret.study import file
from pyfret.study.design import Design, with_values
from pyfret.study.store import POINT_VARIABLES, empty_dataset

SCENE = """schema = 1
body1 = { shape = { sphere = { R = 5e-3 } }, E = 210e9, nu = 0.3 }
friction = { mu = 0.3 }
grid = { n = 8, extent = 2e-4 }
path = [{ W = 10.0, increments = 1 }]

[body2]
shape = "flat"
E = 210e9
nu = 0.3
coatings = [{ thickness = 2e-6, E = 300e9, nu = 0.25 }]
"""
THICKNESS = "body2.coatings.0.thickness"
#: A key of each kind of quantity, a text, and its number in SI.
QUANTITIES = [
    (THICKNESS, "2 um", 2e-6),
    ("body2.coatings[0].thickness", "2 um", 2e-6),
    ("body2.coatings.0.E", "400 GPa", 400e9),
    ("body1.shape.sphere.R", "5 mm", 5e-3),
    ("path.*.W", "1 kN", 1e3),
    ("path.1.T_x,-path.2.T_x", "-2 N", -2.0),
    ("grid.extent", "0.2 mm", 2e-4),
]
#: Keys whose texts are none.
TEXTS = [
    ("body2.coatings.0.material", "steel_52100"),
    ("path.file", "load2.csv"),
    ("body2.shape", "flat"),
    ("output.save", "all"),
]


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    path = tmp_path / "s.toml"
    path.write_text(SCENE)
    return path


def solved(scene: Any, parameters: dict[str, Any], **options: Any) -> fret.study.Study:
    return fret.study.run(
        scene,
        parameters,
        measure="p_max",
        executor=ThreadPoolExecutor(1),
        progress=False,
        **options,
    )


@pytest.mark.parametrize(("key", "text", "number"), QUANTITIES)
def test_a_quantity_is_a_number_in_si(key: str, text: str, number: float) -> None:
    for design in (
        Design.from_values({key: [text]}, "grid"),
        Design.from_values({key: [number]}, "grid"),
    ):
        assert design.coords()[key].values.tolist() == [number]
    assert file.read_values([text], key, "f.toml") == [text]
    spaced = file.read_values({"from": text, "to": text, "n": 2}, key, "f.toml")
    assert [in_si(key, value) for value in spaced] == pytest.approx([number, number], rel=1e-12)


@pytest.mark.parametrize(("key", "text"), TEXTS)
def test_a_text_that_is_no_quantity_stays(key: str, text: str) -> None:
    assert in_si(key, text) == text
    with pytest.raises(ValueError, match="must be a number"):
        file.read_values({"from": text, "to": text, "n": 2}, key, "f.toml")


def test_a_unit_of_something_else_is_refused() -> None:
    with pytest.raises(ValueError, match=rf'{THICKNESS} = "2 MPa": must be a number in m'):
        Design.from_values({THICKNESS: ["2 MPa"]}, "grid")
    with pytest.raises(ValueError, match=r"parameters.body2.*from: .*must be a number in m"):
        file.read_values({"from": "2 MPa", "to": 1.0, "n": 2}, THICKNESS, "f.toml")


def test_a_function_gets_numbers_for_texts_with_units() -> None:
    values = {"thickness": ["1 um", "2 um"], "film": ["TiN", "100Cr6"], "mixed": ["1 um", "thin"]}
    design = Design.from_values(values, "grid", keys=False)
    assert design.parameters["thickness"] == pytest.approx([1e-6, 2e-6])
    assert design.values(0) == {"thickness": 1e-6, "film": "TiN", "mixed": "1 um"}


@pytest.mark.parametrize(("text", "other"), [("2 N", "-2 N"), ("-2 N", "2 N"), (2.0, -2.0)])
def test_the_opposite_of_a_text(text: Any, other: Any) -> None:
    assert opposite(text) == other


@pytest.mark.solves
def test_a_study_over_texts_is_the_one_over_numbers(scene: Path, tmp_path: Path) -> None:
    """The coordinates, the numbers and the store; a map of a part takes both forms, too."""
    path = tmp_path / "st.zarr"
    options = solved(scene, {THICKNESS: ["2 um", "4 um"], "friction.mu": [0.3, 0.5]}, out=path)
    plain = {THICKNESS: [2e-6, 4e-6], "friction.mu": [0.3, 0.5]}
    # It goes on with the same store.
    again = solved(scene, plain, out=path)
    assert options.dataset[THICKNESS].values.tolist() == plain[THICKNESS]
    np.testing.assert_array_equal(options.dataset["p_max"], again.dataset["p_max"])
    assert not np.isnan(options.dataset["p_max"]).any()
    # A part is asked for by any name of the parameter, in any form of its value.
    for at in ({"mu": 0.5}, {"friction.mu": 0.48}):
        drawn = fret.open(path).map(at=at).lines[0].get_ydata()
        np.testing.assert_allclose(drawn, options.dataset["p_max"][:, 1] / 1e6)
    for at in ({THICKNESS: 4e-6}, {THICKNESS: "4 um"}, {"body2.coatings[0].thickness": "4 um"}):
        drawn = options.map(at=at).lines[0].get_ydata()
        np.testing.assert_allclose(drawn, options.dataset["p_max"][1] / 1e6)
    with pytest.raises(ValueError, match=rf"no parameter 'muu'.*\(of {THICKNESS}, friction.mu\)"):
        options.map(at={"muu": 0.5})
    with pytest.raises(ValueError, match="must be a number in m"):
        options.map(at={THICKNESS: "4 MPa"})


@pytest.mark.parametrize("known", ["mu", "friction.mu"])
@pytest.mark.parametrize("name", ["mu", "friction.mu"])
def test_a_short_name_and_its_key_are_one(known: str, name: str) -> None:
    assert one_of(["a", known], name, "at") == known


def test_a_part_of_texts_and_of_samples() -> None:
    """A text is taken as it is, without quotes; samples have no part."""
    key = "body2.coatings.0.material"
    item = Design.from_values({key: ["TiN", "CrN"], "mu": [0.1, 0.2]}, "grid")
    assert str(part(empty_dataset(item, {}, POINT_VARIABLES), {key: "CrN"})[key].values) == '"CrN"'
    with pytest.raises(ValueError, match='must be one of "TiN", "CrN"'):
        part(empty_dataset(item, {}, POINT_VARIABLES), {key: "DLC"})
    with pytest.raises(ValueError, match="must be a number"):
        part(empty_dataset(item, {}, POINT_VARIABLES), {"mu": "low"})
    samples = Design.from_values({key: ["TiN", "CrN"], "mu": [0.1, 0.2]}, "zip")
    with pytest.raises(ValueError, match="changes together with others"):
        part(empty_dataset(samples, {}, POINT_VARIABLES), {"friction.mu": 0.1})


@pytest.mark.solves
def test_a_force_per_length_is_none_of_a_ball(scene: Path) -> None:
    with pytest.raises(ValueError, match="no point of the study has a scene"):
        solved(scene, {"path.0.W": ["10 N/mm"]})


@pytest.mark.solves
def test_a_threshold_over_texts_is_the_one_over_numbers(scene: Path) -> None:
    """The load of a largest pressure over the thickness, with and without units."""
    item = [
        fret.study.threshold(
            scene,
            "path.0.W",
            measure=lambda result: float(result.at(-1).p.max()),
            value=1.04e09,
            between=(8.0, 13.0),
            over={THICKNESS: thickness},
            tolerance=0.1,
            error=False,
        )
        for thickness in (["2 um"], [2e-6])
    ]
    assert item[0].equals(item[1])


@pytest.mark.parametrize(
    ("name", "given", "right"),
    [
        ("body2.coatings.0.E", {"from": "100 GPa", "to": "0.3e12 Pa", "n": 3}, [1e11, 2e11, 3e11]),
        (THICKNESS, {"from": "1 um", "to": "4 um", "n": 3, "scale": "log"}, [1e-6, 2e-6, 4e-6]),
        ("mu", {"from": 0.1, "to": 0.3, "n": 3}, [0.1, 0.2, 0.3]),
    ],
)
def test_a_range_keeps_the_unit_that_it_was_given_in(
    name: str, given: dict[str, object], right: list[float]
) -> None:
    computed = file.read_values(given, name, "study.toml")
    unit = str(given["from"]).partition(" ")[2]
    assert all(str(value).endswith(unit) for value in computed)
    assert [in_si(name, value) for value in computed] == pytest.approx(right, rel=1e-12)


def test_a_range_of_forces_per_length_is_refused_on_a_ball(scene: Path) -> None:
    forces = file.read_values({"from": "1 N/mm", "to": "2 N/mm", "n": 2}, "path.0.W", "study.toml")
    for force in forces:
        with pytest.raises(fret.errors.InvalidSceneError, match="the contact is no line"):
            with_values(scene, {"path.0.W": force})
