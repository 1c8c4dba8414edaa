"""Every public class: shown to people, pickled, copied, compared; immutable ones as keys."""

from __future__ import annotations

import copy
import inspect
import pickle
from collections.abc import Iterator
from types import ModuleType
from typing import Any

import numpy as np
import pytest
import xarray as xr

import pyfret as fret
from conftest import SAME_PROCESS, W, paper_path, sphere_on_flat
from pyfret.solution import Increment
from pyfret.verification import Check

pytestmark = pytest.mark.solves

STEEL = fret.Elastic(E=210e9, nu=0.3)
PAIR = (STEEL, fret.Elastic(E=70e9, nu=0.33))
HERTZ = fret.reference.hertz(R=0.018, bodies=PAIR, W=1e3)
COATING = fret.Coating(fret.Elastic(E=400e9, nu=0.25), thickness=HERTZ.a)
MATERIAL = fret.fatigue.Materials()["steel_42CrMo4"]
GRID = fret.Grid.centred(width=1e-3, n=4)
BODY = fret.Body(STEEL, coatings=[COATING], shape=fret.Sphere(0.01))
SPRINGS = fret.reference.Springs(HERTZ, R=0.018, bodies=PAIR, mu=0.3, n=20)
SPRINGS.load(W=1e3, T=100.0)
MAP = fret.SurfaceMap([[0.0, 1e-8], [2e-8, -0.0]], spacing=1e-6)
LAW = fret.wear.Archard(1e-14)
TURN = np.linspace(0.0, 6.0 * np.pi, 900)

ARREST = fret.fracture.CrackArrest("stops", 1e-5, 1e-4, (1e-4,), 0.9, 2e-4, 1.1, (1e-5, 3e-4))

