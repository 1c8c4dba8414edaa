"""Guesses of the first hour work: columns, items, choices, short keys, fits."""

from __future__ import annotations

import contextlib
import copy
import inspect
import pickle
import re
import sys
from pathlib import Path
from typing import Any, get_args

import numpy as np
import pandas as pd
import pytest
import xarray as xr

import pyfret as fret
from conftest import W, sphere_on_flat
from pyfret import _core
from pyfret._util.names import MEANT
from pyfret.fatigue.criteria import CriterionName
from pyfret.fit.ranges import USUAL
from pyfret.fit.search import estimate_unknowns, under_normal_force, without_defaults

pytestmark = [pytest.mark.solves, pytest.mark.filterwarnings("ignore")]


@pytest.fixture(scope="module")
def result() -> fret.Result:
    path = fret.LoadPath.start().normal(W, increments=2).cycles(1, T_x=90.0, increments=4)
    return fret.solve(sphere_on_flat(ratio=2.0, n=16), path, save="all", progress=False)


@pytest.fixture(scope="module")
def study() -> Any:
    scene = sphere_on_flat(ratio=2.0, n=16)
    path = fret.LoadPath.start().normal(W, increments=2)
    return fret.study.run(scene, {"mu": [0.3, 0.5]}, path=path, measure=["p_max"], progress=False)


def frames(result: fret.Result, study: Any) -> dict[str, pd.DataFrame]:
    return {
        "result": result.to_dataframe(),
        "snapshot": result.at(-1).to_dataframe(),
        "branches": result.branches().to_dataframe(),
        "loops": result.loops().to_dataframe(),
        "stress": result.at(-1).stress().to_dataframe(),
        "study": study.to_dataframe(),
        "materials": fret.materials(),
    }


def test_every_column_is_found_without_its_unit(result: fret.Result, study: Any) -> None:
    for name, frame in frames(result, study).items():
        for head in frame.columns:
            bare = str(head).split(" [")[0]
            pd.testing.assert_series_equal(frame[bare], frame[head])
            pd.testing.assert_series_equal(frame[[bare]].iloc[:, 0], frame[head])
        with pytest.raises(KeyError, match="no column 'nonsense'; there is"):
            frame["nonsense"]
        assert type(pickle.loads(pickle.dumps(frame))) is type(frame), name
        assert type(copy.copy(frame.head(1))) is type(frame)
    assert result.to_dataframe().T_x.max() == float(result.T_x.max())
    few = result.to_dataframe(columns=["delta_x", "T_x"], units={"delta_x": "um"})
    assert list(few.columns) == ["delta_x [um]", "T_x [N]"]


def test_every_array_of_a_result_is_an_item(result: fret.Result, study: Any) -> None:
    stress = result.at(-1).stress()
    for owner in (result, result.at(-1), stress, study):
        for name in dir(owner):
            if name.startswith("_"):
                continue
            try:
                array = getattr(owner, name, None)
            except ValueError:  # a number that this contact does not have
                continue
            if isinstance(array, xr.DataArray):
                np.testing.assert_array_equal(owner[name], array)
        with pytest.raises(KeyError, match="has no 'nonsense'"):
            owner["nonsense"]
        with pytest.raises(TypeError, match="must be the name of a variable"):
            owner[0]
    with pytest.raises(KeyError, match="did you mean von_mises"):
        stress["von_mises_"]
    table = result.branches()
    assert float(table[-1].W) == float(table.W[-1])
    with pytest.raises(KeyError, match="did you mean dissipated"):
        table["disipated"]


def test_a_result_is_gone_through_by_its_increments(result: fret.Result, study: Any) -> None:
    numbers = [int(snapshot.increment) for snapshot in result]
    assert numbers == result.dataset.saved_increment.values.tolist()
    with pytest.raises(TypeError, match="not iterable"):
        list(study)


def test_energies_have_names(result: fret.Result) -> None:
    """One word is used over increments, branches and cycles; the sum has a name of its own."""
    assert result.dissipated.long_name.endswith("in the increment")
    assert result.branches().dissipated.long_name.endswith("in the branch")
    assert result.loops().dissipated.long_name.endswith("in the cycle")
    assert result.dissipated_energy.long_name.endswith("since the start")
    for word in ("energy", "loop_energy", "dissipation"):
        with pytest.raises(AttributeError, match=r"each cycle.*since the start.*each branch.*each"):
            getattr(result, word)


@pytest.mark.parametrize("name", get_args(CriterionName))
def test_a_choice_is_taken_in_any_spelling(result: fret.Result, name: str) -> None:
    alloy = fret.fatigue.Materials()["steel_42CrMo4"]
    try:
        expected = result.life(alloy, name)
    except ValueError as refused:
        with pytest.raises(ValueError, match=re.escape(str(refused))):
            result.life(alloy, name.replace("_", " ").title())
        return
    for spelling in (name.upper(), name.replace("_", "-"), name.replace("_", " ").title()):
        assert result.life(alloy, spelling).criterion == expected.criterion


