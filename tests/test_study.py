"""Studies: every point once, whoever is killed on the way."""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
from decimal import Decimal
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
import xarray as xr

import pyfret as fret
from conftest import ROOT, SAME_PROCESS, R, W, sphere_on_flat
from dying import DEADLY, dies, dies_once
from pyfret import citation
from pyfret.plot.parameters import parameter_label
from pyfret.study.design import Design
from pyfret.study.measures import to_variables
from pyfret.study.outcome import open_study

pytestmark = pytest.mark.solves

#: A cycle, small.
PATH = fret.LoadPath.start().normal(W, increments=2).cycles(1, T_x=150.0, increments=6)
SCENE = sphere_on_flat(ratio=2.0, n=16).replace(path=PATH, title="study")
PARAMETERS = {"body2.coatings.0.E": [1e11, 4e11], "mu": [0.2, 0.3, 0.4]}
MEASURES = ["loop_energy", "stick_ratio", "p_max"]


def run(
    *, measure: Any = MEASURES, executor: Any = SAME_PROCESS, **options: Any
) -> fret.study.Study:
    return fret.study.run(
        SCENE, PARAMETERS, measure=measure, executor=executor, progress=False, **options
    )


def numbers(study: fret.study.Study) -> xr.Dataset:
    """All but the times."""
    return study.dataset.drop_vars("seconds")


@pytest.fixture(scope="module")
def whole() -> fret.study.Study:
    return run()


def test_sensitivity_is_the_part_of_the_variance() -> None:
    """The shares of a + b^2, which has no interaction, belong to the terms and add up to 1."""
    a, b = np.array([0.0, 1.0, 2.0]), np.array([-1.0, 0.5, 3.0, 4.0])
    sums = xr.DataArray(10.0 + a[:, None] + b[None, :] ** 2, {"a": a, "b": b}, name="sum")
    product = xr.DataArray(a[:, None] * (b - b.mean())[None, :], {"a": a, "b": b}, name="product")
    status = xr.full_like(sums, 1, dtype=np.int8).rename("status")
    study = fret.study.Study(xr.merge([sums, product, status]))
    parts = study.sensitivity("sum")
    assert list(parts.parameter.values) == ["b", "a"]
    np.testing.assert_allclose(parts.sel(parameter="a"), a.var() / (a.var() + (b**2).var()))
    np.testing.assert_allclose(parts.sum(), 1.0)
    # b alone moves the mean over a, a alone moves nothing: the rest is interaction.
    parts = study.sensitivity("product")
    np.testing.assert_allclose(parts.sel(parameter="a"), 0.0, atol=1e-12)
    np.testing.assert_allclose(parts.sel(parameter="b"), a.mean() ** 2 / (a**2).mean())
    holes = fret.study.Study(study.dataset.assign({"sum": sums.where(sums < 20.0)}))
    for item, of_study, expected in (
        ("sum", holes, "have no sum"),
        ("none", study, "must be one of"),
    ):
        with pytest.raises(ValueError, match=expected):
            of_study.sensitivity(item)


@pytest.mark.parametrize("second", [2.0, np.nan])
def test_a_map_says_where_a_point_that_is_done_has_no_value(second: float) -> None:
    axes = {"a": [1.0, 2.0], "b": [1.0, 2.0]}
    life = xr.DataArray([[1.0, second], [3.0, 4.0]], axes, name="life")
    status = xr.full_like(life, 1, dtype=np.int8).rename("status")
    legend = fret.study.Study(xr.merge([life, status])).map("life").get_legend()
    progress = [] if legend is None else [text.get_text() for text in legend.texts]
    assert progress == (["no value"] if np.isnan(second) else [])


def test_a_point_is_the_solution_of_its_scene(whole: fret.study.Study) -> None:
    assert whole.count() == {"open": 0, "done": 6, "failed": 0, "partly": 0}
    point = whole.dataset.isel({"body2.coatings.0.E": 1, "mu": 2})
    coat = fret.Coating(fret.Elastic(E=4e11, nu=0.3), thickness=SCENE.body2.coatings[0].thickness)
    scene = SCENE.replace(friction=0.4, body2=SCENE.body2.replace(coatings=[coat]))
    result = fret.solve(scene, progress=False)
    assert float(point.p_max) == float(result.dataset.p_max.max())
    assert float(point.stick_ratio) == float(result.stick_ratio[-1])
    assert float(point.loop_energy) == float(result.loops().dissipated[-1])
    assert int(point.nx) == 16
    assert point.p_max.attrs["units"] == "Pa"
    assert float(point.seconds) > 0


