"""Numbers outside the range of the theory, or of the unit, stay in what is printed."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any

import pytest

import pyfret as fret
from pyfret import wear
from pyfret.errors import InvalidSceneError, SceneWarning
from pyfret.heat import Conductor, temperature

pytestmark = pytest.mark.solves

STEEL, PLASTIC = fret.Elastic(E=210e9, nu=0.3), fret.Elastic(E=3e9, nu=0.4)


def pressed(shaft: Any, hole: Any, a: float, material: fret.Elastic, *, line: bool) -> fret.Scene:
    """A shaft or head in a hole, of such a half width of the contact."""
    k = 1 / 0.010 - 1 / abs(hole.R)
    E_star = material.E / (1 - material.nu**2) / 2
    W = a**2 * k * 3.14159265 * E_star / 4 if line else 4 / 3 * E_star * k * a**3
    grid = fret.Grid.strip(extent=2.6 * a, n=32) if line else fret.Grid.centred(width=2.6 * a, n=32)
    return fret.Scene(
        body1=fret.Body(material, shape=shaft),
        body2=fret.Body(material, shape=hole),
        friction=0.3,
        grid=grid,
        path=fret.LoadPath.start().normal(W, increments=1),
    )


@pytest.mark.parametrize("shape", [fret.Cylinder, fret.Sphere])
def test_conformal_contacts_are_refused_or_doubted_by_the_body(
    shape: Callable[[float], Any],
) -> None:
    line = shape is fret.Cylinder
    scene = pressed(shape(0.010), shape(-0.0102), 0.01985, STEEL, line=line)
    expected = r"a/R = 1\.9.*body1 0\.01 m, in a conformal"
    with pytest.raises(InvalidSceneError, match=expected):
        fret.solve(scene, progress=False)
    scene = pressed(shape(0.010), shape(-0.0102), 0.002, STEEL, line=line)
    with pytest.warns(SceneWarning, match=r"a/R = 0\.20.*conformal contact with body2"):
        result = fret.solve(scene, progress=False)
    pattern = [doubt for doubt in result.doubts if "a/R = 0.2" in doubt]
    assert len(pattern) == 1, result.doubts
    assert pattern[0] in result.summary()


@pytest.mark.usefixtures("without_overview")
def test_doubts_of_the_scene_and_of_the_run_stay_in_the_result_and_its_report(
    tmp_path: Any,
) -> None:
    scene = pressed(fret.Sphere(0.010), fret.Sphere(-0.0102), 0.002, PLASTIC, line=False)
    path = scene.path.force(sigma_B=150.0, increments=1)
    with pytest.warns(SceneWarning) as text:
        result = fret.solve(scene, path, progress=False)
    messages = [str(item.message) for item in text]
    assert any("sigma_B = 150 Pa is less" in doubt for doubt in result.doubts), result.doubts
    assert sum("sigma_B = 150 Pa is less" in message for message in messages) == 1
    summary = result.summary()
    result.report(tmp_path / "page.html")
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    for doubt in result.doubts:
        assert doubt in summary
        assert doubt.replace("'", "&#x27;") in page
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        stored = fret.solve(scene, path, out=tmp_path / "store.zarr", progress=False)
        assert stored.doubts == result.doubts
        *_, last = fret.march(scene, path)
        assert last.doubts == result.doubts


def test_an_elastic_pressure_above_a_hundredth_of_the_softest_modulus_is_doubted() -> None:
    a = 1e-4
    scene = pressed(fret.Sphere(0.010), fret.Sphere(-1e9), a, STEEL, line=False)
    hard = fret.Coating(fret.Elastic(E=450e9, nu=0.25), thickness=2e-6)
    W = float(scene.path.branches[-1].W)
    for factor, doubted in ((0.5, False), (4.0, True)):
        extra = scene.replace(
            body1=fret.Body(STEEL, shape=fret.Sphere(0.002)),
            body2=fret.Body(STEEL, coatings=hard),
            path=fret.LoadPath.start().normal(factor * W, increments=1),
        )
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            result = fret.solve(extra, progress=False)
        p_max = float(result.at(-1).p_max)
        assert (p_max > 2.1e9) == doubted, p_max
        assert any("E/100" in doubt for doubt in result.doubts) == doubted, result.doubts


def test_doubtful_numbers_of_wear_and_heat_stay_in_their_results() -> None:
    path = fret.LoadPath.start().normal(20.0, increments=2)
    for T in (5.0, -5.0, 5.0):
        path = path.force(T_x=T, increments=3)
    scene = fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Sphere(0.01)),
        body2=fret.Body(STEEL),
        friction=0.6,
        grid=fret.Grid.centred(width=2.6e-4, n=24),
        path=path,
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        worn = wear.solve(scene, body1=wear.Archard(k=1e-9), cycles=1, progress=False)
        small = Conductor(conductivity=0.045, heat_capacity=3.6e6)
        hot = temperature(fret.solve(scene, save="all", progress=False), small, small, frequency=5)
    law, cells = worn.doubts
    assert "wear.body1.k" in law
    assert "slip zone is 1.7 cells wide" in cells
    assert all(doubt in worn.summary() for doubt in worn.doubts)
    assert "conductivity = 0.045" in hot.attrs["doubts"]


@pytest.mark.parametrize(("largest", "doubted"), [(300e6, False), (300.0, True)])
@pytest.mark.parametrize("name", ["sigma_B", "sigma_B1"])
def test_a_bulk_stress_is_doubted_where_it_is_largest(
    name: str, largest: float, *, doubted: bool
) -> None:
    # A swing passes 0: its small values are no mistake of units.
    steel = fret.Elastic(E=210e9, nu=0.3)
    path = fret.LoadPath.start().normal(100.0, increments=1)
    for part in (3e-5, 1.0, -1e-6):
        path = path.force(increments=1, **{name: part * largest})
    scene = fret.Scene(
        body1=fret.Body(steel, shape=fret.Sphere(R=0.01)),
        body2=fret.Body(steel),
        friction=0.3,
        grid=fret.Grid.centred(width=4e-4, n=24),
        path=path,
    )
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        fret.solve(scene, progress=False)
    doubts = [str(item.message) for item in caught if "fatigue load" in str(item.message)]
    assert [f"path[2].{name}" in text for text in doubts] == [True] * doubted, doubts
