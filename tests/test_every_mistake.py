"""Every mistake of a scene is listed at once, with its line, and quantities have their units."""

from __future__ import annotations

import json
import re
import subprocess
from pathlib import Path

import pytest

import pyfret as fret

ROOT = Path(__file__).parents[1]
FRET = ROOT / "target" / "release" / "fret"

#: A ball on a coated flat.
GOOD = """schema = 1
title = "ball"

[body1]
shape.sphere.R = 5e-3
E = 210e9
nu = 0.3

[body2]
shape = "flat"
E = 210e9
nu = 0.3

[[body2.coatings]]
E = 380e9
nu = 0.2
thickness = 3e-6

[friction]
mu = 0.15

[grid]
n = 64
extent = { a_H = 2.4 }

[[path]]
W = 10
increments = 4

[[path]]
T_x = 1.0
increments = 4
"""

#: The wrong text, the right text, its line and the message.
MISTAKES = [
    ("schema = 1\n", "\n", 1, "schema is missing"),
    ("E = 210e9\nnu = 0.3\n\n[body2]", "E = 210e9\nnu = 0.6\n\n[body2]", 7, "body1.nu = 0.6"),
    ('shape = "flat"', 'shape = "flot"', 10, "body2.shape"),
    ("E = 380e9", 'E = "380 GPA"', 15, "a text with its unit (Pa, kPa"),
    (
        "thickness = 3e-6",
        "thicknes = 3e-6",
        17,
        "nearest valid key is `body2.coatings[0].thickness`",
    ),
    ("mu = 0.15", 'mu = "0.15"', 20, "friction.mu"),
    ("n = 64", "n = 0", 23, "grid.n = 0: must be a whole number >= 1"),
    ("W = 10\n", 'W = "10 m"\n', 27, "a number in N, a text with its unit (N, "),
    ("T_x = 1.0\nincrements = 4", "T_x = 1.0\nincrements = 4.5", 32, "path[1].increments = 4.5"),
]


def broken(mistakes: list[tuple[str, str, int, str]]) -> str:
    text = GOOD
    for right, wrong, *_ in mistakes:
        assert right in text, right
        text = text.replace(right, wrong, 1)
    return text


@pytest.mark.parametrize("skipped", range(len(MISTAKES) + 1))
def test_all_mistakes_are_told_in_one_round(skipped: int) -> None:
    mistakes = [item for n, item in enumerate(MISTAKES) if n != skipped]
    with pytest.raises(fret.errors.InvalidSceneError) as refused:
        fret.Scene.from_toml(broken(mistakes))
    lines = str(refused.value).splitlines()
    assert len(lines) == len(mistakes), str(refused.value)
    for line, (_, _, number, expected) in zip(lines, mistakes, strict=True):
        assert line.startswith(f"scene:{number}: "), line
        assert expected in line


@pytest.mark.parametrize("mistake", MISTAKES)
def test_one_mistake_is_one_line(mistake: tuple[str, str, int, str]) -> None:
    with pytest.raises(fret.errors.InvalidSceneError) as refused:
        fret.Scene.from_toml(broken([mistake]))
    assert len(str(refused.value).splitlines()) == 1


def test_doubts_are_told_beside_mistakes() -> None:
    text = GOOD.replace("R = 5e-3", "R = 5").replace("E = 380e9", "E = 380")
    with pytest.raises(fret.errors.InvalidSceneError) as refused:
        fret.Scene.from_toml(text.replace("n = 64", "n = 0").replace("mu = 0.15", "mu = 15"))
    lines = str(refused.value).splitlines()
    assert "grid.n = 0" in lines[0]
    doubts = ("body1.shape.R = 5 m", "coatings[0].E = 380 Pa", "friction.mu = 15")
    assert len(lines) == 1 + len(doubts)
    for line, doubt in zip(sorted(lines[1:]), sorted(doubts), strict=True):
        assert line.startswith("doubtful: ")
        assert doubt in line


def test_a_value_that_depends_on_a_mistake_is_no_mistake() -> None:
    """A force is within friction or not once the friction is known."""
    with pytest.raises(fret.errors.InvalidSceneError) as refused:
        fret.Scene.from_toml(
            GOOD.replace("mu = 0.15", "muu = 0.15").replace("W = 10\n", "W = -1\n")
        )
    lines = str(refused.value).splitlines()
    assert len(lines) == 2
    assert "friction.mu" in lines[0]
    assert "path[0].W = -1" in lines[1]


def test_quantities_have_units() -> None:
    text = (
        GOOD.replace("E = 210e9", 'E = "210 GPa"')
        .replace("R = 5e-3", 'R = "5 mm"')
        .replace("thickness = 3e-6", 'thickness = "3 µm"')
        .replace("extent = { a_H = 2.4 }", 'extent = "2.4 a_H"')
        .replace("W = 10\n", 'W = "0.01 kN"\n')
    )
    right, computed = fret.Scene.from_toml(GOOD), fret.Scene.from_toml(text)
    assert computed.body1.substrate == right.body1.substrate
    assert computed.grid.dx == pytest.approx(right.grid.dx, rel=1e-12)
    assert computed.path.W.tolist() == pytest.approx(right.path.W.tolist())
    assert fret.Scene.from_toml(GOOD, set=["path.0.W=0.01 kN"]).path.W[-1] == pytest.approx(10)