def test_values_in_step_and_samples(whole: fret.study.Study) -> None:
    sample = {"body2.coatings.0.E": np.array([1e11, 4e11]), "mu": np.array([0.3, 0.2])}
    study = fret.study.run(
        SCENE, sample, combine="zip", measure=MEASURES, executor=SAME_PROCESS, progress=False
    )
    assert study.dataset.sizes == {"point": 2}
    there = whole.dataset.p_max
    assert study.dataset.p_max.values.tolist() == [float(there[0, 1]), float(there[1, 0])]
    with pytest.raises(ValueError, match="must be the same"):
        fret.study.run(SCENE, {"mu": [0.1, 0.2], "grid.n": [16]}, combine="zip")


def tractions(result: fret.Result) -> dict[str, Any]:
    """A number and a field."""
    return {"cells": int(result.at(-1).contact.sum()), "pressure": result.at(-1).p}


def test_a_function_of_the_user_gives_numbers_and_fields() -> None:
    stiff = {"body2.coatings.0.E": [3e11, 4e11], "mu": [0.2, 0.3]}
    study = fret.study.run(SCENE, stiff, measure=["p_max", tractions], executor=SAME_PROCESS)
    assert study.dataset.pressure.dims == ("body2.coatings.0.E", "mu", "x", "y")
    assert (study.dataset.pressure.max(("x", "y")) <= study.dataset.p_max).all()
    assert (study.dataset.cells > 100).all()
    soft = fret.study.run(
        SCENE, {"body2.coatings.0.E": [3e11, 1e11]}, measure=tractions, executor=SAME_PROCESS
    )
    assert "{'x': 22, 'y': 22}" in soft.failed()[0][1]
    with pytest.raises(ValueError, match="field over x, y"):
        study.map("pressure")
    bad = run(measure=lambda result: np.zeros(3))
    assert "give an xarray.DataArray" in bad.failed()[0][1]


def test_failed_points_say_why_and_are_solved_again_if_asked(tmp_path: Path) -> None:
    where = {"mu": [0.1, 0.3]}  # 150 N are more than 0.1 of 1000 N
    options: dict[str, Any] = {
        "measure": MEASURES,
        "executor": SAME_PROCESS,
        "out": tmp_path / "s.zarr",
    }
    study = fret.study.run(SCENE, where, **options)
    ((values, reason),) = study.failed()
    assert values == {"mu": 0.1}
    assert "mu W" in reason
    assert np.isnan(study.dataset.p_max[0])
    solved: list[int] = []
    fret.study.run(SCENE, where, **options, on_point=lambda n, _: solved.append(n))
    assert solved == []
    fret.study.run(SCENE, where, **options, again=True, on_point=lambda n, _: solved.append(n))
    assert solved == [2]


def test_an_interrupted_study_goes_on(whole: fret.study.Study, tmp_path: Path) -> None:
    def stop(done: int, total: int) -> None:
        if done == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(out=tmp_path / "s.zarr", on_point=stop)
    half = fret.open(tmp_path / "s.zarr")
    assert half.count() == {"open": 4, "done": 2, "failed": 0, "partly": 0}
    assert "4 open, 2 done" in repr(half)
    progress: list[tuple[int, int]] = []
    study = run(out=tmp_path / "s.zarr", on_point=lambda *n: progress.append(n))
    assert progress == [(3, 6), (4, 6), (5, 6), (6, 6)]
    assert numbers(study).identical(numbers(whole))


