"""Wear from Python: laws, results, stores, figures."""

from __future__ import annotations

import base64
import contextlib
import gzip
import json
import re
import subprocess
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import pyfret as fret
from conftest import ROOT
from pyfret._core import with_error

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.solves

STEEL = fret.Elastic(E=200e9, nu=0.3)


def line(n: int = 96) -> fret.Scene:
    """Give a cylinder that slides to and fro on a flat, both of steel."""
    path = fret.LoadPath.start().normal(18.5e3, increments=1)
    for to in (20e-6, -20e-6, 20e-6):
        path = path.displace(delta_x=to, increments=3)
    return fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Cylinder(R=6e-3)),
        body2=fret.Body(STEEL),
        friction=0.9,
        grid=fret.Grid.strip(extent=0.5e-3, n=n),
        path=path,
    )


def worn(law: object, **options: object) -> fret.wear.WearResult:
    """Wear the flat of :func:`line` by a law."""
    return fret.wear.solve(
        line(), cycles=2000, first_branch=2, cycling="sliding", body2=law, progress=False, **options
    )


def test_a_law_of_ones_own_that_says_the_same_wears_the_same() -> None:
    built_in = worn(fret.wear.Archard(2e-14))
    own_values = worn(
        lambda pressure_times_slip, slip_distance, dissipated, worn, cycles: (
            2e-14 * pressure_times_slip
        )
    )
    assert np.allclose(built_in.worn2, own_values.worn2, rtol=1e-9, atol=0)
    energy = worn(
        lambda pressure_times_slip, slip_distance, dissipated, worn, cycles: (
            2e-14 / 0.9 * dissipated
        )
    )
    assert np.allclose(built_in.worn2, energy.worn2, rtol=1e-9, atol=0)


def test_volume_follows_from_energy_and_depth() -> None:
    result = worn(fret.wear.DissipatedEnergy(2e-14))
    d = result.dataset
    assert np.allclose(d.volume2, 2e-14 * d.dissipated, rtol=1e-9)
    assert np.isclose(float(d.worn2[-1].max()), float(d.depth2[-1]))
    assert float(d.cycles[-1]) == 2000
    assert d.worn1.max() == 0
    assert "2000 cycles" in repr(result)


def test_a_store_is_the_result(tmp_path: Path) -> None:
    in_memory = worn(fret.wear.Archard(2e-14))
    stored = worn(fret.wear.Archard(2e-14), out=tmp_path / "wear.zarr")
    assert in_memory.dataset.equals(stored.dataset.load())
    assert fret.wear.resume(tmp_path / "wear.zarr", progress=False).status == "done"
    with pytest.raises(fret.errors.StoreError, match="exists"):
        worn(fret.wear.Archard(2e-14), out=tmp_path / "wear.zarr")


def test_bad_input_is_refused_by_name() -> None:
    with pytest.raises(fret.errors.ArgumentError, match=r"wear\.body2\.k = -0"):
        worn(fret.wear.Archard(-1e-14))
    with pytest.raises(TypeError, match="wear law"):
        worn("archard")
    with pytest.raises(fret.errors.ArgumentError, match=r"wear\.law"):
        worn(lambda *_: np.zeros(3))
    with pytest.raises(fret.errors.ArgumentError, match="nothing grows"):
        worn(lambda pressure_times_slip, *_: -pressure_times_slip)
    with pytest.raises(fret.errors.ArgumentError, match=r"wear\.tolerance = 3"):
        worn(fret.wear.Archard(1e-14), tolerance=3.0)


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ({"cycling": "slide"}, r'cycling = "slide": must be "auto" or "march" or "sliding"'),
        ({"worn_through": "on"}, r'worn_through = "on": must be "stop" or "go_on"'),
        ({"jumps": -1}, r"jumps = -1: must be a whole number >= 1"),
        ({"first_branch": 0}, r"first_branch = 0: must be a whole number >= 1"),
        ({"tolerance": 0.01, "jumps": 3}, "one of tolerance, jumps, explicit_jumps at most"),
        ({"share1": 0.5}, r"share1 = 0.5: must come with a law, body1"),
    ],
)
def test_options_are_refused_by_name(options: dict[str, Any], expected: str) -> None:
    wears: dict[str, Any] = {"cycles": 10, "first_branch": 2, "body2": fret.wear.Archard(1e-14)}
    with pytest.raises(ValueError, match=expected):
        fret.wear.solve(line(), progress=False, **{**wears, **options})