#: A value of every class that needs no run; the members of enumerations are values as well.
VALUES: list[Any] = [
    fret.subsurface.Zone(-1e-4, 2e-4, 0),
    fret.fatigue.DamageLaw("original", 1e6, 5.0),
    fret.kernels.EigenstrainOperator(BODY, GRID, depth=1e-4, height=5e-5),
    fret.subsurface.Extremum(0.01, 1e-4, fret.subsurface.Place(0.0, 0.0, 1e-4), 0),
    fret.subsurface.Place(1e-4, 0.0, 2e-5),
    fret.fatigue.CyclicResponse("shakes down", 1, (1e-6, 0.0), (1e-3, 1e-3), 0.0, 0.0, None, 1.0),
    STEEL,
    COATING,
    BODY,
    GRID,
    MAP,
    fret.shapes.Flat(),
    fret.Sphere(0.01),
    fret.shapes.Ellipsoid(R_x=0.1, R_y=0.2),
    fret.Cylinder(R=0.1),
    fret.shapes.CrownedRoller(R=0.1, length=1e-3, crown=1.0),
    fret.shapes.Cone(slope=0.01),
    fret.shapes.Wedge(slope=0.01),
    fret.shapes.FlatPunch(radius=1e-3, edge=1e-4),
    fret.shapes.Ring(radius=1e-3, R=1e-2),
    fret.shapes.Ridges(R=1e-2, spacing=1e-4, count=3),
    fret.shapes.Waviness(amplitude=1e-7, wavelength=1e-5),
    fret.shapes.Rough(rms=1e-7, hurst=0.8, longest=1e-4, shortest=1e-5, seed=3),
    fret.Sphere(1.0) + MAP,
    fret.Friction(0.3, map=MAP, history=(fret.History.SLIP, [(0.0, 1.0), (1e-5, 2.0)])),
    fret.History.SLIP,
    fret.Spacing.EQUAL_RADIUS,
    fret.PerRange(40),
    fret.LoadPath.start().normal(1e3).tangential([50.0, -50.0]),
    fret.LoadPath.start().normal(1e3).branches[0],
    fret.Settings(save=[1, 2]),
    fret.settings.Skip(contact_window=False),
    fret.settings.Preset.SPINU2020,
    fret.settings.Hankel(),
    fret.settings.InverseFft(enlargement=4),
    fret.settings.FrequencyDomain(enlargement=4),
    fret.Profile.table([(0.0, 1.0), (1.0, 2.0)]),
    fret.Profile.power(top=1.0, bottom=2.0, exponent=0.5),
    fret.SurfaceOperator(BODY, fret.Body(STEEL), GRID),
    sphere_on_flat(n=8),
    HERTZ,
    fret.reference.hertz_ellipse(R_x=0.01, R_y=0.02, E_star=1e11, W=10.0),
    fret.reference.HertzStress(a=1e-3, nu=0.3),
    fret.reference.line_contact(R=0.01, bodies=PAIR, W=1e5),
    fret.reference.CattaneoMindlin(HERTZ, bodies=PAIR, mu=0.3),
    fret.reference.Lubkin(HERTZ, bodies=PAIR, mu=0.3),
    fret.reference.coupled_indentation(beta=0.2, mu=0.3),
    fret.reference.coated_indentation(
        R=0.018, indenter=STEEL, coating=COATING, substrate=STEEL, W=100.0
    ),
    SPRINGS,
    fret.fatigue.Criterion.findley(k=0.3),
    fret.fatigue.Criterion.fatemi_socie(E=2e11, nu=0.3, k=0.5, s_y=9e8),
    MATERIAL,
    MATERIAL.assessment("findley"),
    fret.fatigue.Materials()["steel_4340"].assessment("smith_watson_topper"),
    fret.fatigue.Materials(),
    fret.fatigue.Section(y=0.0),
    fret.heat.Conductor(conductivity=45.0, heat_capacity=3.6e6),
    fret.wear.Air(distance=1e-3, power_density=1e4, power_exponent=0.9),
    fret.wear.DebrisBed(kappa=1e-3),
    fret.wear.Archard(1e-14),
    fret.wear.DissipatedEnergy(1e-14),
    fret.study.Cracking(MATERIAL, "dang_van"),
    fret.study.WornDepth(cycles=100.0, body2=fret.wear.Archard(1e-14)),
    fret.fracture.buckling_release(COATING, -5e9, half_width=1e-3),
    fret.Bond(normal=1e-15, shear=2e-15),
    fret.fracture.Crack(legs=[(1e-4, 0.0), (1e-5, 0.3)]),
    fret.fracture.Threshold(dK_th=2.1e6),
    fret.fracture.Paris(C=1e-11, m=3.0),
    ARREST,
    fret.export.Frame(),
    fret.fracture.CrackLife(1e6, 1e-3, stopped=False, arrest=ARREST),
    fret.fracture.Cracks.from_arrays([1e-5, 1e-4], [1e6, 2e6], [0.0, 1e5]),
    fret.study.Arrest(fret.fracture.Threshold(dK_th=2.1e6)),
    fret.study.FirstToFail(toughness=90.0),
    fret.study.LargestStress("s_1", increments=[-1, 2]),
    fret.fracture.FailureOrder(1.1, 0.5, 0.2),
    fret.study.Averaged(MATERIAL, "crossland", L=5e-5),
    fret.study.ThresholdLoad(1e3, 5.0, 2, ((900.0, 1.1), (1100.0, 0.9)), 900.0, 1100.0),
    fret.study.Limits(MATERIAL, 5e-5, 0.9, 0.1, np.array([0.9, np.nan, 1.1]), (2e-5, 1e-4)),
    fret.experiments.icf13("FF_1", n=64),
    fret.experiments.fouvry2007("TiC"),
    fret.fit.Loops.from_arrays(1e-6 * np.cos(TURN), 5.0 * np.sin(TURN)),
    fret.fit.Indentation.from_arrays([1.0, 2.0], [1e-7, 2e-7]),
    fret.fit.Scar.from_arrays(1e-5 * TURN, 1e-6 * np.cos(TURN), wear={"cycles": 1e3, "body2": LAW}),
    fret.fit.Lives(1e3 * TURN, [{"mu": 0.3}] * TURN.size, {"body2": LAW}),
    fret.fatigue.Range(1e4, 2e4, 4e4),
    fret.Plastic(s_y=1e9, hardening=1e10),
    fret.fatigue.LifeRange(
        1e4, 2e4, 4e4, fret.fatigue.Range(1e4, 2e4, 4e4), 3.0, None, None, ("a note",)
    ),
    fret.study.Candidate(BODY, mu=0.3, residual=(-1e9, 0.0)),
    fret.fit.Posterior({"mu": 0.3 + 0.01 * np.cos(TURN)}, 0.1, 12),
]
#: Classes whose values may change or hold what may, which are no keys of a dict.
NO_KEYS = (
    *("Springs", "Material", "Assessment", "Materials", "Cracking", "Cracks", "Wear", "Candidate"),
    *("Averaged", "Limits", "Experiment", "Loops", "Indentation", "Scar", "Lives", "Posterior"),
)


