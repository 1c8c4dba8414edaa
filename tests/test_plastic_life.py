"""Criteria of strain below a contact whose plastic strain changes within the cycle."""

from __future__ import annotations

import functools
import json
import subprocess
from typing import TYPE_CHECKING

import numpy as np
import pytest

import pyfret as fret
from conftest import ROOT
from pyfret import fatigue

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.solves

FRET = ROOT / "target" / "release" / "fret"

E, NU = 115e9, 0.32
TITANIUM = fatigue.Materials()["titanium_6Al4V"]
SWT = TITANIUM.assessment("smith_watson_topper").criterion


def scene(s_y: float = 380e6, *, upper: bool = False) -> fret.Scene:
    """A cylinder on a flat of the same material, one of which yields."""
    elastic = fret.Elastic(E=E, nu=NU)
    yielding = elastic.replace(plastic=fret.Plastic(s_y=s_y, kinematic=5e9))
    materials = (yielding, elastic) if upper else (elastic, yielding)
    return fret.Scene(
        body1=fret.Body(materials[0], shape=fret.Cylinder(R=0.05)),
        body2=fret.Body(materials[1]),
        friction=0.4,
        grid=fret.Grid.strip(extent=3.6e-3, n=48),
    )


PRESSED = fret.LoadPath.start().force(W=1.2e6, increments=2)
TO_AND_FRO = PRESSED.cycles(3, T_x=0.9 * 0.4 * 1.2e6, increments=3)


@functools.cache
def alternating(*, upper: bool = False) -> fret.Result:
    """Three cycles of a pair that alternates."""
    return fret.solve(scene(upper=upper), TO_AND_FRO, save="all", progress=False)


def test_the_life_of_a_contact_that_goes_on_yielding_has_the_plastic_strain(tmp_path: Path) -> None:
    """The value follows from the total strain, in Python and on the command line."""
    result = alternating()
    assert result.cyclic_response().kind == "alternates"
    life = result.life(TITANIUM, "fatemi_socie", y=0.0)
    worst = life.worst
    position = {"x": worst.x, "y": 0.0}
    stress = fatigue.history(result, [worst.z], **position)
    strain = fatigue.history(result, [worst.z], **position, of="plastic_strain")
    numbers = TITANIUM.assessment("fatemi_socie").criterion.numbers
    criterion = fatigue.Criterion.fatemi_socie(**{**numbers, "E": E, "nu": NU})
    total = fatigue.evaluate_criterion(stress, criterion, plastic_strain=strain)
    assert float(total.value.item()) == pytest.approx(worst.value, rel=1e-4)
    # The strain of the stress is less than that which is there.
    elastic = float(fatigue.evaluate_criterion(stress.values, criterion).value.item())
    assert elastic < 0.5 * worst.value
    with pytest.raises(ValueError, match=r"fatemi_socie.*plastic_strain=fatigue"):
        fatigue.evaluate_criterion(stress, criterion)
    # A figure of the life draws the same plane.
    own_values = fatigue.evaluate_criterion(
        life.history(), criterion, plastic_strain=life.history("plastic_strain")
    ).normal
    np.testing.assert_allclose(np.abs(own_values), np.abs(worst.normal), atol=1e-6)
    assert len(fret.plot.critical_plane_rose(life).lines) == 3
    crossland = fatigue.Criterion.crossland(alpha=0.2)
    alone, beside = (
        fatigue.evaluate_criterion(stress, crossland, plastic_strain=item).value
        for item in (None, strain)
    )
    np.testing.assert_array_equal(alone, beside)

    store = tmp_path / "alternates.zarr"
    result.save(store)
    command = [FRET, "life", store, "--material", "titanium_6Al4V", "--criterion", "fatemi_socie"]
    ran = subprocess.run([*command, "--json"], capture_output=True, text=True, check=True)
    assert json.loads(ran.stdout.splitlines()[0])["value"] == pytest.approx(worst.value, rel=1e-9)


@pytest.mark.parametrize("upper", [False, True])
def test_the_strain_is_that_of_plane_strain(*, upper: bool) -> None:
    """The whole strain along y is zero everywhere: elastic and plastic strain cancel there."""
    result, number = alternating(upper=upper), 1 if upper else 2
    depths = [10e-6, 60e-6, 200e-6, 500e-6]
    position = {"y": 0.0, "body_number": number}
    stress = fatigue.history(result, depths, **position)
    strain = fatigue.history(result, depths, **position, of="plastic_strain")
    assert strain.dims == stress.dims
    assert strain.shape == stress.shape
    s_xx, s_yy, s_zz = (stress.sel(component=f"s_{c}").values for c in ("xx", "yy", "zz"))
    elastic = (s_yy - NU * (s_xx + s_zz)) / E
    plastic = strain.sel(component="yy").values
    largest = float(np.abs(plastic).max())
    assert largest > 1e-4
    assert float(np.abs(elastic + plastic).max()) < 2e-3 * largest