def test_figures_are_drawn() -> None:
    result = worn([fret.wear.Archard(2e-14)])
    axes = fret.plot.wear_profiles(result)
    assert axes.get_ylabel() == "worn depth [µm]"
    assert len(axes.lines) > 2
    assert result.plot.wear_history().get_xlabel() == "cycles"
    assert result.plot.depth_map(of="body2").figure is not None
    assert fret.plot.wear_history(result).get_xlabel() == "cycles"
    assert len(fret.plot.wear_loops(result).lines) == 2


def test_debris_that_stays_makes_scars_narrow_and_deep() -> None:
    law = fret.wear.Archard(2e-13)
    free, kept = worn(law), worn(law, debris_kept=0.85)
    assert np.isclose(free.volume2[-1], kept.volume2[-1], rtol=1e-3)
    assert float(kept.depth2[-1]) > 1.2 * float(free.depth2[-1])
    assert np.isclose(kept.debris[-1], 0.85 * kept.volume2[-1])
    assert np.allclose(kept.gap, 0.15 * kept.worn)
    assert "debris: 0.85" in kept.summary()
    for line in kept.summary().splitlines():
        if line.startswith(("body ", "debris", "energy", "largest", "thinned", "worn")):
            assert "+-" in line or "about " in line, line


def test_lives_are_told_at_their_cycle() -> None:
    d = worn(fret.wear.Archard(2e-13), jumps=40)
    depth, volume = 0.4 * float(d.depth2[-1]), 0.6 * float(d.volume2[-1])
    for pattern, name, value in (
        (d.cycles_to(depth=depth), "depth2", depth),
        (d.cycles_to(volume=volume), "volume2", volume),
    ):
        curve = np.interp(value, np.r_[0, d.dataset[name]], np.r_[0, d.dataset.cycles])
        assert np.isclose(pattern, curve, rtol=2e-3)
    few = worn(fret.wear.Archard(2e-13), jumps=10)
    assert np.isclose(few.cycles_to(depth=depth), d.cycles_to(depth=depth), rtol=0.03)
    beyond, end = d.cycles_to(depth=1.0), float(d.cycles[-1])
    assert np.isnan(beyond)
    assert beyond.beyond == end
    assert str(beyond) == f"more than {end:g} cycles (the run ended there)"
    least = d.range_of_cycles(depth=1.0)
    assert np.isnan(least.best)
    assert least.low < end
    assert "scatter included (the run ended before)" in repr(least)
    # The other body does not wear.
    assert d.cycles_to(depth=1e-9, body_number=1) == np.inf
    assert "nothing wears" in repr(d.range_of_cycles(depth=1e-9, body_number=1))
    with pytest.raises(ValueError, match="give one of them"):
        d.cycles_to()
    with pytest.raises(ValueError, match="has 0 coatings"):
        d.cycles_to(part_of_coating=0.5)


def test_a_run_goes_on_from_worn_surfaces(tmp_path: Path) -> None:
    law = fret.wear.Archard(8e-14)
    first = worn(law, jumps=8)
    second = worn(law, jumps=8, start=first)
    assert float(second.cycles[-1]) == 4000
    assert float(second.depth2[-1]) > float(first.depth2[-1])
    depth = float(second.depth2[0])
    for name in ("saved.zarr", "saved.nc"):
        second.save(tmp_path / name)
        again = fret.open(tmp_path / name)
        assert again == second
        assert again.cycles_to(depth=depth) == second.cycles_to(depth=depth)
        with pytest.raises(FileExistsError, match=name):
            second.save(tmp_path / name)
    fret.solve(line(), progress=False).save(tmp_path / "run.zarr")
    assert isinstance(fret.open(tmp_path / "run.zarr"), fret.Result)
    with pytest.raises(TypeError, match="must be a run of wear"):
        worn(law, start=fret.open(tmp_path / "run.zarr"))
    for name in ("none.zarr", "none.nc"):
        with pytest.raises(fret.errors.StoreError, match=name):
            fret.open(tmp_path / name)


