"""Guesses of a user of matplotlib and xarray work, or the error has the right name."""

from __future__ import annotations

import importlib
import re
from collections.abc import Callable
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest
from xarray import Dataset

import pyfret as fret
import pyfret.plot
from conftest import SAME_PROCESS, W, sphere_on_flat

pytestmark = pytest.mark.solves

PRESSED = fret.LoadPath.start().normal(W, increments=2)


@pytest.fixture(scope="module")
def result() -> fret.Result:
    scene = sphere_on_flat(ratio=2.0, n=16)
    return fret.solve(scene, PRESSED.cycles(1, T_x=90.0, increments=4), progress=False)


def test_variables_are_found_as_in_xarray(result: fret.Result) -> None:
    assert result.T_x.dims == ("increment",)
    assert result["p"].dims == ("saved", "x", "y")
    assert result.at(-1)["p"].equals(result.at(-1).p)


@pytest.mark.parametrize(
    ("guess", "error", "expected"),
    [
        (lambda r: r.p, AttributeError, r"field of every increment.*result.at\(-1\).p"),
        (lambda r: r.isel, AttributeError, r"result.dataset.isel"),
        (lambda r: r.to_netcdf, AttributeError, r"result.dataset.to_netcdf"),
        (lambda r: r.plot.nonsense, AttributeError, r"nonsense"),
        (lambda r: r.scene.grid.spacing, AttributeError, r"a Grid has no 'spacing': .* dx and dy"),
        (lambda r: r.scene.grid.cells, AttributeError, r"it is called nx and ny"),
        (lambda r: r.at(-1).rims, AttributeError, r"it is called contact_zone"),
        (lambda r: r.at(-1).normal_force, AttributeError, r"it is called W"),
        (lambda r: r.at(0), KeyError, r"count from 1.*result.at\(\d+\) is the first"),
        (lambda r: r.stress_history, AttributeError, r"fret.plot.stress_history\(\.\.\.\)"),
        (lambda r: r.plot.stress_history(), TypeError, r"its .envelope\(\)"),
        (lambda r: r.hertz, AttributeError, r"fret.reference.hertz\("),
        (lambda r: r.stick_rato, AttributeError, r"did you mean stick_ratio"),
        (lambda r: r[-1], TypeError, r"result.at\(-1\)"),
        (lambda r: r.at("last"), TypeError, r"-1 for the last"),
        (lambda r: r.at(-1).von_mises, AttributeError, r"snapshot.stress\(\).von_mises"),
        (lambda r: r.at(-1).pressure, AttributeError, r"it is called p"),
        (lambda r: r.at(-1).stress().max, AttributeError, r"maximum|stress.dataset.max"),
        (lambda r: fret.plot.fretting_loop(r.at(-1)), TypeError, r"must be the result of a run"),
        (lambda r: fret.plot.stick_ratio(r.dataset), TypeError, r"must be the result of a run"),
        (lambda r: fret.plot.stress_map(r.at(-1)), TypeError, r"result.at\(-1\).stress\(\)"),
        (lambda r: fret.solve(PRESSED, r.scene), TypeError, r"solve\(scene, path\)"),
        (lambda r: fret.open("nowhere.zarr"), fret.errors.StoreError, r"no such file or folder"),
        (lambda r: r.loops(direction="z"), ValueError, r'"x", "y" or "torsion"'),
        (lambda r: fret.plot.fretting_loop(r, direction="z"), ValueError, r"direction = 'z'"),
        (lambda r: r.envelope(z=[], y=0.0), ValueError, r"z is empty: give depths in m"),
        (lambda r: r.at(-1).stress(z=[]), ValueError, r"z is empty: give depths in m"),
        (
            lambda r: r.at(-1).stress(z=[-1e-6]),
            fret.errors.ArgumentError,
            r"must be a depth in m",
        ),
        (
            lambda r: r.at(-1).stress(y=1.0),
            fret.errors.ArgumentError,
            r"y = 1: must be a place ab",
        ),
        (lambda r: r.life("steel", "crossland"), ValueError, r"`steel`.s_D: is missing"),
        (lambda r: r.at(0.37), KeyError, r"no fields were kept at 0.37; kept are"),
        (lambda r: r.save("x.csv"), ValueError, r"x.csv: must end in .zarr or .nc"),
        (lambda r: r.report("/dev/null/x.html"), OSError, r"/dev/null"),
        (lambda r: fret.open("/dev/null"), fret.errors.StoreError, r"/dev/null"),
        (
            lambda r: fret.solve(r.scene, save="some"),
            fret.errors.InvalidSceneError,
            r'"branches", "all"',
        ),
        (
            lambda r: fret.study.run(r.scene, {}, measure="p_max"),
            ValueError,
            r"no parameters: give",
        ),
        (
            lambda r: fret.study.run(r.scene, {"mu": [0.1]}, measure="x"),
            ValueError,
            r"measure 'x': mu",
        ),
        (lambda r: r.scene.replace(mew=0.1), TypeError, r"mew"),
        (lambda r: fret.load, AttributeError, r"it is called pyfret.open"),
        (lambda r: fret.Material, AttributeError, r"it is called pyfret.Elastic"),
    ],
)
def test_what_is_not_there_is_told_with_what_is(
    result: fret.Result,
    guess: Callable[[fret.Result], object],
    error: type[Exception],
    expected: str,
) -> None:
    with pytest.raises(error, match=expected):
        guess(result)
    plt.close("all")


