"""One contact of the campaign of moved contacts, in the ways that differ most."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent / "campaign"))

import moved


@pytest.mark.solves
@pytest.mark.parametrize(
    ("seed", "way"),
    [
        pytest.param(0, "beside the middle", marks=pytest.mark.slow),
        (1, "bodies exchanged"),
    ],
)
def test_every_number_of_a_moved_contact_stays(seed: int, way: str) -> None:
    rows = list(moved.compared(moved.draw(seed), [way], criteria=["crossland", "findley"]))
    assert len(rows) > 40
    wrong = [
        f"{name}: {there:.5g}, right {value:.5g} +- {allowed:.2g}"
        for _, name, value, there, allowed in rows
        if not abs(there - value) <= allowed
    ]
    assert len(wrong) <= 0.01 * len(rows), wrong