def test_coefficients_change_by_a_table() -> None:
    table = [(0.0, 1.0), (2000.0, 3.0)]
    law = fret.wear.Archard(2e-14, factor=("cycles", table))
    assert law.factor == ("cycles", tuple(table))
    assert law == law.replace(k=2e-14)
    twice = worn(law, jumps=10).volume2[-1] / worn(fret.wear.Archard(2e-14), jumps=10).volume2[-1]
    assert np.isclose(twice, 2.0, rtol=1e-3)
    power = fret.wear.DissipatedEnergy(2e-14, factor=("power_density", [(0.0, 0.5)]))
    with pytest.raises(fret.errors.ArgumentError, match=r"wear\.frequency.*must be given in Hz"):
        worn(power)
    half = worn(power, frequency=5.0).dataset
    assert np.isclose(half.volume2[-1], 1e-14 * half.dissipated[-1])
    with pytest.raises(
        ValueError, match=r'factor\.of = "weekdays": must be "cycles" or "pressure"'
    ):
        worn(fret.wear.Archard(1e-14, factor=("weekdays", table)))


def test_what_is_left_open_is_chosen() -> None:
    scene = line()
    path = fret.LoadPath.start().normal(18.5e3).displace(delta_x=[20e-6, -20e-6, 20e-6])
    law = fret.wear.Archard(2e-14)
    result = fret.wear.solve(
        scene, path=path, cycles=100, cycling="sliding", body2=[law], jumps=1, progress=False
    )
    assert float(result.volume2[-1]) > 0
    with pytest.raises(fret.errors.ArgumentError, match="no closed cycle"):
        fret.wear.solve(
            scene, path=fret.LoadPath.start().normal(1e3), cycles=1, body2=law, progress=False
        )


def test_a_function_is_given_again_to_go_on(tmp_path: Path) -> None:
    def law(pressure_times_slip: Any, *_: Any) -> Any:
        return 2e-14 * pressure_times_slip

    def fails(
        pressure_times_slip: Any, slip_distance: Any, dissipated: Any, worn: Any, cycles: float
    ) -> Any:
        if cycles > 500:
            raise RuntimeError("the laboratory is closed")
        return law(pressure_times_slip)

    store = tmp_path / "wear.zarr"
    with pytest.raises(fret.errors.ArgumentError, match="the laboratory is closed"):
        worn(fails, jumps=8, out=store)
    with pytest.raises(fret.errors.ArgumentError, match="given again"):
        fret.wear.resume(store, progress=False)
    resumed = fret.wear.resume(store, body2=law, progress=False)
    assert np.array_equal(resumed.worn2, worn(law, jumps=8).worn2)


def test_friction_falls_over_cycles() -> None:
    mu = fret.Friction(0.9, history=(fret.History.CYCLES, [(0.0, 1.0), (2000.0, 0.5)]))
    scene = line().replace(friction=mu)
    falls = fret.wear.solve(
        scene,
        cycles=2000,
        cycling="sliding",
        body2=fret.wear.Archard(1e-16),
        jumps=6,
        progress=False,
    )
    plain = worn(fret.wear.Archard(1e-16), jumps=6)
    assert np.isclose(falls.dissipated[-1] / plain.dissipated[-1], 0.75, rtol=1e-3)


def test_a_rig_acts_in_every_run() -> None:
    scene = line(160)
    shifted = scene.path.branches[-1].delta_x
    stiff = fret.solve(scene, progress=False)
    soft = fret.solve(scene, rig_stiffness=5e9, progress=False)
    assert float(soft.delta_x[-1]) == shifted
    assert float(soft.dataset.dissipated.sum()) < float(stiff.dataset.dissipated.sum())
    again = fret.Scene.from_toml(scene.replace(path=scene.path.rig(5e9)).to_toml())
    assert again.path.rig_stiffness == 5e9


