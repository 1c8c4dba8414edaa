"""One history in many forms: a small part of ``tests/campaign/histories.py``."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import pytest

import pyfret as fret

sys.path.insert(0, str(Path(__file__).parent / "campaign"))

import histories

pytestmark = [pytest.mark.solves, pytest.mark.filterwarnings("ignore")]


@pytest.mark.parametrize(
    ("seed", "points"),
    [
        (1, 8),
        pytest.param(4, 16, marks=pytest.mark.slow),
        pytest.param(9, 64, marks=pytest.mark.slow),
    ],
)
def test_energy_wear_life_and_crack_do_not_depend_on_the_form(seed: int, points: int) -> None:
    """Zigzag, sine, function and file with noise, in one channel or two: within the errors."""
    rows = list(histories.compare(replace(histories.drawn(seed), points=points)))
    assert {form for form, *_ in rows} == {f"sine of {points}", "function", "file"}
    assert {name for _, name, *_ in rows} == {"energy", "volume", "life", "dK"}
    for _, _, ratio, words in rows:
        assert ratio < histories.MOST, words


def test_a_file_without_its_period_is_refused_by_name() -> None:
    """Noise does not return: the period is missing."""
    path = histories.drawn(1).file()
    assert len(path.whole_cycles()) == 2
    bare = path.repeats(period=None)
    assert bare.whole_cycles() == []
    with pytest.raises(ValueError, match="period"):
        fret.wear.solve(histories.scene(bare), cycles=10.0, body2=histories.LAW, progress=False)


@pytest.mark.slow
def test_random_histories() -> None:
    """Twelve histories."""
    rows = [row for seed in range(12) for row in histories.compare(histories.drawn(seed))]
    within = [ratio < histories.MOST for _, name, ratio, _ in rows if name]
    assert sum(within) >= 0.95 * len(within)
