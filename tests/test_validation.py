"""The machinery of the validation book on small grids."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from validation import pages, runner
from validation.truth import Known, order
from validation.truths import TRUTHS, bodies

import pyfret as fret

HERTZ = bodies.PAGES[0]


def test_order_is_the_slope_of_the_error() -> None:
    sizes = (16, 32, 64)
    assert order(sizes, [n**-2.0 for n in sizes]) == pytest.approx(2.0)
    assert np.isnan(order(sizes, [1.0, 0.0, 0.0]))


def test_errors_are_over_the_truth_or_the_scale() -> None:
    assert Known(1.1, 1.0).error == pytest.approx(0.1)
    assert Known(1.1, -1.0, 2.0).error == pytest.approx(1.05)


def test_every_page_has_a_name_of_its_own() -> None:
    names = [truth.name for truth in TRUTHS]
    assert len(set(names)) == len(names)


def test_a_page_says_what_was_run(tmp_path: Path) -> None:
    outcome = runner.run(replace(HERTZ, grids=(32, 64)))
    grids = outcome.grids
    # Numbers of smooth fields converge with the square of the cell.
    assert grids.order("p_max") > 1.5
    assert grids.order("delta_z") > 1.5
    # The rim is found within a twentieth of a cell.
    x = outcome.finest.dataset.x.values
    a = grids.known[-1]["a"]
    assert abs(a.ours - a.truth) < 0.05 * (x[1] - x[0])
    pages.write(outcome, tmp_path)
    text = (tmp_path / "hertz.md").read_text(encoding="utf-8")
    assert "| 64 |" in text
    assert "observed order" in text
    assert {f.name for f in tmp_path.iterdir()} == {"hertz.md", "hertz.png", "hertz_error.png"}
    assert "hertz.md" in pages.front_row(outcome)


def test_error_bars_come_from_half_as_many_cells() -> None:
    fine = fret.solve(HERTZ.scene(64), progress=False, error=True)
    coarse = fret.solve(HERTZ.scene(32), progress=False)
    bars = fine.error_bars()
    change = abs(float(fine.at(-1).delta_z - coarse.at(-1).delta_z))
    assert 0.2 < float(bars.delta_z[0]) / change <= 1.0
    truth = bodies.ROUND
    for name, exact in (("delta_z", truth.delta_z), ("p_max", truth.p0)):
        error = abs(float(fine.at(-1).dataset[name]) - exact)
        assert 0.2 < error / float(bars[name][0]) < 1.5
    with pytest.raises(ValueError, match="error=True"):
        coarse.error_bars()
    with pytest.raises(fret.InvalidSceneError, match="even numbers of cells"):
        fret.solve(HERTZ.scene(33), progress=False, error=True)