def test_a_place_is_a_length_with_a_unit(result: fret.Result) -> None:
    """Points and lines of every function that takes x or y."""
    state = result.at(-1)
    pairs: list[tuple[Any, Any]] = [
        (state.stress(x="1 um", y="-2 um"), state.stress(x=1e-6, y=-2e-6)),
        (state.stress(z=["3 um"], y="0 um"), state.stress(z=[3e-6], y=0.0)),
        (state.displacement(x="1 um", y="2 um"), state.displacement(x=1e-6, y=2e-6)),
        (state.along(y="1 um"), state.along(y=1e-6)),
        (result.envelope(z=["3 um"], y="1 um"), result.envelope(z=[3e-6], y=1e-6)),
    ]
    for with_unit, plain in pairs:
        first, second = (getattr(item, "dataset", item) for item in (with_unit, plain))
        xr.testing.assert_allclose(first, second)
    assert state.stick_zone(y="0 um") == state.stick_zone(y=0.0)
    with pytest.raises(TypeError, match="'3': must be a number, not a text: write 3"):
        fret.Scene.ball_on_flat("steel", "steel", R=1e-3, W=1.0, mu=0.3, cycles="3")  # type: ignore[arg-type]


def test_a_shortened_key_is_the_one_that_has_its_parts(study: Any) -> None:
    scene = sphere_on_flat(ratio=2.0, n=16).replace(path=fret.LoadPath.start().normal(W))
    for short, key in {
        "thickness": "body2.coatings.0.thickness",
        "coating.thickness": "body2.coatings.0.thickness",
        "R": "body1.shape.sphere.R",
        "body1.R": "body1.shape.sphere.R",
    }.items():
        value = 0.9 * (5e-6 if "thickness" in key else 0.018)
        assert scene.replace({short: value}) == scene.replace({key: value})
    with pytest.raises(ValueError, match=r"did you mean 'body1.E' or 'body2.E' or"):
        scene.replace({"E": 1e11})
    with pytest.raises(ValueError, match=r"'stick_rato'.*the nearest is stick_ratio"):
        fret.study.run(scene, {"mu": [0.3]}, measure="stick_rato", progress=False)
    with pytest.raises(TypeError, match=r"not a mapping.*def peak"):
        fret.study.run(scene, {"mu": [0.3]}, measure={"peak": len}, progress=False)  # type: ignore[arg-type]


def test_a_residual_stress_is_in_the_summary() -> None:
    film = fret.Coating("TiN", thickness="2 um", residual="-1 GPa")
    for residual, words in (
        ("-500 MPa", "residual stress -500 MPa"),
        ([(0.0, "-500 MPa"), ("100 um", "80 MPa")], "-500 to 80 MPa, to a depth of 100 µm"),
    ):
        body = fret.Body("Ti-6Al-4V", coatings=[film], residual=residual)
        scene = fret.Scene.ball_on_flat("steel", body, R=5e-3, W=20.0, mu=0.3, n=16, quiet=True)
        assert words in scene.summary()
        assert "residual stress -1000 MPa" in scene.summary()
    assert "residual" not in sphere_on_flat(n=16).summary()


def test_a_missing_argument_is_described() -> None:
    with pytest.raises(TypeError, match=r"ball_on_flat needs R \(Radius of the ball \[m\]\)"):
        fret.Scene.ball_on_flat("steel", "steel", W=2.0, mu=0.3)  # type: ignore[call-arg]
    with pytest.raises(AttributeError, match=r"Materials\(\).*number\('hardness'\)"):
        fret.material("steel").hardness  # type: ignore[attr-defined]  # noqa: B018


@pytest.mark.parametrize("name", ["pressure", "surface", "stress", "study", "loop", "slip"])
def test_a_short_name_of_a_figure_is_answered_once_figures_are_loaded(name: str) -> None:
    import pyfret.plot  # noqa: F401

    with pytest.raises(AttributeError, match=r"did you mean fret.plot"):
        getattr(fret.plot, name)


#: Variables of wear.
WORN = {"depth1", "depth2", "volume1", "volume2"}


def names_of_package() -> set[str]:
    """Names of functions and classes, of their parameters and attributes."""
    names = set()
    modules = [m for key, m in [*sys.modules.items()] if key.partition(".")[0] == "pyfret"]
    for member in (member for module in modules for member in vars(module).values()):
        callables = [member]
        if inspect.isclass(member):
            names.update(dir(member))
            names.update(getattr(member, "__annotations__", {}))
            callables += vars(member).values()
        for call in filter(callable, callables):
            with contextlib.suppress(TypeError, ValueError):
                names.update(inspect.signature(call).parameters)
    return names | {name for module in modules for name in vars(module)}


