"""Cracks: below a contact and under plain histories; thresholds, arrest, the command line."""

from __future__ import annotations

import copy
import pickle
from typing import TYPE_CHECKING

import matplotlib as mpl
import numpy as np
import pytest

import pyfret as fret
from pyfret import fracture
from pyfret._cli import commands

if TYPE_CHECKING:
    from pathlib import Path

mpl.use("Agg")

STEEL = fret.Elastic(E=210e9, nu=0.3)
F_0 = 1.121522255231


@pytest.fixture(scope="module")
def rig() -> fret.Result:
    """A pad on a flat under half of the sliding force, back and forth."""
    W, mu, a = 2e5, 0.6, 3.3e-4
    scene = fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Cylinder(R=0.05)),
        body2=fret.Body(STEEL),
        mu=mu,
        grid=fret.Grid.strip(extent=3 * a, n=96),
    )
    T = 0.5 * mu * W
    path = fret.LoadPath.start().normal(W, increments=2).tangential([T, -T, T], increments=24)
    return fret.solve(scene, path, save="all")


def test_uniform_tension_on_a_normal_crack() -> None:
    crack = fracture.Crack(legs=[(1e-4, 0.0)])
    stress = np.zeros((2, len(crack.points), 6))
    stress[0, :, 0] = 100e6
    K = crack.intensity(stress)
    assert K["K_I"][0] == pytest.approx(F_0 * 100e6 * np.sqrt(np.pi * 1e-4), rel=1e-7)
    assert K["error"][0] < 1e-6 * K["K_I"][0]
    stress[1, :, 0] = -50e6
    closed = crack.intensity(stress, friction=0.3)
    assert closed["K_I"][1] == 0.0
    assert closed["open"].tolist() == pytest.approx([1.0, 0.0])
    with pytest.raises(ValueError, match="must be"):
        crack.intensity(stress[:, :-1])


def test_cracks_are_values() -> None:
    crack = fracture.Crack(legs=[(1e-4, 0.0), (2e-4, 0.3)], x=-1e-3)
    for again in (pickle.loads(pickle.dumps(crack)), copy.copy(crack)):
        assert np.array_equal(again.points, crack.points)
    assert repr(crack) == "Crack(legs=[(0.0001, 0.0), (0.0002, 0.3)], x=-0.001)"
    with pytest.raises(ValueError, match="length"):
        fracture.Crack(legs=[(-1e-4, 0.0)])


def test_the_worse_rim_is_the_trailing_one_and_short_cracks_stop(rig: fret.Result) -> None:
    cracks = rig.crack()
    assert abs(abs(cracks.dataset.attrs["x"]) / rig.a_H - 1.0) < 0.05
    # The force goes to and fro: both rims are trailing ones, the range is that of either.
    mirrored = rig.crack(-cracks.dataset.attrs["x"], lengths=cracks.lengths)
    assert mirrored.dK() == pytest.approx(cracks.dK(), rel=0.05)
    dK = cracks.dK()
    assert np.all(cracks.dataset.K_I >= 0.0)
    low, high = 0.5 * dK.max(), 2.0 * dK.max()
    stops = cracks.arrest(fracture.Threshold(low), start=float(cracks.lengths[dK.argmax()]))
    assert stops.verdict == "stops"
    assert stops.margin < 1.0
    assert cracks.arrest(fracture.Threshold(high)).verdict == "dormant"
    life = cracks.life(
        fracture.Threshold(low),
        fracture.Paris(C=1e-11, m=3.0),
        start=float(cracks.lengths[dK.argmax()]),
    )
    assert life.stopped
    assert 0.0 < life.cycles < np.inf
    assert life.length == pytest.approx(stops.length)


