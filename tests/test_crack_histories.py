"""K of closed cracks: the error of K_II has the slip that faces keep from earlier states."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

import pyfret as fret

sys.path.insert(0, str(Path(__file__).parent / "campaign"))

import lines

pytestmark = pytest.mark.solves

#: Cells of the contact, and of its truth.
CELLS = (64, 192)


def drawn(seed: int) -> tuple[list[fret.Result], float]:
    """The contact of a seed on both grids, and its half-width [m]."""
    scenes = [lines.drawn(seed, n) for n in CELLS]
    results = [fret.solve(scene, progress=False, save="all") for scene in scenes]
    bodies = (scenes[0].body1.substrate, scenes[0].body2.substrate)
    W = float(results[0].dataset.W.max())
    return results, fret.reference.line_contact(R=scenes[0].body1.shape.R, bodies=bodies, W=W).a


def ends(result: fret.Result, cracks: fret.fracture.Cracks) -> np.ndarray:
    """Rows of the ends of branches among the states of a crack."""
    branch = result.dataset.branch_of_increment.sel(increment=cracks.dataset.increment).values
    return np.flatnonzero(np.append(np.diff(branch) > 0, True))


@pytest.mark.parametrize("seed", [0, 4])
def test_the_error_of_a_closed_crack_has_the_slip_of_earlier_states(seed: int) -> None:
    """Below the contact: shear slips the faces as it turns, pressure holds them from then on."""
    results, a = drawn(seed)
    lengths = np.array([0.03, 0.1, 0.3]) * a
    for friction in (0.0, 0.5):
        coarse, fine = (r.crack(0.5 * a, lengths=lengths, friction=friction) for r in results)
        rows, right = ends(results[0], coarse), ends(results[1], fine)
        K, bars = (coarse.dataset[name].values[rows] for name in ("K_II", "error"))
        off = np.abs(K - fine.dataset.K_II.values[right])
        assert np.all(off <= lines.MOST * bars), (friction, off / bars)
        # The bar is not the size of the number.
        assert np.median(bars / np.abs(K).max()) < 0.2