def test_points_have_the_increments_of_the_middle_one_in_any_order(tmp_path: Path) -> None:
    """A point with chosen increments depends on its scene and on the middle one alone."""
    coated = sphere_on_flat(ratio=2.0, n=32)
    path = fret.LoadPath.start().normal(W).tangential(T_x=[150.0, -150.0])
    scene = coated.replace(path=path, title="chosen")
    parameters = {"mu": [0.3, 0.35, 0.4]}

    def solved(**options: Any) -> fret.study.Study:
        return fret.study.run(
            scene, parameters, measure=counted, executor=SAME_PROCESS, progress=False, **options
        )

    def stop(done: int, _: int) -> None:
        if done == 1:
            raise KeyboardInterrupt

    whole = numbers(solved())
    with pytest.raises(KeyboardInterrupt):
        solved(out=tmp_path / "s.zarr", on_point=stop)
    assert numbers(solved(out=tmp_path / "s.zarr")).drop_attrs().identical(whole.drop_attrs())
    middle = scene.replace({"mu": 0.35})
    alone = counted(fret.solve(middle, progress=False))
    for n, mu in enumerate(parameters["mu"]):
        point = whole.isel(mu=n)
        like = fret.solve(scene.replace({"mu": mu}), like=middle, progress=False)
        assert float(point["shift"]) == counted(like)["shift"]
        assert float(point["increments"]) == alone["increments"]


def counted(result: fret.Result) -> dict[str, float]:
    """The increments, and the shift at the end."""
    return {
        "increments": float(result.dataset.sizes["increment"]),
        "shift": float(result.delta_x[-1]),
    }


def test_the_store_of_another_study_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "s.zarr"
    fret.study.run(SCENE, {"mu": [0.3]}, measure="p_max", executor=SAME_PROCESS, out=path)
    with pytest.raises(fret.errors.StoreError, match="differ in parameters"):
        fret.study.run(SCENE, {"mu": [0.4]}, measure="p_max", executor=SAME_PROCESS, out=path)
    with pytest.raises(fret.errors.StoreError, match="it measures p_max, not q_max"):
        fret.study.run(SCENE, {"mu": [0.3]}, measure="q_max", executor=SAME_PROCESS, out=path)
    fret.solve(SCENE, out=tmp_path / "run.zarr", progress=False)
    with pytest.raises(fret.errors.StoreError, match="not the store of a study"):
        open_study(tmp_path / "run.zarr")


def test_a_grid_that_is_too_small_grows() -> None:
    small = SCENE.replace(grid=SCENE.grid.replace(dx=SCENE.grid.dx / 2.5, dy=SCENE.grid.dy / 2.5))
    softer = {"body2.coatings.0.E": [1e11]}
    study = fret.study.run(small, softer, measure="p_max", executor=SAME_PROCESS)
    assert study.count()["done"] == 1
    assert study.dataset.nx.item() > 16
    assert study.dataset.nx.item() == study.dataset.ny.item()
    kept = fret.study.run(small, softer, measure="p_max", executor=SAME_PROCESS, grow=False)
    assert kept.failed()[0][1].startswith("OffGridError")


def test_processes_share_the_points_and_one_may_die(
    whole: fret.study.Study, tmp_path: Path
) -> None:
    measure = partial(dies_once, tmp_path / "died")
    study = run(measure=[*MEASURES, measure], executor=2, out=tmp_path / "s.zarr")
    assert (tmp_path / "died").exists()
    assert numbers(study)[MEASURES].equals(numbers(whole)[MEASURES])
    assert (study.dataset.dies_once == study.dataset.p_max).all()


def test_a_point_that_kills_its_process_is_given_up() -> None:
    study = fret.study.run(SCENE, {"mu": [0.2, DEADLY, 0.4]}, measure=dies, executor=1)
    assert study.dataset.status.values.tolist() == [1, 2, 1]
    assert "killed 3 times" in study.failed()[0][1]


def test_a_cluster_of_dask_loses_nothing_with_a_worker(
    whole: fret.study.Study, tmp_path: Path
) -> None:
    distributed = pytest.importorskip("distributed")
    measure = partial(dies_once, tmp_path / "died")
    cluster = distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
    )
    progress: list[int] = []
    with cluster, distributed.Client(cluster) as client:
        study = run(
            measure=[*MEASURES, measure],
            executor=client,
            out=tmp_path / "s.zarr",
            on_point=lambda n, _: progress.append(n),
        )
    assert (tmp_path / "died").exists()
    assert progress == [1, 2, 3, 4, 5, 6]
    assert numbers(study)[MEASURES].equals(numbers(whole)[MEASURES])


