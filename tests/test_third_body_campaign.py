"""A small part of the campaign of the third body: ``python tests/campaign/third_body.py``."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent / "campaign"))

import third_body

pytestmark = [pytest.mark.solves, pytest.mark.filterwarnings("ignore")]


@pytest.mark.parametrize("seed", [3, 29, 42, 46, 67, 97])
def test_the_depth_of_a_random_run_is_within_its_error_bar(seed: int) -> None:
    faults, ratio = third_body.audit(seed)
    assert faults == []
    # Cells that are aerated in part, and oxygen on cells as large as lambda, err the most.
    assert ratio <= third_body.FACTOR
