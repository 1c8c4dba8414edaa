"""Friction as a function of the user: its arguments, its errors, resuming."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyfret as fret
from conftest import MU, W, sphere_on_flat

pytestmark = pytest.mark.solves

PATH = fret.LoadPath.start().normal(W, increments=2).cycles(1, T_x=0.5 * MU * W, increments=6)


def worn(of: fret.Scene, **options: Any) -> fret.wear.WearResult:
    arguments: dict[str, Any] = {"cycles": 2e4, "body2": fret.wear.Archard(1e-14), "jumps": 3}
    return fret.wear.solve(of, **{**arguments, "progress": False, **options})


def scene(law: Any, path: fret.LoadPath = PATH) -> fret.Scene:
    return sphere_on_flat(n=24).replace(friction=fret.Friction(MU, law=law), path=path)


def by_pressure(x: Any, y: Any, p: Any, slip: Any, dissipated: Any) -> Any:
    return MU * p / 1e9


def softening(x: Any, y: Any, p: Any, slip: Any, dissipated: Any) -> Any:
    return MU * np.interp(slip, [0.0, 1e-6], [1.0, 0.8])


def test_a_law_of_pressure_slides_under_the_sum_of_its_coefficient_times_the_pressure() -> None:
    # Under Hertz's pressure the sum of p^2 is 3/4 p_H W.
    path = fret.LoadPath.start().normal(W, increments=1).displace(delta_x=2e-5, increments=6)
    result = fret.solve(scene(by_pressure, path), progress=False)
    limit = 0.75 * MU * result.p_H / 1e9 * W
    assert float(result.T_x[-1]) == pytest.approx(limit, rel=5e-3)
    at = result.at(-1)
    q, p = np.hypot(at.q_x, at.q_y).values, at.p.values
    np.testing.assert_allclose(q[p > 0], MU * p[p > 0] ** 2 / 1e9, rtol=2e-3)


def slides(to: float) -> fret.LoadPath:
    path = fret.LoadPath.start().normal(W, increments=1)
    return path.displace(delta_x=to).displace(delta_x=-to).displace(delta_x=to)


def test_a_law_of_pressure_dissipates_in_gross_slip_what_it_does_under_hertz() -> None:
    path = slides(2e-5)
    once = {"cycles": 1, "jumps": 1, "body2": fret.wear.Archard(1e-20), "cycling": "sliding"}
    result = worn(scene(by_pressure, path), **once)
    mu = 0.75 * MU * scene(by_pressure, path).hertz.p_H / 1e9
    assert float(result.mu[-1]) == pytest.approx(mu, rel=5e-3)
    assert float(result.dissipated_per_cycle[-1]) == pytest.approx(4 * 2e-5 * mu * W, rel=5e-3)


def test_a_law_of_slip_gives_what_the_same_table_gives() -> None:
    table = fret.Friction(MU, history=(fret.History.SLIP, [(0.0, 1.0), (1e-6, 0.8)]))
    by_table = fret.solve(scene(softening).replace(friction=table), progress=False)
    by_law = fret.solve(scene(softening), progress=False)
    np.testing.assert_allclose(by_law.delta_x, by_table.delta_x, atol=2e-3 * 1e-6)
    # Each coefficient is settled to a thousandth.
    np.testing.assert_allclose(by_law.dissipated, by_table.dissipated, rtol=1e-2, atol=1e-12)


def test_a_law_sees_every_cell_and_where_it_is() -> None:
    seen: list[tuple[np.ndarray[Any, Any], ...]] = []

    def law(*cells: Any) -> float:
        seen.append(tuple(np.array(item) for item in cells))
        return MU

    result = fret.solve(scene(law), progress=False)
    x, y, p, slip, dissipated = seen[-1]
    assert {item.shape for item in seen[-1]} == {x.shape}
    at, places = result.at(-1), result.dataset
    i = np.abs(places.x.values[:, None] - x).argmin(axis=0)
    j = np.abs(places.y.values[:, None] - y).argmin(axis=0)
    np.testing.assert_allclose(x, places.x.values[i], atol=1e-12)
    np.testing.assert_allclose(p, at.p.values[i, j], rtol=1e-9)
    np.testing.assert_allclose(dissipated, at.dissipated_density.values[i, j], rtol=1e-6)
    assert slip.max() > np.abs(at.slip_x.values).max() > 0
    plain = fret.solve(scene(law).replace(friction=MU), progress=False)
    largest = float(np.abs(plain.delta_x).max())
    np.testing.assert_allclose(result.delta_x, plain.delta_x, atol=1e-6 * largest)


def test_what_a_law_raises_is_raised_as_it_is() -> None:
    class Mine(Exception):
        pass

    def law(*_: Any) -> float:
        raise Mine("no such film")

    with pytest.raises(Mine, match="no such film"):
        fret.solve(scene(law), progress=False)
    with pytest.raises(Mine, match="no such film"):
        list(fret.march(scene(law)))


@pytest.mark.parametrize(
    ("gives", "error", "expected"),
    [
        (np.nan, fret.errors.InvalidSceneError, "finite coefficient >= 0"),
        (-0.1, fret.errors.InvalidSceneError, r"friction.law = -0.1 at x = "),
        (np.inf, fret.errors.InvalidSceneError, "finite coefficient >= 0"),
        (np.ones(3), ValueError, r"shape \[3\], must be \(576,\)"),
        ("much", TypeError, "array of real numbers"),
        (1j, TypeError, "array of real numbers"),
    ],
)
def test_what_is_no_coefficient_is_refused(
    gives: Any, error: type[Exception], expected: str
) -> None:
    with pytest.raises(error, match=expected):
        fret.solve(scene(lambda *_: gives), progress=False)


def test_a_law_is_a_function_and_alone() -> None:
    with pytest.raises(TypeError, match="must be a function of the arrays"):
        fret.Friction(MU, law=3)  # type: ignore[arg-type]
    with pytest.raises(fret.errors.InvalidSceneError, match="without map, history, kinetic"):
        fret.Friction(MU, law=softening, kinetic=0.2)
    with pytest.raises(TypeError, match=r"Friction\(0.3, law=function\)"):
        sphere_on_flat().replace(friction=softening)
    path = slides(2e-5).replace(rig_stiffness=1e9)
    with pytest.raises(ValueError, match=r"a law of your own.*march"):
        worn(scene(softening, path), cycling="sliding", cycles=10)


def test_a_law_is_kept_by_copies_and_only_named_by_files(tmp_path: Path) -> None:
    law = fret.Friction(MU, law=softening)
    for copied in (pickle.loads(pickle.dumps(law)), copy.deepcopy(law), law.replace()):
        assert copied == law
        assert copied.law is softening
    assert law != fret.Friction(MU, law=by_pressure)
    text = scene(softening).to_toml()
    assert 'law = "own"' in text
    read = fret.Scene.from_toml(text)
    assert read.friction.law == "own"
    assert read.to_toml() == text
    with pytest.raises(fret.errors.InvalidSceneError, match="must be given again"):
        fret.solve(read, progress=False)


def test_a_run_goes_on_with_its_law_bit_by_bit(tmp_path: Path) -> None:
    whole = fret.solve(scene(softening), progress=False)
    store = tmp_path / "run.zarr"
    calls = 0

    def stops(*cells: Any) -> Any:
        nonlocal calls
        calls += 1
        if calls == 25:
            raise RuntimeError("power cut")
        return softening(*cells)

    with pytest.raises(RuntimeError, match="power cut"):
        fret.solve(scene(stops), out=store, checkpoint=0.0, progress=False)
    assert 0 < fret.open(store).dataset.sizes["increment"] < whole.dataset.sizes["increment"]
    with pytest.raises(fret.errors.InvalidSceneError, match="friction_law="):
        fret.resume(store, progress=False)
    resumed = fret.resume(store, friction_law=softening, progress=False)
    assert resumed.status == "done"
    for name in ("delta_x", "dissipated", "q_x"):
        assert (resumed.dataset[name].values == whole.dataset[name].values).all(), name


def by_energy(x: Any, y: Any, p: Any, slip: Any, dissipated: Any) -> Any:
    return MU * np.interp(dissipated, [0.0, 1e7], [1.0, 0.7])


def test_over_cycles_of_wear_a_law_gives_what_the_same_table_gives() -> None:
    table = fret.Friction(MU, history=(fret.History.DISSIPATED, [(0.0, 1.0), (1e7, 0.7)]))
    constant, by_table, by_law = (
        worn(scene(by_energy).replace(friction=mu)).dataset
        for mu in (MU, table, fret.Friction(MU, law=by_energy))
    )
    # Each coefficient is settled to a thousandth.
    np.testing.assert_allclose(by_law.volume2, by_table.volume2, rtol=1e-3)
    np.testing.assert_allclose(by_law.dissipated, by_table.dissipated, rtol=1e-3)
    assert abs(float(by_law.volume2[-1] / constant.volume2[-1]) - 1.0) > 0.05


def test_a_run_of_wear_goes_on_with_its_law_bit_by_bit(tmp_path: Path) -> None:
    whole = worn(scene(by_energy), jumps=4)
    calls, lasts = 0, 10**9

    def stops(*cells: Any) -> Any:
        nonlocal calls
        calls += 1
        if calls > lasts:
            raise RuntimeError("power cut")
        return by_energy(*cells)

    worn(scene(stops), jumps=4)
    calls, lasts = 0, calls // 2
    store = tmp_path / "worn.zarr"
    with pytest.raises(RuntimeError, match="power cut"):
        worn(scene(stops), jumps=4, out=store)
    assert 0 < fret.open(store).dataset.sizes["jump"] < 4
    with pytest.raises(ValueError, match="friction_law="):
        fret.wear.resume(store, progress=False)
    resumed = fret.wear.resume(store, friction_law=by_energy, progress=False)
    assert resumed.dataset.attrs["status"] == "done"
    for name in ("volume2", "worn2", "dissipated"):
        assert (resumed.dataset[name].values == whole.dataset[name].values).all(), name