FILE = """
schema = 1
[body1]
shape.cylinder.R = "6 mm"
E = "200 GPa"
nu = 0.3
[body2]
shape = "flat"
E = "200 GPa"
nu = 0.3
[friction]
mu = 0.9
[grid]
n = 96
extent = "0.5 mm"
plane_strain = true
[[path]]
W = "18.5 N/mm"
increments = 1
[[path]]
delta_x = "20 um"
increments = 3
[[path]]
delta_x = "-20 um"
increments = 3
[[path]]
delta_x = "20 um"
increments = 3
[wear]
cycles = 2000
first_branch = 2
cycling = "sliding"
body2.k = 2e-14
"""


def test_a_scene_file_is_worn_as_it_says(tmp_path: Path) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(FILE)
    law = fret.wear.Archard(2e-14)
    wear = fret.wear.Wear(2000, body2=law, first_branch=2, cycling="sliding")
    in_process = fret.wear.solve(line(), wear, progress=False)
    there = fret.wear.solve(file, progress=False)
    assert there.dataset.wear == in_process.dataset.wear
    assert np.allclose(in_process.worn2, there.worn2, rtol=1e-9, atol=0)
    twice = fret.wear.solve(file, cycles=4000, progress=False)
    assert float(twice.cycles[-1]) == 4000


def test_the_nearest_name_of_a_setting_is_offered() -> None:
    with pytest.raises(TypeError, match=r"no argument 'debris': the nearest is 'debris_kept'"):
        fret.wear.solve(line(), cycles=10, debris=0.5)
    with pytest.raises(TypeError, match="cycles: must be given"):
        fret.wear.solve(line(), body2=fret.wear.Archard(1e-14))


@pytest.mark.usefixtures("without_overview")
@pytest.mark.parametrize("cycling", ["sliding", "march"])
def test_the_rig_of_a_run_of_wear_is_in_its_scene_and_on_its_page(
    cycling: str, tmp_path: Path
) -> None:
    K = 24e9
    run = fret.wear.solve(
        line(48),
        cycles=100,
        cycling=cycling,
        rig_stiffness=K,
        jumps=1,
        body2=fret.wear.Archard(2e-14),
        progress=False,
    )
    stored = fret.Scene.from_toml(run.dataset.attrs["scene"])
    assert stored.path.rig_stiffness == run.scene.path.rig_stiffness == K
    assert f"stiffness = {K}" in run.dataset.attrs["scene"]
    fret.solve(run.scene, progress=False).report(tmp_path / "page.html", wear=run)
    text = (tmp_path / "page.html").read_text(encoding="utf-8")
    numbers = next(
        json.loads(matches)
        for matches in (
            gzip.decompress(base64.b64decode(item)) for item in re.findall(r"H4sI[\w+/=]*", text)
        )
        if matches.startswith(b"{")
    )
    # The page draws the loops of the result and of its figure.
    axes = fret.plot.wear_loops(run)
    for drawn, loop in zip(axes.lines, numbers["wear"]["loops"], strict=True):
        assert np.allclose(drawn.get_xdata(), loop["x"], rtol=1e-4, atol=1e-9)
        assert np.allclose(drawn.get_ydata(), loop["y"], rtol=1e-4, atol=1e-6)
    # The loop of the contact on the same page has the rig as well: as long and as high.
    for key, name in (("x", "loop_delta_x"), ("y", "loop_T_x")):
        computed = np.ptp(np.array(numbers["loop"][key], dtype=float))
        scale = 1e6 if key == "x" else 1.0
        assert np.isclose(computed, scale * np.ptp(run.dataset[name][0].values), rtol=0.01)


def test_a_store_with_the_rig_in_its_table_of_wear_still_has_it() -> None:
    run = worn(fret.wear.Archard(2e-14), jumps=1)
    d = run.dataset
    assert run.scene.path.rig_stiffness is None
    before = d.assign_attrs(
        wear=d.attrs["wear"].replace("cycles =", "rig_stiffness = 5e9\ncycles =")
    )
    assert fret.wear.WearResult(before).scene.path.rig_stiffness == 5e9