def test_a_study_file_is_the_same_study(whole: fret.study.Study, tmp_path: Path) -> None:
    (tmp_path / "scene.toml").write_text(SCENE.to_toml())
    file = tmp_path / "study.toml"
    file.write_text(
        'scene = "scene.toml"\nmeasure = ["loop_energy", "stick_ratio", "p_max"]\n[parameters]\n'
        '"body2.coatings.0.E" = [1e11, 4e11]\n"mu" = { from = 0.2, to = 0.4, n = 3 }\n'
    )
    fret_binary = ROOT / "target" / "release" / "fret"
    command = [fret_binary, "study", file, "--workers", "1", "--map", tmp_path / "map.png"]
    environment = {**os.environ, "FRET_PYTHON": sys.executable}
    ran = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
    assert ran.returncode == 0, ran.stderr
    assert "6 done" in ran.stdout
    assert (tmp_path / "map.png").stat().st_size > 10_000
    computed = fret.open(tmp_path / "study.zarr")
    np.testing.assert_allclose(computed.dataset.mu, whole.dataset.mu)
    assert np.array_equal(computed.dataset.p_max[:, 0], whole.dataset.p_max[:, 0])
    file.write_text('scene = "scene.toml"\nparameter = 1\n')
    ran = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
    assert ran.returncode == 2
    assert "nearest valid key is `parameters`" in ran.stderr
    assert len(ran.stderr.strip().splitlines()) == 1


def test_stresses_wear_and_a_scene_file_with_its_measures(tmp_path: Path) -> None:
    text = (ROOT / "scenes" / "coated_small.toml").read_text()
    start = text.index("[[path]]\nT_x = { mu_W = -0.9 }\nincrements = 40\nt = 0.8")
    (tmp_path / "scene.toml").write_text(text[:start])
    thick = {"body2.coatings.0.thickness.a_H": [0.5, 1.0], "grid.n": [24]}
    worn = fret.study.WornDepth(1e4, body2=fret.wear.Archard(1e-14), first_branch=2)
    study = fret.study.run(
        tmp_path / "scene.toml",
        thick,
        measure=["von_mises", "interface_shear", worn],
        executor=SAME_PROCESS,
    )
    assert study.count()["done"] == 2, study.failed()
    d = study.dataset
    assert (d.von_mises > d.interface_shear).all()
    assert (d.worn_depth2 > 0).all()
    assert (d.worn_depth1 == 0).all()
    assert "coating_life2: its range is without the scatter of the wear" in study.summary()
    hertz = fret.reference.hertz(R=R, bodies=(SCENE.body1.substrate,) * 2, W=W)
    file = tmp_path / "scene.toml"
    varied = fret.Scene.from_file(file, set=["body2.coatings.0.thickness.a_H=0.5"])
    assert varied.body2.coatings[0].thickness == pytest.approx(0.5 * hertz.a, rel=1e-12)


