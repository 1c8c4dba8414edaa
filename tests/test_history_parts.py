"""Parts of a table: marched at the same time, joined to one, ended together."""

from __future__ import annotations

import threading
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

import pyfret as fret
from conftest import MU, W, sphere_on_flat
from pyfret import _core, fatigue
from pyfret._util import concurrently
from pyfret._util.progress import Progress
from pyfret.history import marching, parts
from pyfret.history.ladder import follow_channels
from pyfret.history.table import HistoryTable, keeps_memory
from test_history_store import kill_when

if TYPE_CHECKING:
    from collections.abc import Callable

PRESSED = fret.LoadPath.start().normal(W)
STEEL = "steel_42CrMo4"


def contact(ratio: float = 1.0, n: int = 32) -> fret.Scene:
    """A ball on a flat, pressed."""
    return sphere_on_flat(n=n, ratio=ratio).replace(path=PRESSED)


def history() -> fret.LoadHistory:
    """Forty reversals of more amplitudes than a table has."""
    force = np.random.default_rng(7).uniform(-0.7, 0.8, 41)
    force[0], force[20], force[-1] = 0.85, -0.75, 0.85
    return fret.LoadHistory.from_array(T_x=force * MU * W)


def damage_of(table: HistoryTable) -> fatigue.Damage:
    """Damage on a section, by a table."""
    layers = len(table.scene.body2.coatings) + 1
    materials = [fatigue.Materials()[STEEL]] * layers
    return fatigue.damage(
        table.scene, table.history, materials, "smith_watson_topper", [0.0], y=0.0, table=table
    )


def one_after_the_other(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let every table have a single thread for its runs."""
    monkeypatch.setattr(concurrently, "count_threads", lambda: 1)


@pytest.mark.solves
@pytest.mark.parametrize("ratio", [1.0, 2.0])
def test_parts_have_every_loop_and_the_numbers_of_a_single_path(
    ratio: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    in_parts = HistoryTable.build(contact(ratio), history(), progress=False)
    monkeypatch.setattr(parts, "AMPLITUDES", 100)
    whole = HistoryTable.build(contact(ratio), history(), progress=False)
    np.testing.assert_array_equal(in_parts.amplitudes, whole.amplitudes)
    count = in_parts.amplitudes.size
    assert len(set(in_parts.ladder.tops) | set(in_parts.ladder.bottoms)) == 2 * count
    # The ends of each loop are the states of that force.
    ends = in_parts.run.branches().T_x.values
    top, bottom = (ends[places] for places in (in_parts.ladder.tops, in_parts.ladder.bottoms))
    np.testing.assert_allclose(0.5 * (top - bottom), in_parts.ladder.levels[:, 0])
    assert in_parts.energies == pytest.approx(whole.energies, rel=3e-3)
    assert in_parts.total_energy == pytest.approx(whole.total_energy, rel=1e-3)
    first, second = damage_of(in_parts), damage_of(whole)
    assert first.worst == pytest.approx(second.worst, rel=0.01)
    assert first.place == second.place


@pytest.mark.solves
def test_friction_that_ages_has_no_exact_memory() -> None:
    scene = contact(n=16).replace(friction=fret.Friction(MU, kinetic=0.8 * MU))
    pressed = fret.solve(scene, progress=False)
    companions = follow_channels(history())
    assert keeps_memory(fret.solve(contact(n=16), progress=False), companions)
    assert not keeps_memory(pressed, companions)
    for law in (
        {"history": (fret.History.SLIP, [(0.0, 1.0), (1e-4, 1.2)])},
        {"law": lambda x, y, p, slip, dissipated: MU},
    ):
        aged = contact(n=16).replace(friction=fret.Friction(MU, **law))
        assert not keeps_memory(fret.solve(aged, progress=False), companions)


@pytest.mark.solves
def test_numbers_do_not_depend_on_the_threads(monkeypatch: pytest.MonkeyPatch) -> None:
    at_once = damage_of(HistoryTable.build(contact(), history(), progress=False))
    one_after_the_other(monkeypatch)
    assert damage_of(HistoryTable.build(contact(), history(), progress=False)) == at_once


@pytest.mark.solves
def test_parts_that_were_killed_go_on_to_the_same_bytes(tmp_path: Path) -> None:
    store, whole = tmp_path / "store", tmp_path / "whole"
    code = (
        "from test_history_parts import stored_damage\nfrom pathlib import Path\n"
        f"stored_damage(Path({str(store)!r}))"
    )
    kill_when(store, code, store / "8_amplitudes_2_of_2.zarr")
    assert stored_damage(store) == stored_damage(whole)
    names = sorted(path.name for path in whole.iterdir())
    assert names == sorted(path.name for path in store.iterdir())
    assert sum(name.startswith("half_of_the_cells_8") for name in names) == 4


def stored_damage(store: Path) -> fatigue.Damage:
    """Damage by a table whose runs are in a folder."""
    return damage_of(HistoryTable.build(contact(), history(), store=store, progress=False))


@pytest.mark.solves
def test_parts_are_one_bar(monkeypatch: pytest.MonkeyPatch) -> None:
    counts: list[tuple[int, int]] = []
    monkeypatch.setattr(Progress, "observer", lambda done, total: counts.append((done, total)))
    HistoryTable.build(contact(n=16), history())
    ends = [n for n, (done, total) in enumerate(counts) if done == total]
    # One bar presses the bodies, one has the parts, maybe one more has 16 amplitudes.
    assert len(ends) in (2, 3)
    for start, end in zip([-1, *ends[:-1]], ends, strict=True):
        numbers = [done for done, _ in counts[start + 1 : end + 1]]
        assert numbers == sorted(numbers)


@pytest.mark.solves
def test_one_failure_ends_all_parts(monkeypatch: pytest.MonkeyPatch) -> None:
    solve = _core.solve_in_memory
    calls: list[int] = []

    def fail_second(scene: fret.Scene, *, on_increment: Callable[[int, int], None]) -> object:
        calls.append(len(scene.path.branches))
        if len(calls) == 2:
            raise fret.errors.NoConvergenceError("a part of the table")
        return solve(scene, on_increment=on_increment)

    monkeypatch.setattr(marching._core, "solve_in_memory", fail_second)
    marches = marching.Marches(progress=False)
    scene = contact()
    path = PRESSED.tangential([0.5 * MU * W, -0.5 * MU * W] * 10)
    scenes = {name: scene.replace(path=path) for name in ("a", "b", "c")}
    with pytest.raises(fret.errors.NoConvergenceError, match="a part of the table"):
        marches.run_all(scenes)
    assert marches.made == {}


def test_an_interrupt_ends_all_works(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(concurrently, "count_threads", lambda: 2)
    begun, ended = threading.Barrier(3), []

    def work(count: Callable[[int, int], None]) -> None:
        begun.wait()
        try:
            while True:
                count(1, 2)
        finally:
            ended.append(True)

    def interrupt(*_: object) -> None:
        begun.wait()
        raise KeyboardInterrupt

    monkeypatch.setattr(concurrently, "wait", interrupt)
    with Progress(title="", shown=False) as bar, pytest.raises(KeyboardInterrupt):
        concurrently.run_concurrently({"a": work, "b": work}, bar)
    assert ended == [True, True]
