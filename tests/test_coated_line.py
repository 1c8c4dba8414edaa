"""The coated line contact beside CalculiX: the kept runs, and what the page compares."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.append(str(Path(__file__).parents[1]))

from validation import calculix, coated_line
from validation.calculix import MU, A, Tractions


@pytest.mark.solves
def test_both_programs_have_the_same_tractions() -> None:
    kept = json.loads(coated_line.KEPT.read_text())
    finest = [row for row in kept["elements"] if row["ratio"] == 2.0 and row["cells"] == 20]
    reference = coated_line.solve(2.0, 256, 64, 12)
    for row in finest:
        errors = coated_line.errors(coated_line.of_elements(row), reference)
        # An elastic slip of 1.3 % of the slip, and elements of a/20.
        assert errors.p < 0.005
        assert errors.q < 0.035
    few = [row for row in kept["ours"] if row["press"] == 8]
    for row in few:
        q = np.abs(row["steps"][0]["q"]).max()
        assert q - row["q_error"] < coated_line.largest(reference[0]) < q + row["q_error"]


def test_stick_limits_of_a_root_lie_between_the_points() -> None:
    x = np.linspace(-A, A, 60)
    p = 500.0 * np.sqrt(np.maximum(1.0 - (x / A) ** 2, 0.0))
    c = 0.43 * A
    shortfall = MU * 215.0 * np.sqrt(np.maximum(1.0 - (x / c) ** 2, 0.0))
    ends = coated_line.stick_limits(Tractions(x, p, MU * p - shortfall))
    assert ends == pytest.approx((-c, c), abs=0.004 * A)


def test_the_input_of_calculix_has_two_blocks_and_a_coating(tmp_path: Path) -> None:
    model = calculix.Model(cells=5)
    nodes = calculix.write_input(model, tmp_path / "job.inp")
    text = (tmp_path / "job.inp").read_text()
    x, z = calculix.coordinates(model)
    assert nodes == 2 * x.size * z.size
    assert text.count("*STEP, INC") == 1 + len(calculix.BRANCHES)
    assert np.all(np.diff(x) > 0.0)
    assert np.isclose(z, calculix.THICKNESS).sum() == 1