def test_measures_have_their_range_or_are_called_estimates() -> None:
    """Every ready number of a study has a range, the word "about", or is a code."""
    steel = fret.fatigue.Materials()["steel_42CrMo4"]
    path = fret.LoadPath.start().normal(W, increments=2)
    for sign in (1, -1, 1):
        path = path.force(T_x=sign * 0.3 * SCENE.mu * W, increments=4)
    judged = [fret.study.Cracking(steel, item) for item in ("crossland", "smith_watson_topper")]
    cycle = SCENE.replace(path=path, save="all")
    pressed = SCENE.replace(path=fret.LoadPath.start().normal(W, increments=2), save="all")
    computed: dict[str, fret.study.Study] = {}
    for scene, measure in (
        (cycle, ["loop_energy", "stiffness", "regime", *judged]),
        (pressed, ["s_1"]),
    ):
        study = fret.study.run(
            scene,
            {"mu": [SCENE.mu, 1.2 * SCENE.mu]},
            measure=measure,
            executor=SAME_PROCESS,
            progress=False,
        )
        lines = {line.split()[0]: line for line in study.summary().splitlines()[2:]}
        d = study.dataset
        for name in study.measures:
            if f"{name}_low" in d:
                assert (d[f"{name}_low"] <= d[name]).all()
                assert (d[name] <= d[f"{name}_high"]).all()
                assert "(" in lines[name] or "endless" in lines[name], lines[name]
            else:
                assert ("about " in lines[name]) == (name != "regime"), lines[name]
            if name.startswith(("safety_factor", "life")):
                assert "of the mean over 72.41 um" in d[name].attrs["long_name"]
            computed[name] = study
    names = ["loop_energy", "stiffness", "regime", "safety_factor", "crack_depth"]
    assert list(computed) == [*names, "life_2", "crack_depth_2", "s_1"]
    for name in ("stiffness", "s_1", "safety_factor", "life_2"):
        assert f"{name}_low" in computed[name].dataset
    # A figure shows the errors of its numbers, and a line has its range.
    for name, pattern in (("s_1", ("±", "factor")), ("loop_energy", ("estimate",))):
        drawn = computed[name].map(name)
        assert any(word in drawn.get_ylabel() for word in pattern), drawn.get_ylabel()
        assert bool(drawn.collections) == (name == "s_1")


def test_maps_of_studies(whole: fret.study.Study) -> None:
    ax = whole.map("p_max")
    assert ax.get_ylabel() == r"$\mu$"
    line = fret.plot.study_map(whole, "p_max", at={"mu": 0.21})
    assert whole.plot("p_max").get_title() == ax.get_title()
    with pytest.raises(ValueError, match="of = 'nothing': must be one of"):
        whole.plot("nothing")
    assert "largest pressure of the path [GPa]" in line.get_ylabel()
    with pytest.raises(ValueError, match="must be one of"):
        whole.map("life")
    fine = fret.study.Study(
        whole.dataset.interp(
            mu=np.linspace(0.2, 0.4, 5), **{"body2.coatings.0.E": np.geomspace(1e11, 4e11, 5)}
        )
    )
    drawn = fine.map("p_max")
    assert drawn.get_xscale() == "log"
    assert len(drawn.collections) > 1


def test_what_is_no_study_is_refused() -> None:
    with pytest.raises(ValueError, match="no parameters"):
        fret.study.run(SCENE, {})
    with pytest.raises(ValueError, match="has no values"):
        fret.study.run(SCENE, {"mu": []})
    with pytest.raises(ValueError, match='E1/E2: a "/" parts folders'):
        fret.study.run(SCENE, {"E1/E2": [1.0]})
    with pytest.raises(ValueError, match="must be a list"):
        fret.study.run(SCENE, {"mu": 0.3})
    with pytest.raises(ValueError, match="loop_energy"):
        fret.study.run(SCENE, {"mu": [0.3]}, measure="energy")
    with pytest.raises(TypeError, match="number of processes"):
        fret.study.run(SCENE, {"mu": [0.3]}, executor="many")
    with pytest.raises(ValueError, match="nearest valid key"):
        fret.study.run(SCENE, {"body2.coatings.0.modulus": [1e-5]}, executor=SAME_PROCESS)


def test_a_study_can_be_pickled(whole: fret.study.Study) -> None:
    assert pickle.loads(pickle.dumps(whole)).dataset.identical(whole.dataset)


def test_sources_are_those_of_the_bibliography() -> None:
    known_values = (ROOT / "references.bib").read_text()
    assert all(source.doi in known_values for source in citation.sources())
    assert "10.1115/1.3261591" in fret.cite(SCENE)
    assert "10.1115/1.3261591" not in fret.cite(sphere_on_flat())