def test_a_coating_that_is_worn_through_has_its_cycles() -> None:
    """A substrate that wears faster than its coating: the run ends at the bottom to rounding."""
    coated = fret.Body(STEEL, coatings=fret.Coating(STEEL, thickness=2e-7))
    run = fret.wear.solve(
        line(64).replace(body2=coated),
        cycles=1e5,
        first_branch=2,
        cycling="sliding",
        body2=[fret.wear.Archard(1e-15), fret.wear.Archard(1e-14)],
        progress=False,
    )
    assert [event["kind"] for event in run.events][-1] == "worn through"
    assert run.cycles_to(part_of_coating=1.0) == pytest.approx(run.events[-1]["cycles"], rel=1e-6)
    # The same of a depth that is missed by rounding.
    last = float(run.dataset.depth2[-1])
    assert run.cycles_to(depth=last * (1.0 + 5e-10)) == pytest.approx(float(run.cycles[-1]))
    assert run.cycles_to(depth=1.001 * last).beyond == float(run.cycles[-1])
    with pytest.raises(AttributeError, match=r"its \.dataset\.isel\(jump=-1, .*block=-1"):
        run.at(-1)
    # Every event is printed with the error of its jump.
    ends = run.dataset.cycles.values
    for event in run.events:
        at = int(np.searchsorted(ends, event["cycles"] * (1.0 - 1e-12)))
        part = float(run.dataset.depth_error[at])
        assert event["cycles_error"] == pytest.approx(part * event["cycles"])
        arguments = with_error(event["cycles"], event["cycles_error"])
        assert f"{event['kind']} after {arguments} cycles" in run.summary()


def test_the_scar_is_estimated_with_its_coating() -> None:
    """The warning before a run follows the layers: one that ends in a coating has no wide scar."""
    laws = [fret.wear.Archard(1e-15), fret.wear.Archard(1e-13)]
    bare = line(32)
    coated = bare.replace(body2=fret.Body(STEEL, coatings=fret.Coating(STEEL, thickness=2e-7)))
    settings: dict[str, Any] = {"first_branch": 2, "cycling": "sliding", "progress": False}

    def cycles_on_grid(scene: fret.Scene, body2: Any, **changes: Any) -> float:
        """Read the warning before a run, which need not reach its end."""
        off_grid = contextlib.suppress(fret.errors.OffGridError)
        with pytest.warns(UserWarning, match="the scar becomes") as seen, off_grid:
            fret.wear.solve(scene, cycles=1e5, body2=body2, jumps=1, **(settings | changes))
        number = re.search(r"leaves it after about ([0-9.e+]+) cycles", str(seen[0].message))
        assert number
        return float(number[1])

    # The coating lasts a hundred times as long as the substrate: it comes first.
    through = cycles_on_grid(coated, laws, worn_through="go_on")
    assert through > 1.5 * cycles_on_grid(bare, laws[1])
    with warnings.catch_warnings():
        warnings.filterwarnings("error", message=".*the scar becomes")
        run = fret.wear.solve(coated, cycles=1e5, body2=laws, **settings)
    assert run.events[-1]["kind"] == "worn through"


def test_the_largest_pressure_of_worn_surfaces_has_an_error_or_is_singular() -> None:
    """Gross slip: the error covers four times the cells. Partial slip: there is no number."""
    law = fret.wear.Archard(2e-14)
    settings: dict[str, Any] = {"cycles": 2000, "first_branch": 2, "body2": law, "progress": False}
    coarse, fine = (fret.wear.solve(line(n), cycling="sliding", **settings) for n in (48, 192))
    p, error = float(coarse.dataset.p_max[-1]), float(coarse.dataset.p_max_error[-1])
    assert 0.0 < error < 0.3
    assert abs(float(fine.dataset.p_max[-1]) / p - 1.0) < 1.5 * error
    assert "largest pressure: " in coarse.summary()
    assert "singular" not in coarse.summary()
    path = fret.LoadPath.start().normal(18.5e3, increments=1).cycles(2, T_x=8e3, increments=4)
    scene = line(48).replace(path=path)
    sticks = fret.wear.solve(scene, jumps=1, **(settings | {"first_branch": None}))
    assert float(sticks.dataset.stick_ratio[-1]) > 0.0
    assert np.isinf(sticks.dataset.p_max_error[-1])
    assert "largest pressure: singular at the border of the stick zone" in sticks.summary()


