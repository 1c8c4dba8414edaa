"""Every object of results is described, drawn and written, or names the call that does so."""

from __future__ import annotations

import ast
import inspect
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

import pyfret as fret
from pyfret import contacts, fit
from pyfret._util.attributes import OUTPUTS, OWNERS
from pyfret._util.compiled import MATERIALS
from pyfret._util.csv_table import convert_units
from pyfret._util.holds_arrays import HoldsArrays
from pyfret._util.labelled import Labelled
from pyfret.scene.maps import write_heights

#: Modules with public classes.
MODULES = ("fatigue", "fit", "fracture", "heat", "study", "subsurface", "wear")
#: Outputs of an object that holds arrays.
NEEDED = ("summary", "plot", "to_csv", "to_dataframe", "to_excel")


def public_classes() -> dict[str, type]:
    """The public classes by their names."""
    modules = [fret, *(import_module(f"pyfret.{name}") for name in MODULES)]
    members = {name: getattr(module, name) for module in modules for name in module.__all__}
    return {name: kind for name, kind in members.items() if inspect.isclass(kind)}


CLASSES = public_classes()
#: Classes with arrays or a dataset; a numbers-only class has none of preference.
WITH_DATA = {
    name: kind
    for name, kind in CLASSES.items()
    if issubclass(kind, (Labelled, HoldsArrays)) and name not in ("Posterior", "Limits")
}


@pytest.fixture(scope="module")
def line() -> fret.Result:
    scene = fret.Scene.cylinder_on_flat(
        "Ti-6Al-4V", "Ti-6Al-4V", R="5 mm", W="300 N/mm", T="80 N/mm", mu=0.6, cycles=1, n=24,
        quiet=True,
    )  # fmt: skip
    return fret.solve(scene, save="all", progress=False)


@pytest.mark.parametrize("name", sorted(WITH_DATA))
def test_a_class_with_data_has_every_output(name: str) -> None:
    missing = [output for output in NEEDED if not hasattr(WITH_DATA[name], output)]
    # The growth in a pass has no figure of its own: its dataset draws it.
    assert missing == (["plot"] if name == "BlockGrowth" else [])


def bare(kind: type) -> Any:
    """An object of a class of numbers, without its numbers."""
    if issubclass(kind, tuple):
        return tuple.__new__(kind, [None] * len(kind._fields))  # type: ignore[attr-defined]
    return object.__new__(kind)


@pytest.mark.parametrize("output", OUTPUTS)
@pytest.mark.parametrize("name", sorted(OWNERS.keys() & CLASSES.keys() - {"LoadPath", "Scene"}))
def test_a_class_of_numbers_names_the_call_of_an_output(name: str, output: str) -> None:
    kind = CLASSES[name]
    if hasattr(kind, output):
        return
    with pytest.raises(AttributeError, match=rf"has no '{output}': .*\("):
        getattr(bare(kind), output)


@pytest.mark.parametrize(
    "value", [fret.LoadPath.start(), fret.Elastic(E=1e9, nu=0.3), fret.Grid.centred(width=1, n=8)]
)
@pytest.mark.parametrize("output", ["plot", "to_csv", "to_dataframe"])
def test_a_part_of_a_scene_names_a_call_as_well(value: object, output: str) -> None:
    with pytest.raises(AttributeError, match=rf"has no '{output}': .*\("):
        getattr(value, output)


@pytest.mark.solves
def test_tables_of_a_run_are_described_and_drawn(line: fret.Result) -> None:
    loops, branches = line.loops(), line.branches()
    assert "dissipated" in loops.summary()
    assert "to_dataframe()" in branches.summary()
    assert loops.plot().get_ylabel()
    assert loops.plot("T").get_ylabel()
    with pytest.raises(ValueError, match="column = 'Q': there is"):
        loops.plot("Q")
    np.testing.assert_allclose(loops.dissipated_sum, loops.dissipated.cumsum())
    with pytest.raises(AttributeError, match="it is called dissipated"):
        loops.energy  # noqa: B018
    assert line.at(-1).summary().startswith("increment")
    for stress in (line.at(-1).stress(x=0.0, y=0.0), line.at(-1).stress()):
        assert stress.plot().get_xlabel()