def test_words_of_others_lead_to_names(result: fret.Result) -> None:
    assert all(word == word.lower() or len(word) == 1 for word in MEANT)
    reachable = names_of_package() | set(_core.probe_labels()) | WORN
    reachable |= {*map(str, result.dataset.variables), *result.dataset.attrs}
    for word, words in MEANT.items():
        assert len(set(words)) == len(words)
        assert reachable.issuperset(words), word


@pytest.fixture(scope="module")
def pressed() -> fret.Scene:
    return fret.Scene.ball_on_flat(
        "steel", "Ti-6Al-4V", R=5e-3, W=10.0, T=4.0, mu=0.5, cycles=1, n=24, quiet=True
    )


def measured(scene: fret.Scene, shift: float, rig: float, noise: float) -> fret.fit.Loops:
    """Two cycles between two shifts of the contact behind a rig, with noise of the force."""
    path = fret.LoadPath.start().normal(10.0).cycles(1, delta_x=shift, increments=20)
    d = fret.solve(scene, path, progress=False).dataset
    branch = d.branch_of_increment.values
    kept = np.r_[np.flatnonzero(branch == 1)[-1], np.flatnonzero(branch > 1)][:-1]
    delta, force = (np.tile(d[name].values[kept], 2) for name in ("delta_x", "T_x"))
    scatter = noise * np.random.default_rng(0).normal(size=force.size)
    return fret.fit.Loops.from_arrays(delta + force / rig, force + scatter)


def test_a_column_is_named_by_its_head(tmp_path: Path) -> None:
    shift = np.sin(np.linspace(0.0, 9.0, 90))
    frame = pd.DataFrame({"s [um]": shift, "F [N]": 3.0 * shift, "x [um]": shift + 1.0})
    frame.to_csv(tmp_path / "loop.csv", index=False)
    heads, names = (
        fret.fit.read_loops(tmp_path / "loop.csv", delta=delta, T=T)
        for delta, T in (("s [um]", "F [N]"), ("s", "F"))
    )
    assert heads == names


def test_a_loop_alone_gives_friction_and_rig(pressed: fret.Scene) -> None:
    loops = measured(pressed, 3e-6, 1e7, 0.02)
    fitted = fret.fit(pressed, loops)
    assert list(fitted.known) == list(USUAL)
    assert fitted.known["mu"].low < 0.5 < fitted.known["mu"].high
    assert fitted.known["rig.stiffness"].low < 1e7 < fitted.known["rig.stiffness"].high
    assert fret.fit(pressed, loops, unknown=["mu", "rig.stiffness"])["mu"] == fitted["mu"]
    with pytest.raises(KeyError, match=r"no unknown 'rig.stiff'.*did you mean"):
        fitted["rig.stiff"]
    with pytest.raises(ValueError, match=r"body2.E needs its range"):
        fret.fit(pressed, loops, unknown=["body2.E"])
    alone = fret.fit(pressed, loops, unknown="mu")
    assert any('"rig.stiffness": (1e6, 1e9)' in doubt for doubt in alone.doubts)
    assert not any("rig.stiffness" in doubt for doubt in fitted.doubts)


def test_a_spring_that_hides_the_unknowns_is_left_out(pressed: fret.Scene) -> None:
    """A loop that hardly slides: with a spring and drifts beside it nothing would be resolved."""
    loops = measured(pressed, 0.95e-6, 1e7, 0.05)
    fitted = fret.fit(pressed, loops)
    assert fitted.left_out == ("tilt", "drift")
    assert fitted.is_resolved
    assert fitted.known["mu"].low < 0.5 < fitted.known["mu"].high
    assert fitted.known["rig.stiffness"].low < 1e7 < fitted.known["rig.stiffness"].high
    assert any("tilt=True fits it" in doubt for doubt in fitted.doubts)
    with_both = fret.fit(
        pressed, fret.fit.Loops.from_arrays(loops.delta, loops.T, tilt=True, drift=True)
    )
    assert with_both.left_out == ()


def test_where_a_search_for_a_loop_starts(pressed: fret.Scene) -> None:
    loops = measured(pressed, 3e-6, 1e6, 0.0)
    starts = estimate_unknowns(pressed, [loops])
    assert starts["mu"] == pytest.approx(0.55, rel=0.02)
    assert 0.9e6 < starts["rig.stiffness"] < 4e6
    assert without_defaults([loops])[1] == ("tilt", "drift")
    under = under_normal_force(pressed)
    assert [branch.W for branch in under.path.branches] == [10.0]
    assert under_normal_force(under) == under
