"""Results do not depend on the rotation of the scene."""

from __future__ import annotations

import warnings

import matplotlib.pyplot as plt
import numpy as np
import pytest

import pyfret as fret
from pyfret import fatigue

STEEL = fret.Elastic(E=210e9, nu=0.3)
RADIUS = 0.01
W, T, MU = 100.0, 25.0, 0.3
A = fret.reference.hertz(R=RADIUS, bodies=(STEEL, STEEL), W=W).a


def sheared(
    angle: float, *, n: int = 28, shape: object = None, extent: float = 2.6, increments: int = 4
) -> fret.Result:
    """A contact sheared to and fro at an angle to the x axis."""
    x, y = T * np.cos(angle), T * np.sin(angle)
    path = fret.LoadPath.start().normal(W, increments=1)
    for sign in (1.0, -1.0, 1.0):
        path = path.force(W=W, T_x=sign * x, T_y=sign * y, increments=increments)
    ball = fret.Body(STEEL, shape=shape or fret.Sphere(R=RADIUS))
    scene = fret.Scene(
        body1=ball,
        body2=fret.Body(STEEL),
        friction=MU,
        grid=fret.Grid.centred(width=extent * A, n=n),
        path=path,
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return fret.solve(scene, progress=False, save="all")


def numbers(result: fret.Result) -> dict[str, float]:
    """Largest stresses, life, load factor and crack by default."""
    material = fatigue.Materials()["steel_42CrMo4"]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        below = result.at(-1).stress()
        crack = result.crack(lengths=[0.2 * A])
        return {
            "s_1": below.maximum("s_1").value,
            "von_mises": below.maximum("von_mises").value,
            "margin": result.life(material, "crossland").worst.margin,
            "factor": result.load_factors(900e6).least("von_mises").value,
            "dK": float(crack.dK().max()),
        }


@pytest.fixture(scope="module")
def along_x() -> dict[str, float]:
    return numbers(sheared(0.0, n=48))


@pytest.mark.solves
@pytest.mark.parametrize("degrees", [37.0, 90.0])
def test_turned_shear_gives_the_same_numbers(along_x: dict[str, float], degrees: float) -> None:
    turned = numbers(sheared(np.radians(degrees), n=48))
    for name, right in along_x.items():
        assert turned[name] == pytest.approx(right, rel=0.01), (name, degrees)


@pytest.mark.solves
def test_the_outline_of_a_sheared_ball() -> None:
    at = sheared(np.radians(37.0)).at(-1)
    outline = at.outline
    assert outline is not None
    azimuth = outline.shear_azimuth
    assert azimuth is not None
    assert np.degrees(azimuth) == pytest.approx(37.0, abs=0.5)
    for angle in np.linspace(0.0, np.pi, 7):
        rear, front = outline.border(angle)
        assert front == pytest.approx(A, rel=0.01)
        assert rear == pytest.approx(-A, rel=0.01)
    section = at.stress()
    assert section.s_1.dims == ("depth", "s")
    assert float(section.dataset.azimuth) == pytest.approx(azimuth)


def test_tractions_are_drawn_along_the_shear() -> None:
    angle = np.radians(37.0)
    straight, turned = sheared(0.0).at(-1), sheared(angle).at(-1)
    along, cut = straight.along(), turned.along()
    assert along.p.dims == ("x",)
    assert cut.p.dims == ("s",)
    assert float(cut.p.max()) == pytest.approx(float(along.p.max()), rel=0.01)
    # The largest shear is a cusp between the cells; its integral is known better.
    assert float(cut.q_s.integrate("s")) == pytest.approx(float(along.q_x.integrate("x")), rel=0.02)
    assert float(abs(cut.q_t).max()) < 0.05 * float(abs(cut.q_s).max())
    np.testing.assert_allclose(straight.along(y=0.0).p, straight.along_x().p)
    across = straight.along(x=0.3 * A)
    np.testing.assert_allclose(across.p, straight.p.interp(x=0.3 * A))
    with pytest.raises(ValueError, match="a point is no line"):
        straight.along(x=0.0, y=0.0)
    for draw in (fret.plot.shear_profile, fret.plot.pressure_profile):
        ax = draw(turned, units="SI")
        assert ax.get_xlabel().startswith("$s$")
        drawn = ax.lines[0].get_ydata()
        assert np.abs(drawn).max() == pytest.approx(
            1e-6 * float(abs(cut["p" if draw is fret.plot.pressure_profile else "q_s"]).max())
        )
    plt.close("all")


def test_an_oblique_section_is_the_stress_at_its_points() -> None:
    at = sheared(np.radians(37.0)).at(-1)
    below = at.stress([0.0, 0.3 * A], x=0.1 * A, y=-0.2 * A, azimuth=0.5)
    for n in (5, 14, 22):
        x, y = (float(below.dataset[name][n]) for name in ("x", "y"))
        point = at.stress([0.0, 0.3 * A], x=x, y=y)
        for name in ("s_xx", "s_xy", "s_zz"):
            assert below.dataset[name][:, n].values == pytest.approx(
                point.dataset[name].values, rel=1e-9, abs=1.0
            )
    rims = below.rims()
    assert rims.s_xx.sizes["rim"] == 2
    x, y = rims.dataset.x.values, rims.dataset.y.values
    assert np.hypot(x, y) == pytest.approx(A, rel=0.01)


@pytest.mark.solves
def test_the_crack_begins_where_an_elliptic_contact_ends() -> None:
    result = sheared(
        0.0, n=64, extent=4.4, shape=fret.shapes.Ellipsoid(R_x=2.0 * RADIUS, R_y=0.5 * RADIUS)
    )
    at = result.at(-1)
    outline = at.outline
    assert outline is not None
    rim = max(outline.border(0.0))
    cells = np.abs(at.dataset.x.values[at.contact.values.any(axis=1)]).max()
    assert rim == pytest.approx(cells, abs=0.8 * result.scene.grid.dx)
    lengths = [0.1 * A, 0.2 * A]
    by_default = result.crack(lengths=lengths).dK().max()
    there = max(
        float(result.crack(x=x, lengths=lengths, azimuth=0.0).dK().max()) for x in (-rim, rim)
    )
    assert float(by_default) >= 0.99 * there


@pytest.mark.solves
def test_the_largest_stress_of_a_buried_layer_lies_beyond_the_grid() -> None:
    ball, base = fret.Elastic(E=190e9, nu=0.25), fret.Elastic(E=205e9, nu=0.26)
    a = fret.reference.hertz(R=8e-3, bodies=(ball, base), W=40.0).a
    stack = [
        fret.Coating(fret.Elastic(E=225e9, nu=0.31), thickness=0.13 * a),
        fret.Coating(fret.Elastic(E=690e9, nu=0.18), thickness=0.042 * a),
    ]

    def largest(extent: float, n: int) -> fret.subsurface.Extremum:
        scene = fret.Scene(
            body1=fret.Body(ball, shape=fret.Sphere(R=8e-3)),
            body2=fret.Body(base, coatings=stack),
            friction=0.0,
            grid=fret.Grid.centred(width=extent * a, n=n),
        )
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            result = fret.solve(scene, fret.LoadPath.start().normal(40.0), progress=False)
            return result.at(-1).stress().maximum("s_1", layer=1)

    wide = largest(5.0, 96)
    for n in (56,):
        short = largest(2.8, n)
        assert abs(short.value - wide.value) <= 0.03 * wide.value + short.error


def test_worn_profiles_and_work_lie_along_the_shear() -> None:
    """Sheared along y, wear and Ruiz' parameters are those along x, on the line along y."""
    collected = []
    for name, angle in (("x", 0.0), ("y", np.pi / 2)):
        run = sheared(angle, n=24)
        worn = fret.wear.solve(
            run.scene,
            cycles=100,
            first_branch=2,
            body2=fret.wear.Archard(2e-14),
            jumps=1,
            progress=False,
        )
        cut, ruiz = worn.along(), fatigue.ruiz(run)
        assert worn.direction == name
        assert cut.worn2.dims == ("block", name)
        assert fret.plot.wear_profiles(worn).get_xlabel() == f"${name}$ [mm]"
        assert fret.plot.wear_loops(worn).get_ylabel() == f"$T_{name}$ [N]"
        assert ruiz.F1.dims == (name,)
        collected.append((cut.worn2[-1].values, ruiz.F1.values, ruiz.F2.values))
    plt.close("all")
    for along_x, along_y in zip(*collected, strict=True):
        assert along_x.max() > 0.0
        np.testing.assert_allclose(along_y, along_x, rtol=1e-2, atol=1e-3 * along_x.max())


@pytest.mark.solves
def test_a_worst_point_beyond_the_grid_under_a_bulk_stress() -> None:
    """Below a soft coating the bulk stress outweighs the contact beside it, on any grid."""
    titanium = fret.Elastic(E=117e9, nu=0.31)
    soft = fret.Coating(fret.Elastic(E=80e9, nu=0.3), thickness=110e-6)
    W, mu, extent = 205e3, 0.7, 0.583e-3
    path = fret.LoadPath.start().normal(W)
    for sign in (1, -1, 1):
        path = path.force(T_x=sign * 49e3, sigma_B=sign * 134e6)
    material = fatigue.Materials()["titanium_6Al4V"]
    values = []
    for n in (80, 160):
        scene = fret.Scene(
            body1=fret.Body(fret.Elastic(E=210e9, nu=0.3), shape=fret.Cylinder(R=12e-3)),
            body2=fret.Body(titanium, coatings=[soft]),
            friction=mu,
            grid=fret.Grid.strip(extent=extent, n=n),
            path=path,
        )
        result = fret.solve(scene, progress=False, save="all")
        worst = result.life([None, material], "smith_watson_topper").worst_of(1)
        assert abs(worst.x) > 0.5 * extent
        values.append((worst.value, worst.error))
    (coarse, error), (fine, _) = values
    assert abs(coarse - fine) < 1.5 * error + 0.002 * fine


def result_at_offset(cells: int, *, residual: object = None) -> fret.Result:
    """A ball whose top lies some cells off the middle along y, sheared along x."""
    ti = fret.Elastic(E=117e9, nu=0.31)
    a = fret.reference.hertz(R=5e-3, bodies=(ti, ti), W=30.0).a
    n = 36
    dx = 4.6 * a / n
    at = (np.arange(n + 4) - (n + 3) / 2) * dx
    x, y = np.meshgrid(at, at - cells * dx, indexing="ij")
    top = fret.SurfaceMap(-(x**2 + y**2) / 1e-2, spacing=(dx, dx))
    path = fret.LoadPath.start().normal(30.0, increments=1)
    for sign in (1.0, -1.0, 1.0):
        path = path.force(T_x=sign * 9.0, increments=4)
    options = {} if residual is None else {"residual": residual}
    scene = fret.Scene(
        body1=fret.Body(ti, shape=top),
        body2=fret.Body(ti, **options),
        friction=0.5,
        grid=fret.Grid.centred(width=n * dx, n=n),
        path=path,
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return fret.solve(scene, save="all", progress=False)


@pytest.mark.solves
def test_a_crack_lies_in_the_plane_of_the_contact() -> None:
    middle, moved = result_at_offset(0), result_at_offset(7)
    threshold = fret.fracture.Threshold(dK_th=3e6, dS_0=500e6)
    right, shifted = middle.crack(), moved.crack()
    cell = moved.scene.grid.dy
    assert shifted.dataset.attrs["offset"] == pytest.approx(7 * cell, abs=0.3 * cell)
    assert shifted.K_max == pytest.approx(right.K_max, rel=0.02, abs=1e4)
    assert shifted.arrest(threshold).verdict == right.arrest(threshold).verdict
    right, shifted = (run.grow_crack(start=1.5e-5, end=3e-5) for run in (middle, moved))
    assert shifted.K_max == pytest.approx(right.K_max, rel=0.02, abs=1e4)
    # The plane through the axis of depth is one that may be given.
    away = moved.crack(offset=0.0, azimuth=0.0)
    assert away.K_max.max() < 0.6 * moved.crack().K_max.max()


@pytest.mark.solves
def test_residual_stress_across_the_shear_is_looked_at() -> None:
    """No point of the surface is worse than the worst point and its error."""
    result = result_at_offset(0, residual=[[0.0, -300e6, 500e6], [1e-3, -300e6, 500e6]])
    material = fatigue.Materials()["titanium_6Al4V"]
    half = result.at(-1).outline.half_width(0.0)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        stress = [fatigue.history(result, z=[0.0], x=x * half) for x in np.linspace(-1.1, 1.1, 5)]
        for name in ("findley", "smith_watson_topper"):
            worst = result.life(material, name).worst
            values = [fatigue.evaluate_margin(line, material, name).value.max() for line in stress]
            assert max(map(float, values)) <= worst.value + 1.5 * worst.error, name


@pytest.mark.solves
def test_unloaded_stress_is_that_of_the_whole_body() -> None:
    """Every measure of a ball that was sheared along x and along y, and unloaded."""
    from pyfret.subsurface.tensor import COMPONENTS, LABELS

    hard, soft = STEEL, STEEL.replace(plastic=fret.Plastic(s_y=800e6, hardening=10e9))
    residual = []
    for axis in ("T_x", "T_y"):
        path = fret.LoadPath.start().normal(120.0, increments=2)
        for sign in (1, -1, 0):
            path = path.force(**{axis: sign * 40.0}, increments=2)
        scene = fret.Scene(
            body1=fret.Body(hard, shape=fret.Sphere(R=10e-3)),
            body2=fret.Body(soft),
            friction=0.5,
            grid=fret.Grid.centred(width=5e-4, n=24),
            path=path.normal(1.0, increments=2),
        )
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            below = fret.solve(scene, save="branches", progress=False).unloaded().stress()
        residual.append(below)
    x, y = residual
    for name in LABELS:
        if name in COMPONENTS or name.startswith("interface"):
            continue
        right, turned = x.maximum(name), y.maximum(name)
        assert turned.value == pytest.approx(right.value, rel=0.03), name