@pytest.mark.solves
def test_tables_take_units(line: fret.Result, tmp_path: Path) -> None:
    path = tmp_path / "loop.csv"
    line.to_csv(path, columns=["delta_x", "T_x"], units={"delta_x": "um", "T_x": "N/mm"})
    frame = pd.read_csv(path)
    assert list(frame) == ["delta_x [um]", "T_x [N/mm]"]
    np.testing.assert_allclose(frame["delta_x [um]"], 1e6 * line.delta_x)
    np.testing.assert_allclose(frame["T_x [N/mm]"], 1e-3 * line.T_x)
    # A unit stands for all of its columns; a table of a workbook has those that it has.
    assert "delta_y [um]" in line.to_dataframe(units={"m": "um"})
    loops = line.loops()
    assert "dissipated [uJ/m]" in loops.to_dataframe(units={"dissipated": "uJ/m"})
    loops.to_excel(tmp_path / "loops.xlsx", units={"delta": "um"})
    line.to_excel(tmp_path / "all.xlsx", units={"delta_x": "um", "dissipated": "mJ/m"})
    book = pd.read_excel(tmp_path / "all.xlsx", sheet_name=None)
    assert "delta_x [um]" in book["increments"]
    assert "dissipated [mJ/m]" in book["loops"]
    for units, message in (
        ({"delta_q": "um"}, "no column with a unit is called 'delta_q'"),
        ({"delta_x": "N"}, "delta_x is in m: cannot be in 'N'"),
        ({"delta_x": "furlong"}, "cannot be in 'furlong'"),
    ):
        with pytest.raises(ValueError, match=message):
            line.to_dataframe(units=units)
        with pytest.raises(ValueError, match=message):
            line.to_excel(tmp_path / "none.xlsx", units=units)
    with pytest.raises(TypeError, match="units: must be names of columns"):
        line.to_csv(path, units="um")  # type: ignore[arg-type]


def test_measured_points_are_written_and_drawn(tmp_path: Path) -> None:
    x = np.linspace(-1e-4, 1e-4, 21)
    scar = fit.Scar.from_arrays(x, 1e-6 * (1.0 - (x / 1e-4) ** 2), wear={"cycles": 1e5})
    curve = fit.Indentation.from_arrays([1.0, 2.0], [1e-6, 2e-6])
    lives = fit.Lives(np.array([1e5, 2e5]), [{}, {}], {})
    t = np.linspace(0.0, 4.0 * np.pi, 200)
    loops = fit.Loops.from_arrays(1e-6 * np.sin(t), 5.0 * np.cos(t))
    for number, data in enumerate((scar, curve, lives, loops)):
        assert data.summary()
        assert data.plot().get_ylabel()
        data.to_csv(tmp_path / f"{number}.csv")
        assert len(pd.read_csv(tmp_path / f"{number}.csv")) == len(data.to_dataframe())
    assert scar.plot().yaxis_inverted()


def test_heights_are_written_and_read_back(tmp_path: Path) -> None:
    heights = 1e-7 * np.random.default_rng(1).normal(size=(9, 7))
    surface = fret.SurfaceMap(heights - heights.mean(), spacing=(2e-6, 3e-6))
    path = tmp_path / "heights.csv"
    write_heights(surface, path)
    again = fret.read_surface(path)
    np.testing.assert_allclose(again.values, surface.values, atol=1e-21)
    assert again.spacing == pytest.approx((2e-6, 3e-6))
    surface.to_csv(path)
    assert fret.read_surface(path) == again
    statistics = surface.statistics()
    assert statistics["Sq"] == statistics["S_q"] == statistics.Sq == statistics.S_q == statistics[0]
    assert statistics["Sdq"] == statistics.S_dq
    with pytest.raises(KeyError, match="S_a"):
        statistics["Sx"]


