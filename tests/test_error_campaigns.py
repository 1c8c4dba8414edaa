"""Printed errors cover the true errors: small parts of the campaigns of lines, balls and wear."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

import pyfret as fret

sys.path.insert(0, str(Path(__file__).parent / "campaign"))

import lines
import paths
import worn

pytestmark = pytest.mark.solves


@pytest.mark.parametrize("seed", [1, 13, 19, 24])
def test_ends_of_stick_zones_lie_within_their_errors(seed: int) -> None:
    """Four times the cells: borders that the tractions give, and borders between two cells."""
    coarse, fine = (
        fret.solve(lines.drawn(seed, n), progress=False).at(-1).stick_zone() for n in (64, 256)
    )
    assert coarse.error is not None
    for side in ("left", "right"):
        off = abs(getattr(coarse, side) - getattr(fine, side))
        assert off < lines.MOST * coarse.error, (side, coarse, fine)


def test_a_crack_without_a_place_starts_at_the_outermost_rim() -> None:
    """The contact of unlike bodies moves with the shear; the chosen state would be chance."""
    found = {}
    for n in (64, 256):
        scene = lines.drawn(0, n)
        result = fret.solve(scene, progress=False, save="all")
        found[n] = result.crack(lengths=np.array([0.02, 0.1, 0.5]) * 3e-4)
        cell = scene.grid.dx
    coarse, fine = found[64], found[256]
    assert abs(coarse.dataset.attrs["x"] - fine.dataset.attrs["x"]) < 0.15 * 4 * cell
    assert (abs(coarse.dK() - fine.dK()) < lines.MOST * coarse.dK_error()).all()
    assert (coarse.dK_error() < 0.15 * coarse.dK()).all()
    assert (coarse.dK_error() > 1e-4 * coarse.dK()).all()


def test_the_place_of_the_rim_is_part_of_the_error() -> None:
    scene = lines.drawn(1, 64)
    result = fret.solve(scene, progress=False, save="all")
    lengths = np.array([0.02, 0.1]) * 3e-4
    free = result.crack(lengths=lengths)
    fixed = result.crack(free.dataset.attrs["x"], lengths=lengths)
    assert np.array_equal(free.dataset.K_I, fixed.dataset.K_I)
    assert (free.dataset.error.values >= fixed.dataset.error.values).all()
    assert (free.dataset.error.values > fixed.dataset.error.values).any()


@pytest.mark.parametrize("scene", [("line", 64, 0.15, 5e3), ("line", 60, 0.5, 5e3)])
def test_worn_depth_and_volume_have_the_error_of_their_cells(
    scene: tuple[str, int, float, float],
) -> None:
    """A slip zone of 2 cells is doubted, one of 7 is not."""
    found, doubted, words = worn.ratios(*scene)
    assert doubted == (scene[2] == 0.15), words
    assert doubted or max(found.values()) < worn.MOST, words


def test_a_stress_that_jumps_along_a_crack() -> None:
    """Hartranft and Sih's weight function of an edge crack, to 0.5 %; without the interface 2 %."""
    length, depth = 1e-4, 3e-5
    x, w = np.polynomial.legendre.leggauss(100)
    top = np.arcsin(depth / length)
    t = top * (x + 1) / 2
    truth = -2 * np.sqrt(length / np.pi) * ((1.3 - 0.3 * np.sin(t) ** 1.25) * w).sum() * top / 2
    crack = fret.fracture.Crack(legs=[(length, 0.0)], interfaces=[depth])
    stress = np.zeros((1, len(crack.points), 6))
    stress[0, crack.points[:, 1] < depth, 0] = -1.0
    K = crack.intensity(stress)
    assert K["K_I"][0] == pytest.approx(truth, rel=6e-3)
    assert K["error"][0] < 5e-3 * abs(truth)
    assert crack.interfaces == [depth]
    assert "interfaces=[3e-5]" in repr(crack)


def test_energies_along_a_coarser_path_are_those_of_the_grid() -> None:
    """The last increment of a branch starts from displacements that were interpolated."""
    ball, flat = fret.Elastic(E=210e9, nu=0.3), fret.Elastic(E=70e9, nu=0.2)
    radius = fret.reference.hertz(R=0.01, bodies=(ball, flat), W=100.0).a
    T = 0.7 * 0.69 * 100.0
    loops = {}
    for path_grid in (64, "same"):
        scene = fret.Scene(
            body1=fret.Body(ball, shape=fret.Sphere(R=0.01)),
            body2=fret.Body(flat),
            friction=0.69,
            grid=fret.Grid.centred(width=2.6 * radius, n=128),
            path=fret.LoadPath.start().normal(100.0).tangential([T, -T, T]),
            settings=fret.Settings(path_grid=path_grid),
        )
        result = fret.solve(scene, progress=False)
        loops[path_grid] = result.branches().dissipated.values[1:]
        # The energies per area add up to the energies of the branches.
        field = result.at(-1).dissipated_density.sum() * scene.grid.dx**2
        assert float(field) == pytest.approx(result.dataset.dissipated.values.sum(), rel=1e-3)
    assert loops[64] == pytest.approx(loops["same"], rel=1.5e-3)


@pytest.mark.parametrize(
    "seed", [5, *(pytest.param(seed, marks=pytest.mark.slow) for seed in (3, 8))]
)
def test_energies_of_branches_are_within_their_errors_on_a_coarser_path(seed: int) -> None:
    """The error of a branch does not vanish by chance."""
    ratios = paths.ratios(seed)
    assert ratios.size == 3
    assert ratios.max() < paths.MOST, ratios
    assert np.median(ratios) > 0.1, ratios