def test_keys_of_the_path_may_be_those_of_all_branches_and_of_an_amplitude() -> None:
    path = fret.LoadPath.start().normal(1e3, increments=1).cycles(1, delta_x=1e-6, increments=2)
    scene = sphere_on_flat(n=16).replace(path=path)
    amplitude = "path.1.delta_x,-path.2.delta_x,path.3.delta_x"
    made = scene.replace({"path.*.W": 500.0, amplitude: 3e-6})
    assert [branch.W for branch in made.path.branches] == [500.0] * 4
    assert [branch.delta_x for branch in made.path.branches[1:]] == [3e-6, -3e-6, 3e-6]
    # Of the first branch alone: the others go back to the old force, which is hardly meant.
    with pytest.warns(fret.errors.SceneWarning, match=r"path\.\*\.W sets all"):
        alone = scene.replace({"path.0.W": 500.0})
    assert [branch.W for branch in alone.path.branches] == [500.0, 1e3, 1e3, 1e3]
    assert parameter_label(amplitude) == (r"amplitude of $\delta_x$ [µm]", 1e-6)
    assert parameter_label("path.*.W", per_metre=True) == ("$W$ [N/m]", 1.0)


def test_a_friction_law_of_ones_own_goes_with_the_scene() -> None:
    def law(x: object, y: object, p: object, slip: object, dissipated: object) -> float:
        return 0.3

    path = fret.LoadPath.start().normal(1e3, increments=1)
    scene = sphere_on_flat(n=16).replace(friction=fret.Friction(0.3, law=law), path=path)
    made = scene.replace({"solver.path_tolerance": 0.01})
    assert made.friction.law is law
    assert scene.replace({"mu": 0.4}).friction == fret.Friction(0.4, law=law)


def test_a_store_of_another_friction_law_is_another_study(tmp_path: Path) -> None:
    def constant(x: object, y: object, p: object, slip: object, dissipated: object) -> float:
        return 0.3

    def higher(x: object, y: object, p: object, slip: object, dissipated: object) -> float:
        return 0.5

    path = fret.LoadPath.start().normal(1e3, increments=1)
    position = tmp_path / "laws.zarr"

    def solve(law: Any) -> fret.study.Study:
        scene = sphere_on_flat(n=16).replace(friction=fret.Friction(0.3, law=law), path=path)
        return fret.study.run(
            scene, {"path.0.W": [900.0]}, measure="p_max", executor=1, out=position, progress=False
        )

    solve(constant)
    solve(constant)
    with pytest.raises(fret.errors.StoreError, match=r"another study.*law"):
        solve(higher)


@pytest.mark.parametrize(
    ("parameters", "expected"),
    [
        ({"path.0.W": [10.0], "path[0].W": [9.0]}, "set path.0.W twice"),
        ({"mu": {0.2, 0.3}}, "must be a list"),
        ({"mu": {0.2: 1}}, "must be a list"),
        ({"mu": np.ma.masked_equal([0.2, 0.3], 0.3)}, "masked"),
        ({"mu": [0.2j]}, "must be a number, a text"),
        ({"mu": xr.DataArray([[0.2]], dims=("a", "b"))}, "axes a, b"),
    ],
)
def test_values_of_parameters_come_through_the_door(
    parameters: dict[str, object], expected: str
) -> None:
    with pytest.raises((ValueError, TypeError), match=expected):
        Design.from_values(parameters, "grid").check(SCENE)


def test_values_of_parameters_in_any_form() -> None:
    for values in (
        np.array([0.2, 0.3]),
        xr.DataArray([0.2, 0.3], dims="q"),
        pd.Series([0.2, 0.3], index=[7, 1]),
        [Decimal("0.2"), Fraction(3, 10)],
        (np.float32(0.2), 0.3),
    ):
        computed = Design.from_values({"mu": values}, "grid").parameters["mu"]
        assert computed == pytest.approx([0.2, 0.3])
    assert Design.from_values({"grid.n": range(8, 12, 2)}, "grid").parameters["grid.n"] == [8, 10]


def test_what_a_measure_gives_is_a_number_or_missing() -> None:
    arguments = {"masked": np.ma.masked, "none": None, "truth": True, "series": xr.DataArray(2.0)}
    computed = to_variables(arguments, "all")
    assert np.isnan([float(computed[name]) for name in ("masked", "none")]).all()
    assert [float(computed[name]) for name in ("truth", "series")] == [1.0, 2.0]
    for wrong in (np.zeros(3), 1j, "a", xr.DataArray(np.array([object()]), dims="k")):
        with pytest.raises((TypeError, ValueError)):
            to_variables(wrong, "all")