def test_a_material_has_its_name() -> None:
    """Names work in a file and by `set`, in bodies and coatings, as in `fret.material`."""
    table, film = fret.fatigue.Materials(), "body2.coatings.0"
    for name in ("titanium_6Al4V", "Ti-6Al-4V", "steel", "TiN"):
        scene = fret.Scene.from_toml(GOOD, set=[f"{film}.material={name}"])
        assert fret.Scene.from_toml(scene.to_toml()) == scene
        # E and nu of the file belong to the old material.
        material, layer = table[name], scene.body2.coatings[0].material
        assert layer.E == material.number("E") != 380e9
        assert layer.nu == (material.number("nu") or layer.nu)
    by_name = re.sub(r"(\[body1\][^[]*?)E = 210e9\nnu = 0.3", r'\1material = "Ti-6Al-4V"', GOOD)
    assert by_name != GOOD
    assert fret.Scene.from_toml(by_name).body1.substrate == fret.Elastic(
        E=table["Ti-6Al-4V"].number("E"), nu=table["Ti-6Al-4V"].number("nu")
    )
    with pytest.raises(
        fret.errors.InvalidSceneError, match=r"nearest are titanium_6Al4V"
    ) as refused:
        fret.Scene.from_toml(by_name.replace("Ti-6Al-4V", "Ti-6Al-V4"))
    line = by_name[: by_name.index("material =")].count("\n") + 1
    assert f":{line}: body1.material" in str(refused.value)


def test_the_load_of_a_line_is_per_length() -> None:
    line = (ROOT / "crates/fret-cli/templates/cylinder.toml").read_text()
    scene = fret.Scene.from_toml(line, set=["path.0.W=300 N/mm"])
    assert scene.path.branches[0].W == 3e5
    with pytest.raises(fret.errors.InvalidSceneError, match="a force per length"):
        fret.Scene.from_toml(line, set=["path.0.W=300 N"])
    with pytest.raises(fret.errors.InvalidSceneError, match="the contact is no line"):
        fret.Scene.from_toml(GOOD, set=["path.0.W=300 N/mm"])


def run(*arguments: str | Path, text: str | None = None) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [FRET, "check", *arguments], input=text, capture_output=True, text=True, check=False
    )


def test_check_prints_each_mistake_on_its_line(tmp_path: Path) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(broken(MISTAKES))
    ran = run(file)
    assert ran.returncode == 2
    lines = ran.stderr.splitlines()
    assert [line.split(": ")[1] for line in lines] == [f"{file}:{item[2]}" for item in MISTAKES]
    answer = json.loads(run(file, "--json").stdout)
    assert [item["line"] for item in answer["errors"]] == [item[2] for item in MISTAKES]


def test_strict_exits_with_one_on_a_doubt() -> None:
    assert run("-", "--strict", text=GOOD.replace("n = 64", "n = 512")).returncode in (0, 1)
    doubtful = GOOD.replace("mu = 0.15", "mu = 15")
    assert run("-", text=doubtful).returncode == 0
    strict = run("-", "--strict", text=doubtful)
    assert strict.returncode == 1
    assert "(--strict)" in strict.stderr


def test_json_has_numbers() -> None:
    answer = json.loads(run("-", "--json", text=GOOD).stdout)
    scene = fret.Scene.from_toml(GOOD)
    assert scene.hertz is not None
    assert answer["a_H"] == pytest.approx(scene.hertz.a)
    assert answer["cells_per_a_H"][0] == pytest.approx(scene.hertz.a / scene.grid.dx)
    assert answer["grid"]["n"] == [64, 64]
    assert answer["path"]["increments"] == [8, 8]
    assert answer["convolutions"][0] < answer["convolutions"][1]
    assert 0 < answer["memory"]["needed"] < answer["memory"]["available"]
    shared = answer["memory"]["answers"]
    assert 0 < shared["sections"] < 128e6
    assert shared["kernels"] > 0
    assert 0 < shared["cycle"] < 250e6
    assert answer["errors"] == []
    # Each number has a unit.
    units = answer["units"]
    assert set(units) == {name for name in numbers_of(answer) if not name.startswith("units")}


def numbers_of(numbers: dict[str, object], within: str = "") -> set[str]:
    """Names of the numbers of an answer, and of the lists of them."""
    names: set[str] = set()
    for name, value in numbers.items():
        first = value[0] if isinstance(value, list) and value else value
        if isinstance(value, dict):
            names |= numbers_of(value, f"{within}{name}.")
        elif isinstance(first, int | float) and not isinstance(first, bool):
            names.add(f"{within}{name}")
    return names


