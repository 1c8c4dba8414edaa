"""Stiffness right after a reversal and sliding ratio: known to their errors, or not given."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

import pyfret as fret

if TYPE_CHECKING:
    from collections.abc import Sequence

    import xarray as xr

pytestmark = pytest.mark.solves

SIC, STEEL = fret.Elastic(E=410e9, nu=0.14), fret.Elastic(E=193e9, nu=0.29)
R, W, MU = 3e-3, 8.0, 0.45


def mindlin(a: float) -> float:
    """R. D. Mindlin, J. Appl. Mech. 16 (1949) 259-268: 8 a/((2 - nu1)/G1 + (2 - nu2)/G2)."""
    compliance = sum((2 - m.nu) * 2 * (1 + m.nu) / m.E for m in (SIC, STEEL))
    return 8 * a / compliance


def loop(
    reach: float,
    increments: int,
    *,
    n: int = 32,
    layers: Sequence[fret.Coating] = (),
    mu: float = MU,
) -> tuple[xr.Dataset, str]:
    """The last loop of a ball on a flat, and the summary."""
    a = fret.reference.hertz(R=R, bodies=(SIC, STEEL), W=W).a
    scene = fret.Scene(
        body1=fret.Body(SIC, shape=fret.Sphere(R=R)),
        body2=fret.Body(STEEL, coatings=layers),
        friction=mu,
        grid=fret.Grid.centred(width=2.6 * a, n=n),
    )
    path = fret.LoadPath.start().normal(W)
    for to in (reach, -reach, reach):
        path = path.displace(delta_x=to, increments=increments)
    result = fret.solve(scene, path, progress=False)
    return result.loops().isel(cycle=-1), result.summary()


@pytest.mark.filterwarnings("ignore::pyfret.errors.SceneWarning")
@pytest.mark.parametrize("reach", [1e-7, 3e-7, 6e-7])
@pytest.mark.parametrize("increments", [3, 5, 8, 12, 20])
@pytest.mark.parametrize("layer", [None, (410e9, 0.3), (100e9, 0.15)])
def test_a_stiffness_in_partial_slip(
    reach: float,
    increments: int,
    layer: tuple[float, float] | None,
) -> None:
    """Within 2 % of Mindlin's on a bare flat, or not given; on layers of the stuck contact's."""
    a, layers = fret.reference.hertz(R=R, bodies=(SIC, STEEL), W=W).a, []
    if layer is not None:
        E, thick = layer
        layers = [fret.Coating(fret.Elastic(E=E, nu=0.2), thickness=thick * a)]
    loop_numbers, summary = loop(reach, increments, n=24, layers=layers)
    stiffness, error = float(loop_numbers.stiffness), float(loop_numbers.stiffness_error)
    if np.isnan(stiffness):
        assert np.isnan(error)
        assert "use more" in summary
        assert increments < 12 or reach > 3e-7
        return
    right = mindlin(a)
    if layers:
        stuck, _ = loop(2e-8, 3, n=24, layers=layers, mu=20.0)
        right = float(stuck.stiffness)
    assert stiffness == pytest.approx(right, rel=0.02)
    assert 0.0 < error < 0.02 * stiffness
    if not layers:
        assert abs(stiffness - right) < error


@pytest.mark.parametrize("reach", [15e-6, 1e-6, 2e-7])
@pytest.mark.parametrize("increments", [3, 12, 40])
def test_the_stiffness_is_mindlins_or_not_given(reach: float, increments: int) -> None:
    a = fret.reference.hertz(R=R, bodies=(SIC, STEEL), W=W).a
    loop_numbers, summary = loop(reach, increments)
    stiffness = float(loop_numbers.stiffness)
    # 40 increments of a way of 2 um have six in partial slip, 12 have two.
    if reach == 2e-7 or (reach < 1e-5 and increments >= 40):
        assert stiffness == pytest.approx(mindlin(a), rel=0.02)
        assert float(loop_numbers.stiffness_error) < 0.02 * stiffness
    elif reach > 1e-5:
        assert np.isnan(stiffness)
        assert "use more" in summary
    else:
        assert np.isnan(stiffness) or stiffness == pytest.approx(mindlin(a), rel=0.02)
    sliding, error = float(loop_numbers.sliding_ratio), float(loop_numbers.sliding_ratio_error)
    # 0.9777 and 0.6716 on 60 increments a branch and 48 cells.
    right = {15e-6: 0.9777, 1e-6: 0.6716, 2e-7: 0.0735}[reach]
    assert np.isnan(sliding) or abs(sliding - right) < error + 0.005
    assert np.isnan(sliding) == (error > 0.05)


@pytest.mark.parametrize(("n", "increments", "part"), [(24, 8, 0.6), (24, 4, 0.3), (32, 14, 0.8)])
def test_a_stiffness_in_torsion(n: int, increments: int, part: float) -> None:
    """Within the error of Reissner and Sagoci's 16 a^3/(3 (1/G1 + 1/G2)), on few cells as well."""
    a = fret.reference.hertz(R=R, bodies=(SIC, STEEL), W=W).a
    right = 16.0 * a**3 / (3.0 * sum(2.0 * (1.0 + m.nu) / m.E for m in (SIC, STEEL)))
    scene = fret.Scene(
        body1=fret.Body(SIC, shape=fret.Sphere(R=R)),
        body2=fret.Body(STEEL),
        friction=MU,
        grid=fret.Grid.centred(width=2.6 * a, n=n),
    )
    path = fret.LoadPath.start().normal(W, increments=1)
    for sign in (1.0, -1.0, 1.0):
        upper = 3.0 * np.pi / 16.0 * MU * W * a
        path = path.force(M_z=sign * part * upper, increments=increments)
    loop_numbers = fret.solve(scene, path, progress=False).loops(direction="torsion").isel(cycle=-1)
    error = float(loop_numbers.stiffness_error)
    assert error < 0.06 * right
    assert abs(float(loop_numbers.stiffness) - right) < error


