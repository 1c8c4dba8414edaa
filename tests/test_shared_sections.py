"""Stress measures of a result sample each section once."""

from __future__ import annotations

import pytest

import pyfret as fret
from conftest import W, sphere_on_flat
from pyfret.snapshot import Snapshot
from pyfret.study.measures import evaluate_measures

pytestmark = pytest.mark.solves


def test_stress_measures_share_their_sections(monkeypatch: pytest.MonkeyPatch) -> None:
    """Three measures of five increments: searched sections alone, numbers of single questions."""
    path = fret.LoadPath.start().normal(W, increments=2).tangential([50.0], increments=3)
    result = fret.solve(sphere_on_flat(n=12), path, save="all", progress=False)
    names = ["von_mises", "tresca", "s_1"]
    alone = {
        name: float(evaluate_measures(fret.Result(result.dataset), [name])[0][name].values)
        for name in names
    }
    sections = 0
    stress = Snapshot.stress

    def count(*arguments: object, **options: object) -> object:
        nonlocal sections
        sections += 1
        return stress(*arguments, **options)  # type: ignore[arg-type]

    monkeypatch.setattr(Snapshot, "stress", count)
    numbers, _ = evaluate_measures(result, names)
    # All are sampled in one call (test_answers.py); a search evaluates the section of its state.
    assert 0 < sections <= len(names)
    assert {name: float(numbers[name].values) for name in names} == alone