def test_the_strain_is_that_of_the_points_of_the_volume_grid() -> None:
    """The strain on its planes and in its cells is the stored one."""
    for upper in (False, True):
        result, number = alternating(upper=upper), 1 if upper else 2
        state = result.at(-1)
        kept = state.plastic(body_number=number).dataset.strain.isel(z=slice(0, 6))
        depths = kept.z.values
        computed = fatigue.history(result, depths, y=0.0, body_number=number, of="plastic_strain")
        last = computed.isel(increment=-1).interp(x=kept.x.values)
        own_values = kept.isel(y=0).transpose("z", "x", "component").values
        assert np.abs(own_values).max() > 1e-3
        np.testing.assert_allclose(last.values, own_values, rtol=1e-5, atol=1e-8)


def test_where_nothing_yields_within_the_cycle_the_bits_are_those_of_the_elastic_strain() -> None:
    """Far below, and after shakedown, the plastic strain cancels from the amplitudes."""
    result = alternating()
    position = {"y": 0.0}
    depths = [20e-6, 1.5e-3]
    stress = fatigue.history(result, depths, **position)
    strain = fatigue.history(result, depths, **position, of="plastic_strain")
    still = (strain == strain.isel(increment=0)).all(("increment", "component")).values
    assert still.any()
    assert not still.all()
    for item in (
        fatigue.Criterion.fatemi_socie(E=E, nu=NU, k=1.0, s_y=880e6),
        fatigue.Criterion.brown_miller(E=E, nu=NU, S=0.5),
    ):
        total = fatigue.evaluate_criterion(stress, item, plastic_strain=strain).value.values
        elastic = fatigue.evaluate_criterion(stress.values, item).value.values
        np.testing.assert_array_equal(total[still], elastic[still])
        assert (total[~still] != elastic[~still]).any()
        # Where it yields most the strain is larger than the stress gives.
        largest = np.unravel_index(int(np.argmax(total - elastic)), total.shape)
        assert total[largest] > 1.3 * elastic[largest]


@pytest.mark.filterwarnings("ignore:the plastic strain comes to 6 %")
def test_the_error_of_a_value_has_that_of_the_plastic_strain() -> None:
    """The strain at the border of slip grows with each refinement; its error covers the next."""
    coarse = alternating().life(TITANIUM, "fatemi_socie", y=0.0)
    finer = scene().replace(grid=fret.Grid.strip(extent=3.6e-3, n=96))
    fine = fret.solve(finer, TO_AND_FRO, save="all", progress=False)
    fine = fine.life(TITANIUM, "fatemi_socie", y=0.0)
    change = abs(fine.worst.value - coarse.worst.value)
    assert 0.1 * coarse.worst.value < change < coarse.worst.error
    assert fine.worst.error < coarse.worst.error
    # The mean over the critical distance hardly depends on the grid.
    assert 0.6 < fine.range.best / coarse.range.best < 1.5


def test_a_cycle_that_ratchets_is_refused() -> None:
    """A first cycle under a force of one sign keeps the strain that it adds up."""
    one_sided = PRESSED.tangential([0.9 * 0.4 * 1.2e6, 0.0], increments=3)
    result = fret.solve(scene(300e6), one_sided, save="all", progress=False)
    assert result.cyclic_response().kind == "ratchets"
    with pytest.raises(ValueError, match=r"smith_watson_topper.*dang_van.*ratchets.*keeps"):
        result.life(TITANIUM, "smith_watson_topper", y=0.0)
    assert result.life(TITANIUM, "crossland", y=0.0).worst.value > 0.0


def test_a_plastic_strain_that_is_none_is_refused_by_name() -> None:
    """Its shape, its volume and its labels."""
    stress = np.array([[[1e8, 0, 0, 0, 0, 0]], [[-1e8, 0, 0, 0, 0, 0]]], dtype=float)
    with pytest.raises(ValueError, match=r"of the shape of the stress, \(2, 1, 6\)"):
        fatigue.evaluate_criterion(stress, SWT, plastic_strain=np.zeros((3, 1, 6)))
    grown = np.zeros((2, 1, 6))
    grown[0, 0, 0] = 1e-3
    with pytest.raises(ValueError, match="keeps the volume"):
        fatigue.evaluate_margin(stress, TITANIUM, "smith_watson_topper", plastic_strain=grown)
    with pytest.raises(ValueError, match="plastic_strain has the shape"):
        fatigue.evaluate_criterion(stress, SWT, plastic_strain=np.zeros(6))
    with pytest.raises(ValueError, match=r"of = 'strain'.*plastic_strain"):
        fatigue.history(alternating(), [1e-5], y=0.0, of="strain")  # type: ignore[arg-type]