def modules() -> list[ModuleType]:
    """pyfret and its public modules, the figures aside."""
    return [fret, *(m for n in fret.__all__ if inspect.ismodule(m := getattr(fret, n)))]


def classes() -> Iterator[type]:
    """Every public class that is neither an error nor a warning."""
    for module in modules():
        for name in module.__all__:
            thing = getattr(module, name)
            if inspect.isclass(thing) and not issubclass(thing, BaseException):
                yield thing


@pytest.fixture(scope="module")
def of_a_run() -> list[Any]:
    """A value of every class that a run gives."""
    scene = sphere_on_flat(ratio=2.0, n=16)
    path = fret.LoadPath.start().normal(W, increments=2).cycles(1, T_x=100.0, increments=4)
    result = fret.solve(scene, path, save="all", progress=False)
    life = result.life([MATERIAL, MATERIAL], "dang_van", [0.0, 1e-4])
    factors = result.load_factors(900e6, [0.0, 1e-4])
    stress = result.at(-1).stress()
    round_trip = fret.LoadPath.start().normal(W, increments=2)
    round_trip = round_trip.tangential([100.0, -100.0, 0.0], increments=6)
    worn = fret.wear.solve(scene, path=round_trip, cycles=10.0, jumps=1, body2=LAW, progress=False)
    study = fret.study.run(
        scene.replace(path=path),
        {"mu": [0.3]},
        measure="p_max",
        executor=SAME_PROCESS,
        progress=False,
    )
    compared = fret.compare(
        {"coated": scene.body2},
        scene,
        path,
        questions=["energy"],
        executor=SAME_PROCESS,
        progress=False,
    )
    march = fret.march(scene, paper_path(1, 9))
    curve = fret.fit.Indentation.from_arrays(
        W * np.array([0.3, 0.6, 1.0]), [6.1e-6, 9.6e-6, 1.33e-5]
    )
    of_path = scene.replace(path=path)
    fitted = fret.fit.fit(of_path, curve, unknown={"body2.E": (1e11, 4e11)})
    loop = ("loop", [1.0])
    damage = fret.fatigue.Damage(
        xr.Dataset(
            {
                "damage": (("depth", "x"), [[1e-3]]),
                "range": loop,
                "part": loop,
                "compressive": loop,
            },
            attrs={
                "place": [0.0, 0.0, 1e-5],
                "error_sources": "cells",
                "errors": [1e-4],
                "notes": "a note",
            },
        )
    )
    lengths = [1e-5, 2e-5]
    growth = fret.fracture.BlockGrowth(
        xr.Dataset({"growth": ("length", [1e-9, 2e-9])}, coords={"length": lengths})
    )
    return [
        result,
        result.at(-1),
        next(march),
        stress,
        stress.maximum(),
        stress.maximum().errors,
        life,
        life.worst,
        life.worst.errors,
        life.over_distance([1e-5, 2e-5]),
        compared,
        factors,
        factors.least(),
        worn,
        study,
        fitted,
        damage,
        growth,
        Check("what", "source", ours=1.0, truth=1.0, scale=1.0, last=0.0),
    ]


def check(value: Any) -> None:
    """Shown, pickled, copied, compared."""
    shown = repr(value)
    assert " object at 0x" not in shown, shown
    assert len(shown) < 2000, shown
    if isinstance(value, Increment):
        # A march ends with the process: what is pickled and copied is the increment.
        value = fret.Snapshot(value.dataset)
    whole = pickle.loads(pickle.dumps(value))
    for alternative in (whole, copy.copy(value), copy.deepcopy(value)):
        assert alternative == value, type(value)
        assert value != object()


