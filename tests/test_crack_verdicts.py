"""Verdicts on cracks: grow, stop or stay, with the error of K and the length they hold for."""

from __future__ import annotations

import matplotlib as mpl
import numpy as np
import pytest

import pyfret as fret
from pyfret import fracture

mpl.use("Agg")


def test_what_becomes_of_a_crack_has_the_error_of_k() -> None:
    """K falls as 1/l: it stops where dK (1 +- 5 %) is the threshold, and the margin has 5 %."""
    lengths = np.geomspace(1e-5, 1e-3, 400)
    plain = fracture.Cracks.from_arrays(lengths, 3e6 * (1e-4 / lengths), np.zeros(400))
    error = (0.05 * plain.dataset.K_I).assign_attrs(units="Pa m^0.5")
    cracks = fracture.Cracks(plain.dataset.assign(error=error))
    threshold = fracture.Threshold(dK_th=3e6)
    without, arrest = plain.arrest(threshold), cracks.arrest(threshold)
    assert without.margin_error is None
    assert without.lengths is None
    assert "(estimate)" in without.describe()
    assert arrest.verdict == "stops"
    assert arrest.is_sure
    assert arrest.length == pytest.approx(1e-4, rel=2e-3)
    assert arrest.lengths == pytest.approx((0.95e-4, 1.05e-4), rel=2e-3)
    assert arrest.margin_error == pytest.approx(0.05 * arrest.margin, rel=1e-6)
    assert "100 (95 to 105) um" in arrest.describe()
    assert "+-" in arrest.describe()
    # At 1.02 times the threshold at its first length the error leaves two verdicts.
    unsure = cracks.arrest(fracture.Threshold(dK_th=3e7 / 1.02))
    assert (unsure.verdict, set(unsure.verdicts)) == ("stops", {"stops", "dormant"})
    assert "not decided within the error of K: it may not grow" in unsure.describe()
    assert "dK/dK_th 1.020 +- 0.051 at that length" in unsure.describe()
    assert not unsure.is_sure
    # The bar of the margin reaches over 1 where both of its ends grow: not decided.
    sure = cracks.arrest(fracture.Threshold(dK_th=2.9e5))
    assert (sure.verdict, sure.is_sure) == ("grows", False)
    assert "not decided within the error of K" in sure.briefly()


def bump(threshold: float = 1e6) -> fracture.Cracks:
    """K that is above a threshold of 1 MPa m^0.5 between about 17 and 92 um, 0.5 to 600 um."""
    lengths = np.geomspace(5e-6, 6e-4, 24)
    K = 2.0 * threshold * np.exp(-(np.log(lengths / 4e-5) ** 2))
    plain = fracture.Cracks.from_arrays(lengths, K, np.zeros(24))
    error = (0.1 * plain.dataset.K_I).assign_attrs(units="Pa m^0.5")
    return fracture.Cracks(plain.dataset.assign(error=error))


@pytest.mark.parametrize(
    ("start", "verdict", "words"),
    [
        (None, "dormant", ["from a length of 5 um, the shortest computed", "one of 17.4 um to 91"]),
        (2e-5, "stops", ["from a length of 20 um", "one shorter than 17.4 um would not grow"]),
        (1e-4, "dormant", ["from a length of 100 um", "one of 17.4 um to 91"]),
    ],
)
def test_a_verdict_says_for_which_length_it_holds_and_what_others_do(
    start: float | None, verdict: str, words: list[str]
) -> None:
    cracks, threshold = bump(), fracture.Threshold(dK_th=1e6)
    arrest = cracks.arrest(threshold, start=start)
    life = cracks.life(threshold, fracture.Paris(C=1e-11, m=3.0), start=start)
    assert arrest.verdict == verdict
    assert arrest.start == (5e-6 if start is None else start)
    ((low, high),) = arrest.growing
    assert (low, high) == pytest.approx((17.40e-6, 91.97e-6), rel=1e-3)
    for word in words:
        assert word in arrest.describe()
    assert arrest.describe().startswith(arrest.briefly())
    if verdict == "dormant":
        assert arrest.length is None
        assert arrest.tip == arrest.start
        assert "stop at 91.97 um" in repr(life)
        assert "no number of cycles" in life.describe()
        assert "does not grow" in str(life.why_infinite())
        # A crack of the length that it names does grow.
        longer = cracks.arrest(threshold, start=1.01 * low)
        assert longer.verdict == "stops"
        assert longer.length == pytest.approx(high)
    else:
        assert arrest.tip == arrest.length == pytest.approx(high)
        assert "cycles from 20 um to 91.97 um, where it stops" in life.describe()


def test_growth_through_all_lengths_and_through_none() -> None:
    cracks = bump()
    none = cracks.arrest(fracture.Threshold(dK_th=1e7))
    assert none.growing == ()
    assert "nor would one of any length up to 600 um" in none.describe()
    even = fracture.Cracks.from_arrays(cracks.lengths, np.full(24, 1e6), np.zeros(24))
    every = even.arrest(fracture.Threshold(dK_th=2e4))
    assert every.growing == ((5e-6, 6e-4),)
    assert every.describe().startswith(
        "grows through all lengths from a length of 5 um, the shortest computed, to 600 um; least"
    )


def test_an_error_as_large_as_the_number_is_told() -> None:
    cracks = bump()
    wide = cracks.dataset.assign(error=(1.2 * cracks.dataset.K_I).assign_attrs(units="Pa m^0.5"))
    arrest = fracture.Cracks(wide).arrest(fracture.Threshold(dK_th=1e6), start=4e-5)
    assert "the error of K is as large as dK" in arrest.describe()
    assert not arrest.is_sure


def test_what_rests_on_an_estimate_says_so() -> None:
    """Threshold, length, cycles, figures: the word stands at each; a measured one has none."""
    table = fret.fatigue.Materials()
    estimated = fracture.Threshold.from_material(table["titanium_6Al4V"])
    assert "dK_th" in str(estimated.estimate)
    measured = fracture.Threshold.from_material(table["aluminium_4Cu"])
    assert measured.estimate is None
    cracks = bump(estimated.dK_th)
    paris = fracture.Paris(C=1e-11, m=3.0)
    for threshold, marked in ((estimated, True), (measured, False)):
        arrest = cracks.arrest(threshold, start=4e-5)
        life = cracks.life(threshold, paris, start=4e-5)
        assert arrest.verdict == "stops"
        for text in (arrest.describe(), arrest.briefly(), arrest.describe_length(), repr(life)):
            assert ("estimate" in text) == marked, text
        axes = (
            fret.plot.crack_arrest(cracks, threshold, start=4e-5),
            fret.plot.kitagawa(cracks, threshold),
        )
        for ax in axes:
            legend = [text.get_text() for text in ax.get_legend().get_texts()]
            assert any("(estimate)" in item for item in legend) == marked


def test_too_few_lengths_are_refused_with_what_to_do() -> None:
    lengths = [1e-5, 1e-4]
    cracks = fracture.Cracks.from_arrays(lengths, [1e6, 2e6], [0.0, 0.0])
    expected = r"number of lengths of the crack = 2: must be 4 or more.*more lengths.*default"
    with pytest.raises(ValueError, match=expected):
        cracks.arrest(fracture.Threshold(dK_th=1e6))
    with pytest.raises(ValueError, match=expected):
        cracks.life(fracture.Threshold(dK_th=1e6), fracture.Paris(C=1e-11, m=3.0))