def sliding_ratio(T: float, limit: float) -> float:
    """Half the opening at T = 0 over half the range of the shift, from Mindlin's loading curve."""
    shift = 1.0 - (1.0 - np.array([T, 0.5 * T]) / limit) ** (2.0 / 3.0)
    return float(1.0 - 2.0 * shift[1] / shift[0])


def test_numbers_of_a_cycle_have_the_errors_of_its_branches() -> None:
    """Four in five of Mindlin's loops are within 1.5 errors, all within 2."""
    hertz = fret.reference.hertz(R=R, bodies=(STEEL, STEEL), W=W)
    right = fret.reference.CattaneoMindlin(hertz, bodies=(STEEL, STEEL), mu=MU)
    ratios = []
    for n in (20, 26, 32):
        for T in right.T_limit * np.array([0.3, 0.5, 0.6, 0.7, 0.85]):
            scene = fret.Scene(
                body1=fret.Body(STEEL, shape=fret.Sphere(R=R)),
                body2=fret.Body(STEEL),
                friction=MU,
                grid=fret.Grid.centred(width=2.6 * hertz.a, n=n),
                path=fret.LoadPath.start().normal(W).cycles(1, T_x=T),
            )
            result = fret.solve(scene, error=True, progress=False)
            loop_numbers = result.loops().isel(cycle=-1)
            for name, value in (
                ("dissipated", right.loop_energy(T)),
                ("energy_ratio", right.energy_ratio(T)),
                ("sliding_ratio", sliding_ratio(T, right.T_limit)),
            ):
                error = float(loop_numbers[f"{name}_error"])
                if np.isnan(loop_numbers[name]):
                    assert name == "sliding_ratio"
                    continue
                # The opening has the bound of the increments, too.
                assert 0.0 < error < (0.2 * value if name != "sliding_ratio" else 0.1)
                ratios.append(abs(float(loop_numbers[name]) - value) / error)
    assert np.mean(np.array(ratios) <= 1.5) >= 0.8
    assert max(ratios) < 2.0
    line = next(line for line in result.summary().splitlines() if line.startswith("cycle"))
    assert "+- " in line.split("energy ratio")[0]
    assert "+- " in line.split("energy ratio")[1].split(",")[0]
    without = fret.solve(scene, progress=False).loops()
    assert not {"dissipated_error", "energy_ratio_error"} & set(without.data_vars)


@pytest.mark.solves
@pytest.mark.parametrize("increments", [3, 8, 30, "auto"])
def test_an_opening_is_right_or_not_given(increments: int | str) -> None:
    """A ball that slides on a rig: half the opening is the shift less the elastic one."""
    steel, mu, W, rig, shift = fret.material("steel"), 0.15, 8.0, 1e7, 30e-6
    scene = fret.Scene(
        body1=fret.Body(steel, shape=fret.Sphere(R=5e-3)),
        body2=fret.Body(steel),
        friction=mu,
        grid=fret.Grid.centred(width=2e-4, n=32),
        path=fret.LoadPath.start()
        .normal(W)
        .cycles(1, delta_x=shift, increments=increments)
        .rig(rig),
    )
    loop = fret.solve(scene, progress=False).loops()
    opening = float(loop.opening[0])
    assert np.isnan(opening) == np.isnan(float(loop.sliding_ratio[0]))
    # The energy of a loop of two stick and two slip lines is 4 mu W times half its opening.
    right = float(loop.dissipated[0]) / (4.0 * mu * W)
    bound = max(float(loop.sliding_ratio_error[0]), 1e-3) * shift
    assert np.isnan(opening) or abs(opening - right) < bound, (opening, right)
    assert (increments == "auto") <= np.isfinite(opening)


@pytest.mark.filterwarnings("ignore::pyfret.errors.SceneWarning")
def test_the_sliding_ratio_has_the_error_of_the_cells_without_error_bars() -> None:
    """Narrow and wide slip zones of equal balls, many increments: Mindlin, Deresiewicz (1953)."""
    load, mu = 50.0, 0.5
    a = fret.reference.hertz(R=10e-3, bodies=(STEEL, STEEL), W=load).a
    # The shift at the onset of sliding, 3 mu W (2 - nu)/(8 G a) of equal bodies.
    G = STEEL.E / (2.0 * (1.0 + STEEL.nu))
    limit = 3.0 * mu * load * (2.0 - STEEL.nu) / (8.0 * G * a)
    ratios, of_opening = [], []
    for n in (16, 24, 32, 48):
        for part in (0.15, 0.3, 0.5, 0.7, 0.9):
            path = fret.LoadPath.start().normal(load, increments=1)
            path = path.cycles(1, T_x=part * mu * load, increments=60)
            scene = fret.Scene(
                body1=fret.Body(STEEL, shape=fret.Sphere(R=10e-3)),
                body2=fret.Body(STEEL),
                friction=mu,
                grid=fret.Grid.centred(width=2.4 * a, n=n),
            )
            last = fret.solve(scene, path, progress=False).loops().isel(cycle=-1)
            off = abs(float(last.sliding_ratio) - sliding_ratio(part, 1.0))
            ratios.append(off / float(last.sliding_ratio_error))
            shift = limit * (1.0 - (1.0 - part) ** (2.0 / 3.0))
            off = abs(float(last.opening) - sliding_ratio(part, 1.0) * shift)
            of_opening.append(off / float(last.opening_error))
    for every in (ratios, of_opening):
        assert np.mean(np.array(every) < 1.5) >= 0.95, every
        assert np.median(every) > 0.1