@pytest.mark.parametrize("value", VALUES, ids=lambda v: type(v).__name__)
def test_a_value_is_shown_pickled_copied_compared(value: Any) -> None:
    check(value)
    assert type(pickle.loads(pickle.dumps(value))) is type(value)
    if type(value).__name__ not in NO_KEYS:
        assert hash(pickle.loads(pickle.dumps(value))) == hash(value)


def test_what_a_run_gives_is_shown_pickled_copied_compared(of_a_run: list[Any]) -> None:
    for value in of_a_run:
        check(value)
        there = type(pickle.loads(pickle.dumps(value)))
        assert there is (fret.Snapshot if isinstance(value, fret.Snapshot) else type(value))


def test_every_public_class_has_its_value_here(of_a_run: list[Any]) -> None:
    local = {kind for value in (*VALUES, *of_a_run) for kind in type(value).__mro__}
    assert {kind.__name__ for kind in classes() if kind not in local} == set()


def test_notebooks_show_tables(of_a_run: list[Any]) -> None:
    shown = (
        "Result",
        "Snapshot",
        "Stress",
        "Life",
        "OverDistance",
        "Comparison",
        "WearResult",
        "Study",
    )
    values = [sphere_on_flat(n=8), paper_path(1, 9), *of_a_run]
    for value in values:
        if type(value).__name__ in (*shown, "Scene", "LoadPath"):
            assert "<table" in value._repr_html_(), type(value)


def test_values_that_differ_are_unequal() -> None:
    lubkin = fret.reference.Lubkin(HERTZ, bodies=PAIR, mu=0.3)
    assert lubkin != fret.reference.Lubkin(HERTZ, bodies=PAIR, mu=0.4)
    fresh = fret.reference.Springs(HERTZ, R=0.018, bodies=PAIR, mu=0.3, n=20)
    assert fresh != SPRINGS
    assert fresh.load(W=1e3, T=100.0) > 0.0
    assert fresh == SPRINGS
    # What went through the same loads answers the same.
    there = pickle.loads(pickle.dumps(SPRINGS))
    assert there.load(W=1e3, T=-50.0) == fresh.load(W=1e3, T=-50.0)


def test_the_lists_of_public_modules_are_their_names() -> None:
    for module in (*modules(), fret.plot):
        assert sorted(module.__all__) == dir(module), module
        assert all(hasattr(module, name) for name in module.__all__)
    assert len(dir(fret)) <= 45


def test_a_run_is_the_same_in_memory_and_in_a_store(tmp_path: Any) -> None:
    scene = sphere_on_flat(ratio=2.0, n=16)
    path = fret.LoadPath.start().normal(W, increments=3).tangential(100.0, increments=3)
    for save in ("branches", "all", [2, 5]):
        in_process = fret.solve(scene, path, save=save, progress=False).dataset  # type: ignore[arg-type]
        position = tmp_path / f"{save}.zarr"
        there = fret.solve(scene, path, save=save, out=position, progress=False).dataset  # type: ignore[arg-type]
        xr.testing.assert_identical(in_process, there.load())
        assert {n: v.dtype for n, v in in_process.variables.items()} == {
            n: v.dtype for n, v in there.variables.items()
        }


def test_increments_of_a_march_are_those_of_a_run() -> None:
    scene = sphere_on_flat(ratio=2.0, n=16)
    path = fret.LoadPath.start().normal(W, increments=3).tangential(100.0, increments=3)
    result = fret.solve(scene, path, save="all", progress=False)
    assert "6.1 cells" in result.doubts[0]
    for increment in fret.march(scene.replace(save="all"), path):
        same = result.at(int(increment.increment)).dataset
        mine = increment.dataset
        xr.testing.assert_equal(mine, same)
        # How the run ends is known at its end; doubts are known up to the last increment.
        so_far = {"status": "done", "doubts": result.dataset.attrs["doubts"]}
        assert {**mine.attrs, **so_far} == same.attrs
        # Rounded down: fewer than eight is not printed as eight.
        cells = np.floor(10.0 * float(increment.cells_per_radius)) / 10.0
        assert f"{cells:.1f} cells" in increment.doubts[0]
        assert all(mine[name].attrs == same[name].attrs for name in mine.variables)
    assert increment.doubts == result.doubts