def test_a_run_of_one_state_is_told_how_its_stress_is_got(result: fret.Result) -> None:
    item = fret.solve(result.scene, PRESSED, progress=False)
    with pytest.raises(ValueError, match=r"no closed cycle.*one state is result.at\(-1\).stress"):
        fret.fatigue.history(item, [1e-5])


@pytest.mark.filterwarnings("ignore")
def test_what_a_dataset_says_of_itself_is_an_attribute(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every result that has a dataset, every entry of its attributes."""
    monkeypatch.syspath_prepend(str(Path(__file__).with_name("hostile")))
    public = importlib.import_module("public")
    results = [
        item
        for item in vars(public).values()
        if isinstance(getattr(item, "dataset", None), Dataset)
    ]
    results += [public.BARE.grow_crack(0.0, end=2e-5), public.LIFE.over_distance([1e-5, 2e-5])]
    count, missing = 0, []
    for item in results:
        for name in map(str, item.dataset.attrs):
            if not name.isidentifier() or name.startswith("_"):
                continue
            count += 1
            if name not in dir(item) or not has(item, name):
                missing.append(f"{type(item).__name__}.{name}")
    assert count > 60
    assert missing == []
    growth = public.BARE.grow_crack(0.0, end=2e-5)
    assert growth.end in ("reached", "closed", "surface", "kinks")
    assert 0.0 <= growth.path_error < 1e-6


def has(one: object, name: str) -> bool:
    """Whether a thing has an attribute, or refuses it for this case by a reason."""
    try:
        getattr(one, name)
    except AttributeError:
        return False
    except ValueError:
        # A yardstick that a contact of this kind has not.
        return True
    return True


def test_maps_take_the_words_of_imshow(result: fret.Result) -> None:
    ax = fret.plot.pressure_map(result, cmap="magma", vmax=2.0)
    assert ax.images[0].get_cmap().name == "magma"
    assert ax.images[0].get_clim() == (0.0, 2.0)
    assert fret.plot.slip_map(result, vmax=1.0).images[0].get_clim() == (0.0, 1.0)
    plt.close("all")


def test_a_copy_of_a_result_is_one(result: fret.Result, tmp_path: Path) -> None:
    result.save(tmp_path / "a.nc")
    assert fret.open(tmp_path / "a.nc").T_x.equals(result.T_x)


@pytest.mark.parametrize(
    ("guess", "error", "expected"),
    [
        (
            lambda: PRESSED.normal(-5.0),
            fret.errors.InvalidSceneError,
            r"W = -5: must be a finite compr",
        ),
        (
            lambda: PRESSED.tangential(float("inf")),
            fret.errors.InvalidSceneError,
            r"path\[1\].T_x = inf",
        ),
        (
            lambda: PRESSED.force(W=float("nan")),
            fret.errors.InvalidSceneError,
            r"path\[1\].W = NaN",
        ),
        (
            lambda: PRESSED.displace(delta_x=float("inf")),
            fret.errors.InvalidSceneError,
            "delta_x = inf",
        ),
        (lambda: fret.Grid.centred(width=1e-3, n=-3), TypeError, r"-3: must be a whole number"),
        (lambda: fret.Grid.centred(width=1e-3, n=32.0), TypeError, "32.0: must be a whole number"),
        (lambda: PRESSED.normal(W, increments=0), TypeError, "0: must be a whole number of incr"),
        (lambda: PRESSED.normal(W, increments="many"), TypeError, "'many': must be a whole numb"),
        (lambda: PRESSED.displace(), ValueError, r"displace: give a motion, such as delta_x=2e-6"),
        (lambda: PRESSED.cycles(2), ValueError, r"cycles: give the amplitude of one load or motio"),
        (
            lambda: fret.Settings(tolerance=0.0),
            fret.errors.InvalidSceneError,
            "tolerance = 0: must be b",
        ),
        (
            lambda: fret.Settings(path_tolerance=2.0),
            fret.errors.InvalidSceneError,
            "path_tolerance = 2:",
        ),
        (
            lambda: fret.Settings(max_iterations=0),
            fret.errors.InvalidSceneError,
            "max_iterations = 0",
        ),
        (lambda: fret.SurfaceMap([0.0], spacing=1e-6), TypeError, r"\[0.0\]: must be an array of"),
    ],
)
def test_constructors_refuse_at_once(
    guess: Callable[[], object], error: type[Exception], expected: str
) -> None:
    with pytest.raises(error, match=expected):
        guess()


def test_a_radius_needs_no_name() -> None:
    assert fret.Cylinder(5e-3) == fret.Cylinder(R=5e-3)
    assert fret.Sphere(5e-3) == fret.Sphere(R=5e-3)


def test_tables_of_cycles_and_branches_are_written_as_pandas_writes_them(
    result: fret.Result, tmp_path: Path
) -> None:
    loops = result.loops()
    assert isinstance(loops, Dataset)
    loops.to_csv(tmp_path / "loops.csv", columns=["T", "dissipated [J]"])
    head, row = (tmp_path / "loops.csv").read_text().split("\n")[:2]
    assert head == "T [N],dissipated [J]"
    assert float(row.split(",")[1]) == float(loops.dissipated[0])
    result.branches().to_excel(tmp_path / "branches.xlsx")
    assert (tmp_path / "branches.xlsx").stat().st_size > 0
    assert "T_x [N]" in result.branches().to_dataframe().columns
    assert type(loops.isel(cycle=[0])) is type(loops)
    result.to_csv(tmp_path / "loop.csv", columns=["delta_x", "T_x"])
    assert (tmp_path / "loop.csv").read_text().startswith("delta_x [m],T_x [N]\n")
    with pytest.raises(ValueError, match="no column 'energy'; there is dissipated"):
        result.to_csv(tmp_path / "x.csv", columns=["energy"])
    assert not (tmp_path / "x.csv").exists()


def test_layers_have_their_printed_names(result: fret.Result) -> None:
    stress = result.at(-1).stress()
    for layer, names in ((0, ("coating", "coating 1")), (1, ("substrate", "the substrate"))):
        expected = stress.maximum("s_1", layer=layer)
        for name in names:
            assert stress.maximum("s_1", layer=name) == expected
    for wrong in ("TiN", 2, -1):
        with pytest.raises(ValueError, match=r"0 \(coating 1\), 1 \(the substrate\)"):
            stress.maximum("s_1", layer=wrong)


def test_a_criterion_is_chosen_by_the_numbers_of_the_material(result: fret.Result) -> None:
    cycle = fret.solve(result.scene, save="all", progress=False)
    assert repr(cycle.life("steel_42CrMo4")).startswith("Life(smith_watson_topper")
    with pytest.raises(ValueError, match="criterion = nothing: must be given; material `TiN`"):
        cycle.life("TiN")


@pytest.mark.parametrize(
    ("guess", "says"),
    [
        (lambda: fret.LoadPath.start().cycles(1, T_x=1.0, sigma_B=1e6), r"LoadPath.force\(sigma"),
        (lambda: fret.LoadPath.start().tangential([1.0], bulk=1e6), r"waypoints\(sigma_B=...\)"),
        (lambda: fret.Body("steel", surface=1), "the nearest is 'shape'"),
        (lambda: fret.Body("steel", roughness=1), "the nearest is 'shape'"),
        (lambda: fret.HeightMap, "pyfret.SurfaceMap"),
        (lambda: fret.materials("100Cr6"), r"fret.material\('100Cr6'\)"),
        (lambda: fret.materials["Unobtainium"], "no material 'Unobtainium'"),
        (lambda: fret.Coating("TiNN", thickness=1e-6), "material: no material 'TiNN'"),
    ],
)
def test_guesses_of_names_are_answered(guess: Callable[[], object], says: str) -> None:
    with pytest.raises((TypeError, ValueError, AttributeError, KeyError), match=says):
        guess()


@pytest.mark.filterwarnings("ignore")
def test_materials_are_given_by_their_names() -> None:
    film = fret.Coating("TiN", thickness="2 um")
    assert film == fret.Coating(fret.material("TiN"), thickness=2e-6)
    assert film == fret.Coating(material=fret.fatigue.Materials()["TiN"], thickness=2e-6)
    body = fret.Body("Ti-6Al-4V", coatings=[film])
    assert body == fret.Body(fret.materials["Ti6Al4V"], coatings=[film])
    assert fret.Body(substrate="steel") == fret.Body(fret.material("steel"))
    assert "TiN" in fret.materials
    assert set(fret.materials) == set(fret.materials().index)


def test_a_hardness_is_a_number_with_a_unit_or_a_material() -> None:
    """A text that begins with a digit is a pressure."""
    steel = fret.Elastic(E=210e9, nu=0.3)
    assert fret.Body(steel, hardness="3.5 GPa").hardness == pytest.approx(3.5e9)
    assert fret.Body(steel, hardness=3.5e9).hardness == pytest.approx(3.5e9)
    with pytest.raises(ValueError, match="must be a number in Pa"):
        fret.Body(steel, hardness="3 m")


#: Words of people for the stiffness of a rig.
OF_RIGS = ("spring", "compliance", "rig_compliance", "machine_stiffness")


@pytest.mark.parametrize("word", OF_RIGS)
@pytest.mark.parametrize(
    "call",
    [
        *(getattr(fret.fit, name) for name in fret.fit.__all__ if name.startswith("read_")),
        *(fret.fit.Loops.from_arrays, fret.fit.Indentation.from_arrays, fret.fit.Scar.from_arrays),
        *(fret.fit.fit, fret.solve, fret.study.run, fret.compare, fret.wear.Wear, fret.Scene),
        *(fret.Scene.ball_on_flat, fret.Scene.cylinder_on_flat, fret.Scene.rough_on_flat),
        *(fret.Scene.flat_pad, fret.Scene.crossed_cylinders, fret.LoadPath.start),
    ],
)
def test_a_word_for_the_rig_is_answered_with_its_argument(
    call: Callable[..., object], word: str
) -> None:
    with pytest.raises(TypeError, match=r"rig\.stiffness|'?rig_stiffness'?|frame=True"):
        call(**{word: 1e7})


def test_a_known_rig_is_set_as_a_refusal_says(result: fret.Result) -> None:
    scene = result.scene.replace(path=PRESSED.tangential([90.0], increments=2))
    assert scene.replace({"rig.stiffness": 9e6}).path.rig_stiffness == 9e6


def test_a_result_counts_what_it_goes_through(result: fret.Result) -> None:
    assert len(result) == len(list(result)) == result.dataset.sizes["saved"]
    assert bool(result)
    assert len(result.path) == result.dataset.sizes["increment"]


@pytest.mark.parametrize("word", ["branch", "cycle", "increment", "index", "time"])
def test_a_place_in_the_history_is_asked_for_as_a_refusal_says(
    result: fret.Result, word: str
) -> None:
    with pytest.raises(TypeError, match=rf"no argument '{word}': .*result\.at\(") as refused:
        result.at(**{word: 1})
    for text in re.findall(r"result\.at\([-\d]+\)|result\.at\(t=float.*?\)\)", str(refused.value)):
        for n in range(len(result.branches().t)):
            computed = eval(text, {"result": result, "n": n})
            assert computed.scene == result.scene
            if "branches" in text:
                ends = result.branches()
                np.testing.assert_allclose(computed.T_x, ends.T_x[n], rtol=1e-12)


def test_a_method_is_named_with_what_it_needs() -> None:
    answers = fret.study.Comparison(Dataset(), {}, {})
    with pytest.raises(AttributeError, match=r"it is called preference\(of\)"):
        _ = answers.best
    with pytest.raises(TypeError, match="preference needs of"):
        answers.preference()  # type: ignore[call-arg]


@pytest.mark.parametrize(
    ("word", "name"), [("radius", "R"), ("amplitude", "T_x"), ("modulus", "E"), ("load", "W")]
)
def test_a_word_for_a_parameter_of_a_study_is_answered(
    result: fret.Result, word: str, name: str
) -> None:
    with pytest.raises(ValueError, match=rf"{word}: the nearest is {name}$"):
        fret.study.run(
            result.scene, {word: [1.0]}, measure="p_max", executor=SAME_PROCESS, progress=False
        )


@pytest.mark.parametrize(
    ("word", "name"),
    [("life", "Cracking"), ("wear", "WornDepth"), ("crack", "Arrest"), ("max_stress", "Largest"),
     ("energy", "loop_energy"), ("pressure", "p_max")],
)  # fmt: skip
def test_a_word_for_a_measure_is_answered(result: fret.Result, word: str, name: str) -> None:
    with pytest.raises(ValueError, match=rf"; .*{name}"):
        fret.study.run(result.scene, {"mu": [0.3]}, measure=word, progress=False)


def test_a_file_that_is_no_result_is_answered_with_its_reader(tmp_path: Path) -> None:
    for name, reader in (
        ("scene.toml", "Scene.from_file"),
        ("loop.csv", "read_loops"),
        ("x.bin", ".zarr"),
    ):
        (tmp_path / name).write_text("")
        with pytest.raises(fret.errors.StoreError, match=f"is no result: .*{reader}"):
            fret.open(tmp_path / name)
    with pytest.raises(fret.errors.StoreError, match=r"is no result: a folder \.zarr"):
        fret.open(tmp_path)