class Quantity:
    """A quantity as pint gives it: a magnitude and units that write themselves."""

    def __init__(self, magnitude: float, units: str) -> None:
        self.magnitude = magnitude
        self.units = Units(units)

    def __float__(self) -> float:
        raise TypeError("cannot be a number: it has a dimension")


class Units(str):
    def __format__(self, kind: str) -> str:
        assert kind == "~P"
        return str(self)


def test_quantities_are_taken_where_numbers_are() -> None:
    q = Quantity
    assert fret.Elastic(E=q(380.0, "GPa"), nu=0.2) == fret.Elastic(E="380 GPa", nu=0.2)  # type: ignore[arg-type]
    assert pytest.approx(380e9) == fret.Elastic(E=q(380.0, "GPa"), nu=0.2).E  # type: ignore[arg-type]
    film = fret.Coating(fret.Elastic(E=3e11, nu=0.2), thickness=q(3, "µm"))  # type: ignore[arg-type]
    assert film.thickness == pytest.approx(3e-6)
    assert pytest.approx(5e-3) == fret.Sphere(q(5.0, "mm")).R  # type: ignore[arg-type]
    path = fret.LoadPath.start().normal(q(10.0, "N"), increments=1)  # type: ignore[arg-type]
    path = path.cycles(1, delta_x=q(2.0, "µm"), increments=4)  # type: ignore[arg-type]
    assert path.branches[0].W == 10.0
    assert path.branches[1].delta_x == pytest.approx(2e-6)
    with pytest.raises(ValueError, match=r"3.0 N.: must be a number in m"):
        fret.Sphere(q(3.0, "N"))  # type: ignore[arg-type]


def test_pint_is_understood() -> None:
    pint = pytest.importorskip("pint")
    unit = pint.UnitRegistry()
    assert pytest.approx(210e9) == fret.Elastic(E=210 * unit.GPa, nu=0.3).E
    assert pytest.approx(5e-3) == fret.Sphere(5 * unit.mm).R


@pytest.mark.parametrize(
    ("call", "nearest"),
    [
        (lambda: fret.Body(fret.RIGID, coating=[]), "coatings"),
        (lambda: fret.Elastic(e=1e9, nu=0.3, E=1e9), "E"),
        (lambda: fret.Coating(fret.RIGID, thicknes=1e-6, thickness=1e-6), "thickness"),
        (lambda: fret.LoadPath.start().cycles(1, T=3.0), "T_x"),
        (
            lambda: fret.Scene(
                body1=fret.Body(fret.RIGID, shape=fret.Sphere(1.0)),
                body2=fret.Body(fret.Elastic(E=1e9, nu=0.3)),
                friction=0.3,
                grid=fret.Grid.centred(width=1e-3, n=8),
                setting=None,
            ),
            "settings",
        ),
    ],
)
def test_an_unknown_argument_has_its_nearest(call: object, nearest: str) -> None:
    with pytest.raises(TypeError, match=f"the nearest is '{nearest}'"):
        call()  # type: ignore[operator]


#: A cycle, and what it wears.
WORN = """
[[path]]
T_x = -1.0
increments = 4

[[path]]
T_x = 1.0
increments = 4

[wear]
cycles = 1e4

[wear.body2]
k = 1e-14
"""


def test_the_table_of_wear_is_checked_with_the_rest() -> None:
    """Every mistake of all sections in one round, at its line; a doubt; and nothing where none."""
    good = run("-", text=GOOD + WORN)
    assert good.returncode == 0, good.stderr
    assert "wear          body 2 over 10000 cycles" in good.stdout
    wrong = (
        (GOOD + WORN)
        .replace("cycles = 1e4", 'cyclng = "march"\ncycles = 1e4')
        .replace("k = 1e-14", 'k = "3 um"\nthreshhold = 0.0')
        .replace("mu = 0.15", "mmu = 0.15")
    )
    ran = run("-", text=wrong)
    assert ran.returncode != 0
    for key, nearest in [
        ("friction.mmu", "friction.mu"),
        ("wear.cyclng", "wear.cycling"),
        ("wear.body2.threshhold", "wear.body2.threshold"),
    ]:
        assert f"unknown key `{key}`: the nearest valid key is `{nearest}`" in ran.stderr
    assert 'wear.body2.k = "3 um": must be a number in m^2/N' in ran.stderr
    assert len(ran.stderr.splitlines()) == 4, ran.stderr
    doubtful = (GOOD + WORN).replace("k = 1e-14", "k = 1e-6")
    doubted = run("-", "--strict", text=doubtful)
    assert doubted.returncode == 1
    assert "wear.body2.k = 1e-6" in doubted.stderr
    assert "wear.body2.k" in json.loads(run("-", "--json", text=doubtful).stdout)["doubts"][0]