def test_the_loop_of_a_run_of_wear_is_that_of_its_scene_but_for_wear() -> None:
    """A cycle that wears nothing: the scene's second one; in sliding without the elastic shift."""
    W, mu, to = 50.0, 0.6, 20e-6
    a = fret.reference.hertz(R=10e-3, bodies=(STEEL, STEEL), W=W).a
    scene = fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Sphere(R=10e-3)),
        body2=fret.Body(STEEL),
        friction=mu,
        grid=fret.Grid.centred(width=2.8 * a, n=24),
        path=fret.LoadPath.start().normal(W, increments=2).cycles(2, delta_x=to, increments=6),
    )
    own_values = float(fret.solve(scene, progress=False).loops().dissipated[-1])
    computed, text = {}, {}
    for cycling in ("march", "sliding"):
        law = {"body2": fret.wear.Archard(1e-18), "cycling": cycling}
        run = fret.wear.solve(scene, cycles=1.0, jumps=1, progress=False, **law)
        computed[cycling], text[cycling] = float(run.dissipated_per_cycle[-1]), run.summary()
    assert computed["march"] == pytest.approx(own_values, rel=1e-4)
    assert computed["sliding"] == pytest.approx(4.0 * mu * W * to, rel=1e-9)
    assert computed["sliding"] > 1.05 * own_values
    assert "in the last cycle, on the worn surfaces" in text["march"]
    assert "elastic shift" not in text["march"]
    assert "without the elastic shift of the contact" in text["sliding"]


def test_the_command_tells_cycles_of_an_event_with_their_error(tmp_path: Path) -> None:
    coated = fret.Body(STEEL, coatings=fret.Coating(STEEL, thickness=2e-7))
    wear = (
        '[wear]\ncycles = 1e5\nfirst_branch = 2\ncycling = "sliding"\n'
        "[wear.body2]\nlaws = [{ k = 1e-15 }, { k = 1e-14 }]\n"
    )
    scene = tmp_path / "scene.toml"
    scene.write_text(line(64).replace(body2=coated).to_toml() + wear, encoding="utf-8")
    out = tmp_path / "out.zarr"
    command = [ROOT / "target" / "release" / "fret", "wear", scene, "-o", out, "--json"]
    ran = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr
    events = fret.open(out).events
    assert events
    assert [item["cycles_error"] for item in json.loads(ran.stdout)["events"]] == pytest.approx(
        [event["cycles_error"] for event in events]
    )
    for event in events:
        assert f"after {with_error(event['cycles'], event['cycles_error'])} cycles" in ran.stderr


@pytest.mark.parametrize("cycling", ["sliding", "march"])
def test_loops_of_wear_are_those_of_the_run(cycling: str) -> None:
    """A run that hardly wears has the numbers of the contact itself, by the same names."""
    path = fret.LoadPath.start().normal(18.5e3, increments=1)
    for to in (20e-6, -20e-6, 20e-6):
        path = path.displace(delta_x=to, increments=40)
    scene = line(n=48).replace(path=path)
    law = fret.wear.Archard(1e-22)
    result = fret.wear.solve(
        scene, cycles=10, first_branch=2, cycling=cycling, body2=law, jumps=1, progress=False
    )
    worn, run = result.loops(), fret.solve(scene, progress=False).loops()
    # Sliding leaves out the elastic shift of the contact, a part of the stroke.
    part = 1e-6 if cycling == "march" else 0.1
    for name, entry in worn.data_vars.items():
        assert entry.attrs == run[name].attrs
        assert float(entry[-1]) == pytest.approx(float(run[name][-1]), rel=part), name
    d = result.dataset
    assert float(worn.dissipated[-1]) == pytest.approx(float(d.dissipated_per_cycle[-1]))
    assert worn.block_cycles.equals(d.block_cycles)
    assert worn.identical(result.loops(direction="x"))
    with pytest.raises(ValueError, match='must be "x" or "y"'):
        result.loops(direction="z")  # type: ignore[arg-type]
