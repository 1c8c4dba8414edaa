"""Bodies that yield, as a user meets them."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
import xarray as xr

import pyfret as fret
from plastic_rows import body, rows, value_at_interface
from pyfret import _core
from pyfret.subsurface.plastic import YIELDED

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

pytestmark = pytest.mark.solves

STEEL = fret.Elastic(E=210e9, nu=0.3, plastic=fret.Plastic(s_y=1e9, hardening=1e10))


def indentation(material: fret.Elastic = STEEL, **changes: object) -> fret.Scene:
    """A rigid ball on a flat, pressed to 2.5 times the approach of first yield."""
    return fret.Scene(
        body1=fret.Body(fret.RIGID, shape=fret.Sphere(R=10e-3)),
        body2=fret.Body(material),
        friction=0.0,
        grid=fret.Grid.centred(width=5.6e-4, n=24),
        path=fret.LoadPath.start().normal(120.0, increments=3).normal(1.0, increments=1),
        **changes,
    )


def test_what_yields_is_told_with_its_residual_stress_and_imprint() -> None:
    """Volume, depth, imprint and residual stress of a march, and the numbers of every increment."""
    states = []
    for increment in fret.march(indentation()):
        states.append((increment.plastic(), float(increment.plastic_volume)))
    loaded, unloaded = states[2][0], states[3][0]
    assert loaded.volume() > 0
    assert loaded.volume() == pytest.approx(states[2][1])
    assert 0 < loaded.depth() < 3e-4
    assert 1e-4 < loaded.largest() < 0.02
    # Nothing yields anew while the load comes off.
    assert unloaded.volume() == loaded.volume()
    imprint = unloaded.dataset.imprint
    assert 0 < float(imprint.max()) < 2e-6
    yield_stress = 1e9 + 1e10 * loaded.largest()
    s = loaded.dataset.stress.sel(component=["xx", "yy", "zz", "xy", "xz", "yz"]).to_numpy()
    xx, yy, zz, xy, xz, yz = np.moveaxis(s, 1, 0)
    mises = np.sqrt(
        0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3 * (xy**2 + xz**2 + yz**2)
    )
    assert mises.max() < 1.002 * yield_stress


def test_the_energy_of_every_increment_balances() -> None:
    """Displacements without tractions do work, too."""
    result = fret.solve(indentation(), progress=False)
    assert float(result.plastic_work.sum()) > 0
    assert float(np.abs(result.residual_energy).max()) < 1e-6


def test_bodies_that_do_not_yield_have_the_bits_of_elastic_ones() -> None:
    """A yield stress that is not reached changes nothing; E / 5 is the largest without a doubt."""
    hard = fret.Elastic(E=210e9, nu=0.3, plastic=fret.Plastic(s_y=4e10))
    elastic = fret.solve(indentation(fret.Elastic(E=210e9, nu=0.3)), progress=False)
    solved = fret.solve(indentation(hard), progress=False)
    for name in ("W", "delta_z", "p_max", "p"):
        np.testing.assert_array_equal(solved.dataset[name], elastic.dataset[name])


def test_a_scene_file_keeps_the_law() -> None:
    """Written and read again it is the same scene."""
    scene = indentation()
    assert fret.Scene.from_toml(scene.to_toml()) == scene
    assert "plastic = " in scene.to_toml()
    assert scene.body2.substrate.plastic == fret.Plastic(s_y=1e9, hardening=1e10)


@pytest.mark.parametrize(
    ("numbers", "key"),
    [({"s_y": 0.0}, "s_y"), ({"s_y": float("nan")}, "s_y")]
    + [
        ({"s_y": 1e9, name: bad}, name)
        for name, bad in itertools.product(("hardening", "kinematic"), (-1.0, float("inf")))
    ],
)
def test_numbers_without_meaning_are_refused_by_name(numbers: dict[str, float], key: str) -> None:
    """The message names the key."""
    with pytest.raises(fret.errors.InvalidSceneError, match=f"plastic.{key}"):
        fret.Plastic(**numbers)


def test_a_store_keeps_the_plastic_strain(tmp_path: Path) -> None:
    """Memory, store, copy and march have the same one."""
    scene = indentation()
    kept = fret.solve(scene, progress=False)
    stored = fret.solve(scene, out=tmp_path / "run", progress=False)
    stored.save(tmp_path / "copy.zarr")
    copied = fret.open(tmp_path / "copy.zarr")
    *_, live = fret.march(scene)
    state = kept.at(-1).plastic
    assert state.dataset.equivalent.dims == ("z", "y", "x")
    assert state.volume() == pytest.approx(float(kept.plastic_volume[-1]))
    assert state.largest() == float(kept.largest_plastic_strain[-1])
    # The increment under load has a plastic strain of its own.
    assert kept.at(3).plastic.volume() > 0
    for alternative in (stored.at(-1), copied.at(-1), live):
        xr.testing.assert_identical(alternative.plastic.dataset, state.dataset)


def test_a_run_that_was_stopped_goes_on_to_the_same_plastic_strain(tmp_path: Path) -> None:
    """Points of the increments before and after the stop, each once."""
    scene = indentation().replace(save="all")

    def stop(index: int, _: int) -> None:
        if index == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        _core.solve(scene, store=tmp_path / "run", checkpoint=0.0, on_increment=stop)
    assert fret.open(tmp_path / "run").status != "done"
    resumed = fret.resume(tmp_path / "run", progress=False)
    whole = fret.solve(scene, progress=False)
    for name in YIELDED:
        np.testing.assert_array_equal(resumed.dataset[name], whole.dataset[name])


def test_the_stress_below_is_that_which_is_there() -> None:
    """The points of the volume grid have the stress of the plastic state."""
    result = fret.solve(indentation(), progress=False)
    loaded = result.at(3)
    plastic = loaded.plastic.dataset
    z = plastic.z.values[2:12:3]
    row = plastic.y.values[13]
    below = loaded.stress(z, y=row)
    own_values = plastic.sel(z=z, y=row)
    scale = float(np.abs(own_values.residual_stress).max())
    assert scale > 1e8
    without = fret.subsurface.stress(
        result.scene.body2.replace(substrate=fret.Elastic(E=210e9, nu=0.3)),
        result.scene.grid,
        z,
        y=row,
        rim=True,
        stick=loaded.stick.values,
        **loaded.tractions(),
    )
    for name in ("xx", "yy", "zz", "xz"):
        remaining = (below.dataset[f"s_{name}"] - without.dataset[f"s_{name}"]).values
        np.testing.assert_allclose(
            remaining, own_values.residual_stress.sel(component=name).values, atol=1e-6 * scale
        )
    # A point, a plane, a history and an envelope have it, too.
    at = loaded.stress(z, x=plastic.x.values[9], y=row)
    np.testing.assert_allclose(at.s_xx, below.s_xx[:, 9], rtol=1e-6)
    plane = loaded.stress(z)
    np.testing.assert_allclose(plane.s_xx[:, :, 13], below.s_xx, rtol=1e-6)
    history = fret.fatigue.history(result, z, y=row, cycle=None)
    np.testing.assert_allclose(history.sel(increment=3)[..., 0], below.s_xx, rtol=1e-6)
    envelope = result.envelope(z, y=row, of=("s_xx",))
    assert float(envelope.s_xx_max.max()) >= float(below.s_xx.max())


def test_tractions_alone_do_not_say_what_has_yielded() -> None:
    """The stress of a body that yields needs its run."""
    scene = indentation()
    with pytest.raises(ValueError, match=r"plastic.*from their run"):
        fret.subsurface.stress(scene.body2, scene.grid, p=np.ones((24, 24)))


def test_stress_of_bodies_that_have_not_yielded_has_the_bits_of_elastic_ones() -> None:
    """Below the surface as on it; the summary prints the distance to it."""
    hard = fret.Elastic(E=210e9, nu=0.3, plastic=fret.Plastic(s_y=5e9))
    elastic = fret.solve(indentation(fret.Elastic(E=210e9, nu=0.3)), progress=False)
    solved = fret.solve(indentation(hard), progress=False)
    below, alternative = (run.at(3).stress(y=0.0).dataset for run in (solved, elastic))
    for name in ("s_xx", "s_zz", "s_xz"):
        np.testing.assert_array_equal(below[name], alternative[name])
    assert solved.at(3).plastic.volume() == 0.0
    ratio = float(solved.yield_ratio.max())
    # 0.62 p_H below a sphere for nu = 0.3.
    assert ratio == pytest.approx(0.62 * solved.p_H / 5e9, rel=0.02)
    assert f"{ratio:.3g} of the yield stress" in solved.summary()
    assert "yield stress" not in elastic.summary()
    assert float(elastic.yield_ratio.max()) == 0.0


def test_what_is_left_after_unloading(recwarn: pytest.WarningsRecorder) -> None:
    """Residual stress without tractions, and the imprint as the shape of the next scene."""
    scene = indentation()
    result = fret.solve(scene, progress=False)
    remaining = result.unloaded()
    plastic = result.at(-1).plastic
    row = plastic.dataset.y.values[12]
    z = plastic.dataset.z.values[1:9]
    computed = remaining.stress(z, y=row)
    own_values = plastic.dataset.residual_stress.sel(z=z, y=row, component="xx")
    np.testing.assert_allclose(computed.s_xx, own_values, rtol=1e-5, atol=1e3)
    # Nothing is carried by the surface.
    surface = remaining.stress([0.0], y=row)
    for name in ("s_zz", "s_xz", "s_yz"):
        assert float(np.abs(surface.dataset[name]).max()) == 0.0
    assert remaining.depth() == pytest.approx(float(plastic.dataset.imprint.max()), rel=1e-3)
    assert remaining.depth(1) == 0.0
    # The ball rests deeper in the imprint than on the flat, and more softly.
    deeper = scene.replace(
        body2=fret.Body(fret.Elastic(E=210e9, nu=0.3), shape=remaining.shape(2)),
        path=fret.LoadPath.start().normal(20.0, increments=1),
    )
    resting = fret.solve(deeper, progress=False)
    flat = fret.solve(deeper.replace(body2=fret.Body(STEEL.replace(plastic=None))), progress=False)
    sunk = float(resting.delta_z[-1] - flat.delta_z[-1])
    assert 0.4 * remaining.depth() < sunk < remaining.depth()
    assert float(resting.p_max[-1]) < 0.9 * float(flat.p_max[-1])
    assert not [w for w in recwarn if "in reverse" in str(w.message)]
    with pytest.raises(ValueError, match="stay elastic"):
        flat.unloaded()


def sheared(s_y: float, cycles: int) -> fret.Result:
    """A cylinder on a flat that yields, to and fro under a force."""
    yielding = fret.Plastic(s_y=s_y, kinematic=5e9)
    scene = fret.Scene(
        body1=fret.Body(fret.Elastic(E=115e9, nu=0.32), shape=fret.Cylinder(R=0.05)),
        body2=fret.Body(fret.Elastic(E=115e9, nu=0.32, plastic=yielding)),
        friction=0.4,
        grid=fret.Grid.strip(extent=3.6e-3, n=48),
    )
    path = fret.LoadPath.start().force(W=1.2e6, increments=2)
    return fret.solve(
        scene, path.cycles(cycles, T_x=0.9 * 0.4 * 1.2e6, increments=3), progress=False
    )


def turned(axis: str, s_y: float, quarter: int) -> xr.Dataset:
    """Press a ball that makes a flat of another metal yield, and shear it along an axis."""
    law = fret.Plastic(s_y=s_y, kinematic=6e9, hardening=2e9)
    ball, flat = fret.Elastic(E=210e9, nu=0.3), fret.Elastic(E=115e9, nu=0.32, plastic=law)
    W, mu = 150.0, 0.4
    scene = fret.Scene(
        body1=fret.Body(ball, shape=fret.Sphere(R=10e-3)),
        body2=fret.Body(flat),
        friction=mu,
        grid=fret.Grid.centred(
            width=3.6 * fret.reference.hertz(R=10e-3, bodies=(ball, flat), W=W).a, n=20
        ),
    )
    path = fret.LoadPath.start().normal(W, increments=3)
    path = path.cycles(1, **{f"T_{axis}": 0.8 * mu * W}, increments=5 * quarter)
    return fret.solve(scene, path, save="all", progress=False).dataset


@pytest.mark.parametrize(
    ("s_y", "quarter"), [(5e8, 2), pytest.param(6e8, 4, marks=pytest.mark.slow)]
)
def test_a_scene_turned_by_90_degrees_yields_the_same(s_y: float, quarter: int) -> None:
    """Tractions and plastic strain do not depend on the axis of the force."""
    x, y = (turned(axis, s_y, quarter) for axis in "xy")
    assert float(x.largest_plastic_strain[-1]) > 1e-3
    for of_x, of_y in (("p", "p"), ("q_x", "q_y"), ("q_y", "q_x")):
        size = float(abs(x["p" if of_x == "p" else "q_x"]).max())
        off = abs(x[of_x].values - y[of_y].values.transpose(0, 2, 1)).max()
        assert off < 1e-3 * size, (of_x, off / size)
    np.testing.assert_allclose(
        y.largest_plastic_strain, x.largest_plastic_strain, rtol=1e-3, atol=1e-6
    )
    np.testing.assert_allclose(y.plastic_work.sum(), x.plastic_work.sum(), rtol=1e-3)


def test_the_verdict_of_cycles() -> None:
    """Elastic, shaken down and alternating, with the works of every cycle."""
    elastic = sheared(2e9, 1).cyclic_response()
    assert elastic.kind == "elastic"
    assert elastic.work == (0.0,)
    assert 0.0 < elastic.yield_ratio < 1.0
    shaken = sheared(480e6, 3).cyclic_response()
    assert shaken.kind == "shakes down"
    assert shaken.after is not None
    assert 0 < shaken.after < 3
    assert str(shaken) == f"shakes down after {shaken.after} of 3 cycles"
    result = sheared(380e6, 3)
    computed = result.cyclic_response()
    assert computed.kind == "alternates"
    # To and fro: much is added up and little is left.
    assert 0.0 <= computed.net_strain < 0.5 * computed.strain
    assert sum(computed.work) <= float(result.plastic_work.sum())
    assert computed.where is not None
    assert computed.where.body_number == 2
    assert "alternates" in str(computed)
    with pytest.raises(ValueError, match=r"body2\.plastic.*cyclic_response"):
        result.load_factors(380e6)
    with pytest.raises(ValueError, match="no closed cycle"):
        fret.solve(indentation(), progress=False).cyclic_response()


@pytest.mark.usefixtures("without_overview")
def test_figures_of_what_has_yielded(tmp_path: Path) -> None:
    """The zone and the residual stress, of states and runs, and in the report."""
    result = fret.solve(indentation(), progress=False)
    zone = result.plot.plastic_zone()
    assert zone.get_ylim()[0] > zone.get_ylim()[1] == 0.0
    remaining = result.at(-1).plot.residual_stress(units="SI")
    assert "MPa" in remaining.get_ylabel()
    result.report(tmp_path / "page.html")
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert "on the section along the shear" in page
    assert "Residual stress below the middle" in page
    assert "largest plastic strain" in page


def test_a_material_of_the_table_yields_only_when_asked() -> None:
    """Its yield stress stands in the table; a material without one is refused."""
    assert fret.material("titanium_6Al4V").plastic is None
    alloy = fret.material("titanium_6Al4V", plastic=True)
    assert alloy.plastic == fret.Plastic(s_y=1185e6)
    with (
        pytest.warns(fret.errors.SceneWarning),
        pytest.raises(ValueError, match=r"no yield stress.*plastic=Plastic\(s_y"),
    ):
        fret.material("CrN", plastic=True)


def test_a_hard_film_is_in_tension_after_unloading() -> None:
    """The bottom of the film on a substrate that yields, of finite elements; none by elasticity."""
    row = rows("normal")["hard_thick"]
    state = row["states"][2]
    film = 30e-6
    path = fret.LoadPath.start().displace(delta_z=state["approach"], increments=10)
    scene = fret.Scene(
        body1=fret.Body(fret.RIGID, shape=fret.Sphere(R=row["indenter"]["R"])),
        body2=body(row),
        friction=0.0,
        grid=fret.Grid.centred(width=2.6 * state["contact_radius_between"][1], n=32),
        path=path.normal(1e-3 * state["load"]["value"], increments=2),
    )
    result = fret.solve(scene, progress=False)
    # The row has no load after unloading; the 0.34 N of the last increment add 93 MPa there.
    bottom = []
    for n, name in ((10, "stress"), (12, "residual_stress")):
        s_xx = result.at(n).plastic.on_axis(name).sel(component="xx")
        bottom.append(value_at_interface(s_xx, film, 0))
    remaining = state["unloaded"]["s_rr_at_interfaces"]
    under_load = state["s_rr_at_interfaces_loaded"]
    for candidate, table in zip(bottom, (under_load, remaining), strict=True):
        allowed = table["error"][0] + 0.03 * remaining["value"][0]
        assert candidate == pytest.approx(table["value"][0], abs=allowed)
    # What a user reads, of the run and without its load.
    z = [0.999 * film]
    assert float(result.at(10).stress(z, x=0.0, y=0.0).s_xx[0]) == pytest.approx(472e6, abs=75e6)
    unloaded = float(result.unloaded().stress(z, x=0.0, y=0.0).s_xx[0])
    assert unloaded == pytest.approx(1676e6, abs=85e6)
    elastic = scene.replace(
        body2=fret.Body(fret.Elastic(E=115e9, nu=0.32), coatings=[elastic_film(row)])
    )
    under_the_largest = fret.solve(elastic, progress=False).at(10)
    assert float(under_the_largest.stress(z, x=0.0, y=0.0).s_xx[0]) < -800e6


def elastic_film(row: dict[str, Any]) -> fret.Coating:
    """Make the film of a row."""
    film = row["coatings"][0]
    return fret.Coating(fret.Elastic(E=film["E"], nu=film["nu"]), thickness=film["thickness"])


def test_a_run_of_wear_begins_with_an_imprint() -> None:
    """A ball that frets in its imprint wears that shape, with a lower pressure."""
    remaining = fret.solve(indentation(), progress=False).unloaded()
    elastic = fret.Elastic(E=210e9, nu=0.3)

    def worn(lower: fret.Body) -> fret.wear.WearResult:
        path = fret.LoadPath.start().normal(20.0, increments=1)
        for to in (4e-6, -4e-6, 4e-6):
            path = path.displace(delta_x=to, increments=2)
        scene = fret.Scene(
            body1=fret.Body(elastic, shape=fret.Sphere(R=10e-3)),
            body2=lower,
            friction=0.5,
            grid=fret.Grid.centred(width=5.6e-4, n=24),
            path=path,
        )
        law = fret.wear.Archard(1e-14)
        return fret.wear.solve(scene, cycles=100, first_branch=2, body2=law, progress=False)

    marked = worn(fret.Body(elastic, shape=remaining.shape(2)))
    flat = worn(fret.Body(elastic))
    # The imprint bears over a wider area: scars of about the same volume are shallower.
    assert float(marked.volume2[-1]) == pytest.approx(float(flat.volume2[-1]), rel=0.1)
    assert float(marked.depth2[-1]) < 0.9 * float(flat.depth2[-1])
    with pytest.raises(fret.errors.ArgumentError, match=r"body2\.plastic.*imprint"):
        worn(fret.Body(STEEL))


def test_what_is_not_computed_of_bodies_that_yield_is_refused_by_name() -> None:
    """Each with its key and with what to do."""
    scene = indentation()
    elastic = fret.Elastic(E=210e9, nu=0.3)
    ball = fret.Body(elastic, shape=fret.Sphere(R=10e-3))
    rubbed = scene.replace(body1=ball, friction=0.3)
    pressed = fret.LoadPath.start().normal(50.0, increments=1)

    def along_path(**columns: float) -> fret.Scene:
        ends = {name: [value] for name, value in columns.items()}
        return rubbed.replace(path=pressed.waypoints(increments=2, **ends))

    rigid = fret.RIGID.replace(plastic=fret.Plastic(s_y=1e9))
    soft = fret.Coating(STEEL, thickness=2e-5, bond=fret.Bond(normal=1e-17))
    # 356 times the load of first yield with s_y = 100 MPa, 0.04 N.
    perfect = fret.Elastic(E=210e9, nu=0.3, plastic=fret.Plastic(s_y=1e8))
    refused: list[tuple[Callable[[], fret.Scene], str]] = [
        (
            lambda: scene.replace(body1=ball.replace(substrate=rigid)),
            r"body1\.E.*leave plastic out",
        ),
        (
            lambda: along_path(rolled=4 * rubbed.grid.dx),
            r"body2\.plastic.*path\.rolled.*left out where",
        ),
        (lambda: along_path(sigma_B=2e10), r"path\[\d\]\.sigma_B.*would yield as a whole"),
        (
            lambda: scene.replace(body2=fret.Body(elastic, coatings=[soft])),
            r"body2\.coatings\[0\]\.bond.*left out in a body",
        ),
        (
            lambda: indentation(perfect),
            r"body2\.plastic\.hardening.*a W of at most 1\.4\d*e1 N.*2\.8 s_y",
        ),
    ]
    for item, text in refused:
        with pytest.raises(fret.errors.InvalidSceneError, match=f"(?s){text}"):
            fret.solve(item(), progress=False)
    path = pressed
    for to in (1e-6, -1e-6, 1e-6):
        path = path.displace(delta_x=to, increments=1)
    result = fret.solve(rubbed.replace(path=path), progress=False)
    metal = fret.heat.Conductor(conductivity=45.0, heat_capacity=3.6e6)
    with pytest.raises(ValueError, match=r"body2\.plastic.*without plastic"):
        result.temperature(metal, metal, frequency=50.0)


@pytest.mark.filterwarnings("ignore::pyfret.errors.SceneWarning")
def test_large_strains_are_doubted_and_end_a_run(tmp_path: Path) -> None:
    """A strain of 6 % is doubted, 15 % ends the run, also when it is resumed."""
    soft = fret.Elastic(E=210e9, nu=0.3, plastic=fret.Plastic(s_y=1e9, hardening=2e10))
    path = fret.LoadPath.start()
    for W in (2e6, 6e6, 1e7):
        path = path.force(W=W, increments=1)
    scene = fret.Scene(
        body1=fret.Body(fret.RIGID, shape=fret.Cylinder(R=2e-3)),
        body2=fret.Body(soft),
        friction=0.0,
        grid=fret.Grid.strip(extent=3e-3, n=48),
        path=path,
        settings=fret.Settings(save="all"),
    )
    store = tmp_path / "large.zarr"
    ends = "strains stay below 15 %"
    with pytest.raises(fret.errors.InvalidSceneError, match=ends):
        fret.solve(scene, out=store, progress=False)
    kept = fret.open(store)
    assert kept.status != "done"
    assert 0.06 < float(kept.largest_plastic_strain.max()) < 0.15
    assert "small strains" in kept.summary()
    with pytest.raises(fret.errors.InvalidSceneError, match=ends):
        fret.resume(store, progress=False)
    np.testing.assert_array_equal(fret.open(store).W, kept.W)