def test_bulk_tension_opens_a_crack_as_it_should(rig: fret.Result) -> None:
    """Far below a contact the bulk stress alone is left: checked by a run with it."""
    scene = rig.scene
    path = fret.LoadPath.start().normal(2e5, increments=2)
    path = path.force(T_x=3e4, sigma_B=200e6, increments=6)
    path = path.force(T_x=-3e4, sigma_B=0.0, increments=6)
    path = path.force(T_x=3e4, sigma_B=200e6, increments=6)
    pulled = fret.solve(scene, path, save="all").crack(lengths=[1e-5, 1e-4, 1e-3, 3e-3])
    K = F_0 * 200e6 * np.sqrt(np.pi * 3e-3)
    assert pulled.K_max[-1] == pytest.approx(K, rel=0.15)


def test_thresholds() -> None:
    haddad = fracture.Threshold(dK_th=2.1e6, dS_0=124e6)
    assert haddad.a_0 == pytest.approx(91.29465388e-6)
    assert haddad.at(1e-5) == pytest.approx(0.659821e6, rel=1e-5)
    assert fracture.Threshold(2.1e6).at([1e-6, 1.0]).tolist() == [2.1e6, 2.1e6]
    with pytest.raises(ValueError, match="dK_th"):
        fracture.Threshold(-1.0)
    steel = fret.fatigue.Materials()["steel_42CrMo4"]
    with pytest.raises(ValueError, match="dK_th"):
        fracture.Threshold.of(steel)
    own = fret.fatigue.Material("mine", [("dK_th", 8e6, "a test"), ("s_D", 300e6, "another")])
    assert fracture.Threshold.of(own) == fracture.Threshold(4e6, 300e6)


def test_kitagawa_of_uniform_tension() -> None:
    lengths = np.geomspace(1e-6, 1e-3, 20)
    K = 100e6 * np.sqrt(np.pi * lengths)
    cracks = fracture.Cracks.from_arrays(lengths, K, 0 * K)
    found = cracks.kitagawa(fracture.Threshold(2.1e6, 124e6))
    assert found["load"].values == pytest.approx(100e6)
    assert found.limit.values[0] == pytest.approx(124e6, rel=1e-2)
    assert cracks.scaled(0.5).K_max == pytest.approx(0.5 * K)
    assert fracture.ellipse_factor(1.0) == pytest.approx(0.590752, rel=1e-5)


def test_films() -> None:
    film = fret.Coating(STEEL, thickness=4e-6)
    G = fracture.channel_release(film, STEEL, 1e9)
    assert pytest.approx(1.975766 * 1e18 * 4e-6 * 0.91 / 210e9, rel=1e-5) == G
    assert fracture.channel_release(film, STEEL, -1e9) == 0.0
    K = fracture.film_intensity(film, STEEL, 2e-6, 1e9)
    assert pytest.approx(F_0 * 1e9 * np.sqrt(np.pi * 2e-6), rel=1e-6) == K
    with pytest.raises(ValueError, match="depth"):
        fracture.film_intensity(film, STEEL, 5e-6, 1e9)


def test_figures(rig: fret.Result) -> None:
    cracks, threshold = rig.crack(), fracture.Threshold(2e6, 200e6)
    for ax in (
        fret.plot.intensity_history(cracks, 1e-4),
        fret.plot.crack_arrest(cracks, threshold),
        fret.plot.kitagawa(cracks, threshold),
    ):
        assert ax.get_xlabel()
        assert ax.lines


def test_command(rig: fret.Result, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    store = tmp_path / "rig.nc"
    rig.save(store)
    figure = tmp_path / "crack.png"
    lengths = "1e-5,3e-5,1e-4,3e-4"
    told = ["crack", str(store), "--lengths", lengths, "--dK-th", "2e6", "-o", str(figure)]
    assert commands.main(told) == 0
    said = capsys.readouterr().out
    assert said.count("MPa m^0.5") == 4
    assert "least dK/dK_th" in said
    assert figure.stat().st_size > 0
    assert commands.main(["crack", str(store), "--dS-0", "1e8"]) == 2
    assert "--dK-th" in capsys.readouterr().err