def test_a_scene_is_described() -> None:
    body = fret.Body("Ti-6Al-4V", coatings=[fret.Coating("TiN", thickness="2 um")])
    scene = fret.Scene.ball_on_flat(
        "100Cr6", body, R="5 mm", W="20 N", T="7 N", mu=0.5, cycles=1, n=24, quiet=True
    )
    text = scene.summary()
    for part in ("R = 5 mm", "lower body, coating 1: 2 µm", "μ = 0.5", "T_x = -7 N", "24 "):
        assert part in text
    assert "<" not in text
    assert "&" not in text


def test_a_scene_takes_its_parts_by_their_keys() -> None:
    body = fret.Body("Ti-6Al-4V", coatings=[fret.Coating("TiN", thickness="2 um")])
    scene = fret.Scene.ball_on_flat(
        "100Cr6", body, R="5 mm", W="20 N", T="7 N", mu=0.5, cycles=1, n=24, quiet=True
    )
    grid = fret.Grid.centred(width="640 um", n=48)
    film = fret.Coating(fret.material("CrN", nu=0.25), thickness="1 um")
    sphere = fret.Sphere(R="3 mm")
    assert scene.replace({"grid": grid}).grid == grid
    assert scene.replace({"friction": fret.Friction(0.4)}).mu == 0.4
    changed = scene.replace({"body2.coatings.0": film, "body1.shape": sphere, "mu": 0.6})
    assert (changed.body2.coatings, changed.body1.shape, changed.mu) == ([film], sphere, 0.6)
    assert scene.replace({"path": scene.path}) == scene
    for key, value in (("bodi1", sphere), ("body2.coatings.3", film), ("grid.n", sphere)):
        with pytest.raises(fret.errors.InvalidSceneError, match=f"{key}: the scene has no such"):
            scene.replace({key: value})
    with pytest.raises(TypeError, match="must be a grid"):
        scene.replace({"grid": sphere})
    # Other cells leave the sides, and other sides leave the number of cells.
    side = scene.grid.nx * scene.grid.dx
    finer = scene.replace({"grid.n": 48}).grid
    assert (finer.nx, finer.nx * finer.dx) == (48, pytest.approx(side))
    for key in ("grid.extent", "grid.width"):
        wider = scene.replace({key: "500 um"}).grid
        assert (wider.nx, wider.nx * wider.dx) == (24, pytest.approx(500e-6))


def compiled_parameters(wanted: str) -> dict[str, set[str]]:
    """Parameters of the compiled module whose type has a word, by function or class."""
    stub = Path(inspect.getfile(fret)).with_name("_core.pyi").read_text(encoding="utf-8")
    parameters: dict[str, set[str]] = {}

    def visit(function: ast.FunctionDef, name: str) -> None:
        arguments = [*function.args.posonlyargs, *function.args.args, *function.args.kwonlyargs]
        for argument in arguments:
            hint = argument.annotation
            words = {n.id for n in ast.walk(hint) if isinstance(n, ast.Name)} if hint else set()
            if wanted in words:
                parameters.setdefault(name, set()).add(argument.arg)

    for node in ast.parse(stub).body:
        if isinstance(node, ast.FunctionDef):
            visit(node, node.name)
        elif isinstance(node, ast.ClassDef):
            for member in node.body:
                if isinstance(member, ast.FunctionDef):
                    visit(member, node.name if member.name == "__new__" else member.name)
    return parameters


def test_every_elastic_material_is_given_by_its_name() -> None:
    parameters = compiled_parameters("Elastic")
    for name in contacts.__all__:
        # The usual contacts read materials themselves.
        parameters.pop(name, None)
    assert {name: set(taken) for name, taken in MATERIALS.items()} == parameters
    hertz = fret.reference.hertz(R="5 mm", bodies=("100Cr6", "Ti-6Al-4V"), W="20 N")
    steel, titanium = fret.material("100Cr6"), fret.material("Ti-6Al-4V")
    assert hertz == fret.reference.hertz(R=5e-3, bodies=(steel, titanium), W=20.0)
    assert fret.reference.dundurs_beta("100Cr6", "TiN") == fret.reference.dundurs_beta(
        steel, fret.material("TiN", nu=0.25)
    )
    with pytest.raises(ValueError, match="bodies: no material 'Ti-6Al-9V'"):
        fret.reference.hertz(R=5e-3, bodies=("100Cr6", "Ti-6Al-9V"), W=20.0)


