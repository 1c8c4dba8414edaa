"""The comparison with other programs judges all of them by the same, right measure."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

import pyfret as fret

sys.path.append(str(Path(__file__).parents[1] / "benches"))

import hertz
import tables

STEEL = fret.Elastic(E=hertz.E, nu=hertz.NU)


@pytest.mark.parametrize("name", hertz.SHAPES)
def test_the_judge_has_the_operator_of_the_half_spaces(name: str) -> None:
    shape = hertz.SHAPES[name]
    grid = fret.Grid.centred(width=shape.width, n=24)
    p = np.random.default_rng(1).random((24, 24))
    body = fret.Body(STEEL)
    expected = fret.SurfaceOperator(body, body, grid).displacement(p)[2]
    np.testing.assert_allclose(hertz.displacement(p, shape.width), expected, rtol=1e-11)


def test_a_pressure_that_is_off_is_found_out() -> None:
    shape = hertz.SHAPES["hertz"]
    exact = hertz.pressure(shape, 64)
    computed = hertz.judge(1.01 * exact, shape)
    assert computed["error_p"] == pytest.approx(0.01)
    assert computed["balance"] == pytest.approx(0.01, abs=1e-3)
    # The gap of one per cent too much pressure: 1.01 (2 - r^2/a^2)/2 instead of that.
    assert 1e-3 < computed["residual"] < 1e-2


def test_tables_go_between_their_marks(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text("before\n<!-- begin times -->\nold\n<!-- end times -->\nafter\n")
    tables.write_between_marks(page, "times", tables.table(["cells", "time"], [["64", "1 ms"]]))
    text = page.read_text()
    assert text.startswith("before\n")
    assert text.endswith("after\n")
    assert "| 64 | 1 ms |" in text
    assert "old" not in text
    with pytest.raises(ValueError, match="no marks"):
        tables.write_between_marks(page, "memory", "")
