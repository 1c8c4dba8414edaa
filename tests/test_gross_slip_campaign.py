"""A small part of the campaign of wear in gross slip: ``python tests/campaign/gross_slip.py``."""

from __future__ import annotations

import re
import sys
from dataclasses import replace
from pathlib import Path

import pytest

import pyfret as fret

sys.path.insert(0, str(Path(__file__).parent / "campaign"))

import gross_slip

pytestmark = [pytest.mark.solves, pytest.mark.filterwarnings("ignore")]


@pytest.mark.parametrize("kind", gross_slip.KINDS)
def test_depths_lie_within_their_errors_and_volumes_are_exact(kind: str) -> None:
    """Against more cells and more places; V = k W s N."""
    seed = 7 if kind in gross_slip.ROUND else 2
    ratios, volume, words = gross_slip.compare(gross_slip.drawn(seed, kind), seed)
    assert max(ratios.values()) < gross_slip.MOST, words
    assert volume < gross_slip.VOLUME, words


@pytest.mark.parametrize("stroke", [0.2, 20.0])
def test_a_worn_cylinder_has_lost_a_segment(stroke: float) -> None:
    """Depth b^2/(2 R), whatever the stroke."""
    ratio, words = gross_slip.compare_with_segment(stroke)
    assert ratio < gross_slip.MOST, words


@pytest.mark.parametrize("cells", [1.3, 1.6, 2.2, 3.0])
@pytest.mark.parametrize("k", [(1.0, 0.0), (0.0, 1.0)])
def test_few_cells_across_a_spot_have_their_error(cells: float, k: tuple[float, float]) -> None:
    """A little wear of spots of a few cells, whose depth is off by per cents."""
    case = gross_slip.drawn(0, "cylinder")
    K = sum(case.k)
    case = replace(case, k=(k[0] * K, k[1] * K), cycles=0.2 * case.cycles)
    fine, coarse = case.wear(12.0), case.wear(cells)
    (right,), (depth,) = (gross_slip.numbers(run).values() for run in (fine, coarse))
    bar = coarse.error_of("depth")
    assert abs(depth / right - 1.0) < gross_slip.MOST * bar
    assert bar > fine.error_of("depth")


def test_the_width_that_is_named_exceeds_the_grid() -> None:
    """Wavy bodies that fit by the worn volume alone, and not by their elastic contact."""
    case = gross_slip.drawn(5, "waviness")
    narrow = replace(case, lengths=(4.4931e-3, 1.0))
    with pytest.raises(fret.errors.OffGridError, match=r"after [1-9]") as refused:
        narrow.wear(3.0)
    width = re.search(r"should be about ([0-9.e+-]+) m by 1\.0", str(refused.value))
    assert width is not None
    wide = replace(case, lengths=(float(width[1]), 1.0))
    assert wide.lengths[0] > 1.02 * narrow.lengths[0]
    assert wide.wear(3.0).dataset.attrs["status"] == "done"


@pytest.mark.slow
@pytest.mark.parametrize("kind", gross_slip.KINDS)
def test_random_runs(kind: str) -> None:
    """Six runs of every kind."""
    rows = [gross_slip.compare(gross_slip.drawn(seed, kind), seed) for seed in range(6)]
    assert all(volume < gross_slip.VOLUME for _, volume, _ in rows)
    within = [ratio < gross_slip.MOST for ratios, _, _ in rows for ratio in ratios.values()]
    assert sum(within) >= 0.95 * len(within), [words for *_, words in rows]
