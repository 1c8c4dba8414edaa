"""First guesses of people who have not seen the package: they work, or are refused."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import matplotlib.pyplot as plt
import numpy as np
import pytest
import xarray as xr

import pyfret as fret
from conftest import SAME_PROCESS, W, sphere_on_flat
from pyfret._core import measure
from pyfret._util.modules import SYNONYMS
from pyfret._util.numbers import layer_index
from pyfret.fit.figures import in_words
from pyfret.fit.outcome import Known, neighbour_correlation
from pyfret.plot.parameters import parameter_label
from pyfret.plot.studies import scale_axis

PITCH = 2e-6
X, Y = np.meshgrid(PITCH * np.arange(16), PITCH * np.arange(12), indexing="ij")
ROUGH = 1e-8 * np.random.default_rng(1).normal(size=X.shape)
#: A rough plane with a tilt of 0.01 along x [m].
TILTED = 0.01 * X - 0.004 * Y + ROUGH


def write_map(folder: Path, kind: str) -> tuple[Path, dict[str, object]]:
    path = folder / f"map.{kind}"
    if kind == "npy":
        np.save(path, TILTED)
        return path, {"spacing": PITCH}
    if kind == "xyz":
        columns = [1e6 * X.ravel(), 1e6 * Y.ravel(), 1e6 * TILTED.ravel()]
        np.savetxt(path, np.column_stack(columns), header="x [um],y [um],z [um]", delimiter=",")
        return path, {"unit": "um"}
    np.savetxt(path, 1e6 * TILTED, delimiter=",")
    return path, {"spacing": "2 um", "unit": "um"}


@pytest.mark.parametrize("kind", ["csv", "xyz", "npy"])
@pytest.mark.parametrize("form", [True, "plane", "paraboloid"])
def test_every_kind_of_file_is_detrended(kind: str, form: object, tmp_path: Path) -> None:
    path, options = write_map(tmp_path, kind)
    surface = fret.read_surface(path, detrend=form, **options)  # type: ignore[arg-type]
    assert surface.fit_form("plane").slopes == pytest.approx((0.0, 0.0), abs=1e-12)
    raw = fret.read_surface(path, **options)  # type: ignore[arg-type]
    assert raw.fit_form("plane").slopes == pytest.approx((0.01, -0.004), rel=0.2)
    level = raw.level("plane" if form is True else form)  # type: ignore[arg-type]
    np.testing.assert_allclose(surface.values, level.values, atol=1e-15)


@pytest.mark.parametrize("form", ["banana", "linear", "", 3, ["plane"]])
def test_an_unknown_form_is_refused_for_every_kind_of_file(form: object, tmp_path: Path) -> None:
    for kind in ("csv", "xyz", "npy"):
        path, options = write_map(tmp_path, kind)
        with pytest.raises((ValueError, TypeError), match=r"detrend.*'plane'"):
            fret.read_surface(path, detrend=form, **options)  # type: ignore[arg-type]


@pytest.mark.parametrize("unit", ["um", "nm", "mm"])
def test_heights_in_another_unit_are_not_taken_for_metres(unit: str, tmp_path: Path) -> None:
    factor = {"um": 1e6, "nm": 1e9, "mm": 1e3}[unit]
    path = tmp_path / "map.csv"
    # A step of 20 um on a side of 32 um.
    np.savetxt(path, factor * (TILTED + 2e-5 * (X.mean() < X)), delimiter=",")
    with pytest.raises(fret.errors.StoreError, match=r"heights reach over .* give their unit"):
        fret.read_surface(path, spacing=PITCH)
    assert fret.read_surface(path, spacing=PITCH, unit=unit).rms < 2e-5


def test_the_direction_of_a_matrix_is_printed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for kind, printed in (("csv", True), ("npy", True), ("xyz", False)):
        path, options = write_map(tmp_path, kind)
        fret.read_surface(path, **options)  # type: ignore[arg-type]
        text = capsys.readouterr().err
        assert ("rows are taken along x" in text) is printed
        assert ("heights taken in m" in text) is (kind == "npy")


@pytest.fixture(scope="module")
def coated() -> fret.Result:
    path = fret.LoadPath.start().normal(W, increments=2).cycles(1, T_x=90.0, increments=4)
    return fret.solve(sphere_on_flat(ratio=2.0, n=16), path, progress=False)


@pytest.mark.solves
def test_a_table_of_stress_has_what_designers_ask_for(coated: fret.Result) -> None:
    for stress in (coated.at(-1).stress(), coated.at(-1).stress(x=0.0, y=0.0)):
        frame = stress.to_dataframe()
        tensor = np.stack(
            [frame[f"{name} [Pa]"] for name in ("s_xx", "s_yy", "s_zz", "s_xy", "s_xz", "s_yz")]
        )
        for name in ("von_mises", "tresca", "s_1", "s_2", "s_3", "hydrostatic"):
            np.testing.assert_allclose(frame[f"{name} [Pa]"], measure(name, tensor))


@pytest.mark.solves
def test_a_quantity_has_the_name_in_its_table_that_it_was_asked_by(coated: fret.Result) -> None:
    for name in (n for n in dir(coated) if not n.startswith("_")):
        column = getattr(coated, name, None)
        if getattr(column, "dims", None) == ("increment",):
            assert column.name == name


def test_a_layer_has_the_name_of_its_material() -> None:
    layers = [fret.material(name, nu=0.25) for name in ("TiN", "CrN", "100Cr6")]
    assert [layer_index(name, 2, range(3), layers) for name in ("TiN", "CrN", "100Cr6")] == [
        0,
        1,
        2,
    ]
    alloys = fret.fatigue.Materials()
    known = [None, None, alloys["Ti-6Al-4V"]]
    assert (
        layer_index("Ti6Al4V", 2, range(3), known)
        == layer_index(known[2].name, 2, range(3), known)
        == 2
    )  # type: ignore[union-attr]
    with pytest.raises(ValueError, match="must be one of 0"):
        layer_index("TiN", 2, range(3), [layers[0], layers[0], layers[2]])


@pytest.mark.parametrize(
    "text",
    ["2e-7 mm3/(N m)", "2e-7 mm^3/N/m", "2e-7 mm^3/N m", "2e-7 mm³/(N·m)", "2e-7 mm^3/(N*m)",
     "0.2 um^3/(N mm)", "200 um^3/(N m)", "2e-10 mm^2/N", "2e-16 m2/N"],
)  # fmt: skip
def test_a_wear_coefficient_takes_its_unit_in_any_spelling(text: str) -> None:
    assert fret.wear.Archard(k=text).k == pytest.approx(2e-16)


@pytest.mark.parametrize(
    "text", ["2e-7 mm^3/N", "2e-7 mm^3/(N m)^2", "2e-7 mm^3/(N s)", "2e-7 mm^3/J", "2e-7 x"]
)
def test_a_unit_of_another_dimension_is_refused_in_any_spelling(text: str) -> None:
    with pytest.raises(ValueError, match=r"k = .*must be a number in m\^2/N"):
        fret.wear.Archard(k=text)


@pytest.mark.parametrize(
    ("module", "name", "right"),
    [
        ("", "life", "fret.fatigue.life"),
        ("", "hertz", "fret.reference.hertz"),
        ("", "read_loops", "fret.fit.read_loops"),
        ("", "Study", "fret.study.Study"),
        ("", "solv", "fret.solve"),
        ("reference", "hertz_line", "fret.reference.line_contact"),
        ("study", "sweep", "fret.study.run"),
        ("wear", "coefficient", "fret.fit.read_scar"),
        ("fit", "friction", "fret.fit.fit"),
        ("fatigue", "criterion", "fret.fatigue.Criterion"),
    ],
)
def test_a_wrong_name_of_a_module_is_answered_with_the_right_one(
    module: str, name: str, right: str
) -> None:
    owner = getattr(fret, module) if module else fret
    with pytest.raises(AttributeError, match=f"{name}.*did you mean .*{right}"):
        getattr(owner, name)


@pytest.mark.parametrize(
    "name", [n for n in fret.__all__ if isinstance(getattr(fret, n), ModuleType)]
)
def test_a_module_that_is_called_names_its_functions(name: str) -> None:
    module = getattr(fret, name)
    expected = {"fit": "scene = 1", "study": "scene = 1"}.get(name, f"fret.{name}")
    with pytest.raises((TypeError, ValueError), match=expected):
        module(1, {})
    with pytest.raises(AttributeError, match="has no 'nonsense'"):
        module.nonsense  # noqa: B018


def test_every_synonym_of_a_module_leads_to_a_public_name() -> None:
    for word in SYNONYMS.values():
        owner = fret
        for part in word.split("."):
            owner = getattr(owner, part)


@pytest.mark.parametrize(
    ("name", "right"),
    [
        ("von_mises", r"result.at\(-1\).stress\(\).von_mises"),
        ("s_1", r"result.at\(-1\).stress\(\).s_1"),
        ("max_stress", r"result.at\(-1\).stress\(\).maximum"),
        ("loop", r"columns=\[.delta_x., .T_x.\].*result.loops\(\)"),
        ("energy", r"loops\(\).dissipated, the sum since the start result.dissipated_energy"),
        ("peak_pressure", "p_max and p_H"),
        ("max_pressure", "it is called p_max"),
    ],
)
@pytest.mark.solves
def test_a_wrong_name_of_a_result_is_answered(coated: fret.Result, name: str, right: str) -> None:
    with pytest.raises(AttributeError, match=right):
        getattr(coated, name)


def test_a_wrong_name_of_a_measurement_is_answered() -> None:
    turns = 1e-6 * np.sin(np.linspace(0.0, 12.0, 200))
    for data in (
        fret.fit.Loops.from_arrays(turns, 1e7 * turns),
        fret.fit.Scar.from_arrays([0.0, 1e-6], [1e-6, 2e-6], wear={"cycles": 10}),
    ):
        with pytest.raises(AttributeError, match=r"fret.fit\(scene, data"):
            data.mu  # type: ignore[union-attr]  # noqa: B018
        with pytest.raises(AttributeError, match=r"has no 'nois'; did you mean noise"):
            data.nois  # type: ignore[union-attr]  # noqa: B018
        assert copy.copy(data) == pickle.loads(pickle.dumps(data)) == data


def test_neighbouring_residuals_are_told_from_scatter() -> None:
    scatter = np.random.default_rng(2).normal(size=400)
    assert abs(neighbour_correlation(scatter)) < 0.2
    assert neighbour_correlation(scatter + 3 * np.sin(np.linspace(0, 20, 400))) > 0.5
    assert neighbour_correlation(scatter[:4]) == 0.0


@pytest.mark.parametrize(
    ("guess", "text"),
    [
        (lambda: fret.fatigue.Material("Ti-6Al-4V"), r"fatigue.Materials\(\)\['Ti-6Al-4V'\]"),  # type: ignore[call-arg]
        (lambda: fret.LoadPath.start().force(T_x=[1.0, 2.0]), r"T_x.*waypoints\(T_x=\[...\]"),  # type: ignore[arg-type]
        (lambda: fret.LoadPath.start().force(W=np.ones(2)), r"W: .*waypoints\(W=\[...\]"),  # type: ignore[arg-type]
        (lambda: fret.study.Study("study.zarr"), r"fret.study.run\(scene.*fret.open\(path\)"),  # type: ignore[arg-type]
        (lambda: fret.Result({}), r"fret.open\(path\)"),  # type: ignore[arg-type]
    ],
)
def test_a_wrong_argument_is_answered_with_the_call(guess: Callable[[], object], text: str) -> None:
    with pytest.raises(TypeError, match=text):
        guess()


def test_a_profile_of_heights_is_no_scar() -> None:
    """A scar is positive into the body: heights of a profilometer have the other sign."""
    x = np.linspace(-1e-3, 1e-3, 21)
    depth = 1e-6 * np.maximum(1.0 - (x / 5e-4) ** 2, 0.0)
    scar = fret.fit.Scar.from_arrays(x, depth, wear={"cycles": 1e5})
    assert "depth up to 1 µm" in scar.summary()
    with pytest.raises(ValueError, match="give heights with the other sign"):
        fret.fit.Scar.from_arrays(x, -depth, wear={"cycles": 1e5})


def test_a_table_of_excel_takes_columns(tmp_path: Path) -> None:
    result = fret.solve(
        sphere_on_flat(n=16), fret.LoadPath.start().normal(W, increments=1), progress=False
    )
    path = tmp_path / "loop.xlsx"
    result.to_excel(path, columns=["delta_x", "T_x"])
    import pandas as pd

    sheets = pd.read_excel(path, sheet_name=None)
    assert [list(sheet.columns) for sheet in sheets.values()] == [["delta_x [m]", "T_x [N]"]]


def test_a_stress_has_a_summary_of_its_largest_samples() -> None:
    stress = (
        fret.solve(
            sphere_on_flat(n=16), fret.LoadPath.start().normal(W, increments=1), progress=False
        )
        .at(-1)
        .stress()
    )
    lines = stress.summary().splitlines()
    assert "maximum()" in lines[0]
    largest = next(line for line in lines if line.startswith("von_mises"))
    assert f"{1e-6 * float(stress.von_mises.max()):.4g} MPa" in largest
    assert "z = " in largest


def test_a_parameter_of_roughness_is_named_after_the_standard() -> None:
    statistics = fret.SurfaceMap(ROUGH, spacing=PITCH).statistics()
    assert statistics.Sa == statistics.S_a
    with pytest.raises(AttributeError, match="S_a"):
        _ = statistics.Sv
    assert pickle.loads(pickle.dumps(statistics)) == copy.copy(statistics)


@pytest.mark.solves
def test_a_table_keeps_the_coordinates_of_its_rows(coated: fret.Result, tmp_path: Path) -> None:
    state = coated.at(-1)
    frame = state.to_dataframe(columns=["x", "p"])
    assert list(frame.columns) == ["x [m]", "y [m]", "p [Pa]"]
    assert not frame.duplicated(["x [m]", "y [m]"]).any()
    assert list(state.to_dataframe(columns=["p"]).columns) == ["p [Pa]"]
    section = state.stress().to_dataframe(columns=["x", "von_mises"])
    assert list(section.columns) == ["x [m]", "z [m]", "layer", "von_mises [Pa]"]


@pytest.mark.solves
def test_a_profile_is_a_table_with_units(coated: fret.Result, tmp_path: Path) -> None:
    state, path = coated.at(-1), tmp_path / "profile.csv"
    state.to_csv(path, of="profile", columns=["x", "p", "q_x", "q_y"], units={"Pa": "MPa"})
    head, *rows = path.read_text().splitlines()
    assert head == "x [m],p [MPa],q_x [MPa],q_y [MPa]"
    columns = np.array([row.split(",") for row in rows], dtype=float).T
    line = state.along(y=0.0)
    np.testing.assert_allclose(columns[0], line.x, rtol=1e-12)
    np.testing.assert_allclose(1e6 * columns[1], line.p, rtol=1e-12)
    for lines in (line, state.along_x()):
        lines.to_csv(path)
        assert path.read_text().splitlines()[0].startswith("x [m],")
        np.testing.assert_allclose(lines.to_dataframe()["q_x [Pa]"], line.q_x, rtol=1e-12)
    with pytest.raises(TypeError, match=r"no argument 'y': .*snapshot.along\(y=0.0\).to_csv"):
        state.to_csv(path, y=0.0)
    with pytest.raises(AttributeError, match=r"snapshot.along\(y=0.0\).*of=.profile"):
        state.profile("p")


@pytest.mark.parametrize(
    ("guess", "text"),
    [
        (lambda r: r.profile("p"), r"result.at\(-1\).along\(y=0.0\)"),
        (lambda r: r.p_max_error, r"error_bars\(\).p_max.sel\(part='total'\)"),
        (lambda r: r.first_yield(), r'result.load_factors\("Ti-6Al-4V"\)'),
        (lambda r: r.at(-1).stress().first_yield(), r'result.load_factors\("Ti-6Al-4V"\)'),
        (lambda r: fret.fatigue.first_yield(r), r'result.load_factors\("Ti-6Al-4V"\)'),
        (lambda r: r.load_factors(), r'such as result.load_factors\("Ti-6Al-4V"\)'),
        (lambda r: r.grow_crack("Al 7075"), r'grow_crack\(x\).life\("Al 7075"\)'),
        (lambda r: r.grow_crack("steel"), r'grow_crack\(x\).life\("Al 7075"\)'),
    ],
)
@pytest.mark.solves
def test_a_wrong_call_on_a_result_is_answered(
    coated: fret.Result, guess: Callable[[fret.Result], object], text: str
) -> None:
    with pytest.raises((AttributeError, TypeError, ValueError), match=text):
        guess(coated)


def test_a_wrong_name_of_an_error_is_answered() -> None:
    unknown = Known(0.5, 0.4, 0.6, 0.1, 0.0, at_bound=False)
    with pytest.raises(AttributeError, match=r"from .low to .high"):
        unknown.error  # type: ignore[attr-defined]  # noqa: B018
    assert pickle.loads(pickle.dumps(unknown)) == copy.copy(unknown) == unknown


def test_a_growth_of_cracks_is_answered_with_the_life() -> None:
    cracks = fret.fracture.Cracks.from_arrays([1e-5, 2e-5], [1e6, 2e6], [0.0, 0.0])
    with pytest.raises(AttributeError, match=r'cracks.life\("Al 7075"\) counts'):
        cracks.growth("Al 7075")


@pytest.mark.solves
def test_a_wrong_name_of_a_study_or_of_wear_is_answered(coated: fret.Result) -> None:
    study = fret.study.run(coated.scene, {"mu": [0.3, 0.4]}, measure="p_max", executor=SAME_PROCESS)
    with pytest.raises(AttributeError, match=r"to_dataframe\(\).sort_values\('p_max \[Pa\]'\)"):
        study.best("p_max")
    with pytest.raises(AttributeError, match=r"study.failed\(\)"):
        study.failures  # noqa: B018
    ordered = study.to_dataframe().sort_values("p_max [Pa]")
    assert ordered["p_max [Pa]"].is_monotonic_increasing
    law = fret.wear.Archard(k=1e-17)
    worn = fret.wear.solve(coated.scene, cycles=10, body2=law, progress=False)
    for name in ("depth2_error", "error_bars"):
        with pytest.raises(AttributeError, match=r'wear.error_of\("depth"\)'):
            getattr(worn, name)


@pytest.mark.parametrize(
    ("word", "call"),
    [
        ("life", r'fret.study.Cracking\("Ti-6Al-4V", "smith_watson_topper"\)'),
        ("worn_depth", r"fret.study.WornDepth\(cycles=1e5, body2=fret.wear.Archard\(k=1e-15\)\)"),
        ("arrest", r'fret.study.Arrest\("Al 7075"\)'),
    ],
)
def test_a_measure_that_needs_more_is_answered_with_its_class(word: str, call: str) -> None:
    with pytest.raises(ValueError, match=call):
        fret.study.run(sphere_on_flat(n=16), {"mu": [0.3, 0.4]}, measure=["p_max", word])
    assert eval(call.replace("\\", "")) is not None


@pytest.mark.solves
def test_a_summary_of_a_study_counts_what_is_no_number(coated: fret.Result) -> None:
    study = fret.study.run(
        coated.scene,
        {"mu": [0.3, 0.4, 0.5]},
        measure=[
            lambda result: 2.0 if result.mu > 0.35 else float("nan"),
            lambda result: 3.0 if result.mu > 0.45 else float("inf"),
            lambda _: float("inf"),
        ],
        executor=SAME_PROCESS,
        progress=False,
    )
    assert study.measures == ["measure_1", "measure_2", "measure_3"]
    text = " ".join(study.summary().split())
    assert "measure_1 2, 1 no number" in text
    assert "measure_2 3, 2 infinite" in text
    assert "measure_3 infinite" in text
    assert "no number at 1 of 3 points: measure_1: measure_1 gave NaN" in text


def test_units_of_a_figure_are_answered(coated: fret.Result) -> None:
    with pytest.raises(TypeError, match=r"units = .*: must be a text; .SI. draws um, MPa and N"):
        fret.plot.fretting_loop(coated, units={"delta_x": "um"})
    with pytest.raises(ValueError, match=r"units = 'ksi': must be .* which draws um, MPa and N"):
        fret.plot.pressure_map(coated, units="ksi")
    assert "MPa" in fret.plot.pressure_profile(coated, units="MPa").get_ylabel()


def test_a_table_prints_the_columns_that_fit(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    lines = repr(fret.materials()).splitlines()
    heads = lines[0]
    for head in ("kind", "E [Pa]", "nu", "s_y [Pa]", "hardness [Pa]"):
        assert head in heads
    assert "more columns: s_u [Pa]" in next(line for line in lines if "more columns" in line)
    assert max(map(len, lines)) <= 80
    assert "1.185e+09" in next(line for line in lines if line.startswith("titanium_6Al4V"))
    monkeypatch.setenv("COLUMNS", "400")
    assert "more columns" not in repr(fret.materials()[["kind", "nu"]])


def test_a_refusal_of_a_changed_scene_names_no_line() -> None:
    path = fret.LoadPath.start().normal(W).force(T_x=1.0)
    with pytest.raises(fret.errors.InvalidSceneError) as refusal:
        sphere_on_flat(n=16).replace(path=path).replace({"mu": 1e-9})
    assert str(refusal.value).startswith("path[1].T_x = 1: must be")


@pytest.mark.solves
def test_words_of_summaries(coated: fret.Result) -> None:
    largest = coated.at(-1).stress().maximum("s_1")
    if largest.border == "rim":
        assert "at the rim of the contact" in repr(largest)
    crack = coated.crack(x=1e-5, angle=0.1)
    assert crack.summary().startswith("crack from x = 10 um, 5.73 deg from the normal")


@pytest.mark.filterwarnings("ignore")
@pytest.mark.solves
def test_a_worn_map_that_leaves_its_grid_names_the_grid_of_wear() -> None:
    path = fret.LoadPath.start().normal(W, increments=2).cycles(1, delta_x=5e-5, increments=8)
    scene = sphere_on_flat(n=16).replace(path=path)
    law = fret.wear.Archard(k=1e-12)
    with pytest.raises(fret.errors.OffGridError, match=r"Scene.ball_on_flat\(..., wear="):
        fret.wear.solve(scene, cycles=1e4, body2=law, progress=False)


@pytest.mark.parametrize("name", ["Sq", "Sa", "Sz", "Ssk", "S_ku"])
def test_a_map_has_the_parameters_of_the_standard(name: str) -> None:
    surface = fret.SurfaceMap(ROUGH, spacing=PITCH)
    assert getattr(surface, name) == getattr(surface.statistics(), name)
    assert fret.SurfaceMap(ROUGH, spacing=PITCH).Sq == pytest.approx(surface.rms, rel=1e-12)
    with pytest.raises(AttributeError, match="a SurfaceMap has no 'Sx'"):
        surface.Sx  # noqa: B018
    assert copy.copy(surface) == pickle.loads(pickle.dumps(surface)) == surface


def test_a_closed_form_of_partial_slip_shows_how_it_is_made() -> None:
    bodies = (fret.material("steel"), fret.material("steel"))
    with pytest.raises(TypeError, match=r"fret.reference.hertz\(R=.*stick_radius\(12.0\)"):
        fret.reference.CattaneoMindlin(R=5e-3, bodies=bodies, W=50.0, T=12.0, mu=0.5)
    with pytest.raises(TypeError, match=r"fret.reference.hertz\(R="):
        fret.reference.CattaneoMindlin(bodies=bodies, mu=0.5)
    hertz = fret.reference.hertz(R=5e-3, bodies=bodies, W=50.0)
    closed = fret.reference.CattaneoMindlin(hertz, bodies=bodies, mu=0.5)
    assert closed.stick_radius(12.0) == pytest.approx(hertz.a * (1 - 12.0 / 25.0) ** (1 / 3))


def test_figures_label_each_value_and_each_unit() -> None:
    _, ax = plt.subplots()
    coordinate = xr.DataArray([50.0, 100.0, 200.0, 400.0], dims="W", name="W")
    scale_axis(ax, "x", coordinate, {"W": parameter_label("W")})
    assert [text.get_text() for text in ax.get_xticklabels()] == ["50", "100", "200", "400"]
    plt.close("all")
    assert in_words("rig.stiffness", 5.985e6, per_metre=False) == "rig.stiffness = 5.985e+06 N/m"
    assert in_words("rig.stiffness", 5.985e6, per_metre=True) == "rig.stiffness = 5.985e+06"
    assert in_words("friction.mu", 0.5, per_metre=False) == "friction.mu = 0.5"


@pytest.mark.parametrize("name", ["error", "error_bars"])
def test_a_run_of_wear_is_not_asked_for_errors(name: str) -> None:
    with pytest.raises(TypeError, match=r'worn\.error_of\("depth"\)'):
        fret.wear.solve(sphere_on_flat(ratio=2.0, n=16), cycles=1e3, **{name: True})