def test_usual_contacts_take_a_grid() -> None:
    grid = fret.Grid.centred(width="400 um", n=32)
    make = fret.Scene.ball_on_flat
    assert make("steel", "steel", R=5e-3, W=20.0, mu=0.5, grid=grid, quiet=True).grid == grid
    with pytest.raises(ValueError, match="n and grid: give one of them"):
        make("steel", "steel", R=5e-3, W=20.0, mu=0.5, grid=grid, n=32)
    for name, right in (("width", "grid"), ("delta_x", "shift"), ("T_x", "T")):
        with pytest.raises(TypeError, match=f"no argument '{name}': the nearest is '{right}'"):
            make("steel", "steel", R=5e-3, W=20.0, mu=0.5, **{name: 1e-6})  # type: ignore[arg-type]


def rough_map(side: int) -> fret.SurfaceMap:
    """A rough map with a pitch of 2 um."""
    heights = np.random.default_rng(3).normal(size=(side // 4, side // 4))
    smooth = np.kron(3e-7 * heights, np.ones((4, 4)))
    return fret.SurfaceMap(smooth, spacing=2e-6)


@pytest.mark.solves
def test_a_map_of_heights_bounds_the_grid() -> None:
    surface = rough_map(128)

    def make(W: float, **options: Any) -> fret.Scene:
        return fret.Scene.rough_on_flat(
            "100Cr6", "Ti-6Al-4V", surface=surface, R="5 mm", W=W, mu=0.5, quiet=True, **options
        )

    grid = make(8.0, n=48).grid
    assert min(grid.nx, grid.ny) == 48
    assert max(grid.nx * grid.dx, grid.ny * grid.dy) <= 256e-6 * (1 + 1e-9)
    with pytest.raises(ValueError, match=r"map of heights is 256 µm x 256 µm.* in place of 100"):
        make(100.0, n=48)


@pytest.mark.solves
def test_the_grid_of_layered_laws_holds_the_scar_beyond_the_film() -> None:
    law = fret.wear.Archard
    body = fret.Body("Ti-6Al-4V", coatings=[fret.Coating("TiN", thickness="1 um")])
    wear = {"body2": [law("1e-6 mm^3/(N m)"), law("2e-6 mm^3/(N m)")], "cycles": 4e5}
    scene = fret.Scene.ball_on_flat(
        "100Cr6", body, R="5 mm", W="20 N", mu=0.6, shift="5.6 um", cycles=1, n=16, quiet=True,
        wear=wear,
    )  # fmt: skip
    worn = fret.wear.solve(scene, **wear, worn_through="go_on", tolerance=0.1, progress=False)
    assert worn.cycles[-1] == 4e5
    assert float(worn.depth2[-1]) > 1.2e-6


def test_a_run_that_left_the_grid_decides_nothing() -> None:
    preference = fret.study.comparison.Preference(["TiN", "DLC"], [], ended=["TiN"])
    assert str(preference) == "undecided: the grid is too small for TiN"
    assert str(preference._replace(ended=())) == "no difference"
    assert str(preference._replace(best=["DLC"], worse=["TiN"])) == "best: DLC"


def test_errors_and_bounds_have_the_unit_of_their_number() -> None:
    frame = pd.DataFrame({f"s_1{end} [Pa]": [2e6] for end in ("", "_low", "_high", "_error")})
    frame["s_1_ratio [Pa]"] = [2e6]
    converted = convert_units(frame, {"s_1": "MPa"})
    assert list(converted.iloc[0]) == [2.0, 2.0, 2.0, 2.0, 2e6]
    assert list(converted)[1:] == [
        *("s_1_low [MPa]", "s_1_high [MPa]", "s_1_error [MPa]", "s_1_ratio [Pa]"),
    ]
