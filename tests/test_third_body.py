"""Oxygen and debris in runs of wear: input, stores, figures."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyfret as fret
from pyfret.report import content

AIR = fret.wear.Air(distance=1.753e-3, power_density=24e3, power_exponent=0.94)
BED = fret.wear.DebrisBed(kappa=4.444e-3, starved_yield=0.75)
LAW = fret.wear.DissipatedEnergy(alpha=2.25e-13, starved=4e-14)


def cylinder(n: int = 64) -> fret.Scene:
    """A titanium cylinder on a flat."""
    titanium = fret.Elastic(E=119e9, nu=0.29)
    path = fret.LoadPath.start().normal(1.066e6)
    return fret.Scene(
        body1=fret.Body(titanium, shape=fret.Cylinder(R=80e-3)),
        body2=fret.Body(titanium),
        friction=0.6,
        grid=fret.Grid.strip(extent=5.5e-3, n=n),
        path=path.displace(delta_x=75e-6).displace(delta_x=-75e-6).displace(delta_x=75e-6),
    )


def settings(**changes: Any) -> dict[str, Any]:
    """Settings of a short run with air and bed."""
    wear: dict[str, Any] = {"cycles": 500, "body1": LAW, "body2": LAW, "frequency": 5.0, "jumps": 4}
    return {**wear, "air": AIR, "bed": BED, **changes}


@pytest.mark.parametrize(
    ("changes", "match"),
    [
        (lambda: {"frequency": None}, r"wear\.frequency"),
        (lambda: {"debris_kept": 0.5}, r"wear\.debris_kept"),
        (lambda: {"air": AIR.replace(threshold=3e4)}, r"wear\.air\.threshold"),
        (lambda: {"air": AIR.replace(threshold=float("nan"))}, r"threshold"),
        (lambda: {"air": AIR.replace(distance=-1e-3)}, r"distance"),
        (lambda: {"air": AIR.replace(power_exponent=-0.5)}, r"wear\.air\.power_exponent"),
        (lambda: {"air": AIR.replace(reaction=1.0)}, r"wear\.air\.distance"),
        (lambda: {"air": AIR.replace(pressure=1e8)}, r"wear\.air\.power_density"),
        (lambda: {"bed": BED.replace(kappa=-1.0)}, r"wear\.bed\.kappa"),
        (lambda: {"bed": BED.replace(kappa=float("nan"))}, r"kappa"),
        (lambda: {"bed": BED.replace(starved_yield=1.5)}, r"wear\.bed\.starved_yield"),
        (lambda: {"bed": BED.replace(volume_ratio=0.0)}, r"wear\.bed\.volume_ratio"),
        (lambda: {"closed_below": -1e-6}, r"closed_below"),
        (lambda: {"body1": LAW.replace(starved=-1e-14)}, r"starved"),
        (lambda: {"bed": AIR}, r"DebrisBed"),
    ],
)
def test_constants_without_a_meaning_are_refused_by_name(
    changes: Callable[[], dict[str, Any]], match: str
) -> None:
    with pytest.raises((ValueError, TypeError), match=match):
        fret.wear.solve(cylinder(), progress=False, **settings(**changes()))


@pytest.mark.solves
def test_a_run_keeps_its_mass_and_goes_on_with_the_same_bits(tmp_path: Path) -> None:
    worn = fret.wear.solve(cylinder(), progress=False, **settings())
    volume = worn.volume1 + worn.volume2
    np.testing.assert_allclose(worn.debris + worn.ejected, volume, rtol=1e-9)
    area = worn.scene.grid.dx
    np.testing.assert_allclose(worn.bed[-1].sum() * area, worn.debris[-1], rtol=1e-9)
    assert 0 < float(worn.aerated_share[-1]) < 1
    assert "bed" in worn.summary()
    assert "aerated" in worn.summary()
    gap = worn.worn1 + worn.worn2 - worn.bed
    np.testing.assert_allclose(worn.gap, gap, atol=1e-15)
    # The scene file of the run has both tables.
    out = tmp_path / "run.zarr"
    stored = fret.wear.solve(cylinder(), progress=False, out=out, **settings())
    assert stored.table["air"]["distance"] == AIR.distance
    assert stored.table["bed"]["kappa"] == BED.kappa
    np.testing.assert_array_equal(stored.bed, worn.bed)
    # A second run starts on surfaces and bed of the first one.
    second = fret.wear.solve(cylinder(), progress=False, start=worn, **settings())
    volume = second.volume1 + second.volume2
    np.testing.assert_allclose(second.debris + second.ejected, volume, rtol=1e-8)


@pytest.mark.solves
@pytest.mark.parametrize(("frequency", "maxima"), [(0.1, [0.0]), (2.0, [-8.125e-4, 8.125e-4])])
def test_a_scar_is_a_u_with_oxygen_and_a_w_without(frequency: float, maxima: list[float]) -> None:
    """The maxima of the W lie as in the row titanium_air_2Hz of a dense code."""
    long = settings(cycles=5000, jumps=10, frequency=frequency, cycling="sliding")
    worn = fret.wear.solve(cylinder(96), progress=False, **long)
    depth = np.asarray((worn.worn1 + worn.worn2)[-1, :, 0])
    is_top = (depth[1:-1] > depth[:-2]) & (depth[1:-1] >= depth[2:])
    x = np.asarray(worn.x)[1:-1][is_top & (depth[1:-1] > 0.5 * depth.max())]
    np.testing.assert_allclose(x, maxima, atol=worn.scene.grid.dx)


@pytest.mark.solves
def test_more_without_oxygen_than_in_air_is_doubted() -> None:
    law = LAW.replace(starved=1e-12)
    short = settings(body1=law, cycles=10, jumps=1)
    worn = fret.wear.solve(cylinder(48), progress=False, **short)
    assert "wear.body1.starved" in " ".join(worn.doubts)


def film(**changes: Any) -> fret.Scene:
    """A cylinder on a flat with a film of low friction, which is worn through."""
    steel = fret.Elastic(E=200e9, nu=0.3)
    path = fret.LoadPath.start().normal(1e5)
    scene = fret.Scene(
        body1=fret.Body(steel, shape=fret.Cylinder(R=10e-3)),
        body2=fret.Body(steel, coatings=fret.Coating(steel, thickness=2e-6)),
        friction=fret.Friction(layers=[0.15, 0.7]),
        grid=fret.Grid.strip(extent=1.2e-3, n=64),
        path=path.displace(delta_x=50e-6).displace(delta_x=-50e-6).displace(delta_x=50e-6),
    )
    return scene.replace(**changes)


#: Laws of the film and of the substrate.
FILM_LAWS = [fret.wear.DissipatedEnergy(1e-15), fret.wear.DissipatedEnergy(3e-15)]


def wear_film(scene: fret.Scene, **changes: Any) -> fret.wear.WearResult:
    """Wear the film through."""
    settings = {"cycles": 3e5, "body2": FILM_LAWS, "worn_through": "go_on", "jumps": 12}
    return fret.wear.solve(scene, progress=False, **{**settings, **changes})


@pytest.mark.solves
def test_friction_rises_as_a_film_is_worn_through() -> None:
    worn = wear_film(film())
    mu = np.asarray(worn.mu)
    assert mu[0] == pytest.approx(0.15)
    assert 0.17 < mu[-1] < 0.7
    cycles = worn.cycles_to(mu=0.16)
    assert worn.cycles_to(part_of_coating=1.0) <= cycles < 3e5
    assert worn.cycles_to(mu=0.6).beyond == pytest.approx(3e5)
    assert worn.cycles_to(mu=0.15) == 0.0
    assert "mean coefficient of friction" in worn.summary()
    # A single layer has no border that a cell could cut.
    bare = np.asarray(worn.depth2) > 2e-6
    assert np.all(np.asarray(worn.mu_error)[~bare] < 1e-3)
    assert np.all(np.asarray(worn.mu_error)[bare] > 1e-4)
    assert worn.scene.friction == fret.Friction(layers=[0.15, 0.7])
    # The force of the loop follows the friction of the last surfaces.
    force = float(worn.dissipated_per_cycle[-1]) / (4 * 50e-6)
    assert float(worn.loop_T_x[-1].max()) == pytest.approx(force, rel=1e-6)
    # Energy of the cells is energy of the contact.
    energy = float(worn.energy2[-1].sum() * worn.scene.grid.dx)
    assert energy == pytest.approx(float(worn.dissipated[-1]), rel=1e-9)


@pytest.mark.slow
def test_a_run_with_friction_of_the_surface_goes_on_with_the_same_bytes(tmp_path: Path) -> None:
    def substrate(pressed: Any, slip: Any, dissipated: Any, worn: Any, cycles: float) -> Any:
        return 3e-15 * dissipated

    def stops(pressed: Any, slip: Any, dissipated: Any, worn: Any, cycles: float) -> Any:
        if cycles > 2e5:
            raise RuntimeError("the power is off")
        return 3e-15 * dissipated

    grid = fret.Grid.strip(extent=1.2e-3, n=32)
    scene = film(grid=grid)
    options: dict[str, Any] = {
        "bed": fret.wear.DebrisBed(kappa=1e-3),
        "cycling": "sliding",
        "jumps": 4,
    }
    store = tmp_path / "film.zarr"
    with pytest.raises(fret.errors.ArgumentError, match="the power is off"):
        wear_film(scene, body2=[FILM_LAWS[0], stops], out=store, **options)
    resumed = fret.wear.resume(store, body2=substrate, progress=False)
    whole = wear_film(
        scene, body2=[FILM_LAWS[0], substrate], out=tmp_path / "whole.zarr", **options
    )
    assert float(whole.mu[-1]) > 0.16
    for name, values in whole.dataset.variables.items():
        assert values.values.tobytes() == resumed.dataset[name].values.tobytes(), name


def test_a_body_that_yields_has_no_wear_with_a_bed() -> None:
    yields = fret.Elastic(E=119e9, nu=0.29, plastic=fret.Plastic(s_y=8e8))
    scene = cylinder(48).replace(body2=fret.Body(yields))
    with pytest.raises(ValueError, match=r"body2\.plastic"):
        fret.wear.solve(scene, progress=False, **settings())


@pytest.mark.solves
def test_a_law_of_your_own_sees_the_exposed_surface() -> None:
    seen: dict[str, float] = {}

    def law(x: Any, y: Any, p: Any, slip: Any, dissipated: Any, *, layer2: Any, worn2: Any) -> Any:
        seen["layer"] = max(seen.get("layer", 0.0), float(layer2.max()))
        seen["worn"] = max(seen.get("worn", 0.0), float(worn2.max()))
        return np.where(layer2 > 0, 0.7, 0.15)

    path = fret.LoadPath.start().normal(1e5)
    for to in (20e-6, -20e-6, 20e-6):
        path = path.displace(delta_x=to, increments=4)
    plain = film(path=path)
    with_law = plain.replace(friction=fret.Friction(0.15, law=law))
    results = [wear_film(s, cycling="march", cycles=6e5, jumps=6) for s in (plain, with_law)]
    assert seen["layer"] == 1.0
    assert seen["worn"] > 2e-6
    # The layers of a jump count within it, the law of a user at its ends.
    assert all(0.152 < float(worn.mu[-1]) < 0.7 for worn in results)
    depth = [float(worn.depth2[-1]) for worn in results]
    assert depth[1] == pytest.approx(depth[0], rel=0.05)


@pytest.mark.solves
def test_a_law_of_your_own_in_sliding_agrees_with_the_laws_that_are_there() -> None:
    """Layers, bed and oxygen by a function wear as by their numbers, a constant as the number."""

    def of_layers(x: Any, y: Any, p: Any, slip: Any, dissipated: Any, *, layer2: Any) -> Any:
        return np.where(layer2 > 0, 0.7, 0.15)

    def of_third_body(
        x: Any, y: Any, p: Any, slip: Any, dissipated: Any, *, bed: Any, aerated: Any
    ) -> Any:
        bare = 0.9 + (0.6 - 0.9) * aerated
        return 0.4 + (bare - 0.4) * np.exp(-bed / 2e-6)

    sliding = {"cycling": "sliding", "jumps": 12}
    pairs = [
        (wear_film, film(), fret.Friction(0.15, law=of_layers), sliding),
        (
            lambda scene, **changes: fret.wear.solve(scene, progress=False, **settings(**changes)),
            cylinder(48).replace(friction=fret.Friction(0.6, starved=0.9, bed=(0.4, 2e-6))),
            fret.Friction(0.6, law=of_third_body),
            {"cycling": "sliding"},
        ),
        (
            lambda scene, **changes: fret.wear.solve(scene, progress=False, **settings(**changes)),
            cylinder(48),
            fret.Friction(0.6, law=lambda x, y, p, slip, dissipated: 0.6 + 0 * p),
            {"cycling": "sliding"},
        ),
    ]
    within = [2e-2, 1e-2, 1e-9]
    for (run, scene, law, options), tolerance in zip(pairs, within, strict=True):
        there = run(scene, **options)
        result = run(scene.replace(friction=law), **options)
        for name in ("depth2", "dissipated"):
            values = [float(worn.dataset[name][-1]) for worn in (result, there)]
            assert values[0] == pytest.approx(values[1], rel=tolerance), name
        # The mean friction of single jumps scatters by the cells at the border of a layer.
        scatter = sum(float(worn.mu_error[-1] * worn.mu[-1]) for worn in (result, there))
        assert abs(float(result.mu[-1] - there.mu[-1])) <= scatter + tolerance
        # Energy of the cells is energy of the contact, at each body.
        dx = result.scene.grid.dx
        for energy in (result.energy1, result.energy2):
            total = float(energy[-1].sum() * dx)
            assert total == pytest.approx(float(result.dissipated[-1]), rel=1e-6)


@pytest.mark.solves
def test_a_law_of_your_own_in_sliding_is_refused_on_the_spring_of_a_rig_alone() -> None:
    law = fret.Friction(0.6, law=lambda x, y, p, slip, dissipated: np.full_like(p, np.nan))
    with pytest.raises(ValueError, match=r"friction\.law"):
        fret.wear.solve(
            cylinder(48).replace(friction=law), progress=False, **settings(cycling="sliding")
        )
    path = cylinder().path.replace(rig_stiffness=1e9)
    on_rig = cylinder(48).replace(friction=law, path=path)
    with pytest.raises(ValueError, match=r"friction.*march"):
        fret.wear.solve(on_rig, progress=False, **settings(cycling="sliding"))


@pytest.mark.solves
@pytest.mark.parametrize("air", [None, AIR.replace(distance=1e-4)])
def test_a_third_body_that_changes_nothing_leaves_the_run_as_it_is(air: Any) -> None:
    """Oxygen with equal coefficients, and a bed that leaves at once, wear as a run without."""
    law = LAW.replace(starved=LAW.alpha)
    plain = {"cycles": 500, "body1": law, "body2": law, "jumps": 4, "cycling": "sliding"}
    bare = {**plain, "body1": fret.wear.DissipatedEnergy(LAW.alpha)}
    bare["body2"] = bare["body1"]
    without = fret.wear.solve(cylinder(48), progress=False, **bare)
    # A law with `starved` takes the same steps where no oxygen is modelled: the same bits.
    same = fret.wear.solve(cylinder(48), progress=False, **plain)
    np.testing.assert_array_equal(same.worn2, without.worn2)
    np.testing.assert_array_equal(same.p, without.p)
    third = {"bed": fret.wear.DebrisBed(kappa=1e12), "frequency": 5.0, "air": air}
    third = {key: value for key, value in third.items() if value is not None}
    worn = fret.wear.solve(cylinder(48), progress=False, **{**plain, **third})
    assert float(worn.debris[-1]) < 1e-6 * float(worn.ejected[-1])
    deepest = float(without.worn2[-1].max())
    np.testing.assert_allclose(worn.worn2, without.worn2, atol=5e-3 * deepest)


@pytest.mark.parametrize(
    ("friction", "match"),
    [
        (lambda: fret.Friction(layers=[]), r"layers"),
        (lambda: fret.Friction(layers=[0.1, -0.2]), r"friction\.layers"),
        (lambda: fret.Friction(layers=[0.1, float("nan")]), r"layers"),
        (lambda: fret.Friction(0.3, layers=[0.1, 0.2]), r"friction\.mu"),
        (lambda: fret.Friction(), r"mu is missing"),
        (lambda: fret.Friction(0.3, starved=-0.1), r"friction\.starved"),
        (lambda: fret.Friction(0.3, bed=(0.2, 0.0)), r"friction\.bed\.thickness"),
        (lambda: fret.Friction(0.3, bed=(-0.2, 1e-6)), r"friction\.bed\.mu"),
        (lambda: wear_film(film(friction=fret.Friction(layers=[0.1, 0.2, 0.3]))), r"layers"),
        (lambda: wear_film(film(friction=fret.Friction(0.3, starved=0.4))), r"friction\.starved"),
        (lambda: wear_film(film(friction=fret.Friction(0.3, bed=(0.2, 1e-6)))), r"friction\.bed"),
        (lambda: wear_film(film(), yield_stress=float("nan")), r"yield_stress"),
    ],
)
def test_friction_without_a_meaning_is_refused_by_name(
    friction: Callable[[], Any], match: str
) -> None:
    with pytest.raises((ValueError, TypeError), match=match):
        friction()


def test_friction_of_the_surface_is_kept_by_files_and_copies() -> None:
    law = fret.Friction(layers=[0.15, 0.7], starved=0.9, bed=(0.4, 2e-6))
    assert law.mu == 0.15
    assert (law.layers, law.starved, law.bed) == ([0.15, 0.7], 0.9, (0.4, 2e-6))
    assert pickle.loads(pickle.dumps(law)) == law
    assert eval(repr(law), {"Friction": fret.Friction}) == law
    scene = film(friction=law)
    assert fret.Scene.from_toml(scene.to_toml()).friction == law
    without_mu = scene.to_toml().replace("mu = 0.15\n", "", 1)
    assert fret.Scene.from_toml(without_mu).friction == law


@pytest.mark.solves
def test_a_pressure_above_the_yield_stress_is_doubted() -> None:
    short = settings(cycles=10, jumps=1, yield_stress=1e8)
    worn = fret.wear.solve(cylinder(48), progress=False, **short)
    assert "wear.yield_stress" in " ".join(worn.doubts)
    high = fret.wear.solve(cylinder(48), progress=False, **{**short, "yield_stress": 2e9})
    assert "wear.yield_stress" not in " ".join(high.doubts)


@pytest.mark.solves
def test_laws_of_wear_may_see_the_third_body() -> None:
    seen: dict[str, float] = {}

    def law(pressed: Any, slip: Any, dissipated: Any, worn: Any, cycles: Any, *, bed: Any) -> Any:
        seen["bed"] = max(seen.get("bed", 0.0), float(bed.max()))
        return 2e-13 * dissipated

    fret.wear.solve(cylinder(48), progress=False, **settings(body1=law, jumps=2))
    assert seen["bed"] > 1e-7


@pytest.mark.solves
@pytest.mark.usefixtures("without_overview")
def test_scar_bed_and_aerated_zone_are_drawn_and_reported(tmp_path: Path) -> None:
    worn = fret.wear.solve(cylinder(48), progress=False, **settings(jumps=2))
    page = tmp_path / "run.html"
    fret.solve(cylinder(48), progress=False).report(page, wear=worn)
    assert "scar, debris and oxygen" in page.read_text(encoding="utf-8")
    lines = content.wear(worn)["third"]
    assert [line["name"] for line in lines] == ["debris", "aerated share [1]"]
    ax = fret.plot.third_body(worn)
    labels = {text.get_text() for text in ax.get_legend().get_texts()}
    expected = {"worn off both bodies", "debris", "growth of the gap", "oxygen arrives"}
    assert labels == expected
