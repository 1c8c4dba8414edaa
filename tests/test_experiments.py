"""Published tests: that they can be repeated, and what is predicted of them."""

from __future__ import annotations

import numpy as np
import pytest

import pyfret as fret
from pyfret import experiments

pytestmark = pytest.mark.solves


def test_every_table_is_there() -> None:
    for name in experiments.NAMES:
        rows = experiments.table(name)
        assert len(rows) > 3
        assert all(row["set"] == "dev" for row in rows)
    with pytest.raises(ValueError, match="must be one of"):
        experiments.table("fouvry")


def test_the_scar_of_ti64_has_its_width_with_the_debris_that_stays() -> None:
    test = experiments.fouvry2017("RP_f_20")
    worn = test.wear(tolerance=0.05).dataset
    volume = float(worn.volume1[-1] + worn.volume2[-1]) * test.row["L_m"]
    assert volume == pytest.approx(test.row["worn_volume_m3"], rel=0.02)
    half = float(worn.contact_area[-1]) / 2
    assert half == pytest.approx(test.row["derived_scar_half_width_m"], rel=0.15)


def test_the_u_scar_of_ti64_has_its_profile_with_the_bed_of_debris() -> None:
    test = experiments.arnaud2021(bed=True)
    worn = test.wear(tolerance=0.02).dataset
    depth = (worn.worn1 + worn.worn2)[-1, :, 0]
    measured = np.array(test.row["depth"])
    computed = np.interp(test.row["x"], worn.x, depth)
    assert float(depth.max()) == pytest.approx(measured.max(), rel=0.08)
    assert float(np.sqrt(np.mean((computed - measured) ** 2))) < 6e-6


def test_one_set_of_constants_carries_the_volumes_of_ti64() -> None:
    rows = experiments.table("fouvry2017_ti64")
    constant = {row["test"] for row in rows if row["W_min_over_W_max"] == 1.0}
    carried = experiments.sets.TI64_CARRIED
    # Small contacts at 5 Hz wear up to 5.5 times less than the model has it.
    assert constant - set(carried) == {"R_1", "R_3", "P_4", "P_5"}
    volumes, widths = [], []
    for name in carried:
        test = experiments.fouvry2017(name, third_body=True)
        worn = test.wear(tolerance=0.02).dataset
        volume = float(worn.volume1[-1] + worn.volume2[-1]) * test.row["L_m"]
        # The table prints no volume of f_4: 2.25 mm^3 are read off its figure 7.
        volumes.append(volume / (test.row["worn_volume_m3"] or 2.25e-9))
        half_width = float(worn.contact_area[-1]) / 2
        widths.append(half_width / test.row["derived_scar_half_width_m"])
    assert np.mean(np.abs(np.log(volumes)) <= np.log(1.5)) >= 0.9
    assert np.abs(np.log(volumes)).max() < np.log(1.6)
    # P_2 and RP_f_31 have a derived width of another area than the other tests of their contact.
    assert np.mean(np.abs(np.array(widths) - 1) <= 0.15) >= 0.8


def test_oxygen_distances_of_flats_follow_one_law() -> None:
    air = experiments.sets.STEEL_AIR
    ratios = []
    for row in experiments.table("baydoun2020_distance"):
        p = (row["pressure_Pa"] / air.pressure) ** (-air.pressure_exponent / 2)
        f = (row["frequency_Hz"] / air.frequency) ** (-air.frequency_exponent / 2)
        ratios.append(air.distance * p * f / row["oxygen_distance_m"])
    assert np.mean(ratios) == pytest.approx(1.0, abs=0.05)
    assert np.std(ratios) < 0.12


def test_without_debris_the_scar_is_wider_and_stays_on_its_grid() -> None:
    kept, free = (
        experiments.arnaud2021(debris_kept=part).wear(tolerance=0.1).dataset for part in (0.85, 0.0)
    )
    # Worn surfaces that fit: the width goes with the cube root of the part that leaves.
    ratio = float(free.contact_area[-1] / kept.contact_area[-1])
    assert ratio == pytest.approx(0.15 ** (-1 / 3), rel=0.12)


def test_the_depth_of_tic_follows_its_energy() -> None:
    worn = experiments.fouvry2007("TiC").wear(jumps=6)
    d = worn.dataset
    rows = [r for r in experiments.table("fouvry2007_tic_depth") if r["phase"] == "I wear"]
    energies = [r["derived_accumulated_energy_J"] for r in rows]
    ours = np.interp(energies, np.r_[0, d.dissipated], np.r_[0, d.depth2])
    ratios = ours / np.array([r["worn_depth_m"] for r in rows])
    assert 0.9 < ratios.mean() < 1.1
    assert np.abs(ratios - 1).max() < 0.35


def test_energies_of_a_flat_on_a_flat() -> None:
    rows = experiments.table("baydoun2019")
    for n, row in enumerate(rows[:2]):
        worn = experiments.baydoun2019(n).wear(jumps=1).dataset
        assert float(worn.dissipated[-1]) == pytest.approx(row["accumulated_energy_J"], rel=0.05)


def test_a_threshold_is_bracketed_in_few_solves() -> None:
    limits = [("s_D", 311e6, "fitted"), ("t_D", 209e6, "fitted")]
    steel = fret.fatigue.Material("steel", limits)
    measure = fret.study.Averaged(steel, "crossland", 85e-6)
    threshold_load = fret.study.threshold(
        lambda values: experiments.icf13("FF_1", Q=values["Q"], n=64).scene,
        "Q",
        measure=measure,
        between=(5e4, 6e5),
        tolerance=0.02,
        error=False,
    )
    assert threshold_load.solves <= 9
    assert threshold_load.value == pytest.approx(2.73e5, rel=0.2)
    with pytest.raises(ValueError, match="widen"):
        fret.study.threshold(
            lambda values: experiments.icf13("FF_1", Q=values["Q"], n=64).scene,
            "Q",
            measure=measure,
            between=(5e4, 6e4),
        )
